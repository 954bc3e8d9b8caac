// Rigorous predicates of fields: known results, exact oracles, planted faults.
#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include "exact_spline.h"
#include "test_meshes.h"

#include <CGAL/Random.h>
#include <CGAL/Simple_cartesian.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <vector>

namespace test_Field_predicates_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef BS::Field_predicates_3<Field> Predicates;
typedef std::array<Point_3, 3> Triangle;
typedef BS::Verdict Verdict;

// Returns a field on all cells of a cube about a center: eight cells of width `scale` per side.
Field cube_field(const Point_3& center = CGAL::ORIGIN, double scale = 1)
{
  const double h = 4 * scale;
  const BS::Lattice_3 lattice(
    CGAL::Bbox_3(center.x() - h, center.y() - h, center.z() - h, center.x() + h, center.y() + h, center.z() + h),
    scale);
  std::vector<std::uint64_t> keys;
  for(int k = -4; k < 4; ++k)
    for(int j = -4; j < 4; ++j)
      for(int i = -4; i < 4; ++i) keys.push_back(BS::Lattice_key::encode(i, j, k));
  return Field(BS::Cell_complex_3(lattice, keys));
}

// Sets the coefficients by a function of the lattice point, relative to the center.
template <typename Function>
void set(Field& field, const Function& f, double scale = 1)
{
  Eigen::VectorXd x(field.number_of_coefficients());
  for(std::size_t n = 0; n < field.number_of_coefficients(); ++n) {
    const BS::Lattice_3::Point& p = field.points(0).point(BS::Cell_complex_3::Index(n));
    x[Eigen::Index(n)] = scale * f(double(p[0]), double(p[1]), double(p[2]));
  }
  field.set_coefficients(x);
}

// A spline whose coefficients are a linear function equals that function.
Field linear_field(double a, double b, double c)
{
  Field field = cube_field();
  set(field, [=](double x, double y, double z) { return a * x + b * y + c * z; });
  return field;
}

Field random_field(unsigned seed)
{
  Field field = cube_field();
  CGAL::Random random(seed);
  set(field, [&](double, double, double) { return random.get_double(-1, 1); });
  return field;
}

Point_3 random_point(CGAL::Random& random, double reach)
{
  return Point_3(random.get_double(-reach, reach), random.get_double(-reach, reach), random.get_double(-reach, reach));
}

const double inf = std::numeric_limits<double>::infinity();

} // namespace

TEST_CASE("Predicates: a peak inside a facet is detected, even if all edges are lower")
{
  // f = -(x^2 + y^2): coefficients -(i^2 + j^2) + 2/3
  Field field = cube_field();
  set(field, [](double x, double y, double) { return -(x * x + y * y) + 2. / 3; });
  const Predicates predicates(field);
  const Triangle t = { Point_3(-1, -1, .1), Point_3(1.5, -1, .1), Point_3(0, 2, .1) };
  double edges = -inf;
  for(int e = 0; e < 3; ++e)
    for(int n = 0; n <= 100; ++n) {
      const Point_3 p = t[e] + n / 100. * (t[(e + 1) % 3] - t[e]);
      edges = (std::max)(edges, -(p.x() * p.x() + p.y() * p.y()));
    }
  REQUIRE(edges < -0.3);
  BS::Witness witness;
  CHECK(predicates.values_within(t, { -10, edges }, &witness) == Verdict::REFUTED);
  CHECK(witness.value.min > edges);
  CHECK(predicates.values_within(t, { -10, -1e-9 }) == Verdict::REFUTED);
  CHECK(predicates.values_within(t, { -10, 1e-9 }) == Verdict::PROVED);
}

TEST_CASE("Predicates: facets tilted by 1e-9 from the gradient are classified correctly")
{
  const Field field = linear_field(0, 0, 1);
  const Predicates predicates(field);
  const Point_3 p(0, 0, 0), q(2, 0, 0);
  CHECK(predicates.crosses_upwards({ p, q, Point_3(0, 2, 0) }) == Verdict::PROVED);
  CHECK(predicates.crosses_upwards({ q, p, Point_3(0, 2, 0) }) == Verdict::REFUTED);
  // nearly along the gradient, from either side
  CHECK(predicates.crosses_upwards({ p, q, Point_3(0, 1e-9, 2) }) == Verdict::PROVED);
  CHECK(predicates.crosses_upwards({ p, q, Point_3(0, -1e-9, 2) }) == Verdict::REFUTED);
  // Exactly along the gradient, the slope is zero: not proved. Only exact arithmetic could refute it.
  CHECK(predicates.crosses_upwards({ p, q, Point_3(0, 0, 2) }) != Verdict::PROVED);
}

TEST_CASE("Predicates: a needle of width 1e-12 is classified by its exact normal")
{
  const Field field = linear_field(0, 0, 1);
  const Predicates predicates(field);
  const Point_3 p(-1.1, 0.3, 0.7), q(2.3, 1.1, 0.9);
  const Point_3 up = CGAL::midpoint(p, q) + Vector_3(-0.8e-12, 3.4e-12, 0);
  // Whatever the rounding of the third vertex, the sign of the exact normal's z decides.
  const auto up_part = [&](const Point_3& r) -> Rational {
    return (Rational(q.x()) - Rational(p.x())) * (Rational(r.y()) - Rational(p.y()))
           - (Rational(q.y()) - Rational(p.y())) * (Rational(r.x()) - Rational(p.x()));
  };
  REQUIRE(up_part(up) > 0);
  CHECK(predicates.crosses_upwards({ p, q, up }) == Verdict::PROVED);
  CHECK(predicates.crosses_upwards({ q, p, up }) == Verdict::REFUTED);
}

