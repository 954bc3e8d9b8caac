// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_LOCAL_GAP_3_H
#define CGAL_BSPLINE_SHELL_3_MESH_LOCAL_GAP_3_H

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/enum.h>

#include <array>
#include <cstddef>
#include <limits>
#include <memory>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief computes the local gap of a mesh: the thickness of its walls, and the width of narrow gaps between its parts.
 *
 * The local gap is defined at a point of a facet, on one of its two sides: it is the diameter of the largest ball that
 * touches the facet there and whose interior contains no point of an opposite facet. A facet is opposite if the angle
 * between the normals exceeds 120 degrees. The gap behind the facet is the thickness of the wall, and the gap in front
 * of it is the distance to the next part of the mesh. Facets that share a vertex with the facet are ignored, because
 * the gap of a fold is zero at its edge.
 *
 * Gaps are computed in `double`s; up to rounding, each is the diameter of a ball that touches the facet and meets an
 * opposite facet. Const member functions may be called concurrently. A query takes logarithmic time if few facets are
 * closer than the gap.
 */
class Local_gap_3
{
public:
  typedef Input_mesh_3::Face_index Face_index;
  typedef std::array<double, 3> Point;

  /// \pre `input` is built, and outlives this object
  explicit Local_gap_3(const Input_mesh_3& input);

  /// returns the smallest gap on a facet, in the units of the coordinates.
  /// \param facet a facet of the checked mesh
  /// \param side `NEGATIVE` behind the facet, `POSITIVE` in front of it
  /// \param most upper bound on the result; a smaller bound makes the query faster
  double operator()(Face_index facet, Sign side, double most = std::numeric_limits<double>::infinity()) const;

  /// returns the smallest gap on a part of a facet, in the units of the coordinates.
  /// \param facet a facet of the checked mesh
  /// \param corners the corners of a convex polygon in the facet, or one point
  /// \param size number of corners: three or more, or one
  /// \param side as above
  /// \param most as above
  double operator()(Face_index facet, const Point* corners, std::size_t size, Sign side,
                    double most = std::numeric_limits<double>::infinity()) const;

private:
  class Facets;
  std::shared_ptr<const Facets> m_facets;
};

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_MESH_LOCAL_GAP_3_H
