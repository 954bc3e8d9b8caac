// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_WRITE_SHELL_H
#define CGAL_BSPLINE_SHELL_3_IO_WRITE_SHELL_H

#include <CGAL/Bspline_shell_3/IO/Shell_file_status.h>
#include <CGAL/Bspline_shell_3/IO/checksum.h>
#include <CGAL/Bspline_shell_3/IO/internal/File_output.h>
#include <CGAL/Bspline_shell_3/IO/internal/shell_file.h>
#include <CGAL/Bspline_shell_3/IO/internal/truncation_file.h>
#include <CGAL/Bspline_shell_3/IO/write_file.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>

#include <CGAL/assertions.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Writes all lines except the last.
template <typename Shell>
void write_ASCII_shell(File_output& out, const Shell& shell)
{
  const auto& field = shell.field();
  const auto& cells = field.cells();
  const auto word = [&out](auto x) {
    out.text(" ");
    out.decimal(x);
  };
  const auto point = [&](int level, const Lattice_point& p) {
    out.decimal(level);
    for(int i : p) word(i);
  };
  out.text(ASCII_shell_magic);
  word(shell_file_version);
  out.text(" ascii\nunit");
  word(shell.report().unit);
  if(!Shell::Threshold::is_constant) out.text("\nthickness");
  else {
    out.text("\nlevels");
    word(levels(shell).min);
  }
  word(levels(shell).max);
  out.text("\ntriangles");
  word(shell.report().triangles);
  out.text(" components");
  word(shell.report().components);
  out.text("\nfield ");
  out.text(kind_of_field);
  for(double x : cells.lattice().origin()) word(x);
  word(cells.lattice().spacing());

  out.text("\nfunctions");
  word(field.number_of_coefficients());
  out.text("\n");
  const std::vector<const Eigen::VectorXd*> splines = coefficients_of_splines(shell);
  Eigen::Index n = 0;
  visit_functions(field, [&](int level, const Lattice_point& p) {
    point(level, p);
    for(const Eigen::VectorXd* coefficients : splines) word((*coefficients)[n]);
    ++n;
    out.text("\n");
  });

  out.text("leaves");
  word(field.number_of_cells());
  out.text("\n");
  for(typename Shell::Field::Cell_index c = 0; c < field.number_of_cells(); ++c) {
    point(cells.level(c), cells.lattice_point(c));
    word(shell.shell_cells()[c] ? 1 : 0);
    out.text("\n");
  }

  out.text("facet_ranges");
  word(shell.facet_ranges().size());
  out.text("\n");
  for(const Level_range& range : shell.facet_ranges()) {
    out.decimal(range.min);
    word(range.max);
    out.text("\n");
  }

  const Shell_closing_3 no_closing;
  const Shell_closing_3& closing = shell.closing() ? *shell.closing() : no_closing;
  out.text("closing");
  word(closing.points().size());
  word(closing.number_of_border_points());
  word(closing.triangles().size());
  out.text("\n");
  for(const Shell_closing_3::Point& p : closing.points()) {
    out.decimal(p[0]);
    word(p[1]);
    word(p[2]);
    out.text("\n");
  }
  for(std::size_t t = 0; t < closing.triangles().size(); ++t) {
    out.decimal(std::size_t(closing.triangles()[t][0]));
    word(std::size_t(closing.triangles()[t][1]));
    word(std::size_t(closing.triangles()[t][2]));
    word(int(closing.kinds()[t]));
    out.text("\n");
  }
  const std::vector<Crossing_path> paths = paths_of_file(shell);
  out.text("paths");
  word(paths.size());
  out.text("\n");
  for(const Crossing_path& path : paths) {
    out.decimal(path.component);
    for(const auto& p : { path.source, path.target })
      for(double x : p) word(x);
    out.text("\n");
  }
  out.text("truncation\n");
  write_truncation(Row_output(out, false), shell.truncation().get());
}

