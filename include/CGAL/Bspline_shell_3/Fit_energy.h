// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_ENERGY_H
#define CGAL_BSPLINE_SHELL_3_FIT_ENERGY_H

#include <CGAL/Bspline_shell_3/Cubic_bspline.h>
#include <CGAL/Bspline_shell_3/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/internal/Normal_equations.h>
#include <CGAL/Bspline_shell_3/internal/tensor_contraction.h>
#include <CGAL/Bspline_shell_3/internal/triangle_quadrature.h>
#include <CGAL/Bspline_shell_3/sample_signed_distance.h>

#include <Eigen/Core>

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
 * \brief the four terms of the paper's energy.
 */
enum class Energy_term
{
  DISTANCE,           ///< \f$E_{SDF}\f$ (Eq. 4.2): squared difference to the signed distance, summed over the samples
  ANGLE,              ///< \f$E_{angle}\f$ (Eq. 4.3): squared difference of gradient and normal, on the facets
  SINGULAR_HESSIAN,   ///< \f$E_{singularH}\f$ (Eq. 4.4): absolute determinant of the Hessian, in the shell
  NORMAL              ///< \f$E_{normal}\f$ (Eq. 4.5): squared difference of the gradient's normal part and one
};

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief weights of the terms, \f$E = E_{SDF} + \mu (E_{angle} + \sigma E_{singularH} + \zeta E_{normal})\f$ (Eq. 4.6).
 */
struct Energy_weights
{
  double mu = 0.1;                ///< the paper's \f$\mu\f$
  double zeta = 1e5;              ///< the paper's \f$\zeta\f$
  /// \f$\sigma\f$: 1 in the paper. By default the term is left out: it does not exclude critical points, takes most of the
  /// time, and thickens the shell at corners.
  double singular_hessian = 0;

  /// all four terms, as in the paper
  static Energy_weights paper()
  {
    Energy_weights weights;
    weights.singular_hessian = 1;
    return weights;
  }
};

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief the paper's energy of a field, as a function of its coefficients.
 *
 * Coefficients are in *cell units*: user units divided by the cells' width. There, with the paper's lengths measured
 * in units of the mesh's longest box side and \f$\gamma\f$ cells per unit, the energy divided by the squared width is
 * \f[ \sum_p (F - D)^2 + \mu \left( \int |\nabla F - n|^2 + \sigma \gamma^2 \int |\det H_F|
 *     + \zeta \int (\nabla F \cdot n - 1)^2 \right) . \f]
 * All member functions speak of this quotient. Surface integrals use quadrature on the clipped mesh, volume integrals
 * the midpoints of eighths of cells.
 *
 * \tparam Field a field with uniform B-spline coefficients, `Uniform_bspline_field_3`
 */
template <typename Field>
class Fit_energy
{
  typedef typename Field::Cell_index Cell_index;
  typedef Eigen::Matrix<double, 64, 1> Local_vector;
  typedef Eigen::Matrix<double, 64, 64> Local_matrix;
  typedef std::array<double, 4> Weights;

public:
  typedef Eigen::VectorXd Vector;

  /// how many unknowns there can be: a column of the lower triangle has at most 172 entries, which `int`s number
  static constexpr std::size_t max_number_of_unknowns = std::size_t(std::numeric_limits<int>::max()) / 172;

  /// \param field gives cells and functions; its coefficients are not looked at
  /// \param samples the signed distance at the samples of all cells, user units (`sample_signed_distance()`)
  /// \param clipped the mesh, cut by the field's cells; the samples grow the way its facets face
  /// \param gamma number of cells per unit of length of the paper
  /// \param weights of the terms
  /// \pre field, samples and clipped mesh outlive this object; the field has all cells that the clipped mesh has pieces in,
  /// and at most `max_number_of_unknowns` coefficients
  Fit_energy(const Field& field, const std::vector<double>& samples, const Clipped_mesh_3& clipped,
             double gamma, const Energy_weights& weights)
    : m_field(field), m_samples(samples), m_clipped(clipped)
    , m_weights(weights), m_gamma(gamma), m_equations(field)
  {
    for(int s = 0; s < Distance_samples::per_cell; ++s)
      for(int a = 0; a < 3; ++a) {
        const double t = Distance_samples::position(s, a);
        m_sample_basis[s][0][a] = Cubic_bspline<>::values(t);
        m_sample_basis[s][1][a] = Cubic_bspline<>::first_derivatives(t);
        m_sample_basis[s][2][a] = Cubic_bspline<>::second_derivatives(t);
      }
    group_points();
  }

