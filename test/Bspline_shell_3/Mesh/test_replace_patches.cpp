// replace_patches.h: meshes that have the facets of a truncation are truncated, and others stay as they are.
#include <CGAL/Bspline_shell_3/Mesh/replace_patches.h>
#include "truncations.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace test_replace_patches {

namespace BS = CGAL::Bspline_shells;
typedef BS::Shell_truncation_3 Truncation;
namespace PMP = CGAL::Polygon_mesh_processing;
typedef Truncation_parts Parts;

namespace {

template <typename FaceGraph>
void check_applied(bool has_point)
{
  FaceGraph mesh;
  const Mesh start = pyramid(4, 1);
  CGAL::copy_face_graph(start, mesh);
  Parts parts = square_pyramid(has_point);
  const double before = PMP::volume(mesh);
  const Truncation t = parts.assembled();
  auto vpm = get(CGAL::vertex_point, mesh);
  const auto found = BS::find_patches(t, mesh, vpm).cut_facets;
  REQUIRE(std::count(found.begin(), found.end(), boost::graph_traits<FaceGraph>::null_halfedge()) == 0);
  for(std::size_t n = 0; n < found.size(); ++n) {
    const auto &p = get(vpm, source(found[n], mesh)), &q = get(vpm, target(found[n], mesh));
    CHECK(Truncation::Point{ p[0], p[1], p[2] } == t.points()[t.cut_facets()[n][0]]);
    CHECK(Truncation::Point{ q[0], q[1], q[2] } == t.points()[t.cut_facets()[n][1]]);
  }
  const auto applied = BS::replace_patches(t, mesh, vpm);
  REQUIRE(applied);
  const auto& truncated = *applied;
  CHECK(CGAL::is_valid_polygon_mesh(mesh));
  CHECK(CGAL::is_closed(mesh));
  CHECK(CGAL::is_triangle_mesh(mesh));
  CHECK(truncated.vertices[0] == boost::graph_traits<FaceGraph>::null_vertex());
  REQUIRE(truncated.facets.size() == t.new_facets().size());
  for(std::size_t n = 0; n < truncated.facets.size(); ++n) {
    REQUIRE(truncated.facets[n] != boost::graph_traits<FaceGraph>::null_face());
    std::vector<Truncation::Point> corners;
    for(auto v : CGAL::vertices_around_face(halfedge(truncated.facets[n], mesh), mesh)) {
      const auto& p = get(vpm, v);
      corners.push_back({ p[0], p[1], p[2] });
    }
    const Truncation::Triangle triangle = t.new_facets()[n].triangle;
    const auto first = std::find(corners.begin(), corners.end(), t.points()[triangle[0]]);
    REQUIRE(first != corners.end());
    std::rotate(corners.begin(), first, corners.end());
    for(int i = 0; i < 3; ++i) CHECK(corners[i] == t.points()[triangle[i]]);
  }
  // The part that is cut off has half the size of the pyramid. The roof on its base has a fifth of its height.
  const double tip = before / 8;
  CHECK(PMP::volume(mesh) == Approx(before - tip + (has_point ? tip * 0.2 : 0)));
  // Nothing is left to truncate.
  CHECK(BS::find_patches(t, mesh, vpm).empty());
}

} // namespace

TEST_CASE("Truncation: meshes of several types can be truncated")
{
  for(bool has_point : { false, true }) {
    check_applied<Mesh>(has_point);
    check_applied<CGAL::Polyhedron_3<Kernel> >(has_point);
  }
}

TEST_CASE("Truncation: a mesh that lacks a facet of a patch is left unchanged")
{
  const Truncation t = square_pyramid().assembled();
  for(int change = 0; change < 3; ++change) {
    CAPTURE(change);
    Mesh mesh = pyramid(4, 1);
    if(change == 0) mesh.point(Mesh::Vertex_index(2)) = Point_3(1, 0, -0.1);
    if(change == 1)
      mesh.point(mesh.target(CGAL::Euler::add_center_vertex(mesh.halfedge(Mesh::Vertex_index(0)), mesh))) = Point_3(
        0.3, 0.3, 0.35);
    if(change == 2) {
      for(auto f : mesh.faces()) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
      mesh.collect_garbage();
    }
    const Mesh before = mesh;
    const auto truncated = BS::replace_patches(t, mesh, mesh.points());
    REQUIRE(truncated);
    const std::vector<Mesh::Face_index> none(t.new_facets().size(), Mesh::null_face());
    CHECK(truncated->facets == none);
    CHECK(is_equal(before, mesh));
  }
}

