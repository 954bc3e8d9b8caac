// The data of a fit, made from a mesh, and coefficients of polynomials.
#ifndef FIT_PROBLEM_H
#define FIT_PROBLEM_H

#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Fit/Fit_energy.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Mesh_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Fit/sample_signed_distance.h>

#include <Eigen/Core>

typedef CGAL::Bspline_shells::Hierarchical_bspline_field_3<> Field;
typedef CGAL::Bspline_shells::Fit_energy<Field> Energy;
typedef CGAL::Bspline_shells::Energy_term Term;
typedef CGAL::Bspline_shells::Energy_weights Energy_weights;

// Returns the weights of the paper, independent of the defaults.
inline Energy_weights all_four_terms()
{
  Energy_weights weights;
  weights.mu = 0.1;
  weights.zeta = 1e5;
  weights.singular_hessian = 1;
  return weights;
}

// Returns weights for all terms, including those that are not in the paper.
inline Energy_weights all_terms_weighted()
{
  Energy_weights weights = all_four_terms();
  weights.surface = 30;
  weights.coefficients = 0.25;
  return weights;
}

struct Fit_problem
{
  CGAL::Bspline_shells::Input_mesh_3 input;
  CGAL::Bspline_shells::Lattice_3 lattice;
  CGAL::Bspline_shells::Clipped_mesh_3 clipped;
  Field field;
  std::vector<double> samples;

  Fit_problem(const Mesh& mesh, double gamma, int rings = 2)
  {
    namespace BS = CGAL::Bspline_shells;
    typedef CGAL::Sequential_tag Tag;
    const BS::Shell_status status = input.build<Tag>(mesh, get(CGAL::vertex_point, mesh), {});
    REQUIRE(status == BS::Shell_status::SUCCESS);
    lattice = BS::Lattice_3(input.bbox(), input.unit() / gamma);
    const std::vector<std::uint64_t> keys = BS::cells_entered_by_mesh<Tag>(input, lattice);
    field = Field(BS::Cell_complex_3(lattice, BS::dilate(keys, -rings, rings)));
    clipped = BS::clip_mesh_to_cells<Tag>(input, field.cells());
    const BS::Mesh_signed_distance_3 distance(input);
    samples = BS::sample_signed_distance<Tag>(distance, field.cells());
  }
  Fit_problem(const Fit_problem&) = delete; // energies refer to it

  double width() const { return lattice.spacing(); }
  double gamma() const { return input.unit() / width(); }
  Energy energy(const Energy_weights& weights = all_four_terms()) const
  {
    return Energy(field, samples, clipped, gamma(), weights);
  }

  // Returns a coefficient for each basis function, a function of its lattice point.
  template <typename Function>
  Eigen::VectorXd coefficients(const Function& f) const
  {
    Eigen::VectorXd x(field.number_of_coefficients());
    for(Field::Cell_index n = 0; n < field.number_of_coefficients(); ++n) {
      const auto& p = field.points(0).point(n);
      x[n] = f(double(p[0]), double(p[1]), double(p[2]));
    }
    return x;
  }
};

// Returns the lower triangle of (a b; b c).
inline Eigen::SparseMatrix<double> lower_triangle(double a, double b, double c)
{
  Eigen::SparseMatrix<double> lower(2, 2);
  lower.insert(0, 0) = a;
  lower.insert(1, 0) = b;
  lower.insert(1, 1) = c;
  lower.makeCompressed();
  return lower;
}

// Returns the coefficient of t^2 at the lattice coordinate i.
inline double square_coefficient(double i)
{
  return i * i - 1 / 3.;
}

// Numbers in [-1, 1] that are the same with any standard library.
class Deterministic_numbers
{
  std::uint64_t m_state;
public:
  explicit Deterministic_numbers(std::uint64_t seed) : m_state(seed) {}
  double operator()()
  {
    m_state = m_state * 6364136223846793005u + 1442695040888963407u;
    return double(m_state >> 11) / double(std::uint64_t(1) << 52) - 1;
  }
  Eigen::VectorXd vector(std::size_t size)
  {
    Eigen::VectorXd x(size);
    for(double& c : x) c = (*this)();
    return x;
  }
};

#endif // FIT_PROBLEM_H
