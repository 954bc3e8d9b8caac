// Slope_enforcement.h, Slope_condition.h: conditions are met at the least cost, close to where they were violated.
// Infeasible conditions do no harm.
#include "fit_problem.h"
#include "random_hierarchies.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Fit/Slope_enforcement.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace test_Slope_enforcement {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Sequential_tag Tag;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef Field::Cell_index Index;
typedef BS::Slope_enforcement<Field> Enforcement;
typedef BS::Slope_condition Condition;
typedef Eigen::VectorXd Vector;
typedef Eigen::SparseMatrix<double> Matrix;

const double inf = std::numeric_limits<double>::infinity();
// relative excess of solutions over the requested slopes
constexpr double excess = 0.05;

// A quadratic energy of fields on some cells, and its minimizer.
struct Problem
{
  Field field;
  Matrix A;    // lower triangle
  Vector b, x; // in units of the width of root cells

  double width() const { return field.cells().lattice().spacing(); }
  void minimize() { x = Eigen::SimplicialLDLT<Matrix>(A).solve(b); }
  Eigen::MatrixXd dense() const { return Matrix(A.selfadjointView<Eigen::Lower>()); }
  double energy(const Vector& y) const { return y.dot(A.selfadjointView<Eigen::Lower>() * y) - 2 * b.dot(y); }

  Field field_of(const Vector& y) const
  {
    Field f = field;
    f.set_coefficients(y * width());
    return f;
  }
  Condition condition(const Point_3& p, const Vector_3& d, double least, double largest = inf) const
  {
    const Index c = field.locate(p);
    REQUIRE(c != Field::npos);
    const double length = std::sqrt(d.squared_length());
    return { c,     0,      field.cell(c).local_coordinates(p), { d.x() / length, d.y() / length, d.z() / length },
             least, largest };
  }
  Point_3 point(const Condition& c) const
  {
    const std::array<double, 3> corner = field.cells().corner(c.cell);
    const double w = field.cells().width(c.cell);
    return Point_3(corner[0] + w * c.position[0], corner[1] + w * c.position[1], corner[2] + w * c.position[2]);
  }
  // Returns by how much a condition is exceeded, according to the field's own values and gradients.
  double slack(const Condition& c, const Field& f) const
  {
    const Vector_3 g = f.gradient(point(c)).value();
    return (std::min)(g.x() * c.direction[0] + g.y() * c.direction[1] + g.z() * c.direction[2] - c.least,
                      c.largest - std::abs(f.value(point(c)).value()) / width());
  }
  double least_slack(const std::vector<Condition>& conditions, const Vector& y) const
  {
    const Field f = field_of(y);
    double least = inf;
    for(const Condition& c : conditions) least = (std::min)(least, slack(c, f));
    return least;
  }
  std::vector<std::uint32_t> violated_cells(const std::vector<Condition>& conditions, const Vector& y) const
  {
    const Field f = field_of(y);
    std::set<std::uint32_t> cells;
    for(const Condition& c : conditions)
      if(slack(c, f) < 0) cells.insert(c.cell);
    return std::vector<std::uint32_t>(cells.begin(), cells.end());
  }
};

// Returns the energy of a mesh, on cells that are refined around a point.
Problem problem_of(const Mesh& mesh, double gamma, const Point_3& refined_at, int levels, double zeta = 1)
{
  BS::Input_mesh_3 input;
  REQUIRE(input.build<Tag>(mesh, get(CGAL::vertex_point, mesh), {}) == BS::Shell_status::SUCCESS);
  const BS::Lattice_3 lattice(input.bbox(), input.unit() / gamma);
  Hierarchy cells(Root_cells(lattice, BS::dilate(BS::cells_entered_by_mesh<Tag>(input, lattice), -1, 1)));
  while(cells.number_of_levels() < levels) cells = cells.refined({ cells.locate(refined_at) });
  Problem problem;
  problem.field = Field(cells);
  const BS::Clipped_mesh_3 clipped = BS::clip_mesh_to_cells<Tag>(input, cells);
  const std::vector<double> samples = BS::sample_signed_distance<Tag>(BS::Mesh_signed_distance_3(input), cells);
  Energy_weights weights;
  weights.zeta = zeta;
  weights.surface = 1;
  BS::Fit_energy<Field>(problem.field, samples, clipped, input.unit() / lattice.spacing(), weights)
    .assemble<Tag>(problem.A, problem.b);
  problem.minimize();
  return problem;
}

