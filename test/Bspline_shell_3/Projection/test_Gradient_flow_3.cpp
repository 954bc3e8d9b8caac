// Gradient_flow_3.h, Integral_curve.h, trace_to_level.h: points arrive where the closed forms of integral curves end,
// up to the tolerance, or the status is a failure.
#include "polynomial_fields.h"
#include "shell_reports.h"

#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <Eigen/Geometry>

#include <catch2/catch.hpp>

#include <algorithm>
#include <complex>
#include <cstring>
#include <limits>
#include <string>

namespace test_Gradient_flow_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
using BS::Flow_status;
typedef CGAL::Bspline_shell_3<> Shell;
typedef BS::Gradient_flow_3<Shell> Flow;
typedef Eigen::Vector3d Vector;
typedef Eigen::Matrix3d Matrix;

const double infinity = std::numeric_limits<double>::infinity(),
             not_a_number = std::numeric_limits<double>::quiet_NaN();

Vector vector(const Field::Point_3& p)
{
  return { p.x(), p.y(), p.z() };
}

Vector random_vector(CGAL::Random& random, double size)
{
  return { random.get_double(-size, size), random.get_double(-size, size), random.get_double(-size, size) };
}

// A polynomial, the point of an integral curve at a level, and the derivative of that point with respect to the start.
// The derivative keeps the difference of the levels constant.
struct Example
{
  std::string name;
  Polynomial polynomial;
  double (*value)(const Vector&);
  Vector (*gradient)(const Vector&);
  Vector (*arrival)(const Vector&, double level);
  Matrix (*differential)(const Vector&, double level);
};

Example plane()
{
  return { "plane",
           { { 2, { 1, 0, 0 } }, { -1, { 0, 1, 0 } }, { 2, { 0, 0, 1 } } },
           [](const Vector& x) { return Vector(2, -1, 2).dot(x); },
           [](const Vector&) { return Vector(2, -1, 2); },
           [](const Vector& x, double level) {
             return Vector(x + (level - Vector(2, -1, 2).dot(x)) / 9 * Vector(2, -1, 2));
           },
           [](const Vector&, double) { return Matrix(Matrix::Identity()); } };
}

Example spheres()
{
  return { "spheres",
           squared_distance,
           [](const Vector& x) { return x.squaredNorm(); },
           [](const Vector& x) { return Vector(2 * x); },
           [](const Vector& x, double level) { return Vector(std::sqrt(level) / x.norm() * x); },
           [](const Vector& x, double level) {
             const double stretch = std::sqrt(level) / x.norm(), r2 = x.squaredNorm();
             return Matrix(stretch * Matrix::Identity() - (level - r2) / (stretch * r2 * r2) * x * x.transpose());
           } };
}

// f = x y, half the imaginary part of (x + iy)^2. The real part is constant on the curves.
Example hyperbolas()
{
  return { "hyperbolas",
           { { 1, { 1, 1, 0 } } },
           [](const Vector& x) { return x[0] * x[1]; },
           [](const Vector& x) { return Vector(x[1], x[0], 0); },
           [](const Vector& x, double level) {
             std::complex<double> z = std::sqrt(std::complex<double>(x[0] * x[0] - x[1] * x[1], 2 * level));
             if(z.real() * x[0] + z.imag() * x[1] < 0) z = -z;
             return Vector(z.real(), z.imag(), x[2]);
           },
           // z^2 moves by a constant c. The derivative of Z = sqrt(z^2 + c) is z / Z.
           [](const Vector& x, double level) {
             const std::complex<double> z(x[0], x[1]),
               d = z / std::sqrt(z * z + std::complex<double>(0, 2 * (level - x[0] * x[1])));
             const double sign = (d * z / z).real() < 0 ? -1 : 1;
             Matrix m = Matrix::Identity();
             m.topLeftCorner<2, 2>() << sign * d.real(), -sign * d.imag(), sign * d.imag(), sign * d.real();
             return m;
           } };
}

// f = x^2 - y^2 + z. In time t, the gradient flow moves (x, y, z) to (x e^2t, y e^-2t, z + t).
double time(const Vector& x, double level)
{
  double t = 0;
  for(int i = 0; i < 100; ++i) { // Newton's method: f increases with t, and is nearly convex
    const double a = x[0] * x[0] * std::exp(4 * t), b = x[1] * x[1] * std::exp(-4 * t);
    t -= (a - b + x[2] + t - level) / (4 * a + 4 * b + 1);
  }
  return t;
}

