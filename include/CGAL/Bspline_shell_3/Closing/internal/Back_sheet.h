// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_BACK_SHEET_H
#define CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_BACK_SHEET_H

#include <CGAL/Bspline_shell_3/Closing/internal/Closing_mesh.h>
#include <CGAL/Bspline_shell_3/Shell/Closing_report.h>

#include <CGAL/Polygon_mesh_processing/connected_components.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A reversed copy of the open components of a mesh, placed behind them, with strips that connect it to their borders.
// The copy extends beyond the border by as much as it lies behind the mesh. Strips therefore have a slope of 45
// degrees, so that the facets at vertices of flat tips and slits face a common direction. Where the border is twisted,
// strips may have to be steeper.
//
// The copy of vertex n of the mesh is vertex n plus the number of vertices of the mesh.
class Back_sheet
{
  typedef Closing_mesh::Face_index Face_index;
  typedef Closing_mesh::Halfedge_index Halfedge_index;
  typedef Closing_mesh::Vertex_index Vertex_index;
  typedef Closing_kernel::Vector_3 Vector_3;
public:
  typedef std::array<std::size_t, 3> Triangle;

  Back_sheet(const Closing_mesh& mesh, double offset)
    : m_mesh(mesh), m_size(mesh.number_of_vertices()), m_offset(offset)
  {
    m_distance.assign(m_size, 0);
    m_back.assign(m_size, Vector_3(0, 0, 0));
    m_beyond = m_back;
    m_slope.assign(m_size, 1);
    const std::vector<char> is_open = find_open_facets();
    for(Halfedge_index h : mesh.halfedges())
      if(mesh.is_border(h) && !mesh.is_border(mesh.opposite(h))) {
        const std::size_t s = mesh.source(h), t = mesh.target(h);
        m_triangles.push_back({ s, t, m_size + t });
        m_triangles.push_back({ s, m_size + t, m_size + s });
      }
    for(Face_index f : mesh.faces())
      if(is_open[f]) {
        const Halfedge_index h = mesh.halfedge(f);
        const std::size_t u = mesh.source(h), v = mesh.target(h), w = mesh.target(mesh.next(h));
        m_triangles.push_back({ m_size + u, m_size + w, m_size + v });
      }
    if(m_triangles.empty()) return;
    const Ray_tree tree(mesh);
    for(Vertex_index v : mesh.vertices())
      if(!mesh.is_isolated(v) && is_open[any_facet(v)]) place(v, offset, tree);
    smooth();
  }

  const std::vector<Triangle>& triangles() const { return m_triangles; }
  Closing_kernel::Point_3 point(std::size_t n) const
  {
    if(n < m_size) return m_mesh.point(vertex(n));
    n -= m_size;
    return m_mesh.point(vertex(n)) + m_distance[n] * (m_back[n] + m_slope[n] * m_beyond[n]);
  }

  // Returns the vertex of which a vertex is the copy; otherwise, the vertex itself.
  std::size_t original(std::size_t n) const { return n % m_size; }
  // Returns the distance at a vertex or its copy.
  double distance(std::size_t n) const { return m_distance[original(n)]; }

  // Returns the copies whose angle with the reversed original facet has a cosine below `least_cosine`. There, the
  // distance is too large for the curvature of the mesh.
  std::vector<Triangle> folded_triangles() const
  {
    constexpr double least_cosine = 0.3;
    std::vector<Triangle> folded;
    const auto normal = [&](const Triangle& t, std::size_t offset) {
      const auto n = facet_normal(point(t[0] - offset), point(t[1] - offset), point(t[2] - offset)).direction;
      const Vector_3 v(n[0], n[1], n[2]);
      return v / length(v);
    };
    for(const Triangle& t : m_triangles)
      if((std::min)({ t[0], t[1], t[2] }) >= m_size && normal(t, 0) * normal(t, m_size) < least_cosine)
        folded.push_back(t);
    return folded;
  }

  // Makes the strip steeper at a border vertex or its copy. Returns false if the strip is upright or there is none.
  bool make_steeper(std::size_t n)
  {
    const std::size_t v = original(n);
    if(m_distance[v] == 0 || m_slope[v] == 0 || m_beyond[v] == Vector_3(0, 0, 0)) return false;
    m_slope[v] = (std::max)(m_slope[v] - 0.5, 0.);
    return true;
  }

  // Halves the distance of the vertices of some triangles. Returns false if none has a copy, or if a distance becomes
  // less than `least` times the offset.
  bool move_closer(const std::vector<Triangle>& triangles)
  {
    constexpr double least = 1. / 16384;
    std::vector<char> is_halved(m_size, 0);
    bool has_moved = false;
    for(const Triangle& t : triangles)
      for(std::size_t n : t) {
        const std::size_t v = original(n);
        if(m_distance[v] == 0 || is_halved[v]) continue;
        is_halved[v] = 1;
        m_distance[v] /= 2;
        has_moved = true;
        if(m_distance[v] < least * m_offset) return false;
      }
    smooth();
    return has_moved;
  }

