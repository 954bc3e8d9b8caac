// Facets within a solid are found, whether or not they meet other parts.
#include <CGAL/Bspline_shell_3/Soup/internal/Solid_finder.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Visibility.h>
#include <CGAL/Bspline_shell_3/Soup/internal/exact_union.h>
#include "test_meshes.h"

#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace test_Visibility {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace BI = CGAL::Bspline_shells::internal;

// Returns the facets that are found among all facets of the mesh, instead of those of a union.
std::vector<std::size_t> hidden_facets(const Mesh& mesh)
{
  const BI::Solids solids = BI::Solid_finder().find<CGAL::Sequential_tag>(mesh);
  REQUIRE(solids.report);
  BI::Exact_mesh all;
  for(std::size_t color = 0; color < solids.number_of_colors; ++color) BI::add_solids(mesh, solids, color, all);
  return BI::Visibility(mesh, solids).hidden_sources(all);
}

// Returns the facets of other parts with middles within a convex part, which is given by its facets.
std::vector<std::size_t> facets_within(const Mesh& mesh, std::size_t first, std::size_t last)
{
  std::vector<std::size_t> within;
  for(Mesh::Face_index f : mesh.faces()) {
    bool is_within = std::size_t(f) < first || std::size_t(f) >= last;
    for(std::size_t n = first; n < last && is_within; ++n) {
      const auto t = corners(mesh, Mesh::Face_index(Mesh::size_type(n)));
      is_within = CGAL::orientation(t[0], t[1], t[2], centroid(mesh, f)) == CGAL::NEGATIVE;
    }
    if(is_within) within.push_back(f);
  }
  return within;
}

} // namespace

TEST_CASE("Visibility: facets with their middles within another solid are found")
{
  const Mesh cube = box(Point_3(-0.85, -0.85, -0.85), Point_3(0.85, 0.85, 0.85)), ball = sphere(3);
  const Mesh mesh = joined(cube, ball);
  std::vector<std::size_t> expected = facets_within(mesh, 12, mesh.number_of_faces());
  CHECK(expected.size() == 12);
  const std::vector<std::size_t> of_ball = facets_within(mesh, 0, 12), found = hidden_facets(mesh);
  // Facets of the ball that do not meet the cube are represented by one in each connected set, all of which are hidden.
  CHECK(of_ball.size() > 100);
  CHECK(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
  expected.insert(expected.end(), of_ball.begin(), of_ball.end());
  CHECK(std::includes(expected.begin(), expected.end(), found.begin(), found.end()));
  CHECK(found.size() > 50);
}

TEST_CASE("Visibility: a solid within another one, and facets between two solids, are hidden")
{
  const Mesh outer = box(Point_3(0, 0, 0), Point_3(3, 3, 3)), inner = box(Point_3(1, 1, 1), Point_3(2, 2, 2));
  for(const Mesh& mesh : { joined(outer, inner), reversed(joined(outer, inner)) })
    CHECK(hidden_facets(mesh) == std::vector<std::size_t>{ 12 });

  const Mesh beside = box(Point_3(3, 0, 0), Point_3(5, 3, 3));
  const Mesh mesh = joined(outer, beside);
  std::vector<std::size_t> between;
  for(Mesh::Face_index f : mesh.faces())
    if(centroid(mesh, f).x() == 3) between.push_back(f);
  CHECK(between.size() == 4);
  CHECK(hidden_facets(mesh) == between);
}
} // namespace test_Visibility
