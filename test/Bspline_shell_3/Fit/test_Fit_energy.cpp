// Fit_energy.h, Normal_equations.h: the paper's energy is compared with closed forms and finite differences, and the
// normal equations with the energy.
#include "fit_problem.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace test_Fit_energy {
namespace {

constexpr Term all_terms[] = { Term::DISTANCE,         Term::SURFACE, Term::ANGLE,
                               Term::SINGULAR_HESSIAN, Term::NORMAL,  Term::COEFFICIENTS };
constexpr Term quadratic_terms[] = { Term::DISTANCE, Term::SURFACE, Term::ANGLE, Term::NORMAL, Term::COEFFICIENTS };
constexpr double everywhere = 1e9;

// A cube of five cells on the lattice of integers, with sides in the middle of cells. User units are cell units. Every
// piece of the mesh is a triangle or a rectangle, large enough for quadrature to be exact to degree two.
constexpr double half = 2.5;
const Fit_problem& cube_problem()
{
  static const Fit_problem problem(box(Point_3(-half, -half, -half), Point_3(half, half, half)), 5, 1);
  return problem;
}

// Returns |x|^2 / 2 with signs. The Hessian is diagonal; its determinant is the product of the signs.
Eigen::VectorXd paraboloid(const Fit_problem& problem, double sx, double sy, double sz)
{
  return problem.coefficients([&](double x, double y, double z) {
    return (sx * square_coefficient(x) + sy * square_coefficient(y) + sz * square_coefficient(z)) / 2;
  });
}

// Calls f(cell, point) for all samples.
template <typename Function>
void for_each_sample(const Fit_problem& problem, const Function& f)
{
  for(Field::Cell_index c = 0; c < problem.field.number_of_cells(); ++c) {
    const std::array<double, 3> corner = problem.field.cells().corner(c);
    for(int s = 0; s < 8; ++s)
      f(c, Point_3(corner[0] + (s & 1 ? 0.75 : 0.25) * problem.width(),
                   corner[1] + (s & 2 ? 0.75 : 0.25) * problem.width(),
                   corner[2] + (s & 4 ? 0.75 : 0.25) * problem.width()));
  }
}

// Returns the determinants of the Hessian at the samples of the chosen cells, in cell units, by evaluating the field.
std::vector<double> determinants(const Fit_problem& problem, const Eigen::VectorXd& x, const std::vector<char>& cells)
{
  Field field = problem.field;
  field.set_coefficients(x * problem.width());
  std::vector<double> found;
  for_each_sample(problem, [&](Field::Cell_index c, const Point_3& p) {
    if(!cells[c]) return;
    const auto& h = field.cell(c).second_order_jet(p).hessian; // xx, yy, zz, xy, xz, yz
    Eigen::Matrix3d m;
    m << h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2];
    found.push_back((m * problem.width()).determinant());
  });
  return found;
}

// Returns the cells with a sample between the levels, in cell units.
std::vector<char> cells_between(const Fit_problem& problem, const Eigen::VectorXd& x, double eps1, double eps2)
{
  Field field = problem.field;
  field.set_coefficients(x * problem.width());
  std::vector<char> cells(field.number_of_cells(), 0);
  for_each_sample(problem, [&](Field::Cell_index c, const Point_3& p) {
    const double f = field.cell(c).value(p) / problem.width();
    if(f >= eps1 && f <= eps2) cells[c] = 1;
  });
  return cells;
}

Eigen::MatrixXd symmetric(const Eigen::SparseMatrix<double>& lower)
{
  Eigen::MatrixXd A = lower;
  A.triangularView<Eigen::StrictlyUpper>() = A.transpose();
  return A;
}

} // namespace

