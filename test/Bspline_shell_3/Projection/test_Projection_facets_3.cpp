// Projection_facets_3.h: the tree finds the same as a comparison with all facets.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace test_Projection_facets_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Projection_facets_3 Facets;
typedef Facets::Coordinates Coordinates;
typedef Facets::Index Index;

Mesh triangle()
{
  Mesh mesh;
  mesh.add_face(mesh.add_vertex(Point_3(0, 0, 0)), mesh.add_vertex(Point_3(1, 0, 0.5)),
                mesh.add_vertex(Point_3(0.2, 1, 0)));
  return mesh;
}

CGAL::Bbox_3 bbox(const Facets& facets, Index f)
{
  CGAL::Bbox_3 box;
  for(int i = 0; i < 3; ++i)
    box += Point_3(facets.vertex(f, i)[0], facets.vertex(f, i)[1], facets.vertex(f, i)[2]).bbox();
  return box;
}

double distance(const Coordinates& p, const Coordinates& q)
{
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

// Returns the distance from a grid of points on a facet: an upper bound on the distance from the facet.
double sampled_distance(const Facets& facets, Index f, const Coordinates& p)
{
  constexpr int steps = 40;
  double least = std::numeric_limits<double>::infinity();
  for(int i = 0; i <= steps; ++i)
    for(int j = 0; i + j <= steps; ++j)
      least = (std::min)(
        least, distance(p, facets.point(f, { double(i) / steps, double(j) / steps, double(steps - i - j) / steps })));
  return least;
}

} // namespace

TEST_CASE("Projection facets: the closest facet is found at any distance, and some facet for NaN or infinity")
{
  for(const Mesh& mesh : { sphere(0), sphere(2), torus(3, 1, 40, 20), triangle() }) {
    const BS::Projection_target_3<Mesh> facets(mesh, mesh.points());
    std::mt19937 random(1);
    for(double size : { 0.1, 1.5, 30. }) {
      std::uniform_real_distribution<double> coordinate(-size, size);
      for(int n = 0; n < 40; ++n) {
        const Coordinates p = { coordinate(random), coordinate(random), coordinate(random) };
        const auto closest = facets.closest(p);
        const double found = distance(p, facets.point(closest.first, closest.second));
        CHECK(*std::min_element(closest.second.begin(), closest.second.end()) > -1e-9);
        double least = std::numeric_limits<double>::infinity();
        for(Index f = 0; f < facets.number_of_facets(); ++f) least = (std::min)(least, sampled_distance(facets, f, p));
        CHECK(found <= least * (1 + 1e-12));
        CHECK(found > least - 0.1);
      }
    }
    for(auto v : mesh.vertices()) {
      const Coordinates p = { mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z() };
      const auto closest = facets.closest(p);
      CHECK(distance(p, facets.point(closest.first, closest.second)) < 1e-15);
    }
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for(double x : { nan, infinity, -infinity }) CHECK(facets.closest({ x, 0, 0 }).first < facets.number_of_facets());
  }
}

TEST_CASE(
  "Projection facets: a box finds the facets whose boxes it meets, and a line the facets that it passes through")
{
  for(const Mesh& mesh : { sphere(0), torus(3, 1, 40, 20), triangle() }) {
    const BS::Projection_target_3<Mesh> facets(mesh, mesh.points());
    std::mt19937 random(2);
    std::uniform_real_distribution<double> coordinate(-4, 4), extent(0, 1);
    std::size_t passed = 0;
    for(int n = 0; n < 300; ++n) {
      const Coordinates p = { coordinate(random), coordinate(random), coordinate(random) };
      const double r = n % 10 == 0 ? 10 : extent(random);
      const CGAL::Bbox_3 box(p[0] - r, p[1] - r, p[2] - r, p[0] + r, p[1] + r, p[2] + r);
      std::vector<Index> found, expected;
      facets.visit_facets(box, [&](Index f) { found.push_back(f); });
      std::sort(found.begin(), found.end());
      for(Index f = 0; f < facets.number_of_facets(); ++f)
        if(CGAL::do_overlap(box, bbox(facets, f))) expected.push_back(f);
      CHECK(found == expected);

      // The line passes through a facet along its normal, in general position. The facet is the first one that is met
      // from behind.
      const Index f = Index(random() % facets.number_of_facets());
      const Coordinates q = facets.point(f, { 0.3, 0.33, 0.37 }), direction = facets.normal(f);
      passed += facets.facet_on_line(q, direction, -1e-3, 1e-3, 1e-9) == f ? 1 : 0;
      CHECK(facets.facet_on_line(q, { -direction[0], -direction[1], -direction[2] }, -1e-3, 1e-3, 1e-9)
            == Facets::npos);
    }
    CHECK(passed == 300);
  }
}
} // namespace test_Projection_facets_3
