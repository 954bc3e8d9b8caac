// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_PATHS_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_PATHS_H

#include <CGAL/Bspline_shell_3/Certificate/internal/Certificate_draft.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Examined_shell.h>
#include <CGAL/Bspline_shell_3/Certificate/segment_through_shell.h>
#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Kernel/global_functions_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

inline constexpr std::size_t max_paths = 64; // paths tried for a component
// Barycentric coordinates of the points at which paths pass through facets: the first point for all facets, then the
// next.
inline constexpr std::array<std::array<double, 3>, 4> path_points = {
  { { 1, 1, 1 }, { 2, 1, 1 }, { 1, 2, 1 }, { 1, 1, 2 } }
};
inline constexpr std::size_t max_spare_paths = 3; // per component

// Returns the facets of a component through which paths are tried. Large facets, whose middles are far from edges,
// alternate with facets from all parts of the component. The largest facets of a symmetric mesh may be copies of each
// other, and may all lie at creases, where gradients turn too fast for a straight path.
inline std::vector<Input_mesh_3::Triangle_mesh::Face_index> path_facets(
  std::vector<std::pair<double, Input_mesh_3::Triangle_mesh::Face_index> >& facets)
{
  typedef Input_mesh_3::Triangle_mesh::Face_index Face_index;
  constexpr std::size_t half = max_paths / 2;
  std::vector<Face_index> spread, candidates;
  if(facets.size() > max_paths)
    for(std::size_t n = 0; n < half; ++n) spread.push_back(facets[n * (facets.size() / half)].second);
  const std::size_t largest = (std::min)(max_paths, facets.size()) - spread.size();
  std::partial_sort(facets.begin(), facets.begin() + std::ptrdiff_t(largest), facets.end());
  for(std::size_t n = 0; n < largest; ++n) {
    candidates.push_back(facets[n].second);
    if(n < spread.size()) candidates.push_back(spread[n]);
  }
  return candidates;
}

// Tries a segment through a facet, along the gradient at the point with the given barycentric coordinates. The count
// proves or refutes the claim; if the segment does not qualify, the verdict is undecided.
template <typename ConcurrencyTag, typename Field, typename Threshold>
Verdict try_path(const Examined_shell<Field, Threshold>& shell, const Input_mesh_3& input,
                 const Crossing_counter_3& counter, Input_mesh_3::Triangle_mesh::Face_index f,
                 const std::array<double, 3>& weights, Crossing_path& path, int& count)
{
  typedef typename Field::Point_3 Point_3;
  typedef Input_mesh_3::Triangle_mesh Triangle_mesh;
  const auto t = input.triangle(f);
  const Triangle_mesh::Point middle = CGAL::barycenter(t[0], weights[0], t[1], weights[1], t[2], weights[2]);
  const auto segment = segment_through_shell(shell.predicates, shell.inner, shell.outer, converted<Point_3>(middle));
  if(!segment) return Verdict::UNDECIDED;
  const Triangle_mesh::Point p = converted<Triangle_mesh::Point>((*segment)[0]),
                             q = converted<Triangle_mesh::Point>((*segment)[1]);
  const auto crossings = counter.crossings<ConcurrencyTag>(p, q);
  if(!crossings) return Verdict::UNDECIDED;
  count = 0;
  for(const auto& crossing : *crossings) count += crossing.second;
  path.triangle = std::size_t(f);
  path.source = to_array(p);
  path.target = to_array(q);
  const bool through = std::any_of(crossings->begin(), crossings->end(), [&](const auto& x) { return x.first == f; });
  if(!through) return Verdict::UNDECIDED;
  return count == 1 ? Verdict::PROVED : Verdict::REFUTED;
}

// Examines P5.
template <typename ConcurrencyTag, typename Field, typename Threshold>
void examine_paths(const Examined_shell<Field, Threshold>& shell, const Input_mesh_3& input, Certificate_draft& draft)
{
  typedef Input_mesh_3::Triangle_mesh::Face_index Face_index;
  const Input_mesh_3::Triangle_mesh& mesh = input.mesh();
  const Crossing_counter_3 counter(mesh);
  std::vector<std::vector<std::pair<double, Face_index> > > facets(input.number_of_components());
  for(Face_index f : mesh.faces()) {
    const auto t = input.triangle(f);
    facets[input.component(f)].emplace_back(-CGAL::cross_product(t[1] - t[0], t[2] - t[0]).squared_length(), f);
  }
  draft.begin(Claim::DEGREE_ONE);
  for(std::size_t c = 0; c < input.number_of_components(); ++c) {
    Run::poll();
    const std::vector<Face_index> candidates = path_facets(facets[c]);
    Verdict verdict = Verdict::UNDECIDED;
    Crossing_path path;
    path.component = c;
    int count = 0;
    Face_index facet = candidates.front();
    std::size_t n = 0;
    for(; n < max_paths && verdict == Verdict::UNDECIDED; ++n) {
      const Face_index tried = candidates[n % candidates.size()];
      const std::array<double, 3>& point = path_points[n / candidates.size() % path_points.size()];
      verdict = try_path<ConcurrencyTag>(shell, input, counter, tried, point, path, count);
      if(verdict == Verdict::REFUTED) facet = tried;
    }
    if(verdict == Verdict::PROVED) {
      draft.paths.push_back(path);
      // Spare paths lead through other points of the next facets, because another mesh may have vertices in the middles
      // of these facets.
      const std::size_t first = (n - 1) % candidates.size();
      const std::size_t end = (std::min)(first + max_spare_paths, candidates.size());
      for(std::size_t m = first; m < end; ++m)
        if(try_path<ConcurrencyTag>(shell, input, counter, candidates[m], { 0.871, 0.978, 1.151 }, path, count)
           == Verdict::PROVED)
          draft.spare_paths.push_back(path);
      continue;
    }
    // The count is the same for all paths only if there are no critical points.
    if(draft.verdict(Claim::GRADIENT) != Verdict::PROVED) verdict = Verdict::UNDECIDED;
    Certificate_witness w = witness(Claim::DEGREE_ONE, verdict,
                                    verdict == Verdict::REFUTED ? Certificate_witness::CROSSINGS
                                                                : Certificate_witness::NO_PATH);
    w.component = c;
    if(verdict == Verdict::REFUTED) w.count = count;
    const auto t = input.triangle(facet);
    w.point = to_array(CGAL::centroid(t[0], t[1], t[2]));
    w.facet = input.facet_of_origin(facet);
    w.part = input.part_of_facet(w.facet);
    w.triangle = std::size_t(facet);
    draft.conclude(w);
  }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_PATHS_H
