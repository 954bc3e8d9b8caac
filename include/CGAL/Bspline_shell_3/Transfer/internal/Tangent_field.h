// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_TANGENT_FIELD_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_TANGENT_FIELD_H

#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

inline Eigen::Vector3d eigen_vector(const std::array<double, 3>& v) { return Eigen::Vector3d(v[0], v[1], v[2]); }

// The mean of vectors in a plane, each of which stands for its rotations by 2 pi / N: the angle is that of the mean of N-th powers, next to the
// first vector; the length is the mean length. For N = 1, it is the mean.
class Symmetric_mean
{
public:
  Symmetric_mean(const Eigen::Vector3d& normal, int symmetry) : m_normal(normal.normalized()), m_symmetry(symmetry) {}

  void add(const Eigen::Vector3d& v, double weight)
  {
    m_weight += weight;
    m_sum += weight * v;
    const double length = v.norm();
    if(m_symmetry == 1 || !(length > 0)) return;
    if(m_length == 0) {
      m_x = (v - v.dot(m_normal) * m_normal).normalized();
      m_y = m_normal.cross(m_x);
    }
    m_length += weight * length;
    m_power += weight * length * std::polar(1., m_symmetry * std::atan2(m_y.dot(v), m_x.dot(v)));
  }

  // zero if nothing was added
  Eigen::Vector3d operator()() const
  {
    if(!(m_weight > 0)) return Eigen::Vector3d::Zero();
    if(m_symmetry == 1) return m_sum / m_weight;
    const double angle = std::arg(m_power) / m_symmetry;
    return m_length / m_weight * (std::cos(angle) * m_x + std::sin(angle) * m_y);
  }

private:
  Eigen::Vector3d m_normal, m_x = Eigen::Vector3d::Zero(), m_y = Eigen::Vector3d::Zero(), m_sum = Eigen::Vector3d::Zero();
  std::complex<double> m_power = 0;
  int m_symmetry;
  double m_weight = 0, m_length = 0;
};

// A field of symmetric tangent vectors on a mesh: constant on each facet, or interpolated between vertices: their N-th powers, as
// complex numbers whose modulus is the vector's length. Directions at a vertex are polar angles, the sum of its facets' angles being scaled to a full
// turn (as in F. Knoeppel, K. Crane, U. Pinkall, P. Schroeder: Globally optimal direction fields, 2013). A facet has them turned, so that the
// bisector of its angle is the same for both: a phase for each corner.
class Tangent_field
{
  typedef Projection_facets_3::Index Index;
  typedef std::complex<double> Power;
public:
  // from vectors at facets
  static Tangent_field constant(const Projection_facets_3& facets, std::vector<Eigen::Vector3d> of_facets)
  {
    Tangent_field field(facets, 1);
    field.m_of_facets = std::move(of_facets);
    return field;
  }

  // From vectors at facets: those at vertices are the mean of those around them, weighted by angles. As this smooths, what the means of facets lack
  // is added once. `vertices` has the number of the vertex at each corner: 3 times that of the facet, and that of the corner.
  static Tangent_field continuous(const Projection_facets_3& facets, const std::vector<Eigen::Vector3d>& of_facets, std::vector<std::size_t> vertices,
                                  std::size_t number_of_vertices, int symmetry)
  {
    Tangent_field field(facets, symmetry);
    field.set_phases(std::move(vertices), number_of_vertices);
    std::vector<Power> powers, missing;
    std::vector<double> lengths;
    for(Index f = 0; f < facets.number_of_facets(); ++f) {
      powers.push_back(facets.has_area(f) ? field.power(of_facets[f], f) : Power(0));
      lengths.push_back(std::abs(powers.back()));
    }
    field.m_powers = field.powers_at_vertices(powers);
    field.m_lengths = field.means_at_vertices<double>([&](std::size_t c) { return lengths[c / 3]; });
    for(Index f = 0; f < facets.number_of_facets(); ++f) missing.push_back(powers[f] - field.interpolated(f, { 1/3., 1/3., 1/3. }));
    const std::vector<Power> added = field.powers_at_vertices(missing);
    for(std::size_t v = 0; v < number_of_vertices; ++v) field.m_powers[v] += added[v];
    return field;
  }

  // from vectors at vertices; what they have along the normal is lost
  static Tangent_field continuous(const Projection_facets_3& facets, const std::vector<Eigen::Vector3d>& of_vertices,
                                  std::vector<std::size_t> vertices, int symmetry)
  {
    Tangent_field field(facets, symmetry);
    field.set_phases(std::move(vertices), of_vertices.size());
    std::vector<Eigen::Vector3d> normals(of_vertices.size(), Eigen::Vector3d::Zero());
    for(std::size_t c = 0; c < field.m_vertices.size(); ++c)
      if(field.m_angles[c] > 0) normals[field.m_vertices[c]] += field.m_angles[c] * field.normal(Index(c / 3)).normalized();
    // into each facet by the rotation that takes one normal to the other the shortest way
    field.m_powers = field.means_at_vertices<Power>([&](std::size_t c) {
      const std::size_t v = field.m_vertices[c];
      const Eigen::Vector3d n = normals[v].normalized(), tangent = of_vertices[v] - of_vertices[v].dot(n) * n;
      const Index f = Index(c / 3);
      return std::conj(field.m_phases[c]) * field.power(Eigen::Quaterniond::FromTwoVectors(n, field.normal(f)) * tangent, f);
    });
    for(const Power& z : field.m_powers) field.m_lengths.push_back(std::abs(z));
    return field;
  }

