// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_WRITE_VTU_H
#define CGAL_BSPLINE_SHELL_3_IO_WRITE_VTU_H

#include <CGAL/Bspline_shell_3/IO/Shell_file_status.h>
#include <CGAL/Bspline_shell_3/IO/internal/File_output.h>
#include <CGAL/Bspline_shell_3/IO/write_file.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Control points i + 4j + 16k of a cell in the order of VTK's cubic hexahedra since file version 2.2: corners, edges,
// faces, interior.
constexpr int VTK_control_points[64] = { 0,  3,  15, 12, 48, 51, 63, 60, 1,  2,  7,  11, 13, 14, 4,  8,
                                         49, 50, 55, 59, 61, 62, 52, 56, 16, 32, 19, 35, 31, 47, 28, 44,
                                         20, 24, 36, 40, 23, 27, 39, 43, 17, 18, 33, 34, 29, 30, 45, 46,
                                         5,  6,  9,  10, 53, 54, 57, 58, 21, 22, 25, 26, 37, 38, 41, 42 };

// Numbers the control points of the given cells of a field. Neighbors of equal size share the numbers of their common
// control points. Their Bernstein coefficients there are equal as `double`s, because the same operations compute them
// from the same coefficients.
template <typename Field>
class Control_points
{
  typedef typename Field::Cell_index Index;
public:
  Control_points(const Field& field, const std::vector<Index>& cells)
    : m_field(field), m_cells(cells), m_position(field.number_of_cells(), none), m_owned(cells.size()),
      m_first(cells.size() + 1, 0)
  {
    for(std::size_t c = 0; c < cells.size(); ++c) m_position[cells[c]] = c;
    for(std::size_t c = 0; c < cells.size(); ++c) {
      const Neighbors neighbors = neighbors_of(c);
      for(int n = 0; n < 64; ++n)
        if(owner(neighbors, n).cell == c) m_owned[c].set(std::size_t(n));
      m_first[c + 1] = m_first[c] + m_owned[c].count();
    }
  }

  std::size_t size() const { return m_first.back(); }

  // Calls visit(cell, n) for each point in the order of the numbers, with the first cell that has it.
  template <typename Visitor>
  void visit_points(const Visitor& visit) const
  {
    for(std::size_t c = 0; c < m_cells.size(); ++c)
      for(int n = 0; n < 64; ++n)
        if(m_owned[c][std::size_t(n)]) visit(m_cells[c], n);
  }

  // Calls visit(number) for the points of all cells, in VTK's order.
  template <typename Visitor>
  void visit_cells(const Visitor& visit) const
  {
    for(std::size_t c = 0; c < m_cells.size(); ++c) {
      const Neighbors neighbors = neighbors_of(c);
      for(int n : VTK_control_points) {
        const Place place = owner(neighbors, n);
        // Counts the owned points before it. A bitset may be shifted by its whole length.
        visit(m_first[place.cell] + (m_owned[place.cell] << std::size_t(64 - place.point)).count());
      }
    }
  }

  std::array<double, 3> position(Index c, int n) const
  {
    const auto cell = m_field.cell(c);
    const int steps[3] = { n % 4, n / 4 % 4, n / 16 };
    std::array<double, 3> x = cell.corner();
    for(int a = 0; a < 3; ++a) x[a] += steps[a] == 3 ? cell.width() : steps[a] * cell.width() / 3;
    return x;
  }

private:
  static constexpr std::size_t none = std::size_t(-1);
  typedef std::array<std::size_t, 27> Neighbors; // positions of the cell and of its 26 neighbors of equal size, or none
  struct Place
  {
    std::size_t cell;
    int point;
  };

  Neighbors neighbors_of(std::size_t c) const
  {
    const int level = m_field.cells().level(m_cells[c]);
    const Lattice_point& p = m_field.cells().lattice_point(m_cells[c]);
    Neighbors neighbors;
    for(int n = 0; n < 27; ++n) {
      const Index cell = m_field.cells().leaf(level, { p[0] + n % 3 - 1, p[1] + n / 3 % 3 - 1, p[2] + n / 9 - 1 });
      neighbors[std::size_t(n)] = cell == Field::npos ? none : m_position[cell];
    }
    return neighbors;
  }

  // Returns the first cell that has the point, and the point's number there.
  Place owner(const Neighbors& neighbors, int point) const
  {
    Place first = { none, 0 };
    for(const Place& place : m_places[std::size_t(point)])
      if(neighbors[place.cell] < first.cell) first = { neighbors[place.cell], place.point };
    return first;
  }

  // Returns, for each point of a cell, its places in the cell and in its neighbors.
  static std::array<std::vector<Place>, 64> places()
  {
    std::array<std::vector<Place>, 64> places;
    for(int point = 0; point < 64; ++point)
      for(int n = 0; n < 27; ++n) {
        const int steps[3] = { point % 4 - 3 * (n % 3 - 1), point / 4 % 4 - 3 * (n / 3 % 3 - 1),
                               point / 16 - 3 * (n / 9 - 1) };
        if(std::all_of(steps, steps + 3, [](int s) { return s >= 0 && s < 4; }))
          places[std::size_t(point)].push_back({ std::size_t(n), steps[0] + 4 * steps[1] + 16 * steps[2] });
      }
    return places;
  }

