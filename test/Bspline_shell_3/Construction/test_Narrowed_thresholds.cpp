// Narrowed_thresholds.h: thresholds are as wide as requested where the shell is proved to be free of critical points,
// and narrower at other places. Data that is kept from field to field does not change the result.
#include <CGAL/Bspline_shell_3/Construction/Narrowed_thresholds.h>
#include "coefficient_functions.h"
#include "input_of_mesh.h"

#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/refined_coefficients.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace test_Narrowed_thresholds {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Sequential_tag Tag;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef BS::Narrowed_thresholds<Field> Thresholds;
typedef BS::Threshold_obstacle Obstacle;
typedef Field::Cell_index Index;

// A function close to the distance from the unit sphere, on cells of width 1/2 and smaller. Its only critical point is
// near the center.
struct Ball
{
  BS::Input_mesh_3 input = input_of(sphere(3));
  Field field;
  BS::Clipped_mesh_3 clipped;
  std::vector<BS::Level_range> ranges;

  explicit Ball(double level = 1, double scale = 1)
  {
    const Hierarchy cells(all_cells(0.5, { -5, -5, -5 }, { 4, 4, 4 }));
    set_field(cells.refined({ cells.locate(Point_3(0, 0.6, 0.8)) }), level, scale);
  }

  void set_field(const Hierarchy& cells, double level, double scale)
  {
    field = Field(cells);
    set_coefficients(field, [&](const Point_3& p, double) { return scale * (distance(p, CGAL::ORIGIN) - level); });
    update_ranges();
  }

  void update_ranges()
  {
    clipped = BS::clip_mesh_to_cells<Tag>(input, field.cells());
    ranges = BS::facet_ranges<Tag>(field, clipped).cell;
  }

  template <typename ConcurrencyTag = Tag>
  std::vector<Obstacle> choose(Thresholds& thresholds, const BS::Narrowing_limits& limits = {}) const
  {
    return thresholds.choose<ConcurrencyTag>(
      [&](BS::Mesh_ranges::Precision) -> const std::vector<BS::Level_range>& { return ranges; }, limits);
  }
};

std::vector<Field::Point_3> seed()
{
  return { Field::Point_3(1, 0, 0) };
}

// Requested thicknesses. With `thick`, the center and the boundary of the domain are between thresholds of this width.
double thin(const Point_3&)
{
  return 0.4;
}
constexpr double half = 1.7;
double thick(const Point_3&)
{
  return 2 * half;
}

Eigen::VectorXd inner(const Thresholds& t)
{
  return t.inner().field().coefficients();
}
Eigen::VectorXd outer(const Thresholds& t)
{
  return t.outer().field().coefficients();
}

bool are_equal(const std::vector<Obstacle>& a, const std::vector<Obstacle>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Obstacle& o, const Obstacle& p) {
    return o.cell == p.cell && o.point == p.point && o.side == p.side && o.size == p.size;
  });
}

} // namespace

TEST_CASE("Narrowed thresholds: thresholds have the requested width if the shell has no critical point")
{
  const Ball ball;
  Thresholds thresholds(seed());
  CHECK_FALSE(thresholds.are_chosen());
  CHECK(std::isinf(thresholds.undecided_volume()));
  thresholds.begin(ball.field, thin);
  CHECK(ball.choose(thresholds).empty());
  REQUIRE(thresholds.are_chosen());
  CHECK(thresholds.undecided_volume() == 0);
  CHECK(inner(thresholds).minCoeff() == -0.2);
  CHECK(inner(thresholds).maxCoeff() == -0.2);
  CHECK(outer(thresholds).minCoeff() == 0.2);
  CHECK(outer(thresholds).maxCoeff() == 0.2);
  thresholds.reset();
  CHECK_FALSE(thresholds.are_chosen());
}

