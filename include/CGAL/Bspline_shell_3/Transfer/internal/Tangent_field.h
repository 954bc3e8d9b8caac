// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_TANGENT_FIELD_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_TANGENT_FIELD_H

#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

inline Eigen::Vector3d eigen_vector(const std::array<double, 3>& v)
{
  return Eigen::Vector3d(v[0], v[1], v[2]);
}

// The mean of vectors in a plane, each of which represents its rotations by multiples of 2 pi / N. The angle is that of
// the mean of the N-th powers, chosen closest to the first vector; the length is the mean length. For N = 1, this is
// the ordinary mean.
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

  // Returns zero if nothing was added.
  Eigen::Vector3d operator()() const
  {
    if(!(m_weight > 0)) return Eigen::Vector3d::Zero();
    if(m_symmetry == 1) return m_sum / m_weight;
    const double angle = std::arg(m_power) / m_symmetry;
    return m_length / m_weight * (std::cos(angle) * m_x + std::sin(angle) * m_y);
  }

private:
  Eigen::Vector3d m_normal, m_x = Eigen::Vector3d::Zero(), m_y = Eigen::Vector3d::Zero(),
                            m_sum = Eigen::Vector3d::Zero();
  std::complex<double> m_power = 0;
  int m_symmetry;
  double m_weight = 0, m_length = 0;
};

// Returns a vector after the smallest rotation that takes one direction to another.
inline Eigen::Vector3d rotated(const Eigen::Vector3d& v, const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  const Eigen::Vector3d axis = from.cross(to);
  return Eigen::AngleAxisd(std::atan2(axis.norm(), from.dot(to)), axis.normalized()) * v;
}

// Returns the pseudoinverse of a positive semidefinite matrix.
inline Eigen::Matrix2d pseudoinverse(const Eigen::Matrix2d& matrix)
{
  const double trace = matrix.trace(), det = matrix.determinant();
  // The determinant of a matrix of rank 1 is at most this after rounding.
  if(det > std::numeric_limits<double>::epsilon() * trace * trace) return matrix.inverse();
  if(!(trace > 0)) return Eigen::Matrix2d::Zero();
  return matrix / (trace * trace);
}

// A field of symmetric tangent vectors on a mesh.
class Tangent_field
{
  typedef Projection_facets_3::Index Index;
  typedef std::complex<double> Power;
public:
  // Returns a field that is constant on each facet.
  static Tangent_field constant(const Projection_facets_3& facets, std::vector<Eigen::Vector3d> of_facets)
  {
    Tangent_field field(facets, 1);
    field.m_of_facets = std::move(of_facets);
    return field;
  }

  // Returns a field that is linear on each facet, has the facet's vector at the centroid, and fits the vectors of the
  // neighbors best. Neighbors are unfolded around common edges. The N-th powers are linear, as complex numbers whose
  // modulus is the vector's length. Neighbors across sharp edges are ignored, because a field need not be continuous
  // there.
  static Tangent_field linear(const Projection_facets_3& facets, std::vector<Eigen::Vector3d> of_facets, int symmetry)
  {
    Tangent_field field(facets, symmetry);
    field.m_of_facets = std::move(of_facets);
    for(Index f = 0; f < facets.number_of_facets(); ++f)
      field.m_gradients.push_back(facets.has_area(f) ? field.gradient(f) : Gradient{ 0, 0 });
    return field;
  }

  // Returns a field that is interpolated between vertices. The vector of a vertex is rotated into each facet by the
  // smallest rotation from the vertex's normal. This normal is the mean of the facets' normals, weighted by angles.
  // Components along the normal are lost. `vertices` contains the index of the vertex at each corner; corner i of facet
  // f has the index 3 f + i.
  static Tangent_field interpolated(const Projection_facets_3& facets, std::vector<Eigen::Vector3d> of_vertices,
                                    std::vector<std::size_t> vertices, int symmetry)
  {
    Tangent_field field(facets, symmetry);
    field.m_vertices = std::move(vertices);
    field.m_normals.assign(of_vertices.size(), Eigen::Vector3d::Zero());
    for(std::size_t c = 0; c < field.m_vertices.size(); ++c) {
      const Index f = Index(c / 3);
      const int i = int(c % 3);
      if(!facets.has_area(f)) continue;
      const Eigen::Vector3d a = field.edge(f, i), b = -field.edge(f, (i + 2) % 3);
      field.m_normals[field.m_vertices[c]] += std::atan2(a.cross(b).norm(), a.dot(b)) * field.normal(f).normalized();
    }
    for(std::size_t v = 0; v < of_vertices.size(); ++v) {
      Eigen::Vector3d& n = field.m_normals[v];
      n = n.norm() > 0 ? Eigen::Vector3d(n.normalized()) : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
      of_vertices[v] -= of_vertices[v].dot(n) * n;
    }
    field.m_of_vertices = std::move(of_vertices);
    return field;
  }