Example exponentials()
{
  return { "exponentials",
           { { 1, { 2, 0, 0 } }, { -1, { 0, 2, 0 } }, { 1, { 0, 0, 1 } } },
           [](const Vector& x) { return x[0] * x[0] - x[1] * x[1] + x[2]; },
           [](const Vector& x) { return Vector(2 * x[0], -2 * x[1], 1); },
           [](const Vector& x, double level) {
             const double t = time(x, level);
             return Vector(x[0] * std::exp(2 * t), x[1] * std::exp(-2 * t), x[2] + t);
           },
           // The derivative at constant time, plus a multiple of the gradient G at the end: the change of time
           // satisfies G . D = g.
           [](const Vector& x, double level) {
             const double t = time(x, level);
             const Vector g(2 * x[0], -2 * x[1], 1), G(2 * x[0] * std::exp(2 * t), -2 * x[1] * std::exp(-2 * t), 1);
             const Matrix flow = Vector(std::exp(2 * t), std::exp(-2 * t), 1).asDiagonal();
             return Matrix(flow + G * (g.transpose() - G.transpose() * flow) / G.squaredNorm());
           } };
}

// f = x^3 / 3 - x y^2, a third of the real part of (x + iy)^3. The imaginary part is constant on the curves.
Example cubics()
{
  return { "cubics",
           { { 1 / 3., { 3, 0, 0 } }, { -1, { 1, 2, 0 } } },
           [](const Vector& x) { return x[0] * x[0] * x[0] / 3 - x[0] * x[1] * x[1]; },
           [](const Vector& x) { return Vector(x[0] * x[0] - x[1] * x[1], -2 * x[0] * x[1], 0); },
           [](const Vector& x, double level) {
             const std::complex<double> z(x[0], x[1]), cube = z * z * z;
             // Relative to the start, the root is on the correct branch.
             const std::complex<double> Z = z * std::pow(std::complex<double>(3 * level, cube.imag()) / cube, 1 / 3.);
             return Vector(Z.real(), Z.imag(), x[2]);
           },
           [](const Vector& x, double level) {
             const std::complex<double> z(x[0], x[1]), cube = z * z * z;
             const std::complex<double> Z = z * std::pow(std::complex<double>(3 * level, cube.imag()) / cube, 1 / 3.),
                                        d = z * z / (Z * Z);
             Matrix m = Matrix::Identity();
             m.topLeftCorner<2, 2>() << d.real(), -d.imag(), d.imag(), d.real();
             return m;
           } };
}

std::vector<Example> examples()
{
  return { plane(), spheres(), hyperbolas(), exponentials(), cubics() };
}

// A start and a level. The curve stays in the cube, and avoids small gradients.
struct Way
{
  Vector start;
  double level;
};
std::vector<Way> ways(const Example& example, int number, double difference, double least_gradient = 0.4)
{
  CGAL::Random random(5);
  std::vector<Way> ways;
  while(int(ways.size()) < number) {
    const Way way = { random_vector(random, 0.95), 0 };
    const double from = example.value(way.start), to = from + random.get_double(-difference, difference);
    bool good = true;
    for(int i = 0; i <= 16 && good; ++i) {
      const Vector x = example.arrival(way.start, from + (to - from) * i / 16);
      good = x.cwiseAbs().maxCoeff() < 0.98 && example.gradient(x).norm() > least_gradient; // false for NaN
    }
    if(good) ways.push_back({ way.start, to });
  }
  return ways;
}

template <typename Shell>
double largest_error(const Shell& shell, const Example& example, const Frame& frame, double tolerance,
                     double difference, double least_gradient)
{
  const BS::Gradient_flow_3<Shell> flow(shell, tolerance);
  double worst = 0;
  for(const Way& way : ways(example, 100, difference, least_gradient)) {
    const auto arrival = flow.trace(frame.to_user(way.start), frame.scale * way.level);
    REQUIRE(arrival.status == Flow_status::SUCCESS);
    worst = (std::max)(worst, (vector(arrival.point) - frame.to_user(example.arrival(way.start, way.level))).norm());
  }
  return worst;
}

} // namespace

