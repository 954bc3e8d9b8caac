// Shell_certificate_3.h, Shell_cover_3.h, critical_point.h, Thresholds.h: true claims are proved, planted faults are
// located, and no false claim is proved.
#include "exact_spline.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <set>
#include <vector>

namespace test_Shell_certificate_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef BS::Shell_certificate_3<Field> Certificate;
typedef BS::Constant_threshold Constant;
typedef BS::Certificate_witness Place;
using BS::Claim;
using BS::Verdict;

// Returns a field on all cells of a cube about the origin.
Field cube_field(int half_cells, double spacing)
{
  const double h = half_cells * spacing;
  std::vector<std::uint64_t> keys;
  for(int k = -half_cells; k < half_cells; ++k)
    for(int j = -half_cells; j < half_cells; ++j)
      for(int i = -half_cells; i < half_cells; ++i) keys.push_back(BS::Lattice_key::encode(i, j, k));
  return Field(BS::Cell_complex_3(BS::Lattice_3(CGAL::Bbox_3(-h, -h, -h, h, h, h), spacing), keys));
}

// Sets each coefficient by a function of the point at which its basis function is centered.
template <typename Function>
void set(Field& field, const Function& f)
{
  const double w = field.cells().lattice().spacing();
  Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
  for(std::size_t n = 0; n < field.number_of_coefficients(); ++n) {
    const auto& p = field.points(0).point(Field::Cell_index(n));
    x[Eigen::Index(n)] = f(p[0] * w, p[1] * w, p[2] * w);
  }
  field.set_coefficients(x);
}

// Returns a field close to |x|; its only critical point is the origin.
Field radial_field()
{
  Field field = cube_field(12, 1. / 8);
  set(field, [](double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); });
  return field;
}

// Returns a x^2 + b y^2 + c z^2, exactly, with cells of width one: the coefficients of x^2 are x^2 - 1/3.
Field quadratic_field(double a, double b, double c)
{
  Field field = cube_field(4, 1);
  set(field, [=](double x, double y, double z) { return a * x * x + b * y * y + c * z * z - (a + b + c) / 3; });
  return field;
}

// Returns a double pyramid over a star pentagon. The surface covers each direction twice.
Mesh pentagram_bipyramid()
{
  Mesh mesh;
  const auto north = mesh.add_vertex(Point_3(0, 0, 1)), south = mesh.add_vertex(Point_3(0, 0, -1));
  std::vector<Mesh::Vertex_index> link;
  for(int n : { 0, 2, 4, 1, 3 }) {
    const double angle = 2 * CGAL_PI * n / 5;
    link.push_back(mesh.add_vertex(Point_3(std::cos(angle), std::sin(angle), 0)));
  }
  for(int n = 0; n < 5; ++n) {
    mesh.add_face(link[n], link[(n + 1) % 5], north);
    mesh.add_face(link[(n + 1) % 5], link[n], south);
  }
  return mesh;
}

Certificate certify(const Field& field, double inner, double outer, const Mesh& mesh)
{
  Certificate certificate(field, Constant(inner), Constant(outer));
  certificate.verify<CGAL::Sequential_tag>(mesh);
  return certificate;
}

// Returns whether the cover of a point's component contains another point, if boxes with critical points beyond a
// threshold are not subdivided.
bool whole_cells_join(const Field& field, double inner, double outer, const Point_3& p, const Point_3& q)
{
  BS::Shell_cover_3<Field> cover(field, Constant(inner), Constant(outer), 0);
  const std::uint32_t component = cover.flood<CGAL::Sequential_tag>(p, 0);
  return cover.component(q) == component;
}

std::vector<Verdict> verdicts(const Certificate& certificate)
{
  std::vector<Verdict> v;
  for(int c = 0; c < 5; ++c) v.push_back(certificate.verdict(Claim(c)));
  return v;
}

const std::vector<Verdict> all_proved(5, Verdict::PROVED);

std::set<std::size_t> facets_named(const Certificate& certificate, Claim claim)
{
  std::set<std::size_t> facets;
  for(const Place& w : certificate.witnesses())
    if(w.claim == claim && w.facet != Place::none) facets.insert(w.facet);
  return facets;
}

std::set<std::size_t> facets_at(const Mesh& mesh, Mesh::Vertex_index v)
{
  std::set<std::size_t> facets;
  for(auto f : mesh.faces_around_target(mesh.halfedge(v))) facets.insert(std::size_t(f));
  return facets;
}

} // namespace

TEST_CASE("Certificate: the shell of a sphere is certified, and reported bounds hold")
{
  const Mesh mesh = sphere(2);
  const CGAL::Bspline_shell_3<> shell = CGAL::bspline_shell_3(mesh, P::resolution(16));
  REQUIRE(shell);
  Certificate certificate(shell);
  CHECK_FALSE(certificate); // nothing has been verified yet
  for(int c = 0; c < 5; ++c) CHECK(certificate.verdict(Claim(c)) == Verdict::UNDECIDED);
  REQUIRE(certificate.verify(mesh));
  CHECK(certificate);
  CHECK(verdicts(certificate) == all_proved);
  CHECK(certificate.witnesses().empty());
  CHECK(certificate.number_of_covers() == 1);
  REQUIRE(certificate.paths().size() == 1);
  CHECK(certificate.singular_vertices().empty());

  // Bounds are compared with samples.
  double least = 1e9, greatest = 0, least_angle = 1e9;
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Point_3 &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h)),
                  &r = mesh.point(mesh.target(mesh.next(h)));
    const Vector_3 n = CGAL::cross_product(q - p, r - p);
    for(const Point_3& s : { p, q, r, CGAL::centroid(p, q, r) }) {
      const Vector_3 g = shell.field().gradient(s).value();
      const double length = std::sqrt(g.squared_length());
      least = (std::min)(least, length);
      greatest = (std::max)(greatest, length);
      least_angle = (std::min)(least_angle, std::asin(n * g / length / std::sqrt(n.squared_length())));
      CHECK(certificate.facets()[std::size_t(f)].slope <= n * g / std::sqrt(n.squared_length()) + 1e-12);
    }
  }
  CHECK(certificate.least_gradient() > 0.5 * least);
  CHECK(certificate.least_gradient() <= least);
  CHECK(certificate.report().largest_gradient < 2 * greatest);
  CHECK(certificate.report().largest_gradient >= greatest);
  CHECK(certificate.least_angle() > 0.5 * least_angle);
  CHECK(certificate.least_angle() <= least_angle);
  CHECK(certificate.displacement_bound() >= shell.thickness() / least);
  CHECK(certificate.displacement_bound() <= 2 * shell.thickness() / least);

  // Integral curves through the middles of facets are traced in small steps. Their lengths must not exceed the bounds.
  const std::vector<double> displacements = certificate.displacement_bounds();
  REQUIRE(displacements.size() == mesh.number_of_faces());
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    double length = 0;
    for(double sign : { -1., 1. }) {
      Point_3 p = CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                 mesh.point(mesh.target(mesh.next(h))));
      const double step = shell.thickness() / 100;
      while(shell.bounded_side(p) == CGAL::ON_BOUNDED_SIDE) {
        const Vector_3 g = shell.field().gradient(p).value();
        p = p + sign * step / std::sqrt(g.squared_length()) * g;
        length += step;
      }
      length -= step;
    }
    CHECK(displacements[std::size_t(f)] >= length);
    CHECK(displacements[std::size_t(f)] <= certificate.displacement_bound());
  }

  // The sphere is turned about the z-axis, and remains in the shell.
  Mesh turned = mesh;
  const double c = std::cos(0.3), s = std::sin(0.3);
  for(auto v : turned.vertices()) {
    const Point_3 p = turned.point(v);
    turned.point(v) = Point_3(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
  }
  Certificate other(shell.field(), Constant(shell.inner_level() - 0.02), Constant(shell.outer_level() + 0.02));
  CHECK(other.verify(turned));
  CHECK(other.verify(mesh));
}