// Returns an energy of a bar of nine root cells, with smaller cells at one end. It requests the function z at random
// points, and small coefficients.
Problem bar(unsigned seed = 1)
{
  CGAL::Random random(seed);
  Hierarchy cells(some_cells(random, BS::Lattice_3::from_origin({ 0, 0, 0 }, 0.5, { 0, 0, 0 }, { 8, 0, 0 }),
                             { 0, 0, 0 }, { 8, 0, 0 }));
  cells = cells.refined({ cells.locate(Point_3(0.1, 0.1, 0.1)) });
  Problem problem;
  problem.field = Field(cells);
  REQUIRE(problem.field.number_of_levels() == 2);
  const Eigen::Index size = Eigen::Index(problem.field.number_of_coefficients());
  Eigen::MatrixXd A = 0.05 * Eigen::MatrixXd::Identity(size, size);
  problem.b = Vector::Zero(size);
  for(int n = 0; n < 600; ++n) {
    const Index c = Index(random.get_int(0, int(cells.number_of_cells())));
    std::array<std::array<double, 4>, 3> value;
    std::array<double, 3> t;
    for(int a = 0; a < 3; ++a) value[a] = BS::Cubic_bspline<>::values(t[a] = random.get_double());
    Vector row = Vector::Zero(size);
    problem.field.visit_coefficients(c, [&](int m, Index u, double weight) {
      row[u] += weight * value[0][m % 4] * value[1][m / 4 % 4] * value[2][m / 16];
    });
    A += row * row.transpose();
    problem.b += row * (cells.corner(c)[2] + t[2] * cells.width(c)) / problem.width();
  }
  problem.A = Eigen::MatrixXd(A.triangularView<Eigen::Lower>()).sparseView();
  problem.minimize();
  return problem;
}

// Returns the row of a slope for the free coefficients. Slopes are linear, so fields of unit coefficients are exact up
// to rounding.
Vector slope_row(const Problem& problem, const Condition& c)
{
  Vector row(Eigen::Index(problem.field.number_of_coefficients()));
  for(Eigen::Index n = 0; n < row.size(); ++n) {
    Vector unit = Vector::Zero(row.size());
    unit[n] = 1;
    const Vector_3 g = problem.field_of(unit).gradient(problem.point(c)).value();
    row[n] = g.x() * c.direction[0] + g.y() * c.direction[1] + g.z() * c.direction[2];
  }
  return row;
}

// Returns the step that minimizes s.H.s - 2 r.s under G s >= least. It tries all sets of active conditions.
Vector brute_force(const Eigen::MatrixXd& H, const Vector& r, const Eigen::MatrixXd& G, const Vector& least)
{
  const Eigen::LDLT<Eigen::MatrixXd> factor(H);
  for(int set = 0; set < 1 << G.rows(); ++set) {
    std::vector<Eigen::Index> active;
    for(Eigen::Index i = 0; i < G.rows(); ++i)
      if(set >> i & 1) active.push_back(i);
    Eigen::MatrixXd rows(Eigen::Index(active.size()), G.cols());
    Vector target(Eigen::Index(active.size()));
    for(std::size_t i = 0; i < active.size(); ++i) {
      rows.row(Eigen::Index(i)) = G.row(active[i]);
      target[Eigen::Index(i)] = least[active[i]];
    }
    Vector step = factor.solve(r);
    bool is_optimal = true;
    if(!active.empty()) {
      const Eigen::MatrixXd inverse = factor.solve(rows.transpose());
      const Vector multipliers = (rows * inverse).fullPivLu().solve(target - rows * step);
      step += inverse * multipliers;
      is_optimal = multipliers.minCoeff() >= 0;
    }
    if(is_optimal && (G * step - least).minCoeff() >= -1e-9) return step;
  }
  FAIL("no optimum");
  return Vector();
}

