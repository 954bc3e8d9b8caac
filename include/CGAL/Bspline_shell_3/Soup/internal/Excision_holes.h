// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_HOLES_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_HOLES_H

#include <CGAL/Bspline_shell_3/Shell/Closing_report.h>
#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <array>
#include <map>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Holes that excision made in components that would be closed without them. A cap is far better for them than a back
// sheet, which would be a second surface within the whole component.
class Excision_holes
{
  typedef Excised_soup_3::Mesh Mesh;
public:
  explicit Excision_holes(const Excised_soup_3& soup);

  // Returns whether a point is a vertex at such a hole.
  bool contain(const std::array<double, 3>& point) const { return m_halfedge_at.count(point) > 0; }

  // Returns the facets at the vertices of such holes that have no cap.
  std::vector<Mesh::Face_index> facets_without_cap(const Closing_report& report) const;

private:
  const Mesh& m_mesh;
  std::map<std::array<double, 3>, Mesh::Halfedge_index> m_halfedge_at; // border halfedges, by their targets
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/internal/Excision_holes_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_HOLES_H
