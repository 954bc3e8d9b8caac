// Writes meshes on which shells take long for their size, as OFF files, for certify_meshes.
//
//   hard_models FOLDER MESH...
//
//   NAME_300.off, NAME_1000.off   the closed mesh NAME with at most 300 or 1000 facets, by CGAL's edge collapse; only
//                                 if it does not intersect itself
//   NAME_tips_1.off, ...          the mesh with 1, 5, 20, or 50 singular vertices: each is moved across an edge
//   layers_3.off, ...             four nested bumpy balls with gaps of 3, 1, 0.5, or 0.3 percent of the box
//   cube_flat.off, prism_flat.off a cube and a prism over a star, with about 100,000 facets in large planes
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/OFF.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/subdivision_method_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace BS = CGAL::Bspline_shells;
namespace PMP = CGAL::Polygon_mesh_processing;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef Kernel::Point_3 Point;
typedef Kernel::Vector_3 Vector;

void write(Mesh mesh, const std::string& file)
{
  mesh.collect_garbage();
  std::ofstream out(file);
  out.precision(17);
  CGAL::IO::write_OFF(out, mesh);
  std::cout << file << ": " << mesh.number_of_faces() << " facets" << std::endl;
}

void write_low_poly(const Mesh& mesh, std::size_t facets, const std::string& file)
{
  if(mesh.number_of_faces() <= facets) return;
  namespace SMS = CGAL::Surface_mesh_simplification;
  Mesh coarse = mesh;
  // CGAL 5.5 has no predicate that counts facets.
  SMS::edge_collapse(coarse, SMS::Count_stop_predicate<Mesh>(facets * 3 / 2));
  coarse.collect_garbage();
  if(!PMP::does_self_intersect(coarse)) write(coarse, file);
}

// Moves a vertex across one of the edges opposite to it, such that it becomes singular, and its neighbors do not.
// Returns whether there is such an edge.
bool make_singular(Mesh& mesh, Mesh::Vertex_index v)
{
  constexpr double across = 0.3, lift = 0.3; // relative to the distance from the edge
  const Point before = mesh.point(v);
  std::set<Mesh::Face_index> nearby;
  for(auto w : mesh.vertices_around_target(mesh.halfedge(v)))
    for(auto f : mesh.faces_around_target(mesh.halfedge(w))) nearby.insert(f);
  Vector normal = CGAL::NULL_VECTOR;
  for(auto f : mesh.faces_around_target(mesh.halfedge(v))) normal += PMP::compute_face_normal(f, mesh);
  normal /= std::sqrt(normal.squared_length());
  for(auto h : mesh.halfedges_around_target(mesh.halfedge(v))) {
    const Point middle = CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(mesh.next(h))));
    const Vector out = middle - before;
    mesh.point(v) = middle + across * out + lift * std::sqrt(out.squared_length()) * normal;
    const auto margin = [&](Mesh::Vertex_index w) { return BS::vertex_cone_margin(mesh, w); };
    constexpr double regular = 0.1;
    constexpr double rounding = 1e-9; // largest error of a zero margin
    bool is_good = margin(v) < rounding;
    for(auto w : mesh.vertices_around_target(mesh.halfedge(v))) is_good = is_good && margin(w) > regular;
    if(is_good && !PMP::does_self_intersect(nearby, mesh)) return true;
  }
  mesh.point(v) = before;
  return false;
}

// Makes more and more vertices singular, and writes the mesh when there are 1, 5, 20, and 50.
void write_tips(const Mesh& mesh, const std::string& prefix)
{
  Mesh result = mesh;
  std::set<Mesh::Vertex_index> taken; // vertices near tips
  std::size_t made = 0;
  constexpr std::size_t stride = 7919, most = 50; // a prime, which scatters the tips over the mesh
  for(std::size_t n = 0; n < result.number_of_vertices() && made < most; ++n) {
    const Mesh::Vertex_index v(Mesh::size_type(n * stride % result.number_of_vertices()));
    std::vector<Mesh::Vertex_index> ring = { v };
    for(auto w : result.vertices_around_target(result.halfedge(v)))
      for(auto x : result.vertices_around_target(result.halfedge(w))) ring.push_back(x);
    if(std::any_of(ring.begin(), ring.end(), [&](auto w) { return taken.count(w) == 1; })) continue;
    if(!make_singular(result, v)) continue;
    taken.insert(ring.begin(), ring.end());
    ++made;
    for(std::size_t tips : { 1, 5, 20, 50 })
      if(made == tips) write(result, prefix + std::to_string(tips) + ".off");
  }
}

