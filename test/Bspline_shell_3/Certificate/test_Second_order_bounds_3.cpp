// Second_order_bounds_3.h: proved claims hold at all samples, by closed forms and by the predicates. Claims that just
// fail are not proved. Most true claims are proved.
#include "coefficient_functions.h"
#include "exact_spline.h"
#include "polynomial_fields.h"
#include "random_hierarchies.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Second_order_bounds_3.h>

#include <CGAL/Random.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace test_Second_order_bounds_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Constant_threshold Constant;
typedef BS::Spline_threshold<Field> Varying;
typedef BS::Second_order_bounds_3<Field> Bounds;
typedef BS::Second_order_bounds_3<Field, Varying> Varying_bounds;
typedef std::array<Point_3, 3> Triangle;
using BS::Verdict;

const double inf = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t many = 4096;

template <typename AnyBounds>
typename AnyBounds::Facet_bounds examine(const AnyBounds& bounds, const Triangle& t, std::size_t most_bisections = many,
                                         double target_slope = 0)
{
  return bounds.examine({ bounds.sample(t[0]), bounds.sample(t[1]), bounds.sample(t[2]) },
                        BS::facet_normal(t[0], t[1], t[2]), most_bisections, target_slope);
}

Bounds between(const Field& field, double inner, double outer)
{
  return Bounds(field, Constant(inner), Constant(outer));
}

bool is_contained(const Field& field, double inner, double outer, const Triangle& t, std::size_t most_bisections = many)
{
  return examine(between(field, inner, outer), t, most_bisections).is_contained;
}

Vector_3 normal(const Triangle& t)
{
  // Differences are scaled, so that triangles may have any size.
  double size = 0;
  for(const Vector_3& d : { t[1] - t[0], t[2] - t[0] })
    size = (std::max)({ size, std::abs(d.x()), std::abs(d.y()), std::abs(d.z()) });
  const Vector_3 n = CGAL::cross_product((t[1] - t[0]) / size, (t[2] - t[0]) / size);
  return n / std::sqrt(n.squared_length());
}

// Calls visit(p) for points of a triangle, rounded.
template <typename Visitor>
void for_each_sample(const Triangle& t, const Visitor& visit, int parts = 16)
{
  for(int i = 0; i <= parts; ++i)
    for(int j = 0; i + j <= parts; ++j)
      visit(CGAL::barycenter(t[0], double(i), t[1], double(j), t[2], double(parts - i - j)));
}

struct Extrema
{
  double lowest = inf, highest = -inf;
  void include(double x)
  {
    lowest = (std::min)(lowest, x);
    highest = (std::max)(highest, x);
  }
};

template <typename Field>
Extrema values(const Field& field, const Triangle& t)
{
  Extrema e;
  for_each_sample(t, [&](const Point_3& p) {
    if(const auto f = field.value(p)) e.include(*f);
  });
  return e;
}

template <typename Field>
double least_slope(const Field& field, const Triangle& t)
{
  Extrema e;
  const Vector_3 n = normal(t);
  for_each_sample(t, [&](const Point_3& p) {
    if(const auto g = field.gradient(p)) e.include(*g * n);
  });
  return e.lowest;
}

Vector_3 random_vector(CGAL::Random& random, double reach)
{
  return Vector_3(random.get_double(-reach, reach), random.get_double(-reach, reach), random.get_double(-reach, reach));
}

// Returns triangles of all sizes: also needles, facets in planes of cell faces, and facets whose corners are corners of
// cells.
Triangle random_triangle(CGAL::Random& random, int n)
{
  const double size = std::ldexp(1., -(n % 7));
  const Point_3 p = CGAL::ORIGIN + random_vector(random, 0.9);
  Triangle t = { p, p + random_vector(random, size), p + random_vector(random, size) };
  if(n % 5 == 1) t[2] = t[1] + random_vector(random, 1e-7 * size);
  for(Point_3& q : t) {
    const auto clamped = [](double x) { return (std::min)((std::max)(x, -0.99), 0.99); };
    q = Point_3(clamped(q.x()), clamped(q.y()), clamped(q.z()));
    if(n % 5 == 2) q = Point_3(q.x(), q.y(), 0.25);
    if(n % 10 == 3) q = Point_3(std::round(3 * q.x()) / 4, std::round(3 * q.y()) / 4, std::round(3 * q.z()) / 4);
  }
  return t;
}

template <typename Field>
void set_random(Field& field, CGAL::Random& random, const Polynomial& mean, double noise)
{
  set_polynomial(field, mean);
  Eigen::VectorXd x = field.coefficients();
  for(Eigen::Index n = 0; n < x.size(); ++n) x[n] += random.get_double(-noise, noise);
  field.set_coefficients(x);
}

const Polynomial height = { { 1, { 0, 0, 1 } } }, nothing = { { 0, { 0, 0, 0 } } };
// -(x^2 + y^2) in the plane z = 0.1
const Polynomial dome = { { -1, { 2, 0, 0 } }, { -1, { 0, 2, 0 } }, { 1, { 0, 0, 1 } }, { -0.1, { 0, 0, 0 } } };

// Returns an equilateral triangle around (x, x, z) that faces upwards.
Triangle horizontal(double radius, double z, double x = 0)
{
  const double h = radius * std::sqrt(0.75);
  return { Point_3(x + radius, x, z), Point_3(x - radius / 2, x + h, z), Point_3(x - radius / 2, x - h, z) };
}

// Returns whether a triangle is proved to be in a shell. The outer (if `side` > 0) or inner threshold is beyond the
// values at samples by a share of their range. The other threshold is far away.
bool is_contained_with_margin(const Field& field, double side, double share, const Triangle& t,
                              std::size_t most_bisections = many)
{
  const Extrema e = values(field, t);
  const double margin = share * (e.highest - e.lowest);
  return side > 0 ? is_contained(field, -9, e.highest + margin, t, most_bisections)
                  : is_contained(field, e.lowest - margin, 9, t, most_bisections);
}

Triangle scaled(const Triangle& t, double scale)
{
  Triangle s;
  for(int v = 0; v < 3; ++v) s[v] = Point_3(scale * t[v].x(), scale * t[v].y(), scale * t[v].z());
  return s;
}

} // namespace

TEST_CASE("Second-order bounds: proved claims hold at all samples, and claims that barely fail are not proved")
{
  Field field(cells_of_cube());
  const BS::Field_predicates_3<Field> predicates(field);
  int proved = 0, transversal = 0, missed = 0;
  for(int n = 0; n < 60; ++n) {
    CGAL::Random random{ unsigned(n) };
    // fields range from nearly linear to noise
    set_random(field, random, n % 3 == 0 ? nothing : height, std::ldexp(0.3, -n % 9));
    const Triangle t = random_triangle(random, n);
    if(CGAL::collinear(t[0], t[1], t[2])) continue;
    const Extrema e = values(field, t);
    const double size = e.highest - e.lowest;
    for(double margin : { 1e-9, 1e-3 }) {
      CHECK_FALSE(is_contained(field, e.lowest - 1, e.highest - margin * size, t));
      CHECK_FALSE(is_contained(field, e.lowest + margin * size, e.highest + 1, t));
    }
    const double least = least_slope(field, t);
    for(double room : { 0.01, 0.2, 2. }) {
      const double inner = e.lowest - room * size, outer = e.highest + room * size;
      const auto found = examine(between(field, inner, outer), t, many, 100);
      const bool within = predicates.values_within(t, { inner, outer }) == Verdict::PROVED;
      const bool upwards = predicates.crosses_upwards(t) == Verdict::PROVED;
      if(found.is_contained) CHECK((within && !found.leaves_shell));
      if(found.is_transversal) {
        CHECK((upwards && !found.faces_away));
        CHECK(found.slope > 0);
        CHECK(found.slope <= least * (1 + 1e-9));
      } else CHECK(found.slope == 0);
      if(upwards && within) missed += !(found.is_contained && found.is_transversal);
      proved += found.is_contained;
      transversal += found.is_transversal;
    }
  }
  CHECK(proved > 30);
  CHECK(transversal > 30);
  CHECK(missed <= proved / 20);
}

