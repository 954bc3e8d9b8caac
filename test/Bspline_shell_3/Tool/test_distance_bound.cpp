#include "test_meshes.h"

#include <Verbs/distance_bound.h>

#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/tags.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <set>

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
