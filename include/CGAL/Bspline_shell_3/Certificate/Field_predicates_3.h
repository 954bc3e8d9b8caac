// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_FIELD_PREDICATES_3_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_FIELD_PREDICATES_3_H

#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Support/power_of_two.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief A place where a claim fails or is undecided.
 */
struct Witness
{
  /// exact, dyadic barycentric coordinates of the point, by the vertices of the triangle or the ends of the segment
  std::array<double, 3> barycentric = {};
  /// the point, rounded
  std::array<double, 3> point = {};
  /// encloses the value at the point: of the field, or of the derivative along the normal per user unit
  Level_range value;
  /// whether the point lies outside the field's domain
  bool outside = false;
};

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
    const Level_range range = enclose_at_point(enclosed_value(cell), cell.local_coordinates(p), local_error(p, cell));
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
    return decide(simplex, Values_within{ levels }, witness, statistics, nullptr);
  }

  /// Decides whether `inner < f < outer` on a segment or a triangle, for two thresholds, models of `ShellThreshold`.
  template <std::size_t size, typename Threshold>
  Verdict values_within(const std::array<Point_3, size>& simplex, const Threshold& inner, const Threshold& outer,
                        Witness* witness = nullptr, Predicate_statistics* statistics = nullptr) const
  {
    if constexpr(Threshold::is_constant) {
      return values_within(simplex, Level_range{ inner.level(), outer.level() }, witness, statistics);
    } else {
      const Verdict above = decide(simplex, Is_beyond<Threshold>{ inner, 1 }, witness, statistics, nullptr);
      if(above == Verdict::REFUTED) return above;
      Witness second;
      const Verdict below = decide(simplex, Is_beyond<Threshold>{ outer, -1 }, &second, statistics, nullptr);
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
    return verdict == Verdict::PROVED ? decide(simplex, Is_in_cells{ flagged_cells }, nullptr, nullptr, nullptr)
                                      : verdict;
  }

  /// Decides whether the derivative of the field along the triangle's normal is positive on the triangle: \f$n \cdot
  /// \nabla f > 0\f$.
  /// \param[in,out] slope receives a lower bound of the derivative, per user unit along the unit normal; 0 if the claim
  ///   is not proved. If the coarse bound of whole cells is at least the initial value of `slope`, this bound is used.
  /// \pre the triangle is not degenerate
  Verdict crosses_upwards(const std::array<Point_3, 3>& triangle, Witness* witness = nullptr,
                          Predicate_statistics* statistics = nullptr, double* slope = nullptr) const
  {
    const Facet_normal n = facet_normal(triangle[0], triangle[1], triangle[2]);
    if(slope == nullptr) return decide(triangle, Increases{ n.direction, n.radius }, witness, statistics, nullptr);
    double squared = 0;
    for(double x : n.direction) squared += (std::abs(x) + n.radius) * (std::abs(x) + n.radius);
    const double length = std::sqrt(squared) * (1 + 16 * internal::rounding);
    Least_value least = { *slope * length, std::numeric_limits<double>::infinity() };
    const Verdict verdict = decide(triangle, Increases{ n.direction, n.radius }, witness, statistics, &least);
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
    return decide(segment, along(segment), witness, statistics, nullptr);
  }

  /// Decides whether the field minus a threshold strictly increases along the segment.
  template <typename Threshold>
  Verdict increases_above(const std::array<Point_3, 2>& segment, const Threshold& threshold, Witness* witness = nullptr,
                          Predicate_statistics* statistics = nullptr) const
  {
    if constexpr(Threshold::is_constant) return increases(segment, witness, statistics);
    else return decide(segment, Increases_above<Threshold>{ along(segment), threshold }, witness, statistics, nullptr);
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
      return decide(std::array<Point_3, 2>{ p, p }, Is_beyond<Threshold>{ threshold, side == POSITIVE ? -1 : 1 }, &w,
                    nullptr, nullptr)
               == Verdict::REFUTED
             && !w.outside;
    }
  }

