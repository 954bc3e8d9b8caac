// fit_field.h and the solvers: fits minimize the energy, and reports are correct, also if a solver fails.
#include "fit_problem.h"

#include <CGAL/Bspline_shell_3/Fit/Conjugate_gradient_solver.h>
#include <CGAL/Bspline_shell_3/Fit/fit_field.h>
#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>
#ifdef HAVE_CHOLMOD
#include <CGAL/Bspline_shell_3/Fit/Cholmod_solver.h>
#endif

#include <functional>
#include <vector>

namespace test_fit_field {
namespace {

namespace BS = CGAL::Bspline_shells;
using BS::Solver_status;
typedef CGAL::Sequential_tag Tag;
typedef BS::Conjugate_gradient_solver<> CG;

const Fit_problem& sphere_problem()
{
  static const Fit_problem problem(sphere(2), 8);
  return problem;
}

const Fit_problem& torus_problem()
{
  static const Fit_problem problem(torus(3, 1.2, 12, 7), 9);
  return problem;
}

Energy_weights quadratic_terms_only(double zeta)
{
  Energy_weights weights;
  weights.zeta = zeta;
  weights.singular_hessian = 0;
  return weights;
}

// A conjugate gradient solver that records its calls, and fails on request.
struct Recording_solver
{
  typedef CG::Matrix Matrix;
  typedef CG::Vector Vector;

  CG solver = CG(1e-8);
  std::vector<Vector> guesses;
  std::size_t computes = 0, all_iterations = 0, fails_at_compute = 0, fails_at_solve = 0; // counted from 1