TEST_CASE("Predicates: facets in lattice planes and through lattice corners are decided like others")
{
  Field field = cube_field();
  set(field, [](double x, double y, double z) { return z + 0.05 * std::sin(x) * std::sin(y); });
  const Predicates predicates(field);
  const Triangle flat = { Point_3(-3, -3, 1), Point_3(3, -3, 1), Point_3(0, 3, 1) };
  CHECK(predicates.crosses_upwards(flat) == Verdict::PROVED);
  CHECK(predicates.values_within(flat, { 0.9, 1.1 }) == Verdict::PROVED);
  CHECK(predicates.values_within(flat, { 1, 1.1 }) == Verdict::REFUTED);
}

TEST_CASE("Predicates: a facet that leaves the domain is not within any levels")
{
  const Field field = linear_field(1, 0, 0);
  const Predicates predicates(field);
  BS::Witness witness;
  CHECK(
    predicates.values_within(Triangle{ Point_3(0, 0, 0), Point_3(9, 0, 0), Point_3(0, 1, 0) }, { -100, 100 }, &witness)
    == Verdict::REFUTED);
  CHECK(witness.outside);
  CHECK(predicates.values_within(Triangle{ Point_3(20, 0, 0), Point_3(21, 0, 0), Point_3(20, 1, 0) }, { -100, 100 })
        == Verdict::REFUTED);
  CHECK(predicates.values_within(Triangle{ Point_3(4, 0, 0), Point_3(4, 1, 0), Point_3(4, 0, 1) }, { 3, 5 })
        != Verdict::REFUTED); // on the boundary, which belongs to the domain
  // This must take no time, whatever the size.
  for(double far : { 1e9, 1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() }) {
    CHECK(predicates.values_within(Triangle{ Point_3(0, 0, 0), Point_3(far, 0, 0), Point_3(0, far, 0) }, { -100, 100 })
          == Verdict::REFUTED);
    CHECK(predicates.increases({ Point_3(0, 0, 0), Point_3(far, 0, 0) }) != Verdict::PROVED);
  }
  const Field nowhere;
  CHECK(
    Predicates(nowhere).values_within(Triangle{ Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0) }, { -100, 100 })
    == Verdict::REFUTED);
}

TEST_CASE("Predicates: the cost of a long needle is linear in its length")
{
  const Field field = linear_field(0, 0, 1);
  const Predicates predicates(field);
  BS::Predicate_statistics statistics;
  const Triangle needle = { Point_3(-3.9, -3.7, 1), Point_3(3.9, 3.8, 1.5), Point_3(3.9, 3.8 + 1e-9, 1.5) };
  CHECK(predicates.values_within(needle, { 0.9, 1.6 }, nullptr, &statistics) == Verdict::PROVED);
  CHECK(statistics.by_cell + statistics.by_form < 200);
}

TEST_CASE("Predicates: a facet that spans many cells is decided, however many subdivisions this takes")
{
  // The field has waves, on two layers of cells. They are higher inside the cells than on the facet between the layers.
  constexpr int half = 80;
  std::vector<std::uint64_t> keys;
  for(int k = -1; k < 1; ++k)
    for(int j = -half; j < half; ++j)
      for(int i = -half; i < half; ++i) keys.push_back(BS::Lattice_key::encode(i, j, k));
  Field field(BS::Cell_complex_3(BS::Lattice_3(CGAL::Bbox_3(-half, -half, -half, half, half, half), 1), keys));
  set(field, [](double x, double y, double z) { return (z == 0 ? -0.25 : 1) * (int(x + y) % 2 ? 1 : -1); });
  // On the facet, values lie between +-(1 - 4/4 + 1)/6 times +-1/3 along x and y.
  const double highest = 1. / 54;
  const Predicates predicates(field);
  const Triangle t = { Point_3(-79.3, -79.2, 0), Point_3(79.4, -79.1, 0), Point_3(-78.3, 79.3, 0) };
  BS::Predicate_statistics statistics;
  CHECK(predicates.values_within(t, { -1.2 * highest, 1.2 * highest }, nullptr, &statistics) == Verdict::PROVED);
  CHECK(statistics.subdivisions > 20000);
  CHECK(predicates.values_within(t, { -0.99 * highest, 1.2 * highest }) == Verdict::REFUTED);
}

