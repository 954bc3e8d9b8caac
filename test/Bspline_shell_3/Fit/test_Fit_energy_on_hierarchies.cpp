// Fit_energy.h, fit_field.h, Unknown_blocks.h on cells of different sizes: each cell has its own units.
#include "fit_problem.h"
#include "random_hierarchies.h"

#include <CGAL/Bspline_shell_3/Fit/Conjugate_gradient_solver.h>
#include <CGAL/Bspline_shell_3/Fit/fit_field.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <vector>

namespace test_Fit_energy_on_hierarchies {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Sequential_tag Tag;
typedef Field::Cell_index Index;

constexpr Term all_terms[] = { Term::DISTANCE,         Term::SURFACE, Term::ANGLE,
                               Term::SINGULAR_HESSIAN, Term::NORMAL,  Term::COEFFICIENTS };
constexpr Term quadratic_terms[] = { Term::DISTANCE, Term::SURFACE, Term::ANGLE, Term::NORMAL, Term::COEFFICIENTS };

// A mesh, and leaves that are refined at one point of it.
struct Problem
{
  BS::Input_mesh_3 input;
  Field field;
  BS::Clipped_mesh_3 clipped;
  std::vector<double> samples;

  Problem(const Mesh& mesh, double gamma, int rings, const Point_3& refined_at, int levels)
  {
    REQUIRE(input.build<Tag>(mesh, get(CGAL::vertex_point, mesh), {}) == BS::Shell_status::SUCCESS);
    const BS::Lattice_3 lattice(input.bbox(), input.unit() / gamma);
    Hierarchy cells(Root_cells(lattice, BS::dilate(BS::cells_entered_by_mesh<Tag>(input, lattice), -rings, rings)));
    while(cells.number_of_levels() < levels) cells = cells.refined({ cells.locate(refined_at) });
    field = Field(cells);
    clipped = BS::clip_mesh_to_cells<Tag>(input, cells);
    samples = BS::sample_signed_distance<Tag>(BS::Mesh_signed_distance_3(input), cells);
  }
  Problem(const Problem&) = delete; // energies refer to it

  double root_width() const { return field.cells().lattice().spacing(); }
  Energy energy(const Energy_weights& weights = all_terms_weighted()) const
  {
    return Energy(field, samples, clipped, input.unit() / root_width(), weights);
  }

  // Returns a coefficient for each free function: `f` of its lattice point, in user units, and of the spacing of its
  // level. Linear functions are reproduced, and so are squares if a third of the squared spacing is subtracted.
  template <typename Function>
  Eigen::VectorXd coefficients(const Function& f) const
  {
    Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
    for(Index n = 0; n < field.number_of_coefficients(); ++n) {
      const Index point = field.point_of_coefficient(n);
      int l = field.number_of_levels() - 1;
      while(point >= field.first_point(l) + field.points(l).size()) --l;
      const Lattice_point& p = field.points(l).point(point - field.first_point(l));
      const auto at = [&](int a) { return field.cells().coordinate(l, a, p[a]); };
      x[n] = f(at(0), at(1), at(2), field.cells().level_width(l)) / root_width();
    }
    return x;
  }

  Field field_of(const Eigen::VectorXd& x) const
  {
    Field f = field;
    f.set_coefficients(x * root_width());
    return f;
  }

