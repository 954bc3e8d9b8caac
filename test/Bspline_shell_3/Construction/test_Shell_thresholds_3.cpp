// Shell_thresholds_3.h: thresholds are as wide as requested, narrower under caps, and never narrower than the mesh
// requires.
#include "coefficient_functions.h"
#include "input_of_mesh.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Construction/Shell_thresholds_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace test_Shell_thresholds_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Sequential_tag Tag;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef BS::Shell_thresholds_3<Field> Thresholds;
typedef BS::Level_range Level_range;
typedef Field::Cell_index Index;

const double inf = std::numeric_limits<double>::infinity();
constexpr CGAL::Sign sides[] = { CGAL::NEGATIVE, CGAL::POSITIVE };

double requested(const Point_3&)
{
  return 0.5;
}

// Returns a factor for coefficients of a threshold; their products increase outwards for both thresholds.
double sign(CGAL::Sign side)
{
  return side == CGAL::POSITIVE ? 1 : -1;
}

// Cells of width 1/2 and smaller around the unit sphere, and the ranges of a bumpy function on its mesh.
struct Problem
{
  BS::Input_mesh_3 input = input_of(sphere(2));
  Field field;
  BS::Clipped_mesh_3 clipped;
  std::vector<Level_range> ranges;

  Problem()
  {
    CGAL::Random random(1);
    Hierarchy cells(all_cells(0.5, { -5, -5, -5 }, { 4, 4, 4 }));
    for(int n = 0; n < 2; ++n) cells = cells.refined({ cells.locate(Point_3(0, 0.6, 0.8)) });
    field = Field(cells);
    REQUIRE(field.number_of_levels() == 3);
    set_coefficients(
      field, [&](const Point_3& p, double) { return distance(p, CGAL::ORIGIN) - 1 + random.get_double(-0.3, 0.3); });
    clipped = BS::clip_mesh_to_cells<Tag>(input, cells);
    ranges = BS::facet_ranges<Tag>(field, clipped).cell;
  }

  bool is_on_mesh(Index c) const { return ranges[c].min <= ranges[c].max; }
  Index random_cell(CGAL::Random& random) const { return Index(random.get_int(0, int(field.number_of_cells()))); }
};

const Problem& problem()
{
  static const Problem p;
  return p;
}

// Returns the range of the Bernstein coefficients of a leaf.
Level_range hull(const Field& threshold, Index c)
{
  Level_range r;
  for(int n = 0; n < 64; ++n) r.include(threshold.cell(c).coefficients()[n]);
  return r;
}

Point_3 random_point(CGAL::Random& random, const CGAL::Bbox_3& b)
{
  return Point_3(random.get_double(b.xmin(), b.xmax()), random.get_double(b.ymin(), b.ymax()),
                 random.get_double(b.zmin(), b.zmax()));
}

const CGAL::Bbox_3 domain(-2.5, -2.5, -2.5, 2.5, 2.5, 2.5);

double squared_distance(const Point_3& p, const CGAL::Bbox_3& b)
{
  double squared = 0;
  for(int a = 0; a < 3; ++a) {
    const double gap = (std::max)({ 0., p[a] - (b.max)(a), (b.min)(a)-p[a] });
    squared += gap * gap;
  }
  return squared;
}

// Returns a threshold with one cap, without a mesh.
Field capped_once(const Field& field, double slope, Index c, CGAL::Sign side, double size)
{
  Thresholds thresholds(field, requested, slope);
  thresholds.cap(c, side, sign(side) * size);
  return thresholds.threshold<Tag>(side);
}

// Returns the largest slope at many points. Differences of coefficients are bounded along lines of coefficients. In
// other directions, the spline can be steeper, but only slightly where coefficients grow with a distance.
double steepest(const Field& threshold, CGAL::Random& random)
{
  double largest = 0;
  for(int n = 0; n < 4000; ++n)
    largest = (std::max)(largest, threshold.gradient(random_point(random, domain)).value().squared_length());
  return std::sqrt(largest);
}

} // namespace

