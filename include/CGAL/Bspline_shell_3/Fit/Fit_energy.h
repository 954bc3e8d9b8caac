// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_FIT_ENERGY_H
#define CGAL_BSPLINE_SHELL_3_FIT_FIT_ENERGY_H

#include <CGAL/Bspline_shell_3/Fit/Energy_weights.h>
#include <CGAL/Bspline_shell_3/Fit/Fitted_part.h>
#include <CGAL/Bspline_shell_3/Fit/internal/Cell_colors.h>
#include <CGAL/Bspline_shell_3/Fit/internal/Normal_equations.h>
#include <CGAL/Bspline_shell_3/Fit/internal/Surface_quadrature.h>
#include <CGAL/Bspline_shell_3/Fit/internal/basis_rows.h>
#include <CGAL/Bspline_shell_3/Fit/internal/condense.h>
#include <CGAL/Bspline_shell_3/Fit/sample_signed_distance.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Spline/Cubic_bspline.h>
#include <CGAL/Bspline_shell_3/Spline/tensor_contraction.h>
#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief the energy that a field minimizes, as a function of its coefficients.
 *
 * The energy of each cell is computed in *cell units*: lengths and values are divided by the cell's width, so that
 * cells of all sizes have equal weight. Let \f$F\f$ be the field and \f$D\f$ the signed distance in cell units, \f$p\f$
 * the samples, and \f$n\f$ the normals of facets. Let \f$B_i\f$ be the basis functions and \f$x_i\f$ their
 * coefficients, and \f$\gamma\f$ the number of root cells along the longest side of the mesh's bounding box. With the
 * weights of `Energy_weights`, the energy is
 * \f[ \sum_p (F - D)^2 + \beta \int F^2 + \nu \int (\nabla F \cdot n - 1)^2
 *     + \delta \sum_p \sum_i B_i(p) (x_i - D_c(a_i))^2 + \mu \left( \int |\nabla F - n|^2 + \sigma \gamma^2 \int |\det
 *     H_F| + \zeta \int (\nabla F \cdot n - 1)^2 \right) . \f]
 * \f$D_c\f$ is the linear function closest to the samples in the cell of \f$p\f$, and \f$a_i\f$ is the center of the
 * support of \f$B_i\f$. Surface integrals use quadrature on the clipped mesh; volume integrals use the samples, which
 * are the midpoints of the eight octants of each cell. In all member functions, `x` contains the coefficients of the
 * field divided by the width of root cells.
 *
 * \tparam Field a model of `FittableBsplineField_3`
 */
template <typename Field>
class Fit_energy
{
  typedef typename Field::Cell_index Cell_index;
  typedef internal::Local_vector Local_vector;
  typedef internal::Local_matrix Local_matrix;
  typedef std::array<double, 4> Weights;

public:
  typedef Eigen::VectorXd Vector;

  /// the largest number of unknowns: the entries of the matrix are indexed by `int`s, and a column of its lower
  /// triangle has at most 172 of them
  static constexpr std::size_t max_number_of_unknowns = std::size_t(std::numeric_limits<int>::max()) / 172;

  /// \param field the cells and basis functions; its coefficients are ignored
  /// \param samples the signed distance at the samples of all cells (`sample_signed_distance()`), in the units of the
  ///   coordinates
  /// \param clipped the mesh, clipped to the field's cells; its normals point in the direction in which the samples
  ///   increase
  /// \param gamma number of root cells along the longest side of the mesh's bounding box
  /// \param weights the weights of the terms
  /// \pre field, samples, and clipped mesh outlive this object; the field contains all cells with pieces of the clipped
  ///   mesh, and has at most `max_number_of_unknowns` coefficients
  Fit_energy(const Field& field, const std::vector<double>& samples, const Clipped_mesh_3& clipped, double gamma,
             const Energy_weights& weights)
    : m_field(field), m_samples(samples), m_surface(field, clipped), m_weights(weights), m_gamma(gamma), m_colors(field)
  {
    for(int s = 0; s < Distance_samples::per_cell; ++s)
      for(int a = 0; a < 3; ++a) {
        const double t = Distance_samples::position(s, a);
        m_sample_basis[s][0][a] = Cubic_bspline<>::values(t);
        m_sample_basis[s][1][a] = Cubic_bspline<>::first_derivatives(t);
        m_sample_basis[s][2][a] = Cubic_bspline<>::second_derivatives(t);
      }
    m_share.setZero();
    for(int s = 0; s < Distance_samples::per_cell; ++s) m_share += sample_row(s);
  }

