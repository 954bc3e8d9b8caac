// Shell_cover_3.h: claims about boxes hold at points of the boxes, in exact arithmetic. Floods agree with a search
// through all pairs of boxes, in integers.
#include "exact_spline.h"
#include "polynomial_fields.h"
#include "random_hierarchies.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_cover_3.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Field/refined_coefficients.h>
#include <CGAL/Bspline_shell_3/Spline/critical_values.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace test_Shell_cover_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef BS::Constant_threshold Constant;
typedef BS::Spline_threshold<Field> Varying;
typedef BS::Shell_cover_3<Field> Cover;
typedef BS::Shell_cover_3<Field, Varying> Varying_cover;
typedef CGAL::Sequential_tag Tag;
using BS::Box_kind;
using BS::Cover_box;

constexpr std::uint32_t none = Cover_box::no_component;
constexpr double pi = 3.141592653589793;

// Sets each free coefficient by a function of the point at which its basis function is centered.
template <typename Function>
Field with(Field field, const Function& f)
{
  Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
  for(Field::Cell_index n = 0; n < field.number_of_coefficients(); ++n) {
    const auto point = field.point_of_coefficient(n);
    int l = field.number_of_levels() - 1;
    while(point >= field.first_point(l) + field.points(l).size()) --l;
    const Lattice_point& p = field.points(l).point(point - field.first_point(l));
    x[n] = f(field.cells().coordinate(l, 0, p[0]), field.cells().coordinate(l, 1, p[1]),
             field.cells().coordinate(l, 2, p[2]));
  }
  field.set_coefficients(x);
  return field;
}

// Returns a field on cells of width one, at random places of a cube of number^3 cells; some cells are split.
Field random_cells(CGAL::Random& random, int number, double share, int levels)
{
  const double h = number / 2.;
  const BS::Lattice_3 lattice(CGAL::Bbox_3(-h, -h, -h, h, h, h), 1);
  return Field(random_hierarchy(random,
                                some_cells(random, lattice, { -number / 2, -number / 2, -number / 2 },
                                           { (number - 1) / 2, (number - 1) / 2, (number - 1) / 2 }, share),
                                levels));
}

// Subdivides all cells.
template <typename AnyCover>
void prepare_all(AnyCover& cover)
{
  std::vector<std::uint32_t> all(cover.field().number_of_cells());
  std::iota(all.begin(), all.end(), 0);
  cover.template prepare<Tag>(all);
}

// A closed box, in integers; the smallest cells are 2^7 units wide.
struct Integer_box
{
  std::array<std::int64_t, 3> low, high;
  bool touches(const Integer_box& other) const
  {
    for(int a = 0; a < 3; ++a)
      if(low[a] > other.high[a] || high[a] < other.low[a]) return false;
    return true;
  }
};

class Boxes
{
public:
  explicit Boxes(const Field& field) : m_cells(&field.cells()), m_smallest(field.cells()) {}

  Integer_box box(const Cover_box& b) const
  {
    Integer_box result;
    const Lattice_point least = m_smallest.begin(*m_cells, b.cell);
    const std::int64_t width = (std::int64_t(m_smallest.size(m_cells->level(b.cell))) << bits) >> b.depth;
    for(int a = 0; a < 3; ++a) {
      result.low[a] = least[a] * (std::int64_t(1) << bits) + b.position[a] * width;
      result.high[a] = result.low[a] + width;
    }
    return result;
  }

  // Calls visit(leaf) for the smallest cells that a box touches, and visit(npos) for places outside the domain.
  template <typename Visitor>
  void visit_around(const Integer_box& b, const Visitor& visit) const
  {
    std::array<std::int64_t, 3> first, last;
    for(int a = 0; a < 3; ++a) {
      first[a] = (b.low[a] - 1) >> bits;
      last[a] = b.high[a] >> bits;
    }
    for(std::int64_t k = first[2]; k <= last[2]; ++k)
      for(std::int64_t j = first[1]; j <= last[1]; ++j)
        for(std::int64_t i = first[0]; i <= last[0]; ++i) visit(m_smallest.leaf({ int(i), int(j), int(k) }));
  }

private:
  static constexpr int bits = 7;
  const Hierarchy* m_cells;
  Smallest_cells m_smallest;
};

// Returns the boxes that a flood from a point must reach, by a search through all pairs.
template <typename AnyCover>
std::vector<char> flooded(const AnyCover& cover, const std::vector<Integer_box>& box, const Point_3& p)
{
  std::vector<char> reached(box.size(), 0);
  std::vector<std::size_t> stack;
  const auto reach = [&](std::size_t n) {
    if(reached[n] || cover.boxes()[n].kind == Box_kind::EXCLUDED) return;
    reached[n] = 1;
    stack.push_back(n);
  };
  for(std::size_t n = 0; n < box.size(); ++n)
    if(do_overlap(cover.bbox(cover.boxes()[n]), CGAL::Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z()))) reach(n);
  while(!stack.empty()) {
    const std::size_t n = stack.back();
    stack.pop_back();
    for(std::size_t m = 0; m < box.size(); ++m)
      if(box[m].touches(box[n])) reach(m);
  }
  return reached;
}

// The exact Bernstein form of a field on a box of a cover, and exact gradients at its corners.
struct Exact_box
{
  Exact_box(const Field& field, const Cover_box& box)
    : box(box), width(field.cell(box.cell).width()), b(field.bernstein_coefficients<Rational>(box.cell))
  {}

  Exact_point place(int n) const
  {
    Exact_point t;
    for(int a = 0; a < 3; ++a) t[a] = Rational(int(box.position[a]) + (n >> a & 1)) / (1 << box.depth);
    return t;
  }
  // Returns the gradient at the n-th corner of the box, per user unit.
  Exact_point gradient(int n) const
  {
    Exact_point g;
    for(int a = 0; a < 3; ++a) {
      std::array<int, 3> order = { 0, 0, 0 };
      order[a] = 1;
      g[a] = bernstein_value(b, place(n), order) / width;
    }
    return g;
  }

