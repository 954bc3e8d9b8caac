// Disc_search.h and Spherical_discs.h: each of many random singular cones gets a disc. It is embedded, and its margin
// is close to the bound by the edges that it cuts.
#include <CGAL/Bspline_shell_3/Truncation/internal/Disc_search.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/Spherical_discs.h>
#include "test_meshes.h"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace test_Disc_search {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace PMP = CGAL::Polygon_mesh_processing;

// Returns a cone over a random closed spherical polygon that is embedded and singular.
Mesh random_cone(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  while(true) {
    Mesh cone;
    const auto apex = cone.add_vertex(Point_3(0, 0, 0));
    std::vector<Mesh::Vertex_index> link;
    for(std::size_t k = 4 + random() % 7; k > 0; --k) {
      const Vector_3 d(normal(random), normal(random), normal(random));
      link.push_back(
        cone.add_vertex(CGAL::ORIGIN + (0.5 + double(random() % 100) / 66) / std::sqrt(d.squared_length()) * d));
    }
    for(std::size_t i = 0; i < link.size(); ++i) cone.add_face(apex, link[i], link[(i + 1) % link.size()]);
    if(!PMP::does_self_intersect<CGAL::Sequential_tag>(cone) && !BS::vertex_cone(cone, apex)) return cone;
  }
}

BS::internal::Tip tip(const Mesh& cone)
{
  BS::internal::Tip result(cone, Mesh::Vertex_index(0));
  result.radius = result.shortest_edge() / 3;
  for(std::size_t i = 0; i < result.size(); ++i)
    result.radius = (std::min)(
      result.radius, std::sqrt(CGAL::squared_distance(
                       result.center, Kernel::Segment_3(result.ends[i], result.ends[(i + 1) % result.size()])))
                       / 2);
  return result;
}

bool is_embedded(const Mesh& cone, const BS::internal::Tip& tip, const BS::internal::Tip_disc& disc)
{
  const BS::Shell_truncation_3 truncation = BS::internal::assemble_truncation(cone, { tip }, { disc });
  if(!truncation.is_valid()) return false;
  Mesh result = cone;
  REQUIRE(truncation.apply(result, result.points()));
  return !PMP::does_self_intersect<CGAL::Sequential_tag>(result);
}

} // namespace

TEST_CASE("Disc search: every random singular cone gets an embedded disc with a margin")
{
  std::mt19937 random(5);
  for(int n = 0; n < 60; ++n) {
    const Mesh cone = random_cone(random);
    const BS::internal::Tip singular = tip(cone);
    const auto disc = BS::internal::Disc_search(singular)();
    REQUIRE(disc);
    // The edges bound the margin of every disc.
    CHECK(disc->margin <= singular.largest_margin() * (1 + 1e-6));
    CHECK(disc->margin > 0.3 * (std::min)(singular.largest_margin(), 0.35));
    CHECK(is_embedded(cone, singular, *disc));
  }
}

TEST_CASE("Spherical discs: parts of the sphere can replace tips")
{
  std::mt19937 random(6);
  int found = 0;
  for(int n = 0; n < 30; ++n) {
    const Mesh cone = random_cone(random);
    const BS::internal::Tip singular = tip(cone);
    for(auto& disc : BS::internal::Spherical_discs(singular)()) {
      disc.measure(singular, -1);
      if(!is_embedded(cone, singular, disc)) continue;
      ++found;
      // Facets meet the sphere at right angles.
      const double m = singular.largest_margin();
      CHECK(disc.margin > 0.7 * m / std::sqrt(1 + m * m));
    }
  }
  CHECK(found > 30);
}
} // namespace test_Disc_search