// Returns conditions along z at random points. The minimizer violates them if the slope is larger than one.
std::vector<Condition> random_conditions(const Problem& problem, CGAL::Random& random, int number, double least)
{
  std::vector<Condition> conditions;
  for(int n = 0; n < number; ++n)
    conditions.push_back(problem.condition(
      Point_3(random.get_double(0.01, 4.49), random.get_double(0.01, 0.49), random.get_double(0.01, 0.49)),
      Vector_3(random.get_double(-0.5, 0.5), random.get_double(-0.5, 0.5), 1), least));
  return conditions;
}

} // namespace

TEST_CASE("Slopes: at an apex, the field attains the slope that the cone allows on all facets")
{
  const int sides = 8;
  for(double height : { 2., 5. }) {
    const Mesh mesh = pyramid(sides, height);
    const Point_3 apex(0, 0, height);
    const double inradius = std::cos(std::acos(-1.) / sides),
                 margin = inradius / std::sqrt(height * height + inradius * inradius);
    REQUIRE(BS::vertex_cone_margin(mesh, Mesh::Vertex_index(0)) == Approx(margin));
    Problem problem = problem_of(mesh, 2 * height, apex, 3);
    // A field of slope one along the axis has the slope `margin` across all facets. Most of this is requested.
    std::vector<Condition> conditions;
    for(auto h : CGAL::halfedges_around_target(Mesh::Vertex_index(0), mesh)) {
      const Point_3 &q = mesh.point(mesh.target(mesh.next(h))), &r = mesh.point(mesh.source(h));
      const Vector_3 n = CGAL::cross_product(q - apex, r - apex);
      for(double s : { 0., 0.02, 0.05, 0.1, 0.2 })
        for(double t : { 0., 0.5, 1. })
          conditions.push_back(problem.condition(apex + s * (q - apex + t * (r - q)), n, 0.6 * margin));
    }
    Vector x = problem.x;
    const std::vector<std::uint32_t> violated = problem.violated_cells(conditions, x);
    REQUIRE_FALSE(violated.empty());
    Enforcement enforce(problem.field, problem.A, problem.b);
    enforce.insert(conditions);
    const BS::Slope_report report = enforce(x);
    CHECK(report.enforced);
    CHECK(report.violated_before == violated.size());
    CHECK(report.patches > 0);
    CHECK(report.violated_cells.empty());
    CHECK(problem.least_slack(conditions, x) >= 0);
    CHECK(problem.field_of(x).gradient(apex).value().z() >= 0.6);
    // By definition of the minimizer, the energy is larger.
    CHECK(problem.energy(x) > problem.energy(problem.x));
    // Far from the apex, nothing changes.
    for(Index n = 0; n < problem.field.number_of_coefficients(); ++n)
      if(problem.field.support(n).zmax() < 0.4 * height) CHECK(x[n] == problem.x[n]);
    for(const Condition& c : conditions)
      CHECK(problem.field_of(x).gradient(problem.point(c)).value().squared_length() < 9);
  }
}

