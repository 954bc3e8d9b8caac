// Shell_closing_3.h: triangles that close every mesh with their border, and no other. Attaching and detaching them
// restores the mesh.
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include "test_meshes.h"

#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace test_Shell_closing_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Shell_closing_3 Closing;

// Returns the unit cube without its top.
Mesh open_cube()
{
  Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  remove_facets(mesh, [](const Point_3& p) { return p.z() == 1; });
  return mesh;
}

// Returns a roof with one inner point.
Closing roof(double height = 1.5)
{
  return Closing({ { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 }, { 0.5, 0.5, height } }, 4,
                 { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } },
                 std::vector<Closing::Kind>(4, Closing::Kind::CAP));
}

} // namespace

TEST_CASE("Shell closing: a mesh is closed by the triangles, in their order, and opened again")
{
  const Mesh before = open_cube();
  Mesh mesh = before;
  const auto attached = roof().attach(mesh, mesh.points());
  REQUIRE(attached);
  CHECK(CGAL::is_closed(mesh));
  CHECK(mesh.is_valid());
  CHECK(mesh.number_of_faces() == before.number_of_faces() + 4);
  CHECK(mesh.number_of_vertices() == before.number_of_vertices() + 1);
  REQUIRE(attached->faces.size() == 4);
  REQUIRE(attached->vertices.size() == 1);
  CHECK(mesh.point(attached->vertices[0]) == Point_3(0.5, 0.5, 1.5));
  for(std::size_t n = 0; n < 4; ++n) {
    bool has_apex = false;
    for(auto v : mesh.vertices_around_face(mesh.halfedge(attached->faces[n])))
      has_apex = has_apex || v == attached->vertices[0];
    CHECK(has_apex);
  }
  Closing::detach(mesh, *attached);
  mesh.collect_garbage();
  CHECK(mesh.is_valid());
  CHECK(is_equal(mesh, before));
}

TEST_CASE("Shell closing: a Polyhedron_3 is closed and opened again")
{
  typedef CGAL::Polyhedron_3<Kernel> Polyhedron;
  Polyhedron mesh;
  CGAL::copy_face_graph(open_cube(), mesh);
  const std::size_t facets = mesh.size_of_facets(), vertices = mesh.size_of_vertices();
  const auto attached = roof().attach(mesh, get(CGAL::vertex_point, mesh));
  REQUIRE(attached);
  CHECK(mesh.is_closed());
  CHECK(mesh.is_valid());
  Closing::detach(mesh, *attached);
  CHECK(mesh.size_of_facets() == facets);
  CHECK(mesh.size_of_vertices() == vertices);
  CHECK(mesh.is_valid());
}

TEST_CASE("Shell closing: signs of zeros are ignored")
{
  Mesh mesh = mapped(open_cube(), [](const Point_3& p) { return Point_3(p.x() == 0 ? -0. : p.x(), p.y(), p.z()); });
  CHECK(roof().attach(mesh, mesh.points()));
}

TEST_CASE("Shell closing: a mesh with another border is left unchanged")
{
  const auto is_rejected = [](const Mesh& before, const Closing& closing) {
    Mesh mesh = before;
    const bool is_attached = bool(closing.attach(mesh, mesh.points()));
    mesh.collect_garbage();
    return !is_attached && is_equal(mesh, before);
  };
  const Mesh cube = open_cube();
  REQUIRE_FALSE(is_rejected(cube, roof()));
  CHECK(is_rejected(box(Point_3(0, 0, 0), Point_3(1, 1, 1)), roof())); // already closed

  Mesh moved = cube; // by one unit in the last place
  for(auto v : moved.vertices())
    if(moved.point(v) == Point_3(1, 1, 1)) moved.point(v) = Point_3(1, 1 - 1.2e-16, 1);
  CHECK(is_rejected(moved, roof()));

  Mesh split = cube;
  for(auto h : split.halfedges())
    if(split.is_border(h)) {
      const auto v = CGAL::Euler::split_edge(h, split);
      split.point(split.target(v)) = Point_3(0.5, 0.5, 1);
      break;
    }
  CHECK(is_rejected(split, roof()));

  Mesh another = cube; // with another hole
  CGAL::Euler::remove_face(another.halfedge(*another.faces().begin()), another);
  another.collect_garbage();
  CHECK(is_rejected(another, roof()));

  // The triangles have the opposite orientation to the mesh.
  CHECK(is_rejected(cube, Closing(roof().points(), 4, { { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 4 }, { 0, 3, 4 } },
                                  std::vector<Closing::Kind>(4, Closing::Kind::CAP))));
  // The closing has an edge that the mesh also has, the diagonal of a square. This is detected after facets were added.
  const Mesh square = sheet({ 0, 1 }, { 0, 1 });
  const Closing across({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.7, 0.3, -1 }, { 0.3, 0.7, -1 } }, 4,
                       { { 1, 0, 4 }, { 2, 1, 4 }, { 0, 2, 4 }, { 3, 2, 5 }, { 0, 3, 5 }, { 2, 0, 5 } },
                       std::vector<Closing::Kind>(6, Closing::Kind::BACK));
  REQUIRE(across.is_valid());
  CHECK(is_rejected(square, across));
  // Two points of the border have the same position.
  CHECK(is_rejected(cube, Closing({ { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 0, 1 } }, 4,
                                  { { 0, 1, 2 }, { 0, 2, 3 } }, std::vector<Closing::Kind>(2, Closing::Kind::CAP))));
}

