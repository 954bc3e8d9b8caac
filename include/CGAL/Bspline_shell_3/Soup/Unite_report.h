// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_UNITE_REPORT_H
#define CGAL_BSPLINE_SHELL_3_SOUP_UNITE_REPORT_H

#include <cstddef>
#include <iomanip>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Soup
/// the outcome of `unite_parts()`
enum class Unite_status
{
  NOT_TRIED,                ///< `unite_parts()` was not called
  UNITED,                   ///< the mesh bounds the union of all parts
  UNSUITABLE_MESH,          ///< the mesh is open, not manifold, or has degenerate facets
  TOO_MANY_INTERSECTIONS,   ///< more than 10^7 pairs of facets intersect
  PART_INTERSECTS_ITSELF,   ///< a connected component intersects itself
  INCONSISTENT_ORIENTATION, ///< outermost parts face different sides, or a cavity is not within one solid
  CONTACT,                  ///< parts touch along an edge or at a vertex, where their union is not manifold
  NOT_COMPUTED,             ///< the computation of the union failed
  ROUNDED_BADLY             ///< after coordinates are rounded, facets intersect, are degenerate, or are turned
};

/// \ingroup PkgBsplineShell3Soup
/// returns a sentence that describes the outcome
inline const char* message(Unite_status status)
{
  switch(status) {
    case Unite_status::NOT_TRIED: return "The parts of the mesh were not united.";
    case Unite_status::UNITED: return "Parts that intersect were united.";
    case Unite_status::UNSUITABLE_MESH:
      return "Parts cannot be united because the mesh is open, not manifold, or has degenerate facets.";
    case Unite_status::TOO_MANY_INTERSECTIONS: return "Parts are not united because too many facets intersect.";
    case Unite_status::PART_INTERSECTS_ITSELF:
      return "Parts cannot be united because a connected component intersects itself.";
    case Unite_status::INCONSISTENT_ORIENTATION:
      return "Parts cannot be united because their orientations are inconsistent.";
    case Unite_status::CONTACT:
      return "Parts cannot be united because they touch along an edge or at a vertex: move them slightly.";
    case Unite_status::NOT_COMPUTED: return "Parts cannot be united because the computation of their union failed.";
    case Unite_status::ROUNDED_BADLY:
      return "Parts cannot be united because facets of their union are too small for rounded coordinates.";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief a report on the union of the parts of a mesh.
 *
 * A *part* is a connected component. A *solid* is a part with the cavities in it. Numbers of facets refer to the input.
 */
struct Unite_report
{
  Unite_status status = Unite_status::NOT_TRIED;
  /// facets of the input that cause a failure, ascending; empty if they are unknown
  std::vector<std::size_t> offending_facets;
  std::size_t parts = 0, solids = 0;
  std::size_t united_solids = 0;        ///< solids that intersect or contain another one
  std::size_t groups = 0;               ///< connected sets of such solids
  std::size_t hidden_facets = 0;        ///< facets that contribute nothing to the result
  std::size_t partly_hidden_facets = 0; ///< facets that contribute a part of their area
  std::size_t coplanar_pairs = 0;       ///< pairs of facets that overlap, and face the same side
  double hidden_area = 0;               ///< fraction of the input's area that contributes nothing
  double seconds = 0;                   ///< time, in seconds

  explicit operator bool() const { return status == Unite_status::UNITED; } ///< returns whether there is a union
};

/// \ingroup PkgBsplineShell3Soup
/// returns a sentence that describes the outcome, with the number of solids and the hidden area
inline std::string message(const Unite_report& report)
{
  if(!report) return message(report.status);
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << report.united_solids << " overlapping closed parts were united; " << std::setprecision(2)
       << 100 * report.hidden_area << " % of the area is hidden inside.";
  return text.str();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_UNITE_REPORT_H
