// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_READ_SHELL_H
#define CGAL_BSPLINE_SHELL_3_IO_READ_SHELL_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/IO/Shell_file_status.h>
#include <CGAL/Bspline_shell_3/IO/checksum.h>
#include <CGAL/Bspline_shell_3/IO/internal/File_input.h>
#include <CGAL/Bspline_shell_3/IO/internal/shell_file.h>
#include <CGAL/Bspline_shell_3/IO/internal/truncation_file.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Content of a shell file before validation; any of it may be wrong.
struct Shell_file_content
{
  struct Position
  {
    int level;
    Lattice_point point;
  };

  bool has_spline_thresholds = false;
  double unit = 0;
  Level_range levels; // zero and the thickness if thresholds vary
  std::size_t triangles = 0, components = 0;
  std::array<double, 3> origin = {};
  double spacing = 0;
  std::vector<Position> functions;           // text files only: a binary file lists cells, which imply them
  std::vector<std::vector<double> > splines; // coefficients of the field, and of the inner and the outer threshold
  std::vector<Position> leaves;
  std::vector<char> marks;
  std::vector<Level_range> facet_ranges;
  std::vector<Crossing_path> paths;
  std::shared_ptr<const Shell_truncation_3> truncation;
  std::vector<Shell_closing_3::Point> closing_points;
  std::uint64_t border_points = 0;
  std::vector<Shell_closing_3::Triangle> closing_triangles;
  std::vector<Shell_closing_3::Kind> closing_kinds;

  // Returns false if there is no such triangle.
  bool add_closing_triangle(const std::array<std::uint64_t, 3>& corners, int kind)
  {
    Shell_closing_3::Triangle t;
    for(int i = 0; i < 3; ++i) {
      if(corners[i] >= closing_points.size()) return false;
      t[i] = Shell_closing_3::Index(corners[i]);
    }
    closing_triangles.push_back(t);
    closing_kinds.push_back(Shell_closing_3::Kind(kind));
    return kind == 0 || kind == 1;
  }

  bool has_closing() const { return !closing_points.empty() || border_points > 0 || !closing_triangles.empty(); }
};