  Cover_box box;
  Rational width;
  std::array<Rational, 64> b;
};

// Returns whether one of 27 points of a box is in the shell and at the boundary of the domain: in some direction out of
// the box, there is no cell next to the point.
template <typename IsInShell>
bool is_in_shell_at_end(const Field& field, const CGAL::Bbox_3& b, const IsInShell& is_in_shell)
{
  const double next = 1e-6 * (b.xmax() - b.xmin());
  const auto on = [&](int a, int i, double out) {
    return i < 0 ? (b.min)(a)-out : i > 0 ? (b.max)(a) + out : ((b.min)(a) + (b.max)(a)) / 2;
  };
  for(int k = -1; k <= 1; ++k)
    for(int j = -1; j <= 1; ++j)
      for(int i = -1; i <= 1; ++i) {
        if(!is_in_shell(Point_3(on(0, i, 0), on(1, j, 0), on(2, k, 0)))) continue;
        for(int out = 1; out < 8; ++out)
          if(field.locate(
               Point_3(on(0, i, (out & 1) * next), on(1, j, (out >> 1 & 1) * next), on(2, k, (out >> 2) * next)))
             == Field::npos)
            return true;
      }
  return false;
}

} // namespace

TEST_CASE("Cover: floods agree with a search through all pairs of boxes, on cells of different sizes with holes")
{
  std::size_t boxes = 0, apart = 0, at_end = 0, excluded_at_end = 0, undecided = 0, joined = 0;
  for(unsigned seed = 1; seed < 11; ++seed) {
    CAPTURE(seed);
    CGAL::Random random(seed);
    const bool is_split = seed % 3 == 0, is_ball = seed % 4 == 0;
    const Field cells = random_cells(random, is_split ? 3 : 4, is_split || is_ball ? 1 : 0.55, is_split ? 2 : 1);
    const double x0 = random.get_double(-1, 1), y0 = random.get_double(-1, 1), bend = seed % 2 ? 0.15 : 0.6;
    // Level sets are bent planes, or spheres around a critical point that is not at the corner of a cell.
    const Field field = with(cells, [&](double x, double y, double z) {
      return is_ball ? (x - 0.2) * (x - 0.2) + (y - 0.3) * (y - 0.3) + (z - 0.1) * (z - 0.1)
                     : z + bend * std::sin(1.5 * (x - x0)) * std::cos(1.5 * (y - y0));
    });
    const double level = is_ball ? 1 : random.get_double(-0.5, 0.5), half = is_ball ? 1.05 : seed % 2 ? 0.03 : 0.2;
    Cover cover(field, Constant(level - half), Constant(level + half));
    const Boxes in_units(field);
    // Components are flooded one after the other, from points in the shell. Some points are corners of cells, also at
    // the boundary of the domain.
    std::vector<Point_3> seeds;
    std::vector<std::uint32_t> numbers;
    for(int n = 0; n < 800 && seeds.size() < 8; ++n) {
      Point_3 p(random.get_double(-2, 2), random.get_double(-2, 2), random.get_double(-2, 2));
      if(n % 2 == 0) {
        const CGAL::Bbox_3 b = field.cell(Field::Cell_index(random.get_int(0, int(field.number_of_cells())))).bbox();
        p = n % 4 == 0 ? Point_3(b.xmin(), b.ymin(), b.zmin()) : Point_3(b.xmax(), b.ymax(), b.zmax());
      }
      const auto f = field.value(p);
      if(!f || std::abs(*f - level) > half) continue;
      seeds.push_back(p);
      numbers.push_back(cover.flood<Tag>(p, std::uint32_t(seeds.size() - 1)));
    }
    REQUIRE(!seeds.empty());
    std::vector<Integer_box> box;
    for(const Cover_box& b : cover.boxes()) box.push_back(in_units.box(b));
    boxes += box.size();
    std::vector<char> in_any(box.size(), 0);
    for(std::size_t s = 0; s < seeds.size(); ++s) {
      const std::vector<char> reached = flooded(cover, box, seeds[s]);
      bool same = true, is_known = numbers[s] != s;
      for(std::size_t n = 0; n < box.size(); ++n) {
        same = same && (cover.boxes()[n].component == numbers[s]) == bool(reached[n]);
        in_any[n] = in_any[n] || reached[n];
      }
      CHECK(same);
      if(is_known) {
        REQUIRE(numbers[s] < s);
        CHECK(numbers[numbers[s]] == numbers[s]);
        ++joined;
      } else ++apart;
    }
    // All cells around a component are subdivided. A box with a point of the shell at the boundary of the domain is
    // reported as being at the end.
    std::vector<char> is_subdivided(field.number_of_cells(), 0), is_at_end(box.size(), 0);
    for(const Cover_box& b : cover.boxes()) is_subdivided[b.cell] = 1;
    for(auto b : cover.at_end()) is_at_end[b] = 1;
    std::size_t number_of_undecided = 0, failures = 0;
    for(std::size_t n = 0; n < box.size(); ++n) {
      if(!in_any[n]) {
        failures += cover.boxes()[n].component != none;
        continue;
      }
      number_of_undecided += cover.boxes()[n].kind == Box_kind::UNDECIDED;
      bool is_inside = true, is_known = true;
      in_units.visit_around(box[n], [&](Field::Cell_index c) {
        is_inside = is_inside && c != Field::npos;
        is_known = is_known && (c == Field::npos || is_subdivided[c]);
      });
      const bool meets_shell = !is_inside
                               && is_in_shell_at_end(field, cover.bbox(cover.boxes()[n]), [&](const Point_3& p) {
                                    return std::abs(field.value(p).value() - level) <= half;
                                  });
      failures += !is_known || (is_at_end[n] ? is_inside : meets_shell);
      at_end += is_at_end[n];
      excluded_at_end += !is_inside && !is_at_end[n];
    }
    CHECK(failures == 0);
    CHECK(cover.number_of_undecided_boxes() == number_of_undecided);
    undecided += number_of_undecided;
    // The boxes of a cell fill it, and do not overlap.
    std::map<std::uint32_t, double> filled;
    for(const Cover_box& b : cover.boxes()) filled[b.cell] += std::ldexp(1., -3 * b.depth);
    CHECK(filled.size() == cover.number_of_cells());
    for(const auto& f : filled) CHECK(f.second == 1);
    for(std::size_t n = 0; n + 1 < box.size(); ++n)
      if(cover.boxes()[n].cell == cover.boxes()[n + 1].cell) {
        bool overlap = true;
        for(int a = 0; a < 3; ++a)
          overlap = overlap && box[n].low[a] < box[n + 1].high[a] && box[n + 1].low[a] < box[n].high[a];
        failures += overlap;
      }
    CHECK(failures == 0);
  }
  CHECK(boxes > 5000);
  CHECK(apart > 8);
  CHECK(joined > 10);
  CHECK(at_end > 100);
  CHECK(excluded_at_end > 100);
  CHECK(undecided > 1);
}