// Writes all data except the checksum.
template <typename Shell>
void write_binary_shell(File_output& out, const Shell& shell)
{
  const auto& field = shell.field();
  const auto& cells = field.cells();
  const auto count = [&out](std::size_t n) { out.binary(std::uint64_t(n)); };
  out.text(binary_shell_magic);
  out.text("0");
  out.decimal(shell_file_version);
  out.binary(shell.report().unit);
  out.binary(levels(shell).min);
  out.binary(levels(shell).max);
  count(shell.report().triangles);
  count(shell.report().components);
  for(double x : cells.lattice().origin()) out.binary(x);
  out.binary(cells.lattice().spacing());
  count(field.number_of_coefficients());
  count(field.number_of_cells());
  count(shell.facet_ranges().size());
  out.binary(bit_of_field | (Shell::Threshold::is_constant ? 0 : bit_of_spline_thresholds));
  for(typename Shell::Field::Cell_index c = 0; c < field.number_of_cells(); ++c) {
    out.binary(std::uint8_t(cells.level(c)));
    for(int i : cells.lattice_point(c)) out.binary(std::int32_t(i));
    out.binary(std::uint8_t(shell.shell_cells()[c] ? 1 : 0));
  }
  for(const Eigen::VectorXd* coefficients : coefficients_of_splines(shell))
    for(Eigen::Index n = 0; n < coefficients->size(); ++n) out.binary((*coefficients)[n]);
  for(const Level_range& range : shell.facet_ranges()) {
    out.binary(range.min);
    out.binary(range.max);
  }
  const Shell_closing_3 no_closing;
  const Shell_closing_3& closing = shell.closing() ? *shell.closing() : no_closing;
  count(closing.points().size());
  count(closing.number_of_border_points());
  count(closing.triangles().size());
  for(const Shell_closing_3::Point& p : closing.points())
    for(double x : p) out.binary(x);
  for(std::size_t t = 0; t < closing.triangles().size(); ++t) {
    for(Shell_closing_3::Index i : closing.triangles()[t]) out.binary(std::uint32_t(i));
    out.binary(std::uint8_t(closing.kinds()[t]));
  }
  const std::vector<Crossing_path> paths = paths_of_file(shell);
  count(paths.size());
  for(const Crossing_path& path : paths) {
    count(path.component);
    for(const auto& p : { path.source, path.target })
      for(double x : p) out.binary(x);
  }
  write_truncation(Row_output(out, true), shell.truncation().get());
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief writes a shell so that `read_shell()` reproduces it bit by bit: the field, cells, thresholds, facet ranges,
 * closing, truncation, and paths through its components. See \ref BsplineShell3FileFormats.
 *
 * Of the report, only the unit, the number of triangles and of components, and the thickness are written. The
 * certificate is not written; `certify()` proves it again for the shell that was read.
 *
 * \tparam Field a `Hierarchical_bspline_field_3`
 * \tparam Threshold `Constant_threshold` or `Spline_threshold<Field>`
 *
 * \param out a stream opened with `std::ios::binary`; its locale is ignored
 * \param shell the shell
 * \param format binary files are shorter than text files and are written faster
 * \return `NOT_A_SHELL` if there is no shell, or if it has numbers that are not finite or corners that are not exact.
 *   Nothing is written then. Shells of `bspline_shell_3()` and `certified_bspline_shell_3()` can always be written.
 * \cgalHeading{Cost} Linear in the size of the file.
 */
template <typename Field, typename Threshold>
Shell_file_status write_shell(std::ostream& out, const Bspline_shell_3<Field, Threshold>& shell,
                              Shell_format format = Shell_format::BINARY)
{
  if(!internal::is_shell(shell)) return Shell_file_status::NOT_A_SHELL;
  internal::File_output output(out);
  if(format == Shell_format::BINARY) {
    internal::write_binary_shell(output, shell);
    output.binary(output.checksum());
  } else {
    internal::write_ASCII_shell(output, shell);
    output.text("checksum " + Checksum::text(output.checksum()) + "\n");
  }
  return output.flush() ? Shell_file_status::SUCCESS : Shell_file_status::CANNOT_WRITE;
}

/// \ingroup PkgBsplineShell3IO
/// writes a shell to a file. On failure, an existing file remains unchanged (`write_file()`).
template <typename Field, typename Threshold>
Shell_file_status write_shell(const std::string& file, const Bspline_shell_3<Field, Threshold>& shell,
                              Shell_format format)
{
  if(!internal::is_shell(shell)) return Shell_file_status::NOT_A_SHELL;
  const bool written = write_file(
    file, [&](std::ostream& out) { return write_shell(out, shell, format) == Shell_file_status::SUCCESS; });
  return written ? Shell_file_status::SUCCESS : Shell_file_status::CANNOT_WRITE;
}

/// \ingroup PkgBsplineShell3IO
/// writes a shell to a file in the format given by its name: text if the name ends in ".txt" (as in "name.shell.txt"),
/// otherwise binary ("name.shell")
template <typename Field, typename Threshold>
Shell_file_status write_shell(const std::string& file, const Bspline_shell_3<Field, Threshold>& shell)
{
  const std::string extension = ".txt";
  const bool is_text = file.size() >= extension.size()
                       && file.compare(file.size() - extension.size(), extension.size(), extension) == 0;
  return write_shell(file, shell, is_text ? Shell_format::ASCII : Shell_format::BINARY);
}

/// \ingroup PkgBsplineShell3IO
/// returns the checksum in the last line of the shell's text file, by which other files identify the shell.
/// \pre there is a shell
template <typename Field, typename Threshold>
std::uint64_t shell_checksum(const Bspline_shell_3<Field, Threshold>& shell)
{
  CGAL_precondition(bool(shell));
  std::ostream nowhere(nullptr);
  internal::File_output output(nowhere);
  internal::write_ASCII_shell(output, shell);
  return output.checksum();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_WRITE_SHELL_H