TEST_CASE(
  "Certificate: bounds hold in the whole shell, even if the field is steeper and the shell thicker in some parts",
  "[slow]")
{
  const Mesh mesh = sphere(2);
  // The field is ten times as steep above as below.
  Field field = radial_field();
  set(field, [](double x, double y, double z) {
    const double t = (std::min)((std::max)(z / 0.8, 0.), 1.);
    return std::sqrt(x * x + y * y + z * z) * (1 + 9 * t * t * (3 - 2 * t));
  });
  const Certificate certificate = certify(field, 0.5, 12, mesh);
  REQUIRE(certificate.verdict(Claim::TRANSVERSALITY) == Verdict::PROVED);
  double least_angle = 10;
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Point_3 &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h)),
                  &r = mesh.point(mesh.target(mesh.next(h)));
    const Vector_3 n = CGAL::cross_product(q - p, r - p), g = *field.gradient(CGAL::centroid(p, q, r));
    least_angle = (std::min)(least_angle, std::asin(n * g / std::sqrt(n.squared_length() * g.squared_length())));
  }
  CHECK(certificate.least_angle() > 0);
  CHECK(certificate.least_angle() <= least_angle);

  // The shell is thick above and thin below: the integral curve upwards is 0.606 long.
  typedef BS::Spline_threshold<Field> Varying;
  const Field round = radial_field();
  Field inner = round, outer = round;
  set(inner, [](double, double, double z) { return 0.8 - 0.1 * z; });
  set(outer, [](double, double, double z) { return 1.2 + 0.1 * z; });
  BS::Shell_certificate_3<Field, Varying> varying(round, Varying(inner), Varying(outer));
  REQUIRE(varying.verify<CGAL::Sequential_tag>(mesh));
  CHECK(varying.displacement_bound() >= 0.6);
}

TEST_CASE("Certificate: adjacent and nested mesh components have separate shell components")
{
  Mesh mesh = sphere(2);
  Mesh hole = sphere(2, 0.4);
  CGAL::Polygon_mesh_processing::reverse_face_orientations(hole);
  CGAL::copy_face_graph(hole, mesh);
  CGAL::copy_face_graph(sphere(2, 0.5, Point_3(2, 0, 0)), mesh);
  const CGAL::Bspline_shell_3<> shell = CGAL::bspline_shell_3(mesh, P::resolution(24));
  REQUIRE(shell);
  Certificate certificate(shell);
  CHECK(certificate.verify(mesh));
  CHECK(certificate.number_of_covers() == 3);
  CHECK(certificate.paths().size() == 3);
}

TEST_CASE("Certificate: a fan that winds twice is detected as a double cover, although all facets face the gradient")
{
  const Mesh mesh = pentagram_bipyramid();
  const Field field = radial_field();
  const Certificate certificate = certify(field, 0.28, 1.1, mesh);
  CHECK(
    verdicts(certificate)
    == std::vector<Verdict>{ Verdict::PROVED, Verdict::PROVED, Verdict::PROVED, Verdict::PROVED, Verdict::REFUTED });
  REQUIRE(certificate.witnesses().size() == 1);
  CHECK(certificate.witnesses()[0].reason == Place::CROSSINGS);
  CHECK(certificate.witnesses()[0].count == 2);
  CHECK_FALSE(certificate);
}

TEST_CASE("Certificate: an inverted facet is refuted and reported")
{
  Mesh mesh = sphere(2);
  const auto v = *mesh.vertices().begin();
  // Moves the vertex across the opposite edge of one of its facets, along the sphere.
  const auto h = mesh.halfedge(v);
  const Point_3 &q = mesh.point(mesh.source(h)), &r = mesh.point(mesh.target(mesh.next(h)));
  const Vector_3 over = CGAL::midpoint(q, r) + 0.5 * (CGAL::midpoint(q, r) - mesh.point(v)) - CGAL::ORIGIN;
  mesh.point(v) = CGAL::ORIGIN + over / std::sqrt(over.squared_length());
  const Field field = radial_field();
  const Certificate certificate = certify(field, 0.8, 1.2, mesh);
  CHECK(certificate.verdict(Claim::CONTAINMENT) == Verdict::PROVED);
  CHECK(certificate.verdict(Claim::TRANSVERSALITY) == Verdict::REFUTED);
  CHECK(certificate.verdict(Claim::GRADIENT) == Verdict::PROVED);
  const std::set<std::size_t> named = facets_named(certificate, Claim::TRANSVERSALITY), at_v = facets_at(mesh, v);
  CHECK(named.count(std::size_t(mesh.face(h))) == 1);
  CHECK(std::includes(at_v.begin(), at_v.end(), named.begin(), named.end()));
  for(const Place& w : certificate.witnesses())
    if(w.verdict == Verdict::REFUTED && w.claim == Claim::TRANSVERSALITY) CHECK(w.value.max <= 0);
  CHECK(certificate.facets()[std::size_t(mesh.face(h))].transversality == Verdict::REFUTED);
  CHECK(certificate.least_angle() == 0);
}

TEST_CASE("Certificate: nested sheets in one shell component are refuted, and so is the claim of degree one")
{
  Mesh mesh = sphere(2, 0.9);
  CGAL::copy_face_graph(sphere(2, 1.1), mesh);
  const Field field = radial_field();
  const Certificate certificate = certify(field, 0.8, 1.2, mesh);
  CHECK(
    verdicts(certificate)
    == std::vector<Verdict>{ Verdict::PROVED, Verdict::PROVED, Verdict::PROVED, Verdict::REFUTED, Verdict::REFUTED });
  for(const Place& w : certificate.witnesses()) {
    if(w.claim == Claim::ONE_SHEET) {
      CHECK(w.reason == Place::TWO_SHEETS);
      CHECK(w.component == 0);
      CHECK(w.other_component == 1);
    } else CHECK(w.count == 2);
  }
}

TEST_CASE("Certificate: any crossing count other than one is refuted, even if it is odd")
{
  Mesh mesh = sphere(2, 0.9);
  for(double radius : { 1., 1.1 }) CGAL::copy_face_graph(sphere(2, radius), mesh);
  const Certificate certificate = certify(radial_field(), 0.8, 1.2, mesh);
  CHECK(certificate.verdict(Claim::DEGREE_ONE) == Verdict::REFUTED);
  CHECK(certificate.paths().empty());
  for(const Place& w : certificate.witnesses())
    if(w.claim == Claim::DEGREE_ONE) CHECK(w.count == 3);
}

TEST_CASE("Certificate: if critical points are possible, the crossing count of one path refutes nothing")
{
  // The field has a dent between the thresholds, away from the mesh.
  Field field = radial_field();
  Eigen::VectorXd x = field.coefficients();
  x[field.points(0).index(5, 5, 5)] -= 0.5;
  field.set_coefficients(x);
  const Certificate certificate = certify(field, 0.28, 1.1, pentagram_bipyramid());
  CHECK(certificate.verdict(Claim::CONTAINMENT) == Verdict::PROVED);
  CHECK(certificate.verdict(Claim::TRANSVERSALITY) == Verdict::PROVED);
  CHECK(certificate.verdict(Claim::GRADIENT) != Verdict::PROVED);
  CHECK(certificate.verdict(Claim::DEGREE_ONE) == Verdict::UNDECIDED);
  int said = 0;
  for(const Place& w : certificate.witnesses()) {
    if(w.claim != Claim::DEGREE_ONE) continue;
    ++said;
    CHECK(w.verdict == Verdict::UNDECIDED);
    CHECK(w.reason == Place::NO_PATH);
    CHECK(w.component == 0);
    CHECK(w.facet != Place::none);
  }
  CHECK(said == 1);
}

