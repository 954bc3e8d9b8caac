// check_embedding.h: meshes that intersect themselves, and vertices whose facets face no common direction, are refused.
#include <CGAL/Bspline_shell_3/Mesh/check_embedding.h>
#include "input_meshes.h"

namespace test_check_embedding {

using namespace input_meshes;

TEST_CASE("SELF_INTERSECTION: the facets that cross are reported, as polygons of the user's mesh")
{
  // A spike from the inside of a box of quadrangles pierces its top.
  const Point_3 tip(0.5, 0.3, 3);
  Mesh mesh = both(box(Point_3(-1, -1, -1), Point_3(1, 1, 1), false),
                   tetrahedron(tip, Point_3(0.4, 0.2, 0), Point_3(0.6, 0.2, 0), Point_3(0.5, 0.4, 0)));
  for(bool garbage : { false, true }) {
    if(garbage) mesh = with_garbage(mesh);
    const auto at_tip = vertex_at(mesh, tip);
    const Positions crossing = facets_where(mesh, [&](Mesh::Face_index f) {
      if(has_corner(mesh, f, at_tip)) return true;
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        if(mesh.point(v).z() != 1) return false;
      return true;
    });
    REQUIRE(crossing.size() == 4);
    Input_mesh_3 input;
    REQUIRE(check(input, mesh) == Status::SELF_INTERSECTION);
    CHECK(input.offending_simplices().facets == crossing);
    CHECK(input.offending_simplices().vertices.empty());

    Input_mesh_3::Tolerated_defects tolerated;
    tolerated.self_intersections = true;
    CHECK(check(input, mesh, tolerated) == Status::SUCCESS);
    CHECK(input.number_of_components() == 2);
    CHECK(input.offending_simplices().facets.empty());
  }
}

TEST_CASE("SINGULAR_VERTEX: the apex over a polygon with an empty kernel is reported")
{
  Mesh mesh = pyramid_over_U();
  for(bool garbage : { false, true }) {
    if(garbage) mesh = with_garbage(mesh);
    const auto apex = vertex_at(mesh, Point_3(2, 0.5, 3));
    Input_mesh_3 input;
    REQUIRE(check(input, mesh) == Status::SINGULAR_VERTEX);
    CHECK(input.offending_simplices().vertices == Positions{ position(mesh.vertices(), apex) });
    CHECK(input.offending_simplices().facets.empty());

    Input_mesh_3::Tolerated_defects tolerated;
    tolerated.singular_vertices = true;
    CHECK(check(input, mesh, tolerated) == Status::SUCCESS);
  }
}
} // namespace test_check_embedding
