// Any_spd_solver.h: wrong solutions are detected.
#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver.h>

#include <catch2/catch.hpp>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <functional>
#include <limits>
#include <string>

namespace test_Any_spd_solver {
namespace {

namespace BS = CGAL::Bspline_shells;
using BS::Solver_status;
typedef Eigen::SparseMatrix<double> Matrix;
typedef Eigen::VectorXd Vector;

// A solver that applies a function to the exact solution.
struct Solver
{
  Solver_status compute(const Matrix& lower, const BS::Unknown_blocks&)
  {
    matrix = Matrix(lower.selfadjointView<Eigen::Lower>());
    return Solver_status::SUCCESS;
  }
  Solver_status solve(const Vector& b, Vector& x)
  {
    x = change(Eigen::MatrixXd(matrix).ldlt().solve(b));
    return status;
  }
  std::size_t iterations() const { return 1; }
  double residual() const { return 0; }

  std::function<Vector(const Vector&)> change = [](const Vector& x) { return x; };
  Solver_status status = Solver_status::SUCCESS;
  Matrix matrix;
};

// Returns the lower triangle of a positive definite matrix.
Matrix lower_matrix()
{
  const int n = 12;
  Matrix lower(n, n);
  for(int i = 0; i < n; ++i) {
    lower.insert(i, i) = 4;
    if(i > 0) lower.insert(i, i - 1) = -1;
    if(i > 2) lower.insert(i, i - 3) = 0.5;
  }
  lower.makeCompressed();
  return lower;
}

Solver_status status_of(Solver& solver, bool is_checked = true, double scale = 1)
{
  const Matrix lower = scale * lower_matrix();
  const BS::Any_spd_solver any(solver, is_checked), copy(any);
  REQUIRE(copy.compute(lower, BS::Unknown_blocks()) == Solver_status::SUCCESS);
  Vector x = Vector::Ones(lower.cols());
  return any.solve(scale * Vector::LinSpaced(lower.cols(), -1, 2), x);
}

} // namespace

TEST_CASE("SPD solvers: residuals up to a tenth of the right-hand side are accepted, at any scale")
{
  Solver solver;
  for(double scale : { 1e-100, 1., 1e100 }) {
    for(double error : { 0., 1e-9, 0.09 }) {
      solver.change = [&](const Vector& x) { return Vector((1 + error) * x); };
      CHECK(status_of(solver, true, scale) == Solver_status::SUCCESS);
    }
    solver.change = [](const Vector& x) { return Vector(1.11 * x); };
    CHECK(status_of(solver, true, scale) == Solver_status::WRONG_SOLUTION);
  }
}

TEST_CASE("SPD solvers: wrong solutions, values that are not finite, and vectors of the wrong size are detected")
{
  Solver solver;
  for(double value : { 0., 1., -1e9 }) {
    solver.change = [&](const Vector& x) { return Vector::Constant(x.size(), value); };
    CHECK(status_of(solver) == Solver_status::WRONG_SOLUTION);
  }
  for(int size : { 0, 1, 11, 13, 1000 }) {
    solver.change = [&](const Vector&) { return Vector::Zero(size); };
    CHECK(status_of(solver) == Solver_status::WRONG_SOLUTION);
  }
  for(double value : { std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() }) {
    solver.change = [&](const Vector& x) {
      Vector y = x;
      y[3] = value;
      return y;
    };
    CHECK(status_of(solver) == Solver_status::NOT_FINITE);
  }
  // An unsuccessful status is passed on.
  solver.status = Solver_status::NOT_CONVERGED;
  CHECK(status_of(solver) == Solver_status::NOT_CONVERGED);
}

TEST_CASE("SPD solvers: solvers that measure their own residuals are not checked")
{
  Solver solver;
  solver.change = [](const Vector& x) { return Vector(2 * x); };
  CHECK(status_of(solver) == Solver_status::WRONG_SOLUTION);
  CHECK(status_of(solver, false) == Solver_status::SUCCESS);
}

TEST_CASE("SPD solvers: each status has a message")
{
  for(int s = 0; s <= int(Solver_status::WRONG_SOLUTION); ++s)
    CHECK_FALSE(std::string(message(Solver_status(s))).empty());
}
} // namespace test_Any_spd_solver
