// similar_cells.h: results are compared with repeated searches through all cells, from each given cell.
#include <CGAL/Bspline_shell_3/Construction/similar_cells.h>
#include "random_hierarchies.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace test_similar_cells {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef Hierarchy::Index Index;
typedef std::vector<BS::Level_range> Ranges;

double largest(const BS::Level_range& r)
{
  return (std::max)(-r.min, r.max);
}

bool are_neighbors(const Hierarchy& cells, Index a, Index b)
{
  if(cells.level(a) != cells.level(b)) return false;
  for(int axis = 0; axis < 3; ++axis)
    if(std::abs(cells.lattice_point(a)[axis] - cells.lattice_point(b)[axis]) > 1) return false;
  return true;
}

std::vector<Index> by_search(const Hierarchy& cells, const Ranges& ranges, const std::vector<Index>& given)
{
  std::vector<char> is_similar(cells.number_of_cells(), 0);
  for(Index start : given) {
    std::vector<char> reached(cells.number_of_cells(), 0);
    reached[start] = 1;
    for(bool more = true; more;) {
      more = false;
      for(Index c = 0; c < reached.size(); ++c)
        for(Index n = 0; n < reached.size() && !reached[c]; ++n)
          if(reached[n] && are_neighbors(cells, c, n) && largest(ranges[c]) >= 0.7 * largest(ranges[start]))
            more = (reached[c] = is_similar[c] = 1);
    }
  }
  for(Index c : given) is_similar[c] = 0;
  std::vector<Index> similar;
  for(Index c = 0; c < is_similar.size(); ++c)
    if(is_similar[c]) similar.push_back(c);
  return similar;
}

} // namespace

TEST_CASE("Similar cells: similar cells are reached through equal cells with similar fields, in any order")
{
  CGAL::Random random(3);
  std::size_t most = 0;
  for(int trial = 0; trial < 12; ++trial) {
    const Hierarchy cells = random_hierarchy(random, all_cells(1, { 0, 0, 0 }, { 4, 4, 2 }), 2, 2);
    Ranges ranges(cells.number_of_cells());
    for(BS::Level_range& r : ranges)
      if(random.get_double() < 0.7) r.include(random.get_double(-1, 1)); // the other cells have no part of the mesh
    std::vector<Index> given;
    for(Index c = 0; c < ranges.size(); ++c)
      if(largest(ranges[c]) > 0 && random.get_double() < 0.05) given.push_back(c);
    const std::vector<Index> similar = BS::similar_cells(cells, ranges, given);
    CHECK(similar == by_search(cells, ranges, given));
    std::reverse(given.begin(), given.end());
    CHECK(similar == BS::similar_cells(cells, ranges, given));
    most = (std::max)(most, similar.size());
  }
  CHECK(most > 10);
  const Hierarchy cells(all_cells(1, { 0, 0, 0 }, { 4, 4, 2 }));
  CHECK(BS::similar_cells(cells, Ranges(cells.number_of_cells()), {}).empty());
}
} // namespace test_similar_cells