TEST_CASE("Predicates: answers are undecided if a coefficient or a level is not finite")
{
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for(double bad : { not_a_number, inf, -inf }) {
    Field field = linear_field(0, 0, 1);
    Eigen::VectorXd x = field.coefficients();
    x[field.points(0).index(0, 0, 0)] = bad;
    field.set_coefficients(x);
    const Predicates predicates(field);
    const Triangle t = { Point_3(0.1, 0.2, 0.3), Point_3(1, 0.2, 0.3), Point_3(0.1, 1, 0.4) };
    CHECK_FALSE(predicates.compare(t[0], 0));
    CHECK_FALSE(predicates.is_beyond(t[0], BS::Constant_threshold(-100), CGAL::POSITIVE));
    CHECK(predicates.values_within(t, { -100, 100 }) == Verdict::UNDECIDED);
    CHECK(predicates.values_within(t, { 99, 100 }) == Verdict::UNDECIDED);
    double slope = 0;
    CHECK(predicates.crosses_upwards(t, nullptr, nullptr, &slope) == Verdict::UNDECIDED);
    CHECK(slope == 0);
    CHECK(predicates.increases({ t[0], t[1] }) == Verdict::UNDECIDED);
    // Other facets are decided as usual.
    const Triangle away = { Point_3(2.1, 0.2, 0.3), Point_3(3, 0.2, 0.3), Point_3(2.1, 1, 0.4) };
    CHECK(predicates.values_within(away, { 0, 1 }) == Verdict::PROVED);
    CHECK(predicates.crosses_upwards(away) == Verdict::PROVED);
    CHECK(predicates.compare(away[0], 0) == CGAL::LARGER);
    CHECK_FALSE(predicates.compare(away[0], not_a_number));
    CHECK(predicates.values_within(away, { 0, not_a_number }) == Verdict::UNDECIDED);
  }
}

TEST_CASE("Predicates: the bound on a slope beyond the largest double is finite")
{
  constexpr double largest = std::numeric_limits<double>::max(), scale = 1e-20;
  Field field = cube_field(CGAL::ORIGIN, scale);
  set(field, [](double, double, double z) { return 1e300 * z; });
  double slope = 0;
  const Triangle t = { Point_3(0, 0, 0), Point_3(scale, 0, 0), Point_3(0, scale, 0) };
  CHECK(Predicates(field).crosses_upwards(t, nullptr, nullptr, &slope) == Verdict::PROVED);
  CHECK(slope > largest / 2);
  CHECK(slope <= largest);
}

TEST_CASE("Predicates: a point one ulp outside the domain is not beyond a varying threshold")
{
  const Field field = linear_field(1, 0, 0);
  const BS::Spline_threshold<Field> threshold(linear_field(0.5, 0, 0));
  const Predicates predicates(field);
  CHECK(predicates.is_beyond(Point_3(4, 0.3, 0.2), threshold, CGAL::POSITIVE));
  CHECK_FALSE(predicates.is_beyond(Point_3(std::nextafter(4., 5.), 0.3, 0.2), threshold, CGAL::POSITIVE));
}

TEST_CASE("Predicates: a proved increase along a segment agrees with exact values")
{
  const Field field = random_field(21);
  const Predicates predicates(field);
  CGAL::Random random(22);
  int proved = 0;
  for(int n = 0; n < 60; ++n) {
    const Point_3 p = random_point(random, 3.5);
    const Vector_3 g = *field.gradient(p);
    const Point_3 q = p + random.get_double(0.01, 0.4) / std::sqrt(g.squared_length()) * g;
    const Verdict verdict = predicates.increases({ p, q });
    bool increases = true;
    Rational last = exact_value(field, exact(p));
    for(int i = 1; i <= 16; ++i) {
      std::array<Rational, 3> x;
      for(int a = 0; a < 3; ++a) x[a] = (Rational(16 - i) * p[a] + Rational(i) * q[a]) / 16;
      const Rational f = exact_value(field, x);
      increases = increases && f > last;
      last = f;
    }
    if(verdict == Verdict::PROVED) {
      ++proved;
      CHECK(increases);
    }
    if(!increases) CHECK(verdict == Verdict::REFUTED);
    CHECK(predicates.increases({ q, p }) != Verdict::PROVED);
  }
  CHECK(proved > 20);
}

