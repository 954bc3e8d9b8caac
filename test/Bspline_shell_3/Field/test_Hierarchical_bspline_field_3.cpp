// Splines on cells of different sizes are compared with their definition in exact arithmetic, with polynomials, and
// with themselves on other cells.
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/is_same_in_cell.h>
#include "exact_spline.h"
#include "random_hierarchies.h"

#include <CGAL/Random.h>

#include <Eigen/Eigenvalues>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace test_Hierarchical_bspline_field_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef Field::Cell_index Index;
typedef Field::Point_3 Point;
typedef std::array<int, 3> Order;

const double eps = std::numeric_limits<double>::epsilon();
const BS::Lattice_3 lattice(CGAL::Bbox_3(9, -1, -4, 11, 2, 1), 0.3);

// Returns cells of three levels, with holes and negative coordinates.
Hierarchy some_cells_of_three_sizes(CGAL::Random& random, double share = 0.85)
{
  return random_hierarchy(random, some_cells(random, lattice, { -6, -3, -2 }, { 4, 1, 1 }, share), 3);
}

Eigen::VectorXd random_vector(CGAL::Random& random, std::size_t size)
{
  Eigen::VectorXd x((Eigen::Index(size)));
  for(double& y : x) y = random.get_double(-1, 1);
  return x;
}

// Returns small integers; repeated halving of these is exact.
Eigen::VectorXd random_integers(CGAL::Random& random, std::size_t size)
{
  Eigen::VectorXd x((Eigen::Index(size)));
  for(double& y : x) y = random.get_int(-100, 101);
  return x;
}

const Lattice_point& point(const Field& field, int level, Index n)
{
  return field.points(level).point(n - field.first_point(level));
}

int level_of_point(const Field& field, Index n)
{
  int l = field.number_of_levels() - 1;
  while(n >= field.first_point(l) + field.points(l).size()) --l;
  return l;
}

// Calls visit(cell) for the 64 cells in the support of the function at a lattice point.
template <typename Visitor>
void for_each_cell_of_function(const Lattice_point& g, const Visitor& visit)
{
  for(int k = -2; k <= 1; ++k)
    for(int j = -2; j <= 1; ++j)
      for(int i = -2; i <= 1; ++i) visit(Lattice_point{ g[0] + i, g[1] + j, g[2] + k });
}

// Returns the levels of the smallest and the largest leaf in the support of a function.
std::pair<int, int> levels_under(const Field& field, const Smallest_cells& smallest, int level, const Lattice_point& g)
{
  std::pair<int, int> levels(-1, 100);
  const int s = smallest.size(level);
  for_each_cell_of_function(g, [&](const Lattice_point& p) {
    for(int k = 0; k < s; ++k)
      for(int j = 0; j < s; ++j)
        for(int i = 0; i < s; ++i) {
          const Index c = smallest.leaf({ p[0] * s + i, p[1] * s + j, p[2] * s + k });
          if(c == Field::npos) continue;
          levels.first = (std::max)(levels.first, field.cells().level(c));
          levels.second = (std::min)(levels.second, field.cells().level(c));
        }
  });
  return levels;
}

// The definition: the coefficient of any function of a level, computed from free coefficients by the two-scale
// relation.
class Exact_coefficients
{
public:
  explicit Exact_coefficients(const Field& field) : m_field(&field), m_smallest(field.cells()) {}

  Rational operator()(int level, const Lattice_point& g)
  {
    const auto known = m_known.find({ level, g });
    if(known != m_known.end()) return known->second;
    Rational sum(0);
    if(levels_under(*m_field, m_smallest, level, g).second >= level) {
      const Index n = m_field->first_point(level) + m_field->points(level).index(g);
      sum = Rational(m_field->coefficients()[m_field->coefficient_of_point(n)]);
    } else {
      // B(x) is the sum of (1, 4, 6, 4, 1) / 8 times B(2x - n), n = -2 ... 2.
      const int mask[5] = { 1, 4, 6, 4, 1 };
      const auto half = [](int i) { return int(std::floor(i / 2.)); };
      for(int k = half(g[2]) - 1; k <= half(g[2]) + 1; ++k)
        for(int j = half(g[1]) - 1; j <= half(g[1]) + 1; ++j)
          for(int i = half(g[0]) - 1; i <= half(g[0]) + 1; ++i) {
            const int d[3] = { g[0] - 2 * i, g[1] - 2 * j, g[2] - 2 * k };
            if(std::abs(d[0]) > 2 || std::abs(d[1]) > 2 || std::abs(d[2]) > 2) continue;
            sum += Rational(mask[d[0] + 2] * mask[d[1] + 2] * mask[d[2] + 2]) / 512 * (*this)(level - 1, { i, j, k });
          }
    }
    m_known[{ level, g }] = sum;
    return sum;
  }

