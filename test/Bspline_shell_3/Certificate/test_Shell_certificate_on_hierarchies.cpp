// Field_predicates_3.h, Shell_cover_3.h, Shell_certificate_3.h on cells of different sizes. Results that are reused
// from a shell with a known cover.
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include "exact_spline.h"
#include "random_hierarchies.h"
#include "test_meshes.h"

#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace test_Shell_certificate_on_hierarchies {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef BS::Field_predicates_3<Field> Predicates;
typedef BS::Shell_certificate_3<Field> Certificate;
typedef CGAL::Bspline_shell_3<Field> Shell;
typedef BS::Constant_threshold Constant;
typedef BS::Certificate_witness Place;
typedef std::array<Point_3, 3> Triangle;
typedef Field::Cell_index Index;
using BS::Claim;
using BS::Verdict;

const double inf = std::numeric_limits<double>::infinity();

// Returns all root cells of a cube about the origin.
Root_cells cube(int half_cells, double spacing)
{
  const double h = half_cells * spacing;
  CGAL::Random random(0);
  return some_cells(random, BS::Lattice_3(CGAL::Bbox_3(-h, -h, -h, h, h, h), spacing),
                    { -half_cells, -half_cells, -half_cells }, { half_cells - 1, half_cells - 1, half_cells - 1 });
}

Hierarchy refined_at(Hierarchy cells, const Point_3& p, int times)
{
  for(int n = 0; n < times; ++n) cells = cells.refined({ cells.locate(p) });
  return cells;
}

// Sets each free coefficient by a function of its level, and of the point at which its basis function is centered.
template <typename Function>
void set(Field& field, const Function& f)
{
  Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
  for(Index n = 0; n < field.number_of_coefficients(); ++n) {
    const Index point = field.point_of_coefficient(n);
    int l = field.number_of_levels() - 1;
    while(point >= field.first_point(l) + field.points(l).size()) --l;
    const Lattice_point& p = field.points(l).point(point - field.first_point(l));
    x[n] = f(field.cells().coordinate(l, 0, p[0]), field.cells().coordinate(l, 1, p[1]),
             field.cells().coordinate(l, 2, p[2]), l);
  }
  field.set_coefficients(x);
}

// Returns a field on leaves of five sizes: cells of width one, halved four times at one place.
Field deep_field()
{
  const Field field(refined_at(Hierarchy(cube(4, 1)), Point_3(-2.3, -2.1, 0.4), 4));
  REQUIRE(field.number_of_levels() == 5);
  return field;
}

// Returns a field close to |x|, with smaller leaves at two places of the sphere of radius `scale`.
Field radial_field(double scale = 1)
{
  Hierarchy cells(cube(6, scale / 4));
  cells = refined_at(cells, Point_3(0, 0.6 * scale, 0.8 * scale), 3);
  cells = refined_at(cells, Point_3(-0.6 * scale, -0.8 * scale, 0), 1);
  Field field(cells);
  REQUIRE(field.number_of_levels() == 4);
  set(field, [](double x, double y, double z, int) { return std::sqrt(x * x + y * y + z * z); });
  return field;
}

// Evaluates the field at exact points, on a leaf that contains the point.
class Exact_values
{
public:
  explicit Exact_values(const Field& field) : m_field(&field) {}

  Rational operator()(const Exact_point& p)
  {
    Index c = m_field->locate(Point_3(CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2])));
    if(!holds(c, p)) // rounding has moved the point across a face
      for(c = 0; !holds(c, p);) ++c;
    const auto found = m_coefficients.find(c);
    const std::array<Rational, 64>& b = found != m_coefficients.end()
                                          ? found->second
                                          : (m_coefficients[c] = m_field->bernstein_coefficients<Rational>(c));
    Exact_point t;
    for(int a = 0; a < 3; ++a)
      t[a] = (p[a] - Rational(m_field->cells().corner(c)[a])) / Rational(m_field->cells().width(c));
    return bernstein_value(b, t);
  }

private:
  bool holds(Index c, const Exact_point& p) const
  {
    for(int a = 0; a < 3; ++a) {
      const Rational least(m_field->cells().corner(c)[a]);
      if(p[a] < least || p[a] > least + Rational(m_field->cells().width(c))) return false;
    }
    return true;
  }

  const Field* m_field;
  std::map<Index, std::array<Rational, 64> > m_coefficients;
};

Exact_point combined(const Triangle& t, const Rational& u, const Rational& v, const Rational& w)
{
  Exact_point p;
  for(int a = 0; a < 3; ++a) p[a] = u * Rational(t[0][a]) + v * Rational(t[1][a]) + w * Rational(t[2][a]);
  return p;
}

