// Fields whose coefficients are a function of their points.
#ifndef COEFFICIENT_FUNCTIONS_H
#define COEFFICIENT_FUNCTIONS_H

#include "random_hierarchies.h"

#include <Eigen/Core>

#include <cstddef>

// Sets each coefficient to f(its point, the width of cells of its level).
template <typename Field, typename Function>
void set_coefficients(Field& field, const Function& f)
{
  const auto& lattice = field.cells().lattice();
  Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
  for(std::size_t n = 0; n < field.number_of_coefficients(); ++n) {
    const auto point = field.point_of_coefficient(typename Field::Cell_index(n));
    int level = 0;
    while(point < field.first_point(level)) ++level; // the finest level comes first
    const auto& p = field.points(level).point(point - field.first_point(level));
    const double width = std::ldexp(lattice.spacing(), -level);
    const auto at = [&](int a) { return lattice.origin()[std::size_t(a)] + p[std::size_t(a)] * width; };
    x[Eigen::Index(n)] = f(typename Field::Point_3(at(0), at(1), at(2)), width);
  }
  field.set_coefficients(x);
}

// Returns a field on a cube around the origin, whose coefficients are a function of the distance from the origin.
template <typename Field, typename Function>
Field radial_spline(int cells_along_half_side, double width, const Function& f)
{
  const int n = cells_along_half_side;
  Field field(all_cells(width, { -n, -n, -n }, { n - 1, n - 1, n - 1 }));
  set_coefficients(field, [&](const typename Field::Point_3& p, double) {
    return f(std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z()));
  });
  return field;
}

#endif // COEFFICIENT_FUNCTIONS_H
