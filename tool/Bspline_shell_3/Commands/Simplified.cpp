#include "Simplified.h"
#include "Outcome.h"
#include "Pin_filter.h"
#include "finish_edit.h"

#include "../Carry/Corner_groups.h"

#include <CGAL/Bspline_shell_3/Editing/Line_filter.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <type_traits>

namespace Tool {

// Stops at a number of facets, or at a time.
class Timed_stop_predicate
{
public:
  Timed_stop_predicate(std::size_t facets, const Time_limit& time, bool& is_late)
    : m_facets(facets), m_time(&time), m_is_late(&is_late)
  {}

  template <typename FT, typename Profile>
  bool operator()(const FT& cost, const Profile& profile, std::size_t initial, std::size_t current) const
  {
    *m_is_late = m_time->ends_edits();
    return *m_is_late || m_facets(cost, profile, initial, current);
  }

private:
  BS::Facet_count_stop_predicate m_facets;
  const Time_limit* m_time;
  bool* m_is_late;
};

} // namespace Tool

// So a time limit that is not reached does not change the result.
template <>
struct CGAL::Bspline_shells::Is_repeatable_stop_predicate<Tool::Timed_stop_predicate> : std::true_type
{};

namespace Tool {

namespace {

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

BS::Simplification_result<Mesh> simplify_mesh(Mesh& mesh, Edge_marks lines, bool needs_filter, std::size_t facets,
                                              const BS::Shell_of_soup_3& found, const Simplify_target& target,
                                              const Time_limit& time, bool& is_late)
{
  const auto simplify = [&](const auto& stop) {
    const auto np = BS::parameters::stop(stop).border_tolerance(target.border_tolerance);
    if(!needs_filter) return BS::simplify_in_shell(mesh, found.shell(), np);
    const BS::Line_filter filter(mesh, lines, target.line_tolerance, Pin_filter(found.excised.get(), target.pins));
    return BS::simplify_in_shell(
      mesh, found.shell(), np.filter(std::cref(filter)).edge_is_constrained_map(lines).protect_constraints(false));
  };
  if(std::isfinite(time.limit())) return simplify(Timed_stop_predicate(facets, time, is_late));
  return simplify(BS::Facet_count_stop_predicate(facets));
}

Limit limit_of(BS::Edit_termination end, bool is_late)
{
  switch(end) {
    case BS::Edit_termination::STOP_PREDICATE: return is_late ? Limit::TIME : Limit::FACETS;
    case BS::Edit_termination::SHELL: return Limit::SHELL;
    case BS::Edit_termination::FILTER: return Limit::LINES;
    default: return Limit::MESH;
  }
}

} // namespace

Simplified simplify_in_shell(const Model& model, const std::shared_ptr<const BS::Shell_of_soup_3>& found,
                             const Simplify_target& target, const Time_limit& time, Progress& progress)
{
  Simplified result;
  result.found = found;
  result.mesh = found->mesh();
  const std::size_t excised = found->excised ? found->excised->excised_triangles().size() : 0;
  result.facets_before = found->mesh().number_of_faces() + excised;
  const std::size_t facets = target.facets == 0 ? 0 : target.facets <= excised ? 1 : target.facets - excised;
  auto lines = result.mesh.add_property_map<Mesh::Edge_index, bool>("e:is_line", false).first;
  std::vector<char> is_line;
  if(!found->proxy) is_line = find_lines(model, found->mesh(), Mesh_origins(model, found->mesh()));
  const bool cuts_lines = target.cuts_lines && !found->proxy;
  if(!found->proxy && !cuts_lines) result.lines = mark_lines(is_line, result.mesh, lines);
  result.keeps_lines = target.keeps_lines || result.lines == 0;
  if(!result.keeps_lines)
    for(auto e : result.mesh.edges()) lines[e] = false;

  result.pins = target.pins.size();
  progress.show("simplification", 0);
  bool is_late = false;
  const bool needs_filter = (result.keeps_lines && result.lines > 0) || found->excised || !target.pins.empty();
  const auto simplified = simplify_mesh(result.mesh, lines, needs_filter, facets, *found, target, time, is_late);
  if(!simplified) {
    result.message = with_options(simplified.message());
    return result;
  }
  result.limit = limit_of(simplified.end, is_late);
  result.closing = simplified.closing;
  result.removed_border_edges = simplified.removed_border_edges;
  result.mesh.collect_garbage();
  if(cuts_lines) {
    result.cut = cut_lines(*found, is_line, result.mesh, result.closing);
    result.lines = result.cut->cut.cut_edges;
  }
  result.is_rounded = target.rounds_coordinates && round_coordinates(result.mesh, found->shell(), result.closing);
  if(found->excised) {
    result.rejoined = BS::rejoin_excised(*found->excised, result.mesh);
    if(!result.rejoined) {
      result.message = with_options(message(result.rejoined.verdict.status));
      return result;
    }
  }
  result.facets = result.mesh.number_of_faces() + excised;

  progress.show("distances", 0);
  result.distances = distances_of_edit(*found, result.mesh, target.surface_tolerance);
  progress.clear();
  return result;
}

} // namespace Tool
