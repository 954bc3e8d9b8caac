// Neo_hookean_solid.h of the examples: solutions agree with closed forms, derivatives agree with the energy, and
// Newton's method converges as it should. Meshes and closed forms are made here.
#include "../../../examples/Bspline_shell_3/Neo_hookean_solid.h" // first: must be self-contained

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace test_Neo_hookean_solid {
namespace {

typedef Neo_hookean_solid<> Solid;
typedef Solid::Vector Vector;
typedef Solid::Vectors Vectors;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
const Lame_parameters material{ 0.7, 1.9 };
const std::array<Element_order, 2> orders{ Element_order::LINEAR, Element_order::QUADRATIC };

struct Tetrahedra
{
  std::vector<Vector> points;
  std::vector<std::array<std::size_t, 4> > cells;
};

// Returns a box of unit cubes, each cut into six tetrahedra around a diagonal. Inner points are moved at random, by too
// little to invert a tetrahedron.
Tetrahedra box(std::size_t nx, std::size_t ny, std::size_t nz, double jitter)
{
  Tetrahedra result;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-jitter, jitter);
  const auto number = [&](std::size_t x, std::size_t y, std::size_t z) { return (x * (ny + 1) + y) * (nz + 1) + z; };
  for(std::size_t x = 0; x <= nx; ++x)
    for(std::size_t y = 0; y <= ny; ++y)
      for(std::size_t z = 0; z <= nz; ++z) {
        Vector p(x, y, z);
        if(x % nx != 0 && y % ny != 0 && z % nz != 0)
          for(double& c : p) c += uniform(random);
        result.points.push_back(p);
      }
  for(std::size_t x = 0; x < nx; ++x)
    for(std::size_t y = 0; y < ny; ++y)
      for(std::size_t z = 0; z < nz; ++z) {
        std::array<int, 3> axes{ 0, 1, 2 };
        do {
          std::array<std::size_t, 3> at{ x, y, z };
          std::array<std::size_t, 4> cell{ number(x, y, z) };
          for(int i = 0; i < 3; ++i) {
            ++at[axes[i]];
            cell[i + 1] = number(at[0], at[1], at[2]);
          }
          const auto& p = result.points;
          if((p[cell[1]] - p[cell[0]]).cross(p[cell[2]] - p[cell[0]]).dot(p[cell[3]] - p[cell[0]]) < 0)
            std::swap(cell[2], cell[3]);
          result.cells.push_back(cell);
        } while(std::next_permutation(axes.begin(), axes.end()));
      }
  return result;
}

// Returns solids of linear and of quadratic elements.
std::vector<Solid> solids(const Tetrahedra& mesh)
{
  return { Solid(mesh.points, mesh.cells, Element_order::LINEAR, material),
           Solid(mesh.points, mesh.cells, Element_order::QUADRATIC, material) };
}

Vectors random_displacements(const Solid& solid, double size)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-size, size);
  Vectors u(3, solid.number_of_nodes());
  for(double& x : u.reshaped()) x = uniform(random);
  return u;
}

template <typename Predicate>
std::vector<Solid::Condition> hold(const Solid& solid, const Predicate& is_held)
{
  std::vector<Solid::Condition> result;
  for(std::size_t n = 0; n < solid.number_of_nodes(); ++n)
    if(is_held(solid.node(n))) result.push_back({ n });
  return result;
}

// Solves a problem in which one end is held, and the other is turned and moved.
Solid::Result bend(const Solid& solid, double length, double angle, const Solid::Options& options = Solid::Options(),
                   const Eigen::Matrix3d& turned = Eigen::Matrix3d::Identity())
{
  const auto ends = hold(solid, [&](const Vector& p) { return p.x() == 0 || p.x() == length; });
  return solid.solve(
    ends,
    [&](std::size_t n, double t) -> Vector {
      const Vector p = solid.node(n), pivot(length, 0, 0);
      const Vector moved = p.x() == 0 ? p
                                      : Vector(pivot + Eigen::AngleAxisd(t * angle, Vector::UnitY()) * (p - pivot)
                                               + t * Vector(-0.3, 0, 0.5));
      return turned * moved - p;
    },
    options);
}

} // namespace