TEST_CASE("Second-order bounds: on a hierarchy, between varying thresholds, proved claims hold at all samples")
{
  int proved = 0, transversal = 0;
  for(int seed = 1; seed < 9; ++seed) {
    CGAL::Random random{ unsigned(seed) };
    Field field(random_hierarchy(random, cells_of_cube(), 4, 2));
    REQUIRE(field.number_of_levels() > 2);
    Field inner = field, outer = field;
    const double noise = std::ldexp(0.2, -seed);
    set_random(field, random, height, noise);
    set_random(inner, random, { { 1, { 0, 0, 1 } }, { -0.2, { 0, 0, 0 } } }, noise);
    set_random(outer, random, { { 1, { 0, 0, 1 } }, { 0.2, { 0, 0, 0 } } }, noise);
    const Varying_bounds bounds(field, Varying(inner), Varying(outer));
    const BS::Field_predicates_3<Field> predicates(field);
    for(int n = 0; n < 60; ++n) {
      Triangle t = random_triangle(random, n);
      if(n % 2 == 0) // move it to where leaves are smallest
        for(Point_3& p : t) {
          const auto cell = field.cell(field.locate(p)).bbox();
          p = CGAL::midpoint(p, Point_3(cell.xmin(), cell.ymin(), cell.zmin()));
        }
      if(CGAL::collinear(t[0], t[1], t[2])) continue;
      const auto found = examine(bounds, t, many, 100);
      if(found.is_contained) {
        ++proved;
        double least = inf;
        for_each_sample(t, [&](const Point_3& p) {
          const auto c = field.locate(p);
          if(c == Field::npos) return; // outside the domain, by rounding
          const double f = field.cell(c).value(p);
          least = (std::min)({ least, f - inner.cell(c).value(p), outer.cell(c).value(p) - f });
        });
        CHECK(least >= 0);
      }
      if(found.leaves_shell) CHECK(predicates.values_within(t, Varying(inner), Varying(outer)) == Verdict::REFUTED);
      if(found.is_transversal) {
        ++transversal;
        CHECK(found.slope > 0);
        CHECK(found.slope <= least_slope(field, t) * (1 + 1e-9));
      }
      if(found.faces_away) CHECK(predicates.crosses_upwards(t) == Verdict::REFUTED);
    }
  }
  CHECK(proved > 100);
  CHECK(transversal > 100);
}

TEST_CASE("Second-order bounds: a slight peak in a facet or on an edge is detected, and curvature away from a "
          "threshold does not matter")
{
  const Field field = uniform_field(dome);
  const Triangle around_peak = horizontal(0.2, 0.1),
                 across_edge = { Point_3(-0.2, 0, 0.1), Point_3(0.2, 0, 0.1), Point_3(0, 0.2, 0.1) };
  for(const Triangle& t : { around_peak, across_edge })
    for(double margin : { 1e-12, 1e-5 }) {
      CHECK_FALSE(is_contained(field, -1, -margin, t));
      if(margin > 1e-9) CHECK(is_contained(field, -1, margin, t));
    }
  // The bound is the best of its kind: it is attained in the middle of an equilateral triangle in one cell.
  const Triangle in_a_cell = horizontal(0.0625, 0.1, 0.125);
  const Field centered = uniform_field({ { -1, { 2, 0, 0 } },
                                         { -1, { 0, 2, 0 } },
                                         { 0.25, { 1, 0, 0 } },
                                         { 0.25, { 0, 1, 0 } },
                                         { 1, { 0, 0, 1 } },
                                         { -0.1, { 0, 0, 0 } } });
  const double peak = 0.03125; // value at (1/8, 1/8, 1/10)
  CHECK(is_contained(centered, -1, peak + 1e-12, in_a_cell, 0));
  CHECK_FALSE(is_contained(centered, -1, peak - 1e-12, in_a_cell));
  const Field minimum = uniform_field({ { 1, { 2, 0, 0 } },
                                        { 1, { 0, 2, 0 } },
                                        { -0.25, { 1, 0, 0 } },
                                        { -0.25, { 0, 1, 0 } },
                                        { 1, { 0, 0, 1 } },
                                        { -0.1, { 0, 0, 0 } } });
  CHECK(is_contained(minimum, -peak - 1e-12, 1, in_a_cell, 0));
  CHECK_FALSE(is_contained(minimum, -peak + 1e-12, 1, in_a_cell));
  for(double share : { 0.1, 0.2, 0.4 }) { // relative to the height above the corners
    CHECK_FALSE(is_contained(centered, -1, peak - share * 0.0625 * 0.0625, in_a_cell, 0));
    CHECK_FALSE(is_contained(minimum, -peak + share * 0.0625 * 0.0625, 1, in_a_cell, 0));
  }
  // At the other threshold, the corners decide, whatever the size of the facet.
  const Triangle large = horizontal(0.4, 0.1);
  const double at_corners = values(field, large).lowest;
  CHECK(is_contained(field, at_corners - 1e-12, 0.5, large));
  CHECK(is_contained(field, at_corners - 1e-12, 1, large, 0));
  CHECK_FALSE(is_contained(field, at_corners + 1e-12, 1, large));
}

TEST_CASE(
  "Second-order bounds: a facet that rises from a threshold may bend towards it by far more than its least distance")
{
  // The field is x^2 + z. At z = 0.1, it exceeds the inner threshold by 0.001 where x is 0, and by 0.04 more at the
  // other end.
  constexpr double low = 0.001;
  const Triangle t = { Point_3(0, 0.1, 0.1), Point_3(0.2, 0.1, 0.1), Point_3(0.2, 0.2, 0.1) };
  CHECK(is_contained(uniform_field({ { 1, { 2, 0, 0 } }, { 1, { 0, 0, 1 } } }), 0.1 - low, 1, t, 0));
  CHECK(is_contained(uniform_field({ { -1, { 2, 0, 0 } }, { 1, { 0, 0, 1 } } }), -1, 0.1 + low, t, 0));
  // 4 (x - 0.1)^2 is equally high at both ends, but sinks in between.
  const Polynomial sinking = { { 4, { 2, 0, 0 } }, { -0.8, { 1, 0, 0 } }, { 0.04, { 0, 0, 0 } }, { 1, { 0, 0, 1 } } };
  CHECK_FALSE(is_contained(uniform_field(sinking), 0.1 + low, 1, t));
  CHECK(is_contained(uniform_field(sinking), 0.1 - low, 1, t));
}

TEST_CASE("Second-order bounds: peaks at the most curved part of a cell, or due to mixed derivatives, are detected")
{
  // -(x^3 + y^3), with a peak at (0.23, 0.23) in the cell from 0 to 1/4. Its largest second derivative in the cell is
  // nearly twice the mean.
  constexpr double at = 0.23;
  const Triangle corner = horizontal(0.015, 0.1, at);
  // z x y, near the end of a cell where z is 1/4. The triangle is a needle along (1, -1); the field is higher in its
  // middle.
  constexpr double top = 0.245;
  const Triangle ridge = { Point_3(0.22, 0.02, top), Point_3(0.02, 0.22, top), Point_3(0.219, 0.019, top) };
  for(double sign : { 1., -1. }) {
    const auto contained = [&](const Polynomial& p, const Triangle& t, double share, std::size_t bisections) {
      return is_contained_with_margin(uniform_field(p), sign, share, t, bisections);
    };
    const Polynomial cubic = { { -sign, { 3, 0, 0 } },
                               { -sign, { 0, 3, 0 } },
                               { 3 * sign * at * at, { 1, 0, 0 } },
                               { 3 * sign * at * at, { 0, 1, 0 } },
                               { 1, { 0, 0, 1 } } };
    const Polynomial mixed = { { sign, { 1, 1, 1 } },
                               { -sign * top * 0.12, { 1, 0, 0 } },
                               { -sign * top * 0.12, { 0, 1, 0 } },
                               { 1, { 0, 0, 1 } } };
    for(const auto& problem : { std::make_pair(cubic, corner), std::make_pair(mixed, ridge) }) {
      for(double share : { -0.03, -0.1, -0.2 }) CHECK_FALSE(contained(problem.first, problem.second, share, 0));
      CHECK(contained(problem.first, problem.second, 0.1, many));
    }
  }
}

TEST_CASE("Second-order bounds: a facet that faces away only in cells without its corners is detected")
{
  // z times a function of x that is close to |x|, and slightly negative at 0
  constexpr double width = 0.25;
  for(double margin : { 1e-9, 0.1, -0.5 }) {
    Field field(cells_of_cube());
    set_coefficients(field,
                     [&](const Point_3& p, double) { return p.z() * (std::abs(p.x()) / width - 1. / 3 - margin); });
    const Eigen::VectorXd x = field.coefficients();
    for(double z : { 0.1, -0.3 })
      for(double sign : { 1., -1. }) {
        field.set_coefficients(sign * x);
        const Bounds bounds = between(field, -5, 5);
        Triangle t = { Point_3(-1.4 * width, -0.5 * width, z), Point_3(1.4 * width, -0.5 * width, z),
                       Point_3(1.4 * width, 0.5 * width, z) };
        if(sign < 0) std::swap(t[0], t[1]);
        for(double enough : { 0., 100. })
          for(std::size_t bisections : { std::size_t(0), std::size_t(1), many }) {
            const auto found = examine(bounds, t, bisections, enough);
            if(margin > 0) CHECK_FALSE(found.is_transversal);
            else {
              CHECK(found.slope <= -margin + 1e-12);
              if(bisections == many && enough > 1) CHECK(found.slope > -0.85 * margin);
            }
          }
      }
  }
}

