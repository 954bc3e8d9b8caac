// Meshes to be checked, and their elements by position.
#ifndef INPUT_MESHES_H
#define INPUT_MESHES_H

#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace input_meshes {

using CGAL::Bspline_shells::Input_mesh_3;
typedef CGAL::Bspline_shells::Shell_status Status;
typedef std::vector<std::size_t> Positions;

template <typename M>
Status check(Input_mesh_3& input, const M& mesh, const Input_mesh_3::Tolerated_defects& tolerated = {})
{
  return input.build<CGAL::Sequential_tag>(mesh, get(CGAL::vertex_point, mesh), tolerated);
}

template <typename Range, typename Descriptor>
std::size_t position(const Range& range, Descriptor d)
{
  const auto it = std::find(range.begin(), range.end(), d);
  REQUIRE(it != range.end());
  return std::size_t(std::distance(range.begin(), it));
}

// Returns the positions of a mesh's facets that satisfy a condition, in ascending order.
template <typename Condition>
Positions facets_where(const Mesh& mesh, const Condition& condition)
{
  Positions found;
  std::size_t n = 0;
  for(auto f : mesh.faces()) {
    if(condition(f)) found.push_back(n);
    ++n;
  }
  return found;
}

inline bool has_corner(const Mesh& mesh, Mesh::Face_index f, Mesh::Vertex_index v)
{
  for(auto w : mesh.vertices_around_face(mesh.halfedge(f)))
    if(w == v) return true;
  return false;
}

inline Mesh::Vertex_index vertex_at(const Mesh& mesh, const Point_3& p)
{
  for(auto v : mesh.vertices())
    if(mesh.point(v) == p) return v;
  FAIL("no vertex at this point");
  return Mesh::null_vertex();
}

inline Mesh both(Mesh a, const Mesh& b)
{
  CGAL::copy_face_graph(b, a);
  return a;
}

inline Mesh tetrahedron(const Point_3& p, const Point_3& q, const Point_3& r, const Point_3& s)
{
  Mesh mesh;
  CGAL::make_tetrahedron(p, q, r, s, mesh);
  if(CGAL::orientation(p, q, r, s) == CGAL::POSITIVE) CGAL::Polygon_mesh_processing::reverse_face_orientations(mesh);
  return mesh;
}

// Returns a copy of a mesh with gaps in its ranges: a tetrahedron is added first, and removed again. So descriptors
// differ from positions.
inline Mesh with_garbage(const Mesh& mesh)
{
  Mesh garbage = tetrahedron(Point_3(50, 0, 0), Point_3(51, 0, 0), Point_3(50, 1, 0), Point_3(50, 0, 1));
  const std::vector<Mesh::Vertex_index> doomed(garbage.vertices().begin(), garbage.vertices().end());
  CGAL::copy_face_graph(mesh, garbage);
  CGAL::Euler::remove_face(garbage.halfedge(*garbage.faces().begin()), garbage);
  while(!garbage.is_removed(doomed[0]) && garbage.degree(doomed[0]) > 0)
    CGAL::Euler::remove_face(garbage.is_border(garbage.halfedge(doomed[0]))
                               ? garbage.opposite(garbage.halfedge(doomed[0]))
                               : garbage.halfedge(doomed[0]),
                             garbage);
  for(auto f : std::vector<Mesh::Face_index>(garbage.faces().begin(), garbage.faces().begin() + 4))
    if(!garbage.is_removed(f) && garbage.point(garbage.target(garbage.halfedge(f))).x() >= 50)
      CGAL::Euler::remove_face(garbage.halfedge(f), garbage);
  REQUIRE(garbage.has_garbage());
  REQUIRE(garbage.number_of_faces() == mesh.number_of_faces());
  REQUIRE(garbage.number_of_vertices() == mesh.number_of_vertices());
  return garbage;
}

// Returns a pyramid over a simple polygon in the plane z = 0, given counterclockwise. The facets at the apex face a
// common direction if and only if the polygon's kernel (the points that see the whole polygon) has an interior.
inline Mesh pyramid(const std::vector<std::pair<double, double> >& base, const Point_3& apex)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for(const auto& p : base) v.push_back(mesh.add_vertex(Point_3(p.first, p.second, 0)));
  const Mesh::Vertex_index top = mesh.add_vertex(apex);
  for(std::size_t i = 0; i < v.size(); ++i) mesh.add_face(v[i], v[(i + 1) % v.size()], top);
  mesh.add_face(std::vector<Mesh::Vertex_index>(v.rbegin(), v.rend()));
  return mesh;
}

// Returns a pyramid over a U, where no point sees both arms.
inline Mesh pyramid_over_U()
{
  return pyramid({ { 0, 0 }, { 5, 0 }, { 5, 4 }, { 4, 4 }, { 4, 1 }, { 1, 1 }, { 1, 4 }, { 0, 4 } },
                 Point_3(2, 0.5, 3));
}

} // namespace input_meshes

#endif // INPUT_MESHES_H
