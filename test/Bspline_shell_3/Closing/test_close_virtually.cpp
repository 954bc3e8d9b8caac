// close_virtually.h: holes get caps where these leave enough room, otherwise back sheets. The closed mesh never
// intersects itself, and a mesh that cannot be closed is refused.
#include <CGAL/Bspline_shell_3/Closing/close_virtually.h>
#include "test_meshes.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/number_type_config.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace test_close_virtually {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace PMP = CGAL::Polygon_mesh_processing;
typedef BS::Shell_closing_3 Closing;
typedef BS::Shell_status Status;

// Returns a rectangle of the parameter plane, mapped to space by `place`.
Mesh surface(int nu, int nv, const std::function<Point_3(double, double)>& place)
{
  return mapped(sheet(steps(0, 1, nu), steps(0, 1, nv)), [&](const Point_3& p) { return place(p.x(), p.y()); });
}

struct Closed_mesh
{
  Mesh mesh;
  BS::Closing_report report;
};

// Checks the guarantees of the closed mesh, which has the facets of `mesh` first.
Closed_mesh closed(const Mesh& mesh, double offset)
{
  BS::Closing_report report;
  const BS::Virtual_closing found = BS::close_virtually<CGAL::Sequential_tag>(mesh, offset, report);
  REQUIRE(found.status == Status::SUCCESS);
  REQUIRE(found.closing);
  CHECK(found.offending_facets.empty());
  CHECK(report.triangles == found.closing->triangles().size());
  CHECK(found.closing->kinds().size() == found.closing->triangles().size());
  Mesh whole = mesh;
  const auto attached = found.closing->attach(whole, whole.points());
  REQUIRE(attached);
  CHECK(CGAL::is_closed(whole));
  CHECK_FALSE(PMP::does_self_intersect(whole));
  std::size_t border = 0;
  for(auto v : mesh.vertices())
    if(mesh.is_border(v)) {
      ++border;
      CHECK(found.closing->border_point({ mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z() })
            < found.closing->number_of_border_points());
    }
  CHECK(found.closing->number_of_border_points() == border);
  return { whole, report };
}

} // namespace

TEST_CASE("Closing: an open half sphere gets a flat cap")
{
  Mesh mesh = sphere(3);
  remove_facets(mesh, [](const Point_3& p) { return p.z() < 0.1; });
  const auto [whole, report] = closed(mesh, 0.05);
  REQUIRE(report.holes.size() == 1);
  CHECK(report.caps() == 1);
  CHECK(report.sheets == 0);
  CHECK(report.holes[0].is_capped);
  CHECK(report.triangles == report.holes[0].edges - 2);
  CHECK(PMP::volume(whole) == Approx(2 * CGAL_PI / 3).epsilon(0.2));
  CHECK(whole.number_of_vertices() == mesh.number_of_vertices());
}

TEST_CASE("Closing: a planar sheet becomes a slab with sloping sides")
{
  constexpr double offset = 0.05;
  const Mesh mesh = sheet(steps(0, 1, 4), steps(0, 2, 8));
  const auto [whole, report] = closed(mesh, offset);
  CHECK(report.caps() == 0);
  CHECK(report.sheets == 1);
  CHECK(report.least_offset == Approx(offset));
  CHECK(report.largest_offset == Approx(offset));
  CHECK(report.triangles == mesh.number_of_faces() + 2 * report.holes.at(0).edges);
  // The volume is that of a frustum between rectangles of 1 x 2 and 1.1 x 2.1.
  const double a = 2, b = (1 + 2 * offset) * (2 + 2 * offset), middle = (1 + offset) * (2 + offset);
  CHECK(PMP::volume(whole) == Approx(offset / 6 * (a + 4 * middle + b)));
  for(auto v : whole.vertices())
    if(std::size_t(v) >= mesh.number_of_vertices()) CHECK(whole.point(v).z() == Approx(-offset));
}

TEST_CASE("Closing: a planar annulus with a slit and a flat sharp triangle get a back sheet")
{
  const Mesh annulus = surface(24, 3, [](double u, double v) {
    const double angle = -1.96 * CGAL_PI * u, r = 0.5 + 0.5 * v;
    return Point_3(r * std::cos(angle), r * std::sin(angle), 0);
  });
  const BS::Closing_report report = closed(annulus, 0.05).report; // the slit is 0.06 wide at the inner circle
  CHECK(report.sheets == 1);
  CHECK(report.largest_offset <= 0.05 * (1 + 1e-12));

  Mesh tip; // an angle of five degrees
  const double t = std::tan(5 * CGAL_PI / 180);
  tip.add_face(tip.add_vertex(Point_3(0, 0, 0)), tip.add_vertex(Point_3(1, 0, 0)), tip.add_vertex(Point_3(1, t, 0)));
  CHECK(closed(tip, 0.02).report.sheets == 1);
}