// Vectors grow as data is read; no memory is reserved for counts in the file.
inline Shell_file_status read_binary_shell(File_input& in, Shell_file_content& content)
{
  for(char c : binary_shell_magic)
    if(in.binary<char>() != c) return Shell_file_status::NOT_A_SHELL;
  const char tens = in.binary<char>();
  const int version = in.binary<char>() - '0';
  if(tens != '0' || version != shell_file_version)
    return in.is_bad() ? Shell_file_status::DAMAGED : Shell_file_status::VERSION_NOT_SUPPORTED;
  content.unit = in.binary<double>();
  content.levels.min = in.binary<double>();
  content.levels.max = in.binary<double>();
  content.triangles = std::size_t(in.binary<std::uint64_t>());
  content.components = std::size_t(in.binary<std::uint64_t>());
  for(double& x : content.origin) x = in.binary<double>();
  content.spacing = in.binary<double>();
  const std::uint64_t coefficients = in.binary<std::uint64_t>(), leaves = in.binary<std::uint64_t>(),
                      facets = in.binary<std::uint64_t>(), kind = in.binary<std::uint64_t>();
  if(kind > (bit_of_field | bit_of_spline_thresholds)) return Shell_file_status::DAMAGED;
  content.has_spline_thresholds = (kind & bit_of_spline_thresholds) != 0;
  for(std::uint64_t n = 0; n < leaves && !in.is_bad(); ++n) {
    Shell_file_content::Position leaf;
    leaf.level = in.binary<std::uint8_t>();
    for(int& i : leaf.point) i = in.binary<std::int32_t>();
    content.leaves.push_back(leaf);
    content.marks.push_back(in.binary<char>());
    if(content.marks.back() != 0 && content.marks.back() != 1) return Shell_file_status::DAMAGED;
  }
  content.splines.resize(content.has_spline_thresholds ? 3 : 1);
  for(std::vector<double>& spline : content.splines)
    for(std::uint64_t n = 0; n < coefficients && !in.is_bad(); ++n) spline.push_back(in.binary<double>());
  for(std::uint64_t n = 0; n < facets && !in.is_bad(); ++n) {
    Level_range range;
    range.min = in.binary<double>();
    range.max = in.binary<double>();
    content.facet_ranges.push_back(range);
  }
  const std::uint64_t points = in.binary<std::uint64_t>();
  content.border_points = in.binary<std::uint64_t>();
  const std::uint64_t triangles = in.binary<std::uint64_t>();
  for(std::uint64_t n = 0; n < points && !in.is_bad(); ++n) {
    content.closing_points.emplace_back();
    for(double& x : content.closing_points.back()) x = in.binary<double>();
  }
  for(std::uint64_t n = 0; n < triangles && !in.is_bad(); ++n) {
    std::array<std::uint64_t, 3> corners;
    for(std::uint64_t& i : corners) i = in.binary<std::uint32_t>();
    if(!content.add_closing_triangle(corners, in.binary<std::uint8_t>())) return Shell_file_status::DAMAGED;
  }
  const std::uint64_t paths = in.binary<std::uint64_t>();
  for(std::uint64_t n = 0; n < paths && !in.is_bad(); ++n) {
    content.paths.emplace_back();
    content.paths.back().component = std::size_t(in.binary<std::uint64_t>());
    for(auto* p : { &content.paths.back().source, &content.paths.back().target })
      for(double& x : *p) x = in.binary<double>();
  }
  if(!read_truncation(Row_input(in, true), content.truncation)) return Shell_file_status::DAMAGED;
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
  if(version != shell_file_version) return Shell_file_status::VERSION_NOT_SUPPORTED;
  if(!first.word("ascii").are_complete()) return Shell_file_status::NOT_A_SHELL;

  const Shell_file_status damaged = Shell_file_status::DAMAGED;
  if(!Words(in.line()).word("unit").number(content.unit).are_complete()) return damaged;
  const std::string_view thresholds = in.line();
  content.has_spline_thresholds = Words(thresholds).word("thickness").number(content.levels.max).are_complete();
  if(content.has_spline_thresholds) content.levels.min = 0;
  else if(!Words(thresholds).word("levels").number(content.levels.min).number(content.levels.max).are_complete())
    return damaged;
  if(!Words(in.line())
        .word("triangles")
        .number(content.triangles)
        .word("components")
        .number(content.components)
        .are_complete())
    return damaged;
  const std::string_view field = in.line();
  const bool is_older = Words(field).word("field").word(older_kind_of_field).are_as_expected();
  if(!Words(field)
        .word("field")
        .word(is_older ? older_kind_of_field : kind_of_field)
        .number(content.origin[0])
        .number(content.origin[1])
        .number(content.origin[2])
        .number(content.spacing)
        .are_complete())
    return damaged;

  const auto position = [&](Words& words) {
    Shell_file_content::Position p = { 0, {} };
    words.number(p.level);
    for(int& i : p.point) words.number(i);
    return p;
  };
  std::uint64_t count = 0;
  if(!Words(in.line()).word("functions").number(count).are_complete()) return damaged;
  content.splines.resize(content.has_spline_thresholds ? 3 : 1);
  for(; count > 0; --count) {
    Words words(in.line());
    content.functions.push_back(position(words));
    for(std::vector<double>& spline : content.splines) {
      spline.emplace_back();
      words.number(spline.back());
    }
    if(!words.are_complete()) return damaged;
  }
  if(!Words(in.line()).word("leaves").number(count).are_complete()) return damaged;
  for(; count > 0; --count) {
    Words words(in.line());
    content.leaves.push_back(position(words));
    int mark = 0;
    words.number(mark);
    if(!words.are_complete() || (mark != 0 && mark != 1)) return damaged;
    content.marks.push_back(char(mark));
  }
  if(!Words(in.line()).word("facet_ranges").number(count).are_complete()) return damaged;
  for(; count > 0; --count) {
    Level_range range;
    if(!Words(in.line()).number(range.min).number(range.max).are_complete()) return damaged;
    content.facet_ranges.push_back(range);
  }
  std::uint64_t triangles = 0;
  if(!Words(in.line()).word("closing").number(count).number(content.border_points).number(triangles).are_complete())
    return damaged;
  for(; count > 0; --count) {
    Shell_closing_3::Point p = {};
    if(!Words(in.line()).number(p[0]).number(p[1]).number(p[2]).are_complete()) return damaged;
    content.closing_points.push_back(p);
  }
  for(; triangles > 0; --triangles) {
    std::array<std::uint64_t, 3> corners = {};
    int kind = 0;
    if(!Words(in.line()).number(corners[0]).number(corners[1]).number(corners[2]).number(kind).are_complete())
      return damaged;
    if(!content.add_closing_triangle(corners, kind)) return damaged;
  }
  if(!Words(in.line()).word("paths").number(count).are_complete()) return damaged;
  for(; count > 0; --count) {
    Words words(in.line());
    content.paths.emplace_back();
    words.number(content.paths.back().component);
    for(auto* p : { &content.paths.back().source, &content.paths.back().target })
      for(double& x : *p) words.number(x);
    if(!words.are_complete()) return damaged;
  }
  if(!Words(in.line()).word("truncation").are_complete()) return damaged;
  if(!read_truncation(Row_input(in, false), content.truncation)) return damaged;
  const std::string checksum = Checksum::text(in.checksum());
  const bool intact = Words(in.line()).word("checksum").word(checksum).are_complete() && in.is_at_end();
  return intact ? Shell_file_status::SUCCESS : damaged;
}

