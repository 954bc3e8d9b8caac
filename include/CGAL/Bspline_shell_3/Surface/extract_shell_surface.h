// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SURFACE_EXTRACT_SHELL_SURFACE_H
#define CGAL_BSPLINE_SHELL_3_SURFACE_EXTRACT_SHELL_SURFACE_H

#include <CGAL/Bspline_shell_3/Mesh/facet_crossing.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Surface/Level_set_status.h>
#include <CGAL/Bspline_shell_3/Surface/extract_level_set.h>
#include <CGAL/Bspline_shell_3/Surface/internal/Level_set_soup.h>
#include <CGAL/Bspline_shell_3/Surface/internal/Shell_cells.h>
#include <CGAL/Bspline_shell_3/Surface/internal/Soup_components.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/FPU.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/tags.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Returns the point where the field equals the threshold on a path along which their difference increases.
template <typename Field, typename Threshold>
std::array<double, 3> crossing_of_path(const Field& field, const Threshold& threshold, const Crossing_path& path)
{
  std::array<double, 3> low = path.source, high = path.target, middle = low;
  constexpr int steps = 60;
  for(int n = 0; n < steps; ++n) {
    for(int a = 0; a < 3; ++a) middle[a] = low[a] + (high[a] - low[a]) / 2;
    const typename Field::Point_3 p(middle[0], middle[1], middle[2]);
    (*field.value(p) < threshold.value(p) ? low : high) = middle;
  }
  return middle;
}

