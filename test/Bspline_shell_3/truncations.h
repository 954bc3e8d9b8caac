// Truncations of meshes as separate arrays, which tests can modify.
#ifndef TRUNCATIONS_H
#define TRUNCATIONS_H

#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>

#include <CGAL/number_type_config.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

struct Truncation_parts
{
  typedef CGAL::Bspline_shells::Shell_truncation_3 Truncation;
  typedef Truncation::Index Index;

  std::vector<Truncation::Point> points;
  std::vector<Truncation::Triangle> cut_facets;
  std::vector<Truncation::Cut> cuts;
  std::vector<Truncation::Core> cores;
  std::vector<Truncation::Disc> discs;
  std::vector<Truncation::Planar_point> planar;

  Truncation assembled() const { return Truncation(points, cut_facets, cuts, cores, discs, planar); }
  std::shared_ptr<const Truncation> shared() const { return std::make_shared<const Truncation>(assembled()); }
  bool is_valid() const { return assembled().is_valid(); }
};

// Cuts off vertices at 1/4 of their edges, and replaces each by a fan of triangles: around its first cut or, with
// `has_point`, around the centroid of its cuts.
inline Truncation_parts truncation_at(const Mesh& mesh, const std::vector<Mesh::Vertex_index>& centers, bool has_point)
{
  typedef Truncation_parts::Index Index;
  typedef Truncation_parts::Truncation Truncation;
  constexpr double s = 0.25;
  Truncation_parts parts;
  std::map<Mesh::Vertex_index, Index> corner;
  std::map<Mesh::Face_index, Index> facet;
  std::map<std::pair<Mesh::Vertex_index, Mesh::Vertex_index>, Index> cut; // by center and the other end of the edge
  for(auto center : centers)
    for(auto f : mesh.faces_around_target(mesh.halfedge(center))) {
      if(!facet.emplace(f, Index(parts.cut_facets.size())).second) continue;
      Truncation::Triangle t;
      int i = 0;
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
        const auto found = corner.emplace(v, Index(parts.points.size()));
        if(found.second) parts.points.push_back({ mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z() });
        t[i++] = found.first->second;
      }
      parts.cut_facets.push_back(t);
    }
  for(auto center : centers) {
    Truncation::Disc disc;
    disc.center = corner.at(center);
    const double step = 2 * CGAL_PI / double(mesh.degree(center));
    const auto first = mesh.opposite(mesh.halfedge(center));
    auto h = first;
    do {
      const auto end = mesh.target(h);
      const Point_3 p = mesh.point(center) + s * (mesh.point(end) - mesh.point(center));
      const double angle = step * double(disc.rim.size());
      cut[{ center, end }] = Index(parts.points.size());
      disc.rim.push_back(Index(parts.points.size()));
      disc.facets.push_back(facet.at(mesh.face(h)));
      parts.points.push_back({ p.x(), p.y(), p.z() });
      parts.planar.push_back({ std::cos(angle), std::sin(angle) });
      parts.cuts.push_back({ disc.center, corner.at(end), Truncation::npos, s, 0 });
      h = mesh.opposite(mesh.prev(h));
    } while(h != first);
    parts.discs.push_back(disc);
  }
  for(Truncation::Disc& disc : parts.discs) {
    const std::size_t size = disc.rim.size();
    if(has_point) {
      Truncation::Point middle = {};
      for(Index p : disc.rim)
        for(int a = 0; a < 3; ++a) middle[a] += parts.points[p][a] / double(size);
      for(std::size_t i = 0; i < size; ++i)
        disc.triangles.push_back({ disc.rim[i], disc.rim[(i + 1) % size], Index(parts.points.size()) });
      parts.points.push_back(middle);
      parts.planar.push_back({ 0, 0 });
    } else
      for(std::size_t i = 1; i + 1 < size; ++i) disc.triangles.push_back({ disc.rim[0], disc.rim[i], disc.rim[i + 1] });
  }
  for(const auto& pair : facet) {
    std::vector<Mesh::Vertex_index> v;
    for(auto u : mesh.vertices_around_face(mesh.halfedge(pair.first))) v.push_back(u);
    std::vector<Index> polygon;
    for(int i = 0; i < 3; ++i) {
      const auto before = cut.find({ v[i], v[(i + 2) % 3] }), after = cut.find({ v[i], v[(i + 1) % 3] });
      if(before == cut.end()) polygon.push_back(corner.at(v[i]));
      else polygon.insert(polygon.end(), { before->second, after->second });
    }
    for(std::size_t i = 1; i + 1 < polygon.size(); ++i)
      parts.cores.push_back({ { polygon[0], polygon[i], polygon[i + 1] }, pair.second });
  }
  return parts;
}

// The apex of `pyramid(4, 1)` is cut off halfway, and replaced by a square. With `has_point`, it is replaced by a roof
// with a point in the middle.
inline Truncation_parts square_pyramid(bool has_point = false)
{
  typedef Truncation_parts::Truncation Truncation;
  typedef Truncation_parts::Index Index;
  Truncation_parts parts;
  const Index apex = 0, npos = Truncation::npos;
  const Mesh mesh = pyramid(4, 1);
  for(std::uint32_t v : { 0u, 2u, 3u, 4u, 5u }) {
    const Point_3& p = mesh.point(Mesh::Vertex_index(v));
    parts.points.push_back({ p.x(), p.y(), p.z() });
  }
  for(Index i = 0; i < 4; ++i) parts.cut_facets.push_back({ apex, 1 + i, 1 + (i + 1) % 4 });
  Truncation::Disc disc;
  disc.center = apex;
  for(Index i = 0; i < 4; ++i) {
    const auto p = parts.points[1 + i]; // a copy, as the vector grows
    parts.points.push_back({ p[0] / 2, p[1] / 2, 0.5 });
    parts.cuts.push_back({ apex, 1 + i, npos, 0.5, 0 });
    parts.planar.push_back({ p[0], p[1] });
    disc.rim.push_back(5 + i);
    disc.facets.push_back(i);
    const Index j = (i + 1) % 4;
    parts.cores.push_back({ { 5 + i, 1 + i, 1 + j }, i });
    parts.cores.push_back({ { 5 + i, 1 + j, 5 + j }, i });
  }
  if(has_point) {
    parts.points.push_back({ 0.05, 0, 0.6 });
    parts.planar.push_back({ 0.1, 0.2 });
    for(Index i = 0; i < 4; ++i) disc.triangles.push_back({ 5 + i, 5 + (i + 1) % 4, 9 });
  } else disc.triangles = { { 5, 6, 7 }, { 5, 7, 8 } };
  parts.discs.push_back(disc);
  return parts;
}

#endif // TRUNCATIONS_H
