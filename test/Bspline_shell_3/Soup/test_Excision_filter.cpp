// Edits of the mesh of an excised soup keep the contact with excised triangles, and add nothing to it.
#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Soup/Excision_filter.h>
#include <CGAL/Bspline_shell_3/Soup/check_excision.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include "finned_sphere.h"
#include "test_meshes.h"

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/property_map.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace test_Excision_filter {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;

// The collapse of an edge, as the filter sees it. Vertices are points.
struct Profile
{
  typedef Point_3 vertex_descriptor;
  struct Triangle
  {
    Point_3 v0, v1, v2;
  };

  Point_3 first, second;
  std::vector<Triangle> around;

  const Point_3& v0() const { return first; }
  const Point_3& v1() const { return second; }
  const Point_3& p0() const { return first; }
  const Point_3& p1() const { return second; }
  const std::vector<Triangle>& triangles() const { return around; }
  CGAL::Identity_property_map<Point_3> vertex_point_map() const { return {}; }
};

const Point_3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1), e(2, 2, 2), far(5, 5, 5);

// Returns a tetrahedron without a facet, in contact with other triangles at its vertices a, b, c, and d.
BS::Excised_soup_3 tetrahedron_with(std::vector<BS::Soup_triangles::Triangle> excised)
{
  BS::Soup_triangles soup;
  soup.points = { a, b, c, d, e };
  soup.triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 } };
  std::vector<BS::Excision_reason> reasons(soup.triangles.size(), BS::Excision_reason::KEPT);
  for(const auto& t : excised) {
    soup.triangles.push_back(t);
    reasons.push_back(BS::Excision_reason::INTERSECTING);
  }
  soup.point_of = { 0, 1, 2, 3, 4 };
  soup.polygon_of.assign(soup.triangles.size(), 0);
  const std::size_t n = reasons.size();
  return BS::Excised_soup_3(std::move(soup), std::move(reasons), std::vector<char>(n, 0));
}

bool passes(const BS::Excised_soup_3& soup, const Profile& profile, const Point_3& placement,
            BS::New_contacts contacts = BS::New_contacts::ALLOWED)
{
  return bool(BS::Excision_filter(soup, contacts)(profile, BS::internal::Optional<Point_3>(placement)));
}

} // namespace

TEST_CASE("Excision filter: a new vertex must not have the coordinates of an excised point")
{
  const BS::Excised_soup_3 soup = tetrahedron_with({ { 0, 1, 4 } });
  const Profile profile = { far, Point_3(6, 5, 5), {} };
  CHECK(passes(soup, profile, Point_3(5.5, 5, 5)));
  CHECK_FALSE(passes(soup, profile, e));
  CHECK(passes(soup, { a, far, {} }, a));
  CHECK(passes(soup, { far, a, {} }, a));
  CHECK_FALSE(passes(soup, { a, a, {} }, a));
  CHECK_FALSE(bool(BS::Excision_filter(soup)(profile, BS::internal::Optional<Point_3>())));
}

TEST_CASE("Excision filter: a new edge must not be that of an excised triangle, unless the mesh has it already")
{
  // In the mesh, a and b are neighbors; b and e, and a and e, are not.
  const BS::Excised_soup_3 soup = tetrahedron_with({ { 0, 1, 4 } });
  CHECK_FALSE(passes(soup, { b, far, { { far, e, c } } }, b));
  CHECK_FALSE(passes(soup, { b, far, { { c, far, e } } }, b));
  CHECK_FALSE(passes(soup, { far, b, { { e, c, far } } }, b));
  CHECK(passes(soup, { b, far, { { far, a, c } } }, b));
  // The facets at the kept vertex do not change, and those of the edge vanish.
  CHECK(passes(soup, { b, far, { { b, e, c }, { b, far, e } } }, b));
  CHECK(passes(soup, { c, far, { { far, e, b } } }, c));
}