  template <typename Function>
  void for_each_sample(const Function& f) const
  {
    for(Index c = 0; c < field.number_of_cells(); ++c) {
      const std::array<double, 3> corner = field.cells().corner(c);
      const double w = field.cells().width(c);
      for(int s = 0; s < 8; ++s)
        f(c, Point_3(corner[0] + (s & 1 ? 0.75 : 0.25) * w, corner[1] + (s & 2 ? 0.75 : 0.25) * w,
                     corner[2] + (s & 4 ? 0.75 : 0.25) * w));
    }
  }
};

const Problem& sphere_problem()
{
  static const Problem problem(sphere(1), 5.3, 2, Point_3(0, 0.6, 0.8), 3);
  return problem;
}

// The sides of the cube are in the middle of root cells, and between smaller cells. All pieces are triangles or
// rectangles, large enough for quadrature to be exact to degree two.
const Problem& cube_problem()
{
  static const Problem problem(box(Point_3(-2.5, -2.5, -2.5), Point_3(2.5, 2.5, 2.5)), 5, 2, Point_3(2.4, -2.4, 0.1),
                               3);
  return problem;
}

// Returns |x|^2 / 2 with signs.
Eigen::VectorXd paraboloid(const Problem& problem, double sx, double sy, double sz)
{
  return problem.coefficients([&](double x, double y, double z, double w) {
    return (sx * (x * x - w * w / 3) + sy * (y * y - w * w / 3) + sz * (z * z - w * w / 3)) / 2;
  });
}

// Returns the integral of a function, which is quadratic on each piece, over the pieces in leaves of a level.
template <typename Function>
double integral(const Problem& problem, int level, const Function& f)
{
  double sum = 0;
  for(const BS::Clipped_mesh_3::Piece& piece : problem.clipped.pieces()) {
    if(problem.field.cells().level(piece.cell) != level) continue;
    const auto at = [&](std::uint32_t v) {
      const BS::Clipped_mesh_3::Point& p = problem.clipped.point(piece.first + v);
      return Point_3(p[0], p[1], p[2]);
    };
    for(std::uint32_t v = 1; v + 1 < piece.size; ++v) {
      const Point_3 p = at(0), q = at(v), r = at(v + 1);
      const double area = std::sqrt(CGAL::cross_product(q - p, r - p).squared_length()) / 2;
      sum += area / 3 * (f(CGAL::midpoint(p, q)) + f(CGAL::midpoint(q, r)) + f(CGAL::midpoint(r, p)));
    }
  }
  return sum;
}

Eigen::MatrixXd symmetric(const Eigen::SparseMatrix<double>& lower)
{
  Eigen::MatrixXd A = lower;
  A.triangularView<Eigen::StrictlyUpper>() = A.transpose();
  return A;
}

} // namespace

TEST_CASE("Fit energy on a hierarchy: E_SDF is the sum of squared differences in units of each leaf")
{
  const Problem& problem = sphere_problem();
  REQUIRE(problem.field.number_of_levels() == 3);
  const Eigen::VectorXd x = Deterministic_numbers(1).vector(problem.field.number_of_coefficients());
  const Field field = problem.field_of(x);
  double sum = 0;
  std::size_t n = 0;
  problem.for_each_sample([&](Index c, const Point_3& p) {
    const double d = (field.cell(c).value(p) - problem.samples[n++]) / field.cells().width(c);
    sum += d * d;
  });
  CHECK(n == problem.samples.size());
  CHECK(problem.energy().value(Term::DISTANCE, x) == Approx(sum).epsilon(1e-12));
}

