// Bounds of a field on edges and facets: polynomials with known extrema, and fields that are sampled in exact
// arithmetic.
#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>
#include "exact_spline.h"
#include "field_on_mesh.h"

#include <CGAL/Random.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace test_level_bounds {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Level_range Range;
typedef std::array<double, 10> Nonic;

const double eps = std::numeric_limits<double>::epsilon();
const double inf = std::numeric_limits<double>::infinity();

// A polynomial: its coefficients of 1, t, t^2, ...
typedef std::vector<Rational> Polynomial;

Rational value(const Polynomial& p, const Rational& t)
{
  Rational sum(0);
  for(std::size_t n = p.size(); n-- > 0;) sum = sum * t + p[n];
  return sum;
}

// Returns the integral of the product of all (t - root).
Polynomial with_critical_points(const std::vector<Rational>& roots)
{
  Polynomial p = { Rational(1) };
  for(const Rational& root : roots) {
    p.push_back(Rational(0));
    for(std::size_t n = p.size(); n-- > 0;) p[n] = (n > 0 ? p[n - 1] : Rational(0)) - root * p[n];
  }
  Polynomial integral = { Rational(0) };
  for(std::size_t n = 0; n < p.size(); ++n) integral.push_back(p[n] / Rational(int(n) + 1));
  return integral;
}

Nonic bernstein(const Polynomial& p)
{
  const auto binomial = [](int n, int k) {
    Rational r(1);
    for(int m = 0; m < k; ++m) r = r * (n - m) / (m + 1);
    return r;
  };
  Nonic b;
  for(int m = 0; m < 10; ++m) {
    Rational sum(0);
    for(int k = 0; k <= m && k < int(p.size()); ++k) sum += binomial(m, k) / binomial(9, k) * p[k];
    b[m] = CGAL::to_double(sum);
  }
  return b;
}

double de_casteljau(Nonic b, double t)
{
  for(int n = 9; n > 0; --n)
    for(int i = 0; i < n; ++i) b[i] = (1 - t) * b[i] + t * b[i + 1];
  return b[0];
}

double largest(const Nonic& b)
{
  double m = 0;
  for(double x : b) m = (std::max)(m, std::abs(x));
  return m;
}

BS::Facet_ranges facet_ranges(const Field_on_mesh& problem)
{
  return BS::facet_ranges<CGAL::Sequential_tag>(problem.field, problem.clipped);
}

CGAL::Bbox_3 around(const Point_3& p)
{
  return (p + Vector_3(-1.01, -1.02, -0.99)).bbox() + (p + Vector_3(1, 1, 1)).bbox();
}

} // namespace

TEST_CASE("Extrema on an edge: polynomials with known critical points have the expected range")
{
  const auto r = [](int a, int b) { return Rational(a, b); };
  const std::vector<std::vector<Rational> > cases = { {},
                                                      { r(1, 3) },
                                                      { r(1, 4), r(2, 3) },
                                                      { r(1, 7), r(1, 2), r(9, 10) },
                                                      { r(1, 9), r(2, 9), r(3, 9), r(4, 9), r(5, 9), r(6, 9), r(7, 9),
                                                        r(8, 9) },
                                                      { r(-1, 2), r(1, 2), r(3, 2) }, // some roots beyond the ends
                                                      { r(-2, 1), r(5, 1), r(9, 1) }, // all roots beyond the ends
                                                      { r(0, 1), r(1, 1) },           // roots at the ends
                                                      { r(1, 2), r(1, 2) },
                                                      { r(1, 3), r(1, 3), r(3, 4) }, // no extremum at a double root
                                                      { r(1, 2), r(1, 2), r(1, 2) }, // extremum at a triple root
                                                      { r(1, 2), r(1, 2), r(1, 2), r(1, 2), r(1, 2), r(1, 2), r(1, 2) },
                                                      { r(1, 1000), r(999, 1000) },
                                                      { r(1, 2), r(501, 1000) },
                                                      { r(1, 3), r(10000, 1) },
                                                      { r(1, 3), r(-10000000, 1) } }; // some are nearly zero
  for(const std::vector<Rational>& roots : cases)
    for(double scale : { 1., -1., 1e-200, 1e200 })
      for(int constant : { 0, 100 }) {
        Polynomial p = with_critical_points(roots);
        p[0] += constant;
        for(Rational& x : p) x *= Rational(scale);
        Rational least = value(p, Rational(0)), most = least;
        std::vector<Rational> candidates = roots;
        candidates.push_back(Rational(1));
        for(const Rational& t : candidates) {
          if(t < 0 || t > 1) continue;
          least = (std::min)(least, value(p, t));
          most = (std::max)(most, value(p, t));
        }
        const Nonic b = bernstein(p);
        const Range range = BS::bernstein_range(b);
        // Coefficients and de Casteljau's algorithm are rounded. An error of a critical point has a quadratic effect.
        const double rounding = 32 * eps * largest(b);
        CAPTURE(roots.size(), scale, constant);
        CHECK(std::abs(range.min - CGAL::to_double(least)) <= rounding);
        CHECK(std::abs(range.max - CGAL::to_double(most)) <= rounding);
      }
}