namespace {

template <typename FaceGraph>
void check_truncated(const Mesh& start, const std::vector<Mesh::Vertex_index>& centers)
{
  for(bool has_point : { false, true }) {
    FaceGraph mesh;
    CGAL::copy_face_graph(start, mesh);
    const bool was_closed = CGAL::is_closed(mesh);
    const Truncation t = truncation_at(start, centers, has_point).assembled();
    REQUIRE(t.is_valid());
    const auto truncated = BS::replace_patches(t, mesh, get(CGAL::vertex_point, mesh));
    REQUIRE(truncated);
    const auto& facets = truncated->facets;
    CHECK(std::count(facets.begin(), facets.end(), boost::graph_traits<FaceGraph>::null_face()) == 0);
    CHECK(CGAL::is_valid_polygon_mesh(mesh));
    CHECK(CGAL::is_triangle_mesh(mesh));
    CHECK(CGAL::is_closed(mesh) == was_closed);
    CHECK(faces(mesh).size() == start.number_of_faces() - t.cut_facets().size() + t.new_facets().size());
  }
}

} // namespace

TEST_CASE("Truncation: discs may share facets and edges, touch the border, and replace all vertices")
{
  const Mesh ball = sphere(1);
  std::vector<Mesh::Vertex_index> all(ball.vertices().begin(), ball.vertices().end());
  const Mesh::Vertex_index v(0), beside = ball.source(ball.halfedge(v));
  check_truncated<Mesh>(ball, { v, beside });
  check_truncated<Mesh>(ball, all);
  check_truncated<CGAL::Polyhedron_3<Kernel> >(ball, { v, beside });
  check_truncated<CGAL::Polyhedron_3<Kernel> >(ball, all);
  // All facets at the only inner vertex have an edge on the border.
  const Mesh roof = [] {
    Mesh mesh = pyramid(5, 1);
    for(auto g : std::vector<Mesh::Face_index>(mesh.faces().begin(), mesh.faces().end())) {
      bool has_apex = false;
      for(auto u : mesh.vertices_around_face(mesh.halfedge(g))) has_apex = has_apex || u == Mesh::Vertex_index(0);
      if(!has_apex) CGAL::Euler::remove_face(mesh.halfedge(g), mesh);
    }
    mesh.collect_garbage();
    return mesh;
  }();
  REQUIRE(roof.number_of_faces() == 5);
  Mesh::Vertex_index apex;
  for(auto u : roof.vertices())
    if(!roof.is_border(u)) apex = u;
  check_truncated<Mesh>(roof, { apex });
  check_truncated<CGAL::Polyhedron_3<Kernel> >(roof, { apex });
}

TEST_CASE("Truncation: a patch of two discs is matched as a whole or not at all")
{
  const Mesh ball = sphere(1);
  const Mesh::Vertex_index v(0), beside = ball.source(ball.halfedge(v));
  const Truncation t = truncation_at(ball, { v, beside }, false).assembled();
  REQUIRE(t.is_valid());
  // The moved corner belongs only to facets of the second disc.
  Mesh mesh = ball;
  for(auto u : mesh.vertices_around_target(mesh.halfedge(beside)))
    if(u != v && !mesh.halfedge(u, v).is_valid()) {
      mesh.point(u) = CGAL::ORIGIN + 1.01 * (mesh.point(u) - CGAL::ORIGIN);
      break;
    }
  REQUIRE_FALSE(is_equal(mesh, ball));
  const auto found = BS::find_patches(t, mesh, mesh.points()).cut_facets;
  CHECK(std::count(found.begin(), found.end(), Mesh::null_halfedge()) == std::ptrdiff_t(found.size()));
}

