#include "Input.h"
#include "Json.h"
#include "Result_files.h"
#include "verbs.h"

#include "../Carry/carry_attributes.h"
#include "../Files/File_status.h"
#include "../Files/write_model.h"

#include <CGAL/Bspline_shell_3/Soup/provenance.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

namespace Tool {

namespace {

std::string number(double x)
{
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g", x);
  return buffer;
}

// Returns which limit ended the simplification, and which one would allow fewer facets.
std::string message_of_limit(const Simplified& result)
{
  switch(result.limit) {
    case Limit::FACETS: return "The requested number of facets ended the simplification.";
    case Limit::TOLERANCE: return "The tolerance ended the simplification: a larger --tolerance allows fewer facets.";
    case Limit::TIME: return "The time limit ended the simplification: a larger --time-limit allows fewer facets.";
    case Limit::SHELL:
      return "The shell ended the simplification: a larger --thickness than " + number(result.thickness)
             + " may allow fewer facets.";
    case Limit::LINES:
      return "Seams, borders of labels, or excised triangles ended the simplification; --facets gives up seams and "
             "borders of labels if this reaches the number.";
    case Limit::MESH: return "No edge is left that can be collapsed without changing the topology or a border.";
  }
  return "";
}

Json changes(const Model& model, const BS::Shell_of_soup_3& found)
{
  std::vector<std::size_t> number(std::size_t(BS::Polygon_change::WRAPPED) + 1, 0);
  for(BS::Polygon_change change : BS::provenance(model.soup, found)) ++number[std::size_t(change)];
  Json json;
  for(std::size_t c = 0; c < number.size(); ++c)
    if(number[c] > 0) json.add(name(BS::Polygon_change(c)), number[c]);
  return json;
}

struct Summary
{
  std::vector<std::string> attributes, warnings;
  Carry_report carried;
  bool reaches_target;
  double longest_side, seconds;
};

void print_json(const Simplify_options& options, const Model& model, const Simplified& result, const Summary& summary)
{
  const BS::Shell_of_soup_3& found = *result.found;
  Json json;
  json.add("input", options.input)
    .add("output", options.output)
    .add("certification", name(found.certification()))
    .add("kind", name(found.kind()))
    .add("facets_before", result.facets_before)
    .add("facets", result.facets)
    .add("reaches_target", summary.reaches_target)
    .add("distance_to_result", result.distances.to_second)
    .add("distance_to_input", result.distances.to_first)
    .add("thickness", result.thickness)
    .add("limit", message_of_limit(result))
    .add("polygons", changes(model, found))
    .add("attributes", summary.attributes)
    .add("warnings", summary.warnings)
    .add("edges_on_lines", result.lines)
    .add("keeps_lines", result.keeps_lines)
    .add("is_rounded", result.is_rounded)
    .add("removed_border_edges", result.removed_border_edges)
    .add("facets_across_seams", summary.carried.facets_across_seams)
    .add("points_without_image", summary.carried.points_without_image)
    .add("seconds", summary.seconds);
  std::cout << json.text() << std::endl;
}

void print(const Simplify_options& options, const Model& model, const Simplified& result, const Summary& summary)
{
  const BS::Shell_of_soup_3& found = *result.found;
  const double distance = result.distances.largest();
  const std::size_t polygons = model.soup.polygons.size();
  std::cout << "facets      " << result.facets << " of " << result.facets_before
            << (polygons == result.facets_before
                  ? ""
                  : " triangles, into which the " + std::to_string(polygons) + " polygons of the file are split")
            << (summary.reaches_target ? "" : ": the requested number is not reached") << "\n"
            << "distance    at most " << number(distance) << " between any point of one surface and the other ("
            << number(100 * distance / summary.longest_side) << " % of the box)\n"
            << "map         one-to-one" << (found.proxy ? " from the proxy" : "")
            << (result.removed_border_edges > 0 ? ", except for strips along the border" : "") << ", "
            << name(found.certification()) << "; " << name(found.kind()) << "\n";
  const std::string welding = message(found.weld);
  if(!welding.empty()) std::cout << "welding     " << with_options(welding) << "\n";
  if(found.excised) std::cout << "excised     " << with_options(found.excision_message()) << "\n";
  if(found.proxy) std::cout << "proxy       " << with_options(found.mesh_message()) << "\n";
  if(!summary.attributes.empty()) {
    std::cout << "attributes ";
    for(const std::string& name : summary.attributes) std::cout << " " << name;
    std::cout << "\n";
  }
  if(summary.carried.facets_across_seams > 0)
    std::cout << "seams       " << summary.carried.facets_across_seams << " facets lie across a seam\n";
  if(summary.carried.points_without_image > 0)
    std::cout << "            " << summary.carried.points_without_image
              << " points have the values of the nearest points\n";
  if(!result.keeps_lines) std::cout << "lines       were not kept, because the requested number of facets needs them\n";
  if(result.removed_border_edges > 0)
    std::cout << "border      has " << result.removed_border_edges << " edges fewer\n";
  if(!result.is_rounded && has_single_precision(options.output))
    std::cout << "coordinates are rounded to float in the file, for which nothing is proved: use another format\n";
  else if(!result.is_rounded && model.coordinates == Number_type::FLOAT32)
    std::cout << "coordinates are of type double, because rounding to float would invalidate the proof\n";
  std::cout << "limit       " << message_of_limit(result) << std::endl;
}

} // namespace

Outcome simplify(const Simplify_options& options, bool writes_json)
{
  if(!is_supported(options.output)) return { WRONG_USAGE, options.output, message(File_status::UNSUPPORTED) };
  if(is_same_file(options.input, options.output))
    return { WRONG_USAGE, options.output, "The result would replace the input: choose another name." };
  Model model;
  if(const Outcome read = read_input(options.input, model); !read) return read;
  if(!is_writable(options.output)) return { CANNOT_WRITE, options.output, message(File_status::CANNOT_WRITE) };

  const Time_limit time(options.seconds);
  Progress progress;
  Simplified result;
  if(const Outcome simplified = simplify_model(model, options, time, progress, result); !simplified) return simplified;
  const BS::Shell_of_soup_3& found = *result.found;
  Summary summary;
  summary.longest_side = longest_side(model);
  const double tolerance = options.tolerance ? options.tolerance->in_box(summary.longest_side) : 0;
  if(options.tolerance && result.distances.largest() > tolerance)
    return { NOT_CERTIFIED, options.input,
             "The tolerance is not kept: the distance is at most " + number(result.distances.largest()) + ". "
               + (found.proxy ? "The polygons are not a mesh, so that a proxy around them was simplified. "
                                  + with_options(found.mesh_message())
                              : std::string("Use a larger --tolerance.")) };

  Model output = carry_attributes(model, found, result.mesh, result.closing, result.rejoined,
                                  options.carries_normals ? Normals::CARRIED : Normals::RECOMPUTED, summary.carried,
                                  [&](double fraction) { progress.show("attributes", fraction); });
  progress.clear();
  const Written_files written = write_model(output, options.output);
  for(const auto& file : written.files)
    if(std::any_of(model.files.begin(), model.files.end(),
                   [&](const std::string& input) { return is_same_file(file.first, input); }))
      return { WRONG_USAGE, file.first, "The result would replace a part of the input: choose another name." };
  const std::string failed = write_files(written.files);
  if(!failed.empty()) return { CANNOT_WRITE, failed, message(File_status::CANNOT_WRITE) };

  for(const std::string& warning : written.warnings) std::cerr << options.output << ": " << warning << "\n";
  summary.warnings = written.warnings;
  summary.attributes = written.attributes;
  summary.reaches_target = (options.facets == 0 && options.ratio == 0) || result.limit == Limit::FACETS;
  summary.seconds = time.seconds();
  if(writes_json) print_json(options, model, result, summary);
  else print(options, model, result, summary);
  return DONE;
}

} // namespace Tool