  /// the weight of a term in cell units
  double weight(Energy_term term) const
  {
    switch(term) {
      case Energy_term::DISTANCE: return 1;
      case Energy_term::ANGLE: return m_weights.mu;
      case Energy_term::NORMAL: return m_weights.mu * m_weights.zeta;
      case Energy_term::SINGULAR_HESSIAN: return m_weights.mu * m_weights.singular_hessian * m_gamma * m_gamma;
    }
    return 0;
  }

  /// where \f$E_{singularH}\f$ is integrated: the cells that have a sample with \f$\epsilon_1 \le F \le \epsilon_2\f$
  /// for the field `x` (cell units). Until it is called, the term is zero.
  void set_singular_hessian_domain(const Vector& x, double eps1, double eps2)
  {
    m_hessian_domain.assign(m_field.number_of_cells(), 0);
    for(Cell_index c = 0; c < m_field.number_of_cells(); ++c) {
      const std::array<double, 64> local = gather(x, c);
      for(int s = 0; s < Distance_samples::per_cell; ++s) {
        const double f = sample_value(local, s);
        if(f >= eps1 && f <= eps2) { m_hessian_domain[c] = 1; break; }
      }
    }
  }

  /// least and largest value of the field `x` at the quadrature points of the mesh, cell units
  std::pair<double, double> range_on_mesh(const Vector& x) const
  {
    std::pair<double, double> range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
    for(Cell_index c = 0; c < m_field.number_of_cells(); ++c) {
      if(m_first_point[c] == m_first_point[c+1]) continue;
      const std::array<double, 64> local = gather(x, c);
      for(std::size_t p = m_first_point[c]; p < m_first_point[c+1]; ++p) {
        const std::array<double, 3>& t = m_points[p].t;
        const double f = internal::contract(local.data(), Cubic_bspline<>::values(t[0]), Cubic_bspline<>::values(t[1]),
                                            Cubic_bspline<>::values(t[2]));
        range.first = (std::min)(range.first, f);
        range.second = (std::max)(range.second, f);
      }
    }
    return range;
  }

  /// a field near the signed distance: each coefficient is the mean of the samples under its function
  template <typename ConcurrencyTag = Sequential_tag>
  Vector initial_guess() const
  {
    Vector sum = Vector::Zero(m_field.number_of_coefficients()), weight = sum;
    Local_vector w = Local_vector::Zero();
    for(int s = 0; s < Distance_samples::per_cell; ++s) w += sample_row(s);
    m_equations.template for_each_cell<ConcurrencyTag>([&](Cell_index c) {
      Local_vector s;
      sample_right_hand_side(c, s);
      scatter(s, c, sum);
      scatter(w, c, weight);
    });
    return sum.cwiseQuotient(weight);
  }

  /// the weighted term at `x`
  template <typename ConcurrencyTag = Sequential_tag>
  double value(Energy_term term, const Vector& x) const
  {
    constexpr std::size_t chunk = 1024;
    const std::size_t size = m_field.number_of_cells();
    std::vector<double> sums((size + chunk - 1) / chunk, 0.);
    internal::for_each_chunk<ConcurrencyTag>(size, chunk, [&](std::size_t begin, std::size_t end) {
      double& sum = sums[begin / chunk];
      for(std::size_t c = begin; c < end; ++c)
        visit_residuals(term, x, Cell_index(c), [&](double residual, double w, const auto&) {
          sum += w * (term == Energy_term::SINGULAR_HESSIAN ? std::abs(residual) : residual * residual);
        });
    });
    return weight(term) * std::accumulate(sums.begin(), sums.end(), 0.);
  }

  /// the sum of the weighted terms at `x`
  template <typename ConcurrencyTag = Sequential_tag>
  double value(const Vector& x) const
  {
    double sum = value<ConcurrencyTag>(Energy_term::DISTANCE, x) + value<ConcurrencyTag>(Energy_term::ANGLE, x)
               + value<ConcurrencyTag>(Energy_term::NORMAL, x);
    if(m_weights.singular_hessian > 0) sum += value<ConcurrencyTag>(Energy_term::SINGULAR_HESSIAN, x);
    return sum;
  }

  /// the derivatives of the weighted term with respect to the coefficients (of \f$|\det H|\f$: a subgradient)
  Vector gradient(Energy_term term, const Vector& x) const
  {
    Vector g = Vector::Zero(x.size());
    for(Cell_index c = 0; c < m_field.number_of_cells(); ++c) {
      Local_vector local = Local_vector::Zero();
      visit_residuals(term, x, c, [&](double residual, double w, const auto& row) {
        const double slope = term == Energy_term::SINGULAR_HESSIAN ? (residual > 0 ? 1. : residual < 0 ? -1. : 0.)
                                                                   : 2 * residual;
        local += weight(term) * w * slope * row();
      });
      scatter(local, c, g);
    }
    return g;
  }

