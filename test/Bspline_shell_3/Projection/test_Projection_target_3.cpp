// Projection_target_3.h, Truncated_facets.h: the facets of a truncated mesh, their neighbors, and places on them.
#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include "truncations.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace test_Projection_target_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Projection_target_3<Mesh> Target;
typedef Target::Coordinates Coordinates;

// Returns a sphere whose facets begin at different corners.
Mesh ball()
{
  Mesh mesh = sphere(1);
  for(auto f : mesh.faces())
    for(std::size_t n = 0; n < std::size_t(f) % 3; ++n) mesh.set_halfedge(f, mesh.next(mesh.halfedge(f)));
  return mesh;
}

const std::vector<Mesh::Vertex_index>& centers()
{
  static const std::vector<Mesh::Vertex_index> centers = [] {
    const Mesh mesh = ball();
    const Mesh::Vertex_index v(0);
    return std::vector<Mesh::Vertex_index>{ v, mesh.source(mesh.halfedge(v)), Mesh::Vertex_index(7) };
  }();
  return centers;
}

double distance(const Coordinates& p, const Coordinates& q)
{
  return std::sqrt(CGAL::squared_distance(Point_3(p[0], p[1], p[2]), Point_3(q[0], q[1], q[2])));
}

} // namespace

TEST_CASE("Projection target: traced facets are neighbors across each of their edges")
{
  const Mesh mesh = ball();
  for(bool has_point : { false, true }) {
    const auto truncation = truncation_at(mesh, centers(), has_point).shared();
    REQUIRE(truncation->is_valid());
    const Target target(mesh, mesh.points(), truncation);
    REQUIRE(target.is_valid());
    const BS::Projection_facets_3& facets = target.traced_facets();
    const std::size_t kept = mesh.number_of_faces() - truncation->cut_facets().size();
    CHECK(facets.number_of_facets() == kept + truncation->new_facets().size());
    std::size_t right = 0;
    for(Target::Index f = 0; f < facets.number_of_facets(); ++f)
      for(int i = 0; i < 3; ++i) {
        const Target::Index g = facets.neighbor(f, i);
        REQUIRE(g != Target::npos);
        for(int j = 0; j < 3; ++j)
          if(facets.neighbor(g, j) == f && facets.vertex(g, j) == facets.vertex(f, (i + 1) % 3)
             && facets.vertex(g, (j + 1) % 3) == facets.vertex(f, i))
            ++right;
      }
    CHECK(right == 3 * facets.number_of_facets());
  }
}

TEST_CASE("Projection target: places on the mesh are traced to the truncated mesh, and back")
{
  const Mesh mesh = ball();
  const Target target(mesh, mesh.points(), truncation_at(mesh, centers(), true).shared());
  std::size_t moved = 0;
  for(Target::Index f = 0; f < mesh.number_of_faces(); ++f)
    for(int i = 0; i <= 12; ++i)
      for(int j = 0; i + j <= 12; ++j) {
        const Coordinates barycentric = { i / 12., j / 12., 1 - (i + j) / 12. };
        const auto back = target.untraced(target.traced({ f, barycentric }));
        CHECK(distance(target.point(back.first, back.second), target.point(f, barycentric)) < 1e-14);
        moved += distance(target.traced_point(f, barycentric), target.point(f, barycentric)) > 1e-14 ? 1 : 0;
      }
  CHECK(moved > 50);
}

TEST_CASE(
  "Projection target: vertices that are cut off are traced from the middles of their discs, and others in place")
{
  const Mesh mesh = ball();
  const auto truncation = truncation_at(mesh, centers(), true).shared();
  const Target target(mesh, mesh.points(), truncation);
  const std::size_t first = truncation->points().size() - centers().size();
  for(auto v : mesh.vertices()) {
    Coordinates expected = { mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z() };
    for(std::size_t n = 0; n < centers().size(); ++n)
      if(v == centers()[n]) expected = truncation->points()[first + n];
    CHECK(distance(target.traced_vertices()[std::size_t(v)], expected) < 1e-14);
  }
}