TEST_CASE("Fit energy: the weights of the terms agree with the paper, in cell units")
{
  Energy_weights weights;
  weights.mu = 0.25;
  weights.zeta = 1024;
  weights.singular_hessian = 8;
  weights.surface = 3;
  const Energy energy = cube_problem().energy(weights);
  CHECK(energy.weight(Term::DISTANCE) == 1);
  CHECK(energy.weight(Term::SURFACE) == 3);
  CHECK(energy.weight(Term::ANGLE) == 0.25);
  CHECK(energy.weight(Term::NORMAL) == 256);
  CHECK(energy.weight(Term::SINGULAR_HESSIAN) == 0.25 * 8 * 25);
  CHECK(cube_problem().energy(Energy_weights::paper()).weight(Term::SURFACE) == 0);
  CHECK(Energy_weights().surface == 0);
  CHECK(Energy_weights().normal == 0);
  CHECK(Energy_weights().coefficients == 0);
  weights.normal = 5;
  CHECK(cube_problem().energy(weights).weight(Term::NORMAL) == 261);
  weights.mu = 0;
  CHECK(cube_problem().energy(weights).weight(Term::NORMAL) == 5);
  const auto invalid = [&] {
    CGAL::Bspline_shells::Invalid_parameter parameter;
    weights.check(parameter);
    return parameter ? std::string(parameter.name) : std::string();
  };
  CHECK(invalid() == "");
  weights.coefficients = 0.5;
  CHECK(cube_problem().energy(weights).weight(Term::COEFFICIENTS) == 0.5);
  weights.normal = -1;
  CHECK(invalid() == "energy_weights.normal");
  weights.normal = 0;
  weights.coefficients = -1;
  CHECK(invalid() == "energy_weights.coefficients");
}

TEST_CASE("Fit energy: E_surface is the integral of the squared value over the facets")
{
  const Fit_problem& problem = cube_problem();
  const Energy energy = problem.energy(all_terms_weighted());
  const double beta = energy.weight(Term::SURFACE), side = 4 * half * half;
  REQUIRE(beta == 30);
  // a constant; and x, which is half^2 squared on two sides, and half^2 / 3 in the mean square on the other four
  CHECK(energy.value(Term::SURFACE, problem.coefficients([](double, double, double) { return 3.; }))
        == Approx(beta * 6 * side * 9).epsilon(1e-12));
  CHECK(energy.value(Term::SURFACE, problem.coefficients([](double x, double, double) { return x; }))
        == Approx(beta * side * half * half * (2 + 4 / 3.)).epsilon(1e-12));
  const Eigen::VectorXd x = Deterministic_numbers(7).vector(problem.field.number_of_coefficients());
  CHECK(problem.energy().value(Term::SURFACE, x) == 0);
  // The sum of all terms includes this term.
  double sum = 0;
  for(Term term : quadratic_terms) sum += energy.value(term, x);
  CHECK(energy.value(x) == Approx(sum).epsilon(1e-14));
}

TEST_CASE("Fit energy: surface factors scale E_surface in their cells, and no other term")
{
  const Fit_problem& problem = cube_problem();
  Energy energy = problem.energy(all_terms_weighted());
  const Eigen::VectorXd x = problem.coefficients([](double, double, double) { return 1.; });
  const double all = energy.value(Term::SURFACE, x);
  const double others = energy.value(x) - all;
  // The factor is three on one half of the cube.
  std::vector<float> factors(problem.field.number_of_cells(), 1);
  for(Field::Cell_index c = 0; c < factors.size(); ++c)
    if(problem.field.cell(c).bbox().xmax() <= 0) factors[c] = 3;
  REQUIRE(std::count(factors.begin(), factors.end(), 3.f) * 2 == std::ptrdiff_t(factors.size()));
  energy.set_surface_factors(factors);
  CHECK(energy.value(Term::SURFACE, x) == Approx(2 * all).epsilon(1e-12));
  CHECK(energy.value(x) == Approx(2 * all + others).epsilon(1e-12));
}