TEST_CASE("Predicates: between varying thresholds, answers agree with values, and witnesses with exact values")
{
  typedef BS::Spline_threshold<Field> Varying;
  std::array<int, 2> beyond_it = {}, refuted = {}; // by the inner threshold, and by the outer one
  int within = 0;
  for(unsigned seed = 60; seed < 64; ++seed) {
    const Field field = random_field(seed);
    const Predicates predicates(field);
    CGAL::Random random(seed);
    const auto noisy = [&](double level) {
      Field threshold = cube_field();
      set(threshold, [&](double, double, double) { return level + random.get_double(-0.5, 0.5); });
      return threshold;
    };
    const std::array<Field, 2> level = { noisy(-0.1), noisy(0.1) };
    const std::array<Varying, 2> threshold = { Varying(level[0]), Varying(level[1]) };
    for(int n = 0; n < 60; ++n) {
      const double size = std::ldexp(4., -(n % 5));
      const Point_3 p = random_point(random, 2);
      const Triangle t = { p, p + size / 2 * (random_point(random, 1) - CGAL::ORIGIN),
                           p + size / 2 * (random_point(random, 1) - CGAL::ORIGIN) };
      const std::array<Point_3, 2> edge = { t[0], t[1] };
      // by how much the field exceeds each threshold at most
      const auto beyond = [&](int side, const Point_3& x) {
        return (side == 0 ? -1 : 1) * (*field.value(x) - *level[side].value(x));
      };
      std::array<double, 2> on_facet = { -inf, -inf }, on_edge = on_facet;
      for(int i = 0; i <= 12; ++i)
        for(int j = 0; i + j <= 12; ++j)
          for(int side = 0; side < 2; ++side) {
            const double b = beyond(side, CGAL::barycenter(t[0], 12. - i - j, t[1], i, t[2], j));
            on_facet[side] = (std::max)(on_facet[side], b);
            if(j == 0) on_edge[side] = (std::max)(on_edge[side], b);
          }
      const auto check = [&](const auto& simplex, const std::array<double, 2>& farthest) {
        BS::Witness witness;
        const Verdict verdict = predicates.values_within(simplex, threshold[0], threshold[1], &witness);
        const bool leaves = farthest[0] > 1e-9 || farthest[1] > 1e-9;
        if(leaves) CHECK(verdict == Verdict::REFUTED);
        within += verdict == Verdict::PROVED;
        if(verdict != Verdict::REFUTED) return;
        Exact_point x;
        for(int a = 0; a < 3; ++a) {
          x[a] = 0;
          for(std::size_t v = 0; v < simplex.size(); ++v) x[a] += Rational(witness.barycentric[v]) * simplex[v][a];
        }
        const Rational f = exact_value(field, x), low = f - exact_value(level[0], x),
                       high = exact_value(level[1], x) - f;
        const int side = low < 0 ? 0 : 1;
        CHECK((side == 0 ? low : high) < 0);
        CHECK(witness.value.max < 0);
        ++refuted[std::size_t(side)];
      };
      check(t, on_facet);
      check(edge, on_edge);
      for(int side = 0; side < 2; ++side)
        for(CGAL::Sign sign : { CGAL::NEGATIVE, CGAL::POSITIVE }) {
          const bool is_beyond = predicates.is_beyond(p, threshold[std::size_t(side)], sign);
          const double above = *field.value(p) - *level[std::size_t(side)].value(p);
          CHECK(is_beyond == (sign == CGAL::POSITIVE ? above > 0 : above < 0));
          beyond_it[std::size_t(side)] += is_beyond;
        }
    }
  }
  CHECK(within > 20);
  for(int side = 0; side < 2; ++side) {
    CHECK(beyond_it[side] > 100);
    CHECK(refuted[side] > 50);
  }
}

TEST_CASE("Predicates: a proved increase relative to a varying threshold agrees with exact values")
{
  typedef BS::Spline_threshold<Field> Varying;
  int proved = 0, faster = 0;
  for(unsigned seed = 70; seed < 73; ++seed) {
    CGAL::Random random(seed);
    Field field = cube_field(), level = field;
    set(field, [&](double, double, double z) { return z + random.get_double(-0.3, 0.3); });
    set(level, [&](double, double, double z) { return 0.9 * z + random.get_double(-0.3, 0.3); });
    const Predicates predicates(field);
    const Varying threshold(level);
    for(int n = 0; n < 40; ++n) {
      const Point_3 p = random_point(random, 3),
                    q = p
                        + Vector_3(random.get_double(-0.2, 0.2), random.get_double(-0.2, 0.2),
                                   random.get_double(0.02, 0.9));
      const auto increases = [&](bool above) {
        bool result = true;
        Rational last;
        for(int i = 0; i <= 16; ++i) {
          Exact_point x;
          for(int a = 0; a < 3; ++a) x[a] = (Rational(16 - i) * p[a] + Rational(i) * q[a]) / 16;
          const Rational f = exact_value(field, x) - (above ? exact_value(level, x) : Rational(0));
          result = result && (i == 0 || f > last);
          last = f;
        }
        return result;
      };
      const Verdict verdict = predicates.increases_above({ p, q }, threshold);
      const bool above = increases(true);
      if(!above) CHECK(verdict == Verdict::REFUTED);
      proved += verdict == Verdict::PROVED;
      // Here, only the threshold matters.
      faster += !above && predicates.increases({ p, q }) == Verdict::PROVED;
      CHECK(predicates.increases_above({ p, q }, BS::Constant_threshold(0.3)) == predicates.increases({ p, q }));
    }
  }
  CHECK(proved > 20);
  CHECK(faster > 20);
}

TEST_CASE("Predicates: answers depend neither on a power-of-two scale nor on the rounding mode")
{
  Field field = cube_field();
  const auto f = [](double x, double y, double z) { return std::sin(x) + std::cos(2 * y) * z; };
  set(field, f);
  const double scale = std::ldexp(1., -60);
  Field small = cube_field(CGAL::ORIGIN, scale);
  set(small, f, scale);
  CGAL::Random random(31);
  for(int n = 0; n < 40; ++n) {
    const Point_3 p = random_point(random, 3), q = p + (random_point(random, 1) - CGAL::ORIGIN),
                  r = p + (random_point(random, 1) - CGAL::ORIGIN);
    const auto scaled = [&](const Point_3& x) { return Point_3(scale * x.x(), scale * x.y(), scale * x.z()); };
    const Verdict slope = Predicates(field).crosses_upwards({ p, q, r });
    const Verdict range = Predicates(field).values_within(Triangle{ p, q, r }, { -1, 1 });
    CHECK(Predicates(small).crosses_upwards({ scaled(p), scaled(q), scaled(r) }) == slope);
    CHECK(Predicates(small).values_within(Triangle{ scaled(p), scaled(q), scaled(r) }, { -scale, scale }) == range);
    for(int mode : { FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO }) {
      std::fesetround(mode);
      const Verdict other_slope = Predicates(field).crosses_upwards({ p, q, r });
      const Verdict other_range = Predicates(field).values_within(Triangle{ p, q, r }, { -1, 1 });
      const int mode_after = std::fegetround();
      std::fesetround(FE_TONEAREST);
      CHECK(mode_after == mode);
      CHECK(other_slope == slope);
      CHECK(other_range == range);
    }
  }
}

