// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Mesh/fan_winding.h>
#include <CGAL/Bspline_shell_3/Mesh/intersecting_facets.h>
#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

template <typename ConcurrencyTag>
Shell_status Input_mesh_3::check(const Tolerated_defects& tolerated, const Closer& closer, const Truncator& truncator)
{
  const bool is_closed = CGAL::is_closed(m_mesh);
  Shell_status status = is_closed || closer ? Shell_status::SUCCESS : check_border();
  if(status == Shell_status::SUCCESS) status = check_fans();
  if(status == Shell_status::SUCCESS) status = triangulate<ConcurrencyTag>();
  if(status == Shell_status::SUCCESS && !is_closed) status = close<ConcurrencyTag>(closer);
  if(status == Shell_status::SUCCESS && !tolerated.self_intersections) status = check_intersections<ConcurrencyTag>();
  if(status == Shell_status::SUCCESS && truncator) status = truncate<ConcurrencyTag>(truncator, tolerated);
  if(status == Shell_status::SUCCESS) find_components();
  if(status == Shell_status::SUCCESS && !tolerated.orientation)
    status = tolerated.self_intersections ? check_volume() : check_orientation<ConcurrencyTag>();
  if(status == Shell_status::SUCCESS && !tolerated.singular_vertices) status = check_vertices<ConcurrencyTag>();
  std::vector<char>().swap(m_is_embedded);
  return status;
}