TEST_CASE("Fit energy on a hierarchy: integrals of linear functions over facets agree with closed forms")
{
  const Problem& problem = cube_problem();
  const Energy energy = problem.energy();
  const auto f = [](const Point_3& p) { return 0.3 * p.x() - 2 * p.y() + p.z() + 0.7; };
  const Eigen::VectorXd x = problem.coefficients(
    [&](double a, double b, double c, double) { return f(Point_3(a, b, c)); });
  const Vector_3 gradient(0.3, -2, 1);
  double surface = 0, angle = 0, normal = 0, area = 0;
  for(int l = 0; l < 3; ++l) {
    const double w = problem.root_width() / (1 << l);
    const double squares = integral(problem, l, [&](const Point_3& p) { return f(p) * f(p); });
    CHECK(squares > 0); // leaves of all sizes contribute
    surface += squares / (w * w) / (w * w);
  }
  for(const BS::Clipped_mesh_3::Piece& piece : problem.clipped.pieces()) {
    const BS::Clipped_mesh_3::Point& n = problem.clipped.normal(piece.facet);
    const double w = problem.field.cells().width(piece.cell), share = problem.clipped.area(piece) / (w * w);
    const Vector_3 d = gradient - Vector_3(n[0], n[1], n[2]);
    angle += share * d.squared_length();
    normal += share * std::pow(d * Vector_3(n[0], n[1], n[2]), 2);
    area += problem.clipped.area(piece);
  }
  CHECK(area == Approx(6 * 25).epsilon(1e-12));
  CHECK(energy.value(Term::SURFACE, x) == Approx(energy.weight(Term::SURFACE) * surface).epsilon(1e-12));
  CHECK(energy.value(Term::ANGLE, x) == Approx(energy.weight(Term::ANGLE) * angle).epsilon(1e-12));
  CHECK(energy.value(Term::NORMAL, x) == Approx(energy.weight(Term::NORMAL) * normal).epsilon(1e-12));
}

TEST_CASE("Fit energy on a hierarchy: the range on the mesh and the domain of E_singularH use the same units")
{
  const Problem& problem = cube_problem();
  Energy energy = problem.energy();
  // A linear function, in root cells.
  const Eigen::VectorXd linear = problem.coefficients([](double x, double y, double, double) { return x + 10 * y; });
  const std::pair<double, double> range = energy.range_on_mesh(linear);
  CHECK(range.second <= 27.5);
  CHECK(range.second > 16.5);
  CHECK(range.first >= -27.5);
  CHECK(range.first < -16.5);

  // The determinant of the Hessian is one per cubed user unit. User units are root cells.
  const Eigen::VectorXd x = paraboloid(problem, 1, 1, 1);
  const Field field = problem.field_of(x);
  for(const std::pair<double, double>& levels : { std::make_pair(-1e9, 1e9), std::make_pair(3., 5.) }) {
    std::vector<char> domain(field.number_of_cells(), 0);
    problem.for_each_sample([&](Index c, const Point_3& p) {
      const double f = field.cell(c).value(p) / problem.root_width();
      if(f >= levels.first && f <= levels.second) domain[c] = 1;
    });
    double sum = 0;
    std::size_t chosen[3] = { 0, 0, 0 };
    for(Index c = 0; c < field.number_of_cells(); ++c) {
      // With F = f / w and coordinates x / w, second derivatives are w times those of f.
      if(domain[c]) sum += std::pow(field.cells().width(c), 3);
      chosen[field.cells().level(c)] += domain[c];
    }
    for(std::size_t n : chosen) CHECK(n > 0);
    energy.set_singular_hessian_domain(x, levels.first, levels.second);
    CHECK(energy.value(Term::SINGULAR_HESSIAN, x) == Approx(energy.weight(Term::SINGULAR_HESSIAN) * sum).epsilon(1e-9));
  }
}

TEST_CASE("Fit energy on a hierarchy: gradients are the derivatives of the values")
{
  const Problem& problem = sphere_problem();
  Energy energy = problem.energy();
  Deterministic_numbers random(2);
  const std::size_t size = problem.field.number_of_coefficients();
  // Determinants are close to 1 or -1 per root cell, where |det H| is smooth.
  const double w = problem.root_width();
  const double h = 1. / 4096;
  for(double sign : { 1., -1. }) {
    const Eigen::VectorXd x = paraboloid(problem, 1 / w, sign / w, 1 / w) + 1e-3 * random.vector(size);
    for(double level : { 3., 1e9 }) {
      energy.set_singular_hessian_domain(x, -level, level);
      for(int trial = 0; trial < 8; ++trial) {
        // all coefficients change, or only one
        const Eigen::VectorXd d = trial < 4
                                    ? random.vector(size)
                                    : Eigen::VectorXd::Unit(size, Eigen::Index((1 + random()) / 2 * double(size - 1)));
        for(Term term : all_terms) {
          CAPTURE(int(term), trial, sign, level);
          const auto value = [&](double step) { return energy.value(term, Eigen::VectorXd(x + step * h * d)); };
          // Exact up to rounding, as the terms are polynomials of degree two or three along a line.
          const double difference = (8 * (value(1) - value(-1)) - (value(2) - value(-2))) / (12 * h);
          // Each value is a sum of less than 2^15 numbers; relative errors add up like a random walk.
          const double rounding = 2e-16 * 256 * value(0) * 18 / (12 * h);
          CHECK(std::abs(energy.gradient(term, x).dot(d) - difference) <= rounding);
          // Rounding is far less than the compared values.
          if(trial < 4) CHECK(std::abs(difference) > 10 * rounding);
        }
      }
    }
  }
}

