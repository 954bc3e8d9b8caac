// cut_along_polylines.h, Cut_report.h: polylines become sequences of edges, and the surface stays as it is; a mesh that
// cannot be cut or certified is unchanged.
#include "frozen_facets.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Editing/cut_along_polylines.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Transfer/map_polyline.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Random.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace test_cut_along_polylines {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
namespace PMP = CGAL::Polygon_mesh_processing;
typedef BS::Cut_status Status;
typedef CGAL::Bspline_shell_3<> Shell;
typedef PMP::Face_location<Mesh, double> Location;
typedef std::vector<Location> Polyline;
typedef Mesh::Property_map<Mesh::Edge_index, bool> Marks;

Location at_vertex(const Mesh& mesh, int v)
{
  return PMP::locate_vertex<double>(Mesh::Vertex_index(Mesh::size_type(v)), mesh);
}

Marks new_marks(Mesh& mesh)
{
  return mesh.add_property_map<Mesh::Edge_index, bool>("e:is_cut", false).first;
}

double marked_length(const Mesh& mesh, const Marks& marks)
{
  double length = 0;
  for(auto e : mesh.edges())
    if(marks[e]) length += PMP::edge_length(mesh.halfedge(e), mesh);
  return length;
}

double length(const Mesh& mesh, const Polyline& polyline)
{
  double length = 0;
  for(std::size_t n = 1; n < polyline.size(); ++n)
    length += distance(PMP::construct_point(polyline[n - 1], mesh), PMP::construct_point(polyline[n], mesh));
  return length;
}

// Claims that hold for every cut mesh.
void check_cut(const Mesh& before, const Mesh& after, const BS::Cut_report& report)
{
  CHECK(report.status == Status::SUCCESS);
  CHECK(report.facets_before == before.number_of_faces());
  CHECK(report.facets == after.number_of_faces());
  CHECK(after.is_valid());
  CHECK(CGAL::is_valid_polygon_mesh(after));
  CHECK(CGAL::is_triangle_mesh(after));
  CHECK(PMP::area(after) == Approx(PMP::area(before)).epsilon(1e-12));
  CHECK(after.number_of_vertices() + after.number_of_faces() - after.number_of_edges()
        == before.number_of_vertices() + before.number_of_faces() - before.number_of_edges());
  for(auto v : before.vertices()) CHECK(after.point(v) == before.point(v));
}

// The unit square: triangles 0 1 2 and 0 2 3.
Mesh square()
{
  Mesh mesh;
  const auto a = mesh.add_vertex({ 0, 0, 0 }), b = mesh.add_vertex({ 1, 0, 0 }), c = mesh.add_vertex({ 1, 1, 0 }),
             d = mesh.add_vertex({ 0, 1, 0 });
  mesh.add_face(a, b, c);
  mesh.add_face(a, c, d);
  return mesh;
}

Location in_square(const Mesh& mesh, double x, double y)
{
  Location location = PMP::locate(Point_3(x, y, 0), mesh);
  for(double& w : location.second)
    if(std::abs(w) < 1e-15) w = 0;
  return location;
}

Polyline section(const Mesh& mesh, const Vector_3& normal)
{
  const auto height = [&](Mesh::Vertex_index v) { return normal * (mesh.point(v) - CGAL::ORIGIN); };
  Mesh::Halfedge_index first;
  for(auto h : mesh.halfedges())
    if(height(mesh.source(h)) < 0 && height(mesh.target(h)) > 0) first = h;
  Polyline result;
  auto h = first;
  do {
    const double a = height(mesh.source(h)), b = height(mesh.target(h));
    result.push_back(PMP::locate_on_halfedge<double>(h, a / (a - b), mesh));
    auto next = mesh.next(h);
    if((height(mesh.source(next)) > 0) == (height(mesh.target(next)) > 0)) next = mesh.next(next);
    h = mesh.opposite(next);
  } while(h != first);
  result.push_back(result.front());
  return result;
}

