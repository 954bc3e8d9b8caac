// check_orientation.h: components must bound a volume together; all of them may be inside out.
#include <CGAL/Bspline_shell_3/Mesh/check_orientation.h>
#include "input_meshes.h"

#include <array>

namespace test_check_orientation {
namespace {

using namespace input_meshes;

namespace PMP = CGAL::Polygon_mesh_processing;

} // namespace

TEST_CASE("INCONSISTENT_ORIENTATION: one facet of each component to be reversed is reported")
{
  Input_mesh_3 input;
  const Mesh left = box(Point_3(0, 0, 0), Point_3(1, 1, 1)), right = box(Point_3(2, 0, 0), Point_3(3, 1, 1), false),
             far = box(Point_3(4, 0, 0), Point_3(5, 1, 1));
  REQUIRE(check(input, both(both(left, right), far)) == Status::SUCCESS);
  CHECK(input.number_of_components() == 3);

  // Reversing the named components must fix the mesh, whichever side is taken as the correct one.
  const auto mend = [&input](Mesh mesh, std::size_t components) {
    REQUIRE(check(input, mesh) == Status::INCONSISTENT_ORIENTATION);
    const Positions named = input.offending_simplices().facets;
    CHECK(named.size() == components);
    CHECK(input.offending_simplices().vertices.empty());
    for(std::size_t n : named) {
      std::vector<Mesh::Face_index> component;
      PMP::connected_component(*std::next(mesh.faces().begin(), n), mesh, std::back_inserter(component));
      PMP::reverse_face_orientations(component, mesh);
    }
    CHECK(check(input, mesh) == Status::SUCCESS);
  };
  mend(both(left, reversed(right)), 1);
  mend(both(both(left, reversed(right)), reversed(far)), 2);
  mend(with_garbage(both(left, reversed(right))), 1);
  // A cavity must have the orientation opposite to its surroundings, and a body in the cavity again the opposite one.
  const Mesh outer = sphere(1, 4), cavity = sphere(1, 2), core = sphere(1, 1);
  mend(both(outer, cavity), 1);
  mend(both(both(outer, reversed(cavity)), reversed(core)), 1);
}

TEST_CASE("Input mesh: bodies side by side are recognized, even if their gap is much narrower than their facets")
{
  Input_mesh_3 input;
  for(int axis = 0; axis < 3; ++axis) {
    constexpr double gap = 1e-3;
    std::array<double, 3> low = { 0, 0, 0 }, high = { 1, 1, 1 };
    low[axis] += 1 + gap;
    high[axis] += 1 + gap;
    const Mesh body = box(Point_3(0, 0, 0), Point_3(1, 1, 1)),
               other = box(Point_3(low[0], low[1], low[2]), Point_3(high[0], high[1], high[2]));
    for(const Mesh& m : { both(body, other), both(other, body) }) {
      REQUIRE(check(input, m) == Status::SUCCESS);
      CHECK(input.faces_outwards());
    }
  }
}

TEST_CASE("INCONSISTENT_ORIENTATION is returned for a flat mesh, which bounds no volume, even if it may self-intersect")
{
  // Two triangles back to back, and a folded flat octahedron that is not orthogonal to any axis.
  Mesh flat = tetrahedron(Point_3(0, 0, 0), Point_3(4, 0, 0), Point_3(0, 4, 0), Point_3(1, 1, 0));
  Input_mesh_3 input;
  CHECK(check(input, flat) == Status::SELF_INTERSECTION);
  Input_mesh_3::Tolerated_defects tolerated;
  tolerated.self_intersections = true;
  CHECK(check(input, flat, tolerated) == Status::INCONSISTENT_ORIENTATION);
  CHECK(input.offending_simplices().facets == Positions{ 0 });
  for(auto v : flat.vertices()) {
    const Point_3 p = flat.point(v);
    flat.point(v) = Point_3(p.x(), p.y(), p.x() / 3 + p.y() / 7);
  }
  CHECK(check(input, flat, tolerated) == Status::INCONSISTENT_ORIENTATION);
}

TEST_CASE("Input mesh: the whole mesh may be inside out")
{
  Input_mesh_3 input;
  const Mesh hollow = both(sphere(1, 4), reversed(sphere(1, 2)));
  REQUIRE(check(input, hollow) == Status::SUCCESS);
  CHECK(input.faces_outwards());
  CHECK(input.number_of_components() == 2);
  REQUIRE(check(input, reversed(hollow)) == Status::SUCCESS);
  CHECK_FALSE(input.faces_outwards());
  CHECK(input.number_of_components() == 2);
  REQUIRE(check(input, reversed(sphere(1))) == Status::SUCCESS);
  CHECK_FALSE(input.faces_outwards());
  // The order of the components does not matter.
  REQUIRE(check(input, both(reversed(sphere(1, 2)), sphere(1, 4))) == Status::SUCCESS);
  CHECK(input.faces_outwards());
}
} // namespace test_check_orientation
