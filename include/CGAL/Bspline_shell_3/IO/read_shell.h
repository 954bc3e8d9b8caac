// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_READ_SHELL_H
#define CGAL_BSPLINE_SHELL_3_IO_READ_SHELL_H

#include <CGAL/Bspline_shell_3/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/IO/Shell_file_status.h>
#include <CGAL/Bspline_shell_3/IO/checksum.h>
#include <CGAL/Bspline_shell_3/internal/File_input.h>
#include <CGAL/Bspline_shell_3/internal/shell_file.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <istream>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// What a file says. All of it may be wrong.
struct Shell_file_content
{
  static constexpr std::size_t numbers_per_leaf = 69;     // corner, width, error radius, 64 Bernstein coefficients

  double unit = 0;
  Level_range levels;
  std::size_t triangles = 0, components = 0;
  std::array<double, 3> origin = {};
  double spacing = 0;
  std::vector<Lattice_point> functions;       // text only: in a binary file, they follow from the cells
  std::vector<double> coefficients;
  std::vector<Lattice_point> leaves;
  std::vector<char> marks;
  std::vector<double> leaf_numbers;           // text only
  std::vector<Level_range> facet_ranges;
};

// Vectors grow with what is read, never to what a count promises.
inline Shell_file_status read_binary_shell(File_input& in, Shell_file_content& content)
{
  for(char c : binary_shell_magic)
    if(in.binary<char>() != c) return Shell_file_status::NOT_A_SHELL;
  for(char c : binary_shell_version)
    if(in.binary<char>() != c) return in.is_bad() ? Shell_file_status::DAMAGED : Shell_file_status::VERSION_NOT_SUPPORTED;
  content.unit = in.binary<double>();
  content.levels.min = in.binary<double>();
  content.levels.max = in.binary<double>();
  content.triangles = std::size_t(in.binary<std::uint64_t>());
  content.components = std::size_t(in.binary<std::uint64_t>());
  for(double& x : content.origin) x = in.binary<double>();
  content.spacing = in.binary<double>();
  const std::uint64_t coefficients = in.binary<std::uint64_t>(), leaves = in.binary<std::uint64_t>(),
                      facets = in.binary<std::uint64_t>();
  if(in.binary<std::uint64_t>() != binary_uniform_field) return Shell_file_status::DAMAGED;
  for(std::uint64_t n = 0; n < leaves && !in.is_bad(); ++n) {
    Lattice_point p;
    for(int& i : p) i = in.binary<std::int32_t>();
    content.leaves.push_back(p);
    content.marks.push_back(in.binary<char>());
    if(content.marks.back() != 0 && content.marks.back() != 1) return Shell_file_status::DAMAGED;
  }
  for(std::uint64_t n = 0; n < coefficients && !in.is_bad(); ++n) content.coefficients.push_back(in.binary<double>());
  for(std::uint64_t n = 0; n < facets && !in.is_bad(); ++n) {
    Level_range range;
    range.min = in.binary<double>();
    range.max = in.binary<double>();
    content.facet_ranges.push_back(range);
  }
  const std::uint64_t checksum = in.checksum();
  const bool intact = in.binary<std::uint64_t>() == checksum && !in.is_bad() && in.is_at_end();
  return intact ? Shell_file_status::SUCCESS : Shell_file_status::DAMAGED;
}

inline Shell_file_status read_ASCII_shell(File_input& in, Shell_file_content& content)
{
  int version = 0;
  Words first(in.line());
  first.word(ASCII_shell_magic).number(version);
  if(!first.are_as_expected()) return Shell_file_status::NOT_A_SHELL;
  if(version != ASCII_shell_version) return Shell_file_status::VERSION_NOT_SUPPORTED;
  if(!first.word("ascii").are_complete()) return Shell_file_status::NOT_A_SHELL;

  const Shell_file_status damaged = Shell_file_status::DAMAGED;
  if(!Words(in.line()).word("unit").number(content.unit).are_complete()) return damaged;
  if(!Words(in.line()).word("levels").number(content.levels.min).number(content.levels.max).are_complete()) return damaged;
  if(!Words(in.line()).word("triangles").number(content.triangles)
                      .word("components").number(content.components).are_complete()) return damaged;
  if(!Words(in.line()).word("field").word("uniform").number(content.origin[0]).number(content.origin[1])
                      .number(content.origin[2]).number(content.spacing).are_complete()) return damaged;

  std::uint64_t count = 0;
  if(!Words(in.line()).word("functions").number(count).are_complete()) return damaged;
  for(; count > 0; --count) {
    Lattice_point p;
    double coefficient;
    if(!Words(in.line()).number(p[0]).number(p[1]).number(p[2]).number(coefficient).are_complete()) return damaged;
    content.functions.push_back(p);
    content.coefficients.push_back(coefficient);
  }
  if(!Words(in.line()).word("leaves").number(count).are_complete()) return damaged;
  for(; count > 0; --count) {
    Lattice_point p;
    int mark;
    std::array<double, Shell_file_content::numbers_per_leaf> numbers;
    Words words(in.line());
    words.number(p[0]).number(p[1]).number(p[2]).number(mark);
    for(double& x : numbers) words.number(x);
    if(!words.are_complete() || (mark != 0 && mark != 1)) return damaged;
    content.leaves.push_back(p);
    content.marks.push_back(char(mark));
    content.leaf_numbers.insert(content.leaf_numbers.end(), numbers.begin(), numbers.end());
  }
  if(!Words(in.line()).word("facet_ranges").number(count).are_complete()) return damaged;
  for(; count > 0; --count) {
    Level_range range;
    if(!Words(in.line()).number(range.min).number(range.max).are_complete()) return damaged;
    content.facet_ranges.push_back(range);
  }
  const std::string checksum = Checksum::text(in.checksum());
  const bool intact = Words(in.line()).word("checksum").word(checksum).are_complete() && in.is_at_end();
  return intact ? Shell_file_status::SUCCESS : damaged;
}