TEST_CASE("Extrema on an edge: the range encloses all samples, and is attained")
{
  CGAL::Random random(1);
  for(int n = 0; n < 300; ++n) {
    Nonic b;
    for(double& x : b) x = random.get_double(-1, 1);
    if(n % 3 == 1)
      for(double& x : b) x += 1000;
    if(n % 3 == 2)
      for(int m = 0; m < 10; ++m) b[m] = m + 0.3 * b[m]; // nearly monotone
    const Range range = BS::bernstein_range(b);
    double least = inf, most = -inf;
    constexpr int samples = 2000;
    for(int i = 0; i <= samples; ++i) {
      const double x = de_casteljau(b, double(i) / samples);
      least = (std::min)(least, x);
      most = (std::max)(most, x);
    }
    const double rounding = 32 * eps * largest(b);
    // Second derivatives are at most 72 times the second differences of coefficients, which are at most 4.
    const double between = 72 * 4 / 8. / samples / samples + rounding;
    CHECK(range.min <= least + rounding);
    CHECK(range.max >= most - rounding);
    CHECK(range.min >= least - between);
    CHECK(range.max <= most + between);
  }
}

TEST_CASE("Extrema on an edge: the range of a constant is its value")
{
  for(double x : { 0., 1., -3.25, 1e300, 5e-324 }) {
    Nonic b;
    b.fill(x);
    const Range range = BS::bernstein_range(b);
    CHECK(range.min == Approx(x).epsilon(eps));
    CHECK(range.max == Approx(x).epsilon(eps));
  }
}

TEST_CASE("Facet bounds: bounds enclose exact values of the spline on the whole facet")
{
  const Point_3 center = GENERATE(Point_3(0, 0, 0), Point_3(1e6, -1e6, 1234.5));
  Field_on_mesh problem(sphere(1, 1, center), BS::Lattice_3(around(center), 0.3));
  problem.set_noisy_distance(0.05, 2, center);
  const BS::Facet_ranges ranges = facet_ranges(problem);
  REQUIRE(ranges.facet.size() == problem.input.mesh().number_of_faces());
  const int resolution = 5;
  int outside_facet = 0, outside_mesh = 0;
  std::size_t n = 0;
  for(auto f : problem.input.mesh().faces()) {
    const auto t = problem.input.triangle(f);
    const Exact_point p = exact(t[0]), q = exact(t[1]), r = exact(t[2]);
    for(int i = 0; i <= resolution; ++i)
      for(int j = 0; i + j <= resolution; ++j) {
        Exact_point x;
        for(int a = 0; a < 3; ++a) x[a] = (i * p[a] + j * q[a] + (resolution - i - j) * r[a]) / Rational(resolution);
        const Rational y = exact_value(problem.field, x);
        outside_facet += y < Rational(ranges.facet[n].min) || y > Rational(ranges.facet[n].max);
        outside_mesh += y < Rational(ranges.mesh.min) || y > Rational(ranges.mesh.max);
      }
    ++n;
  }
  CHECK(outside_facet == 0);
  CHECK(outside_mesh == 0);

  // Extrema on the edges of pieces are values on the mesh.
  const Range edges = BS::edge_range<CGAL::Sequential_tag>(problem.field, problem.clipped);
  CHECK(edges.min >= ranges.mesh.min);
  CHECK(edges.max <= ranges.mesh.max);
  for(const Range& facet : ranges.facet) CHECK(facet.min <= facet.max);
}