  /// returns the weight of a term in cell units
  double weight(Energy_term term) const
  {
    switch(term) {
      case Energy_term::DISTANCE: return 1;
      case Energy_term::SURFACE: return m_weights.surface;
      case Energy_term::ANGLE: return m_weights.mu;
      case Energy_term::NORMAL: return m_weights.normal + m_weights.mu * m_weights.zeta;
      case Energy_term::COEFFICIENTS: return m_weights.coefficients;
      case Energy_term::SINGULAR_HESSIAN: return m_weights.mu * m_weights.singular_hessian * m_gamma * m_gamma;
    }
    return 0;
  }

  /// sets the factor by which the weight of the term `SURFACE` is multiplied in each cell; by default, all factors are
  /// 1
  void set_surface_factors(std::vector<float> factors) { m_surface_factors = std::move(factors); }

  /// sets the domain of \f$E_{singularH}\f$: the cells with a sample at which the field with the coefficients `x` lies
  /// between `eps1` and `eps2`, which are divided by the width of root cells. Before the first call, the term is zero.
  void set_singular_hessian_domain(const Vector& x, double eps1, double eps2)
  {
    m_hessian_domain.assign(m_field.number_of_cells(), 0);
    const Vector points = m_field.extend(x);
    for(Cell_index c = 0; c < m_field.number_of_cells(); ++c) {
      const std::array<double, 64> local = gather(points, c);
      for(int s = 0; s < Distance_samples::per_cell; ++s) {
        const double f = sample_value(local, s) / scale(c);
        if(f >= eps1 && f <= eps2) {
          m_hessian_domain[c] = 1;
          break;
        }
      }
    }
  }

  /// returns the smallest and the largest value, at the quadrature points of the mesh, of the field with the
  /// coefficients `x`, divided by the width of root cells
  std::pair<double, double> range_on_mesh(const Vector& x) const
  {
    std::pair<double, double> range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
    const Vector points = m_field.extend(x);
    for(Cell_index c = 0; c < m_field.number_of_cells(); ++c) {
      if(m_surface.is_empty(c)) continue;
      const std::array<double, 64> local = gather(points, c);
      m_surface.for_each_point(c, [&](const auto& basis, double, const auto&) {
        const double f = internal::contract(local.data(), basis[0][0], basis[0][1], basis[0][2]);
        range.first = (std::min)(range.first, f / scale(c));
        range.second = (std::max)(range.second, f / scale(c));
      });
    }
    return range;
  }

  /// returns the coefficients of a field close to the signed distance. Each coefficient is the weighted mean of linear
  /// functions, fitted to the samples in the surrounding leaves of its level, at the center of its basis function. On
  /// cells of one size, these coefficients minimize the term `COEFFICIENTS`.
  template <typename ConcurrencyTag = Sequential_tag>
  Vector initial_guess() const
  {
    Vector sum = Vector::Zero(Eigen::Index(m_field.number_of_points())), weight = sum;
    m_colors.template for_each_cell<ConcurrencyTag>([&](Cell_index c) {
      scatter(m_share.cwiseProduct(extended_samples(c)) / (scale(c) * scale(c)), c, sum);
      scatter(m_share / scale(c), c, weight);
    });
    Vector guess(Eigen::Index(m_field.number_of_coefficients()));
    for(Eigen::Index u = 0; u < guess.size(); ++u) {
      const Eigen::Index point = Eigen::Index(m_field.point_of_coefficient(Cell_index(u)));
      guess[u] = sum[point] / weight[point];
    }
    return guess;
  }

