// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_POLICIES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_POLICIES_H

#include <CGAL/Bspline_shell_3/Certificate/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Editing/Collapse_visitor.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_termination.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Any_collapse_policies.h>
#include <CGAL/Bspline_shell_3/Editing/internal/move_to_level.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// State shared by the stop predicate, visitor, placement, and filter. For each edge, a run calls OnSelected() and then,
// if the edge satisfies the link condition, the placement and the filter once each, before it selects another edge.
struct Collapse_state
{
  bool is_waiting = false; // whether the selected edge has no placement yet
  bool is_accepted = false;
  bool has_stopped = false;
  bool has_deferred = false;                          // whether a placement cost too much in this run
  Edit_termination obstacle = Edit_termination::MESH; // reason why the selected edge has no placement
  double cost = 0;                                    // cost of the selected edge
  double largest_cost = 0;                            // largest cost of a collapsed edge
  double allowance = 1; // factor by which other placements may cost more than the policy's
  std::size_t initial_edges = 0;
  std::size_t closing_facets = 0;
  std::size_t collapsed = 0, retried = 0;

  // Returns the number of edges for stop predicates and visitors: 3/2 of the number of facets of the mesh, without the
  // facets that close it.
  std::size_t edges_without_closing(std::size_t edges) const
  {
    return closing_facets == 0 ? edges : 3 * (2 * edges / 3 - closing_facets) / 2;
  }
};

// Presents several runs to the base visitor as one. Marks the selected edge after calling the base visitor, and updates
// constraints before the base visitor receives a collapsed edge.
template <typename Profile, typename Rules>
class Selecting_visitor : public Collapse_visitor<typename Profile::Triangle_mesh, Any_collapse_visitor<Profile> >
{
  typedef typename Profile::Triangle_mesh TriangleMesh;
  typedef Collapse_visitor<TriangleMesh, Any_collapse_visitor<Profile> > Base;
public:
  Selecting_visitor(Any_collapse_visitor<Profile>& visitor, TriangleMesh& mesh, Rules& rules, Collapse_state& state)
    : Base(visitor), m_mesh(&mesh), m_rules(&rules), m_state(&state),
      m_obstacle(get(dynamic_edge_property_t<Edit_termination>(), mesh))
  {}

  // Returns the reason why none of the remaining edges was collapsed. The shell takes precedence over the filter.
  Edit_termination end() const
  {
    if(m_state->has_stopped) return Edit_termination::STOP_PREDICATE;
    Edit_termination end = Edit_termination::MESH;
    for(auto e : edges(*m_mesh)) {
      const Edit_termination obstacle = get(m_obstacle, e);
      if(obstacle == Edit_termination::SHELL) return obstacle;
      if(obstacle == Edit_termination::FILTER) end = obstacle;
    }
    return end;
  }

  void start() { Base::OnStarted(*m_mesh); }
  void finish() { Base::OnFinished(*m_mesh); }
  void OnStarted(TriangleMesh&) {}
  void OnFinished(TriangleMesh&) {}
  void OnCollected(const Profile& profile, const Optional<typename Profile::FT>& cost)
  {
    Run::poll();
    Base::OnCollected(profile, cost);
  }
  void OnSelected(const Profile& profile, const Optional<typename Profile::FT>& cost, std::size_t, std::size_t current)
  {
    Base::OnSelected(profile, cost, m_state->initial_edges, m_state->edges_without_closing(current));
    m_state->is_waiting = true;
    m_state->obstacle = Edit_termination::MESH; // unless a placement is rejected
    m_state->cost = cost ? rounded(*cost) : 0;
  }
  void OnCollapsing(const Profile& profile, const Optional<typename Profile::Point>& placement)
  {
    Base::OnCollapsing(profile, placement);
    m_state->largest_cost = (std::max)(m_state->largest_cost, m_state->cost);
    ++m_state->collapsed;
    m_rules->before_collapse(profile, placement);
  }
  void OnCollapsed(const Profile& profile, typename Profile::vertex_descriptor v)
  {
    m_rules->after_collapse(profile, v);
    m_state->closing_facets = m_rules->number_of_closing_facets();
    Base::OnCollapsed(profile, v);
  }
  void OnNonCollapsable(const Profile& profile)
  {
    Base::OnNonCollapsable(profile);
    put(m_obstacle, edge(profile.v0_v1(), *m_mesh), m_state->obstacle);
  }

private:
  TriangleMesh* m_mesh;
  Rules* m_rules;
  Collapse_state* m_state;
  // reason why an edge was rejected the last time
  typename boost::property_map<TriangleMesh, dynamic_edge_property_t<Edit_termination> >::type m_obstacle;
};