TEST_CASE("Facet bounds: the range of the mesh exceeds the attained values by at most the tolerance")
{
  Field_on_mesh problem(sphere(1), BS::Lattice_3(around(CGAL::ORIGIN), 0.3));
  problem.set_noisy_distance(0.05, 3);
  Range sampled;
  const int resolution = 60;
  for(auto f : problem.input.mesh().faces()) {
    const auto t = problem.input.triangle(f);
    for(int i = 0; i <= resolution; ++i)
      for(int j = 0; i + j <= resolution; ++j)
        sampled.include(*problem.field.value(CGAL::barycenter(t[0], i, t[1], j, t[2], double(resolution - i - j))));
  }
  // Samples are at most 0.01 from any point (sides of 0.62 in 60 parts). Sampled extrema differ from the true ones by
  // at most half the square of that, times second derivatives. These are 1 for the distance, plus 12 times the noise
  // over the squared spacing.
  const double between = 0.01 * 0.01 / 2 * (1 + 12 * 0.05 / 0.09);
  for(double tolerance : { 1e-1, 1e-2, 1e-4 }) {
    const Range mesh = BS::facet_ranges<CGAL::Sequential_tag>(problem.field, problem.clipped, tolerance).mesh;
    const double allowed = tolerance * (sampled.max - sampled.min + 2 * between) + between;
    CAPTURE(tolerance);
    CHECK(mesh.max <= sampled.max + allowed);
    CHECK(mesh.min >= sampled.min - allowed);
    CHECK(mesh.max >= sampled.max);
    CHECK(mesh.min <= sampled.min);
  }
  // Extrema on the edges of pieces are close to these, but are not bounds: samples inside facets exceed them.
  const Range edges = BS::edge_range<CGAL::Sequential_tag>(problem.field, problem.clipped);
  CHECK(edges.max - edges.min > 0.5 * (sampled.max - sampled.min));
  CHECK((sampled.max > edges.max || sampled.min < edges.min));
}

TEST_CASE("Facet bounds: a peak between the edges is enclosed")
{
  // -(u - 1/2)^2 - (v - 1/4)^2 in units of the lattice. On the top and bottom of a box, the peak is inside a piece.
  Field_on_mesh problem(box(Point_3(-1, -1, -1), Point_3(1, 1, 1)),
                        BS::Lattice_3(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.5));
  problem.set([](const Point_3& p) {
    const double u = 2 * p.x(), v = 2 * p.y();
    return -(u * u - 1 / 3. - u + 0.25) - (v * v - 1 / 3. - v / 2 + 0.0625);
  });
  // the closest edges: those of lattice planes at a distance of 1/4, and the diagonal of a side, depending on its
  // direction
  double expected = -1 / 16.;
  for(auto e : problem.input.mesh().edges()) {
    const Vector_3 d = problem.input.mesh().point(problem.input.mesh().vertex(e, 0))
                       - problem.input.mesh().point(problem.input.mesh().vertex(e, 1));
    if(d.x() == d.y() && d.x() != 0) expected = -1 / 32.;
  }
  const double lowest = -(2.5 * 2.5 + 2.25 * 2.25); // at a corner of the box
  const double rounding = 64 * eps * 16;            // the largest coefficient is less than 16
  const Range edges = BS::edge_range<CGAL::Sequential_tag>(problem.field, problem.clipped);
  CHECK(std::abs(edges.max - expected) <= rounding);
  CHECK(std::abs(edges.min - lowest) <= rounding);
  double last = inf;
  for(double tolerance : { 1e-1, 1e-3, 1e-6, 1e-9 }) {
    const Range mesh = BS::facet_ranges<CGAL::Sequential_tag>(problem.field, problem.clipped, tolerance).mesh;
    CAPTURE(tolerance);
    CHECK(mesh.max >= -rounding); // coefficients are rounded
    CHECK(mesh.min <= lowest + rounding);
    CHECK(mesh.max <= tolerance * (0 - lowest) + 10 * rounding);
    CHECK(mesh.min >= lowest - tolerance * (0 - lowest) - 10 * rounding);
    CHECK(mesh.max - mesh.min <= last);
    last = mesh.max - mesh.min;
  }
}