TEST_CASE("Certificate: a critical point refutes the claim in the shell, prevents a proof on its boundary, and is "
          "harmless beyond")
{
  // |x - c|^2, exactly; c is not a corner of any box
  const Point_3 c(0.31, -0.13, 0.17);
  Field field = cube_field(4, 1);
  set(field, [&](double x, double y, double z) {
    return (x - c.x()) * (x - c.x()) + (y - c.y()) * (y - c.y()) + (z - c.z()) * (z - c.z()) - 1;
  });
  const Mesh mesh = sphere(2, 2, c);
  const double highest = 4.001, lowest = 3;
  REQUIRE(certify(field, lowest, highest, mesh));
  CHECK(certify(field, 0.01, highest, mesh).verdict(Claim::GRADIENT) == Verdict::PROVED);
  const double lowest_value = field.value(c).value(); // zero up to rounding
  REQUIRE(std::abs(lowest_value) < 1e-14);
  for(double inner : { -0.5, lowest_value }) {
    CAPTURE(inner);
    const Certificate certificate = certify(field, inner, highest, mesh);
    CHECK(certificate.verdict(Claim::CONTAINMENT) == Verdict::PROVED);
    CHECK(certificate.verdict(Claim::GRADIENT) == (inner < -0.1 ? Verdict::REFUTED : Verdict::UNDECIDED));
    CHECK(certificate.least_gradient() == 0);
    CHECK(certificate.displacement_bound() == std::numeric_limits<double>::infinity());
    bool named = false;
    for(const Place& w : certificate.witnesses())
      if(w.claim == Claim::GRADIENT && w.verdict == certificate.verdict(Claim::GRADIENT))
        named = named
                || std::abs(w.point[0] - c.x()) + std::abs(w.point[1] - c.y()) + std::abs(w.point[2] - c.z()) < 0.05;
    CHECK(named);
  }
  // At a corner of cells, the field is not a polynomial in any neighborhood. The critical point is found, but not
  // proved.
  CHECK(certify(quadratic_field(1, 1, 1), -0.5, highest, sphere(2, 2)).verdict(Claim::GRADIENT) == Verdict::UNDECIDED);
}

TEST_CASE("Certificate: a critical point outside the shell refutes nothing, however close it is")
{
  // f = A(x) + ((y - 0.31)^2 + (z + 0.13)^2) / 10. A'' is bend + |x| up to |x| = 1, and 1 + bend beyond. The
  // function is convex, so its only critical point is its minimum, at x = c. Across the box of the cover that contains
  // it, A'' changes by a factor. So Newton's method with the second derivatives at the middle of the box ends visibly
  // far from the minimum.
  constexpr double c = 0.05 / 128, bend = 1.6e-4, slope = -(bend + c / 2) * c; // A'(0) = slope
  Field field = cube_field(4, 1);
  set(field, [=](double x, double y, double z) {
    return (1 + bend) / 2 * x * x - std::abs(x) / 2 + slope * x + (std::pow(y - 0.31, 2) + std::pow(z + 0.13, 2)) / 10
           - 1. / 15;
  });
  const Rational least = exact_value(field, exact(Point_3(c, 0.31, -0.13))); // the minimum is at most this
  const Mesh mesh = sphere(2, 1.5, Point_3(-0.3, 0.31, -0.13));
  for(int bit = 30; bit < 46; ++bit) {
    const double inner = CGAL::to_double(least) + std::ldexp(1., -bit);
    REQUIRE(Rational(inner) > least);
    const Certificate certificate = certify(field, inner, 1.2, mesh);
    CAPTURE(bit);
    REQUIRE(certificate.verdict(Claim::CONTAINMENT) == Verdict::PROVED);
    CHECK(certificate.verdict(Claim::GRADIENT) != Verdict::REFUTED);
  }
  // A critical point in the shell does refute the claim.
  CHECK(certify(field, CGAL::to_double(least) - 1e-3, 1.2, mesh).verdict(Claim::GRADIENT) == Verdict::REFUTED);
}

TEST_CASE("Certificate: a critical point in another shell component refutes nothing, even if one cover contains both")
{
  // two wells along x, with a saddle between them
  Field field = cube_field(8, 0.5);
  set(field, [](double x, double y, double z) {
    return std::pow(x * x - 1, 2) / 4 + 0.03 * x + std::pow(y - 0.31, 2) + std::pow(z + 0.13, 2);
  });
  const auto critical_point = [&](double x, double end) {
    const auto slope = [&](double t) { return field.gradient(Point_3(t, 0.31, -0.13))->x(); };
    const bool rises = slope(end) > 0;
    for(int n = 0; n < 60; ++n) (slope((x + end) / 2) > 0) == rises ? end = (x + end) / 2 : x = (x + end) / 2;
    return Point_3(x, 0.31, -0.13);
  };
  const Point_3 left = critical_point(-1.5, -0.7), saddle = critical_point(-0.5, 0.5), right = critical_point(0.7, 1.5);
  const double at_left = *field.value(left), at_saddle = *field.value(saddle), at_right = *field.value(right);
  REQUIRE(at_left < at_right - 0.05);
  REQUIRE(at_right < at_saddle - 0.05);
  const double inner = (at_left + at_right) / 2;
  const Mesh mesh = sphere(2, 0.3, left);
  // Slightly above the saddle, both wells are joined. Slightly below it, they are separate, and the left one has no
  // critical point between the thresholds.
  CHECK(certify(field, inner, at_saddle + 0.01, mesh).verdict(Claim::GRADIENT) == Verdict::REFUTED);
  const Certificate certificate = certify(field, inner, at_saddle - 1e-7, mesh);
  CHECK(certificate.verdict(Claim::CONTAINMENT) == Verdict::PROVED);
  CHECK(certificate.verdict(Claim::GRADIENT) == Verdict::UNDECIDED);
  // The cover contains both.
  REQUIRE(certificate.cover()->component(right) == 0);
  // Farther below the saddle, finer boxes separate the wells.
  const double outer = at_saddle - 0.09;
  CHECK(whole_cells_join(field, inner, outer, left, right));
  CHECK(certify(field, inner, outer, sphere(2, 0.25, left)));
}

TEST_CASE("Certificate: another shell component may reach the boundary of the domain, if boxes separate it")
{
  // a well and a saddle along x; beyond the saddle, the field decreases
  Field field = cube_field(8, 0.5);
  set(field, [](double x, double y, double z) {
    return (3 * x - x * x * x) / 4 + std::pow(y - 0.31, 2) + std::pow(z + 0.13, 2);
  });
  const Point_3 well(-1, 0.31, -0.13), beyond(2, 0.31, -0.13);
  CHECK(whole_cells_join(field, -0.2, 0.45, well, beyond));
  CHECK(certify(field, -0.2, 0.45, sphere(2, 0.5, well)));
}

TEST_CASE("Certificate: a saddle away from the lattice is proved to be a critical point")
{
  // x^2 + y^2 - z^2 plus linear terms; the saddle is not at a corner of any box
  Field field = cube_field(4, 1);
  set(field,
      [](double x, double y, double z) { return x * x + y * y - z * z - 1. / 3 - 0.62 * x + 0.26 * y + 0.34 * z; });
  BS::Shell_cover_3<Field> cover(field, Constant(-0.3), Constant(0.3));
  CHECK(cover.flood<CGAL::Sequential_tag>(Point_3(0.31, -0.13, 0.17), 0) == 0);
  std::size_t proved = 0;
  for(const BS::Cover_box& box : cover.boxes()) {
    if(box.component != 0 || box.kind != BS::Box_kind::UNDECIDED) continue;
    const auto critical = BS::prove_critical_point(cover.function(box));
    if(!critical) continue;
    ++proved;
    const CGAL::Bbox_3 b = cover.bbox(box);
    const double w = b.xmax() - b.xmin();
    CHECK(b.xmin() + critical->center[0] * w == Approx(0.31).epsilon(1e-9));
    CHECK(b.ymin() + critical->center[1] * w == Approx(-0.13).epsilon(1e-9));
    CHECK(b.zmin() + critical->center[2] * w == Approx(0.17).epsilon(1e-9));
  }
  CHECK(proved == 1);
  CHECK_FALSE(BS::prove_critical_point(BS::enclosed_value(field.cell(field.locate(Point_3(3.5, 3.5, 3.5))))));
}

TEST_CASE("Certificate: a shell that reaches the boundary of the domain is not proved to be in its interior")
{
  const Field field = radial_field(); // the domain extends to 1.5 along the axes
  const Mesh mesh = sphere(2);
  CHECK(certify(field, 0.9, 1.45, mesh));
  const Certificate certificate = certify(field, 0.9, 1.55, mesh);
  CHECK(certificate.verdict(Claim::GRADIENT) == Verdict::UNDECIDED);
  REQUIRE_FALSE(certificate.witnesses().empty());
  for(const Place& w : certificate.witnesses()) {
    CHECK(w.reason == Place::BOUNDARY_OF_DOMAIN);
    CHECK((std::max)({ std::abs(w.point[0]), std::abs(w.point[1]), std::abs(w.point[2]) }) > 1.3);
  }
}