// Calls the caller's predicate with the number of edges before and during the whole edit, which may take several runs.
template <typename Profile>
struct Continued_stop_predicate
{
  const Collapse_stop_predicate<Profile>* stop;
  Collapse_state* state;

  bool operator()(const typename Profile::FT& cost, const Profile& profile, std::size_t, std::size_t edges) const
  {
    Run::poll();
    state->has_stopped = (*stop)(cost, profile, state->initial_edges, state->edges_without_closing(edges));
    return state->has_stopped;
  }
};

// The costs of a policy, which are initialized only with the original mesh.
template <typename Profile>
struct Continued_cost
{
  typedef Tag_true Update_tag;

  const Any_collapse_policy<Profile>* policy;
  const Collapse_state* state;

  Optional<typename Profile::FT> operator()(const Profile& profile,
                                            const Optional<typename Profile::Point>& placement) const
  {
    return policy->cost(profile, placement);
  }
  void initialize(const typename Profile::Triangle_mesh& mesh, const typename Profile::Vertex_point_map& vpm,
                  const typename Profile::Geom_traits& traits) const
  {
    if(state->collapsed == 0) policy->initialize(mesh, vpm, traits);
  }
  void update_after_collapse(const Profile& profile, typename Profile::vertex_descriptor v) const
  {
    policy->update_after_collapse(profile, v);
  }
};

// A quadric error, plus a tiny fraction of the squared length of the edge. Within a plane, the errors of all edges are
// equal up to rounding. Without this term, collapses concentrate at a few vertices, whose degrees grow without bound.
// Far from the origin, rounding errors may exceed the term.
template <typename GetCost>
class Cost_with_length
{
public:
  typedef Tag_true Update_tag;

  explicit Cost_with_length(const GetCost& cost) : m_cost(cost) {}

  template <typename Profile, typename OptionalPoint>
  Optional<typename Profile::FT> operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    constexpr double weight = 1e-10; // equals a distance of 1e-5 edge lengths from a plane
    const Optional<typename Profile::FT> cost = m_cost(profile, placement);
    if(!cost) return cost;
    return *cost + weight * CGAL::squared_distance(profile.p0(), profile.p1());
  }
  template <typename TriangleMesh, typename VertexPointMap, typename GeomTraits>
  void initialize(const TriangleMesh& mesh, const VertexPointMap& vpm, const GeomTraits& traits) const
  {
    m_cost.initialize(mesh, vpm, traits);
  }
  template <typename Profile, typename Vertex>
  void update_after_collapse(const Profile& profile, const Vertex& v) const
  {
    m_cost.update_after_collapse(profile, v);
  }

private:
  const GetCost& m_cost;
};

// For an edge that only needs a cost, returns the policy's placement. For the selected edge, returns the cheapest of
// several placements that passes the filter, or the policy's placement if there is none or it is too expensive. If the
// rules allow only some positions, these replace the policy's placement; if they allow none, no placement is accepted.
template <typename Profile, typename Filter, typename Field, typename Rules>
class Retrying_placement
{
  typedef typename Profile::Point Point;
  typedef Optional<Point> Place;

public:
  Retrying_placement(const Any_collapse_policy<Profile>& policy, const Filter& filter, const Field& field,
                     const Rules& rules, Collapse_state& state)
    : m_policy(&policy), m_filter(&filter), m_field(&field), m_rules(&rules), m_state(&state)
  {}

