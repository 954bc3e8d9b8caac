#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

Mesh demo_mesh(const std::string& name)
{
  Mesh mesh;
  if(CGAL::Bspline_shells::read_polygon_mesh(std::string(MESHES) + "/" + name, mesh)
     != CGAL::Bspline_shells::Shell_status::SUCCESS)
    throw std::runtime_error(name + " cannot be read");
  return mesh;
}

Mesh subdivided(const Mesh& mesh)
{
  Mesh fine;
  std::vector<Mesh::Vertex_index> at_vertex, at_edge;
  for(auto v : mesh.vertices()) at_vertex.push_back(fine.add_vertex(mesh.point(v)));
  for(auto e : mesh.edges())
    at_edge.push_back(fine.add_vertex(CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)))));
  for(auto f : mesh.faces()) {
    Mesh::Vertex_index v[3], m[3];
    auto h = mesh.halfedge(f);
    for(int i = 0; i < 3; ++i, h = mesh.next(h)) {
      v[i] = at_vertex[mesh.source(h)];
      m[i] = at_edge[mesh.edge(h)];
    }
    fine.add_face(v[0], m[0], m[2]);
    fine.add_face(m[0], v[1], m[1]);
    fine.add_face(m[2], m[1], v[2]);
    fine.add_face(m[0], m[1], m[2]);
  }
  return fine;
}

Mesh sphere(int subdivisions, double radius, const Point_3& center)
{
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Point_3(0, 0, 0), 1.);
  for(int s = 0; s < subdivisions; ++s) mesh = subdivided(mesh);
  for(auto v : mesh.vertices()) {
    const Vector_3 d = mesh.point(v) - CGAL::ORIGIN;
    mesh.point(v) = center + radius / std::sqrt(d.squared_length()) * d;
  }
  return mesh;
}