TEST_CASE("Projection target: tips of meshes with lazy coordinates are found by their rounded coordinates")
{
  typedef CGAL::Exact_predicates_exact_constructions_kernel Lazy_kernel;
  typedef CGAL::Surface_mesh<Lazy_kernel::Point_3> Lazy_mesh;
  const Mesh mesh = ball();
  const auto truncation = truncation_at(mesh, centers(), true).shared();
  // All coordinates have the same values, but wide enclosures.
  const Lazy_kernel::FT large = Lazy_kernel::FT(1e9) / 3;
  const auto wide = [&](double x) { return Lazy_kernel::FT((x + large) - large); };
  Lazy_mesh lazy;
  for(auto v : mesh.vertices()) {
    const Point_3& p = mesh.point(v);
    lazy.add_vertex({ wide(p.x()), wide(p.y()), wide(p.z()) });
  }
  for(auto f : mesh.faces()) {
    std::vector<Mesh::Vertex_index> corners;
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners.push_back(v);
    lazy.add_face(corners);
  }
  const BS::Projection_target_3<Lazy_mesh> target(lazy, lazy.points(), truncation);
  REQUIRE(target.is_valid());
  const Target of_doubles(mesh, mesh.points(), truncation);
  CHECK(target.traced_facets().number_of_facets() == of_doubles.traced_facets().number_of_facets());
  for(auto v : mesh.vertices()) {
    const bool is_cut = std::find(centers().begin(), centers().end(), v) != centers().end();
    const Coordinates p = { mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z() };
    CHECK((target.traced_vertices()[std::size_t(v)] == p) == !is_cut);
  }
}

TEST_CASE("Projection target: the nearest place on the border of a square, and the triangles of its closing, are found")
{
  const Mesh mesh = sheet(steps(0, 1, 4), steps(0, 1, 4));
  typedef BS::Shell_closing_3 Closing;
  const auto tent = std::make_shared<const Closing>(
    std::vector<Closing::Point>{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.5, 0.5, -0.5 } }, 4,
    std::vector<Closing::Triangle>{ { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 4 }, { 0, 3, 4 } },
    std::vector<Closing::Kind>(4, Closing::Kind::BACK));
  const Target target(mesh, mesh.points(), nullptr, tent);
  REQUIRE(target.is_valid());
  CHECK(target.closing() == tent);
  // the point, and the nearest point of the border
  const std::vector<std::array<Coordinates, 2> > cases = {
    { { { 0.3, 0.1, 0 }, { 0.3, 0, 0 } } },     { { { 0.3, -2, 5 }, { 0.3, 0, 0 } } },
    { { { 0.875, 0.6, 0.1 }, { 1, 0.6, 0 } } }, { { { 2, 3, 1 }, { 1, 1, 0 } } },
    { { { 0.2, 0.99, -0.3 }, { 0.2, 1, 0 } } }, { { { -1e-3, 0.25, 0 }, { 0, 0.25, 0 } } },
  };
  for(const auto& c : cases) {
    const auto nearest = target.closest_on_border(c[0]);
    REQUIRE(nearest.first < target.number_of_facets());
    CHECK(distance(target.point(nearest.first, nearest.second), c[1]) < 1e-15);
    double sum = 0;
    for(double w : nearest.second) {
      CHECK(w >= 0);
      sum += w;
    }
    CHECK(sum == Approx(1));
  }
  const BS::Projection_facets_3& facets = target.closing_facets();
  REQUIRE(facets.number_of_facets() == 4);
  for(Target::Index f = 0; f < 4; ++f) {
    CHECK(facets.neighbor(f, 0) == Target::npos);
    CHECK(facets.neighbor(f, 1) == (f + 3) % 4);
    CHECK(facets.neighbor(f, 2) == (f + 1) % 4);
    CHECK(facets.vertex(f, 2) == tent->points()[4]);
  }
  CHECK(Target(mesh, mesh.points()).closing_facets().number_of_facets() == 0);
  const Mesh closed = ball();
  CHECK(Target(closed, closed.points(), nullptr, tent).closing_facets().number_of_facets() == 0);
}
} // namespace test_Projection_target_3
