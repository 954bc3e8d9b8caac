// validate_mesh.h: facets are triangulated; meshes that are not surfaces of such triangles are refused.
#include <CGAL/Bspline_shell_3/Mesh/validate_mesh.h>
#include "input_meshes.h"

#include <cmath>

namespace test_validate_mesh {

using namespace input_meshes;

TEST_CASE("OPEN_MESH: the facets at the border are reported, even of polygons and after removals")
{
  Input_mesh_3 input;
  for(bool triangulated : { false, true }) {
    Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, 1), triangulated);
    const Mesh::Face_index gone = *std::next(mesh.faces().begin(), 2);
    Positions neighbors;
    std::vector<Mesh::Face_index> faces;
    for(auto h : mesh.halfedges_around_face(mesh.halfedge(gone))) faces.push_back(mesh.face(mesh.opposite(h)));
    CGAL::Euler::remove_face(mesh.halfedge(gone), mesh);
    for(auto f : faces) neighbors.push_back(position(mesh.faces(), f));
    std::sort(neighbors.begin(), neighbors.end());
    REQUIRE(check(input, mesh) == Status::OPEN_MESH);
    CHECK(neighbors.size() == (triangulated ? 3 : 4));
    CHECK(input.offending_simplices().facets == neighbors);
    CHECK(input.offending_simplices().vertices.empty());
  }
}

TEST_CASE("NON_MANIFOLD: the vertex at which two closed surfaces touch is reported")
{
  // Two tetrahedra are joined at a common apex. The unused vertex is removed, so positions shift.
  const Mesh lower = tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, -1), Point_3(0, 1, -1), Point_3(-1, -1, -1));
  const Mesh upper = tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, 1), Point_3(0, 1, 1), Point_3(-1, -1, 1));
  Mesh mesh = both(upper, lower);
  Mesh::Vertex_index keep = Mesh::null_vertex(), drop = Mesh::null_vertex();
  for(auto v : mesh.vertices())
    if(mesh.point(v) == CGAL::ORIGIN) {
      (drop == Mesh::null_vertex() ? drop : keep) = v;
    }
  const auto around = mesh.halfedges_around_target(mesh.halfedge(drop));
  const std::vector<Mesh::Halfedge_index> halfedges(around.begin(), around.end());
  for(auto h : halfedges) mesh.set_target(h, keep);
  mesh.remove_vertex(drop);
  Input_mesh_3 input;
  REQUIRE(check(input, mesh) == Status::NON_MANIFOLD);
  CHECK(input.offending_simplices().vertices == Positions{ position(mesh.vertices(), keep) });
  CHECK(input.offending_simplices().facets.empty());
}

TEST_CASE("DEGENERATE_FACET: exactly the triangles and polygons of zero area are reported")
{
  // The edge pq of a tetrahedron gets `cuts` points. Then the facet on its left side is cut along pq.
  for(int cuts : { 1, 2 }) {
    Mesh mesh = tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1));
    const auto p = vertex_at(mesh, Point_3(0, 0, 0)), q = vertex_at(mesh, Point_3(1, 0, 0));
    Mesh::Halfedge_index h = mesh.halfedge(p, q);     // to q
    const Mesh::Halfedge_index before = mesh.prev(h); // to p
    for(int c = 1; c <= cuts; ++c) {
      const auto first_half = CGAL::Euler::split_edge(h, mesh);
      mesh.point(mesh.target(first_half)) = Point_3(c / 4., 0, 0);
    }
    // Corners of 180 degrees are not defects: two polygons with such corners are accepted.
    Input_mesh_3 input;
    REQUIRE(check(input, mesh) == Status::SUCCESS);
    CHECK(input.mesh().number_of_faces() == std::size_t(4 + 2 * cuts));

    CGAL::Euler::split_face(before, h, mesh);
    const Positions flat = facets_where(mesh, [&](Mesh::Face_index f) {
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        if(mesh.point(v).y() != 0 || mesh.point(v).z() != 0) return false;
      return true;
    });
    REQUIRE(flat.size() == 1);
    REQUIRE(check(input, mesh) == Status::DEGENERATE_FACET);
    CHECK(input.offending_simplices().facets == flat);
    CHECK(input.mesh().number_of_faces() == 0);
  }
}

TEST_CASE("DEGENERATE_FACET is not returned for a positive area, even of one part in 10^300")
{
  const double tiny = std::ldexp(1., -1000);
  Input_mesh_3 input;
  Mesh mesh = tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1));
  mesh.point(vertex_at(mesh, Point_3(0, 0, 1))) = Point_3(0, tiny, tiny); // thin, but no facet is degenerate
  CHECK(check(input, mesh) == Status::SUCCESS);
  mesh.point(vertex_at(mesh, Point_3(0, tiny, tiny))) = Point_3(0.5, 0, 0);
  REQUIRE(check(input, mesh) == Status::DEGENERATE_FACET);
  const auto moved = vertex_at(mesh, Point_3(0.5, 0, 0)), off = vertex_at(mesh, Point_3(0, 1, 0));
  CHECK(input.offending_simplices().facets == facets_where(mesh, [&](Mesh::Face_index f) {
          return has_corner(mesh, f, moved) && !has_corner(mesh, f, off);
        }));
}

TEST_CASE("COORDINATES_OUT_OF_RANGE is returned if coordinates are too large or too small for products of doubles")
{
  const auto scaled = [](double s) {
    return tetrahedron(Point_3(0, 0, 0), Point_3(s, 0, 0), Point_3(0, s, 0), Point_3(0, 0, s));
  };
  Input_mesh_3 input;
  for(double s : { 1.1e60, 1e90, 1e300, 0.9e-60, 1e-100, 1e-300 }) {
    CAPTURE(s);
    CHECK(check(input, scaled(s)) == Status::COORDINATES_OUT_OF_RANGE);
  }
  for(double s : { 0.9e60, 1.1e-60 }) {
    CAPTURE(s);
    CHECK(check(input, scaled(s)) == Status::SUCCESS);
  }
}

TEST_CASE("Input mesh: triangles of a polygon keep their facet of origin")
{
  Mesh mesh = both(box(Point_3(0, 0, 0), Point_3(1, 2, 3), false), sphere(0, 1, Point_3(5, 5, 5)));
  for(bool garbage : { false, true }) {
    if(garbage) mesh = with_garbage(mesh);
    Input_mesh_3 input;
    REQUIRE(check(input, mesh) == Status::SUCCESS);
    REQUIRE(input.mesh().number_of_faces() == 6 * 2 + 20);
    const std::vector<Mesh::Face_index> faces(mesh.faces().begin(), mesh.faces().end());
    std::vector<int> triangles(faces.size(), 0);
    for(auto f : input.mesh().faces()) {
      const std::size_t origin = input.facet_of_origin(f);
      REQUIRE(origin < faces.size());
      ++triangles[origin];
      for(const Point_3& p : input.triangle(f)) CHECK(has_corner(mesh, faces[origin], vertex_at(mesh, p)));
    }
    for(std::size_t n = 0; n < faces.size(); ++n) CHECK(triangles[n] == int(mesh.degree(faces[n])) - 2);
  }
}
} // namespace test_validate_mesh
