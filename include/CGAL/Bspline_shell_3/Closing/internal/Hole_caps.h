// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_HOLE_CAPS_H
#define CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_HOLE_CAPS_H

#include <CGAL/Bspline_shell_3/Closing/internal/Closing_mesh.h>
#include <CGAL/Bspline_shell_3/Shell/Closing_report.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The holes of a mesh, with their caps where possible. Facets and vertices of the mesh keep their indices in the capped
// mesh; facets and vertices of caps follow.
class Hole_caps
{
  typedef Closing_mesh::Face_index Face_index;
  typedef Closing_mesh::Halfedge_index Halfedge_index;
  typedef Closing_mesh::Vertex_index Vertex_index;
  typedef Closing_kernel::Point_3 Point_3;
public:
  typedef std::vector<std::pair<Face_index, Face_index> > Facet_pairs;

  // Requirements on caps. If a cap does not meet them, a back sheet is better.
  struct Requirements
  {
    double margin; // smallest cone margin at the hole's border; half of the mesh's own margin is enough
    // Smallest distance to other facets, behind and in front of each facet, in the units of the coordinates. Near the
    // border, 1/8 of the distance from the border is enough.
    double gap;
  };

  explicit Hole_caps(const Closing_mesh& mesh) : m_mesh(mesh)
  {
    std::vector<char> is_known(mesh.num_halfedges(), 0);
    for(Halfedge_index h : mesh.halfedges()) {
      if(!mesh.is_border(h) || is_known[h]) continue;
      m_holes.emplace_back();
      for(Halfedge_index g : mesh.halfedges_around_face(h)) {
        is_known[g] = 1;
        m_holes.back().halfedges.push_back(g);
      }
      while(!triangulate(m_holes.back())) {}
    }
    rebuild();
  }

  const Closing_mesh& capped_mesh() const { return m_capped; }
  bool is_cap(Face_index f) const { return std::size_t(f) >= m_mesh.number_of_faces(); }
  // Returns whether a hole has no cap.
  bool is_open() const
  {
    return std::any_of(m_holes.begin(), m_holes.end(), [](const Hole& hole) { return hole.triangles.empty(); });
  }
  // Returns the smallest gap of a cap.
  double least_gap() const { return m_least_gap; }

  // Replaces or removes caps that intersect other facets. Returns whether there were any.
  bool replace(const Facet_pairs& intersections)
  {
    std::vector<char> is_bad(m_holes.size(), 0);
    for(const auto& pair : intersections)
      for(Face_index f : { pair.first, pair.second })
        if(is_cap(f)) is_bad[hole_of(f)] = 1;
    return replace(is_bad);
  }

  // Replaces or removes caps that do not meet the requirements. Returns whether there were any.
  bool replace(const Requirements& requirements)
  {
    std::vector<char> is_bad(m_holes.size(), 0);
    for(std::size_t n = 0; n < m_holes.size(); ++n) is_bad[n] = is_folded(m_holes[n], requirements.margin);
    std::vector<double> gap(m_capped.number_of_faces(), std::numeric_limits<double>::infinity());
    const Ray_tree tree(m_capped);
    for(Face_index f : m_capped.faces()) {
      if(!is_cap(f)) continue;
      const auto [behind, least] = least_gap_at(tree, f, requirements.gap);
      gap[f] = behind;
      if(behind < least) is_bad[hole_of(f)] = 1;
    }
    m_least_gap = std::numeric_limits<double>::infinity();
    for(Face_index f : m_capped.faces())
      if(is_cap(f) && !is_bad[hole_of(f)]) m_least_gap = (std::min)(m_least_gap, gap[f]);
    return replace(is_bad);
  }

