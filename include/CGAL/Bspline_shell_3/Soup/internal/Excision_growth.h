// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_GROWTH_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_GROWTH_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Chooses the triangles that are excised at places where no shell was built: offending facets, and rings of facets
// around them. The first time, there are no rings. Each time that a place fails again, there is one more ring around
// the facets that fail then. Hence the distance from the place grows like the square of the number of failures. If it
// grows exponentially, holes become unnecessarily large.
class Excision_growth
{
  typedef Excised_soup_3::Mesh Mesh;
  typedef Mesh::Face_index Face_index;
public:
  // Returns the triangles of the offending facets and of the rings around them, ascending.
  std::vector<std::size_t> triangles_around(const Excised_soup_3& soup, const std::vector<Face_index>& offenders);

private:
  // Numbers of rings, with the facet itself as one; 0 for a facet that is not reached.
  struct Reach
  {
    std::size_t initial = 0;   // around the offending facet from which this one is reached
    std::size_t remaining = 0; // around this facet
  };

  // Returns the reach of an offending facet: one more than when its place failed before.
  std::size_t reach_of(const Excised_soup_3& soup, Face_index f) const;

  std::vector<Reach> reach_from(const Excised_soup_3& soup, const std::vector<Face_index>& offenders) const;

  std::vector<std::size_t> m_reach_at; // by point: the initial reach with which its triangles were excised
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/internal/Excision_growth_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_GROWTH_H