private:
  // A question provides the tricubic to bound on a cell, and the ranges of it that prove or refute the claim.
  struct Values_within
  {
    Level_range levels;
    Enclosed_tricubic function(const typename Field::Cell& cell, Cell_index) const { return enclosed_value(cell); }
    bool proves(const Level_range& r) const { return levels.min < r.min && r.max < levels.max; }
    bool refutes(const Level_range& r) const { return r.max < levels.min || r.min > levels.max; }
    double unit(const typename Field::Cell&) const { return 1; }
  };
  template <typename Threshold>
  struct Is_beyond
  {
    const Threshold& threshold;
    int sign; // 1: above it, -1: below it
    Enclosed_tricubic function(const typename Field::Cell& cell, Cell_index c) const
    {
      Enclosed_tricubic d = threshold.difference(enclosed_value(cell), c);
      for(double& x : d.coefficients) x *= sign;
      return d;
    }
    bool proves(const Level_range& r) const { return r.min > 0; }
    bool refutes(const Level_range& r) const { return r.max < 0; }
    double unit(const typename Field::Cell&) const { return 1; }
  };
  struct Is_in_cells
  {
    const std::vector<char>& flagged;
    // The constant is positive on flagged cells. On other cells it has an infinite radius, which proves and refutes
    // nothing, as the simplex may only touch them.
    Enclosed_tricubic function(const typename Field::Cell&, Cell_index c) const
    {
      Enclosed_tricubic constant;
      constant.coefficients.fill(1);
      constant.radius = flagged[c] ? 0 : std::numeric_limits<double>::infinity();
      return constant;
    }
    bool proves(const Level_range& r) const { return r.min > 0; }
    bool refutes(const Level_range& r) const { return r.max < 0; }
    double unit(const typename Field::Cell&) const { return 1; }
  };
  struct Increases
  {
    std::array<double, 3> direction;
    double radius;
    Enclosed_tricubic function(const typename Field::Cell& cell, Cell_index) const
    {
      return enclosed_derivative(enclosed_value(cell), direction, radius);
    }
    bool proves(const Level_range& r) const { return r.min > 0; }
    bool refutes(const Level_range& r) const { return r.max <= 0; }
    double unit(const typename Field::Cell& cell) const { return cell.width(); }
  };

  template <typename Threshold>
  struct Increases_above
  {
    Increases increases;
    const Threshold& threshold;
    Enclosed_tricubic function(const typename Field::Cell& cell, Cell_index c) const
    {
      return enclosed_derivative(threshold.difference(enclosed_value(cell), c), increases.direction, increases.radius);
    }
    bool proves(const Level_range& r) const { return r.min > 0; }
    bool refutes(const Level_range& r) const { return r.max <= 0; }
    double unit(const typename Field::Cell& cell) const { return cell.width(); }
  };

  // Returns the direction of a segment, scaled by a power of two: components are at most one, and err by one rounding.
  static Increases along(const std::array<Point_3, 2>& segment)
  {
    Increases question = { {}, internal::rounding };
    for(int a = 0; a < 3; ++a) question.direction[a] = segment[1][a] - segment[0][a];
    const double unit = internal::reciprocal_power_of_two(question.direction);
    for(double& d : question.direction) d *= unit;
    return question;
  }

  // A lower bound of the quantity in question, per user unit. A proved bound suffices if it is at least `wanted`.
  struct Least_value
  {
    double wanted, value;
  };

  // A part of a segment (size two) or a triangle (size three). Its corners are in units of 2^-depth.
  template <std::size_t size>
  struct Part
  {
    std::array<std::array<std::int64_t, size>, size> corner;
    int depth;
    int refinements; // subdivisions below the size of a cell
  };

  // A function on a cell, computed on first use and cached for questions about neighboring parts.
  struct Cell_function
  {
    Cell_index cell;
    Enclosed_tricubic function;
    Level_range range;
    bool proved; // on the whole cell
  };

  static constexpr int max_bisections = 40;  // 2^20 cells along an edge; 62 bits hold all depths
  static constexpr int max_refinements = 14; // below the size of a cell
  static constexpr double large_extent = 64; // cells
  // Limits that bound the time. They apply to the subdivisions of a part of the size of a cell, and of all parts
  // together; the latter limit grows by a few for each part of that size.
  static constexpr std::size_t most_parts_of_a_cell = 2000, most_parts = 20000, parts_for_each = 8;

  // Bounds the roundings of the local coordinates of a point.
  template <typename Point>
  static double local_error(const Point& p, const typename Field::Cell& cell)
  {
    double largest = 0;
    for(int a = 0; a < 3; ++a) largest = (std::max)(largest, std::abs(p[a] - cell.corner()[a]) / cell.width());
    return 4 * internal::rounding * largest; // a difference, relative to its own size, and a quotient
  }

  template <std::size_t size, typename Question>
  Verdict decide(const std::array<Point_3, size>& simplex, const Question& question, Witness* witness,
                 Predicate_statistics* statistics, Least_value* bound_below) const
  {
    double extent = 0, reach = 0;
    for(int a = 0; a < 3; ++a) {
      double lowest = simplex[0][a], highest = lowest;
      for(const Point_3& p : simplex) {
        lowest = (std::min)(lowest, p[a]);
        highest = (std::max)(highest, p[a]);
      }
      extent = (std::max)(extent, highest - lowest);
      reach = (std::max)({ reach, std::abs(lowest), std::abs(highest) });
    }
    // A position has products with exact weights that sum to one, and two sums.
    const double position_error = 4 * internal::rounding * reach;

    const Plane<size> plane(simplex, extent, reach);
    Predicate_statistics local_statistics;
    Predicate_statistics& count = statistics ? *statistics : local_statistics;
    Verdict verdict = Verdict::PROVED;
    std::vector<Cell_function> functions;
    std::vector<Cell_index> cells;
    std::vector<Part<size> > stack(1);
    stack[0].depth = stack[0].refinements = 0;
    for(std::size_t v = 0; v < size; ++v) {
      stack[0].corner[v].fill(0);
      stack[0].corner[v][v] = 1;
    }
    // A simplex much larger than the domain has a corner outside it.
    if(!(extent <= large_extent * m_largest_width))
      for(std::size_t v = 0; v < size; ++v)
        if(fails_at(simplex, stack[0].corner[v], 0, position_error, question, functions, witness))
          return Verdict::REFUTED;
    std::size_t parts = 0, parts_here = 0, parts_of_cell_size = 0;
    while(!stack.empty()) {
      const Part<size> part = stack.back();
      stack.pop_back();
      // the part's corners, its box, and the cells that it may meet
      std::array<std::array<double, 3>, size> corner;
      std::array<double, 3> least, most;
      for(std::size_t v = 0; v < size; ++v)
        for(int a = 0; a < 3; ++a) corner[v][a] = coordinate(simplex, part.corner[v], part.depth, a);
      // First bisect down to parts of the size of a cell, as facets may be long and thin.
      const std::array<std::size_t, 2> edge = longest_edge(corner);
      const double length = edge_length(corner[edge[0]], corner[edge[1]]);
      if(part.depth < max_bisections && length > m_largest_width) {
        bisect(part, edge, stack);
        continue;
      }
      for(int a = 0; a < 3; ++a) {
        least[a] = most[a] = corner[0][a];
        for(const auto& p : corner) {
          least[a] = (std::min)(least[a], p[a]);
          most[a] = (std::max)(most[a], p[a]);
        }
        least[a] -= 2 * position_error;
        most[a] += 2 * position_error;
      }
      cells.clear();
      const bool covered = m_field->visit_cells(Bbox_3(least[0], least[1], least[2], most[0], most[1], most[2]),
                                                [&](Cell_index c) {
                                                  if(plane.meets(m_field->cell(c))) cells.push_back(c);
                                                });
      bool proved = covered && !cells.empty(), spans_cells = false;
      double least_on_part = std::numeric_limits<double>::infinity();
      for(Cell_index c : cells) {
        if(!proved) break;
        const Cell_function& f = cell_function(functions, c, question);
        const typename Field::Cell cell = m_field->cell(c);
        const double unit = question.unit(cell);
        if(f.proved && !(bound_below && f.range.min < bound_below->wanted * unit)) {
          ++count.by_cell;
          least_on_part = (std::min)(least_on_part, f.range.min / unit);
          continue;
        }
        // A part must have the size of the cell: far beyond the cell, its polynomial gives no useful bound.
        spans_cells = part.depth < max_bisections && length > cell.width();
        if(spans_cells) break;
        const Level_range range = bound(simplex, part, f.function, cell);
        proved = question.proves(range);
        count.by_form += proved;
        least_on_part = (std::min)(least_on_part, range.min / unit);
      }
      if(spans_cells) {
        bisect(part, edge, stack);
        continue;
      }
      if(proved) {
        if(bound_below) bound_below->value = (std::min)(bound_below->value, least_on_part);
        continue;
      }
      // Does the claim certainly fail at a corner?
      for(std::size_t v = 0; v < size; ++v)
        if(fails_at(simplex, part.corner[v], part.depth, position_error, question, functions, witness))
          return Verdict::REFUTED;
      if(part.refinements == 0) {
        parts_here = 0;
        ++parts_of_cell_size;
      }
      if(part.refinements < max_refinements && ++parts <= most_parts + parts_for_each * parts_of_cell_size
         && ++parts_here <= most_parts_of_a_cell) {
        ++count.subdivisions;
        subdivide(part, stack);
        continue;
      }
      if(verdict == Verdict::PROVED && witness) describe(simplex, part.corner[0], part.depth, *witness);
      verdict = Verdict::UNDECIDED; // another part may still refute the claim
    }
    return verdict;
  }

  // Excludes cells that the plane of a triangle does not meet, although the box of the triangle does.
  template <std::size_t size>
  struct Plane
  {
    std::array<double, 3> normal = {}, point = {};
    double error = 0;

    Plane(const std::array<Point_3, size>& simplex, double extent, double reach)
    {
      if constexpr(size == 3) {
        // The edges are scaled to a length of about one, as products of three lengths could vanish.
        const double unit = internal::reciprocal_power_of_two(extent);
        std::array<double, 3> u, v;
        for(int a = 0; a < 3; ++a) {
          u[a] = unit * (simplex[1][a] - simplex[0][a]);
          v[a] = unit * (simplex[2][a] - simplex[0][a]);
        }
        double sum = 0;
        for(int a = 0; a < 3; ++a) {
          const int b = (a + 1) % 3, c = (a + 2) % 3;
          normal[a] = u[b] * v[c] - u[c] * v[b];
          point[a] = simplex[0][a];
          sum += std::abs(normal[a]);
        }
        // Covers the effect of the rounded normal (see facet_normal()) on points of the triangle, and the roundings of
        // meets(). There, cells are at most two extents and a cell away, and coordinates are differences of coordinates
        // within the reach.
        error = 32 * internal::rounding * (extent + sum * (reach + extent));
      }
    }

    bool meets(const typename Field::Cell& cell) const
    {
      if constexpr(size != 3) return true;
      double distance = 0, half = 0, size_of_terms = 0;
      for(int a = 0; a < 3; ++a) {
        const double center = cell.corner()[a] + cell.width() / 2 - point[a];
        distance += normal[a] * center;
        size_of_terms += std::abs(normal[a]) * (std::abs(center) + cell.width());
        half += std::abs(normal[a]) * cell.width() / 2;
      }
      return !(std::abs(distance) > half + error + 16 * internal::rounding * size_of_terms);
    }
  };

  template <typename Question>
  const Cell_function& cell_function(std::vector<Cell_function>& functions, Cell_index c,
                                     const Question& question) const
  {
    for(std::size_t n = functions.size(); n-- > 0;) // the last ones are the most likely
      if(functions[n].cell == c) return functions[n];
    if(functions.size() >= 64) functions.erase(functions.begin(), functions.begin() + 32);
    const Enclosed_tricubic f = question.function(m_field->cell(c), c);
    const Level_range range = f.range();
    functions.push_back({ c, f, range, question.proves(range) });
    return functions.back();
  }

  // Returns one coordinate of the point with the given barycentric coordinates. Terms are added in the order of the
  // vertices, so the result is the same for every part that has the point as a corner.
  template <std::size_t size>
  static double coordinate(const std::array<Point_3, size>& simplex, const std::array<std::int64_t, size>& numerator,
                           int depth, int a)
  {
    const double unit = 1 / double(std::int64_t(1) << depth);
    double sum = 0;
    for(std::size_t v = 0; v < size; ++v) sum += double(numerator[v]) * unit * simplex[v][a];
    return sum;
  }

  template <std::size_t size>
  Level_range bound(const std::array<Point_3, size>& simplex, const Part<size>& part, const Enclosed_tricubic& f,
                    const typename Field::Cell& cell) const
  {
    std::array<std::array<double, 3>, size> t;
    const double unit = 1 / double(std::int64_t(1) << part.depth);
    double largest = 0;
    for(int a = 0; a < 3; ++a) {
      std::array<double, size> local;
      for(std::size_t v = 0; v < size; ++v) {
        local[v] = (simplex[v][a] - cell.corner()[a]) / cell.width();
        largest = (std::max)(largest, std::abs(local[v]));
      }
      for(std::size_t v = 0; v < size; ++v) {
        double sum = 0;
        for(std::size_t u = 0; u < size; ++u) sum += double(part.corner[v][u]) * unit * local[u];
        t[v][a] = sum;
      }
    }
    // A local coordinate has two roundings, followed by a product and at most three sums.
    const double shift = 8 * internal::rounding * largest;
    if constexpr(size == 3) return enclose_on_triangle(f, t, shift);
    else return enclose_on_segment(f, t, shift);
  }

  // Returns true if the claim certainly fails at a point of the simplex, by the polynomials of all cells in which the
  // point may lie. Outside the domain, it fails.
  template <std::size_t size, typename Question>
  bool fails_at(const std::array<Point_3, size>& simplex, const std::array<std::int64_t, size>& numerator, int depth,
                double position_error, const Question& question, std::vector<Cell_function>& functions,
                Witness* witness) const
  {
    std::array<double, 3> p;
    for(int a = 0; a < 3; ++a) p[a] = coordinate(simplex, numerator, depth, a);
    const double e = 2 * position_error;
    Level_range range;
    bool fails = true, somewhere = false;
    m_field->visit_cells(Bbox_3(p[0] - e, p[1] - e, p[2] - e, p[0] + e, p[1] + e, p[2] + e), [&](Cell_index c) {
      somewhere = true;
      if(!fails) return;
      const typename Field::Cell cell = m_field->cell(c);
      const Cell_function& f = cell_function(functions, c, question);
      std::array<double, 3> t = cell.local_coordinates(p);
      const double shift = e / cell.width() + local_error(p, cell);
      const Level_range r = enclose_at_point(f.function, t, shift);
      fails = question.refutes(r);
      const double unit = question.unit(cell);
      range.include(Level_range{ r.min / unit, r.max / unit });
    });
    if(!fails) return false;
    if(witness) {
      describe(simplex, numerator, depth, *witness);
      witness->value = range;
      witness->outside = !somewhere;
    }
    return true;
  }

  template <std::size_t size>
  static void describe(const std::array<Point_3, size>& simplex, const std::array<std::int64_t, size>& numerator,
                       int depth, Witness& witness)
  {
    witness = Witness();
    for(std::size_t v = 0; v < size; ++v) witness.barycentric[v] = std::ldexp(double(numerator[v]), -depth);
    for(int a = 0; a < 3; ++a) witness.point[a] = coordinate(simplex, numerator, depth, a);
  }

  static double edge_length(const std::array<double, 3>& p, const std::array<double, 3>& q)
  {
    return (std::max)({ std::abs(p[0] - q[0]), std::abs(p[1] - q[1]), std::abs(p[2] - q[2]) });
  }

  template <std::size_t size>
  static std::array<std::size_t, 2> longest_edge(const std::array<std::array<double, 3>, size>& corner)
  {
    std::array<std::size_t, 2> longest = { 0, 1 };
    for(std::size_t v = 1; v + 1 < size; ++v)
      for(std::size_t u = 0; u <= v; ++u)
        if(edge_length(corner[u], corner[v + 1]) > edge_length(corner[longest[0]], corner[longest[1]]))
          longest = { u, v + 1 };
    return longest;
  }

  // Bisects an edge; all numerators are doubled.
  template <std::size_t size>
  static void bisect(const Part<size>& part, const std::array<std::size_t, 2>& edge, std::vector<Part<size> >& stack)
  {
    Part<size> half = part;
    ++half.depth;
    for(auto& corner : half.corner)
      for(std::int64_t& numerator : corner) numerator *= 2;
    std::array<std::int64_t, size> middle;
    for(std::size_t n = 0; n < size; ++n) middle[n] = part.corner[edge[0]][n] + part.corner[edge[1]][n];
    for(std::size_t end : { edge[1], edge[0] }) {
      stack.push_back(half);
      stack.back().corner[end] = middle;
    }
  }

  static void subdivide(const Part<2>& part, std::vector<Part<2> >& stack)
  {
    const std::size_t first = stack.size();
    bisect(part, { 0, 1 }, stack);
    for(std::size_t n = first; n < stack.size(); ++n) ++stack[n].refinements;
  }

  static void subdivide(const Part<3>& part, std::vector<Part<3> >& stack)
  {
    std::array<std::array<std::int64_t, 3>, 3> c, m; // corners, and midpoints of the sides opposite to them
    for(int v = 0; v < 3; ++v)
      for(int u = 0; u < 3; ++u) {
        c[v][u] = 2 * part.corner[v][u];
        m[v][u] = part.corner[(v + 1) % 3][u] + part.corner[(v + 2) % 3][u];
      }
    const int depth = part.depth + 1, refinements = part.refinements + 1;
    stack.push_back({ { m[0], m[1], m[2] }, depth, refinements });
    stack.push_back({ { c[2], m[1], m[0] }, depth, refinements });
    stack.push_back({ { c[1], m[0], m[2] }, depth, refinements });
    stack.push_back({ { c[0], m[2], m[1] }, depth, refinements });
  }

  const Field* m_field;
  double m_largest_width = 0; // largest width of a cell
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_FIELD_PREDICATES_3_H