  // Returns the field, or a derivative, at local coordinates of a leaf.
  Rational value(Index c, const Exact_point& t, const Order& order)
  {
    const int level = m_field->cells().level(c);
    const Lattice_point& p = m_field->cells().lattice_point(c);
    Rational sum(0);
    for(int k = -1; k <= 2; ++k)
      for(int j = -1; j <= 2; ++j)
        for(int i = -1; i <= 2; ++i)
          sum += (*this)(level, { p[0] + i, p[1] + j, p[2] + k }) * bspline(t[0] - i, order[0])
                 * bspline(t[1] - j, order[1]) * bspline(t[2] - k, order[2]);
    for(int m = 0; m < order[0] + order[1] + order[2]; ++m) sum /= Rational(m_field->cells().width(c));
    return sum;
  }

private:
  const Field* m_field;
  Smallest_cells m_smallest;
  std::map<std::pair<int, Lattice_point>, Rational> m_known;
};

Point point_in_cell(const Field& field, Index c, const std::array<double, 3>& t)
{
  const std::array<double, 3> corner = field.cells().corner(c);
  const double w = field.cells().width(c);
  return Point(corner[0] + t[0] * w, corner[1] + t[1] * w, corner[2] + t[2] * w);
}

Exact_point local(const Field& field, Index c, const Exact_point& p)
{
  Exact_point t;
  for(int a = 0; a < 3; ++a) t[a] = (p[a] - Rational(field.cells().corner(c)[a])) / Rational(field.cells().width(c));
  return t;
}

double off(double x, const Rational& exact)
{
  return std::abs(CGAL::to_double(Rational(Rational(x) - exact)));
}

// Returns an upper bound on the error of an evaluated derivative: the leaf's radius, and roundings of local
// coordinates, weights and sums. The absolute Bernstein weights of a first derivative sum to at most 6; those of a
// second derivative, to at most 36.
double tolerance(const Field& field, Index c, int order)
{
  double largest = 0;
  for(int n = 0; n < 64; ++n) largest = (std::max)(largest, std::abs(field.cell(c).coefficients()[n]));
  const double w = field.cells().width(c);
  return (field.cell(c).error_radius() + 200 * eps * largest) * (order == 0 ? 1 : order == 1 ? 6 / w : 36 / (w * w));
}

// Returns the coefficients of the next level in one octant of a cell.
std::array<double, 64> two_scale(std::array<double, 64> x, int octant)
{
  for(int axis = 0, stride = 1; axis < 3; ++axis, stride *= 4)
    for(int n = 0; n < 64; ++n) {
      if((n / stride) % 4 != 0) continue;
      double* c = &x[n];
      // values at -1/2, 0, 1/2, 1, 3/2 and 2
      const double at[6] = { (c[0] + c[stride]) / 2,
                             (c[0] + 6 * c[stride] + c[2 * stride]) / 8,
                             (c[stride] + c[2 * stride]) / 2,
                             (c[stride] + 6 * c[2 * stride] + c[3 * stride]) / 8,
                             (c[2 * stride] + c[3 * stride]) / 2,
                             0 };
      for(int m = 0; m < 4; ++m) c[m * stride] = at[m + ((octant >> axis) & 1)];
    }
  return x;
}

// Returns all 64 coefficients of a leaf's level that act on the leaf.
std::array<double, 64> local_coefficients(const Field& field, const Eigen::VectorXd& all, Index c)
{
  const std::array<Index, 16> rows = field.coefficient_rows(c);
  std::array<double, 64> x;
  for(int n = 0; n < 64; ++n) x[n] = all[rows[n / 4] + n % 4];
  return x;
}

} // namespace

TEST_CASE(
  "Hierarchical field: each level has the functions acting on its leaves, free unless they act on a larger leaf")
{
  for(unsigned seed = 1; seed <= 3; ++seed) {
    CGAL::Random random(seed);
    const Field field(some_cells_of_three_sizes(random));
    const Smallest_cells smallest(field.cells());
    std::size_t wrong = 0, dependent = 0, points = 0;
    Index free = 0;
    // the finest level comes first
    for(int l = field.number_of_levels() - 1; l >= 0; --l) {
      CHECK(field.first_point(l) == points);
      points += field.points(l).size();
      std::map<Lattice_point, int> acting;
      for(Index c = 0; c < field.number_of_cells(); ++c) {
        if(field.cells().level(c) != l) continue;
        for(int k = -1; k <= 2; ++k)
          for(int j = -1; j <= 2; ++j)
            for(int i = -1; i <= 2; ++i) {
              const Lattice_point& p = field.cells().lattice_point(c);
              acting[{ p[0] + i, p[1] + j, p[2] + k }] = 1;
            }
      }
      CHECK(acting.size() == field.points(l).size());
      for(Index n = 0; n < field.points(l).size(); ++n) {
        const Lattice_point& g = field.points(l).point(n);
        const Index coefficient = field.coefficient_of_point(field.first_point(l) + n);
        wrong += acting.count(g) == 0;
        const std::pair<int, int> levels = levels_under(field, smallest, l, g);
        wrong += (coefficient != Field::npos) != (levels.second >= l);
        if(coefficient == Field::npos) {
          ++dependent;
          wrong += levels.second != l - 1; // the largest leaf is exactly one level coarser
          double sum = 0;
          field.visit_parents(l, g, [&](Index parent, double weight) {
            wrong += parent >= field.number_of_coefficients();
            sum += weight;
          });
          wrong += sum != 1;
          continue;
        }
        wrong += coefficient != free++;
        wrong += field.point_of_coefficient(coefficient) != field.first_point(l) + n;
      }
    }
    CHECK(wrong == 0);
    CHECK(dependent > 100);
    CHECK(field.number_of_points() == points);
    CHECK(field.number_of_coefficients() == free);
    CHECK(field.coefficients().isZero(0));
    CHECK(*field.value(point_in_cell(field, 0, { 0.5, 0.5, 0.5 })) == 0);
  }
}

