#include "Mesh_origins.h"
#include "closest_weights.h"

#include "../Files/triangles_of.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace Tool {

namespace {

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef Kernel::Point_3 Point;

Eigen::Vector3d vector(const Point& p)
{
  return { p.x(), p.y(), p.z() };
}

// The polygons as triangles, for the search of the nearest one.
class Triangles
{
  typedef std::vector<Kernel::Triangle_3> List;
  typedef CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, List::const_iterator> > Traits;

public:
  struct Triangle
  {
    std::size_t polygon;
    std::array<std::size_t, 3> corners;
  };

  Triangles(const Model& model, const std::vector<std::size_t>& first)
  {
    const auto& points = model.soup.points;
    for(std::size_t n = 0; n < model.soup.polygons.size(); ++n) {
      const auto& polygon = model.soup.polygons[n];
      for(const auto& t : triangles_of(model, n)) {
        const Kernel::Triangle_3 triangle(points[polygon[t[0]]], points[polygon[t[1]]], points[polygon[t[2]]]);
        if(triangle.is_degenerate()) continue;
        m_list.push_back(triangle);
        m_triangles.push_back({ n, { first[n] + t[0], first[n] + t[1], first[n] + t[2] } });
      }
    }
    m_tree.emplace(m_list.begin(), m_list.end());
  }

  const Triangle& nearest(const Point& p) const { return m_triangles[index(p)]; }
  Mix mix(const Triangle& t, const Point& p) const
  {
    const Kernel::Triangle_3& triangle = m_list[std::size_t(&t - m_triangles.data())];
    const auto weights = closest_weights(vector(p), { vector(triangle[0]), vector(triangle[1]), vector(triangle[2]) });
    Mix result;
    for(std::size_t i = 0; i < 3; ++i)
      if(weights[i] != 0) result.emplace_back(t.corners[i], weights[i]);
    return result;
  }

private:
  std::size_t index(const Point& p) const
  {
    return std::size_t(m_tree->closest_point_and_primitive(p).second - m_list.begin());
  }

  List m_list;
  std::vector<Triangle> m_triangles;
  std::optional<CGAL::AABB_tree<Traits> > m_tree;
};

} // namespace

Mesh_origins::Mesh_origins(const Model& model, const Mesh& mesh)
  : m_polygon(mesh.num_faces()), m_corner(mesh.num_halfedges())
{
  const std::vector<std::size_t> first = model.first_corners();
  // by position: polygons and their corners there, ascending
  std::map<Point, std::vector<std::pair<std::size_t, std::size_t> > > corners_at;
  for(std::size_t n = 0; n < model.soup.polygons.size(); ++n)
    for(std::size_t i = 0; i < model.soup.polygons[n].size(); ++i)
      corners_at[model.soup.points[model.soup.polygons[n][i]]].emplace_back(n, first[n] + i);

  std::optional<Triangles> triangles; // made if it is needed
  for(Mesh::Face_index f : mesh.faces()) {
    std::array<Mesh::Halfedge_index, 3> corner;
    corner[0] = mesh.halfedge(f);
    for(std::size_t i = 1; i < 3; ++i) corner[i] = mesh.next(corner[i - 1]);
    const auto find = [&](std::size_t i, std::size_t polygon) -> std::optional<std::size_t> {
      const auto here = corners_at.find(mesh.point(mesh.target(corner[i])));
      if(here == corners_at.end()) return std::nullopt;
      for(const auto& c : here->second)
        if(c.first == polygon) return c.second;
      return std::nullopt;
    };
    bool is_found = false;
    const auto here = corners_at.find(mesh.point(mesh.target(corner[0])));
    if(here != corners_at.end())
      for(const auto& c : here->second) {
        const auto second = find(1, c.first), third = find(2, c.first);
        if(!second || !third) continue;
        m_polygon[f] = c.first;
        m_corner[corner[0]] = { { c.second, 1. } };
        m_corner[corner[1]] = { { *second, 1. } };
        m_corner[corner[2]] = { { *third, 1. } };
        is_found = true;
        break;
      }
    if(is_found) continue;
    if(!triangles) triangles.emplace(model, first);
    const auto p = [&](std::size_t i) { return mesh.point(mesh.target(corner[i])); };
    const auto& nearest = triangles->nearest(CGAL::centroid(p(0), p(1), p(2)));
    m_polygon[f] = nearest.polygon;
    for(std::size_t i = 0; i < 3; ++i) m_corner[corner[i]] = triangles->mix(nearest, p(i));
  }
}

} // namespace Tool