TEST_CASE("Gradient flow: the closed forms that these tests use are correct")
{
  // First, the oracle is checked: arrivals are on the level, and move along the gradient.
  for(const Example& example : examples())
    for(const Way& way : ways(example, 50, 0.5)) {
      INFO(example.name);
      const Vector x = example.arrival(way.start, way.level);
      CHECK(example.value(x) == Approx(way.level).margin(1e-13));
      CHECK((example.arrival(way.start, example.value(way.start)) - way.start).norm() < 1e-13);
      const double h = 1e-5;
      const Vector velocity = (example.arrival(way.start, way.level + h) - example.arrival(way.start, way.level - h))
                              / (2 * h);
      const Vector g = example.gradient(x);
      CHECK((velocity - g / g.squaredNorm()).norm() < 1e-7); // h^2 times a third derivative of up to a few hundred
      const Matrix d = example.differential(way.start, way.level);
      for(int a = 0; a < 3; ++a) {
        Vector up = way.start, down = way.start;
        up[a] += h;
        down[a] -= h;
        const double change = way.level - example.value(way.start);
        const Vector column = (example.arrival(up, example.value(up) + change)
                               - example.arrival(down, example.value(down) + change))
                              / (2 * h);
        CHECK((column - d.col(a)).norm() < 1e-7);
      }
    }
}

TEST_CASE("Gradient flow: end points are within the tolerance, on uniform and on hierarchical cells")
{
  for(const Example& example : examples()) {
    const Shell uniform = shell_of(uniform_field(example.polynomial), -infinity, infinity);
    const Shell hierarchical = shell_of(hierarchical_field(example.polynomial), -infinity, infinity);
    REQUIRE(hierarchical.field().number_of_levels() == 3);
    for(double tolerance : { 1e-3, 1e-5, 1e-7, 1e-9, 1e-11 }) {
      INFO(example.name << ", tolerance " << tolerance);
      // As in a shell: curves are shorter than half a cell, and the gradient changes little.
      CHECK(largest_error(uniform, example, Frame(), tolerance, 0.07, 0.9) <= tolerance);
      CHECK(largest_error(hierarchical, example, Frame(), tolerance, 0.07, 0.9) <= tolerance);
      // Curves cross the cube, over ten cells or more, and may diverge.
      CHECK(largest_error(uniform, example, Frame(), tolerance, 0.8, 0.4) <= tolerance);
      CHECK(largest_error(hierarchical, example, Frame(), tolerance, 0.8, 0.4) <= tolerance);
    }
  }
}

TEST_CASE("Gradient flow: end points are within the tolerance, at any scale and position")
{
  for(const Frame& frame :
      { Frame{ Vector(0, 0, 0), 1e-6 }, Frame{ Vector(0, 0, 0), 1e6 }, Frame{ Vector(0, 0, 0), 1e-100 },
        Frame{ Vector(1000, -2000, 500), 1 }, Frame{ Vector(3, 1, 2), 1e-3 } })
    for(const Example& example : examples()) {
      INFO(example.name << ", scale " << frame.scale << ", center " << frame.center[0]);
      const double tolerance = 2e-9 * frame.scale;
      CHECK(largest_error(shell_of(uniform_field(example.polynomial, frame), -infinity, infinity, frame), example,
                          frame, tolerance, 0.07, 0.9)
            <= tolerance);
      CHECK(largest_error(shell_of(hierarchical_field(example.polynomial, frame), -infinity, infinity, frame), example,
                          frame, tolerance, 0.07, 0.9)
            <= tolerance);
    }
}

TEST_CASE("Gradient flow: near the origin, the default tolerance is 1e-9 of the box")
{
  const Shell shell = shell_of(uniform_field(squared_distance), -infinity, infinity);
  CHECK(Flow(shell).tolerance() == 1e-9 * shell.report().unit);
  CHECK(Flow(shell, 0.25).tolerance() == 0.25);
  CHECK(&Flow(shell).shell() == &shell);
  CHECK(largest_error(shell, spheres(), Frame(), 0, 0.07, 0.9) <= 2e-9);
}

