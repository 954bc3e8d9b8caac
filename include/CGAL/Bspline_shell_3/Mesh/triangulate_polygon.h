// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_TRIANGULATE_POLYGON_H
#define CGAL_BSPLINE_SHELL_3_MESH_TRIANGULATE_POLYGON_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <queue>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Cuts off ears, those with the best shape first. Orientations are exact, in the projection of the polygon along the
// axis nearest to its normal.
class Ear_clipping
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;
public:
  typedef Kernel::Point_3 Point_3;
  typedef std::array<std::size_t, 3> Triangle;

  explicit Ear_clipping(const std::vector<Point_3>& polygon) : m_points(polygon), m_size(polygon.size())
  {
    m_previous.resize(m_size);
    m_next.resize(m_size);
    m_version.assign(m_size, 0);
    for(std::size_t i = 0; i < m_size; ++i) {
      m_next[i] = (i + 1) % m_size;
      m_previous[m_next[i]] = i;
    }
    project();
    for(std::size_t i = 0; i < m_size; ++i) {
      if(!is_convex(i)) m_others.push_back(i);
      push(i);
    }
  }

  // The tip of each triangle is its second corner; no later triangle has it.
  std::vector<Triangle> triangles()
  {
    std::vector<Triangle> result;
    std::vector<Ear> waiting; // ears that contain other vertices
    bool is_stuck = false;
    while(result.size() + 2 < m_points.size()) {
      if(m_queue.empty()) {
        is_stuck = waiting.empty() || m_has_waited; // the polygon is not simple; it is cut anyway
        for(const Ear& ear : waiting) m_queue.push(ear);
        if(m_queue.empty())
          for(std::size_t i = 0; i < m_points.size(); ++i)
            if(m_next[i] != removed) push(i);
        waiting.clear();
        m_has_waited = true;
      }
      const Ear ear = m_queue.top();
      m_queue.pop();
      if(ear.version != m_version[ear.tip]) continue;
      if(!is_stuck && !is_convex(ear.tip)) continue; // it is pushed again when a neighbor is cut
      if(!is_stuck && is_blocked(ear.tip)) {
        waiting.push_back(ear);
        continue;
      }
      result.push_back({ m_previous[ear.tip], ear.tip, m_next[ear.tip] });
      cut(ear.tip);
      is_stuck = m_has_waited = false;
    }
    return result;
  }

private:
  struct Ear
  {
    double quality;
    std::size_t tip, version;
    bool operator<(const Ear& other) const
    {
      return quality < other.quality || (quality == other.quality && tip > other.tip);
    }
  };
  static constexpr std::size_t removed = std::size_t(-1);

  void project()
  {
    // Newell's normal
    std::array<double, 3> normal = {};
    for(std::size_t i = 0; i < m_size; ++i) {
      const Kernel::Vector_3 u = m_points[i] - m_points[0], v = m_points[m_next[i]] - m_points[0];
      for(int a = 0; a < 3; ++a) normal[a] += u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3];
    }
    int axis = 0;
    for(int a = 1; a < 3; ++a)
      if(std::abs(normal[a]) > std::abs(normal[axis])) axis = a;
    for(const Point_3& p : m_points) m_projected.emplace_back(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    // A simple polygon has the orientation of the turn at its smallest vertex.
    const std::size_t least = std::min_element(m_projected.begin(), m_projected.end()) - m_projected.begin();
    m_orientation = turn(m_previous[least], least, m_next[least]);
    if(m_orientation == COLLINEAR) m_orientation = normal[axis] < 0 ? RIGHT_TURN : LEFT_TURN;
  }

  Orientation turn(std::size_t i, std::size_t j, std::size_t k) const
  {
    return CGAL::orientation(m_projected[i], m_projected[j], m_projected[k]);
  }

  bool is_convex(std::size_t i) const { return turn(m_previous[i], i, m_next[i]) == m_orientation; }

  // Returns whether another vertex lies in the ear or on its boundary.
  bool is_blocked(std::size_t tip) const
  {
    const std::array<std::size_t, 3> ear = { m_previous[tip], tip, m_next[tip] };
    return std::any_of(m_others.begin(), m_others.end(), [&](std::size_t i) {
      for(std::size_t corner : ear)
        if(i == corner || m_projected[i] == m_projected[corner]) return false;
      for(int e = 0; e < 3; ++e)
        if(turn(ear[e], ear[(e + 1) % 3], i) == -m_orientation) return false;
      return true;
    });
  }

  void push(std::size_t tip)
  {
    const Point_3 &p = m_points[m_previous[tip]], &q = m_points[tip], &r = m_points[m_next[tip]];
    const double longest = (std::max)({ (q - p).squared_length(), (r - q).squared_length(), (p - r).squared_length() });
    const double area = std::sqrt(CGAL::cross_product(q - p, r - p).squared_length());
    m_queue.push({ longest > 0 ? area / longest : 0, tip, m_version[tip] });
  }

  void cut(std::size_t tip)
  {
    const std::size_t before = m_previous[tip], after = m_next[tip];
    m_next[before] = after;
    m_previous[after] = before;
    m_next[tip] = removed;
    ++m_version[tip];
    for(std::size_t i : { before, after }) {
      ++m_version[i];
      push(i);
    }
    // Convex vertices remain convex.
    m_others.erase(
      std::remove_if(m_others.begin(), m_others.end(),
                     [&](std::size_t i) { return i == tip || ((i == before || i == after) && is_convex(i)); }),
      m_others.end());
  }

  const std::vector<Point_3>& m_points;
  std::size_t m_size;
  std::vector<std::size_t> m_previous, m_next, m_version;
  std::vector<Kernel::Point_2> m_projected;
  Orientation m_orientation;
  std::vector<std::size_t> m_others; // vertices that are not convex
  std::priority_queue<Ear> m_queue;
  bool m_has_waited = false;
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief triangulates a polygon in space without new vertices, by cutting off ears, those with the best shape first.
 *
 * `CGAL::Polygon_mesh_processing::triangulate_faces()` gives better results for polygons that are far from planar, but
 * takes longer to compile than all other checks of the mesh.
 *
 * \param polygon at least three vertices
 * \return indices of vertices: a triangle is cut off at its second vertex, which no later triangle has. If the
 *   projection of the polygon along an axis is simple, all triangles have the orientation of the polygon, and none is
 *   degenerate. Otherwise, some may be degenerate or reversed.
 * \cgalHeading{Cost} \f$O(n \log n + n r)\f$ for \f$n\f$ vertices of which \f$r\f$ are not convex
 */
inline std::vector<std::array<std::size_t, 3> > triangulate_polygon(
  const std::vector<Exact_predicates_inexact_constructions_kernel::Point_3>& polygon)
{
  return internal::Ear_clipping(polygon).triangles();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_TRIANGULATE_POLYGON_H