TEST_CASE("Shell thresholds: the mesh lies between the thresholds in every cell, whatever the caps")
{
  const Problem& p = problem();
  CGAL::Random random(2);
  for(int caps : { 0, 1, 30 }) {
    Thresholds thresholds(p.field, requested);
    thresholds.set_mesh_ranges(p.ranges);
    for(int n = 0; n < caps; ++n) {
      const CGAL::Sign side = sides[n % 2];
      thresholds.cap(p.random_cell(random), side, sign(side) * random.get_double(-0.3, 0.3));
    }
    const Field inner = thresholds.threshold<Tag>(CGAL::NEGATIVE), outer = thresholds.threshold<Tag>(CGAL::POSITIVE);
    int narrowed = 0;
    for(Index c = 0; c < p.field.number_of_cells(); ++c) {
      if(!p.is_on_mesh(c)) continue;
      // up to rounding in the conversion to Bernstein coefficients
      CHECK(hull(inner, c).max <= p.ranges[c].min + 1e-14);
      CHECK(hull(outer, c).min >= p.ranges[c].max - 1e-14);
      narrowed += hull(outer, c).min < 0.249 || hull(inner, c).max > -0.249;
    }
    CHECK((narrowed > 0) == (caps > 0));
    for(const BS::Clipped_mesh_3::Piece& piece : p.clipped.pieces())
      for(std::uint32_t v = 0; v < piece.size; ++v) {
        const auto& q = p.clipped.point(piece.first + v);
        const Point_3 at(q[0], q[1], q[2]);
        const double f = p.field.value(at).value();
        CHECK(inner.value(at).value() <= f + 1e-14);
        CHECK(outer.value(at).value() >= f - 1e-14);
      }
  }
  // The mesh is contained not only because thresholds are wide: here, its ranges exceed the requested width.
  std::vector<Level_range> wide = p.ranges;
  for(Level_range& r : wide)
    if(r.min <= r.max) r = { r.min - 0.4, r.max + 0.2 };
  Thresholds thresholds(p.field, requested);
  thresholds.set_mesh_ranges(wide);
  const Field inner = thresholds.threshold<Tag>(CGAL::NEGATIVE), outer = thresholds.threshold<Tag>(CGAL::POSITIVE);
  for(Index c = 0; c < p.field.number_of_cells(); ++c) {
    if(!(wide[c].min <= wide[c].max)) continue;
    CHECK(hull(inner, c).max <= wide[c].min + 1e-14);
    CHECK(hull(outer, c).min >= wide[c].max - 1e-14);
    CHECK(thresholds.needed(c, CGAL::NEGATIVE) <= wide[c].min);
    CHECK(thresholds.needed(c, CGAL::POSITIVE) >= wide[c].max);
  }
  // New ranges replace the old ones.
  thresholds.set_mesh_ranges(std::vector<Level_range>(p.field.number_of_cells()));
  for(Index c = 0; c < p.field.number_of_cells(); ++c) {
    CHECK(hull(thresholds.threshold<Tag>(CGAL::POSITIVE), c).max == Approx(0.25));
    if(c > 20) break;
  }
}

TEST_CASE("Shell thresholds: a cell needs the room of all functions acting in it, as found by a search")
{
  const Problem& p = problem();
  Thresholds thresholds(p.field, requested);
  thresholds.set_mesh_ranges(p.ranges);
  // extrema on the mesh in the supports of basis functions
  std::vector<Level_range> of(p.field.number_of_coefficients());
  for(Index c = 0; c < p.field.number_of_cells(); ++c)
    if(p.is_on_mesh(c)) p.field.visit_coefficients(c, [&](int, Index u, double) { of[u].include(p.ranges[c]); });
  for(Index c = 0; c < p.field.number_of_cells(); ++c) {
    Level_range expected;
    p.field.visit_coefficients(c, [&](int, Index u, double) { expected.include(of[u]); });
    CHECK(thresholds.needed(c, CGAL::POSITIVE) == expected.max);
    CHECK(thresholds.needed(c, CGAL::NEGATIVE) == expected.min);
  }
}

TEST_CASE("Shell thresholds: a cap applies in its cell, as far as the mesh allows, and only to its side")
{
  const Problem& p = problem();
  CGAL::Random random(3);
  int needing = 0;
  for(int n = 0; n < 24; ++n) {
    const CGAL::Sign side = sides[n % 2];
    const Index c = p.random_cell(random);
    const double size = random.get_double(-0.1, 0.24);
    Thresholds thresholds(p.field, requested);
    thresholds.set_mesh_ranges(p.ranges);
    thresholds.cap(c, side, sign(side) * size);
    const Level_range r = hull(thresholds.threshold<Tag>(side), c);
    const double largest = side == CGAL::POSITIVE ? r.max : -r.min, needed = sign(side) * thresholds.needed(c, side);
    CHECK(largest <= (std::max)(size, needed) + 1e-14);
    needing += needed > size;
    Thresholds without(p.field, requested);
    without.set_mesh_ranges(p.ranges);
    CHECK(thresholds.threshold<Tag>(CGAL::opposite(side)).coefficients()
          == without.threshold<Tag>(CGAL::opposite(side)).coefficients());
    // a cap wider than requested, and a weaker one in the same cell
    const Eigen::VectorXd x = thresholds.threshold<Tag>(side).coefficients();
    thresholds.cap(c, side, sign(side) * 0.25);
    thresholds.cap(c, side, sign(side) * (size + 0.01));
    CHECK(thresholds.threshold<Tag>(side).coefficients() == x);
  }
  CHECK(needing > 2);
  CHECK(needing < 22);
}