// Returns the zero function on the leaves, or nothing if the leaves are inconsistent.
template <typename Field>
std::optional<Field> make_field(const Shell_file_content& content)
{
  if(content.leaves.empty() || content.leaves.size() >= Field::npos) return std::nullopt;
  std::vector<std::vector<std::uint64_t> > keys; // by level
  for(const Shell_file_content::Position& leaf : content.leaves) {
    const std::size_t level = std::size_t(leaf.level);
    if(leaf.level < 0 || leaf.level > largest_file_level || level + 1 < keys.size()) return std::nullopt;
    for(int i : leaf.point)
      if(i < -Lattice_key::max_coordinate || i > Lattice_key::max_coordinate) return std::nullopt;
    keys.resize(level + 1);
    const std::uint64_t key = Lattice_key::encode(leaf.point[0], leaf.point[1], leaf.point[2]);
    if(!keys[level].empty() && keys[level].back() >= key) return std::nullopt;
    keys[level].push_back(key);
  }
  // Whether the lattice is exact for these cells is tested below.
  const Lattice_3 lattice = Lattice_3::from_origin(content.origin, content.spacing, {}, {});
  if(!lattice.is_exact()) return std::nullopt;
  std::optional<Cell_hierarchy_3> cells = Cell_hierarchy_3::from_leaves(lattice, keys);
  if(!cells || !cells->is_exact()) return std::nullopt;
  return Field(std::move(*cells));
}

