// The rejoined soup has the facets of the mesh and the excised triangles, with common vertices at equal points.
#include <CGAL/Bspline_shell_3/Soup/check_excision.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>
#include "finned_sphere.h"
#include "test_meshes.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

namespace test_rejoin_excised {
namespace {

namespace BS = CGAL::Bspline_shells;

std::vector<Point_3> points_of(const BS::Rejoined_soup_3& joined, std::size_t triangle)
{
  std::vector<Point_3> points;
  for(std::size_t v : joined.soup.polygons[triangle]) points.push_back(joined.soup.points[v]);
  return points;
}
std::vector<Point_3> points_of(const BS::Soup_triangles& soup, std::size_t triangle)
{
  std::vector<Point_3> points;
  for(std::size_t v : soup.triangles[triangle]) points.push_back(soup.points[v]);
  return points;
}

} // namespace

TEST_CASE("Rejoining: facets of the mesh come first, then excised triangles, bit for bit, and no point is doubled")
{
  const BS::Excised_soup_3 soup = Finned_sphere::excised();
  const Mesh& mesh = soup.mesh();
  const BS::Rejoined_soup_3 joined = BS::rejoin_excised(soup, mesh);
  REQUIRE(joined);
  CHECK(joined.vertices == mesh.number_of_vertices());
  CHECK(joined.facets == mesh.number_of_faces());
  REQUIRE(joined.soup.polygons.size() == Finned_sphere::triangles);
  CHECK(joined.soup.points.size() == soup.soup().points.size());
  CHECK(std::set<Point_3>(joined.soup.points.begin(), joined.soup.points.end()).size() == joined.soup.points.size());
  std::size_t wrong = 0;
  for(auto f : mesh.faces()) {
    const auto expected = corners(mesh, f);
    wrong += points_of(joined, std::size_t(f)) != std::vector<Point_3>(expected.begin(), expected.end());
  }
  CHECK(wrong == 0);
  REQUIRE(soup.excised_triangles().size() == 3);
  for(std::size_t n = 0; n < 3; ++n)
    CHECK(points_of(joined, joined.facets + n) == points_of(soup.soup(), soup.excised_triangles()[n]));
  std::size_t known = 0;
  for(std::size_t p = 0; p < joined.soup.points.size(); ++p)
    if(joined.excised_point[p] != BS::Rejoined_soup_3::none) {
      ++known;
      CHECK(joined.soup.points[p] == soup.soup().points[joined.excised_point[p]]);
    }
  CHECK(known == 9); // three corners each
}

TEST_CASE("Rejoining: a mesh that lacks a pin does not complete the excised triangles")
{
  const BS::Excised_soup_3 soup = Finned_sphere::excised();
  Mesh mesh = soup.mesh();
  const auto v = soup.pinned_vertices()[0];
  mesh.point(v) = mesh.point(v) + Vector_3(1e-9, 0, 0);
  const BS::Rejoined_soup_3 joined = BS::rejoin_excised(soup, mesh);
  CHECK_FALSE(joined);
  CHECK(joined.verdict.status == BS::Excision_status::MISSING_PIN);
  CHECK(joined.soup.polygons.empty());
}

TEST_CASE("Contacts: pairs that meet outside of common simplices are counted")
{
  const BS::Excised_soup_3 soup = Finned_sphere::excised();
  CHECK(BS::number_of_contacts(BS::rejoin_excised(soup, soup.mesh())) == 0);

  // A neighbor of the thorn's foot is moved onto the line of one of its edges, which then lies on two facets.
  Mesh along = soup.mesh();
  const BS::Soup_triangles::Triangle& thorn = soup.soup().triangles[Finned_sphere::thorn];
  const Point_3 &low = soup.soup().points[thorn[1]], &high = soup.soup().points[thorn[2]];
  const auto foot = soup.vertex_at(thorn[0]);
  REQUIRE(foot != along.null_vertex());
  along.point(along.source(along.halfedge(foot))) = along.point(foot) + 2 * (high - along.point(foot));
  CHECK(BS::number_of_contacts(BS::rejoin_excised(soup, along)) == 2);

  // A vertex farther away is pulled through the thorn.
  Mesh through = soup.mesh();
  const auto is_near = [&](Mesh::Vertex_index v) {
    return v == foot || through.halfedge(v, foot) != through.null_halfedge();
  };
  const auto v = *std::find_if(through.vertices().begin(), through.vertices().end(), [&](Mesh::Vertex_index v) {
    const double squared_distance = CGAL::squared_distance(through.point(v), through.point(foot));
    return !is_near(v) && squared_distance < 0.1;
  });
  const Point_3 middle = CGAL::centroid(through.point(foot), low, high);
  through.point(v) = through.point(v) + 1.5 * (middle - through.point(v));
  const BS::Rejoined_soup_3 joined = BS::rejoin_excised(soup, through);
  REQUIRE(joined);
  const auto triangle = [&](std::size_t t) {
    const auto p = points_of(joined, t);
    return Kernel::Triangle_3(p[0], p[1], p[2]);
  };
  std::size_t expected = 0;
  for(auto f : through.faces_around_target(through.halfedge(v)))
    expected += CGAL::do_intersect(triangle(std::size_t(f)), Kernel::Triangle_3(through.point(foot), low, high));
  CHECK(expected > 0);
  CHECK(BS::number_of_contacts(joined) == expected);
}

} // namespace test_rejoin_excised
