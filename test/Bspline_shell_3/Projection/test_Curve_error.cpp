// Curve_error.h: errors grow as curves diverge, according to closed forms. The tolerance is met, or the status is a
// failure.
#include "polynomial_fields.h"

#include <CGAL/Bspline_shell_3/Projection/internal/Curve_error.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace test_Curve_error {
namespace {

namespace BS = CGAL::Bspline_shells;
using BS::Flow_status;
using BS::internal::Curve_error;
using BS::internal::Divergence;
typedef Eigen::Vector3d Vector;

Divergence divergence(const Field& field, const Vector& x)
{
  const Field::Point_3 p(x[0], x[1], x[2]);
  return BS::internal::divergence(field.cell(field.locate(p)), p);
}

// Returns the estimate along a curve, where each step has the given error.
Curve_error along(const Field& field, const std::vector<Vector>& curve, const std::vector<double>& values, double error)
{
  Curve_error result(divergence(field, curve[0]));
  for(std::size_t i = 1; i < curve.size(); ++i)
    result.add_step(values[i] - values[i - 1], error, divergence(field, curve[i]));
  return result;
}

} // namespace

TEST_CASE("Curve error: the divergence follows from the eigenvalues of the Hessian across the gradient")
{
  // f = x + (y^2 + 3 z^2 + 4 y z) / 2 on the x axis
  const Field flat = uniform_field(
    { { 1, { 1, 0, 0 } }, { 0.5, { 0, 2, 0 } }, { 1.5, { 0, 0, 2 } }, { 2, { 0, 1, 1 } } });
  const Divergence d = divergence(flat, Vector(0.3, 0, 0));
  CHECK(d.most == Approx(2 + std::sqrt(5.)));
  CHECK(d.least == Approx(2 - std::sqrt(5.)));
  // f = |x|^2, where H = 2 and |g|^2 = 4 |x|^2
  const Field spheres = uniform_field({ { 1, { 2, 0, 0 } }, { 1, { 0, 2, 0 } }, { 1, { 0, 0, 2 } } });
  for(const Vector& x : { Vector(0.3, -0.2, 0.6), Vector(0, 0, 0.5), Vector(-0.7, 0.1, 0.1) }) {
    CHECK(divergence(spheres, x).most == Approx(1 / (2 * x.squaredNorm())));
    CHECK(divergence(spheres, x).least == Approx(1 / (2 * x.squaredNorm())));
  }
}

TEST_CASE("Curve error: errors grow as curves diverge, forwards and backwards")
{
  // Along a ray of f = |x|^2, distances between curves are proportional to the radius.
  const Field spheres = uniform_field({ { 1, { 2, 0, 0 } }, { 1, { 0, 2, 0 } }, { 1, { 0, 0, 2 } } });
  const Vector direction = Vector(1, 2, -1).normalized();
  for(const bool outwards : { true, false }) {
    const double first = outwards ? 0.1 : 0.9, last = outwards ? 0.9 : 0.1;
    constexpr int steps = 200;
    std::vector<Vector> curve;
    std::vector<double> values;
    double at_end = 0, at_start = 0;
    for(int i = 0; i <= steps; ++i) {
      const double r = first + (last - first) * i / steps;
      curve.push_back(r * direction);
      values.push_back(r * r);
      at_end += i == 0 ? 0 : last / r;
      at_start += i == 0 ? 0 : first / r;
    }
    const Curve_error error = along(spheres, curve, values, 1);
    CHECK(error.at_end() == Approx(at_end).epsilon(0.01));
    CHECK(error.at_start() == Approx(at_start).epsilon(0.01));
  }
}

TEST_CASE("Curve error: curves are traced again until the tolerance is met, or the status is a failure")
{
  struct Result
  {
    BS::internal::Image_error error;
  };
  std::vector<double> tolerances;
  Result result;
  const auto keep = [&](double at_image, double at_start, double least_at_image, double least_at_start) {
    tolerances.clear();
    return BS::internal::keep_tolerance(1e-9, result, [&](double step_tolerance, Result& result) {
      tolerances.push_back(step_tolerance);
      result.error = { (std::max)(at_image * step_tolerance, least_at_image),
                       (std::max)(at_start * step_tolerance, least_at_start) };
      return Flow_status::SUCCESS;
    });
  };
  CHECK(keep(0.4, 0.4, 0, 0) == Flow_status::SUCCESS);
  CHECK(tolerances.size() == 1);
  CHECK(keep(500, 0.4, 0, 0) == Flow_status::SUCCESS);
  CHECK(tolerances.size() == 2);
  CHECK(result.error.at_image <= 1e-9);
  CHECK(keep(0.4, 500, 0, 0) == Flow_status::SUCCESS);
  CHECK(tolerances.size() == 2);
  CHECK(result.error.at_start <= 1e-9);
  // rounding at the image, and at the start
  CHECK(keep(1, 1, 2e-9, 0) == Flow_status::TOLERANCE_NOT_MET);
  CHECK(keep(1, 1, 0, 2e-9) == Flow_status::SUCCESS);
  CHECK(result.error.at_start == 2e-9);
  CHECK(keep(std::nan(""), 0, 0, 0) == Flow_status::TOLERANCE_NOT_MET);
  // If a curve cannot be traced in shorter steps, its result is kept.
  int calls = 0;
  const auto fail_later = [&](double, Result& result) {
    result.error = { 0, 2e-9 };
    return ++calls == 1 ? Flow_status::SUCCESS : Flow_status::TOLERANCE_NOT_MET;
  };
  CHECK(BS::internal::keep_tolerance(1e-9, result, fail_later) == Flow_status::SUCCESS);
  CHECK(calls == 2);
  CHECK(BS::internal::keep_tolerance(1e-9, result, [](double, Result&) { return Flow_status::LEAVES_SHELL; })
        == Flow_status::LEAVES_SHELL);
}
} // namespace test_Curve_error