TEST_CASE("Cover: between varying thresholds, a box in the shell at the boundary of the domain is reported")
{
  std::size_t beyond_inner = 0, beyond_outer = 0;
  for(unsigned seed = 1; seed < 13; ++seed) {
    CAPTURE(seed);
    CGAL::Random random(seed);
    const Field cells = random_cells(random, 2, 1, 1);
    const auto noise = [&] { return random.get_double(-0.03, 0.03); };
    const Field field = with(cells, [&](double x, double y, double z) { return z + 0.1 * x * y; }),
                inner = with(cells, [&](double x, double, double) { return -0.3 + 0.5 * x + noise(); }),
                outer = with(cells, [&](double, double y, double) { return 0.3 - 0.4 * y + noise(); });
    Varying_cover cover(field, Varying(inner), Varying(outer));
    cover.flood<Tag>(Point_3(0, 0, 0), 0);
    std::vector<char> is_at_end(cover.boxes().size(), 0);
    for(auto b : cover.at_end()) is_at_end[b] = 1;
    std::size_t failures = 0;
    for(std::size_t n = 0; n < cover.boxes().size(); ++n) {
      if(cover.boxes()[n].component == none) continue;
      bool is_below = false, is_above = false; // at some examined point
      const bool is_in_shell = is_in_shell_at_end(field, cover.bbox(cover.boxes()[n]), [&](const Point_3& p) {
        const double f = field.value(p).value();
        is_below = is_below || f < inner.value(p).value();
        is_above = is_above || f > outer.value(p).value();
        return f >= inner.value(p).value() && f <= outer.value(p).value();
      });
      failures += is_in_shell && !is_at_end[n];
      beyond_inner += is_in_shell && is_below;
      beyond_outer += is_in_shell && is_above;
    }
    CHECK(failures == 0);
  }
  CHECK(beyond_inner > 20);
  CHECK(beyond_outer > 20);
}

TEST_CASE("Cover: claims about boxes hold at points in them, between levels and varying thresholds")
{
  std::array<std::size_t, 5> kinds = {};
  std::size_t met = 0, steep = 0, straddling = 0;
  for(unsigned seed = 1; seed < 25; ++seed) {
    CAPTURE(seed);
    CGAL::Random random(seed);
    const Field cells = random_cells(random, 2, 1, seed % 3 == 0 ? 2 : 1);
    const auto noise = [&](double size) { return random.get_double(-size, size); };
    // Thresholds are about as steep as the field, in some cases along diagonals. In some cases, only one of them has
    // this slope.
    const double steepness = random.get_double(0.2, 1.2), bumps = seed % 2 ? 0.3 : 0.03,
                 u = random.get_double(0, 2 * pi);
    const auto slope = [&](double x, double y, double z) {
      return steepness * (seed % 4 < 2 ? (x + y + z) / std::sqrt(3.) : std::cos(u) * x + std::sin(u) * y);
    };
    // In some cases, the field has critical points, below or above the shell.
    const Field field = with(cells,
                             [&](double x, double y, double z) {
                               return (seed < 13 ? z + 0.1 * x * y : (seed % 2 ? 1 : -1) * (z * z + 0.3 * x * x - 0.6))
                                      + noise(0.02);
                             }),
                inner = with(cells,
                             [&](double x, double y, double z) {
                               return -0.3 + (seed % 5 == 1 ? 0 : slope(x, y, z)) + noise(bumps);
                             }),
                outer = with(cells, [&](double x, double y, double z) {
                  return 0.3 + (seed % 5 == 2 ? 0 : slope(x, y, z)) + noise(bumps);
                });
    Varying_cover varying(field, Varying(inner), Varying(outer));
    Cover constant(field, Constant(-0.3), Constant(0.3));
    prepare_all(varying);
    prepare_all(constant);
    const auto check = [&](const auto& cover, const auto& threshold) {
      std::size_t failures = 0;
      for(const Cover_box& box : cover.boxes()) {
        ++kinds[std::size_t(box.kind)];
        if(box.kind == Box_kind::UNDECIDED) continue;
        const CGAL::Bbox_3 b = cover.bbox(box);
        bool all_between = true, rises = true, is_excluded = true, is_beyond = true;
        std::array<std::array<bool, 2>, 2> side = {}; // by threshold
        std::array<bool, 2> crosses = { true, true };
        const std::array<double, 3>& d = box.proof;
        const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        constexpr int parts = 2;
        constexpr double hair = 1e-9;
        for(int n = 0; n < (parts + 1) * (parts + 1) * (parts + 1); ++n) {
          const auto at = [&](int a, int i) { return (b.min)(a) + ((b.max)(a) - (b.min)(a)) * i / parts; };
          const Point_3 p(at(0, n % (parts + 1)), at(1, n / (parts + 1) % (parts + 1)),
                          at(2, n / ((parts + 1) * (parts + 1))));
          const auto jet = field.cell(box.cell).first_order_jet(p);
          const double along = jet.gradient[0] * d[0] + jet.gradient[1] * d[1] + jet.gradient[2] * d[2];
          rises = rises && along > 0;
          if(box.kind == Box_kind::CRITICAL_BELOW || box.kind == Box_kind::CRITICAL_ABOVE) {
            const bool below = box.kind == Box_kind::CRITICAL_BELOW;
            double above = jet.value - threshold(below ? 0 : 1, box.cell, p).value;
            for(int a = 0; a < 3; ++a)
              above -= (p[a] - (b.min)(a)-d[a] * ((b.max)(a) - (b.min)(a))) * jet.gradient[a] / 2;
            is_beyond = is_beyond && (below ? above < 0 : above > 0);
          }
          bool is_between = true;
          for(int t = 0; t < 2; ++t) {
            const auto other = threshold(t, box.cell, p);
            const double above = t == 0 ? jet.value - other.value : other.value - jet.value;
            is_between = is_between && above >= -hair;
            if(above > -hair) side[t][1] = true;
            if(above < hair) side[t][0] = true;
            const auto& g = other.gradient;
            crosses[t] = crosses[t] && along > std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) * length - hair;
          }
          if(box.kind == Box_kind::EXCLUDED) {
            const double above = jet.value - threshold(0, box.cell, p).value,
                         below = threshold(1, box.cell, p).value - jet.value;
            is_excluded = is_excluded && !(above > hair && below > hair);
          }
          all_between = all_between && is_between;
        }
        failures += cover.is_between_thresholds(box) && !all_between;
        failures += !is_excluded;
        failures += !is_beyond;
        if(box.kind != Box_kind::MONOTONE) continue;
        straddling += !all_between && side[0][1] && side[1][1];
        failures += !rises;
        for(int t = 0; t < 2; ++t) {
          const bool meets = side[t][0] && side[t][1];
          met += meets;
          steep += !crosses[t];
          failures += meets && !crosses[t];
        }
      }
      CHECK(failures == 0);
    };
    check(varying, [&](int t, std::uint32_t c, const Point_3& p) {
      return (t == 0 ? inner : outer).cell(c).first_order_jet(p);
    });
    check(constant, [&](int t, std::uint32_t, const Point_3&) {
      BS::Tricubic_cell_3::First_order_jet jet;
      jet.value = t == 0 ? -0.3 : 0.3;
      jet.gradient = { 0, 0, 0 };
      return jet;
    });
  }
  CHECK(kinds[0] > 1000);
  CHECK(kinds[1] > 1000);
  CHECK(kinds[2] > 20);
  CHECK(kinds[3] > 20);
  CHECK(kinds[4] > 1000);
  CHECK(met > 500);
  CHECK(steep > 100);
  CHECK(straddling > 500);
}