template <typename Image>
std::vector<Polyline> locations(const Image& image)
{
  std::vector<Polyline> result;
  for(const auto& part : image.parts) {
    result.emplace_back();
    for(const auto& v : part) result.back().push_back(v.location);
  }
  return result;
}

} // namespace

TEST_CASE("Cut: a segment across two facets")
{
  const Mesh before = square();
  Mesh mesh = before;
  const Marks marks = new_marks(mesh);
  const Polyline polyline = { in_square(mesh, 0.25, 0), in_square(mesh, 0.25, 0.25), in_square(mesh, 0.25, 1) };
  const auto report = BS::cut_along_polylines(mesh, std::vector<Polyline>{ polyline },
                                              P::edge_is_constrained_map(marks));
  check_cut(before, mesh, report);
  CHECK(mesh.number_of_vertices() == 7);
  CHECK(report.facets == 6);
  CHECK(report.cut_facets == 2);
  CHECK(report.cut_edges == 2);
  CHECK(report.crossings == 0);
  CHECK(marked_length(mesh, marks) == 1);
  for(auto e : mesh.edges())
    if(marks[e])
      for(unsigned i = 0; i < 2; ++i) CHECK(mesh.point(mesh.vertex(e, i)).x() == 0.25);
}

TEST_CASE("Cut: polylines along edges, through vertices, and to points in facets become edges")
{
  const Mesh before = square();
  Mesh mesh = before;
  const Marks marks = new_marks(mesh);
  const std::vector<Polyline> polylines = {
    { at_vertex(mesh, 0), at_vertex(mesh, 2) },                                // the diagonal
    { in_square(mesh, 0.5, 0.5), in_square(mesh, 0.75, 0.75) },                // a part of it
    { in_square(mesh, 0.25, 0), in_square(mesh, 0.5, 0), at_vertex(mesh, 1) }, // a part of the border
    { at_vertex(mesh, 1), in_square(mesh, 0.5, 0.25), at_vertex(mesh, 1) },    // there and back
    { in_square(mesh, 0.25, 0.75) },                                           // a point
    {}
  };
  const auto report = BS::cut_along_polylines(mesh, polylines, P::edge_is_constrained_map(marks));
  check_cut(before, mesh, report);
  CHECK(mesh.number_of_vertices() == 4 + 2 + 2 + 1 + 1);
  CHECK(marked_length(mesh, marks) == Approx(std::sqrt(2.) + 0.75 + std::hypot(0.5, 0.25)));
  CHECK(report.cut_edges == 3 + 2 + 1);
}

TEST_CASE("Cut: polylines that cross inside a facet meet in a vertex")
{
  const Mesh before = square();
  Mesh mesh = before;
  const Marks marks = new_marks(mesh);
  const std::vector<Polyline> polylines = { { in_square(mesh, 0.25, 0), in_square(mesh, 1, 0.75) },
                                            { in_square(mesh, 0.75, 0), in_square(mesh, 0.75, 0.75) },
                                            { in_square(mesh, 0.625, 0.125), in_square(mesh, 0.875, 0.5) } };
  const auto report = BS::cut_along_polylines(mesh, polylines, P::edge_is_constrained_map(marks));
  check_cut(before, mesh, report);
  CHECK(report.crossings == 2);
  double expected = 0;
  for(const Polyline& polyline : polylines) expected += length(before, polyline);
  CHECK(marked_length(mesh, marks) == Approx(expected));
}

