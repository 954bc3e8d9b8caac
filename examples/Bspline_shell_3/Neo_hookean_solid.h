// Nonlinear elasticity on tetrahedra: equilibria of a compressible Neo-Hookean solid, with prescribed displacements at
// some nodes.
//
// The energy density is W(F) = mu/2 (tr(F^T F) - 3) - mu ln J + lambda/2 (ln J)^2, with the deformation gradient F and
// J = det F. Elements are linear with one quadrature point, or quadratic with straight sides (10 nodes) and four
// points, exact for polynomials of degree two. W is defined for J > 0 only. This is enforced at the quadrature points
// in all intermediate states, but not checked between the points of quadratic elements.
#ifndef NEO_HOOKEAN_SOLID_H
#define NEO_HOOKEAN_SOLID_H

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

struct Lame_parameters
{
  double mu, lambda;
};

inline Lame_parameters lame_parameters(double young, double poisson)
{
  return { young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson)) };
}

enum class Element_order
{
  LINEAR,
  QUADRATIC
};

enum class Solid_status
{
  SUCCESS,
  INVALID_MESH,
  INVERTED_STATE,
  NOT_HELD,
  MOVES_TOO_FAR,
  NO_DECREASE,
  ITERATION_LIMIT_EXCEEDED
};

inline const char* message(Solid_status status)
{
  switch(status) {
    case Solid_status::SUCCESS: return "All forces are in equilibrium.";
    case Solid_status::INVALID_MESH: return "A tetrahedron has no positive volume, or a corner that does not exist.";
    case Solid_status::INVERTED_STATE: return "A tetrahedron is inverted in the initial state.";
    case Solid_status::NOT_HELD: return "The Hessian cannot be factored: hold more nodes.";
    case Solid_status::MOVES_TOO_FAR:
      return "The nodes move too far: even the smallest load step would invert a tetrahedron.";
    case Solid_status::NO_DECREASE: return "The line search did not decrease the energy.";
    case Solid_status::ITERATION_LIMIT_EXCEEDED: return "Newton's method did not converge within the iteration limit.";
  }
  return "";
}

// `Factorization` has the interface of Eigen's sparse Cholesky factorizations, and fails if a matrix is not positive
// definite. For large meshes, Eigen::CholmodSupernodalLLT is an order of magnitude faster.
template <typename Factorization = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> >
class Neo_hookean_solid
{
public:
  typedef Eigen::Vector3d Vector;
  typedef Eigen::Matrix3Xd Vectors; // a column for each node
  typedef Eigen::SparseMatrix<double> Matrix;
  // Returns the displacement of a node at the load t, from 0 to 1.
  typedef std::function<Vector(std::size_t node, double t)> Motion;

  struct Condition
  {
    std::size_t node;
    std::array<bool, 3> is_held = { true, true, true }; // coordinates with prescribed displacements
  };

  struct Options
  {
    unsigned int load_steps = 1;  // initial number; failed steps are halved, down to 1/1024 of the initial size
    unsigned int iterations = 50; // per load step
    double tolerance = 1e-10;     // bounds the norm of the forces, in units of force_unit()
    Vectors start;                // initial displacements; zero if empty
  };

  struct Result
  {
    Solid_status status = Solid_status::SUCCESS;
    Vectors displacements; // the last equilibrium
    double load = 0;       // 1 is the full load
    // projections: number of Hessians that were modified to be positive definite
    unsigned int iterations = 0, load_steps = 0, projections = 0;
    double energy = 0, least_jacobian = 0; // least_jacobian: smallest J at a quadrature point
    std::vector<double> residuals;         // norms of the forces, in the order of the iterations

    explicit operator bool() const { return status == Solid_status::SUCCESS; }
  };

  struct State
  {
    double energy = 0, rounding = 0, least_jacobian = std::numeric_limits<double>::infinity();
  };