TEST_CASE("Slopes: each step is optimal for the coefficients near the violated cell, as an exhaustive search confirms")
{
  for(unsigned seed = 1; seed < 4; ++seed) {
    const Problem problem = bar(seed);
    CGAL::Random random(seed);
    // a small leaf; a coarse leaf next to small ones; a leaf with coarse neighbors
    for(double x0 : { 0.3, 1.6, 3.2 }) {
      const Index center = problem.field.locate(Point_3(x0, 0.2, 0.2));
      std::vector<Condition> conditions;
      for(int n = 0; n < 5; ++n) {
        std::array<double, 3> t, corner = problem.field.cells().corner(center);
        for(int a = 0; a < 3; ++a)
          t[a] = corner[a] + random.get_double(0.05, 0.95) * problem.field.cells().width(center);
        conditions.push_back(problem.condition(
          Point_3(t[0], t[1], t[2]), Vector_3(random.get_double(-0.5, 0.5), random.get_double(-0.5, 0.5), 1), 1.3));
        CHECK(conditions.back().cell == center);
        REQUIRE(problem.least_slack({ conditions.back() }, problem.x) < 0);
      }
      // coefficients that act on leaves at a distance of at most half a width
      std::set<Index> free;
      CGAL::Bbox_3 b = problem.field.cell(center).bbox();
      const double m = problem.field.cells().width(center) / 2;
      b = CGAL::Bbox_3(b.xmin() - m, b.ymin() - m, b.zmin() - m, b.xmax() + m, b.ymax() + m, b.zmax() + m);
      for(Index c = 0; c < problem.field.number_of_cells(); ++c)
        if(CGAL::do_overlap(b, problem.field.cell(c).bbox()))
          problem.field.visit_coefficients(c, [&](int, Index u, double) { free.insert(u); });
      REQUIRE(free.size() < problem.field.number_of_coefficients());
      const Eigen::Index size = Eigen::Index(free.size());
      const Eigen::MatrixXd A = problem.dense();
      const Vector residual = problem.b - A * problem.x;
      const std::vector<Index> unknowns(free.begin(), free.end());
      Eigen::MatrixXd H(size, size), G(Eigen::Index(conditions.size()), size);
      Vector r(size), least(G.rows());
      for(Eigen::Index n = 0; n < size; ++n) {
        r[n] = residual[unknowns[n]];
        for(Eigen::Index m = 0; m < size; ++m) H(m, n) = A(unknowns[m], unknowns[n]);
      }
      for(Eigen::Index i = 0; i < G.rows(); ++i) {
        const Vector row = slope_row(problem, conditions[i]);
        for(Eigen::Index n = 0; n < size; ++n) G(i, n) = row[unknowns[n]];
        least[i] = conditions[i].least - row.dot(problem.x);
      }
      const auto best = [&](double part) {
        const Vector step = brute_force(H, r, G, Vector(least.array() + part * 1.3));
        Vector y = problem.x;
        for(Eigen::Index n = 0; n < size; ++n) y[unknowns[n]] += step[n];
        return y;
      };
      Vector x = problem.x;
      Enforcement enforce(problem.field, problem.A, problem.b);
      enforce.insert(conditions);
      const BS::Slope_report report = enforce(x);
      CHECK(report.patches == 1);
      CHECK(report.violated_cells.empty());
      CHECK(problem.least_slack(conditions, x) >= 0);
      const Vector expected = best(excess);
      CHECK((x - expected).norm() < 2e-3 * (expected - problem.x).norm());
      CHECK(problem.energy(x) > problem.energy(best(0)));
    }
  }
}

TEST_CASE("Slopes: satisfied conditions change nothing")
{
  const Problem problem = bar();
  CGAL::Random random(2);
  Vector x = problem.x;
  Enforcement enforce(problem.field, problem.A, problem.b);
  std::vector<Condition> conditions = random_conditions(problem, random, 50, 0);
  for(Condition& c : conditions) {
    c.least = problem.slack(c, problem.field_of(x)) - 1e-9;
    c.largest = std::abs(problem.field_of(x).value(problem.point(c)).value()) / problem.width() + 1e-9;
  }
  enforce.insert(conditions);
  for(std::size_t most : { std::size_t(0), std::size_t(1000) }) {
    const BS::Slope_report report = enforce(x, most);
    CHECK(report.enforced);
    CHECK(report.violated_before == 0);
    CHECK(report.patches == 0);
    CHECK(report.violated_cells.empty());
    CHECK(report.changed_cells.empty());
    CHECK(x == problem.x);
  }
  // without any conditions
  Enforcement none(problem.field, problem.A, problem.b);
  CHECK(none(x).enforced);
  CHECK(x == problem.x);
}

