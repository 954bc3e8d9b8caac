// Normals at the corners of triangles.
#ifndef TOOL_CARRY_CORNER_NORMALS_H
#define TOOL_CARRY_CORNER_NORMALS_H

#include "../Files/Model.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace Tool {

typedef CGAL::Exact_predicates_inexact_constructions_kernel::Vector_3 Vector;

inline Vector unit(const Vector& v)
{
  const double length = std::sqrt(v.squared_length());
  return length > 0 ? v / length : v;
}

// Returns a normal for each corner: the mean, by area, of the normals of all triangles at the point that form at most
// the crease angle with the triangle of the corner.
inline std::vector<Vector> corner_normals(const BS::Polygon_soup& soup, double crease_angle)
{
  std::vector<Vector> normal;
  std::vector<std::vector<std::size_t> > triangles_at(soup.points.size());
  for(std::size_t n = 0; n < soup.polygons.size(); ++n) {
    const auto& t = soup.polygons[n];
    const auto& p = soup.points;
    normal.push_back(CGAL::cross_product(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
    for(std::size_t v : t) triangles_at[v].push_back(n);
  }
  const double least = std::cos(crease_angle) - 1e-9;
  std::vector<Vector> result;
  for(std::size_t n = 0; n < soup.polygons.size(); ++n)
    for(std::size_t v : soup.polygons[n]) {
      Vector sum(0, 0, 0);
      for(std::size_t m : triangles_at[v])
        if(unit(normal[n]) * unit(normal[m]) >= least) sum = sum + normal[m];
      result.push_back(unit(sum));
    }
  return result;
}

} // namespace Tool

#endif // TOOL_CARRY_CORNER_NORMALS_H