Mesh sliced_sphere(int slices, int rings, int turns)
{
  Mesh mesh;
  const double pi = std::acos(-1.);
  const auto north = mesh.add_vertex(Point_3(0, 0, 1)), south = mesh.add_vertex(Point_3(0, 0, -1));
  std::vector<Mesh::Vertex_index> v;
  for(int i = 1; i < rings; ++i)
    for(int j = 0; j < slices; ++j) {
      const double a = pi * i / rings, b = 2 * pi * turns * j / slices;
      v.push_back(mesh.add_vertex(Point_3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a))));
    }
  const auto at = [&](int i, int j) { return v[(i - 1) * slices + j % slices]; };
  for(int j = 0; j < slices; ++j) {
    mesh.add_face(north, at(1, j), at(1, j + 1));
    mesh.add_face(south, at(rings - 1, j + 1), at(rings - 1, j));
    for(int i = 1; i + 1 < rings; ++i) {
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

Mesh box(const Point_3& a, const Point_3& b, bool triangulated)
{
  Mesh mesh;
  CGAL::make_hexahedron(a, Point_3(b.x(), a.y(), a.z()), Point_3(b.x(), b.y(), a.z()), Point_3(a.x(), b.y(), a.z()),
                        Point_3(a.x(), b.y(), b.z()), Point_3(a.x(), a.y(), b.z()), Point_3(b.x(), a.y(), b.z()), b,
                        mesh);
  if(triangulated) CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
  return mesh;
}

Mesh torus(double major, double minor, int around, int across)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  const double pi = std::acos(-1.);
  for(int i = 0; i < around; ++i)
    for(int j = 0; j < across; ++j) {
      const double a = 2 * pi * i / around, b = 2 * pi * j / across, r = major + minor * std::cos(b);
      v.push_back(mesh.add_vertex(Point_3(r * std::cos(a), r * std::sin(a), minor * std::sin(b))));
    }
  const auto at = [&](int i, int j) { return v[(i % around) * across + j % across]; };
  for(int i = 0; i < around; ++i)
    for(int j = 0; j < across; ++j) {
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return mesh;
}

Mesh pyramid(int sides, double height)
{
  Mesh mesh;
  const double pi = std::acos(-1.);
  const auto apex = mesh.add_vertex(Point_3(0, 0, height)), middle = mesh.add_vertex(Point_3(0, 0, 0));
  std::vector<Mesh::Vertex_index> v;
  for(int i = 0; i < sides; ++i)
    v.push_back(mesh.add_vertex(Point_3(std::cos(2 * pi * i / sides), std::sin(2 * pi * i / sides), 0)));
  for(int i = 0; i < sides; ++i) {
    mesh.add_face(v[i], v[(i + 1) % sides], apex);
    mesh.add_face(v[(i + 1) % sides], v[i], middle);
  }
  return mesh;
}

Mesh grooved_block(double angle, double depth)
{
  const double half = std::tan(angle * std::acos(-1.) / 360) * std::abs(depth);
  const std::vector<std::array<double, 2> > section = {
    { 0, 0 }, { 1, 0 }, { 1, 0.4 }, { 0.5 + half, 0.4 }, { 0.5, 0.4 - depth }, { 0.5 - half, 0.4 }, { 0, 0.4 }
  };
  typedef std::vector<std::array<unsigned, 3> > Triangles;
  const Triangles cap = depth > 0 ? Triangles{ { 0, 1, 4 }, { 1, 2, 3 }, { 1, 3, 4 }, { 0, 4, 5 }, { 0, 5, 6 } }
                                  : Triangles{ { 0, 1, 3 }, { 1, 2, 3 }, { 3, 4, 5 }, { 0, 3, 5 }, { 0, 5, 6 } };
  Mesh mesh;
  std::vector<Mesh::Vertex_index> front, back;
  for(const auto& p : section) front.push_back(mesh.add_vertex(Point_3(p[0], 0, p[1])));
  for(const auto& p : section) back.push_back(mesh.add_vertex(Point_3(p[0], 0.5, p[1])));
  for(std::size_t i = 0; i < section.size(); ++i) {
    const std::size_t j = (i + 1) % section.size();
    mesh.add_face(front[i], back[i], back[j]);
    mesh.add_face(front[i], back[j], front[j]);
  }
  for(const auto& t : cap) {
    mesh.add_face(front[t[0]], front[t[1]], front[t[2]]);
    mesh.add_face(back[t[0]], back[t[2]], back[t[1]]);
  }
  return mesh;
}

Mesh bipyramid(int corners, int step, double height)
{
  Mesh mesh;
  const double pi = std::acos(-1.);
  const auto north = mesh.add_vertex(Point_3(0, 0, height)), south = mesh.add_vertex(Point_3(0, 0, -height));
  std::vector<Mesh::Vertex_index> link;
  for(int n = 0; n < corners; ++n) {
    const double angle = 2 * pi * ((n * step) % corners) / corners;
    link.push_back(mesh.add_vertex(Point_3(std::cos(angle), std::sin(angle), 0)));
  }
  for(int n = 0; n < corners; ++n) {
    mesh.add_face(link[n], link[(n + 1) % corners], north);
    mesh.add_face(link[(n + 1) % corners], link[n], south);
  }
  return mesh;
}

Mesh cubes(const std::vector<std::array<int, 3> >& corners)
{
  Mesh mesh;
  std::map<std::array<int, 3>, Mesh::Vertex_index> vertex;
  const auto at = [&](const std::array<int, 3>& p) {
    const auto found = vertex.find(p);
    return found != vertex.end() ? found->second
                                 : vertex.emplace(p, mesh.add_vertex(Point_3(p[0], p[1], p[2]))).first->second;
  };
  for(const std::array<int, 3>& c : corners)
    for(int a = 0; a < 3; ++a)
      for(int side : { 0, 1 }) {
        std::array<int, 3> beyond = c;
        beyond[a] += 2 * side - 1;
        if(std::find(corners.begin(), corners.end(), beyond) != corners.end()) continue;
        std::array<std::array<int, 3>, 4> square; // counterclockwise as seen from the side of larger coordinates
        for(int i = 0; i < 4; ++i) {
          square[i] = c;
          square[i][a] += side;
          square[i][(a + 1) % 3] += i == 1 || i == 2 ? 1 : 0;
          square[i][(a + 2) % 3] += i >= 2 ? 1 : 0;
        }
        if(side == 0) std::swap(square[1], square[3]);
        mesh.add_face(at(square[0]), at(square[1]), at(square[2]));
        mesh.add_face(at(square[0]), at(square[2]), at(square[3]));
      }
  return mesh;
}

Mesh screw(int number_of_cubes)
{
  std::vector<std::array<int, 3> > corners = { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 1, 1, 2 } };
  corners.resize(std::size_t(number_of_cubes));
  return cubes(corners);
}

Mesh dumbbell(double neck_radius, int around)
{
  Mesh mesh;
  const double pi = std::acos(-1.), joint = std::asin(neck_radius); // angle at the center where the neck begins
  const int rings = 10;
  std::vector<std::pair<double, double> > profile; // x, radius; without the poles
  for(int i = 1; i <= rings; ++i) {
    const double a = pi - (pi - joint) * i / rings;
    profile.emplace_back(-1.5 + std::cos(a), std::sin(a));
  }
  const std::size_t half = profile.size();
  profile.emplace_back(0, neck_radius);
  for(std::size_t i = half; i-- > 0;) profile.emplace_back(-profile[i].first, profile[i].second);
  const auto left = mesh.add_vertex(Point_3(-2.5, 0, 0)), right = mesh.add_vertex(Point_3(2.5, 0, 0));
  std::vector<Mesh::Vertex_index> v;
  for(const auto& p : profile)
    for(int j = 0; j < around; ++j)
      v.push_back(mesh.add_vertex(
        Point_3(p.first, p.second * std::cos(2 * pi * j / around), p.second * std::sin(2 * pi * j / around))));
  const auto at = [&](std::size_t i, int j) { return v[i * around + j % around]; };
  const std::size_t last = profile.size() - 1;
  for(int j = 0; j < around; ++j) {
    mesh.add_face(left, at(0, j + 1), at(0, j));
    mesh.add_face(right, at(last, j), at(last, j + 1));
    for(std::size_t i = 0; i < last; ++i) {
      mesh.add_face(at(i, j), at(i, j + 1), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  return mesh;
}

bool is_equal(const Mesh& a, const Mesh& b)
{
  if(a.number_of_faces() != b.number_of_faces() || a.number_of_vertices() != b.number_of_vertices()) return false;
  for(auto f = a.faces().begin(), g = b.faces().begin(); f != a.faces().end(); ++f, ++g) {
    auto h = a.halfedge(*f), i = b.halfedge(*g);
    for(int n = 0; n < 3; ++n, h = a.next(h), i = b.next(i))
      if(a.point(a.target(h)) != b.point(b.target(i))) return false;
  }
  return true;
}

Mesh joined(Mesh a, const Mesh& b)
{
  CGAL::copy_face_graph(b, a);
  return a;
}

Mesh reversed(Mesh mesh)
{
  CGAL::Polygon_mesh_processing::reverse_face_orientations(mesh);
  return mesh;
}

Mesh mapped(Mesh mesh, const std::function<Point_3(const Point_3&)>& map)
{
  for(auto v : mesh.vertices()) mesh.point(v) = map(mesh.point(v));
  return mesh;
}

void remove_facets(Mesh& mesh, const std::function<bool(const Point_3&)>& is_removed)
{
  std::vector<Mesh::Face_index> removed;
  for(auto f : mesh.faces())
    if(is_removed(centroid(mesh, f))) removed.push_back(f);
  for(auto f : removed) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  mesh.collect_garbage();
}

std::array<Point_3, 3> corners(const Mesh& mesh, Mesh::Face_index f)
{
  const auto h = mesh.halfedge(f);
  return { mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))) };
}

Point_3 centroid(const Mesh& mesh, Mesh::Face_index f)
{
  const std::array<Point_3, 3> t = corners(mesh, f);
  return CGAL::centroid(t[0], t[1], t[2]);
}

std::vector<Point_3> link_of(const Mesh& mesh, Mesh::Vertex_index v)
{
  std::vector<Point_3> link;
  for(auto h : CGAL::halfedges_around_target(v, mesh)) link.push_back(mesh.point(mesh.source(h)));
  std::reverse(link.begin(), link.end());
  return link;
}

double distance(const Point_3& p, const Point_3& q)
{
  return std::sqrt(CGAL::squared_distance(p, q));
}

std::vector<double> steps(double first, double last, int number)
{
  std::vector<double> result;
  for(int n = 0; n <= number; ++n) result.push_back(first + (last - first) * n / number);
  return result;
}