TEST_CASE("Shell thresholds: caps can be copied to other thresholds, even on finer cells")
{
  const Problem& p = problem();
  CGAL::Random random(9);
  const Field finer(p.field.cells().refined({ p.random_cell(random), p.random_cell(random) }));
  Thresholds capped(p.field, requested), again(p.field, requested), on_finer(finer, requested);
  for(int n = 0; n < 8; ++n)
    capped.cap(p.random_cell(random), sides[n % 2], sign(sides[n % 2]) * random.get_double(0, 0.2));
  REQUIRE(capped.caps().size() == 8);
  for(const Thresholds::Cap& cap : capped.caps()) {
    again.cap(cap);
    on_finer.cap(cap);
  }
  CHECK(again.caps().size() == 8);
  for(CGAL::Sign side : sides) {
    const Eigen::VectorXd x = capped.threshold<Tag>(side).coefficients(),
                          y = on_finer.threshold<Tag>(side).coefficients();
    CHECK(again.threshold<Tag>(side).coefficients() == x);
    std::size_t common = 0, below = 0;
    for(int l = 0; l < p.field.number_of_levels(); ++l)
      for(Index n = 0; n < p.field.points(l).size(); ++n) {
        const Index u = p.field.coefficient_of_point(p.field.first_point(l) + n),
                    m = finer.points(l).index(p.field.points(l).point(n));
        const Index v = u == Field::npos || m == Field::npos ? Field::npos
                                                             : finer.coefficient_of_point(finer.first_point(l) + m);
        if(v == Field::npos) continue;
        ++common;
        below += std::abs(x[u]) < 0.25;
        CHECK(x[u] == y[v]);
      }
    CHECK(common > 100);
    CHECK(below > 10);
  }
}

TEST_CASE("Shell thresholds: with distance from a cap, the threshold rises to its requested value")
{
  const Problem& p = problem();
  CGAL::Random random(4);
  for(double slope : { 0.1, 0.2, 0.5 })
    for(int n = 0; n < 12; ++n) {
      const CGAL::Sign side = sides[n % 2];
      const Index c = n % 3 == 0 ? Index(p.field.number_of_cells() - 1 - Index(random.get_int(0, 20)))
                                 : p.random_cell(random);
      const double size = random.get_double(0, 0.2);
      const Field threshold = capped_once(p.field, slope, c, side, size);
      const CGAL::Bbox_3 b = p.field.cell(c).bbox();
      int rising = 0;
      for(int m = 0; m < 2000; ++m) {
        const Point_3 q = random_point(random, domain);
        const double value = sign(side) * threshold.value(q).value(), distance = std::sqrt(squared_distance(q, b));
        CHECK(value >= size - 1e-14);
        CHECK(value <= 0.25 + 1e-14);
        // A basis function has a support of four cells of its size per axis.
        CHECK(value <= size + slope * distance + 1e-14);
        const double width = p.field.cells().level_width(0);
        CHECK(value >= (std::min)(0.25, size + slope * (distance - 4 * std::sqrt(3.) * width)) - 1e-14);
        rising += value > size + 1e-6 && value < 0.25 - 1e-6;
      }
      CHECK(rising > 0);
    }
}

TEST_CASE("Shell thresholds: the slope around a cap is bounded on cells of equal size")
{
  CGAL::Random random(7);
  const Field field(Hierarchy(all_cells(0.25, { -10, -10, -10 }, { 9, 9, 9 })));
  for(double slope : { 0.1, 0.3 })
    for(int n = 0; n < 6; ++n)
      CHECK(
        steepest(capped_once(field, slope, Index(random.get_int(0, int(field.number_of_cells()))), sides[n % 2], 0.05),
                 random)
        <= slope * 1.25);
}

TEST_CASE("Shell thresholds: the slope around a cap is bounded, even where cells of different sizes meet")
{
  const Problem& p = problem();
  CGAL::Random random(8);
  for(double slope : { 0.1, 0.3 })
    for(int n = 0; n < 12; ++n)
      CHECK(steepest(capped_once(p.field, slope, p.random_cell(random), sides[n % 2], 0.05), random) <= slope * 1.25);
}

