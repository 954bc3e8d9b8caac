// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_UNITE_PARTS_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_UNITE_PARTS_IMPL_H

#include <CGAL/Bspline_shell_3/Soup/internal/Rounded_union.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Solid_finder.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Visibility.h>
#include <CGAL/Bspline_shell_3/Soup/internal/exact_union.h>
#include <CGAL/Bspline_shell_3/Soup/unite_parts.h>

#include <CGAL/FPU.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Real_timer.h>

#include <cstddef>
#include <tuple>

namespace CGAL {
namespace Bspline_shells {

template <typename ConcurrencyTag>
Unite_report unite_parts(const United_mesh::Mesh& mesh, United_mesh& united)
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  Real_timer timer;
  timer.start();
  const internal::Solids solids = internal::Solid_finder().template find<ConcurrencyTag>(mesh);
  Unite_report report = solids.report;
  internal::Exact_mesh exact;
  internal::sources_of(exact);
  if(report && solids.number_of_colors > 0) report.status = internal::exact_union(mesh, solids, exact);
  if(report && solids.number_of_colors > 0) {
    report.offending_facets = internal::Visibility(mesh, solids).hidden_sources(exact);
    if(!report.offending_facets.empty()) report.status = Unite_status::NOT_COMPUTED;
  }
  if(report) {
    internal::Rounded_union rounded(mesh, solids, exact, united);
    std::tie(report.status, report.offending_facets) = rounded.template compute<ConcurrencyTag>();
  }
  if(report) {
    double area = 0, hidden = 0;
    std::size_t n = 0;
    for(auto f : mesh.faces()) {
      const double share = united.hidden_share[n++], of_facet = Polygon_mesh_processing::face_area(f, mesh);
      area += of_facet;
      hidden += share * of_facet;
      if(share == 1) ++report.hidden_facets;
      else if(share > 0) ++report.partly_hidden_facets;
    }
    report.hidden_area = hidden / area;
  }
  report.seconds = timer.time();
  return report;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_UNITE_PARTS_IMPL_H