Certificate certify(const Field& field, double inner, double outer, const Mesh& mesh)
{
  Certificate certificate(field, Constant(inner), Constant(outer));
  certificate.verify<CGAL::Sequential_tag>(mesh);
  return certificate;
}

std::vector<Verdict> verdicts(const Certificate& certificate)
{
  std::vector<Verdict> v;
  for(int c = 0; c < 5; ++c) v.push_back(certificate.verdict(Claim(c)));
  return v;
}

const std::vector<Verdict> all_proved(5, Verdict::PROVED);

// Returns a field close to the distance from the nearer of two points, (-0.75, 0, 0) and (0.75, 0, 0).
Field two_balls()
{
  Field field(refined_at(Hierarchy(cube(8, 0.1875)), Point_3(0.75, 0, 0.45), 1));
  set(field, [](double x, double y, double z, int) {
    const double u = std::abs(x) - 0.75;
    return std::sqrt(u * u + y * y + z * z);
  });
  return field;
}

Mesh together(const Mesh& a, const Mesh& b)
{
  Mesh mesh = a;
  CGAL::copy_face_graph(b, mesh);
  return mesh;
}

Mesh left(double radius = 0.45)
{
  return sphere(2, radius, Point_3(-0.75, 0, 0));
}
Mesh right(double radius = 0.45)
{
  return sphere(2, radius, Point_3(0.75, 0, 0));
}
constexpr double inner_level = 0.36, outer_level = 0.52;

// Returns a shell with the cover of a certificate, and with a distinctive gradient bound. The shell is not certified,
// so it imposes no conditions on the components of a mesh.
Shell shell_with_cover(const Field& field, const Certificate& certificate, double gradient)
{
  BS::Shell_report report;
  report.status = BS::Shell_status::SUCCESS;
  report.certificate = certificate.report();
  report.certificate.least_gradient = gradient;
  report.certificate.verdicts[std::size_t(Claim::DEGREE_ONE)] = Verdict::UNDECIDED;
  Shell shell(field, BS::Level_range{ inner_level, outer_level }, std::vector<char>(field.number_of_cells(), 1), {},
              report);
  BS::internal::Shell_access::set_proved_cover(shell, certificate.cover()->boxes());
  return shell;
}

// Compares everything but the time, the number of examined cells, and the boxes of the cover.
void check_conclusions(const Certificate& certificate, const Certificate& reference)
{
  CHECK(verdicts(certificate) == verdicts(reference));
  CHECK(certificate.number_of_covers() == reference.number_of_covers());
  CHECK(certificate.statistics().undecided_boxes == reference.statistics().undecided_boxes);
  CHECK(certificate.least_angle() == reference.least_angle());
  CHECK(certificate.paths().size() == reference.paths().size());
  REQUIRE(certificate.witnesses().size() == reference.witnesses().size());
  for(std::size_t n = 0; n < certificate.witnesses().size(); ++n) {
    CHECK(certificate.witnesses()[n].reason == reference.witnesses()[n].reason);
    CHECK(certificate.witnesses()[n].point == reference.witnesses()[n].point);
  }
}

// Compares the boxes as well.
void check_equal(const Certificate& certificate, const Certificate& reference)
{
  check_conclusions(certificate, reference);
  CHECK(certificate.statistics().cover_boxes == reference.statistics().cover_boxes);
  CHECK(certificate.statistics().monotone_boxes == reference.statistics().monotone_boxes);
  if(certificate.cover() && certificate.verdict(Claim::ONE_SHEET) == Verdict::PROVED)
    for(std::size_t c = 0; c < certificate.number_of_covers(); ++c) {
      const auto boxes = [&](const Certificate& x) {
        const auto& all = x.cover()->boxes();
        return std::count_if(all.begin(), all.end(), [&](const BS::Cover_box& box) { return box.component == c; });
      };
      CHECK(boxes(certificate) == boxes(reference));
    }
}

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

} // namespace