TEST_CASE("Cover: boxes classified as monotone are monotone exactly, even if the field is nearly constant")
{
  std::size_t monotone = 0, flat = 0;
  for(unsigned seed = 1; seed < 9; ++seed) {
    CGAL::Random random(seed);
    const double slope = 1e-10 * std::ldexp(1., 2 * int(seed) - 2);
    const Field field = with(random_cells(random, 2, 1, 1), [&](double x, double, double) {
      return 1e6 + slope * (x + random.get_double(-0.15, 0.15));
    });
    Cover cover(field, Constant(0), Constant(2e6));
    prepare_all(cover);
    std::size_t number = 0;
    for(const Cover_box& box : cover.boxes()) {
      flat += box.kind == Box_kind::UNDECIDED;
      if(box.kind != Box_kind::MONOTONE || ++number > 60) continue;
      ++monotone;
      const Exact_box here(field, box);
      bool rises = true;
      for(int n = 0; n < 8; ++n) rises = rises && dot(here.gradient(n), exact(box.proof)) > 0;
      CHECK(rises);
    }
  }
  CHECK(flat > 100);
  CHECK(monotone > 50);
}

TEST_CASE("Cover: a box where the field does not rise is not monotone, even if rounded coefficients rise")
{
  // The coefficients are b + k ulp |x|. By symmetry, the derivative of the spline is zero at x = 0.
  CGAL::Random random(21);
  for(int n = 0; n < 40; ++n) {
    const double b = random.get_double(1, 2), step = 10 * (n + 1) * std::numeric_limits<double>::epsilon();
    const BS::Lattice_3::Point first = { -2, 0, 0 }, last = { 1, 0, 0 };
    const Field field = with(
      Field(Hierarchy(some_cells(random, BS::Lattice_3::from_origin({ 0, 0, 0 }, 1, first, last), first, last))),
      [&](double x, double, double) { return b + step * std::abs(x); });
    Cover cover(field, Constant(0), Constant(3));
    cover.prepare<Tag>({ 0, 1, 2, 3 });
    std::size_t failures = 0, boxes = 0;
    for(const Cover_box& box : cover.boxes()) {
      if(cover.bbox(box).xmin() > 0 || cover.bbox(box).xmax() < 0) continue;
      ++boxes;
      failures += box.kind != Box_kind::UNDECIDED;
    }
    CHECK(failures == 0);
    CHECK(boxes > 2);
  }
}

namespace {

// Returns a field on 64 cells of width one around the cube [0, 1]^3.
Field cells_around_unit_cube()
{
  CGAL::Random random(35);
  const BS::Lattice_3::Point first = { -1, -1, -1 }, last = { 2, 2, 2 };
  return Field(Hierarchy(some_cells(random, BS::Lattice_3::from_origin({ 0, 0, 0 }, 1, first, last), first, last)));
}

// Returns sign |x - m|^2, where m is the middle of the unit cube.
Field squared_distance_field(double sign)
{
  Field field = cells_around_unit_cube();
  Polynomial polynomial;
  for(int a = 0; a < 3; ++a)
    for(int power = 0; power < 3; ++power) {
      Monomial m = { sign * (power == 0 ? 0.25 : power == 1 ? -1. : 1.), { 0, 0, 0 } };
      m.power[a] = power;
      polynomial.push_back(m);
    }
  set_polynomial(field, polynomial);
  return field;
}

const std::array<double, 3> middle = { 0.5, 0.5, 0.5 };

} // namespace

