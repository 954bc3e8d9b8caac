// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_COMPONENTS_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_COMPONENTS_H

#include <CGAL/Bspline_shell_3/Certificate/internal/Certificate_draft.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Examined_shell.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/examine_cover.h>
#include <CGAL/Bspline_shell_3/Certificate/match_components.h>
#include <CGAL/Bspline_shell_3/Certificate/segment_through_shell.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Paths through the components of a shell.
struct Component_paths
{
  std::vector<Crossing_path> paths;
  bool are_of_certificate = false; // the shell is certified, and each of its components has a path
  bool are_proved = true;

  // Keeps only the paths that are proved to lead through the shell.
  template <typename Field, typename Threshold>
  void prove(const Examined_shell<Field, Threshold>& shell)
  {
    typedef typename Field::Point_3 Point_3;
    if(are_proved) return;
    const auto point = [](const std::array<double, 3>& p) { return Point_3(p[0], p[1], p[2]); };
    const auto is_unproved = [&](const Crossing_path& path) {
      return !leads_through_shell(shell.predicates, shell.inner, shell.outer,
                                  { point(path.source), point(path.target) });
    };
    paths.erase(std::remove_if(paths.begin(), paths.end(), is_unproved), paths.end());
    are_proved = true;
  }
};

// Examines whether the components of the mesh are those of the certified shell. All meshes for which this is proved are
// mapped onto each other. Without paths through a shell, the mesh defines the components. If paths of an uncertified
// shell or of a file do not meet a mesh, nothing is refuted: the shell may have critical points away from the mesh, and
// the file may contain any paths.
inline void examine_components(const Input_mesh_3& input, const Seeds& seeds, const Component_paths& shell,
                               Certificate_draft& draft)
{
  draft.components.assign(input.number_of_components(), Certificate_witness::none);
  if(shell.paths.empty()) {
    for(const Crossing_path& path : draft.paths) draft.components[path.component] = path.component;
    return;
  }
  const Component_match match = match_components(shell.paths, input);
  draft.components = match.component_of_shell;
  // Crossings of components that face along the gradient all have the same sign.
  const bool is_transversal = draft.verdict(Claim::TRANSVERSALITY) == Verdict::PROVED;
  bool is_known = is_transversal && shell.are_of_certificate;
  for(std::size_t k = 0; k < match.crossings.size(); ++k) {
    const std::optional<int> count = match.crossings[k];
    is_known = is_known && count;
    if(count == 1) continue;
    const bool is_empty = !count || *count == 0, is_refuted = count && is_transversal && shell.are_of_certificate;
    Certificate_witness w = witness(
      is_empty ? Claim::ONE_SHEET : Claim::DEGREE_ONE, is_refuted ? Verdict::REFUTED : Verdict::UNDECIDED,
      is_empty ? Certificate_witness::EMPTY_COMPONENT : Certificate_witness::SHELL_CROSSINGS);
    w.component = k;
    if(!is_empty) w.count = *count;
    for(const Crossing_path& path : shell.paths)
      if(path.component == k)
        for(int a = 0; a < 3; ++a) w.point[a] = (path.source[a] + path.target[a]) / 2;
    draft.conclude(w);
  }
  for(std::size_t c = 0; c < input.number_of_components(); ++c)
    if(draft.components[c] == Certificate_witness::none) {
      Certificate_witness w = witness(Claim::ONE_SHEET, is_known ? Verdict::REFUTED : Verdict::UNDECIDED,
                                      Certificate_witness::OTHER_COMPONENT);
      w.component = c;
      w.point = to_array(input.mesh().point(seeds[c]));
      draft.conclude(w);
    }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINE_COMPONENTS_H
