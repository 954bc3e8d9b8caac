// attach_closing.h: closings are attached to meshes that they make closed surfaces, and to no others.
#include <CGAL/Bspline_shell_3/Mesh/attach_closing.h>
#include "input_meshes.h"

#include <memory>

namespace test_attach_closing {
namespace {

using namespace input_meshes;

typedef CGAL::Bspline_shells::Shell_closing_3 Closing;
typedef CGAL::Bspline_shells::Surface_part Part;

Status check_closed(Input_mesh_3& input, const Mesh& mesh, const Closing& closing)
{
  return input.build<CGAL::Sequential_tag>(mesh, mesh.points(), {}, std::make_shared<const Closing>(closing));
}

// Returns a pyramid over a square, without its base.
Mesh open_pyramid()
{
  Mesh mesh;
  const auto top = mesh.add_vertex(Point_3(0, 0, 1));
  std::vector<Mesh::Vertex_index> v;
  for(const Point_3& p : { Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(-1, 0, 0), Point_3(0, -1, 0) })
    v.push_back(mesh.add_vertex(p));
  for(int i = 0; i < 4; ++i) mesh.add_face(top, v[i], v[(i + 1) % 4]);
  return mesh;
}

// Returns the missing base, with a point below.
Closing base_of_pyramid(const Closing::Point& below)
{
  return Closing({ { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, -1, 0 }, below }, 4,
                 { { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 4 }, { 0, 3, 4 } },
                 std::vector<Closing::Kind>(4, Closing::Kind::CAP));
}

} // namespace

TEST_CASE("Input mesh: each facet of a closed mesh belongs to the user's mesh or to the closing")
{
  Input_mesh_3 input;
  REQUIRE(check_closed(input, open_pyramid(), base_of_pyramid({ 0, 0, -1 })) == Status::SUCCESS);
  CHECK(input.number_of_facets_of_origin() == 8);
  for(std::size_t n = 0; n < 8; ++n) CHECK(input.part_of_facet(n) == (n < 4 ? Part::MESH : Part::CLOSING));
  for(auto v : input.mesh().vertices()) CHECK((input.vertex_of_origin(v) < 5) == (input.mesh().point(v).z() >= 0));
}

TEST_CASE("Input mesh: a closing that belongs to another mesh, or does not yield a surface, is rejected")
{
  const Mesh mesh = open_pyramid();
  const Positions all = { 0, 1, 2, 3 }; // each facet has an edge on the border
  Input_mesh_3 input;
  const auto refused = [&](const Mesh& m, const Closing& closing) {
    const Status status = check_closed(input, m, closing);
    CHECK(input.offending_simplices().facets == all);
    CHECK(input.mesh().number_of_faces() == 0);
    CHECK_FALSE(input.closing());
    return status;
  };
  Mesh moved = mesh;
  moved.point(Mesh::Vertex_index(1)) = Point_3(1.1, 0, 0);
  CHECK(refused(moved, base_of_pyramid({ 0, 0, -1 })) == Status::OPEN_MESH);
  // degenerate triangles, and coordinates out of range
  CHECK(refused(mesh, base_of_pyramid({ 0.5, 0.5, 0 })) == Status::NOT_CLOSABLE);
  CHECK(refused(mesh, base_of_pyramid({ 0, 0, -1e70 })) == Status::NOT_CLOSABLE);
  // The closing has an edge that the mesh also has.
  Mesh square = sheet({ 0, 1 }, { 0, 1 }, [](double, double) { return 0.; });
  const Closing across({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.7, 0.3, -1 }, { 0.3, 0.7, -1 } }, 4,
                       { { 1, 0, 4 }, { 2, 1, 4 }, { 0, 2, 4 }, { 3, 2, 5 }, { 0, 3, 5 }, { 2, 0, 5 } },
                       std::vector<Closing::Kind>(6, Closing::Kind::BACK));
  CHECK(check_closed(input, square, across) == Status::NOT_CLOSABLE);
  CHECK(input.offending_simplices().facets == Positions{ 0, 1 });
  // If triangles intersect the mesh, facets of the mesh are reported.
  CHECK(check_closed(input, mesh, base_of_pyramid({ 0.9, 0.9, 0.3 })) == Status::NOT_CLOSABLE);
  CHECK_FALSE(input.offending_simplices().facets.empty());
  for(std::size_t f : input.offending_simplices().facets) CHECK(f < mesh.number_of_faces());
  REQUIRE(check_closed(input, mesh, base_of_pyramid({ 0, 0, -1 })) == Status::SUCCESS);
}
} // namespace test_attach_closing