TEST_CASE("Predicates on a hierarchy: the comparison of a point with a level is exact")
{
  Field field = deep_field();
  CGAL::Random random(1);
  set(field, [&](double, double, double, int) { return random.get_double(-1, 1); });
  const Predicates predicates(field);
  Exact_values values(field);
  for(int n = 0; n < 60; ++n) {
    const Index c = n % 2 ? Index(random.get_int(0, int(field.number_of_cells())))
                          : Index(field.number_of_cells() - 1 - std::size_t(n));
    const std::array<double, 3> corner = field.cells().corner(c);
    const double w = field.cells().width(c);
    const auto at = [&](int a) {
      return corner[std::size_t(a)] + w * (n % 5 == 4 ? random.get_int(0, 2) : random.get_double());
    };
    const Point_3 p(at(0), at(1), at(2));
    const Rational value = values(exact(p));
    const double near = CGAL::to_double(value);
    for(double level : { near - 1, std::nextafter(near, -inf), near, std::nextafter(near, inf), near + 1 })
      CHECK(predicates.compare(p, level) == CGAL::compare(value, Rational(level)));
  }
  CHECK_FALSE(predicates.compare(Point_3(5, 0, 0), 0));
  Field plane = field;
  set(plane, [](double x, double, double, int) { return x; });
  CHECK(Predicates(plane).compare(Point_3(0.5, 1, 2), 0.5) == CGAL::EQUAL);
}

TEST_CASE("Predicates on a hierarchy: answers agree with exact values on facets that cross leaves of all sizes")
{
  Field field = deep_field();
  const Predicates predicates(field);
  int proved = 0, refuted = 0;
  for(unsigned seed = 2; seed < 5; ++seed) {
    CGAL::Random random(seed);
    set(field, [&](double, double, double, int) { return random.get_double(-1, 1); });
    Exact_values values(field);
    for(int n = 0; n < 9; ++n) {
      // Triangles reach from the smallest leaves to the other end, or stay among the smallest leaves.
      const auto point = [&](double reach, const Point_3& center) {
        return center
               + Vector_3(random.get_double(-reach, reach), random.get_double(-reach, reach),
                          random.get_double(-reach, reach));
      };
      const Point_3 deep(-2.3, -2.1, 0.4);
      Triangle t = { point(0.1, deep), point(n % 3 == 0 ? 3.9 : 0.4, n % 3 == 0 ? Point_3(0, 0, 0) : deep),
                     point(n % 3 == 1 ? 0.3 : 3.9, n % 3 == 1 ? deep : Point_3(0, 0, 0)) };
      if(n % 4 == 3)
        for(Point_3& p : t) p = Point_3(p.x(), p.y(), 0.5); // in a plane between leaves of different sizes
      if(n % 5 == 4) t[2] = t[0] + 0.3 / 8 * (t[2] - t[0]); // needle-like
      Rational least(1000), most(-1000);
      constexpr int parts = 8;
      for(int i = 0; i <= parts; ++i)
        for(int j = 0; i + j <= parts; ++j) {
          const Rational f = values(
            combined(t, Rational(i) / parts, Rational(j) / parts, Rational(parts - i - j) / parts));
          least = (std::min)(least, f);
          most = (std::max)(most, f);
        }
      const double middle = CGAL::to_double((least + most) / 2), half = CGAL::to_double((most - least) / 2);
      for(double factor : { 0.5, 0.9, 1.05, 1.5, 3. }) {
        const BS::Level_range levels = { middle - factor * half, middle + factor * half };
        BS::Witness witness;
        const Verdict verdict = predicates.values_within(t, levels, &witness);
        const bool holds_at_samples = least >= Rational(levels.min) && most <= Rational(levels.max);
        if(verdict == Verdict::PROVED) {
          ++proved;
          CHECK(holds_at_samples);
        }
        if(!holds_at_samples) CHECK(verdict == Verdict::REFUTED);
        if(verdict == Verdict::REFUTED) {
          ++refuted;
          const Rational f = values(combined(t, Rational(witness.barycentric[0]), Rational(witness.barycentric[1]),
                                             Rational(witness.barycentric[2])));
          CHECK((f < Rational(levels.min) || f > Rational(levels.max)));
          CHECK((f >= Rational(witness.value.min) && f <= Rational(witness.value.max)));
        }
        CHECK(verdict != Verdict::UNDECIDED);
      }
    }
  }
  CHECK(proved > 20);
  CHECK(refuted > 40);
}