TEST_CASE("Cover: a box with a critical point beyond a threshold is not subdivided, and gradient bounds are close")
{
  for(double sign : { 1., -1. }) {
    CAPTURE(sign);
    const Field field = squared_distance_field(sign);
    Cover cover(field, Constant(sign > 0 ? 0.02 : -0.05), Constant(sign > 0 ? 0.05 : -0.02), 0);
    REQUIRE(cover.flood<Tag>(Point_3(0.68, 0.5, 0.5), 0) == 0);
    CHECK(cover.number_of_undecided_boxes() == 0);
    CHECK(cover.at_end().empty());
    std::size_t boxes = 0;
    for(const Cover_box& box : cover.boxes()) {
      if(box.component == none) continue;
      ++boxes;
      CHECK(box.depth == 0);
      CHECK(box.kind == (sign > 0 ? Box_kind::CRITICAL_BELOW : Box_kind::CRITICAL_ABOVE));
      for(int a = 0; a < 3; ++a) CHECK(box.proof[a] == Approx(middle[a]));
      CHECK(BS::critical_values(cover.function(box)).min == Approx(0).margin(1e-10));
      CHECK(BS::critical_values(cover.function(box)).max == Approx(0).margin(1e-10));
    }
    CHECK(boxes == 1);
    // In the shell, the gradient is least on the sphere of radius sqrt(0.02).
    const double truth = 2 * std::sqrt(0.02), bound = cover.least_gradient<Tag>();
    CHECK(bound <= truth);
    CHECK(bound > 0.5 * truth);
    const std::uint32_t cell = field.cells().locate(Point_3(0.5, 0.5, 0.5));
    const double in_cell = cover.least_gradients<Tag>()[cell];
    CHECK(in_cell <= truth);
    CHECK(in_cell > 0.2 * truth);
  }
}

TEST_CASE("Cover: a box with a critical point in the shell is undecided, however close the threshold is")
{
  for(double sign : { 1., -1. })
    for(double beyond : { 1e-3, 1e-9, -1e-9, -1e-3 }) {
      CAPTURE(sign, beyond);
      const Field field = squared_distance_field(sign);
      Cover cover(field, Constant(sign > 0 ? beyond : -0.05), Constant(sign > 0 ? 0.05 : -beyond));
      cover.prepare<Tag>({ std::uint32_t(field.cells().locate(Point_3(0.5, 0.5, 0.5))) });
      bool is_undecided = false;
      for(const Cover_box& box : cover.boxes())
        is_undecided = is_undecided
                       || (box.kind == Box_kind::UNDECIDED
                           && do_overlap(cover.bbox(box), Point_3(0.5, 0.5, 0.5).bbox()));
      CHECK(is_undecided == (beyond < 0));
    }
}

TEST_CASE("Cover: boxes with a critical point beyond a threshold are decided if and only if the field is steeper")
{
  // The inner threshold is 0.02 + s (x - 1/2). Where the field equals it, the slope of the field is 2 |x - m|: at least
  // 0.28 for x > 1/2, and less for x < 1/2.
  const Field field = squared_distance_field(1);
  const std::uint32_t cell = field.cells().locate(Point_3(0.5, 0.5, 0.5));
  for(double s : { 0., 0.01, 0.1, 0.3, 1. }) {
    CAPTURE(s);
    Field inner = cells_around_unit_cube(), outer = inner;
    set_polynomial(inner, { { 0.02 - s / 2, { 0, 0, 0 } }, { s, { 1, 0, 0 } } });
    set_polynomial(outer, { { 10, { 0, 0, 0 } } });
    Varying_cover cover(field, Varying(inner), Varying(outer), 0);
    cover.prepare<Tag>({ cell });
    std::size_t critical = 0, undecided = 0;
    for(const Cover_box& box : cover.boxes()) {
      critical += box.kind == Box_kind::CRITICAL_BELOW;
      undecided += box.kind == Box_kind::UNDECIDED;
    }
    // |x - m|^2 = 0.02 + s (x - 1/2) is a sphere, where |x - m|^2 is at least `least`. If s >= 2 sqrt(least), then the
    // threshold is as steep as the field at a point of the sphere.
    const double radius = std::sqrt(0.02 + s * s / 4), least = 0.02 + s * (s / 2 - radius);
    CHECK((undecided > 0) == (s >= 2 * std::sqrt(least)));
    if(s < 0.1) CHECK(critical > 0);
    if(s == 0) CHECK(cover.boxes().size() == 1);
  }
}

TEST_CASE("Cover: a wall thinner than a cell takes few boxes, in any direction")
{
  // (n . (x - m))^2 - t^2; the thresholds are close to zero compared with the wall
  CGAL::Random random(37);
  for(int k = 0; k < 20; ++k) {
    std::array<double, 3> n = { random.get_double(-1, 1), random.get_double(-1, 1), random.get_double(0.2, 1) };
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), t = 0.05;
    for(double& x : n) x /= length;
    const double offset = (n[0] + n[1] + n[2]) / 2;
    Polynomial polynomial = { { offset * offset - t * t, { 0, 0, 0 } } };
    for(int a = 0; a < 3; ++a) {
      Monomial linear = { -2 * offset * n[a], { 0, 0, 0 } };
      linear.power[a] = 1;
      polynomial.push_back(linear);
      for(int b = 0; b < 3; ++b) {
        Monomial m = { n[a] * n[b], { 0, 0, 0 } };
        ++m.power[a];
        ++m.power[b];
        polynomial.push_back(m);
      }
    }
    Field field = cells_around_unit_cube();
    set_polynomial(field, polynomial);
    Cover cover(field, Constant(-t * t / 2), Constant(t * t / 2), 0);
    cover.prepare<Tag>({ std::uint32_t(field.cells().locate(Point_3(0.5, 0.5, 0.5))) });
    for(const Cover_box& box : cover.boxes()) CHECK(box.kind != Box_kind::UNDECIDED);
    CHECK(cover.boxes().size() <= 64);
  }
}

