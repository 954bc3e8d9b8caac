// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_TRUNCATION_REPORT_H
#define CGAL_BSPLINE_SHELL_3_SHELL_TRUNCATION_REPORT_H

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief a report on where a mesh was truncated, and where truncation was required but impossible. Lengths are in the
 * units of the coordinates.
 */
struct Truncation_report
{
  /// the outcome at a vertex with a small cone margin
  enum class Outcome : unsigned char
  {
    TRUNCATED,
    ON_BORDER,   ///< not truncated: the vertex is on the border of an open mesh
    FOLDED_EDGE, ///< not truncated: two facets at an edge have nearly opposite normals, so no disc helps
    NO_DISC,     ///< not truncated: no disc was found that improves the cone margin
    NO_SPACE     ///< not truncated: other parts of the mesh are so close, or edges so short, that rounding would decide
  };

  struct Vertex
  {
    std::size_t vertex = 0;           ///< position in `vertices(mesh)`
    std::array<double, 3> point = {}; ///< position of the vertex
    Outcome outcome = Outcome::TRUNCATED;
    double radius = 0;         ///< radius of the ball around the vertex outside which nothing was changed
    double margin_before = 0;  ///< `vertex_cone_margin()`
    double margin_after = 0;   ///< smallest cone margin of the vertices of the disc
    std::size_t triangles = 0; ///< number of triangles of the disc
  };

  std::vector<Vertex> vertices; ///< all vertices whose cone margin is smaller than requested

  std::size_t number(Outcome outcome) const
  {
    std::size_t n = 0;
    for(const Vertex& v : vertices) n += v.outcome == outcome ? 1 : 0;
    return n;
  }
  /// returns the number of truncated vertices
  std::size_t truncated() const { return number(Outcome::TRUNCATED); }
};

/// \ingroup PkgBsplineShell3Shell
/// returns the outcome as one word
inline const char* name(Truncation_report::Outcome outcome)
{
  switch(outcome) {
    case Truncation_report::Outcome::TRUNCATED: return "truncated";
    case Truncation_report::Outcome::ON_BORDER: return "on_border";
    case Truncation_report::Outcome::FOLDED_EDGE: return "folded_edge";
    case Truncation_report::Outcome::NO_DISC: return "no_disc";
    case Truncation_report::Outcome::NO_SPACE: return "no_space";
  }
  return "";
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_TRUNCATION_REPORT_H