TEST_CASE(
  "Gradient flow: curves along faces, edges and diagonals of cells, and through corners, are exact up to rounding")
{
  // All values are exact, and so are straight curves, except where they leave cells: a millionth of a cell beyond the
  // faces, with the rounding of the neighbor.
  const double rounding = 1e-13;
  CGAL::Random random(3);
  for(const Vector& direction :
      { Vector(1, 0, 0), Vector(0, 0, -1), Vector(1, 1, 0), Vector(0, 1, -1), Vector(1, 1, 1), Vector(-1, 1, 1) }) {
    const Polynomial polynomial = { { direction[0], { 1, 0, 0 } },
                                    { direction[1], { 0, 1, 0 } },
                                    { direction[2], { 0, 0, 1 } } };
    const auto check = [&](const auto& shell) {
      const BS::Gradient_flow_3<std::decay_t<decltype(shell)> > flow(shell);
      for(int n = 0; n < 300; ++n) {
        // corners, points in edges and faces of cells of all sizes, and points close to these
        Vector x(random.get_int(-8, 9) / 16., random.get_int(-8, 9) / 16., random.get_int(-8, 9) / 16.);
        if(n % 3 == 1) x[n % 9 / 3] += random.get_double(-1e-6, 1e-6);
        if(n % 3 == 2) x[n % 9 / 3] += random.get_double(0, 1 / 16.);
        const double from = direction.dot(x), to = from + random.get_int(-8, 9) / 32. * direction.squaredNorm();
        const auto arrival = flow.trace(x, to);
        REQUIRE(arrival.status == Flow_status::SUCCESS);
        CHECK((vector(arrival.point) - (x + (to - from) / direction.squaredNorm() * direction)).norm() <= rounding);
      }
    };
    check(shell_of(uniform_field(polynomial), -infinity, infinity));
    check(shell_of(hierarchical_field(polynomial), -infinity, infinity));
  }

  // Curves in a plane of faces; and curves of x y in the plane x = y, which are straight and pass through edges and
  // corners.
  for(int seed : { 1, 2, 3 }) {
    const Shell curved = shell_of(hierarchical_field(hyperbolas().polynomial, Frame(), seed), -infinity, infinity);
    const Flow flow(curved);
    for(int n = 0; n < 100; ++n) {
      const double z = random.get_int(-15, 16) / 16., x = random.get_double(0.4, 0.9);
      const Vector starts[2] = { Vector(x, random.get_double(-0.3, 0.3), z),
                                 Vector(0.5, 0.5, random.get_double(-1, 1)) };
      const double levels[2] = { random.get_double(-0.05, 0.3), random.get_double(0.1, 0.9) };
      for(int i = 0; i < 2; ++i) {
        const auto arrival = flow.trace(starts[i], levels[i]);
        REQUIRE(arrival.status == Flow_status::SUCCESS);
        CHECK((vector(arrival.point) - hyperbolas().arrival(starts[i], levels[i])).norm() <= 10 * flow.tolerance());
        if(i == 0) CHECK(std::abs(arrival.point.z() - z) <= 1e-13);
        else CHECK(arrival.point.x() == Approx(arrival.point.y()).epsilon(1e-13));
      }
    }
  }
}

TEST_CASE("Gradient flow: points exactly on a threshold are in the shell, as start and end points")
{
  const Shell slab = shell_of(uniform_field({ { 1, { 1, 0, 0 } } }), -0.25, 0.625);
  const Flow flow(slab);
  for(double y : { 0., 0.25, 0.3, -0.99 }) {
    const Vector inner(-0.25, y, 0.5), outer(0.625, y, 0.5);
    REQUIRE(flow.trace(inner, 0.625));
    CHECK((vector(flow.trace(inner, 0.625).point) - outer).norm() < 1e-13);
    REQUIRE(flow.trace(outer, -0.25));
    CHECK((vector(flow.trace(outer, -0.25).point) - inner).norm() < 1e-13);
    for(double level : { -0.25, 0.625 }) { // curves of length zero
      const auto arrival = flow.trace(level < 0 ? inner : outer, level);
      REQUIRE(arrival);
      CHECK((vector(arrival.point) - (level < 0 ? inner : outer)).norm() < 1e-13);
      CHECK((flow.differential(level < 0 ? inner : outer, level).matrix - Matrix::Identity()).norm() < 1e-13);
    }
  }
  // On spheres, the same holds up to rounding.
  const Shell shell = shell_of(uniform_field(squared_distance), 0.25, 0.49);
  const Flow radial(shell);
  CGAL::Random random(11);
  for(int n = 0; n < 200; ++n) {
    const Vector direction = random_vector(random, 1).normalized();
    const auto out = radial.trace(0.5 * direction, 0.49), in = radial.trace(0.7 * direction, 0.25);
    REQUIRE(out.status == Flow_status::SUCCESS);
    REQUIRE(in.status == Flow_status::SUCCESS);
    // The shell is as wide as a cell. Curves meet two to four cells, each in separate steps.
    CHECK((vector(out.point) - 0.7 * direction).norm() <= 2 * radial.tolerance());
    CHECK((vector(in.point) - 0.5 * direction).norm() <= 2 * radial.tolerance());
  }
}

