// apply_truncation.h: truncated meshes refer to the facets that they were cut from; meshes that cannot be truncated are
// refused.
#include <CGAL/Bspline_shell_3/Mesh/apply_truncation.h>
#include "input_meshes.h"
#include "truncations.h"

#include <cmath>
#include <memory>
#include <vector>

namespace test_apply_truncation {
namespace {

using namespace input_meshes;

typedef CGAL::Bspline_shells::Shell_closing_3 Closing;
typedef CGAL::Bspline_shells::Surface_part Part;

Status check_truncated(Input_mesh_3& input, const Mesh& mesh, const Truncation_parts& parts,
                       const Input_mesh_3::Tolerated_defects& tolerated = {})
{
  return input.build<CGAL::Sequential_tag>(mesh, mesh.points(), tolerated, nullptr, parts.shared());
}

} // namespace

TEST_CASE("Input mesh: cores have the facets that they are part of, and discs have none")
{
  const Mesh mesh = sphere(1);
  const Truncation_parts parts = truncation_at(mesh, { Mesh::Vertex_index(0), Mesh::Vertex_index(5) }, true);
  Input_mesh_3 input;
  REQUIRE(check_truncated(input, mesh, parts) == Status::SUCCESS);
  REQUIRE(input.truncation());
  CHECK(CGAL::is_closed(input.mesh()));
  const std::vector<Mesh::Face_index> faces(mesh.faces().begin(), mesh.faces().end());
  std::size_t in_discs = 0;
  for(auto f : input.mesh().faces()) {
    const std::size_t n = input.facet_of_origin(f);
    CHECK(input.part_of_facet(n) == (n < faces.size() ? Part::MESH : Part::DISC));
    in_discs += n >= faces.size() ? 1 : 0;
    if(n >= faces.size()) continue;
    // All vertices are in the plane of the facet, up to rounding.
    const auto h = mesh.halfedge(faces[n]);
    const Point_3 &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h));
    const Point_3& r = mesh.point(mesh.target(mesh.next(h)));
    for(const Point_3& x : input.triangle(f)) CHECK(std::abs(CGAL::volume(p, q, r, x)) < 1e-15);
    const auto t = input.triangle(f);
    CHECK(CGAL::squared_distance(CGAL::centroid(t[0], t[1], t[2]), Kernel::Triangle_3(p, q, r)) < 1e-30);
  }
  CHECK(in_discs == input.truncation()->discs()[0].triangles.size() + input.truncation()->discs()[1].triangles.size());
  CHECK(input.number_of_facets_of_origin() == faces.size() + in_discs);
}

TEST_CASE("Input mesh: a tip that another facet pierces is rejected, even if self-intersections are tolerated")
{
  // The tip is beyond the disc, so the truncated mesh does not intersect itself.
  Mesh mesh = ::pyramid(4, 1);
  const Truncation_parts parts = truncation_at(mesh, { Mesh::Vertex_index(0) }, false);
  mesh = both(mesh, box(Point_3(-0.5, -0.5, 0.9), Point_3(0.5, 0.5, 1.5)));
  Input_mesh_3::Tolerated_defects tolerated;
  tolerated.self_intersections = tolerated.singular_vertices = tolerated.orientation = true;
  Input_mesh_3 input;
  CHECK(check(input, mesh, tolerated) == Status::SUCCESS);
  CHECK(check_truncated(input, mesh, parts, tolerated) == Status::SELF_INTERSECTION);
  CHECK(check_truncated(input, ::pyramid(4, 1), parts, tolerated) == Status::SUCCESS);
}

TEST_CASE("Input mesh: a truncation that does not yield a surface is rejected, and its cut-off vertices are reported")
{
  const Mesh mesh = sphere(1);
  const Mesh::Vertex_index v(5);
  Truncation_parts parts = truncation_at(mesh, { v }, true);
  Input_mesh_3 input;
  const auto refused = [&](const Mesh& m, const Truncation_parts& p) {
    REQUIRE(p.is_valid());
    const Status status = check_truncated(input, m, p);
    CHECK(input.offending_simplices().vertices == Positions{ 5 });
    CHECK(input.offending_simplices().facets.empty());
    CHECK(input.mesh().number_of_faces() == 0);
    CHECK_FALSE(input.truncation());
    return status;
  };
  parts.points.back() = parts.points[parts.discs[0].rim[1]]; // the inner point of the disc is on its rim
  CHECK(refused(mesh, parts) == Status::NOT_TRUNCATABLE);
  parts.points.back() = { 0, 0, 1e70 };
  CHECK(refused(mesh, parts) == Status::NOT_TRUNCATABLE);

  // Facets of the closing are not part of the user's mesh, and cannot be cut.
  Mesh open = mesh;
  CGAL::Euler::remove_face(open.halfedge(v), open);
  open.collect_garbage();
  std::vector<Closing::Point> hole;
  for(auto h : open.halfedges())
    if(open.is_border(h)) {
      auto g = h;
      do {
        const Point_3& p = open.point(open.source(g));
        hole.push_back({ p.x(), p.y(), p.z() });
        g = open.next(g);
      } while(g != h);
      break;
    }
  REQUIRE(hole.size() == 3);
  const auto cap = std::make_shared<const Closing>(hole, 3, std::vector<Closing::Triangle>{ { 0, 1, 2 } },
                                                   std::vector<Closing::Kind>{ Closing::Kind::CAP });
  parts = truncation_at(mesh, { v }, true);
  const Status status = input.build<CGAL::Sequential_tag>(open, open.points(), {}, cap, parts.shared());
  CHECK(status == Status::NOT_TRUNCATABLE);
  CHECK(input.offending_simplices().vertices.size() == 1);
}
} // namespace test_apply_truncation