  // The nodes are the points, in their order; for quadratic elements, the midpoints of edges follow.
  Neo_hookean_solid(const std::vector<Vector>& points, const std::vector<std::array<std::size_t, 4> >& tetrahedra,
                    Element_order order, const Lame_parameters& material)
    : m_nodes(points), m_order(order), m_material(material)
  {
    for(const std::array<std::size_t, 4>& t : tetrahedra) {
      if(*std::max_element(t.begin(), t.end()) >= points.size()) {
        m_is_valid = false;
        continue;
      }
      Element e;
      Eigen::Matrix3d edges;
      for(int i = 0; i < 3; ++i) edges.col(i) = points[t[i + 1]] - points[t[0]];
      e.volume = edges.determinant() / 6;
      m_is_valid = m_is_valid && e.volume > 0;
      // gradients of the barycentric coordinates
      e.gradients.template rightCols<3>() = edges.inverse().transpose();
      e.gradients.col(0) = -e.gradients.template rightCols<3>().rowwise().sum();
      std::copy(t.begin(), t.end(), e.nodes.begin());
      if(order == Element_order::QUADRATIC)
        for(int n = 4; n < 10; ++n) {
          const std::size_t a = t[ends[n - 4][0]], b = t[ends[n - 4][1]];
          const auto [middle, is_new] = m_middles.emplace(std::minmax(a, b), m_nodes.size());
          if(is_new) m_nodes.push_back((points[a] + points[b]) / 2);
          e.nodes[n] = middle->second;
        }
      m_elements.push_back(e);
    }
    for_each_point([&](const Element&, const Gradients& g, double weight) {
      m_force_unit += weight * (m_material.mu + m_material.lambda) * g.norm();
    });
  }

  bool is_valid() const { return m_is_valid && !m_elements.empty(); }
  std::size_t number_of_nodes() const { return m_nodes.size(); }
  const Vector& node(std::size_t n) const { return m_nodes[n]; }

  // Returns the magnitude of the elements' forces for strains of about one, a scale for residuals.
  double force_unit() const { return m_force_unit; }

  // Returns the node in the middle of an edge of quadratic elements.
  std::size_t middle(std::size_t a, std::size_t b) const { return m_middles.at(std::minmax(a, b)); }

  // Returns all nodes on a facet with these corners.
  std::vector<std::size_t> facet_nodes(const std::array<std::size_t, 3>& corners) const
  {
    std::vector<std::size_t> nodes(corners.begin(), corners.end());
    if(m_order == Element_order::QUADRATIC)
      for(int i = 0; i < 3; ++i) nodes.push_back(middle(corners[i], corners[(i + 1) % 3]));
    return nodes;
  }

  // Returns the displacement of a point in a facet, whose corners are nodes, from barycentric coordinates.
  Vector displacement(const Vectors& u, const std::array<std::size_t, 3>& corners, const std::array<double, 3>& w) const
  {
    Vector sum = Vector::Zero();
    for(int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      if(m_order == Element_order::LINEAR) sum += w[i] * u.col(corners[i]);
      else sum += w[i] * (2 * w[i] - 1) * u.col(corners[i]) + 4 * w[i] * w[j] * u.col(middle(corners[i], corners[j]));
    }
    return sum;
  }

  // Returns the energy, an estimate of its rounding error, and the smallest J. If the smallest J is not positive, the
  // energy is infinite.
  State state(const Vectors& u) const
  {
    State s;
    double size = 0;
    for_each_point([&](const Element& e, const Gradients& g, double weight) {
      const Eigen::Matrix3d F = deformation_gradient(e, g, u);
      const double J = F.determinant(), log_J = J > 0 ? std::log(J) : 0;
      if(!(J >= s.least_jacobian)) s.least_jacobian = J;
      s.energy += weight
                  * (m_material.mu * ((F.squaredNorm() - 3) / 2 - log_J) + m_material.lambda / 2 * log_J * log_J);
      size += weight
              * (m_material.mu * ((F.squaredNorm() + 3) / 2 + std::abs(log_J)) + m_material.lambda / 2 * log_J * log_J);
    });
    if(!(s.least_jacobian > 0)) s.energy = std::numeric_limits<double>::infinity();
    // an estimate: rounding errors of n terms are assumed to add up like a random walk
    s.rounding = std::sqrt(double(m_elements.size() * points_per_element())) * std::numeric_limits<double>::epsilon()
                 * size;
    return s;
  }

