#include "Input.h"
#include "Json.h"
#include "Progress.h"
#include "Result_model.h"
#include "Transfer_map.h"
#include "View_file.h"
#include "distance_bound.h"
#include "number.h"
#include "commands.h"

#include "../Bake/Color_source.h"
#include "../Bake/Normal_source.h"
#include "../Bake/Texel_map.h"
#include "../Bake/bake.h"
#include "../Carry/corner_mixes.h"
#include "../Carry/transfer_attributes.h"
#include "../Files/read_model.h"
#include "../Files/texture_comments.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Tool {

namespace {

bool bakes(const Transfer_options& options)
{
  return !options.image.empty() || !options.normal_image.empty();
}

std::vector<std::string> images_of(const Transfer_options& options)
{
  std::vector<std::string> images;
  for(const std::string& image : { options.image, options.normal_image })
    if(!image.empty()) images.push_back(image);
  return images;
}

// Returns whether the names of files can be used, before anything is read.
Outcome check_names(const Transfer_options& options)
{
  const std::vector<std::string> images = images_of(options);
  if(const Outcome output = check_output(options.output, { options.input, options.to }); !output) return output;
  for(std::size_t n = 0; n < images.size(); ++n) {
    if(extension_of(images[n]) != ".png")
      return { WRONG_USAGE, images[n], "Images are PNG files: use the extension .png." };
    if(n > 0 && images[n] == images[0]) return { WRONG_USAGE, images[n], "Both images have the same name." };
  }
  return DONE;
}

// Makes an image the texture of all polygons of a model that is written to a file.
void set_texture(Model& model, const std::string& image, const std::string& output)
{
  const std::filesystem::path path(image);
  const std::string folder = path.parent_path().string();
  const bool is_PLY = output == stream_name ? model.format == "ply" : extension_of(output) == ".ply";
  const std::string replaced = is_PLY ? texture_number_name : material_name;
  auto& attributes = model.attributes;
  attributes.erase(
    std::remove_if(attributes.begin(), attributes.end(), [&](const Attribute& a) { return a.name == replaced; }),
    attributes.end());
  if(is_PLY) {
    set_textures_in_comments(model, { moved_name(path.filename().string(), folder, model.folder) });
    return;
  }
  const std::string baked = "baked";
  model.folder = folder;
  model.assets.reset();
  model.materials = "newmtl " + baked + "\nKd 1 1 1\nmap_Kd " + path.filename().string() + "\n";
  attributes.push_back({ material_name,
                         Element::POLYGON,
                         Kind::LABEL,
                         Number_type::INT32,
                         { material_name },
                         std::vector<double>(model.soup.polygons.size(), 1),
                         { "", baked } });
}

struct Baked
{
  std::vector<std::pair<std::string, Image> > images; // files and their contents
  std::size_t covered = 0, overlapping = 0;           // numbers of texels
  std::vector<std::string> warnings;
};

void bake_images(const Transfer_options& options, const Model& from, const Model& to, const Transfer_map& map,
                 const std::optional<Color_source>& colors, Progress& progress, Baked& baked)
{
  const Texel_map texels(to, map.mesh, *texture_coordinates(to), options.size);
  baked.covered = texels.covered();
  baked.overlapping = texels.overlapping();
  if(baked.overlapping > 0)
    baked.warnings.push_back(
      std::to_string(baked.overlapping) + " texels belong to several polygons, for example to polygons "
      + std::to_string(texels.overlapping_polygons()[0]) + " and " + std::to_string(texels.overlapping_polygons()[1])
      + ": their texture coordinates overlap, and the first polygon is baked.");
  if(texels.outside() > 0)
    baked.warnings.push_back(std::to_string(texels.outside())
                             + " triangles have no texture coordinates, or some outside [0, 1]; they are not baked "
                               "there.");
  const Mesh_origins& origins = map.map->origins();
  const auto mix = [&](const Source_point& p) { return mix_of(p.corners, p.weights, origins); };
  std::optional<Normal_source> normals;
  std::vector<Color_of_point> functions;
  if(colors) functions.push_back([&](const Source_point& p) { return (*colors)(origins.polygon_of(p.facet), mix(p)); });
  if(!options.normal_image.empty()) {
    normals.emplace(from, *map.map);
    functions.push_back([&](const Source_point& p) { return (*normals)(p, mix(p)); });
  }
  std::vector<Image> images = bake(*map.map, texels, options.margin, functions,
                                   [&](double fraction) { progress.show("image", fraction); });
  progress.clear();
  for(std::size_t n = 0; n < images.size(); ++n) baked.images.emplace_back(images_of(options)[n], std::move(images[n]));
}

// Returns which part of the map is proved.
std::string map_message(const Transfer_map& map)
{
  const BS::Shell_of_soup_3& found = map.found;
  if(found.certification() == BS::Certification::NONE) return "none: " + map.outcome.message;
  const Mapped_parts& parts = map.parts;
  const std::string onto = found.proxy     ? " to the proxy, from which it continues to the visible polygons"
                           : found.excised ? " except for excised triangles"
                                           : "";
  if(parts.is_one_to_one()) return "one-to-one" + onto + ": proved for the whole mesh";
  const double share = parts.share(Mapped::ONE_TO_ONE);
  return (share > 0 ? percent(share) + " of the area one-to-one" + onto
                        + (parts.is_certified ? ": proved as a whole; "
                                              : ": each facet is proved to face along the curves, and samples return; ")
                    : "nothing is one-to-one; ")
         + percent(parts.share(Mapped::CONTINUED)) + " continued without a proof; "
         + percent(parts.share(Mapped::NEAREST)) + " outside of the shell, with values of the nearest points";
}

void print_list(std::ostream& out, const std::string& title, const std::vector<std::string>& list)
{
  if(list.empty()) return;
  out << title;
  for(const std::string& item : list) out << " " << item;
  out << "\n";
}

void print(const Transfer_options& options, const Transfer_map& map, double distance, double unit,
           const Attribute_transfer& transferred, const Baked& baked)
{
  std::ostream& out = report_stream(options.output);
  out << "map         " << map_message(map) << "\n";
  if(!map.parts.is_one_to_one())
    out << "            marked by the property \"" << mapped_name
        << "\" of points: 0 one-to-one, 1 continued, 2 nearest\n";
  out << "distance    no point is farther than " << number(distance) << " from the first mesh ("
      << percent(distance / unit) << " of its box)\n";
  if(map.found.certification() != BS::Certification::NONE)
    out << "shell       thickness " << number(map.thickness) << " (" << percent(map.thickness / unit)
        << " of the box); " << name(map.found.certification()) << "; " << name(map.found.kind()) << "\n";
  print_list(out, "attributes ", transferred.transferred);
  print_list(out, "replaced   ", transferred.replaced);
  if(transferred.facets_across_seams > 0)
    out << "seams       " << transferred.facets_across_seams << " facets straddle a seam\n";
  for(const auto& image : baked.images)
    out << "image       " << image.first << ": " << options.size << " x " << options.size << " texels, "
        << percent(double(baked.covered) / double(options.size * options.size)) << " covered\n";
  out << std::flush;
}

} // namespace