TEST_CASE("Slopes: contradictory conditions are reported, without endless iterations or large coefficients")
{
  const Problem problem = bar();
  const Point_3 p(3.2, 0.2, 0.3);
  const std::vector<Condition> contradiction = { problem.condition(p, Vector_3(0, 0, 1), 2),
                                                 problem.condition(p, Vector_3(0, 0, -1), 2) };
  // one far from the contradiction, and one next to it
  const Condition far = problem.condition(Point_3(0.2, 0.3, 0.1), Vector_3(0, 1, 2), 1.3),
                  near = problem.condition(Point_3(3.7, 0.1, 0.3), Vector_3(0, 0, 1), 1.2);
  std::vector<Condition> conditions = contradiction;
  conditions.push_back(far);
  conditions.push_back(near);
  Vector x = problem.x;
  Enforcement enforce(problem.field, problem.A, problem.b);
  enforce.insert(conditions);
  for(int call = 0; call < 3; ++call) {
    const BS::Slope_report report = enforce(x);
    CHECK(report.enforced);
    CHECK(report.violated_cells == problem.violated_cells(contradiction, x));
    CHECK(report.violated_cells == std::vector<std::uint32_t>{ contradiction[0].cell });
    CHECK(problem.least_slack({ far, near }, x) >= 0);
    if(call > 0) CHECK(report.patches == 0); // already tried
    // Each of the two conditions alone can be met.
    for(const Condition& c : contradiction) {
      Vector y = problem.x;
      Enforcement one(problem.field, problem.A, problem.b);
      one.insert({ c });
      CHECK(one(y).violated_cells.empty());
    }
    CHECK(x.allFinite());
    CHECK((x - problem.x).lpNorm<Eigen::Infinity>() < 10);
  }
  // many conditions, with values that are too small for the requested slopes
  std::vector<Condition> more;
  CGAL::Random random(4);
  for(int n = 0; n < 60; ++n) {
    const Point_3 q(random.get_double(2.6, 2.9), random.get_double(0, 0.5), random.get_double(0, 0.5));
    more.push_back(problem.condition(
      q, Vector_3(random.get_double(-1, 1), random.get_double(-1, 1), random.get_double(-1, 1)), 1e3, 1e-6));
  }
  enforce.insert(more);
  const BS::Slope_report report = enforce(x);
  CHECK_FALSE(report.violated_cells.empty());
  CHECK(x.allFinite());
  CHECK(x.lpNorm<Eigen::Infinity>() < 1e5);
}

TEST_CASE("Slopes: values can be bounded, with or without a slope at the same point")
{
  const Problem problem = bar();
  std::vector<Condition> conditions;
  for(double x0 : { 0.1, 1.1, 2.3, 3.9 })
    for(double t : { 0.1, 0.3, 0.45 }) {
      const Point_3 p(x0, 0.25, t);
      const double size = std::abs(problem.field_of(problem.x).value(p).value()) / problem.width();
      conditions.push_back(problem.condition(p, Vector_3(0, 0, 1), t == 0.3 ? 0.9 : -inf, 0.8 * size));
    }
  // Bounds on values only must not depend on the slope.
  for(Condition& c : conditions)
    if(c.least == -inf) c.least = -1e3;
  REQUIRE(problem.violated_cells(conditions, problem.x).size() >= 4);
  Vector x = problem.x;
  Enforcement enforce(problem.field, problem.A, problem.b);
  enforce.insert(conditions);
  const BS::Slope_report report = enforce(x);
  CHECK(report.violated_cells.empty());
  CHECK(problem.least_slack(conditions, x) >= 0);
  // The same holds for negative values.
  Problem negative = problem;
  negative.b = -problem.b;
  negative.minimize();
  for(Condition& c : conditions) c.direction = { 0, 0, -1 };
  Vector y = negative.x;
  Enforcement enforce_negative(negative.field, negative.A, negative.b);
  enforce_negative.insert(conditions);
  CHECK(enforce_negative(y).violated_cells.empty());
  CHECK(negative.least_slack(conditions, y) >= 0);
  CHECK((x + y).norm() < 1e-6 * x.norm());
}