TEST_CASE("Predicates on a hierarchy: slopes are per user unit, whatever the size of the leaf")
{
  Field field = deep_field();
  set(field, [](double x, double y, double z, int) { return 0.5 * x - y + 2 * z; });
  const Predicates predicates(field);
  const double length = std::sqrt(0.25 + 1 + 4);
  // The facet is orthogonal to the gradient, and crosses leaves of all sizes.
  const Vector_3 u(2, 1, 0), v(0, 2, 1);
  const Point_3 p(-2.3, -2.1, 0.4), q = p + 2. * u, r = p + 2. * v - 0.3 * u;
  double slope = 10; // lower bound on the slope
  CHECK(predicates.crosses_upwards({ p, q, r }, nullptr, nullptr, &slope) == Verdict::PROVED);
  CHECK(slope <= length);
  CHECK(slope > length * (1 - 2e-9)); // the error radius of small leaves is divided by their width
  BS::Witness witness;
  CHECK(predicates.crosses_upwards({ q, p, r }, &witness) == Verdict::REFUTED);
  CHECK(witness.value.min >= -length * std::sqrt(3.)); // the largest component of the normal is one
  CHECK(witness.value.max <= -length * (1 - 1e-9));
  // nearly along the gradient, from either side
  const Vector_3 g(0.5, -1, 2), n = CGAL::cross_product(u, v);
  REQUIRE(n * g > 0);
  for(double tilt : { 1e-9, -1e-9 }) {
    const Point_3 s = p + 0.9 * g + tilt * CGAL::cross_product(g, u);
    CHECK(predicates.crosses_upwards({ p, p + u, s })
          == (tilt * (CGAL::cross_product(u, CGAL::cross_product(g, u)) * g) > 0 ? Verdict::PROVED : Verdict::REFUTED));
  }
  CHECK(predicates.increases({ p, p + g }) == Verdict::PROVED);
  CHECK(predicates.increases({ p + g, p }) == Verdict::REFUTED);
  // The range of a linear function is as tight as rounding permits.
  const auto f = [](const Point_3& x) { return 0.5 * x.x() - x.y() + 2 * x.z(); };
  const double least = (std::min)({ f(p), f(q), f(r) }), most = (std::max)({ f(p), f(q), f(r) });
  CHECK(predicates.values_within(Triangle{ p, q, r }, { least - 1e-11, most + 1e-11 }) == Verdict::PROVED);
  CHECK(predicates.values_within(Triangle{ p, q, r }, { least + 1e-11, most + 1 }, &witness) == Verdict::REFUTED);
  CHECK(witness.value.max < least + 1e-11);
  CHECK(predicates.values_within(Triangle{ p, q, r }, { least - 1, most - 1e-11 }, &witness) == Verdict::REFUTED);
  CHECK(witness.value.min > most - 1e-11);
}

TEST_CASE("Predicates on a hierarchy: the cost of a facet depends only on the leaves that it meets")
{
  // One facet is small, and far from the smallest leaves; the other one is large, and crosses them.
  Field field = deep_field();
  set(field, [](double x, double y, double z, int) { return z + 0.01 * std::sin(3 * x) * std::sin(2 * y); });
  const Predicates predicates(field);
  BS::Predicate_statistics statistics;
  CHECK(predicates.values_within(Triangle{ Point_3(3, 3, 3), Point_3(3.5, 3, 3), Point_3(3, 3.5, 3) }, { 2, 4 },
                                 nullptr, &statistics)
        == Verdict::PROVED);
  CHECK(statistics.by_cell + statistics.by_form < 20);
  statistics = BS::Predicate_statistics();
  const Triangle large = { Point_3(-3.9, -3.9, 0.4), Point_3(3.9, -3.9, 0.4), Point_3(-3.9, 3.9, 0.4) };
  CHECK(predicates.values_within(large, { 0.3, 0.5 }, nullptr, &statistics) == Verdict::PROVED);
  CHECK(predicates.crosses_upwards(large, nullptr, &statistics) == Verdict::PROVED);
  CHECK(statistics.by_cell + statistics.by_form < 20 * field.number_of_cells());
}

TEST_CASE("Certificate on a hierarchy: the shell of a sphere is certified, and reported bounds hold")
{
  const Field field = radial_field();
  const Mesh mesh = sphere(2);
  Certificate certificate(field, Constant(0.85), Constant(1.2));
  REQUIRE(certificate.verify(mesh));
  CHECK(verdicts(certificate) == all_proved);
  CHECK(certificate.witnesses().empty());
  CHECK(certificate.number_of_covers() == 1);
  REQUIRE(certificate.paths().size() == 1);
  // The cover contains boxes of all sizes.
  std::array<std::size_t, 4> boxes = {};
  for(const BS::Cover_box& box : certificate.cover()->boxes()) ++boxes[std::size_t(field.cells().level(box.cell))];
  for(std::size_t n : boxes) CHECK(n > 0);

  double least = inf, least_angle = inf;
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Point_3 &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h)),
                  &r = mesh.point(mesh.target(mesh.next(h)));
    const Vector_3 n = CGAL::cross_product(q - p, r - p);
    for(const Point_3& s : { p, q, r, CGAL::centroid(p, q, r) }) {
      const Vector_3 g = field.gradient(s).value();
      const double length = std::sqrt(g.squared_length());
      least = (std::min)(least, length);
      least_angle = (std::min)(least_angle, std::asin(n * g / length / std::sqrt(n.squared_length())));
      CHECK(certificate.facets()[std::size_t(f)].slope <= n * g / std::sqrt(n.squared_length()) + 1e-12);
    }
  }
  CHECK(certificate.least_gradient() > 0.2 * least);
  CHECK(certificate.least_gradient() <= least);
  CHECK(certificate.least_angle() > 0.3 * least_angle);
  CHECK(certificate.least_angle() <= least_angle);
  CHECK(certificate.displacement_bound() >= 0.35 / least);
}

