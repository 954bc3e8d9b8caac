// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_COVER_BOX_H
#define CGAL_BSPLINE_SHELL_3_SHELL_COVER_BOX_H

#include <array>
#include <cstdint>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief the classification of a box.
 */
enum class Box_kind : std::uint8_t
{
  /// outside the shell: on the whole closed box, the field is below the inner threshold or above the outer threshold
  EXCLUDED,
  MONOTONE,       ///< on the whole closed box, the field increases along a fixed direction: no critical point
  CRITICAL_BELOW, ///< the field is below the inner threshold at all critical points in the closed box
  CRITICAL_ABOVE, ///< the field is above the outer threshold at all critical points in the closed box
  UNDECIDED       ///< none of the above was proved
};

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief a closed dyadic part of a leaf cell.
 */
struct Cover_box
{
  static constexpr std::uint32_t no_component = std::uint32_t(-1);

  std::uint32_t cell;        ///< leaf cell of the field
  std::uint16_t position[3]; ///< position of the smallest corner, in units of the cell's width / 2^depth
  std::uint8_t depth;        ///< number of subdivisions of the cell
  Box_kind kind;
  std::uint32_t component = no_component; ///< component of the cover; `no_component` if the box is in none
  /// data that proves the kind: for a monotone box, the direction, whose largest component has the absolute value 1;
  /// for critical points beyond a threshold, the center for `values_at_critical_points()`, in units of the box
  std::array<double, 3> proof = {};
  bool is_at_end = false; ///< whether a point of the box on the boundary of the domain may be in the shell
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_COVER_BOX_H
