// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATION_MAP_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATION_MAP_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The map between the cut facets and the new facets of a truncation (`Shell_truncation_3`), computed in `double`s.
// Places on edges belong to several facets, and all of these yield the same image.
class Truncation_map
{
public:
  typedef Shell_truncation_3::Index Index;
  typedef std::array<double, 3> Barycentric;

  // A point of a cut facet, or of a new facet.
  struct Place
  {
    Index facet;
    Barycentric barycentric;
  };

  // \pre the truncation is valid
  explicit Truncation_map(std::shared_ptr<const Shell_truncation_3> truncation);

  // Returns the image on the truncated mesh of a place on a cut facet.
  Place image(const Place& place) const;

  // Returns the preimage on the original mesh of a place on a new facet.
  Place preimage(const Place& place) const;

  // Returns the derivative of `image()` at a place: the matrix, given by its columns, that maps changes of the
  // barycentric coordinates of the place to changes of those of the image.
  std::array<Barycentric, 3> derivative(const Place& place) const;

private:
  typedef Shell_truncation_3::Planar_point Planar_point;
  typedef std::array<Planar_point, 3> Planar_triangle;
  static constexpr Index npos = Shell_truncation_3::npos;

  // A part of a cut facet: a core, or a triangle of a tip, between the vertex and an edge of the rim.
  struct Part
  {
    Index core, disc;                   // one of them is `npos`
    std::size_t edge;                   // the edge of the rim, for a tip
    std::array<Barycentric, 3> corners; // coordinates in the cut facet
  };

  // The piece of the map that contains a place: a part of the facet, and, for a tip, a triangle of the disc.
  struct Piece
  {
    const Part* part;
    Index new_facet;
  };

  // A triangle that contains a point, and the coordinates of the point in it.
  struct Found
  {
    std::size_t number;
    Barycentric barycentric;
  };

  static Shell_truncation_3::Triangle tip_triangle(const Shell_truncation_3::Disc& d, std::size_t edge);

  std::array<Barycentric, 3> corners(Index facet, const Shell_truncation_3::Triangle& t) const;
  const Planar_point& planar(Index point) const { return m_truncation->planar(point); }

  // Maps corners to the plane by two of their barycentric coordinates.
  static Planar_triangle in_plane(const std::array<Barycentric, 3>& c);
  Planar_triangle in_plane(const Shell_truncation_3::Triangle& t) const;

  // Returns the barycentric coordinates of a point in a planar triangle. If the triangle is too small to compute them,
  // returns the coordinates of its first corner.
  static Barycentric barycentric_in(const Planar_triangle& t, const Planar_point& p);

  // Corrects the barycentric coordinates of a point that is outside a triangle by rounding only.
  static Barycentric clamped(Barycentric barycentric);

  static Barycentric combined(const Barycentric& weights, const std::array<Barycentric, 3>& corners);

  // Returns the triangle that contains a point or is nearest to it, as measured by the least barycentric coordinate.
  template <typename Triangle>
  static Found find_triangle(std::size_t size, const Planar_point& p, const Triangle& triangle);

  Piece piece(const Place& place) const;

  // Returns the planar position of a point in a triangle of a tip.
  Planar_point planar_point(const Part& part, const Barycentric& b) const;

  // Applies the affine map of a piece.
  Barycentric mapped(const Piece& piece, const Barycentric& b) const;

  std::shared_ptr<const Shell_truncation_3> m_truncation;
  std::vector<std::vector<Part> > m_parts;  // by cut facet
  std::vector<std::size_t> m_first_of_disc; // by disc: the number of its first triangle among the new facets
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Projection/internal/Truncation_map_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATION_MAP_H
