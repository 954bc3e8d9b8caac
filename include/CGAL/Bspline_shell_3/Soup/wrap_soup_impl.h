// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_WRAP_SOUP_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_WRAP_SOUP_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Soup/wrap_soup.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Real_timer.h>
#include <CGAL/alpha_wrap_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Ends a wrap when its run ends. The exception passes through CGAL, whose objects for the wrap are local to
// `alpha_wrap_3()`.
struct Polling_wrap_visitor : Alpha_wraps_3::internal::Wrapping_default_visitor
{
  template <typename Wrapper, typename Gate>
  void before_facet_treatment(const Wrapper&, const Gate&)
  {
    Run::poll();
  }
};

} // namespace internal

template <typename ConcurrencyTag>
Shell_status wrap_soup(const Soup_mesh_3& soup, double alpha, double offset, double max_bytes, Soup_mesh_3::Mesh& wrap,
                       Proxy_report& report)
{
  typedef Soup_mesh_3::Mesh Mesh;
  if(soup.mesh().number_of_faces() == 0) return Shell_status::EMPTY_MESH;
  const Bbox_3 box = Polygon_mesh_processing::bbox(soup.mesh());
  double largest = 0, unit = 0;
  for(int a = 0; a < 3; ++a) {
    largest = (std::max)({ largest, std::abs((box.min)(a)), std::abs((box.max)(a)) });
    unit = (std::max)(unit, (box.max)(a) - (box.min)(a));
  }
  // Points at the offset are computed to 1/100 of the offset, by constructions with several rounding errors.
  constexpr double precision = 1e-10, bytes_per_facet = 2000, facets_per_ball = 8;
  if(!(offset > precision * largest)) return Shell_status::GRID_TOO_FINE;
  // The area of the wrap is at most about that of both sides of the soup, and at most that of a foam with bubbles of
  // size `alpha`.
  const double area = (std::min)(2 * Polygon_mesh_processing::area(soup.mesh()), unit * unit * (6 + unit / alpha));
  if(area / (alpha * alpha) * facets_per_ball * bytes_per_facet > max_bytes) return Shell_status::MEMORY_LIMIT_EXCEEDED;
  Real_timer timer;
  timer.start();
  Polygon_soup::Points points;
  std::vector<std::array<std::size_t, 3> > triangles;
  for(Mesh::Vertex_index v : soup.mesh().vertices()) points.push_back(soup.mesh().point(v));
  for(Mesh::Face_index f : soup.mesh().faces()) {
    const auto h = soup.mesh().halfedge(f);
    triangles.push_back({ std::size_t(soup.mesh().source(h)), std::size_t(soup.mesh().target(h)),
                          std::size_t(soup.mesh().target(soup.mesh().next(h))) });
  }
  constexpr std::size_t most = 8;
  constexpr double coarser = 1.25;
  Shell_status status = Shell_status::SINGULAR_VERTEX;
  for(report.wraps = 0; report.wraps < most && status == Shell_status::SINGULAR_VERTEX; ++report.wraps) {
    if(report.wraps > 0) {
      alpha *= coarser;
      offset *= coarser;
    }
    wrap.clear();
    CGAL::alpha_wrap_3(points, triangles, alpha, offset, wrap, CGAL::parameters::default_values(),
                       CGAL::parameters::visitor(internal::Polling_wrap_visitor()));
    wrap.collect_garbage();
    status = Input_mesh_3().template build<ConcurrencyTag>(wrap, get(vertex_point, static_cast<const Mesh&>(wrap)),
                                                           Input_mesh_3::Tolerated_defects());
  }
  report.alpha = alpha;
  report.offset = offset;
  report.wrap_seconds = timer.time();
  return status;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_WRAP_SOUP_IMPL_H