TEST_CASE("Predicates: far from the origin, a facet is decided if levels leave room for 1e-12 of the coordinates")
{
  const double far = std::ldexp(1., 20);
  const Point_3 center(far, -far, far);
  Field field = cube_field(center);
  set(field, [](double x, double y, double z) { return x + y + z; });
  const Predicates predicates(field);
  const Triangle t = { center + Vector_3(0, 0, 0), center + Vector_3(1, 0, 0), center + Vector_3(0, 1.5, 0) };
  CHECK(predicates.values_within(t, { -1e-6, 1.5 + 1e-6 }) == Verdict::PROVED);
  CHECK(predicates.values_within(t, { 1e-6, 1.5 + 1e-6 }) == Verdict::REFUTED);
  CHECK(predicates.crosses_upwards(t) == Verdict::PROVED);
}

namespace {

// Returns a field on cells of width one around the z-axis, three of the four at each height. The bits of `missing` are
// the signs of x and y of the missing cells.
Field bent_field(int missing)
{
  std::vector<std::uint64_t> keys;
  for(int k = -2; k < 2; ++k)
    for(int j = -2; j < 2; ++j)
      for(int i = -2; i < 2; ++i)
        if(((i >= 0) | (j >= 0) << 1) != missing) keys.push_back(BS::Lattice_key::encode(i, j, k));
  Field field(BS::Cell_complex_3(BS::Lattice_3(CGAL::Bbox_3(-2, -2, -2, 2, 2, 2), 1), keys));
  set(field, [](double, double, double z) { return z; });
  return field;
}

// Returns a number whose triple is rounded up, or down.
double thirds(CGAL::Random& random, bool up)
{
  for(;;) {
    const double x = random.get_double(0.2, 0.5) + std::ldexp(random.get_double(0, 1), -33);
    if(Rational(3 * x) != 3 * Rational(x) && (Rational(3 * x) > 3 * Rational(x)) == up) return x;
  }
}

} // namespace

TEST_CASE("Predicates: a simplex that leaves the domain between its corners is not proved, even by less than rounding")
{
  CGAL::Random random(41);
  for(int missing = 0; missing < 4; ++missing)
    for(int n = 0; n < 8; ++n) {
      CAPTURE(missing, n);
      const Field field = bent_field(missing);
      const Predicates predicates(field);
      const double sx = missing & 1 ? 1 : -1, sy = missing & 2 ? 1 : -1; // towards the missing cells
      // A quarter of the way, the segment is off the axis by the rounding error of tripling, on the side of the missing
      // cells.
      const double x = thirds(random, true), y = thirds(random, false);
      const Point_3 p(-sx * x, sy * y, 0.1), q(sx * 3 * x, -sy * 3 * y, 0.1), away(-sx, -sy, 0.5);
      CHECK(predicates.values_within(std::array<Point_3, 2>{ p, q }, { -1, 1 }) != Verdict::PROVED);
      CHECK(predicates.values_within(Triangle{ p, q, away }, { -1, 1 }) != Verdict::PROVED);
      // On the other side, the segment is inside.
      const Point_3 inside_p(-sx * x, sy * (y - 0.01), 0.1);
      CHECK(predicates.values_within(std::array<Point_3, 2>{ inside_p, q }, { -1, 1 }) == Verdict::PROVED);
      // Here it leaves the domain by far; its ends and most of the facet are inside.
      const Point_3 far_p(-sx, sy * 1.5, 0.1), far_q(sx * 1.5, -sy, 0.1);
      CHECK(predicates.values_within(std::array<Point_3, 2>{ far_p, far_q }, { -1, 1 }) != Verdict::PROVED);
      CHECK(predicates.values_within(Triangle{ far_p, far_q, away }, { -1, 1 }) != Verdict::PROVED);
      CHECK(predicates.crosses_upwards({ far_p, far_q, away }) != Verdict::PROVED);
    }
}

TEST_CASE("Predicates: a facet parallel to the gradient is never proved to face it, however thin")
{
  CGAL::Random random(43);
  int inexact = 0;
  for(int n = 0; n < 8; ++n) {
    // The gradient is exactly along an edge of the facet.
    const auto integer = [&] { return random.get_int(-100, 100); };
    const double a = integer(), b = integer(), c = 1 + std::abs(integer());
    const Field field = linear_field(a, b, c);
    const Predicates predicates(field);
    const Point_3 p(0, 0, 0), q(a / 128, b / 128, c / 128);
    const auto number = [&] { return random.get_double(-1, 1) + std::ldexp(random.get_double(-1, 1), -31); };
    const double s = number(), width = std::ldexp(1., -20 - n % 5);
    const Point_3 r(s * q.x() + width * number(), s * q.y() + width * number(), s * q.z() + width * number());
    if(CGAL::collinear(p, q, r)) continue;
    inexact += BS::facet_normal(p, q, r).radius > 1e-12;
    for(const Triangle& t : { Triangle{ p, q, r }, Triangle{ q, p, r } }) {
      double slope = 0;
      CHECK(predicates.crosses_upwards(t) != Verdict::PROVED);
      CHECK(predicates.crosses_upwards(t, nullptr, nullptr, &slope) != Verdict::PROVED);
      CHECK(slope == 0);
    }
  }
  CHECK(inexact > 4);
}

