// Solver_traits_adaptor.h: CGAL's solver traits solve the systems of fits.
#include "fit_problem.h"

#include <CGAL/Bspline_shell_3/Fit/Conjugate_gradient_solver.h>
#include <CGAL/Bspline_shell_3/Fit/Solver_traits_adaptor.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Eigen_solver_traits.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include <cmath>

namespace test_Solver_traits_adaptor {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
using BS::Solver_status;
typedef CGAL::Eigen_sparse_matrix<double>::EigenType Matrix;
typedef CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<Matrix> > Direct;        // gets both triangles
typedef CGAL::Eigen_solver_traits<Eigen::SimplicialCholesky<Matrix> > Symmetric; // stores one triangle
typedef CGAL::Eigen_solver_traits<> General;

} // namespace

TEMPLATE_TEST_CASE("Solver traits: a system is solved for several right-hand sides", "", Direct, Symmetric, General)
{
  const Eigen::SparseMatrix<double> lower = lower_triangle(1, 2, 8);
  BS::Solver_traits_adaptor<TestType> solver;
  REQUIRE(solver.compute(lower) == Solver_status::SUCCESS);
  Eigen::VectorXd b(2), x;
  b << 1, 6;
  REQUIRE(solver.solve(b, x) == Solver_status::SUCCESS);
  CHECK(x[0] == Approx(-1).epsilon(1e-12));
  CHECK(x[1] == Approx(1).epsilon(1e-12));
  CHECK(solver.residual() < 1e-12);
  REQUIRE(solver.solve(2 * b, x) == Solver_status::SUCCESS);
  CHECK(x[0] == Approx(-2).epsilon(1e-12));
}

TEST_CASE("Solver traits: a singular matrix is reported as a failure")
{
  const Eigen::SparseMatrix<double> lower = lower_triangle(0, 0, 0);
  BS::Solver_traits_adaptor<Direct> solver;
  Eigen::VectorXd b = Eigen::VectorXd::Ones(2), x;
  CHECK((solver.compute(lower) != Solver_status::SUCCESS || solver.solve(b, x) != Solver_status::SUCCESS));
}

TEST_CASE("Solver traits: a shell can be fitted with solver traits of CGAL")
{
  const auto p = P::resolution(6);
  const auto shell = CGAL::bspline_shell_3(sphere(1), p.spd_solver(BS::Solver_traits_adaptor<Direct>()));
  const auto other = CGAL::bspline_shell_3(sphere(1), p.spd_solver(BS::Conjugate_gradient_solver<>(1e-10)));
  REQUIRE(shell);
  REQUIRE(other);
  CHECK(shell.report().fit.residual < 1e-10);
  // Bounds are refined to 1e-4 of their range.
  CHECK(std::abs(shell.inner_level() - other.inner_level()) < 2e-4 * shell.thickness());
  CHECK(std::abs(shell.outer_level() - other.outer_level()) < 2e-4 * shell.thickness());
}
} // namespace test_Solver_traits_adaptor