  const Field& m_field;
  const std::vector<Index>& m_cells;
  const std::array<std::vector<Place>, 64> m_places = places();
  std::vector<std::size_t> m_position;   // by cell of the field: position in the cells
  std::vector<std::bitset<64> > m_owned; // points that no earlier cell has
  std::vector<std::size_t> m_first;      // number of the first owned point
};

// Writes a VTK XML file: first the descriptions of arrays, with the numbers in text files; then, in binary files, the
// data.
class VTU_output
{
public:
  VTU_output(std::ostream& out, Shell_format format) : m_out(out), m_binary(format == Shell_format::BINARY) {}

  void text(std::string_view text) { m_out.text(text); }
  template <typename T>
  void decimal(T x)
  {
    m_out.decimal(x);
  }

  // Describes an array of `size` numbers; `values(put)` calls put(x) for each number.
  template <typename T, typename Values>
  void array(const char* name, int components, std::size_t size, const Values& values)
  {
    m_out.text("<DataArray type=\"");
    m_out.text(std::is_floating_point<T>::value ? "Float64" : sizeof(T) == 1 ? "UInt8" : "Int64");
    m_out.text("\" Name=\"");
    m_out.text(name);
    m_out.text("\" NumberOfComponents=\"");
    m_out.decimal(components);
    if(m_binary) {
      m_out.text("\" format=\"appended\" offset=\"");
      m_out.decimal(m_offset);
      m_out.text("\"/>\n");
      m_offset += sizeof(std::uint64_t) + size * sizeof(T);
    } else {
      m_out.text("\" format=\"ascii\">\n");
      values([this](T x) {
        decimal(x);
        m_out.text("\n");
      });
      m_out.text("</DataArray>\n");
    }
  }

  template <typename T, typename Values>
  void appended_array(std::size_t size, const Values& values)
  {
    m_out.binary(std::uint64_t(size * sizeof(T)));
    values([this](T x) { m_out.binary(x); });
  }

  bool is_binary() const { return m_binary; }
  bool flush() { return m_out.flush(); }

private:
  File_output m_out;
  bool m_binary;
  std::uint64_t m_offset = 0;
};

// Functions on the same cells, with their names.
template <typename Field>
using VTU_splines = std::vector<std::pair<const char*, const Field*> >;