TEST_CASE("Facet bounds: a peak is enclosed, wherever it lies on the facet")
{
  Field_on_mesh problem(box(Point_3(-1, -1, -1), Point_3(1, 1, 1)),
                        BS::Lattice_3(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.5));
  CGAL::Random random(6);
  for(int n = 0; n < 30; ++n) {
    const double a = random.get_double(-2, 2), b = random.get_double(-2, 2);
    problem.set([&](const Point_3& p) {
      const double u = 2 * p.x(), v = 2 * p.y();
      return -(u * u - 1 / 3. - 2 * a * u + a * a) - (v * v - 1 / 3. - 2 * b * v + b * b);
    });
    const double tolerance = 1e-9,
                 lowest = -(2 + std::abs(a)) * (2 + std::abs(a)) - (2 + std::abs(b)) * (2 + std::abs(b));
    const double rounding = 640 * eps * 50; // as above; the largest coefficient is less than 50
    const Range mesh = BS::facet_ranges<CGAL::Sequential_tag>(problem.field, problem.clipped, tolerance).mesh;
    CHECK(mesh.max >= -rounding);
    CHECK(mesh.max <= -tolerance * lowest + rounding);
    CHECK(mesh.min <= lowest + rounding);
    CHECK(mesh.min >= (1 + tolerance) * lowest - rounding);
  }
}

TEST_CASE("Facet bounds: the bounds on a linear field are its values at the vertices")
{
  const Mesh mesh = sphere(1);
  Field_on_mesh problem(mesh, BS::Lattice_3(around(CGAL::ORIGIN), 0.3));
  const Vector_3 d(1, -2, 3);
  problem.set([&](const Point_3& p) { return d * (p - CGAL::ORIGIN); });
  // allowances of Piece_in_cell and Form_error: values are up to 10, and vary by 2 in a cell; coordinates are up to 4
  // spacings
  const double allowance = eps * (57 * 10 + 9 * 2 * (64 * 5 + 32));
  const BS::Facet_ranges ranges = facet_ranges(problem);
  Range whole;
  std::size_t n = 0;
  for(auto f : problem.input.mesh().faces()) {
    Range facet;
    for(const Point_3& p : problem.input.triangle(f)) facet.include(d * (p - CGAL::ORIGIN));
    whole.include(facet);
    CHECK(ranges.facet[n].min == Approx(facet.min).epsilon(0).margin(2 * allowance));
    CHECK(ranges.facet[n].max == Approx(facet.max).epsilon(0).margin(2 * allowance));
    ++n;
  }
  CHECK(ranges.mesh.min == Approx(whole.min).epsilon(0).margin(2 * allowance));
  CHECK(ranges.mesh.max == Approx(whole.max).epsilon(0).margin(2 * allowance));
  const Range edges = BS::edge_range<CGAL::Sequential_tag>(problem.field, problem.clipped);
  CHECK(edges.min == Approx(whole.min).epsilon(0).margin(allowance));
  CHECK(edges.max == Approx(whole.max).epsilon(0).margin(allowance));
}

TEST_CASE("Facet bounds: the allowance for rounding is necessary and sufficient")
{
  // The field is linear, far from the origin. Coefficients of the form are values of the field, so there is no slack
  // between them.
  const Point_3 center(1e6, -1e6, 1234.5);
  Field_on_mesh problem(sphere(2, 1, center), BS::Lattice_3(around(center), 0.3));
  const BS::Lattice_3& lattice = problem.field.cells().lattice();
  problem.set([&](const Point_3& p) {
    const auto g = [&](int a) { return (p[a] - lattice.origin()[std::size_t(a)]) / lattice.spacing(); };
    return g(0) + 0.7 * g(1) - 0.3 * g(2) + 100.1;
  });
  const BS::Facet_ranges ranges = facet_ranges(problem);
  int outside = 0, beyond_values = 0;
  std::size_t n = 0;
  for(auto f : problem.input.mesh().faces()) {
    Range rounded;
    for(const Point_3& p : problem.input.triangle(f)) rounded.include(*problem.field.value(p));
    for(const Point_3& p : problem.input.triangle(f)) {
      const Rational y = exact_value(problem.field, exact(p));
      outside += y < Rational(ranges.facet[n].min) || y > Rational(ranges.facet[n].max);
      beyond_values += y < Rational(rounded.min) || y > Rational(rounded.max);
    }
    ++n;
  }
  CHECK(outside == 0);
  CHECK(beyond_values > 0);
}

