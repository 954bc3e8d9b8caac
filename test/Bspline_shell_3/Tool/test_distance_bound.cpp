#include "test_meshes.h"

#include <Commands/distance_bound.h>

#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/tags.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

namespace test_distance_bound {

constexpr double infinity = std::numeric_limits<double>::infinity();

namespace PMP = CGAL::Polygon_mesh_processing;

TEST_CASE("distance_bounds: a surface has the distance zero from itself, up to the resolution")
{
  const Mesh mesh = sphere(2, 1);
  CHECK(Tool::distance_bounds(mesh, mesh, 1e-6, infinity).largest() < 1e-5);
}

TEST_CASE("distance_bounds: the distance of parallel squares is their distance")
{
  Mesh low, high;
  for(Mesh* mesh : { &low, &high }) {
    const double z = mesh == &low ? 0 : 0.25;
    const auto v = [&](double x, double y) { return mesh->add_vertex(Point_3(x, y, z)); };
    const auto a = v(0, 0), b = v(1, 0), c = v(1, 1), d = v(0, 1);
    mesh->add_face(a, b, c);
    mesh->add_face(a, c, d);
  }
  const Tool::Distance_bounds bounds = Tool::distance_bounds(low, high, 1e-6, infinity);
  CHECK(bounds.to_second == Approx(0.25));
  CHECK(bounds.to_second >= 0.25);
  CHECK(bounds.to_first >= 0.25);
}

TEST_CASE("distance_bounds: facets beyond the limit are those near the part that is beyond it")
{
  const Mesh mesh = sphere(3, 1);
  Mesh moved = mesh;
  const Mesh::Vertex_index top(7);
  moved.point(top) = CGAL::ORIGIN + 1.1 * (moved.point(top) - CGAL::ORIGIN);
  const Tool::Distance_bounds none = Tool::distance_bounds(mesh, moved, 1e-4, 0.2),
                              some = Tool::distance_bounds(mesh, moved, 1e-4, 0.05);
  CHECK(none.beyond_limit.empty());
  CHECK(some.to_first >= 0.099);
  CHECK(!some.beyond_limit.empty());
  std::set<Mesh::Face_index> near_top;
  for(auto v : mesh.vertices_around_target(mesh.halfedge(top)))
    for(auto f : mesh.faces_around_target(mesh.halfedge(v))) near_top.insert(f);
  for(auto f : some.beyond_limit) CHECK(near_top.count(f) == 1);
}

TEST_CASE("distance_bounds: a small square is close to a large one, which is not close to it")
{
  Mesh small, large;
  for(Mesh* mesh : { &small, &large }) {
    const double s = mesh == &small ? 1 : 3;
    const auto v = [&](double x, double y) { return mesh->add_vertex(Point_3(x, y, 0)); };
    const auto a = v(-s, -s), b = v(s, -s), c = v(s, s), d = v(-s, s);
    mesh->add_face(a, b, c);
    mesh->add_face(a, c, d);
  }
  const Tool::Distance_bounds bounds = Tool::distance_bounds(small, large, 1e-3, infinity);
  CHECK(bounds.to_second < 2e-3);
  CHECK(bounds.to_first >= std::sqrt(8.));
  CHECK(bounds.to_first < 1.02 * std::sqrt(8.));
}

TEST_CASE("distance_bounds: equal surfaces with other facets have the distance zero, up to the resolution")
{
  Mesh whole, cut;
  for(Mesh* mesh : { &whole, &cut }) {
    const auto a = mesh->add_vertex(Point_3(0, 0, 0)), b = mesh->add_vertex(Point_3(1, 0, 0)),
               c = mesh->add_vertex(Point_3(1, 1, 0)), d = mesh->add_vertex(Point_3(0, 1, 0));
    mesh->add_face(a, b, mesh == &whole ? c : d);
    mesh->add_face(mesh == &whole ? a : b, c, d);
  }
  const double resolution = 1e-3;
  CHECK(Tool::distance_bounds(whole, cut, resolution, infinity).largest() <= 1.01 * resolution);
}

TEST_CASE("distance_bounds: a hole in one of two equal surfaces is found, however small it is")
{
  Mesh whole, grid;
  const auto w = [&](double x, double y) { return whole.add_vertex(Point_3(x, y, 0)); };
  const auto a = w(0, 0), b = w(1, 0), c = w(0, 1);
  whole.add_face(a, b, c);
  constexpr std::size_t n = 32;
  std::vector<Mesh::Vertex_index> v;
  for(std::size_t j = 0; j <= n; ++j)
    for(std::size_t i = 0; i <= n; ++i) v.push_back(grid.add_vertex(Point_3(double(i) / n, double(j) / n, 0)));
  for(std::size_t j = 0; j < n; ++j)
    for(std::size_t i = 0; i < n; ++i) {
      const std::size_t k = j * (n + 1) + i;
      grid.add_face(v[k], v[k + 1], v[k + n + 2]);
      grid.add_face(v[k], v[k + n + 2], v[k + n + 1]);
    }
  CHECK(Tool::distance_bounds(whole, grid, 1e-3, infinity).to_second <= 1.01e-3);

  // The largest distance is that of the center of the inscribed circle of the missing facet.
  const Mesh::Face_index missing(300);
  CGAL::Euler::remove_face(grid.halfedge(missing), grid);
  const double distance = (1 - std::sqrt(0.5)) / n;
  const Tool::Distance_bounds bounds = Tool::distance_bounds(whole, grid, 1e-3, infinity);
  CHECK(bounds.to_second >= distance);
  CHECK(bounds.to_second <= 1.02 * distance);
}

TEST_CASE("distance_bounds: bounds are not less than CGAL's Hausdorff distance, and close to it")
{
  const Mesh coarse = sphere(1, 1), fine = sphere(3, 1.01);
  REQUIRE(coarse.number_of_faces() != fine.number_of_faces());
  const Tool::Distance_bounds bounds = Tool::distance_bounds(coarse, fine, 1e-4, infinity);
  constexpr double error = 1e-3;
  const double distance = PMP::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(coarse, fine, error),
               other = PMP::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(fine, coarse, error);
  CHECK(bounds.to_second >= distance - error);
  CHECK(bounds.to_second <= 1.02 * distance + error);
  CHECK(bounds.to_first >= other - error);
  CHECK(bounds.to_first <= 1.02 * other + error);
}

} // namespace test_distance_bound
