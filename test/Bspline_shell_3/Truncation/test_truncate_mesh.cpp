// truncate_mesh.h: singular vertices are replaced by discs with a margin, without intersections. Vertices that cannot
// be truncated are reported; other vertices are unchanged.
#include <CGAL/Bspline_shell_3/Truncation/truncate_mesh.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include "test_meshes.h"

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace test_truncate_mesh {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace PMP = CGAL::Polygon_mesh_processing;
typedef BS::Truncation_report::Outcome Outcome;

BS::Input_mesh_3 input(const Mesh& mesh, const BS::Input_mesh_3::Closer& closer = BS::Input_mesh_3::Closer())
{
  BS::Input_mesh_3 result;
  BS::Input_mesh_3::Tolerated_defects tolerated;
  tolerated.singular_vertices = true;
  REQUIRE(result.build<CGAL::Sequential_tag>(mesh, mesh.points(), tolerated, closer) == BS::Shell_status::SUCCESS);
  return result;
}

std::shared_ptr<const BS::Shell_truncation_3> truncation(const BS::Input_mesh_3& mesh, double radius, double margin,
                                                         BS::Truncation_report& report)
{
  return BS::truncate_mesh<CGAL::Sequential_tag>(
    mesh, [radius](const std::array<double, 3>&) { return radius; }, margin, report);
}

// Returns the truncated mesh, after checks of its guarantees.
Mesh truncated(const Mesh& mesh, double radius, double margin, BS::Truncation_report& report)
{
  const BS::Input_mesh_3 checked = input(mesh);
  const auto found = truncation(checked, radius, margin, report);
  REQUIRE(found);
  CHECK(found->is_valid());
  CHECK(found->discs().size() == report.truncated());
  Mesh result = checked.mesh();
  const auto applied = found->apply(result, result.points());
  REQUIRE(applied);
  CHECK(applied->patches > 0);
  CHECK(std::count(applied->facets.begin(), applied->facets.end(), Mesh::null_face()) == 0);
  result.collect_garbage();
  CHECK(CGAL::is_valid_polygon_mesh(result));
  CHECK(CGAL::is_closed(result));
  CHECK(CGAL::is_triangle_mesh(result));
  CHECK_FALSE(PMP::does_self_intersect(result));
  for(const auto& v : report.vertices) {
    if(v.outcome != Outcome::TRUNCATED) continue;
    const Point_3 center(v.point[0], v.point[1], v.point[2]);
    CHECK(v.radius > 0);
    CHECK(v.radius <= radius);
    CHECK(v.margin_after >= 2 * v.margin_before);
    // The margins at the disc are as reported.
    double least = 1;
    for(auto w : result.vertices()) {
      const double distance = std::sqrt(CGAL::squared_distance(center, result.point(w)));
      CHECK(distance > 0);
      if(distance > v.radius * (1 + 1e-9)) continue;
      least = (std::min)(least, BS::vertex_cone_margin(result, w));
      CHECK(BS::vertex_cone(result, w));
    }
    CHECK(least == Approx(v.margin_after).epsilon(1e-6));
  }
  return result;
}

} // namespace

TEST_CASE("Truncated meshes: a mesh without bad vertices is not truncated")
{
  BS::Truncation_report report;
  report.vertices.resize(3);
  for(const Mesh& mesh : { sphere(2), box(Point_3(0, 0, 0), Point_3(1, 2, 3)), torus(1, 0.3, 20, 10) }) {
    CHECK_FALSE(truncation(input(mesh), 0.1, 0.2, report));
    CHECK(report.vertices.empty());
  }
}

TEST_CASE("Truncated meshes: a vertex of six quadrants that face no common direction is truncated")
{
  const Mesh mesh = screw();
  REQUIRE(CGAL::is_closed(mesh));
  BS::Truncation_report report;
  const Mesh result = truncated(mesh, 0.1, 0.05, report);
  REQUIRE(report.vertices.size() == 1);
  const auto& v = report.vertices.front();
  CHECK(mesh.point(Mesh::Vertex_index(v.vertex)) == Point_3(1, 1, 1));
  CHECK(v.outcome == Outcome::TRUNCATED);
  CHECK(v.margin_before == 0);
  CHECK(v.margin_after > 0.3);
  CHECK(v.radius == Approx(0.1));
  CHECK(result.number_of_vertices() > mesh.number_of_vertices());
}

TEST_CASE("Truncated meshes: two singular vertices that an edge joins are truncated within disjoint balls")
{
  BS::Truncation_report report;
  truncated(screw(5), 1, 0.05, report);
  REQUIRE(report.vertices.size() == 2);
  for(const auto& v : report.vertices) {
    CHECK(v.outcome == Outcome::TRUNCATED);
    CHECK(v.radius <= 1. / 3); // the balls are disjoint
    CHECK(v.margin_after > 0.2);
  }
}

TEST_CASE("Truncated meshes: a needle is truncated only if a larger margin is requested")
{
  BS::Truncation_report report;
  const Mesh needle = pyramid(12, 20);
  CHECK_FALSE(truncation(input(needle), 0.1, 0.04, report));
  truncated(needle, 0.1, 0.06, report);
  REQUIRE(report.truncated() == 1);
  CHECK(report.vertices.front().margin_before == Approx(0.05).epsilon(0.1));
  CHECK(report.vertices.front().margin_after > 0.3);
}