// Makes the shell that the content describes; returns false if the content is inconsistent.
template <typename Shell>
bool make_shell(Shell_file_content& content, Shell& shell)
{
  typedef typename Shell::Field Field;
  typedef typename Shell::Threshold Threshold;

  std::optional<Field> field = make_field<Field>(content);
  if(!field || field->number_of_coefficients() != content.splines.front().size()) return false;
  if(!content.functions.empty()) {
    bool are_those_of_field = true;
    auto listed = content.functions.begin();
    visit_functions(*field, [&](int level, const Lattice_point& p) {
      are_those_of_field = are_those_of_field && listed->level == level && listed->point == p;
      ++listed;
    });
    if(!are_those_of_field) return false;
  }
  const auto spline = [&](std::size_t n) {
    Field f = *field;
    f.set_coefficients(
      Eigen::Map<const Eigen::VectorXd>(content.splines[n].data(), Eigen::Index(content.splines[n].size())));
    return f;
  };

  Shell_report report;
  report.status = Shell_status::SUCCESS;
  report.triangles = content.triangles;
  report.components = content.components;
  report.unit = content.unit;
  report.gamma = content.unit / content.spacing;
  report.cells = field->number_of_cells();
  report.unknowns = field->number_of_coefficients();
  const auto between = [&](Threshold inner, Threshold outer) {
    return Shell(spline(0), std::move(inner), std::move(outer), std::move(content.marks),
                 std::move(content.facet_ranges), report);
  };
  Shell made;
  if constexpr(Threshold::is_constant) made = between(Threshold(content.levels.min), Threshold(content.levels.max));
  else {
    report.thickness = content.levels.max;
    made = between(Threshold(spline(1)), Threshold(spline(2)));
  }
  if(content.has_closing())
    internal::Shell_access::set_closing(
      made,
      std::make_shared<const Shell_closing_3>(std::move(content.closing_points), std::size_t(content.border_points),
                                              std::move(content.closing_triangles), std::move(content.closing_kinds)));
  internal::Shell_access::set_truncation(made, std::move(content.truncation));
  internal::Shell_access::set_path_candidates(made, std::move(content.paths));
  if(!is_shell(made)) return false;
  shell = std::move(made);
  return true;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief reads a shell written by `write_shell()`, in binary or text format. See \ref BsplineShell3FileFormats.
 *
 * The field, cells, thresholds, facet ranges, closing, and truncation are reproduced bit by bit. Truncated and altered
 * files are rejected: every file has a checksum, and its parts must be consistent. A damaged file takes no more time
 * and memory than an intact file of its length.
 *
 * The shell is not certified. `certify(shell, mesh)` proves the certificate again, for the mesh for which the shell was
 * built, or for another mesh in it. The paths in the file through the components of the shell are candidates: a
 * certificate uses only those that it proves (`Bspline_shell_3::path_candidates()`). The unit, the thickness, the
 * number of triangles and of components, and the facet ranges are not checked; no proof uses them.
 *
 * \tparam Field a `Hierarchical_bspline_field_3`
 * \tparam Threshold `Constant_threshold` or `Spline_threshold<Field>`
 *
 * \param in a stream opened with `std::ios::binary`, which must end where the shell ends. Its locale and format flags
 *   are ignored, and its state does not change.
 * \param[out] shell the shell if the status is `SUCCESS`; otherwise unchanged. Its report contains the unit, gamma, the
 *   thickness, and the number of triangles, components, cells, and unknowns.
 */
template <typename Field, typename Threshold>
Shell_file_status read_shell(std::istream& in, Bspline_shell_3<Field, Threshold>& shell)
{
  if(!in) return Shell_file_status::CANNOT_OPEN;
  internal::File_input input(in);
  internal::Shell_file_content content;
  Shell_file_status status = Shell_file_status::NOT_A_SHELL;
  if(input.starts_with(internal::binary_shell_magic)) status = internal::read_binary_shell(input, content);
  else if(input.starts_with(internal::ASCII_shell_magic)) status = internal::read_ASCII_shell(input, content);
  if(status != Shell_file_status::SUCCESS) return status;
  if(content.has_spline_thresholds == Threshold::is_constant) return Shell_file_status::OTHER_KIND;
  return internal::make_shell(content, shell) ? status : Shell_file_status::DAMAGED;
}

/// \ingroup PkgBsplineShell3IO
/// reads a shell from a file with any extension
template <typename Field, typename Threshold>
Shell_file_status read_shell(const std::string& file, Bspline_shell_3<Field, Threshold>& shell)
{
  std::ifstream in(file, std::ios::binary);
  if(in) in.peek(); // a folder can be opened but not read
  return in.bad() ? Shell_file_status::CANNOT_OPEN : read_shell(in, shell);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_READ_SHELL_H