  /// returns the weighted term of the field with the coefficients `x`
  template <typename ConcurrencyTag = Sequential_tag>
  double value(Energy_term term, const Vector& x) const
  {
    constexpr std::size_t chunk = 1024;
    const std::size_t size = m_field.number_of_cells();
    std::vector<double> sums((size + chunk - 1) / chunk, 0.);
    const Vector points = m_field.extend(x);
    internal::for_each_chunk<ConcurrencyTag>(size, chunk, [&](std::size_t begin, std::size_t end) {
      double& sum = sums[begin / chunk];
      for(std::size_t c = begin; c < end; ++c)
        visit_residuals(term, points, Cell_index(c), [&](double residual, double w, const auto&) {
          sum += w * (term == Energy_term::SINGULAR_HESSIAN ? std::abs(residual) : residual * residual);
        });
    });
    return weight(term) * std::accumulate(sums.begin(), sums.end(), 0.);
  }

  /// returns the sum of the weighted terms of this field
  template <typename ConcurrencyTag = Sequential_tag>
  double value(const Vector& x) const
  {
    double sum = 0;
    for(Energy_term term : { Energy_term::DISTANCE, Energy_term::SURFACE, Energy_term::ANGLE,
                             Energy_term::SINGULAR_HESSIAN, Energy_term::NORMAL, Energy_term::COEFFICIENTS })
      if(weight(term) > 0) sum += value<ConcurrencyTag>(term, x);
    return sum;
  }

  /// returns the derivatives of the weighted term with respect to the coefficients (for \f$|\det H|\f$, a subgradient);
  /// sequential
  Vector gradient(Energy_term term, const Vector& x) const
  {
    const Vector points = m_field.extend(x);
    Vector g = Vector::Zero(points.size());
    for(Cell_index c = 0; c < m_field.number_of_cells(); ++c) {
      Local_vector local = Local_vector::Zero();
      visit_residuals(term, points, c, [&](double residual, double w, const auto& row) {
        const double slope = term == Energy_term::SINGULAR_HESSIAN ? (residual > 0   ? 1.
                                                                      : residual < 0 ? -1.
                                                                                     : 0.)
                                                                   : 2 * residual;
        local += weight(term) * w * slope * row();
      });
      scatter(local, c, g);
    }
    return m_field.collect(g);
  }

  /// \name Normal Equations
  /// @{
  typedef Eigen::SparseMatrix<double> Matrix;

  /// assembles the quadratic terms \f$x^T A x - 2 b^T x + const\f$: the lower triangle of \f$A\f$, and \f$b\f$
  template <typename ConcurrencyTag>
  void assemble(Matrix& A, Vector& b) const
  {
    const Local_matrix of_samples = sample_matrix();
    assemble_cells<ConcurrencyTag>(nullptr, A, b, [&](Cell_index c, Local_matrix& local, Local_vector& rhs) {
      local = of_samples;
      sample_right_hand_side(c, rhs);
      add_surface_terms(c, local, rhs);
      return true;
    });
  }

  /// assembles the quadratic terms as functions of some unknowns, while the others keep their values in `x`. Entries of
  /// \f$A\f$ and \f$b\f$ for the others are zero. The time is proportional to the number of cells on which the unknowns
  /// act.
  template <typename ConcurrencyTag>
  void assemble(const Fitted_part& part, const Vector& x, Matrix& A, Vector& b) const
  {
    const Local_matrix of_samples = sample_matrix();
    const Vector points = m_field.extend(x);
    assemble_cells<ConcurrencyTag>(&part.points, A, b, [&](Cell_index c, Local_matrix& local, Local_vector& rhs) {
      if(!part.cells[c]) return false;
      local = of_samples;
      sample_right_hand_side(c, rhs);
      add_surface_terms(c, local, rhs);
      const std::array<double, 64> at_x = gather(points, c);
      rhs -= local.template selfadjointView<Eigen::Lower>() * Eigen::Map<const Local_vector>(at_x.data());
      return true;
    });
    // Convert the right-hand side from changes of the unknowns to their values.
    for(Eigen::Index u = 0; u < b.size(); ++u)
      if(!part.coefficients[std::size_t(u)]) b[u] = 0;
    b += A.template selfadjointView<Eigen::Lower>() * x;
  }