// Whether a text file's numbers of a leaf are those that follow from its lattice point and the functions. Corner and width
// are exact. The others may be rounded in another way where the file was written: compilers fuse products and sums on
// some machines.
inline bool are_numbers_of_cell(const double* numbers, const Tricubic_cell_3& cell)
{
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  bool are = true;
  for(int a = 0; a < 3; ++a) are = are && numbers[a] == cell.corner()[a];
  are = are && numbers[3] == cell.width();
  const double radius = cell.error_radius();
  are = are && std::abs(numbers[4] - radius) <= 1e-15 * radius + 4 * smallest;
  for(int n = 0; n < 64; ++n) are = are && std::abs(numbers[5 + n] - cell.coefficients()[n]) <= 2 * radius;
  return are;
}

// the shell that the content describes, unless it contradicts itself
template <typename GeomTraits>
bool make_shell(Shell_file_content& content, Bspline_shell_3<Uniform_bspline_field_3<GeomTraits> >& shell)
{
  typedef Uniform_bspline_field_3<GeomTraits> Field;
  typedef typename Field::Cell_index Index;

  const std::size_t cells = content.leaves.size();
  if(cells == 0 || (std::max)(cells, content.coefficients.size()) >= Field::npos) return false;
  Lattice_extent extent = { content.leaves.front(), content.leaves.front() };
  for(const Lattice_point& p : content.leaves) extent.include(p);
  if(!extent.has_reasonable_size(cells)) return false;
  std::vector<std::uint64_t> keys;
  keys.reserve(cells);
  for(const Lattice_point& p : content.leaves) {
    keys.push_back(Lattice_key::encode(p[0], p[1], p[2]));
    if(keys.size() > 1 && keys[keys.size() - 2] >= keys.back()) return false;
  }
  const Lattice_3 lattice = Lattice_3::from_origin(content.origin, content.spacing, extent.first, extent.last);
  if(!lattice.is_exact()) return false;

  Field field(Cell_complex_3(lattice, keys));
  if(field.number_of_coefficients() != content.coefficients.size()) return false;
  for(std::size_t n = 0; n < content.functions.size(); ++n)
    if(field.functions().point(Index(n)) != content.functions[n]) return false;
  field.set_coefficients(Eigen::Map<const Eigen::VectorXd>(content.coefficients.data(),
                                                           Eigen::Index(content.coefficients.size())));
  for(std::size_t n = 0, c = 0; n < content.leaf_numbers.size(); n += Shell_file_content::numbers_per_leaf, ++c)
    if(!are_numbers_of_cell(&content.leaf_numbers[n], field.cell(Index(c)))) return false;

  Shell_report report;
  report.status = Shell_status::SUCCESS;
  report.triangles = content.triangles;
  report.components = content.components;
  report.unit = content.unit;
  report.gamma = content.unit / lattice.spacing();
  report.cells = field.number_of_cells();
  report.unknowns = field.number_of_coefficients();
  Bspline_shell_3<Field> made(std::move(field), content.levels, std::move(content.marks), std::move(content.facet_ranges),
                              std::move(report));
  if(!is_shell(made)) return false;
  shell = std::move(made);
  return true;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief reads a shell that `write_shell()` wrote, binary or text. See \ref BsplineShell3FileFormats.
 *
 * The field, cells, levels and facet ranges are those that were written, bit by bit. Nothing that was cut off or altered is
 * taken for a shell: every file has a checksum, and what it says must agree. A damaged file costs no more time and
 * memory than an intact one of its length.
 *
 * \param in a stream, opened with `std::ios::binary`, which must end where the shell ends. It is read past its locale and
 * flags; the status tells how it went.
 * \param[out] shell the shell, if the status is `SUCCESS`; otherwise it is left as it is. Of its report, unit, gamma and the
 * numbers of triangles, components, cells and unknowns are known.
 */
template <typename GeomTraits>
Shell_file_status read_shell(std::istream& in, Bspline_shell_3<Uniform_bspline_field_3<GeomTraits> >& shell)
{
  if(!in) return Shell_file_status::CANNOT_OPEN;
  internal::File_input input(in);
  internal::Shell_file_content content;
  Shell_file_status status = Shell_file_status::NOT_A_SHELL;
  if(input.starts_with(internal::binary_shell_magic)) status = internal::read_binary_shell(input, content);
  else if(input.starts_with(internal::ASCII_shell_magic)) status = internal::read_ASCII_shell(input, content);
  if(status == Shell_file_status::SUCCESS && !internal::make_shell(content, shell)) status = Shell_file_status::DAMAGED;
  return status;
}

/// \ingroup PkgBsplineShell3IO
/// The same from a file, whatever its extension.
template <typename GeomTraits>
Shell_file_status read_shell(const std::string& file, Bspline_shell_3<Uniform_bspline_field_3<GeomTraits> >& shell)
{
  std::ifstream in(file, std::ios::binary);
  if(in) in.peek();       // a folder can be opened, but not read
  return in.bad() ? Shell_file_status::CANNOT_OPEN : read_shell(in, shell);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_READ_SHELL_H
