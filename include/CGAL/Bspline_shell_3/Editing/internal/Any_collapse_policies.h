// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_ANY_COLLAPSE_POLICIES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_ANY_COLLAPSE_POLICIES_H

#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <functional>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Interfaces to the caller's policies for edge collapses, so that collapses are compiled once for each mesh type.

// a model of `GetCost`, and a model of `GetPlacement`
template <typename Profile>
class Any_collapse_policy
{
public:
  typedef Optional<typename Profile::FT> Cost;
  typedef Optional<typename Profile::Point> Place;

  virtual ~Any_collapse_policy() = default;
  virtual Cost cost(const Profile& profile, const Place& place) const = 0;
  virtual Place placement(const Profile& profile) const = 0;
  virtual void initialize(const typename Profile::Triangle_mesh& mesh, const typename Profile::Vertex_point_map& vpm,
                          const typename Profile::Geom_traits& traits) const = 0;
  virtual void update_after_collapse(const Profile& profile, typename Profile::vertex_descriptor v) const = 0;
};

template <typename Cost, typename = void>
struct Requires_updates : Tag_false
{};
template <typename Cost>
struct Requires_updates<Cost, std::void_t<typename Cost::Update_tag> > : Boolean_tag<Cost::Update_tag::value>
{};

// pre: the cost and the placement outlive this object
template <typename Profile, typename GetCost, typename GetPlacement>
class Collapse_policy_of final : public Any_collapse_policy<Profile>
{
  typedef Any_collapse_policy<Profile> Base;

public:
  Collapse_policy_of(const GetCost& cost, const GetPlacement& placement) : m_cost(cost), m_placement(placement) {}

  typename Base::Cost cost(const Profile& profile, const typename Base::Place& place) const override
  {
    return m_cost(profile, place);
  }
  typename Base::Place placement(const Profile& profile) const override { return m_placement(profile); }
  void initialize(const typename Profile::Triangle_mesh& mesh, const typename Profile::Vertex_point_map& vpm,
                  const typename Profile::Geom_traits& traits) const override
  {
    if constexpr(Requires_updates<GetCost>::value) m_cost.initialize(mesh, vpm, traits);
  }
  void update_after_collapse(const Profile& profile, typename Profile::vertex_descriptor v) const override
  {
    if constexpr(Requires_updates<GetCost>::value) m_cost.update_after_collapse(profile, v);
  }

private:
  const GetCost& m_cost;
  const GetPlacement& m_placement;
};

// a model of `StopPredicate`
template <typename Profile>
using Collapse_stop_predicate =
  std::function<bool(const typename Profile::FT&, const Profile&, std::size_t, std::size_t)>;

// a model of `PlacementFilter`
template <typename Profile>
using Collapse_filter =
  std::function<Optional<typename Profile::Point>(const Profile&, const Optional<typename Profile::Point>&)>;

// a model of `EdgeCollapseSimplificationVisitor`
template <typename Profile>
class Any_collapse_visitor
{
protected:
  typedef typename Profile::Triangle_mesh Triangle_mesh;
  typedef Optional<typename Profile::FT> Cost;
  typedef Optional<typename Profile::Point> Place;
  typedef typename Profile::vertex_descriptor Vertex;

public:
  virtual ~Any_collapse_visitor() = default;
  virtual void OnStarted(Triangle_mesh& mesh) = 0;
  virtual void OnFinished(Triangle_mesh& mesh) = 0;
  virtual void OnStopConditionReached(const Profile& profile) = 0;
  virtual void OnCollected(const Profile& profile, const Cost& cost) = 0;
  virtual void OnSelected(const Profile& profile, const Cost& cost, std::size_t initial, std::size_t current) = 0;
  virtual void OnCollapsing(const Profile& profile, const Place& placement) = 0;
  virtual void OnCollapsed(const Profile& profile, const Vertex& v) = 0;
  virtual void OnNonCollapsable(const Profile& profile) = 0;
};

// pre: the visitor outlives this object
template <typename Profile, typename Visitor>
class Collapse_visitor_of final : public Any_collapse_visitor<Profile>
{
  typedef Any_collapse_visitor<Profile> Base;

public:
  explicit Collapse_visitor_of(Visitor& visitor) : m_visitor(visitor) {}

  void OnStarted(typename Base::Triangle_mesh& mesh) override { m_visitor.OnStarted(mesh); }
  void OnFinished(typename Base::Triangle_mesh& mesh) override { m_visitor.OnFinished(mesh); }
  void OnStopConditionReached(const Profile& profile) override { m_visitor.OnStopConditionReached(profile); }
  void OnCollected(const Profile& profile, const typename Base::Cost& cost) override
  {
    m_visitor.OnCollected(profile, cost);
  }
  void OnSelected(const Profile& profile, const typename Base::Cost& cost, std::size_t initial,
                  std::size_t current) override
  {
    m_visitor.OnSelected(profile, cost, initial, current);
  }
  void OnCollapsing(const Profile& profile, const typename Base::Place& placement) override
  {
    m_visitor.OnCollapsing(profile, placement);
  }
  void OnCollapsed(const Profile& profile, const typename Base::Vertex& v) override
  {
    m_visitor.OnCollapsed(profile, v);
  }
  void OnNonCollapsable(const Profile& profile) override { m_visitor.OnNonCollapsable(profile); }

private:
  Visitor& m_visitor;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_ANY_COLLAPSE_POLICIES_H