TEST_CASE("Certificate: a vertex that sticks out by 1e-12 is refuted, and so is a mesh outside the shell")
{
  const Field field = radial_field();
  Mesh mesh = sphere(2);
  const auto v = *(mesh.vertices().begin() + 20);
  mesh.point(v) = CGAL::ORIGIN + 1.05 * (mesh.point(v) - CGAL::ORIGIN);
  const double highest = field.value(mesh.point(v)).value();
  CHECK(certify(field, 0.8, highest + 1e-12, mesh).verdict(Claim::CONTAINMENT) == Verdict::PROVED);
  const Certificate certificate = certify(field, 0.8, highest - 1e-12, mesh);
  CHECK(verdicts(certificate)
        == std::vector<Verdict>{ Verdict::REFUTED, Verdict::PROVED, Verdict::UNDECIDED, Verdict::UNDECIDED,
                                 Verdict::UNDECIDED });
  CHECK(facets_named(certificate, Claim::CONTAINMENT) == facets_at(mesh, v));
  for(const Place& w : certificate.witnesses())
    if(w.claim != Claim::CONTAINMENT) CHECK(w.reason == Place::CONTAINMENT_NOT_PROVED);

  for(const Point_3& center : { Point_3(0, 0, 20), Point_3(1, 0, 0) }) {
    const Certificate elsewhere = certify(field, 0.8, 1.2, sphere(1, 1, center));
    CHECK(elsewhere.verdict(Claim::CONTAINMENT) == Verdict::REFUTED);
    CHECK_FALSE(elsewhere);
    // Points are reported as outside only beyond the boundary of the domain, 1.5 from the origin.
    int outside = 0, inside = 0;
    for(const Place& w : elsewhere.witnesses()) {
      if(w.claim != Claim::CONTAINMENT) continue;
      const double far = (std::max)({ std::abs(w.point[0]), std::abs(w.point[1]), std::abs(w.point[2]) });
      CHECK((w.reason == Place::OUTSIDE || w.reason == Place::FACET));
      if(w.reason == Place::OUTSIDE) {
        ++outside;
        CHECK(far > 1.5);
      } else {
        ++inside;
        CHECK(far <= 1.5);
      }
    }
    CHECK(outside > 0);
    CHECK((inside > 0) == (center.z() == 0));
  }
}

TEST_CASE("Certificate: meshes with facets in lattice planes, and meshes far from the origin, are certified")
{
  // The sides of a cube are in lattice planes. Far from any critical point, the field is exactly |x|^2.
  const Field field = quadratic_field(1, 1, 1);
  CHECK(certify(field, 0.9, 3.1, box(Point_3(-1, -1, -1), Point_3(1, 1, 1))));

  Mesh mesh = sphere(2);
  for(auto v : mesh.vertices()) mesh.point(v) = mesh.point(v) + Vector_3(1e6, -1e6, 1e6);
  const CGAL::Bspline_shell_3<> shell = CGAL::bspline_shell_3(mesh, P::resolution(16));
  REQUIRE(shell);
  Certificate certificate(shell);
  CHECK(certificate.verify(mesh));
}

TEST_CASE("Certificate: a needle of width 1e-12 is classified by its exact normal")
{
  Mesh mesh = sphere(2);
  // A facet is split at a point 1e-12 from one of its edges, into two facets and a needle.
  const auto f = *mesh.faces().begin();
  const auto h = mesh.halfedge(f);
  const Point_3 &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h)),
                &r = mesh.point(mesh.target(mesh.next(h)));
  const Point_3 inside = CGAL::midpoint(p, q) + 1e-12 * (r - CGAL::midpoint(p, q));
  const auto center = mesh.target(CGAL::Euler::add_center_vertex(h, mesh));
  mesh.point(center) = inside;
  const Field field = radial_field();
  const Certificate certificate = certify(field, 0.8, 1.2, mesh);
  // Rounding has moved the point by 1e-16, so the needle may have any normal. The verdict must follow the exact normal.
  for(auto face : mesh.faces()) {
    const auto g = mesh.halfedge(face);
    const Point_3 &a = mesh.point(mesh.source(g)), &b = mesh.point(mesh.target(g)),
                  &c = mesh.point(mesh.target(mesh.next(g)));
    const bool faces_out = CGAL::orientation(a, b, c, Point_3(0, 0, 0)) == CGAL::NEGATIVE;
    if(!faces_out) CHECK(certificate.facets()[std::size_t(face)].transversality != Verdict::PROVED);
  }
  CHECK(certificate.verdict(Claim::CONTAINMENT) == Verdict::PROVED);
}

TEST_CASE("Certificate: nothing is proved for a field on an inexact lattice")
{
  const auto field_on = [](double spacing) {
    const BS::Lattice_3::Point first = { -12, -12, -12 }, last = { 11, 11, 11 };
    const BS::Lattice_3 lattice = BS::Lattice_3::from_origin({ spacing, spacing, spacing }, spacing, first, last);
    std::vector<std::uint64_t> keys;
    for(int k = -12; k < 12; ++k)
      for(int j = -12; j < 12; ++j)
        for(int i = -12; i < 12; ++i) keys.push_back(BS::Lattice_key::encode(i, j, k));
    Field field(BS::Cell_complex_3(lattice, keys));
    set(field, [&](double x, double y, double z) {
      return std::sqrt(std::pow(x + spacing, 2) + std::pow(y + spacing, 2) + std::pow(z + spacing, 2));
    });
    return field;
  };
  const Field inexact = field_on(0.1), exact = field_on(0.125);
  REQUIRE_FALSE(inexact.has_exact_cells());
  REQUIRE(exact.has_exact_cells());
  const Certificate refused = certify(inexact, 0.75, 1.05, sphere(2, 0.9));
  CHECK(refused.status() == BS::Shell_status::GRID_TOO_FINE);
  CHECK_FALSE(refused);
  for(int c = 0; c < 5; ++c) CHECK(refused.verdict(Claim(c)) == Verdict::UNDECIDED);
  CHECK(certify(exact, 0.75, 1.05, sphere(2, 0.9)));
}

TEST_CASE("Certificate: a coefficient that is not finite, in the field or in a threshold, prevents certification",
          "[slow]")
{
  typedef BS::Spline_threshold<Field> Varying;
  const Mesh mesh = sphere(2);
  const Field field = radial_field();
  Field constant_inner = field, constant_outer = field;
  set(constant_inner, [](double, double, double) { return 0.85; });
  set(constant_outer, [](double, double, double) { return 1.15; });
  const auto with = [](Field f, const BS::Lattice_3::Point& p, double bad) {
    Eigen::VectorXd x = f.coefficients();
    x[f.points(0).index(p)] = bad;
    f.set_coefficients(x);
    return f;
  };
  const auto certified = [&](const Field& f, const Field& inner, const Field& outer) {
    BS::Shell_certificate_3<Field, Varying> certificate(f, Varying(inner), Varying(outer));
    certificate.verify<CGAL::Sequential_tag>(mesh);
    for(const Place& w : certificate.witnesses()) CHECK(w.verdict == Verdict::UNDECIDED);
    if(!certificate) CHECK(certificate.verdict(Claim::GRADIENT) == Verdict::UNDECIDED);
    return certificate.is_certified();
  };
  REQUIRE(certified(field, constant_inner, constant_outer));
  const double not_a_number = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  // the bad coefficient is in the shell, but away from the mesh
  const std::vector<std::pair<BS::Lattice_3::Point, double> > cases = { { { 0, 0, 11 }, not_a_number },
                                                                        { { -10, 0, 5 }, infinity },
                                                                        { { 0, -5, 0 }, not_a_number } };
  for(const auto& [p, bad] : cases) {
    CAPTURE(bad, p[0], p[1], p[2]);
    CHECK_FALSE(certified(field, constant_inner, with(constant_outer, p, bad)));
    CHECK_FALSE(certified(field, with(constant_inner, p, bad), constant_outer));
    CHECK_FALSE(certified(with(field, p, bad), constant_inner, constant_outer));
    const Certificate certificate = certify(with(field, p, bad), 0.85, 1.15, mesh);
    CHECK_FALSE(certificate);
    CHECK(certificate.verdict(Claim::CONTAINMENT) == Verdict::PROVED);
    CHECK(certificate.verdict(Claim::GRADIENT) == Verdict::UNDECIDED);
    CHECK(certificate.least_gradient() == 0);
  }
  // On the mesh, exactly the facets in the support of the basis function are undecided.
  const BS::Lattice_3::Point p = { 0, 0, 8 };
  const Certificate certificate = certify(with(field, p, not_a_number), 0.85, 1.15, mesh);
  CHECK_FALSE(certificate);
  std::size_t undecided = 0;
  for(auto f : mesh.faces()) {
    CGAL::Bbox_3 b;
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) b += mesh.point(v).bbox();
    const bool near = b.xmin() < 0.25 && b.xmax() > -0.25 && b.ymin() < 0.25 && b.ymax() > -0.25 && b.zmax() > 0.75;
    const Certificate::Facet_verdict& verdict = certificate.facets()[std::size_t(f)];
    if(!near) CHECK((verdict.containment == Verdict::PROVED && verdict.transversality == Verdict::PROVED));
    undecided += verdict.containment == Verdict::UNDECIDED && verdict.transversality == Verdict::UNDECIDED;
  }
  CHECK(undecided > 0);
}