  /// \name Normal Equations
  /// @{
  typedef Eigen::SparseMatrix<double> Matrix;

  /// The three quadratic terms are \f$x^T A x - 2 b^T x + const\f$: writes the lower triangle of \f$A\f$, and \f$b\f$.
  template <typename ConcurrencyTag>
  void assemble(Matrix& A, Vector& b) const
  {
    m_equations.set_zero(A, b);
    const Local_matrix mass = sample_matrix();
    m_equations.template for_each_cell<ConcurrencyTag>([&](Cell_index c) {
      Local_matrix local = mass;
      Local_vector rhs;
      sample_right_hand_side(c, rhs);
      add_surface_terms(c, local, rhs);
      m_equations.add(c, local, rhs, A, b);
    });
  }

  /// Adds the Gauss-Newton matrix and right-hand side of \f$E_{singularH}\f$ linearized at `x`: of
  /// \f$\int (\det H)^2 / \max(|\det H|, \eta)\f$, whose value is the term's where \f$|\det H| \ge \eta\f$.
  template <typename ConcurrencyTag>
  void add_singular_hessian(const Vector& x, double eta, Matrix& A, Vector& b) const
  {
    m_equations.template for_each_cell<ConcurrencyTag>([&](Cell_index c) {
      if(!in_hessian_domain(c)) return;
      Eigen::Matrix<double, 64, Distance_samples::per_cell> rows;
      Local_vector rhs = Local_vector::Zero();
      const std::array<double, 64> local = gather(x, c);
      for(int s = 0; s < Distance_samples::per_cell; ++s) {
        Local_vector row;
        const double det = hessian_determinant(local, s, &row);
        const double w = weight(Energy_term::SINGULAR_HESSIAN) / Distance_samples::per_cell / (std::max)(std::abs(det), eta);
        // det(x + d) ~ det + row . d = row . (x + d) - 2 det, as the determinant is cubic
        rows.col(s) = std::sqrt(w) * row;
        rhs += w * 2 * det * row;
      }
      Local_matrix matrix = Local_matrix::Zero();
      matrix.template selfadjointView<Eigen::Lower>().rankUpdate(rows);
      m_equations.add(c, matrix, rhs, A, b);
    });
  }
  /// @}

private:
  // a quadrature point on a facet
  struct Surface_point
  {
    std::array<double, 3> t;    // position in the cell
    double weight;              // share of the area, cell units
    std::uint32_t facet;
  };

  void group_points()
  {
    const double width = m_field.cells().width();
    m_first_point.assign(m_field.number_of_cells() + 1, 0);
    Cell_index c = Field::npos;
    std::uint64_t key = 0;
    Cell_index filled = 0;      // cells below have their first point set
    for(const Clipped_mesh_3::Piece& piece : m_clipped.pieces()) {
      if(c == Field::npos || piece.cell != key) {
        key = piece.cell;
        c = m_field.cells().cell(internal::Lattice_key::decode(key));
        for(; filled <= c; ++filled) m_first_point[filled] = m_points.size();
      }
      const std::array<double, 3> corner = m_field.cells().corner(c);
      const auto local = [&](std::uint32_t v) {
        const Clipped_mesh_3::Point& p = m_clipped.point(piece.first + v);
        return std::array<double, 3>{ (p[0] - corner[0]) / width, (p[1] - corner[1]) / width, (p[2] - corner[2]) / width };
      };
      const auto add_triangle = [&](const std::array<double, 3>& p, const std::array<double, 3>& q, const std::array<double, 3>& r) {
        internal::for_each_quadrature_point(p, q, r, [&](const std::array<double, 3>& t, double w) {
          m_points.push_back({ t, w, piece.facet });
        });
      };
      if(piece.size == 3) {
        add_triangle(local(0), local(1), local(2));
        continue;
      }
      // from the middle: a mirrored or turned mesh gets the mirrored or turned points
      std::array<double, 3> middle = {};
      for(std::uint32_t v = 0; v < piece.size; ++v) {
        const std::array<double, 3> p = local(v);
        for(int a = 0; a < 3; ++a) middle[a] += p[a] / piece.size;
      }
      for(std::uint32_t v = 0; v < piece.size; ++v) add_triangle(middle, local(v), local((v + 1) % piece.size));
    }
    for(; filled < m_first_point.size(); ++filled) m_first_point[filled] = m_points.size();
  }