TEST_CASE("Cut: many random polylines")
{
  CGAL::Random random(5);
  const Mesh before = sheet(steps(-1, 1, 6), steps(-1, 1, 5), [](double x, double y) { return x * y + 0.3 * x; });
  Mesh mesh = before;
  const Marks marks = new_marks(mesh);
  std::vector<Polyline> polylines;
  double expected = 0;
  for(auto f : before.faces()) {
    polylines.emplace_back();
    for(int i = 0; i < 5; ++i) {
      // on an edge, in the facet, or at a vertex
      std::array<double, 3> w = { random.get_double(), random.get_double(), random.get_double() };
      if(i == 0 || i == 2) w[std::size_t(random.get_int(0, 3))] = 0;
      if(i == 4) w = { 0, 1, 0 };
      const double sum = w[0] + w[1] + w[2];
      for(double& x : w) x /= sum;
      polylines.back().emplace_back(f, w);
    }
    expected += length(before, polylines.back());
  }
  const auto report = BS::cut_along_polylines(mesh, polylines, P::edge_is_constrained_map(marks));
  check_cut(before, mesh, report);
  CHECK(report.cut_facets == before.number_of_faces());
  CHECK(report.crossings > 0);
  CHECK(marked_length(mesh, marks) == Approx(expected));
}

TEST_CASE("Cut: parts of a marked edge are marked, and other new edges are not")
{
  Mesh mesh = square();
  const Marks marks = new_marks(mesh);
  for(auto e : mesh.edges()) marks[e] = !mesh.is_border(e); // the diagonal
  const Polyline polyline = { in_square(mesh, 0.25, 0), in_square(mesh, 0.25, 0.25), in_square(mesh, 0.25, 1) };
  const auto report = BS::cut_along_polylines(mesh, std::vector<Polyline>{ polyline },
                                              P::edge_is_constrained_map(marks));
  REQUIRE(report);
  CHECK(report.cut_edges == 2);
  CHECK(marked_length(mesh, marks) == Approx(1 + std::sqrt(2.)));
}

TEST_CASE("Cut: other types of meshes and point maps can be cut")
{
  typedef CGAL::Polyhedron_3<Kernel> Polyhedron;
  const Mesh before = sphere(1);
  Polyhedron polyhedron;
  CGAL::copy_face_graph(before, polyhedron);
  std::vector<PMP::Face_location<Polyhedron, double> > polyline;
  const auto h = *halfedges(polyhedron).begin();
  polyline.push_back(PMP::locate_on_halfedge<double>(h, 0.3, polyhedron));
  polyline.push_back(PMP::locate_on_halfedge<double>(next(h, polyhedron), 0.6, polyhedron));
  const auto report = BS::cut_along_polylines(polyhedron, std::vector<decltype(polyline)>{ polyline });
  CHECK(report);
  CHECK(report.cut_facets == 3);
  CHECK(polyhedron.is_valid());
  CHECK(num_faces(polyhedron) == before.number_of_faces() + 4);
  CHECK(PMP::area(polyhedron) == Approx(PMP::area(before)));

  Mesh mesh = before;
  auto points = mesh.add_property_map<Mesh::Vertex_index, Point_3>("v:other").first;
  for(auto v : mesh.vertices()) points[v] = mesh.point(v);
  for(auto v : mesh.vertices()) mesh.point(v) = Point_3(0, 0, 0);
  const Polyline on_mesh = section(before, { 1, 2, 3.1 });
  CHECK(BS::cut_along_polylines(mesh, std::vector<Polyline>{ on_mesh }, P::vertex_point_map(points)));
  CHECK(PMP::area(mesh, CGAL::parameters::vertex_point_map(points)) == Approx(PMP::area(before)));
}

TEST_CASE("Cut: the image of a seam on a simplified mesh, certified")
{
  const Mesh source = sphere(3);
  const Shell shell = widened(CGAL::bspline_shell_3(sphere(2), P::resolution(12)), 0.08);
  Mesh target = source;
  REQUIRE(BS::simplify_in_shell(target, shell, P::stop(BS::Facet_count_stop_predicate(150))));
  target.collect_garbage();
  const Mesh before = target;
  std::vector<Polyline> polylines;
  {
    const BS::Shell_map_3<Shell, Mesh> map(shell, source, target);
    for(const Vector_3& normal : { Vector_3(1, 2, 3.1), Vector_3(-1, 0.3, 0.2) }) {
      const auto image = BS::map_polyline(map, section(source, normal), P::tolerance(1e-4));
      REQUIRE(image);
      polylines.push_back(locations(image)[0]);
    }
  }
  const Marks marks = new_marks(target);
  const auto report = BS::cut_along_polylines(target, polylines, shell, P::edge_is_constrained_map(marks));
  check_cut(before, target, report);
  CHECK(report.certificate.are_all_proved());
  CHECK(marked_length(target, marks) == Approx(length(before, polylines[0]) + length(before, polylines[1])));
  // Integral curves are rays up to the error of the fit, so images are nearly in the planes. No facet lies across.
  std::size_t ends = 0;
  for(auto v : target.vertices()) {
    std::size_t degree = 0;
    for(auto h : target.halfedges_around_target(target.halfedge(v))) degree += marks[target.edge(h)];
    CHECK(degree % 2 == 0);
    ends += degree == 4;
  }
  CHECK(ends == 2);
}

