// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_FIELD_PREDICATES_3_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_FIELD_PREDICATES_3_H

#include <CGAL/Bspline_shell_3/Certificate/internal/Field_questions.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Simplex_decision.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief Rigorous predicates of a field: its sign at a point, its range and its slope on segments and triangles.
 *
 * A decision holds for the spline with its `double` coefficients, at every point of the simplex with the given, exact
 * vertices. A triangle is subdivided in dyadic barycentric coordinates. For every leaf cell that the box of a part
 * meets, the polynomial of the cell is bounded on the whole part. At each point of the part, the field is one of these
 * polynomials. So parts need not be cut at the cells' faces, and no point is lost. As the polynomials join with two
 * derivatives, continuing them slightly beyond their cells costs very little.
 *
 * Const member functions may be called from several threads at once. The class has no global state, and results do not
 * depend on the rounding mode.
 *
 * \tparam Field_ a model of `BsplineField_3`
 */
template <typename Field_>
class Field_predicates_3
{
public:
  typedef Field_ Field;
  typedef typename Field::Point_3 Point_3;
  typedef typename Field::Cell_index Cell_index;

  /// \pre `field` outlives this object
  explicit Field_predicates_3(const Field& field) : m_field(&field)
  {
    for(Cell_index c = 0; c < field.number_of_cells(); ++c)
      m_largest_width = (std::max)(m_largest_width, field.cell(c).width());
  }

  explicit Field_predicates_3(const Field&&) = delete; // it would dangle

  const Field& field() const { return *m_field; }

  /// Compares the field at `p` with `level`, exactly. Returns nothing outside the domain, or where the field has no
  /// value.
  std::optional<Comparison_result> compare(const Point_3& p, double level) const
  {
    const Cell_index c = m_field->locate(p);
    if(c == Field::npos) return std::nullopt;
    const typename Field::Cell cell = m_field->cell(c);
    if(!std::isfinite(cell.error_radius()) || std::isnan(level)) return std::nullopt;
    const Level_range range = enclose_at_point(enclosed_value(cell), cell.local_coordinates(p),
                                               internal::local_error(p, cell));
    if(range.min > level) return LARGER;
    if(range.max < level) return SMALLER;
    typedef Exact_rational ET;
    const std::array<ET, 64> b = m_field->template bernstein_coefficients<ET>(c);
    std::array<internal::Weights<ET>, 3> weights;
    for(int a = 0; a < 3; ++a) {
      const ET t = (ET(p[a]) - ET(cell.corner()[a])) / ET(cell.width());
      weights[a] = internal::polar_weights<ET>(t, t, t, 1);
    }
    return CGAL::compare(internal::contract(b.data(), weights[0], weights[1], weights[2]), ET(level));
  }

  /// Decides whether `levels.min < f < levels.max` on a segment (two points) or a triangle (three). The claim is
  /// refuted if `f` is beyond a level at some point.
  template <std::size_t size>
  Verdict values_within(const std::array<Point_3, size>& simplex, const Level_range& levels, Witness* witness = nullptr,
                        Predicate_statistics* statistics = nullptr) const
  {
    return decide(simplex, internal::Values_within{ levels }, witness, statistics);
  }

  /// Decides whether `inner < f < outer` on a segment or a triangle, for two thresholds, models of `ShellThreshold`.
  template <std::size_t size, typename Threshold>
  Verdict values_within(const std::array<Point_3, size>& simplex, const Threshold& inner, const Threshold& outer,
                        Witness* witness = nullptr, Predicate_statistics* statistics = nullptr) const
  {
    if constexpr(Threshold::is_constant) {
      return values_within(simplex, Level_range{ inner.level(), outer.level() }, witness, statistics);
    } else {
      const Verdict above = decide(simplex, internal::Is_beyond<Threshold>{ inner, 1 }, witness, statistics);
      if(above == Verdict::REFUTED) return above;
      Witness second;
      const Verdict below = decide(simplex, internal::Is_beyond<Threshold>{ outer, -1 }, &second, statistics);
      if(below == Verdict::PROVED) return above;
      if(witness) *witness = second;
      return below;
    }
  }