TEST_CASE("Neo-Hookean solid: an affine motion of the boundary extends to the interior")
{
  Eigen::Matrix3d A;
  A << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, -0.2, 0.1, 1.1;
  const Vector b(0.3, -2, 1);
  for(const Solid& solid : solids(box(3, 3, 3, 0.2))) {
    REQUIRE(solid.is_valid());
    const auto boundary = hold(solid, [](const Vector& p) { return p.minCoeff() == 0 || p.maxCoeff() == 3; });
    Solid::Options options;
    options.start = random_displacements(solid, 0.05); // otherwise the start would be the solution
    const auto result = solid.solve(
      boundary, [&](std::size_t n, double t) -> Vector { return t * (A * solid.node(n) + b - solid.node(n)); },
      options);
    REQUIRE(result);
    CHECK(result.load == 1);

    // Residual forces r displace the nodes by r over the least eigenvalue; the condition number amplifies rounding.
    std::vector<char> is_held(3 * solid.number_of_nodes(), 0);
    for(const auto& c : boundary)
      for(std::size_t i = 0; i < 3; ++i) is_held[3 * c.node + i] = 1;
    std::vector<int> inside;
    for(std::size_t n = 0; n < is_held.size(); ++n)
      if(is_held[n] == 0) inside.push_back(int(n));
    const Eigen::MatrixXd H = Eigen::MatrixXd(solid.hessian(result.displacements))(inside, inside);
    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H).eigenvalues();
    const double tolerance = 2 * result.residuals.back() / eigenvalues[0]
                             + 10 * epsilon * eigenvalues.tail(1)[0] / eigenvalues[0];
    CHECK(tolerance < 1e-8);
    double farthest = 0;
    for(std::size_t n = 0; n < solid.number_of_nodes(); ++n)
      farthest = (std::max)(farthest, (solid.node(n) + result.displacements.col(n) - A * solid.node(n) - b).norm());
    CHECK(farthest <= tolerance);
    // The gradient of an affine map is constant.
    const double log_J = std::log(A.determinant());
    const double density = material.mu * ((A.squaredNorm() - 3) / 2 - log_J) + material.lambda / 2 * log_J * log_J;
    CHECK(result.energy == Approx(27 * density).epsilon(1e-9));
    CHECK(result.least_jacobian == Approx(A.determinant()).epsilon(1e-7));
  }
}

TEST_CASE("Neo-Hookean solid: a stretched or compressed bar has no lateral stress")
{
  for(const Solid& solid : solids(box(4, 2, 2, 0.2)))
    for(double stretch : { 0.5, 1.1, 2.5 }) {
      std::vector<Solid::Condition> conditions; // symmetry on three sides; the other end moves along the bar
      for(std::size_t n = 0; n < solid.number_of_nodes(); ++n) {
        const Vector& p = solid.node(n);
        conditions.push_back({ n, { p.x() == 0 || p.x() == 4, p.y() == 0, p.z() == 0 } });
      }
      const auto result = solid.solve(
        conditions, [&](std::size_t n, double t) { return Vector(t * (stretch - 1) * solid.node(n).x(), 0, 0); });
      REQUIRE(result);

      // The condition is mu (s - 1/s) + lambda ln(stretch s^2) / s = 0. Times s, it increases with s.
      double low = 0.1, high = 10;
      while(high - low > 4 * epsilon * high) {
        const double s = (low + high) / 2;
        (material.mu * (s * s - 1) + material.lambda * std::log(stretch * s * s) > 0 ? high : low) = s;
      }
      for(std::size_t n = 0; n < solid.number_of_nodes(); ++n) {
        const Vector& p = solid.node(n);
        CHECK((p + result.displacements.col(n) - Vector(stretch * p.x(), low * p.y(), low * p.z())).norm() < 1e-8);
      }
      const double stress = material.mu * (stretch - 1 / stretch)
                            + material.lambda * std::log(stretch * low * low) / stretch;
      const Vectors forces = solid.gradient(result.displacements);
      double reaction = 0;
      for(std::size_t n = 0; n < solid.number_of_nodes(); ++n)
        if(solid.node(n).x() == 4) reaction += forces(0, n);
      CHECK(reaction == Approx(4 * stress).epsilon(1e-8)); // the cross-section has area four
    }
}

