// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_EXCISION_REPORT_H
#define CGAL_BSPLINE_SHELL_3_SOUP_EXCISION_REPORT_H

#include <array>
#include <cstddef>
#include <iomanip>
#include <locale>
#include <sstream>
#include <string>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Soup
/// whether a triangle of a soup is part of its mesh, or the reason why it is excised
enum class Excision_reason : unsigned char
{
  KEPT,           ///< the triangle is a facet of the mesh
  NO_AREA,        ///< its corners are collinear
  NON_MANIFOLD,   ///< an edge would have more than two facets, or a vertex several fans
  INTERSECTING,   ///< it intersects another triangle
  NOT_ORIENTABLE, ///< it cannot be oriented like its neighbors
  STEEP_BORDER,   ///< it is at a border vertex that no closing completes to a regular vertex
  SINGULAR_PIN,   ///< it is at a vertex that must not move, although its facets face no common direction
  FRAGMENT,       ///< it is in a small piece that excision separated from its component
  WRONG_SIDE,     ///< it is in a component that faces the wrong side of others, and cannot be reversed
  NOT_CLOSABLE,   ///< the virtual closing failed close to it
  NOT_CERTIFIED   ///< the certificate failed close to it
};
/// \ingroup PkgBsplineShell3Soup
/// number of values of `Excision_reason`
constexpr std::size_t number_of_excision_reasons = std::size_t(Excision_reason::NOT_CERTIFIED) + 1;

/// \ingroup PkgBsplineShell3Soup
/// returns the name that reports use
inline const char* name(Excision_reason reason)
{
  switch(reason) {
    case Excision_reason::KEPT: return "kept";
    case Excision_reason::NO_AREA: return "no area";
    case Excision_reason::NON_MANIFOLD: return "not manifold";
    case Excision_reason::INTERSECTING: return "intersecting";
    case Excision_reason::NOT_ORIENTABLE: return "not orientable";
    case Excision_reason::STEEP_BORDER: return "steep border";
    case Excision_reason::SINGULAR_PIN: return "singular pin";
    case Excision_reason::FRAGMENT: return "fragment";
    case Excision_reason::WRONG_SIDE: return "on the wrong side";
    case Excision_reason::NOT_CLOSABLE: return "not closable";
    case Excision_reason::NOT_CERTIFIED: return "not certified";
  }
  return "";
}

/// \ingroup PkgBsplineShell3Soup
/// the number of excised triangles of a soup, their area, and the reasons
struct Excision_report
{
  std::array<std::size_t, number_of_excision_reasons> triangles_with = {}; ///< by reason
  std::size_t triangles = 0;                                               ///< all different triangles of the soup
  std::size_t excised = 0;                                                 ///< triangles that are not in the mesh
  double excised_area = 0;                                                 ///< fraction of the total area
  std::size_t pinned_vertices = 0, pinned_edges = 0;
  std::size_t reversed = 0;   ///< facets of the mesh with the opposite orientation of their polygons
  std::size_t duplicates = 0; ///< triangles with the corners of another one, which represents them

  std::size_t number_of(Excision_reason reason) const { return triangles_with[std::size_t(reason)]; }
};

/// \ingroup PkgBsplineShell3Soup
/// returns a sentence with the number of excised triangles, their share of the area, and the reasons
inline std::string message(const Excision_report& report)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << report.excised << " of " << report.triangles << " triangles (" << std::setprecision(2)
       << 100 * report.excised_area << " % of the area) "
       << (report.excised == 1 ? "is excised, and stays exactly as it is"
                               : "are excised, and stay exactly as they are");
  const char* separator = ": ";
  for(std::size_t n = 1; n < number_of_excision_reasons; ++n)
    if(report.triangles_with[n] > 0) {
      text << separator << report.triangles_with[n] << ' ' << name(Excision_reason(n));
      separator = ", ";
    }
  text << '.';
  return text.str();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_EXCISION_REPORT_H
