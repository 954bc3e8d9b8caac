// Shell_containment_3.h: the call operators of Polyhedral_envelope, with rigorous results.
#include "coefficient_functions.h"
#include "polynomial_fields.h"
#include "shell_reports.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_containment_3.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Random.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace test_Shell_containment_3 {
namespace {

namespace P = CGAL::Bspline_shells::parameters;
typedef CGAL::Bspline_shells::Shell_containment_3<> Containment;

const CGAL::Bspline_shell_3<>& shell()
{
  static const CGAL::Bspline_shell_3<> shell = CGAL::bspline_shell_3(sphere(1), P::resolution(12));
  return shell;
}

} // namespace

TEST_CASE("Containment: a point is contained if and only if bounded_side() places it in the shell")
{
  REQUIRE(shell());
  const Containment contains(shell());
  CHECK_FALSE(contains.is_empty());
  CGAL::Random random(7);
  std::size_t inside = 0;
  for(int n = 0; n < 3000; ++n) {
    const Point_3 p(random.get_double(-1.2, 1.2), random.get_double(-1.2, 1.2), random.get_double(-1.2, 1.2));
    const bool in = shell().bounded_side(p) != CGAL::ON_UNBOUNDED_SIDE;
    inside += in;
    CHECK(contains(p) == in);
  }
  CHECK(inside > 50);
  CHECK_FALSE(contains(Point_3(100, 0, 0)));
  CHECK_FALSE(contains(Point_3(0, 0, 0)));
}

TEST_CASE("Containment: a segment, triangle, mesh or soup is contained only if all its points are")
{
  const Containment contains(shell());
  const Mesh mesh = sphere(1);
  CHECK(contains(mesh));
  CHECK(contains(mesh, CGAL::parameters::vertex_point_map(mesh.points())));
  CHECK_FALSE(contains(sphere(1, 1.5)));
  CHECK_FALSE(contains(sphere(1, 0.5)));
  std::vector<Point_3> points;
  std::vector<std::array<std::size_t, 3> > triangles;
  for(auto v : mesh.vertices()) points.push_back(mesh.point(v));
  for(auto f : mesh.faces()) {
    std::array<std::size_t, 3> t;
    std::size_t n = 0;
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[n++] = std::size_t(v);
    triangles.push_back(t);
  }
  CHECK(contains(points, triangles));
  points[3] = Point_3(0, 0, 0);
  CHECK_FALSE(contains(points, triangles));
  for(auto e : mesh.edges()) CHECK(contains(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));

  // It is not enough that the ends or corners are in the shell.
  const auto v = *mesh.vertices().begin(), w = *(mesh.vertices().begin() + 5);
  const Point_3 &p = mesh.point(v), &q = mesh.point(w);
  REQUIRE(contains(p));
  REQUIRE(contains(q));
  CHECK_FALSE(contains(p, q));
  CHECK_FALSE(contains(p, q, CGAL::midpoint(p, q)));
  CGAL::Random random(3);
  std::size_t contained = 0, not_contained = 0;
  for(int n = 0; n < 300; ++n) {
    const auto f = *(mesh.faces().begin() + random.get_int(0, int(mesh.number_of_faces())));
    const double size = std::ldexp(0.06, -(n % 10));
    const auto shifted = [&](const Point_3& x) {
      return x + size * Vector_3(random.get_double(-1, 1), random.get_double(-1, 1), random.get_double(-1, 1));
    };
    const std::array<Point_3, 3> t = corners(mesh, f);
    const Point_3 a = shifted(t[0]), b = shifted(t[1]), c = shifted(t[2]);
    bool in = true;
    for(int i = 0; i <= 10; ++i)
      for(int j = 0; i + j <= 10; ++j)
        in = in && shell().bounded_side(a + i / 10. * (b - a) + j / 10. * (c - a)) != CGAL::ON_UNBOUNDED_SIDE;
    if(contains(a, b, c)) {
      ++contained;
      CHECK(in);
    } else ++not_contained;
    if(!in) CHECK_FALSE(contains(a, b, c));
  }
  CHECK(contained > 20);
  CHECK(not_contained > 20);
}