  Solver_status compute(const Matrix& lower, const BS::Unknown_blocks& blocks)
  {
    if(++computes == fails_at_compute) return Solver_status::NOT_POSITIVE_DEFINITE;
    return solver.compute(lower, blocks);
  }
  Solver_status solve(const Vector& b, Vector& x)
  {
    guesses.push_back(x);
    const Solver_status status = solver.solve(b, x);
    all_iterations += solver.iterations();
    return guesses.size() == fails_at_solve ? Solver_status::NOT_CONVERGED : status;
  }
  std::size_t iterations() const { return solver.iterations(); }
  double residual() const { return solver.residual(); }
};

} // namespace

TEST_CASE("Blocks of unknowns: blocks cover all unknowns, overlap, and are small")
{
  const Fit_problem& problem = sphere_problem();
  const BS::Unknown_blocks blocks = BS::overlapping_blocks(problem.field);
  std::vector<int> times(problem.field.number_of_coefficients(), 0);
  for(std::size_t b = 0; b < blocks.size(); ++b) {
    REQUIRE(blocks.first[b + 1] > blocks.first[b]);
    CHECK(blocks.first[b + 1] - blocks.first[b] <= 125);
    for(std::size_t n = blocks.first[b]; n < blocks.first[b + 1]; ++n) {
      ++times[blocks.unknowns[n]];
      if(n > blocks.first[b]) CHECK(blocks.unknowns[n] > blocks.unknowns[n - 1]);
    }
  }
  CHECK(*std::min_element(times.begin(), times.end()) >= 1);
  CHECK(*std::max_element(times.begin(), times.end()) == 8);
}

TEST_CASE("Blocks of unknowns: blocks save most iterations, and change the solution by no more than the tolerance")
{
  const Fit_problem& problem = sphere_problem();
  const Energy energy = problem.energy(quadratic_terms_only(1e5));
  CG::Matrix A;
  CG::Vector b;
  energy.assemble<CGAL::Sequential_tag>(A, b);
  CG diagonal(1e-8, 100000), schwarz(1e-8);
  BS::Conjugate_gradient_solver<CGAL::Sequential_tag> sequential(1e-8);
  CG::Vector x = CG::Vector::Zero(b.size()), y = x, z = x;
  REQUIRE(diagonal.compute(A) == Solver_status::SUCCESS);
  REQUIRE(diagonal.solve(b, x) == Solver_status::SUCCESS);
  const BS::Unknown_blocks blocks = BS::overlapping_blocks(problem.field);
  REQUIRE(schwarz.compute(A, blocks) == Solver_status::SUCCESS);
  REQUIRE(schwarz.solve(b, y) == Solver_status::SUCCESS);
  CHECK(10 * schwarz.iterations() < diagonal.iterations());
  CHECK((A.selfadjointView<Eigen::Lower>() * y - b).norm() <= 1.1e-8 * b.norm());
  REQUIRE(sequential.compute(A, blocks) == Solver_status::SUCCESS);
  REQUIRE(sequential.solve(b, z) == Solver_status::SUCCESS);
  CHECK((y == z)); // for any number of threads
}

TEST_CASE("Conjugate_gradient_solver solves a system given by its lower triangle")
{
  // The solution of (4 1; 1 3) x = (1; 2) is (1, 7) / 11.
  Eigen::SparseMatrix<double> lower = lower_triangle(4, 1, 3);
  Eigen::VectorXd b(2), x = Eigen::VectorXd::Zero(2);
  b << 1, 2;
  CG solver(1e-14);
  REQUIRE(solver.compute(lower) == Solver_status::SUCCESS);
  REQUIRE(solver.solve(b, x) == Solver_status::SUCCESS);
  CHECK(x[0] == Approx(1 / 11.).epsilon(1e-13));
  CHECK(x[1] == Approx(7 / 11.).epsilon(1e-13));
  CHECK(solver.residual() <= 1e-14);
  CHECK(solver.iterations() <= 3); // the number of unknowns, plus one for a single-precision preconditioner
  // At the solution, nothing is left to do.
  REQUIRE(solver.solve(b, x) == Solver_status::SUCCESS);
  CHECK(solver.iterations() <= 1);
  // One iteration is not enough.
  CG limited(1e-14, 1);
  x.setZero();
  REQUIRE(limited.compute(lower) == Solver_status::SUCCESS);
  CHECK(limited.solve(b, x) == Solver_status::NOT_CONVERGED);
  CHECK(limited.residual() > 1e-14);
}

TEST_CASE("The gradient of the energy vanishes at a fit")
{
  const Fit_problem& problem = torus_problem();
  Energy_weights weights = quadratic_terms_only(1e3);
  weights.surface = 10;
  Energy energy = problem.energy(weights);
  Field field = problem.field;
  CG solver(1e-10, 20000);
  const BS::Fit_report report = BS::fit_field<Tag>(field, energy, solver, energy.initial_guess());
  REQUIRE(report.status == Solver_status::SUCCESS);
  CHECK(report.linear_solves == 1);
  CHECK(report.iterations == solver.iterations());
  CHECK(report.residual <= 1e-10);
  CHECK(report.residual == solver.residual());

  const Eigen::VectorXd x = field.coefficients() / problem.width();
  const auto gradient = [&](const Eigen::VectorXd& y) {
    return Eigen::VectorXd(energy.gradient(Term::DISTANCE, y) + energy.gradient(Term::SURFACE, y)
                           + energy.gradient(Term::ANGLE, y) + energy.gradient(Term::NORMAL, y));
  };
  // The gradient is 2 (A x - b); at zero it is -2 b. The factor two allows for rounding.
  CHECK(gradient(x).norm() <= 2 * 1e-10 * gradient(Eigen::VectorXd::Zero(x.size())).norm());
  // The energy grows in every direction with the square of the step.
  const double least = energy.value(x);
  Deterministic_numbers random(5);
  for(int trial = 0; trial < 5; ++trial) {
    const Eigen::VectorXd d = 1e-2 * random.vector(x.size());
    const double plus = energy.value(Eigen::VectorXd(x + d)) - least,
                 minus = energy.value(Eigen::VectorXd(x - d)) - least;
    CHECK(plus > 0);
    CHECK(plus == Approx(minus).epsilon(1e-4));
  }
  for(Term term : { Term::DISTANCE, Term::SURFACE, Term::ANGLE, Term::NORMAL })
    CHECK(report.energy[std::size_t(term)] == Approx(energy.value(term, x)).epsilon(1e-9));
  CHECK(report.energy[std::size_t(Term::SINGULAR_HESSIAN)] == 0);
}

TEST_CASE("A fit to a sphere is close to its signed distance")
{
  const Fit_problem& problem = sphere_problem();
  Energy energy = problem.energy();
  Field field = problem.field;
  CG solver;
  REQUIRE(BS::fit_field<Tag>(field, energy, solver, energy.initial_guess()).status == Solver_status::SUCCESS);
  // The mesh is inscribed in the sphere, at most 0.04 below it. Half a cell (0.125) is added for the smoothing of
  // edges.
  for(double r : { 0.8, 0.95, 1.1, 1.25 })
    for(const Vector_3& d : { Vector_3(1, 0, 0), Vector_3(0.6, 0, -0.8), Vector_3(-0.48, 0.6, 0.64) }) {
      const Point_3 p = CGAL::ORIGIN + r * d;
      REQUIRE(field.value(p));
      CHECK(std::abs(*field.value(p) - (r - 1)) < 0.165);
      CHECK(*field.gradient(p) * d > 0.7);
      CHECK(*field.gradient(p) * d < 1.3);
    }
}

TEST_CASE("Steps on the singular Hessian never increase the energy, and decrease that term")
{
  for(const Fit_problem* problem : { &sphere_problem(), &torus_problem() }) {
    Energy energy = problem->energy();
    Field field = problem->field;
    Recording_solver solver;
    const BS::Fit_report report = BS::fit_field<Tag>(field, energy, solver, energy.initial_guess());
    REQUIRE(report.status == Solver_status::SUCCESS);
    CHECK(report.linear_solves == solver.guesses.size());
    CHECK(report.linear_solves == solver.computes);
    CHECK(report.iterations == solver.all_iterations);
    REQUIRE(report.linear_solves >= 2);

    // Each step starts from the current solution. Thus the guesses, except for the first, are the solutions of the
    // steps.
    std::vector<Eigen::VectorXd> steps(solver.guesses.begin() + 1, solver.guesses.end());
    steps.push_back(field.coefficients() / problem->width());
    Energy reference = problem->energy();
    const std::pair<double, double> range = reference.range_on_mesh(steps.front());
    reference.set_singular_hessian_domain(steps.front(), range.first, range.second);
    // The last point was multiplied and divided by the width, with errors of a few units in the last place.
    for(std::size_t n = 1; n < steps.size(); ++n)
      CHECK(reference.value(steps[n]) <= reference.value(steps[n - 1]) * (1 + 1e-12));
    const double first = reference.value(Term::SINGULAR_HESSIAN, steps.front()),
                 last = reference.value(Term::SINGULAR_HESSIAN, steps.back());
    CHECK(last < 0.9 * first);
    CHECK(report.energy[std::size_t(Term::SINGULAR_HESSIAN)] == Approx(last).epsilon(1e-9));
  }
}

TEST_CASE("A weight of zero disables the singular Hessian")
{
  Energy energy = sphere_problem().energy(quadratic_terms_only(1e5));
  Field field = sphere_problem().field;
  Recording_solver solver;
  REQUIRE(BS::fit_field<Tag>(field, energy, solver, energy.initial_guess()).status == Solver_status::SUCCESS);
  CHECK(solver.computes == 1);
}

TEST_CASE("If a solver fails, its status is reported, and the field is unchanged")
{
  const Fit_problem& problem = sphere_problem();
  Energy energy = problem.energy();
  Field field = problem.field;
  const Eigen::VectorXd before = Deterministic_numbers(6).vector(field.number_of_coefficients());
  field.set_coefficients(before);

  CG limited(1e-10, 1);
  CHECK(BS::fit_field<Tag>(field, energy, limited, energy.initial_guess()).status == Solver_status::NOT_CONVERGED);
  CHECK((field.coefficients() == before));
  CHECK(limited.iterations() == 1);

  Recording_solver no_factorization;
  no_factorization.fails_at_compute = 1;
  CHECK(BS::fit_field<Tag>(field, energy, no_factorization, energy.initial_guess()).status
        == Solver_status::NOT_POSITIVE_DEFINITE);
  CHECK(no_factorization.guesses.empty());
  CHECK((field.coefficients() == before));

  Recording_solver fails_later; // fails in the first step on the singular Hessian
  fails_later.fails_at_solve = 2;
  CHECK(BS::fit_field<Tag>(field, energy, fails_later, energy.initial_guess()).status == Solver_status::NOT_CONVERGED);
  CHECK(fails_later.guesses.size() == 2);
  CHECK((field.coefficients() == before));
}

TEST_CASE("A fit that starts at the solution takes hardly any iterations")
{
  Energy energy = sphere_problem().energy(quadratic_terms_only(1e3));
  Field field = sphere_problem().field;
  CG solver(1e-6);
  const BS::Fit_report cold = BS::fit_field<Tag>(field, energy, solver, energy.initial_guess());
  REQUIRE(cold.status == Solver_status::SUCCESS);
  REQUIRE(cold.iterations > 10);
  const BS::Fit_report warm = BS::fit_field<Tag>(field, energy, solver,
                                                 field.coefficients() / sphere_problem().width());
  REQUIRE(warm.status == Solver_status::SUCCESS);
  CHECK(warm.iterations <= 2); // the residual of the recurrence differs from the true one by rounding
}

#ifdef HAVE_CHOLMOD
TEST_CASE("Conjugate gradients and the direct solver yield the same field")
{
  const Fit_problem problem(sphere(1), 5, 1);
  for(double singular_hessian : { 0., 1. }) {
    Energy_weights weights;
    weights.zeta = 1e3;
    weights.singular_hessian = singular_hessian;
    Energy energy = problem.energy(weights);
    Field direct = problem.field, iterative = problem.field;
    BS::Cholmod_solver cholmod;
    CG cg(1e-12, 20000);
    const BS::Fit_report a = BS::fit_field<Tag>(direct, energy, cholmod, energy.initial_guess());
    const BS::Fit_report b = BS::fit_field<Tag>(iterative, energy, cg, energy.initial_guess());
    REQUIRE(a.status == Solver_status::SUCCESS);
    REQUIRE(b.status == Solver_status::SUCCESS);
    CHECK(a.residual < 1e-12);
    CHECK(a.iterations == a.linear_solves);
    // The residual is 1e-12, and condition numbers are about 1e7.
    const double scale = direct.coefficients().cwiseAbs().maxCoeff();
    CHECK((direct.coefficients() - iterative.coefficients()).cwiseAbs().maxCoeff() < 1e-5 * scale);
    for(std::size_t term = 0; term < a.energy.size(); ++term)
      CHECK(a.energy[term] == Approx(b.energy[term]).epsilon(1e-6));
    const BS::Level_range levels = BS::facet_ranges<Tag>(direct, problem.clipped).mesh,
                          others = BS::facet_ranges<Tag>(iterative, problem.clipped).mesh;
    CHECK(std::abs(levels.min - others.min) < 1e-5 * problem.width());
    CHECK(std::abs(levels.max - others.max) < 1e-5 * problem.width());
  }
}

TEST_CASE("Cholmod_solver rejects a matrix that is not positive definite")
{
  Eigen::SparseMatrix<double> lower = lower_triangle(1, 2, 1);
  BS::Cholmod_solver solver;
  CHECK(solver.compute(lower) == Solver_status::NOT_POSITIVE_DEFINITE);
  lower.coeffRef(1, 1) = 8;
  REQUIRE(solver.compute(lower) == Solver_status::SUCCESS);
  Eigen::VectorXd b(2), x;
  b << 1, 6;
  REQUIRE(solver.solve(b, x) == Solver_status::SUCCESS);
  CHECK(x[0] == Approx(-1).epsilon(1e-14));
  CHECK(x[1] == Approx(1).epsilon(1e-14));
  CHECK(solver.residual() < 1e-15);
}
#endif
} // namespace test_fit_field