CGAL_BSPLINE_SHELL_3_INLINE std::vector<std::size_t> Input_mesh_3::facets_at_border() const
{
  std::vector<std::size_t> facets;
  for(auto h : m_mesh.halfedges())
    if(m_mesh.is_border(h) && !m_mesh.is_border(m_mesh.opposite(h)))
      facets.push_back(m_origin[m_mesh.face(m_mesh.opposite(h))]);
  return facets;
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::check_border()
{
  std::vector<std::size_t> open = facets_at_border();
  return open.empty() ? Shell_status::SUCCESS : refuse_facets(Shell_status::OPEN_MESH, open);
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::check_fans()
{
  std::vector<Triangle_mesh::Halfedge_index> pinched;
  Polygon_mesh_processing::non_manifold_vertices(m_mesh, std::back_inserter(pinched));
  std::vector<std::size_t> vertices; // one halfedge per fan
  for(auto h : pinched) vertices.push_back(m_vertex_origin[m_mesh.target(h)]);
  return vertices.empty() ? Shell_status::SUCCESS : refuse_vertices(Shell_status::NON_MANIFOLD, vertices);
}

// \pre all facets are triangles with positive area, and each vertex has one fan
template <typename ConcurrencyTag>
Shell_status Input_mesh_3::close(const Closer& closer)
{
  // The numbers must suffice for a closing with as many facets as the mesh, and two per border edge.
  const std::size_t vertices = m_mesh.number_of_vertices(), edges = m_mesh.number_of_edges();
  if(!internal::Mesh_size{ 2 * vertices, 4 * edges }.has_numbers()) return Shell_status::TOO_MANY_FACETS;
  std::vector<std::size_t> at_border = facets_at_border();
  const Closed closed = closer(m_mesh);
  if(closed.status != Shell_status::SUCCESS) {
    std::vector<std::size_t> facets;
    for(Face_index f : closed.offending_facets) facets.push_back(m_origin[f]);
    return refuse_facets(closed.status, facets);
  }
  if(!closed.closing->match_border(m_mesh, m_mesh.points())) return refuse_facets(Shell_status::OPEN_MESH, at_border);
  const auto attached = closed.closing->attach(m_mesh, m_mesh.points());
  if(!attached) return refuse_facets(Shell_status::NOT_CLOSABLE, at_border);
  m_closing = closed.closing;
  m_origin.resize(m_mesh.number_of_faces());
  for(Face_index f : attached->faces) m_origin[f] = m_number_of_facets++;
  m_vertex_origin.resize(m_mesh.number_of_vertices());
  for(auto v : attached->vertices) {
    m_vertex_origin[v] = m_number_of_vertices++;
    m_bbox += m_mesh.point(v).bbox();
  }
  return is_surface<ConcurrencyTag>() ? Shell_status::SUCCESS : refuse_facets(Shell_status::NOT_CLOSABLE, at_border);
}

// Returns whether the mesh satisfies the requirements of all later steps: it is a closed surface of triangles with
// positive area, and its coordinates are in range. Every change of the mesh ends with this check.
template <typename ConcurrencyTag>
bool Input_mesh_3::is_surface()
{
  const bool is = check_range() == Shell_status::SUCCESS && CGAL::is_closed(m_mesh) && CGAL::is_triangle_mesh(m_mesh)
                  && check_fans() == Shell_status::SUCCESS && check_areas<ConcurrencyTag>() == Shell_status::SUCCESS;
  m_offenders = Offending_simplices();
  return is;
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::check_range() const
{
  // Squares of cross products, and determinants, must be far from overflow and underflow.
  constexpr double largest = 1e60, smallest = 1e-60;
  for(int a = 0; a < 3; ++a)
    if((std::max)(std::abs((m_bbox.min)(a)), std::abs((m_bbox.max)(a))) > largest)
      return Shell_status::COORDINATES_OUT_OF_RANGE;
  // If the box is a point, all facets are degenerate: their status is more specific.
  return unit() > 0 && unit() < smallest ? Shell_status::COORDINATES_OUT_OF_RANGE : Shell_status::SUCCESS;
}

// Certificates prove that the truncated mesh has no self-intersections, which does not cover the tips cut off. If
// self-intersections are tolerated, the mesh is therefore tested before it is truncated.
// \pre all facets are triangles
template <typename ConcurrencyTag>
Shell_status Input_mesh_3::truncate(const Truncator& truncator, const Tolerated_defects& tolerated)
{
  std::shared_ptr<const Shell_truncation_3> truncation = truncator(*this);
  if(!truncation || !truncation->is_valid()) return Shell_status::SUCCESS;
  const auto in_mesh = truncation->match(m_mesh, m_mesh.points());
  if(std::all_of(in_mesh.begin(), in_mesh.end(), [](auto h) { return h == Triangle_mesh::null_halfedge(); }))
    return Shell_status::SUCCESS;
  if(tolerated.self_intersections) {
    const Shell_status status = check_intersections<ConcurrencyTag>();
    if(status != Shell_status::SUCCESS) return status;
  }
  // Facets of origin of the cut facets, and the vertices to be cut off.
  std::vector<std::size_t> origin_of_cut(in_mesh.size(), 0), centers;
  for(std::size_t n = 0; n < in_mesh.size(); ++n)
    if(in_mesh[n] != Triangle_mesh::null_halfedge()) origin_of_cut[n] = m_origin[m_mesh.face(in_mesh[n])];
  for(const Shell_truncation_3::Disc& d : truncation->discs()) {
    auto h = in_mesh[d.facets.front()];
    if(h == Triangle_mesh::null_halfedge()) continue;
    const Shell_truncation_3::Triangle& t = truncation->cut_facets()[d.facets.front()];
    for(int i = 0; t[i] != d.center; ++i) h = m_mesh.next(h);
    centers.push_back(m_vertex_origin[m_mesh.source(h)]);
  }
  // Maps to and from an open mesh find its own facets only.
  const auto is_of_closing = [&](std::size_t facet) { return part_of_facet(facet) == Surface_part::CLOSING; };
  if(std::any_of(origin_of_cut.begin(), origin_of_cut.end(), is_of_closing))
    return refuse_vertices(Shell_status::NOT_TRUNCATABLE, centers);
  // Origins are stored in property maps, which follow the elements through the truncation.
  auto origin = m_mesh.add_property_map<Face_index, std::size_t>("f:origin").first;
  auto vertex_origin = m_mesh.add_property_map<Triangle_mesh::Vertex_index, std::size_t>("v:origin").first;
  for(Face_index f : m_mesh.faces()) origin[f] = m_origin[f];
  for(auto v : m_mesh.vertices()) vertex_origin[v] = m_vertex_origin[v];
  const auto truncated = truncation->apply(m_mesh, m_mesh.points());
  if(!truncated) return refuse_vertices(Shell_status::NOT_TRUNCATABLE, centers);
  for(std::size_t n = 0; n < truncated->facets.size(); ++n) {
    const Face_index f = truncated->facets[n];
    if(f == Triangle_mesh::null_face()) continue; // the mesh does not have its patch
    const bool is_core = truncation->disc_of_new_facet(n) == Shell_truncation_3::npos;
    origin[f] = is_core ? origin_of_cut[truncation->cores()[n].facet] : m_number_of_facets++;
  }
  for(std::size_t n = truncation->number_of_corners(); n < truncated->vertices.size(); ++n)
    if(truncated->vertices[n] != Triangle_mesh::null_vertex()) {
      vertex_origin[truncated->vertices[n]] = m_number_of_vertices++;
      m_bbox += m_mesh.point(truncated->vertices[n]).bbox();
    }
  m_mesh.collect_garbage();
  m_origin.resize(m_mesh.number_of_faces());
  m_vertex_origin.resize(m_mesh.number_of_vertices());
  for(Face_index f : m_mesh.faces()) m_origin[f] = origin[f];
  for(auto v : m_mesh.vertices()) m_vertex_origin[v] = vertex_origin[v];
  m_mesh.remove_property_map(origin);
  m_mesh.remove_property_map(vertex_origin);
  m_truncation = std::move(truncation);
  m_is_embedded.clear(); // describes the mesh before truncation
  return is_surface<ConcurrencyTag>() ? Shell_status::SUCCESS : refuse_vertices(Shell_status::NOT_TRUNCATABLE, centers);
}

template <typename ConcurrencyTag>
Shell_status Input_mesh_3::triangulate()
{
  std::vector<std::size_t> degenerate;
  if(!CGAL::is_triangle_mesh(m_mesh)) {
    const std::vector<Face_index> polygons(m_mesh.faces().begin(), m_mesh.faces().end());
    for(Face_index f : polygons)
      if(!CGAL::is_triangle(m_mesh.halfedge(f), m_mesh) && !triangulate(f)) degenerate.push_back(m_origin[f]);
    if(!degenerate.empty()) return refuse_facets(Shell_status::DEGENERATE_FACET, degenerate);
  }
  return check_areas<ConcurrencyTag>();
}

template <typename ConcurrencyTag>
Shell_status Input_mesh_3::check_areas()
{
  constexpr std::size_t chunk = 4096;
  std::vector<std::size_t> degenerate = internal::collect_from_chunks<ConcurrencyTag, std::size_t>(
    m_mesh.number_of_faces(), chunk, [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found) {
      for(std::size_t n = begin; n < end; ++n)
        if(Polygon_mesh_processing::is_degenerate_triangle_face(Face_index(static_cast<unsigned int>(n)), m_mesh))
          found.push_back(m_origin[n]);
    });
  if(!degenerate.empty()) return refuse_facets(Shell_status::DEGENERATE_FACET, degenerate);
  return Shell_status::SUCCESS;
}

// Returns false for a polygon of two edges.
CGAL_BSPLINE_SHELL_3_INLINE bool Input_mesh_3::triangulate(Face_index f)
{
  std::vector<Triangle_mesh::Halfedge_index> halfedges; // each leads to a vertex of the polygon
  std::vector<Kernel::Point_3> points;
  for(auto h : m_mesh.halfedges_around_face(m_mesh.halfedge(f))) {
    halfedges.push_back(h);
    points.push_back(m_mesh.point(m_mesh.target(h)));
  }
  if(points.size() < 3) return false;
  std::vector<std::array<std::size_t, 3> > triangles = triangulate_polygon(points);
  triangles.pop_back(); // the remaining facet
  for(const auto& t : triangles) {
    const Triangle_mesh::Halfedge_index across = CGAL::Euler::split_face(halfedges[t[0]], halfedges[t[2]], m_mesh);
    halfedges[t[2]] = across;
    const Face_index cut_off = m_mesh.face(m_mesh.opposite(across));
    if(m_origin.size() <= std::size_t(cut_off)) m_origin.resize(std::size_t(cut_off) + 1);
    m_origin[cut_off] = m_origin[f];
  }
  return true;
}

template <typename ConcurrencyTag>
Shell_status Input_mesh_3::check_intersections()
{
  m_is_embedded = embedded_fans<ConcurrencyTag>(m_mesh);
  std::vector<std::size_t> facets, with_closing;
  // Overlapping meshes may have a quadratic number of pairs; `max_pairs` of them suffice.
  for(const auto& pair : internal::intersecting_facets<ConcurrencyTag>(m_mesh, m_is_embedded, max_pairs)) {
    const std::size_t f = m_origin[pair.first], g = m_origin[pair.second];
    auto& found = f < m_user_facets && g < m_user_facets ? facets : with_closing;
    found.push_back(f);
    found.push_back(g);
  }
  if(!facets.empty()) return refuse_facets(Shell_status::SELF_INTERSECTION, facets);
  return with_closing.empty() ? Shell_status::SUCCESS : refuse_facets(Shell_status::NOT_CLOSABLE, with_closing);
}

// All components must be oriented as the boundary of one volume, or all in the opposite way. For each component, a
// point is chosen close to one of its facets, in front of it. The facets crossed on a segment from there to the outside
// determine the components that contain the point.
// \pre components do not intersect
template <typename ConcurrencyTag>
Shell_status Input_mesh_3::check_orientation()
{
  const Crossing_counter_3 counter(m_mesh);
  std::vector<char> is_known(m_components, 0), is_outward(m_components, 0);
  std::vector<std::size_t> nesting(m_components, 0);
  for(Face_index f : m_mesh.faces()) {
    const std::size_t c = m_component[f];
    if(is_known[c]) continue;
    internal::Run::poll();
    const std::optional<std::vector<std::size_t> > around = components_around_front<ConcurrencyTag>(f, counter);
    if(!around) continue;
    is_known[c] = 1;
    is_outward[c] = std::find(around->begin(), around->end(), c) == around->end();
    nesting[c] = around->size() - (is_outward[c] ? 0 : 1);
  }
  // First facet of each component; first facets of the components with the wrong orientation.
  std::vector<std::size_t> first(m_components, m_number_of_facets), facets;
  for(Face_index f : m_mesh.faces()) first[m_component[f]] = (std::min)(first[m_component[f]], m_origin[f]);
  for(std::size_t c = 0; c < m_components; ++c)
    if(!is_known[c]) facets.push_back(first[c]);
  if(!facets.empty()) return refuse_facets(Shell_status::DEGENERATE_FACET, facets);
  const auto faces_out = [&](std::size_t c) { return bool(is_outward[c]) == (nesting[c] % 2 == 0); };
  m_outwards = faces_out(m_component[*m_mesh.faces().begin()]);
  for(std::size_t c = 0; c < m_components; ++c)
    if(faces_out(c) != m_outwards) facets.push_back(first[c]);
  return facets.empty() ? Shell_status::SUCCESS : refuse_facets(Shell_status::INCONSISTENT_ORIENTATION, facets);
}

// Returns the components that contain a point in front of the facet, with no other facet between. Returns nothing if
// rounding leaves no such point near the middle of the facet.
template <typename ConcurrencyTag>
std::optional<std::vector<std::size_t> > Input_mesh_3::components_around_front(Face_index f,
                                                                               const Crossing_counter_3& counter) const
{
  const auto t = triangle(f);
  const std::array<double, 3> n = facet_normal(t[0], t[1], t[2]).direction;
  const Kernel::Vector_3 normal(n[0], n[1], n[2]); // its largest component is near one
  const Kernel::Point_3 middle = CGAL::centroid(t[0], t[1], t[2]);
  const double size = std::sqrt(
    (std::max)({ (t[1] - t[0]).squared_length(), (t[2] - t[1]).squared_length(), (t[0] - t[2]).squared_length() }));
  for(int halvings = 4;; halvings *= 2) {
    const double step = std::ldexp(size, -halvings);
    const Kernel::Point_3 front = middle + step * normal;
    if(front == middle) return std::nullopt;
    const auto through = counter.crossings<ConcurrencyTag>(middle - step * normal, front);
    if(!through || through->size() != 1 || (*through)[0] != std::make_pair(f, 1)) continue;
    // Tries directions until one touches no edge; the directions are generic.
    const double reach = 8 * unit();
    for(const Kernel::Vector_3& way :
        { Kernel::Vector_3(0.531, 0.677, 0.509), Kernel::Vector_3(-0.732, 0.417, 0.539),
          Kernel::Vector_3(0.389, -0.811, 0.437), Kernel::Vector_3(0.467, 0.353, -0.811) }) {
      const auto out = counter.crossings<ConcurrencyTag>(front, front + reach * way);
      if(!out) continue;
      std::vector<std::size_t> crossed, around;
      for(const auto& crossing : *out) crossed.push_back(m_component[crossing.first]);
      std::sort(crossed.begin(), crossed.end());
      for(auto first = crossed.begin(), next = first; first != crossed.end(); first = next) {
        next = std::upper_bound(first, crossed.end(), *first);
        if((next - first) % 2 == 1) around.push_back(*first);
      }
      return around;
    }
  }
}

CGAL_BSPLINE_SHELL_3_INLINE void Input_mesh_3::find_components()
{
  // One triangle per facet of origin, in the order in which components are numbered.
  std::vector<Face_index> triangle(m_number_of_facets);
  for(Face_index f : m_mesh.faces()) triangle[m_origin[f]] = f;
  constexpr std::size_t unknown = std::size_t(-1);
  m_component.assign(m_mesh.number_of_faces(), unknown);
  m_components = 0;
  std::vector<Face_index> stack;
  for(Face_index first : triangle) {
    // Facets may have been cut off entirely.
    if(first == Triangle_mesh::null_face() || m_component[first] != unknown) continue;
    m_component[first] = m_components;
    stack.push_back(first);
    while(!stack.empty()) {
      const Face_index f = stack.back();
      stack.pop_back();
      for(auto h : m_mesh.halfedges_around_face(m_mesh.halfedge(f))) {
        const Face_index g = m_mesh.face(m_mesh.opposite(h));
        if(g == Triangle_mesh::null_face() || m_component[g] != unknown) continue;
        m_component[g] = m_components;
        stack.push_back(g);
      }
    }
    ++m_components;
  }
}

// Intersecting components have no nesting. The sign of the volume decides, if it exceeds the rounding error.
CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::check_volume()
{
  const Kernel::Point_3 o((m_bbox.xmin() + m_bbox.xmax()) / 2, (m_bbox.ymin() + m_bbox.ymax()) / 2,
                          (m_bbox.zmin() + m_bbox.zmax()) / 2);
  double volume = 0, products = 0;
  for(auto f : m_mesh.faces()) {
    const auto t = triangle(f);
    const Kernel::Vector_3 u = t[0] - o, v = t[1] - o, w = t[2] - o;
    volume += CGAL::determinant(u, v, w);
    const auto size = [](const Kernel::Vector_3& x) { return std::abs(x.x()) + std::abs(x.y()) + std::abs(x.z()); };
    products += size(u) * size(v) * size(w);
  }
  // Three roundings of differences and three of products in each term, and one for each sum.
  const double error = std::numeric_limits<double>::epsilon() * (8. + double(m_mesh.number_of_faces())) * products;
  if(!(std::abs(volume) > error)) {
    std::vector<std::size_t> first = { 0 };
    return refuse_facets(Shell_status::INCONSISTENT_ORIENTATION, first);
  }
  m_outwards = volume > 0;
  return Shell_status::SUCCESS;
}

template <typename ConcurrencyTag>
Shell_status Input_mesh_3::check_vertices()
{
  constexpr std::size_t chunk = 1024;
  std::vector<std::size_t> singular = internal::collect_from_chunks<ConcurrencyTag, std::size_t>(
    m_mesh.number_of_vertices(), chunk, [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found) {
      for(std::size_t n = begin; n < end; ++n) {
        const Triangle_mesh::Vertex_index v(static_cast<unsigned int>(n));
        const bool is_regular = (!m_is_embedded.empty() && m_is_embedded[n]) || m_mesh.is_isolated(v)
                                || vertex_cone(m_mesh, v);
        if(!is_regular) found.push_back(m_vertex_origin[n]);
      }
    });
  return singular.empty() ? Shell_status::SUCCESS : refuse_vertices(Shell_status::SINGULAR_VERTEX, singular);
}

// Only facets of the user's mesh are listed. If there are none, the closing or the truncation causes the failure.
CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::refuse_facets(Shell_status status,
                                                                     std::vector<std::size_t>& facets)
{
  sort_unique(facets);
  if(!facets.empty() && facets.front() >= m_user_facets)
    status = part_of_facet(facets.front()) == Surface_part::CLOSING ? Shell_status::NOT_CLOSABLE
                                                                    : Shell_status::NOT_TRUNCATABLE;
  facets.erase(std::lower_bound(facets.begin(), facets.end(), m_user_facets), facets.end());
  m_offenders.facets.swap(facets);
  return status;
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::refuse_vertices(Shell_status status,
                                                                       std::vector<std::size_t>& vertices)
{
  sort_unique(vertices);
  if(!vertices.empty() && vertices.front() >= m_user_vertices) {
    const std::size_t added = m_closing ? m_closing->points().size() - m_closing->number_of_border_points() : 0;
    status = vertices.front() - m_user_vertices < added ? Shell_status::NOT_CLOSABLE : Shell_status::NOT_TRUNCATABLE;
  }
  vertices.erase(std::lower_bound(vertices.begin(), vertices.end(), m_user_vertices), vertices.end());
  m_offenders.vertices.swap(vertices);
  return status;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_IMPL_H
