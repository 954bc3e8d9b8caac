// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_FACETS_TO_EXCISE_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_FACETS_TO_EXCISE_H

#include <CGAL/Bspline_shell_3/Shell/Refinement_obstacle.h>
#include <CGAL/Bspline_shell_3/Shell/Truncation_report.h>
#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the facets closest to the places where the proof of a shell failed.
std::vector<Excised_soup_3::Mesh::Face_index> facets_at_obstacles(const Excised_soup_3::Mesh& mesh,
                                                                  const std::vector<Refinement_obstacle>& obstacles);

// Returns the truncated vertices of a mesh.
std::vector<Excised_soup_3::Mesh::Vertex_index> truncated_vertices(const Truncation_report& report);

// Returns the facets of components that have to be reversed: those of the listed facets or, if these have more than
// half of the area, all others.
std::vector<Excised_soup_3::Mesh::Face_index> facets_on_wrong_side(const Excised_soup_3& soup,
                                                                   const std::vector<std::size_t>& listed);

// Returns the facets that have a point in common with any of these triangles.
std::vector<Excised_soup_3::Mesh::Face_index> facets_beside(const Excised_soup_3& soup,
                                                            const std::vector<std::size_t>& triangles);

// Returns the area of the facets of a mesh that share no edge with another facet, as a fraction of its area.
double share_of_isolated_facets(const Excised_soup_3::Mesh& mesh);

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/internal/facets_to_excise_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_FACETS_TO_EXCISE_H
