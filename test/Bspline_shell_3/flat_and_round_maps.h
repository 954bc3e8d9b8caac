// Maps between meshes in closed form: between sheets along vertical lines, and between spheres along rays from the
// origin.
#ifndef FLAT_AND_ROUND_MAPS_H
#define FLAT_AND_ROUND_MAPS_H

#include "polynomial_fields.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>

#include <algorithm>
#include <array>
#include <vector>

typedef CGAL::Bspline_shell_3<Field> Polynomial_shell;
typedef CGAL::Bspline_shells::Shell_map_3<Polynomial_shell, Mesh> Polynomial_map;

// f = z
inline const Polynomial_shell& slab()
{
  static const Polynomial_shell shell = shell_of(uniform_field({ { 1, { 0, 0, 1 } } }), -0.9, 0.9);
  return shell;
}

// f = |x|^2
inline const Polynomial_shell& ball()
{
  static const Polynomial_shell shell = shell_of(uniform_field(squared_distance), 0.3, 0.9);
  return shell;
}

inline Vector_3 normal(const Mesh& mesh, Mesh::Face_index f)
{
  const std::array<Point_3, 3> t = corners(mesh, f);
  return CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
}

// Turns a mesh about the z-axis, then about the x-axis.
inline Mesh turned(const Mesh& mesh, double angle)
{
  const double c = std::cos(angle), s = std::sin(angle);
  return mapped(mesh, [&](const Point_3& p) {
    const Point_3 q(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
    return Point_3(q.x(), c * q.y() - s * q.z(), s * q.y() + c * q.z());
  });
}

#endif // FLAT_AND_ROUND_MAPS_H