  /// Decides whether `inner < f < outer`, and whether all points lie in flagged cells.
  template <std::size_t size, typename Threshold>
  Verdict values_within(const std::array<Point_3, size>& simplex, const Threshold& inner, const Threshold& outer,
                        const std::vector<char>& flagged_cells) const
  {
    const Verdict verdict = values_within(simplex, inner, outer);
    return verdict == Verdict::PROVED ? decide(simplex, internal::Is_in_cells{ flagged_cells }, nullptr, nullptr)
                                      : verdict;
  }

  /// Decides whether the derivative of the field along the triangle's normal is positive on the triangle: \f$n \cdot
  /// \nabla f > 0\f$.
  /// \param[in,out] slope receives a lower bound on the derivative, per user unit along the unit normal; 0 if the claim
  ///   is not proved. If the coarse bound for whole cells is at least the initial value of `slope`, this bound is used.
  /// \pre the triangle is not degenerate
  Verdict crosses_upwards(const std::array<Point_3, 3>& triangle, Witness* witness = nullptr,
                          Predicate_statistics* statistics = nullptr, double* slope = nullptr) const
  {
    const Facet_normal n = facet_normal(triangle[0], triangle[1], triangle[2]);
    if(slope == nullptr) return decide(triangle, internal::Increases{ n.direction, n.radius }, witness, statistics);
    double squared = 0;
    for(double x : n.direction) squared += (std::abs(x) + n.radius) * (std::abs(x) + n.radius);
    const double length = std::sqrt(squared) * (1 + 16 * internal::rounding);
    internal::Least_value least = { *slope * length, std::numeric_limits<double>::infinity() };
    const Verdict verdict = decide(triangle, internal::Increases{ n.direction, n.radius }, witness, statistics, &least);
    // A slope that is too large for a number is at least the largest number. If the quotient is nearly subnormal,
    // rounding may increase it by more than the factor takes back: then no slope is known.
    constexpr double largest = (std::numeric_limits<double>::max)();
    const bool is_known = verdict == Verdict::PROVED && least.value >= internal::underflow;
    *slope = is_known ? (std::min)(least.value, largest) / length * (1 - 4 * internal::rounding) : 0;
    return verdict;
  }

  /// Decides whether the field strictly increases along the segment, from its first point to its second.
  Verdict increases(const std::array<Point_3, 2>& segment, Witness* witness = nullptr,
                    Predicate_statistics* statistics = nullptr) const
  {
    return decide(segment, internal::along(segment), witness, statistics);
  }

  /// Decides whether the field minus a threshold strictly increases along the segment.
  template <typename Threshold>
  Verdict increases_above(const std::array<Point_3, 2>& segment, const Threshold& threshold, Witness* witness = nullptr,
                          Predicate_statistics* statistics = nullptr) const
  {
    if constexpr(Threshold::is_constant) return increases(segment, witness, statistics);
    else
      return decide(segment, internal::Increases_above<Threshold>{ internal::along(segment), threshold }, witness,
                    statistics);
  }

  /// Returns `true` if the field is certainly, and strictly, on the positive or negative side of a threshold at a
  /// point. This is exact for constant thresholds. Returns `false` outside the domain.
  template <typename Threshold>
  bool is_beyond(const Point_3& p, const Threshold& threshold, Sign side) const
  {
    if constexpr(Threshold::is_constant) {
      const std::optional<Comparison_result> result = compare(p, threshold.level());
      return result && *result == (side == POSITIVE ? LARGER : SMALLER);
    } else {
      if(m_field->locate(p) == Field::npos) return false; // also if it is outside by less than rounding
      Witness w;
      return decide(std::array<Point_3, 2>{ p, p },
                    internal::Is_beyond<Threshold>{ threshold, side == POSITIVE ? -1 : 1 }, &w, nullptr)
               == Verdict::REFUTED
             && !w.outside;
    }
  }

private:
  template <std::size_t size, typename Question>
  Verdict decide(const std::array<Point_3, size>& simplex, const Question& question, Witness* witness,
                 Predicate_statistics* statistics, internal::Least_value* bound_below = nullptr) const
  {
    return internal::Simplex_decision<Field, size, Question>(*m_field, m_largest_width, simplex, question, witness,
                                                             statistics, bound_below)();
  }

  const Field* m_field;
  double m_largest_width = 0; // largest width of a cell
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_FIELD_PREDICATES_3_H