TEST_CASE("Predicates: the bound on the slope does not exceed the least slope on the facet")
{
  CGAL::Random random(47);
  Field field = cube_field();
  set(field, [&](double, double, double z) { return z + random.get_double(-0.4, 0.4); });
  const Predicates predicates(field);
  int proved = 0;
  for(int n = 0; n < 100; ++n) {
    const double size = std::ldexp(2., -(n % 5));
    const Point_3 p = random_point(random, 1.5);
    const auto tilt = [&] { return random.get_double(-0.3, 0.3) * size; };
    const Triangle t = { p, p + Vector_3(size, 0, tilt()), p + Vector_3(0, size, tilt()) };
    double slope = inf;
    if(predicates.crosses_upwards(t, nullptr, nullptr, &slope) != Verdict::PROVED) continue;
    ++proved;
    CHECK(slope > 0);
    Vector_3 normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
    normal = normal / std::sqrt(normal.squared_length());
    double least = inf;
    for(int i = 0; i <= 24; ++i)
      for(int j = 0; i + j <= 24; ++j)
        least = (std::min)(least, *field.gradient(CGAL::barycenter(t[0], i, t[1], j, t[2], 24. - i - j)) * normal);
    CHECK(slope <= least * (1 + 1e-12));
  }
  CHECK(proved > 20);
}

TEST_CASE("Predicates: a needle that leaves the levels in any of its cells is refuted, however its normal is rounded")
{
  CGAL::Random random(53);
  int seen = 0;
  for(int n = 0; n < 200; ++n) {
    const Point_3 p = random_point(random, 3.5), q = random_point(random, 3.5);
    const double width = std::ldexp(1., -30 - n % 20);
    const Point_3 r = q + width * (random_point(random, 1) - CGAL::ORIGIN);
    // one coefficient is one, near the middle of the needle
    const Point_3 middle = CGAL::midpoint(p, q);
    Field field = cube_field();
    const double x = std::round(middle.x()), y = std::round(middle.y()), z = std::round(middle.z());
    set(field, [&](double i, double j, double k) { return i == x && j == y && k == z ? 1. : 0.; });
    const Predicates predicates(field);
    double highest = 0;
    for(int i = 0; i <= 200; ++i) highest = (std::max)(highest, *field.value(p + i / 200. * (q - p)));
    CHECK(predicates.values_within(Triangle{ p, q, r }, { -1, 0.99 * highest }) == Verdict::REFUTED);
    ++seen;
    if(n < 20) CHECK(predicates.values_within(Triangle{ p, q, r }, { -1, 1.01 }) == Verdict::PROVED);
  }
  CHECK(seen == 200);
  // The triangle is so thin that rounded differences of its corners may give any normal. It leaves the levels just
  // before its highest point.
  const Field field = random_field(17);
  const Predicates predicates(field);
  CGAL::Random other(17);
  for(int n = 0; n < 300; ++n) {
    const Point_3 p = random_point(other, 3.5), q = random_point(other, 3.5);
    const Point_3 r = q + std::ldexp(1., -46 - n % 7) * (random_point(other, 1) - CGAL::ORIGIN);
    if(CGAL::collinear(p, q, r)) continue;
    double highest = -inf;
    for(int i = 0; i <= 200; ++i) highest = (std::max)(highest, *field.value(p + i / 200. * (q - p)));
    CHECK(predicates.values_within(Triangle{ p, q, r }, { -10, highest - 0.001 }) == Verdict::REFUTED);
  }
}

namespace {

// Returns a field on cells of width one along the diagonal of the first quadrant. One end is far from the origin.
Field diagonal_field(int length)
{
  std::vector<std::uint64_t> keys;
  for(int k = -1; k < 1; ++k)
    for(int j = 0; j < length; ++j)
      for(int i = (std::max)(j - 1, 0); i < (std::min)(j + 2, length); ++i)
        keys.push_back(BS::Lattice_key::encode(i, j, k));
  const BS::Lattice_3 lattice = BS::Lattice_3::from_origin({ 0, 0, 0 }, 1, { 0, 0, -1 }, { length - 1, length - 1, 0 });
  return Field(BS::Cell_complex_3(lattice, keys));
}

} // namespace

TEST_CASE("Predicates: the rounded midpoint of a long segment yields neither a false proof nor a false refutation")
{
  // The field is a parabola along x, whose top is at the middles of all segments. It is steep across the diagonal.
  constexpr double middle = 1024.3;
  Field field = diagonal_field(2050);
  set(field, [&](double x, double y, double) {
    const double s = x - middle;
    return x - y - 0.2 * (std::min)(s * s, 16.);
  });
  const Predicates predicates(field);
  CGAL::Random random(81);
  for(int n = 0; n < 24; ++n) {
    CAPTURE(n);
    const double x = random.get_double(0.2, 0.8), offset = random.get_double(-0.1, 0.1);
    const Point_3 p(x, x + offset, 0.1 * x), q(2 * middle - x, 2 * middle - x + offset, -0.1 * x);
    Exact_point m;
    for(int a = 0; a < 3; ++a) m[a] = (Rational(p[a]) + Rational(q[a])) / 2;
    const Rational top = exact_value(field, m);
    // the closest doubles below and above
    double below = CGAL::to_double(top), above = below;
    while(Rational(below) >= top) below = std::nextafter(below, -inf);
    while(Rational(above) <= top) above = std::nextafter(above, inf);
    CHECK(predicates.values_within(std::array<Point_3, 2>{ p, q }, { -inf, below }) != Verdict::PROVED);
    CHECK(predicates.values_within(std::array<Point_3, 2>{ p, q }, { -inf, above }) != Verdict::REFUTED);
  }
}

