// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_ASSEMBLE_TRUNCATION_H
#define CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_ASSEMBLE_TRUNCATION_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/Tip.h>

#include <CGAL/number_type_config.h>

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Maps the points of a disc to the plane: the rim to a regular polygon, and each inner point to the mean of its
// neighbors. No triangle is reversed then (W. T. Tutte: How to draw a graph, 1963).
inline std::vector<Shell_truncation_3::Planar_point> planar_disc(const Tip_disc& disc)
{
  std::vector<Shell_truncation_3::Planar_point> planar;
  const std::size_t n = disc.rim.size(), m = disc.inner.size();
  for(std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * CGAL_PI * double(i) / double(n);
    planar.push_back({ std::cos(angle), std::sin(angle) });
  }
  if(m == 0) return planar;
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(m, m);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(m, 2);
  for(const auto& t : disc.triangles)
    for(int i = 0; i < 3; ++i) {
      // Each edge between inner points has two triangles, and is visited in both directions.
      const std::size_t p = t[i], q = t[(i + 1) % 3];
      if(p < n) continue;
      laplacian(p - n, p - n) += 1;
      if(q >= n) laplacian(p - n, q - n) -= 1;
      else
        for(int a = 0; a < 2; ++a) right(p - n, a) += planar[q][a];
    }
  const Eigen::MatrixXd x = laplacian.partialPivLu().solve(right);
  for(std::size_t i = 0; i < m; ++i) planar.push_back({ x(i, 0), x(i, 1) });
  return planar;
}

// Assembles the truncation of a mesh that replaces tips by discs. The result may not be valid.
// \pre `discs` are those of the tips, in their order
inline Shell_truncation_3 assemble_truncation(const Truncation_mesh& mesh, const std::vector<Tip>& tips,
                                              const std::vector<Tip_disc>& discs)
{
  typedef Shell_truncation_3 Truncation;
  typedef Truncation::Index Index;
  const auto coordinates = [](const Tip::Point_3& p) { return Truncation::Point{ p.x(), p.y(), p.z() }; };
  std::vector<Truncation::Point> points;
  std::vector<Truncation::Triangle> cut_facets;
  std::unordered_map<Truncation_mesh::Vertex_index, Index> corner;
  std::unordered_map<Truncation_mesh::Face_index, Index> facet;
  for(const Tip& tip : tips)
    for(Truncation_mesh::Face_index f : tip.facets) {
      if(!facet.emplace(f, Index(cut_facets.size())).second) continue;
      Truncation::Triangle t;
      int i = 0;
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
        const auto found = corner.emplace(v, Index(points.size()));
        if(found.second) points.push_back(coordinates(mesh.point(v)));
        t[i++] = found.first->second;
      }
      cut_facets.push_back(t);
    }

  const std::size_t corners = points.size();
  std::vector<Truncation::Cut> cuts;
  std::vector<Truncation::Planar_point> planar;
  std::vector<Truncation::Disc> assembled;
  // By facet and corner: the rim points in the facet, counterclockwise around the corner.
  std::vector<std::array<std::vector<Index>, 3> > chains(cut_facets.size());
  std::vector<std::vector<Truncation::Planar_point> > in_plane;
  for(std::size_t n = 0; n < tips.size(); ++n) {
    const Tip& tip = tips[n];
    Truncation::Disc disc;
    disc.center = corner.at(tip.vertex);
    in_plane.push_back(planar_disc(discs[n]));
    for(std::size_t i = 0; i < discs[n].rim.size(); ++i) {
      const Tip_disc::Rim_point& p = discs[n].rim[i];
      disc.rim.push_back(Index(points.size()));
      disc.facets.push_back(facet.at(tip.facets[p.facet]));
      points.push_back(coordinates(p.point));
      planar.push_back(in_plane.back()[i]);
      cuts.push_back({ disc.center, corner.at(tip.link[p.facet]),
                       p.t == 0 ? Truncation::npos : corner.at(tip.link[(p.facet + 1) % tip.size()]), p.s, p.t });
    }
    // The rim begins on an edge, so that the chain of a facet is not interrupted.
    for(std::size_t i = 0; i < disc.rim.size(); ++i) {
      const Truncation::Triangle& t = cut_facets[disc.facets[i]];
      auto& chain = chains[disc.facets[i]][Truncation::corner(t, disc.center)];
      if(chain.empty() || chain.back() != disc.rim[i]) chain.push_back(disc.rim[i]);
      chain.push_back(disc.rim[(i + 1) % disc.rim.size()]);
    }
    assembled.push_back(std::move(disc));
  }
  for(std::size_t n = 0; n < tips.size(); ++n) {
    const Tip_disc& disc = discs[n];
    const std::size_t size = disc.rim.size(), first = points.size();
    for(std::size_t i = 0; i < disc.inner.size(); ++i) {
      points.push_back(coordinates(disc.inner[i]));
      planar.push_back(in_plane[n][size + i]);
    }
    for(const auto& t : disc.triangles) {
      Truncation::Triangle triangle;
      for(int i = 0; i < 3; ++i) triangle[i] = t[i] < size ? assembled[n].rim[t[i]] : Index(first + t[i] - size);
      assembled[n].triangles.push_back(triangle);
    }
  }

  std::vector<Truncation::Core> cores;
  for(std::size_t f = 0; f < cut_facets.size(); ++f) {
    const Truncation::Triangle& t = cut_facets[f];
    std::vector<Index> polygon;
    for(int i = 0; i < 3; ++i) {
      if(chains[f][i].empty()) polygon.push_back(t[i]);
      else polygon.insert(polygon.end(), chains[f][i].rbegin(), chains[f][i].rend()); // clockwise around the corner
    }
    // Points are placed in the plane by their barycentric coordinates. The plane has the facet's shape, so that
    // triangles are not worse than necessary.
    const auto at = [&](int i) { return Tip::Point_3(points[t[i]][0], points[t[i]][1], points[t[i]][2]); };
    const double length = std::sqrt(CGAL::squared_distance(at(0), at(1))),
                 x = CGAL::scalar_product(at(2) - at(0), at(1) - at(0)) / length,
                 y = std::sqrt((std::max)(CGAL::squared_distance(at(0), at(2)) - x * x, 0.));
    const std::array<std::array<double, 2>, 3> plane = { { { 0, 0 }, { length, 0 }, { x, y } } };
    std::vector<Tip::Point_3> flat;
    for(Index p : polygon) {
      std::array<double, 3> b = {};
      if(p < corners) b[Truncation::corner(t, p)] = 1;
      else b = cuts[p - corners].barycentric<double>(t);
      flat.emplace_back(b[1] * plane[1][0] + b[2] * plane[2][0], b[2] * plane[2][1], 0);
    }
    for(const auto& triangle : triangulate_polygon(flat))
      cores.push_back({ { polygon[triangle[0]], polygon[triangle[1]], polygon[triangle[2]] }, Index(f) });
  }
  return Truncation(std::move(points), std::move(cut_facets), std::move(cuts), std::move(cores), std::move(assembled),
                    std::move(planar));
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_ASSEMBLE_TRUNCATION_H
