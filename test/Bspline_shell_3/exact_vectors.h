// Points and vectors with rational coordinates.
#ifndef EXACT_VECTORS_H
#define EXACT_VECTORS_H

#include <CGAL/Exact_rational.h>

#include <array>

typedef CGAL::Exact_rational Rational;
typedef std::array<Rational, 3> Exact_point;

template <typename Point>
Exact_point exact(const Point& p)
{
  return { Rational(p[0]), Rational(p[1]), Rational(p[2]) };
}
inline Exact_point minus(const Exact_point& p, const Exact_point& q)
{
  return { p[0] - q[0], p[1] - q[1], p[2] - q[2] };
}
inline Exact_point cross(const Exact_point& u, const Exact_point& v)
{
  return { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
}
inline Rational dot(const Exact_point& u, const Exact_point& v)
{
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

#endif // EXACT_VECTORS_H
