// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/apply_truncation.h>
#include <CGAL/Bspline_shell_3/Mesh/attach_closing.h>
#include <CGAL/Bspline_shell_3/Mesh/check_embedding.h>
#include <CGAL/Bspline_shell_3/Mesh/check_orientation.h>
#include <CGAL/Bspline_shell_3/Mesh/replace_patches.h>
#include <CGAL/Bspline_shell_3/Mesh/validate_mesh.h>

#include <CGAL/FPU.h>

#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

template <typename ConcurrencyTag>
Shell_status Input_mesh_3::build(Mesh_with_origins mesh, const Tolerated_defects& tolerated,
                                 std::shared_ptr<const Shell_closing_3> closing,
                                 std::shared_ptr<const Shell_truncation_3> truncation)
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  Mesh_refusal& refusal = mesh.refusal;
  if(!refusal) refusal = internal::validate_mesh<ConcurrencyTag>(mesh, bool(closing));
  if(!refusal && closing) refusal = internal::attach_closing<ConcurrencyTag>(closing, mesh);
  Truncation_patches<Triangle_mesh> patches;
  if(!refusal && truncation) patches = find_patches(*truncation, mesh.mesh, mesh.mesh.points());
  const bool truncates = !patches.empty();
  if(!refusal && (truncates || !tolerated.self_intersections))
    refusal = internal::check_intersections<ConcurrencyTag>(mesh);
  if(!refusal && truncates) refusal = internal::apply_truncation<ConcurrencyTag>(truncation, patches, mesh);
  return take<ConcurrencyTag>(std::move(mesh), tolerated);
}

template <typename ConcurrencyTag>
Shell_status Input_mesh_3::take(Mesh_with_origins mesh, const Tolerated_defects& tolerated)
{
  *this = Input_mesh_3();
  Mesh_refusal& refusal = mesh.refusal;
  internal::Components components;
  if(!refusal) components = internal::find_components(mesh);
  if(!refusal && !tolerated.orientation)
    refusal = tolerated.self_intersections ? internal::check_volume(mesh, m_outwards)
                                           : internal::check_nesting<ConcurrencyTag>(mesh, components, m_outwards);
  if(!refusal && !tolerated.singular_vertices) refusal = internal::check_vertices<ConcurrencyTag>(mesh);
  if(refusal) {
    m_mesh.refusal = std::move(refusal);
    return status();
  }
  std::vector<char>().swap(mesh.is_embedded);
  m_mesh = std::move(mesh);
  m_component = std::move(components.of_facet);
  m_number_of_components = components.first_facet.size();
  return status();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_IMPL_H
