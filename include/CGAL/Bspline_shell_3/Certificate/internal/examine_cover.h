// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_COVER_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_COVER_H

#include <CGAL/Bspline_shell_3/Certificate/Shell_cover_3.h>
#include <CGAL/Bspline_shell_3/Certificate/critical_point.h>
#include <CGAL/Bspline_shell_3/Certificate/displacement_bounds.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Certificate_draft.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Examined_shell.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>
#include <CGAL/Bspline_shell_3/Spline/monotone_direction.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The vertex of each component of a mesh from which the flood fill of the cover starts.
typedef std::vector<Input_mesh_3::Triangle_mesh::Vertex_index> Seeds;

inline Seeds find_seeds(const Input_mesh_3& input)
{
  typedef Input_mesh_3::Triangle_mesh Triangle_mesh;
  const Triangle_mesh& mesh = input.mesh();
  Seeds seeds(input.number_of_components(), Triangle_mesh::null_vertex());
  for(Triangle_mesh::Face_index f : mesh.faces())
    if(seeds[input.component(f)] == Triangle_mesh::null_vertex())
      seeds[input.component(f)] = mesh.target(mesh.halfedge(f));
  return seeds;
}

// The cover of a certified shell, and quantities that were proved with it.
struct Proved_cover
{
  std::shared_ptr<const std::vector<Cover_box> > boxes; // null if the shell is not certified
  std::size_t components = 0;
  double least_gradient = 0, largest_gradient = std::numeric_limits<double>::infinity();
};

// Returns an upper bound on the length of the gradient on a leaf cell, from differences of coefficients.
template <typename Field>
double largest_gradient(const Field& field, typename Field::Cell_index c)
{
  const typename Field::Cell cell = field.cell(c);
  const std::array<Level_range, 3> differences = difference_ranges(cell.coefficients());
  std::array<double, 3> greatest;
  for(std::size_t a = 0; a < 3; ++a)
    greatest[a] = 3 * ((std::max)(0., differences[a].largest_size()) + 2 * cell.error_radius());
  return length_bound(greatest) / cell.width() * (1 + 16 * rounding) + std::numeric_limits<double>::denorm_min();
}

// Adopts the proved cover if there is one and it contains all components of the mesh. Returns the components of the
// mesh that share a component of the cover with an earlier component.
template <typename Field, typename Threshold>
std::optional<std::vector<typename Shell_cover_3<Field, Threshold>::Shared> > adopt_proved_cover(
  const Examined_shell<Field, Threshold>& shell, const Input_mesh_3::Triangle_mesh& mesh, const Seeds& seeds,
  const Proved_cover& proved, std::optional<Shell_cover_3<Field, Threshold> >& cover)
{
  typedef typename Field::Point_3 Point_3;
  if(!proved.boxes) return std::nullopt;
  std::vector<Point_3> points;
  for(auto v : seeds) points.push_back(converted<Point_3>(mesh.point(v)));
  cover.emplace(shell.field, shell.inner, shell.outer);
  return cover->adopt(*proved.boxes, points);
}

// Floods a cover from all components of the mesh. Returns the components of the mesh that share a component of the
// cover with an earlier component.
template <typename ConcurrencyTag, typename Field, typename Threshold>
std::vector<typename Shell_cover_3<Field, Threshold>::Shared> flood_cover(const Input_mesh_3& input, const Seeds& seeds,
                                                                          Shell_cover_3<Field, Threshold>& cover)
{
  typedef typename Field::Point_3 Point_3;
  const Input_mesh_3::Triangle_mesh& mesh = input.mesh();
  // The cells at the mesh are needed in any case.
  std::vector<std::uint32_t> cells;
  for(auto f : mesh.faces())
    cells.push_back(cover.field().locate(converted<Point_3>(mesh.point(mesh.target(mesh.halfedge(f))))));
  cover.template prepare<ConcurrencyTag>(std::move(cells));
  std::vector<typename Shell_cover_3<Field, Threshold>::Shared> shared;
  for(std::size_t c = 0; c < input.number_of_components(); ++c) {
    const Point_3 seed = converted<Point_3>(mesh.point(seeds[c]));
    const std::uint32_t known = cover.template flood<ConcurrencyTag>(seed, std::uint32_t(c));
    if(known != c) shared.push_back({ known, c });
  }
  return shared;
}

