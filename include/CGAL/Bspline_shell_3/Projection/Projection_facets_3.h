// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_FACETS_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_FACETS_3_H

#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief the facets of a mesh to project onto (`Projection_target_3`), independent of the type of the mesh: their
 * corners, neighbors, and normals, and an AABB tree.
 *
 * Facets are numbered. Edge `i` of a facet leads from vertex `i` to the next. Const member functions may be called
 * concurrently.
 */
class Projection_facets_3
{
public:
  typedef std::array<double, 3> Coordinates;
  typedef std::uint32_t Index;
  static constexpr Index npos = std::numeric_limits<Index>::max();

  struct Facet
  {
    std::array<Coordinates, 3> vertex;
    std::array<Index, 3> neighbor; ///< `npos` at a border
    Coordinates normal;            ///< its length is twice the area; set by the constructor
  };

  Projection_facets_3() = default;
  /// \pre coordinates are finite
  explicit Projection_facets_3(std::vector<Facet> facets);

  std::size_t number_of_facets() const { return m_facets.size(); }
  const Coordinates& vertex(Index facet, int i) const { return m_facets[facet].vertex[i]; }
  const Coordinates& normal(Index facet) const { return m_facets[facet].normal; } ///< its length is twice the area
  bool has_area(Index facet) const { return normal(facet) != Coordinates{}; }
  Index neighbor(Index facet, int edge) const { return m_facets[facet].neighbor[edge]; } ///< `npos` at a border

  /// returns whether the mesh has no border edges
  bool is_closed() const
  {
    return std::all_of(m_facets.begin(), m_facets.end(), [](const Facet& f) {
      return std::find(f.neighbor.begin(), f.neighbor.end(), npos) == f.neighbor.end();
    });
  }

  /// returns the connected component of each facet, and sets `number` to the number of components
  std::vector<Index> components(std::size_t& number) const;

  /// returns the point with these barycentric coordinates
  Coordinates point(Index facet, const Coordinates& barycentric) const
  {
    Coordinates p;
    for(int a = 0; a < 3; ++a)
      p[a] = barycentric[0] * vertex(facet, 0)[a] + barycentric[1] * vertex(facet, 1)[a]
             + barycentric[2] * vertex(facet, 2)[a];
    return p;
  }

  /// returns normal . (p - q) for a point q of the facet's plane
  double height(Index facet, const Coordinates& p) const
  {
    const Facet& f = m_facets[facet];
    return internal::dot(f.normal, difference(p, f.vertex[0]));
  }

  /// the position of a point in the plane of a facet
  struct Position
  {
    /// barycentric coordinates; they may be negative
    Coordinates barycentric;
    /// distance from the facet, if the point is outside; otherwise, minus the distance from the nearest edge
    double outside;
    /// the edge whose line the point is farthest outside of or, if it is inside, nearest to
    int edge;
    /// barycentric coordinates of the nearest point of the facet
    Coordinates nearest;
  };
  /// \pre the facet has an area
  Position position(Index facet, const Coordinates& p) const;

  /// returns the facet that is nearest to a point, and the barycentric coordinates of its nearest point.
  /// \pre there is a facet
  std::pair<Index, Coordinates> closest(const Coordinates& p) const;

  /// calls `visit(facet)` for all facets whose bounding boxes intersect the box
  template <typename Visitor>
  void visit_facets(const Bbox_3& box, const Visitor& visit) const
  {
    visit_facets(
      box, [](const void* visitor, Index facet) { (*static_cast<const Visitor*>(visitor))(facet); }, &visit);
  }

  /// returns the facet nearest to `p` that the straight segment from `p + first * direction` to `p + last * direction`
  /// meets from behind. If there is none, returns the facet that the line misses least among those whose bounding boxes
  /// are within `margin` of the segment, or `npos`.
  Index facet_on_line(const Coordinates& p, const Coordinates& direction, double first, double last,
                      double margin) const;

  /// returns a facet that the segment meets from behind, found by a walk over edges from `facet`. Returns `npos` if a
  /// facet on the walk does not face along `direction`, or if the walk ends at a border, beyond the segment, or after
  /// too many moves.
  Index facet_on_line_near(Index facet, const Coordinates& p, const Coordinates& direction, double first,
                           double last) const;

private:
  class Tree;

  void visit_facets(const Bbox_3& box, void (*visit)(const void*, Index), const void* visitor) const;
  static Coordinates difference(const Coordinates& p, const Coordinates& q)
  {
    return { p[0] - q[0], p[1] - q[1], p[2] - q[2] };
  }
  static Coordinates normal(const Coordinates& p, const Coordinates& q, const Coordinates& r);
  static Coordinates exact_barycentric(const Facet& f, const Coordinates& p);
  static double nearest_on_edges(const Facet& f, const Coordinates& p, Coordinates& barycentric);

  std::vector<Facet> m_facets;
  std::shared_ptr<const Tree> m_tree;
};

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_FACETS_3_H
