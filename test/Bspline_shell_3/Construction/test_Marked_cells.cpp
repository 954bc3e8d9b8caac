// Marked_cells.h: marked cells are compared with a search through all cells.
#include <CGAL/Bspline_shell_3/Construction/Marked_cells.h>
#include "random_hierarchies.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <set>
#include <vector>

namespace test_Marked_cells {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef Hierarchy::Index Index;

Hierarchy some_hierarchy(unsigned seed)
{
  CGAL::Random random(seed);
  const BS::Lattice_3 lattice(CGAL::Bbox_3(-2, -2, -2, 2, 2, 2), 1);
  return random_hierarchy(random, some_cells(random, lattice, { -2, -2, -2 }, { 1, 1, 1 }, 0.8), 3, 2);
}

} // namespace

TEST_CASE("Marked cells: visit_around() visits all cells within half a width of the given cell")
{
  for(unsigned seed = 1; seed < 4; ++seed) {
    const Hierarchy cells = some_hierarchy(seed);
    for(Index c = 0; c < cells.number_of_cells(); ++c) {
      std::set<Index> visited, expected;
      BS::visit_around(cells, c, [&](Index n) { visited.insert(n); });
      const auto p = cells.corner(c);
      for(Index n = 0; n < cells.number_of_cells(); ++n) {
        const auto q = cells.corner(n);
        const double near = cells.width(c) / 2;
        bool is_near = true;
        for(int a = 0; a < 3; ++a)
          is_near = is_near && q[a] <= p[a] + cells.width(c) + near && p[a] - near <= q[a] + cells.width(n);
        if(is_near) expected.insert(n);
      }
      CHECK(visited == expected);
    }
  }
}

TEST_CASE(
  "Marked cells: mark_widely() marks neighbors of equal size across faces, edges or vertices, once and in order")
{
  for(unsigned seed = 1; seed < 4; ++seed) {
    const Hierarchy cells = some_hierarchy(seed);
    for(int axes = 0; axes <= 3; ++axes) {
      BS::Marked_cells marked(cells);
      CHECK(marked.empty());
      std::set<Index> expected;
      for(Index c = 0; c < cells.number_of_cells(); c += 7) {
        for(int twice = 0; twice < 2; ++twice) marked.mark_widely(c, axes);
        for(Index n = 0; n < cells.number_of_cells(); ++n) {
          int apart = 0;
          bool are_neighbors = cells.level(n) == cells.level(c);
          for(int a = 0; a < 3; ++a) {
            const int steps = std::abs(cells.lattice_point(n)[a] - cells.lattice_point(c)[a]);
            apart += steps;
            are_neighbors = are_neighbors && steps <= 1;
          }
          if(are_neighbors && apart <= axes) expected.insert(n);
        }
      }
      CHECK_FALSE(marked.empty());
      CHECK(marked.sorted() == std::vector<Index>(expected.begin(), expected.end()));
    }
  }
}

TEST_CASE("Marked cells: cells of the last level are never marked")
{
  Hierarchy cells = some_hierarchy(1);
  while(cells.number_of_levels() <= cells.max_level())
    cells = cells.refined({ cells.first_leaf(cells.number_of_levels() - 1) }, 0);
  const Index smallest = cells.first_leaf(cells.max_level());
  REQUIRE(cells.level(smallest) == cells.max_level());
  BS::Marked_cells marked(cells);
  marked.mark(smallest);
  marked.mark_widely(smallest);
  CHECK(marked.empty());
  marked.mark(0);
  CHECK(marked.sorted() == std::vector<Index>{ 0 });
}
} // namespace test_Marked_cells
