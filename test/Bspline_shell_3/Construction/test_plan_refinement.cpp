// plan_refinement.h: which cells are refined, given the results of a round.
#include <CGAL/Bspline_shell_3/Construction/plan_refinement.h>
#include "random_hierarchies.h"

#include <CGAL/Bbox_3.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace test_plan_refinement {
namespace {

namespace BS = CGAL::Bspline_shells;
using BS::Obstacle_kind;
typedef Hierarchy::Index Index;
typedef std::vector<Index> Cells;

constexpr std::size_t cells_at_mesh = 1000;

// Returns a block of 7 x 7 x 7 cells of the same size.
Hierarchy block()
{
  return Hierarchy(all_cells(BS::Lattice_3(CGAL::Bbox_3(-4, -4, -4, 4, 4, 4), 1), { -3, -3, -3 }, { 3, 3, 3 }));
}

Index cell_at(const Hierarchy& cells, const Lattice_point& p)
{
  return cells.leaf(0, p);
}

std::vector<BS::Threshold_obstacle> obstacles_in(const Cells& cells)
{
  std::vector<BS::Threshold_obstacle> obstacles;
  for(Index c : cells) obstacles.push_back({ c, { 0, 0, 0 } });
  return obstacles;
}

BS::Refinement_plan plan_for(const Hierarchy& cells, const BS::Round_findings& found)
{
  return BS::plan_refinement(cells, found, cells_at_mesh, BS::Refinement_tuning());
}

// Returns the number of cells that differ from the middle one by at most one in up to `axes` coordinates.
std::size_t number_of_neighbors(int axes)
{
  return axes == 0 ? 1 : axes == 1 ? 7 : 27;
}

} // namespace

TEST_CASE("Refinement plan: without any findings, nothing is refined")
{
  const BS::Refinement_plan plan = plan_for(block(), BS::Round_findings());
  CHECK(plan.split.empty());
  CHECK(plan.at_gaps.empty());
  CHECK(plan.is_empty());
}

TEST_CASE("Refinement plan: neighbors are also refined at failing slopes and at few thick cells, but not at many")
{
  const Hierarchy cells = block();
  const Index middle = cell_at(cells, { 0, 0, 0 }), other = cell_at(cells, { 3, 3, 3 });
  BS::Round_findings found;
  SECTION("failing slopes")
  {
    found.cells_with_small_slopes = { middle };
    CHECK(plan_for(cells, found).split.size() == number_of_neighbors(3));
  }
  SECTION("few cells where the field is too large")
  {
    found.thick = { middle };
    found.thick_at_first = { other }; // was corrected
    CHECK(plan_for(cells, found).split.size() == number_of_neighbors(3));
  }
  SECTION("many cells where the field is too large, or nearly so")
  {
    found.thick = { middle };
    found.are_many_thick = true;
    found.thick_at_first = { other };
    CHECK(plan_for(cells, found).split == Cells{ (std::min)(middle, other), (std::max)(middle, other) });
  }
  SECTION("two sheets in a cell")
  {
    found.two_sheets = { middle };
    CHECK(plan_for(cells, found).split == Cells{ middle });
  }
}

TEST_CASE("Refinement plan: most neighbors are refined if the number of obstacles is neither small nor large")
{
  const Hierarchy cells = block();
  BS::Round_findings found;
  const auto split = [&](std::size_t number) {
    Cells with_obstacles;
    for(Index c = 0; c < number; ++c) with_obstacles.push_back(c);
    found.obstacles = obstacles_in(with_obstacles);
    return plan_for(cells, found).split;
  };
  const Cells few = split(8), more = split(9), many = split(cells_at_mesh / 38 + 1);
  const auto expected = [&](std::size_t number, int axes) {
    BS::Marked_cells marked(cells);
    for(Index c = 0; c < number; ++c) marked.mark_widely(c, axes);
    return marked.sorted();
  };
  CHECK(few == expected(8, 1));
  CHECK(more == expected(9, 3));
  CHECK(many == expected(cells_at_mesh / 38 + 1, 0));
  CHECK(many.size() == cells_at_mesh / 38 + 1);
}

TEST_CASE("Refinement plan: the treatment of obstacles depends on their kind")
{
  const Hierarchy cells = block();
  const Index obstacle = cell_at(cells, { 0, 0, 0 }), cause = cell_at(cells, { 2, 0, 0 }),
              thick = cell_at(cells, { 0, 3, 0 });
  BS::Round_findings found;
  found.obstacles = obstacles_in({ obstacle, obstacle });
  found.thick_at_first = { thick };
  SECTION("for few obstacles, only face neighbors are split, too")
  {
    CHECK(plan_for(cells, found).at_gaps.empty());
    CHECK(plan_for(cells, found).split.size() == number_of_neighbors(1));
  }
  SECTION("for many obstacles, their cells are split further at gaps")
  {
    found.kind = Obstacle_kind::MANY;
    CHECK(plan_for(cells, found).at_gaps == Cells{ obstacle });
  }
  SECTION("obstacles of a field that is too large are ignored")
  {
    found.kind = Obstacle_kind::THICK_FIELD;
    const BS::Refinement_plan plan = plan_for(cells, found);
    CHECK(plan.split == Cells{ thick });
    CHECK(plan.at_gaps.empty());
  }
  SECTION("obstacles at gaps with larger weights are not split, but the field is fitted again")
  {
    found.kind = Obstacle_kind::WEIGHED_GAPS;
    BS::Refinement_plan plan = plan_for(cells, found);
    CHECK(plan.split.empty());
    CHECK_FALSE(plan.is_empty());
    found.cells_with_small_slopes = { thick };
    plan = plan_for(cells, found);
    CHECK(std::binary_search(plan.split.begin(), plan.split.end(), thick));
    CHECK_FALSE(std::binary_search(plan.split.begin(), plan.split.end(), cause));
  }
  SECTION("at narrow gaps, causing cells are split instead")
  {
    found.kind = Obstacle_kind::NARROW_GAPS;
    found.causing_cells = { cause };
    const BS::Refinement_plan plan = plan_for(cells, found);
    CHECK(plan.split == Cells{ cause });
    CHECK(plan.at_gaps == Cells{ cause });
  }
}

TEST_CASE("Refinement plan: at narrow gaps, cells with obstacles are refined if causing cells are on the last level")
{
  Hierarchy cells = block();
  while(cells.number_of_levels() <= cells.max_level())
    cells = cells.refined({ cells.first_leaf(cells.number_of_levels() - 1) }, 0);
  const Index smallest = cells.first_leaf(cells.max_level());
  BS::Round_findings found;
  found.kind = Obstacle_kind::NARROW_GAPS;
  found.causing_cells = { smallest };
  found.obstacles = obstacles_in({ 0 });
  CHECK_FALSE(plan_for(cells, found).split.empty());
  found.obstacles = obstacles_in({ smallest });
  CHECK(plan_for(cells, found).split.empty());
}
} // namespace test_plan_refinement