// Calls visit(p) for points of the facets, about half a cell apart, until it returns false.
template <typename Field, typename Visit>
void visit_points_of_facets(const Input_mesh_3::Triangle_mesh& mesh, const Field& field, const Visit& visit)
{
  typedef Input_mesh_3::Triangle_mesh::Point Point;
  typedef std::array<Point, 3> Triangle;
  constexpr double size = 0.5; // of a part of a facet, in widths of the cell at its center
  std::vector<Triangle> parts;
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    parts.assign(1, { mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))) });
    while(!parts.empty()) {
      const Triangle t = parts.back();
      parts.pop_back();
      const auto center = converted<typename Field::Point_3>(CGAL::centroid(t[0], t[1], t[2]));
      const auto cell = field.locate(center);
      if(cell == Field::npos) continue;
      const auto squared_length = [&](std::size_t i) { return CGAL::squared_distance(t[i], t[(i + 1) % 3]); };
      std::size_t i = 0; // the longest edge
      for(std::size_t k = 1; k < 3; ++k)
        if(squared_length(k) > squared_length(i)) i = k;
      if(std::sqrt(squared_length(i)) <= size * field.cell(cell).width()) {
        if(!visit(center)) return;
        continue;
      }
      const Point &a = t[i], &b = t[(i + 1) % 3], &c = t[(i + 2) % 3], middle = CGAL::midpoint(a, b);
      parts.push_back({ a, middle, c });
      parts.push_back({ middle, b, c });
    }
  }
}

// Computes the cover. Returns the components of the mesh that share a component of the cover with an earlier component.
template <typename ConcurrencyTag, typename Field, typename Threshold>
std::vector<typename Shell_cover_3<Field, Threshold>::Shared> find_cover(
  const Examined_shell<Field, Threshold>& shell, const Input_mesh_3& input, const Seeds& seeds,
  std::optional<Shell_cover_3<Field, Threshold> >& cover)
{
  // A cover that does not separate the sides of walls has far fewer boxes. It suffices for most meshes, because the
  // mesh is on both sides.
  constexpr int no_separation = 0;
  cover.emplace(shell.field, shell.inner, shell.outer, no_separation);
  const auto shared = flood_cover<ConcurrencyTag>(input, seeds, *cover);
  if(shared.empty() && cover->number_of_undecided_boxes() == 0
     && cover->are_monotone_boxes_connected_to(
       [&](const auto& visit) { visit_points_of_facets(input.mesh(), shell.field, visit); }))
    return shared;
  cover.emplace(shell.field, shell.inner, shell.outer);
  return flood_cover<ConcurrencyTag>(input, seeds, *cover);
}

// Returns whether an undecided box is proved to contain a critical point in the shell: between the thresholds, and
// joined to a vertex of the mesh by a segment between them.
template <typename Field, typename Threshold>
bool is_critical(const Examined_shell<Field, Threshold>& shell, const Shell_cover_3<Field, Threshold>& cover,
                 const Input_mesh_3::Triangle_mesh& mesh, const Cover_box& box, std::array<double, 3>& point)
{
  typedef typename Field::Point_3 Point_3;
  typedef Input_mesh_3::Triangle_mesh Triangle_mesh;
  const Enclosed_tricubic f = cover.function(box);
  const std::optional<Critical_point> critical = prove_critical_point(f);
  if(!critical) return false;
  const Bbox_3 b = cover.bbox(box);
  const double width = b.xmax() - b.xmin();
  for(int a = 0; a < 3; ++a) point[a] = (b.min)(a) + critical->center[a] * width;
  // The whole box must be between the thresholds, because the critical point may be anywhere in it.
  if(!cover.is_between_thresholds(box)) return false;
  const Triangle_mesh::Point p(point[0], point[1], point[2]);
  Triangle_mesh::Point nearest = p;
  double least = std::numeric_limits<double>::infinity();
  for(auto v : mesh.vertices()) {
    const double d = CGAL::squared_distance(p, mesh.point(v));
    if(d < least) {
      least = d;
      nearest = mesh.point(v);
    }
  }
  return shell.contains(converted<Point_3>(p), converted<Point_3>(nearest));
}