TEST_CASE("Predicates: a point rounded onto a cell face is not a witness in the cell on the wrong side")
{
  // The field is -x - 0.001 for negative x. For positive x, it has a cubic term, which is large even where x is less
  // than rounding.
  Field field = cube_field();
  set(field, [](double x, double, double) { return x == 2 ? std::ldexp(1., 175) : -x - 0.001; });
  const Predicates predicates(field);
  CGAL::Random random(83);
  for(int n = 0; n < 20; ++n) {
    // A quarter of the way, x differs from zero by rounding only.
    const double x = thirds(random, true);
    const Point_3 p(-x, 0.1, 0.2), q(3 * x, 0.3, 0.2);
    BS::Witness witness;
    if(predicates.values_within(std::array<Point_3, 2>{ p, q }, { 0, inf }, &witness) != Verdict::REFUTED) continue;
    Exact_point w;
    for(int a = 0; a < 3; ++a) w[a] = Rational(witness.barycentric[0]) * p[a] + Rational(witness.barycentric[1]) * q[a];
    CHECK(exact_value(field, w) < 0);
  }
}

TEST_CASE(
  "Predicates: a facet is proved to lie in flagged cells only if it enters no other, even by less than rounding")
{
  typedef CGAL::Simple_cartesian<Rational> Exact;
  const Field field = cube_field();
  const Predicates predicates(field);
  const BS::Constant_threshold inner(-1), outer(1);
  CGAL::Random random(91);
  int entered = 0;
  for(int n = 0; n < 128; ++n) {
    // Up to rounding, small facets are about the origin, where eight cells meet.
    const double size = std::ldexp(1. / 3, -4 - n % 16);
    const Vector_3 p = size * (random_point(random, 1) - CGAL::ORIGIN),
                   q = size * (random_point(random, 1) - CGAL::ORIGIN), r = -(p + q);
    const Exact::Point_3 a(p.x(), p.y(), p.z()), b(q.x(), q.y(), q.z()), c(r.x(), r.y(), r.z());
    const Exact::Vector_3 normal = CGAL::cross_product(b - a, c - a);
    const Rational offset = normal * (a - CGAL::ORIGIN);
    if(offset == 0) continue;
    // the cell whose diagonal meets the plane, and the point where it does
    const auto sign = [&](int i) { return normal[i] * offset > 0 ? 1 : -1; };
    const Exact::Vector_3 diagonal(sign(0), sign(1), sign(2));
    const Exact::Point_3 x = CGAL::ORIGIN + offset / (normal * diagonal) * diagonal;
    const auto faces = [&](const Exact::Point_3& u, const Exact::Point_3& v) {
      return normal * CGAL::cross_product(v - u, x - u) > 0;
    };
    if(!(faces(a, b) && faces(b, c) && faces(c, a))) continue;
    ++entered;
    std::vector<char> flagged(field.number_of_cells(), 1);
    flagged[field.locate(Point_3(sign(0) / 2., sign(1) / 2., sign(2) / 2.))] = 0;
    const auto facet = [&](double moved) {
      const Point_3 o(moved * sign(0), moved * sign(1), moved * sign(2));
      return Triangle{ o + p, o + q, o + r };
    };
    CHECK(predicates.values_within(facet(0), inner, outer, flagged) == Verdict::UNDECIDED);
    CHECK(predicates.values_within(facet(-2 * size), inner, outer, flagged) == Verdict::PROVED);
  }
  CHECK(entered > 60);
}

TEST_CASE("Thresholds: differences from a threshold, and its range on a cell, enclose exact values")
{
  CGAL::Random random(85);
  const Field field = random_field(86), level = random_field(87);
  const BS::Spline_threshold<Field> varying(level);
  const BS::Constant_threshold constant(0.37);
  for(Field::Cell_index c = 0; c < field.number_of_cells(); c += 37) {
    const auto cell = field.cell(c);
    const BS::Enclosed_tricubic f = BS::enclosed_value(cell), above = varying.difference(f, c),
                                above_constant = constant.difference(f, c);
    const BS::Level_range range = varying.range(c), one = constant.range(c);
    CHECK(one.min <= 0.37);
    CHECK(one.max >= 0.37);
    CHECK(one.max - one.min < 1e-12);
    for(int n = 0; n < 10; ++n) {
      Point_3 p = CGAL::ORIGIN + 0.01 * (random_point(random, 1) - CGAL::ORIGIN);
      p = Point_3(cell.corner()[0] + 0.5 + 40 * p.x(), cell.corner()[1] + 0.5 + 40 * p.y(),
                  cell.corner()[2] + 0.5 + 40 * p.z());
      const Rational value = exact_value(field, exact(p)), at = exact_value(level, exact(p));
      CHECK((at >= Rational(range.min) && at <= Rational(range.max)));
      const auto encloses = [&](const BS::Enclosed_tricubic& d, const Rational& x) {
        const BS::Level_range r = BS::enclose_at_point(d, cell.local_coordinates(p), 4e-16);
        return x >= Rational(r.min) && x <= Rational(r.max) && r.max - r.min < 1e-11;
      };
      CHECK(encloses(above, value - at));
      CHECK(encloses(above_constant, value - Rational(0.37)));
    }
  }
}

