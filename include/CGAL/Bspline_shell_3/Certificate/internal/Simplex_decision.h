// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_SIMPLEX_DECISION_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_SIMPLEX_DECISION_H

#include <CGAL/Bspline_shell_3/Certificate/internal/Dyadic_part.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Support/power_of_two.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A lower bound on the quantity in question, per user unit. A proved bound suffices if it is at least `enough`.
struct Least_value
{
  double enough, value;
};

// Bounds the roundings of the local coordinates of a point.
template <typename Point, typename Cell>
double local_error(const Point& p, const Cell& cell)
{
  double largest = 0;
  for(int a = 0; a < 3; ++a) largest = (std::max)(largest, std::abs(p[a] - cell.corner()[a]) / cell.width());
  return 4 * rounding * largest; // a difference, relative to its own size, and a quotient
}

// Excludes cells that the plane of a triangle does not meet, although the box of the triangle does.
template <std::size_t size>
struct Plane_of_simplex
{
  std::array<double, 3> normal = {}, point = {};
  double error = 0;

  template <typename Point_3>
  Plane_of_simplex(const std::array<Point_3, size>& simplex, double extent, double reach)
  {
    if constexpr(size == 3) {
      // The edges are scaled to a length of about one, as products of three lengths could vanish.
      const double unit = reciprocal_power_of_two(extent);
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
      error = 32 * rounding * (extent + sum * (reach + extent));
    }
  }

  template <typename Cell>
  bool meets(const Cell& cell) const
  {
    if constexpr(size != 3) return true;
    double distance = 0, half = 0, size_of_terms = 0;
    for(int a = 0; a < 3; ++a) {
      const double center = cell.corner()[a] + cell.width() / 2 - point[a];
      distance += normal[a] * center;
      size_of_terms += std::abs(normal[a]) * (std::abs(center) + cell.width());
      half += std::abs(normal[a]) * cell.width() / 2;
    }
    return !(std::abs(distance) > half + error + 16 * rounding * size_of_terms);
  }
};

// The decision of one question on a segment (size two) or a triangle (size three).
//
// The simplex is bisected into parts of the size of a cell. The claim is proved on a part if the polynomial of every
// cell that its box meets proves it there. Other parts are subdivided, until a corner refutes the claim or a limit is
// reached.
template <typename Field, std::size_t size, typename Question>
class Simplex_decision
{
public:
  typedef typename Field::Point_3 Point_3;
  typedef std::array<Point_3, size> Simplex;

  // Pointers may be null. `bound_below` receives the least value.
  Simplex_decision(const Field& field, double largest_width, const Simplex& simplex, const Question& question,
                   Witness* witness, Predicate_statistics* statistics, Least_value* bound_below)
    : m_field(field), m_simplex(simplex), m_question(question), m_witness(witness), m_bound_below(bound_below),
      m_statistics(statistics ? *statistics : m_own_statistics), m_largest_width(largest_width),
      m_extent(extent(simplex)), m_reach(reach(simplex)), m_plane(simplex, m_extent, m_reach)
  {}

  Verdict operator()()
  {
    const Part whole = whole_simplex<size>();
    // A simplex much larger than the domain has a corner outside it.
    if(!(m_extent <= large_extent * m_largest_width) && fails_at_corner(whole)) return Verdict::REFUTED;
    Verdict verdict = Verdict::PROVED;
    m_stack.assign(1, whole);
    while(!m_stack.empty()) {
      const Part part = m_stack.back();
      m_stack.pop_back();
      const Corners corners = this->corners(part);
      const std::array<std::size_t, 2> edge = longest_edge(corners);
      const double length = edge_length(corners[edge[0]], corners[edge[1]]);
      switch(prove(part, corners, length)) {
        case Attempt::PROVED: continue;
        case Attempt::TOO_LARGE: bisect(part, edge, m_stack); continue;
        case Attempt::FAILED: break;
      }
      if(fails_at_corner(part)) return Verdict::REFUTED;
      if(may_subdivide(part)) {
        ++m_statistics.subdivisions;
        subdivide(part, m_stack);
        continue;
      }
      if(verdict == Verdict::PROVED && m_witness) describe(part.corner[0], part.depth);
      verdict = Verdict::UNDECIDED; // another part may still refute the claim
    }
    return verdict;
  }

private:
  typedef typename Field::Cell_index Cell_index;
  typedef Dyadic_part<size> Part;
  typedef std::array<std::array<double, 3>, size> Corners;

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