// A ball with bumps, with a radius from the given one to 1.2 times that.
void add_bumpy_ball(Mesh& mesh, double radius, bool is_reversed)
{
  Mesh ball;
  CGAL::make_icosahedron(ball, Point(CGAL::ORIGIN), 1.);
  CGAL::Subdivision_method_3::Loop_subdivision(ball, CGAL::parameters::number_of_iterations(4));
  for(auto v : ball.vertices()) {
    const Vector p = ball.point(v) - CGAL::ORIGIN, n = p / std::sqrt(p.squared_length());
    const double bump = 1.1 + 0.1 * std::sin(5 * n.x()) * std::sin(5 * n.y() + 1) * std::sin(4 * n.z() + 2);
    ball.point(v) = CGAL::ORIGIN + radius * bump * n;
  }
  if(is_reversed) PMP::reverse_face_orientations(ball);
  CGAL::copy_face_graph(ball, mesh);
}

void write_layers(double percent, const std::string& file)
{
  const double gap = percent / 100 * 2.4; // of the box of the outermost ball
  Mesh mesh;
  for(int n = 0; n < 4; ++n) add_bumpy_ball(mesh, 1 - n * gap / 1.1, n % 2 == 1);
  write(mesh, file);
}

// A prism over a polygon that is star-shaped around the origin, whose sides and bases are grids of n cells.
void write_prism(const std::vector<std::array<double, 2> >& polygon, std::size_t n, const std::string& file)
{
  Mesh mesh;
  const std::size_t around = polygon.size() * n;
  const auto rim = [&](std::size_t i) { // a point of the polygon
    const std::size_t side = i % around / n;
    const double t = double(i % n) / double(n);
    const auto &p = polygon[side], &q = polygon[(side + 1) % polygon.size()];
    return std::array<double, 2>{ (1 - t) * p[0] + t * q[0], (1 - t) * p[1] + t * q[1] };
  };
  const auto ring = [&](double scale, double z) {
    std::vector<Mesh::Vertex_index> vertices;
    for(std::size_t i = 0; i < around; ++i)
      vertices.push_back(mesh.add_vertex(Point(scale * rim(i)[0], scale * rim(i)[1], z)));
    return vertices;
  };
  const auto join = [&](const std::vector<Mesh::Vertex_index>& low, const std::vector<Mesh::Vertex_index>& high) {
    for(std::size_t i = 0; i < around; ++i) {
      const std::size_t j = (i + 1) % around;
      mesh.add_face(low[i], low[j], high[j]);
      mesh.add_face(low[i], high[j], high[i]);
    }
  };
  std::vector<Mesh::Vertex_index> last;
  const auto add = [&](double scale, double z) {
    const auto next = ring(scale, z);
    if(!last.empty()) join(last, next);
    last = next;
    return next;
  };
  const auto first = add(1 / double(n), 0);
  for(std::size_t k = 2; k <= n; ++k) add(double(k) / double(n), 0);
  for(std::size_t k = 1; k <= n; ++k) add(1, double(k) / double(n));
  for(std::size_t k = n - 1; k >= 1; --k) add(double(k) / double(n), 1);
  const auto bottom = mesh.add_vertex(Point(0, 0, 0)), top = mesh.add_vertex(Point(0, 0, 1));
  for(std::size_t i = 0; i < around; ++i) {
    mesh.add_face(bottom, first[(i + 1) % around], first[i]);
    mesh.add_face(top, last[i], last[(i + 1) % around]);
  }
  write(mesh, file);
}

int main(int argc, char** argv)
{
  if(argc < 2) {
    std::cerr << "usage: hard_models FOLDER MESH..." << std::endl;
    return 1;
  }
  const std::string folder = std::string(argv[1]) + "/";
  for(int n = 2; n < argc; ++n) {
    const std::string file = argv[n], base = file.substr(file.find_last_of('/') + 1),
                      name = folder + base.substr(0, base.find_last_of('.'));
    Mesh mesh;
    if(BS::read_triangle_mesh(file, mesh) != BS::Shell_status::SUCCESS || !CGAL::is_closed(mesh)) continue;
    for(std::size_t facets : { 300, 1000 }) write_low_poly(mesh, facets, name + "_" + std::to_string(facets) + ".off");
    write_tips(mesh, name + "_tips_");
  }
  for(const auto& [percent, text] :
      { std::pair(3., "3"), std::pair(1., "1"), std::pair(0.5, "0.5"), std::pair(0.3, "0.3") })
    write_layers(percent, folder + "layers_" + text + ".off");
  const std::vector<std::array<double, 2> > square = { { -0.5, -0.5 }, { 0.5, -0.5 }, { 0.5, 0.5 }, { -0.5, 0.5 } };
  write_prism(square, 64, folder + "cube_flat.off");
  std::vector<std::array<double, 2> > star;
  constexpr int points = 5;
  for(int i = 0; i < 2 * points; ++i) {
    const double angle = 3.14159265358979 * i / points, radius = i % 2 == 0 ? 1 : 0.5;
    star.push_back({ radius * std::cos(angle), radius * std::sin(angle) });
  }
  write_prism(star, 40, folder + "prism_flat.off");
}
