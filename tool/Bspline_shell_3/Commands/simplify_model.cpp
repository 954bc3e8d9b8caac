#include "simplify_model.h"
#include "Input.h"
#include "Result_model.h"
#include "Search_tuning.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace Tool {

namespace {

// Simplifies a mesh in a shell. Where the result is farther than the tolerance from the mesh, facets of the mesh are
// kept, and the simplification is repeated.
Simplified simplify_within_tolerance(const Model& model, const std::shared_ptr<const BS::Shell_of_soup_3>& found,
                                     Simplify_target target, const Time_limit& time, Progress& progress)
{
  for(int n = 0;; ++n) {
    Simplified result = simplify_in_shell(model, found, target, time, progress);
    const auto& beyond = result.distances.beyond_limit;
    if(!result || beyond.empty() || found->proxy || n == search_tuning.repetitions || result.limit == Limit::TIME
       || double(beyond.size()) > search_tuning.largest_kept_share * double(result.facets_before))
      return result;
    const Mesh& mesh = found->mesh();
    for(auto f : beyond)
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) target.pins.insert(mesh.point(v));
  }
}

class Search
{
public:
  Search(const Model& model, const Simplify_options& options, const Time_limit& time, Progress& progress)
    : m_model(model), m_options(options), m_time(time), m_progress(progress), m_side(longest_side(model))
  {
    m_target.facets = options.facets > 0 ? options.facets
                                         : std::size_t(std::ceil(options.ratio * double(triangles(model))));
    m_target.cuts_lines = options.cuts_lines;
    m_target.rounds_coordinates = rounds_coordinates(model, options.output);
    if(options.border) m_target.border_tolerance = options.border->in_box(m_side);
    m_target.surface_tolerance = tolerance_of(options, m_side);
  }

  Outcome operator()(Simplified& result)
  {
    Outcome failure;
    double thickness = first_thickness(m_options, m_side);
    for(int attempt = 0; attempt < search_tuning.attempts; ++attempt) {
      if(attempt > 0 && m_time.seconds() > search_tuning.last_attempt * m_time.limit()) break;
      const Outcome outcome = try_thickness(thickness);
      if(!outcome && attempt == 0) failure = outcome;
      const double next = next_thickness(outcome, thickness);
      if(next == thickness) break;
      thickness = next;
    }
    if(!m_best) {
      result.found = m_first;
      return failure;
    }
    if(misses_target(*m_best) && m_best->keeps_lines && m_best->lines > 0 && !m_options.cuts_lines) {
      m_target.keeps_lines = false;
      Simplified without_lines = simplify(m_best->found, m_best->thickness);
      if(keeps_tolerance(without_lines) && !misses_target(without_lines)) m_best = std::move(without_lines);
    }
    if(!keeps_tolerance(*m_best) && !m_best->found->proxy) {
      m_target.facets = m_best->facets_before;
      m_best = simplify(m_best->found, m_best->thickness);
      if(!*m_best) return { NOT_CERTIFIED, m_options.input, m_best->message };
      m_best->limit = Limit::TOLERANCE;
    }
    result = std::move(*m_best);
    const bool has_thickness_of_tolerance = m_options.tolerance && !m_options.thickness
                                            && result.thickness < search_tuning.thickest * m_side;
    if((result.limit == Limit::SHELL && has_thickness_of_tolerance)
       || (result.limit == Limit::LINES && result.pins > 0))
      result.limit = Limit::TOLERANCE;
    return DONE;
  }

private:
  static std::size_t triangles(const Model& model)
  {
    std::size_t number = 0;
    for(const auto& polygon : model.soup.polygons)
      number += polygon.size() - (std::min)(polygon.size(), std::size_t(2));
    return number;
  }

  bool keeps_tolerance(const Simplified& result) const
  {
    return result && result.distances.largest() <= m_target.surface_tolerance;
  }
  bool misses_target(const Simplified& result) const { return m_target.facets > 0 && result.limit != Limit::FACETS; }

  Simplified simplify(const std::shared_ptr<const BS::Shell_of_soup_3>& found, double thickness)
  {
    m_target.line_tolerance = thickness;
    Simplified result = simplify_within_tolerance(m_model, found, m_target, m_time, m_progress);
    result.thickness = thickness;
    return result;
  }

  Outcome try_thickness(double thickness)
  {
    const auto found = std::make_shared<BS::Shell_of_soup_3>();
    const Outcome outcome = find_shell(m_model, m_options, thickness, m_time.left(), m_progress, *found);
    if(!m_first) m_first = found;
    if(!outcome) return outcome;
    m_current = simplify(found, thickness);
    if(!m_current) return { NOT_CERTIFIED, m_options.input, m_current.message };
    if(!m_best || (keeps_tolerance(m_current) && (!keeps_tolerance(*m_best) || m_current.facets < m_best->facets)))
      m_best = m_current;
    return DONE;
  }

  // Returns the thickness of the next attempt, or the same one if no other attempt is useful.
  double next_thickness(const Outcome& outcome, double thickness) const
  {
    if(m_options.thickness || (outcome && m_current.found->proxy)) return thickness;
    const double thicker = (std::min)(search_tuning.thickening * thickness, search_tuning.thickest * m_side);
    if(!outcome) return outcome.code == NOT_CERTIFIED && m_options.tolerance && !m_best ? thicker : thickness;
    if(!m_options.tolerance) return misses_target(m_current) && m_current.limit == Limit::SHELL ? thicker : thickness;
    const double tolerance = m_target.surface_tolerance, distance = m_current.distances.largest();
    const double scaled = search_tuning.aim * tolerance / distance * thickness;
    if(!keeps_tolerance(m_current))
      return keeps_tolerance(*m_best) || scaled < search_tuning.thinnest * m_side ? thickness : scaled;
    return m_current.limit == Limit::SHELL && distance <= search_tuning.slack * tolerance ? (std::min)(scaled, thicker)
                                                                                          : thickness;
  }

  const Model& m_model;
  const Simplify_options& m_options;
  const Time_limit& m_time;
  Progress& m_progress;
  double m_side;
  Simplify_target m_target;
  std::shared_ptr<const BS::Shell_of_soup_3> m_first; // certified or not
  Simplified m_current;
  std::optional<Simplified> m_best; // the result with the fewest facets within the tolerance, or else the first one
};

} // namespace

Outcome simplify_model(const Model& model, const Simplify_options& options, const Time_limit& time, Progress& progress,
                       Simplified& result)
{
  return Search(model, options, time, progress)(result);
}

} // namespace Tool