  /// adds the Gauss-Newton matrix and right-hand side of \f$E_{singularH}\f$, linearized at `x`: those of \f$\int (\det
  /// H)^2 / \max(|\det H|, \eta)\f$, which equals the term where \f$|\det H| \ge \eta\f$ (in cell units)
  template <typename ConcurrencyTag>
  void add_singular_hessian(const Vector& x, double eta, Matrix& A, Vector& b) const
  {
    Matrix more;
    Vector more_rhs;
    const Vector points = m_field.extend(x);
    assemble_cells<ConcurrencyTag>(nullptr, more, more_rhs, [&](Cell_index c, Local_matrix& matrix, Local_vector& rhs) {
      if(!in_hessian_domain(c)) return false;
      Eigen::Matrix<double, 64, Distance_samples::per_cell> rows;
      rhs.setZero();
      const std::array<double, 64> local = gather(points, c);
      for(int s = 0; s < Distance_samples::per_cell; ++s) {
        Local_vector row;
        const double det = internal::hessian_determinant(local, m_sample_basis[s], &row);
        const double w = weight(Energy_term::SINGULAR_HESSIAN) / Distance_samples::per_cell
                         / (std::max)(std::abs(det), eta);
        // det(x + d) ~ det + row . d = row . (x + d) - 2 det, because the determinant is cubic
        rows.col(s) = std::sqrt(w) * row;
        rhs += w * 2 * det * row;
      }
      matrix.setZero();
      matrix.template selfadjointView<Eigen::Lower>().rankUpdate(rows);
      return true;
    });
    // The two matrices have the same pattern.
    Eigen::Map<Vector>(A.valuePtr(), A.nonZeros()) += Eigen::Map<const Vector>(more.valuePtr(), more.nonZeros());
    b += more_rhs;
  }
  /// @}

private:
  // Assembles the equations of all points, or of the chosen points. local(c, matrix, rhs) computes the contribution of
  // a cell, and returns false if there is none.
  template <typename ConcurrencyTag, typename Local>
  void assemble_cells(const std::vector<char>* chosen, Matrix& A, Vector& b, const Local& local) const
  {
    const internal::Normal_equations<Field> equations(m_field, chosen);
    Matrix all;
    Vector all_rhs;
    equations.template set_zero<ConcurrencyTag>(all, all_rhs);
    m_colors.template for_each_cell<ConcurrencyTag>([&](Cell_index c) {
      Local_matrix matrix;
      Local_vector rhs;
      if(!local(c, matrix, rhs)) return;
      const double s = scale(c);
      equations.add(c, s * s * matrix, s * rhs, all, all_rhs);
    });
    internal::condense<ConcurrencyTag>(m_field, equations, all, all_rhs, A, b);
  }

  // Returns the factor that converts coefficients to cell units: the width of root cells divided by that of the cell.
  double scale(Cell_index c) const { return double(1 << m_field.cells().level(c)); }

  Local_vector sample_row(int s) const
  {
    const std::array<Weights, 3>& b = m_sample_basis[s][0];
    return internal::outer(b[0], b[1], b[2]);
  }

  double sample_value(const std::array<double, 64>& local, int s) const
  {
    const std::array<Weights, 3>& b = m_sample_basis[s][0];
    return internal::contract(local.data(), b[0], b[1], b[2]);
  }

  // Returns the coefficients that act on a cell, in cell units, from the coefficients at all points.
  std::array<double, 64> gather(const Vector& points, Cell_index c) const
  {
    const std::array<Cell_index, 16> rows = m_field.coefficient_rows(c);
    const double s = scale(c);
    std::array<double, 64> local;
    for(int r = 0; r < 16; ++r)
      for(int i = 0; i < 4; ++i) local[4 * r + i] = s * points[rows[r] + i];
    return local;
  }

