// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIELD_HIERARCHICAL_BSPLINE_FIELD_3_H
#define CGAL_BSPLINE_SHELL_3_FIELD_HIERARCHICAL_BSPLINE_FIELD_3_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Field/internal/to_bernstein.h>
#include <CGAL/Bspline_shell_3/Field/internal/visit_parent_points.h>
#include <CGAL/Bspline_shell_3/Spline/Tricubic_cell_3.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/assertions.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Field
 *
 * \brief a piecewise tricubic \f$C^2\f$ function on cells of different sizes, in terms of truncated hierarchical
 * B-splines.
 *
 * There is a coefficient at every lattice point of level \f$l\f$ whose function acts on a leaf of level \f$l\f$. It is
 * *free* if the function acts on no coarser leaf. Free coefficients are the unknowns of the field, and their functions
 * are linearly independent. Other coefficients *depend* on those of the level above by the two-scale relation, so that
 * the field continues the coarser splines there. The grading of `Cell_hierarchy_3` ensures that the coefficients above
 * are free. On a leaf, the field is the tricubic with the 64 coefficients of its level. In the literature, these are
 * truncated hierarchical B-splines (THB-splines) on an admissible mesh of class two.
 *
 * With cells of one size, all coefficients are free, and the field is \f$f(v) = \sum_g \lambda_g B_g(v)\f$ (Eq. 3.3 of
 * \cgalCite{CubicBsplineShell2025}). The sum is over all lattice points \f$g\f$ whose function does not vanish on all
 * cells.
 *
 * The field is defined by its free coefficients, which are `double`s. Copies share the cells. Const member functions
 * may be called concurrently.
 *
 * \cgalModels `FittableBsplineField_3`
 *
 * \tparam GeomTraits a kernel with `FT` = `double`
 */
template <typename GeomTraits = Exact_predicates_inexact_constructions_kernel>
class Hierarchical_bspline_field_3
{
  static_assert(std::is_same<typename GeomTraits::FT, double>::value,
                "GeomTraits must be a kernel with the number type double.");
public:
  typedef GeomTraits Geom_traits;
  typedef typename GeomTraits::FT FT;
  typedef typename GeomTraits::Point_3 Point_3;
  typedef typename GeomTraits::Vector_3 Vector_3;
  typedef Tricubic_cell_3 Cell;
  typedef Cell_hierarchy_3::Index Cell_index;
  static constexpr Cell_index npos = Cell_hierarchy_3::npos;

  Hierarchical_bspline_field_3() = default;

  /// constructs the zero function on the cells
  explicit Hierarchical_bspline_field_3(Cell_hierarchy_3 cells)
    : m_basis(std::make_shared<const Basis>(std::move(cells)))
  {
    constexpr bool may_have_dependent = true;
    m_coefficients.setZero(Eigen::Index(number_of_coefficients()));
    const auto zero = std::make_shared<Form_block>();
    zero->error_radii.fill(internal::conversion_radius(0, may_have_dependent));
    m_forms.assign(number_of_blocks(), zero);
  }

  /// returns another function on the same cells, with the free coefficients `x`. Like copies, the two fields share the
  /// cells. If few coefficients differ from those of this function, they also share most of the polynomials.
  /// \pre `x.size() == number_of_coefficients()`
  template <typename ConcurrencyTag = Sequential_tag>
  Hierarchical_bspline_field_3 with_coefficients(Eigen::VectorXd x) const
  {
    CGAL_precondition(std::size_t(x.size()) == number_of_coefficients());
    constexpr Eigen::Index many = 8; // If 1/8 of the coefficients differ, all cells are converted.
    Hierarchical_bspline_field_3 other;
    other.m_basis = m_basis;
    std::vector<Cell_index> different;
    for(Eigen::Index n = 0; n < x.size(); ++n)
      if(!(x[n] == m_coefficients[n])) different.push_back(Cell_index(n));
    if(many * Eigen::Index(different.size()) > x.size()) other.template set_coefficients<ConcurrencyTag>(std::move(x));
    else other.template share_with_coefficients<ConcurrencyTag>(*this, std::move(x), different);
    return other;
  }

  /// returns whether this function and another one share their cells
  bool has_cells_of(const Hierarchical_bspline_field_3& other) const { return m_basis == other.m_basis; }