TEST_CASE("Certificate on a hierarchy: false claims are refuted, or at least not proved")
{
  const Field field = radial_field();
  CHECK(
    verdicts(certify(field, 0.28, 1.2, pentagram_bipyramid()))
    == std::vector<Verdict>{ Verdict::PROVED, Verdict::PROVED, Verdict::PROVED, Verdict::PROVED, Verdict::REFUTED });
  Mesh nested = sphere(2, 0.95);
  CGAL::copy_face_graph(sphere(2, 1.1), nested);
  CHECK(
    verdicts(certify(field, 0.85, 1.2, nested))
    == std::vector<Verdict>{ Verdict::PROVED, Verdict::PROVED, Verdict::PROVED, Verdict::REFUTED, Verdict::REFUTED });

  // One vertex sticks out, where leaves are smallest.
  Mesh mesh = sphere(2);
  Mesh::Vertex_index v = *mesh.vertices().begin();
  for(auto w : mesh.vertices())
    if(CGAL::squared_distance(mesh.point(w), Point_3(0, 0.6, 0.8))
       < CGAL::squared_distance(mesh.point(v), Point_3(0, 0.6, 0.8)))
      v = w;
  mesh.point(v) = CGAL::ORIGIN + 1.1 * (mesh.point(v) - CGAL::ORIGIN);
  REQUIRE(field.cells().level(field.locate(mesh.point(v))) >= 2);
  const double highest = field.value(mesh.point(v)).value();
  CHECK(certify(field, 0.85, highest + 1e-12, mesh).verdict(Claim::CONTAINMENT) == Verdict::PROVED);
  const Certificate refuted = certify(field, 0.85, highest - 1e-12, mesh);
  CHECK(refuted.verdict(Claim::CONTAINMENT) == Verdict::REFUTED);
  for(const Place& w : refuted.witnesses())
    if(w.claim == Claim::CONTAINMENT) CHECK(w.reason == Place::FACET);
  CHECK(certify(field, 0.85, 1.2, sphere(2, 1, Point_3(9, 0, 0))).witnesses().front().reason == Place::OUTSIDE);

  // The shell reaches the boundary of the domain.
  const Certificate open = certify(field, 0.85, 1.6, sphere(2));
  CHECK(open.verdict(Claim::GRADIENT) == Verdict::UNDECIDED);
  for(const Place& w : open.witnesses()) CHECK(w.reason == Place::BOUNDARY_OF_DOMAIN);

  // The field has a dent in the smallest leaves, outside the mesh.
  Field dented = field;
  Eigen::VectorXd x = field.coefficients();
  const int finest = field.number_of_levels() - 1;
  const Lattice_point& p = field.cells().lattice_point(field.locate(Point_3(0.01, 0.65, 0.85)));
  REQUIRE(field.cells().level(field.locate(Point_3(0.01, 0.65, 0.85))) == finest);
  const Index n = field.coefficient_of_point(field.first_point(finest) + field.points(finest).index(p));
  REQUIRE(n != Field::npos);
  x[n] -= 0.2;
  dented.set_coefficients(x);
  const Certificate critical = certify(dented, 0.85, 1.2, sphere(2));
  CHECK(critical.verdict(Claim::GRADIENT) != Verdict::PROVED);
  bool named = false;
  for(const Place& w : critical.witnesses())
    named = named
            || (w.claim == Claim::GRADIENT && std::abs(w.point[0]) < 0.1 && std::abs(w.point[1] - 0.65) < 0.1
                && std::abs(w.point[2] - 0.85) < 0.1);
  CHECK(named);
}