TEST_CASE("Fit energy on a hierarchy: the normal equations represent the quadratic terms")
{
  const Problem problem(sphere(1), 3.3, 1, Point_3(0, 0.6, 0.8), 2);
  Energy_weights without_angle;
  without_angle.mu = 0;
  without_angle.normal = 10;
  without_angle.surface = 100;
  without_angle.coefficients = 0.002;
  Energy energy = problem.energy(GENERATE_COPY(all_terms_weighted(), without_angle));
  const std::size_t size = problem.field.number_of_coefficients();
  REQUIRE(size < problem.field.number_of_points());
  if(GENERATE(false, true)) {
    std::vector<float> factors(problem.field.number_of_cells());
    for(std::size_t c = 0; c < factors.size(); ++c) factors[c] = float(1 + c % 7);
    energy.set_surface_factors(factors);
  }
  Eigen::SparseMatrix<double> A;
  Eigen::VectorXd b;
  energy.assemble<Tag>(A, b);
  REQUIRE(std::size_t(A.rows()) == size);
  const Eigen::MatrixXd full = symmetric(A);
  const auto quadratic_value = [&](const Eigen::VectorXd& x) {
    double sum = 0;
    for(Term term : quadratic_terms) sum += energy.value(term, x);
    return sum;
  };
  Deterministic_numbers random(3);
  const double constant = quadratic_value(Eigen::VectorXd::Zero(Eigen::Index(size)));
  for(int trial = 0; trial < 3; ++trial) {
    const Eigen::VectorXd x = random.vector(size);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(Eigen::Index(size));
    for(Term term : quadratic_terms) gradient += energy.gradient(term, x);
    CHECK((2 * (full * x - b) - gradient).norm() <= 1e-12 * gradient.norm());
    CHECK(x.dot(full * x) - 2 * b.dot(x) + constant == Approx(quadratic_value(x)).epsilon(1e-12));
  }
  // The result is the same for any number of threads.
  Eigen::SparseMatrix<double> parallel_A;
  Eigen::VectorXd parallel_b;
  energy.assemble<CGAL::Parallel_if_available_tag>(parallel_A, parallel_b);
  REQUIRE(parallel_A.nonZeros() == A.nonZeros());
  CHECK(std::equal(A.valuePtr(), A.valuePtr() + A.nonZeros(), parallel_A.valuePtr()));
  CHECK((b == parallel_b));
  // The matrix is positive definite, as the samples alone determine every coefficient.
  Energy_weights distance_only;
  distance_only.mu = 0;
  problem.energy(distance_only).assemble<Tag>(A, b);
  CHECK(Eigen::LLT<Eigen::MatrixXd, Eigen::Lower>(Eigen::MatrixXd(A)).info() == Eigen::Success);
}