TEST_CASE("Containment: all points of a contained segment are contained, even if its cells hold another component")
{
  // The field is close to 4 (|x| - 0.8) (0.95 - |x|). The shell is at the inner sphere, but its leaves also contain
  // parts of the component at the outer one.
  namespace BS = CGAL::Bspline_shells;
  typedef BS::Hierarchical_bspline_field_3<> Field;
  constexpr double outer = 0.95;
  const Field field = radial_spline<Field>(12, 1. / 8, [](double r) { return 4 * (r - 0.8) * (outer - r) + 0.025; });
  const BS::Level_range levels{ -0.02, 0.008 };
  const Mesh mesh = sphere(3, 0.797);
  BS::Shell_certificate_3<Field> certificate(field, BS::Constant_threshold(levels.min),
                                             BS::Constant_threshold(levels.max));
  REQUIRE(certificate.verify(mesh));
  const std::vector<BS::Cover_box>& boxes = certificate.cover()->boxes();
  const CGAL::Bspline_shell_3<Field> without_cover(field, levels, cells_of_cover(boxes, field.number_of_cells()), {},
                                                   successful_report(2, certificate.report()));
  CGAL::Bspline_shell_3<Field> with_cover(without_cover);
  BS::internal::Shell_access::set_proved_cover(with_cover, boxes);

  const auto at = [&](double theta, double phi) {
    return Point_3(outer * std::cos(theta) * std::cos(phi), outer * std::sin(theta) * std::cos(phi),
                   outer * std::sin(phi));
  };
  std::size_t segments = 0;
  for(const auto* shell : { &without_cover, &std::as_const(with_cover) }) {
    const BS::Shell_containment_3<Field> contains(*shell);
    CHECK(contains(mesh));
    for(int a = 0; a < 100; ++a)
      for(int b = 0; b < 50; ++b) {
        const double theta = 1.57 * a / 100, phi = 1.5 * b / 50;
        const Point_3 p = at(theta, phi), q = at(theta + 0.05, phi);
        if(shell == &with_cover) CHECK_FALSE(contains(p)); // this component does not contain the mesh
        if(!contains(p, q)) continue;
        ++segments;
        CHECK(shell == &without_cover);
        for(double t : { 0., 0.2, 0.5, 0.9, 1. }) CHECK(contains(p + t * (q - p)));
      }
  }
  CHECK(segments > 10);
}

TEST_CASE("Containment: points on a level are contained, but segments and triangles on a level are not proved to be")
{
  namespace BS = CGAL::Bspline_shells;
  const auto without_cover = shell_of(uniform_field({ { 1, { 0, 0, 1 } } }), 0.25, 0.5);
  // The field has no critical point.
  auto report = without_cover.report();
  report.certificate.verdicts[std::size_t(BS::Claim::GRADIENT)] = BS::Verdict::PROVED;
  CGAL::Bspline_shell_3<Field> with_cover(without_cover.field(),
                                          { without_cover.inner_level(), without_cover.outer_level() },
                                          without_cover.shell_cells(), {}, report);
  BS::Shell_cover_3<Field> cover(with_cover.field(), with_cover.inner_threshold(), with_cover.outer_threshold());
  REQUIRE(cover.flood<CGAL::Sequential_tag>(Point_3(0.1, 0.1, 0.3), 0) == 0);
  BS::internal::Shell_access::set_proved_cover(with_cover, cover.boxes());
  for(const auto* shell : { &without_cover, &std::as_const(with_cover) }) {
    const BS::Shell_containment_3<Field> contains(*shell);
    for(double x : { -0.7, 0., 0.1, 0.5 }) {
      CHECK(contains(Point_3(x, 0.2, 0.25)));
      CHECK(contains(Point_3(x, 0.2, 0.5)));
      CHECK(contains(Point_3(x, 0.2, 0.3)));
      CHECK_FALSE(contains(Point_3(x, 0.2, std::nextafter(0.25, 0.))));
      CHECK_FALSE(contains(Point_3(x, 0.2, std::nextafter(0.5, 1.))));
      CHECK_FALSE(contains(Point_3(x, 0.2, 0.9)));
      CHECK(contains(Point_3(x, 0.2, 0.26), Point_3(x + 0.1, 0.3, 0.49)));
      for(double z : { 0.25, 0.5 }) {
        CHECK_FALSE(contains(Point_3(x, 0.2, z), Point_3(x + 0.1, 0.3, z)));
        CHECK_FALSE(contains(Point_3(x, 0.2, z), Point_3(x + 0.1, 0.3, z), Point_3(x, 0.3, 0.3)));
      }
    }
  }
}

TEST_CASE("Containment: an empty shell contains nothing")
{
  const CGAL::Bspline_shell_3<> none;
  const Containment contains(none);
  CHECK(contains.is_empty());
  CHECK_FALSE(contains(Point_3(0, 0, 0)));
  CHECK_FALSE(contains(Point_3(0, 0, 0), Point_3(1, 0, 0)));
  CHECK(contains.match(sphere(1)).verdict() == CGAL::Bspline_shells::Verdict::UNDECIDED);
}
} // namespace test_Shell_containment_3