  void describe(Closing_report& report) const
  {
    for(const Hole& hole : m_holes) {
      report.holes.emplace_back();
      const Point_3& p = m_mesh.point(m_mesh.source(hole.halfedges[0]));
      report.holes.back().point = { p.x(), p.y(), p.z() };
      report.holes.back().edges = hole.halfedges.size();
      report.holes.back().is_capped = !hole.triangles.empty();
    }
  }

private:
  enum class Method
  {
    PLANAR,
    SPATIAL,
    FLAT_FAN,
    CONE,
    NONE
  };
  struct Hole
  {
    std::vector<Halfedge_index> halfedges; // ordered around the hole
    Method method = Method::PLANAR;
    Point_3 apex; // apex of a fan
    // Corner i is the source of halfedge i; in a fan, the last corner is the apex.
    std::vector<std::array<std::size_t, 3> > triangles;
  };
  struct Triple
  {
    std::array<std::size_t, 3> v;
    Triple(int i, int j, int k) : v{ std::size_t(i), std::size_t(j), std::size_t(k) } {}
  };

  std::size_t hole_of(Face_index f) const { return m_hole_of[std::size_t(f) - m_mesh.number_of_faces()]; }

  bool replace(const std::vector<char>& is_bad)
  {
    for(std::size_t n = 0; n < m_holes.size(); ++n)
      if(is_bad[n] && m_holes[n].method != Method::NONE) {
        // Skips methods that do not change the cap.
        Hole& hole = m_holes[n];
        const auto last = hole.triangles;
        do {
          hole.method = hole.halfedges.size() == 3 ? Method::NONE : Method(int(hole.method) + 1);
          while(!triangulate(hole)) {}
        } while(hole.method != Method::NONE && !is_fan(hole) && hole.triangles == last);
      }
    if(std::find(is_bad.begin(), is_bad.end(), 1) == is_bad.end()) return false;
    rebuild();
    return true;
  }

  // Triangulates a hole by its method, unless this is `NONE`. If the method fails, selects the next method and returns
  // false.
  bool triangulate(Hole& hole) const
  {
    // Numbers of edges above which the cubic search for a triangulation, or adding a fan, takes too long.
    constexpr std::size_t most_for_cubic = 120, most_for_fan = 2000;
    Run::poll();
    hole.triangles.clear();
    if(hole.method == Method::NONE) return true;
    std::vector<Point_3> points, beyond;
    for(Halfedge_index h : hole.halfedges) {
      points.push_back(m_mesh.point(m_mesh.source(h)));
      beyond.push_back(m_mesh.point(m_mesh.target(m_mesh.next(m_mesh.opposite(h)))));
    }
    const std::size_t size = points.size();
    std::vector<Triple> patch;
    if(size == 3) patch.emplace_back(0, 1, 2);
    else if(is_fan(hole) && size > most_for_fan) {
    } else if(is_fan(hole)) {
      points.push_back(hole.apex = apex(hole, points));
      for(std::size_t i = 0; i < size; ++i) patch.emplace_back(int(i), int((i + 1) % size), int(size));
    } else
      Polygon_mesh_processing::triangulate_hole_polyline(
        points, beyond, std::back_inserter(patch),
        CGAL::parameters::use_delaunay_triangulation(true)
          .use_2d_constrained_delaunay_triangulation(hole.method == Method::PLANAR)
          .do_not_use_cubic_algorithm(size > most_for_cubic));
    bool is_good = patch.size() == (size > 3 && is_fan(hole) ? size : size - 2);
    for(const Triple& t : patch) is_good = is_good && !CGAL::collinear(points[t.v[0]], points[t.v[1]], points[t.v[2]]);
    if(is_good)
      for(const Triple& t : patch) hole.triangles.push_back(t.v);
    else hole.method = Method(int(hole.method) + 1);
    return is_good;
  }

  static bool is_fan(const Hole& hole) { return hole.method == Method::FLAT_FAN || hole.method == Method::CONE; }