  // in the facet's plane. \pre the facet has an area
  Eigen::Vector3d operator()(Index facet, const std::array<double, 3>& barycentric) const
  {
    if(!m_of_facets.empty()) return m_of_facets[facet];
    const Power z = interpolated(facet, barycentric);
    const Eigen::Vector3d x = x_axis(facet), y = normal(facet).normalized().cross(x);
    if(m_symmetry == 1) return z.real() * x + z.imag() * y;
    double length = 0;
    for(std::size_t i = 0; i < 3; ++i) length += barycentric[i] * m_lengths[m_vertices[3 * facet + i]];
    const double angle = std::arg(z) / m_symmetry;
    return length * (std::cos(angle) * x + std::sin(angle) * y);
  }

private:
  Tangent_field(const Projection_facets_3& facets, int symmetry) : m_facets(&facets), m_symmetry(symmetry) {}

  Eigen::Vector3d normal(Index f) const { return eigen_vector(m_facets->normal(f)); }
  Eigen::Vector3d edge(Index f, int i) const { return eigen_vector(m_facets->vertex(f, (i + 1) % 3)) - eigen_vector(m_facets->vertex(f, i)); }
  Eigen::Vector3d x_axis(Index f) const { return edge(f, 0).normalized(); }

  double polar_angle(const Eigen::Vector3d& v, Index f) const
  {
    const Eigen::Vector3d x = x_axis(f);
    return std::atan2(normal(f).normalized().cross(x).dot(v), x.dot(v));
  }
  Power power(const Eigen::Vector3d& v, Index f) const { return std::polar(v.norm(), m_symmetry * polar_angle(v, f)); }

  Power interpolated(Index f, const std::array<double, 3>& barycentric) const
  {
    Power z = 0;
    for(std::size_t i = 0; i < 3; ++i) z += barycentric[i] * m_phases[3 * f + i] * m_powers[m_vertices[3 * f + i]];
    return z;
  }

  // of what is said of corners
  template <typename Value, typename Function>
  std::vector<Value> means_at_vertices(const Function& value) const
  {
    std::vector<Value> sum(m_number_of_vertices, Value(0));
    std::vector<double> weight(m_number_of_vertices, 0);
    for(std::size_t c = 0; c < m_vertices.size(); ++c) {
      if(!(m_angles[c] > 0)) continue;
      sum[m_vertices[c]] += m_angles[c] * value(c);
      weight[m_vertices[c]] += m_angles[c];
    }
    for(std::size_t v = 0; v < sum.size(); ++v)
      if(weight[v] > 0) sum[v] /= weight[v];
    return sum;
  }
  std::vector<Power> powers_at_vertices(const std::vector<Power>& of_facets) const
  {
    return means_at_vertices<Power>([&](std::size_t c) { return std::conj(m_phases[c]) * of_facets[c / 3]; });
  }

  // Facets without an area face no way, and do not count.
  void set_phases(std::vector<std::size_t> vertices, std::size_t number_of_vertices)
  {
    m_vertices = std::move(vertices);
    m_number_of_vertices = number_of_vertices;
    m_angles.assign(m_vertices.size(), 0);
    m_phases.assign(m_vertices.size(), 1);
    for(std::size_t c = 0; c < m_vertices.size(); ++c) {
      const Index f = Index(c / 3);
      const int i = int(c % 3);
      const Eigen::Vector3d a = edge(f, i), b = -edge(f, (i + 2) % 3);
      if(m_facets->has_area(f)) m_angles[c] = std::atan2(a.cross(b).norm(), a.dot(b));
    }
    std::vector<char> is_done(m_vertices.size(), 0);
    for(std::size_t c = 0; c < m_vertices.size(); ++c) {
      if(is_done[c]) continue;
      // once around the vertex, counterclockwise; at a border from the first facet to the last
      const std::size_t first = first_corner(c);
      const bool is_closed = next_corner(first, 0) != none;
      double sum = 0, angle = 0;
      for(std::size_t d = first; d != none && !is_done[d]; d = next_corner(d, 2)) {
        is_done[d] = 1;
        sum += m_angles[d];
      }
      const double scale = is_closed && sum > 0 ? 2 * CGAL_PI / sum : 1;
      std::size_t d = first;
      do {
        const Index f = Index(d / 3);
        if(m_angles[d] > 0)
          m_phases[d] = std::polar(1., m_symmetry * (polar_angle(edge(f, int(d % 3)), f) + m_angles[d] / 2 - (angle + scale * m_angles[d] / 2)));
        angle += scale * m_angles[d];
        d = next_corner(d, 2);
      } while(d != none && d != first);
    }
  }

  static constexpr std::size_t none = std::size_t(-1);

  // Of the facet beyond one of a facet's edges at a corner's vertex: that which begins there, 0, or ends there, 2.
  std::size_t next_corner(std::size_t corner, std::size_t edge) const
  {
    const Index f = Index(corner / 3), g = m_facets->neighbor(f, int((corner % 3 + edge) % 3));
    if(g == Projection_facets_3::npos) return none;
    for(std::size_t i = 0; i < 3; ++i)
      if(m_vertices[3 * std::size_t(g) + i] == m_vertices[corner]) return 3 * std::size_t(g) + i;
    return none;
  }
  std::size_t first_corner(std::size_t corner) const
  {
    for(std::size_t c = corner;;) {
      const std::size_t before = next_corner(c, 0);
      if(before == none) return c;
      if(before == corner) return corner;
      c = before;
    }
  }

  const Projection_facets_3* m_facets;
  int m_symmetry;
  std::vector<Eigen::Vector3d> m_of_facets;               // this alone, or the others
  std::vector<std::size_t> m_vertices;                    // by corner, as angles and phases
  std::size_t m_number_of_vertices = 0;
  std::vector<double> m_angles;
  std::vector<Power> m_phases;                            // from vertex to facet
  std::vector<Power> m_powers;                            // by vertex
  std::vector<double> m_lengths;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_TANGENT_FIELD_H