TEST_CASE("Fit energy: E_angle and E_normal of linear and quadratic functions on a cube agree with closed forms")
{
  const Fit_problem& problem = cube_problem();
  const Energy energy = problem.energy();
  const double mu = energy.weight(Term::ANGLE), mu_zeta = energy.weight(Term::NORMAL);
  const double side = 4 * half * half;

  // f = x: gradient and normal agree on one side of the cube, are opposite on another side, and orthogonal on four
  // sides.
  const Eigen::VectorXd linear = problem.coefficients([](double x, double, double) { return x; });
  CHECK(energy.value(Term::ANGLE, linear) == Approx(mu * side * (0 + 4 + 4 * 2)).epsilon(1e-12));
  CHECK(energy.value(Term::NORMAL, linear) == Approx(mu_zeta * side * (0 + 4 + 4 * 1)).epsilon(1e-12));

  // f = |x|^2 / 2: the gradient is x; its normal part is `half` on each side.
  const Eigen::VectorXd quadratic = paraboloid(problem, 1, 1, 1);
  const double second_moment = side * 4 * half * half / 12;
  CHECK(energy.value(Term::ANGLE, quadratic)
        == Approx(mu * 6 * (side * (half - 1) * (half - 1) + 2 * second_moment)).epsilon(1e-12));
  CHECK(energy.value(Term::NORMAL, quadratic) == Approx(mu_zeta * 6 * side * (half - 1) * (half - 1)).epsilon(1e-12));

  // f = |x|^2 / 5: the normal part of the gradient is one everywhere.
  CHECK(energy.value(Term::NORMAL, quadratic / half) < 1e-20 * mu_zeta * side);
}

TEST_CASE("Fit energy: E_singularH is the integral of |det H| over the cells in the shell")
{
  const Fit_problem& problem = cube_problem();
  Energy energy = problem.energy();
  const double weight = energy.weight(Term::SINGULAR_HESSIAN);
  for(double sign : { 1., -1. }) {
    const Eigen::VectorXd x = paraboloid(problem, 1, 1, sign); // det H = sign everywhere
    energy.set_singular_hessian_domain(x, -everywhere, everywhere);
    const double whole = weight * problem.field.number_of_cells();
    CHECK(energy.value(Term::SINGULAR_HESSIAN, x) == Approx(whole).epsilon(1e-12));
    CHECK(energy.value(Term::SINGULAR_HESSIAN, 2 * x) == Approx(8 * whole).epsilon(1e-12));

    const std::vector<char> cells = cells_between(problem, x, 1, 3);
    const auto size = std::count(cells.begin(), cells.end(), 1);
    REQUIRE(size > 0);
    REQUIRE(std::size_t(size) < cells.size());
    energy.set_singular_hessian_domain(x, 1, 3);
    CHECK(energy.value(Term::SINGULAR_HESSIAN, x) == Approx(weight * size).epsilon(1e-12));
  }
  CHECK(problem.energy().value(Term::SINGULAR_HESSIAN, paraboloid(problem, 1, 1, 1)) == 0); // no domain is set
}

TEST_CASE(
  "Fit energy: E_coefficients measures deviations from the linear extension of the samples, by the functions' shares")
{
  const Fit_problem& problem = cube_problem();
  Energy_weights weights;
  weights.mu = 0;
  weights.coefficients = 0.5;
  const Energy energy = problem.energy(weights);
  // If all differences are equal, the functions' shares in each sample sum to one. The energy is then half of the
  // squared difference per sample.
  const Eigen::VectorXd guess = energy.initial_guess();
  const std::vector<double> constant(problem.samples.size(), 3 * problem.width());
  const Energy of_constant(problem.field, constant, problem.clipped, problem.gamma(), weights);
  const Eigen::VectorXd five = Eigen::VectorXd::Constant(guess.size(), 5.);
  CHECK(of_constant.value(Term::COEFFICIENTS, five) == Approx(0.5 * 4 * double(problem.samples.size())).epsilon(1e-12));
  CHECK(problem.energy().value(Term::COEFFICIENTS, guess) == 0);
  // The gradient vanishes at the minimizer. A change of one coefficient there costs its share in all samples.
  CHECK(energy.gradient(Term::COEFFICIENTS, guess).cwiseAbs().maxCoeff() < 1e-11);
  const double least = energy.value(Term::COEFFICIENTS, guess);
  const Eigen::Index middle = guess.size() / 2;
  Field function = problem.field;
  function.set_coefficients(Eigen::VectorXd::Unit(guess.size(), middle));
  double share = 0;
  for_each_sample(problem, [&](Field::Cell_index c, const Point_3& p) { share += function.cell(c).value(p); });
  REQUIRE(share > 0);
  CHECK(energy.value(Term::COEFFICIENTS, Eigen::VectorXd(guess + 2 * Eigen::VectorXd::Unit(guess.size(), middle)))
          - least
        == Approx(0.5 * 4 * share).epsilon(1e-9));
}