  // The transpose of gather().
  void scatter(const Local_vector& local, Cell_index c, Vector& points) const
  {
    const std::array<Cell_index, 16> rows = m_field.coefficient_rows(c);
    const double s = scale(c);
    for(int r = 0; r < 16; ++r)
      for(int i = 0; i < 4; ++i) points[rows[r] + i] += s * local[4 * r + i];
  }

  double surface_factor(Cell_index c) const { return m_surface_factors.empty() ? 1 : double(m_surface_factors[c]); }

  bool in_hessian_domain(Cell_index c) const { return !m_hessian_domain.empty() && m_hessian_domain[c] != 0; }

  double sample(Cell_index c, int s) const
  {
    return m_samples[std::size_t(c) * Distance_samples::per_cell + s] / m_field.cells().width(c);
  }

  // Calls visit(residual, weight, row) for the residuals of a term in a cell; row() is the derivative of the residual
  // with respect to the cell's 64 coefficients in cell units.
  template <typename Visitor>
  void visit_residuals(Energy_term term, const Vector& points, Cell_index c, const Visitor& visit) const
  {
    switch(term) {
      case Energy_term::DISTANCE: {
        const std::array<double, 64> local = gather(points, c);
        for(int s = 0; s < Distance_samples::per_cell; ++s) {
          const double f = sample_value(local, s);
          visit(f - sample(c, s), 1., [&]() { return sample_row(s); });
        }
        return;
      }
      case Energy_term::COEFFICIENTS: {
        const std::array<double, 64> local = gather(points, c);
        const Local_vector extended = extended_samples(c);
        for(int n = 0; n < 64; ++n)
          visit(local[n] - extended[n], m_share[n], [&]() { return Local_vector(Local_vector::Unit(n)); });
        return;
      }
      case Energy_term::SURFACE:
      case Energy_term::ANGLE:
      case Energy_term::NORMAL: {
        if(m_surface.is_empty(c)) return;
        const std::array<double, 64> local = gather(points, c);
        m_surface.for_each_point(c, [&](const auto& basis, double w, const std::array<double, 3>& n) {
          const internal::First_order_jet<double> jet = internal::first_order_jet<double>(local.data(), basis);
          if(term == Energy_term::SURFACE) {
            visit(jet.value, w * surface_factor(c),
                  [&]() { return internal::outer(basis[0][0], basis[0][1], basis[0][2]); });
            return;
          }
          const std::array<double, 3>& g = jet.gradient;
          if(term == Energy_term::NORMAL)
            visit(internal::dot(n, g) - 1, w, [&]() { return internal::directional_row(basis, n); });
          else
            for(int a = 0; a < 3; ++a) {
              std::array<double, 3> axis = {};
              axis[a] = 1;
              visit(g[a] - n[a], w, [&]() { return internal::directional_row(basis, axis); });
            }
        });
        return;
      }
      case Energy_term::SINGULAR_HESSIAN: {
        if(!in_hessian_domain(c)) return;
        const std::array<double, 64> local = gather(points, c);
        for(int s = 0; s < Distance_samples::per_cell; ++s)
          visit(internal::hessian_determinant(local, m_sample_basis[s], nullptr), 1. / Distance_samples::per_cell,
                [&]() {
                  Local_vector row;
                  internal::hessian_determinant(local, m_sample_basis[s], &row);
                  return row;
                });
        return;
      }
    }
  }

