// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_COLLAPSE_VISITOR_H
#define CGAL_BSPLINE_SHELL_3_EDITING_COLLAPSE_VISITOR_H

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <memory>
#include <unordered_map>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief the history of a run of `CGAL::Surface_mesh_simplification::edge_collapse()`: numbers of edges, and for each
 * vertex of the original mesh the vertex of the result into which it was collapsed.
 *
 * \tparam TriangleMesh a model of `FaceListGraph`
 */
template <typename TriangleMesh>
class Collapse_history
{
public:
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;

  std::size_t selected = 0;        ///< edges that were considered; repetitions are counted
  std::size_t collapsed = 0;       ///< including edges of length zero
  std::size_t not_collapsable = 0; ///< edges that failed the link condition or the filter

  /// returns the vertex into which `v` was collapsed, or `v` itself if it still exists
  vertex_descriptor image(vertex_descriptor v) const
  {
    for(auto found = m_kept.find(v); found != m_kept.end(); found = m_kept.find(v)) v = found->second;
    return v;
  }

  /// records that `v` was collapsed into `kept`
  void collapse(vertex_descriptor v, vertex_descriptor kept)
  {
    ++collapsed;
    m_kept.emplace(v, kept);
  }

private:
  // Removed vertices are used only as keys.
  std::unordered_map<vertex_descriptor, vertex_descriptor> m_kept;
};

/// \ingroup PkgBsplineShell3Editing
/// \brief a visitor that does nothing, for any type of profile.
///
/// \cgalModels `EdgeCollapseSimplificationVisitor`
struct Default_collapse_visitor
{
  template <typename TriangleMesh>
  void OnStarted(TriangleMesh&)
  {}
  template <typename TriangleMesh>
  void OnFinished(TriangleMesh&)
  {}
  template <typename Profile>
  void OnStopConditionReached(const Profile&)
  {}
  template <typename Profile, typename OptionalCost>
  void OnCollected(const Profile&, const OptionalCost&)
  {}
  template <typename Profile, typename OptionalCost>
  void OnSelected(const Profile&, const OptionalCost&, std::size_t, std::size_t)
  {}
  template <typename Profile, typename OptionalPoint>
  void OnCollapsing(const Profile&, const OptionalPoint&)
  {}
  template <typename Profile, typename Vertex>
  void OnCollapsed(const Profile&, const Vertex&)
  {}
  template <typename Profile>
  void OnNonCollapsable(const Profile&)
  {}
};

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief a visitor for `CGAL::Surface_mesh_simplification::edge_collapse()` that records the history of the run, after
 * passing each call on to a base visitor.
 *
 * A visitor cannot stop a run, unlike a `StopPredicate`, which receives the initial and the current number of edges for
 * each edge that is considered. Copies share the history.
 *
 * \cgalModels `EdgeCollapseSimplificationVisitor`
 *
 * \tparam TriangleMesh a model of `FaceListGraph`
 * \tparam BaseVisitor a model of `EdgeCollapseSimplificationVisitor`
 */
template <typename TriangleMesh, typename BaseVisitor = Default_collapse_visitor>
class Collapse_visitor
{
public:
  typedef Collapse_history<TriangleMesh> History;

  /// constructs a visitor with its own base visitor
  Collapse_visitor() : m_own(std::make_shared<BaseVisitor>()), m_base(m_own.get()) {}
  /// \pre `base` outlives this object and its copies
  explicit Collapse_visitor(BaseVisitor& base) : m_base(&base) {}

  const History& history() const { return *m_history; }

  /// \name Calls
  /// These functions are called by \cgal.
  /// @{
  void OnStarted(TriangleMesh& mesh)
  {
    m_base->OnStarted(mesh);
    *m_history = History();
  }
  void OnFinished(TriangleMesh& mesh) { m_base->OnFinished(mesh); }
  template <typename Profile>
  void OnStopConditionReached(const Profile& profile)
  {
    m_base->OnStopConditionReached(profile);
  }
  template <typename Profile, typename OptionalCost>
  void OnCollected(const Profile& profile, const OptionalCost& cost)
  {
    m_base->OnCollected(profile, cost);
  }
  template <typename Profile, typename OptionalCost>
  void OnSelected(const Profile& profile, const OptionalCost& cost, std::size_t initial, std::size_t current)
  {
    m_base->OnSelected(profile, cost, initial, current);
    ++m_history->selected;
  }
  template <typename Profile, typename OptionalPoint>
  void OnCollapsing(const Profile& profile, const OptionalPoint& placement)
  {
    m_base->OnCollapsing(profile, placement);
  }
  template <typename Profile, typename Vertex>
  void OnCollapsed(const Profile& profile, const Vertex& v)
  {
    m_base->OnCollapsed(profile, v);
    m_history->collapse(v == profile.v0() ? profile.v1() : profile.v0(), v);
  }
  template <typename Profile>
  void OnNonCollapsable(const Profile& profile)
  {
    m_base->OnNonCollapsable(profile);
    ++m_history->not_collapsable;
  }
  /// @}

private:
  std::shared_ptr<BaseVisitor> m_own;
  BaseVisitor* m_base;
  std::shared_ptr<History> m_history = std::make_shared<History>();
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_COLLAPSE_VISITOR_H