TEST_CASE("Truncated meshes: folded edges are reported, and left unchanged")
{
  // A blade: its two facets face opposite directions, up to half a degree.
  Mesh blade;
  const auto a = blade.add_vertex(Point_3(0, 0, 0)), b = blade.add_vertex(Point_3(1, 0, 0)),
             c = blade.add_vertex(Point_3(0.5, 1, 0.004)), d = blade.add_vertex(Point_3(0.5, 1, -0.004));
  blade.add_face(a, b, c);
  blade.add_face(b, a, d);
  blade.add_face(c, b, d);
  blade.add_face(a, c, d);
  BS::Truncation_report report;
  CHECK_FALSE(truncation(input(blade), 0.1, 0.05, report));
  CHECK(report.number(Outcome::FOLDED_EDGE) >= 2);
  CHECK(report.truncated() == 0);
}

TEST_CASE("Truncated meshes: singular vertices on the border of an open mesh are reported")
{
  // The screw lacks one of the facets at its singular vertex, and is closed by that facet.
  Mesh open = screw();
  const Point_3 corner(1, 1, 1);
  const auto v = *std::find_if(open.vertices().begin(), open.vertices().end(),
                               [&](auto w) { return open.point(w) == corner; });
  const auto f = open.face(open.halfedge(v));
  const auto h = open.halfedge(f);
  std::vector<BS::Shell_closing_3::Point> points;
  for(auto w : { open.source(h), open.target(h), open.target(open.next(h)) }) {
    const Point_3& p = open.point(w);
    points.push_back({ p.x(), p.y(), p.z() });
  }
  CGAL::Euler::remove_face(h, open);
  open.collect_garbage();
  const auto closing = std::make_shared<const BS::Shell_closing_3>(
    points, 3, std::vector<BS::Shell_closing_3::Triangle>{ { 0, 1, 2 } },
    std::vector<BS::Shell_closing_3::Kind>{ BS::Shell_closing_3::Kind::CAP });
  BS::Truncation_report report;
  CHECK_FALSE(truncation(input(open, BS::Input_mesh_3::closer(closing)), 0.1, 0.05, report));
  REQUIRE(report.vertices.size() == 1);
  CHECK(report.vertices.front().outcome == Outcome::ON_BORDER);
  CHECK(open.point(Mesh::Vertex_index(report.vertices.front().vertex)) == corner);
}

TEST_CASE("Truncated meshes: a vertex whose coordinates are too large for exact cuts is not truncated")
{
  Mesh mesh = screw();
  for(auto v : mesh.vertices()) mesh.point(v) = mesh.point(v) + Vector_3(0x1p40, 0, 0);
  BS::Truncation_report report;
  CHECK_FALSE(truncation(input(mesh), 0.1, 0.05, report));
  REQUIRE(report.vertices.size() == 1);
  CHECK(report.vertices.front().outcome == Outcome::NO_SPACE);
}

TEST_CASE("Truncated meshes: other parts nearby reduce the radius of the ball")
{
  // Another component is in the corner that the screw leaves open.
  Mesh mesh = screw();
  Mesh other = box(Point_3(1.02, 0.2, 0.2), Point_3(1.8, 0.98, 0.98));
  mesh += other;
  BS::Truncation_report report;
  truncated(mesh, 0.3, 0.05, report);
  REQUIRE(report.truncated() == 1);
  CHECK(report.vertices.front().radius <= 0.02 * std::sqrt(3.) / 2 * (1 + 1e-12));
}

TEST_CASE("Truncated meshes: the truncation does not depend on scale, rotation or threads")
{
  BS::Truncation_report first;
  truncated(screw(5), 0.2, 0.05, first);
  const double c = std::cos(0.7), s = std::sin(0.7);
  for(double scale : { 1e-6, 1., 1e9 }) {
    Mesh mesh = screw(5);
    PMP::transform(
      CGAL::Aff_transformation_3<Kernel>(c, -s, 0, s * 0.6, c * 0.6, -0.8, s * 0.8, c * 0.8, 0.6, 1. / scale), mesh);
    BS::Truncation_report report;
    truncated(mesh, 0.2 * scale, 0.05, report);
    REQUIRE(report.vertices.size() == first.vertices.size());
    for(std::size_t n = 0; n < first.vertices.size(); ++n) {
      CHECK(report.vertices[n].vertex == first.vertices[n].vertex);
      CHECK(report.vertices[n].radius == Approx(scale * first.vertices[n].radius));
      CHECK(report.vertices[n].margin_after == Approx(first.vertices[n].margin_after).epsilon(0.05));
    }
  }
#ifdef CGAL_LINKED_WITH_TBB
  BS::Truncation_report report;
  const BS::Input_mesh_3 mesh = input(screw(5));
  const auto parallel = BS::truncate_mesh<CGAL::Parallel_tag>(
    mesh, [](const std::array<double, 3>&) { return 0.2; }, 0.05, report);
  const auto sequential = truncation(mesh, 0.2, 0.05, report);
  REQUIRE(parallel);
  CHECK(parallel->points() == sequential->points());
  CHECK(parallel->cut_facets() == sequential->cut_facets());
#endif
}
} // namespace test_truncate_mesh