TEST_CASE("Certificate on a hierarchy: results do not depend on a power-of-two scale, threads or the rounding mode")
{
  const Mesh mesh = pentagram_bipyramid();
  const Field field = radial_field();
  const Certificate reference = certify(field, 0.28, 1.2, mesh);
  for(double scale : { std::ldexp(1., 30), std::ldexp(1., -40) }) {
    Mesh scaled = mesh;
    for(auto v : scaled.vertices()) scaled.point(v) = CGAL::ORIGIN + scale * (mesh.point(v) - CGAL::ORIGIN);
    const Field scaled_field = radial_field(scale);
    const Certificate certificate = certify(scaled_field, scale * 0.28, scale * 1.2, scaled);
    CHECK(verdicts(certificate) == verdicts(reference));
    CHECK(certificate.statistics().cover_boxes == reference.statistics().cover_boxes);
    CHECK(certificate.least_angle() == reference.least_angle());
    CHECK(certificate.least_gradient() == reference.least_gradient());
  }
  const auto check_in_mode = [&](int mode, auto concurrency_tag) {
    REQUIRE(std::fesetround(mode) == 0);
    Certificate certificate(field, Constant(0.28), Constant(1.2));
    certificate.verify<decltype(concurrency_tag)>(mesh);
    const int after = std::fegetround();
    std::fesetround(FE_TONEAREST);
    CHECK(after == mode);
    CHECK(verdicts(certificate) == verdicts(reference));
    CHECK(certificate.statistics().cover_boxes == reference.statistics().cover_boxes);
    CHECK(certificate.least_gradient() == reference.least_gradient());
    CHECK(certificate.least_angle() == reference.least_angle());
  };
  for(int mode : { FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO }) {
    check_in_mode(mode, CGAL::Sequential_tag());
    check_in_mode(mode, CGAL::Parallel_if_available_tag()); // other threads have their own rounding modes
  }
}

TEST_CASE("Certificate on a hierarchy: inexact corners or coefficients that are not finite prevent certification")
{
  CGAL::Random random(5);
  const BS::Lattice_3 lattice = BS::Lattice_3::from_origin({ 0.1, 0.1, 0.1 }, 0.2, { -8, -8, -8 }, { 7, 7, 7 });
  Field inexact(refined_at(Hierarchy(some_cells(random, lattice, { -8, -8, -8 }, { 7, 7, 7 })), Point_3(0, 0, 1), 1));
  set(inexact, [](double x, double y, double z, int) { return std::sqrt(x * x + y * y + z * z); });
  REQUIRE_FALSE(inexact.has_exact_cells());
  const Certificate refused = certify(inexact, 0.85, 1.2, sphere(2));
  CHECK(refused.status() == BS::Shell_status::GRID_TOO_FINE);
  for(int c = 0; c < 5; ++c) CHECK(refused.verdict(Claim(c)) == Verdict::UNDECIDED);

  // The thresholds vary, on the same leaves.
  typedef BS::Spline_threshold<Field> Varying;
  const Field field = radial_field();
  Field inner = field, outer = field;
  set(inner, [](double, double, double z, int) { return 0.85 + 0.02 * z; });
  set(outer, [](double, double, double z, int) { return 1.2 - 0.02 * z; });
  BS::Shell_certificate_3<Field, Varying> certificate(field, Varying(inner), Varying(outer));
  CHECK(certificate.verify<CGAL::Sequential_tag>(sphere(2)));
  // One coefficient of a large basis function, next to the mesh, is NaN; smaller leaves depend on it.
  Eigen::VectorXd x = outer.coefficients();
  for(Index n = 0; n < field.number_of_coefficients(); ++n) {
    const Index point = field.point_of_coefficient(n);
    if(point < field.first_point(0)) continue;
    const Lattice_point& p = field.points(0).point(point - field.first_point(0));
    if(p == Lattice_point{ 0, 5, -2 }) x[n] = std::numeric_limits<double>::quiet_NaN();
  }
  REQUIRE_FALSE(x.allFinite());
  Field no_number = outer;
  no_number.set_coefficients(x);
  BS::Shell_certificate_3<Field, Varying> unproved(field, Varying(inner), Varying(no_number));
  CHECK_FALSE(unproved.verify<CGAL::Sequential_tag>(sphere(2)));
  CHECK(unproved.verdict(Claim::GRADIENT) == Verdict::UNDECIDED);
}