TEST_CASE("Shell thresholds: several caps yield the minimum of their thresholds, in any order")
{
  const Problem& p = problem();
  CGAL::Random random(5);
  struct Cap
  {
    Index cell;
    CGAL::Sign side;
    double size;
  };
  std::vector<Cap> caps;
  for(int n = 0; n < 12; ++n) caps.push_back({ p.random_cell(random), sides[n % 2], random.get_double(-0.1, 0.2) });
  const auto capped = [&](const std::vector<Cap>& list, CGAL::Sign side) {
    Thresholds thresholds(p.field, requested);
    thresholds.set_mesh_ranges(p.ranges);
    for(const Cap& c : list) thresholds.cap(c.cell, c.side, sign(c.side) * c.size);
    return Eigen::VectorXd(sign(side) * thresholds.threshold<Tag>(side).coefficients());
  };
  for(CGAL::Sign side : sides) {
    Eigen::VectorXd least = capped({}, side);
    for(const Cap& c : caps) least = least.cwiseMin(capped({ c }, side));
    CHECK(capped(caps, side) == least);
    CHECK(capped(std::vector<Cap>(caps.rbegin(), caps.rend()), side) == least);
  }
}

TEST_CASE("Shell thresholds: set_constant() yields two constant levels")
{
  const Problem& p = problem();
  Thresholds thresholds(p.field, requested);
  thresholds.set_mesh_ranges(p.ranges);
  thresholds.cap(0, CGAL::POSITIVE, 0);
  thresholds.set_constant({ -0.125, 0.375 });
  for(CGAL::Sign side : sides) {
    const double level = side == CGAL::POSITIVE ? 0.375 : -0.125;
    const Field threshold = thresholds.threshold<Tag>(side);
    for(Index c = 0; c < p.field.number_of_cells(); ++c) {
      const Level_range r = hull(threshold, c);
      CHECK(r.min == Approx(level).epsilon(1e-14));
      CHECK(r.max == Approx(level).epsilon(1e-14));
      CHECK(thresholds.needed(c, side) == level);
    }
  }
}

TEST_CASE("Shell thresholds: a varying thickness is reproduced where no cap narrows it")
{
  const Problem& p = problem();
  // A spline reproduces linear functions.
  const auto linear = [](const Point_3& q) { return 1 + 0.2 * q.x() - 0.1 * q.z(); };
  Thresholds thresholds(p.field, linear);
  CGAL::Random random(6);
  const Field inner = thresholds.threshold<Tag>(CGAL::NEGATIVE), outer = thresholds.threshold<Tag>(CGAL::POSITIVE);
  for(int n = 0; n < 1000; ++n) {
    const Point_3 q = random_point(random, domain);
    CHECK(outer.value(q).value() == Approx(linear(q) / 2).epsilon(1e-9));
    CHECK(inner.value(q).value() == Approx(-linear(q) / 2).epsilon(1e-9));
  }
  // A cap far below the requested thickness has an effect as far as the largest thickness requires.
  Thresholds capped(p.field, linear);
  const Index c = p.field.locate(Point_3(0.1, 0.1, 0.1));
  capped.cap(c, CGAL::POSITIVE, 0.1);
  const Field threshold = capped.threshold<Tag>(CGAL::POSITIVE);
  CHECK(hull(threshold, c).max <= 0.1 + 1e-14);
  for(int n = 0; n < 1000; ++n) {
    const Point_3 q = random_point(random, domain);
    CHECK(threshold.value(q).value() <= linear(q) / 2 + 1e-9);
  }
  // A thickness with jumps is reproduced at a distance from the jumps.
  const auto step = [](const Point_3& q) { return q.x() < 0 ? 0.2 : 0.6; };
  const Field stepped = Thresholds(p.field, step).threshold<Tag>(CGAL::POSITIVE);
  for(int n = 0; n < 1000; ++n) {
    const Point_3 q = random_point(random, domain);
    const double value = stepped.value(q).value();
    CHECK(value >= 0.1 - 1e-14);
    CHECK(value <= 0.3 + 1e-14);
    if(std::abs(q.x()) > 1) CHECK(value == Approx(q.x() < 0 ? 0.1 : 0.3).epsilon(1e-12));
  }
}

TEST_CASE("Shell thresholds: the result does not depend on the number of threads")
{
  const Problem& p = problem();
  Thresholds thresholds(p.field, requested);
  thresholds.set_mesh_ranges(p.ranges);
  thresholds.cap(5, CGAL::POSITIVE, 0.1);
  const Field one = thresholds.threshold<CGAL::Sequential_tag>(CGAL::POSITIVE),
              two = thresholds.threshold<CGAL::Parallel_if_available_tag>(CGAL::POSITIVE);
  CHECK(one.coefficients() == two.coefficients());
  for(Index c = 0; c < p.field.number_of_cells(); ++c)
    CHECK(std::equal(one.cell(c).coefficients(), one.cell(c).coefficients() + 64, two.cell(c).coefficients()));
}
} // namespace test_Shell_thresholds_3
