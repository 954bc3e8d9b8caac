// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_SHELL_FILE_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_SHELL_FILE_H

#include <CGAL/Bspline_shell_3/Cells/Lattice_set_3.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

constexpr std::string_view binary_shell_magic = "BSHELL", ASCII_shell_magic = "cubic_bspline_shell";
constexpr int shell_file_version = 5;
constexpr int largest_file_level = 30; // highest cell level in a file; no hierarchy has so many levels

// The kind of the field, as a word and as a bit. Older versions of the package wrote another word, and no bit, if all
// cells had one size.
constexpr std::string_view kind_of_field = "hierarchical", older_kind_of_field = "uniform";
constexpr std::uint64_t bit_of_field = 1, bit_of_spline_thresholds = 2;

// Returns the coefficients of the field and, unless they are constant, of the inner and the outer threshold.
template <typename Shell>
std::vector<const Eigen::VectorXd*> coefficients_of_splines(const Shell& shell)
{
  std::vector<const Eigen::VectorXd*> splines = { &shell.field().coefficients() };
  if constexpr(!Shell::Threshold::is_constant) {
    splines.push_back(&shell.inner_threshold().field().coefficients());
    splines.push_back(&shell.outer_threshold().field().coefficients());
  }
  return splines;
}

// Returns the values of constant thresholds; for other thresholds, zero and the thickness.
template <typename Shell>
Level_range levels(const Shell& shell)
{
  if constexpr(Shell::Threshold::is_constant) return { shell.inner_level(), shell.outer_level() };
  else return { 0, shell.thickness() };
}

// Returns the paths through the components of a certified shell; otherwise, the candidates that were read from a file.
template <typename Shell>
std::vector<Crossing_path> paths_of_file(const Shell& shell)
{
  return shell.is_certified() ? shell.component_paths() : shell.path_candidates();
}

// Calls visit(level, p) for the lattice points of all free coefficients of a field, in their order.
template <typename Field, typename Visitor>
void visit_functions(const Field& field, const Visitor& visit)
{
  for(int l = field.number_of_levels() - 1; l >= 0; --l)
    for(typename Field::Cell_index n = 0; n < field.points(l).size(); ++n)
      if(field.coefficient_of_point(field.first_point(l) + n) != Field::npos) visit(l, field.points(l).point(n));
}

// Within this bound, averages of coefficients do not overflow in intermediate sums.
inline bool is_coefficient(double x)
{
  return std::abs(x) <= (std::numeric_limits<double>::max)() / 64;
}

inline bool is_range(const Level_range& r)
{
  return std::isfinite(r.min) && std::isfinite(r.max) && r.min <= r.max;
}

// Returns whether there is a shell and a file can represent it.
template <typename Shell>
bool is_shell(const Shell& shell)
{
  if(!shell) return false;
  const auto& field = shell.field();
  if(field.number_of_cells() == 0 || shell.shell_cells().size() != field.number_of_cells() || !field.has_exact_cells())
    return false;
  for(typename Shell::Field::Cell_index c = 0; c < field.number_of_cells(); ++c)
    for(int i : field.cells().lattice_point(c))
      if(std::abs(i) > Lattice_key::max_coordinate) return false;
  for(const Eigen::VectorXd* x : coefficients_of_splines(shell))
    if(std::size_t(x->size()) != field.number_of_coefficients()
       || !std::all_of(x->data(), x->data() + x->size(), is_coefficient))
      return false;
  if(shell.closing() && !shell.closing()->is_valid()) return false;
  if(shell.truncation() && !shell.truncation()->is_valid()) return false;
  const std::vector<Crossing_path> paths = paths_of_file(shell);
  for(const Crossing_path& path : paths) {
    if(path.component >= paths.size()) return false; // each component has a path
    for(const auto& p : { path.source, path.target })
      if(!std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); })) return false;
  }
  const double unit = shell.report().unit;
  return is_range(levels(shell)) && std::isfinite(unit) && unit >= 0
         && std::all_of(shell.facet_ranges().begin(), shell.facet_ranges().end(), is_range);
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_SHELL_FILE_H