TEST_CASE("Certificate with a known cover: results agree with results without it, for any sequence of meshes")
{
  const Field field = two_balls();
  const Certificate proved = certify(field, inner_level, outer_level, together(left(), right()));
  REQUIRE(verdicts(proved) == all_proved);
  REQUIRE(proved.number_of_covers() == 2);
  const double gradient = 0.75 * proved.least_gradient(); // differs from the bound that is computed
  const Shell shell = shell_with_cover(field, proved, gradient);
  Certificate certificate(shell);
  // One certificate verifies all meshes in turn; one of the meshes is not in the shell.
  for(const Mesh& mesh : { together(left(), right()), together(left(0.46), right(0.44)), left(), sphere(2), right(),
                           together(right(), left(0.46)) }) {
    const Certificate reference = certify(field, inner_level, outer_level, mesh);
    certificate.verify<CGAL::Sequential_tag>(mesh);
    check_equal(certificate, reference);
    if(reference.verdict(Claim::CONTAINMENT) != Verdict::PROVED) {
      CHECK_FALSE(certificate.is_certified());
      CHECK(certificate.least_gradient() == 0);
      continue;
    }
    CHECK(certificate.is_certified());
    CHECK(certificate.least_gradient() == gradient);
    CHECK(certificate.least_gradient() <= reference.least_gradient());
    CHECK(certificate.displacement_bound() >= reference.displacement_bound());
    CHECK(certificate.displacement_bound() <= 2 * reference.displacement_bound());
    const std::vector<double> bounds = certificate.displacement_bounds<CGAL::Sequential_tag>(),
                              without = reference.displacement_bounds<CGAL::Sequential_tag>();
    REQUIRE(bounds.size() == without.size());
    for(std::size_t n = 0; n < bounds.size(); ++n) CHECK(bounds[n] >= without[n]);
  }
  // Bounds are shared.
  const auto bounds = std::make_shared<const Certificate::Bounds>(shell.field(), shell.inner_threshold(),
                                                                  shell.outer_threshold());
  Certificate sharing(shell, bounds);
  sharing.verify<CGAL::Parallel_if_available_tag>(left(0.46));
  check_equal(sharing, certify(field, inner_level, outer_level, left(0.46)));
  CHECK(sharing.facets().front().slope == certify(field, inner_level, outer_level, left(0.46)).facets().front().slope);
}

TEST_CASE("Certificate with a known cover: components that share part of the cover reuse it, unless it is incomplete")
{
  const Field field = two_balls();
  const Certificate all = certify(field, inner_level, outer_level, together(left(), right()));
  const Certificate of_left = certify(field, inner_level, outer_level, left());
  REQUIRE(all.is_certified());
  REQUIRE(of_left.is_certified());
  const Shell shell = shell_with_cover(field, all, 0.75 * all.least_gradient()),
              partial = shell_with_cover(field, of_left, 0.75 * of_left.least_gradient());
  Certificate by_all(shell), by_part(partial);
  const Mesh nested = together(left(0.42), left(0.47));
  for(const Mesh& mesh : { nested, together(right(), nested) }) {
    const Certificate reference = certify(field, inner_level, outer_level, mesh);
    REQUIRE(reference.verdict(Claim::ONE_SHEET) == Verdict::REFUTED);
    by_all.verify<CGAL::Sequential_tag>(mesh);
    check_conclusions(by_all, reference); // the cover of the nested components has finer boxes
    CHECK(by_all.least_gradient() == 0.75 * all.least_gradient());
  }
  // the known cover is on the other side, or covers only one side
  for(const Mesh& mesh : { right(), together(left(), right()) }) {
    const Certificate reference = certify(field, inner_level, outer_level, mesh);
    by_part.verify<CGAL::Sequential_tag>(mesh);
    check_equal(by_part, reference);
    CHECK(by_part.is_certified());
    CHECK(by_part.least_gradient() == reference.least_gradient());
  }
  by_part.verify<CGAL::Sequential_tag>(left());
  CHECK(by_part.least_gradient() == 0.75 * of_left.least_gradient());
  // The shell's report has no bound on the gradient.
  const Shell silent = shell_with_cover(field, all, 0);
  Certificate by_silent(silent);
  CHECK(by_silent.verify<CGAL::Sequential_tag>(left()));
  CHECK(by_silent.least_gradient() == of_left.least_gradient());
}

