// tetrahedralize.h of the examples: which tetrahedra are accepted as a filling of a mesh.
#include "../../../examples/Bspline_shell_3/tetrahedralize.h" // first: must be self-contained

#include <CGAL/boost/graph/helpers.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <utility>

namespace test_tetrahedralize {
TEST_CASE("Tetrahedra conform to a mesh if and only if their boundary facets are exactly those of the mesh")
{
  // a double pyramid over a triangle, cut into two tetrahedra
  Tetrahedra tetrahedra;
  tetrahedra.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0.2, 0.3, 1 }, { 0.2, 0.3, -1 } };
  tetrahedra.cells = { { 0, 1, 2, 3 }, { 0, 2, 1, 4 } };
  Surface mesh;
  for(const Tetrahedra::Point& p : tetrahedra.points) mesh.add_vertex(p);
  const auto add = [&](unsigned int a, unsigned int b, unsigned int c) {
    REQUIRE(mesh.add_face(Surface::Vertex_index(a), Surface::Vertex_index(b), Surface::Vertex_index(c))
            != Surface::null_face());
  };
  for(unsigned int a = 0; a < 3; ++a) {
    add(a, (a + 1) % 3, 3);
    add((a + 1) % 3, a, 4);
  }
  REQUIRE(CGAL::is_closed(mesh));
  CHECK(conforms(tetrahedra, mesh));

  SECTION("interior points and tetrahedra are allowed")
  {
    tetrahedra.points.emplace_back(0.2, 0.3, 0.5);
    tetrahedra.cells = { { 0, 2, 1, 4 }, { 0, 1, 2, 5 }, { 0, 1, 5, 3 }, { 1, 2, 5, 3 }, { 2, 0, 5, 3 } };
    CHECK(conforms(tetrahedra, mesh));
  }
  SECTION("a missing tetrahedron is detected")
  {
    tetrahedra.cells.pop_back();
    CHECK_FALSE(conforms(tetrahedra, mesh));
  }
  SECTION("a duplicate tetrahedron is detected")
  {
    tetrahedra.cells.push_back(tetrahedra.cells[0]);
    CHECK_FALSE(conforms(tetrahedra, mesh));
  }
  SECTION("a tetrahedron outside the mesh is detected")
  {
    tetrahedra.points.emplace_back(2, 2, 2);
    tetrahedra.cells.push_back({ 1, 2, 3, 5 });
    CHECK_FALSE(conforms(tetrahedra, mesh));
  }
  SECTION("a subdivided facet of the mesh is detected")
  {
    tetrahedra.points.emplace_back(0.5, 0, 0);
    tetrahedra.cells = { { 0, 5, 2, 3 }, { 5, 1, 2, 3 }, { 0, 2, 1, 4 } };
    CHECK_FALSE(conforms(tetrahedra, mesh));
  }
  SECTION("a point moved by one ulp is detected")
  {
    tetrahedra.points[3] = Tetrahedra::Point(0.2, 0.3, std::nextafter(1., 2.));
    CHECK_FALSE(conforms(tetrahedra, mesh));
  }
  SECTION("an inverted tetrahedron is detected and repaired")
  {
    std::swap(tetrahedra.cells[1][0], tetrahedra.cells[1][1]);
    CHECK_FALSE(conforms(tetrahedra, mesh));
    CHECK(checked(tetrahedra, mesh));
  }
}
} // namespace test_tetrahedralize