TEST_CASE("Hierarchical field: around a refined leaf, all functions of the next level exist")
{
  CGAL::Random random(4);
  for(int levels = 1; levels <= 2; ++levels) {
    // The leaf is far from the border; otherwise, some functions would be missing.
    Hierarchy cells(some_cells(random, lattice, { -5, -5, -5 }, { 5, 5, 5 }));
    const std::array<double, 3> middle = { lattice.origin()[0] + 0.1, lattice.origin()[1] + 0.1,
                                           lattice.origin()[2] + 0.1 };
    for(int l = 1; l < levels; ++l) cells = cells.refined({ cells.locate(middle) });
    const Index marked = cells.locate(middle);
    const int l = cells.level(marked) + 1;
    const Lattice_point p = cells.lattice_point(marked);
    const Field field(cells.refined({ marked }));
    int free = 0;
    // Refinement creates ten cells per side, from 2 p - 4 on. Seven functions per side are supported by them.
    for(int k = -2; k < 5; ++k)
      for(int j = -2; j < 5; ++j)
        for(int i = -2; i < 5; ++i) {
          const Index n = field.points(l).index(2 * p[0] + i, 2 * p[1] + j, 2 * p[2] + k);
          REQUIRE(n != Field::npos);
          free += field.coefficient_of_point(field.first_point(l) + n) != Field::npos;
        }
    CHECK(free == 343);
  }
}

TEST_CASE("Hierarchical field: value, gradient and Hessian agree with the definition")
{
  CGAL::Random random(5);
  Field field(some_cells_of_three_sizes(random));
  field.set_coefficients(random_vector(random, field.number_of_coefficients()));
  Exact_coefficients oracle(field);
  for(int n = 0; n < 60; ++n) {
    // leaves of all levels
    const int l = n % 3;
    const Index first = field.cells().first_leaf(l);
    const Index end = l < 2 ? field.cells().first_leaf(l + 1) : Index(field.number_of_cells());
    const Index c = Index(random.get_int(int(first), int(end)));
    const Point p = point_in_cell(field, c, { random.get_double(), random.get_double(), random.get_double() });
    REQUIRE(field.locate(p) == c);
    const Exact_point t = local(field, c, exact(p));
    const std::array<Rational, 64> b = field.bernstein_coefficients<Rational>(c);
    const Rational value = oracle.value(c, t, { 0, 0, 0 });
    CHECK(bernstein_value(b, t, { 0, 0, 0 }) == value);
    CHECK(off(*field.value(p), value) <= tolerance(field, c, 0));
    const Field::Vector_3 gradient = *field.gradient(p);
    const Eigen::Matrix3d hessian = *field.hessian(p);
    for(int a = 0; a < 3; ++a) {
      Order order = { 0, 0, 0 };
      ++order[a];
      CHECK(off(gradient[a], oracle.value(c, t, order)) <= tolerance(field, c, 1));
      ++order[(a + n) % 3];
      CHECK(off(hessian(a, (a + n) % 3), oracle.value(c, t, order)) <= tolerance(field, c, 2));
    }
  }
}

