#include <Carry/Triangulated_model.h>

#include <catch2/catch.hpp>

#include <cstddef>

namespace test_Triangulated_model {

using namespace Tool;

TEST_CASE("Triangulated_model: corners and halfedges belong to each other, also after a reversal")
{
  Model model; // two triangles; the fifth point is at the position of the first one, and the last has no polygon
  model.soup.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 0 }, { 5, 5, 5 } };
  model.soup.polygons = { { 0, 1, 2 }, { 4, 2, 3 } };
  Triangulated_model mesh(model);
  CHECK(mesh.vertex_at(0) == mesh.vertex_at(4));
  CHECK(mesh.vertex_at(5) == Mesh::null_vertex());
  for(int turn = 0; turn < 2; ++turn) {
    for(std::size_t corner = 0; corner < 6; ++corner) {
      const auto h = mesh.halfedge_to(corner);
      REQUIRE(h != Mesh::null_halfedge());
      CHECK(mesh.corner_at(h) == corner);
      CHECK(mesh.polygon_of(mesh.mesh().face(h)) == corner / 3);
      CHECK(mesh.mesh().point(mesh.mesh().target(h)) == model.soup.points[model.soup.polygons[corner / 3][corner % 3]]);
    }
    mesh.reverse();
  }
}

TEST_CASE("Triangulated_model: polygons without area have no facets")
{
  Model model;
  model.soup.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 2, 0, 0 } };
  model.soup.polygons = { { 0, 1, 3 }, { 0, 1, 2 } };
  const Triangulated_model mesh(model);
  REQUIRE(mesh.mesh().number_of_faces() == 1);
  CHECK(mesh.polygon_of(*mesh.mesh().faces().begin()) == 1);
  CHECK(mesh.halfedge_to(0) == Mesh::null_halfedge());
}

} // namespace test_Triangulated_model