  static Local_vector outer(const Weights& x, const Weights& y, const Weights& z)
  {
    Local_vector v;
    for(int k = 0; k < 4; ++k)
      for(int j = 0; j < 4; ++j) {
        const double yz = y[j] * z[k];
        for(int i = 0; i < 4; ++i) v[16*k + 4*j + i] = yz * x[i];
      }
    return v;
  }

  // the derivatives of all 64 functions along a direction
  static Local_vector directional_row(const internal::Basis_jet<double, 2>& basis, const std::array<double, 3>& direction)
  {
    const auto& b = basis[0];
    const auto& d = basis[1];
    Local_vector row;
    for(int k = 0; k < 4; ++k)
      for(int j = 0; j < 4; ++j) {
        const double with_dx = direction[0] * b[1][j] * b[2][k];
        const double with_b = direction[1] * d[1][j] * b[2][k] + direction[2] * b[1][j] * d[2][k];
        for(int i = 0; i < 4; ++i) row[16*k + 4*j + i] = with_dx * d[0][i] + with_b * b[0][i];
      }
    return row;
  }

  Local_vector sample_row(int s) const
  {
    const std::array<Weights, 3>& b = m_sample_basis[s][0];
    return outer(b[0], b[1], b[2]);
  }

  double sample_value(const std::array<double, 64>& local, int s) const
  {
    const std::array<Weights, 3>& b = m_sample_basis[s][0];
    return internal::contract(local.data(), b[0], b[1], b[2]);
  }

  std::array<double, 64> gather(const Vector& x, Cell_index c) const
  {
    const std::array<Cell_index, 16> rows = m_field.coefficient_rows(c);
    std::array<double, 64> local;
    for(int r = 0; r < 16; ++r)
      for(int i = 0; i < 4; ++i) local[4*r + i] = x[rows[r] + i];
    return local;
  }

  void scatter(const Local_vector& local, Cell_index c, Vector& x) const
  {
    const std::array<Cell_index, 16> rows = m_field.coefficient_rows(c);
    for(int r = 0; r < 16; ++r)
      for(int i = 0; i < 4; ++i) x[rows[r] + i] += local[4*r + i];
  }

  bool in_hessian_domain(Cell_index c) const { return !m_hessian_domain.empty() && m_hessian_domain[c] != 0; }

  double sample(Cell_index c, int s) const
  {
    return m_samples[std::size_t(c) * Distance_samples::per_cell + s] / m_field.cells().width();
  }

  // the determinant of the Hessian at a sample and, if asked for, its derivative by the 64 coefficients
  double hessian_determinant(const std::array<double, 64>& local, int s, Local_vector* row) const
  {
    const internal::Basis_jet<double, 3>& basis = m_sample_basis[s];
    const std::array<double, 6> h = internal::second_order_jet<double>(local.data(), basis).hessian;
    const double xx = h[0], yy = h[1], zz = h[2], xy = h[3], xz = h[4], yz = h[5];
    const double cxx = yy*zz - yz*yz, cyy = xx*zz - xz*xz, czz = xx*yy - xy*xy;
    const double cxy = xz*yz - xy*zz, cxz = xy*yz - xz*yy, cyz = xy*xz - xx*yz;
    if(row != nullptr)
      *row = cxx * outer(basis[2][0], basis[0][1], basis[0][2]) + cyy * outer(basis[0][0], basis[2][1], basis[0][2])
           + czz * outer(basis[0][0], basis[0][1], basis[2][2])
           + 2*cxy * outer(basis[1][0], basis[1][1], basis[0][2]) + 2*cxz * outer(basis[1][0], basis[0][1], basis[1][2])
           + 2*cyz * outer(basis[0][0], basis[1][1], basis[1][2]);
    return xx*cxx + xy*cxy + xz*cxz;
  }

