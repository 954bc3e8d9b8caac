// transfer_corner_attribute.h: texture coordinates are unchanged, and facets across a seam are not spread over the
// texture.
#include "flat_and_round_maps.h"
#include "meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/Transfer/transfer_corner_attribute.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <set>

namespace test_transfer_corner_attribute {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
typedef Mesh::Halfedge_index Halfedge;
typedef Mesh::Face_index Face;
typedef Kernel::Point_2 Point_2;
typedef Mesh::Property_map<Halfedge, Point_2> Texture;

Texture texture_of(Mesh& mesh, const char* name)
{
  return mesh.add_property_map<Halfedge, Point_2>(name, Point_2(-7, -7)).first;
}

double distance(const Point_2& p, const Point_2& q)
{
  return std::sqrt(CGAL::squared_distance(p, q));
}

// Sets the value at each corner, a function of its point and of the centroid of its facet.
template <typename Function>
void set_texture(const Mesh& mesh, Texture texture, const Function& uv)
{
  for(auto f : mesh.faces())
    for(auto h : mesh.halfedges_around_face(mesh.halfedge(f)))
      texture[h] = uv(mesh.point(mesh.target(h)), centroid(mesh, f));
}

// Planar coordinates with a jump at x = 1/8.
Point_2 cut_sheet(const Point_3& p, const Point_3& center)
{
  return Point_2(p.x() + (center.x() < 0.125 ? 0 : 10), 2 * p.y());
}

// Coordinates from 0 to 1 around the z-axis, cut where y = 0 and x < 0. Each facet is on one side of the cut.
Point_2 around(const Point_3& p, const Point_3& center)
{
  double u = std::atan2(p.y(), p.x()) / (2 * CGAL_PI);
  const double c = std::atan2(center.y(), center.x()) / (2 * CGAL_PI);
  if(u - c > 0.5) u -= 1;
  if(u - c < -0.5) u += 1;
  return Point_2(u, p.z());
}

} // namespace

TEST_CASE("Texture coordinates: under the identity, coordinates are unchanged, even on closed surfaces with cuts")
{
  for(Mesh mesh : { torus(2, 0.7, 24, 12), sphere(2) }) {
    const CGAL::Certified_bspline_shell_3 shell = CGAL::certified_bspline_shell_3(mesh, P::relative_thickness(0.02));
    REQUIRE(shell.is_certified());
    Texture before = texture_of(mesh, "h:before"), after = texture_of(mesh, "h:after");
    set_texture(mesh, before, around);
    const BS::Shell_map_3<CGAL::Certified_bspline_shell_3, Mesh> identity(shell, mesh, mesh);
    const BS::Transfer_report report = BS::transfer_corner_attribute(identity, before, after);
    CHECK(report);
    CHECK(report.transferred == mesh.number_of_faces());
    CHECK(report.facets_across_seams.empty());
    for(auto h : mesh.halfedges()) CHECK(distance(before[h], after[h]) < 1e-12);

    // If vertices are moved within the shell, the lengths of edges change by the displacement at most: 1 % of the box,
    // a tenth of an edge.
    Mesh moved = certified_mesh_in_shell(shell, mesh);
    Texture on_moved = texture_of(moved, "h:moved");
    CHECK(BS::transfer_corner_attribute(BS::Shell_map_3<CGAL::Certified_bspline_shell_3, Mesh>(shell, mesh, moved),
                                        before, on_moved));
    for(auto h : mesh.halfedges()) CHECK(distance(before[h], on_moved[h]) < 0.01);
  }
}

TEST_CASE("Texture coordinates: a facet across a seam gets the coordinates of one side, and is reported")
{
  // Vertices and edges of the source are on the seam; steps are 1/8.
  Mesh a = sheet(steps(-0.75, 0.75, 12), steps(-0.8, 0.8, 7));
  Texture on_a = texture_of(a, "h:uv");
  set_texture(a, on_a, cut_sheet);
  for(int number : { 3, 10, 12, 37 }) {
    // Facets of the target can be far larger or far smaller than those of the source. With 12 steps, its vertices and
    // edges are over those of the source.
    Mesh b = sheet(steps(-0.75, 0.75, number), steps(-0.7, 0.6, number),
                   [](double x, double y) { return 0.2 + 0.2 * x - 0.3 * y; });
    for(auto v : b.vertices()) // moved inside
      if(b.is_border(v)) b.point(v) = Point_3(0.999 * b.point(v).x(), b.point(v).y(), b.point(v).z());
    Texture on_b = texture_of(b, "h:uv");
    const BS::Transfer_report report = BS::transfer_corner_attribute(Polynomial_map(slab(), a, b), on_a, on_b);
    CHECK(report);
    const std::set<std::size_t> named(report.facets_across_seams.begin(), report.facets_across_seams.end());
    for(auto f : b.faces()) {
      const std::array<Point_3, 3> t = corners(b, f);
      const double least = (std::min)({ t[0].x(), t[1].x(), t[2].x() }),
                   largest = (std::max)({ t[0].x(), t[1].x(), t[2].x() });
      const double near = 1e-6;
      if(least < 0.125 - near && largest > 0.125 + near) CHECK(named.count(std::size_t(f)) == 1);
      if(largest < 0.125 + 1e-12 || least > 0.125 - 1e-12) CHECK(named.count(std::size_t(f)) == 0);
      // The function is linear on both sides, so extrapolation is exact.
      for(auto h : b.halfedges_around_face(b.halfedge(f)))
        CHECK(distance(on_b[h], cut_sheet(b.point(b.target(h)), centroid(b, f))) < 1e-7);
    }
  }
}