TEST_CASE("Gradient flow: a point that cannot be moved has a status with the reason")
{
  const Shell shell = shell_of(uniform_field(squared_distance), 0.25, 0.49);
  const Flow flow(shell);
  const auto status = [&](const Vector& x, double level) {
    const Flow_status traced = flow.trace(x, level).status;
    CHECK(flow.differential(x, level).status == traced);
    return traced;
  };
  const Vector x(0.6, 0, 0);
  CHECK(status(x, 0.4) == Flow_status::SUCCESS);
  for(double bad : { not_a_number, infinity, -infinity }) {
    CHECK(status(x, bad) == Flow_status::NOT_FINITE);
    for(int a = 0; a < 3; ++a) {
      Vector y = x;
      y[a] = bad;
      CHECK(status(y, 0.4) == Flow_status::NOT_FINITE);
    }
  }
  CHECK(status(Vector(0.4, 0, 0), 0.4) == Flow_status::STARTS_OUTSIDE); // beyond the inner threshold
  CHECK(status(Vector(0.8, 0, 0), 0.4) == Flow_status::STARTS_OUTSIDE); // beyond the outer one
  CHECK(status(Vector(5, 0, 0), 0.4) == Flow_status::STARTS_OUTSIDE);   // outside all cells
  CHECK(status(Vector(1e300, 0, 0), 0.4) == Flow_status::STARTS_OUTSIDE);
  CHECK(status(x, 0.5) == Flow_status::LEAVES_SHELL);
  CHECK(status(x, 0.24) == Flow_status::LEAVES_SHELL);
  CHECK(status(x, 1e300) == Flow_status::LEAVES_SHELL);
  CHECK(status(x, -1e300) == Flow_status::LEAVES_SHELL);

  // Thresholds are respected up to the tolerance.
  const double far = 3 * flow.tolerance();
  CHECK(status(Vector(0.5 - far, 0, 0), 0.4) == Flow_status::STARTS_OUTSIDE);
  CHECK(status(Vector(0.7 + far, 0, 0), 0.4) == Flow_status::STARTS_OUTSIDE);
  CHECK(status(Vector(0.5 + far, 0, 0), 0.4) == Flow_status::SUCCESS);
  CHECK(status(x, 0.49 + 1.4 * far) == Flow_status::LEAVES_SHELL);

  // Cells that the shell does not meet are not part of it.
  Field field = uniform_field({ { 1, { 1, 0, 0 } } });
  std::vector<char> cells(field.number_of_cells(), 1);
  for(Field::Cell_index c = 0; c < field.number_of_cells(); ++c) cells[c] = field.cell(c).corner()[0] < 0.5;
  const Shell part(field, BS::Level_range{ -2, 2 }, cells, {}, successful_report(2));
  const BS::Gradient_flow_3<Shell> partly(part);
  CHECK(partly.trace(Vector(0.1, 0.1, 0.1), 0.4).status == Flow_status::SUCCESS);
  CHECK(partly.trace(Vector(0.1, 0.1, 0.1), 0.7).status == Flow_status::LEAVES_SHELL);
  CHECK(partly.trace(Vector(0.7, 0.1, 0.1), 0.6).status == Flow_status::STARTS_OUTSIDE);
  // Neither are points beyond the last cell.
  CHECK(partly.trace(Vector(-0.9, 0.1, 0.1), -1.5).status == Flow_status::LEAVES_SHELL);

  for(int s = 0; s <= int(Flow_status::CANCELED); ++s) CHECK(std::strlen(message(Flow_status(s))) > 10);
}