  // Returns the gradient of the energy: the forces that hold the nodes in place.
  Vectors gradient(const Vectors& u) const
  {
    Vectors result = Vectors::Zero(3, Eigen::Index(m_nodes.size()));
    for_each_point([&](const Element& e, const Gradients& g, double weight) {
      const Eigen::Matrix3d F = deformation_gradient(e, g, u), G = F.inverse().transpose();
      const Eigen::Matrix3d P = m_material.mu * (F - G) + m_material.lambda * std::log(F.determinant()) * G;
      const Gradients forces = weight * P * g;
      for(Eigen::Index a = 0; a < g.cols(); ++a) result.col(e.nodes[a]) += forces.col(a);
    });
    return result;
  }

  // Returns the Hessian of the energy, for all coordinates of all nodes.
  Matrix hessian(const Vectors& u) const
  {
    std::vector<int> unknown(3 * m_nodes.size());
    for(std::size_t n = 0; n < unknown.size(); ++n) unknown[n] = int(n);
    Matrix H = pattern(unknown, int(unknown.size()));
    assemble(u, unknown, false, H);
    return H.template selfadjointView<Eigen::Lower>();
  }

  // Solves by Newton's method in load steps. Coordinates with a condition follow the motion; all others reach
  // equilibrium.
  Result solve(const std::vector<Condition>& conditions, const Motion& motion, const Options& options = Options()) const
  {
    Result result;
    const auto ended = [&](Solid_status status) {
      result.status = status;
      return result;
    };
    if(!is_valid()) return ended(Solid_status::INVALID_MESH);
    result.displacements = options.start.size() > 0 ? options.start : Vectors::Zero(3, Eigen::Index(m_nodes.size()));
    const auto record_state = [&] {
      const State now = state(result.displacements);
      result.energy = now.energy;
      result.least_jacobian = now.least_jacobian;
    };
    record_state();
    if(!(result.least_jacobian > 0)) return ended(Solid_status::INVERTED_STATE);

    // unknowns are numbered from 0; held coordinates have -1
    std::vector<int> unknown(3 * m_nodes.size(), 0);
    int number = 0;
    for(const Condition& c : conditions)
      for(int i = 0; i < 3; ++i)
        if(c.is_held[i]) unknown[3 * c.node + i] = -1;
    for(int& n : unknown) n = n < 0 ? -1 : number++;
    System system{ unknown, pattern(unknown, number), {} };
    if(number > 0) system.factorization.analyzePattern(system.H);

    const double longest = 1. / (std::max)(1u, options.load_steps);
    for(double step = longest; result.load < 1;) {
      // Rounding must not leave a tiny last step.
      const double load = result.load + step < 1 - longest / 2048 ? result.load + step : 1;
      Vectors u = result.displacements, jump = Vectors::Zero(3, u.cols());
      for(const Condition& c : conditions) {
        const Vector wanted = motion(c.node, load);
        for(int i = 0; i < 3; ++i)
          if(c.is_held[i]) jump(i, c.node) = wanted[i] - u(i, c.node);
      }
      const Solid_status status = find_equilibrium(system, jump, options, u, result);
      if(status == Solid_status::SUCCESS) {
        ++result.load_steps;
        result.load = load;
        result.displacements = u;
        record_state();
        step = (std::min)(2 * step, longest);
      } else if(status == Solid_status::NOT_HELD || step < longest / 1000) return ended(status);
      else step /= 2;
    }
    return result;
  }

private:
  typedef Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 10> Gradients; // gradients of the shape functions
  typedef Eigen::Matrix<double, 9, 9> Tangent;                          // second derivatives of W, by the columns of F

