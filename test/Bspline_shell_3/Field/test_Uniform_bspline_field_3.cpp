// A tricubic spline on sparse cells is compared with closed forms, and with its definition, summed in exact arithmetic.
#include <CGAL/Bspline_shell_3/Field/Uniform_bspline_field_3.h>
#include "exact_spline.h"

#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace test_Uniform_bspline_field_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Uniform_bspline_field_3<> Field;
typedef Field::Point_3 Point;
typedef BS::Lattice_key Key;

const double eps = std::numeric_limits<double>::epsilon();

// Returns cells in [first, last]^3, some of which are missing. The spacing of the lattice is not a power of two.
BS::Cell_complex_3 sparse_cells(CGAL::Random& random, int first, int last, double share)
{
  const BS::Lattice_3 lattice(CGAL::Bbox_3(9, -1, -4, 11, 2, 1), 0.3);
  std::vector<std::uint64_t> keys;
  for(int k = first; k <= last; ++k)
    for(int j = first; j <= last; ++j)
      for(int i = first; i <= last; ++i)
        if(random.get_double() < share) keys.push_back(Key::encode(i, j, k));
  return BS::Cell_complex_3(lattice, keys);
}

Eigen::VectorXd random_coefficients(CGAL::Random& random, std::size_t size)
{
  Eigen::VectorXd x(size);
  for(Eigen::Index n = 0; n < x.size(); ++n) x[n] = random.get_double(-1, 1);
  return x;
}

Point point_in_cell(const Field& field, Field::Cell_index c, double x, double y, double z)
{
  const std::array<double, 3> corner = field.cells().corner(c);
  const double w = field.cells().width();
  return Point(corner[0] + x * w, corner[1] + y * w, corner[2] + z * w);
}

// Returns an upper bound of the error of an evaluated value: the cell's radius, and roundings in local coordinates
// (one, times a derivative of at most 6 per axis), weights (five per axis) and sums (four per axis).
double tolerance(const Field& field, Field::Cell_index c)
{
  double largest = 0;
  for(double x : field.local_coefficients(c)) largest = (std::max)(largest, std::abs(x));
  return field.cell(c).error_radius() + 64 * eps * largest;
}

// The absolute Bernstein weights of a derivative sum to at most 6; those of a second derivative, to at most 24.
double tolerance(const Field& field, Field::Cell_index c, int order)
{
  const double w = field.cells().width();
  return tolerance(field, c) * (order == 0 ? 1 : order == 1 ? 6 / w : 36 / (w * w));
}

double off(double x, const Rational& exact)
{
  return std::abs(CGAL::to_double(Rational(Rational(x) - exact)));
}

std::array<int, 3> derivative(int a, int b)
{
  std::array<int, 3> order = { 0, 0, 0 };
  ++order[a];
  ++order[b];
  return order;
}

} // namespace

TEST_CASE("Uniform field: the functions are exactly those that act on some cell")
{
  CGAL::Random random(1);
  const Field field(sparse_cells(random, -2, 2, 0.3));
  std::set<BS::Lattice_3::Point> centers;
  for(Field::Cell_index c = 0; c < field.number_of_cells(); ++c)
    for(int k = -1; k <= 2; ++k)
      for(int j = -1; j <= 2; ++j)
        for(int i = -1; i <= 2; ++i) {
          const BS::Lattice_3::Point& p = field.cells().lattice_point(c);
          centers.insert(BS::Lattice_3::Point{ p[0] + i, p[1] + j, p[2] + k });
        }
  REQUIRE(field.number_of_coefficients() == centers.size());
  for(const BS::Lattice_3::Point& g : centers) CHECK(field.functions().index(g) != Field::npos);
  CHECK(field.coefficients().isZero(0));
  CHECK(*field.value(point_in_cell(field, 0, 0.5, 0.5, 0.5)) == 0);
}