TEST_CASE("Excision filter: a new facet must not have the corners of an excised triangle")
{
  // The mesh has the three edges of the excised triangle, but not the triangle.
  const BS::Excised_soup_3 soup = tetrahedron_with({ { 0, 3, 2 } });
  REQUIRE(soup.mesh().number_of_faces() == 3);
  CHECK_FALSE(passes(soup, { a, far, { { far, c, d } } }, a));
  CHECK_FALSE(passes(soup, { far, a, { { d, c, far } } }, a));
  CHECK(passes(soup, { a, far, { { far, c, b } } }, a));
}

TEST_CASE("Excision filter: on request, a collapse must not add a contact with excised triangles")
{
  // A facet with a vertex below passes through the triangle (a, b, e).
  const BS::Excised_soup_3 soup = tetrahedron_with({ { 0, 1, 4 } });
  const Point_3 below(1, 0.6, -3), u(1, 0.7, 3), w(0.9, 0.9, 3), above(1, 1, 5);
  const auto rejected = BS::New_contacts::REJECTED;
  const Profile from_above = { far, above, { { far, u, w } } }, from_below = { far, below, { { below, u, w } } };
  CHECK(passes(soup, from_above, below));
  CHECK_FALSE(passes(soup, from_above, below, rejected));
  CHECK(passes(soup, from_above, above, rejected));
  CHECK(passes(soup, from_below, below + Vector_3(0.01, 0, 0), rejected));
  CHECK(passes(soup, from_below, above, rejected));
  // Facets that share a vertex or an edge with the triangle do not meet it elsewhere.
  CHECK(passes(soup, { far, above, { { far, a, b }, { far, e, above } } }, Point_3(0, 0, -5), rejected));
  const Point_3 v(1, 0.1, -3), t(2, 0, -3);
  CHECK(passes(soup, { far, b, { { far, v, t } } }, b, rejected));
}

TEST_CASE("Excision filter: a mesh simplified with it and with constrained pins can replace the mesh of the soup")
{
  const Finned_sphere ball;
  REQUIRE(ball.shell.is_certified());
  const BS::Facet_count_stop_predicate stop(200);
  Mesh mesh = ball.soup.mesh();
  auto is_constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:pinned", false).first;
  BS::constrain_pins(ball.soup, is_constrained);
  const auto kept = BS::simplify_in_shell(
    mesh, ball.shell,
    parameters::stop(stop).edge_is_constrained_map(is_constrained).filter(BS::Excision_filter(ball.soup)));
  REQUIRE(kept);
  CHECK(kept.facets <= 200);
  mesh.collect_garbage();
  CHECK(BS::check_replacement(ball.soup, mesh));

  Mesh free = ball.soup.mesh();
  REQUIRE(BS::simplify_in_shell(free, ball.shell, parameters::stop(stop)));
  free.collect_garbage();
  CHECK(BS::check_replacement(ball.soup, free).status == BS::Excision_status::MISSING_PIN);
}

TEST_CASE("Excision filter: a new facet must have no vertex, edge or corners that only excised triangles have")
{
  const auto permits = [](const BS::Excised_soup_3& soup, const Point_3& p, const Point_3& q, const Point_3& r) {
    const BS::Excision_filter filter(soup);
    const bool result = filter(p, q, r);
    CHECK(filter(q, r, p) == result);
    CHECK(filter(r, q, p) == result);
    return result;
  };
  const BS::Excised_soup_3 soup = tetrahedron_with({ { 0, 1, 4 } });
  CHECK(permits(soup, a, b, far)); // the mesh has this edge
  CHECK_FALSE(permits(soup, far, c, e));
  CHECK_FALSE(permits(soup, a, b, e));
  const BS::Excised_soup_3 closed = tetrahedron_with({ { 0, 3, 2 } });
  CHECK_FALSE(permits(closed, a, c, d));
  CHECK(permits(closed, a, c, b));
}