TEST_CASE("Certificate: an open or empty mesh has a status, and no claim is proved")
{
  Mesh open = sphere(1);
  CGAL::Euler::remove_face(open.halfedge(*open.faces().begin()), open);
  const Field field = radial_field();
  const Certificate certificate = certify(field, 0.8, 1.2, open);
  CHECK(certificate.status() == BS::Shell_status::OPEN_MESH);
  CHECK(certificate.offending_simplices().facets.size() == 3);
  for(int c = 0; c < 5; ++c) CHECK(certificate.verdict(Claim(c)) == Verdict::UNDECIDED);
  CHECK(certify(field, 0.8, 1.2, Mesh()).status() == BS::Shell_status::EMPTY_MESH);
}

TEST_CASE("Varying thresholds: constant thresholds prove the same as levels, and nothing is proved for thresholds that "
          "are too steep")
{
  typedef BS::Spline_threshold<Field> Varying;
  const Field field = radial_field();
  const Mesh mesh = sphere(2);
  const auto threshold = [&](const auto& f) {
    Field values = field;
    set(values, f);
    return values;
  };
  const auto certify_between = [&](const Field& inner, const Field& outer, const Mesh& mesh) {
    BS::Shell_certificate_3<Field, Varying> certificate(field, Varying(inner), Varying(outer));
    certificate.template verify<CGAL::Sequential_tag>(mesh);
    return certificate;
  };
  const auto constant = [](double c) { return [c](double, double, double) { return c; }; };
  const auto certificate = certify_between(threshold(constant(0.85)), threshold(constant(1.15)), mesh);
  CHECK(certificate);
  CHECK(certificate.displacement_bound()
        == Approx(certify(field, 0.85, 1.15, mesh).displacement_bound()).epsilon(0.05));

  // The shell is thin above and thick below. Thresholds are never as steep as the field.
  const Field inner = threshold([](double, double, double z) { return 0.8 + 0.1 * z; }),
              outer = threshold([](double, double, double z) { return 1.2 - 0.1 * z; });
  CHECK(certify_between(inner, outer, mesh));
  // The mesh does not fit into the thin part.
  const auto refuted = certify_between(inner, outer, sphere(2, 1.15));
  CHECK_FALSE(refuted);
  CHECK(refuted.verdict(Claim::CONTAINMENT) == Verdict::REFUTED);

  // The threshold falls as the field rises. So the shell is close to that of constant thresholds: it has no critical
  // point, and is inside the domain. A threshold less steep than the field is proved to be crossed; a steeper one is
  // not.
  const auto falling = [&](double level, double steepness) {
    return threshold(
      [=](double x, double y, double z) { return level - steepness * (std::sqrt(x * x + y * y + z * z) - level); });
  };
  for(double steepness : { 0.5, 1.5 }) {
    CAPTURE(steepness);
    const bool is_crossed = steepness < 1;
    CHECK((certify_between(falling(0.85, steepness), threshold(constant(1.2)), mesh).verdict(Claim::GRADIENT)
           == Verdict::PROVED)
          == is_crossed);
    CHECK((certify_between(threshold(constant(0.85)), falling(1.2, steepness), mesh).verdict(Claim::GRADIENT)
           == Verdict::PROVED)
          == is_crossed);
  }
}

TEST_CASE("Varying thresholds: an overhang of either threshold is not certified")
{
  typedef BS::Spline_threshold<Field> Varying;
  const Field field = radial_field();
  const Mesh mesh = sphere(2);
  // The inner threshold has a dent, or the outer one has a bump, beside the sphere.
  const auto dented = [&](double level, const BS::Lattice_3::Point& p, double height) {
    Field values = field;
    set(values, [=](double, double, double) { return level; });
    Eigen::VectorXd x = values.coefficients();
    x[values.points(0).index(p)] += height;
    values.set_coefficients(x);
    return values;
  };
  // Returns the least value of grad f . grad(f - threshold) where the field is near the threshold, around a point.
  const auto least_crossing = [&](const Field& threshold, const Point_3& near) {
    double least = 1e9;
    const int parts = 60;
    for(int i = -parts; i <= parts; ++i)
      for(int j = -parts; j <= parts; ++j)
        for(int k = -parts; k <= parts; ++k) {
          const Point_3 p = near + 0.3 / parts * Vector_3(i, j, k);
          const auto f = field.value(p), t = threshold.value(p);
          if(!f || !(std::abs(*f - *t) < 0.002)) continue;
          const Vector_3 g = *field.gradient(p);
          least = (std::min)(least, g * (g - *threshold.gradient(p)));
        }
    return least;
  };
  const BS::Lattice_3::Point below = { 0, 3, 4 }, above = { 0, 6, 9 };
  for(bool is_inner : { true, false })
    for(double height : { 0.3, 3. }) {
      CAPTURE(is_inner, height);
      const Field inner = dented(0.85, below, is_inner ? -height : 0),
                  outer = dented(1.15, above, is_inner ? 0 : height);
      BS::Shell_certificate_3<Field, Varying> certificate(field, Varying(inner), Varying(outer));
      certificate.verify<CGAL::Sequential_tag>(mesh);
      const double least = is_inner ? least_crossing(inner, Point_3(0, 3. / 8, 4. / 8))
                                    : least_crossing(outer, Point_3(0, 6. / 8, 9. / 8));
      if(height < 1) {
        CHECK(least > 0);
        CHECK(certificate);
      } else {
        CHECK(least < -0.01);
        CHECK(certificate.verdict(Claim::CONTAINMENT) == Verdict::PROVED);
        CHECK(certificate.verdict(Claim::GRADIENT) != Verdict::PROVED);
        for(const Place& w : certificate.witnesses())
          if(w.claim == Claim::GRADIENT) CHECK(w.reason == Place::BOX);
      }
    }
}

namespace {

// Returns whether a path crosses a mesh exactly once, counted with signs, and through the reported facet. Paths through
// edges are rejected.
bool crosses_once(const BS::Crossing_path& path, const BS::Input_mesh_3::Triangle_mesh& mesh)
{
  const Point_3 p(path.source[0], path.source[1], path.source[2]), q(path.target[0], path.target[1], path.target[2]);
  int count = 0;
  bool crosses_facet = false;
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Point_3 &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
                  &c = mesh.point(mesh.target(mesh.next(h)));
    const CGAL::Orientation at_p = CGAL::orientation(a, b, c, p), at_q = CGAL::orientation(a, b, c, q);
    const CGAL::Orientation ab = CGAL::orientation(p, q, a, b), bc = CGAL::orientation(p, q, b, c),
                            ca = CGAL::orientation(p, q, c, a);
    if(at_p * at_q > 0 || ab * bc < 0 || bc * ca < 0 || ca * ab < 0) continue;
    if(at_p * at_q * ab * bc * ca == 0) return false;
    count += at_q == CGAL::POSITIVE ? 1 : -1;
    crosses_facet = crosses_facet || std::size_t(f) == path.triangle;
  }
  return count == 1 && crosses_facet;
}