TEST_CASE("Closing: a sphere with a hundred holes gets a hundred caps")
{
  Mesh mesh = sphere(4);
  std::vector<char> is_taken(mesh.number_of_vertices(), 0);
  std::vector<Mesh::Vertex_index> centers;
  for(auto v : mesh.vertices()) {
    if(centers.size() == 100) break;
    bool is_free = true;
    std::vector<Mesh::Vertex_index> near = { v };
    for(auto w : mesh.vertices_around_target(mesh.halfedge(v))) {
      near.push_back(w);
      for(auto x : mesh.vertices_around_target(mesh.halfedge(w))) near.push_back(x);
    }
    for(auto w : near) is_free = is_free && !is_taken[w];
    if(!is_free) continue;
    for(auto w : near) is_taken[w] = 1;
    centers.push_back(v);
  }
  REQUIRE(centers.size() == 100);
  for(auto v : centers) CGAL::Euler::remove_center_vertex(mesh.halfedge(v), mesh);
  std::vector<Mesh::Face_index> polygons;
  for(auto f : mesh.faces())
    if(!CGAL::is_triangle(mesh.halfedge(f), mesh)) polygons.push_back(f);
  for(auto f : polygons) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  mesh.collect_garbage();
  const BS::Closing_report report = closed(mesh, 0.05).report;
  CHECK(report.holes.size() == 100);
  CHECK(report.caps() == 100);
  CHECK(report.sheets == 0);
}

TEST_CASE("Closing: if a cap would intersect the mesh, a back sheet replaces it, at a smaller offset in narrow places")
{
  // The sheet is rolled up to a spiral of two turns, 0.1 apart.
  const Mesh mesh = surface(96, 4, [](double u, double v) {
    const double angle = 4 * CGAL_PI * u, r = 0.3 + 0.2 * u;
    return Point_3(r * std::cos(angle), r * std::sin(angle), 0.5 * v);
  });
  const BS::Closing_report report = closed(mesh, 0.2).report;
  CHECK(report.caps() == 0);
  CHECK(report.sheets == 1);
  CHECK(report.least_offset < 0.1);
  CHECK(report.largest_offset > report.least_offset);
}

TEST_CASE("Closing: two sheets back to back, closer than the offset, get back sheets between them")
{
  const std::vector<double> xs = steps(0, 1, 4);
  const Mesh mesh = joined(sheet(xs, xs, 0.02), reversed(sheet(xs, xs)));
  const BS::Closing_report report = closed(mesh, 0.05).report;
  CHECK(report.sheets == 2);
  CHECK(report.largest_offset < 0.01);
}

TEST_CASE("Closing: if only triangles of the closing intersect, the facets at their vertices are named")
{
  // Back sheets are not closer than 1/16384 of the offset, so that those of both sheets do not fit between them.
  const double offset = 0.2, gap = 0.75 * offset / 16384;
  const Mesh front = sheet(steps(0, 1, 3), steps(0, 1, 3)),
             mesh = joined(front,
                           reversed(mapped(front, [&](const Point_3&p) { return Point_3(p.x(), p.y(), -gap); })));
  BS::Closing_report report;
  const BS::Virtual_closing found = BS::close_virtually<CGAL::Sequential_tag>(mesh, offset, report);
  CHECK(found.status == Status::NOT_CLOSABLE);
  CHECK_FALSE(found.offending_facets.empty());
  CHECK(std::any_of(found.offending_facets.begin(), found.offending_facets.end(),
                    [&](auto f) { return std::size_t(f) >= front.number_of_faces(); }));
}

TEST_CASE("Closing: closed components are left unchanged")
{
  const Mesh mesh = joined(sphere(2, 1, Point_3(5, 0, 0)), sheet(steps(0, 1, 2), steps(0, 1, 2)));
  const auto [whole, report] = closed(mesh, 0.05);
  CHECK(report.sheets == 1);
  CHECK(report.triangles == 8 + 2 * 8);
  CHECK(whole.number_of_faces() == mesh.number_of_faces() + report.triangles);
}