TEST_CASE("Narrowed thresholds: a critical point or the boundary of the domain narrows only the threshold next to it")
{
  const Ball ball;
  Thresholds thresholds(seed());
  thresholds.begin(ball.field, thick);
  CHECK(ball.choose(thresholds).empty());
  CHECK(thresholds.undecided_volume() == 0);
  const double at_center = ball.field.value(Point_3(0, 0, 0)).value();
  const double at_end = ball.field.value(Point_3(2.499, 0, 0)).value();
  REQUIRE(at_center > -half); // otherwise there would be nothing to narrow
  REQUIRE(at_end < half);
  CHECK(thresholds.inner().value(Point_3(0, 0, 0)) > at_center);
  CHECK(thresholds.outer().value(Point_3(2.499, 0, 0)) < at_end);
  for(Index c = 0; c < ball.field.number_of_cells(); ++c) {
    if(!(ball.ranges[c].min <= ball.ranges[c].max)) continue;
    CHECK(thresholds.inner().range(c).min <= ball.ranges[c].min);
    CHECK(thresholds.outer().range(c).max >= ball.ranges[c].max);
  }
  // Only the threshold next to the place is narrowed.
  const double less = 1.2;
  REQUIRE(at_center > -less);
  REQUIRE(at_end > less);
  Thresholds only_inside(seed());
  only_inside.begin(ball.field, [&](const Point_3&) { return 2 * less; });
  CHECK(ball.choose(only_inside).empty());
  CHECK(only_inside.inner().value(Point_3(0, 0, 0)) > at_center);
  CHECK(outer(only_inside).minCoeff() == less);
  // One pass finds the place, but does not narrow the threshold.
  Thresholds once(seed());
  once.begin(ball.field, thick);
  BS::Narrowing_limits limits;
  limits.max_passes = 1;
  ball.choose(once, limits);
  CHECK(once.undecided_volume() > 0);
  CHECK(once.inner().value(Point_3(0, 0, 0)) == Approx(-half));
}

TEST_CASE("Narrowed thresholds: the boundary of the domain counts as undecided while the shell reaches it")
{
  const Ball large(1.9);
  constexpr double width = 1.6;
  REQUIRE(large.field.value(Point_3(0, 0, 0)).value() < -width / 2 - 0.3); // outside the shell
  REQUIRE(large.field.value(Point_3(2.499, 0, 0)).value() < width / 2);    // in the shell
  Thresholds thresholds(seed());
  BS::Narrowing_limits limits;
  limits.max_passes = 1;
  thresholds.begin(large.field, [](const Point_3&) { return width; });
  large.choose(thresholds, limits);
  CHECK(thresholds.undecided_volume() > 0);
  thresholds.begin(large.field, [](const Point_3&) { return width; });
  CHECK(large.choose(thresholds).empty());
  CHECK(thresholds.undecided_volume() == 0);
}

TEST_CASE("Narrowed thresholds: a mesh close to a critical point makes its cell an obstacle")
{
  // the field is zero everywhere
  const Ball flat(1, 0);
  Thresholds thresholds(seed());
  thresholds.begin(flat.field, thin);
  const std::vector<Obstacle> obstacles = flat.choose(thresholds);
  const std::vector<Index> cells = BS::cells_of(obstacles);
  CHECK(thresholds.undecided_volume() > 0);
  CHECK(cells.size() > 100);
  CHECK(std::adjacent_find(cells.begin(), cells.end(), [](Index a, Index b) { return !(a < b); }) == cells.end());
  std::size_t wrong = 0;
  for(const Obstacle& o : obstacles) wrong += flat.field.locate(Point_3(o.point[0], o.point[1], o.point[2])) != o.cell;
  CHECK(wrong == 0);

  // The mesh needs the full requested width everywhere, so nothing can be narrowed.
  const Ball ball;
  Thresholds needing(seed());
  needing.begin(ball.field, thick);
  const std::vector<BS::Level_range> everywhere(ball.field.number_of_cells(), BS::Level_range{ -half, half });
  const std::vector<Obstacle> left = needing.choose<Tag>(
    [&](BS::Mesh_ranges::Precision) -> const std::vector<BS::Level_range>& { return everywhere; },
    BS::Narrowing_limits());
  REQUIRE_FALSE(left.empty());
  const auto are_near = [&](const std::array<double, 3>& p) {
    constexpr double near = 0.2;
    return std::any_of(left.begin(), left.end(), [&](const Obstacle& o) {
      return std::abs(o.point[0] - p[0]) < near && std::abs(o.point[1] - p[1]) < near
             && std::abs(o.point[2] - p[2]) < near;
    });
  };
  CHECK(are_near({ 0, 0, 0 }));   // the critical point
  CHECK(are_near({ 2.5, 0, 0 })); // the boundary of the domain
  CHECK_FALSE(are_near({ 1, 0, 0 }));
  // Constant thresholds are not narrowed either.
  needing.forget();
  needing.begin(ball.field, thick);
  needing.set_constant({ -half, 0.2 });
  CHECK_FALSE(ball.choose(needing).empty());
  CHECK(inner(needing).maxCoeff() == -half);
  CHECK(outer(needing).minCoeff() == 0.2);
}

