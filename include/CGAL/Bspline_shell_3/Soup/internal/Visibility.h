// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_VISIBILITY_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_VISIBILITY_H

#include <CGAL/Bspline_shell_3/Mesh/facet_crossing.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Soup/United_mesh.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Solid_finder.h>
#include <CGAL/Bspline_shell_3/Soup/internal/exact_union.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/enum.h>
#include <CGAL/intersections.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Proves that facets of an exact union are on the boundary of the union: the winding number of the solids is zero in
// front of a facet. It is counted along a segment from the middle of the facet to the outside.
class Visibility
{
  typedef United_mesh::Mesh Mesh;

  struct Probe
  {
    std::size_t source;
    Exact_kernel::Point_3 middle, outside;
    int winding = 0;        // winding number in front of the facet
    bool is_generic = true; // whether the segment touches no edge or vertex
  };
  typedef Box_intersection_d::Box_with_info_d<double, 3, std::size_t> Box;

public:
  // \param mesh the user's mesh
  Visibility(const Mesh& mesh, const Solids& solids) : m_solids(solids)
  {
    for(auto f : mesh.faces()) {
      const auto h = mesh.halfedge(f);
      m_facets.push_back(
        { mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))) });
      std::array<Mesh::Point, 3>& t = m_facets.back();
      if(!solids.faces_outwards) std::swap(t[1], t[2]);
      const std::size_t source = m_facets.size() - 1;
      if(solids.color[solids.solid_of_facet[source]] == Solids::none) continue;
      m_boxes.emplace_back(t[0].bbox() + t[1].bbox() + t[2].bbox(), source);
      m_bbox += m_boxes.back().bbox();
    }
  }

  // Returns the sources of facets that are not proved to be visible. Facets are examined one by one if their sources
  // meet other parts. Of the others, one is examined in each connected set, because no part separates them.
  std::vector<std::size_t> hidden_sources(const Exact_mesh& exact)
  {
    choose_probes(exact);
    constexpr std::array<std::array<double, 2>, 4> slopes = {
      { { 3.1e-4, 7.3e-4 }, { -5.9e-4, 2.3e-4 }, { 8.3e-4, -6.7e-4 }, { -1.7e-4, -9.7e-4 } }
    }; // generic directions, close to an axis: the boxes of segments are narrow
    std::vector<std::size_t> hidden;
    for(const std::array<double, 2>& slope : slopes) {
      count_crossings(slope);
      std::vector<Probe> next;
      for(const Probe& probe : m_probes)
        if(!probe.is_generic) next.push_back({ probe.source, probe.middle, {} });
        else if(probe.winding != 0) hidden.push_back(probe.source);
      m_probes.swap(next);
    }
    for(const Probe& probe : m_probes) hidden.push_back(probe.source);
    sort_unique(hidden);
    return hidden;
  }

private:
  void choose_probes(const Exact_mesh& exact)
  {
    const Exact_sources sources = *find_property_map<Exact_mesh::Face_index, std::size_t>(exact, "f:source");
    std::vector<char> separates(exact.number_of_edges(), 0);
    for(auto h : exact.halfedges())
      if(m_solids.meets_others[sources[exact.face(h)]]) separates[exact.edge(h)] = 1;
    std::vector<std::size_t> set(exact.number_of_faces());
    const std::size_t size = Polygon_mesh_processing::connected_components(
      exact, CGAL::make_property_map(set),
      CGAL::parameters::edge_is_constrained_map(CGAL::make_property_map(separates)));
    std::vector<char> is_known(size, 0);
    for(auto f : exact.faces()) {
      if(is_known[set[f]]) continue;
      is_known[set[f]] = 1;
      const auto h = exact.halfedge(f);
      m_probes.push_back({ sources[f],
                           CGAL::centroid(exact.point(exact.source(h)), exact.point(exact.target(h)),
                                          exact.point(exact.target(exact.next(h)))),
                           {} });
    }
  }

  void count_crossings(const std::array<double, 2>& slope)
  {
    const double reach = 2 * (std::max)({ m_bbox.x_span(), m_bbox.y_span(), m_bbox.z_span() });
    std::vector<Box> segments;
    for(std::size_t n = 0; n < m_probes.size(); ++n) {
      Probe& probe = m_probes[n];
      const auto& t = m_facets[probe.source];
      const std::array<double, 3> normal = facet_normal(t[0], t[1], t[2]).direction;
      const std::size_t axis = main_axis(normal);
      const Bbox_3 box = probe.middle.bbox();
      std::array<double, 3> q = { box.xmin(), box.ymin(), box.zmin() };
      q[axis] += normal[axis] > 0 ? reach : -reach;
      q[(axis + 1) % 3] += slope[0] * reach;
      q[(axis + 2) % 3] += slope[1] * reach;
      probe.outside = Exact_kernel::Point_3(q[0], q[1], q[2]);
      segments.emplace_back(box + probe.outside.bbox(), n);
    }
    CGAL::box_intersection_d(segments.begin(), segments.end(), m_boxes.begin(), m_boxes.end(),
                             [&](const Box& segment, const Box& facet) {
                               Run::poll();
                               add_crossing(m_probes[segment.info()], m_facets[facet.info()]);
                             });
  }

  // A segment that begins in the plane of a facet leaves it to the front of the facet that is examined, and does not
  // pass through the facet.
  static void add_crossing(Probe& probe, const std::array<Mesh::Point, 3>& facet)
  {
    const auto exact = [](const Mesh::Point& p) { return Exact_kernel::Point_3(p.x(), p.y(), p.z()); };
    const auto a = exact(facet[0]), b = exact(facet[1]), c = exact(facet[2]);
    if(CGAL::orientation(a, b, c, probe.middle) == COPLANAR) return;
    const std::optional<int> crossing = facet_crossing(probe.middle, probe.outside, a, b, c);
    if(crossing) probe.winding += *crossing;
    else probe.is_generic = false;
  }

  const Solids& m_solids;
  std::vector<std::array<Mesh::Point, 3> > m_facets; // facets of the user's mesh, facing outwards
  std::vector<Box> m_boxes;                          // boxes of the united facets
  Bbox_3 m_bbox;
  std::vector<Probe> m_probes;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_VISIBILITY_H