TEST_CASE("Truncation: a vertex with reordered neighbors or additional facets does not match the patch")
{
  const Mesh start = pyramid(5, 1);
  const Truncation t = truncation_at(start, { Mesh::Vertex_index(0) }, false).assembled();
  REQUIRE(t.is_valid());
  const auto is_found = [&](const Mesh& mesh) {
    const auto found = BS::find_patches(t, mesh, mesh.points()).cut_facets;
    return std::count(found.begin(), found.end(), Mesh::null_halfedge()) == 0;
  };
  REQUIRE(is_found(start));
  // A pentagram around the apex, whose facets have the same orientation.
  Mesh star;
  std::vector<Mesh::Vertex_index> v;
  for(auto u : start.vertices()) v.push_back(star.add_vertex(start.point(u)));
  std::vector<Mesh::Vertex_index> ring;
  auto spoke = start.opposite(start.halfedge(Mesh::Vertex_index(0)));
  for(; ring.size() < 5; spoke = start.opposite(start.prev(spoke))) ring.push_back(v[start.target(spoke)]);
  for(int i = 0; i < 5; ++i) star.add_face(v[0], ring[2 * i % 5], ring[2 * (i + 1) % 5]);
  CHECK(star.degree(v[0]) == 5);
  CHECK_FALSE(is_found(star));
  // A fin: an edge is doubled, with two facets between both copies.
  Mesh fin = start;
  const auto h = fin.halfedge(Mesh::Vertex_index(0)), g = fin.opposite(h);
  const auto n = fin.next(h), e = fin.add_edge(); // a second edge beside h, and a facet with two edges between them
  const auto f = fin.face(h), digon = fin.add_face();
  const auto p = fin.prev(h);
  fin.set_target(e, fin.target(h));
  fin.set_target(fin.opposite(e), fin.source(h));
  fin.set_next(p, e);
  fin.set_next(e, n);
  fin.set_face(e, f);
  fin.set_halfedge(f, e);
  fin.set_next(h, fin.opposite(e));
  fin.set_next(fin.opposite(e), h);
  fin.set_face(h, digon);
  fin.set_face(fin.opposite(e), digon);
  fin.set_halfedge(digon, h);
  CHECK(fin.opposite(h) == g);
  const auto middle = fin.target(CGAL::Euler::add_center_vertex(h, fin));
  fin.point(middle) = Point_3(2, 2, 2);
  REQUIRE(fin.is_valid());
  REQUIRE(fin.degree(Mesh::Vertex_index(0)) == 7);
  CHECK_FALSE(is_found(fin));
}

TEST_CASE("Truncation: a polygon is only cut into triangles that triangulate it")
{
  typedef std::vector<std::pair<Truncation::Triangle, std::size_t> > Triangles;
  const auto is_cut = [](const Triangles& triangles) {
    Mesh mesh;
    std::vector<Mesh::Vertex_index> v;
    for(int i = 0; i < 6; ++i) v.push_back(mesh.add_vertex(Point_3(std::cos(i), std::sin(i), 0)));
    const auto f = mesh.add_face(std::vector<Mesh::Vertex_index>(v.begin(), v.begin() + 5));
    std::size_t cut = 0;
    const auto count = [&](std::size_t, Mesh::Face_index) { ++cut; };
    const bool is = BS::internal::cut_into_triangles(mesh.halfedge(f), mesh, v, triangles, count);
    if(is) CHECK(cut == 3);
    return is;
  };
  CHECK(is_cut({ { { 0, 1, 2 }, 0 }, { { 0, 2, 3 }, 1 }, { { 0, 3, 4 }, 2 } }));
  CHECK(is_cut({ { { 2, 4, 1 }, 0 }, { { 4, 0, 1 }, 1 }, { { 3, 4, 2 }, 2 } }));
  // a missing triangle; reversed triangles; a wrong point; overlapping triangles
  CHECK_FALSE(is_cut({ { { 0, 1, 2 }, 0 }, { { 0, 2, 3 }, 1 } }));
  CHECK_FALSE(is_cut({ { { 0, 2, 1 }, 0 }, { { 0, 3, 2 }, 1 }, { { 0, 4, 3 }, 2 } }));
  CHECK_FALSE(is_cut({ { { 0, 1, 2 }, 0 }, { { 0, 2, 3 }, 1 }, { { 0, 3, 5 }, 2 } }));
  CHECK_FALSE(is_cut({ { { 0, 1, 3 }, 0 }, { { 0, 2, 3 }, 1 }, { { 0, 3, 4 }, 2 } }));
}

TEST_CASE("Truncation: an invalid truncation leaves every mesh unchanged")
{
  Parts parts = square_pyramid();
  parts.cores.pop_back();
  Mesh mesh = pyramid(4, 1);
  const auto truncated = BS::replace_patches(parts.assembled(), mesh, mesh.points());
  REQUIRE(truncated);
  CHECK(is_equal(mesh, pyramid(4, 1)));
}
} // namespace test_replace_patches
