// Random cells, fields and thresholds of all sizes and magnitudes, and simplices in and around them.
#ifndef RANDOM_SHELLS_H
#define RANDOM_SHELLS_H

#include "worst_points.h"
#include "random_hierarchies.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef Kernel::Point_3 Point_3;
typedef std::array<Point_3, 2> Segment;
typedef std::array<Point_3, 3> Triangle;
typedef Eigen::Vector3d Vector;

inline bool chance(CGAL::Random& random, double share)
{
  return random.get_double() < share;
}
inline double sign(CGAL::Random& random)
{
  return random.get_bool() ? 1 : -1;
}
inline double power_of_ten(CGAL::Random& random, double least, double most)
{
  return std::pow(10., random.get_double(least, most));
}
inline Vector random_vector(CGAL::Random& random)
{
  const double x = random.get_double(-1, 1), y = random.get_double(-1, 1), z = random.get_double(-1, 1);
  return { x, y, z };
}
inline Vector random_direction(CGAL::Random& random)
{
  for(;;) {
    const Vector v = random_vector(random);
    if(v.norm() > 0.1 && v.norm() <= 1) return v.normalized();
  }
}

// Root cells, whose width is the unit of all other random lengths. Their corners have integer coordinates, and the
// domain is within [first, last + 1].
struct Random_cells
{
  Root_cells roots;
  Lattice_point first, last;

  // At most `most_cells` along each axis.
  Random_cells(CGAL::Random& random, int most_cells)
  {
    const double spacing = std::ldexp(random.get_double(0.5, 1), random.get_int(-300, 301));
    Vector center = Vector::Zero();
    if(chance(random, 0.5)) center = random_vector(random) * spacing * std::ldexp(1., random.get_int(0, 34));
    for(int a = 0; a < 3; ++a) {
      first[a] = -random.get_int(0, most_cells + 1);
      last[a] = first[a] + random.get_int(1, most_cells + 1) - 1;
    }
    const BS::Lattice_3 lattice(CGAL::Bbox_3(center[0], center[1], center[2], center[0], center[1], center[2]),
                                spacing);
    roots = some_cells(random, lattice, first, last, chance(random, 0.8) ? 1 : 0.85);
    if(roots.number_of_cells() == 0) roots = some_cells(random, lattice, first, last);
  }

  double spacing() const { return roots.lattice().spacing(); }
  Point_3 to_user(const Vector& u) const
  {
    const auto& origin = roots.lattice().origin();
    return Point_3(origin[0] + u[0] * spacing(), origin[1] + u[1] * spacing(), origin[2] + u[2] * spacing());
  }
  Vector anywhere(CGAL::Random& random) const
  {
    Vector u;
    for(int a = 0; a < 3; ++a) u[a] = random.get_double(first[a], last[a] + 1.);
    return u;
  }
};

// Returns a field on cells of one size or several.
inline Field zero_field(CGAL::Random& random, const Root_cells& roots)
{
  return Field(random_hierarchy(random, roots, chance(random, 0.5) ? 1 : chance(random, 0.9) ? 2 : 3));
}

// Returns f(point) for the lattice points of coefficients, in units of root cells. Linear functions are reproduced.
template <typename Function>
Eigen::VectorXd coefficients(const Field& field, const Function& f)
{
  Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
  for(std::size_t n = 0; n < field.number_of_coefficients(); ++n) {
    const auto point = field.point_of_coefficient(Field::Cell_index(n));
    int level = 0;
    while(point < field.first_point(level)) ++level; // the finest level comes first
    const auto& p = field.points(level).point(point - field.first_point(level));
    x[Eigen::Index(n)] = f(Vector(std::ldexp(p[0], -level), std::ldexp(p[1], -level), std::ldexp(p[2], -level)));
  }
  return x;
}