TEST_CASE("Neo-Hookean solid: gradient and Hessian agree with finite differences of the energy")
{
  const double h = std::cbrt(epsilon); // the optimal order for central differences
  for(const Solid& solid : solids(box(2, 2, 2, 0.2))) {
    const Vectors u = random_displacements(solid, 0.08), v = random_displacements(solid, 1).rowwise().reverse();
    const auto state = solid.state(u);
    REQUIRE(state.least_jacobian > 0);
    // The error of a central difference is a third of its difference from the one of twice the width, up to higher
    // orders and rounding.
    const auto slope = [&](double width) {
      return (solid.state(u + width * v).energy - solid.state(u - width * v).energy) / (2 * width);
    };
    const Vectors gradient = solid.gradient(u);
    CHECK(std::abs(slope(h) - gradient.cwiseProduct(v).sum())
          <= std::abs(slope(2 * h) - slope(h)) + state.rounding / h);

    const auto change = [&](double width) -> Vectors {
      return (solid.gradient(u + width * v) - solid.gradient(u - width * v)) / (2 * width);
    };
    const Eigen::VectorXd product = solid.hessian(u) * v.reshaped();
    const Vectors first = change(h), second = change(2 * h);
    CHECK((first.reshaped() - product).norm() <= (second - first).norm() + epsilon * solid.force_unit() / h);
    CHECK(product.norm() > 1);
  }
}

TEST_CASE("Neo-Hookean solid: Newton's method converges quadratically near the solution")
{
  for(const Solid& solid : solids(box(4, 1, 1, 0))) {
    Solid::Options options;
    options.tolerance = 1e-13;
    const auto result = bend(solid, 4, 0.5, options);
    REQUIRE(result);
    CHECK(result.load_steps == 1);
    // Newton's method converges quadratically: from half the distance, one step leaves a quarter of the forces. The
    // relative error of this ratio is of the order of the distance.
    Vectors v = random_displacements(solid, 1);
    for(std::size_t n = 0; n < solid.number_of_nodes(); ++n)
      if(solid.node(n).x() == 0 || solid.node(n).x() == 4) v.col(n).setZero();
    const auto forces_after_a_step = [&](double distance) {
      options.start = result.displacements + distance * v;
      return bend(solid, 4, 0.5, options).residuals.at(1);
    };
    const double h = 2e-4;
    const double forces = forces_after_a_step(h), half = forces_after_a_step(h / 2),
                 quarter = forces_after_a_step(h / 4);
    CHECK(forces / half == Approx(4).epsilon(10 * h));
    CHECK(half / quarter == Approx(4).epsilon(10 * h));
  }
}

TEST_CASE("Neo-Hookean solid: a rotation preserves the energy, and rotates forces and solutions")
{
  const Eigen::Matrix3d R = Eigen::AngleAxisd(2.3, Vector(1, 2, -0.5).normalized()).toRotationMatrix();
  for(const Solid& solid : solids(box(4, 1, 1, 0))) {
    Vectors nodes(3, solid.number_of_nodes());
    for(std::size_t n = 0; n < solid.number_of_nodes(); ++n) nodes.col(n) = solid.node(n);
    const Vectors u = random_displacements(solid, 0.05), turned = R * (nodes + u) - nodes;
    const auto state = solid.state(u), state_turned = solid.state(turned);
    CHECK(std::abs(state_turned.energy - state.energy) <= 10 * (state.rounding + state_turned.rounding));
    CHECK((solid.gradient(turned) - R * solid.gradient(u)).norm() <= 100 * epsilon * solid.force_unit());

    const auto result = bend(solid, 4, 0.9);
    Solid::Options options;
    options.start = R * nodes - nodes;
    const auto result_turned = bend(solid, 4, 0.9, options, R);
    REQUIRE(result);
    REQUIRE(result_turned);
    CHECK(result_turned.energy == Approx(result.energy).epsilon(1e-9));
    CHECK((R * (nodes + result.displacements) - nodes - result_turned.displacements).cwiseAbs().maxCoeff() < 1e-7);
    // Forces remain only where the ends are held.
    const Vectors forces = solid.gradient(result.displacements);
    for(std::size_t n = 0; n < solid.number_of_nodes(); ++n)
      if(nodes(0, n) > 0 && nodes(0, n) < 4)
        CHECK(forces.col(n).norm() <= Solid::Options().tolerance * solid.force_unit());
  }
}

