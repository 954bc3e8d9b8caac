// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_VERTICES_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_VERTICES_H

#include <CGAL/Bspline_shell_3/Certificate/internal/Certificate_draft.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Finds the smallest cone margin and the singular vertices.
template <typename ConcurrencyTag>
void examine_vertices(const Input_mesh_3& input, Certificate_draft& draft)
{
  typedef Input_mesh_3::Triangle_mesh Triangle_mesh;
  const Triangle_mesh& mesh = input.mesh();
  constexpr std::size_t chunk = 256;
  const std::vector<Triangle_mesh::Vertex_index> vertices(mesh.vertices().begin(), mesh.vertices().end());
  struct Result
  {
    double least_margin = 1;
    std::vector<std::size_t> singular;
  };
  std::vector<Result> results((vertices.size() + chunk - 1) / chunk);
  for_each_chunk<ConcurrencyTag>(vertices.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Result& result = results[begin / chunk];
    for(std::size_t n = begin; n < end; ++n) {
      if(mesh.is_isolated(vertices[n])) continue;
      const std::optional<double> margin = bounded_vertex_cone_margin(mesh, vertices[n], result.least_margin);
      if(margin) result.least_margin = *margin; // existence is decided exactly, unlike the value
      else result.singular.push_back(input.vertex_of_origin(vertices[n]));
    }
  });
  draft.least_cone_margin = 1;
  for(const Result& result : results) {
    draft.least_cone_margin = (std::min)(draft.least_cone_margin, result.least_margin);
    draft.singular_vertices.insert(draft.singular_vertices.end(), result.singular.begin(), result.singular.end());
  }
  std::sort(draft.singular_vertices.begin(), draft.singular_vertices.end());
  if(!draft.singular_vertices.empty()) draft.least_cone_margin = 0;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_VERTICES_H