TEST_CASE("Excision filter: on request, a new facet must have no contact with excised triangles")
{
  const BS::Excised_soup_3 soup = tetrahedron_with({ { 0, 1, 4 } });
  const Point_3 below(1, 0.6, -3), u(1, 0.7, 3), w(0.9, 0.9, 3); // the facet passes through (a, b, e)
  CHECK(BS::Excision_filter(soup)(below, u, w));
  CHECK_FALSE(BS::Excision_filter(soup, BS::New_contacts::REJECTED)(below, u, w));
  CHECK(BS::Excision_filter(soup, BS::New_contacts::REJECTED)(below, a, b));
}

TEST_CASE("Excision filter: a mesh remeshed with it can replace the mesh of the soup, where flips could double an edge")
{
  // One edge of a sphere is flipped. An excised triangle has the original edge, which remeshing would restore.
  Mesh start = sphere(3);
  const auto flipped = *start.halfedges().begin();
  const std::size_t p = std::size_t(start.source(flipped)), q = std::size_t(start.target(flipped));
  CGAL::Euler::flip_edge(flipped, start);
  BS::Soup_triangles soup = triangles_of(start);
  soup.points.push_back(CGAL::ORIGIN + 1.5 * (soup.points[p] - CGAL::ORIGIN));
  soup.point_of.push_back(soup.point_of.size());
  soup.triangles.push_back({ p, q, soup.points.size() - 1 });
  soup.polygon_of.push_back(soup.polygon_of.size());
  std::vector<BS::Excision_reason> reasons(soup.triangles.size(), BS::Excision_reason::KEPT);
  reasons.back() = BS::Excision_reason::NON_MANIFOLD;
  const std::vector<char> is_reversed(reasons.size(), 0);
  const BS::Excised_soup_3 excised(std::move(soup), std::move(reasons), is_reversed);
  const CGAL::Certified_bspline_shell_3 shell = CGAL::certified_bspline_shell_3(excised.mesh(),
                                                                                parameters::relative_thickness(0.05));
  REQUIRE(shell.is_certified());
  const auto remeshed = [&](const auto& filter) {
    Mesh mesh = excised.mesh();
    auto is_pin = mesh.add_property_map<Mesh::Vertex_index, bool>("v:pin", false).first;
    for(auto v : excised.pinned_vertices()) is_pin[v] = true;
    REQUIRE(BS::remesh_in_shell(mesh, 0.15, shell, parameters::vertex_is_constrained_map(is_pin).filter(filter)));
    mesh.collect_garbage();
    return mesh;
  };
  CHECK(BS::check_replacement(excised, remeshed(BS::Excision_filter(excised))));
  const auto permissive = [](const Point_3&, const Point_3&, const Point_3&) { return true; };
  CHECK(BS::check_replacement(excised, remeshed(permissive)).status == BS::Excision_status::COMMON_EDGE);
}

TEST_CASE("Excision filter: pinned edges are constrained, and one edge at each pinned vertex without one")
{
  const BS::Excised_soup_3 soup = Finned_sphere::excised();
  Mesh mesh = soup.mesh();
  auto is_constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:pinned", false).first;
  BS::constrain_pins(soup, is_constrained);
  std::size_t constrained = 0;
  for(auto f : mesh.edges()) constrained += is_constrained[f];
  CHECK(constrained == 2); // one for the fin, and one for the thorn
  REQUIRE(soup.pinned_edges().size() == 1);
  CHECK(is_constrained[soup.pinned_edges()[0]]);
  REQUIRE(soup.pinned_vertices().size() == 3);
  for(auto v : soup.pinned_vertices()) {
    std::size_t at_vertex = 0;
    for(auto h : mesh.halfedges_around_target(mesh.halfedge(v))) at_vertex += is_constrained[mesh.edge(h)];
    CHECK(at_vertex == 1);
  }
}

} // namespace test_Excision_filter