TEST_CASE("Uniform field: tricubic polynomials are reproduced, with first and second derivatives")
{
  CGAL::Random random(2);
  Field field(sparse_cells(random, -2, 2, 0.6));
  // Coefficients are in units of the lattice, and not symmetric.
  const auto factor = [](int a, int b, int c) { return (1 + a + 5 * b * b + 11 * c) % 13 - 6; };
  // The spline coefficient of x^n at g is its polar form at (g-1, g, g+1). For integer coefficients, 3 x^2 replaces
  // x^2.
  const auto polar = [](int n, int g) { return n == 0 ? 1 : n == 1 ? g : n == 2 ? 3 * g * g - 1 : g * g * g - g; };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(field.number_of_coefficients());
  for(Field::Cell_index g = 0; g < field.number_of_coefficients(); ++g) {
    const BS::Lattice_3::Point& p = field.functions().point(g);
    for(int a = 0; a < 4; ++a)
      for(int b = 0; b < 4; ++b)
        for(int c = 0; c < 4; ++c) x[g] += factor(a, b, c) * polar(a, p[0]) * polar(b, p[1]) * polar(c, p[2]);
  }
  field.set_coefficients(x);
  // Returns the n-th derivative of x^a (of 3 x^2 for a = 2).
  const auto power = [](const Rational& u, int a, int n) {
    Rational r(a == 2 ? 3 : 1);
    for(int m = 0; m < n; ++m) r *= a - m;
    for(int m = n; m < a; ++m) r *= u;
    return r;
  };
  const auto polynomial = [&](const Exact_point& u, const std::array<int, 3>& order) {
    Rational sum(0);
    for(int a = 0; a < 4; ++a)
      for(int b = 0; b < 4; ++b)
        for(int c = 0; c < 4; ++c)
          sum += factor(a, b, c) * power(u[0], a, order[0]) * power(u[1], b, order[1]) * power(u[2], c, order[2]);
    for(int m = 0; m < order[0] + order[1] + order[2]; ++m) sum /= Rational(field.cells().width());
    return sum;
  };
  for(Field::Cell_index c = 0; c < field.number_of_cells(); ++c) {
    const Point p = point_in_cell(field, c, random.get_double(), random.get_double(), random.get_double());
    REQUIRE(field.locate(p) == c);
    const Exact_point u = lattice_coordinates(field, exact(p));
    CHECK(exact_value(field, exact(p)) == polynomial(u, { 0, 0, 0 })); // checks the oracle as well
    CHECK(off(*field.value(p), polynomial(u, { 0, 0, 0 })) <= tolerance(field, c));
    const Field::Vector_3 gradient = *field.gradient(p);
    const Eigen::Matrix3d hessian = *field.hessian(p);
    for(int a = 0; a < 3; ++a) {
      std::array<int, 3> first = { 0, 0, 0 };
      first[a] = 1;
      CHECK(off(gradient[a], polynomial(u, first)) <= tolerance(field, c, 1));
      for(int b = 0; b < 3; ++b) CHECK(off(hessian(a, b), polynomial(u, derivative(a, b))) <= tolerance(field, c, 2));
    }
  }
}

TEST_CASE("Uniform field: value, gradient and Hessian agree with Eq. 3.3")
{
  CGAL::Random random(3);
  Field field(sparse_cells(random, -2, 2, 0.4));
  field.set_coefficients(random_coefficients(random, field.number_of_coefficients()));
  for(int n = 0; n < 40; ++n) {
    const Field::Cell_index c = random.get_int(0, int(field.number_of_cells()));
    const Point p = point_in_cell(field, c, random.get_double(), random.get_double(), random.get_double());
    CHECK(off(*field.value(p), exact_value(field, exact(p))) <= tolerance(field, c));
    const Field::Vector_3 gradient = *field.gradient(p);
    const Eigen::Matrix3d hessian = *field.hessian(p);
    for(int a = 0; a < 3; ++a) {
      std::array<int, 3> first = { 0, 0, 0 };
      first[a] = 1;
      CHECK(off(gradient[a], exact_value(field, exact(p), first)) <= tolerance(field, c, 1));
      for(int b = 0; b < 3; ++b)
        CHECK(off(hessian(a, b), exact_value(field, exact(p), derivative(a, b))) <= tolerance(field, c, 2));
    }
  }
}

TEST_CASE("Uniform field: derivatives agree with difference quotients")
{
  CGAL::Random random(4);
  Field field(sparse_cells(random, -1, 1, 1));
  field.set_coefficients(random_coefficients(random, field.number_of_coefficients()));
  const double w = field.cells().width(), h = 1e-4 * w;
  for(int n = 0; n < 50; ++n) {
    const Point p = point_in_cell(field, random.get_int(0, 27), random.get_double(.1, .9), random.get_double(.1, .9),
                                  random.get_double(.1, .9));
    for(int a = 0; a < 3; ++a) {
      const Field::Vector_3 step(a == 0 ? h : 0, a == 1 ? h : 0, a == 2 ? h : 0);
      // Third derivatives are at most 8 / w^3, so the error of the quotient is 8/6 h^2 / w^3, plus a few eps / h.
      const double error = 2e-8 / w;
      CHECK(((*field.value(p + step) - *field.value(p - step)) / (2 * h))
            == Approx((*field.gradient(p))[a]).margin(error));
      const Field::Vector_3 second = (*field.gradient(p + step) - *field.gradient(p - step)) / (2 * h);
      for(int b = 0; b < 3; ++b) CHECK(second[b] == Approx((*field.hessian(p))(a, b)).margin(20 * error / w));
    }
  }
}