TEST_CASE("Hierarchical field: derivatives agree with difference quotients")
{
  CGAL::Random random(19);
  Field field(some_cells_of_three_sizes(random));
  field.set_coefficients(random_vector(random, field.number_of_coefficients()));
  for(int n = 0; n < 50; ++n) {
    const Index c = Index(random.get_int(0, int(field.number_of_cells())));
    const double w = field.cells().width(c), h = 1e-4 * w;
    const Point p = point_in_cell(field, c,
                                  { random.get_double(.1, .9), random.get_double(.1, .9), random.get_double(.1, .9) });
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

TEST_CASE("Hierarchical field: there is no value outside the cells, which are closed")
{
  CGAL::Random random(8);
  Field field(random_hierarchy(random, some_cells(random, lattice, { -1, -1, -1 }, { 1, 1, 1 }), 3));
  field.set_coefficients(random_vector(random, field.number_of_coefficients()));
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const auto end = [](int a) { return lattice.coordinate(a, 2); };
  const Point corner(end(0), end(1), end(2));
  CHECK(field.value(corner).has_value());
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

TEST_CASE("Hierarchical field: the functions sum to one, and reproduce tricubic polynomials exactly")
{
  CGAL::Random random(6);
  Field field(some_cells_of_three_sizes(random));
  const int levels = field.number_of_levels();
  field.set_coefficients(Eigen::VectorXd::Ones(Eigen::Index(field.number_of_coefficients())));
  std::size_t wrong = 0;
  for(Index c = 0; c < field.number_of_cells(); ++c)
    for(const Rational& b : field.bernstein_coefficients<Rational>(c)) wrong += b != 1;
  CHECK(wrong == 0);
  CHECK(*field.value(point_in_cell(field, 0, { 0.3, 0.7, 0.2 })) == Approx(1).epsilon(1e-14));

  // In units of the smallest cells, the coefficient of x^n is its polar form at (g - h, g, g + h). For integer
  // coefficients, 3 x^2 replaces x^2.
  const auto factor = [](int a, int b, int c) { return (1 + a + 5 * b * b + 11 * c) % 13 - 6; };
  const auto polar = [](int n, int g, int h) {
    return n == 0 ? 1 : n == 1 ? g : n == 2 ? 3 * g * g - h * h : g * g * g - g * h * h;
  };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(field.number_of_coefficients()));
  for(Index n = 0; n < field.number_of_coefficients(); ++n) {
    const Index at = field.point_of_coefficient(n);
    const int l = level_of_point(field, at), h = 1 << (levels - 1 - l);
    const Lattice_point& p = point(field, l, at);
    for(int a = 0; a < 4; ++a)
      for(int b = 0; b < 4; ++b)
        for(int c = 0; c < 4; ++c)
          x[n] += double(factor(a, b, c)) * polar(a, h * p[0], h) * polar(b, h * p[1], h) * polar(c, h * p[2], h);
  }
  field.set_coefficients(x);
  const auto power = [](const Rational& u, int a) {
    return a == 0 ? Rational(1) : a == 1 ? u : a == 2 ? Rational(3 * u * u) : Rational(u * u * u);
  };
  for(int n = 0; n < 200; ++n) {
    const Index c = Index(random.get_int(0, int(field.number_of_cells())));
    const int h = 1 << (levels - 1 - field.cells().level(c));
    const Exact_point t = { Rational(random.get_int(0, 8)) / 7, Rational(random.get_int(0, 8)) / 7,
                            Rational(random.get_int(0, 8)) / 7 };
    Exact_point u;
    for(int a = 0; a < 3; ++a) u[a] = h * (field.cells().lattice_point(c)[a] + t[a]);
    Rational polynomial(0);
    for(int a = 0; a < 4; ++a)
      for(int b = 0; b < 4; ++b)
        for(int d = 0; d < 4; ++d) polynomial += factor(a, b, d) * power(u[0], a) * power(u[1], b) * power(u[2], d);
    CHECK(bernstein_value(field.bernstein_coefficients<Rational>(c), t, { 0, 0, 0 }) == polynomial);
  }
}

TEST_CASE("Hierarchical field: adjacent leaves agree exactly on their common face in value, gradient and Hessian")
{
  CGAL::Random random(7);
  Field field(some_cells_of_three_sizes(random, 0.9));
  field.set_coefficients(random_vector(random, field.number_of_coefficients()));
  int equal = 0, different = 0, edges = 0, differ_in_third = 0;
  std::size_t wrong = 0;
  for(Index c = 0; c < field.number_of_cells(); ++c)
    for(int a = 0; a < 3; ++a) {
      std::vector<Index> neighbors;
      field.visit_neighbors(c, a, true, [&](Index n) { neighbors.push_back(n); });
      for(Index n : neighbors) {
        const int level = field.cells().level(c), other_level = field.cells().level(n);
        // Faces between equal leaves are frequent, so fewer of them are checked.
        if(level == other_level ? c % 64 != 0 : c % 4 != 0) continue;
        ++(level == other_level ? equal : different);
        const std::array<Rational, 64> b = field.bernstein_coefficients<Rational>(c),
                                       d = field.bernstein_coefficients<Rational>(n);
        const Index small = level < other_level ? n : c;
        const Rational w(field.cells().width(c)), v(field.cells().width(n));
        // On the face, derivatives across it are polynomials of degree three in each coordinate. Sixteen points
        // determine these, and all derivatives along the face.
        for(int j = 0; j < 4; ++j)
          for(int i = 0; i < 4; ++i) {
            Exact_point p;
            for(int e = 0; e < 3; ++e) p[e] = Rational(field.cells().corner(small)[e]);
            p[a] = Rational(field.cells().corner(n)[a]);
            p[(a + 1) % 3] += Rational(field.cells().width(small)) * i / 3;
            p[(a + 2) % 3] += Rational(field.cells().width(small)) * j / 3;
            const Exact_point t = local(field, c, p), s = local(field, n, p);
            Order order = { 0, 0, 0 };
            Rational scale_c(1), scale_n(1);
            for(int m = 0; m <= 2; ++m) {
              order[a] = m;
              wrong += bernstein_value(b, t, order) * scale_n != bernstein_value(d, s, order) * scale_c;
              scale_c *= w;
              scale_n *= v;
            }
          }
        // The third derivative, a difference of second ones, may jump.
        const Exact_point begin = { 0, 0, 0 };
        Exact_point one = begin;
        one[a] = 1;
        Order second = { 0, 0, 0 };
        second[a] = 2;
        if(level == other_level)
          differ_in_third += bernstein_value(b, one, second) - bernstein_value(b, begin, second)
                             != bernstein_value(d, one, second) - bernstein_value(d, begin, second);
        // The rounded copies on both sides agree within their tolerances.
        const Point p = point_in_cell(field, small, { 0.3, 0.6, 0.8 });
        std::array<double, 3> q = { p.x(), p.y(), p.z() };
        q[std::size_t(a)] = field.cells().corner(n)[a];
        edges += std::abs(field.cell(c).value(q) - field.cell(n).value(q))
                 > tolerance(field, c, 0) + tolerance(field, n, 0);
      }
    }
  CHECK(wrong == 0);
  CHECK(edges == 0);
  CHECK(equal > 50);
  CHECK(different > 50);
  CHECK(differ_in_third > equal / 2);
}

TEST_CASE("Hierarchical field: the functions are linearly independent")
{
  CGAL::Random random(8);
  const Field field(random_hierarchy(random, some_cells(random, lattice, { -4, 0, 0 }, { 5, 0, 0 }), 3));
  const Eigen::Index size = Eigen::Index(field.number_of_coefficients());
  // values of all functions at points of all leaves
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd on_points(field.number_of_points(), size);
  for(Eigen::Index n = 0; n < size; ++n) on_points.col(n) = field.extend(Eigen::VectorXd::Unit(size, n));
  for(Index c = 0; c < field.number_of_cells(); ++c) {
    const std::array<Index, 16> rows = field.coefficient_rows(c);
    Eigen::MatrixXd local(64, size), values(64, 64);
    for(int n = 0; n < 64; ++n) local.row(n) = on_points.row(rows[n / 4] + n % 4);
    typedef BS::Cubic_bspline<> Basis;
    for(int s = 0; s < 64; ++s)
      for(int n = 0; n < 64; ++n)
        values(s, n) = Basis::values((s % 4) / 3.)[n % 4] * Basis::values((s / 4 % 4) / 3.)[n / 4 % 4]
                       * Basis::values((s / 16) / 3.)[n / 16];
    const Eigen::MatrixXd here = values * local;
    gram += here.transpose() * here;
  }
  const Eigen::VectorXd scale = gram.diagonal().cwiseSqrt().cwiseInverse();
  gram = scale.asDiagonal() * gram * scale.asDiagonal();
  const Eigen::VectorXd spectrum = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram, Eigen::EigenvaluesOnly)
                                     .eigenvalues();
  CAPTURE(size, spectrum[0], spectrum[size - 1]);
  CHECK(field.number_of_levels() == 3);
  CHECK(spectrum[0] > 1e-8 * spectrum[size - 1]);
}

TEST_CASE("Hierarchical field: a field can be represented exactly on finer cells")
{
  for(unsigned seed = 11; seed <= 13; ++seed) {
    CGAL::Random random(seed);
    Hierarchy cells = random_hierarchy(random, some_cells(random, lattice, { -6, -3, -2 }, { 4, 1, 1 }, 0.9),
                                       int(seed - 10));
    Field field(cells);
    field.set_coefficients(random_integers(random, field.number_of_coefficients()));
    // several rounds, with leaves of all sizes
    for(int round = 0; round < 2; ++round) {
      std::vector<Index> leaves = random_leaves(random, cells, 1);
      leaves.push_back(Index(random.get_int(0, int(cells.number_of_cells()))));
      cells = cells.refined(leaves);
    }
    Field finer(cells);
    REQUIRE(finer.number_of_coefficients() > field.number_of_coefficients());
    // For each leaf of the finer field, compute the coefficients of its level that give the old field. Each function
    // must get the same coefficient from all leaves.
    const Eigen::VectorXd all = field.extend(field.coefficients());
    const double unknown = 1e9;
    Eigen::VectorXd wanted = Eigen::VectorXd::Constant(Eigen::Index(finer.number_of_points()), unknown);
    std::size_t contradictions = 0;
    for(Index c = 0; c < finer.number_of_cells(); ++c) {
      const Index coarse = field.locate(point_in_cell(finer, c, { 0.5, 0.5, 0.5 }));
      std::array<double, 64> x = local_coefficients(field, all, coarse);
      for(int l = cells.level(c) - field.cells().level(coarse) - 1; l >= 0; --l) {
        const Lattice_point& p = cells.lattice_point(c);
        x = two_scale(x, ((p[0] >> l) & 1) | ((p[1] >> l) & 1) << 1 | ((p[2] >> l) & 1) << 2);
      }
      const std::array<Index, 16> rows = finer.coefficient_rows(c);
      for(int n = 0; n < 64; ++n) {
        double& y = wanted[rows[n / 4] + n % 4];
        contradictions += y != unknown && y != x[n];
        y = x[n];
      }
    }
    CHECK(contradictions == 0);
    Eigen::VectorXd x((Eigen::Index(finer.number_of_coefficients())));
    for(Index n = 0; n < finer.number_of_coefficients(); ++n) x[n] = wanted[finer.point_of_coefficient(n)];
    // Dependent coefficients have the expected values.
    CHECK((finer.extend(x) == wanted));
    finer.set_coefficients(x);
    for(int n = 0; n < 40; ++n) {
      const Index c = Index(random.get_int(0, int(finer.number_of_cells())));
      const Point p = point_in_cell(finer, c, { 0.125, 0.75, 0.5 });
      const Index coarse = field.locate(p);
      CHECK(bernstein_value(finer.bernstein_coefficients<Rational>(c), local(finer, c, exact(p)), { 0, 0, 0 })
            == bernstein_value(field.bernstein_coefficients<Rational>(coarse), local(field, coarse, exact(p)),
                               { 0, 0, 0 }));
    }
  }
}

TEST_CASE("Hierarchical field: the error radius bounds the rounding of Bernstein coefficients, and is not excessive")
{
  CGAL::Random random(14);
  Field field(some_cells_of_three_sizes(random));
  for(double scale : { 1., 1e200, 1e-200, 1e-310 }) {
    Eigen::VectorXd x = random_vector(random, field.number_of_coefficients());
    for(Eigen::Index n = 0; n < x.size(); ++n) x[n] = scale == 1. ? x[n] + 1000 * (n % 2) : scale * x[n];
    field.set_coefficients(x);
    std::size_t beyond = 0, rounded = 0, idle = 0, dependent = 0;
    double tightest = 0;
    for(Index c = 0; c < field.number_of_cells(); c += 3) {
      const std::array<Rational, 64> b = field.bernstein_coefficients<Rational>(c);
      const double radius = field.cell(c).error_radius();
      double worst = 0, largest = 0;
      for(int n = 0; n < 64; ++n) {
        const Rational difference = CGAL::abs(Rational(field.cell(c).coefficients()[n]) - b[n]);
        beyond += difference > Rational(radius);
        rounded += difference != 0;
        worst = (std::max)(worst, CGAL::to_double(difference));
      }
      bool is_free = true;
      const std::array<Index, 16> rows = field.coefficient_rows(c);
      for(int n = 0; n < 64; ++n) {
        const Index at = rows[n / 4] + n % 4, coefficient = field.coefficient_of_point(at);
        if(coefficient != Field::npos) {
          largest = (std::max)(largest, std::abs(x[coefficient]));
          continue;
        }
        is_free = false;
        const int l = field.cells().level(c);
        field.visit_parents(l, point(field, l, at),
                            [&](Index parent, double) { largest = (std::max)(largest, std::abs(x[parent])); });
      }
      dependent += !is_free;
      idle += scale > 1e-300 && radius > (is_free ? 11 : 38) * eps * largest;
      if(scale > 1e-300) tightest = (std::max)(tightest, worst / radius);
    }
    CAPTURE(scale);
    CHECK(beyond == 0);
    CHECK(idle == 0);
    CHECK(rounded > 1000);
    CHECK(dependent > 30);
    if(scale > 1e-300) CHECK(tightest > 0.01);
  }
}

TEST_CASE("Hierarchical field: the error radius accounts for large coefficients whose averages are small")
{
  // The coefficients of the largest cells have checkerboard signs. Averages of equally many of each sign nearly vanish,
  // up to rounding.
  CGAL::Random random(16);
  Field field(some_cells_of_three_sizes(random, 1));
  Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
  for(Index n = 0; n < field.number_of_coefficients(); ++n) {
    const Index at = field.point_of_coefficient(n);
    const Lattice_point& p = point(field, level_of_point(field, at), at);
    x[n] = level_of_point(field, at) > 0 ? 0 : ((p[0] + p[1] + p[2]) % 2 == 0 ? 1 : -1) * random.get_double(1, 1.001);
  }
  field.set_coefficients(x);
  std::size_t small = 0, beyond = 0;
  for(Index c = 0; c < field.number_of_cells(); ++c) {
    const auto cell = field.cell(c);
    double largest = 0;
    for(int n = 0; n < 64; ++n) largest = (std::max)(largest, std::abs(cell.coefficients()[n]));
    if(largest == 0 || largest > 0.001) continue;
    ++small;
    const std::array<Rational, 64> b = field.bernstein_coefficients<Rational>(c);
    for(int n = 0; n < 64; ++n)
      beyond += CGAL::abs(Rational(cell.coefficients()[n]) - b[n]) > Rational(cell.error_radius());
  }
  CHECK(small > 10);
  CHECK(beyond == 0);
}

TEST_CASE("Hierarchical field: collect() is the transpose of extend()")
{
  CGAL::Random random(15);
  const Field field(some_cells_of_three_sizes(random));
  for(int n = 0; n < 5; ++n) {
    const Eigen::VectorXd x = random_integers(random, field.number_of_coefficients()),
                          y = random_integers(random, field.number_of_points());
    CHECK(field.extend(x).dot(y) == x.dot(field.collect(y))); // exact: sums of multiples of 1/512
  }
  // Free coefficients are kept; dependent ones agree with the definition.
  Field other = field;
  other.set_coefficients(random_vector(random, field.number_of_coefficients()));
  const Eigen::VectorXd all = other.extend(other.coefficients());
  Exact_coefficients oracle(other);
  std::size_t wrong = 0;
  for(Index n = 0; n < field.number_of_points(); ++n) {
    const Index coefficient = field.coefficient_of_point(n);
    const int l = level_of_point(field, n);
    if(coefficient != Field::npos) wrong += all[n] != other.coefficients()[coefficient];
    else wrong += off(all[n], oracle(l, point(field, l, n))) > 20 * eps;
  }
  CHECK(wrong == 0);
}

TEST_CASE("Hierarchical field: a coefficient that is not finite leaves cells unknown where it acts, and nowhere else")
{
  CGAL::Random random(16);
  Field field(some_cells_of_three_sizes(random));
  const Eigen::VectorXd x = random_vector(random, field.number_of_coefficients());
  field.set_coefficients(x);
  for(double bad : { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity() })
    for(int trial = 0; trial < 12; ++trial) {
      Eigen::VectorXd y = x;
      const Index n = Index(random.get_int(0, int(y.size())));
      y[n] = bad;
      Field other = field;
      other.set_coefficients(y);
      // the leaves on which the basis function does not vanish
      const Eigen::VectorXd acting = field.extend(Eigen::VectorXd::Unit(x.size(), n));
      std::size_t claimed = 0, lost = 0, affected = 0;
      for(Index c = 0; c < field.number_of_cells(); ++c) {
        const std::array<double, 64> weights = local_coefficients(field, acting, c);
        if(std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0; })) {
          ++affected;
          claimed += other.cell(c).error_radius() != std::numeric_limits<double>::infinity();
        } else
          lost += other.cell(c).error_radius() != field.cell(c).error_radius()
                  || !std::equal(field.cell(c).coefficients(), field.cell(c).coefficients() + 64,
                                 other.cell(c).coefficients());
      }
      CHECK(claimed == 0);
      CHECK(lost == 0);
      CHECK(affected > 0);
    }
}

