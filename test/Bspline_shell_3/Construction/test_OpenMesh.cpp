// Shells, maps and edits of OpenMesh's meshes. CGAL's property map of their points rounds written coordinates to
// floats.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>

#include "truncations.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <iterator>
#include <vector>

namespace test_OpenMesh {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble> Poly_mesh;
typedef CGAL::Certified_bspline_shell_3 Shell;

// Returns a mesh with the same vertices and facets in the same order, without rounding.
Poly_mesh openmesh_of(const Mesh& mesh)
{
  Poly_mesh result;
  std::vector<Poly_mesh::VertexHandle> v;
  for(auto w : mesh.vertices()) {
    const Point_3& p = mesh.point(w);
    v.push_back(result.add_vertex({ p.x(), p.y(), p.z() }));
  }
  for(auto f : mesh.faces()) {
    std::vector<Poly_mesh::VertexHandle> corners;
    for(auto w : mesh.vertices_around_face(mesh.halfedge(f))) corners.push_back(v[std::size_t(w)]);
    result.add_face(corners);
  }
  return result;
}

struct Ball
{
  Poly_mesh mesh = openmesh_of(sphere(3));
  Shell shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(0.05));
};

bool is_certified(const Shell& shell, const Poly_mesh& mesh)
{
  return BS::Shell_certificate_3<Shell::Field, Shell::Threshold>(shell).verify(mesh);
}

} // namespace

TEST_CASE("OpenMesh: a shell is certified, and points are mapped between two meshes in it")
{
  const Ball ball;
  REQUIRE(ball.shell.is_certified());
  REQUIRE(ball.shell.facet_ranges().size() == ball.mesh.n_faces());
  Poly_mesh other = ball.mesh;
  for(auto v : other.vertices()) other.set_point(v, other.point(v) * 1.001);
  REQUIRE(is_certified(ball.shell, other));
  const BS::Shell_map_3 map(ball.shell, ball.mesh, other);
  bool matched = true;
  for(auto v : ball.mesh.vertices()) {
    const auto image = map(v);
    REQUIRE(image);
    const auto q = other.point(v);
    matched = matched && CGAL::squared_distance(image.point, Point_3(q[0], q[1], q[2])) < 1e-6;
  }
  CHECK(matched);
}

TEST_CASE("OpenMesh: coordinates are read at full precision")
{
  Poly_mesh mesh = openmesh_of(sphere(2));
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(0.05));
  const Shell same = CGAL::certified_bspline_shell_3(sphere(2), BS::parameters::relative_thickness(0.05));
  REQUIRE(shell.is_certified());
  CHECK(shell.report().unit == same.report().unit);
  CHECK(shell.report().cells == same.report().cells);
}

TEST_CASE("OpenMesh: simplified and remeshed meshes are certified")
{
  Ball ball;
  // num_faces() counts removed facets until the mesh collects its garbage
  const auto facets = [&ball] { return std::distance(faces(ball.mesh).begin(), faces(ball.mesh).end()); };
  const auto before = facets();
  const auto simplified = BS::simplify_in_shell(ball.mesh, ball.shell);
  REQUIRE(simplified);
  CHECK(facets() < before / 2);
  CHECK(is_certified(ball.shell, ball.mesh));

  const auto remeshed = BS::remesh_in_shell(ball.mesh, 0.3, ball.shell);
  CHECK(remeshed.status == BS::Edit_status::SUCCESS);
  CHECK(is_certified(ball.shell, ball.mesh));
}

TEST_CASE("OpenMesh: meshes can be truncated, even at vertices with common facets")
{
  const Mesh ball = sphere(1);
  const Mesh::Vertex_index v(0), beside = ball.source(ball.halfedge(v));
  for(bool has_point : { false, true }) {
    const auto truncation = truncation_at(ball, { v, beside }, has_point).shared();
    REQUIRE(truncation->is_valid());
    Poly_mesh mesh = openmesh_of(ball);
    REQUIRE(BS::replace_patches(*truncation, mesh, get(CGAL::vertex_point, mesh)));
    mesh.garbage_collection();
    const std::size_t kept = ball.number_of_faces() - truncation->cut_facets().size();
    CHECK(mesh.n_faces() == kept + truncation->new_facets().size());
    CHECK(CGAL::is_valid_polygon_mesh(mesh));
    CHECK(CGAL::is_closed(mesh));
    CHECK(CGAL::is_triangle_mesh(mesh));
  }
}

TEST_CASE("OpenMesh: a mesh is closed and opened again, or left unchanged if the closing does not fit")
{
  typedef BS::Shell_closing_3 Closing;
  const Mesh square = sheet({ 0, 1 }, { 0, 1 });
  const std::vector<Closing::Point> border = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  const auto check = [&](std::vector<Closing::Point> points, const std::vector<Closing::Triangle>& triangles,
                         bool fits) {
    points.insert(points.begin(), border.begin(), border.end());
    const Closing closing(points, 4, triangles, std::vector<Closing::Kind>(triangles.size(), Closing::Kind::BACK));
    REQUIRE(closing.is_valid());
    Poly_mesh mesh = openmesh_of(square);
    const auto attached = closing.attach(mesh, get(CGAL::vertex_point, mesh));
    REQUIRE(bool(attached) == fits);
    CHECK(CGAL::is_closed(mesh) == fits);
    if(attached) Closing::detach(mesh, *attached);
    mesh.garbage_collection();
    CHECK(mesh.n_vertices() == 4);
    CHECK(mesh.n_edges() == 5);
    CHECK(mesh.n_faces() == 2);
    CHECK(CGAL::is_valid_polygon_mesh(mesh));
  };
  check({ { 0.5, 0.5, -1 } }, { { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 4 }, { 0, 3, 4 } }, true);
  // Two facets of the closing have the diagonal of the mesh as an edge.
  check({ { 0.7, 0.3, -1 }, { 0.3, 0.7, -1 } },
        { { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 5 }, { 0, 3, 5 }, { 0, 2, 4 }, { 2, 0, 5 } }, false);
}
} // namespace test_OpenMesh
