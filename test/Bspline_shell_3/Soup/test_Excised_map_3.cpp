// The map of an excised soup: the identity on excised triangles, and along integral curves on the mesh.
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Soup/Excised_map_3.h>
#include <CGAL/Bspline_shell_3/Soup/Excision_filter.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>
#include <CGAL/Bspline_shell_3/Soup/transfer_in_excised_soup.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include "finned_sphere.h"
#include "test_meshes.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace test_Excised_map_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;
typedef BS::Excised_map_3<CGAL::Certified_bspline_shell_3> Map;

// A finned sphere and its simplified mesh.
struct Simplified
{
  Finned_sphere ball;
  Mesh mesh = ball.soup.mesh();

  Simplified()
  {
    auto is_constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:pinned", false).first;
    BS::constrain_pins(ball.soup, is_constrained);
    const BS::Facet_count_stop_predicate stop(300);
    REQUIRE(BS::simplify_in_shell(
      mesh, ball.shell,
      parameters::stop(stop).edge_is_constrained_map(is_constrained).filter(BS::Excision_filter(ball.soup))));
    mesh.collect_garbage();
  }
  Map map() const { return Map(ball.shell, ball.soup, mesh, BS::rejoin_excised(ball.soup, mesh)); }
};

const Simplified& simplified()
{
  static const Simplified example;
  return example;
}

Point_3 point(const std::vector<Point_3>& points, const std::array<std::size_t, 3>& triangle,
              const std::array<double, 3>& coordinates)
{
  Vector_3 sum(0, 0, 0);
  for(std::size_t i = 0; i < 3; ++i) sum = sum + coordinates[i] * (points[triangle[i]] - CGAL::ORIGIN);
  return CGAL::ORIGIN + sum;
}
Point_3 point(const Map& map, const BS::Triangle_location& p)
{
  return point(map.soup().soup().points, map.soup().soup().triangles[p.triangle], p.coordinates);
}
Point_3 point_of_rejoined(const Map& map, const BS::Triangle_location& p)
{
  const auto& t = map.rejoined().soup.polygons[p.triangle];
  return point(map.rejoined().soup.points, { t[0], t[1], t[2] }, p.coordinates);
}

// Returns the image by the map of the meshes, on which the corners of the triangle are found by their points.
Point_3 image_of(const Map& map, const BS::Triangle_location& p)
{
  const Mesh& mesh = map.soup().mesh();
  const auto& triangle = map.soup().soup().triangles[p.triangle];
  const auto f = map.soup().facet_of(p.triangle);
  Map::Map::Source_location location(f, {});
  std::size_t i = 0;
  for(auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
    for(std::size_t j = 0; j < 3; ++j)
      if(mesh.point(mesh.source(h)) == map.soup().soup().points[triangle[j]]) location.second[i] = p.coordinates[j];
    ++i;
  }
  const auto image = map.map()(location).point;
  return Point_3(image[0], image[1], image[2]);
}

} // namespace

TEST_CASE("Map of an excised soup: points of excised triangles stay where they are")
{
  const Map map = simplified().map();
  for(std::size_t t : { Finned_sphere::hole, Finned_sphere::fin, Finned_sphere::thorn }) {
    const BS::Triangle_location start = { t, { 0.5, 0.25, 0.25 } };
    const BS::Triangle_image image = map(start);
    REQUIRE(image);
    CHECK(image.is_excised);
    CHECK(point_of_rejoined(map, image.location) == point(map, start));
    const BS::Triangle_image back = map.inverse(image.location);
    REQUIRE(back);
    CHECK(back.is_excised);
    CHECK(back.location.triangle == t);
    CHECK(back.location.coordinates == start.coordinates);
  }
}

