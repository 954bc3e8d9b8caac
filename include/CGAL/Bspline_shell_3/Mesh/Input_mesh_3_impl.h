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
#include <CGAL/Bspline_shell_3/Mesh/validate_mesh.h>

#include <CGAL/FPU.h>

#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

template <typename ConcurrencyTag>
Shell_status Input_mesh_3::build(Mesh_refusal refusal, Mesh_with_origins mesh, const Tolerated_defects& tolerated,
                                 std::shared_ptr<const Shell_closing_3> closing,
                                 std::shared_ptr<const Shell_truncation_3> truncation)
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  std::vector<char> is_embedded;
  if(!refusal) refusal = internal::validate_mesh<ConcurrencyTag>(mesh, bool(closing));
  if(!refusal && closing) refusal = internal::attach_closing<ConcurrencyTag>(closing, mesh);
  const bool truncates = !refusal && truncation && internal::is_cut(mesh, *truncation);
  if(!refusal && (truncates || !tolerated.self_intersections))
    refusal = internal::check_intersections<ConcurrencyTag>(mesh, is_embedded);
  if(!refusal && truncates) {
    refusal = internal::apply_truncation<ConcurrencyTag>(truncation, mesh);
    is_embedded.clear();
  }
  return take<ConcurrencyTag>(std::move(refusal), std::move(mesh), is_embedded, tolerated);
}

template <typename ConcurrencyTag>
Shell_status Input_mesh_3::take(Mesh_refusal refusal, Mesh_with_origins mesh, const std::vector<char>& is_embedded,
                                const Tolerated_defects& tolerated)
{
  *this = Input_mesh_3();
  internal::Components components;
  if(!refusal) components = internal::find_components(mesh);
  if(!refusal && !tolerated.orientation)
    refusal = tolerated.self_intersections ? internal::check_volume(mesh, m_outwards)
                                           : internal::check_nesting<ConcurrencyTag>(mesh, components, m_outwards);
  if(!refusal && !tolerated.singular_vertices) refusal = internal::check_vertices<ConcurrencyTag>(mesh, is_embedded);
  m_refusal = std::move(refusal);
  if(m_refusal) return status();
  m_mesh = std::move(mesh);
  m_component = std::move(components.of_facet);
  m_number_of_components = components.first_facet.size();
  return status();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_IMPL_H