TEST_CASE("Cover: a box where a threshold is steeper than the field is not monotone, even if squares underflow")
{
  // f = s x and eps2 = 0.93 s (x + y + z). The threshold's gradient is 1.6 times as long as the field's, but for the
  // small s, the squares of its components underflow.
  CGAL::Random random(29);
  const Field cells = random_cells(random, 4, 1, 1);
  for(double s : { 1., 1.62e-162 }) {
    const Field field = with(cells, [&](double x, double, double) { return s * x; });
    const Varying inner(with(cells, [&](double, double, double) { return -10 * s; })),
      outer(with(cells, [&](double x, double y, double z) { return 0.93 * s * (x + y + z); }));
    Varying_cover cover(field, inner, outer);
    prepare_all(cover);
    std::size_t steep = 0, failures = 0;
    for(const Cover_box& box : cover.boxes()) {
      const CGAL::Bbox_3 b = cover.bbox(box);
      // bounds on x - eps2 / s on the box
      const double least = 0.07 * b.xmin() - 0.93 * (b.ymax() + b.zmax()),
                   greatest = 0.07 * b.xmax() - 0.93 * (b.ymin() + b.zmin());
      if(!(least < -1e-6 && greatest > 1e-6)) continue;
      ++steep;
      failures += box.kind != Box_kind::UNDECIDED;
    }
    CHECK(failures == 0);
    CHECK(steep > 100);
  }
}

