// segment_through_shell.h: segments begin below the shell, end above it, and rise between.
#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Certificate/segment_through_shell.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include "polynomial_fields.h"

#include <catch2/catch.hpp>

#include <array>
#include <optional>

namespace test_segment_through_shell {
namespace BS = CGAL::Bspline_shells;
typedef Field::Point_3 Point;
typedef BS::Constant_threshold Constant;
typedef BS::Spline_threshold<Field> Varying;

namespace {

const Polynomial x = { { 1, { 1, 0, 0 } } };

// x minus its dip: -0.5 + 1.35 x - 2.85 x^2 + 2 x^3 has the values -0.5 and 0 at 0 and 1, and falls between.
const Polynomial rises = { { -0.5, { 0, 0, 0 } }, { 1.35, { 1, 0, 0 } }, { -2.85, { 2, 0, 0 } }, { 2, { 3, 0, 0 } } };

// Returns x - p.
Polynomial x_minus(Polynomial p)
{
  for(Monomial& m : p) m.factor = -m.factor;
  p.push_back(x[0]);
  return p;
}

Varying varying(const Polynomial& p)
{
  return Varying(uniform_field(p));
}

// Returns a segment along the x-axis.
std::array<Point, 2> along_x(double from, double to)
{
  return { Point(from, 0.1, 0.2), Point(to, 0.1, 0.2) };
}

} // namespace

TEST_CASE("Segments through shells: a segment begins below the inner threshold, and ends above the outer one")
{
  const Field field = uniform_field(x);
  const BS::Field_predicates_3<Field> predicates(field);
  const auto leads_through = [&](double from, double to) {
    const bool leads = BS::leads_through_shell(predicates, Constant(-0.25), Constant(0.25), along_x(from, to));
    CHECK(BS::leads_through_shell(predicates, varying({ { -0.25, { 0, 0, 0 } } }), varying({ { 0.25, { 0, 0, 0 } } }),
                                  along_x(from, to))
          == leads);
    return leads;
  };
  CHECK(leads_through(-0.5, 0.5));
  CHECK_FALSE(leads_through(-0.2, 0.5));
  CHECK_FALSE(leads_through(-0.5, 0.2));
  CHECK_FALSE(leads_through(-0.5, -0.3));
  CHECK_FALSE(leads_through(0.3, 0.5));
  CHECK_FALSE(leads_through(0.5, -0.5));
}

TEST_CASE("Segments through shells: the field, and its differences from both thresholds, increase along a segment")
{
  const std::array<Point, 2> segment = along_x(0, 0.95);
  {
    const Field field = uniform_field(rises);
    const BS::Field_predicates_3<Field> predicates(field);
    REQUIRE(predicates.is_beyond(segment[0], Constant(-0.3), CGAL::NEGATIVE));
    REQUIRE(predicates.is_beyond(segment[1], Constant(-0.2), CGAL::POSITIVE));
    CHECK_FALSE(BS::leads_through_shell(predicates, Constant(-0.3), Constant(-0.2), segment));
  }
  const Field field = uniform_field(x);
  const BS::Field_predicates_3<Field> predicates(field);
  // The field minus the first threshold is `rises` + 0.25.
  Polynomial shifted = rises;
  shifted[0].factor += 0.25;
  const Varying dips = varying(x_minus(shifted)), low = varying({ { 0.1, { 0, 0, 0 } } }),
                high = varying({ { 0.8, { 0, 0, 0 } } });
  for(const Varying& threshold : { dips, low, high }) {
    REQUIRE(predicates.is_beyond(segment[0], threshold, CGAL::NEGATIVE));
    REQUIRE(predicates.is_beyond(segment[1], threshold, CGAL::POSITIVE));
  }
  CHECK(BS::leads_through_shell(predicates, low, high, segment));
  CHECK_FALSE(BS::leads_through_shell(predicates, dips, high, segment));
  CHECK_FALSE(BS::leads_through_shell(predicates, low, dips, segment));
}

TEST_CASE("Segments through shells: a segment is found through points at which the gradient does not vanish")
{
  const Field field = uniform_field(squared_distance);
  const BS::Field_predicates_3<Field> predicates(field);
  const Constant inner(0.25), outer(0.36);
  const std::optional<std::array<Point, 2> > segment = BS::segment_through_shell(predicates, inner, outer,
                                                                                 Point(0.55, 0, 0));
  REQUIRE(segment);
  CHECK(BS::leads_through_shell(predicates, inner, outer, *segment));
  CHECK_FALSE(BS::segment_through_shell(predicates, inner, outer, Point(0, 0, 0)));
  CHECK_FALSE(BS::segment_through_shell(predicates, inner, outer, Point(3, 0, 0)));
}
} // namespace test_segment_through_shell