TEST_CASE("Closing: a shallow dish gets no cap that would leave a thin wall")
{
  Mesh dish = sphere(5); // 0.28 wide and 0.01 deep
  remove_facets(dish, [](const Point_3& p) { return p.z() < 0.99; });
  CHECK(closed(dish, 0.1).report.sheets == 1);
  CHECK(closed(dish, 0.002).report.caps() == 1);
}

TEST_CASE("Closing: a self-intersecting mesh is rejected, and its facets are reported")
{
  const Mesh flat = sheet({ 0, 1 }, { 0, 1 }),
             mesh = joined(flat, mapped(flat, [](const Point_3&p) {
                             return Point_3(0.3 + 0.2 * p.y(), 0.3 + 0.1 * p.x(), p.y() - 0.5);
                           }));
  BS::Closing_report report;
  const auto found = BS::close_virtually<CGAL::Sequential_tag>(mesh, 0.05, report);
  CHECK(found.status == Status::SELF_INTERSECTION);
  CHECK_FALSE(found.closing);
  CHECK_FALSE(found.offending_facets.empty());
}

TEST_CASE("Closing: a spiral ramp cannot be closed at its axis")
{
  // The mesh is embedded and faces upwards everywhere, but it turns by 630 degrees around one vertex.
  Mesh mesh;
  const auto axis = mesh.add_vertex(Point_3(0, 0, 0));
  std::vector<Mesh::Vertex_index> rim;
  for(int i = 0; i <= 28; ++i) {
    const double angle = CGAL_PI * i / 8;
    rim.push_back(mesh.add_vertex(Point_3(std::cos(angle), std::sin(angle), 0.05 * i)));
  }
  for(std::size_t i = 0; i + 1 < rim.size(); ++i) mesh.add_face(axis, rim[i], rim[i + 1]);
  REQUIRE_FALSE(PMP::does_self_intersect(mesh));
  BS::Closing_report report;
  const auto found = BS::close_virtually<CGAL::Sequential_tag>(mesh, 0.02, report);
  CHECK(found.status == Status::NOT_CLOSABLE);
  CHECK_FALSE(found.closing);
}

TEST_CASE("Closing: the result does not depend on the number of threads")
{
  Mesh mesh = sphere(3);
  remove_facets(mesh, [](const Point_3& p) { return std::abs(p.z()) < 0.3 || p.x() > 0.9; });
  BS::Closing_report one, several;
  const auto a = BS::close_virtually<CGAL::Sequential_tag>(mesh, 0.2, one);
  const auto b = BS::close_virtually<CGAL::Parallel_if_available_tag>(mesh, 0.2, several);
  REQUIRE(a.closing);
  REQUIRE(b.closing);
  CHECK(a.closing->points() == b.closing->points());
  CHECK(a.closing->triangles() == b.closing->triangles());
}

TEST_CASE("Closing: scaling a mesh by a power of two scales its closing exactly")
{
  Mesh holed = sphere(3);
  remove_facets(holed, [](const Point_3& p) { return std::abs(p.z()) < 0.3 || p.x() > 0.9; });
  const Mesh dish = surface(8, 8, [](double u, double v) { return Point_3(u, v, 0.4 * (u * u + v * v)); });
  for(const Mesh& mesh : { holed, dish }) {
    BS::Closing_report report, scaled_report;
    const auto found = BS::close_virtually<CGAL::Sequential_tag>(mesh, 0.2, report);
    REQUIRE(found.closing);
    for(int exponent : { 60, -60, 190, -190 }) {
      CAPTURE(exponent);
      const double scale = std::ldexp(1., exponent);
      const Mesh scaled = mapped(mesh, [&](const Point_3& p) { return CGAL::ORIGIN + scale * (p - CGAL::ORIGIN); });
      const auto other = BS::close_virtually<CGAL::Sequential_tag>(scaled, scale * 0.2, scaled_report);
      REQUIRE(other.closing);
      CHECK(other.closing->triangles() == found.closing->triangles());
      REQUIRE(other.closing->points().size() == found.closing->points().size());
      std::size_t wrong = 0;
      for(std::size_t n = 0; n < found.closing->points().size(); ++n)
        for(std::size_t a = 0; a < 3; ++a)
          wrong += other.closing->points()[n][a] != scale * found.closing->points()[n][a];
      CHECK(wrong == 0);
    }
  }
}
} // namespace test_close_virtually