TEST_CASE("Second-order bounds: curvature across a facet's plane does not weaken its bounds")
{
  // The field is steep and curved across the facet, but linear in its plane.
  const Field field = uniform_field(
    { { 1, { 0, 0, 1 } }, { 0.9, { 0, 0, 2 } }, { 0.7, { 0, 0, 3 } }, { 0.2, { 1, 0, 0 } } });
  const Triangle t = { Point_3(-0.3, -0.2, 0.3), Point_3(0.3, -0.2, 0.3), Point_3(0, 0.3, 0.3) };
  const Extrema e = values(field, t);
  const auto found = examine(between(field, e.lowest - 1e-12, e.highest + 1e-12), t, 0, 100);
  CHECK(found.is_contained);
  CHECK(found.is_transversal);
  const double slope = 1 + 2 * 0.9 * 0.3 + 3 * 0.7 * 0.09;
  CHECK(found.slope <= slope);
  CHECK(examine(between(field, -1, 2), t, many, 100).slope > 0.9 * slope);
}

TEST_CASE(
  "Second-order bounds: a bump of the field or of a threshold in the smallest cells is detected anywhere on a facet")
{
  CGAL::Random random(3);
  Field field(random_hierarchy(random, cells_of_cube(), 4, 1));
  set_polynomial(field, height);
  Field inner = field, outer = field;
  set_polynomial(inner, { { -0.2, { 0, 0, 0 } }, { 1, { 0, 0, 1 } } });
  set_polynomial(outer, { { 0.2, { 0, 0, 0 } }, { 1, { 0, 0, 1 } } });
  const int finest = field.number_of_levels() - 1;
  REQUIRE(finest == 3);
  const double width = field.cells().level_width(finest);
  // value of a basis function at its center
  const double peak = 8. / 27;
  int bumps = 0;
  for(Field::Cell_index n = 0; n < field.points(finest).size() && bumps < 7; n += 29) {
    const auto coefficient = field.coefficient_of_point(field.first_point(finest) + n);
    if(coefficient == Field::npos) continue;
    const CGAL::Bbox_3 b = field.support(coefficient);
    const Point_3 top((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2);
    if(!(std::abs(top.x()) < 0.8 && std::abs(top.y()) < 0.8 && std::abs(top.z()) < 0.8)) continue;
    ++bumps;
    // The bump is missed by the samples at the corners, and by the first ones at middles of edges.
    const double x = random.get_double(-1, 1) * width, y = random.get_double(-1, 1) * width,
                 size = (n % 2 ? 1.3 : 0.3) + random.get_double(0, 0.05);
    Triangle t = { top + Vector_3(x - 0.6 * size, y - 0.4 * size, 0), top + Vector_3(x + 0.5 * size, y - 0.5 * size, 0),
                   top + Vector_3(x, y + 0.6 * size, 0) };
    for(Point_3& p : t)
      p = Point_3((std::min)((std::max)(p.x(), -0.95), 0.95), (std::min)((std::max)(p.y(), -0.95), 0.95), p.z());
    if(!(CGAL::cross_product(t[1] - t[0], t[2] - t[0]).z() > 0)) continue;
    const auto with_bump = [&](Field f, double bump) {
      Eigen::VectorXd c = f.coefficients();
      c[coefficient] += bump;
      f.set_coefficients(c);
      return f;
    };
    REQUIRE(examine(Varying_bounds(field, Varying(inner), Varying(outer)), t).is_contained);
    // A bump of the field or of a threshold, 1/8 higher than the room permits, or 1/8 lower.
    for(double sign : { 1., -1. }) {
      const double bump = sign * 0.2 / peak;
      const Field too_high = with_bump(field, 1.125 * bump), high = with_bump(field, 0.875 * bump);
      const Field& narrow = sign > 0 ? outer : inner;
      const Varying too_narrow(with_bump(narrow, -1.125 * bump)), less_narrow(with_bump(narrow, -0.875 * bump));
      const bool is_met = [&] {
        double farthest = 0;
        for_each_sample(
          t, [&](const Point_3& p) { farthest = (std::max)(farthest, sign * (too_high.value(p).value_or(0) - p.z())); },
          100);
        return farthest > 0.2;
      }();
      const auto contained = [&](const Field& f, const Varying& i, const Varying& o) {
        return examine(Varying_bounds(f, i, o), t).is_contained;
      };
      if(is_met) {
        CHECK_FALSE(contained(too_high, Varying(inner), Varying(outer)));
        CHECK_FALSE(
          (sign > 0 ? contained(field, Varying(inner), too_narrow) : contained(field, too_narrow, Varying(outer))));
        CHECK_FALSE(examine(Varying_bounds(too_high, Varying(inner), Varying(outer)), t).is_transversal);
      }
      if(n % 3 == 0) {
        CHECK(contained(high, Varying(inner), Varying(outer)));
        CHECK(
          (sign > 0 ? contained(field, Varying(inner), less_narrow) : contained(field, less_narrow, Varying(outer))));
      }
    }
  }
  CHECK(bumps == 7);
}

TEST_CASE("Second-order bounds: facets tilted by 1e-9 are classified correctly, and slopes agree with closed forms")
{
  const Field field = uniform_field(height);
  const Bounds flat = between(field, -2, 2);
  const Point_3 p(0, 0, 0), q(0.4, 0, 0);
  CHECK(examine(flat, { p, q, Point_3(0, 0.4, 0) }).is_transversal);
  CHECK(examine(flat, { p, q, Point_3(0, 0.4, 0) }).slope == Approx(1).epsilon(1e-12));
  CHECK(examine(flat, { p, q, Point_3(0, 0.4, 0) }).slope <= 1);
  const auto down = examine(flat, { q, p, Point_3(0, 0.4, 0) });
  CHECK_FALSE(down.is_transversal);
  CHECK(down.faces_away);
  CHECK(down.slope == 0);
  // nearly along the gradient, from either side
  const auto tilted = examine(flat, { p, q, Point_3(0, 1e-9, 0.4) }, many, 1);
  CHECK(tilted.is_transversal);
  CHECK(tilted.slope <= 1e-9 / 0.4);
  CHECK(tilted.slope > 0.9e-9 / 0.4);
  CHECK_FALSE(examine(flat, { p, q, Point_3(0, -1e-9, 0.4) }).is_transversal);
  CHECK_FALSE(examine(flat, { p, q, Point_3(0, 0, 0.4) }).is_transversal);
  // The facet is turned only near its middle, and only slightly: the slope of a horizontal facet is `least` + 2 x^2.
  const Triangle around = { Point_3(-0.5, -0.3, 0.1), Point_3(0.5, -0.3, 0.1), Point_3(0, 0.5, 0.1) };
  for(double margin : { 1e-12, 1e-3 }) {
    for(double sign : { 1., -1. }) {
      const double least = sign * margin; // slope at x = 0
      const Field turned = uniform_field({ { least, { 0, 0, 1 } }, { 2, { 2, 0, 1 } } });
      const auto found = examine(between(turned, -5, 5), around, many, 100);
      if(sign < 0) CHECK_FALSE(found.is_transversal);
      if(found.is_transversal) CHECK(found.slope <= least);
      if(sign > 0 && margin == 1e-3) CHECK(found.is_transversal);
    }
  }
}

TEST_CASE(
  "Second-order bounds: needles, facets in lattice planes, and corners at lattice points are handled like others")
{
  const Field field = uniform_field(height);
  const Bounds bounds = between(field, -0.95, 0.95);
  // The sign of the exact normal's z decides.
  const Point_3 p(-0.55, 0.15, 0.35), q(0.65, 0.55, 0.45), up = CGAL::midpoint(p, q) + Vector_3(-0.4e-12, 1.2e-12, 0);
  CHECK(examine(bounds, { p, q, up }).is_transversal);
  CHECK(examine(bounds, { p, q, up }).is_contained);
  CHECK_FALSE(examine(bounds, { q, p, up }).is_transversal);
  for(double size : { 0.25, 0.5, 1.25 }) {
    const Triangle t = { Point_3(-0.5, -0.5, 0.25), Point_3(-0.5 + size, -0.5, 0.25),
                         Point_3(-0.5, -0.5 + size, 0.25) };
    const auto found = examine(bounds, t, 0, 100);
    if(size <= 0.5) CHECK((found.is_contained && found.is_transversal));
    CHECK(examine(bounds, t).is_contained);
    CHECK(examine(bounds, t).is_transversal);
    CHECK(is_contained(field, 0.25 - 1e-12, 0.25 + 1e-12, t));
    CHECK_FALSE(is_contained(field, 0.25 + 1e-12, 1, t));
    CHECK_FALSE(is_contained(field, -1, 0.25 - 1e-12, t));
    CHECK_FALSE(is_contained(field, 0.25, 1, t)); // bounds cannot decide whether they touch
  }
}

TEST_CASE("Second-order bounds: nothing is proved beyond the boundary of the domain, or across a hole in it")
{
  const Lattice_point first = { -4, -4, -4 }, last = { 3, 3, 3 };
  Field field(cells_where(BS::Lattice_3::from_origin({ 0, 0, 0 }, 0.25, first, last), first, last,
                          [](int i, int j, int) { return !(i == 0 && j == 1); }));
  set_polynomial(field, height);
  const Bounds bounds = between(field, -2, 2);
  const auto proves_any = [&](const Triangle& t) {
    const auto found = examine(bounds, t);
    return found.is_contained || found.is_transversal;
  };
  const auto proves_all = [&](const Triangle& t) {
    const auto found = examine(bounds, t);
    return found.is_contained && found.is_transversal;
  };
  for(double z : { 0.1, 0.25 }) {
    // corners outside the domain; around the hole; slightly into it; just outside it
    CHECK_FALSE(proves_any({ Point_3(0, 0, z), Point_3(2, 0, z), Point_3(0, -0.9, z) }));
    CHECK_FALSE(proves_any({ Point_3(-0.6, 0, z), Point_3(0.8, 0.1, z), Point_3(0.1, 0.9, z) }));
    CHECK_FALSE(proves_any({ Point_3(-0.2, 0.1, z), Point_3(0.4, 0.1, z), Point_3(0.125, 0.25 + 1e-9, z) }));
    CHECK_FALSE(proves_any({ Point_3(-0.2, 0.125, z), Point_3(0.2, 0.125, z), Point_3(-0.02, 0.5, z) }));
    CHECK(proves_all({ Point_3(-0.2, 0.1, z), Point_3(0.4, 0.1, z), Point_3(0.125, 0.25 - 1e-9, z) }));
    CHECK(proves_all({ Point_3(-1 + 1e-9, -1 + 1e-9, z), Point_3(1 - 1e-9, -1 + 1e-9, z), Point_3(0, 0.2, z) }));
  }
  CHECK_FALSE(proves_any({ Point_3(0, 0, 1 + 1e-9), Point_3(0.2, 0, 0.9), Point_3(0, -0.2, 0.9) }));
  for(double far : { 1e9, 1e300 })
    CHECK_FALSE(proves_any({ Point_3(0, 0, 0), Point_3(0.1, 0, far), Point_3(0, 0.1, 0) }));
  for(double far : { 1e300, inf, not_a_number }) {
    const auto at = [&](double x, double y) { return bounds.sample(Point_3(x, y, 0)); };
    const auto found = bounds.examine({ at(0, 0), at(far, 0), at(0, far) }, BS::Facet_normal{ { 0, 0, 1 }, 1e-15 },
                                      many);
    CHECK_FALSE((found.is_contained || found.is_transversal || found.leaves_shell || found.faces_away));
  }
  const Field nowhere;
  const Bounds none = between(nowhere, -1, 1);
  CHECK_FALSE(examine(none, horizontal(0.1, 0)).is_contained);
  CHECK_FALSE(examine(none, horizontal(0.1, 0)).is_transversal);
}

TEST_CASE("Second-order bounds: coefficients that are not finite prevent proofs where they act, and nowhere else")
{
  Field field = hierarchical_field(height);
  Field inner = field, outer = field;
  set_polynomial(inner, { { -0.95, { 0, 0, 0 } } });
  set_polynomial(outer, { { 0.95, { 0, 0, 0 } } });
  CGAL::Random random(17);
  int affected = 0, left = 0;
  for(double bad : { not_a_number, inf, -inf, 1.7e308, -1.7e308 })
    for(int which = 0; which < 3; ++which)
      for(int n = 0; n < 3; ++n) {
        std::array<Field, 3> f = { { field, inner, outer } };
        Eigen::VectorXd x = f[which].coefficients();
        // a coefficient of small cells, or of large ones
        x[n == 0 ? random.get_int(0, int(x.size()) / 2) : int(x.size()) - 1 - random.get_int(0, 600)] = bad;
        f[which].set_coefficients(x);
        const Varying_bounds bounds(f[0], Varying(f[1]), Varying(f[2]));
        for(int m = 0; m < 30; ++m) {
          const Triangle t = random_triangle(random, m);
          if(CGAL::collinear(t[0], t[1], t[2])) continue;
          const auto found = examine(bounds, t);
          bool meets = false;
          for_each_sample(t, [&](const Point_3& p) {
            const auto c = field.locate(p);
            if(c == Field::npos) return;
            const double* b = f[which].cell(c).coefficients();
            meets = meets || !std::isfinite(f[which].cell(c).error_radius())
                    || std::any_of(b, b + 64, [](double value) { return !(std::abs(value) < 1e300); });
          });
          affected += meets;
          if(meets) CHECK_FALSE((found.is_contained && found.is_transversal));
          if(meets && which == 0) CHECK_FALSE((found.is_contained || found.is_transversal));
          if(meets) CHECK_FALSE(found.is_contained);
          left += found.is_contained;
        }
      }
  CHECK(affected > 50);
  CHECK(left > 100);
  const Field plane = uniform_field(height);
  for(double level : { not_a_number, inf }) {
    CHECK_FALSE(is_contained(plane, level, 1, horizontal(0.1, 0)));
    CHECK_FALSE(is_contained(plane, -1, -level, horizontal(0.1, 0)));
  }
}

TEST_CASE("Second-order bounds: rounding yields no false proof if values are large compared with their differences")
{
  CGAL::Random random(41);
  int exceeded = 0, turned = 0;
  for(int n = 0; n < 4; ++n) {
    Field field(cells_of_cube());
    set_random(field, random, { { 1e6, { 0, 0, 0 } }, { 1, { 0, 0, 1 } } }, 1e-3);
    const BS::Field_predicates_3<Field> predicates(field);
    for(int m = 0; m < 16; ++m) {
      const Point_3 p = CGAL::ORIGIN + random_vector(random, 0.9);
      const Triangle t = { p, p + Vector_3(-1e-3, 0, -1e-2), p + Vector_3(0, -1e-3, -1e-2) };
      // the largest double that is less than the field at a corner
      double level = *field.value(p) + 1e-8;
      while(predicates.compare(p, level) != CGAL::LARGER) level = std::nextafter(level, -inf);
      ++exceeded;
      CHECK_FALSE(is_contained(field, 0, level, t));
      level = *field.value(p) - 1e-8;
      while(predicates.compare(p, level) != CGAL::SMALLER) level = std::nextafter(level, inf);
      CHECK_FALSE(is_contained(field, level, 2e6, { p, p + Vector_3(1e-3, 0, 1e-2), p + Vector_3(0, 1e-3, 1e-2) }));
    }
    set_random(field, random, { { 1e6, { 0, 0, 0 } } }, 4e-10);
    const Bounds bounds = between(field, 0, 2e6);
    for(int m = 0; m < 16; ++m) {
      const Point_3 p = CGAL::ORIGIN + random_vector(random, 0.9);
      const auto found = examine(bounds, { p, p + Vector_3(1e-9, 0, 0), p + Vector_3(0, 1e-9, 0) });
      const bool faces_along = exact_value(field, exact(p), { 0, 0, 1 }) > 0;
      if(!faces_along) CHECK_FALSE(found.is_transversal);
      turned += !faces_along;
    }
  }
  CHECK(exceeded == 64);
  CHECK(turned > 10);
}

TEST_CASE("Second-order bounds: answers do not depend on a power-of-two scale, and false claims are proved at none")
{
  const Triangle t = horizontal(0.2, 0.1);
  const auto fields = [](double scale) {
    Frame frame;
    frame.scale = scale;
    return uniform_field({ { 1, { 0, 0, 1 } }, { -1, { 2, 0, 0 } }, { -1, { 0, 2, 0 } } }, frame);
  };
  for(int exponent :
      { -1000, -700, -565, -520, -511, -505, -300, 0, 60, 480, 511, 513, 514, 515, 518, 520, 530, 565, 700, 900 }) {
    CAPTURE(exponent);
    const double scale = std::ldexp(1., exponent);
    const Field field = fields(scale);
    for(double size : { 1., 0.5, 0.125, std::ldexp(1., -10) }) {
      // The peak, 0.1, is in the middle.
      const Triangle here = scaled({ Point_3(size * t[0].x(), size * t[0].y(), 0.1),
                                     Point_3(size * t[1].x(), size * t[1].y(), 0.1),
                                     Point_3(size * t[2].x(), size * t[2].y(), 0.1) },
                                   scale);
      const double drop = size * size * 0.04;
      CHECK_FALSE(is_contained(field, -scale, (0.1 - 0.01 * drop) * scale, here));
      CHECK_FALSE(examine(between(field, -scale, scale), { here[1], here[0], here[2] }).is_transversal);
      const auto found = examine(between(field, -scale, (0.1 + 0.01 * drop) * scale), here);
      if(std::abs(exponent) <= 480) {
        CHECK(found.is_contained);
        CHECK(found.is_transversal);
      }
      if(found.is_transversal) CHECK(found.slope <= 1 + 1e-12);
    }
  }
  // Cells have width one quarter.
  const Field field = fields(1);
  const Bounds bounds = between(field, -0.5, 0.5);
  for(double size : { 1e-20, 1e-100, 1e-200, 1e-300 }) {
    const auto found = examine(bounds, scaled(horizontal(1, 0.5), size), 0);
    CHECK(found.is_contained);
    CHECK(found.is_transversal);
    CHECK(found.slope == Approx(1));
  }
}

TEST_CASE("Second-order bounds: fewer bisections prove fewer claims, and never different ones")
{
  CGAL::Random random(23);
  Field field(cells_of_cube());
  set_random(field, random, height, 0.02);
  const Bounds bounds = between(field, -0.5, 0.5);
  std::array<int, 4> proved = {};
  for(int n = 0; n < 200; ++n) {
    const Triangle t = random_triangle(random, n);
    if(CGAL::collinear(t[0], t[1], t[2])) continue;
    bool contained = false, transversal = false;
    int m = 0;
    for(std::size_t bisections : { std::size_t(0), std::size_t(3), std::size_t(20), many }) {
      const auto found = examine(bounds, t, bisections);
      CHECK((found.is_contained || !contained));
      CHECK((found.is_transversal || !transversal));
      contained = found.is_contained;
      transversal = found.is_transversal;
      proved[m++] += contained + transversal;
    }
  }
  CHECK(proved[0] > 20);
  CHECK(proved[0] < proved[1]);
  CHECK(proved[1] < proved[3]);
}

TEST_CASE("Second-order bounds: the bound on the slope is close to the least slope, up to the requested value")
{
  CGAL::Random random(29);
  Field field(cells_of_cube());
  set_random(field, random, height, 0.01);
  const Bounds bounds = between(field, -2, 2);
  for(int n = 0; n < 60; ++n) {
    Triangle t = random_triangle(random, n);
    if(CGAL::collinear(t[0], t[1], t[2])) continue;
    if(normal(t).z() < 0) std::swap(t[0], t[1]);
    if(!(normal(t).z() > 0.05)) continue;
    const double least = least_slope(field, t);
    for(double enough : { 0.1, 0.5, 10. }) {
      const auto found = examine(bounds, t, many, enough);
      if(!(least > 0.01)) continue;
      CHECK(found.is_transversal);
      CHECK(found.slope <= least * (1 + 1e-9));
      CHECK(found.slope >= (std::min)(enough, 0.89 * least));
    }
  }
}

TEST_CASE(
  "Second-order bounds: results are rigorous in any rounding mode, and do not depend on the mode of the first query")
{
  CGAL::Random random(31);
  Field field(cells_of_cube());
  set_random(field, random, height, 0.02);
  const Bounds bounds = between(field, -0.5, 0.5);
  const BS::Field_predicates_3<Field> predicates(field);
  for(int n = 0; n < 60; ++n) {
    const Triangle t = random_triangle(random, n);
    if(CGAL::collinear(t[0], t[1], t[2])) continue;
    const auto expected = examine(bounds, t, many, 1);
    for(int mode : { FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO }) {
      const Bounds others = between(field, -0.5, 0.5);
      std::fesetround(mode);
      const auto found = examine(others, t, many, 1);
      const int after = std::fegetround();
      std::fesetround(FE_TONEAREST);
      CHECK(after == mode);
      const auto again = examine(others, t, many, 1);
      CHECK(again.is_contained == expected.is_contained);
      CHECK(again.is_transversal == expected.is_transversal);
      CHECK(again.slope == expected.slope);
      if(found.is_contained) CHECK(predicates.values_within(t, { -0.5, 0.5 }) == Verdict::PROVED);
      if(found.is_transversal) CHECK(predicates.crosses_upwards(t) == Verdict::PROVED);
    }
  }
}

TEST_CASE("Second-order bounds: few bisections prove nearly all facets of a mesh in a shell")
{
  const Field field = uniform_field(squared_distance);
  const Bounds bounds = between(field, 0.3, 0.66);
  const BS::Field_predicates_3<Field> predicates(field);
  for(int subdivisions : { 1, 2, 3 }) {
    const Mesh mesh = sphere(subdivisions, 0.8);
    std::size_t proved = 0, by_predicates = 0;
    for(auto f : mesh.faces()) {
      const Triangle t = corners(mesh, f);
      const auto found = examine(bounds, t, 64);
      proved += found.is_contained && found.is_transversal;
      by_predicates += predicates.values_within(t, { 0.3, 0.66 }) == Verdict::PROVED
                       && predicates.crosses_upwards(t) == Verdict::PROVED;
    }
    CHECK(by_predicates == mesh.number_of_faces());
    CHECK(proved >= by_predicates * 99 / 100);
  }
}

TEST_CASE("Second-order bounds: near the origin, where positions are exact, rounded values yield no false proof",
          "[slow]")
{
  CGAL::Random random(61);
  int turned = 0;
  const Polynomial steep = { { 1, { 0, 0, 1 } } };
  for(int n = 0; n < 2; ++n) {
    Field field(cells_of_cube());
    set_random(field, random, steep, 0.5);
    const BS::Field_predicates_3<Field> predicates(field);
    for(int m = 0; m < 8; ++m) {
      const Point_3 p = CGAL::ORIGIN + random_vector(random, 1e-9);
      const auto g = field.gradient(p);
      // All other points of the facet are lower than the corner, or all are higher.
      const Vector_3 along = (1e-9 / std::sqrt(g->squared_length())) * *g,
                     u = 0.1 * CGAL::cross_product(along, Vector_3(0.36, 0.48, 0.8)),
                     v = 1e9 * CGAL::cross_product(along, u);
      // the closest doubles below and above the field at the corner
      double level = *field.value(p) + 1e-14;
      while(predicates.compare(p, level) != CGAL::LARGER) level = std::nextafter(level, -inf);
      CHECK_FALSE(is_contained(field, -10, level, { p, p - along + u, p - along + v }, 0));
      level = *field.value(p) - 1e-14;
      while(predicates.compare(p, level) != CGAL::SMALLER) level = std::nextafter(level, inf);
      CHECK_FALSE(is_contained(field, level, 10, { p, p + along + u, p + along + v }, 0));
      ++turned;
    }
  }
  CHECK(turned == 16);
}

TEST_CASE("Second-order bounds: a peak due to a mixed derivative is detected for each pair of axes")
{
  // x y, and permutations, on needles along the diagonal; higher in the middle
  for(int axis = 0; axis < 3; ++axis)
    for(double sign : { 1., -1. }) {
      const int a = axis, b = (axis + 1) % 3, c = (axis + 2) % 3;
      Polynomial mixed = { { sign, { 0, 0, 0 } }, { -sign * 0.12, { 0, 0, 0 } }, { -sign * 0.12, { 0, 0, 0 } } };
      mixed[0].power[a] = mixed[0].power[b] = 1;
      mixed[1].power[a] = 1;
      mixed[2].power[b] = 1;
      mixed.push_back({ 1, { 0, 0, 0 } }); // rises along the third axis
      mixed[3].power[c] = 1;
      const auto point = [&](double x, double y) {
        std::array<double, 3> p;
        p[a] = x;
        p[b] = y;
        p[c] = 0.1;
        return Point_3(p[0], p[1], p[2]);
      };
      Triangle needle = { point(0.22, 0.02), point(0.02, 0.22), point(0.219, 0.019) };
      if(normal(needle)[c] < 0) std::swap(needle[0], needle[1]);
      const Field field = uniform_field(mixed);
      for(double share : { -0.03, -0.2, -0.4 }) CHECK_FALSE(is_contained_with_margin(field, sign, share, needle, 0));
      CHECK(is_contained_with_margin(field, sign, 2, needle));
    }
}

TEST_CASE("Second-order bounds: a facet parallel to the gradient does not face it, however thin")
{
  CGAL::Random random(67);
  int inexact = 0;
  for(int n = 0; n < 200; ++n) {
    // The gradient is exactly along an edge of the facet.
    const auto integer = [&] { return random.get_int(-60, 60); };
    const double a = integer(), b = integer(), c = 1 + std::abs(integer());
    const Field field = uniform_field({ { a, { 1, 0, 0 } }, { b, { 0, 1, 0 } }, { c, { 0, 0, 1 } } });
    const Point_3 p(0, 0, 0), q(a / 128, b / 128, c / 128);
    const auto number = [&] { return random.get_double(-1, 1) + std::ldexp(random.get_double(-1, 1), -31); };
    const double s = number(), width = std::ldexp(1., -20 - n % 5);
    const Point_3 r(s * q.x() + width * number(), s * q.y() + width * number(), s * q.z() + width * number());
    if(CGAL::collinear(p, q, r)) continue;
    inexact += BS::facet_normal(p, q, r).radius > 1e-12;
    const Bounds bounds = between(field, -200, 200);
    for(const Triangle& t : { Triangle{ p, q, r }, Triangle{ q, p, r } })
      for(double enough : { 0., 1e-12 }) {
        const auto found = examine(bounds, t, many, enough);
        CHECK_FALSE(found.is_transversal);
        CHECK_FALSE(found.faces_away); // it does not face away either
      }
  }
  CHECK(inexact > 100);
}

TEST_CASE("Second-order bounds: a facet that leaves the domain between its corners by less than rounding is not proved")
{
  CGAL::Random random(71);
  // The exact point at 3/16 of the way from -x to y is on one side of zero. Repeated midpoints with rounding are on the
  // other side.
  const auto ends = [&](bool is_above) {
    for(;;) {
      const double x = random.get_double(0.1, 0.2) + std::ldexp(random.get_double(0, 1), -34), y = 13 * x / 3;
      const double quarter = ((y - x) / 2 - x) / 2, computed = ((quarter - x) / 2 + quarter) / 2;
      const Rational at = 3 * Rational(y) - 13 * Rational(x);
      if(is_above ? at > 0 && computed < 0 : at < 0 && computed > 0) return std::make_pair(x, y);
    }
  };
  for(int missing = 0; missing < 4; ++missing) {
    Field field(cells_where(BS::Lattice_3(CGAL::Bbox_3(-2, -2, -2, 2, 2, 2), 1), { -2, -2, -2 }, { 1, 1, 1 },
                            [&](int i, int j, int) { return ((i >= 0) | (j >= 0) << 1) != missing; }));
    set_polynomial(field, height);
    const Bounds bounds = between(field, -5, 5);
    const double sx = missing & 1 ? 1 : -1, sy = missing & 2 ? 1 : -1; // towards the missing cells
    for(int n = 0; n < 16; ++n) {
      const auto x = ends(true), y = ends(false);
      const Triangle t = { Point_3(-sx * x.first, sy * y.first, 0.1), Point_3(sx * x.second, -sy * y.second, 0.1),
                           Point_3(-sx, -sy, 0.5) };
      for(const Triangle& turned : { t, Triangle{ t[1], t[0], t[2] } }) {
        const auto found = examine(bounds, turned);
        CHECK_FALSE(found.is_contained);
        CHECK_FALSE(found.is_transversal);
      }
    }
  }
}

namespace {

// Bernstein coefficients along one axis of a cell, and those of products over the cell.
typedef std::array<double, 4> Cubic;
typedef std::array<double, 64> Tricubic;
const Cubic one = { 1, 1, 1, 1 }, three_t = { 0, 1, 2, 3 }, rising = { -3, -1, 1, 3 }; // 6 (t - 1/2)
const Cubic parabola = { 3, -1, -1, 3 };                                               // 12 (t - 1/2)^2

Tricubic product(const Cubic& x, const Cubic& y, const Cubic& z)
{
  Tricubic b;
  for(int n = 0; n < 64; ++n) b[n] = x[n % 4] * y[n / 4 % 4] * z[n / 16];
  return b;
}
Tricubic operator*(double s, Tricubic b)
{
  for(double& x : b) x *= s;
  return b;
}
Tricubic operator+(Tricubic a, const Tricubic& b)
{
  for(int n = 0; n < 64; ++n) a[n] += b[n];
  return a;
}

// A minimal field: coefficients on some cells, known up to a radius. The cells cover a box.
class Known_cells
{
public:
  typedef ::Point_3 Point_3;
  typedef std::uint32_t Cell_index;
  typedef BS::Tricubic_cell_3 Cell;
  static constexpr Cell_index npos = Cell_index(-1);
  struct Piece
  {
    std::array<double, 3> corner;
    double width;
    Tricubic coefficients;
  };

  Known_cells(std::vector<Piece> pieces, const CGAL::Bbox_3& covered, double radius = 0)
    : m_pieces(std::move(pieces)), m_covered(covered), m_radius(radius)
  {}
  // Constructs a field on the cell from 0 to 1.
  explicit Known_cells(const Tricubic& b, double radius = 0)
    : Known_cells({ { { 0, 0, 0 }, 1, b } }, CGAL::Bbox_3(0, 0, 0, 1, 1, 1), radius)
  {}

  std::size_t number_of_cells() const { return m_pieces.size(); }
  Cell cell(Cell_index c) const
  {
    const Piece& p = m_pieces[c];
    return Cell(p.corner, p.width, p.coefficients.data(), m_radius);
  }
  Cell_index locate(const Point_3& p) const
  {
    for(Cell_index c = 0; c < m_pieces.size(); ++c)
      if(CGAL::do_overlap(p.bbox(), cell(c).bbox())) return c;
    return npos;
  }
  template <typename Visitor>
  bool visit_cells(const CGAL::Bbox_3& box, const Visitor& visit) const
  {
    for(Cell_index c = 0; c < m_pieces.size(); ++c)
      if(CGAL::do_overlap(box, cell(c).bbox())) visit(c);
    return box + m_covered == m_covered;
  }

private:
  std::vector<Piece> m_pieces;
  CGAL::Bbox_3 m_covered;
  double m_radius;
};
// A field whose `cell()` throws a few times.
struct Failing_cells : Known_cells
{
  using Known_cells::Known_cells;
  Cell cell(Cell_index c) const
  {
    if(failures-- > 0) throw std::runtime_error("no cell");
    return Known_cells::cell(c);
  }
  mutable int failures = 0; // how often `cell()` will still throw
};
typedef BS::Second_order_bounds_3<Known_cells> Known_bounds;

Known_bounds between(const Known_cells& field, double inner, double outer)
{
  return Known_bounds(field, Constant(inner), Constant(outer));
}

// Returns the exact value of a function, or of a derivative, on the cell from 0 to 1.
Rational exact_value(const Tricubic& b, const Exact_point& p, const std::array<int, 3>& order = { 0, 0, 0 })
{
  return bernstein_value(exact_coefficients(b), p, order);
}

Point_3 with_axes(int a, double x, int b, double y, double z)
{
  std::array<double, 3> p = { z, z, z };
  p[a] = x;
  p[b] = y;
  return Point_3(p[0], p[1], p[2]);
}

} // namespace

TEST_CASE("Second-order bounds: verdicts on a field with an error radius hold for all functions within the radius")
{
  const Triangle small = { Point_3(0.5, 0.5, 0.5), Point_3(0.51, 0.5, 0.5), Point_3(0.5, 0.51, 0.5) };
  const auto found = [&](const Tricubic& b, double inner, double outer, const Triangle& t) {
    const Known_cells field(b, 1);
    return examine(between(field, inner, outer), t);
  };
  const Tricubic rise = product(one, one, rising);
  SECTION("values: functions within the radius differ by up to the radius")
  {
    CHECK_FALSE(found(10. * rise, -0.75, 10, small).is_contained);
    CHECK_FALSE(found(10. * rise, -10, 0.75, small).is_contained);
    CHECK(found(10. * rise, -5, 5, small).is_contained);
    CHECK_FALSE(found(10. * rise, 0.75, 10, small).leaves_shell);
    CHECK_FALSE(found(10. * rise, -10, -0.75, small).leaves_shell);
    CHECK(found(10. * rise, 10, 20, small).leaves_shell);
    CHECK(found(10. * rise, -20, -10, small).leaves_shell);
  }
  SECTION("slopes: functions within the radius differ by up to six times the radius")
  {
    // Some function within the radius has a slope of the other sign where t is 0.
    CHECK_FALSE(found(5. / 6 * rise, -100, 100, small).is_transversal);
    CHECK_FALSE(found(-5. / 6 * rise, -100, 100, small).faces_away);
    CHECK(found(-10. * rise, -200, 200, small).faces_away);
    const auto steep = found(10. * rise, -200, 200, small);
    CHECK(steep.is_transversal);
    CHECK(steep.slope <= 60 - 6);
  }
  SECTION("second derivatives: 6 x (x - 3) has a dip, though a linear function is within the radius in each cell")
  {
    std::vector<Known_cells::Piece> cells;
    for(int i = 0; i < 3; ++i) {
      const double value = 6 * i * (i - 3), slope = 12 * i - 18;
      const Cubic exact_cubic = { value, value + slope / 3, value + 2 * slope / 3 + 2, value + slope + 6 };
      Cubic linear;
      for(int n = 0; n < 4; ++n) {
        linear[n] = value - 1 + n * (slope / 3 + 2);
        REQUIRE(std::abs(linear[n] - exact_cubic[n]) <= 1);
      }
      cells.push_back({ { double(i), 0, 0 }, 1, product(linear, one, one) });
    }
    Triangle t = { Point_3(0.1, 0.5, 0.5), Point_3(2.9, 0.5, 0.5), Point_3(2.9, 0.51, 0.5) };
    const double ends = 6 * 0.1 * (0.1 - 3), middle = -6 * 1.5 * 1.5;
    for(double sign : { 1., -1. }) {
      for(auto& c : cells) c.coefficients = sign * c.coefficients;
      auto rising_cells = cells;
      for(auto& c : rising_cells) c.coefficients = c.coefficients + 10. * rise;
      const Known_cells field(rising_cells, CGAL::Bbox_3(0, 0, 0, 3, 1, 1), 1);
      for(double share : { 0.4, 0.5, 0.9 }) {
        const double level = sign * (ends + share * (middle - ends));
        CHECK_FALSE(examine(sign > 0 ? between(field, level, 100) : between(field, -100, level), t).is_contained);
      }
      CHECK(examine(between(field, -100, 100), t).is_contained);
    }
  }
}

TEST_CASE("Second-order bounds: concurrent requests for the same cells yield the same results as one thread")
{
  CGAL::Random random(5);
  Field field(random_hierarchy(random, cells_of_cube(), 4, 2));
  set_random(field, random, height, 0.05);
  std::vector<Triangle> triangles;
  for(int n = 0; n < 300; ++n) triangles.push_back(random_triangle(random, n));
  const auto examine_all = [&](const Bounds& bounds) {
    std::vector<double> slopes;
    for(const Triangle& t : triangles) slopes.push_back(examine(bounds, t).slope);
    return slopes;
  };
  const std::vector<double> expected = examine_all(Bounds(field, Constant(-10), Constant(10)));
  CHECK(std::any_of(expected.begin(), expected.end(), [](double slope) { return slope > 0; }));
  for(int times = 0; times < 20; ++times) {
    const Bounds bounds(field, Constant(-10), Constant(10));
    std::array<std::vector<double>, 4> found;
    std::vector<std::thread> threads;
    for(auto& slopes : found) threads.emplace_back([&] { slopes = examine_all(bounds); });
    for(std::thread& thread : threads) thread.join();
    for(const auto& slopes : found) CHECK(slopes == expected);
  }
}

TEST_CASE("Second-order bounds: an exception of the field propagates, and the cell can be requested again")
{
  const Failing_cells field(10. * product(one, one, rising));
  const BS::Second_order_bounds_3<Failing_cells> bounds(field, Constant(-5), Constant(5));
  const Triangle t = { Point_3(0.5, 0.5, 0.5), Point_3(0.51, 0.5, 0.5), Point_3(0.5, 0.51, 0.5) };
  for(int times = 0; times < 2; ++times) {
    field.failures = 1;
    CHECK_THROWS_AS(examine(bounds, t), std::runtime_error);
  }
  CHECK(examine(bounds, t).is_contained);
}

TEST_CASE("Second-order bounds: a facet leaves the shell only if it passes the local value of the threshold")
{
  // The thresholds vary by less than 1/1000 of the thickness.
  const auto leaves = [](double value) {
    const Tricubic constant = product(one, one, one), variation = 2e-4 / 3 * product(three_t, one, one);
    const Known_cells field(value * constant), inner(variation), outer(constant + variation);
    const BS::Spline_threshold<Known_cells> i(inner), o(outer);
    const BS::Second_order_bounds_3<Known_cells, BS::Spline_threshold<Known_cells>> bounds(field, i, o);
    const auto facet = [&](double x) {
      return examine(bounds, { Point_3(x, 0.4, 0.4), Point_3(x, 0.6, 0.4), Point_3(x, 0.4, 0.6) }).leaves_shell;
    };
    return std::make_pair(facet(0), facet(1));
  };
  CHECK_FALSE(leaves(5e-5).first);
  CHECK_FALSE(leaves(1 + 1e-4).second);
  CHECK(leaves(-1e-3).first);
  CHECK(leaves(1 + 1e-3).second);
}

TEST_CASE("Second-order bounds: proved claims hold for all normals within the radius")
{
  SECTION("the slope along a normal other than the central one is bounded")
  {
    // 3 z + phi(x), where phi' is near zero at the corners, and -72 halfway between them
    constexpr double radius = 1. / 16;
    const Known_cells field(product(one, one, three_t) + -48. * product({ 0, 0, 1, 1 }, one, one));
    const Triangle t = { Point_3(0.03125, 0.25, 0.5), Point_3(0.96875, 0.25, 0.5 - 0.9375 * radius),
                         Point_3(0.03125, 0.5, 0.5) };
    const Known_bounds bounds = between(field, -1000, 1000);
    const auto found = bounds.examine({ bounds.sample(t[0]), bounds.sample(t[1]), bounds.sample(t[2]) },
                                      BS::Facet_normal{ { 0, 0, 1 }, radius }, many);
    CHECK_FALSE(found.is_transversal);
  }
  SECTION("cells are examined that the facet reaches, but the plane of the central normal does not")
  {
    // 3000 z^3 (2.875 - x) for negative z, and zero above, plus a function that vanishes on the facet and rises across
    // it.
    constexpr double radius = 0.25, end = 2.875;
    std::vector<Known_cells::Piece> cells;
    for(int i = 0; i < 3; ++i)
      for(int k : { 0, -1 }) {
        const Tricubic across = product(three_t, one, one) + 4. * product(one, one, three_t)
                                + (3 * i + 12 * k - 6.375) * product(one, one, one);
        const double at = 3 * (end - i);
        const Tricubic steep_part = product({ at, at - 1, at - 2, at - 3 }, one, { -1, 0, 0, 0 });
        cells.push_back({ { double(i), 0, double(k) }, 1, across + (k < 0 ? 1000 : 0) * steep_part });
      }
    const Known_cells field(cells, CGAL::Bbox_3(0, 0, -1, 3, 1, 1));
    const Triangle t = { Point_3(0.125, 0.5, 0.5), Point_3(end, 0.5, 0.5 - (end - 0.125) * radius),
                         Point_3(0.125, 0.6, 0.5) };
    const Point_3 inside = CGAL::midpoint(t[1], CGAL::midpoint(t[1], CGAL::midpoint(t[0], t[1])));
    const double low = field.cell(field.locate(inside)).value(inside);
    REQUIRE(low < -0.5);
    const Known_bounds bounds = between(field, 0.9 * low, 1);
    const auto found = bounds.examine({ bounds.sample(t[0]), bounds.sample(t[1]), bounds.sample(t[2]) },
                                      BS::Facet_normal{ { 0, 0, 1 }, radius }, 0);
    CHECK_FALSE(found.is_contained);
  }
}

TEST_CASE("Second-order bounds: a mixed derivative that changes its sign in a cell is detected, for any pair of axes")
{
  for(int a = 0; a < 3; ++a)
    for(int b = 0; b < 3; ++b) {
      if(a == b) continue;
      const int c = 3 - a - b;
      const auto along_axes = [&](const Cubic& on_a, const Cubic& on_b, const Cubic& on_c = one) {
        std::array<Cubic, 3> all;
        all[a] = on_a;
        all[b] = on_b;
        all[c] = on_c;
        return product(all[0], all[1], all[2]);
      };
      for(double sign : { 1., -1. }) {
        // 72 (x - 1/2)^2 (y - 1/2), rising along the third axis, plus a linear term that makes the ends of a needle
        // equally high
        const Tricubic curved = sign * along_axes(parabola, rising);
        Triangle needle = { with_axes(a, 0.97, b, 0.03, 0.5), with_axes(a, 0.8, b, 0.97, 0.5),
                            with_axes(a, 0.81, b, 0.97, 0.5) };
        const double low = CGAL::to_double(exact_value(curved, exact(needle[0]))),
                     high = CGAL::to_double(exact_value(curved, exact(needle[1])));
        const Tricubic f = curved + (low - high) / (3 * 0.94) * along_axes(one, three_t);
        const double ends = CGAL::to_double(exact_value(f, exact(needle[0]))),
                     middle = CGAL::to_double(exact_value(f, exact(CGAL::midpoint(needle[0], needle[1]))));
        REQUIRE(sign * (middle - ends) > 1);
        if(normal(needle)[c] < 0) std::swap(needle[0], needle[1]);
        const Known_cells field(f + 100. * along_axes(one, one, rising));
        for(double share : { 0.4, 0.7, 0.95 }) {
          const double level = ends + share * (middle - ends);
          CHECK_FALSE(
            examine(sign > 0 ? between(field, -100, level) : between(field, level, 100), needle, 0).is_contained);
        }
        CHECK(examine(between(field, -100, 100), needle, 0).is_contained);
      }
      // 36 (x - 1/2)^2 y, and permutations: the slope along one axis is least halfway along another
      for(double margin : { 1., 0.1 }) {
        const Known_cells field(along_axes(parabola, three_t) + -margin * along_axes(one, three_t));
        Triangle t = { with_axes(a, 0.05, b, 0.5, 0.4), with_axes(a, 0.95, b, 0.5, 0.4),
                       with_axes(a, 0.05, b, 0.5, 0.6) };
        if(normal(t)[b] < 0) std::swap(t[0], t[1]);
        for(std::size_t bisections : { std::size_t(0), many })
          CHECK_FALSE(examine(between(field, -100, 100), t, bisections).is_transversal);
        const Known_cells steeper(along_axes(parabola, three_t) + margin * along_axes(one, three_t));
        const auto found = examine(between(steeper, -100, 100), t);
        CHECK(found.is_transversal);
        CHECK(found.slope <= 3 * margin);
      }
    }
}

TEST_CASE("Second-order bounds: a slope that falls as fast as the bound allows, and then rises, is detected")
{
  // 3 z (phi(x) - margin), where phi is 3 |x| except near 0, on cells of width 1/8. Here, the bound allows a fall that
  // is only 1/25 larger than the actual one.
  constexpr double h = 0.125;
  const Cubic falls = { 3.25, 2.25, 1.25, 0.25 }, rises = { 0.25, 1.25, 2.25, 3.25 }, left = { 0.25, 0.125, 0, 0 },
              right = { 0, 0, 0.125, 0.25 };
  const Triangle t = { Point_3(-1.1, 0.03, 0.0625), Point_3(1.1, 0.03, 0.0625), Point_3(1.1, 0.06, 0.0625) };
  const auto field = [&](double least) {
    const auto piece = [&](double x, double width, Cubic phi) {
      for(double& c : phi) c += least;
      return Known_cells::Piece{ { x, 0, 0 }, width, width * product(phi, one, three_t) };
    };
    return Known_cells({ piece(-1 - h, 1, falls), piece(-h, h, left), piece(0, h, right), piece(h, 1, rises) },
                       CGAL::Bbox_3(-1 - h, 0, 0, 1 + h, h, h));
  };
  const Known_cells turned = field(-1. / 64), steep = field(0.25);
  CHECK_FALSE(examine(between(turned, -100, 100), t, 0).is_transversal);
  CHECK(examine(between(steep, -100, 100), t, 0).is_transversal);
}

TEST_CASE("Second-order bounds: far from the origin, a facet that faces away only at a rounded midpoint is not proved")
{
  // The cell begins at 2^30. Relative to its corner, the slope along z is 9 (x - 1/2)^2 / 2^17 - 12 (z - 1/2) + 3 ulp.
  const double far = std::ldexp(1., 30), ulp = std::ldexp(1., -22);
  const Tricubic f = std::ldexp(1., -19) * product(parabola, one, three_t) + -0.5 * product(one, one, parabola)
                     + ulp * product(one, one, three_t);
  const Known_cells field({ { { 0, 0, far }, 1, f } }, CGAL::Bbox_3(0, 0, far, 1, 1, far + 1));
  const Triangle t = { Point_3(0.25, 0.2, far + 0.5), Point_3(0.75, 0.2, far + 0.5 + ulp),
                       Point_3(0.5, 0.203125, far + 0.5 - 4 * ulp) };
  const Exact_point middle = { Rational(0.5), Rational(0.2), Rational(0.5) + Rational(ulp) / 2 };
  const auto derivative = [&](int axis) { return exact_value(f, middle, { axis == 0, axis == 1, axis == 2 }); };
  REQUIRE(derivative(0) == 0);
  REQUIRE(derivative(1) == 0);
  REQUIRE(derivative(2) < 0);
  REQUIRE(CGAL::midpoint(t[0], t[1]).z() == far + 0.5);
  CHECK_FALSE(examine(between(field, -100, 100), t).is_transversal);
}

TEST_CASE(
  "Second-order bounds: far from the origin, a facet beyond a threshold only at a rounded midpoint is not proved")
{
  // The cell begins at 2^30. Relative to its corner, the field is 12 (x - 1/2)^2 + 6 (z - 1/2). For the outer
  // threshold, the first term is subtracted.
  const double far = std::ldexp(1., 30), ulp = std::ldexp(1., -22);
  for(double side : { 1., -1. }) {
    const Tricubic f = side * product(parabola, one, one) + product(one, one, rising);
    const Known_cells field({ { { 0, 0, far }, 1, f } }, CGAL::Bbox_3(0, 0, far, 1, 1, far + 1));
    const Triangle t = { Point_3(0.25, 0.2, far + 0.5), Point_3(0.75, 0.2, far + 0.5 - side * ulp),
                         Point_3(0.5, 0.203125, far + 0.5 + side * 4 * ulp) };
    // halfway between the field at the exact middle of an edge and at the rounded one
    const double threshold = -side * 1.5 * ulp;
    const Exact_point middle = { Rational(0.5), Rational(0.2), Rational(0.5) - Rational(side * ulp) / 2 };
    REQUIRE(side * (exact_value(f, middle, { 0, 0, 0 }) - Rational(threshold)) < 0);
    REQUIRE(CGAL::midpoint(t[0], t[1]).z() == far + 0.5);
    const auto found = side > 0 ? examine(between(field, threshold, 100), t)
                                : examine(between(field, -100, threshold), t);
    CHECK_FALSE(found.is_contained);
    // Only the rounding of the place prevents the proof: with a slightly farther threshold, it succeeds.
    const double farther = threshold - side * 1e-3;
    CHECK(
      (side > 0 ? examine(between(field, farther, 100), t) : examine(between(field, -100, farther), t)).is_contained);
  }
}

TEST_CASE("Second-order bounds: a dip in a cell that holds only one corner of the facet is detected")
{
  // 600 (x - 1)^3 (y - 1/2) where x > 1, plus a function that rises along z. It is zero at all corners, and -11 at a
  // point of an edge.
  const Tricubic rise = product(one, one, rising), steep_part = 100. * product({ 0, 0, 0, 1 }, rising, one);
  const Known_cells field({ { { 0, 0, 0 }, 1, 10. * rise }, { { 1, 0, 0 }, 1, 10. * rise + steep_part } },
                          CGAL::Bbox_3(0, 0, 0, 2, 1, 1));
  const Triangle t = { Point_3(0.5, 0.1, 0.5), Point_3(1.9, 0.5, 0.5), Point_3(0.5, 0.5, 0.5) };
  for(int first : { 0, 1, 2 }) {
    const Triangle turned = { t[first], t[(first + 1) % 3], t[(first + 2) % 3] };
    CHECK_FALSE(examine(between(field, -5, 100), turned).is_contained);
    CHECK(examine(between(field, -20, 100), turned).is_contained);
  }
}
} // namespace test_Second_order_bounds_3
