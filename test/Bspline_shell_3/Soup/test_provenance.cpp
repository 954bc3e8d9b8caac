// The provenance is the change that was made to each polygon of a soup.
#include <CGAL/Bspline_shell_3/Soup/provenance.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/certified_shell_of_soup_3.h>
#include "excised_soups.h"
#include "test_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace test_provenance {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;
typedef BS::Polygon_change Change;
using excised_soups::soup_of;

std::size_t number_of(const std::vector<Change>& changes, Change change)
{
  return std::size_t(std::count(changes.begin(), changes.end(), change));
}

} // namespace

TEST_CASE("Provenance: duplicates and polygons without area are named, and reversed polygons are unchanged")
{
  BS::Polygon_soup soup = soup_of(sphere(3));
  const std::size_t size = soup.polygons.size();
  std::reverse(soup.polygons[7].begin(), soup.polygons[7].end());
  const std::vector<std::size_t> first = soup.polygons[0];
  soup.polygons.push_back({ first[2], first[1], first[0] });
  soup.polygons.push_back({ first[0], first[1], first[0] });
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(soup);
  REQUIRE(result.is_certified());
  const std::vector<Change> changes = BS::provenance(soup, result);
  REQUIRE(changes.size() == size + 2);
  CHECK(number_of(changes, Change::NONE) == size);
  CHECK(changes[size] == Change::DUPLICATE);
  CHECK(changes[size + 1] == Change::NO_AREA);
}

TEST_CASE("Provenance: polygons whose corners were moved are welded")
{
  BS::Polygon_soup soup = soup_of(sphere(3));
  soup.points.push_back(soup.points[soup.polygons[5][0]] + Vector_3(1e-6, 0, 0));
  soup.polygons[5][0] = soup.points.size() - 1;
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(soup, parameters::weld_tolerance(2e-6));
  REQUIRE(result.is_certified());
  const std::vector<Change> changes = BS::provenance(soup, result);
  CHECK(number_of(changes, Change::NONE) + number_of(changes, Change::WELDED) == changes.size());
  // The common point is that of the polygon or of its neighbors.
  CHECK((changes[5] == Change::WELDED) != (number_of(changes, Change::WELDED) > 1));
  CHECK(number_of(changes, Change::WELDED) > 0);
}

TEST_CASE("Provenance: polygons within another part of a union are hidden, and those that cross it partly")
{
  const Point_3 other(1.1, 0.2, 0.1);
  const Mesh mesh = joined(sphere(3), sphere(2, 0.7, other));
  const BS::Polygon_soup soup = soup_of(mesh);
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(soup);
  REQUIRE(result.is_certified());
  REQUIRE(result.kind() == BS::Shell_kind::UNITED);
  const std::vector<Change> changes = BS::provenance(soup, result);
  const std::size_t facets_of_first = sphere(3).number_of_faces();
  std::size_t wrong = 0, hidden = 0;
  for(auto f : mesh.faces()) {
    const bool is_first = std::size_t(f) < facets_of_first;
    double nearest = 10, farthest = 0;
    for(const Point_3& p : corners(mesh, f)) {
      const double d = std::sqrt(CGAL::squared_distance(p, is_first ? other : Point_3(0, 0, 0))) / (is_first ? 0.7 : 1);
      nearest = (std::min)(nearest, d);
      farthest = (std::max)(farthest, d);
    }
    // The spheres are polyhedra, which are within a tenth of their radius.
    const Change change = changes[std::size_t(f)];
    if(farthest < 0.9) {
      ++hidden;
      wrong += change != Change::HIDDEN;
    }
    if(nearest > 1.1) wrong += change != Change::NONE;
    if(nearest < 0.9 && farthest > 1) wrong += change != Change::PARTLY_HIDDEN;
  }
  CHECK(wrong == 0);
  CHECK(hidden > 0);
  CHECK(number_of(changes, Change::PARTLY_HIDDEN) > 0);
}

TEST_CASE("Provenance: polygons with excised triangles are named")
{
  BS::Polygon_soup soup = soup_of(sphere(3));
  const std::size_t size = soup.polygons.size();
  soup.points.emplace_back(0, 0, 3);
  soup.polygons.push_back({ soup.polygons[0][0], soup.polygons[0][1], soup.points.size() - 1 });
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(soup);
  REQUIRE(result.kind() == BS::Shell_kind::EXCISED);
  const std::vector<Change> changes = BS::provenance(soup, result);
  CHECK(number_of(changes, Change::EXCISED) == result.excised->excised_triangles().size());
  for(std::size_t t : result.excised->excised_triangles())
    CHECK(changes[result.excised->soup().polygon_of[t]] == Change::EXCISED);
  CHECK(changes[size] == Change::EXCISED);
}

TEST_CASE("Provenance: a proxy wraps all polygons")
{
  BS::Polygon_soup soup = soup_of(sphere(2));
  soup.points.emplace_back(0, 0, 1.3);
  soup.polygons.push_back({ soup.polygons[0][0], soup.polygons[0][1], soup.points.size() - 1 });
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(soup, parameters::largest_excised_share(0.));
  REQUIRE(result.proxy);
  const std::vector<Change> changes = BS::provenance(soup, result);
  CHECK(number_of(changes, Change::WRAPPED) == soup.polygons.size());
}

} // namespace test_provenance
