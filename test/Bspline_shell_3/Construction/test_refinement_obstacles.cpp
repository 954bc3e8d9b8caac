// refinement_obstacles.h: walls and gaps at places that block a proof, narrowest first, and messages about them.
#include <CGAL/Bspline_shell_3/Construction/refinement_obstacles.h>
#include "random_hierarchies.h"
#include "input_of_mesh.h"
#include <CGAL/certified_bspline_shell_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace test_refinement_obstacles {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;
typedef Hierarchy::Index Index;

} // namespace

TEST_CASE("Obstacles: the narrower of wall and gap is reported unless it is far wider than the cell, narrowest first")
{
  // A plate of thickness 0.3 at z = 1. For y > 0, there is a plate of thickness 0.6 above it, at a distance of 0.2.
  const BS::Input_mesh_3 input = input_of(
    joined(box(Point_3(-3, -3, 1), Point_3(3, 3, 1.3)), box(Point_3(-3, 0, 1.5), Point_3(3, 3, 2.1))));
  const auto cells_of_width = [&](double width) {
    const int n = int(4 / width);
    return Hierarchy(all_cells(width, { -n, -n, -n }, { n - 1, n - 1, n - 1 }));
  };
  const Hierarchy cells = cells_of_width(0.25);
  const BS::Clipped_mesh_3 clipped = BS::clip_mesh_to_cells<CGAL::Sequential_tag>(input, cells);
  const BS::Local_gap_3 gap(input);
  std::map<Index, std::array<double, 3> > places;
  const auto add = [&](double x, double y, double z) { places[cells.locate(Point_3(x, y, z))] = { x, y, z }; };
  add(0.1, -1.1, 1.05); // a wall
  add(0.1, 1.1, 1.3);   // the gap
  add(0.1, 1.1, 2.1);   // a wall
  add(0.1, 1.1, 3.1);   // neither
  const std::vector<BS::Refinement_obstacle> found = BS::refinement_obstacles<CGAL::Sequential_tag>(cells, clipped, gap,
                                                                                                    places);
  REQUIRE(found.size() == 4);
  const double gaps[] = { 0.2, 0.3, 0.6 }, heights[] = { 1.3, 1.05, 2.1, 3.1 };
  for(int n = 0; n < 4; ++n) {
    CHECK(found[n].point[2] == heights[n]);
    CHECK(found[n].cell_width == 0.25);
    if(n < 3) CHECK(found[n].gap == Approx(gaps[n]));
    if(n < 3) CHECK(found[n].is_wall == (n > 0));
  }
  CHECK(std::isinf(found[3].gap));
  const auto same = BS::refinement_obstacles<CGAL::Parallel_if_available_tag>(cells, clipped, gap, places);
  CHECK(std::equal(same.begin(), same.end(), found.begin(),
                   [](const auto& a, const auto& b) { return a.point == b.point && a.gap == b.gap; }));

  // The wall is far wider than these small cells.
  const Hierarchy small = cells_of_width(0.125);
  const BS::Clipped_mesh_3 in_small = BS::clip_mesh_to_cells<CGAL::Sequential_tag>(input, small);
  const std::map<Index, std::array<double, 3> > one = { { small.locate(Point_3(0.1, 1.1, 2.1)), { 0.1, 1.1, 2.1 } } };
  CHECK(std::isinf(BS::refinement_obstacles<CGAL::Sequential_tag>(small, in_small, gap, one).front().gap));
}

TEST_CASE("Obstacles: if a limit ends refinement, the report has the wall, its location, and the cell size it may need")
{
  const double thickness = 0.002;
  const Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, thickness));
  const auto shell = CGAL::certified_bspline_shell_3(mesh, parameters::resolution(10.).memory_limit(1e7));
  REQUIRE(shell);
  CHECK_FALSE(shell.is_certified());
  const auto& obstacles = shell.report().obstacles;
  REQUIRE_FALSE(obstacles.empty());
  std::size_t wrong = 0;
  for(const BS::Refinement_obstacle& o : obstacles) {
    const Index c = shell.field().locate(Point_3(o.point[0], o.point[1], o.point[2]));
    wrong += c == Hierarchy::npos || o.cell_width != shell.field().cells().width(c);
    wrong += std::isfinite(o.gap) && !(o.is_wall && o.gap > 0.999 * thickness);
  }
  CHECK(wrong == 0);
  CHECK(obstacles.front().gap == Approx(thickness).epsilon(1e-6));
  CHECK(std::is_sorted(obstacles.begin(), obstacles.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; }));
  const std::string sentence = message(obstacles.front(), shell.report().unit, shell.report().refinement);
  CHECK(sentence.find("The wall at ") == 0);
  CHECK(sentence.find(" is 0.2 % of the bounding box thick, and cells are ") != std::string::npos);
  CHECK(sentence.find(" wide; cells of 0.1 % may be needed.") != std::string::npos);

  // A certified shell has no obstacles.
  const auto proved = CGAL::certified_bspline_shell_3(sphere(2), parameters::resolution(10.));
  REQUIRE(proved.is_certified());
  CHECK(proved.report().obstacles.empty());
}

TEST_CASE("Obstacles: messages name a gap or a wall, or the missing proof if nothing is narrow")
{
  BS::Refinement_obstacle o;
  o.point = { 1, 2, 3 };
  o.cell_width = 0.5;
  const auto sentence = [&o](BS::Refinement_status refinement) { return BS::message(o, 10, refinement); };
  using BS::Refinement_status;
  CHECK(sentence(Refinement_status::LIMIT_REACHED)
        == "The proof fails at 1 2 3, where cells are 5 % of the bounding box wide.");
  o.gap = 0.1;
  CHECK(sentence(Refinement_status::LIMIT_REACHED)
        == "The gap at 1 2 3 is 1 % of the bounding box wide, and cells are 5 % wide; cells of 0.5 % may be needed.");
  // Smaller cells made no progress, so they are not suggested.
  CHECK(sentence(Refinement_status::NO_PROGRESS)
        == "The gap at 1 2 3 is 1 % of the bounding box wide, and cells are 5 % wide: remove it if it is an error of "
           "the mesh, or try a smaller thickness there (sizing).");
  o.is_wall = true;
  o.gap = 1;
  CHECK(sentence(Refinement_status::NO_PROGRESS)
        == "The wall at 1 2 3 is 10 % of the bounding box thick, and cells are 5 % wide.");
}
} // namespace test_refinement_obstacles