  /// \name Leaf cells
  /// @{
  std::size_t number_of_cells() const { return cells().number_of_cells(); }
  bool has_exact_cells() const { return cells().is_exact(); }
  Cell cell(Cell_index c) const
  {
    const Form_block& block = *m_forms[c / block_size];
    return Cell(cells().corner(c), cells().width(c), block.form(c % block_size), block.error_radii[c % block_size]);
  }
  /// returns a leaf that contains `p`, or `npos` outside the domain
  Cell_index locate(const Point_3& p) const { return cells().locate(p); }
  /// calls `visit(n)` for all leaves that share a part of the given face of `c`; returns whether there are any
  template <typename Visitor>
  bool visit_neighbors(Cell_index c, int axis, bool positive, const Visitor& visit) const
  {
    return cells().visit_neighbors(c, axis, positive, visit);
  }
  /// calls `visit(c)` for all leaves that meet the closed box; returns whether they cover the box
  template <typename Visitor>
  bool visit_cells(const Bbox_3& box, const Visitor& visit) const
  {
    return cells().visit_cells(box, visit);
  }
  const Cell_hierarchy_3& cells() const { return m_basis->cells; }
  /// @}

  /// \name Evaluation
  /// Results are empty outside the domain.
  /// @{
  std::optional<FT> value(const Point_3& p) const
  {
    const Cell_index c = locate(p);
    if(c == npos) return std::nullopt;
    return cell(c).value(p);
  }
  std::optional<Vector_3> gradient(const Point_3& p) const
  {
    const Cell_index c = locate(p);
    if(c == npos) return std::nullopt;
    const Cell::First_order_jet jet = cell(c).first_order_jet(p);
    return Vector_3(jet.gradient[0], jet.gradient[1], jet.gradient[2]);
  }
  std::optional<Eigen::Matrix3d> hessian(const Point_3& p) const
  {
    const Cell_index c = locate(p);
    if(c == npos) return std::nullopt;
    const auto& h = cell(c).second_order_jet(p).hessian;
    Eigen::Matrix3d m;
    m << h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2];
    return m;
  }
  /// @}

  /// \name B-spline Coefficients
  /// Free coefficients are the unknowns of a fit. They are numbered with the finest level first. The lattice points,
  /// whose coefficients are free or dependent, are numbered in the same way.
  /// @{
  std::size_t number_of_coefficients() const { return m_basis->point_of_coefficient.size(); }
  const Eigen::VectorXd& coefficients() const { return m_coefficients; }

  int number_of_levels() const { return cells().number_of_levels(); }
  std::size_t number_of_points() const { return m_basis->coefficient_of_point.size(); }
  /// returns the lattice points of a level that have a coefficient
  const Lattice_set_3& points(int level) const { return m_basis->levels[std::size_t(level)].points; }
  /// returns the index of the first lattice point of a level
  Cell_index first_point(int level) const { return m_basis->levels[std::size_t(level)].first_point; }
  /// returns the free coefficient at a point, or `npos` if its coefficient is dependent
  Cell_index coefficient_of_point(Cell_index n) const { return m_basis->coefficient_of_point[n]; }
  Cell_index point_of_coefficient(Cell_index n) const { return m_basis->point_of_coefficient[n]; }

  /// calls `visit(n, weight)` for the free coefficients whose weighted sum is the dependent coefficient at a lattice
  /// point of a level
  template <typename Visitor>
  void visit_parents(int level, const Lattice_3::Point& p, const Visitor& visit) const
  {
    internal::visit_parent_points(p, [&](const Lattice_point& q, double weight) {
      visit(m_basis->coefficient_of_point[first_point(level - 1) + points(level - 1).index(q)], weight);
    });
  }

  /// returns the coefficients at all points, from the free coefficients `x`
  template <typename ConcurrencyTag = Sequential_tag>
  Eigen::VectorXd extend(const Eigen::VectorXd& x) const
  {
    const Eigen::Index size = Eigen::Index(number_of_points());
    Eigen::VectorXd all(size);
    for_each_point<ConcurrencyTag>([&](int l, Cell_index n, Cell_index point) {
      const Cell_index free = m_basis->coefficient_of_point[point];
      if(free != npos) {
        all[point] = x[free];
        return;
      }
      double sum = 0;
      visit_parents(l, points(l).point(n), [&](Cell_index parent, double weight) { sum += weight * x[parent]; });
      all[point] = sum;
    });
    return all;
  }

  /// applies the transpose of `extend()`
  Eigen::VectorXd collect(const Eigen::VectorXd& all) const
  {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(number_of_coefficients()));
    for(int l = 0; l < number_of_levels(); ++l)
      for(Cell_index n = 0; n < points(l).size(); ++n) {
        const Cell_index point = first_point(l) + n, free = m_basis->coefficient_of_point[point];
        if(free != npos) x[free] += all[point];
        else
          visit_parents(l, points(l).point(n),
                        [&](Cell_index parent, double weight) { x[parent] += weight * all[point]; });
      }
    return x;
  }

  /// returns, for each of the sixteen rows of coefficients that act on the leaf, the point of the first of its four
  /// consecutive coefficients
  std::array<Cell_index, 16> coefficient_rows(Cell_index c) const
  {
    const int l = cells().level(c);
    const Lattice_3::Point& p = cells().lattice_point(c);
    std::array<Cell_index, 16> rows;
    for(int k = 0; k < 4; ++k)
      for(int j = 0; j < 4; ++j)
        rows[4 * k + j] = first_point(l) + points(l).index(p[0] - 1, p[1] + j - 1, p[2] + k - 1);
    return rows;
  }

  /// calls `visit(n, coefficient, weight)` for the free coefficients whose weighted sum is the `n`-th of the 64
  /// coefficients that act on a leaf
  template <typename Visitor>
  void visit_coefficients(Cell_index c, const Visitor& visit) const
  {
    const std::array<Cell_index, 16> rows = coefficient_rows(c);
    const int l = cells().level(c);
    for(int n = 0; n < 64; ++n) {
      const Cell_index point = rows[n / 4] + n % 4, free = m_basis->coefficient_of_point[point];
      if(free != npos) visit(n, free, 1.);
      else
        visit_parents(l, points(l).point(point - first_point(l)),
                      [&](Cell_index parent, double weight) { visit(n, parent, weight); });
    }
  }

  /// returns the open box on which the function of a free coefficient does not vanish, rounded inward. The box may
  /// extend beyond the domain.
  Bbox_3 support(Cell_index coefficient) const
  {
    const Cell_index point = m_basis->point_of_coefficient[coefficient];
    int l = 0;
    while(point < first_point(l)) ++l;
    return support(l, points(l).point(point - first_point(l)));
  }

  /// calls `visit(coefficient, support)` for the free coefficients whose supports may meet a box
  template <typename Visitor>
  void visit_coefficients_near(const Bbox_3& box, const Visitor& visit) const
  {
    for(int l = 0; l < number_of_levels(); ++l) {
      const double width = cells().level_width(l);
      const Lattice_box range = points(l).clip(box, cells().lattice().origin(), width, 2);
      for(int k = range.first[2]; k <= range.last[2]; ++k)
        for(int j = range.first[1]; j <= range.last[1]; ++j) {
          const auto row = points(l).index_range(range.first[0], range.last[0] + 1, j, k);
          for(Cell_index n = row.first; n < row.second; ++n) {
            const Cell_index coefficient = m_basis->coefficient_of_point[first_point(l) + n];
            if(coefficient != npos) visit(coefficient, support(l, points(l).point(n)));
          }
        }
    }
  }

  /// returns the 64 Bernstein coefficients of a leaf, from the free coefficients; exact if the number type is exact
  template <typename NT>
  std::array<NT, 64> bernstein_coefficients(Cell_index c) const
  {
    std::array<NT, 64> b;
    const std::array<Cell_index, 16> rows = coefficient_rows(c);
    const int l = cells().level(c);
    for(int n = 0; n < 64; ++n) {
      const Cell_index point = rows[n / 4] + n % 4, free = m_basis->coefficient_of_point[point];
      if(free != npos) {
        b[n] = NT(m_coefficients[free]);
        continue;
      }
      b[n] = NT(0);
      visit_parents(l, points(l).point(point - first_point(l)),
                    [&](Cell_index parent, double weight) { b[n] += NT(weight) * NT(m_coefficients[parent]); });
    }
    internal::to_bernstein(b.data());
    return b;
  }

  /// replaces all free coefficients
  /// \pre `x.size() == number_of_coefficients()`
  template <typename ConcurrencyTag = Sequential_tag>
  void set_coefficients(Eigen::VectorXd x)
  {
    CGAL_precondition(std::size_t(x.size()) == number_of_coefficients());
    m_coefficients = std::move(x);
    std::vector<Point_coefficient> all(number_of_points());
    for_each_point<ConcurrencyTag>([&](int l, Cell_index, Cell_index point) { all[point] = coefficient_at(l, point); });
    m_forms.assign(number_of_blocks(), nullptr);
    set_missing_blocks<ConcurrencyTag>([&](Cell_index c, double* form) {
      return convert_to_bernstein(c, form, [&](int, Cell_index point) { return all[point]; });
    });
  }
  /// @}

