// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_FACET_ORACLE_3_H
#define CGAL_BSPLINE_SHELL_3_SHELL_FACET_ORACLE_3_H

#include <CGAL/Bspline_shell_3/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Tricubic_cell_3.h>
#include <CGAL/Bspline_shell_3/facet_normal.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>

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
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief accepts the triangles that provably lie in a shell and face along the gradient, as containment and transversality,
 * the first two claims of the certificate, ask of facets.
 *
 * Most answers come from a bound of second order. For a function \f$g\f$ whose second derivatives are at most \f$M\f$ on a
 * triangle with edges of length at most \f$L\f$, Taylor's formula at the corners gives
 * \f$g \ge \min_i g(v_i) - M L^2 / 6\f$ and \f$|\nabla g - \nabla g(v_i)| \le M L\f$, the latter with \f$L / \sqrt 3\f$ in the mean over the
 * corners. As the field has two continuous derivatives, this holds across the cells, with the largest \f$M\f$ of the cells that the
 * triangle may meet, which is computed once for each cell. Triangles are subdivided a few times until it is enough; what it
 * leaves open, `Field_predicates_3` decides. Rejections are no proofs: a triangle that is in the shell by less than rounding may
 * be rejected.
 *
 * The oracle is immutable: const member functions may be called from several threads at once.
 *
 * \cgalModels `ShellContainmentOracle`
 *
 * \tparam Field a model of `BsplineField_3`
 * \tparam Threshold a model of `ShellThreshold`
 */
template <typename Field = Uniform_bspline_field_3<>, typename Threshold = Constant_threshold>
class Shell_facet_oracle_3
{
public:
  typedef Bspline_shell_3<Field, Threshold> Shell;
  typedef typename Field::Point_3 Point_3;

  /// \pre there is a shell, and it outlives this object
  explicit Shell_facet_oracle_3(const Shell& shell) : m_shell(&shell), m_predicates(shell.field())
  {
    const Field& field = shell.field();
    m_bounds.reserve(field.number_of_cells());
    for(Cell_index c = 0; c < field.number_of_cells(); ++c) {
      m_bounds.push_back(cell_bounds(c));
      m_largest_width = (std::max)(m_largest_width, field.cell(c).width());
    }
  }

  /// whether every point of the triangle lies between the thresholds, in a cell that the shell may meet, and the field increases
  /// along the triangle's normal there
  Placement_verdict operator()(const Point_3& p, const Point_3& q, const Point_3& r) const
  {
    if(CGAL::collinear(p, q, r)) return Placement_verdict::FACES_AWAY;
    const std::array<Point_3, 3> triangle = { p, q, r };
    bool contained = false, transversal = false;
    const Placement_verdict verdict = examine(triangle, contained, transversal);
    if(verdict != Placement_verdict::ACCEPTED) return verdict;
    if(!contained
       && m_predicates.values_within(triangle, m_shell->inner_threshold(), m_shell->outer_threshold()) != Verdict::PROVED)
      return Placement_verdict::LEAVES_SHELL;
    if(!transversal && m_predicates.crosses_upwards(triangle) != Verdict::PROVED) return Placement_verdict::FACES_AWAY;
    return Placement_verdict::ACCEPTED;
  }

  /// a point in the direction of the gradient from `p`: every facet at `p` that is accepted faces it. Nothing outside the domain.
  std::optional<Point_3> axis(const Point_3& p) const
  {
    const Cell_index c = m_shell->field().locate(p);
    if(c == Field::npos) return std::nullopt;
    const auto jet = m_shell->field().cell(c).first_order_jet(p);
    const double length = norm(jet.gradient);
    if(!(length > 0)) return std::nullopt;
    const double s = 16 * m_largest_width / length;       // long enough that rounding does not turn it
    return Point_3(p[0] + s * jet.gradient[0], p[1] + s * jet.gradient[1], p[2] + s * jet.gradient[2]);
  }