Outcome transfer(const Transfer_options& options, bool writes_json)
{
  if(const Outcome names = check_names(options); !names) return names;
  Model from, to;
  if(const Outcome read = read_input(options.input, from); !read) return read;
  if(const Outcome read = read_input(options.to, to); !read) return read;
  std::vector<std::string> outputs = images_of(options);
  outputs.push_back(options.output);
  if(const Outcome files = check_files(outputs, { &from, &to }); !files) return files;
  if(!options.view.empty())
    if(const Outcome view = check_view(options.view); !view) return view;
  for(const std::string& file : outputs)
    if(!is_writable(file)) return { CANNOT_WRITE, file, message(File_status::CANNOT_WRITE) };

  const Time_limit time(options.seconds);
  Baked baked;
  if(bakes(options) && texture_coordinates(to) == nullptr)
    return { WRONG_INPUT, options.to, "The mesh has no texture coordinates: unwrap it before colors are baked." };
  std::optional<Color_source> colors;
  if(!options.image.empty()) colors.emplace(from, baked.warnings);
  if(colors && !*colors) return { WRONG_INPUT, options.input, "The mesh has no texture and no colors to bake." };

  Progress progress;
  double distance = 0;
  {
    const Triangulated_model source(from), target(to);
    for(const auto& side : { std::make_pair(&options.input, &source), std::make_pair(&options.to, &target) })
      if(side.second->mesh().number_of_faces() == 0) return { WRONG_INPUT, *side.first, "No polygon has an area." };
    constexpr double resolution = 1e-4; // relative to the longest side of the bounding box
    progress.show("distances", 0);
    distance = distance_bounds(target.mesh(), source.mesh(), resolution * longest_side(from),
                               std::numeric_limits<double>::infinity())
                 .to_second;
  }
  const double unit = longest_side(from);
  const std::unique_ptr<const Transfer_map> map = transfer_map(from, to, options, distance, time, progress);
  Attribute_transfer transferred;
  Model output = transfer_attributes(from, to, map->mesh, *map->map, map->parts,
                                     { options.includes_normals, !bakes(options) }, transferred,
                                     [&](double fraction) { progress.show("attributes", fraction); });
  progress.clear();
  if(bakes(options)) bake_images(options, from, to, *map, colors, progress, baked);
  if(!options.image.empty()) set_texture(output, options.image, options.output);

  Contents images;
  for(const auto& [file, image] : baked.images) {
    std::optional<std::string> png = png_of(image);
    if(!png) return { CANNOT_WRITE, file, "Not enough memory for the image: choose a smaller --size." };
    images.emplace_back(file, std::move(png));
  }
  std::vector<std::string> written_attributes, warnings = baked.warnings;
  if(const Outcome written = write_result(output, options.output, { &from, &to }, images, written_attributes, warnings);
     !written)
    return written;
  if(!options.view.empty()) { // shows images that are baked, so that it follows them
    const std::string failed = write_files(
      view_of_transfer(options.view, from, output, map->found, options.output, map_message(*map)));
    if(!failed.empty()) return { CANNOT_WRITE, failed, message(File_status::CANNOT_WRITE) };
  }
  auto& names = transferred.transferred;
  const auto is_missing = [&](const std::string& name) {
    return std::find(written_attributes.begin(), written_attributes.end(), name) == written_attributes.end();
  };
  names.erase(std::remove_if(names.begin(), names.end(), is_missing), names.end());
  const Mapped_parts& parts = map->parts;
  if(writes_json) {
    const bool has_shell = map->found.certification() != BS::Certification::NONE;
    Json json;
    json.add("from", options.input)
      .add("to", options.to)
      .add("output", options.output)
      .add("certification", name(map->found.certification()))
      .add("kind", has_shell ? name(map->found.kind()) : "none")
      .add("map", map_message(*map))
      .add("is_one_to_one", parts.is_one_to_one())
      .add("one_to_one_area", parts.share(Mapped::ONE_TO_ONE))
      .add("continued_area", parts.share(Mapped::CONTINUED))
      .add("nearest_area", parts.share(Mapped::NEAREST))
      .add("distance", distance)
      .add("thickness", map->thickness)
      .add("attributes", transferred.transferred)
      .add("replaced", transferred.replaced)
      .add("facets_across_seams", transferred.facets_across_seams)
      .add("images", images_of(options))
      .add("covered_texels", baked.covered)
      .add("overlapping_texels", baked.overlapping)
      .add("warnings", warnings)
      .add("seconds", time.seconds());
    report_stream(options.output) << json.text() << std::endl;
  } else print(options, *map, distance, unit, transferred, baked);
  return parts.share(Mapped::ONE_TO_ONE) > 0 ? DONE : NOT_CERTIFIED;
}

} // namespace Tool
