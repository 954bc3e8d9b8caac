// Thresholds.h: splines that are constant on most cells, compared with exact arithmetic.
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include "random_hierarchies.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>

#include <CGAL/Exact_rational.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace test_Thresholds {
namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef Field::Cell_index Index;
typedef CGAL::Exact_rational Rational;

TEST_CASE("Spline thresholds: a cell is constant if and only if its coefficients are, with correct range and values")
{
  CGAL::Random random(3);
  const Hierarchy cells = random_hierarchy(random, all_cells(0.7, { -4, -4, -4 }, { 3, 3, 3 }), 3);
  Field field(cells);
  Eigen::VectorXd x = Eigen::VectorXd::Constant(Eigen::Index(field.number_of_coefficients()), 0.125);
  for(int n = 0; n < 3; ++n) x[random.get_int(0, int(x.size()))] = random.get_double(0.05, 0.2);
  // Some averages of these with other coefficients are rounded to the latter.
  for(int n = 0; n < 20; ++n) x[random.get_int(0, int(x.size()))] = std::nextafter(0.125, n % 2);
  field.set_coefficients(x);
  const BS::Spline_threshold<Field> threshold(field);

  std::size_t constant = 0, varying = 0, rounded = 0;
  for(Index c = 0; c < field.number_of_cells(); ++c) {
    const auto cell = field.cell(c);
    const double* const b = cell.coefficients();
    const bool is_constant = std::count(b, b + 64, b[0]) == 64;
    REQUIRE(std::isnan(threshold.constant(c)) == !is_constant);
    ++(is_constant ? constant : varying);

    const BS::Level_range range = threshold.range(c);
    const std::array<Rational, 64> exact = field.bernstein_coefficients<Rational>(c);
    for(const Rational& coefficient : exact)
      REQUIRE((coefficient >= Rational(range.min) && coefficient <= Rational(range.max)));
    rounded += is_constant && std::any_of(exact.begin(), exact.end(), [&](const Rational& coefficient) {
                 return coefficient != Rational(b[0]);
               });
    const auto least_and_most = std::minmax_element(exact.begin(), exact.end());
    CHECK(range.max - range.min < CGAL::to_double(Rational(*least_and_most.second - *least_and_most.first)) + 1e-14);

    const std::array<double, 3> p = { cell.corner()[0] + random.get_double() * cell.width(),
                                      cell.corner()[1] + random.get_double() * cell.width(),
                                      cell.corner()[2] + random.get_double() * cell.width() };
    CHECK(threshold.value(p, c) == Approx(cell.value(p)).epsilon(1e-14));
  }
  CHECK(constant > 100);
  CHECK(varying > 50);
  CHECK(rounded > 0);
}
} // namespace test_Thresholds