// Returns whether a path proves the degree. It must begin below the inner threshold, end above the outer one, and cross
// the mesh once. It must rise above both thresholds all the way, so that its part between them is in one component.
template <typename Inner, typename Outer>
bool proves_degree(const BS::Crossing_path& path, const Field& field, const Inner& inner, const Outer& outer,
                   const BS::Input_mesh_3::Triangle_mesh& mesh)
{
  const Point_3 p(path.source[0], path.source[1], path.source[2]), q(path.target[0], path.target[1], path.target[2]);
  constexpr int parts = 400;
  constexpr double hair = 1e-12;
  std::array<double, 2> last = { -1e9, -1e9 };
  double first_below = 0, last_above = 0;
  for(int n = 0; n <= parts; ++n) {
    const Point_3 x = n == parts ? q : p + double(n) / parts * (q - p);
    const std::array<double, 2> above = { *field.value(x) - inner(x), *field.value(x) - outer(x) };
    if(n == 0) first_below = above[0];
    last_above = above[1];
    for(int t = 0; t < 2; ++t) {
      if(above[t] < last[t] - hair) return false;
      last[t] = above[t];
    }
  }
  return first_below < 0 && last_above > 0 && crosses_once(path, mesh);
}

} // namespace

TEST_CASE("Certificate: paths that prove the degree start and end outside the shell, rise, and cross the mesh once")
{
  typedef BS::Spline_threshold<Field> Varying;
  const Mesh mesh = sphere(1);
  std::size_t paths = 0;
  for(unsigned seed = 1; seed < 25; ++seed) {
    CAPTURE(seed);
    CGAL::Random random(seed);
    const auto noisy = [&](double level, double slope, double size) {
      Field f = cube_field(4, 0.5);
      set(f, [&](double x, double y, double z) {
        return level + slope * std::sqrt(x * x + y * y + z * z) + size * random.get_double(-1, 1);
      });
      return f;
    };
    const bool varies = seed % 2 == 0;
    const Field field = noisy(0, 1, 0.1 * (seed % 5)), inner = noisy(0.5, 0, varies ? 0.5 : 0),
                outer = noisy(1.5, 0, varies ? 0.5 : 0);
    const auto check = [&](const auto& certificate, const auto& inner_value, const auto& outer_value) {
      std::vector<BS::Crossing_path> all = certificate.paths();
      all.insert(all.end(), certificate.report().spare_paths.begin(), certificate.report().spare_paths.end());
      for(const BS::Crossing_path& path : all)
        CHECK(proves_degree(path, field, inner_value, outer_value, certificate.examined_mesh()));
      paths += all.size();
    };
    if(varies) {
      BS::Shell_certificate_3<Field, Varying> certificate(field, Varying(inner), Varying(outer));
      certificate.verify<CGAL::Sequential_tag>(mesh);
      check(
        certificate, [&](const Point_3& p) { return *inner.value(p); },
        [&](const Point_3& p) { return *outer.value(p); });
    } else
      check(
        certify(field, 0.5, 1.5, mesh), [](const Point_3&) { return 0.5; }, [](const Point_3&) { return 1.5; });
  }
  CHECK(paths > 20);
}

TEST_CASE("Certificate: paths cross the mesh once, even if facets are so narrow that rounding displaces the paths")
{
  constexpr double spacing = 0x1p-20, unit = 0x1p-32; // width of a cell; one unit in the last place of coordinates
  const BS::Lattice_3 lattice = BS::Lattice_3::from_origin({ 0x1p20, 0x1p20, 0x1p20 }, spacing, { -1, -1, -1 },
                                                           { 1, 1, 1 });
  std::vector<std::uint64_t> keys;
  for(int k = -1; k <= 1; ++k)
    for(int j = -1; j <= 1; ++j)
      for(int i = -1; i <= 1; ++i) keys.push_back(BS::Lattice_key::encode(i, j, k));
  Field field(BS::Cell_complex_3(lattice, keys));
  REQUIRE(field.has_exact_cells());
  for(const auto& [sides, radius] :
      std::vector<std::pair<int, int> >{ { 20, 6 }, { 24, 6 }, { 24, 8 }, { 24, 10 }, { 28, 8 }, { 28, 10 } }) {
    CAPTURE(sides, radius);
    // A prism about the middle of a cell. Relative to the middle, in units, f = (x^2 + y^2) / radius^2 + z^2 /
    // length^2.
    constexpr double length = 500;
    const double scale[] = { spacing / unit / radius, spacing / unit / radius, spacing / unit / length };
    set(field, [&](double x, double y, double z) {
      return std::pow(scale[0] * (x / spacing - 0.5), 2) + std::pow(scale[1] * (y / spacing - 0.5), 2)
             + std::pow(scale[2] * (z / spacing - 0.5), 2)
             - (scale[0] * scale[0] + scale[1] * scale[1] + scale[2] * scale[2]) / 3;
    });
    Mesh mesh;
    const double middle = 0x1p20 + spacing / 2;
    const auto add = [&](double x, double y, double z) {
      return mesh.add_vertex(
        Point_3(middle + std::nearbyint(x) * unit, middle + std::nearbyint(y) * unit, middle + z * unit));
    };
    std::vector<Mesh::Vertex_index> bottom, top;
    for(int n = 0; n < sides; ++n) {
      const double angle = 2 * CGAL_PI * (n + 0.5) / sides;
      bottom.push_back(add(radius * std::cos(angle), radius * std::sin(angle), -length));
      top.push_back(add(radius * std::cos(angle), radius * std::sin(angle), length));
    }
    const auto south = add(0, 0, -length), north = add(0, 0, length);
    for(int n = 0; n < sides; ++n) {
      const int m = (n + 1) % sides;
      mesh.add_face(bottom[n], bottom[m], top[m]);
      mesh.add_face(bottom[n], top[m], top[n]);
      mesh.add_face(top[n], top[m], north);
      mesh.add_face(bottom[m], bottom[n], south);
    }
    const Certificate certificate = certify(field, 0.5, 2.5, mesh);
    REQUIRE(certificate.paths().size() == 1);
    std::vector<BS::Crossing_path> all = certificate.report().spare_paths;
    all.push_back(certificate.paths()[0]);
    for(const BS::Crossing_path& path : all) CHECK(crosses_once(path, certificate.examined_mesh()));
  }
}

TEST_CASE("Varying thresholds: a box is classified as between the thresholds only if it is")
{
  typedef BS::Spline_threshold<Field> Varying;
  const Field field = radial_field();
  Field inner = field, outer = field;
  set(inner, [](double, double, double z) { return 0.8 + 0.1 * z; });
  set(outer, [](double, double, double z) { return 1.2 - 0.1 * z; });
  const auto count = [&](const auto& cover, const auto& between) {
    std::array<std::size_t, 2> boxes = {};
    for(const BS::Cover_box& box : cover.boxes()) {
      const CGAL::Bbox_3 b = cover.bbox(box);
      bool sampled = true;
      for(int n = 0; n < 27; ++n) {
        const auto at = [&](int a, int i) { return (b.min)(a) + ((b.max)(a) - (b.min)(a)) * i / 2; };
        sampled = sampled && between(Point_3(at(0, n % 3), at(1, n / 3 % 3), at(2, n / 9)));
      }
      if(cover.is_between_thresholds(box)) CHECK(sampled);
      ++boxes[cover.is_between_thresholds(box)];
    }
    return boxes;
  };
  BS::Shell_cover_3<Field, Varying> varying(field, Varying(inner), Varying(outer));
  CHECK(varying.flood<CGAL::Sequential_tag>(Point_3(1, 0, 0), 0) == 0);
  const auto between = [&](const Point_3& p) {
    return *field.value(p) >= *inner.value(p) - 1e-12 && *field.value(p) <= *outer.value(p) + 1e-12;
  };
  const std::array<std::size_t, 2> boxes = count(varying, between);
  CHECK(boxes[0] > 100);
  CHECK(boxes[1] > 100);
  BS::Shell_cover_3<Field> fixed(field, Constant(0.8), Constant(1.2));
  CHECK(fixed.flood<CGAL::Sequential_tag>(Point_3(1, 0, 0), 0) == 0);
  const std::array<std::size_t, 2> fixed_boxes = count(
    fixed, [&](const Point_3& p) { return *field.value(p) >= 0.8 - 1e-12 && *field.value(p) <= 1.2 + 1e-12; });
  CHECK(fixed_boxes[0] > 100);
  CHECK(fixed_boxes[1] > 100);
}