TEST_CASE("Uniform field: adjacent cells agree on their common face in value, gradient and Hessian")
{
  CGAL::Random random(5);
  Field field(sparse_cells(random, -1, 2, 0.5));
  field.set_coefficients(random_coefficients(random, field.number_of_coefficients()));
  typedef BS::Cubic_bspline<Rational> Basis;
  // Returns a derivative of one cell's polynomial, exactly, from the cell's 64 coefficients.
  const auto on_cell = [&](Field::Cell_index c, const Exact_point& p, const std::array<int, 3>& order) {
    const std::array<double, 64> local = field.local_coefficients(c);
    Basis::Weights w[3];
    for(int a = 0; a < 3; ++a) {
      const Rational t = (p[a] - Rational(field.cells().corner(c)[a])) / Rational(field.cells().width());
      w[a] = order[a] == 0   ? Basis::values(t)
             : order[a] == 1 ? Basis::first_derivatives(t)
                             : Basis::second_derivatives(t);
    }
    Rational sum(0);
    for(int n = 0; n < 64; ++n) sum += Rational(local[n]) * w[0][n % 4] * w[1][n / 4 % 4] * w[2][n / 16];
    for(int m = 0; m < order[0] + order[1] + order[2]; ++m) sum /= Rational(field.cells().width());
    return sum;
  };
  const std::vector<std::array<int, 3> > orders = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 2, 0, 0 },
                                                    { 0, 2, 0 }, { 0, 0, 2 }, { 1, 1, 0 }, { 1, 0, 1 }, { 0, 1, 1 } };
  int faces = 0;
  for(Field::Cell_index c = 0; c < field.number_of_cells(); ++c)
    for(int a = 0; a < 3; ++a) {
      Field::Cell_index n = Field::npos;
      if(!field.visit_neighbors(c, a, true, [&](Field::Cell_index neighbor) { n = neighbor; })) continue;
      ++faces;
      double t[3] = { 0.25, 0.625, 0.375 };
      t[a] = 1;
      const Point p = point_in_cell(field, c, t[0], t[1], t[2]);
      REQUIRE(p[a] == field.cells().corner(n)[a]);
      for(const std::array<int, 3>& order : orders) {
        const Rational value = on_cell(c, exact(p), order);
        CHECK(value == on_cell(n, exact(p), order));
        CHECK(value == exact_value(field, exact(p), order));
      }
      // The rounded copies agree within their tolerances.
      CHECK(std::abs(field.cell(c).value(p) - field.cell(n).value(p)) <= tolerance(field, c) + tolerance(field, n));
    }
  CHECK(faces > 20);
}

TEST_CASE("Uniform field: the error radius bounds the rounding of a cell's Bernstein coefficients")
{
  CGAL::Random random(6);
  Field field(sparse_cells(random, -1, 1, 0.7));
  for(double scale : { 1., 1e200, 1e-200, 1e-310 }) {
    Eigen::VectorXd x = random_coefficients(random, field.number_of_coefficients());
    for(Eigen::Index n = 0; n < x.size(); ++n) x[n] = scale == 1. ? x[n] + 1000 * (n % 2) : scale * x[n];
    field.set_coefficients(x);
    int rounded = 0;
    for(Field::Cell_index c = 0; c < field.number_of_cells(); ++c) {
      const std::array<double, 64> local = field.local_coefficients(c);
      std::vector<Rational> b(local.begin(), local.end());
      for(int stride : { 1, 4, 16 })
        for(int n = 0; n < 64; ++n) {
          if(n / stride % 4 != 0) continue;
          const auto r = BS::Cubic_bspline<Rational>::bernstein_coefficients(
            { b[n], b[n + stride], b[n + 2 * stride], b[n + 3 * stride] });
          for(int m = 0; m < 4; ++m) b[n + m * stride] = r[m];
        }
      // Both functions are Bernstein forms, so they nowhere differ by more than their coefficients.
      const Rational radius(field.cell(c).error_radius());
      double largest = 0;
      for(double y : local) largest = (std::max)(largest, std::abs(y));
      bool within = true;
      for(int n = 0; n < 64; ++n) {
        const Rational difference = Rational(field.cell(c).coefficients()[n]) - b[n];
        within = within && difference <= radius && -difference <= radius;
        rounded += difference != 0;
      }
      CAPTURE(scale);
      CHECK(within);
      if(scale > 1e-300) CHECK(field.cell(c).error_radius() <= 1e-14 * largest);
    }
    CHECK(rounded > 100); // rounding occurs, so the test is not vacuous
  }
}