TEST_CASE("Hierarchical field: a leaf is unknown if sums of multiples of its coefficients overflow")
{
  CGAL::Random random(20);
  Field field(some_cells_of_three_sizes(random));
  Eigen::VectorXd x = Eigen::VectorXd::Ones(Eigen::Index(field.number_of_coefficients()));
  const Eigen::VectorXd acting = field.extend(Eigen::VectorXd::Unit(x.size(), 0));
  for(double large : { 1e305, 1e306, -1e306, 1.7e308 }) {
    CAPTURE(large);
    x[0] = large;
    field.set_coefficients(x);
    std::size_t affected = 0, claimed = 0;
    for(Index c = 0; c < field.number_of_cells(); ++c) {
      const std::array<double, 64> weights = local_coefficients(field, acting, c);
      const bool is_known = std::isfinite(field.cell(c).error_radius());
      if(std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; })) CHECK(is_known);
      else {
        ++affected;
        claimed += is_known;
      }
    }
    CHECK(affected > 0);
    CHECK(claimed == (large == 1e305 ? affected : 0));
  }
}

TEST_CASE("Hierarchical field: on cells of one size, all coefficients are free, and the field is that of Eq. 3.3")
{
  CGAL::Random random(17);
  const Root_cells roots = some_cells(random, lattice, { -4, -3, -2 }, { 3, 2, 1 }, 0.6);
  Field field(roots);
  REQUIRE(field.number_of_levels() == 1);
  REQUIRE(field.number_of_points() == field.number_of_coefficients());
  REQUIRE(field.number_of_cells() == roots.number_of_cells());
  const Eigen::VectorXd x = random_vector(random, field.number_of_coefficients());
  field.set_coefficients(x);
  CHECK((field.extend(x) == x));
  CHECK((field.collect(x) == x));
  for(Index n = 0; n < field.number_of_points(); ++n) {
    REQUIRE(field.coefficient_of_point(n) == n);
    REQUIRE(field.point_of_coefficient(n) == n);
  }
  for(int n = 0; n < 40; ++n) {
    const Index c = Index(random.get_int(0, int(field.number_of_cells())));
    CHECK(field.cells().lattice_point(c) == roots.lattice_point(c));
    const Point p = point_in_cell(field, c, { random.get_double(), random.get_double(), random.get_double() });
    REQUIRE(field.locate(p) == c);
    const Rational value = exact_value(field, exact(p));
    CHECK(bernstein_value(field.bernstein_coefficients<Rational>(c), local(field, c, exact(p))) == value);
    CHECK(off(*field.value(p), value) <= tolerance(field, c, 0));
    const Field::Vector_3 gradient = *field.gradient(p);
    for(int a = 0; a < 3; ++a) {
      Order order = { 0, 0, 0 };
      order[a] = 1;
      CHECK(off(gradient[a], exact_value(field, exact(p), order)) <= tolerance(field, c, 1));
    }
  }
}