TEST_CASE("Texture coordinates: around a ball, no edge runs around the wrong way")
{
  Mesh a = sphere(3, 0.75);
  Texture on_a = texture_of(a, "h:uv");
  set_texture(a, on_a, around);
  for(int subdivisions : { 1, 2, 4 }) {
    Mesh b = turned(sphere(subdivisions, subdivisions == 1 ? 0.9 : 0.85), 0.37);
    Texture on_b = texture_of(b, "h:uv");
    const BS::Transfer_report report = BS::transfer_corner_attribute(Polynomial_map(ball(), a, b), on_a, on_b);
    CHECK(report);
    std::size_t checked = 0;
    for(auto f : b.faces()) {
      bool at_pole = false; // longitudes are unreliable there
      for(auto v : b.vertices_around_face(b.halfedge(f))) at_pole = at_pole || std::abs(b.point(v).z()) > 0.6;
      if(at_pole) continue;
      for(auto h : b.halfedges_around_face(b.halfedge(f))) {
        Point_2 expected = around(b.point(b.target(h)), centroid(b, f));
        expected = Point_2(expected.x(), expected.y() * 0.75 / (subdivisions == 1 ? 0.9 : 0.85));
        // Whole turns depend on the chosen side. The remaining error is due to chords instead of arcs, and to
        // extrapolation up to an edge of b beyond the seam.
        const double turns = std::nearbyint(on_b[h].x() - expected.x());
        CHECK(std::abs(on_b[h].x() - turns - expected.x()) < (subdivisions == 1 ? 0.05 : 0.01));
        CHECK(std::abs(on_b[h].y() - expected.y()) < (subdivisions == 1 ? 0.1 : 0.02));
        // All corners of a facet are on the same side.
        CHECK(std::abs(on_b[h].x() - on_b[b.next(h)].x()) < (subdivisions == 1 ? 0.25 : 0.12));
        ++checked;
      }
    }
    CHECK(checked > 30);
    CHECK(report.facets_across_seams.size() > 0);
    CHECK(report.facets_across_seams.size() < (subdivisions == 4 ? 200u : 60u));
  }
}

TEST_CASE("Texture coordinates: failures are reported, and corners there are unchanged")
{
  Mesh a = sheet(steps(-0.75, 0.5, 5), steps(-0.75, 0.75, 7));
  Mesh b = sheet(steps(-0.7, 0.7, 7), steps(-0.7, 0.7, 7), 0.1);
  Texture on_a = texture_of(a, "h:uv"), on_b = texture_of(b, "h:uv");
  set_texture(a, on_a, cut_sheet);
  BS::Transfer_report report = BS::transfer_corner_attribute(Polynomial_map(slab(), a, b), on_a, on_b);
  CHECK_FALSE(report);
  std::set<std::size_t> failed;
  for(const auto& failure : report.failures) {
    CHECK(failure.second == BS::Flow_status::LEAVES_SHELL);
    failed.insert(failure.first);
  }
  for(auto f : b.faces()) {
    const std::array<Point_3, 3> t = corners(b, f);
    const double largest = (std::max)({ t[0].x(), t[1].x(), t[2].x() });
    CHECK(failed.count(std::size_t(f)) == std::size_t(largest > 0.5));
    for(auto h : b.halfedges_around_face(b.halfedge(f))) CHECK((on_b[h] == Point_2(-7, -7)) == (largest > 0.5));
  }
  CHECK(report.transferred + failed.size() == b.number_of_faces());

  // With a default value, all corners of failed facets get it.
  Texture set = texture_of(b, "h:set");
  CHECK(
    BS::transfer_corner_attribute(Polynomial_map(slab(), a, b), on_a, set, P::default_value(Point_2(-1, -1))).failures
    == report.failures);
  for(auto f : b.faces())
    for(auto h : b.halfedges_around_face(b.halfedge(f)))
      CHECK(set[h] == (failed.count(std::size_t(f)) ? Point_2(-1, -1) : on_b[h]));

  Mesh quads = a;
  CGAL::Euler::join_face(*std::find_if(quads.halfedges_begin(), quads.halfedges_end(),
                                       [&](Halfedge h) { return !quads.is_border(quads.edge(h)); }),
                         quads);
  Texture on_quads = texture_of(quads, "h:other");
  report = BS::transfer_corner_attribute(Polynomial_map(slab(), quads, b), on_quads, on_b);
  CHECK(report.transferred == 0);
  CHECK(report.failures.size() == b.number_of_faces());
  CHECK(report.failures[0].second == BS::Flow_status::INVALID_MESH);
  // This includes the four corners of a facet that is not a triangle.
  report = BS::transfer_corner_attribute(Polynomial_map(slab(), b, quads), set, on_quads,
                                         P::default_value(Point_2(-2, -2)));
  CHECK(report.failures.size() == quads.number_of_faces());
  for(auto f : quads.faces())
    for(auto h : quads.halfedges_around_face(quads.halfedge(f))) CHECK(on_quads[h] == Point_2(-2, -2));
}
} // namespace test_transfer_corner_attribute