  // Returns the middle of a hole, weighted by edge lengths so that finely divided parts of the border do not dominate.
  // For a cone, shifts it along the mean outward conormal of the border, in proportion to half its mean distance from
  // the border. This helps if facets at the border stick out of the hole.
  Point_3 apex(const Hole& hole, const std::vector<Point_3>& points) const
  {
    Closing_kernel::Vector_3 sum(0, 0, 0), outwards(0, 0, 0);
    double weight = 0, radius = 0;
    for(std::size_t i = 0; i < points.size(); ++i) {
      const Point_3 &p = points[i], &q = points[(i + 1) % points.size()];
      const double w = std::sqrt(CGAL::squared_distance(p, q));
      sum = sum + w * (CGAL::midpoint(p, q) - CGAL::ORIGIN);
      outwards = outwards + w * outward_conormal(m_mesh, hole.halfedges[i]);
      weight += w;
    }
    const Point_3 middle = CGAL::ORIGIN + sum / weight;
    if(hole.method == Method::FLAT_FAN) return middle;
    for(const Point_3& p : points) radius += std::sqrt(CGAL::squared_distance(p, middle)) / double(points.size());
    return middle + radius / 2 / weight * outwards;
  }

  // Rebuilds the mesh with the remaining caps. A cap with an edge of the mesh or of an earlier cap cannot be added, and
  // is removed.
  void rebuild()
  {
    bool is_complete;
    do {
      is_complete = true;
      m_capped = m_mesh;
      m_hole_of.clear();
      for(std::size_t n = 0; n < m_holes.size() && is_complete; ++n) {
        Hole& hole = m_holes[n];
        const std::size_t size = hole.halfedges.size();
        std::vector<Vertex_index> vertices;
        for(Halfedge_index h : hole.halfedges) vertices.push_back(m_mesh.source(h));
        for(const auto& t : hole.triangles)
          for(int i = 0; i < 3; ++i) {
            const std::size_t p = t[i], q = t[(i + 1) % 3];
            if(p < size && q < size && q != (p + 1) % size
               && m_capped.halfedge(vertices[p], vertices[q]) != Closing_mesh::null_halfedge())
              hole.method = Method::NONE;
          }
        if(hole.method == Method::NONE) hole.triangles.clear();
        if(hole.triangles.empty()) continue;
        if(size > 3 && is_fan(hole)) vertices.push_back(m_capped.add_vertex(hole.apex));
        for(const auto& t : hole.triangles) {
          const std::array<Vertex_index, 3> corners = { vertices[t[0]], vertices[t[1]], vertices[t[2]] };
          is_complete = is_complete && Euler::add_face(corners, m_capped) != Closing_mesh::null_face();
          m_hole_of.push_back(n);
        }
        if(!is_complete) hole.method = Method::NONE;
      }
    } while(!is_complete);
  }

  bool is_folded(const Hole& hole, double least_margin) const
  {
    if(hole.triangles.empty()) return false;
    for(Halfedge_index h : hole.halfedges) {
      const Vertex_index v = m_mesh.source(h);
      const double closed = length(cone_axis_at(m_capped, v));
      // Folds that the mesh has without the cap are ignored.
      if(closed < least_margin && closed < 0.5 * length(cone_axis_at(m_mesh, v))) return true;
    }
    return false;
  }

  // Returns the gap at the middle of a facet and the required gap.
  std::pair<double, double> least_gap_at(const Ray_tree& tree, Face_index f, double gap) const
  {
    Run::poll();
    const Halfedge_index h = m_capped.halfedge(f);
    const std::array<Point_3, 3> t = { m_capped.point(m_capped.source(h)), m_capped.point(m_capped.target(h)),
                                       m_capped.point(m_capped.target(m_capped.next(h))) };
    const Point_3 center = CGAL::centroid(t[0], t[1], t[2]);
    double to_border = std::numeric_limits<double>::infinity();
    for(const Point_3& p : t) to_border = (std::min)(to_border, std::sqrt(CGAL::squared_distance(p, center)));
    const Closing_kernel::Vector_3 normal = unit_normal(m_capped, f);
    const auto is_facet = [&](Face_index g) { return g == f; };
    return { (std::min)(tree.distance(center, -normal, is_facet), tree.distance(center, normal, is_facet)),
             (std::min)(gap, to_border / 8) };
  }

  const Closing_mesh& m_mesh;
  Closing_mesh m_capped;
  std::vector<Hole> m_holes;
  std::vector<std::size_t> m_hole_of; // by facet of caps
  double m_least_gap = std::numeric_limits<double>::infinity();
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_HOLE_CAPS_H
