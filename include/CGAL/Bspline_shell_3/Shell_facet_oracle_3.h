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
#include <CGAL/Bspline_shell_3/fan_winding.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>

#include <boost/functional/hash.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <unordered_map>
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

  /// the verdicts on facets, by their corners: an edge that was given up and is considered again has mostly the same facets
  class Memory
  {
    friend class Shell_facet_oracle_3;
    typedef std::array<double, 9> Facet;
    struct Hash
    {
      std::size_t operator()(const Facet& facet) const { return boost::hash_range(facet.begin(), facet.end()); }
    };
    std::unordered_map<Facet, Placement_verdict, Hash> m_verdicts;
  };

  /// \pre there is a shell, and it outlives this object
  explicit Shell_facet_oracle_3(const Shell& shell) : m_shell(&shell), m_predicates(shell.field())
  {
    const Field& field = shell.field();
    m_cells.resize(field.number_of_cells());
    for(Cell_index c = 0; c < field.number_of_cells(); ++c) {
      bound(c);
      m_largest_width = (std::max)(m_largest_width, field.cell(c).width());
    }
  }

  /// the facets (`p`, `link[n]`, `link[n+1]`) around a vertex: whether all of them are accepted, and wind around the gradient at `p` once.
  /// \param link the vertices of the link, in cyclic order
  /// \param memory of earlier questions
  Placement_verdict operator()(const Point_3& p, const std::vector<Point_3>& link, Memory& memory) const
  {
    const std::size_t size = link.size();
    const auto key = [&](std::size_t n) {
      const Point_3 &q = link[n], &r = link[(n + 1) % size];
      return typename Memory::Facet{ p[0], p[1], p[2], q[0], q[1], q[2], r[0], r[1], r[2] };
    };
    std::vector<char> is_known(size, 0);
    for(std::size_t n = 0; n < size; ++n) {
      const auto found = memory.m_verdicts.find(key(n));
      if(found == memory.m_verdicts.end()) continue;
      if(found->second != Placement_verdict::ACCEPTED) return found->second;
      is_known[n] = 1;
    }
    const auto remember = [&](std::size_t n, Placement_verdict verdict) {
      memory.m_verdicts.emplace(key(n), verdict);
      return verdict;
    };

    const Sample at_p = sample(to_array(p));
    if(at_p.margin < 0) return Placement_verdict::LEAVES_SHELL;
    const std::size_t turns = winding_number(p, at_p, link);
    if(turns == 0) return Placement_verdict::FACES_AWAY;
    if(turns > 1) return Placement_verdict::WINDS_TWICE;
    // first what is cheap, for all facets: corners, and the middles of the edges at `p`
    std::vector<Sample> corners, middles;
    for(std::size_t n = 0; n < size; ++n) {
      corners.push_back(sample(to_array(link[n])));
      middles.push_back(sample(midpoint(at_p, corners.back())));
      if(corners.back().margin < 0 || middles.back().margin < 0) return remember(n, Placement_verdict::LEAVES_SHELL);
    }
    std::vector<Facet_normal> normals;
    for(std::size_t n = 0; n < size; ++n) {
      const std::size_t m = (n + 1) % size;
      normals.push_back(facet_normal(p, link[n], link[m]));
      for(const Sample* s : { &corners[n], &corners[m], &middles[n], &middles[m] })
        if(slope(*s, normals.back()) <= 0) return remember(n, Placement_verdict::FACES_AWAY);
    }
    for(std::size_t n = 0; n < size; ++n) {
      if(is_known[n]) continue;
      const std::size_t m = (n + 1) % size;
      const Placement_verdict verdict = examine({ p, link[n], link[m] }, { at_p, corners[n], corners[m] }, normals[n], few_parts);
      if(remember(n, verdict) != Placement_verdict::ACCEPTED) return verdict;
    }
    return Placement_verdict::ACCEPTED;
  }

  /// the same for a single facet, with more effort
  Placement_verdict operator()(const Point_3& p, const Point_3& q, const Point_3& r) const
  {
    if(CGAL::collinear(p, q, r)) return Placement_verdict::FACES_AWAY;
    return examine({ p, q, r }, { sample(to_array(p)), sample(to_array(q)), sample(to_array(r)) }, facet_normal(p, q, r), most_bisections);
  }

  /// how often a fan of facets, as above, winds around the gradient at `p`; 0 if a facet does not face it
  std::size_t winding_number(const Point_3& p, const std::vector<Point_3>& link) const
  {
    return winding_number(p, sample(to_array(p)), link);
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
    double curvature = 0;             // of the field: second derivatives along any direction
    double gradient_error = 0;        // of the gradient that a cell computes at a point, in length
    Coordinates least_gradient = {}, greatest_gradient = {};
    double margin_curvature = 0;
    double margin_slope = 0;
    double margin_error = 0;          // of the margin that is computed at a point
    std::size_t above = 0;            // where the differences to the thresholds are, for cells that the shell may meet
  };
  typedef std::array<double, 64> Coefficients;

  // A corner of a part of a triangle
  struct Sample
  {
    Coordinates point;
    Cell_index cell;              // `npos` outside the shell's cells
    double margin;                // lower bound; negative outside
    Coordinates gradient;
  };
  struct Part
  {
    std::array<Sample, 3> corner;
    int depth, refinements;       // bisections; those of them below the size of a cell
    bool is_contained, is_transversal;      // known of all of it
  };

  static double norm(const Coordinates& v) { return std::sqrt(v[0]*v[0] + v[1]*v[1] + v[2]*v[2]); }

  // Coefficients, or their differences along some axes: fewer by one along each
  struct Differences
  {
    std::array<double, 64> b;
    std::array<int, 3> size;

    Differences along(int axis) const
    {
      Differences d;
      d.size = size;
      --d.size[axis];
      const std::array<int, 3> stride = { 1, size[0], size[0] * size[1] };
      double* out = d.b.data();
      for(int k = 0; k < d.size[2]; ++k)
        for(int j = 0; j < d.size[1]; ++j) {
          const double* in = b.data() + j * stride[1] + k * stride[2];
          for(int i = 0; i < d.size[0]; ++i) *out++ = in[i + stride[axis]] - in[i];
        }
      return d;
    }

    Level_range range() const
    {
      const auto mm = std::minmax_element(b.begin(), b.begin() + size[0] * size[1] * size[2]);
      return { *mm.first, *mm.second };
    }
    double largest() const
    {
      double x = 0;
      for(int n = 0; n < size[0] * size[1] * size[2]; ++n) x = (std::max)(x, std::abs(b[n]));
      return x;
    }
  };

  struct Derivative_bounds
  {
    double slope, curvature;                            // lengths of the gradient, second derivatives along any direction
    Coordinates least_gradient, greatest_gradient;      // components
  };

  static Derivative_bounds derivative_bounds(const Enclosed_tricubic& f, double width)
  {
    constexpr double up = 1 + 64 * internal::rounding;
    const Differences value = { f.coefficients, {{ 4, 4, 4 }} };
    const double largest = value.largest();
    // each difference carries the radius of two or four coefficients, and at most three roundings of four times the largest
    const double first_error = 2 * f.radius + 4 * internal::rounding * largest + internal::underflow;
    const double second_error = 4 * f.radius + 16 * internal::rounding * largest + internal::underflow;
    Derivative_bounds bounds;
    double first = 0, second = 0;
    for(int a = 0; a < 3; ++a) {
      const Differences d = value.along(a);
      const Level_range range = d.range();
      const double steepest = (std::max)(std::abs(range.min), std::abs(range.max)), error = 16 * internal::rounding * steepest + 2 * first_error;
      bounds.least_gradient[a] = 3 * (range.min - error) / width;
      bounds.greatest_gradient[a] = 3 * (range.max + error) / width;
      first += square(3 * (steepest + first_error));
      second += square(6 * (d.along(a).largest() + second_error));
      for(int other = 0; other < a; ++other) second += 2 * square(9 * (d.along(other).largest() + second_error));
    }
    bounds.slope = std::sqrt(first) / width * up;
    bounds.curvature = std::sqrt(second) / (width * width) * up;
    return bounds;
  }

  static double square(double x) { return x * x; }

  // of the value that a cell computes at a point in it: Form_error covers more roundings than there are
  static double value_error(const Enclosed_tricubic& f)
  {
    return internal::Form_error(8 * internal::rounding)(f);
  }

  void bound(Cell_index c)
  {
    const typename Field::Cell cell = m_shell->field().cell(c);
    const Enclosed_tricubic f = enclosed_value(cell);
    Cell_bounds& bounds = m_cells[c];
    const Derivative_bounds field = derivative_bounds(f, cell.width());
    bounds.curvature = field.curvature;
    bounds.least_gradient = field.least_gradient;
    bounds.greatest_gradient = field.greatest_gradient;
    // the absolute weights of a derivative sum to at most six; local coordinates err by four roundings
    const double component = 6 * value_error(f) / cell.width() + 8 * internal::rounding * bounds.curvature * cell.width();
    bounds.gradient_error = 2 * component;
    std::array<Coefficients, 2> above;
    for(const Threshold* threshold : { &m_shell->inner_threshold(), &m_shell->outer_threshold() }) {
      const Enclosed_tricubic d = threshold->difference(f, c);
      above[threshold == &m_shell->outer_threshold()] = d.coefficients;
      const Derivative_bounds margin = derivative_bounds(d, cell.width());
      bounds.margin_slope = (std::max)(bounds.margin_slope, margin.slope);
      bounds.margin_curvature = (std::max)(bounds.margin_curvature, margin.curvature);
      bounds.margin_error = (std::max)(bounds.margin_error, value_error(d));
    }
    if(!m_shell->shell_cells()[c]) return;
    bounds.above = m_above.size();
    m_above.push_back(above);
  }

  static Coordinates to_array(const Point_3& p) { return { p[0], p[1], p[2] }; }

  Sample sample(const Coordinates& x, bool wants_margin = true, bool wants_gradient = true) const
  {
    Sample s = { x, Field::npos, -1, {} };
    const Point_3 p(x[0], x[1], x[2]);
    const Cell_index c = m_shell->field().locate(p);
    if(c == Field::npos || !m_shell->shell_cells()[c]) return s;
    s.cell = c;
    const typename Field::Cell cell = m_shell->field().cell(c);
    if(wants_gradient) s.gradient = cell.first_order_jet(p).gradient;
    s.margin = 0;
    if(wants_margin) {
      const std::array<Coefficients, 2>& above = m_above[m_cells[c].above];
      const auto value = [&](const Coefficients& b) { return Tricubic_cell_3(cell.corner(), cell.width(), b.data(), 0).value(p); };
      s.margin = (std::min)(value(above[0]), -value(above[1])) - m_cells[c].margin_error;
    }
    return s;
  }

  static Coordinates midpoint(const Sample& p, const Sample& q)
  {
    return { (p.point[0] + q.point[0]) / 2, (p.point[1] + q.point[1]) / 2, (p.point[2] + q.point[2]) / 2 };
  }

  // rounded
  static double slope(const Sample& s, const Facet_normal& normal)
  {
    return s.gradient[0] * normal.direction[0] + s.gradient[1] * normal.direction[1] + s.gradient[2] * normal.direction[2];
  }

  // by an axis that is long enough for its direction not to be spoilt by rounding
  std::size_t winding_number(const Point_3& p, const Sample& at_p, const std::vector<Point_3>& link) const
  {
    const double length = norm(at_p.gradient);
    if(!(length > 0)) return 0;
    const double s = 16 * m_largest_width / length;
    return link_winding_number(p, Point_3(p[0] + s * at_p.gradient[0], p[1] + s * at_p.gradient[1], p[2] + s * at_p.gradient[2]), link);
  }

  // Second-order bounds on parts of a triangle; predicates for what they leave open, if it is no more than some parts.
  Placement_verdict examine(const std::array<Point_3, 3>& triangle, const std::array<Sample, 3>& corners, const Facet_normal& normal,
                            std::size_t most_open_parts) const
  {
    constexpr double up = 1 + 16 * internal::rounding;
    const double length_of_normal = norm(normal.direction) * up + 2 * normal.radius;
    double reach = 0;
    for(const Sample& s : corners) {
      if(s.margin < 0) return Placement_verdict::LEAVES_SHELL;
      if(slope(s, normal) <= 0) return Placement_verdict::FACES_AWAY;
      for(double x : s.point) reach = (std::max)(reach, std::abs(x));
    }
    // corners of parts: a rounding of a coordinate for each halving
    const double e = 4 * (max_depth + 1) * internal::rounding * reach;
    std::size_t bisections = 0, outside = 0, turned = 0;       // parts that are not proved to be in the shell, to face along
    std::vector<Part> stack = { { corners, 0, 0, false, false } };
    while(!stack.empty()) {
      Part part = stack.back();
      stack.pop_back();
      double longest = 0;
      int top = 0;        // the corner opposite to the longest edge
      for(int v = 0; v < 3; ++v) {
        const Coordinates &p = part.corner[(v + 1) % 3].point, &q = part.corner[(v + 2) % 3].point;
        const double squared = square(p[0] - q[0]) + square(p[1] - q[1]) + square(p[2] - q[2]);
        if(squared > longest) { longest = squared; top = v; }
      }
      const double length = std::sqrt(longest) * up + 2 * e;
      const bool is_small = length < large_extent * m_largest_width;
      const Part_bounds bounds = is_small ? bounds_on(part, normal, e) : Part_bounds{ false };
      if(bounds.is_covered && !part.is_contained) {
        const double margin = (std::min)({ part.corner[0].margin, part.corner[1].margin, part.corner[2].margin });
        part.is_contained = margin >= (bounds.margin_slope * e + bounds.margin_curvature * length * length / 6) * up;
      }
      if(bounds.is_covered && !part.is_transversal) {
        double least = std::numeric_limits<double>::infinity();
        for(const Sample& s : part.corner) {
          const double size = std::abs(s.gradient[0]) + std::abs(s.gradient[1]) + std::abs(s.gradient[2]);
          least = (std::min)(least, slope(s, normal) - length_of_normal * m_cells[s.cell].gradient_error
                                      - (2 * normal.radius + 8 * internal::rounding) * size);
        }
        constexpr double inverse_of_root_of_three = 0.5774;      // rounded upwards
        part.is_transversal = bounds.slope > 0
                           || least > length_of_normal * bounds.curvature * (e + inverse_of_root_of_three * length) * up;
      }
      if(part.is_contained && part.is_transversal) continue;
      if(part.refinements == max_refinements || part.depth == max_depth || bisections == most_bisections) {
        outside += !part.is_contained;
        turned += !part.is_transversal;
        if(outside > most_open_parts) return Placement_verdict::LEAVES_SHELL;
        if(turned > most_open_parts) return Placement_verdict::FACES_AWAY;
        continue;
      }
      ++bisections;
      ++part.depth;
      part.refinements += is_small;
      const Sample middle = sample(midpoint(part.corner[(top + 1) % 3], part.corner[(top + 2) % 3]),
                                   !part.is_contained, !part.is_transversal);
      if(middle.margin < 0) return Placement_verdict::LEAVES_SHELL;
      if(!part.is_transversal && slope(middle, normal) <= 0) return Placement_verdict::FACES_AWAY;
      for(int end : { 1, 2 }) {
        stack.push_back(part);
        stack.back().corner[(top + end) % 3] = middle;
      }
    }
    if(outside > 0
       && m_predicates.values_within(triangle, m_shell->inner_threshold(), m_shell->outer_threshold()) != Verdict::PROVED)
      return Placement_verdict::LEAVES_SHELL;
    if(turned > 0 && m_predicates.crosses_upwards(triangle) != Verdict::PROVED) return Placement_verdict::FACES_AWAY;
    return Placement_verdict::ACCEPTED;
  }

  // What is known of all cells that a part meets
  struct Part_bounds
  {
    bool is_covered;              // by cells
    double curvature = 0, margin_curvature = 0, margin_slope = 0;
    double slope = std::numeric_limits<double>::infinity();     // along a normal, lower bound by the cells' gradients
  };

  void include(const Cell_bounds& cell, const Facet_normal& normal, Part_bounds& bounds) const
  {
    bounds.curvature = (std::max)(bounds.curvature, cell.curvature);
    bounds.margin_curvature = (std::max)(bounds.margin_curvature, cell.margin_curvature);
    bounds.margin_slope = (std::max)(bounds.margin_slope, cell.margin_slope);
    double sum = 0, size = 0;
    for(int a = 0; a < 3; ++a) {
      sum += (std::min)(normal.direction[a] * cell.least_gradient[a], normal.direction[a] * cell.greatest_gradient[a]);
      size += (std::max)(std::abs(cell.least_gradient[a]), std::abs(cell.greatest_gradient[a]));
    }
    bounds.slope = (std::min)(bounds.slope, sum - (2 * normal.radius + 8 * internal::rounding) * size);
  }

  // if the corners of the part are displaced by less than e
  Part_bounds bounds_on(const Part& part, const Facet_normal& normal, double e) const
  {
    Coordinates least, most;
    for(int a = 0; a < 3; ++a) {
      const auto mm = std::minmax({ part.corner[0].point[a], part.corner[1].point[a], part.corner[2].point[a] });
      least[a] = mm.first - e;
      most[a] = mm.second + e;
    }
    Part_bounds bounds;
    const Cell_index first = part.corner[0].cell;
    if(part.corner[1].cell == first && part.corner[2].cell == first) {
      const typename Field::Cell cell = m_shell->field().cell(first);
      const Coordinates& corner = cell.corner();
      bounds.is_covered = true;
      for(int a = 0; a < 3; ++a)
        bounds.is_covered = bounds.is_covered && least[a] >= corner[a] && most[a] <= corner[a] + cell.width();
      if(bounds.is_covered) {
        include(m_cells[first], normal, bounds);
        return bounds;
      }
    }
    bounds.is_covered = m_shell->field().visit_cells(Bbox_3(least[0], least[1], least[2], most[0], most[1], most[2]),
                                                     [&](Cell_index c) { include(m_cells[c], normal, bounds); });
    return bounds;
  }

  static constexpr double large_extent = 4;           // cells; larger parts are subdivided before they are bounded
  static constexpr int max_depth = 40, max_refinements = 10;
  static constexpr std::size_t most_bisections = 4096;
  static constexpr std::size_t few_parts = 64;        // that predicates are asked for when there are other places to try

  const Shell* m_shell;
  Field_predicates_3<Field> m_predicates;
  std::vector<Cell_bounds> m_cells;
  std::vector<std::array<Coefficients, 2> > m_above;      // the field minus the inner and the outer threshold
  double m_largest_width = 0;       // of a cell
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_FACET_ORACLE_3_H