// Keeps the components of a soup that paths cross from behind: each path at the triangle closest to the point where it
// crosses the threshold. Returns `false` if a path crosses no component, or if two paths cross the same component.
template <typename Field, typename Threshold>
bool keep_components_on_paths(const Field& field, const Threshold& threshold, const std::vector<Crossing_path>& paths,
                              std::vector<Soup_components::Point>& points,
                              std::vector<Soup_components::Triangle>& triangles)
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  struct Box : Box_intersection_d::Box_d<double, 3>
  {
    Box(const Bbox_3& b, std::size_t n) : Box_intersection_d::Box_d<double, 3>(b), number(n) {}
    std::size_t number;
  };
  struct Passed
  {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t triangle = 0;
  };
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  const auto point = [](const std::array<double, 3>& p) { return Point_3(p[0], p[1], p[2]); };
  const auto corners = [&](std::size_t n) {
    const Soup_components::Triangle& t = triangles[n];
    return std::array<Point_3, 3>{ point(points[t[0]]), point(points[t[1]]), point(points[t[2]]) };
  };
  // Triangles are not exactly on the threshold and may be beyond the ends of a path, so paths are made three times as
  // long.
  std::vector<std::array<Point_3, 2> > lines;
  std::vector<Point_3> crossings;
  std::vector<Box> segments, boxes;
  Bbox_3 all;
  for(const Crossing_path& path : paths) {
    const Point_3 p = point(path.source), q = point(path.target);
    lines.push_back({ p - (q - p), q + (q - p) });
    crossings.push_back(point(crossing_of_path(field, threshold, path)));
    segments.emplace_back(lines.back()[0].bbox() + lines.back()[1].bbox(), segments.size());
    all += segments.back().bbox();
  }
  for(std::size_t n = 0; n < triangles.size(); ++n) {
    const std::array<Point_3, 3> t = corners(n);
    const Bbox_3 box = t[0].bbox() + t[1].bbox() + t[2].bbox();
    if(do_overlap(box, all)) boxes.emplace_back(box, n);
  }
  std::vector<Passed> passed(paths.size());
  CGAL::box_intersection_d(
    segments.begin(), segments.end(), boxes.begin(), boxes.end(), [&](const Box& s, const Box& b) {
      const std::array<Point_3, 3> t = corners(b.number);
      const std::array<Point_3, 2>& line = lines[s.number];
      const std::optional<int> crossing = facet_crossing(line[0], line[1], t[0], t[1], t[2]);
      if(crossing && *crossing != 1) return;
      const auto normal = CGAL::normal(t[0], t[1], t[2]);
      const double distance = std::abs(normal * (t[0] - crossings[s.number]) / (normal * (line[1] - line[0])));
      Passed& best = passed[s.number];
      if(distance < best.distance || (distance == best.distance && b.number < best.triangle))
        best = { distance, b.number };
    });

  Soup_components components(points.size(), triangles);
  std::vector<char> is_kept(points.size(), 0);
  for(const Passed& p : passed) {
    if(!(p.distance < std::numeric_limits<double>::infinity())) return false;
    char& is_known = is_kept[components.component(triangles[p.triangle][0])];
    if(is_known) return false;
    is_known = 1;
  }
  components.keep(is_kept, points, triangles);
  return true;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Surface
 *
 * \brief extracts a triangle mesh of the inner or the outer surface of a shell, like `extract_level_set()` for a level
 * set.
 *
 * Where thresholds vary, other parts of the level set may pass through the same cells; they are excluded by the cover
 * and the paths with which the shell was certified. The mesh is closed and 2-manifold, and has one component for each
 * component of the shell. Cells are split where this is necessary to separate parts of the level set.
 *
 * If the shell has a cover (`Bspline_shell_3::proved_cover()`) but is not certified, the mesh contains all parts of the
 * level set in the cover. Without a cover, it contains the closed parts in `Bspline_shell_3::shell_cells()`; if
 * thresholds are constant, all parts there must be closed.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Field a model of `BsplineField_3`
 * \tparam Threshold a model of `ShellThreshold`
 * \tparam TriangleMesh a model of `MutableFaceGraph`
 * \tparam NamedParameters a sequence of \ref BsplineShell3NamedParameters "named parameters"
 *
 * \param shell the shell
 * \param threshold `Bspline_shell_3::inner_threshold()`, `Bspline_shell_3::outer_threshold()`, or a threshold between
 *   these
 * \param out the mesh to which the surface is added; unchanged if there is nothing to add
 * \param np optional named parameters:
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{subdivision_ratio}
 *       \cgalParamDescription{number of subcells along each axis of a cell. If the shell is certified, the number is
 *         doubled, up to 16, until the surfaces of all components are separated. Handles thinner than subcells may be
 *         missing or superfluous; if the genus matters, choose a larger ratio.}
 *       \cgalParamType{`int`}
 *       \cgalParamDefault{2}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{vertex_point_map}
 *       \cgalParamDescription{a property map from the vertices of `out` to their points}
 *       \cgalParamDefault{`get(CGAL::vertex_point, out)`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 *
 * \return `SUCCESS`, or the reason why there is no mesh
 * \pre there is a shell; `subdivision_ratio` is at least 1 and at most 256
 * \cgalHeading{Cost} That of `extract_level_set()`, and of `CGAL::box_intersection_d()` for components and triangles.
 */
template <typename ConcurrencyTag = Sequential_tag, typename Field, typename Threshold, typename TriangleMesh,
          typename CGAL_NP_TEMPLATE_PARAMETERS>
Level_set_status extract_shell_surface(const Bspline_shell_3<Field, Threshold>& shell, const Threshold& threshold,
                                       TriangleMesh& out, const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  typedef internal::Shell_cells<Field, Threshold> Cells;
  typedef internal::Level_set_soup<Cells> Soup;

  auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point), get_property_map(vertex_point, out));
  const int ratio = choose_parameter(get_parameter(np, internal_np::subdivision_ratio), 2);
  CGAL_precondition(bool(shell));
  CGAL_precondition(ratio >= 1 && ratio <= 256);
  if(!shell.proved_cover()) {
    const auto is_in_shell = [&](typename Field::Cell_index c) { return shell.shell_cells()[c] != 0; };
    return extract_level_set<ConcurrencyTag>(shell.field(), threshold, out,
                                             parameters::filter(is_in_shell)
                                               .skip_open_components(!Threshold::is_constant)
                                               .subdivision_ratio(ratio)
                                               .vertex_point_map(vpm));
  }
  const Cells cells(shell.field(), threshold, *shell.proved_cover());
  const auto is_selected = [&](typename Cells::Index c) { return cells.is_selected(c); };
  std::vector<typename Soup::Point> points;
  std::vector<typename Soup::Triangle> triangles;
  // Bound on the subcells of cells with the surface. More of them would take more memory and time than the shell.
  constexpr double most_subcells = 1 << 28;
  constexpr int finest = 16;
  double selected = 0;
  for(std::size_t c = 0; c < cells.number_of_cells(); ++c) selected += is_selected(typename Cells::Index(c));
  for(int n = ratio;; n *= 2) {
    const Level_set_status status = Soup::template extract<ConcurrencyTag>(cells, n, is_selected, false, points,
                                                                           triangles);
    if(status == Level_set_status::LEVEL_SET_LEAVES_CELLS) return status;
    const bool is_found = status == Level_set_status::SUCCESS;
    if(is_found
       && (!shell.is_certified()
           || internal::keep_components_on_paths(shell.field(), threshold, shell.report().certificate.paths, points,
                                                 triangles)))
      break;
    if(2 * n > finest || selected * std::pow(2 * n, 3) > most_subcells)
      return is_found ? Level_set_status::LEVEL_SET_UNRESOLVED : status;
  }
  Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, out, CGAL::parameters::default_values(),
                                                        CGAL::parameters::vertex_point_map(vpm));
  return Level_set_status::SUCCESS;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SURFACE_EXTRACT_SHELL_SURFACE_H