TEST_CASE("Map of an excised soup: points of other triangles are moved along curves, and return")
{
  const Map map = simplified().map();
  double farthest = 0, nearest_to_start = 0, error = 0;
  std::size_t lost = 0;
  for(std::size_t t = 1; t < Finned_sphere::facets; ++t) {
    const BS::Triangle_location start = { t, { 0.5, 0.3, 0.2 } };
    const BS::Triangle_image image = map(start);
    const BS::Triangle_image back = image ? map.inverse(image.location) : BS::Triangle_image();
    if(!back || image.is_excised || back.is_excised) {
      ++lost;
      continue;
    }
    const Point_3 begin = point(map, start);
    error = (std::max)(error, CGAL::squared_distance(point_of_rejoined(map, image.location), image_of(map, start)));
    farthest = (std::max)(farthest, CGAL::squared_distance(begin, point(map, back.location)));
    nearest_to_start = (std::max)(nearest_to_start,
                                  CGAL::squared_distance(begin, point_of_rejoined(map, image.location)));
  }
  CHECK(lost == 0);
  CHECK(std::sqrt(error) < 1e-8);
  CHECK(std::sqrt(farthest) < 1e-8);
  CHECK(std::sqrt(nearest_to_start) < 0.1); // the thickness of the shell
}

TEST_CASE("Transfer in an excised soup: linear values arrive, and points of excised triangles keep theirs")
{
  const Map map = simplified().map();
  std::vector<double> values, transferred;
  for(const Point_3& p : map.soup().soup().points) values.push_back(p.x() + 2 * p.y() - p.z());
  const BS::Transfer_report report = BS::transfer_point_attribute(map, values, transferred);
  CHECK(report);
  REQUIRE(transferred.size() == map.rejoined().soup.points.size());
  double largest = 0;
  for(std::size_t n = 0; n < transferred.size(); ++n) {
    const Point_3& p = map.rejoined().soup.points[n];
    const double difference = std::abs(transferred[n] - (p.x() + 2 * p.y() - p.z()));
    largest = (std::max)(largest, difference);
    const std::size_t excised = map.rejoined().excised_point[n];
    if(excised != BS::Rejoined_soup_3::none) CHECK(transferred[n] == values[excised]);
  }
  CHECK(largest < 0.2);

  // They do so even if no values can be interpolated around them.
  std::vector<double> known(values.size(), std::numeric_limits<double>::quiet_NaN());
  for(std::size_t t : map.soup().excised_triangles())
    for(std::size_t v : map.soup().soup().triangles[t]) known[v] = values[v];
  BS::transfer_point_attribute(map, known, transferred);
  std::size_t wrong = 0;
  for(std::size_t n = 0; n < transferred.size(); ++n) {
    const std::size_t excised = map.rejoined().excised_point[n];
    wrong += excised != BS::Rejoined_soup_3::none && transferred[n] != values[excised];
  }
  CHECK(wrong == 0);
}

TEST_CASE("Transfer in an excised soup: triangles get the labels of their images, and excised ones keep theirs")
{
  const Map map = simplified().map();
  const auto& soup = map.soup().soup();
  std::vector<int> labels, transferred;
  for(std::size_t t = 0; t < soup.triangles.size(); ++t)
    labels.push_back(t < Finned_sphere::facets ? point(map, { t, { 1 / 3., 1 / 3., 1 / 3. } }).z() > 0 : int(t));
  CHECK(BS::transfer_triangle_labels(map, labels, transferred));
  REQUIRE(transferred.size() == map.rejoined().soup.polygons.size());
  std::size_t wrong = 0;
  for(std::size_t t = 0; t < map.rejoined().facets; ++t) {
    const double z = point_of_rejoined(map, { t, { 1 / 3., 1 / 3., 1 / 3. } }).z();
    wrong += std::abs(z) > 0.2 && transferred[t] != (z > 0);
  }
  CHECK(wrong == 0);
  CHECK(transferred[map.rejoined().facets] == labels[Finned_sphere::hole]);
  CHECK(transferred[map.rejoined().facets + 1] == int(Finned_sphere::fin));
  CHECK(transferred[map.rejoined().facets + 2] == int(Finned_sphere::thorn));
}

} // namespace test_Excised_map_3
