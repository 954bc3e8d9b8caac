// solve_part.h: equations of some unknowns, compared with a direct solution.
#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver.h>
#include <CGAL/Bspline_shell_3/Fit/Conjugate_gradient_solver.h>
#include <CGAL/Bspline_shell_3/Fit/solve_part.h>

#include <CGAL/Random.h>

#include <Eigen/Dense>

#include <catch2/catch.hpp>

#include <vector>

namespace test_solve_part {
namespace {

namespace BS = CGAL::Bspline_shells;
constexpr Eigen::Index size = 40;

struct System
{
  // Rows and columns of unknowns that are not chosen are zero.
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(size), x = Eigen::VectorXd::Zero(size), solution;
  std::vector<char> chosen = std::vector<char>(std::size_t(size), 0);
  BS::Unknown_blocks blocks;

  explicit System(CGAL::Random& random)
  {
    std::vector<Eigen::Index> unknowns;
    for(Eigen::Index u = 0; u < size; ++u) {
      x[u] = random.get_double(-1, 1);
      if((chosen[std::size_t(u)] = random.get_bool())) unknowns.push_back(u);
    }
    const Eigen::Index n = Eigen::Index(unknowns.size());
    Eigen::MatrixXd B(n, n);
    for(double& value : B.reshaped()) value = random.get_double(-1, 1);
    const Eigen::MatrixXd C = B * B.transpose() + Eigen::MatrixXd::Identity(n, n);
    for(Eigen::Index i = 0; i < n; ++i) {
      b[unknowns[std::size_t(i)]] = random.get_double(-1, 1);
      for(Eigen::Index j = 0; j < n; ++j) A(unknowns[std::size_t(i)], unknowns[std::size_t(j)]) = C(i, j);
    }
    Eigen::VectorXd part_b(n);
    for(Eigen::Index i = 0; i < n; ++i) part_b[i] = b[unknowns[std::size_t(i)]];
    const Eigen::VectorXd part_x = C.llt().solve(part_b);
    solution = x;
    for(Eigen::Index i = 0; i < n; ++i) solution[unknowns[std::size_t(i)]] = part_x[i];
    for(std::uint32_t u = 0; u < size; u += 4) {
      for(std::uint32_t v = u; v < std::uint32_t(size) && v < u + 6; ++v) blocks.unknowns.push_back(v);
      blocks.first.push_back(blocks.unknowns.size());
    }
  }
  Eigen::SparseMatrix<double> lower() const { return Eigen::MatrixXd(A.triangularView<Eigen::Lower>()).sparseView(); }
};

struct Failing_solver
{
  BS::Solver_status compute(const Eigen::SparseMatrix<double>&, const BS::Unknown_blocks&)
  {
    return BS::Solver_status::SUCCESS;
  }
  BS::Solver_status solve(const Eigen::VectorXd&, Eigen::VectorXd& x)
  {
    x.setConstant(7);
    return BS::Solver_status::NOT_CONVERGED;
  }
  std::size_t iterations() const { return 1; }
  double residual() const { return 1; }
};

} // namespace

TEST_CASE("Part of the unknowns: the chosen unknowns solve their equations, and the others keep their values")
{
  CGAL::Random random(11);
  BS::Conjugate_gradient_solver<CGAL::Sequential_tag> solver(1e-12);
  for(int n = 0; n < 10; ++n) {
    System system(random);
    Eigen::VectorXd x = system.x;
    REQUIRE(BS::solve_part(solver, system.lower(), system.b, system.chosen, system.blocks, x)
            == BS::Solver_status::SUCCESS);
    CHECK((x - system.solution).norm() < 1e-9 * system.solution.norm());
    for(Eigen::Index u = 0; u < size; ++u)
      if(!system.chosen[std::size_t(u)]) CHECK(x[u] == system.x[u]);
  }
}

TEST_CASE("Part of the unknowns: a failing solver changes nothing")
{
  CGAL::Random random(12);
  Failing_solver solver;
  System system(random);
  Eigen::VectorXd x = system.x;
  CHECK(BS::solve_part(solver, system.lower(), system.b, system.chosen, system.blocks, x)
        == BS::Solver_status::NOT_CONVERGED);
  CHECK((x == system.x));
}
} // namespace test_solve_part