  /// `p` moved along the gradient to where the field has the mean of its values at `a` and `b`, rounded; nothing if that leaves
  /// the domain
  std::optional<Point_3> moved_to_level(const Point_3& p, const Point_3& a, const Point_3& b) const
  {
    constexpr int steps = 3;      // of Newton's method; the field is nearly linear across the shell
    const Field& field = m_shell->field();
    const auto fa = field.value(a), fb = field.value(b);
    if(!fa || !fb) return std::nullopt;
    const double level = (*fa + *fb) / 2;
    Point_3 x = p;
    for(int n = 0; n < steps; ++n) {
      const Cell_index c = field.locate(x);
      if(c == Field::npos) return std::nullopt;
      const auto jet = field.cell(c).first_order_jet(x);
      const double length = norm(jet.gradient);
      if(!(length > 0)) return std::nullopt;
      const double s = (level - jet.value) / (length * length);
      x = Point_3(x[0] + s * jet.gradient[0], x[1] + s * jet.gradient[1], x[2] + s * jet.gradient[2]);
    }
    return x;
  }

private:
  typedef typename Field::Cell_index Cell_index;
  typedef std::array<double, 3> Coordinates;

  // What is known of all of a cell, per user unit. The margin is the distance to the nearer threshold, in units of the field.
  struct Cell_bounds
  {
    double curvature;             // of the field: second derivatives along any direction
    double gradient_error;        // of the gradient that a cell computes at a point, in length
    double margin_curvature;
    double margin_slope;
    double margin_error;          // of the margin that is computed at a point
  };

  // A corner of a part of a triangle
  struct Sample
  {
    Coordinates point;
    double margin;                // lower bound
    Coordinates gradient;
    double gradient_error;
  };
  struct Part
  {
    std::array<Sample, 3> corner;
    int depth, refinements;       // halvings of all edges; those of them below the size of a cell
  };

  static double norm(const Coordinates& v) { return std::sqrt(v[0]*v[0] + v[1]*v[1] + v[2]*v[2]); }

  // bounds the length of the gradient and the second derivatives by differences of the coefficients
  static void bound_derivatives(const Enclosed_tricubic& f, double width, double& slope, double& curvature)
  {
    const double* b = f.coefficients.data();
    double largest = 0;
    for(double x : f.coefficients) largest = (std::max)(largest, std::abs(x));
    // each difference carries the radius of two or four coefficients, and at most three roundings of four times the largest
    const double first_error = 2 * f.radius + 2 * internal::rounding * largest + internal::underflow;
    const double second_error = 4 * f.radius + 12 * internal::rounding * largest + internal::underflow;
    constexpr int stride[3] = { 1, 4, 16 };
    double first = 0, second = 0;
    for(int a = 0; a < 3; ++a) {
      const int s = stride[a];
      double steepest = 0, most_curved = 0;
      for(int n = 0; n < 64; ++n) {
        const int i = (n / s) % 4;
        if(i < 3) steepest = (std::max)(steepest, std::abs(b[n + s] - b[n]));
        if(i < 2) most_curved = (std::max)(most_curved, std::abs((b[n + 2*s] - b[n + s]) - (b[n + s] - b[n])));
      }
      first += square(3 * (steepest + first_error));
      second += square(6 * (most_curved + second_error));
      for(int other = 0; other < a; ++other) {
        const int t = stride[other];
        double twist = 0;
        for(int n = 0; n < 64; ++n)
          if((n / s) % 4 < 3 && (n / t) % 4 < 3)
            twist = (std::max)(twist, std::abs((b[n + s + t] - b[n + s]) - (b[n + t] - b[n])));
        second += 2 * square(9 * (twist + second_error));
      }
    }
    constexpr double up = 1 + 64 * internal::rounding;
    slope = std::sqrt(first) / width * up;
    curvature = std::sqrt(second) / (width * width) * up;
  }

  static double square(double x) { return x * x; }

