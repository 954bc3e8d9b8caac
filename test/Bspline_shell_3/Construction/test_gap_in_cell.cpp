// gap_in_cell.h: the narrowest wall behind the part of a mesh in a cell, and the narrowest gap in front of it.
#include <CGAL/Bspline_shell_3/Construction/gap_in_cell.h>
#include "random_hierarchies.h"
#include "input_of_mesh.h"

namespace test_gap_in_cell {
namespace BS = CGAL::Bspline_shells;

TEST_CASE("Gap in a cell: walls behind the mesh and gaps in front of it are measured in the cell, up to a limit")
{
  // A plate of thickness 0.3. For y > 0, there is a plate of thickness 0.1 above it, at a distance of 0.2.
  const BS::Input_mesh_3 input = input_of(
    joined(box(Point_3(-3, -3, 0.1), Point_3(3, 3, 0.4)), box(Point_3(-3, 0, 0.6), Point_3(3, 3, 0.7))));
  const Hierarchy cells(all_cells(0.5, { -8, -8, -8 }, { 7, 7, 7 }));
  const BS::Clipped_mesh_3 clipped = BS::clip_mesh_to_cells<CGAL::Sequential_tag>(input, cells);
  const BS::Local_gap_3 gap(input);
  const auto in_cell = [&](double y, double z, CGAL::Sign side, double most) {
    return BS::gap_in_cell(gap, clipped, cells.locate(Point_3(1.1, y, z)), side, most);
  };
  const auto narrowest = [&](double y, double z, double most) {
    return BS::gap_in_cell(gap, clipped, cells.locate(Point_3(1.1, y, z)), most);
  };
  // lower plate only
  CHECK(in_cell(-1.2, 0.2, CGAL::NEGATIVE, 1) == Approx(0.3));
  CHECK(in_cell(-1.2, 0.2, CGAL::POSITIVE, 1) == 1);
  CHECK(narrowest(-1.2, 0.2, 1) == Approx(0.3));
  // lower plate, below the upper one
  CHECK(in_cell(1.2, 0.2, CGAL::NEGATIVE, 1) == Approx(0.3));
  CHECK(in_cell(1.2, 0.2, CGAL::POSITIVE, 1) == Approx(0.2));
  CHECK(narrowest(1.2, 0.2, 1) == Approx(0.2));
  // upper plate
  CHECK(in_cell(1.2, 0.6, CGAL::NEGATIVE, 1) == Approx(0.1));
  CHECK(in_cell(1.2, 0.6, CGAL::POSITIVE, 1) == Approx(0.2));
  CHECK(narrowest(1.2, 0.6, 1) == Approx(0.1));
  CHECK(narrowest(1.2, 0.6, 0.05) == 0.05);
  // no mesh
  CHECK(narrowest(1.2, 1.2, 1) == 1);
}
} // namespace test_gap_in_cell
