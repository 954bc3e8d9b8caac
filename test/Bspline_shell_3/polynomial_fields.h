// Fields that are polynomials up to rounding, on cells of one size or several. Their integral curves have closed forms.
#ifndef POLYNOMIAL_FIELDS_H
#define POLYNOMIAL_FIELDS_H

#include "random_hierarchies.h"

#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>

#include <CGAL/Random.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

typedef CGAL::Bspline_shells::Hierarchical_bspline_field_3<> Field;

// Polynomials are sums of monomials, of degree at most three in each variable.
struct Monomial
{
  double factor;
  std::array<int, 3> power;
};
typedef std::vector<Monomial> Polynomial;

// Polynomials are functions of (p - center) / scale; their values are in units of the scale.
struct Frame
{
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;

  Eigen::Vector3d to_user(const Eigen::Vector3d& u) const { return center + scale * u; }
  Eigen::Vector3d from_user(const Eigen::Vector3d& p) const { return (p - center) / scale; }
};

// Returns a coefficient of x^n by the polar form at the three knots x - w, x, x + w.
inline double coefficient(int power, double x, double w)
{
  switch(power) {
    case 0: return 1;
    case 1: return x;
    case 2: return x * x - w * w / 3;
    default: return x * (x * x - w * w);
  }
}

inline void set_polynomial(Field& field, const Polynomial& polynomial, const Frame& frame = Frame())
{
  const auto& lattice = field.cells().lattice();
  Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
  for(std::size_t n = 0; n < field.number_of_coefficients(); ++n) {
    const auto point = field.point_of_coefficient(Field::Cell_index(n));
    int level = 0;
    while(point < field.first_point(level)) ++level; // the finest level comes first
    const auto& p = field.points(level).point(point - field.first_point(level));
    const double width = std::ldexp(lattice.spacing(), -level);
    double sum = 0;
    for(const Monomial& m : polynomial) {
      double term = m.factor;
      for(int a = 0; a < 3; ++a)
        term *= coefficient(m.power[a], ((lattice.origin()[a] - frame.center[a]) + p[a] * width) / frame.scale,
                            width / frame.scale);
      sum += term;
    }
    x[Eigen::Index(n)] = frame.scale * sum;
  }
  field.set_coefficients(x);
}

// Returns the cells of a cube of side 2 around the center, eight along each side.
inline Root_cells cells_of_cube(const Frame& frame = Frame())
{
  const Eigen::Vector3d low = frame.to_user({ -1, -1, -1 }), high = frame.to_user({ 1, 1, 1 });
  CGAL::Random random(0);
  return some_cells(
    random,
    CGAL::Bspline_shells::Lattice_3(CGAL::Bbox_3(low[0], low[1], low[2], high[0], high[1], high[2]), frame.scale / 4),
    { -4, -4, -4 }, { 3, 3, 3 });
}

// Returns a field on cells of one size.
inline Field uniform_field(const Polynomial& polynomial, const Frame& frame = Frame())
{
  Field field(cells_of_cube(frame));
  set_polynomial(field, polynomial, frame);
  return field;
}

// Returns a field on cells of three sizes.
inline Field hierarchical_field(const Polynomial& polynomial, const Frame& frame = Frame(), int seed = 1)
{
  CGAL::Random random(seed);
  Field field(random_hierarchy(random, cells_of_cube(frame), 3, 2));
  set_polynomial(field, polynomial, frame);
  return field;
}

// Returns a shell; levels are in units of the frame.
inline CGAL::Bspline_shell_3<> shell_of(Field field, double inner, double outer, const Frame& frame = Frame())
{
  CGAL::Bspline_shells::Shell_report report;
  report.status = CGAL::Bspline_shells::Shell_status::SUCCESS;
  report.unit = 2 * frame.scale;
  std::vector<char> cells(field.number_of_cells(), 1);
  return CGAL::Bspline_shell_3<>(std::move(field),
                                 CGAL::Bspline_shells::Level_range{ frame.scale * inner, frame.scale * outer },
                                 std::move(cells), {}, report);
}

inline const Polynomial squared_distance = { { 1, { 2, 0, 0 } }, { 1, { 0, 2, 0 } }, { 1, { 0, 0, 2 } } };

#endif // POLYNOMIAL_FIELDS_H