  struct Element
  {
    std::array<std::size_t, 10> nodes;
    Eigen::Matrix<double, 3, 4> gradients;
    double volume;
  };

  struct System
  {
    const std::vector<int>& unknown;
    Matrix H;
    Factorization factorization;
  };

  // edges of a tetrahedron
  static constexpr int ends[6][2] = { { 0, 1 }, { 1, 2 }, { 2, 0 }, { 0, 3 }, { 1, 3 }, { 2, 3 } };

  std::size_t points_per_element() const { return m_order == Element_order::LINEAR ? 1 : 4; }

  // Calls f(element, gradients of the shape functions, weight) for each quadrature point.
  template <typename F>
  void for_each_point(const F& f) const
  {
    const double near = 0.25 + 0.15 * std::sqrt(5.), far = (1 - near) / 3; // coordinates of the four points
    for(const Element& e : m_elements) {
      if(m_order == Element_order::LINEAR) {
        f(e, Gradients(e.gradients), e.volume);
        continue;
      }
      for(int q = 0; q < 4; ++q) {
        Gradients g(3, 10);
        const auto coordinate = [&](int i) { return i == q ? near : far; };
        for(int i = 0; i < 4; ++i) g.col(i) = (4 * coordinate(i) - 1) * e.gradients.col(i);
        for(int n = 4; n < 10; ++n) {
          const int a = ends[n - 4][0], b = ends[n - 4][1];
          g.col(n) = 4 * (coordinate(a) * e.gradients.col(b) + coordinate(b) * e.gradients.col(a));
        }
        f(e, g, e.volume / 4);
      }
    }
  }

  static Eigen::Matrix3d deformation_gradient(const Element& e, const Gradients& g, const Vectors& u)
  {
    Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
    for(Eigen::Index a = 0; a < g.cols(); ++a) F += u.col(e.nodes[a]) * g.col(a).transpose();
    return F;
  }

  Tangent tangent(const Eigen::Matrix3d& F, bool is_projected) const
  {
    const Eigen::Matrix3d G = F.inverse().transpose();
    const double factor = m_material.mu - m_material.lambda * std::log(F.determinant());
    Tangent A = m_material.mu * Tangent::Identity();
    for(int j = 0; j < 3; ++j)
      for(int l = 0; l < 3; ++l)
        A.block<3, 3>(3 * j, 3 * l) += factor * G.col(l) * G.col(j).transpose()
                                       + m_material.lambda * G.col(j) * G.col(l).transpose();
    if(!is_projected) return A;
    // Any positive bound makes the sum of the elements positive definite. It changes the iterates, not the solution.
    const Eigen::SelfAdjointEigenSolver<Tangent> eigen(A);
    return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(1e-3 * m_material.mu).asDiagonal()
           * eigen.eigenvectors().transpose();
  }

  // Calls f(row, column, row of H, column of H) for each entry of an element's matrix that belongs to the lower
  // triangle of H.
  template <typename F>
  static void for_each_entry(const Element& e, int nodes, const std::vector<int>& unknown, const F& f)
  {
    for(int r = 0; r < 3 * nodes; ++r)
      for(int c = 0; c < 3 * nodes; ++c) {
        const int row = unknown[3 * e.nodes[r / 3] + r % 3], column = unknown[3 * e.nodes[c / 3] + c % 3];
        if(column >= 0 && row >= column) f(r, c, row, column);
      }
  }

  Matrix pattern(const std::vector<int>& unknown, int number) const
  {
    std::vector<Eigen::Triplet<double> > entries;
    for(const Element& e : m_elements)
      for_each_entry(e, m_order == Element_order::LINEAR ? 4 : 10, unknown,
                     [&](int, int, int row, int column) { entries.emplace_back(row, column, 0.); });
    Matrix H(number, number);
    H.setFromTriplets(entries.begin(), entries.end());
    return H;
  }