TEST_CASE("Slopes: if more cells are violated than allowed, nothing changes, and all of them are reported")
{
  const Problem problem = bar();
  CGAL::Random random(3);
  const std::vector<Condition> conditions = random_conditions(problem, random, 20, 1.3);
  const std::vector<std::uint32_t> violated = problem.violated_cells(conditions, problem.x);
  REQUIRE(violated.size() > 4);
  Vector x = problem.x;
  Enforcement enforce(problem.field, problem.A, problem.b);
  enforce.insert(conditions);
  const BS::Slope_report refused = enforce(x, violated.size() - 1);
  CHECK_FALSE(refused.enforced);
  CHECK(refused.violated_before == violated.size());
  CHECK(refused.patches == 0);
  CHECK(refused.violated_cells == violated);
  CHECK(refused.changed_cells.empty());
  CHECK(x == problem.x);
  // exactly the permitted number of cells
  const BS::Slope_report report = enforce(x, violated.size());
  CHECK(report.enforced);
  CHECK(report.violated_cells.empty());
  CHECK(problem.least_slack(conditions, x) >= 0);
}

TEST_CASE("Slopes: conditions can be added after a call, and earlier ones still hold")
{
  const Problem problem = bar();
  CGAL::Random random(5);
  Vector x = problem.x;
  Enforcement enforce(problem.field, problem.A, problem.b);
  std::vector<Condition> all;
  for(int call = 0; call < 4; ++call) {
    // Each call requests larger slopes, so previous solutions do not meet them.
    const std::vector<Condition> more = random_conditions(problem, random, 8, 1.2 + 0.1 * call);
    all.insert(all.end(), more.begin(), more.end());
    REQUIRE(problem.least_slack(all, x) < 0);
    const Vector before = x;
    enforce.insert(more);
    const BS::Slope_report report = enforce(x);
    CHECK(report.violated_before == problem.violated_cells(all, before).size());
    CHECK(report.violated_cells.empty());
    CHECK(problem.least_slack(all, x) >= 0);
    // A second call has nothing to do.
    Vector again = x;
    CHECK(enforce(again).patches == 0);
    CHECK(again == x);
  }
}

TEST_CASE("Slopes: a condition in a new cell is compared with the field that earlier calls changed")
{
  const Problem problem = bar();
  const Condition first = problem.condition(Point_3(3.3, 0.2, 0.3), Vector_3(0, 0, 1), 2);
  Vector x = problem.x;
  Enforcement enforce(problem.field, problem.A, problem.b);
  enforce.insert({ first });
  CHECK(enforce(x).violated_cells.empty());
  // The field has also changed nearby.
  const Field before = problem.field_of(problem.x), after = problem.field_of(x);
  for(double x0 : { 2.2, 2.7, 3.7, 4.2 }) {
    const Point_3 p(x0, 0.3, 0.2);
    const double slope = after.gradient(p).value().z();
    REQUIRE(std::abs(slope - before.gradient(p).value().z()) > 0.01);
    for(double more : { -1e-6, 1e-6 }) {
      const Condition condition = problem.condition(p, Vector_3(0, 0, 1), slope + more);
      REQUIRE(condition.cell != first.cell);
      Vector y = x;
      Enforcement next(enforce);
      next.insert({ condition });
      CHECK(next(y).violated_before == (more > 0 ? 1 : 0));
      CHECK((y == x) == (more < 0));
      CHECK(problem.least_slack({ first, condition }, y) >= 0);
    }
  }
}