private:
  // The coefficient at a point, and its absolute value, or that of the largest free coefficient on which it depends if
  // that is larger.
  struct Point_coefficient
  {
    double value, largest;
  };

  Point_coefficient coefficient_at(int level, Cell_index point) const
  {
    const Cell_index free = m_basis->coefficient_of_point[point];
    if(free != npos) return { m_coefficients[free], std::abs(m_coefficients[free]) };
    double sum = 0, largest = 0;
    visit_parents(level, points(level).point(point - first_point(level)), [&](Cell_index parent, double weight) {
      sum += weight * m_coefficients[parent];
      largest = (std::max)(largest, std::abs(m_coefficients[parent]));
    });
    return { sum, (std::max)(std::abs(sum), largest) };
  }

  // The Bernstein forms and error radii of consecutive leaves, which fields share where they are equal.
  static constexpr std::size_t block_size = 64; // leaves; smaller blocks share more, and larger ones are fewer
  struct Form_block
  {
    const double* form(std::size_t n) const { return &coefficients[64 * n]; }
    double* form(std::size_t n) { return &coefficients[64 * n]; }

    std::array<double, 64 * block_size> coefficients = {};
    std::array<double, block_size> error_radii = {};
  };

  std::size_t number_of_blocks() const { return (number_of_cells() + block_size - 1) / block_size; }

  // Calls set(cell, coefficients) for the cells of all blocks that are null. It must write the 64 Bernstein
  // coefficients, and return the error radius.
  template <typename ConcurrencyTag, typename Function>
  void set_missing_blocks(const Function& set)
  {
    constexpr std::size_t chunk = 4; // blocks
    internal::for_each_chunk<ConcurrencyTag>(m_forms.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t b = begin; b < end; ++b) {
        if(m_forms[b]) continue;
        const auto block = std::make_shared<Form_block>();
        const std::size_t first = b * block_size, size = (std::min)(block_size, number_of_cells() - first);
        for(std::size_t n = 0; n < size; ++n) block->error_radii[n] = set(Cell_index(first + n), block->form(n));
        m_forms[b] = block;
      }
    });
  }

  // Sets all free coefficients, of which some differ from those of another function on the same cells.
  template <typename ConcurrencyTag>
  void share_with_coefficients(const Hierarchical_bspline_field_3& other, Eigen::VectorXd x,
                               const std::vector<Cell_index>& different)
  {
    m_coefficients = std::move(x);
    m_forms = other.m_forms;
    std::vector<char> is_different(number_of_cells(), 0);
    for(Cell_index n : different)
      visit_cells(support(n), [&](Cell_index c) {
        is_different[c] = 1;
        m_forms[c / block_size].reset();
      });
    set_missing_blocks<ConcurrencyTag>([&](Cell_index c, double* form) {
      if(is_different[c])
        return convert_to_bernstein(c, form, [&](int level, Cell_index point) { return coefficient_at(level, point); });
      const Cell cell = other.cell(c);
      std::copy_n(cell.coefficients(), 64, form);
      return cell.error_radius();
    });
  }

  // Calls f(level, index in the level, index) for all points.
  template <typename ConcurrencyTag, typename Function>
  void for_each_point(const Function& f) const
  {
    constexpr std::size_t chunk = 1024;
    for(int l = 0; l < number_of_levels(); ++l)
      internal::for_each_chunk<ConcurrencyTag>(points(l).size(), chunk, [&](std::size_t begin, std::size_t end) {
        for(std::size_t n = begin; n < end; ++n) f(l, Cell_index(n), first_point(l) + Cell_index(n));
      });
  }

  Bbox_3 support(int level, const Lattice_3::Point& p) const
  {
    const std::array<double, 3>& origin = cells().lattice().origin();
    const double width = cells().level_width(level);
    constexpr double half = 2 - 1e-6;
    return Bbox_3(origin[0] + (p[0] - half) * width, origin[1] + (p[1] - half) * width,
                  origin[2] + (p[2] - half) * width, origin[0] + (p[0] + half) * width,
                  origin[1] + (p[1] + half) * width, origin[2] + (p[2] + half) * width);
  }

  // The cells and functions, which are the same for all fields on the cells.
  struct Basis
  {
    struct Level
    {
      Lattice_set_3 points;
      Cell_index first_point;
    };

    Basis() = default;
    explicit Basis(Cell_hierarchy_3 cells_) : cells(std::move(cells_))
    {
      const int number = cells.number_of_levels();
      levels.resize(std::size_t(number));
      for(int l = number - 1; l >= 0; --l) {
        std::vector<std::uint64_t> leaves;
        const Cell_index end = l + 1 < number ? cells.first_leaf(l + 1) : Cell_index(cells.number_of_cells());
        for(Cell_index c = cells.first_leaf(l); c < end; ++c) {
          const Lattice_3::Point& p = cells.lattice_point(c);
          leaves.push_back(Lattice_key::encode(p[0], p[1], p[2]));
        }
        // Functions are dependent if they act on cells of this size that are parts of coarser leaves.
        std::vector<std::uint64_t> coarser;
        if(l > 0)
          for(std::uint64_t key : dilate(leaves, -3, 3)) {
            const Lattice_3::Point p = Lattice_key::decode(key);
            if(cells.cells(l).index(p) == npos && cells.is_in_domain(l, p)) coarser.push_back(key);
          }
        const std::vector<std::uint64_t> dependent = dilate(std::move(coarser), -1, 2);
        const std::vector<std::uint64_t> keys = dilate(std::move(leaves), -1, 2);
        levels[l].points = Lattice_set_3(keys);
        levels[l].first_point = Cell_index(coefficient_of_point.size());
        auto d = dependent.begin();
        for(std::uint64_t key : keys) {
          while(d != dependent.end() && *d < key) ++d;
          const bool is_free = d == dependent.end() || *d != key;
          coefficient_of_point.push_back(is_free ? Cell_index(point_of_coefficient.size()) : npos);
          if(is_free) point_of_coefficient.push_back(Cell_index(coefficient_of_point.size() - 1));
        }
      }
    }

    Cell_hierarchy_3 cells;
    std::vector<Level> levels;
    std::vector<Cell_index> coefficient_of_point, point_of_coefficient;
  };

  // Writes the form of a cell, and returns its error radius; `at(level, point)` returns the coefficient at a point.
  template <typename Coefficients>
  double convert_to_bernstein(Cell_index c, double* b, const Coefficients& at) const
  {
    const std::array<Cell_index, 16> rows = coefficient_rows(c);
    const int level = cells().level(c);
    double largest = 0;
    bool is_free = true, finite = true;
    for(int n = 0; n < 64; ++n) {
      const Cell_index point = rows[n / 4] + n % 4;
      const Point_coefficient coefficient = at(level, point);
      b[n] = coefficient.value;
      finite = finite && std::isfinite(b[n]);
      largest = (std::max)(largest, coefficient.largest);
      is_free = is_free && m_basis->coefficient_of_point[point] != npos;
    }
    // Constant coefficients need no conversion: thresholds are constant in most cells.
    if(!std::all_of(b + 1, b + 64, [b](double x) { return x == b[0]; })) internal::to_bernstein(b);
    for(int n = 0; n < 64; ++n) finite = finite && std::isfinite(b[n]); // sums may overflow
    return finite ? internal::conversion_radius(largest, !is_free) : std::numeric_limits<double>::infinity();
  }

  std::shared_ptr<const Basis> m_basis = std::make_shared<const Basis>();
  Eigen::VectorXd m_coefficients;                          // free coefficients
  std::vector<std::shared_ptr<const Form_block> > m_forms; // block n: leaves n * block_size, ...
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIELD_HIERARCHICAL_BSPLINE_FIELD_3_H