TEST_CASE("Gradient flow: a curve that reaches a critical point does not continue beyond it")
{
  // Minima, and saddles that curves reach along an axis. Near the value zero, the resolution of values is higher.
  const Polynomial minimum = squared_distance, saddle = { { 1, { 2, 0, 0 } }, { -1, { 0, 0, 2 } }, { 1, { 0, 2, 0 } } },
                   monkey_saddle = { { 1, { 3, 0, 0 } }, { -3, { 1, 2, 0 } } };
  struct Case
  {
    Polynomial polynomial;
    Vector start;
    double beyond;
  };
  for(Case c : { Case{ minimum, { 0.6, 0, 0 }, -0.1 }, Case{ minimum, { 0.3, -0.2, 0.4 }, -0.1 },
                 Case{ minimum, { 0.3, -0.2, 0.4 }, -0.01 }, Case{ saddle, { 0, 0, 0.5 }, 0.2 },
                 Case{ saddle, { 0.3, 0, 0 }, -0.2 }, Case{ monkey_saddle, { 0.5, 0, 0 }, -0.1 } })
    for(double value : { 0., 0.3, -1 / 3. })
      for(double tolerance : { 1e-3, 1e-6, 1e-9, 1e-12 }) {
        c.polynomial.push_back({ value, { 0, 0, 0 } });
        const Shell shell = shell_of(uniform_field(c.polynomial), -1, 1);
        c.polynomial.pop_back();
        const Flow flow(shell, tolerance);
        INFO("start " << c.start.transpose() << ", value " << value << ", tolerance " << tolerance);
        // If the tolerance is larger than the rest of the curve, the curve may end because it cannot meet the
        // tolerance. Near a saddle, a curve that deviates by rounding may continue.
        const auto arrival = flow.trace(c.start, value + c.beyond);
        if(arrival && c.polynomial[1].factor != minimum[1].factor) {
          const double off = *shell.field().value(arrival.point) - (value + c.beyond);
          CHECK(std::abs(off) <= 10 * tolerance * std::sqrt(shell.field().gradient(arrival.point)->squared_length()));
        } else {
          CHECK((arrival.status == Flow_status::GRADIENT_VANISHES || arrival.status == Flow_status::TOLERANCE_NOT_MET));
        }
        // No curve starts at the critical point.
        CHECK(flow.trace(Vector(0, 0, 0), value + 0.1).status == Flow_status::GRADIENT_VANISHES);
      }
  // The field is constant.
  const Shell constant = shell_of(uniform_field({ { 0.5, { 0, 0, 0 } } }), 0, 1);
  CHECK(Flow(constant).trace(Vector(0.1, 0.2, 0.3), 0.6).status == Flow_status::GRADIENT_VANISHES);
}

TEST_CASE("Gradient flow: curves end at varying thresholds")
{
  // f = x, between -1/2 and 0.4 + y^2 / 4
  const Field field = uniform_field({ { 1, { 1, 0, 0 } } });
  typedef BS::Spline_threshold<Field> Threshold;
  typedef CGAL::Bspline_shell_3<Field, Threshold> Shell;
  const Shell shell(field, Threshold(uniform_field({ { -0.5, { 0, 0, 0 } } })),
                    Threshold(uniform_field({ { 0.4, { 0, 0, 0 } }, { 0.25, { 0, 2, 0 } } })),
                    std::vector<char>(field.number_of_cells(), 1), {}, successful_report(2));
  const BS::Gradient_flow_3<Shell> flow(shell);
  for(double y : { -0.9, -0.5, 0., 0.3, 0.7 }) {
    const double end = 0.4 + y * y / 4, little = 1e-7; // much more than the tolerance, and the rounding of steps
    const Vector start(-0.1, y, 0.2);
    CHECK(flow.trace(start, end - little).status == Flow_status::SUCCESS);
    CHECK(flow.trace(start, end + little).status == Flow_status::LEAVES_SHELL);
    CHECK(flow.trace(Vector(end + little, y, 0.2), 0).status == Flow_status::STARTS_OUTSIDE);
    CHECK(flow.trace(Vector(end - little, y, 0.2), 0).status == Flow_status::SUCCESS);
  }
}

TEST_CASE("Gradient flow: tracing there and back returns to the start")
{
  for(const Example& example : examples()) {
    const Shell shell = shell_of(hierarchical_field(example.polynomial), -infinity, infinity);
    const Flow flow(shell);
    for(const Way& way : ways(example, 100, 0.1, 0.8)) {
      const auto there = flow.trace(way.start, way.level);
      REQUIRE(there);
      const auto back = flow.trace(there.point, example.value(way.start));
      REQUIRE(back);
      CHECK((vector(back.point) - way.start).norm() <= 2 * flow.tolerance());
    }
  }
}