TEST_CASE("Hierarchical field: setting coefficients in parallel yields the same leaves, bit for bit")
{
  CGAL::Random random(18);
  Field sequential(some_cells_of_three_sizes(random));
  REQUIRE(sequential.number_of_cells() > 1000); // enough for several chunks
  Field parallel = sequential;
  const Eigen::VectorXd x = random_vector(random, sequential.number_of_coefficients());
  sequential.set_coefficients<CGAL::Sequential_tag>(x);
  parallel.set_coefficients<CGAL::Parallel_if_available_tag>(x);
  CHECK((sequential.coefficients() == x));
  CHECK((parallel.coefficients() == x));
  std::size_t different = 0;
  for(Index c = 0; c < sequential.number_of_cells(); ++c) {
    const Field::Cell a = sequential.cell(c), b = parallel.cell(c);
    different += !std::equal(a.coefficients(), a.coefficients() + 64, b.coefficients())
                 || a.error_radius() != b.error_radius();
  }
  CHECK(different == 0);
  CHECK(Field().number_of_cells() == 0);
  CHECK(Field().number_of_coefficients() == 0);
}

TEST_CASE("Hierarchical field: changing a few coefficients yields the same leaves as setting all of them, bit for bit")
{
  CGAL::Random random(19);
  const Hierarchy cells = some_cells_of_three_sizes(random);
  Field field(cells);
  field.set_coefficients(random_vector(random, field.number_of_coefficients()));
  for(std::size_t changed : { std::size_t(0), std::size_t(1), std::size_t(20), field.number_of_coefficients() - 1 })
    for(int repetition = 0; repetition < 20; ++repetition) {
      Eigen::VectorXd x = field.coefficients();
      for(std::size_t n = 0; n < changed; ++n)
        x[random.get_int(0, int(x.size()))] = random.get_double(-1, 1) * (n == 0 ? 1e6 : 1);
      Field expected(cells);
      expected.set_coefficients(x);
      const Field found = field.with_coefficients<CGAL::Parallel_if_available_tag>(x);
      CHECK(found.has_cells_of(field));
      CHECK(!found.has_cells_of(expected));
      CHECK((found.coefficients() == x));
      std::size_t different = 0;
      for(Index c = 0; c < field.number_of_cells(); ++c) different += !BS::is_same_in_cell(found, c, expected, c);
      CHECK(different == 0);
    }
}

TEST_CASE("Field with few other coefficients: it shares memory with the field from which it was made")
{
  CGAL::Random random(23);
  Field field(some_cells_of_three_sizes(random));
  REQUIRE(field.number_of_cells() > 500);
  field.set_coefficients(random_vector(random, field.number_of_coefficients()));
  const auto number_of_shared_cells = [&](const Field& other) {
    std::size_t shared = 0;
    for(Index c = 0; c < field.number_of_cells(); ++c)
      shared += field.cell(c).coefficients() == other.cell(c).coefficients();
    return shared;
  };
  Eigen::VectorXd x = field.coefficients();
  CHECK(number_of_shared_cells(field.with_coefficients(x)) == field.number_of_cells());
  x[0] += 1; // acts on few of the cells
  const std::size_t shared = number_of_shared_cells(field.with_coefficients(x));
  CHECK(shared < field.number_of_cells());
  CHECK(shared > field.number_of_cells() / 4);
  x.array() += 1;
  CHECK(number_of_shared_cells(field.with_coefficients(x)) == 0);
}

} // namespace test_Hierarchical_bspline_field_3
