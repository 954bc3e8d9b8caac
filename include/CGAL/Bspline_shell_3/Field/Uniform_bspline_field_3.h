// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIELD_UNIFORM_BSPLINE_FIELD_3_H
#define CGAL_BSPLINE_SHELL_3_FIELD_UNIFORM_BSPLINE_FIELD_3_H

#include <CGAL/Bspline_shell_3/Cells/Cell_complex_3.h>
#include <CGAL/Bspline_shell_3/Field/internal/Field_evaluation.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/assertions.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Field
 *
 * \brief a piecewise tricubic \f$C^2\f$ function on a set of equal cells: \f$f(v) = \sum_g \lambda_g B_g(v)\f$ (Eq. 3.3
 * of \cgalCite{CubicBsplineShell2025}). The sum is over all lattice points \f$g\f$ whose function does not vanish on
 * all cells.
 *
 * The field is defined by its coefficients \f$\lambda_g\f$, which are `double`s. The Bernstein coefficients of the
 * cells are stored as well. Const member functions may be called concurrently.
 *
 * \cgalModels `FittableBsplineField_3`
 *
 * \tparam GeomTraits a kernel with `FT` = `double`
 */
template <typename GeomTraits = Exact_predicates_inexact_constructions_kernel>
class Uniform_bspline_field_3 : public internal::Field_evaluation<Uniform_bspline_field_3<GeomTraits>, GeomTraits>
{
  typedef internal::Field_evaluation<Uniform_bspline_field_3, GeomTraits> Base;
public:
  typedef typename Base::Point_3 Point_3;
  typedef typename Base::Cell Cell;
  typedef Cell_complex_3::Index Cell_index;
  static constexpr Cell_index npos = Cell_complex_3::npos;

  Uniform_bspline_field_3() = default;

  /// constructs the zero function on the cells
  explicit Uniform_bspline_field_3(Cell_complex_3 cells) : m_cells(std::move(cells))
  {
    std::vector<std::uint64_t> keys;
    keys.reserve(m_cells.number_of_cells());
    for(Cell_index c = 0; c < m_cells.number_of_cells(); ++c) {
      const Lattice_3::Point& p = m_cells.lattice_point(c);
      keys.push_back(Lattice_key::encode(p[0], p[1], p[2]));
    }
    m_functions = Lattice_set_3(dilate(std::move(keys), -1, 2));
    set_coefficients(Eigen::VectorXd::Zero(m_functions.size()));
  }

  /// \name Leaf cells
  /// @{
  std::size_t number_of_cells() const { return m_cells.number_of_cells(); }
  bool has_exact_cells() const { return m_cells.is_exact(); }
  Cell cell(Cell_index c) const
  {
    return Cell(m_cells.corner(c), m_cells.width(), &m_bernstein[std::size_t(c) * 64], m_error_radius[c]);
  }
  /// returns a cell that contains `p`, or `npos` outside the domain
  Cell_index locate(const Point_3& p) const { return m_cells.locate(p); }
  /// calls `visit(n)` for the cell across a face of `c`; returns whether there is one
  template <typename Visitor>
  bool visit_neighbors(Cell_index c, int axis, bool positive, const Visitor& visit) const
  {
    const Cell_index n = m_cells.neighbor(c, axis, positive);
    if(n != npos) visit(n);
    return n != npos;
  }
  /// calls `visit(c)` for all cells that meet the closed box; returns whether they cover the box
  template <typename Visitor>
  bool visit_cells(const Bbox_3& box, const Visitor& visit) const
  {
    return m_cells.visit_cells(box, visit);
  }
  const Cell_complex_3& cells() const { return m_cells; }
  /// @}

  /// \name B-spline Coefficients
  /// Coefficients are the unknowns of a fit.
  /// @{
  std::size_t number_of_coefficients() const { return m_functions.size(); }
  const Eigen::VectorXd& coefficients() const { return m_coefficients; }
  /// returns the lattice points at which the functions are centered, in the order of the coefficients
  const Lattice_set_3& functions() const { return m_functions; }

