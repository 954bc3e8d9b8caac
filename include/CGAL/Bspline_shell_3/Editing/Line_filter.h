// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_LINE_FILTER_H
#define CGAL_BSPLINE_SHELL_3_EDITING_LINE_FILTER_H

#include <CGAL/Bspline_shell_3/Editing/Shell_filter.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/squared_distance_3.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief a filter of edge collapses that keeps polylines of edges, the *lines*, close to their initial positions:
 * seams, feature lines, and borders of labels.
 *
 * If an edge on a line is collapsed, an edge replaces a part of the initial line. A placement passes only if all points
 * of this part are within a given distance of the new edge. Since the part is connected and has the ends of the edge,
 * all points of the edge are then within this distance of the part. Use the filter with constrained edges that may be
 * collapsed along their polylines: `parameters::edge_is_constrained_map(map).protect_constraints(false)`.
 *
 * \cgalModels `PlacementFilter`
 *
 * \tparam TriangleMesh a model of `HalfedgeListGraph`, with an internal vertex point map
 * \tparam EdgeIsLineMap a model of `ReadablePropertyMap` from edges to `bool`, which is updated during the edit
 * \tparam BaseFilter a model of `PlacementFilter`, which is called first
 */
template <typename TriangleMesh, typename EdgeIsLineMap, typename BaseFilter = Permissive_filter>
class Line_filter
{
  typedef
    typename boost::property_traits< typename boost::property_map<TriangleMesh, vertex_point_t>::const_type>::value_type
      Point;
  typedef typename Kernel_traits<Point>::Kernel Kernel;
  typedef typename Kernel::Segment_3 Segment;

public:
  /// stores the lines of a mesh before the edit
  /// \param distance in the units of the coordinates
  Line_filter(const TriangleMesh& mesh, EdgeIsLineMap is_line, double distance,
              const BaseFilter& base_filter = BaseFilter())
    : m_is_line(is_line), m_squared_distance(distance * distance), m_base_filter(base_filter)
  {
    const auto vpm = get(vertex_point, mesh);
    auto neighbors = std::make_shared<Neighbors>();
    for(auto e : edges(mesh)) {
      const Point p = get(vpm, source(e, mesh)), q = get(vpm, target(e, mesh));
      if(!get(is_line, e) || p == q) continue;
      (*neighbors)[p].push_back(q);
      (*neighbors)[q].push_back(p);
    }
    m_neighbors = std::move(neighbors);
  }

  /// returns the placement, or none if it is rejected.
  /// \pre an edge on a line is collapsed to one of its vertices
  template <typename Profile, typename OptionalPoint>
  OptionalPoint operator()(const Profile& profile, OptionalPoint placement) const
  {
    placement = m_base_filter(profile, placement);
    return !placement || keeps_line(profile, *placement) ? placement : OptionalPoint();
  }

private:
  typedef std::map<Point, std::vector<Point> > Neighbors;

  template <typename Profile>
  bool keeps_line(const Profile& profile, const Point& place) const
  {
    const auto& mesh = profile.surface_mesh();
    const auto& vpm = profile.vertex_point_map();
    if(!get(m_is_line, edge(profile.v0_v1(), mesh))) return true;
    const bool keeps_first = place == profile.p0();
    const auto removed = keeps_first ? profile.v1() : profile.v0(), kept = keeps_first ? profile.v0() : profile.v1();
    for(auto h : CGAL::halfedges_around_target(removed, mesh))
      if(get(m_is_line, edge(h, mesh)) && source(h, mesh) != kept)
        return is_near(get(vpm, removed), Segment(get(vpm, kept), get(vpm, source(h, mesh))));
    return true;
  }

  // Returns whether the part of the initial line through the point, between the ends of the segment, is within the
  // distance of the segment.
  bool is_near(const Point& middle, const Segment& segment) const
  {
    const std::vector<Point>& both = m_neighbors->at(middle);
    if(both.size() != 2 || CGAL::squared_distance(middle, segment) > m_squared_distance) return false;
    for(Point current : both)
      for(Point previous = middle; current != segment.source() && current != segment.target();) {
        const std::vector<Point>& next = m_neighbors->at(current);
        if(next.size() != 2 || current == middle || CGAL::squared_distance(current, segment) > m_squared_distance)
          return false;
        const Point after = next[0] == previous ? next[1] : next[0];
        previous = current;
        current = after;
      }
    return true;
  }

  EdgeIsLineMap m_is_line;
  double m_squared_distance;
  BaseFilter m_base_filter;
  std::shared_ptr<const Neighbors> m_neighbors; // on the initial lines
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_LINE_FILTER_H