TEST_CASE("Fit energy: the initial guess extends the samples linearly")
{
  const Fit_problem& problem = cube_problem();
  const Eigen::VectorXd guess = problem.energy().initial_guess();
  // Linear functions are reproduced up to rounding, even where a function reaches only a corner of the domain.
  const auto f = [](double x, double y, double z) { return 0.3 * x - 2 * y + z + 0.7; };
  std::vector<double> linear;
  for_each_sample(problem, [&](Field::Cell_index, const Point_3& p) { linear.push_back(f(p.x(), p.y(), p.z())); });
  const Energy energy(problem.field, linear, problem.clipped, problem.gamma(), all_four_terms());
  CHECK((energy.initial_guess() - problem.coefficients(f)).cwiseAbs().maxCoeff() < 1e-12);
  // For a closed mesh, the guess is close to the distance: errors are less than two cells, the reach of a function.
  Field field = problem.field;
  field.set_coefficients(guess * problem.width());
  double worst = 0;
  std::size_t n = 0;
  for_each_sample(problem, [&](Field::Cell_index c, const Point_3& p) {
    worst = (std::max)(worst, std::abs(field.cell(c).value(p) - problem.samples[n++]));
  });
  CHECK(worst < 2);
}

TEST_CASE("Fit energy: the fourth term's equations are the Gauss-Newton model of (det H)^2 / max(|det H|, eta)")
{
  const Fit_problem problem(box(Point_3(-1, -1, -1), Point_3(1, 1, 1)), 2, 1);
  Energy energy = problem.energy();
  const std::size_t size = problem.field.number_of_coefficients();
  Deterministic_numbers random(4);
  const Eigen::VectorXd x = paraboloid(problem, 1, -0.5, 0.3) + 0.1 * random.vector(size);
  const double eta = 0.15, eps1 = -0.4, eps2 = 0.4;
  energy.set_singular_hessian_domain(x, eps1, eps2);
  const std::vector<char> cells = cells_between(problem, x, eps1, eps2);
  REQUIRE(std::count(cells.begin(), cells.end(), 1) > 0);
  REQUIRE(std::count(cells.begin(), cells.end(), 0) > 0);
  const std::vector<double> det = determinants(problem, x, cells);
  const auto small = std::count_if(det.begin(), det.end(), [&](double d) { return std::abs(d) < eta; });
  REQUIRE(small > 0);
  REQUIRE(std::size_t(small) < det.size());

  // The Jacobian of the determinants: each is a cubic polynomial in each coefficient, so the difference is exact.
  Eigen::MatrixXd J(det.size(), size);
  const double h = 0.25;
  for(std::size_t n = 0; n < size; ++n) {
    const Eigen::VectorXd d = Eigen::VectorXd::Unit(size, n) * h;
    const std::vector<double> p1 = determinants(problem, x + d, cells), m1 = determinants(problem, x - d, cells),
                              p2 = determinants(problem, x + 2 * d, cells),
                              m2 = determinants(problem, x - 2 * d, cells);
    for(std::size_t s = 0; s < det.size(); ++s) J(s, n) = (8 * (p1[s] - m1[s]) - (p2[s] - m2[s])) / (12 * h);
  }
  Eigen::MatrixXd expected_A = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd expected_b = Eigen::VectorXd::Zero(size);
  for(std::size_t s = 0; s < det.size(); ++s) {
    const double w = energy.weight(Term::SINGULAR_HESSIAN) / 8 / (std::max)(std::abs(det[s]), eta);
    const Eigen::VectorXd row = J.row(s);
    expected_A += w * row * row.transpose();
    expected_b += w * (row.dot(x) - det[s]) * row;
  }

  Eigen::SparseMatrix<double> A, added_A;
  Eigen::VectorXd b, added_b;
  energy.assemble<CGAL::Sequential_tag>(A, b);
  added_A = A;
  added_b = b;
  energy.add_singular_hessian<CGAL::Sequential_tag>(x, eta, added_A, added_b);
  // The subtracted entries are up to mu zeta = 10^4 times the local area, of which twelve digits remain.
  const double scale = symmetric(A).cwiseAbs().maxCoeff();
  CHECK((symmetric(added_A) - symmetric(A) - expected_A).cwiseAbs().maxCoeff() < 1e-12 * scale);
  CHECK((added_b - b - expected_b).cwiseAbs().maxCoeff() < 1e-12 * scale);
  CHECK(expected_A.cwiseAbs().maxCoeff() > 1e-6 * scale);
  CHECK(expected_b.cwiseAbs().maxCoeff() > 1e-6 * scale);
}