TEST_CASE("Cut: errors leave the mesh unchanged")
{
  const Mesh before = sphere(1);
  Mesh mesh = before;
  const Location p(Mesh::Face_index(5), { 0.2, 0.3, 0.5 });
  const auto cut = [&](const std::vector<Polyline>& polylines) {
    const auto report = BS::cut_along_polylines(mesh, polylines);
    CHECK_FALSE(report);
    CHECK(is_equal(mesh, before));
    CHECK(report.facets == before.number_of_faces());
    CHECK_FALSE(std::string(message(report.status)).empty());
    return report;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for(const std::array<double, 3>& w :
      { std::array<double, 3>{ 0.5, 0.6, 0.5 }, { -0.1, 0.6, 0.5 }, { nan, 0.5, 0.5 }, { 0, 0, 0 } }) {
    const auto report = cut({ { p }, { p, p, Location(p.first, w) } });
    CHECK(report.status == Status::INVALID_LOCATION);
    CHECK(report.polyline == 1);
    CHECK(report.vertex == 2);
  }
  CHECK(cut({ { Location(Mesh::null_face(), { 1, 0, 0 }) } }).status == Status::INVALID_LOCATION);
  const Location far(Mesh::Face_index(40), { 0.2, 0.3, 0.5 });
  const auto apart = cut({ { p, p, far } });
  CHECK(apart.status == Status::NO_COMMON_FACET);
  CHECK(apart.polyline == 0);
  CHECK(apart.vertex == 1);
  // Rounding moves the point to the diagonal, which is not split.
  Mesh flat = square();
  Location close = in_square(flat, 0.75, 0.25);
  for(std::size_t i = 0; i < 3; ++i) {
    const Point_3 p = flat.point(flat.source(BS::internal::halfedge_at_corner(flat, close.first, int(i))));
    close.second[i] = p.x() != p.y() ? 1e-18 : 0.5;
  }
  CHECK(BS::cut_along_polylines(flat, std::vector<Polyline>{ { close } }).status == Status::FACET_TURNS);
  CHECK(is_equal(flat, square()));

  Mesh quadrangles = box({ 0, 0, 0 }, { 1, 1, 1 }, false), none;
  CHECK(BS::cut_along_polylines(quadrangles, std::vector<Polyline>()).status == Status::NOT_TRIANGULATED);
  CHECK(BS::cut_along_polylines(none, std::vector<Polyline>()).status == Status::NOT_TRIANGULATED);
  CHECK(BS::cut_along_polylines(mesh, std::vector<Polyline>(), Shell()).status == Status::NO_SHELL);

  // The mesh is not in the shell.
  const Shell shell = CGAL::bspline_shell_3(sphere(1, 2), P::resolution(10));
  const Marks marks = new_marks(mesh);
  const auto outside = BS::cut_along_polylines(mesh, std::vector<Polyline>{ section(mesh, { 1, 2, 3.1 }) }, shell,
                                               P::edge_is_constrained_map(marks));
  CHECK(outside.status == Status::NOT_CERTIFIED);
  CHECK(outside.cut_edges == 0);
  CHECK(is_equal(mesh, before));
  CHECK(marked_length(mesh, marks) == 0);
}

} // namespace test_cut_along_polylines
