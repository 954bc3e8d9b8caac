// tetrahedralize.h of the examples: which tetrahedra are accepted as a filling of a mesh.
#include "../../../examples/Bspline_shell_3/tetrahedralize.h" // first: must be self-contained

#include <CGAL/boost/graph/helpers.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <string>
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
  const auto check = [&](const std::string& change, bool is_conforming, const std::function<void(Tetrahedra&)>& apply) {
    INFO(change);
    Tetrahedra changed = tetrahedra;
    apply(changed);
    CHECK(conforms(changed, mesh) == is_conforming);
    return changed;
  };
  check("none", true, [](Tetrahedra&) {});
  check("interior points and tetrahedra", true, [](Tetrahedra& t) {
    t.points.emplace_back(0.2, 0.3, 0.5);
    t.cells = { { 0, 2, 1, 4 }, { 0, 1, 2, 5 }, { 0, 1, 5, 3 }, { 1, 2, 5, 3 }, { 2, 0, 5, 3 } };
  });
  check("a missing tetrahedron", false, [](Tetrahedra& t) { t.cells.pop_back(); });
  check("a duplicate tetrahedron", false, [](Tetrahedra& t) { t.cells.push_back(t.cells[0]); });
  check("a tetrahedron outside the mesh", false, [](Tetrahedra& t) {
    t.points.emplace_back(2, 2, 2);
    t.cells.push_back({ 1, 2, 3, 5 });
  });
  check("a subdivided facet of the mesh", false, [](Tetrahedra& t) {
    t.points.emplace_back(0.5, 0, 0);
    t.cells = { { 0, 5, 2, 3 }, { 5, 1, 2, 3 }, { 0, 2, 1, 4 } };
  });
  check("a point moved by one ulp", false,
        [](Tetrahedra& t) { t.points[3] = Tetrahedra::Point(0.2, 0.3, std::nextafter(1., 2.)); });
  const Tetrahedra inverted = check("an inverted tetrahedron", false,
                                    [](Tetrahedra& t) { std::swap(t.cells[1][0], t.cells[1][1]); });
  CHECK(checked(inverted, mesh)); // repairs it
}
} // namespace test_tetrahedralize