TEST_CASE("Gradient flow: the differential and its restrictions agree with closed forms")
{
  const Frame frame{ Vector(10, -20, 30), 50 };
  for(const Example& example : examples()) {
    const Shell shell = shell_of(hierarchical_field(example.polynomial, frame), -infinity, infinity, frame);
    const Flow flow(shell);
    // The tolerance of derivatives is relative: see Gradient_flow_3::differential().
    const double tolerance = 4 * flow.tolerance() / shell.report().unit;
    CGAL::Random random(2);
    for(const Way& way : ways(example, 100, 0.1, 0.8)) {
      INFO(example.name);
      const auto d = flow.differential(frame.to_user(way.start), frame.scale * way.level);
      REQUIRE(d);
      const Vector x = example.arrival(way.start, way.level), g = example.gradient(x);
      const Matrix expected = example.differential(way.start, way.level);
      CHECK((d.matrix - expected).norm() <= tolerance);
      CHECK((d.velocity - g / g.squaredNorm()).norm() <= 10 * tolerance); // its derivative is at most ten

      // The plane is not parallel to the curve. Images are in the plane; displacements along the curve are mapped to
      // zero.
      Vector normal = random_vector(random, 1);
      while(std::abs(normal.normalized().dot(g.normalized())) < 0.3) normal = random_vector(random, 1);
      const Matrix onto = d.onto_plane(normal), level = d.onto_level_set();
      CHECK((normal.transpose() * onto).norm() <= 1e-14 * normal.norm() * onto.norm() * 10);
      const Vector along = example.gradient(way.start).normalized();
      CHECK((onto * along).norm() <= 50 * tolerance);
      CHECK((d.velocity.transpose() * level).norm() <= 1e-14 * d.velocity.norm() * level.norm() * 10);
      CHECK((level * along).norm() <= 50 * tolerance);
      // Scaling or reversing the normal changes nothing.
      CHECK((d.onto_plane(-1000 * normal) - onto).norm() <= 1e-13 * onto.norm());

      // Compare with the map to the plane through x, along tangents. It is accurate to second order, while the
      // differential is of first order.
      const double h = 1e-5;
      for(int a = 0; a < 3; ++a) {
        Vector ends[2];
        for(int side : { 0, 1 }) {
          Vector start = way.start;
          start[a] += side == 0 ? -h : h;
          double s = way.level;
          for(int i = 0; i < 5; ++i) {
            const Vector y = example.arrival(start, s), v = example.gradient(y);
            s -= normal.dot(y - x) / normal.dot(v / v.squaredNorm());
          }
          ends[side] = example.arrival(start, s);
        }
        CHECK(((ends[1] - ends[0]) / (2 * h) - onto.col(a)).norm() < 1e-6 * (1 + onto.norm()));
      }
    }
  }
}

TEST_CASE("Gradient flow: the differential from one sphere to another scales tangent vectors")
{
  const Shell shell = shell_of(uniform_field(squared_distance), 0.2, 0.9);
  const Flow flow(shell);
  const Vector x(0.3, 0.4, 0.2), n = x.normalized(), tangent = n.cross(Vector(0, 0, 1)).normalized();
  const auto d = flow.differential(x, 0.6);
  REQUIRE(d);
  const double stretch = std::sqrt(0.6) / x.norm();
  CHECK((d.onto_level_set() * tangent - stretch * tangent).norm() < 1e-8);
  CHECK((d.onto_level_set() - stretch * (Matrix::Identity() - n * n.transpose())).norm() < 1e-8);
}

TEST_CASE("Gradient flow: the result does not depend on the type of the start point")
{
  const Shell shell = shell_of(uniform_field(cubics().polynomial), -infinity, infinity);
  const Flow flow(shell);
  const auto expected = flow.trace(std::array<double, 3>{ 0.75, 0.5, 0.25 }, 0.1);
  REQUIRE(expected);
  typedef CGAL::Exact_predicates_exact_constructions_kernel Exact;
  CHECK(flow.trace(Field::Point_3(0.75, 0.5, 0.25), 0.1).point == expected.point);
  CHECK(flow.trace(Exact::Point_3(0.75, 0.5, 0.25), 0.1).point == expected.point);
  CHECK(flow.trace(Vector(0.75, 0.5, 0.25), 0.1).point == expected.point);
}
} // namespace test_Gradient_flow_3