TEST_CASE("Uniform field: a cell is unknown if sums of multiples of its coefficients overflow")
{
  CGAL::Random random(7);
  Field field(sparse_cells(random, -1, 1, 0.7));
  Eigen::VectorXd x = Eigen::VectorXd::Ones(Eigen::Index(field.number_of_coefficients()));
  for(double large : { 1e305, 1e306, -1e306, 1.7e308 }) {
    CAPTURE(large);
    x[0] = large;
    field.set_coefficients(x);
    std::size_t affected = 0, claimed = 0;
    for(Field::Cell_index c = 0; c < field.number_of_cells(); ++c) {
      const std::array<double, 64> local = field.local_coefficients(c);
      const bool is_known = std::isfinite(field.cell(c).error_radius());
      if(std::find(local.begin(), local.end(), large) == local.end()) CHECK(is_known);
      else {
        ++affected;
        claimed += is_known;
      }
    }
    CHECK(affected > 0);
    CHECK(claimed == (large == 1e305 ? affected : 0));
  }
}

TEST_CASE("Uniform field: a cell's polynomial is within the error radius of Eq. 3.3, evaluated exactly")
{
  CGAL::Random random(7);
  Field field(sparse_cells(random, -1, 1, 0.7));
  field.set_coefficients(random_coefficients(random, field.number_of_coefficients()));
  for(int n = 0; n < 30; ++n) {
    const Field::Cell_index c = random.get_int(0, int(field.number_of_cells()));
    // includes corners and faces
    const Rational t[3] = { Rational(n % 3) / 2, Rational(n % 5) / 4, Rational(n % 7) / 6 };
    Exact_point p;
    std::array<Rational, 4> b[3];
    for(int a = 0; a < 3; ++a) {
      p[a] = Rational(field.cells().corner(c)[a]) + t[a] * Rational(field.cells().width());
      const Rational s = 1 - t[a];
      b[a] = { s * s * s, 3 * s * s * t[a], 3 * s * t[a] * t[a], t[a] * t[a] * t[a] };
    }
    Rational polynomial(0);
    for(int m = 0; m < 64; ++m)
      polynomial += Rational(field.cell(c).coefficients()[m]) * b[0][m % 4] * b[1][m / 4 % 4] * b[2][m / 16];
    const Rational difference = polynomial - exact_value(field, p);
    CHECK(CGAL::abs(difference) <= Rational(field.cell(c).error_radius()));
  }
}

TEST_CASE("Uniform field: there is no value outside the cells")
{
  CGAL::Random random(8);
  Field field(sparse_cells(random, -1, 1, 1));
  field.set_coefficients(random_coefficients(random, field.number_of_coefficients()));
  const Field::Cell_index last = Field::Cell_index(field.number_of_cells() - 1);
  const Point corner = point_in_cell(field, last, 1, 1, 1);
  CHECK(field.value(corner).has_value()); // the domain is closed
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for(const Point& p : { Point(std::nextafter(corner.x(), inf), corner.y(), corner.z()),
                         Point(corner.x(), corner.y(), std::nextafter(corner.z(), inf)), Point(0, 0, 0),
                         Point(nan, 0, 0), Point(corner.x(), -inf, 0) }) {
    CHECK(field.locate(p) == Field::npos);
    CHECK_FALSE(field.value(p));
    CHECK_FALSE(field.gradient(p));
    CHECK_FALSE(field.hessian(p));
  }
  CHECK_FALSE(Field().value(corner));
}

TEST_CASE("Uniform field: setting coefficients in parallel yields the same cells, bit for bit")
{
  CGAL::Random random(9);
  Field sequential(sparse_cells(random, -5, 5, 0.8)); // enough for several chunks
  REQUIRE(sequential.number_of_cells() > 1000);
  Field parallel = sequential;
  const Eigen::VectorXd x = random_coefficients(random, sequential.number_of_coefficients());
  sequential.set_coefficients<CGAL::Sequential_tag>(x);
  parallel.set_coefficients<CGAL::Parallel_if_available_tag>(x);
  CHECK(sequential.coefficients() == x);
  CHECK(parallel.coefficients() == x);
  std::size_t different = 0;
  for(Field::Cell_index c = 0; c < sequential.number_of_cells(); ++c) {
    const BS::Tricubic_cell_3 a = sequential.cell(c), b = parallel.cell(c);
    different += !std::equal(a.coefficients(), a.coefficients() + 64, b.coefficients())
                 || a.error_radius() != b.error_radius();
  }
  CHECK(different == 0);
}
} // namespace test_Uniform_bspline_field_3
