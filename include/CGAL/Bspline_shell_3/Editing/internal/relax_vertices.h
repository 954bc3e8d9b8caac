// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_RELAX_VERTICES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_RELAX_VERTICES_H

#include <CGAL/Bspline_shell_3/Certificate/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Remeshing_tuning.h>
#include <CGAL/Bspline_shell_3/Editing/internal/triangle_quality.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/container/static_vector.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the vertices that may move, in classes without edges within a class. Each vertex is in the first class that
// contains none of its neighbors.
template <typename Guarded>
std::vector<std::vector<typename Guarded::vertex_descriptor> > independent_vertices(const Guarded& guarded)
{
  constexpr std::size_t none = std::size_t(-1);
  auto& mesh = guarded.mesh;
  std::vector<std::vector<typename Guarded::vertex_descriptor> > classes;
  const auto class_of = get(dynamic_vertex_property_t<std::size_t>(), mesh);
  for(auto v : vertices(mesh)) put(class_of, v, none);
  std::vector<char> is_taken;
  for(auto v : vertices(mesh)) {
    if(halfedge(v, mesh) == boost::graph_traits<typename Guarded::TriangleMesh>::null_halfedge() || guarded.is_fixed(v))
      continue;
    is_taken.assign(classes.size() + 1, 0);
    for(auto h : CGAL::halfedges_around_target(v, mesh))
      if(const std::size_t c = get(class_of, source(h, mesh)); c != none) is_taken[c] = 1;
    const std::size_t c = std::size_t(std::find(is_taken.begin(), is_taken.end(), 0) - is_taken.begin());
    if(c == classes.size()) classes.emplace_back();
    classes[c].push_back(v);
    put(class_of, v, c);
  }
  return classes;
}

// Returns the vector from a point to the centroid of the facets around it, projected to directions without normals: two
// on a smooth surface, one along an edge, none at a corner.
template <typename Point>
typename Kernel_traits<Point>::Kernel::Vector_3 tangential_move(const Point& p, const std::vector<Point>& link)
{
  typedef typename Kernel_traits<Point>::Kernel::Vector_3 Vector;
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double area = 0;
  for(std::size_t n = 0; n < link.size(); ++n) {
    const Vector u = link[n] - p, v = link[(n + 1) % link.size()] - p, normal = CGAL::cross_product(u, v);
    const double a = std::sqrt(normal.squared_length());
    if(!(a > 0)) continue;
    const Eigen::Vector3d e(normal.x(), normal.y(), normal.z());
    tensor += e * e.transpose() / a;
    center += a / 3 * Eigen::Vector3d(u.x() + v.x(), u.y() + v.y(), u.z() + v.z());
    area += a;
  }
  if(!(area > 0)) return NULL_VECTOR;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(tensor / area);
  Eigen::Vector3d move = Eigen::Vector3d::Zero();
  for(int i = 0; i < 2; ++i)
    if(eigen.eigenvalues()[i] < remeshing_tuning.crease)
      move += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).dot(center / area);
  return Vector(move[0], move[1], move[2]);
}

// The verdicts on the positions that were tried for a vertex, and the last position, which may have been accepted.
template <typename Point>
struct Vertex_move
{
  boost::container::static_vector<Placement_verdict, remeshing_tuning.parts_of_moves.size()> verdicts;
  Point place;
};

// Returns the first of several fractions of a vertex's move after which its facets are good.
template <typename Guarded, typename Projection>
Vertex_move<typename Guarded::Point> find_move(typename Guarded::vertex_descriptor v, const Guarded& guarded,
                                               const Projection& project)
{
  const auto& mesh = guarded.mesh;
  typename Guarded::Link link;
  auto h = halfedge(v, mesh);
  do {
    link.push_back(guarded.point(source(h, mesh)));
    h = guarded.turn(h);
  } while(h != halfedge(v, mesh));
  Vertex_move<typename Guarded::Point> found;
  const typename Guarded::Point& p = guarded.point(v);
  const auto move = tangential_move(p, link);
  const double before = (std::min)(star_quality(p, link), remeshing_tuning.good_quality);
  for(double part : remeshing_tuning.parts_of_moves) {
    found.place = project(p + part * move);
    if(found.place == p || !(star_quality(found.place, link) >= before)) continue;
    found.verdicts.push_back(guarded.verdict(found.place, link));
    if(found.verdicts.back() == Placement_verdict::ACCEPTED) break;
  }
  return found;
}

// Moves vertices toward the centroids of their facets, within the tangent plane. Vertices on sharp edges move only
// along these, and corners do not move. Then, `project` may change the position. Vertices without a common edge are
// moved concurrently.
template <typename ConcurrencyTag, typename Guarded, typename Projection>
void relax_vertices(Guarded& guarded, const Projection& project)
{
  constexpr std::size_t chunk = 64;
  for(const auto& independent : independent_vertices(guarded)) {
    if(!guarded.go_on()) return;
    std::vector<Vertex_move<typename Guarded::Point> > moves(independent.size());
    for_each_chunk<ConcurrencyTag>(independent.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n) moves[n] = find_move(independent[n], guarded, project);
    });
    for(std::size_t n = 0; n < moves.size(); ++n) {
      for(Placement_verdict verdict : moves[n].verdicts) guarded.count(verdict);
      if(!moves[n].verdicts.empty() && moves[n].verdicts.back() == Placement_verdict::ACCEPTED)
        guarded.move(independent[n], moves[n].place);
    }
  }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_RELAX_VERTICES_H