// A field that fails after some calls of `cell()`, as any field or allocation may.
struct Failing_field : Field
{
  explicit Failing_field(const Field& field) : Field(field) {}
  Field::Cell cell(Field::Cell_index c) const
  {
    if(left-- == 0) throw std::bad_alloc();
    return Field::cell(c);
  }
  mutable long left = -1;
};

TEST_CASE("Certificate: an exception during the verification leaves nothing proved")
{
  Failing_field field(radial_field());
  const Mesh mesh = sphere(1);
  BS::Shell_certificate_3<Failing_field> certificate(field, Constant(0.7), Constant(1.3));
  REQUIRE(certificate.verify<CGAL::Sequential_tag>(mesh));
  field.left = -1;
  certificate.verify<CGAL::Sequential_tag>(mesh);
  const long calls = -1 - field.left;
  REQUIRE(calls > 1000);
  for(int n = 0; n < 20; ++n) {
    field.left = -1;
    REQUIRE(certificate.verify<CGAL::Sequential_tag>(mesh));
    field.left = calls * n / 20;
    CHECK_THROWS_AS(certificate.verify<CGAL::Sequential_tag>(mesh), std::bad_alloc);
    CHECK_FALSE(certificate.is_certified());
    for(int c = 0; c < 5; ++c) CHECK(certificate.verdict(Claim(c)) == Verdict::UNDECIDED);
    CHECK(certificate.facets().empty());
    CHECK(certificate.paths().empty());
    CHECK(certificate.least_gradient() == 0);
    CHECK(certificate.displacement_bound() == std::numeric_limits<double>::infinity());
  }
}

TEST_CASE("Certificate: for a rejected mesh, nothing is proved, and no result of the previous mesh is kept")
{
  const Field field = radial_field();
  Mesh open = sphere(2);
  CGAL::Euler::remove_face(open.halfedge(*open.faces().begin()), open);
  const auto refused = std::make_shared<BS::Input_mesh_3>(), accepted = std::make_shared<BS::Input_mesh_3>();
  REQUIRE(refused->build<CGAL::Sequential_tag>(open, open.points(), {}) == BS::Shell_status::OPEN_MESH);
  const Mesh closed = sphere(2);
  REQUIRE(accepted->build<CGAL::Sequential_tag>(closed, closed.points(), {}) == BS::Shell_status::SUCCESS);
  Certificate certificate(field, Constant(0.7), Constant(1.3));
  for(const std::shared_ptr<const BS::Input_mesh_3> input : { refused, std::make_shared<BS::Input_mesh_3>() }) {
    REQUIRE(certificate.verify<CGAL::Sequential_tag>(std::shared_ptr<const BS::Input_mesh_3>(accepted)));
    CHECK_FALSE(certificate.verify<CGAL::Sequential_tag>(input));
    CHECK(certificate.status() == input->status());
    for(int c = 0; c < 5; ++c) CHECK(certificate.verdict(Claim(c)) == Verdict::UNDECIDED);
    CHECK(certificate.facets().empty());
  }
}

TEST_CASE("Certificate: a refuting witness is listed, however many undecided places precede it")
{
  BS::Certificate_report report;
  Place w = {};
  w.claim = Claim::GRADIENT;
  w.verdict = Verdict::UNDECIDED;
  for(std::size_t n = 0; n < 2 * BS::Certificate_report::max_witnesses; ++n) report.add(w);
  w.verdict = Verdict::REFUTED;
  report.add(w);
  CHECK(report.witnesses.size() == BS::Certificate_report::max_witnesses);
  CHECK(report.witnesses.back().verdict == Verdict::REFUTED);
  CHECK(report.total_number_of_witnesses() == 2 * BS::Certificate_report::max_witnesses + 1);
}

TEST_CASE("Certificate: the list of witnesses is bounded, and their total number is counted")
{
  const Field field = radial_field();
  Mesh mesh = sphere(3);
  const std::size_t facets = mesh.number_of_faces();
  REQUIRE(facets > 2 * BS::Certificate_report::max_witnesses);
  CGAL::Polygon_mesh_processing::reverse_face_orientations(mesh);
  const Certificate certificate = certify(field, 0.7, 1.3, mesh);
  const std::size_t transversality = std::size_t(Claim::TRANSVERSALITY);
  CHECK(certificate.report().number_of_witnesses[transversality] == facets);
  CHECK(std::size_t(std::count_if(certificate.witnesses().begin(), certificate.witnesses().end(),
                                  [](const Place& w) { return w.claim == Claim::TRANSVERSALITY; }))
        == BS::Certificate_report::max_witnesses);
  for(const auto& facet : certificate.facets()) CHECK(facet.transversality == Verdict::REFUTED);
}

TEST_CASE("Cover: a box where a threshold is slightly steeper than the field is not monotone, at any scale")
{
  typedef BS::Spline_threshold<Field> Varying;
  const auto check = [](int axes, double s) {
    CAPTURE(axes, s);
    // f = s u^2 with u = x, x + y, or x + y + z. The outer threshold equals f at u = 4.05, but has the slope 8.3 s
    // instead of 8.1 s.
    const auto u = [&](double x, double y, double z) { return x + (axes > 1 ? y : 0) + (axes > 2 ? z : 0); };
    Field field = cube_field(5, 1), inner = field, outer = field;
    set(field, [&](double x, double y, double z) { return s * (std::pow(u(x, y, z), 2) - axes / 3.); });
    set(inner, [&](double, double, double) { return s; });
    set(outer, [&](double x, double y, double z) { return s * (16.4025 + 8.3 * (u(x, y, z) - 4.05)); });
    BS::Shell_cover_3<Field, Varying> cover(field, Varying(inner), Varying(outer));
    const double inside = 4.02 / axes;
    cover.flood<CGAL::Sequential_tag>(Point_3(inside, axes > 1 ? inside : 0.5, axes > 2 ? inside : 0.5), 0);
    std::size_t boxes = 0, undecided = 0;
    for(const BS::Cover_box& box : cover.boxes()) {
      const CGAL::Bbox_3 b = cover.bbox(box);
      if(box.component != 0 || u(b.xmin(), b.ymin(), b.zmin()) > 4.05 || u(b.xmax(), b.ymax(), b.zmax()) < 4.05)
        continue;
      ++boxes;
      undecided += box.kind == BS::Box_kind::UNDECIDED;
    }
    CHECK(boxes > 0);
    CHECK(undecided == boxes);
  };
  for(double s : { 1., 1e-150, 1.8e-163, 1.84e-163, 1.9e-163, 1e-200, 1e-290 }) check(1, s);
  // With several axes, each product of slopes is rounded separately.
  for(int axes : { 2, 3 })
    for(double s : { 1.8e-163, 3e-163, 1e-162 }) check(axes, s);
}

