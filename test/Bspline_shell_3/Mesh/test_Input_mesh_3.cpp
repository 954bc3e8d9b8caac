// Input_mesh_3.h: the checked mesh, or the reason why it is refused.
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include "input_meshes.h"

namespace test_Input_mesh_3 {

using namespace input_meshes;

TEST_CASE("Input mesh: a closed mesh is accepted, with its box, unit, components and orientation")
{
  Input_mesh_3 input;
  const Mesh mesh = box(Point_3(1, 2, 3), Point_3(3, 7, 4));
  REQUIRE(check(input, mesh) == Status::SUCCESS);
  CHECK(input.mesh().number_of_faces() == 12);
  CHECK(input.bbox() == CGAL::Bbox_3(1, 2, 3, 3, 7, 4));
  CHECK(input.unit() == 5);
  CHECK(input.number_of_components() == 1);
  CHECK(input.faces_outwards());
  CHECK(input.offending_simplices().facets.empty());
  CHECK(input.offending_simplices().vertices.empty());
}

TEST_CASE("Input mesh: a rejected mesh does not affect the next one")
{
  Input_mesh_3 input;
  REQUIRE(check(input, pyramid_over_U()) == Status::SINGULAR_VERTEX);
  CHECK(input.mesh().number_of_faces() == 0);
  REQUIRE(check(input, sphere(1)) == Status::SUCCESS);
  CHECK(input.offending_simplices().vertices.empty());
  CHECK(input.mesh().number_of_faces() == 80);
}
} // namespace test_Input_mesh_3
