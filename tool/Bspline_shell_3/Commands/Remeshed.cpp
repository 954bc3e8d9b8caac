#include "Remeshed.h"
#include "Outcome.h"
#include "finish_edit.h"

#include "../Carry/Corner_groups.h"

#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Soup/Excision_filter.h>

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <functional>
#include <limits>
#include <optional>

namespace Tool {

namespace {

// Shows the progress, and ends the edit in time for the proofs.
class Remeshing_visitor : public BS::Default_remeshing_visitor
{
public:
  Remeshing_visitor(const Time_limit& time, Progress& progress) : m_time(time), m_progress(progress) {}

  bool start_iteration(unsigned int iteration)
  {
    constexpr double iterations = 3; // default of `remesh_in_shell()`
    m_progress.show("remeshing", iteration / iterations);
    return go_on();
  }
  bool go_on() { return !m_time.ends_edits(); }

private:
  const Time_limit& m_time;
  Progress& m_progress;
};

void measure_edges(const Mesh& mesh, double target, Remeshed& result)
{
  std::size_t near = 0;
  for(auto e : mesh.edges()) {
    const double length = CGAL::Polygon_mesh_processing::edge_length(mesh.halfedge(e), mesh);
    result.mean_edge += length / double(mesh.number_of_edges());
    near += 4. / 5 * target <= length && length <= 4. / 3 * target;
  }
  result.share_near_target = double(near) / double(mesh.number_of_edges());
}

} // namespace

Remeshed remesh_in_shell(const Model& model, const std::shared_ptr<const BS::Shell_of_soup_3>& shell,
                         const Remesh_target& target, const Time_limit& time, Progress& progress)
{
  const BS::Shell_of_soup_3& found = *shell;
  Remeshed result;
  result.found = shell;
  result.thickness = target.thickness;
  const auto fail = [&](const std::string& message) {
    result.message = with_options(message);
    progress.clear();
    return result;
  };
  Mesh& mesh = result.mesh;
  mesh = found.mesh();
  const std::size_t excised = found.excised ? found.excised->excised_triangles().size() : 0;
  result.facets_before = mesh.number_of_faces() + excised;
  auto is_line = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_line", false).first;
  auto is_pin = mesh.add_property_map<Mesh::Vertex_index, bool>("v:is_pin", false).first;
  CGAL::Polygon_mesh_processing::detect_sharp_edges(mesh, target.feature, is_line);
  for(auto e : mesh.edges()) {
    is_line[e] = is_line[e] && !mesh.is_border(e);
    result.features += is_line[e];
  }
  if(!found.proxy) {
    const std::vector<char> lines = find_lines(model, mesh, Mesh_origins(model, mesh));
    for(auto e : mesh.edges()) {
      result.lines += lines[e] != 0;
      is_line[e] = is_line[e] || lines[e];
    }
  }
  std::optional<BS::Excision_filter> excision;
  if(found.excised) {
    // Excised triangles touch the mesh at pins, which must remain.
    result.protects_lines = !found.excised->pinned_edges().empty();
    for(auto e : found.excised->pinned_edges()) is_line[e] = true;
    for(auto v : found.excised->pinned_vertices()) is_pin[v] = true;
    excision.emplace(*found.excised, BS::New_contacts::REJECTED);
  }
  const auto filter = [&](const Mesh::Point& p, const Mesh::Point& q, const Mesh::Point& r) {
    return !excision || (*excision)(p, q, r);
  };

  Remeshing_visitor visitor(time, progress);
  const auto report = BS::remesh_in_shell(mesh, target.edge, found.shell(),
                                          BS::parameters::edge_is_constrained_map(is_line)
                                            .vertex_is_constrained_map(is_pin)
                                            .protect_constraints(result.protects_lines)
                                            .filter(filter)
                                            .visitor(std::ref(visitor)));
  if(!report) return fail(report.message());
  result.end = report.end;
  result.closing = report.closing;
  mesh.collect_garbage();
  result.is_rounded = target.rounds_coordinates && round_coordinates(mesh, found.shell(), result.closing);
  if(found.excised) {
    result.rejoined = BS::rejoin_excised(*found.excised, mesh);
    if(!result.rejoined) return fail(message(result.rejoined.verdict.status));
  }
  result.facets = mesh.number_of_faces() + excised;
  measure_edges(mesh, target.edge, result);
  progress.show("distances", 0);
  result.distances = distances_of_edit(found, mesh, target.tolerance);
  progress.clear();
  return result;
}

} // namespace Tool