TEST_CASE("Cover: the bound on the least gradient does not exceed the field's gradient, however small it is")
{
  for(double s : { 1., 1e-140, 1e-155, 1e-160, 1e-200 }) {
    CAPTURE(s);
    Field field = cube_field(2, 1);
    set(field, [=](double x, double y, double z) { return s * (x + 0.3 * y - 0.7 * z + 0.01 * (x * x - 1. / 3)); });
    BS::Shell_cover_3<Field> cover(field, Constant(-0.5 * s), Constant(0.5 * s));
    cover.flood<CGAL::Sequential_tag>(Point_3(0, 0, 0), 0);
    double sampled = std::numeric_limits<double>::infinity();
    for(const BS::Cover_box& box : cover.boxes()) {
      if(box.component != 0) continue;
      const CGAL::Bbox_3 b = cover.bbox(box);
      const Vector_3 g = *field.gradient(
                           Point_3((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2))
                         / s;
      sampled = (std::min)(sampled, std::sqrt(g.squared_length()));
    }
    REQUIRE(sampled < 2);
    CHECK(cover.least_gradient<CGAL::Sequential_tag>() / s <= sampled * (1 + 1e-12));
    if(cover.number_of_undecided_boxes() == 0) CHECK(cover.least_gradient<CGAL::Sequential_tag>() / s > 0.5 * sampled);
    else CHECK(s < 1e-155);
    for(double bound : cover.least_gradients<CGAL::Sequential_tag>())
      if(bound < std::numeric_limits<double>::infinity()) CHECK(bound / s <= 2);
  }
}

TEST_CASE("Certificate: thresholds on cells other than the field's are rejected")
{
  typedef BS::Spline_threshold<Field> Varying;
  const Field field = radial_field();
  Field inner = field, outer = field, fewer = cube_field(11, 1. / 8), moved = cube_field(12, 1. / 16);
  set(inner, [](double, double, double) { return 0.8; });
  set(outer, [](double, double, double) { return 1.2; });
  set(fewer, [](double, double, double) { return 1.2; });
  set(moved, [](double, double, double) { return 1.2; });
  const Mesh mesh = sphere(2);
  BS::Shell_certificate_3<Field, Varying> certificate(field, Varying(inner), Varying(outer));
  CHECK(certificate.verify<CGAL::Sequential_tag>(mesh));
  for(const Field& other : { fewer, moved }) {
    BS::Shell_certificate_3<Field, Varying> refused(field, Varying(inner), Varying(other));
    CHECK_FALSE(refused.verify<CGAL::Sequential_tag>(mesh));
    CHECK(refused.status() == BS::Shell_status::THRESHOLDS_ON_OTHER_CELLS);
    BS::Shell_report report;
    report.status = BS::Shell_status::SUCCESS;
    const CGAL::Bspline_shell_3<Field, Varying> shell(field, Varying(other), Varying(outer),
                                                      std::vector<char>(field.number_of_cells(), 1), {}, report);
    CHECK(shell.status() == BS::Shell_status::THRESHOLDS_ON_OTHER_CELLS);
  }
}

namespace {

Field scaled(Field field, int exponent)
{
  field.set_coefficients(Eigen::VectorXd(field.coefficients() * std::ldexp(1., exponent)));
  return field;
}

// Compares a certificate with that of a shell whose gradients and coordinates are smaller by factors 2^exponent and
// 2^size.
template <typename Any_certificate>
void check_is_scaled(const Any_certificate& certificate, const Any_certificate& reference, int exponent, int size = 0)
{
  for(int c = 0; c < 5; ++c) CHECK(certificate.verdict(Claim(c)) == reference.verdict(Claim(c)));
  CHECK(certificate.least_angle() == reference.least_angle());
  CHECK(certificate.least_gradient() == std::ldexp(reference.least_gradient(), exponent));
  CHECK(certificate.report().largest_gradient == std::ldexp(reference.report().largest_gradient, exponent));
  CHECK(certificate.displacement_bound() == std::ldexp(reference.displacement_bound(), size));
  CHECK(certificate.statistics().cover_boxes == reference.statistics().cover_boxes);
  CHECK(certificate.statistics().critical_boxes == reference.statistics().critical_boxes);
  CHECK(certificate.statistics().undecided_boxes == reference.statistics().undecided_boxes);
  REQUIRE(certificate.facets().size() == reference.facets().size());
  bool have_scaled_slopes = true;
  for(std::size_t n = 0; n < reference.facets().size(); ++n)
    have_scaled_slopes = have_scaled_slopes
                         && certificate.facets()[n].slope == std::ldexp(reference.facets()[n].slope, exponent);
  CHECK(have_scaled_slopes);
}

} // namespace

TEST_CASE("Certificate: scaling field and levels by a power of two preserves verdicts and angles, and scales gradients")
{
  // a sphere that is proved; a double cover that is refuted; a shell with a critical point; a shell with critical
  // points beyond a threshold
  struct Case
  {
    Field field;
    double inner, outer;
    Mesh mesh;
  };
  const Point_3 c(0.31, -0.13, 0.17);
  Field quadratic = cube_field(4, 1);
  set(quadratic, [&](double x, double y, double z) {
    return (x - c.x()) * (x - c.x()) + (y - c.y()) * (y - c.y()) + (z - c.z()) * (z - c.z()) - 1;
  });
  const Case cases[] = { { radial_field(), 0.8, 1.2, sphere(1) },
                         { radial_field(), 0.28, 1.1, pentagram_bipyramid() },
                         { quadratic, -0.5, 4.001, sphere(1, 2, c) },
                         { quadratic, 0.01, 4.001, sphere(1, 2, c) } };
  const Verdict gradients[] = { Verdict::PROVED, Verdict::PROVED, Verdict::REFUTED, Verdict::PROVED };
  for(int n = 0; n < 4; ++n) {
    CAPTURE(n);
    const auto certified = [&](int exponent) {
      const Case& here = cases[n];
      return certify(scaled(here.field, exponent), std::ldexp(here.inner, exponent), std::ldexp(here.outer, exponent),
                     here.mesh);
    };
    const Certificate reference = certified(0);
    REQUIRE(reference.verdict(Claim::GRADIENT) == gradients[n]);
    if(n < 2) REQUIRE(reference.is_certified() == (n == 0));
    if(n == 3) REQUIRE(reference.statistics().critical_boxes > 0);
    for(int exponent : { -900, -535, 524, 1000 }) {
      CAPTURE(exponent);
      check_is_scaled(certified(exponent), reference, exponent);
    }
  }
}

TEST_CASE("Certificate: scaling field and varying thresholds by a power of two changes only the gradients")
{
  typedef BS::Spline_threshold<Field> Varying;
  typedef BS::Shell_certificate_3<Field, Varying> Varying_certificate;
  const Field field = radial_field();
  Field inner = field, outer = field;
  set(inner, [](double, double y, double z) { return 0.8 - 0.05 * z + 0.02 * y; });
  set(outer, [](double x, double, double z) { return 1.2 + 0.05 * z - 0.02 * x; });
  const Mesh mesh = sphere(1);
  const auto certified = [&](const Field& scaled_field, int exponent) {
    Varying_certificate certificate(scaled_field, Varying(scaled(inner, exponent)), Varying(scaled(outer, exponent)));
    certificate.verify<CGAL::Sequential_tag>(mesh);
    return certificate;
  };
  const Varying_certificate reference = certified(field, 0);
  REQUIRE(reference.is_certified());
  const std::vector<double> displacements = reference.displacement_bounds<CGAL::Sequential_tag>();
  for(int exponent : { -900, 524 }) {
    CAPTURE(exponent);
    const Field scaled_field = scaled(field, exponent);
    const Varying_certificate certificate = certified(scaled_field, exponent);
    check_is_scaled(certificate, reference, exponent);
    CHECK(certificate.displacement_bounds<CGAL::Sequential_tag>() == displacements);
  }
}

TEST_CASE("Certificate: bounds on a field are computed again if its coefficients may have changed")
{
  Field field = radial_field();
  const Mesh mesh = sphere(2, 1);
  Certificate certificate(field, Constant(0.75), Constant(1.25));
  REQUIRE(certificate.verify(mesh));
  set(field, [](double x, double y, double z) { return 2 - std::sqrt(x * x + y * y + z * z); });
  CHECK_FALSE(certificate.verify(mesh));
  CHECK(certificate.verdict(Claim::TRANSVERSALITY) == Verdict::REFUTED);
}

TEST_CASE("Certificate: powers of two scale bounds exactly, including those of facets that the predicates decide")
{
  // Values, slopes and second derivatives are between 2^-900 and 2^1000, beyond the documented range. At some vertices,
  // the outer threshold exceeds the field by so little that only the predicates prove the claims on the facets there.
  const auto certified = [](int exponent, int size) {
    Field field = cube_field(4, std::ldexp(0.5, size));
    set(field, [](double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); });
    field = scaled(field, exponent);
    const Mesh mesh = sphere(1, std::ldexp(1., size));
    double largest = 0;
    for(auto v : mesh.vertices()) largest = (std::max)(largest, *field.value(mesh.point(v)));
    const auto level = [&](double x) { return std::ldexp(x, exponent + size); };
    return certify(field, level(0.7), largest + level(7e-14), mesh);
  };
  const Certificate reference = certified(0, 0);
  REQUIRE(reference.is_certified());
  REQUIRE(reference.statistics().transversality.by_form > 0);
  for(int size : { -190, -67, 0, 67, 190 })
    for(int exponent : { -710, -251, 0, 2, 307, 810 }) {
      CAPTURE(size, exponent);
      check_is_scaled(certified(exponent, size), reference, exponent, size);
    }
  for(int exponent : { -900, 1000 }) {
    CAPTURE(exponent);
    check_is_scaled(certified(exponent, 0), reference, exponent);
  }
}
} // namespace test_Shell_certificate_3