TEST_CASE("Predicates: the bound on a nearly subnormal slope is not rounded up")
{
  // Cells are so large that slopes per user unit have only few significant bits.
  constexpr double scale = 0x1p300;
  int known = 0;
  for(int n = 0; n < 60; ++n) {
    const double slope = std::ldexp(1.1, -700 - n); // per cell
    Field field = cube_field(CGAL::ORIGIN, scale);
    set(field, [&](double, double, double z) { return slope * z; });
    double bound = 0;
    const Triangle t = { Point_3(0, 0, 0.25 * scale), Point_3(scale, 0, 0.25 * scale),
                         Point_3(0, scale, 0.25 * scale) };
    CHECK(Predicates(field).crosses_upwards(t, nullptr, nullptr, &bound) == Verdict::PROVED);
    CHECK(Rational(bound) * Rational(scale) <= Rational(slope));
    known += bound > 0;
  }
  CHECK(known > 5);
}

TEST_CASE("Predicates: near the limits of the double range, answers agree with the scaled field's, or are undecided")
{
  CGAL::Random random(64);
  const Field field = random_field(62);
  const Predicates predicates(field);
  int decided = 0, undecided = 0;
  for(int exponent : { -1070, -1040, -1010, -990, 1012, 1016, 1023 }) {
    CAPTURE(exponent);
    Field scaled = field;
    for(int half : { exponent / 2, exponent - exponent / 2 })
      scaled.set_coefficients(Eigen::VectorXd(std::ldexp(1., half) * scaled.coefficients()));
    const Predicates of_scaled(scaled);
    for(int n = 0; n < 4; ++n) {
      const Point_3 p = random_point(random, 3.5);
      const Triangle t = { p, p + 0.02 * (random_point(random, 1) - CGAL::ORIGIN),
                           p + 0.02 * (random_point(random, 1) - CGAL::ORIGIN) };
      double slope = 0;
      const Verdict scaled_verdict = of_scaled.crosses_upwards(t, nullptr, nullptr, &slope);
      if(scaled_verdict != Verdict::UNDECIDED) CHECK(scaled_verdict == predicates.crosses_upwards(t));
      if(slope > 0) {
        // The comparison is scaled so that neither side underflows or overflows.
        const Vector_3 normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]), gradient = *field.gradient(t[0]);
        const double at_corner = normal * gradient / std::sqrt(normal.squared_length());
        CHECK(std::ldexp(slope, -exponent / 2) <= std::ldexp(at_corner, exponent - exponent / 2) * (1 + 1e-9));
      }
      ++(scaled_verdict == Verdict::UNDECIDED ? undecided : decided);
    }
  }
  CHECK(decided > 4);
  CHECK(undecided > 4);
}

TEST_CASE("Predicates: scaling the field by a power of two preserves answers and scales slopes exactly")
{
  CGAL::Random random(61);
  const Field field = random_field(62);
  const BS::Spline_threshold<Field> threshold(random_field(63));
  int proved = 0, refuted = 0;
  for(int exponent : { -900, -535, 524, 1000 }) {
    Field scaled = field, scaled_threshold = threshold.field();
    scaled.set_coefficients(Eigen::VectorXd(std::ldexp(1., exponent) * field.coefficients()));
    scaled_threshold.set_coefficients(Eigen::VectorXd(std::ldexp(1., exponent) * scaled_threshold.coefficients()));
    const Predicates predicates(field), of_scaled(scaled);
    const BS::Spline_threshold<Field> above(scaled_threshold);
    for(int n = 0; n < 40; ++n) {
      const Point_3 p = random_point(random, 3.5);
      const double size = n % 2 ? 0.3 : 0.02;
      const Triangle t = { p, p + size * (random_point(random, 1) - CGAL::ORIGIN),
                           p + size * (random_point(random, 1) - CGAL::ORIGIN) };
      double slope = 0, scaled_slope = 0;
      const Verdict verdict = predicates.crosses_upwards(t, nullptr, nullptr, &slope);
      CHECK(of_scaled.crosses_upwards(t, nullptr, nullptr, &scaled_slope) == verdict);
      CHECK(scaled_slope == std::ldexp(slope, exponent));
      CHECK(of_scaled.increases({ t[0], t[1] }) == predicates.increases({ t[0], t[1] }));
      CHECK(of_scaled.increases_above({ t[0], t[1] }, above) == predicates.increases_above({ t[0], t[1] }, threshold));
      const double level = *field.value(t[0]) + random.get_double(-0.1, 0.1),
                   scaled_level = std::ldexp(level, exponent);
      CHECK(of_scaled.values_within(t, { scaled_level, inf }) == predicates.values_within(t, { level, inf }));
      proved += verdict == Verdict::PROVED;
      refuted += verdict == Verdict::REFUTED;
    }
  }
  CHECK(proved > 10);
  CHECK(refuted > 10);
}
} // namespace test_Field_predicates_3
