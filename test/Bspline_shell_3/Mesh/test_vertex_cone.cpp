// vertex_cone.h: a common direction of the facets at a vertex is found whenever there is one, at any scale.
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include "input_meshes.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <optional>

namespace test_vertex_cone {
namespace {

using namespace input_meshes;

using CGAL::Bspline_shells::vertex_cone;

// Returns a pyramid over an L with arms of the given width. The kernel of the L is the square at its corner. A side of
// one arm is divided into many facets, which shift the mean of the normals away from the other arm.
Mesh pyramid_over_L(double width)
{
  return pyramid({ { 0, 0 },
                   { 1, 0 },
                   { 2, 0 },
                   { 3, 0 },
                   { 4, 0 },
                   { 5, 0 },
                   { 6, 0 },
                   { 7, 0 },
                   { 8, 0 },
                   { 8, width },
                   { width, width },
                   { width, 8 },
                   { 0, 8 } },
                 Point_3(0.25, 0.25, 2));
}

// Returns the least n . g over the facets at a vertex, with exact n and g.
CGAL::Exact_rational least_exact_product(const Mesh& mesh, Mesh::Vertex_index v, const Vector_3& g)
{
  typedef CGAL::Exact_rational ET;
  typedef CGAL::Simple_cartesian<ET> Exact;
  const auto exact = [](const Point_3& p) { return Exact::Point_3(ET(p.x()), ET(p.y()), ET(p.z())); };
  const Exact::Vector_3 e(ET(g.x()), ET(g.y()), ET(g.z()));
  bool first = true;
  ET least = 0;
  for(auto h : mesh.halfedges_around_target(mesh.halfedge(v))) {
    const Exact::Point_3 p = exact(mesh.point(v)), q = exact(mesh.point(mesh.target(mesh.next(h)))),
                         r = exact(mesh.point(mesh.source(h)));
    const ET product = CGAL::cross_product(q - p, r - p) * e;
    if(first || product < least) least = product;
    first = false;
  }
  return least;
}

// Returns the mean of the unit normals at a vertex, up to a factor.
Vector_3 mean_normal(const Mesh& mesh, Mesh::Vertex_index v)
{
  Vector_3 mean = CGAL::NULL_VECTOR;
  for(auto h : mesh.halfedges_around_target(mesh.halfedge(v))) {
    const Vector_3 n = CGAL::cross_product(mesh.point(mesh.target(mesh.next(h))) - mesh.point(v),
                                           mesh.point(mesh.source(h)) - mesh.point(v));
    mean = mean + n / std::sqrt(n.squared_length());
  }
  return mean;
}

} // namespace

TEST_CASE("Input mesh: a vertex with a tiny positive cone margin is not singular")
{
  for(int exponent : { 3, 20, 40 }) {
    CAPTURE(exponent);
    const Mesh mesh = pyramid_over_L(std::ldexp(1., -exponent));
    const auto apex = vertex_at(mesh, Point_3(0.25, 0.25, 2));
    // The mean of the normals is not a solution here, so the linear program must find one.
    REQUIRE(least_exact_product(mesh, apex, mean_normal(mesh, apex)) <= 0);
    const std::optional<Vector_3> g = vertex_cone(mesh, apex);
    REQUIRE(g);
    CHECK(g->squared_length() == Approx(1).epsilon(1e-15));
    CHECK(least_exact_product(mesh, apex, *g) > 0);
    Input_mesh_3 input;
    CHECK(check(input, mesh) == Status::SUCCESS);
  }
  // The kernel of the first polygon is a rectangle. The kernel of the second one is a segment, which has no interior.
  const Mesh flat_kernel = pyramid({ { 0, 0 }, { 4, 0 }, { 4, 2 }, { 8, 2 }, { 8, 4 }, { 4, 4 }, { 4, 6 }, { 0, 6 } },
                                   Point_3(2, 3, 2));
  const Mesh no_kernel = pyramid({ { 0, 0 }, { 4, 0 }, { 4, 4 }, { 8, 4 }, { 8, 8 }, { 2, 8 }, { 2, 4 }, { 0, 4 } },
                                 Point_3(3, 4, 2));
  CHECK(vertex_cone(flat_kernel, vertex_at(flat_kernel, Point_3(2, 3, 2))));
  CHECK_FALSE(vertex_cone(no_kernel, vertex_at(no_kernel, Point_3(3, 4, 2))));
}

TEST_CASE("Input mesh: vertex_cone() finds a direction at every vertex of an ordinary mesh, at any scale")
{
  for(double scale : { 1., std::ldexp(1., -400), std::ldexp(1., 300) }) {
    CAPTURE(scale);
    Mesh mesh = torus(3, 1, 7, 5);
    for(auto v : mesh.vertices())
      mesh.point(v) = Point_3(scale * mesh.point(v).x(), scale * mesh.point(v).y(), scale * mesh.point(v).z());
    bool all = true;
    for(auto v : mesh.vertices()) {
      const std::optional<Vector_3> g = vertex_cone(mesh, v);
      all = all && g && std::abs(g->squared_length() - 1) < 1e-15 * 4 && least_exact_product(mesh, v, *g) > 0;
    }
    CHECK(all);
  }
}
} // namespace test_vertex_cone