TEST_CASE("Fit energy: the assembled equations do not depend on the number of threads, bit for bit")
{
  const Fit_problem problem(torus(3, 1, 16, 9), 20);
  Energy energy = problem.energy(all_terms_weighted());
  const Eigen::VectorXd x = energy.initial_guess();
  energy.set_singular_hessian_domain(x, -1, 1);
  Eigen::SparseMatrix<double> A;
  Eigen::VectorXd b;
  energy.assemble<CGAL::Sequential_tag>(A, b);
  energy.add_singular_hessian<CGAL::Sequential_tag>(x, 1e-3, A, b);
  for(int run = 0; run < 3; ++run) {
    Eigen::SparseMatrix<double> parallel_A;
    Eigen::VectorXd parallel_b;
    energy.assemble<CGAL::Parallel_if_available_tag>(parallel_A, parallel_b);
    energy.add_singular_hessian<CGAL::Parallel_if_available_tag>(x, 1e-3, parallel_A, parallel_b);
    REQUIRE(parallel_A.nonZeros() == A.nonZeros());
    CHECK(std::equal(A.valuePtr(), A.valuePtr() + A.nonZeros(), parallel_A.valuePtr()));
    CHECK(std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), parallel_A.innerIndexPtr()));
    CHECK((b == parallel_b));
  }
}

TEST_CASE("Fit energy: in cell units, the energy does not depend on the size of the mesh")
{
  const auto scaled = [](double s) {
    Mesh mesh = torus(3, 1, 8, 5);
    for(auto v : mesh.vertices())
      mesh.point(v) = Point_3(s * mesh.point(v).x(), s * mesh.point(v).y(), s * mesh.point(v).z());
    return mesh;
  };
  const Fit_problem one(scaled(1), 8), large(scaled(1024), 8), odd(scaled(1e-3), 8);
  REQUIRE(one.field.number_of_coefficients() == large.field.number_of_coefficients());
  REQUIRE(one.field.number_of_coefficients() == odd.field.number_of_coefficients());
  const Eigen::VectorXd x = one.energy().initial_guess();
  CHECK((x == large.energy().initial_guess()));
  for(Term term : all_terms) {
    Energy e = one.energy(all_terms_weighted()), l = large.energy(all_terms_weighted()),
           o = odd.energy(all_terms_weighted());
    for(Energy* energy : { &e, &l, &o }) energy->set_singular_hessian_domain(x, -1, 1);
    REQUIRE(e.value(term, x) > 0);
    CHECK(e.value(term, x) == l.value(term, x));                       // exact for a power of two
    CHECK(e.value(term, x) == Approx(o.value(term, x)).epsilon(1e-5)); // the lattice is rounded to 20 bits
  }
}
} // namespace test_Fit_energy