TEST_CASE(
  "Fit energy on a hierarchy: the fourth term keeps the sparsity pattern, and its model has the term's gradient")
{
  const Problem& problem = sphere_problem();
  Energy energy = problem.energy();
  const Eigen::VectorXd x = energy.initial_guess();
  energy.set_singular_hessian_domain(x, -1, 1);
  Eigen::SparseMatrix<double> A;
  Eigen::VectorXd b;
  energy.assemble<Tag>(A, b);
  Eigen::SparseMatrix<double> more = A;
  Eigen::VectorXd more_b = b;
  energy.add_singular_hessian<Tag>(x, 1e-3, more, more_b);
  REQUIRE(more.nonZeros() == A.nonZeros());
  // The model is w (row . d + det)^2 / |det|. Its gradient at x is twice that of the term where |det| exceeds eta.
  const Eigen::VectorXd model = 2 * ((more - A).selfadjointView<Eigen::Lower>() * x - (more_b - b));
  const Eigen::VectorXd gradient = energy.gradient(Term::SINGULAR_HESSIAN, x);
  CHECK(model.dot(gradient) > 0.9 * model.norm() * gradient.norm());
}

TEST_CASE("Fit energy on a hierarchy: the gradient vanishes at the solution")
{
  const Problem& problem = sphere_problem();
  Energy_weights weights = all_terms_weighted();
  weights.zeta = 100;
  weights.singular_hessian = 0;
  Energy energy = problem.energy(weights);
  Eigen::SparseMatrix<double> A;
  Eigen::VectorXd b;
  energy.assemble<Tag>(A, b);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double> > factor(A);
  REQUIRE(factor.info() == Eigen::Success);
  const Eigen::VectorXd x = factor.solve(b);
  const auto gradient = [&](const Eigen::VectorXd& y) {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(y.size());
    for(Term term : quadratic_terms) g += energy.gradient(term, y);
    return g;
  };
  CHECK(gradient(x).norm() <= 1e-10 * gradient(Eigen::VectorXd::Zero(x.size())).norm());
  const double least = energy.value(x);
  Deterministic_numbers random(4);
  for(int trial = 0; trial < 3; ++trial)
    CHECK(energy.value(Eigen::VectorXd(x + 1e-3 * random.vector(std::size_t(x.size())))) > least);

  // Conjugate gradients with blocks find the solution, too.
  Field field = problem.field;
  BS::Conjugate_gradient_solver<> solver(1e-10, 20000);
  const BS::Fit_report report = BS::fit_field<Tag>(field, energy, solver, energy.initial_guess());
  REQUIRE(report.status == BS::Solver_status::SUCCESS);
  // condition numbers are about 1e6
  CHECK((field.coefficients() / problem.root_width() - x).norm() <= 1e-4 * x.norm());
  CHECK(energy.value(Eigen::VectorXd(field.coefficients() / problem.root_width())) <= least * (1 + 1e-9));
  for(Term term : quadratic_terms)
    CHECK(report.energy[std::size_t(term)] == Approx(energy.value(term, x)).epsilon(1e-4));
  CHECK(report.energy[std::size_t(Term::SINGULAR_HESSIAN)] == 0);
  // The field is close to the distance from the sphere.
  CHECK(*field.value(Point_3(0, 0.6, 0.8)) == Approx(0).margin(0.1));
  CHECK(*field.gradient(Point_3(0, 0.6, 0.8)) * Vector_3(0, 0.6, 0.8) == Approx(1).margin(0.2));
}