TEST_CASE("Shell closing: is_valid() detects triangles that cannot close any mesh")
{
  const auto is_valid = [](std::size_t points, std::size_t border, const std::vector<Closing::Triangle>& triangles) {
    std::vector<Closing::Point> p;
    for(std::size_t n = 0; n < points; ++n) p.push_back({ double(n), double(n * n), 0 });
    const Closing closing(p, border, triangles, std::vector<Closing::Kind>(triangles.size(), Closing::Kind::CAP));
    Mesh mesh = open_cube();
    CHECK_FALSE(closing.attach(mesh, mesh.points()));
    CHECK(is_equal(mesh, open_cube()));
    return closing.is_valid();
  };
  CHECK(is_valid(3, 3, { { 0, 1, 2 } }));
  CHECK(is_valid(4, 3, { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } }));
  CHECK(is_valid(6, 6, { { 0, 1, 2 }, { 3, 4, 5 } }));
  CHECK_FALSE(is_valid(3, 3, { { 0, 1, 3 } })); // a point that does not exist
  CHECK_FALSE(is_valid(3, 4, { { 0, 1, 2 } }));
  CHECK_FALSE(is_valid(3, 3, { { 0, 1, 1 } }));
  CHECK_FALSE(is_valid(4, 4, { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } })); // the apex is on no border
  CHECK_FALSE(is_valid(4, 3, { { 0, 1, 2 } }));                           // a point in no triangle
  CHECK_FALSE(is_valid(5, 3, { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 4 } })); // open between inner points
  CHECK_FALSE(is_valid(4, 4, { { 0, 1, 2 }, { 0, 1, 3 } }));              // an edge twice in the same direction
  CHECK_FALSE(is_valid(5, 5, { { 0, 1, 2 }, { 0, 3, 4 } }));              // the border passes a point twice
  // A roof with an inner triangle; and the roof with that triangle twice, so each of its edges has several facets on
  // one side.
  const std::vector<Closing::Triangle> roof = { { 0, 1, 3 }, { 1, 4, 3 }, { 1, 2, 4 }, { 2, 5, 4 },
                                                { 2, 0, 5 }, { 0, 3, 5 }, { 3, 4, 5 } };
  std::vector<Closing::Triangle> twice = roof;
  twice.push_back({ 3, 4, 5 });
  CHECK(is_valid(6, 3, roof));
  CHECK_FALSE(is_valid(6, 3, twice));
  // A tetrahedron touches the roof in a point, on the border or inside.
  for(Closing::Index p : { 0u, 3u }) {
    std::vector<Closing::Triangle> touching = roof;
    touching.insert(touching.end(), { { p, 6, 7 }, { p, 7, 8 }, { p, 8, 6 }, { 8, 7, 6 } });
    CHECK_FALSE(is_valid(9, 3, touching));
  }
  // A separate tetrahedron is another component.
  std::vector<Closing::Triangle> beside = roof;
  beside.insert(beside.end(), { { 9, 6, 7 }, { 9, 7, 8 }, { 9, 8, 6 }, { 8, 7, 6 } });
  CHECK(is_valid(10, 3, beside));
  const double infinity = std::numeric_limits<double>::infinity();
  const Closing infinite({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, infinity } }, 3, { { 0, 1, 2 } }, { Closing::Kind::CAP });
  CHECK_FALSE(infinite.is_valid());
}

TEST_CASE("Shell closing: a mesh with a part of the border, or with two copies of it, is left unchanged")
{
  // pyramids without their bases
  const auto add = [](Mesh& mesh, double height) {
    const auto a = mesh.add_vertex(Point_3(0, 0, 0)), b = mesh.add_vertex(Point_3(1, 0, 0));
    const auto c = mesh.add_vertex(Point_3(0, 1, 0));
    const auto top = mesh.add_vertex(Point_3(0.2, 0.2, height));
    mesh.add_face(a, b, top);
    mesh.add_face(b, c, top);
    mesh.add_face(c, a, top);
  };
  const Closing base({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, 3, { { 0, 2, 1 } }, { Closing::Kind::CAP });
  const Closing bases({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 5, 0, 0 }, { 6, 0, 0 }, { 5, 1, 0 } }, 6,
                      { { 0, 2, 1 }, { 3, 5, 4 } }, { Closing::Kind::CAP, Closing::Kind::CAP });
  Mesh one;
  add(one, 1);
  Mesh two = one;
  add(two, 2);
  const Mesh before = one, two_before = two;
  CHECK_FALSE(base.match_border(two, two.points()));
  CHECK_FALSE(base.attach(two, two.points()));
  CHECK(is_equal(two, two_before));
  CHECK_FALSE(bases.match_border(one, one.points()));
  CHECK_FALSE(bases.attach(one, one.points()));
  CHECK(is_equal(one, before));
  CHECK(base.attach(one, one.points()));
}

TEST_CASE("Shell closing: a Polyhedron_3 that already has an edge of the closing is left unchanged")
{
  CGAL::Polyhedron_3<Kernel> mesh;
  CGAL::copy_face_graph(sheet({ 0, 1 }, { 0, 1 }), mesh);
  const Closing across({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.7, 0.3, -1 }, { 0.3, 0.7, -1 } }, 4,
                       { { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 5 }, { 0, 3, 5 }, { 0, 2, 4 }, { 2, 0, 5 } },
                       std::vector<Closing::Kind>(6, Closing::Kind::BACK));
  REQUIRE(across.match_border(mesh, get(CGAL::vertex_point, mesh)));
  CHECK_FALSE(across.attach(mesh, get(CGAL::vertex_point, mesh)));
  CHECK(mesh.size_of_vertices() == 4);
  CHECK(mesh.size_of_facets() == 2);
  mesh.normalize_border();
  CHECK(mesh.size_of_border_edges() == 4);
  CHECK(mesh.is_valid());
}
} // namespace test_Shell_closing_3