  Place operator()(const Profile& profile) const
  {
    const auto allowed = m_rules->allowed_places(profile);
    Place placement;
    if(allowed.are_all) placement = snapped(profile, m_policy->placement(profile));
    else if(!allowed.places.empty()) placement = cheapest(profile, allowed.places);
    else placement = profile.p0();
    if(!m_state->is_waiting) return placement;
    m_state->is_waiting = false;

    const Placement_statistics before = m_filter->statistics();
    const bool is_allowed = allowed.are_all || !allowed.places.empty();
    m_state->is_accepted = is_allowed && bool(placement) && bool((*m_filter)(profile, placement));
    if(m_state->is_accepted || !is_allowed) return placement;
    const double due = m_state->allowance * (std::max)(m_state->largest_cost, m_state->cost);
    boost::container::static_vector<std::pair<double, Point>, 5> others;
    const auto add = [&](const Point& p) {
      const auto cost = m_policy->cost(profile, Place(p));
      if(!cost) return;
      if(rounded(*cost) <= due) others.emplace_back(rounded(*cost), p);
      else m_state->has_deferred = true;
    };
    if(allowed.are_all) {
      const Point middle = CGAL::midpoint(profile.p0(), profile.p1());
      for(const Point& p : { profile.p0(), profile.p1(), middle }) add(p);
      const auto at = [](const Point& p) { return converted<typename Field::Point_3>(p); };
      for(const Place& from : { placement, Place(middle) })
        if(from)
          if(const auto moved = move_to_mean_level(*m_field, at(*from), at(profile.p0()), at(profile.p1())))
            add(converted<Point>(*moved));
    } else {
      for(const Point& p : allowed.places)
        if(p != *placement) add(p);
    }
    std::stable_sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for(const auto& other : others)
      if((*m_filter)(profile, Place(other.second))) {
        m_state->is_accepted = true;
        m_state->cost = other.first;
        ++m_state->retried;
        return other.second;
      }
    const Placement_statistics& now = m_filter->statistics();
    constexpr Placement_verdict filter = Placement_verdict::BASE_FILTER;
    const std::size_t by_filter = now.number(filter) - before.number(filter);
    const std::size_t rejected = now.rejected() - before.rejected();
    if(rejected > 0) m_state->obstacle = rejected > by_filter ? Edit_termination::SHELL : Edit_termination::FILTER;
    return placement;
  }

private:
  // Returns an end of the edge if the placement differs from it only by the rounding of the policy's linear system. A
  // vertex that does not move thus keeps its coordinates.
  static Place snapped(const Profile& profile, const Place& placement)
  {
    constexpr double rounding = 1e-8; // relative to the length of the edge
    if(!placement) return placement;
    const auto near = rounding * rounding * CGAL::squared_distance(profile.p0(), profile.p1());
    for(const Point& p : { profile.p0(), profile.p1() })
      if(CGAL::squared_distance(*placement, p) <= near) return p;
    return placement;
  }

  Place cheapest(const Profile& profile, const std::vector<Point>& places) const
  {
    Place best;
    double least = 0;
    for(const Point& p : places) {
      const auto cost = m_policy->cost(profile, Place(p));
      const double value = cost ? rounded(*cost) : std::numeric_limits<double>::infinity();
      if(best && !(value < least)) continue;
      best = p;
      least = value;
    }
    return best;
  }

  const Any_collapse_policy<Profile>* m_policy;
  const Filter* m_filter;
  const Field* m_field;
  const Rules* m_rules;
  Collapse_state* m_state;
};

// Passes the placements that Retrying_placement accepted.
struct Accepted_filter
{
  const Collapse_state* state;

  template <typename Profile, typename OptionalPoint>
  OptionalPoint operator()(const Profile&, const OptionalPoint& placement) const
  {
    return state->is_accepted ? placement : OptionalPoint();
  }
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_POLICIES_H