TEST_CASE("Slopes: cells in which the field changed are reported")
{
  const Problem problem = bar();
  CGAL::Random random(6);
  std::vector<Condition> conditions = random_conditions(problem, random, 60, 0.1);
  conditions.push_back(problem.condition(Point_3(4.3, 0.2, 0.3), Vector_3(0, 0, 1), 1.5));
  REQUIRE(problem.violated_cells(conditions, problem.x).size() == 1);
  Vector x = problem.x;
  Enforcement enforce(problem.field, problem.A, problem.b);
  enforce.insert(conditions);
  const BS::Slope_report report = enforce(x);
  const Field before = problem.field_of(problem.x), after = problem.field_of(x);
  std::set<std::uint32_t> changed, unchanged;
  for(const Condition& c : conditions) {
    const double* b = before.cell(c.cell).coefficients();
    (std::equal(b, b + 64, after.cell(c.cell).coefficients()) ? unchanged : changed).insert(c.cell);
  }
  CHECK(report.changed_cells == std::vector<std::uint32_t>(changed.begin(), changed.end()));
  CHECK(unchanged.size() > 4);
}

TEST_CASE("Slopes: neither the number of threads nor the order of conditions in different cells matters")
{
  const Mesh mesh = pyramid(6, 4);
  const Problem problem = problem_of(mesh, 16, Point_3(0, 0, 4), 3);
  CGAL::Random random(7);
  std::vector<Condition> conditions;
  for(int n = 0; n < 4000; ++n) {
    const double t = random.get_double(0, 1);
    const Point_3 p(t * random.get_double(-0.4, 0.4), t * random.get_double(-0.4, 0.4), 4 - 2 * t);
    if(problem.field.locate(p) == Field::npos) continue;
    conditions.push_back(problem.condition(p, Vector_3(p.x(), p.y(), 0.1), 0.5));
  }
  const std::vector<std::uint32_t> violated = problem.violated_cells(conditions, problem.x);
  REQUIRE(violated.size() > 10);
  const auto enforced = [&](auto tag, const std::vector<Condition>& list, BS::Slope_report& report) {
    Vector x = problem.x;
    Enforcement enforce(problem.field, problem.A, problem.b);
    enforce.insert(list);
    report = enforce.template operator()<decltype(tag)>(x);
    return x;
  };
  BS::Slope_report one, two, three;
  const Vector x = enforced(CGAL::Sequential_tag(), conditions, one);
  CHECK(one.violated_before == violated.size());
  CHECK(x == enforced(CGAL::Parallel_if_available_tag(), conditions, two));
  CHECK(one.patches == two.patches);
  CHECK(one.violated_cells == two.violated_cells);
  CHECK(one.changed_cells == two.changed_cells);
  std::stable_sort(conditions.begin(), conditions.end(),
                   [](const Condition& a, const Condition& b) { return a.cell > b.cell; });
  CHECK(x == enforced(CGAL::Parallel_if_available_tag(), conditions, three));
  CHECK(one.violated_cells == three.violated_cells);
}

TEST_CASE("Slopes: coefficients without an equation keep their values")
{
  Problem problem = bar();
  const std::vector<Condition> conditions = { { 0, 0, { 0.5, 0.5, 0.5 }, { 0, 0, 1 }, 2 } };
  REQUIRE(problem.least_slack(conditions, problem.x) < 0);
  const Vector before = problem.x;
  // Every third coefficient has no equation.
  Eigen::MatrixXd A = problem.A;
  for(Eigen::Index u = 0; u < before.size(); u += 3) {
    A.row(u).setZero();
    A.col(u).setZero();
  }
  const Eigen::MatrixXd kept = Eigen::MatrixXd(problem.A) - A;
  problem.b -= kept.selfadjointView<Eigen::Lower>() * before;
  for(Eigen::Index u = 0; u < before.size(); u += 3) problem.b[u] = 0;
  problem.A = A.sparseView();
  BS::Slope_enforcement<Field> enforcement(problem.field, problem.A, problem.b);
  enforcement.insert(conditions);
  const BS::Slope_report report = enforcement(problem.x);
  CHECK(report.violated_cells.empty());
  CHECK(problem.least_slack(conditions, problem.x) >= 0);
  std::size_t changed = 0;
  for(Eigen::Index u = 0; u < before.size(); ++u)
    if(u % 3 == 0) CHECK(problem.x[u] == before[u]);
    else changed += problem.x[u] != before[u];
  CHECK(changed > 10);
}
} // namespace test_Slope_enforcement