template <typename Field>
Shell_file_status write_VTU(std::ostream& out, const VTU_splines<Field>& splines,
                            const std::vector<typename Field::Cell_index>& cells, const Level_range* levels,
                            Shell_format format)
{
  typedef typename Field::Cell_index Index;
  const Control_points<Field> points(*splines.front().second, cells);

  const auto positions = [&](const auto& put) {
    points.visit_points([&](Index c, int n) {
      for(double x : points.position(c, n)) put(x);
    });
  };
  const auto values = [&](const Field& spline) {
    return
      [&](const auto& put) { points.visit_points([&](Index c, int n) { put(spline.cell(c).coefficients()[n]); }); };
  };
  const auto connectivity = [&](const auto& put) { points.visit_cells([&](std::size_t n) { put(std::int64_t(n)); }); };
  const auto offsets = [&](const auto& put) {
    for(std::size_t c = 1; c <= cells.size(); ++c) put(std::int64_t(64 * c));
  };
  constexpr int VTK_Bezier_hexahedron = 79;
  const auto types = [&](const auto& put) {
    for(std::size_t c = 0; c < cells.size(); ++c) put(VTK_Bezier_hexahedron);
  };
  const auto degrees = [&](const auto& put) {
    for(std::size_t n = 0; n < 3 * cells.size(); ++n) put(3);
  };

  VTU_output vtu(out, format);
  vtu.text("<?xml version=\"1.0\"?>\n"
           "<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
           "<UnstructuredGrid>\n");
  if(levels != nullptr) {
    vtu.text("<FieldData>\n<DataArray type=\"Float64\" Name=\"levels\" NumberOfTuples=\"2\" format=\"ascii\">\n");
    vtu.decimal(levels->min);
    vtu.text(" ");
    vtu.decimal(levels->max);
    vtu.text("\n</DataArray>\n</FieldData>\n");
  }
  vtu.text("<Piece NumberOfPoints=\"");
  vtu.decimal(points.size());
  vtu.text("\" NumberOfCells=\"");
  vtu.decimal(cells.size());
  vtu.text("\">\n<PointData Scalars=\"f\">\n");
  for(const auto& spline : splines) vtu.array<double>(spline.first, 1, points.size(), values(*spline.second));
  vtu.text("</PointData>\n<CellData HigherOrderDegrees=\"HigherOrderDegrees\">\n");
  vtu.array<double>("HigherOrderDegrees", 3, 3 * cells.size(), degrees);
  vtu.text("</CellData>\n<Points>\n");
  vtu.array<double>("Points", 3, 3 * points.size(), positions);
  vtu.text("</Points>\n<Cells>\n");
  vtu.array<std::int64_t>("connectivity", 1, 64 * cells.size(), connectivity);
  vtu.array<std::int64_t>("offsets", 1, cells.size(), offsets);
  vtu.array<std::uint8_t>("types", 1, cells.size(), types);
  vtu.text("</Cells>\n</Piece>\n</UnstructuredGrid>\n");
  if(vtu.is_binary()) {
    vtu.text("<AppendedData encoding=\"raw\">\n_");
    for(const auto& spline : splines) vtu.appended_array<double>(points.size(), values(*spline.second));
    vtu.appended_array<double>(3 * cells.size(), degrees);
    vtu.appended_array<double>(3 * points.size(), positions);
    vtu.appended_array<std::int64_t>(64 * cells.size(), connectivity);
    vtu.appended_array<std::int64_t>(cells.size(), offsets);
    vtu.appended_array<std::uint8_t>(cells.size(), types);
    vtu.text("\n</AppendedData>\n");
  }
  vtu.text("</VTKFile>\n");
  return vtu.flush() ? Shell_file_status::SUCCESS : Shell_file_status::CANNOT_WRITE;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief writes a field to a file for ParaView and VTK (extension .vtu), as an unstructured grid of cubic Bezier
 * hexahedra. The point data `f` contains the Bernstein coefficients, so VTK's interpolation is \f$f\f$ itself, not a
 * linear approximation.
 *
 * Cells of equal size share their common control points. Where cells of different sizes meet, the grid has hanging
 * nodes. Because \f$f\f$ is the same function on both sides, there are no gaps except for those of VTK's approximation
 * of cells.
 *
 * To view the file in ParaView 5.10 (VTK 9.1) or later, increase the representation's "Nonlinear Subdivision Level" or
 * apply the filter "Tessellate".
 *
 * \tparam Field a model of `BsplineField_3`
 * \param out a stream opened with `std::ios::binary`; its locale is ignored
 * \param field the field
 * \param format `BINARY` appends raw binary data to the XML text; text files are twice as long
 * \cgalHeading{Cost} Linear in the number of cells.
 */
template <typename Field>
Shell_file_status write_VTU(std::ostream& out, const Field& field, Shell_format format = Shell_format::BINARY)
{
  std::vector<typename Field::Cell_index> cells(field.number_of_cells());
  for(std::size_t c = 0; c < cells.size(); ++c) cells[c] = typename Field::Cell_index(c);
  return internal::write_VTU<Field>(out, { { "f", &field } }, cells, nullptr, format);
}

/// \ingroup PkgBsplineShell3IO
/// writes the field of a shell for the cells that the shell may meet (`Bspline_shell_3::shell_cells()`). Constant
/// thresholds are written as field data `levels`, and other thresholds as point data `inner` and `outer`, which contain
/// Bernstein coefficients like `f`.
/// \return `NOT_A_SHELL` if there is no shell, in which case nothing is written
template <typename Field, typename Threshold>
Shell_file_status write_VTU(std::ostream& out, const Bspline_shell_3<Field, Threshold>& shell,
                            Shell_format format = Shell_format::BINARY)
{
  if(!shell) return Shell_file_status::NOT_A_SHELL;
  std::vector<typename Field::Cell_index> cells;
  for(std::size_t c = 0; c < shell.field().number_of_cells(); ++c)
    if(shell.shell_cells()[c]) cells.push_back(typename Field::Cell_index(c));
  if constexpr(Threshold::is_constant) {
    const Level_range levels = { shell.inner_level(), shell.outer_level() };
    return internal::write_VTU<Field>(out, { { "f", &shell.field() } }, cells, &levels, format);
  } else
    return internal::write_VTU<Field>(out,
                                      { { "f", &shell.field() },
                                        { "inner", &shell.inner_threshold().field() },
                                        { "outer", &shell.outer_threshold().field() } },
                                      cells, nullptr, format);
}

/// \ingroup PkgBsplineShell3IO
/// writes a field or a shell to a file. On failure, an existing file remains unchanged (`write_file()`).
template <typename Field_or_shell>
Shell_file_status write_VTU(const std::string& file, const Field_or_shell& field,
                            Shell_format format = Shell_format::BINARY)
{
  Shell_file_status status = Shell_file_status::CANNOT_WRITE;
  const bool written = write_file(file, [&](std::ostream& out) {
    status = write_VTU(out, field, format);
    return status == Shell_file_status::SUCCESS;
  });
  return written || status == Shell_file_status::NOT_A_SHELL ? status : Shell_file_status::CANNOT_WRITE;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_WRITE_VTU_H