  // of the value that a cell computes at a point in it: Form_error covers more roundings than there are
  static double value_error(const Enclosed_tricubic& f)
  {
    return internal::Form_error(8 * internal::rounding)(f);
  }

  Cell_bounds cell_bounds(Cell_index c) const
  {
    const typename Field::Cell cell = m_shell->field().cell(c);
    const Enclosed_tricubic f = enclosed_value(cell);
    Cell_bounds bounds;
    double slope;
    bound_derivatives(f, cell.width(), slope, bounds.curvature);
    // the absolute weights of a derivative sum to at most six; local coordinates err by four roundings
    const double component = 6 * value_error(f) / cell.width() + 8 * internal::rounding * bounds.curvature * cell.width();
    bounds.gradient_error = 2 * component;
    bounds.margin_curvature = bounds.margin_slope = bounds.margin_error = 0;
    for(const Threshold* threshold : { &m_shell->inner_threshold(), &m_shell->outer_threshold() }) {
      const Enclosed_tricubic d = threshold->difference(f, c);
      double s, k;
      bound_derivatives(d, cell.width(), s, k);
      bounds.margin_slope = (std::max)(bounds.margin_slope, s);
      bounds.margin_curvature = (std::max)(bounds.margin_curvature, k);
      bounds.margin_error = (std::max)(bounds.margin_error, value_error(d));
    }
    return bounds;
  }

  // outside the domain, the margin is negative
  Sample sample(const Coordinates& x) const
  {
    Sample s = { x, -1, {}, 0 };
    const Point_3 p(x[0], x[1], x[2]);
    const Cell_index c = m_shell->field().locate(p);
    if(c == Field::npos || !m_shell->shell_cells()[c]) return s;
    const typename Field::Cell cell = m_shell->field().cell(c);
    const auto jet = cell.first_order_jet(p);
    s.gradient = jet.gradient;
    s.gradient_error = m_bounds[c].gradient_error;
    const Enclosed_tricubic f = enclosed_value(cell);
    const auto above = [&](const Threshold& threshold) {
      const Enclosed_tricubic d = threshold.difference(f, c);
      return Tricubic_cell_3(cell.corner(), cell.width(), d.coefficients.data(), d.radius).value(p);
    };
    s.margin = (std::min)(above(m_shell->inner_threshold()), -above(m_shell->outer_threshold())) - m_bounds[c].margin_error;
    return s;
  }

