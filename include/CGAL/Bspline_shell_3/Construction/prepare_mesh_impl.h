// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_PREPARE_MESH_IMPL_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_PREPARE_MESH_IMPL_H

#include <CGAL/Bspline_shell_3/Closing/close_virtually.h>
#include <CGAL/Bspline_shell_3/Construction/prepare_mesh.h>
#include <CGAL/Bspline_shell_3/Mesh/apply_truncation.h>
#include <CGAL/Bspline_shell_3/Mesh/attach_closing.h>
#include <CGAL/Bspline_shell_3/Mesh/check_embedding.h>
#include <CGAL/Bspline_shell_3/Mesh/replace_patches.h>
#include <CGAL/Bspline_shell_3/Mesh/validate_mesh.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>
#include <CGAL/Bspline_shell_3/Truncation/truncate_mesh.h>

#include <CGAL/FPU.h>
#include <CGAL/boost/graph/helpers.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

template <typename ConcurrencyTag>
Input_mesh_3 prepare_mesh(Mesh_with_origins mesh, const Input_mesh_3::Tolerated_defects& tolerated,
                          const Certified_shell_parameters& parameters, Shell_report& report)
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  Mesh_refusal& refusal = mesh.refusal;
  std::shared_ptr<const Shell_closing_3> closing = parameters.closing;
  if(!refusal) refusal = internal::validate_mesh<ConcurrencyTag>(mesh, closing || parameters.closes_virtually);
  if(!refusal && !closing && !CGAL::is_closed(mesh.mesh)) {
    const double offset = parameters.closing_offset(mesh.unit());
    Virtual_closing found = close_virtually<ConcurrencyTag>(mesh.mesh, offset, report.closing,
                                                            parameters.hole_requires_cap);
    // A cap may have been removed because it intersects a back sheet.
    for(const Closing_report::Hole& hole : report.closing.holes)
      if(!hole.is_capped && parameters.hole_requires_cap && parameters.hole_requires_cap(hole.point)) {
        found.status = Shell_status::NOT_CLOSABLE;
        found.closing.reset();
      }
    closing = found.closing;
    refusal.status = found.status;
    std::vector<std::size_t>& facets = refusal.offending_simplices.facets;
    for(auto f : found.offending_facets) facets.push_back(mesh.facet_origin[f]);
    sort_unique(facets);
  }
  if(!refusal && closing) refusal = internal::attach_closing<ConcurrencyTag>(closing, mesh);
  if(!refusal && !tolerated.self_intersections) refusal = internal::check_intersections<ConcurrencyTag>(mesh);
  if(!refusal && !tolerated.self_intersections && parameters.truncates) {
    const double thickness = parameters.largest_thickness(mesh.unit());
    const auto largest_radius = [&](const std::array<double, 3>& p) {
      const double here = parameters.sizing ? parameters.sizing(Certified_bspline_shell_3::Point_3(p[0], p[1], p[2]))
                                            : thickness;
      return here > 0 ? here : thickness; // the distance by which points may also move along curves
    };
    const auto truncation = truncate_mesh<ConcurrencyTag>(mesh, largest_radius, parameters.least_cone_margin,
                                                          report.truncation);
    if(truncation) {
      const auto patches = find_patches(*truncation, mesh.mesh, mesh.mesh.points());
      refusal = internal::apply_truncation<ConcurrencyTag>(truncation, patches, mesh);
    }
  }
  Input_mesh_3 input;
  input.take<ConcurrencyTag>(std::move(mesh), tolerated);
  return input;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_PREPARE_MESH_IMPL_H
