// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_SECOND_ORDER_EXAMINATION_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_SECOND_ORDER_EXAMINATION_H

#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/is_positive_on_triangle.h>
#include <CGAL/Bspline_shell_3/Spline/second_derivatives.h>

#include <CGAL/Bbox_3.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// the result for a triangle
struct Facet_bounds
{
  bool is_contained = false, is_transversal = false; // proved
  // whether a claim fails at a point that is off the triangle by rounding at most: not a proof. The search stops
  // there.
  bool leaves_shell = false, faces_away = false;
  // lower bound on the field's derivative along the unit normal, per user unit, if the triangle is transversal;
  // otherwise 0
  double slope = 0;
};

// The examination of one triangle: it is bisected until the bounds on the cells that its parts meet suffice.
template <typename Cells>
class Second_order_examination
{
public:
  typedef typename Cells::Cell_index Cell_index;
  typedef typename Cells::Sample Sample;

  Second_order_examination(const Cells& cells, const std::array<Sample, 3>& corners, const Facet_normal& normal,
                           std::size_t most_bisections, double target_slope)
    : m_cells(cells), m_normal(normal), m_bisections_left(most_bisections)
  {
    double reach = 0;
    for(const Sample& s : corners)
      for(double x : s.point) reach = (std::max)(reach, std::abs(x));
    // Each bisection rounds a coordinate once.
    m_shift = 4 * (max_depth + 1) * rounding * reach;
    for(int a = 0; a < 3; ++a) m_absolute_normal[a] = std::abs(normal.direction[a]) + normal.radius;
    m_result.slope = std::numeric_limits<double>::infinity();
    const Part part = { { &corners[0], &corners[1], &corners[2] }, 0, 0, false, false };
    const double length = std::sqrt(square(m_absolute_normal[0]) + square(m_absolute_normal[1])
                                    + square(m_absolute_normal[2]));
    m_enough = target_slope * length * (1 + 32 * rounding);
    m_result.is_contained = m_result.is_transversal = true;
    bool fails_at_corner = false;
    for(const Sample& s : corners) fails_at_corner = fails_at_corner || fails(s, part);
    if(!fails_at_corner) find_cells(part);
    m_result.slope = m_result.is_transversal ? m_result.slope / length * (1 - 16 * rounding) : 0;
  }

  const Facet_bounds& result() const { return m_result; }

private:
  typedef typename Cells::Place Place;
  typedef typename Cells::Bounds Bounds;
  typedef std::array<double, 3> Coordinates;
  typedef Symmetric_matrix_3 Symmetric_matrix;

  struct Part
  {
    std::array<const Sample*, 3> corner; // owned by the caller, and by the bisections that led here
    int depth, refinements;              // number of bisections; number of them below the size of a cell
    bool is_contained, is_transversal;   // proved on all of the part, or no longer needed
  };
  struct Cell_met
  {
    Cell_index cell;
    bool is_transversal; // by the gradients on the cell
  };
  // A range of the cells met, by number, and bounds on all of them.
  struct Region
  {
    std::size_t begin, end;
    Symmetric_matrix above, below;      // q of the margins
    Symmetric_matrix radius;            // R of the field
    double width, steepness, curvature; // least width; largest steepness and curvature
    bool is_transversal;
  };
  struct Edges
  {
    std::array<Symmetric_matrix, 3> products; // products of components; doubled off the diagonal
    double longest;                           // length of the longest edge
    int top;                                  // corner opposite to the longest edge
  };

  static double square(double x) { return x * x; }

  // Returns true if a claim cannot be proved because of a point. Then the examination ends.
  bool fails(const Sample& s, const Part& part)
  {
    bool fails = s.cell == Cells::no_cell;
    if(!fails && !part.is_contained) {
      const double margin = (std::min)(s.above, s.below);
      fails = margin < 0;
      m_result.leaves_shell = margin < -2 * m_cells.place(s.cell).value_error;
    }
    if(!fails && !part.is_transversal) {
      const double at_point = Cells::slope(s, m_normal.direction);
      fails = !(at_point > 0);
      m_result.faces_away = at_point < -slope_error(s);
      m_enough = (std::min)(m_enough, 0.9 * at_point);
    }
    if(fails) m_result.is_contained = m_result.is_transversal = false;
    return fails;
  }

  // Bounds the roundings of the slope at a point.
  double slope_error(const Sample& s) const
  {
    const double size = std::abs(s.gradient[0]) + std::abs(s.gradient[1]) + std::abs(s.gradient[2]);
    return 4 * m_cells.bounds(s.cell).gradient_error + (2 * m_normal.radius + 8 * rounding) * size;
  }