  enum class Attempt
  {
    PROVED,
    TOO_LARGE,
    FAILED
  };

  static double extent(const Simplex& simplex)
  {
    double extent = 0;
    for(int a = 0; a < 3; ++a) {
      double lowest = simplex[0][a], highest = lowest;
      for(const Point_3& p : simplex) {
        lowest = (std::min)(lowest, p[a]);
        highest = (std::max)(highest, p[a]);
      }
      extent = (std::max)(extent, highest - lowest);
    }
    return extent;
  }

  static double reach(const Simplex& simplex)
  {
    double reach = 0;
    for(const Point_3& p : simplex)
      for(int a = 0; a < 3; ++a) reach = (std::max)(reach, std::abs(p[a]));
    return reach;
  }

  // Bounds the error of a corner's position. It has products with exact weights that sum to one, and two sums.
  double position_error() const { return 4 * rounding * m_reach; }

  Corners corners(const Part& part) const
  {
    Corners corners;
    for(std::size_t v = 0; v < size; ++v)
      for(int a = 0; a < 3; ++a) corners[v][a] = coordinate(m_simplex, part.corner[v], part.depth, a);
    return corners;
  }

  // Returns a box that contains the exact part, too.
  Bbox_3 bbox(const Corners& corners) const
  {
    std::array<double, 3> least, most;
    for(int a = 0; a < 3; ++a) {
      least[a] = most[a] = corners[0][a];
      for(const auto& p : corners) {
        least[a] = (std::min)(least[a], p[a]);
        most[a] = (std::max)(most[a], p[a]);
      }
      least[a] -= 2 * position_error();
      most[a] += 2 * position_error();
    }
    return Bbox_3(least[0], least[1], least[2], most[0], most[1], most[2]);
  }

  // Tries to prove the claim on a part. Parts are too large if they are larger than a cell that they meet: facets may
  // be long and thin, and a cell's polynomial gives no useful bound far beyond the cell.
  Attempt prove(const Part& part, const Corners& corners, double length)
  {
    const bool may_bisect = part.depth < max_bisections;
    if(may_bisect && length > m_largest_width) return Attempt::TOO_LARGE;
    m_cells.clear();
    const bool covered = m_field.visit_cells(bbox(corners), [&](Cell_index c) {
      if(m_plane.meets(m_field.cell(c))) m_cells.push_back(c);
    });
    if(!covered || m_cells.empty()) return Attempt::FAILED;
    double least_on_part = std::numeric_limits<double>::infinity();
    for(Cell_index c : m_cells) {
      const Cell_function& f = cell_function(c);
      const typename Field::Cell cell = m_field.cell(c);
      const double unit = m_question.unit(cell);
      if(f.proved && !(m_bound_below && f.range.min < m_bound_below->enough * unit)) {
        ++m_statistics.by_cell;
        least_on_part = (std::min)(least_on_part, f.range.min / unit);
        continue;
      }
      if(may_bisect && length > cell.width()) return Attempt::TOO_LARGE;
      const Level_range range = bound(part, f.function, cell);
      if(!m_question.proves(range)) return Attempt::FAILED;
      ++m_statistics.by_form;
      least_on_part = (std::min)(least_on_part, range.min / unit);
    }
    if(m_bound_below) m_bound_below->value = (std::min)(m_bound_below->value, least_on_part);
    return Attempt::PROVED;
  }

  bool may_subdivide(const Part& part)
  {
    if(part.refinements == 0) {
      m_parts_here = 0;
      ++m_parts_of_cell_size;
    }
    return part.refinements < max_refinements && ++m_parts <= most_parts + parts_for_each * m_parts_of_cell_size
           && ++m_parts_here <= most_parts_of_a_cell;
  }

