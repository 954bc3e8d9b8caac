// Mesh_with_origins.h: meshes are copied with rounded coordinates; elements of the copy refer to those of the user's
// mesh.
#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include "input_meshes.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cstddef>
#include <limits>
#include <unordered_map>
#include <vector>

namespace test_Mesh_with_origins {

using namespace input_meshes;

TEST_CASE("EMPTY_MESH is returned for a mesh without facets, even if it has points or removed facets")
{
  Input_mesh_3 input;
  CHECK(check(input, Mesh()) == Status::EMPTY_MESH);
  Mesh points;
  points.add_vertex(Point_3(0, 0, 0));
  CHECK(check(input, points) == Status::EMPTY_MESH);
  Mesh removed;
  const auto p = removed.add_vertex(Point_3(0, 0, 0)), q = removed.add_vertex(Point_3(1, 0, 0)),
             r = removed.add_vertex(Point_3(0, 1, 0));
  const auto f = removed.add_face(p, q, r);
  CGAL::Euler::remove_face(removed.halfedge(f), removed);
  CHECK(check(input, removed) == Status::EMPTY_MESH);
  CHECK(input.mesh().number_of_faces() == 0);
}

TEST_CASE("NOT_FINITE: the vertices with NaN or infinite coordinates are reported")
{
  typedef CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> Plain_mesh;
  Plain_mesh mesh;
  CGAL::copy_face_graph(sphere(1), mesh);
  const std::vector<Plain_mesh::Vertex_index> v(mesh.vertices().begin(), mesh.vertices().end());
  Input_mesh_3 input;
  REQUIRE(check(input, mesh) == Status::SUCCESS);
  typedef CGAL::Simple_cartesian<double>::Point_3 Plain_point;
  mesh.point(v[7]) = Plain_point(0, std::numeric_limits<double>::quiet_NaN(), 0);
  mesh.point(v[30]) = Plain_point(0, 0, std::numeric_limits<double>::infinity());
  mesh.point(v[11]) = Plain_point(-std::numeric_limits<double>::infinity(), 0, 0);
  REQUIRE(check(input, mesh) == Status::NOT_FINITE);
  CHECK(input.offending_simplices().vertices == Positions{ 7, 11, 30 });
  CHECK(input.offending_simplices().facets.empty());
}

TEST_CASE(
  "Input mesh: facets and vertices have their origin's points, despite removals, isolated vertices and reordering")
{
  const Mesh plain = both(box(Point_3(0, 0, 0), Point_3(1, 2, 3)), sphere(1, 1, Point_3(5, 5, 5)));
  Mesh isolated = box(Point_3(0, 0, 0), Point_3(1, 2, 3));
  isolated.add_vertex(Point_3(50, 0, 0));
  isolated = both(isolated, sphere(1, 1, Point_3(5, 5, 5)));
  Mesh reordered;
  reordered.add_vertex(Point_3(50, 0, 0));
  CGAL::copy_face_graph(plain, reordered);
  reordered.remove_vertex(Mesh::Vertex_index(0));
  reordered.collect_garbage();
  for(const Mesh& mesh : { plain, with_garbage(plain), isolated, reordered }) {
    Input_mesh_3 input;
    REQUIRE(check(input, mesh) == Status::SUCCESS);
    REQUIRE(input.mesh().number_of_faces() == mesh.number_of_faces());
    const std::vector<Mesh::Face_index> faces(mesh.faces().begin(), mesh.faces().end());
    const std::vector<Mesh::Vertex_index> vertices(mesh.vertices().begin(), mesh.vertices().end());
    for(auto f : input.mesh().faces()) {
      auto h = mesh.halfedge(faces[input.facet_of_origin(f)]);
      const auto t = input.triangle(f);
      // The facet may begin at another corner.
      for(int turns = 0; turns < 2 && mesh.point(mesh.source(h)) != t[0]; ++turns) h = mesh.next(h);
      CHECK(t
            == std::array<Point_3, 3>{ mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                       mesh.point(mesh.target(mesh.next(h))) });
    }
    for(auto v : input.mesh().vertices())
      if(!input.mesh().is_isolated(v)) CHECK(input.mesh().point(v) == mesh.point(vertices[input.vertex_of_origin(v)]));
    CHECK(input.bbox() == CGAL::Bbox_3(0, 0, 0, 6, 6, 6));
  }
}

TEST_CASE("Input mesh: property maps of the user's mesh are unchanged, whatever their names")
{
  Mesh mesh = both(sphere(1), sphere(1, 1, Point_3(5, 5, 5)));
  auto component = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:component", 7).first;
  Input_mesh_3 input;
  REQUIRE(check(input, mesh) == Status::SUCCESS);
  CHECK(input.number_of_components() == 2);
  CHECK(std::all_of(mesh.faces().begin(), mesh.faces().end(), [&](auto f) { return component[f] == 7; }));
  CHECK_FALSE(
    CGAL::Bspline_shells::internal::find_property_map<Mesh::Face_index, std::size_t>(input.mesh(), "f:component"));
}

TEST_CASE("Input mesh: lazy coordinates are rounded by their exact values, however wide their enclosures")
{
  typedef CGAL::Exact_predicates_exact_constructions_kernel Lazy_kernel;
  typedef Lazy_kernel::FT Lazy;
  // An enclosure of x that is too wide for correct rounding, but narrow enough for to_double().
  const auto wide = [](double x) {
    const Lazy large = Lazy(1e9) / Lazy(3);
    return Lazy((Lazy(x) + large) - large);
  };
  const Mesh ball = sphere(1);
  CGAL::Surface_mesh<Lazy_kernel::Point_3> mesh;
  for(auto v : ball.vertices()) {
    const Point_3& p = ball.point(v);
    mesh.add_vertex(Lazy_kernel::Point_3(wide(p.x()), wide(p.y()), wide(p.z())));
  }
  for(auto f : ball.faces()) {
    std::vector<Mesh::Vertex_index> corners;
    for(auto v : ball.vertices_around_face(ball.halfedge(f))) corners.push_back(v);
    mesh.add_face(corners);
  }
  REQUIRE(CGAL::to_double(wide(0.1)) != 0.1);
  Input_mesh_3 input;
  REQUIRE(input.build<CGAL::Sequential_tag>(mesh, mesh.points(), {}) == Status::SUCCESS);
  for(auto v : input.mesh().vertices())
    CHECK(input.mesh().point(v) == ball.point(Mesh::Vertex_index(unsigned(input.vertex_of_origin(v)))));
}

TEST_CASE("Input mesh: isolated vertices are ignored")
{
  Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  mesh.add_vertex(Point_3(100, 100, 100));
  Input_mesh_3 input;
  REQUIRE(check(input, mesh) == Status::SUCCESS);
  CHECK(input.mesh().number_of_vertices() == 8);
  CHECK(input.bbox() == CGAL::Bbox_3(0, 0, 0, 1, 1, 1));
  CHECK(input.number_of_components() == 1);
}

TEST_CASE("Input mesh: points are taken from the vertex point map")
{
  const Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  std::unordered_map<Mesh::Vertex_index, Point_3> points;
  for(auto v : mesh.vertices()) points[v] = Point_3(2 * mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z() - 5);
  Input_mesh_3 input;
  REQUIRE(input.build<CGAL::Sequential_tag>(mesh, boost::make_assoc_property_map(points), {}) == Status::SUCCESS);
  CHECK(input.bbox() == CGAL::Bbox_3(0, 0, -5, 2, 1, -4));
}

TEST_CASE("Input mesh: a failed check rejects the mesh, even if no element is to blame")
{
  CGAL::Bspline_shells::Mesh_with_origins mesh;
  mesh.user_facets = mesh.user_vertices = 10;
  for(Status status : { Status::NOT_CLOSABLE, Status::NOT_TRUNCATABLE, Status::OPEN_MESH }) {
    CHECK(mesh.refuse_facets(status, {}).status == status);
    CHECK(mesh.refuse_vertices(status, {}).status == status);
    CHECK_FALSE(mesh.refuse_facets_if_any(status, {}));
    CHECK_FALSE(mesh.refuse_vertices_if_any(status, {}));
    CHECK(mesh.refuse_facets_if_any(status, { 3 }).offending_simplices.facets == std::vector<std::size_t>{ 3 });
  }
  // The others are discs, as there is no closing.
  CHECK(mesh.refuse_facets(Status::DEGENERATE_FACET, { 10, 11 }).status == Status::NOT_TRUNCATABLE);
  const CGAL::Bspline_shells::Mesh_refusal refusal = mesh.refuse_vertices(Status::SINGULAR_VERTEX, { 11, 4, 4 });
  CHECK(refusal.status == Status::SINGULAR_VERTEX);
  CHECK(refusal.offending_simplices.vertices == std::vector<std::size_t>{ 4 });
}
} // namespace test_Mesh_with_origins
