// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_SHEETS_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_SHEETS_H

#include <CGAL/Bspline_shell_3/Certificate/internal/Certificate_draft.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Examined_shell.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/examine_cover.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns a point on a segment in the shell from one component of the mesh to another, if one is found.
template <typename Field, typename Threshold>
std::optional<std::array<double, 3> > joined(const Examined_shell<Field, Threshold>& shell, const Input_mesh_3& input,
                                             std::size_t first, std::size_t second)
{
  typedef typename Field::Point_3 Point_3;
  typedef Input_mesh_3::Triangle_mesh Triangle_mesh;
  typedef Triangle_mesh::Vertex_index Vertex_index;
  const Triangle_mesh& mesh = input.mesh();
  typedef std::pair<double, std::pair<Vertex_index, Vertex_index> > Candidate;
  constexpr std::size_t samples = 256, tries = 16;
  std::array<std::vector<Vertex_index>, 2> vertices;
  for(Triangle_mesh::Face_index f : mesh.faces())
    for(int side = 0; side < 2; ++side)
      if(input.component(f) == (side == 0 ? first : second)) vertices[side].push_back(mesh.target(mesh.halfedge(f)));
  std::vector<Candidate> candidates;
  const std::size_t stride = vertices[1].size() / samples + 1;
  for(std::size_t n = 0; n < vertices[1].size(); n += stride) {
    Run::poll();
    Candidate best(std::numeric_limits<double>::infinity(), {});
    for(Vertex_index v : vertices[0]) {
      const double d = CGAL::squared_distance(mesh.point(v), mesh.point(vertices[1][n]));
      if(d < best.first) best = Candidate(d, { v, vertices[1][n] });
    }
    candidates.push_back(best);
  }
  std::sort(candidates.begin(), candidates.end());
  for(std::size_t n = 0; n < (std::min)(tries, candidates.size()); ++n) {
    const auto &p = mesh.point(candidates[n].second.first), &q = mesh.point(candidates[n].second.second);
    if(shell.contains(converted<Point_3>(p), converted<Point_3>(q))) return to_array(CGAL::midpoint(p, q));
  }
  return std::nullopt;
}

// Examines P4, given P1. Components of the mesh in different components of the cover are in different components of the
// shell. If P2, P3, and P5 hold, components of the mesh that share a component of the cover are also in different
// components of the shell. Each component of the shell is then a product of a surface and the curves. All curves meet a
// component of the mesh in it equally often, at least once. Because the path through such a component meets the whole
// mesh once, there is no other.
template <typename Field, typename Threshold, typename Shared>
void examine_sheets(const Examined_shell<Field, Threshold>& shell, const Input_mesh_3& input, const Seeds& seeds,
                    const std::vector<Shared>& shared, Certificate_draft& draft)
{
  draft.begin(Claim::ONE_SHEET);
  const bool is_product = draft.verdict(Claim::TRANSVERSALITY) == Verdict::PROVED
                          && draft.verdict(Claim::GRADIENT) == Verdict::PROVED;
  std::vector<char> has_path(input.number_of_components(), 0);
  for(const Crossing_path& path : draft.paths) has_path[path.component] = 1;
  for(const Shared& pair : shared) {
    if(is_product && has_path[pair[0]] && has_path[pair[1]]) continue;
    const std::optional<std::array<double, 3> > joint = joined(shell, input, pair[0], pair[1]);
    Certificate_witness w = witness(Claim::ONE_SHEET, joint ? Verdict::REFUTED : Verdict::UNDECIDED,
                                    Certificate_witness::TWO_SHEETS);
    w.component = pair[0];
    w.other_component = pair[1];
    w.point = joint ? *joint : to_array(input.mesh().point(seeds[pair[1]]));
    draft.conclude(w);
  }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_SHEETS_H
