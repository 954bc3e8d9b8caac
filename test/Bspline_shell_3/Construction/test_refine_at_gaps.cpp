// refine_at_gaps.h: requested cells are refined until they are nearly as narrow as the gap, and no others.
#include <CGAL/Bspline_shell_3/Construction/refine_at_gaps.h>
#include "random_hierarchies.h"
#include "input_of_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace test_refine_at_gaps {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef Hierarchy::Index Index;

const auto no_limit = [](std::size_t) { return false; };

BS::Input_mesh_3 plate(double thickness)
{
  return input_of(box(Point_3(0.5, 0.5, 1.5 - thickness / 2), Point_3(7.5, 7.5, 1.5 + thickness / 2)));
}

Hierarchy cells_of_width_one()
{
  return Hierarchy(all_cells(BS::Lattice_3(CGAL::Bbox_3(0, 0, 0, 8, 8, 8), 1), { -4, -4, -4 }, { 3, 3, -2 }));
}

bool are_equal(const Hierarchy& a, const Hierarchy& b)
{
  if(a.number_of_cells() != b.number_of_cells()) return false;
  for(Index c = 0; c < a.number_of_cells(); ++c)
    if(a.level(c) != b.level(c) || a.lattice_point(c) != b.lattice_point(c)) return false;
  return true;
}

} // namespace

TEST_CASE("Refinement at gaps: cells are split until they are at most four gaps wide, or the limit is reached")
{
  const Hierarchy cells = cells_of_width_one();
  for(double thickness : { 0.3, 0.1, 0.01 })
    for(int halvings : { 1, 2, 3 }) {
      const BS::Input_mesh_3 input = plate(thickness);
      const BS::Local_gap_3 gap(input);
      const BS::Clipped_mesh_3 clipped = BS::clip_mesh_to_cells<CGAL::Sequential_tag>(input, cells);
      const Index middle = cells.locate(Point_3(4.5, 4.5, 1.5)), empty = cells.locate(Point_3(4.5, 4.5, 0.5));
      const Hierarchy fine = BS::refine_at_gaps<CGAL::Sequential_tag>(cells, { middle }, 1, { middle }, halvings, gap,
                                                                      clipped, no_limit);
      const int wanted = thickness == 0.3 ? 1 : thickness == 0.1 ? 2 : 5; // halvings of a cell of width one
      std::size_t wrong = 0;
      const int expected = (std::min)(halvings, wanted);
      for(double x : { 4.01, 4.3, 4.99 })
        for(double z : { 1.01, 1.6, 1.99 }) wrong += fine.level(fine.locate(Point_3(x, 4.5, z))) != expected;
      CHECK(wrong == 0);
      CHECK(fine.number_of_levels() == expected + 1);
      // An obstacle in a cell without a part of the mesh is split once, and so is a cell that is only marked.
      const Hierarchy once = BS::refine_at_gaps<CGAL::Sequential_tag>(cells, { middle, empty }, 1, { empty }, halvings,
                                                                      gap, clipped, no_limit);
      CHECK(are_equal(once, cells.refined({ middle, empty }, 1)));
      // A limit ends refinement after the marked cells.
      const auto is_too_many = [&](std::size_t size) { return size > cells.refined({ middle }, 1).number_of_cells(); };
      CHECK(are_equal(
        BS::refine_at_gaps<CGAL::Sequential_tag>(cells, { middle }, 1, { middle }, halvings, gap, clipped, is_too_many),
        cells.refined({ middle }, 1)));
      CHECK(are_equal(BS::refine_at_gaps<CGAL::Parallel_if_available_tag>(cells, { middle }, 1, { middle }, halvings,
                                                                          gap, clipped, no_limit),
                      fine));
    }
}
} // namespace test_refine_at_gaps