TEST_CASE("Certificate: paths separate mesh components that share a cover component")
{
  // As the thickness grows, the covers of both shells meet before the shells do.
  const Field field = two_balls();
  const Mesh both = together(left(), right());
  double outer = outer_level;
  std::size_t shared = 0;
  for(; outer < 0.75; outer += 0.005) {
    const Certificate certificate = certify(field, inner_level, outer, both);
    if(certificate.verdict(Claim::GRADIENT) != Verdict::PROVED) break;
    CAPTURE(outer);
    CHECK(certificate.is_certified());
    if(certificate.number_of_covers() == 2) continue;
    ++shared;
    CHECK(certificate.number_of_covers() == 1);
    CHECK(certificate.paths().size() == 2);
    CHECK(certificate.components() == std::vector<std::size_t>{ 0, 1 });
    // One component too many, beside the one on the path or in place of the other ball's: no count is one.
    CHECK(certify(field, inner_level, outer, together(left(), left(0.47))).verdict(Claim::ONE_SHEET)
          == Verdict::REFUTED);
    CHECK_FALSE(certify(field, inner_level, outer, together(both, left(0.47))).is_certified());
    // An inverted component is not transversal, so nothing else is proved.
    Mesh turned = together(left(), right());
    for(auto v : turned.vertices())
      if(turned.point(v).x() > 0)
        turned.point(v) = Point_3(turned.point(v).x(), turned.point(v).y(), -turned.point(v).z());
    const Certificate inside_out = certify(field, inner_level, outer, turned);
    CHECK(inside_out.verdict(Claim::TRANSVERSALITY) == Verdict::REFUTED);
    CHECK(inside_out.verdict(Claim::ONE_SHEET) == Verdict::UNDECIDED);
  }
  CHECK(shared > 0);
}

TEST_CASE("Certificate: paths do not separate mesh components that share a cover component if facets fold over")
{
  const Field field = two_balls();
  const auto folded = [](Mesh mesh) {
    // A vertex is moved past a neighbor, on the sphere.
    Kernel::Vector_3 center(0, 0, 0);
    for(auto v : mesh.vertices()) center = center + (mesh.point(v) - CGAL::ORIGIN) / double(mesh.number_of_vertices());
    const auto h = *mesh.halfedges().begin();
    Point_3& p = mesh.point(mesh.source(h));
    const Kernel::Vector_3 from = p - (CGAL::ORIGIN + center), past = from + 1.5 * (mesh.point(mesh.target(h)) - p);
    p = CGAL::ORIGIN + center + past * std::sqrt(from.squared_length() / past.squared_length());
    return mesh;
  };
  std::size_t shared = 0;
  for(double outer = outer_level; outer < 0.75; outer += 0.005) {
    const Certificate whole = certify(field, inner_level, outer, together(left(), right()));
    if(whole.verdict(Claim::GRADIENT) != Verdict::PROVED) break;
    if(whole.number_of_covers() == 2) continue;
    CAPTURE(outer);
    const Certificate certificate = certify(field, inner_level, outer, together(folded(left()), right()));
    REQUIRE(certificate.verdict(Claim::CONTAINMENT) == Verdict::PROVED);
    REQUIRE(certificate.verdict(Claim::TRANSVERSALITY) == Verdict::REFUTED);
    CHECK(certificate.paths().size() == 2);
    CHECK(certificate.verdict(Claim::ONE_SHEET) == Verdict::UNDECIDED);
    ++shared;
  }
  CHECK(shared > 0);
}

TEST_CASE("Certificate: if the field changes between two verifications, the new field is examined")
{
  Field field = radial_field();
  Certificate certificate(field, Constant(0.85), Constant(1.2));
  const Mesh mesh = sphere(2);
  REQUIRE(certificate.verify<CGAL::Sequential_tag>(mesh));
  // A bump in the smallest leaves, away from the vertices of the mesh; few middles of edges are in its support.
  Eigen::VectorXd x = field.coefficients();
  const int finest = field.number_of_levels() - 1;
  int bumps = 0;
  for(Index n = 0; n < field.points(finest).size(); ++n) {
    const Index coefficient = field.coefficient_of_point(field.first_point(finest) + n);
    if(coefficient == Field::npos) continue;
    const CGAL::Bbox_3 b = field.support(coefficient);
    const Point_3 top((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2);
    const bool meets_vertex = std::any_of(mesh.vertices().begin(), mesh.vertices().end(),
                                          [&](auto v) { return CGAL::do_overlap(mesh.point(v).bbox(), b); });
    if(meets_vertex || std::abs(field.value(top).value() - 0.98) > 0.01 || bumps > 0) continue;
    x[coefficient] += 1;
    ++bumps;
  }
  REQUIRE(bumps == 1);
  field.set_coefficients(x);
  REQUIRE(certify(field, 0.85, 1.2, mesh).verdict(Claim::CONTAINMENT) == Verdict::REFUTED);
  CHECK_FALSE(certificate.verify<CGAL::Sequential_tag>(mesh));
  CHECK(certificate.verdict(Claim::CONTAINMENT) == Verdict::REFUTED);
}
} // namespace test_Shell_certificate_on_hierarchies