  /// \name As a Hierarchy
  /// A fit uses the field as a hierarchy of one level, in which every lattice point has its own coefficient (see
  /// `Hierarchical_bspline_field_3`).
  /// @{
  int number_of_levels() const { return 1; }
  std::size_t number_of_points() const { return m_functions.size(); }
  const Lattice_set_3& points(int) const { return m_functions; }
  Cell_index first_point(int) const { return 0; }
  Cell_index coefficient_of_point(Cell_index n) const { return n; }
  Cell_index point_of_coefficient(Cell_index n) const { return n; }
  Eigen::VectorXd extend(Eigen::VectorXd x) const { return x; }
  Eigen::VectorXd collect(Eigen::VectorXd all) const { return all; }
  /// @}

  /// returns, for each of the sixteen rows of coefficients that act on the cell, the index of the first of its four
  /// consecutive coefficients
  std::array<Cell_index, 16> coefficient_rows(Cell_index c) const
  {
    const Lattice_3::Point& p = m_cells.lattice_point(c);
    std::array<Cell_index, 16> rows;
    for(int k = 0; k < 4; ++k)
      for(int j = 0; j < 4; ++j) rows[4 * k + j] = m_functions.index(p[0] - 1, p[1] + j - 1, p[2] + k - 1);
    return rows;
  }

  /// returns the 64 B-spline coefficients that act on a cell
  std::array<double, 64> local_coefficients(Cell_index c) const
  {
    const std::array<Cell_index, 16> rows = coefficient_rows(c);
    std::array<double, 64> local;
    for(int r = 0; r < 16; ++r)
      for(int i = 0; i < 4; ++i) local[4 * r + i] = m_coefficients[rows[r] + i];
    return local;
  }

  /// returns the 64 Bernstein coefficients of a cell, from the B-spline coefficients; exact if the number type is exact
  template <typename NT>
  std::array<NT, 64> bernstein_coefficients(Cell_index c) const
  {
    const std::array<double, 64> local = local_coefficients(c);
    std::array<NT, 64> b;
    for(int n = 0; n < 64; ++n) b[n] = NT(local[n]);
    internal::to_bernstein(b.data());
    return b;
  }

  /// replaces all coefficients
  /// \pre `x.size() == number_of_coefficients()`
  template <typename ConcurrencyTag = Sequential_tag>
  void set_coefficients(Eigen::VectorXd x)
  {
    CGAL_precondition(std::size_t(x.size()) == number_of_coefficients());
    m_coefficients = std::move(x);
    m_bernstein.resize(64 * number_of_cells());
    m_error_radius.resize(number_of_cells());
    internal::for_each_chunk<ConcurrencyTag>(number_of_cells(), 256, [this](std::size_t begin, std::size_t end) {
      for(std::size_t c = begin; c < end; ++c) convert_to_bernstein(Cell_index(c));
    });
  }
  /// @}

private:
  void convert_to_bernstein(Cell_index c)
  {
    double largest = 0;
    bool finite = true;
    for(double x : local_coefficients(c)) {
      largest = (std::max)(largest, std::abs(x));
      finite = finite && std::isfinite(x);
    }
    const std::array<double, 64> b = bernstein_coefficients<double>(c);
    std::copy(b.begin(), b.end(), m_bernstein.begin() + 64 * std::size_t(c));
    for(double x : b) finite = finite && std::isfinite(x); // sums may overflow
    m_error_radius[c] = finite ? internal::conversion_radius(largest, false) : std::numeric_limits<double>::infinity();
  }

  Cell_complex_3 m_cells;
  Lattice_set_3 m_functions;
  Eigen::VectorXd m_coefficients;
  std::vector<double> m_bernstein;
  std::vector<double> m_error_radius;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIELD_UNIFORM_BSPLINE_FIELD_3_H