TEST_CASE("Cover: a box where a threshold is not finite is undecided")
{
  CGAL::Random random(23);
  const Field cells = random_cells(random, 4, 1, 1);
  const Field field = with(cells, [](double, double, double z) { return z; });
  for(double bad : { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
    for(bool is_inner : { true, false }) {
      const auto level = [&](bool has_bad, double value) {
        return with(cells,
                    [=](double x, double y, double z) { return has_bad && x == 1 && y == 1 && z == 1 ? bad : value; });
      };
      const Varying inner(level(is_inner, -3)), outer(level(!is_inner, 3));
      Varying_cover cover(field, inner, outer);
      prepare_all(cover);
      std::size_t undecided = 0, other = 0, failures = 0;
      for(const Cover_box& box : cover.boxes()) {
        const bool is_known = std::isfinite((is_inner ? inner : outer).field().cell(box.cell).error_radius());
        failures += (box.kind == Box_kind::UNDECIDED) == is_known;
        ++(is_known ? other : undecided);
      }
      CHECK(failures == 0);
      CHECK(undecided > 0);
      CHECK(other > 0);
    }
}

TEST_CASE("Cover: components of another cover are adopted, in any order, or only some of them")
{
  // Level sets are nearly planes: there are three components, each of many cells.
  CGAL::Random random(25);
  const Field field = with(random_cells(random, 6, 1, 2),
                           [](double x, double y, double z) { return std::sin(1.5 * (x - 0.3)) + 0.005 * y * z; });
  const auto make = [&] { return Cover(field, Constant(-0.07), Constant(0.07)); };
  Cover cover = make();
  std::vector<Point_3> seeds;
  for(int n = -40; n <= 40; ++n) {
    const Point_3 p(n / 14., 0.1, 0.2);
    if(std::abs(*field.value(p)) < 0.04 && cover.component(p) == none) {
      REQUIRE(cover.flood<Tag>(p, std::uint32_t(seeds.size())) == seeds.size());
      seeds.push_back(p);
    }
  }
  REQUIRE(seeds.size() >= 3);
  // points of the shell, and other points
  std::vector<Point_3> points = seeds;
  for(int n = 0; n < 500; ++n)
    points.emplace_back(random.get_double(-3, 3), random.get_double(-3, 3), random.get_double(-3, 3));
  // corners of boxes and cells, which adjacent boxes touch
  for(int n = 0; n < 500; ++n) {
    const Cover_box& box = cover.boxes()[std::size_t(random.get_int(0, int(cover.boxes().size())))];
    const CGAL::Bbox_3 b = n % 4 < 2
                             ? cover.bbox(box)
                             : field.cell(Field::Cell_index(random.get_int(0, int(field.number_of_cells())))).bbox();
    points.push_back(n % 2 ? Point_3(b.xmin(), b.ymin(), b.zmin()) : Point_3(b.xmax(), b.ymax(), b.zmax()));
  }
  const auto component = [&](const Point_3& p) {
    for(const Cover_box& box : cover.boxes())
      if(box.component != none && do_overlap(cover.bbox(box), p.bbox())) return box.component;
    return none;
  };
  Cover all = make();
  all.adopt(cover.boxes());
  std::size_t known = 0;
  for(const Point_3& p : points) {
    CHECK(all.component(p) == component(p));
    known += component(p) != none;
  }
  CHECK(known > 100);
  const Point_3 nowhere((seeds[0].x() + seeds[1].x()) / 2, 0.1, 0.2);
  REQUIRE(component(nowhere) == none);
  const auto adopts = [&](const std::vector<Point_3>& points) { return make().adopt(cover.boxes(), points); };
  typedef std::vector<Cover::Shared> Shared;
  CHECK(adopts({ seeds[2], seeds[0], seeds[1] }) == Shared());
  CHECK(adopts({ seeds[2], seeds[0], seeds[2] }) == Shared{ { 0, 2 } });
  CHECK(adopts({ seeds[1], Point_3(seeds[1].x(), seeds[1].y() + 0.01, seeds[1].z()), seeds[0], seeds[1] })
        == Shared{ { 0, 1 }, { 0, 3 } });
  CHECK_FALSE(adopts({ nowhere }));
  CHECK_FALSE(adopts({ seeds[0], nowhere }));
  CHECK_FALSE(adopts({ seeds[0], Point_3(9, 0, 0) }));
  for(const std::vector<std::size_t>& order :
      { std::vector<std::size_t>{ 2, 0, 1 }, std::vector<std::size_t>{ 1 }, std::vector<std::size_t>{ 2, 2, 0 } }) {
    std::vector<Point_3> chosen;
    for(std::size_t n : order) chosen.push_back(seeds[n]);
    Cover some = make();
    REQUIRE(some.adopt(cover.boxes(), chosen));
    for(const Point_3& p : points) {
      const auto place = std::find(order.begin(), order.end(), component(p));
      CHECK(some.component(p) == (place == order.end() ? none : std::uint32_t(place - order.begin())));
    }
  }
}

TEST_CASE("Cover: results of another cover are reused where nothing has changed, and only there")
{
  CGAL::Random random(27);
  const Field field = with(random_cells(random, 4, 1, 2), [](double x, double y, double z) { return z + 0.1 * x * y; });
  Field other = field;
  Eigen::VectorXd x = field.coefficients();
  x[x.size() / 2] += 2;
  other.set_coefficients(x);
  const auto changed = [&](std::uint32_t c) {
    return !std::equal(field.cell(c).coefficients(), field.cell(c).coefficients() + 64, other.cell(c).coefficients());
  };
  Cover before(field, Constant(-0.5), Constant(0.5)), after(other, Constant(-0.5), Constant(0.5)), reference = after;
  prepare_all(before);
  REQUIRE(before.flood<Tag>(Point_3(0, 0, 0), 0) == 0);
  after.reuse(before, [&](std::uint32_t c) { return changed(c) ? Field::npos : c; });
  const std::size_t reused = after.number_of_cells();
  CHECK(reused > 10);
  CHECK(reused < field.number_of_cells());
  for(const Cover_box& box : after.boxes()) CHECK(box.component == none);
  prepare_all(after);
  prepare_all(reference);
  const auto by_cell = [](const Cover& cover) {
    std::map<std::uint32_t, std::vector<Cover_box> > boxes;
    for(const Cover_box& box : cover.boxes()) boxes[box.cell].push_back(box);
    return boxes;
  };
  CHECK(by_cell(before).size() == field.number_of_cells());
  const auto is_same = [](const Cover_box& a, const Cover_box& b) {
    return a.depth == b.depth && a.kind == b.kind
           && std::equal(std::begin(a.position), std::end(a.position), std::begin(b.position));
  };
  const auto found = by_cell(after), expected = by_cell(reference);
  CHECK(found.size() == expected.size());
  for(const auto& cell : expected)
    CHECK(std::equal(cell.second.begin(), cell.second.end(), found.at(cell.first).begin(), found.at(cell.first).end(),
                     is_same));
}

TEST_CASE("Cover: gradient bounds are close to the least gradient, wherever in a box the gradient is shortest")
{
  // d x + x^3/3 + x y^2 + x z^2, mirrored. The gradient is shortest at one corner of the domain, and much longer
  // nearby; for the smaller d, even within the box of the cover there.
  for(double shortest : { 0.05, 0.001 })
    for(int corner = 0; corner < 8; ++corner) {
      CAPTURE(corner, shortest);
      const auto sign = [&](int a) { return corner >> a & 1 ? -1. : 1.; };
      BS::Lattice_3::Point first, last;
      for(int a = 0; a < 3; ++a) {
        first[a] = sign(a) > 0 ? 0 : -2;
        last[a] = first[a] + 1;
      }
      CGAL::Random random(29);
      Field field(Hierarchy(some_cells(random, BS::Lattice_3::from_origin({ 0, 0, 0 }, 1, first, last), first, last)));
      set_polynomial(field,
                     { { shortest, { 1, 0, 0 } }, { 1. / 3, { 3, 0, 0 } }, { 1, { 1, 2, 0 } }, { 1, { 1, 0, 2 } } });
      Cover cover(field, Constant(-100), Constant(100));
      REQUIRE(cover.flood<Tag>(Point_3(sign(0), sign(1), sign(2)), 0) == 0);
      REQUIRE(cover.number_of_undecided_boxes() == 0);
      const double bound = cover.least_gradient<Tag>();
      CHECK(bound <= shortest * (1 + 1e-12));
      CHECK(bound > 0.4 * shortest);
      const std::vector<double> bounds = cover.least_gradients<Tag>();
      for(Field::Cell_index c = 0; c < field.number_of_cells(); ++c) {
        double least = std::numeric_limits<double>::infinity();
        const CGAL::Bbox_3 b = field.cell(c).bbox();
        for(int n = 0; n < 8; ++n) {
          const auto jet = field.cell(c).first_order_jet(
            Point_3(n & 1 ? b.xmax() : b.xmin(), n & 2 ? b.ymax() : b.ymin(), n & 4 ? b.zmax() : b.zmin()));
          least = (std::min)(least, std::sqrt(jet.gradient[0] * jet.gradient[0] + jet.gradient[1] * jet.gradient[1]
                                              + jet.gradient[2] * jet.gradient[2]));
        }
        CHECK(bounds[c] <= least * (1 + 1e-12));
        CHECK(bounds[c] > 0.3 * least);
      }
    }
}

TEST_CASE("Cover: the bound on a gradient beyond the largest double is finite")
{
  // f = 1e300 x / w on cells of width w = 2^-100; the slope is 1.3e330
  const double width = std::ldexp(1., -100);
  const BS::Lattice_3::Point first = { 0, 0, 0 }, last = { 3, 3, 3 };
  CGAL::Random random(31);
  const Field field = with(
    Field(Hierarchy(some_cells(random, BS::Lattice_3::from_origin({ 0, 0, 0 }, width, first, last), first, last))),
    [&](double x, double, double) { return 1e300 * (x / width); });
  Cover cover(field, Constant(1.1e300), Constant(2.9e300));
  cover.flood<Tag>(Point_3(2 * width, 2 * width, 2 * width), 0);
  CHECK(cover.number_of_undecided_boxes() == 0);
  CHECK(cover.least_gradient<Tag>() > 1e308);
  CHECK(cover.least_gradient<Tag>() <= std::numeric_limits<double>::max());
}

namespace {

// A field with exact Bernstein coefficients.
struct Exact_field : Field
{
  explicit Exact_field(const Field& field) : Field(field) {}
  Cell cell(Cell_index c) const
  {
    const Cell rounded = Field::cell(c);
    return Cell(rounded.corner(), rounded.width(), rounded.coefficients(), 0);
  }
};

} // namespace

TEST_CASE("Cover: for an exactly known field, gradient bounds do not exceed the gradient even by rounding")
{
  CGAL::Random random(33);
  const Field cells = random_cells(random, 3, 1, 1);
  for(const std::array<int, 3>& g : { std::array<int, 3>{ 0, -1, 0 }, { 1, 0, 1 }, { 3, -5, 7 } }) {
    CAPTURE(g[0], g[1], g[2]);
    const Exact_field field(
      with(cells, [&](double x, double y, double z) { return 6 * (g[0] * x + g[1] * y + g[2] * z); }));
    BS::Shell_cover_3<Exact_field> cover(field, Constant(-1000), Constant(1000));
    cover.flood<Tag>(Point_3(0.5, 0.5, 0.5), 0);
    REQUIRE(cover.number_of_undecided_boxes() == 0);
    const Rational squared = 36 * (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    for(double bound : cover.least_gradients<Tag>()) {
      CHECK(Rational(bound) * Rational(bound) <= squared);
      CHECK(bound * bound > 0.999 * CGAL::to_double(squared));
    }
  }
}

TEST_CASE("Cover: results of cells are reused under their new indices if other cells are split")
{
  CGAL::Random random(28);
  const Field field = with(random_cells(random, 4, 1, 2), [](double x, double y, double z) { return z + 0.1 * x * y; });
  const Field finer_cells(field.cells().refined({ field.cells().locate(Point_3(0.1, 0.1, 0.1)) }));
  const Field other = finer_cells.with_coefficients(BS::refined_coefficients(field, field.coefficients(), finer_cells));
  Cover before(field, Constant(-0.5), Constant(0.5)), after(other, Constant(-0.5), Constant(0.5)), reference = after;
  prepare_all(before);
  const auto now = [&](std::uint32_t c) {
    const Field::Cell_index n = other.cells().leaf(field.cells().level(c), field.cells().lattice_point(c));
    return n != Field::npos
               && std::equal(field.cell(c).coefficients(), field.cell(c).coefficients() + 64,
                             other.cell(n).coefficients())
             ? n
             : Field::npos;
  };
  after.reuse(before, now);
  const std::size_t reused = after.number_of_cells();
  CHECK(reused > 10);
  CHECK(reused < other.number_of_cells());
  std::size_t renumbered = 0;
  for(Field::Cell_index c = 0; c < field.number_of_cells(); ++c) renumbered += now(c) != Field::npos && now(c) != c;
  CHECK(renumbered > 0);
  prepare_all(after);
  prepare_all(reference);
  CHECK(after.number_of_cells() == other.number_of_cells());
  REQUIRE(after.boxes().size() == reference.boxes().size());
  std::map<std::uint32_t, std::vector<Cover_box> > found, expected;
  for(const Cover_box& box : after.boxes()) found[box.cell].push_back(box);
  for(const Cover_box& box : reference.boxes()) expected[box.cell].push_back(box);
  for(const auto& of_cell : expected) {
    REQUIRE(found[of_cell.first].size() == of_cell.second.size());
    for(std::size_t n = 0; n < of_cell.second.size(); ++n) {
      CHECK(found[of_cell.first][n].kind == of_cell.second[n].kind);
      CHECK(std::equal(std::begin(of_cell.second[n].position), std::end(of_cell.second[n].position),
                       std::begin(found[of_cell.first][n].position)));
    }
  }
}

TEST_CASE("Cover: scaling the field by a power of two preserves boxes and proofs, and scales gradient bounds")
{
  CGAL::Random random(41);
  const Field field = with(random_cells(random, 4, 1, 2), [&](double x, double y, double z) {
    return std::sqrt((x - 0.1) * (x - 0.1) + y * y + z * z) + random.get_double(-0.05, 0.05);
  });
  const auto make = [](const Field& f, double scale) {
    const Point_3 p(1.1, 0, 0);
    const double level = f.value(p).value();
    Cover cover(f, Constant(level - 0.125 * scale), Constant(level + 0.125 * scale));
    cover.flood<Tag>(p, 0);
    return cover;
  };
  const Cover reference = make(field, 1);
  REQUIRE(std::count_if(reference.boxes().begin(), reference.boxes().end(),
                        [](const Cover_box& b) { return b.component == 0; })
          > 20);
  for(int exponent : { -900, -535, 524, 1000 }) {
    CAPTURE(exponent);
    Field scaled = field;
    scaled.set_coefficients(Eigen::VectorXd(std::ldexp(1., exponent) * field.coefficients()));
    const Cover cover = make(scaled, std::ldexp(1., exponent));
    REQUIRE(cover.boxes().size() == reference.boxes().size());
    bool is_same = true;
    for(std::size_t n = 0; n < cover.boxes().size(); ++n) {
      const Cover_box &a = cover.boxes()[n], &b = reference.boxes()[n];
      is_same = is_same && a.cell == b.cell && a.depth == b.depth && a.kind == b.kind && a.component == b.component
                && a.proof == b.proof;
    }
    CHECK(is_same);
    CHECK(cover.least_gradient<Tag>() == std::ldexp(reference.least_gradient<Tag>(), exponent));
  }
}
} // namespace test_Shell_cover_3
