// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SURFACE_QUADRATURE_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SURFACE_QUADRATURE_H

#include <CGAL/Bspline_shell_3/Fit/internal/basis_rows.h>
#include <CGAL/Bspline_shell_3/Fit/internal/polygon_quadrature.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Quadrature on the parts of a mesh in the cells of a field.
template <typename Field>
class Surface_quadrature
{
  typedef typename Field::Cell_index Cell_index;
public:
  // \pre both outlive this object
  Surface_quadrature(const Field& field, const Clipped_mesh_3& clipped) : m_field(field), m_clipped(clipped)
  {
    m_first_piece.assign(field.number_of_cells() + 1, 0);
    for(const Clipped_mesh_3::Piece& piece : clipped.pieces()) ++m_first_piece[piece.cell + 1];
    for(std::size_t c = 0; c + 1 < m_first_piece.size(); ++c) m_first_piece[c + 1] += m_first_piece[c];
  }

  bool is_empty(Cell_index c) const { return m_first_piece[c] == m_first_piece[c + 1]; }

  // Calls f(basis, weight, normal) for the quadrature points on the mesh in a cell. Weights sum to the area in cell
  // units.
  template <typename Function>
  void for_each_point(Cell_index c, const Function& f) const
  {
    const double width = m_field.cells().width(c);
    const std::array<double, 3> corner = m_field.cells().corner(c);
    std::vector<std::array<double, 3> > polygon;
    for(std::size_t n = m_first_piece[c]; n < m_first_piece[c + 1]; ++n) {
      const Clipped_mesh_3::Piece& piece = m_clipped.pieces()[n];
      polygon.clear();
      for(std::size_t v = piece.first; v < piece.first + piece.size; ++v) {
        const Clipped_mesh_3::Point& p = m_clipped.point(v);
        polygon.push_back({ (p[0] - corner[0]) / width, (p[1] - corner[1]) / width, (p[2] - corner[2]) / width });
      }
      for_each_quadrature_point(polygon, [&](const std::array<double, 3>& t, double w) {
        f(first_order_basis(t), w, m_clipped.normal(piece.facet));
      });
    }
  }

private:
  const Field& m_field;
  const Clipped_mesh_3& m_clipped;
  std::vector<std::size_t> m_first_piece; // first piece of each cell, and the end
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SURFACE_QUADRATURE_H