// Returns coefficients of order one, of several kinds.
inline Eigen::VectorXd random_coefficients(CGAL::Random& random, const Field& field, const Random_cells& cells)
{
  const Vector direction = random_direction(random), center = cells.anywhere(random) + 2 * random_vector(random);
  const int shape = random.get_int(0, 6);
  const double offset = chance(random, 0.5) ? random.get_double(-2, 2) : 0,
               noise = chance(random, 0.3) ? 0 : power_of_ten(random, -16, -0.3), curvature = random.get_double(-1, 1);
  const int magnitudes = random.get_int(0, 100);
  return coefficients(field, [&](const Vector& u) {
    double x = 0;
    switch(shape) {
      case 0: x = (u - center).norm() + offset; break; // similar to a distance
      case 1: x = direction.dot(u - center); break;    // linear
      case 2: x = direction.dot(u - center) + curvature * (u - center).squaredNorm() / 4; break;
      case 3: x = random.get_double(-1, 1); break;
      case 4: x = sign(random) * std::ldexp(random.get_double(0.5, 1), random.get_int(-magnitudes, 1)); break;
      default: x = 1 + 1e-3 * noise * direction.dot(u); break; // almost constant
    }
    return x + noise * random.get_double(-1, 1);
  });
}

inline Field random_field(CGAL::Random& random, const Random_cells& cells)
{
  Field field = zero_field(random, cells.roots);
  Eigen::VectorXd x = random_coefficients(random, field, cells);
  x *= chance(random, 0.6) ? cells.spacing() : chance(random, 0.9) ? std::ldexp(1., random.get_int(-300, 301)) : 1e300;
  if(chance(random, 0.06))
    for(int n = random.get_int(1, 4); n > 0; --n)
      x[random.get_int(0, int(x.size()))] = random.get_bool()   ? std::numeric_limits<double>::infinity()
                                            : random.get_bool() ? -std::numeric_limits<double>::infinity()
                                                                : std::numeric_limits<double>::quiet_NaN();
  field.set_coefficients(std::move(x));
  return field;
}

// Returns the field's value at a rounded point, or NaN outside the domain.
inline double rounded_value(const Field& field, const std::array<double, 3>& p)
{
  const auto c = field.locate(Point_3(p[0], p[1], p[2]));
  return c == Field::npos ? std::numeric_limits<double>::quiet_NaN() : field.cell(c).value(p);
}
inline Vector rounded_gradient(const Field& field, const std::array<double, 3>& p)
{
  const auto c = field.locate(Point_3(p[0], p[1], p[2]));
  if(c == Field::npos) return Vector::Constant(std::numeric_limits<double>::quiet_NaN());
  const auto g = field.cell(c).first_order_jet(p).gradient;
  return { g[0], g[1], g[2] };
}

inline bool is_degenerate(const Triangle& t)
{
  const Dyadic_vector p = dyadic(t[0]), n = cross(minus(dyadic(t[1]), p), minus(dyadic(t[2]), p));
  return sign(n[0]) == 0 && sign(n[1]) == 0 && sign(n[2]) == 0;
}