  // Second-order bounds on parts. Accepts if nothing speaks against the triangle; what is proved is told.
  Placement_verdict examine(const std::array<Point_3, 3>& triangle, bool& contained, bool& transversal) const
  {
    const Facet_normal normal = facet_normal(triangle[0], triangle[1], triangle[2]);
    constexpr double up = 1 + 16 * internal::rounding;
    const double length_of_normal = norm(normal.direction) * up + 2 * normal.radius;
    double reach = 0;
    for(const Point_3& p : triangle)
      for(int a = 0; a < 3; ++a) reach = (std::max)(reach, std::abs(double(p[a])));
    // corners of parts: a rounding of a coordinate for each halving
    const double position_error = 2 * (max_depth + 1) * internal::rounding * reach;
    const auto slope = [&](const Sample& s) {
      return s.gradient[0] * normal.direction[0] + s.gradient[1] * normal.direction[1] + s.gradient[2] * normal.direction[2];
    };

    std::vector<Part> stack(1);
    for(int v = 0; v < 3; ++v) {
      Sample& s = stack[0].corner[v];
      s = sample({ triangle[v][0], triangle[v][1], triangle[v][2] });
      if(s.margin < 0) return Placement_verdict::LEAVES_SHELL;
      if(slope(s) <= 0) return Placement_verdict::FACES_AWAY;
    }
    stack[0].depth = stack[0].refinements = 0;
    contained = transversal = true;
    std::size_t parts = 0;
    while(!stack.empty()) {
      const Part part = stack.back();
      stack.pop_back();
      double squared_length = 0;
      Coordinates least = part.corner[0].point, most = least;
      for(int v = 0; v < 3; ++v) {
        double squared = 0;
        for(int a = 0; a < 3; ++a) {
          squared += square(part.corner[v].point[a] - part.corner[(v + 1) % 3].point[a]);
          least[a] = (std::min)(least[a], part.corner[v].point[a]);
          most[a] = (std::max)(most[a], part.corner[v].point[a]);
        }
        squared_length = (std::max)(squared_length, squared);
      }
      const double length = std::sqrt(squared_length) * up + 4 * position_error;
      bool is_contained = false, is_transversal = false;
      const bool is_small = length < large_extent * m_largest_width;
      if(is_small) {
        Cell_bounds bounds = {};
        double least_width = std::numeric_limits<double>::infinity();
        const double e = 2 * position_error;
        const bool covered = m_shell->field().visit_cells(
          Bbox_3(least[0] - e, least[1] - e, least[2] - e, most[0] + e, most[1] + e, most[2] + e), [&](Cell_index c) {
            bounds.curvature = (std::max)(bounds.curvature, m_bounds[c].curvature);
            bounds.margin_curvature = (std::max)(bounds.margin_curvature, m_bounds[c].margin_curvature);
            bounds.margin_slope = (std::max)(bounds.margin_slope, m_bounds[c].margin_slope);
            least_width = (std::min)(least_width, m_shell->field().cell(c).width());
          });
        if(covered) {
          double margin = std::numeric_limits<double>::infinity(), crossing = margin;
          for(const Sample& s : part.corner) {
            margin = (std::min)(margin, s.margin);
            double size = 0;
            for(int a = 0; a < 3; ++a) size += std::abs(s.gradient[a]);
            crossing = (std::min)(crossing, slope(s) - length_of_normal * s.gradient_error
                                              - (2 * normal.radius + 8 * internal::rounding) * size);
          }
          constexpr double inverse_of_root_of_three = 0.5774;      // rounded upwards
          is_contained = margin >= (bounds.margin_slope * e + bounds.margin_curvature * length * length / 6) * up;
          is_transversal = crossing > length_of_normal * bounds.curvature * (e + inverse_of_root_of_three * length) * up;
        }
      }
      if((is_contained || !contained) && (is_transversal || !transversal)) continue;
      if(part.refinements == max_refinements || part.depth == max_depth || ++parts > most_parts) {
        contained = contained && is_contained;
        transversal = transversal && is_transversal;
        if(!contained && !transversal) break;
        continue;
      }
      std::array<Sample, 3> middle;       // of the edges opposite to the corners
      for(int v = 0; v < 3; ++v) {
        const Coordinates &p = part.corner[(v + 1) % 3].point, &q = part.corner[(v + 2) % 3].point;
        middle[v] = sample({ (p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2 });
        if(middle[v].margin < 0) return Placement_verdict::LEAVES_SHELL;
        if(slope(middle[v]) <= 0) return Placement_verdict::FACES_AWAY;
      }
      const int depth = part.depth + 1, refinements = part.refinements + is_small;
      stack.push_back({ middle, depth, refinements });
      for(int v = 0; v < 3; ++v) {
        Part corner = { middle, depth, refinements };
        corner.corner[v] = part.corner[v];
        stack.push_back(corner);
      }
    }
    return Placement_verdict::ACCEPTED;
  }

  static constexpr double large_extent = 4;           // cells; larger parts are subdivided before they are bounded
  static constexpr int max_depth = 20, max_refinements = 5;
  static constexpr std::size_t most_parts = 4096;     // that are subdivided; then the predicates go on

  const Shell* m_shell;
  Field_predicates_3<Field> m_predicates;
  std::vector<Cell_bounds> m_bounds;
  double m_largest_width = 0;       // of a cell
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_FACET_ORACLE_3_H