  // Returns the smallest distance.
  double least_gap() const
  {
    double least = std::numeric_limits<double>::infinity();
    for(double d : m_distance)
      if(d > 0) least = (std::min)(least, d);
    return least;
  }

  void describe(Closing_report& report) const
  {
    report.sheets = m_sheets;
    if(m_sheets == 0) return;
    report.least_offset = least_gap();
    report.largest_offset = *std::max_element(m_distance.begin(), m_distance.end());
  }

private:
  static Vertex_index vertex(std::size_t n) { return Vertex_index(Closing_mesh::size_type(n)); }
  // Returns a facet at the vertex.
  Face_index any_facet(Vertex_index v) const
  {
    const Halfedge_index h = m_mesh.halfedge(v);
    return m_mesh.is_border(h) ? m_mesh.face(m_mesh.opposite(h)) : m_mesh.face(h);
  }

  // Returns, by facet, whether its component has a border.
  std::vector<char> find_open_facets()
  {
    std::vector<std::size_t> component(m_mesh.number_of_faces());
    const std::size_t number = Polygon_mesh_processing::connected_components(m_mesh,
                                                                             CGAL::make_property_map(component));
    std::vector<char> is_open(number, 0), result(m_mesh.number_of_faces());
    for(Halfedge_index h : m_mesh.halfedges())
      if(m_mesh.is_border(h) && !m_mesh.is_border(m_mesh.opposite(h)))
        is_open[component[m_mesh.face(m_mesh.opposite(h))]] = 1;
    for(Face_index f : m_mesh.faces()) result[f] = is_open[component[f]];
    m_sheets = std::size_t(std::count(is_open.begin(), is_open.end(), 1));
    return result;
  }

  // Places the copy of a vertex at the distance behind the planes of all its facets, and beyond all its border edges.
  void place(Vertex_index v, double offset, const Ray_tree& tree)
  {
    constexpr double least_margin = 0.3, least = 1. / 256, share_of_room = 0.4;
    const Vector_3 axis = cone_axis_at(m_mesh, v);
    const double margin = length(axis);
    const bool has_cone = margin > 1e-9;
    const Vector_3 back = has_cone ? -axis / (margin * (std::max)(margin, least_margin))
                                   : -unit_normal(m_mesh, any_facet(v));
    Vector_3 beyond(0, 0, 0);
    for(Halfedge_index h : m_mesh.halfedges_around_target(m_mesh.halfedge(v)))
      if(m_mesh.is_border(h))
        beyond = beyond + miter(outward_conormal(m_mesh, h), outward_conormal(m_mesh, m_mesh.next(h)));
    const double room = tree.distance(m_mesh.point(v), back, [&](Face_index f) {
      const auto around = m_mesh.vertices_around_face(m_mesh.halfedge(f));
      return std::find(around.begin(), around.end(), v) != around.end();
    });
    m_back[v] = back;
    m_beyond[v] = beyond;
    m_distance[v] = (std::max)((std::min)(offset, share_of_room * room / length(back)), least * offset);
  }

  // Returns the vector whose scalar products with two unit vectors are one, shortened to `longest` if necessary, or
  // zero if the unit vectors are almost opposite.
  static Vector_3 miter(const Vector_3& a, const Vector_3& b)
  {
    const Vector_3 sum = a + b;
    constexpr double longest = 2;
    const double size = length(sum);
    return size < 1e-6 ? Vector_3(0, 0, 0) : sum * (std::min)(2 / (size * size), longest / size);
  }

  // Limits the increase of the distance along an edge to half of the edge's length.
  void smooth()
  {
    typedef std::pair<double, std::size_t> Entry;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry> > queue;
    for(std::size_t n = 0; n < m_size; ++n)
      if(m_distance[n] > 0) queue.emplace(m_distance[n], n);
    while(!queue.empty()) {
      const Entry entry = queue.top();
      queue.pop();
      if(entry.first > m_distance[entry.second]) continue;
      const Vertex_index v = vertex(entry.second);
      for(Halfedge_index h : m_mesh.halfedges_around_target(m_mesh.halfedge(v))) {
        const Vertex_index w = m_mesh.source(h);
        const double most = entry.first + std::sqrt(CGAL::squared_distance(m_mesh.point(v), m_mesh.point(w))) / 2;
        if(m_distance[w] <= most) continue;
        m_distance[w] = most;
        queue.emplace(most, std::size_t(w));
      }
    }
  }

  const Closing_mesh& m_mesh;
  std::size_t m_size;
  std::vector<Triangle> m_triangles;
  std::vector<double> m_distance; // by vertex; 0 where there is no back sheet
  // Displacements of the copy for a distance of one, behind the facets and beyond the border.
  std::vector<Vector_3> m_back, m_beyond;
  std::vector<double> m_slope; // factors of `m_beyond`
  double m_offset;
  std::size_t m_sheets = 0;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_BACK_SHEET_H