  const Cell_function& cell_function(Cell_index c)
  {
    for(std::size_t n = m_functions.size(); n-- > 0;) // the last ones are the most likely
      if(m_functions[n].cell == c) return m_functions[n];
    if(m_functions.size() >= 64) m_functions.erase(m_functions.begin(), m_functions.begin() + 32);
    const Enclosed_tricubic f = m_question.function(m_field.cell(c), c);
    const Level_range range = f.range();
    m_functions.push_back({ c, f, range, m_question.proves(range) });
    return m_functions.back();
  }

  Level_range bound(const Part& part, const Enclosed_tricubic& f, const typename Field::Cell& cell) const
  {
    std::array<std::array<double, 3>, size> t;
    const double unit = 1 / double(std::int64_t(1) << part.depth);
    double largest = 0;
    for(int a = 0; a < 3; ++a) {
      std::array<double, size> local;
      for(std::size_t v = 0; v < size; ++v) {
        local[v] = (m_simplex[v][a] - cell.corner()[a]) / cell.width();
        largest = (std::max)(largest, std::abs(local[v]));
      }
      for(std::size_t v = 0; v < size; ++v) {
        double sum = 0;
        for(std::size_t u = 0; u < size; ++u) sum += double(part.corner[v][u]) * unit * local[u];
        t[v][a] = sum;
      }
    }
    // A local coordinate has two roundings, followed by a product and at most three sums.
    const double shift = 8 * rounding * largest;
    if constexpr(size == 3) return enclose_on_triangle(f, t, shift);
    else return enclose_on_segment(f, t, shift);
  }

  bool fails_at_corner(const Part& part)
  {
    for(std::size_t v = 0; v < size; ++v)
      if(fails_at(part.corner[v], part.depth)) return true;
    return false;
  }

  // Returns true if the claim certainly fails at a point of the simplex, by the polynomials of all cells in which the
  // point may lie. Outside the domain, it fails.
  bool fails_at(const typename Part::Corner& corner, int depth)
  {
    std::array<double, 3> p;
    for(int a = 0; a < 3; ++a) p[a] = coordinate(m_simplex, corner, depth, a);
    const double e = 2 * position_error();
    Level_range range;
    bool fails = true, somewhere = false;
    m_field.visit_cells(Bbox_3(p[0] - e, p[1] - e, p[2] - e, p[0] + e, p[1] + e, p[2] + e), [&](Cell_index c) {
      somewhere = true;
      if(!fails) return;
      const typename Field::Cell cell = m_field.cell(c);
      const Cell_function& f = cell_function(c);
      std::array<double, 3> t = cell.local_coordinates(p);
      const double shift = e / cell.width() + local_error(p, cell);
      const Level_range r = enclose_at_point(f.function, t, shift);
      fails = m_question.refutes(r);
      const double unit = m_question.unit(cell);
      range.include(Level_range{ r.min / unit, r.max / unit });
    });
    if(!fails) return false;
    if(m_witness) {
      describe(corner, depth);
      m_witness->value = range;
      m_witness->outside = !somewhere;
    }
    return true;
  }

  void describe(const typename Part::Corner& corner, int depth) const
  {
    *m_witness = Witness();
    for(std::size_t v = 0; v < size; ++v) m_witness->barycentric[v] = std::ldexp(double(corner[v]), -depth);
    for(int a = 0; a < 3; ++a) m_witness->point[a] = coordinate(m_simplex, corner, depth, a);
  }

  const Field& m_field;
  const Simplex& m_simplex;
  const Question& m_question;
  Witness* m_witness;
  Least_value* m_bound_below;
  Predicate_statistics m_own_statistics;
  Predicate_statistics& m_statistics;
  double m_largest_width, m_extent, m_reach; // of a cell; of the simplex; largest absolute coordinate of the simplex
  Plane_of_simplex<size> m_plane;
  std::vector<Part> m_stack;
  std::vector<Cell_function> m_functions;
  std::vector<Cell_index> m_cells;                                     // that the current part may meet
  std::size_t m_parts = 0, m_parts_here = 0, m_parts_of_cell_size = 0; // subdivided: in all, in a part of cell size
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_SIMPLEX_DECISION_H
