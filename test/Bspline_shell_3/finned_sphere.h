// A sphere with excised triangles, and its shell.
#ifndef FINNED_SPHERE_H
#define FINNED_SPHERE_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/certified_bspline_shell_3.h>
#include "test_meshes.h"

#include <cstddef>
#include <utility>
#include <vector>

// Returns the facets of a mesh as triangles.
inline CGAL::Bspline_shells::Soup_triangles triangles_of(const Mesh& mesh)
{
  CGAL::Bspline_shells::Soup_triangles soup;
  for(auto v : mesh.vertices()) soup.points.push_back(mesh.point(v));
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    soup.triangles.push_back(
      { std::size_t(mesh.source(h)), std::size_t(mesh.target(h)), std::size_t(mesh.target(mesh.next(h))) });
  }
  for(std::size_t n = 0; n < soup.points.size(); ++n) soup.point_of.push_back(n);
  for(std::size_t n = 0; n < soup.triangles.size(); ++n) soup.polygon_of.push_back(n);
  return soup;
}

// Returns a unit sphere with three kinds of excised triangles: the first facet, which leaves a hole; a *fin* at the
// inner edge of an inner facet, whose third point is above the sphere; and a *thorn* that has one vertex of the sphere.
// The sphere's facets at odd positions are reversed in the soup.
template <int SUBDIVISIONS>
class Finned_sphere_of_size
{
public:
  typedef CGAL::Bspline_shells::Excised_soup_3 Soup;
  static constexpr std::size_t hole = 0, facets = 20u << (2 * SUBDIVISIONS), fin = facets, thorn = facets + 1,
                               triangles = facets + 2;

  static CGAL::Bspline_shells::Soup_triangles all_triangles()
  {
    CGAL::Bspline_shells::Soup_triangles soup = triangles_of(sphere(SUBDIVISIONS));
    for(std::size_t n = 1; n < facets; n += 2) std::swap(soup.triangles[n][1], soup.triangles[n][2]);
    const auto above = [&](std::size_t v, double factor) {
      soup.points.push_back(CGAL::ORIGIN + factor * (soup.points[v] - CGAL::ORIGIN));
      return soup.points.size() - 1;
    };
    const auto &of_fin = soup.triangles[facets * 5 / 16], &of_thorn = soup.triangles[facets * 45 / 64];
    const std::size_t a = of_fin[0], b = of_fin[1], c = of_thorn[0];
    const std::size_t tip = above(a, 1.5), low = above(c, 1.2), high = above(c, 1.4);
    soup.points[high] = soup.points[high] + Vector_3(0.1, 0, 0.1);
    soup.triangles.push_back({ a, b, tip });
    soup.triangles.push_back({ c, low, high });
    for(std::size_t n = soup.point_of.size(); n < soup.points.size(); ++n) soup.point_of.push_back(n);
    for(std::size_t n = facets; n < triangles; ++n) soup.polygon_of.push_back(n);
    return soup;
  }
  static Soup excised()
  {
    using CGAL::Bspline_shells::Excision_reason;
    std::vector<Excision_reason> reasons(triangles, Excision_reason::KEPT);
    reasons[hole] = Excision_reason::INTERSECTING;
    reasons[fin] = reasons[thorn] = Excision_reason::NON_MANIFOLD;
    std::vector<char> is_reversed(triangles, 0);
    for(std::size_t n = 1; n < facets; n += 2) is_reversed[n] = 1;
    return Soup(all_triangles(), std::move(reasons), std::move(is_reversed));
  }

  const Soup soup = excised();
  const CGAL::Certified_bspline_shell_3 shell = CGAL::certified_bspline_shell_3(
    soup.mesh(), CGAL::Bspline_shells::parameters::relative_thickness(0.05));
};
typedef Finned_sphere_of_size<3> Finned_sphere; // 1280 facets

#endif // FINNED_SPHERE_H