  static Edges edges(const Part& part)
  {
    Edges edges;
    double longest = -1;
    for(int v = 0; v < 3; ++v) {
      const Coordinates &p = part.corner[(v + 1) % 3]->point, &q = part.corner[(v + 2) % 3]->point;
      const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2], squared = x * x + y * y + z * z;
      edges.products[v] = { x * x, y * y, z * z, 2 * y * z, 2 * x * z, 2 * x * y };
      if(squared > longest) {
        longest = squared;
        edges.top = v;
      }
    }
    edges.longest = std::sqrt(longest) * (1 + 8 * rounding);
    return edges;
  }

  // Returns a box that contains the exact part, too.
  Bbox_3 bbox(const Part& part) const
  {
    Coordinates least, most;
    for(int a = 0; a < 3; ++a) {
      const double x = part.corner[0]->point[a], y = part.corner[1]->point[a], z = part.corner[2]->point[a];
      least[a] = (std::min)((std::min)(x, y), z) - m_shift;
      most[a] = (std::max)((std::max)(x, y), z) + m_shift;
    }
    return Bbox_3(least[0], least[1], least[2], most[0], most[1], most[2]);
  }

  static bool is_in(const Bbox_3& box, const Place& cell)
  {
    for(int a = 0; a < 3; ++a)
      if((box.min)(a) < cell.corner[a] || (box.max)(a) > cell.corner[a] + cell.width) return false;
    return true;
  }
  static bool do_meet(const Bbox_3& box, const Place& cell)
  {
    for(int a = 0; a < 3; ++a)
      if((box.max)(a) < cell.corner[a] || (box.min)(a) > cell.corner[a] + cell.width) return false;
    return true;
  }

  // Returns false if the facet's plane misses the cell.
  bool plane_meets(const Place& cell, const Part& part) const
  {
    double distance = 0, extent = 0, reach = 0;
    for(int a = 0; a < 3; ++a) {
      const double d = cell.corner[a] + cell.width / 2 - part.corner[0]->point[a];
      distance += m_normal.direction[a] * d;
      extent += m_absolute_normal[a] * (cell.width / 2 + m_shift);
      reach = (std::max)(reach, std::abs(d));
    }
    return std::abs(distance) <= extent * (1 + 16 * rounding) + (3 * m_normal.radius + 16 * rounding) * reach;
  }

  void meet(Cell_index c)
  {
    const Bounds& cell = m_cells.bounds(c);
    double sum = 0, size = 0;
    for(int a = 0; a < 3; ++a) {
      sum += (std::min)(m_normal.direction[a] * cell.least_gradient[a],
                        m_normal.direction[a] * cell.largest_gradient[a]);
      size += (std::max)(std::abs(cell.least_gradient[a]), std::abs(cell.largest_gradient[a]));
    }
    const double least = sum - (2 * m_normal.radius + 8 * rounding) * size;
    const bool is_transversal = least > 0 && least >= m_enough;
    m_met.push_back({ c, is_transversal });
    if(is_transversal) m_result.slope = (std::min)(m_result.slope, least);
  }

  // Finds the cells that a part meets, and examines the part. Parts larger than a few cells are bisected first.
  void find_cells(const Part& part)
  {
    double width = 0;
    for(const Sample* s : part.corner) width = (std::max)(width, m_cells.place(s->cell).width);
    const Edges e = edges(part);
    if(e.longest < large_extent * width) {
      const Bbox_3 box = bbox(part);
      const Cell_index first = part.corner[0]->cell;
      bool is_covered = part.corner[1]->cell == first && part.corner[2]->cell == first
                        && is_in(box, m_cells.place(first));
      if(is_covered) meet(first);
      else
        is_covered = m_cells.field().visit_cells(box, [&](Cell_index c) {
          if(plane_meets(m_cells.place(c), part)) meet(c);
        });
      is_covered = is_covered && !m_met.empty();
      if(is_covered) examine(part, e, region_from(0));
      m_met.clear();
      if(is_covered) return;
    }
    bisect(part, e, [&](const Part& half) { find_cells(half); });
  }

  // Bisects a part, unless a limit is reached. Calls next() for each half, as long as something can still be proved.
  template <typename Next>
  void bisect(const Part& part, const Edges& e, const Next& next)
  {
    if(part.depth == max_depth || part.refinements == max_refinements || m_bisections_left == 0) {
      m_result.is_contained = m_result.is_contained && part.is_contained;
      m_result.is_transversal = m_result.is_transversal && part.is_transversal;
      return;
    }
    --m_bisections_left;
    const Coordinates x = Cells::middle(*part.corner[(e.top + 1) % 3], *part.corner[(e.top + 2) % 3]);
    const Sample between = m_cells.sample(x, locate(x), !part.is_contained, !part.is_transversal);
    if(fails(between, part)) return;
    Part half = part;
    ++half.depth;
    for(int end : { 1, 2 }) {
      half.corner = part.corner;
      half.corner[(e.top + end) % 3] = &between;
      half.is_contained = part.is_contained || !m_result.is_contained; // a failed claim need not be proved
      half.is_transversal = part.is_transversal || !m_result.is_transversal;
      if(!(half.is_contained && half.is_transversal)) next(half);
    }
  }

  // Returns one of the cells met, if it contains the point, or else a cell of the field.
  Cell_index locate(const Coordinates& x) const
  {
    for(std::size_t n = m_met.size(); n-- > 0;)
      if(Cells::contains(m_cells.place(m_met[n].cell), x)) return m_met[n].cell;
    return m_cells.locate(x);
  }

  // Returns the region of the cells met from a number on.
  Region region_from(std::size_t begin) const
  {
    const Bounds& first = m_cells.bounds(m_met[begin].cell);
    Region region = { begin,
                      m_met.size(),
                      {},
                      {},
                      {},
                      m_cells.place(m_met[begin].cell).width,
                      first.steepness,
                      first.curvature,
                      m_met[begin].is_transversal };
    Symmetric_matrix_range_3 above = first.above, below = first.below, field = first.field;
    for(std::size_t n = begin + 1; n < m_met.size(); ++n) {
      const Bounds& cell = m_cells.bounds(m_met[n].cell);
      region.width = (std::min)(region.width, m_cells.place(m_met[n].cell).width);
      region.steepness = (std::max)(region.steepness, cell.steepness);
      region.curvature = (std::max)(region.curvature, cell.curvature);
      region.is_transversal = region.is_transversal && m_met[n].is_transversal;
      above.include(cell.above);
      below.include(cell.below);
      field.include(cell.field);
    }
    region.above = above.largest_form();
    region.below = below.largest_form();
    for(int m = 0; m < 6; ++m) region.radius[m] = (field.most[m] - field.least[m]) / 2;
    return region;
  }

  // Examines a part that meets only cells of a region.
  void examine(Part part, const Edges& e, const Region& around)
  {
    const Bbox_3 box = bbox(part);
    const std::size_t size = m_met.size();
    for(std::size_t n = around.begin; n < around.end; ++n)
      if(around.end - around.begin == 1 || do_meet(box, m_cells.place(m_met[n].cell)))
        m_met.push_back(Cell_met(m_met[n]));
    const bool is_smaller = m_met.size() - size < around.end - around.begin;
    if(!is_smaller) m_met.resize(size);
    if(is_smaller && m_met.size() > size) examine(part, e, box, region_from(size));
    else examine(part, e, box, around);
    m_met.resize(size);
  }

  void examine(Part& part, const Edges& e, const Bbox_3& box, const Region& region)
  {
    if(!part.is_contained) part.is_contained = is_contained(part, e, region);
    if(!part.is_transversal) part.is_transversal = is_transversal(part, box, region);
    if(part.is_contained && part.is_transversal) return;
    part.refinements += e.longest < region.width;
    bisect(part, e, [&](const Part& half) { examine(half, edges(half), region); });
  }

  static constexpr double up = 1 + 32 * rounding;

  bool is_contained(const Part& part, const Edges& e, const Region& region) const
  {
    // Corners are off by the shift, and edges by twice the shift. This also exceeds the roundings of products, unless
    // these underflow.
    const double error = (region.steepness + 2 * region.curvature * (e.longest + m_shift)) * m_shift
                         + region.curvature * underflow;
    std::array<double, 3> above, below;
    for(std::size_t v = 0; v < 3; ++v) {
      above[v] = part.corner[v]->above - error * up;
      below[v] = part.corner[v]->below - error * up;
    }
    return is_positive_on_triangle(above, on_edges(region.above, e))
           && is_positive_on_triangle(below, on_edges(region.below, e));
  }

  static std::array<double, 3> on_edges(const Symmetric_matrix& q, const Edges& e)
  {
    std::array<double, 3> on_edges;
    for(std::size_t v = 0; v < 3; ++v) {
      const Symmetric_matrix& p = e.products[v];
      on_edges[v] = q[0] * p[0] + q[1] * p[1] + q[2] * p[2] + q[3] * p[3] + q[4] * p[4] + q[5] * p[5];
    }
    return on_edges;
  }

  bool is_transversal(const Part& part, const Bbox_3& box, const Region& region)
  {
    if(region.is_transversal) return true;
    const Symmetric_matrix& r = region.radius;
    const Coordinates& n = m_absolute_normal;
    const double deviation = (box.xmax() - box.xmin()) * (r[0] * n[0] + r[5] * n[1] + r[4] * n[2])
                             + (box.ymax() - box.ymin()) * (r[5] * n[0] + r[1] * n[1] + r[3] * n[2])
                             + (box.zmax() - box.zmin()) * (r[4] * n[0] + r[3] * n[1] + r[2] * n[2]);
    double least = std::numeric_limits<double>::infinity();
    for(const Sample* s : part.corner)
      least = (std::min)(least, Cells::slope(*s, m_normal.direction) - slope_error(*s));
    least -= (deviation / 2 + 4 * region.curvature * m_shift) * up;
    if(!(least > 0 && least >= m_enough)) return false;
    m_result.slope = (std::min)(m_result.slope, least);
    return true;
  }

  const Cells& m_cells;
  const Facet_normal& m_normal;
  Coordinates m_absolute_normal;
  double m_shift;  // by which rounding may displace corners of parts
  double m_enough; // bound on the slope on a part that suffices
  std::size_t m_bisections_left;
  Facet_bounds m_result;
  // The cells of the current region, after the cells of the regions that contain it.
  boost::container::small_vector<Cell_met, 256> m_met;

  static constexpr double large_extent = 3; // cells
  static constexpr int max_depth = 40, max_refinements = 14;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_SECOND_ORDER_EXAMINATION_H
