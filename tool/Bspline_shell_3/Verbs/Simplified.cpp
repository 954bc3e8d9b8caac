#include "Simplified.h"
#include "Pin_filter.h"

#include "../Carry/Corner_groups.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/Line_filter.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Real_timer.h>
#include <CGAL/certified_shell_of_soup_3.h>

#include <algorithm>
#include <functional>

namespace Tool {

namespace {

typedef BS::Shell_certificate_3<Shell::Field, Shell::Threshold> Certificate;
typedef Mesh::Property_map<Mesh::Edge_index, bool> Edge_marks;

// Marks the lines of a mesh, and returns their number of edges.
std::size_t mark_lines(const std::vector<char>& lines, Mesh& mesh, Edge_marks marks)
{
  std::size_t number = 0;
  for(auto e : mesh.edges())
    if(lines[e]) {
      marks[e] = true;
      ++number;
    }
  return number;
}

// Simplifies a mesh without moving the pins of excised triangles.
BS::Simplification_result<Mesh> simplify_mesh(Mesh& mesh, Edge_marks lines, bool has_lines, std::size_t facets,
                                              const Simplify_target& target, double seconds,
                                              const BS::Shell_of_soup_3& found)
{
  constexpr double least_seconds = 1e-3; // time limits must be positive
  const BS::Facet_count_stop_predicate stop(facets);
  const auto np = BS::parameters::stop(stop).time_limit((std::max)(seconds, least_seconds));
  if(!has_lines && !found.excised) return BS::simplify_in_shell(mesh, found.shell(), np);
  const BS::Line_filter filter(mesh, lines, target.thickness, Pin_filter(found.excised.get()));
  return BS::simplify_in_shell(mesh, found.shell(),
                               np.filter(std::cref(filter)).edge_is_constrained_map(lines).protect_constraints(false));
}

// Rounds coordinates to floats if the mesh remains certified, and returns whether it does.
bool round_coordinates(Mesh& mesh, const Shell& shell)
{
  Mesh rounded = mesh;
  for(auto v : rounded.vertices()) {
    const auto& p = mesh.point(v);
    rounded.point(v) = Mesh::Point(float(p.x()), float(p.y()), float(p.z()));
  }
  Certificate certificate(shell);
  if(!certificate.verify(rounded)) return false;
  mesh = std::move(rounded);
  return true;
}

} // namespace

void simplify_model(const Model& model, const Simplify_target& target, Progress& progress, Simplified& result)
{
  CGAL::Real_timer timer;
  timer.start();
  const auto fail = [&](Simplify_status status, const std::string& message) {
    result.status = status;
    result.message = message;
    progress.clear();
  };
  result.found = CGAL::certified_shell_of_soup_3(
    model.soup, BS::parameters::thickness(target.thickness).time_limit(target.seconds).visitor(std::ref(progress)));
  const BS::Shell_of_soup_3& found = result.found;
  if(!found) return fail(Simplify_status::NO_SHELL, found.message());
  if(found.certification() == BS::Certification::NONE) return fail(Simplify_status::NOT_CERTIFIED, found.message());

  result.mesh = found.mesh();
  const std::size_t excised = found.excised ? found.excised->excised_triangles().size() : 0;
  result.facets_before = found.mesh().number_of_faces() + excised;
  const std::size_t facets = target.facets == 0 ? 0 : target.facets <= excised ? 1 : target.facets - excised;
  auto lines = result.mesh.add_property_map<Mesh::Edge_index, bool>("e:is_line", false).first;
  std::vector<char> is_line;
  if(!found.proxy) is_line = find_lines(model, found.mesh(), Mesh_origins(model, found.mesh()));
  if(!found.proxy && !target.cuts_lines) result.lines = mark_lines(is_line, result.mesh, lines);
  progress.show("simplification", 0);
  auto simplified = simplify_mesh(result.mesh, lines, result.lines > 0, facets, target, target.seconds - timer.time(),
                                  found);
  if(simplified && result.lines > 0 && facets > 0 && simplified.facets > facets) {
    result.gave_up_lines = true;
    for(auto e : result.mesh.edges()) lines[e] = false;
    simplified = simplify_mesh(result.mesh, lines, false, facets, target, target.seconds - timer.time(), found);
  }
  if(!simplified) return fail(Simplify_status::NOT_SIMPLIFIED, simplified.message());
  result.end = simplified.end;
  result.mesh.collect_garbage();
  if(!found.proxy && target.cuts_lines) {
    result.cut = cut_lines(found.shell(), found.mesh(), is_line, result.mesh);
    result.lines = result.cut->cut.cut_edges;
  }
  result.is_rounded = target.rounds_coordinates && round_coordinates(result.mesh, found.shell());
  if(found.excised) {
    result.rejoined = BS::rejoin_excised(*found.excised, result.mesh);
    if(!result.rejoined) return fail(Simplify_status::NOT_SIMPLIFIED, message(result.rejoined.verdict.status));
  }
  result.facets = result.mesh.number_of_faces() + excised;
  progress.show("distances", 0);
  constexpr double resolution = 0.02; // relative to the thickness
  result.distances = distance_bounds(found.proxy ? found.proxy->soup().mesh() : found.mesh(), result.mesh,
                                     resolution * target.thickness);
  if(!found.weld.is_none()) {
    result.distances.to_first += found.weld.tolerance;
    result.distances.to_second += found.weld.tolerance;
  }
  result.status = Simplify_status::SUCCESS;
}

} // namespace Tool