  // Assembles the Hessian in the pattern of H. Returns the product of the Hessian and `jump`, or zero without a jump.
  Vectors assemble(const Vectors& u, const std::vector<int>& unknown, bool is_projected, Matrix& H,
                   const Vectors* jump = nullptr) const
  {
    Vectors product = Vectors::Zero(3, u.cols());
    H.coeffs().setZero();
    for_each_point([&](const Element& e, const Gradients& g, double weight) {
      const Tangent A = weight * tangent(deformation_gradient(e, g, u), is_projected);
      Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, 30> B(9, 3 * g.cols()); // maps displacements to F
      for(Eigen::Index a = 0; a < g.cols(); ++a)
        for(int l = 0; l < 3; ++l) B.template block<3, 3>(3 * l, 3 * a) = g(l, a) * Eigen::Matrix3d::Identity();
      const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 30, 30> K = B.transpose() * A * B;
      for_each_entry(e, int(g.cols()), unknown,
                     [&](int r, int c, int row, int column) { H.coeffRef(row, column) += K(r, c); });
      if(jump != nullptr)
        for(Eigen::Index a = 0; a < g.cols(); ++a)
          for(Eigen::Index b = 0; b < g.cols(); ++b)
            product.col(e.nodes[a]) += K.template block<3, 3>(3 * a, 3 * b) * jump->col(e.nodes[b]);
    });
    return product;
  }

  // The first step moves the held coordinates by `jump`, and the others by the solution of the linearized equations.
  Solid_status find_equilibrium(System& system, Vectors& jump, const Options& options, Vectors& u, Result& result) const
  {
    for(unsigned int iteration = 0;; ++iteration) {
      const bool jumps = iteration == 0 && !jump.isZero(0);
      const Vectors forces = gradient(u);
      Eigen::VectorXd rest = Eigen::VectorXd::Zero(system.H.rows());
      for(std::size_t n = 0; n < system.unknown.size(); ++n)
        if(system.unknown[n] >= 0) rest[system.unknown[n]] = forces(n % 3, n / 3);
      result.residuals.push_back(rest.norm());
      if(!jumps && rest.norm() <= options.tolerance * m_force_unit) return Solid_status::SUCCESS;
      if(iteration == options.iterations) return Solid_status::ITERATION_LIMIT_EXCEEDED;
      ++result.iterations;

      Vectors product;
      const auto factorize = [&](bool is_projected) {
        product = assemble(u, system.unknown, is_projected, system.H, jumps ? &jump : nullptr);
        if(system.H.rows() == 0) return true; // all coordinates are held
        system.factorization.factorize(system.H);
        return system.factorization.info() == Eigen::Success;
      };
      if(!factorize(false)) {
        ++result.projections;
        if(!factorize(true)) return Solid_status::NOT_HELD;
      }
      Eigen::VectorXd solution = -rest;
      for(std::size_t n = 0; n < system.unknown.size(); ++n)
        if(system.unknown[n] >= 0) solution[system.unknown[n]] -= product(n % 3, n / 3);
      if(system.H.rows() > 0) solution = system.factorization.solve(solution).eval();
      Vectors step = jumps ? jump : Vectors::Zero(3, u.cols());
      for(std::size_t n = 0; n < system.unknown.size(); ++n)
        if(system.unknown[n] >= 0) step(n % 3, n / 3) = solution[system.unknown[n]];

      double length = 1;
      if(jumps) {
        if(!(state(u + step).least_jacobian > 0)) return Solid_status::MOVES_TOO_FAR;
      } else {
        // Armijo's condition, up to rounding
        const State before = state(u);
        const double slope = rest.dot(solution);
        while(!(state(u + length * step).energy <= before.energy + 1e-4 * length * slope + before.rounding))
          if((length /= 2) < std::numeric_limits<double>::epsilon()) return Solid_status::NO_DECREASE;
      }
      u += length * step;
    }
  }

  std::vector<Vector> m_nodes;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> m_middles;
  std::vector<Element> m_elements;
  Element_order m_order;
  Lame_parameters m_material;
  double m_force_unit = 0;
  bool m_is_valid = true;
};

#endif // NEO_HOOKEAN_SOLID_H