// ((r - R)^2 - (g / 2)^2) / h on cells of width h. The field is zero on both sides of the wall of a hollow ball, and
// critical in the middle of the wall.
struct Hollow_ball
{
  static constexpr double width = 0.25, radius = 2, small = 0.006;
  double depth;
  Field field;
  std::vector<BS::Level_range> ranges; // on the mesh, as at the rims of walls

  explicit Hollow_ball(double wall) : depth(wall * wall / (4 * width))
  {
    field = Field(Hierarchy(all_cells(width, { -14, -14, -14 }, { 13, 13, 13 })));
    // The squared distance is the spline whose coefficients are smaller by a third of the squared width.
    set_coefficients(field, [&](const Point_3& p, double) {
      return (std::pow(distance(p, CGAL::ORIGIN) - radius, 2) - width * width / 3) / width - depth;
    });
    ranges.assign(field.number_of_cells(), BS::Level_range());
    for(Index c = 0; c < ranges.size(); ++c)
      if(is_at_wall(c)) ranges[c] = { -small, small };
  }

  bool is_at_wall(Index c) const
  {
    const CGAL::Bbox_3 b = field.cell(c).bbox();
    const Point_3 p((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2);
    return std::abs(distance(p, CGAL::ORIGIN) - radius) < width;
  }

  std::vector<Obstacle> choose(Thresholds& thresholds) const
  {
    thresholds.begin(field, [](const Point_3&) { return 0.3; });
    BS::Narrowing_limits limits;
    limits.many_obstacles = 100;
    return thresholds.choose<CGAL::Parallel_if_available_tag>(
      [&](BS::Mesh_ranges::Precision) -> const std::vector<BS::Level_range>& { return ranges; }, limits);
  }

  std::vector<Field::Point_3> seeds() const
  {
    return { Field::Point_3(radius - std::sqrt(depth * width), 0, 0),
             Field::Point_3(radius + std::sqrt(depth * width), 0, 0) };
  }
};

TEST_CASE(
  "Narrowed thresholds: most of a wall thinner than a cell is excluded, at levels based on the field in its middle")
{
  const Hollow_ball ball(0.6 * Hollow_ball::width);
  REQUIRE(ball.depth == Approx(0.0225));
  std::size_t at_wall = 0;
  for(Index c = 0; c < ball.field.number_of_cells(); ++c) at_wall += ball.is_at_wall(c);
  REQUIRE(at_wall > 1000);
  Thresholds thresholds(ball.seeds());
  CHECK(ball.choose(thresholds).empty());
  CHECK(thresholds.narrow_places().empty());
  for(double x : { -1., 1. })
    for(double y : { -1., 1. }) {
      const Point_3 middle(x * 1.2, y * 0.96, 1.28);
      REQUIRE(ball.field.value(middle).value() == Approx(-ball.depth).epsilon(0.1));
      CHECK(thresholds.inner().value(middle) < -Hollow_ball::small);
      CHECK(thresholds.inner().value(middle) > -0.8 * ball.depth);
    }
}

TEST_CASE("Narrowed thresholds: places are tight if the mesh takes most of the room, and obstacles if it takes all")
{
  Hollow_ball ball(0.6 * Hollow_ball::width);
  const auto ask_for = [&](double size) {
    for(Index c = 0; c < ball.ranges.size(); ++c)
      if(ball.is_at_wall(c) && ball.field.cell(c).bbox().xmin() > 1) ball.ranges[c].min = -size;
  };
  const auto are_there = [&](const std::vector<Obstacle>& places) {
    return places.size() > 50 && std::all_of(places.begin(), places.end(), [&](const Obstacle& o) {
             return o.point[0] > 0.2 && o.side == CGAL::NEGATIVE && o.size > 0.6 * ball.depth
                    && o.size < 1.2 * ball.depth;
           });
  };
  ask_for(0.8 * ball.depth);
  Thresholds tight(ball.seeds());
  ball.choose(tight);
  CHECK(are_there(tight.narrow_places()));
  ask_for(1.2 * ball.depth);
  Thresholds none(ball.seeds());
  CHECK(are_there(ball.choose(none)));
}

TEST_CASE("Narrowed thresholds: a wall far thinner than its cells is excluded, too")
{
  for(double wall : { 0.3, 0.2, 0.1 }) {
    CAPTURE(wall);
    Hollow_ball ball(wall * Hollow_ball::width);
    for(BS::Level_range& r : ball.ranges)
      if(r.min < r.max) r = { -ball.depth / 2, ball.depth / 2 };
    Thresholds thresholds(ball.seeds());
    CHECK(ball.choose(thresholds).empty());
    CHECK(thresholds.undecided_volume() == 0);
    const Point_3 middle(1.2, 0.96, 1.28);
    CHECK(thresholds.inner().value(middle) < -ball.depth / 2);
    CHECK(thresholds.inner().value(middle) > ball.field.value(middle).value());
  }
}

TEST_CASE("Narrowed thresholds: caps are kept for the next field, and are wider on finer cells")
{
  const Ball ball;
  Thresholds thresholds(seed());
  thresholds.begin(ball.field, thick);
  ball.choose(thresholds);
  const double at_center = thresholds.inner().value(Point_3(0, 0, 0)),
               at_end = thresholds.outer().value(Point_3(2.49, 0, 0));
  REQUIRE(at_center > -half);
  BS::Narrowing_limits once;
  once.max_passes = 1;
  const auto choose_once = [&]() {
    thresholds.begin(ball.field, thick);
    ball.choose(thresholds, once);
  };
  thresholds.forget_field(ball.field.cells(), ball.field.cells());
  CHECK_FALSE(thresholds.are_chosen());
  choose_once();
  CHECK(thresholds.inner().value(Point_3(0, 0, 0)) == Approx(at_center));
  CHECK(thresholds.outer().value(Point_3(2.49, 0, 0)) == Approx(at_end));
  CHECK(thresholds.undecided_volume() == 0);
  // On cells half as wide, caps are twice as wide, up to the requested width.
  std::vector<Index> all(ball.field.number_of_cells());
  for(Index c = 0; c < all.size(); ++c) all[c] = c;
  const Hierarchy before = ball.field.cells();
  Ball finer;
  finer.field = Field(before.refined(all));
  finer.field.set_coefficients(BS::refined_coefficients(ball.field, ball.field.coefficients(), finer.field));
  finer.update_ranges();
  thresholds.forget_field(before, finer.field.cells());
  thresholds.begin(finer.field, thick);
  finer.choose(thresholds, once);
  CHECK(thresholds.inner().value(Point_3(0, 0, 0)) == Approx((std::max)(2 * at_center, -half)));
}

TEST_CASE("Narrowed thresholds: reusing results of an unchanged field does not change the thresholds")
{
  Ball ball;
  Thresholds kept(seed());
  kept.begin(ball.field, thick);
  ball.choose(kept);
  // The field becomes flat around one point of the mesh.
  const Eigen::VectorXd before = ball.field.coefficients();
  Eigen::VectorXd x = before;
  std::vector<char> touched(ball.field.number_of_coefficients());
  ball.field.visit_coefficients(ball.field.locate(Point_3(1, 0, 0)), [&](int, Index u, double) { touched[u] = 1; });
  for(Index u = 0; u < touched.size(); ++u)
    if(touched[u]) x[u] *= 0.1;
  std::vector<char> changed(ball.field.number_of_cells());
  for(Index c = 0; c < changed.size(); ++c)
    ball.field.visit_coefficients(c, [&](int, Index u, double) {
      if(touched[u]) changed[c] = 1;
    });
  REQUIRE(std::count(changed.begin(), changed.end(), 1) < std::ptrdiff_t(changed.size()));
  ball.field.set_coefficients(x);
  ball.update_ranges();
  kept.field_has_changed(changed);
  CHECK_FALSE(kept.are_chosen());
  const std::vector<Obstacle> obstacles = ball.choose(kept);
  // The other thresholds keep only the caps of the first field.
  Ball first;
  Thresholds fresh(seed());
  fresh.begin(first.field, thick);
  first.choose(fresh);
  fresh.forget_cover();
  fresh.begin(ball.field, thick);
  CHECK(are_equal(ball.choose(fresh), obstacles));
  CHECK(inner(fresh) == inner(kept));
  CHECK(outer(fresh) == outer(kept));
  CHECK(fresh.undecided_volume() == kept.undecided_volume());
  // Without caps, the shell is as thick as requested where the first field had obstacles.
  fresh.forget();
  fresh.begin(ball.field, thin);
  ball.choose(fresh);
  CHECK(outer(fresh).maxCoeff() == 0.2);
}

TEST_CASE("Narrowed thresholds: on finer cells, covers and caps are kept under new indices, except in split cells")
{
  Ball ball;
  Thresholds kept(seed());
  kept.begin(ball.field, thick);
  ball.choose(kept);
  const Eigen::VectorXd coarse = ball.field.coefficients();
  const Field before = ball.field;
  const Hierarchy fine = before.cells().refined({ before.locate(Point_3(-1, 0, 0.1)) });
  Ball finer;
  finer.field = Field(fine);
  finer.field.set_coefficients(BS::refined_coefficients(before, coarse, finer.field));
  finer.update_ranges();
  std::vector<Index> now(before.number_of_cells());
  std::size_t same = 0;
  for(Index c = 0; c < now.size(); ++c) {
    now[c] = fine.leaf(before.cells().level(c), before.cells().lattice_point(c));
    if(now[c] != Field::npos && !BS::is_same_in_cell(before, c, finer.field, now[c])) now[c] = Field::npos;
    same += now[c] != Field::npos && now[c] != c;
  }
  REQUIRE(same > 100); // renumbered cells
  kept.cells_were_refined(now);
  CHECK_FALSE(kept.are_chosen());
  Thresholds uncovered = std::move(kept), covered(seed());
  covered.begin(before, thick);
  ball.choose(covered);
  covered.cells_were_refined(now);
  uncovered.forget_cover();
  uncovered.begin(finer.field, thick);
  covered.begin(finer.field, thick);
  CHECK(are_equal(finer.choose(uncovered), finer.choose(covered)));
  CHECK(inner(uncovered) == inner(covered));
  CHECK(outer(uncovered) == outer(covered));
  CHECK(covered.undecided_volume() == 0);
  // The caps for the first field are used from the first pass on.
  BS::Narrowing_limits once;
  once.max_passes = 1;
  covered.begin(finer.field, thick);
  finer.choose(covered, once);
  CHECK(covered.undecided_volume() == 0);
}

TEST_CASE("Narrowed thresholds: the result does not depend on the number of threads")
{
  const Ball ball;
  Thresholds one(seed()), several(seed());
  one.begin(ball.field, thick);
  several.begin(ball.field, thick);
  CHECK(are_equal(ball.choose(one), ball.choose<CGAL::Parallel_if_available_tag>(several)));
  CHECK(inner(one) == inner(several));
  CHECK(outer(one) == outer(several));
}
} // namespace test_Narrowed_thresholds