TEST_CASE("Facet bounds: the result does not depend on the number of threads")
{
  Field_on_mesh problem(sphere(2), BS::Lattice_3(around(CGAL::ORIGIN), 0.1));
  REQUIRE(problem.clipped.number_of_pieces() > 3000); // several chunks
  problem.set_noisy_distance(0.01, 4);
  const BS::Facet_ranges a = facet_ranges(problem);
  const BS::Facet_ranges b = BS::facet_ranges<CGAL::Parallel_if_available_tag>(problem.field, problem.clipped);
  CHECK((a.mesh.min == b.mesh.min && a.mesh.max == b.mesh.max));
  int different = 0;
  for(std::size_t n = 0; n < a.facet.size(); ++n)
    different += a.facet[n].min != b.facet[n].min || a.facet[n].max != b.facet[n].max;
  CHECK(different == 0);
  const Range c = BS::edge_range<CGAL::Sequential_tag>(problem.field, problem.clipped);
  const Range d = BS::edge_range<CGAL::Parallel_if_available_tag>(problem.field, problem.clipped);
  CHECK((c.min == d.min && c.max == d.max));
}

TEST_CASE("Level range: a range is empty until it includes a value")
{
  Range r;
  CHECK(r.min > r.max);
  r.include(Range());
  CHECK(r.min > r.max);
  r.include(2);
  CHECK((r.min == 2 && r.max == 2));
  Range s;
  s.include(-1);
  r.include(s);
  CHECK((r.min == -1 && r.max == 2));
}

TEST_CASE("Rounding of thresholds: thresholds are rounded outwards, at most to the next multiple")
{
  const auto check = [](double x, double y, double quantum) {
    const Range r = BS::round_outwards({ x, y }, quantum);
    CAPTURE(x, y, quantum);
    CHECK(r.min <= x);
    CHECK(r.max >= y);
    CHECK(std::isfinite(r.min));
    CHECK(std::isfinite(r.max));
    const double bits = 2 * eps * (std::abs(x) + std::abs(y) + quantum);
    CHECK(x - r.min <= quantum + bits);
    CHECK(r.max - y <= quantum + bits);
  };
  CGAL::Random random(5);
  for(int n = 0; n < 20000; ++n) {
    const double quantum = std::pow(10, random.get_double(-20, 3));
    const double x = random.get_double(-1, 1) * std::pow(10, random.get_double(-12, 3));
    const double y = x + std::pow(10, random.get_double(-16, 1));
    check(x, y, quantum);
    // multiples of the quantum, rounded to either side
    const double m = std::round(x / quantum) * quantum;
    check(m, m, quantum);
    check(std::nextafter(m, -inf), std::nextafter(m, inf), quantum);
  }
  // a quantum below the last bit, quanta so small that the multiple overflows, and huge ones
  for(double quantum : { 1e-18, 1e-300, 1e-310, 5e-324, 1e10, 1e300 })
    for(double x : { 1., -1., 0.1, -0.1, 1e300, -1e300, 1e-300, 0. }) check(x, x, quantum);
}

TEST_CASE("Rounding of thresholds: multiples are unchanged")
{
  const Range r = BS::round_outwards({ -0.375, 1.25 }, 0.125), s = BS::round_outwards({ -0.375, 1.25 }, 1);
  CHECK((r.min == -0.375 && r.max == 1.25));
  CHECK((s.min == -1 && s.max == 2));
}
} // namespace test_level_bounds
