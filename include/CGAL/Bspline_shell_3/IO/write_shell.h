// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_WRITE_SHELL_H
#define CGAL_BSPLINE_SHELL_3_IO_WRITE_SHELL_H

#include <CGAL/Bspline_shell_3/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/IO/Shell_file_status.h>
#include <CGAL/Bspline_shell_3/IO/checksum.h>
#include <CGAL/Bspline_shell_3/IO/write_file.h>
#include <CGAL/Bspline_shell_3/internal/File_output.h>
#include <CGAL/Bspline_shell_3/internal/shell_file.h>

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// all but the last line
template <typename Shell>
void write_ASCII_shell(File_output& out, const Shell& shell)
{
  typedef typename Shell::Field Field;
  const Field& field = shell.field();
  const Lattice_3& lattice = field.cells().lattice();
  const auto word = [&out](auto x) {
    out.text(" ");
    out.decimal(x);
  };
  const auto point = [&](const Lattice_point& p) {
    out.decimal(p[0]);
    word(p[1]);
    word(p[2]);
  };
  out.text(ASCII_shell_magic);
  word(ASCII_shell_version);
  out.text(" ascii\nunit");
  word(shell.report().unit);
  out.text("\nlevels");
  word(shell.inner_level());
  word(shell.outer_level());
  out.text("\ntriangles");
  word(shell.report().triangles);
  out.text(" components");
  word(shell.report().components);
  out.text("\nfield uniform");
  for(double x : lattice.origin()) word(x);
  word(lattice.spacing());

  out.text("\nfunctions");
  word(field.number_of_coefficients());
  out.text("\n");
  for(typename Field::Cell_index n = 0; n < field.number_of_coefficients(); ++n) {
    point(field.functions().point(n));
    word(field.coefficients()[n]);
    out.text("\n");
  }

  out.text("leaves");
  word(field.number_of_cells());
  out.text("\n");
  for(typename Field::Cell_index c = 0; c < field.number_of_cells(); ++c) {
    const auto cell = field.cell(c);
    point(field.cells().lattice_point(c));
    word(shell.shell_cells()[c] ? 1 : 0);
    for(double x : cell.corner()) word(x);
    word(cell.width());
    word(cell.error_radius());
    for(int n = 0; n < 64; ++n) word(cell.coefficients()[n]);
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
}

// all but the checksum
template <typename Shell>
void write_binary_shell(File_output& out, const Shell& shell)
{
  const auto& field = shell.field();
  const auto& cells = field.cells();
  const auto count = [&out](std::size_t n) { out.binary(std::uint64_t(n)); };
  out.text(binary_shell_magic);
  out.text(binary_shell_version);
  out.binary(shell.report().unit);
  out.binary(shell.inner_level());
  out.binary(shell.outer_level());
  count(shell.report().triangles);
  count(shell.report().components);
  for(double x : cells.lattice().origin()) out.binary(x);
  out.binary(cells.lattice().spacing());
  count(field.number_of_coefficients());
  count(field.number_of_cells());
  count(shell.facet_ranges().size());
  out.binary(binary_uniform_field);
  for(Cell_complex_3::Index c = 0; c < field.number_of_cells(); ++c) {
    for(int i : cells.lattice_point(c)) out.binary(std::int32_t(i));
    out.binary(std::uint8_t(shell.shell_cells()[c] ? 1 : 0));
  }
  for(Eigen::Index n = 0; n < field.coefficients().size(); ++n) out.binary(field.coefficients()[n]);
  for(const Level_range& range : shell.facet_ranges()) {
    out.binary(range.min);
    out.binary(range.max);
  }
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief writes a shell, so that `read_shell()` reads the same shell: the same field, cells, levels and facet ranges, bit
 * by bit. See \ref BsplineShell3FileFormats.
 *
 * Of the report, the unit, the numbers of triangles and components and what follows from the shell are written.
 *
 * \param out a stream, opened with `std::ios::binary`. Its locale does not matter
 * \param shell the shell
 * \param format binary files are a fiftieth as long as text files and are written faster
 * \return `NOT_A_SHELL` if there is no shell, or not one with finite numbers and exact corners (all shells of
 * `bspline_shell_3()` are); then nothing is written
 */
template <typename GeomTraits>
Shell_file_status write_shell(std::ostream& out, const Bspline_shell_3<Uniform_bspline_field_3<GeomTraits> >& shell,
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
/// The same to a file, which is there and complete, or as it was before (`write_file()`).
template <typename GeomTraits>
Shell_file_status write_shell(const std::string& file, const Bspline_shell_3<Uniform_bspline_field_3<GeomTraits> >& shell,
                              Shell_format format)
{
  if(!internal::is_shell(shell)) return Shell_file_status::NOT_A_SHELL;
  const bool written = write_file(file, [&](std::ostream& out) {
    return write_shell(out, shell, format) == Shell_file_status::SUCCESS;
  });
  return written ? Shell_file_status::SUCCESS : Shell_file_status::CANNOT_WRITE;
}

/// \ingroup PkgBsplineShell3IO
/// The same, in the format that the name asks for: text if it ends in ".txt" (as in "name.shell.txt"), otherwise binary
/// ("name.shell").
template <typename GeomTraits>
Shell_file_status write_shell(const std::string& file, const Bspline_shell_3<Uniform_bspline_field_3<GeomTraits> >& shell)
{
  const std::string extension = ".txt";
  const bool is_text = file.size() >= extension.size()
                    && file.compare(file.size() - extension.size(), extension.size(), extension) == 0;
  return write_shell(file, shell, is_text ? Shell_format::ASCII : Shell_format::BINARY);
}

/// \ingroup PkgBsplineShell3IO
/// the checksum in the last line of the shell's text file, by which other files name the shell. \pre there is a shell
template <typename GeomTraits>
std::uint64_t shell_checksum(const Bspline_shell_3<Uniform_bspline_field_3<GeomTraits> >& shell)
{
  std::ostream nowhere(nullptr);
  internal::File_output output(nowhere);
  internal::write_ASCII_shell(output, shell);
  return output.checksum();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_WRITE_SHELL_H