TEST_CASE("Neo-Hookean solid: large motions take several load steps, and no tetrahedron is inverted on the way")
{
  for(const Solid& solid : solids(box(4, 1, 1, 0))) {
    const auto result = bend(solid, 4, 3);
    REQUIRE(result);
    CHECK(result.load_steps > 1);
    CHECK(result.least_jacobian > 0);
    CHECK(solid.state(result.displacements).least_jacobian == result.least_jacobian);
  }
}

TEST_CASE("Neo-Hookean solid: a solid whose nodes are all constrained is deformed as prescribed")
{
  for(const Solid& solid : solids(box(1, 1, 1, 0))) {
    const auto result = solid.solve(hold(solid, [](const Vector&) { return true; }),
                                    [&](std::size_t n, double t) -> Vector { return -0.5 * t * solid.node(n); });
    REQUIRE(result);
    CHECK(result.least_jacobian == Approx(0.125));
  }
}

TEST_CASE("Neo-Hookean solid: problems without a solution are rejected with a status")
{
  const Tetrahedra mesh = box(2, 2, 2, 0.2);
  const auto nothing = [](std::size_t, double) -> Vector { return Vector::Zero(); };
  const auto ends = [](const Vector& p) { return p.x() == 0; };
  for(Element_order order : orders) {
    const Solid solid(mesh.points, mesh.cells, order, material);
    Solid::Options options;
    options.start = Vectors::Zero(3, solid.number_of_nodes());
    options.start.col(13) = Vector(3, 0, 0); // moves the point in the middle out of the box
    const auto inverted = solid.solve(hold(solid, ends), nothing, options);
    CHECK(inverted.status == Solid_status::INVERTED_STATE);
    CHECK(inverted.least_jacobian < 0);
    CHECK(std::isinf(solid.state(options.start).energy));

    // One end is moved through the other.
    const auto crossed = solid.solve(
      hold(solid, [](const Vector& p) { return p.x() == 0 || p.x() == 2; }),
      [&](std::size_t n, double t) -> Vector { return t * Vector(-2 * solid.node(n).x(), 0, 0); });
    CHECK(crossed.status != Solid_status::SUCCESS);
    CHECK(crossed.load < 0.5);
    CHECK(crossed.least_jacobian > 0);
    CHECK(solid.state(crossed.displacements).least_jacobian == crossed.least_jacobian);

    Solid::Options limited;
    limited.iterations = 1;
    CHECK(bend(Solid(box(4, 1, 1, 0).points, box(4, 1, 1, 0).cells, order, material), 4, 0.5, limited).status
          == Solid_status::ITERATION_LIMIT_EXCEEDED);

    Tetrahedra wrong = mesh;
    std::swap(wrong.cells[5][0], wrong.cells[5][1]);
    const Solid turned_over(wrong.points, wrong.cells, order, material);
    CHECK(turned_over.solve(hold(turned_over, ends), nothing).status == Solid_status::INVALID_MESH);
    wrong = mesh;
    wrong.cells[7][2] = wrong.points.size();
    CHECK_FALSE(Solid(wrong.points, wrong.cells, order, material).is_valid());
  }
}

TEST_CASE("Neo-Hookean solid: displacements on facets are interpolated by the shape functions")
{
  const Tetrahedra mesh = box(1, 1, 1, 0);
  for(Element_order order : orders) {
    const Solid solid(mesh.points, mesh.cells, order, material);
    const auto function = [&](const Vector& p) -> Vector {
      return order == Element_order::LINEAR ? Vector(1 + p.x(), p.y() - 2 * p.z(), 3)
                                            : Vector(p.x() * p.y(), p.squaredNorm(), p.z() - 1);
    };
    Vectors u(3, solid.number_of_nodes());
    for(std::size_t n = 0; n < solid.number_of_nodes(); ++n) u.col(n) = function(solid.node(n));
    const std::array<std::size_t, 3> corners{ mesh.cells[0][0], mesh.cells[0][2], mesh.cells[0][1] };
    const std::array<double, 3> w{ 0.2, 0.3, 0.5 };
    Vector p = Vector::Zero();
    for(int i = 0; i < 3; ++i) p += w[i] * mesh.points[corners[i]];
    // The errors are those of sums of a dozen terms of size one.
    CHECK((solid.displacement(u, corners, w) - function(p)).norm() < 20 * epsilon);
  }
}
} // namespace test_Neo_hookean_solid