inline constexpr std::size_t max_examined_boxes = 64; // undecided boxes that are searched for a critical point

// Examines P3, given P1: the mesh's components stay in the components of their seeds. Returns the components of the
// mesh that share a component of the cover.
template <typename ConcurrencyTag, typename Field, typename Threshold>
std::vector<typename Shell_cover_3<Field, Threshold>::Shared> examine_cover(
  const Examined_shell<Field, Threshold>& shell, const Input_mesh_3& input, const Seeds& seeds,
  const Proved_cover& proved, double least_slope, std::optional<Shell_cover_3<Field, Threshold> >& found_cover,
  Certificate_draft& draft)
{
  typedef Shell_cover_3<Field, Threshold> Cover;
  typedef typename Cover::Shared Shared;
  const Input_mesh_3::Triangle_mesh& mesh = input.mesh();
  const std::optional<std::vector<Shared> > known = adopt_proved_cover(shell, mesh, seeds, proved, found_cover);
  const std::vector<Shared> shared = known ? *known : find_cover<ConcurrencyTag>(shell, input, seeds, found_cover);
  const Cover& cover = *found_cover;
  draft.begin(Claim::GRADIENT);
  draft.covers = input.number_of_components() - shared.size();

  Level_range thresholds;
  const bool is_greatest_known = known && draft.covers == proved.components
                                 && proved.largest_gradient < std::numeric_limits<double>::infinity();
  double greatest = is_greatest_known ? proved.largest_gradient : 0;
  std::uint32_t last_cell = std::uint32_t(-1);
  std::size_t examined = 0;
  for(const Cover_box& box : cover.boxes()) {
    draft.statistics.deepest_box = (std::max)(draft.statistics.deepest_box, std::size_t(box.depth));
    if(box.kind == Box_kind::EXCLUDED) ++draft.statistics.excluded_boxes;
    if(box.component == Cover_box::no_component) continue;
    ++draft.statistics.cover_boxes;
    if(box.cell != last_cell) {
      last_cell = box.cell;
      thresholds.include(threshold_range(shell.inner, shell.outer, box.cell));
      if(!is_greatest_known) greatest = (std::max)(greatest, largest_gradient(shell.field, box.cell));
    }
    if(box.kind == Box_kind::MONOTONE) {
      ++draft.statistics.monotone_boxes;
      continue;
    }
    if(box.kind != Box_kind::UNDECIDED) {
      ++draft.statistics.critical_boxes;
      continue;
    }
    ++draft.statistics.undecided_boxes;
    Run::poll();
    const Bbox_3 b = cover.bbox(box);
    std::array<double, 3> center = { (b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2 };
    const bool critical = examined < max_examined_boxes && is_critical(shell, cover, mesh, box, center);
    ++examined;
    Certificate_witness w = witness(Claim::GRADIENT, critical ? Verdict::REFUTED : Verdict::UNDECIDED,
                                    critical ? Certificate_witness::CRITICAL_POINT : Certificate_witness::BOX);
    w.cell = box.cell;
    w.point = center;
    draft.conclude(w);
  }
  for(std::size_t b : cover.at_end()) {
    Certificate_witness w = witness(Claim::GRADIENT, Verdict::UNDECIDED, Certificate_witness::BOUNDARY_OF_DOMAIN);
    w.cell = cover.boxes()[b].cell;
    const Bbox_3 box = cover.bbox(cover.boxes()[b]);
    w.point = { (box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2 };
    draft.conclude(w);
  }
  draft.statistics.cover_cells = cover.number_of_cells();
  draft.largest_gradient = greatest;
  if(draft.verdict(Claim::TRANSVERSALITY) == Verdict::PROVED)
    draft.least_angle = std::asin((std::min)(1., least_slope / greatest)) * (1 - 8 * rounding);
  if(draft.verdict(Claim::GRADIENT) == Verdict::PROVED)
    draft.least_gradient = known && proved.least_gradient > 0 ? proved.least_gradient
                                                              : cover.template least_gradient<ConcurrencyTag>();
  if(draft.least_gradient > 0) draft.displacement_bound = longest_curve(thresholds, draft.least_gradient);
  return shared;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_COVER_H