inline Vector rounded_normal(const Triangle& t)
{
  const Vector u(t[1][0] - t[0][0], t[1][1] - t[0][1], t[1][2] - t[0][2]),
    v(t[2][0] - t[0][0], t[2][1] - t[0][1], t[2][2] - t[0][2]);
  const double size = (std::max)(u.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min()),
               other = (std::max)(v.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  const Vector n = (u / size).cross(v / other);
  return n / (std::max)(n.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
}

// Returns a relative distance from a decision. It is usually not so small that predicates subdivide to their limits.
inline double random_distance(CGAL::Random& random)
{
  return chance(random, 0.02)
           ? 0
           : sign(random) * (chance(random, 0.3) ? power_of_ten(random, -17.5, -6) : power_of_ten(random, -6, -1));
}

// Returns triangles on a lattice or in cell faces, needles, large and tiny ones, partly outside.
inline Triangle random_triangle(CGAL::Random& random, const Random_cells& cells)
{
  for(;;) {
    const double size = chance(random, 0.7) ? power_of_ten(random, -1.5, 0) : power_of_ten(random, -5, 0.7);
    Vector u[3];
    u[0] = cells.anywhere(random);
    const double snap = chance(random, 0.3) ? std::ldexp(1., random.get_int(0, 4)) : 0;
    if(snap > 0 && chance(random, 0.7))
      for(int a = 0; a < 3; ++a)
        if(random.get_bool()) u[0][a] = std::nearbyint(u[0][a]);
    u[1] = u[0] + size * random_vector(random);
    u[2] = u[0] + size * random_vector(random);
    if(chance(random, 0.1)) u[2] = u[1] + power_of_ten(random, -9, -2) * size * random_vector(random);
    if(chance(random, 0.1))
      u[2] = u[0] + random.get_double(-1, 2) * (u[1] - u[0])
             + power_of_ten(random, -9, -2) * size * random_vector(random);
    if(snap > 0)
      for(int v = 1; v < 3; ++v)
        for(int a = 0; a < 3; ++a)
          if(random.get_bool()) u[v][a] = random.get_bool() ? u[0][a] : std::nearbyint(u[v][a] * snap) / snap;
    const Triangle t = { cells.to_user(u[0]), cells.to_user(u[1]), cells.to_user(u[2]) };
    if(!is_degenerate(t)) return t;
  }
}

// Moves vertices along the gradient to the same value of the field, so that its values between them are decisive.
inline Triangle level_triangle(const Field& field, const Triangle& t)
{
  Triangle result = t;
  const double level = rounded_value(field, { t[0][0], t[0][1], t[0][2] });
  for(int v = 1; v < 3; ++v)
    for(int step = 0; step < 4; ++step) {
      const std::array<double, 3> p = { result[v][0], result[v][1], result[v][2] };
      const Vector g = rounded_gradient(field, p), u = g / g.norm();
      const double s = (level - rounded_value(field, p)) / g.norm();
      if(!std::isfinite(s) || !u.allFinite()) return t;
      result[v] = Point_3(p[0] + s * u[0], p[1] + s * u[1], p[2] + s * u[2]);
    }
  return is_degenerate(result) ? t : result;
}

// Turns a triangle so that the least slope across it is near zero, or negative but positive at the vertices.
inline Triangle grazing_triangle(CGAL::Random& random, const Field& field, const Triangle& t)
{
  std::array<double, 3> middle;
  for(int a = 0; a < 3; ++a) middle[a] = t[0][a] / 3 + t[1][a] / 3 + t[2][a] / 3;
  const Vector gradient = rounded_gradient(field, middle) / rounded_gradient(field, middle).norm();
  if(!gradient.allFinite()) return t;
  const Vector across = gradient.cross(random_direction(random)).normalized();
  const double size = (Vector(t[1][0], t[1][1], t[1][2]) - Vector(t[0][0], t[0][1], t[0][2])).norm();
  const auto turned = [&](double angle) {
    Triangle triangle = t;
    const Vector q = size * (std::cos(angle) * gradient + std::sin(angle) * gradient.cross(across));
    const Vector r = size * across + 0.3 * q;
    triangle[1] = Point_3(t[0][0] + q[0], t[0][1] + q[1], t[0][2] + q[2]);
    triangle[2] = Point_3(t[0][0] + r[0], t[0][1] + r[1], t[0][2] + r[2]);
    return triangle;
  };
  // Returns the least slope on a grid with `parts` steps along an edge.
  const auto least_slope = [&](const Triangle& triangle, int parts) {
    const Vector n = rounded_normal(triangle);
    double least = std::numeric_limits<double>::infinity();
    for(int i = 0; i <= parts; ++i)
      for(int j = 0; i + j <= parts; ++j) {
        std::array<double, 3> p;
        for(int a = 0; a < 3; ++a)
          p[a] = (i * triangle[0][a] + j * triangle[1][a] + (parts - i - j) * triangle[2][a]) / parts;
        const Vector g = rounded_gradient(field, p);
        const double slope = n.dot(g) / g.norm();
        if(!(slope >= least)) least = slope;
      }
    return least;
  };
  constexpr int parts = 6;
  for(double end : { -1, 1 })
    if(std::isnan(least_slope(turned(end), parts))) return t;
  const bool rises = least_slope(turned(1), parts) > least_slope(turned(-1), parts);
  const auto with_least_slope = [&](double wanted, int steps) {
    double low = -1, high = 1;
    for(int step = 0; step < steps; ++step) {
      const double angle = (low + high) / 2;
      ((least_slope(turned(angle), parts) < wanted) == rises ? low : high) = angle;
    }
    return turned(rises ? high : low);
  };
  Triangle result = with_least_slope(0, 20);
  const double sag = least_slope(result, 1) - least_slope(result, parts);
  if(sag > 1e-4 && chance(random, 0.7)) result = with_least_slope(-sag * random.get_double(0, 1), 20);
  else result = with_least_slope(random_distance(random), 50);
  return is_degenerate(result) ? t : result;
}

#endif // RANDOM_SHELLS_H
