// Threshold_obstacle.h: cells of obstacles, and cells that cause them.
#include <CGAL/Bspline_shell_3/Construction/Threshold_obstacle.h>
#include "random_hierarchies.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace test_Threshold_obstacle {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Sequential_tag Tag;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef BS::Threshold_obstacle Obstacle;
typedef Field::Cell_index Index;

Root_cells cells()
{
  return all_cells(1, { -6, -6, -6 }, { 5, 5, 5 });
}

std::vector<Index> functions(const Field& field, Index c)
{
  std::vector<Index> all;
  field.visit_coefficients(c, [&](int, Index u, double) { all.push_back(u); });
  std::sort(all.begin(), all.end());
  return all;
}

bool share_a_function(const std::vector<Index>& a, const std::vector<Index>& b)
{
  std::vector<Index> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  return !common.empty();
}

bool contains(const std::vector<Index>& cells, Index c)
{
  return std::binary_search(cells.begin(), cells.end(), c);
}

Obstacle obstacle(Index c, CGAL::Sign side, double size)
{
  return { c, { 0, 0, 0 }, side, size };
}

} // namespace

TEST_CASE("Threshold obstacles: each cell of the obstacles is listed once")
{
  CHECK(BS::cells_of({}).empty());
  CHECK(BS::cells_of({ obstacle(7, CGAL::ZERO, 0), obstacle(3, CGAL::POSITIVE, 1), obstacle(7, CGAL::NEGATIVE, 1) })
        == std::vector<Index>{ 3, 7 });
}

TEST_CASE("Causing cells: they share a function with the cell of the obstacle, and the range of the field is too large "
          "on its side")
{
  CGAL::Random random(3);
  const Field equal{ Hierarchy(cells()) };
  const Field graded(random_hierarchy(random, cells(), 3, 2));
  for(const Field* field : { &equal, &graded }) {
    std::vector<BS::Level_range> ranges(field->number_of_cells());
    for(BS::Level_range& r : ranges)
      if(random.get_double() < 0.7) r = { -random.get_double(), random.get_double() };
    std::size_t missed = 0, wrong = 0, found = 0;
    for(int n = 0; n < 20; ++n) {
      const Index c = Index(random.get_int(0, int(ranges.size())));
      const std::vector<Index> here = functions(*field, c);
      for(CGAL::Sign side : { CGAL::POSITIVE, CGAL::NEGATIVE }) {
        const std::vector<Index> causing_cells = BS::causing_cells_of<Tag>(*field, ranges, { obstacle(c, side, 0.8) },
                                                                           0.5);
        CHECK(std::is_sorted(causing_cells.begin(), causing_cells.end()));
        found += causing_cells.size();
        const auto is_too_large = [&](Index d) {
          return (side == CGAL::POSITIVE ? ranges[d].max : -ranges[d].min) > 0.4;
        };
        for(Index d = 0; d < ranges.size(); ++d) {
          const bool expected = is_too_large(d) && share_a_function(here, functions(*field, d));
          missed += expected && !contains(causing_cells, d);
          // On cells of different sizes, some causing cells are between the cells in the supports.
          wrong += contains(causing_cells, d) && !(field == &equal ? expected : is_too_large(d));
        }
      }
    }
    CHECK(found > 1000);
    CHECK(missed == 0);
    CHECK(wrong == 0);
  }
}

TEST_CASE("Causing cells: the cell of the obstacle itself, if no range is too large or the obstacle is at the mesh")
{
  const Field field{ Hierarchy(cells()) };
  std::vector<BS::Level_range> ranges(field.number_of_cells(), BS::Level_range{ -0.1, 0.3 });
  CHECK(BS::causing_cells_of<Tag>(field, ranges, {}, 0.5).empty());
  CHECK(BS::causing_cells_of<Tag>(field, ranges, { obstacle(5, CGAL::NEGATIVE, 0.3) }, 0.5) == std::vector<Index>{ 5 });
  CHECK(BS::causing_cells_of<Tag>(field, ranges, { obstacle(5, CGAL::POSITIVE, 0.3) }, 0.5).size() > 50);
  CHECK(BS::causing_cells_of<Tag>(field, ranges, { obstacle(9, CGAL::ZERO, 0), obstacle(5, CGAL::ZERO, 0) }, 0.5)
        == std::vector<Index>{ 5, 9 });
}

TEST_CASE("Causing cells: the result does not depend on the number of threads")
{
  CGAL::Random random(5);
  const Field field(random_hierarchy(random, cells(), 3, 2));
  std::vector<BS::Level_range> ranges(field.number_of_cells());
  std::vector<Obstacle> obstacles;
  for(Index c = 0; c < ranges.size(); ++c) {
    ranges[c] = { -random.get_double(), random.get_double() };
    if(random.get_double() < 0.1)
      obstacles.push_back(obstacle(c, random.get_bool() ? CGAL::POSITIVE : CGAL::NEGATIVE, random.get_double()));
  }
  REQUIRE(obstacles.size() > 50);
  CHECK(BS::causing_cells_of<Tag>(field, ranges, obstacles, 0.9)
        == BS::causing_cells_of<CGAL::Parallel_if_available_tag>(field, ranges, obstacles, 0.9));
}
} // namespace test_Threshold_obstacle