  // Returns, in cell units, the linear function closest to the samples of a cell, at the centers of the supports of the
  // cell's 64 functions. The samples are the corners of a cube with sides of 1/2.
  Local_vector extended_samples(Cell_index c) const
  {
    constexpr int n = Distance_samples::per_cell;
    double mean = 0;
    std::array<double, 3> slope = {};
    for(int s = 0; s < n; ++s) {
      const double d = sample(c, s);
      mean += d / n;
      for(int a = 0; a < 3; ++a) slope[a] += (s >> a & 1 ? 4 : -4) * d / n;
    }
    Local_vector extended;
    for(int k = 0; k < 4; ++k)
      for(int j = 0; j < 4; ++j)
        for(int i = 0; i < 4; ++i)
          extended[16 * k + 4 * j + i] = mean + slope[0] * (i - 1.5) + slope[1] * (j - 1.5) + slope[2] * (k - 1.5);
    return extended;
  }

  // Returns the matrix of the terms DISTANCE and COEFFICIENTS, which is the same for all cells.
  Local_matrix sample_matrix() const
  {
    Local_matrix m = Local_matrix::Zero();
    for(int s = 0; s < Distance_samples::per_cell; ++s) {
      const Local_vector row = sample_row(s);
      m += row * row.transpose();
    }
    m.diagonal() += weight(Energy_term::COEFFICIENTS) * m_share;
    return m;
  }

  void sample_right_hand_side(Cell_index c, Local_vector& rhs) const
  {
    rhs.setZero();
    for(int s = 0; s < Distance_samples::per_cell; ++s) rhs += sample(c, s) * sample_row(s);
    const double w = weight(Energy_term::COEFFICIENTS);
    if(w > 0) rhs += w * m_share.cwiseProduct(extended_samples(c));
  }

  // Adds E_surface, E_angle, and E_normal. In a frame (n, u, v) of the facet, the sum of the latter two is
  //   (nu + mu (1 + zeta)) (n . grad - 1)^2 + mu (u . grad)^2 + mu (v . grad)^2
  void add_surface_terms(Cell_index c, Local_matrix& matrix, Local_vector& rhs) const
  {
    constexpr int batch = 24;
    Eigen::Matrix<double, 64, 4 * batch> rows;
    int used = 0;
    const auto flush = [&]() {
      matrix.template selfadjointView<Eigen::Lower>().rankUpdate(rows.leftCols(used));
      used = 0;
    };
    const double angle = weight(Energy_term::ANGLE), both = angle + weight(Energy_term::NORMAL);
    const double surface = weight(Energy_term::SURFACE) * surface_factor(c);
    m_surface.for_each_point(c, [&](const auto& basis, double w, const std::array<double, 3>& normal) {
      std::array<double, 3> frame[3] = { normal };
      const Local_vector along_normal = internal::directional_row(basis, frame[0]);
      rhs += w * both * along_normal;
      rows.col(used++) = std::sqrt(w * both) * along_normal;
      if(angle > 0) {
        tangent_frame(frame);
        rows.col(used++) = std::sqrt(w * angle) * internal::directional_row(basis, frame[1]);
        rows.col(used++) = std::sqrt(w * angle) * internal::directional_row(basis, frame[2]);
      }
      if(surface > 0)
        rows.col(used++) = std::sqrt(w * surface) * internal::outer(basis[0][0], basis[0][1], basis[0][2]);
      if(used > 4 * (batch - 1)) flush();
    });
    if(used > 0) flush();
  }

  // Completes the unit vector frame[0] to an orthonormal frame.
  static void tangent_frame(std::array<double, 3>* frame)
  {
    const Eigen::Map<const Eigen::Vector3d> n(frame[0].data());
    Eigen::Map<Eigen::Vector3d> u(frame[1].data()), v(frame[2].data());
    u = n.unitOrthogonal();
    v = n.cross(u);
  }

  const Field& m_field;
  const std::vector<double>& m_samples;
  internal::Surface_quadrature<Field> m_surface;
  Energy_weights m_weights;
  double m_gamma;
  internal::Cell_colors<Field> m_colors;
  std::array<internal::Basis_jet<double, 3>, Distance_samples::per_cell> m_sample_basis;
  Local_vector m_share;                 // sum of each of the 64 functions over the samples of a cell
  std::vector<char> m_hessian_domain;   // by cell, or empty
  std::vector<float> m_surface_factors; // by cell, or empty
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_FIT_ENERGY_H
