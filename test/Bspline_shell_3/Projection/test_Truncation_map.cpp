// Truncation_map.h: the map between a mesh and its truncated mesh is continuous and one-to-one, and returns.
#include <CGAL/Bspline_shell_3/Projection/internal/Truncation_map.h>
#include "truncations.h"

#include <array>
#include <cmath>
#include <random>

namespace test_Truncation_map {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Shell_truncation_3 Truncation;
typedef Truncation::Index Index;
typedef BS::internal::Truncation_map Truncation_map;

// Returns the position of a place in one of the cut facets, or in a new one.
Point_3 point(const Truncation& t, const Truncation_map::Place& place, bool is_new)
{
  const Truncation::Triangle triangle = is_new ? t.new_facets()[place.facet].triangle : t.cut_facets()[place.facet];
  Vector_3 p = CGAL::NULL_VECTOR;
  for(int i = 0; i < 3; ++i) {
    const auto& q = t.points()[triangle[i]];
    p = p + place.barycentric[i] * Vector_3(q[0], q[1], q[2]);
  }
  return CGAL::ORIGIN + p;
}

double distance(const Point_3& p, const Point_3& q)
{
  return std::sqrt(CGAL::squared_distance(p, q));
}

std::array<double, 3> random_barycentric(std::mt19937& random)
{
  const auto uniform = [&] { return double(random()) / double(std::mt19937::max()); };
  const double u = uniform(), v = uniform();
  return u + v > 1 ? std::array<double, 3>{ u + v - 1, 1 - u, 1 - v } : std::array<double, 3>{ 1 - u - v, u, v };
}

} // namespace

TEST_CASE("Truncation: the map fixes all points that are not cut off, and is undone by its inverse")
{
  for(bool has_point : { false, true }) {
    const auto truncation = square_pyramid(has_point).shared();
    const Truncation& t = *truncation;
    const Truncation_map map(truncation);
    std::mt19937 random(1);
    for(int n = 0; n < 4000; ++n) {
      const Truncation_map::Place place = { Index(random() % 4), random_barycentric(random) };
      const Truncation_map::Place image = map.image(place);
      REQUIRE(image.facet < t.new_facets().size());
      const Truncation_map::Place back = map.preimage(image);
      CHECK(distance(point(t, place, false), point(t, back, false)) < 1e-14);
      const bool is_in_tip = place.barycentric[0] > 0.5;
      CHECK((t.new_facets()[image.facet].disc == 0) == is_in_tip);
      if(!is_in_tip) CHECK(distance(point(t, place, false), point(t, image, true)) < 1e-15);
    }
    for(int n = 0; n < 4000; ++n) {
      const Truncation_map::Place place = { Index(random() % t.new_facets().size()), random_barycentric(random) };
      CHECK(distance(point(t, place, true), point(t, map.image(map.preimage(place)), true)) < 1e-14);
    }
    // the image of the apex, computed in each of its facets
    const Point_3 apex = point(t, map.image({ 0, { 1, 0, 0 } }), true);
    for(Index f = 1; f < 4; ++f) CHECK(distance(apex, point(t, map.image({ f, { 1, 0, 0 } }), true)) < 1e-15);
    // It is in the middle of the planar square, on the diagonal of the disc.
    if(!has_point) CHECK(distance(apex, Point_3(0, 0, 0.5)) < 1e-15);
  }
}

TEST_CASE("Truncation: the map is one-to-one, and covers each disc once")
{
  const auto truncation = square_pyramid(true).shared();
  const Truncation& t = *truncation;
  const Truncation_map map(truncation);
  // A fine grid of triangles in each tip is mapped to the disc. Areas are positive, and sum to the area of the disc.
  double area = 0;
  constexpr int n = 64;
  const auto planar = [&](const Truncation_map::Place& place) {
    const Truncation::Triangle triangle = t.new_facets()[place.facet].triangle;
    Truncation::Planar_point x = {};
    for(int i = 0; i < 3; ++i)
      for(int a = 0; a < 2; ++a) x[a] += place.barycentric[i] * t.planar(triangle[i])[a];
    return x;
  };
  for(Index f = 0; f < 4; ++f)
    for(int i = 0; i < n; ++i)
      for(int j = 0; i + j < n; ++j)
        for(int up = 0; up < (i + j + 1 < n ? 2 : 1); ++up) {
          std::array<Truncation::Planar_point, 3> x;
          const int di[2][3] = { { 0, 1, 0 }, { 1, 1, 0 } }, dj[2][3] = { { 0, 0, 1 }, { 0, 1, 1 } };
          for(int k = 0; k < 3; ++k) {
            const double u = 0.4999 * (i + di[up][k]) / n, v = 0.4999 * (j + dj[up][k]) / n;
            x[k] = planar(map.image({ f, { 1 - u - v, u, v } }));
          }
          const double twice = (x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[1][1] - x[0][1]) * (x[2][0] - x[0][0]);
          CHECK(twice > 0);
          area += twice / 2;
        }
  const double expected = 2 * 0.9998 * 0.9998;
  CHECK(area == Approx(expected).epsilon(1e-9));
}

TEST_CASE("Truncation: the derivative of the map agrees with finite differences")
{
  const Truncation_map map(square_pyramid(true).shared());
  std::mt19937 random(1);
  int tried = 0;
  for(int n = 0; n < 400; ++n) {
    const Truncation_map::Place place = { Index(random() % 4), random_barycentric(random) };
    const auto columns = map.derivative(place);
    const Truncation_map::Place image = map.image(place);
    for(int k = 0; k < 3; ++k) {
      constexpr double step = 1e-7;
      Truncation_map::Place moved = place;
      moved.barycentric[k] += step;
      moved.barycentric[(k + 1) % 3] -= step;
      if(!(moved.barycentric[(k + 1) % 3] > 0) || map.image(moved).facet != image.facet) continue;
      ++tried;
      for(int i = 0; i < 3; ++i)
        CHECK((map.image(moved).barycentric[i] - image.barycentric[i]) / step
              == Approx(columns[k][i] - columns[(k + 1) % 3][i]).margin(1e-6));
    }
  }
  CHECK(tried > 800);
}
} // namespace test_Truncation_map