TEST_CASE("Fit energy on a hierarchy: samples of a linear function are fitted exactly")
{
  const Problem& problem = cube_problem();
  Energy_weights distance_only;
  distance_only.mu = 0;
  const auto f = [](double x, double y, double z) { return 0.3 * x - 2 * y + z + 0.7; };
  std::vector<double> samples;
  problem.for_each_sample([&](Index, const Point_3& p) { samples.push_back(f(p.x(), p.y(), p.z())); });
  const Energy energy(problem.field, samples, problem.clipped, 5, distance_only);
  Eigen::SparseMatrix<double> A;
  Eigen::VectorXd b;
  energy.assemble<Tag>(A, b);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double> > factor(A);
  REQUIRE(factor.info() == Eigen::Success);
  const Eigen::VectorXd x = factor.solve(b), expected = problem.coefficients(
                                               [&](double a, double c, double d, double) { return f(a, c, d); });
  CHECK(energy.value(x) < 1e-20);
  CHECK(energy.value(expected) < 1e-20);
  CHECK((x - expected).cwiseAbs().maxCoeff() < 1e-4); // largest where functions reach only a corner of the domain
  // The guess reproduces linear functions.
  const Eigen::VectorXd guess = energy.initial_guess();
  CHECK((guess - expected).cwiseAbs().maxCoeff() < 1e-11);
  CHECK((energy.initial_guess<CGAL::Parallel_if_available_tag>() == guess));
}

TEST_CASE("Fit energy on a hierarchy: blocks cover all unknowns, and each stays on one level")
{
  const Field& field = sphere_problem().field;
  const BS::Unknown_blocks blocks = BS::overlapping_blocks(field);
  std::vector<int> times(field.number_of_coefficients(), 0);
  std::size_t wrong = 0;
  const auto level = [&](std::uint32_t n) {
    int l = field.number_of_levels() - 1;
    while(field.point_of_coefficient(n) >= field.first_point(l) + field.points(l).size()) --l;
    return l;
  };
  for(std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t begin = blocks.first[b], end = blocks.first[b + 1];
    wrong += end <= begin || end - begin > 125;
    for(std::size_t n = begin; n < end; ++n) {
      ++times[blocks.unknowns[n]];
      wrong += n > begin && blocks.unknowns[n] <= blocks.unknowns[n - 1];
      wrong += level(blocks.unknowns[n]) != level(blocks.unknowns[begin]);
    }
  }
  CHECK(wrong == 0);
  CHECK(*std::min_element(times.begin(), times.end()) >= 1);
  CHECK(*std::max_element(times.begin(), times.end()) == 8);
}

TEST_CASE("Fit energy on a hierarchy: equations of a part equal the full equations with the other values fixed")
{
  for(const Problem* problem : { &sphere_problem(), &cube_problem() }) {
    const Energy energy = problem->energy();
    const Eigen::VectorXd x = Deterministic_numbers(3).vector(problem->field.number_of_coefficients());
    const BS::Fitted_part part(problem->field, { Index(problem->field.number_of_cells() - 1), 5 });
    const Eigen::Index chosen = std::count(part.coefficients.begin(), part.coefficients.end(), 1);
    REQUIRE(chosen > 64);
    REQUIRE(chosen < x.size() / 2);
    Eigen::SparseMatrix<double> all, A, parallel;
    Eigen::VectorXd all_b, b, parallel_b;
    energy.assemble<Tag>(all, all_b);
    energy.assemble<Tag>(part, x, A, b);
    energy.assemble<CGAL::Parallel_if_available_tag>(part, x, parallel, parallel_b);
    const Eigen::MatrixXd expected = symmetric(all), found = symmetric(A);
    const Eigen::VectorXd residual = all_b - expected * x, part_residual = b - found * x;
    const double largest = expected.cwiseAbs().maxCoeff();
    for(Eigen::Index u = 0; u < x.size(); ++u) {
      const bool is_chosen = part.coefficients[std::size_t(u)];
      if(!is_chosen) CHECK((found.col(u).isZero(0) && b[u] == 0));
      else CHECK(std::abs(part_residual[u] - residual[u]) < 1e-11 * largest * x.norm());
      for(Eigen::Index v = 0; is_chosen && v < x.size(); ++v)
        if(part.coefficients[std::size_t(v)] && std::abs(found(u, v) - expected(u, v)) > 1e-13 * largest)
          FAIL(u << " " << v);
    }
    CHECK((symmetric(parallel) == found));
    CHECK((parallel_b == b));
  }
}
} // namespace test_Fit_energy_on_hierarchies