  // Calls visit(residual, weight, row) for the residuals of a term in a cell; row() is the residual's derivative by the
  // cell's 64 coefficients.
  template <typename Visitor>
  void visit_residuals(Energy_term term, const Vector& x, Cell_index c, const Visitor& visit) const
  {
    switch(term) {
      case Energy_term::DISTANCE: {
        const std::array<double, 64> local = gather(x, c);
        for(int s = 0; s < Distance_samples::per_cell; ++s) {
          const double f = sample_value(local, s);
          visit(f - sample(c, s), 1., [&]() { return sample_row(s); });
        }
        return;
      }
      case Energy_term::ANGLE:
      case Energy_term::NORMAL: {
        if(m_first_point[c] == m_first_point[c+1]) return;
        const std::array<double, 64> local = gather(x, c);
        for(std::size_t p = m_first_point[c]; p < m_first_point[c+1]; ++p) {
          const Surface_point& point = m_points[p];
          internal::Basis_jet<double, 2> basis;
          for(int a = 0; a < 3; ++a) {
            basis[0][a] = Cubic_bspline<>::values(point.t[a]);
            basis[1][a] = Cubic_bspline<>::first_derivatives(point.t[a]);
          }
          const std::array<double, 3> g = internal::first_order_jet<double>(local.data(), basis).gradient;
          const std::array<double, 3>& n = m_clipped.normal(point.facet);
          if(term == Energy_term::NORMAL)
            visit(n[0]*g[0] + n[1]*g[1] + n[2]*g[2] - 1, point.weight, [&]() { return directional_row(basis, n); });
          else
            for(int a = 0; a < 3; ++a) {
              std::array<double, 3> axis = {};
              axis[a] = 1;
              visit(g[a] - n[a], point.weight, [&]() { return directional_row(basis, axis); });
            }
        }
        return;
      }
      case Energy_term::SINGULAR_HESSIAN: {
        if(!in_hessian_domain(c)) return;
        const std::array<double, 64> local = gather(x, c);
        for(int s = 0; s < Distance_samples::per_cell; ++s)
          visit(hessian_determinant(local, s, nullptr), 1. / Distance_samples::per_cell, [&]() {
            Local_vector row;
            hessian_determinant(local, s, &row);
            return row;
          });
        return;
      }
    }
  }

  // the same for all cells
  Local_matrix sample_matrix() const
  {
    Local_matrix m = Local_matrix::Zero();
    for(int s = 0; s < Distance_samples::per_cell; ++s) {
      const Local_vector row = sample_row(s);
      m += row * row.transpose();
    }
    return m;
  }

  void sample_right_hand_side(Cell_index c, Local_vector& rhs) const
  {
    rhs.setZero();
    for(int s = 0; s < Distance_samples::per_cell; ++s)
      rhs += sample(c, s) * sample_row(s);
  }

  // E_angle and E_normal: in a frame (n, u, v) of the facet, mu (1 + zeta) (n . grad - 1)^2 + mu (u . grad)^2 + mu (v . grad)^2
  void add_surface_terms(Cell_index c, Local_matrix& matrix, Local_vector& rhs) const
  {
    constexpr int batch = 24;
    Eigen::Matrix<double, 64, 3 * batch> rows;
    int used = 0;
    const auto flush = [&]() {
      matrix.template selfadjointView<Eigen::Lower>().rankUpdate(rows.leftCols(used));
      used = 0;
    };
    const double angle = weight(Energy_term::ANGLE), both = angle + weight(Energy_term::NORMAL);
    for(std::size_t p = m_first_point[c]; p < m_first_point[c+1]; ++p) {
      const Surface_point& point = m_points[p];
      internal::Basis_jet<double, 2> basis;
      for(int a = 0; a < 3; ++a) {
        basis[0][a] = Cubic_bspline<>::values(point.t[a]);
        basis[1][a] = Cubic_bspline<>::first_derivatives(point.t[a]);
      }
      std::array<double, 3> frame[3] = { m_clipped.normal(point.facet) };
      tangent_frame(frame);
      const Local_vector along_normal = directional_row(basis, frame[0]);
      rhs += point.weight * both * along_normal;
      rows.col(used++) = std::sqrt(point.weight * both) * along_normal;
      rows.col(used++) = std::sqrt(point.weight * angle) * directional_row(basis, frame[1]);
      rows.col(used++) = std::sqrt(point.weight * angle) * directional_row(basis, frame[2]);
      if(used == 3 * batch) flush();
    }
    if(used > 0) flush();
  }

  // completes frame[0], a unit vector, to an orthonormal frame
  static void tangent_frame(std::array<double, 3>* frame)
  {
    const Eigen::Map<const Eigen::Vector3d> n(frame[0].data());
    Eigen::Map<Eigen::Vector3d> u(frame[1].data()), v(frame[2].data());
    u = n.unitOrthogonal();
    v = n.cross(u);
  }

  const Field& m_field;
  const std::vector<double>& m_samples;
  const Clipped_mesh_3& m_clipped;
  Energy_weights m_weights;
  double m_gamma;
  internal::Normal_equations<Field> m_equations;
  std::array<internal::Basis_jet<double, 3>, Distance_samples::per_cell> m_sample_basis;
  std::vector<Surface_point> m_points;        // by cell
  std::vector<std::size_t> m_first_point;     // of each cell, and the end
  std::vector<char> m_hessian_domain;         // by cell, or empty
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_ENERGY_H