  // Returns the vector in the facet's plane.
  // \pre the facet has an area
  Eigen::Vector3d operator()(Index f, const std::array<double, 3>& barycentric) const
  {
    if(!m_of_vertices.empty()) {
      Symmetric_mean mean(normal(f), m_symmetry);
      for(std::size_t i = 0; i < 3; ++i) {
        const std::size_t v = m_vertices[3 * std::size_t(f) + i];
        mean.add(rotated(m_of_vertices[v], m_normals[v], normal(f)), barycentric[i]);
      }
      return mean();
    }
    if(m_gradients.empty()) return m_of_facets[f];
    const Eigen::Vector3d x = x_axis(f), y = y_axis(f), p = eigen_vector(m_facets->point(f, barycentric)) - centroid(f);
    const Power z = power(f) + m_gradients[f][0] * x.dot(p) + m_gradients[f][1] * y.dot(p);
    if(m_symmetry == 1) return z.real() * x + z.imag() * y;
    const double angle = std::arg(z) / m_symmetry;
    return m_of_facets[f].norm() * (std::cos(angle) * x + std::sin(angle) * y);
  }

private:
  typedef std::array<Power, 2> Gradient; // derivatives with respect to the coordinates in the facet's plane

  Tangent_field(const Projection_facets_3& facets, int symmetry) : m_facets(&facets), m_symmetry(symmetry) {}

  Eigen::Vector3d normal(Index f) const { return eigen_vector(m_facets->normal(f)); }
  Eigen::Vector3d vertex(Index f, int i) const { return eigen_vector(m_facets->vertex(f, i % 3)); }
  Eigen::Vector3d edge(Index f, int i) const { return vertex(f, i + 1) - vertex(f, i); }
  Eigen::Vector3d centroid(Index f) const { return (vertex(f, 0) + vertex(f, 1) + vertex(f, 2)) / 3; }
  Eigen::Vector3d x_axis(Index f) const { return edge(f, 0).normalized(); }
  Eigen::Vector3d y_axis(Index f) const { return normal(f).normalized().cross(x_axis(f)); }

  double polar_angle(Index f, const Eigen::Vector3d& v) const { return std::atan2(y_axis(f).dot(v), x_axis(f).dot(v)); }
  Power power(Index f) const { return std::polar(m_of_facets[f].norm(), m_symmetry * polar_angle(f, m_of_facets[f])); }

  Gradient gradient(Index f) const
  {
    constexpr double least_cosine = 0.5; // 60 degrees between normals
    const Eigen::Vector3d x = x_axis(f), y = y_axis(f);
    const Power z = power(f);
    Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
    std::array<Power, 2> right = { 0, 0 };
    double largest = 0;
    for(int i = 0; i < 3; ++i) {
      const Index g = m_facets->neighbor(f, i);
      if(g == Projection_facets_3::npos || !m_facets->has_area(g)) continue;
      if(normal(f).normalized().dot(normal(g).normalized()) < least_cosine) continue;
      // the neighbor's centroid, in the plane of the facet, at its distance from the common edge
      const Eigen::Vector3d along = edge(f, i).normalized(), inwards = normal(f).normalized().cross(along),
                            to = centroid(g) - vertex(f, i);
      const Eigen::Vector3d unfolded = vertex(f, i) + along.dot(to) * along
                                       - (to - along.dot(to) * along).norm() * inwards - centroid(f);
      const Eigen::Vector2d d(x.dot(unfolded), y.dot(unfolded));
      const Power difference = power(g) * std::polar(1., m_symmetry * (polar_angle(f, along) - polar_angle(g, along)))
                               - z;
      const double weight = 1 / d.squaredNorm();
      matrix += weight * d * d.transpose();
      for(int k = 0; k < 2; ++k) right[k] += weight * d[k] * difference;
      largest = (std::max)(largest, std::abs(difference));
    }
    const Eigen::Matrix2d inverse = pseudoinverse(matrix);
    const Gradient slope = { inverse(0, 0) * right[0] + inverse(0, 1) * right[1],
                             inverse(1, 0) * right[0] + inverse(1, 1) * right[1] };
    // Limits the gradient so that at the corners, the field differs from the facet's vector by at most as much as the
    // neighbors do.
    double farthest = 0;
    for(int i = 0; i < 3; ++i) {
      const Eigen::Vector3d p = vertex(f, i) - centroid(f);
      farthest = (std::max)(farthest, std::abs(slope[0] * x.dot(p) + slope[1] * y.dot(p)));
    }
    const double scale = farthest > largest ? largest / farthest : 1;
    return { scale * slope[0], scale * slope[1] };
  }

  const Projection_facets_3* m_facets;
  int m_symmetry;
  std::vector<Eigen::Vector3d> m_of_facets;
  std::vector<Gradient> m_gradients;                     // linear fields only
  std::vector<Eigen::Vector3d> m_of_vertices, m_normals; // interpolated fields only
  std::vector<std::size_t> m_vertices;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_TANGENT_FIELD_H
