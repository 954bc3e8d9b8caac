// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_H
#define CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_H

#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

class Shell_truncation_3;

namespace internal {

// Returns whether a truncation is that of a mesh, and its map is a homeomorphism.
bool prove_truncation(const Shell_truncation_3& truncation);

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief replacement of the tips of a mesh at some of its vertices.
 *
 * If the facets at a vertex face no common direction, no field can be transversal there. The *truncated* mesh has a
 * disc in place of the vertex: the facets at the vertex are cut near it, and triangles between the cuts replace the
 * part that is cut off.
 *
 * The map between the meshes is the identity outside the cut facets, up to the rounding of coordinates. The rest of a
 * cut facet, its *core*, is a union of triangles, which are facets of the truncated mesh; the map is affine on each.
 * The *tip* is a fan of triangles between the vertex and the cuts. The tip and the disc are both mapped to the same
 * planar polygon, by affine maps of their triangles. The map from tip to disc is the first of these maps followed by
 * the inverse of the second.
 *
 * `is_valid()` proves in exact arithmetic that the map is a homeomorphism. The proof does not depend on the coordinates
 * of cuts, which are rounded, or on how they were found.
 *
 * Facets are identified by the coordinates of their vertices, because an embedded mesh has no two vertices at the same
 * position. The truncation therefore fits every mesh that has the facets to be cut. Cut facets with a common disc form
 * a *patch*. Each patch is found and replaced as a whole: see `find_patches()` and `replace_patches()`.
 */
class Shell_truncation_3
{
public:
  typedef std::array<double, 3> Point;
  typedef std::array<double, 2> Planar_point;
  typedef std::uint32_t Index;
  typedef std::array<Index, 3> Triangle; ///< indices of points, counterclockwise as seen from the front of the mesh.

  static constexpr Index npos = std::numeric_limits<Index>::max();

  /// a point where a facet is cut: `center + s (first - center) + t (second - center)`, where these are corners of the
  /// facet in this order. On an edge, `t` is zero and `second` is `npos`.
  struct Cut
  {
    Index center, first, second;
    double s, t;

    /// returns the barycentric coordinates of the point
    /// \pre `facet` has the corners
    template <typename NT>
    std::array<NT, 3> barycentric(const Triangle& facet) const
    {
      std::array<NT, 3> b = { NT(0), NT(0), NT(0) };
      b[corner(facet, center)] = NT(1) - NT(s) - NT(t);
      b[corner(facet, first)] = NT(s);
      if(second != npos) b[corner(facet, second)] = NT(t);
      return b;
    }
  };

  /// replacement of the tip at a vertex
  struct Disc
  {
    Index center;                    ///< the vertex
    std::vector<Index> rim;          ///< the cuts around it, counterclockwise
    std::vector<Index> facets;       ///< by edge of the rim, from each cut to the next: the cut facet that contains it
    std::vector<Triangle> triangles; ///< triangles between cuts and inner points
  };

  /// a remaining part of a cut facet
  struct Core
  {
    Triangle triangle;
    Index facet; ///< the cut facet
  };

  /// a facet that only the truncated mesh has
  struct New_facet
  {
    Triangle triangle;
    Index disc;      ///< `npos` for a core
    Index cut_facet; ///< the facet that a core is part of; for a triangle of a disc, some facet that the disc cuts
  };

  Shell_truncation_3() = default;
  /// \param points vertices of the cut facets, followed by the points of `cuts` and the inner points of discs
  /// \param cut_facets facets that are cut
  /// \param cuts of edges and facets
  /// \param cores remaining parts of the cut facets
  /// \param discs replacements of the other parts
  /// \param planar positions of cuts and inner points in the plane; the truncated vertices are at the origin
  Shell_truncation_3(std::vector<Point> points, std::vector<Triangle> cut_facets, std::vector<Cut> cuts,
                     std::vector<Core> cores, std::vector<Disc> discs, std::vector<Planar_point> planar)
    : m_points(std::move(points)), m_cut_facets(std::move(cut_facets)), m_cuts(std::move(cuts)),
      m_cores(std::move(cores)), m_discs(std::move(discs)), m_planar(std::move(planar)),
      m_is_valid(internal::prove_truncation(*this))
  {
    if(!m_is_valid) return;
    for(const Core& c : m_cores) m_new_facets.push_back({ c.triangle, npos, c.facet });
    for(std::size_t n = 0; n < m_discs.size(); ++n)
      for(const Triangle& t : m_discs[n].triangles) m_new_facets.push_back({ t, Index(n), m_discs[n].facets.front() });
  }

  const std::vector<Point>& points() const { return m_points; }
  /// returns the number of points that are vertices of the mesh, which are the first of all points
  std::size_t number_of_corners() const { return m_points.size() - m_planar.size(); }
  const std::vector<Triangle>& cut_facets() const { return m_cut_facets; }
  const std::vector<Cut>& cuts() const { return m_cuts; }
  const std::vector<Core>& cores() const { return m_cores; }
  const std::vector<Disc>& discs() const { return m_discs; }
  const std::vector<Planar_point>& planar() const { return m_planar; }
  /// returns the cores, followed by the triangles of discs; nothing if the truncation is not valid
  const std::vector<New_facet>& new_facets() const { return m_new_facets; }

  /// returns whether a point is a cut
  bool is_cut(Index point) const { return point >= number_of_corners() && point < number_of_corners() + m_cuts.size(); }
  /// returns a cut by its point
  const Cut& cut(Index point) const { return m_cuts[point - number_of_corners()]; }
  /// returns the position of a cut or an inner point in the plane
  const Planar_point& planar(Index point) const { return m_planar[point - number_of_corners()]; }
  /// returns the barycentric coordinates of a point in a cut facet
  /// \pre the point is a corner or a cut of the facet
  template <typename NT = double>
  std::array<NT, 3> barycentric(const Triangle& facet, Index point) const
  {
    if(point >= number_of_corners()) return cut(point).barycentric<NT>(facet);
    std::array<NT, 3> b = { NT(0), NT(0), NT(0) };
    b[corner(facet, point)] = NT(1);
    return b;
  }
  /// returns the position of a point among the corners of a triangle, or 3 if it is not a corner
  static std::size_t corner(const Triangle& t, Index point)
  {
    return std::size_t(std::find(t.begin(), t.end(), point) - t.begin());
  }

  /// returns whether this is proved to be the truncation of a mesh whose map is a homeomorphism
  bool is_valid() const { return m_is_valid; }

private:
  std::vector<Point> m_points;
  std::vector<Triangle> m_cut_facets;
  std::vector<Cut> m_cuts;
  std::vector<Core> m_cores;
  std::vector<Disc> m_discs;
  std::vector<Planar_point> m_planar;
  std::vector<New_facet> m_new_facets;
  bool m_is_valid = false;
};

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_H
