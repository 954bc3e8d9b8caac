// Random numbers, points and functions with all bits random; a number of CGAL::Random has only 32.
#ifndef TEST_RANDOM_H
#define TEST_RANDOM_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>

#include <CGAL/Random.h>

#include <array>
#include <cmath>

inline double random_number(CGAL::Random& random, double least, double most)
{
  return random.get_double(least, most) + std::ldexp(random.get_double(0, most - least), -31);
}

inline std::array<double, 3> random_point(CGAL::Random& random, double least = 0, double most = 1)
{
  return { random_number(random, least, most), random_number(random, least, most), random_number(random, least, most) };
}

// Returns a function with coefficients of both signs, of sizes between 1 and 2^-spread.
inline CGAL::Bspline_shells::Enclosed_tricubic random_function(CGAL::Random& random, int spread, double radius = 0)
{
  CGAL::Bspline_shells::Enclosed_tricubic f;
  for(double& x : f.coefficients) x = std::ldexp(random_number(random, -1, 1), -random.get_int(0, spread + 1));
  f.radius = radius;
  return f;
}

#endif // TEST_RANDOM_H
