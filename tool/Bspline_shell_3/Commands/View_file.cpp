#include "View_file.h"
#include "Input.h"
#include "number.h"

#include "../Files/File_status.h"
#include "../Files/read_model.h"
#include "../View/page_of.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <utility>

namespace Tool {

namespace {

const std::string extension = ".html";

std::string failure_file(const std::string& file)
{
  return file.substr(0, file.size() - extension.size()) + "_failed" + extension;
}

std::string name_of(const std::string& file)
{
  return file == stream_name ? "bspline_shell" : std::filesystem::path(file).filename().string();
}

std::string title_of(const std::string& what, const Model& model)
{
  return what + ": " + std::to_string(model.soup.polygons.size()) + " polygons";
}

Page::Lines shell_lines(const Model& model, const BS::Shell_of_soup_3& found)
{
  const double thickness = found.shell().thickness();
  return { { "Shell", with_options(found.message()) },
           { "Thickness", number(thickness) + " (" + percent(thickness / longest_side(model)) + " of the box)" } };
}

Contents success(const std::string& file, const View& view)
{
  constexpr std::size_t large = 100'000'000; // bytes; some browsers take minutes to open larger pages, or do not
  std::string page = page_of(view);
  if(page.size() > large)
    std::cerr << file << ": The page has " << page.size() / 1'000'000
              << " MB. Browsers open it slowly or not at all; pages of simplified meshes are smaller.\n";
  return { { file, std::move(page) }, { failure_file(file), std::nullopt } };
}

// Returns the center of a facet or, if there is no mesh, of a polygon of the model.
std::array<double, 3> center(const Mesh& mesh, const Model& model, std::size_t facet)
{
  std::vector<Mesh::Point> corners;
  if(mesh.number_of_faces() > 0)
    for(auto v : mesh.vertices_around_face(mesh.halfedge(Mesh::Face_index(Mesh::size_type(facet)))))
      corners.push_back(mesh.point(v));
  else
    for(std::size_t v : model.soup.polygons[facet]) corners.push_back(model.soup.points[v]);
  std::array<double, 3> sum = {};
  for(const auto& p : corners)
    for(int i = 0; i < 3; ++i) sum[std::size_t(i)] += p[i] / double(corners.size());
  return sum;
}

// Returns the obstacles to the proof or, if there is no shell, the facets and vertices with defects.
std::vector<View::Place> places_of(const Model& model, const BS::Shell_of_soup_3& found)
{
  std::vector<View::Place> places;
  const auto& report = found.shell().report();
  for(const BS::Refinement_obstacle& o : report.obstacles)
    places.push_back({ o.point, message(o, report.unit, report.refinement) });
  if(found.shell()) return places;
  const Mesh& mesh = found.own_mesh();
  for(std::size_t f : found.offending_simplices.facets)
    places.push_back({ center(mesh, model, f), "Facet " + std::to_string(f) });
  for(std::size_t v : found.offending_simplices.vertices) {
    const auto& p = mesh.number_of_vertices() > 0 ? mesh.point(Mesh::Vertex_index(Mesh::size_type(v)))
                                                  : model.soup.points[v];
    places.push_back({ { p.x(), p.y(), p.z() }, "Vertex " + std::to_string(v) });
  }
  return places;
}

} // namespace

Outcome check_view(const std::string& file)
{
  if(!has_page_scripts())
    return { CANNOT_WRITE, file,
             "This program was built without three.js and makes no pages: install libjs-three, and build it again." };
  if(extension_of(file) != extension) return { WRONG_USAGE, file, "Pages are HTML files: use the extension .html." };
  for(const std::string& page : { file, failure_file(file) })
    if(!is_writable(page)) return { CANNOT_WRITE, page, message(File_status::CANNOT_WRITE) };
  return DONE;
}

Contents view_of_edit(const std::string& file, const Model& model, const Model& result,
                      const BS::Shell_of_soup_3& found, const Edit_summary& summary)
{
  View view;
  view.title = name_of(summary.output);
  view.sides = { { title_of("Input", model), &model }, { title_of("Result", result), &result } };
  view.shell = &found.shell();
  const double distance = summary.distances.largest();
  view.report = { { "Facets", std::to_string(summary.facets) + " of " + std::to_string(summary.facets_before) },
                  { "Distance", "at most " + number(distance) + " (" + percent(distance / longest_side(model))
                                  + " of the box) between any point of one surface and the other, proved" },
                  { "Map", std::string("one-to-one") + (found.proxy ? " from the proxy" : "") + ", "
                             + name(found.certification()) } };
  for(auto& line : shell_lines(model, found)) view.report.push_back(std::move(line));
  view.report.emplace_back("Limit", summary.limit);
  return success(file, view);
}

Contents view_of_shell(const std::string& file, const Model& model, const BS::Shell_of_soup_3& found,
                       const std::string& input)
{
  View view;
  view.title = name_of(input);
  view.sides = { { title_of("Input", model), &model } };
  view.shell = &found.shell();
  view.report = shell_lines(model, found);
  return success(file, view);
}

Contents view_of_transfer(const std::string& file, const Model& from, const Model& result,
                          const BS::Shell_of_soup_3& found, const std::string& output, const std::string& map_message)
{
  View view;
  view.title = name_of(output);
  view.sides = { { title_of("From", from), &from }, { title_of("Result", result), &result } };
  view.report = { { "Map", map_message } };
  if(found.certification() != BS::Certification::NONE) {
    view.shell = &found.shell();
    for(auto& line : shell_lines(from, found)) view.report.push_back(std::move(line));
  }
  return success(file, view);
}

Outcome write_failure_view(const Outcome& outcome, const std::string& file, const Model& model,
                           const BS::Shell_of_soup_3& found)
{
  if(model.soup.polygons.empty()) return outcome;
  View view;
  view.title = name_of(outcome.file) + ": the shell is not certified";
  view.sides = { { title_of("Input", model), &model } };
  if(found.shell()) view.shell = &found.shell();
  view.report = { { "Reason", outcome.message } };
  view.places = places_of(model, found);
  view.places_title = found.shell() ? "places where the proof fails" : "facets and vertices with defects";
  const std::string page = failure_file(file), failed = write_files({ { page, page_of(view) } });
  Outcome result = outcome;
  result.message += failed.empty() ? " The page " + page + " shows the mesh"
                                       + (view.places.empty() ? "" : " and " + view.places_title) + "."
                                   : " The page " + failed + " cannot be written.";
  return result;
}

} // namespace Tool
