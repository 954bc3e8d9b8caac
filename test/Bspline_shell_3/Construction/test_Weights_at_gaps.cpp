// Weights_at_gaps.h: where the surface term of the energy has a larger weight, and how much larger it is.
#include <CGAL/Bspline_shell_3/Construction/Weights_at_gaps.h>
#include "random_hierarchies.h"
#include "input_of_mesh.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace test_Weights_at_gaps {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Sequential_tag Tag;
typedef Hierarchy::Index Index;
typedef std::vector<Index> Cells;

// A plate that is 7 long and wide, in cells of width one, clipped to these cells
struct Plate
{
  explicit Plate(double thickness)
    : input(input_of(box(Point_3(0.5, 0.5, 1.4), Point_3(7.5, 7.5, 1.4 + thickness)))), gap(input),
      cells(all_cells(1, { -4, -4, -4 }, { 11, 11, 7 })), clipped(clip(cells))
  {}

  BS::Clipped_mesh_3 clip(const Hierarchy& finer) const { return BS::clip_mesh_to_cells<Tag>(input, finer); }
  double factor(const Hierarchy& of, Index c) const { return BS::surface_factor_at_gap(of, clip(of), gap, c); }

  BS::Input_mesh_3 input;
  BS::Local_gap_3 gap;
  Hierarchy cells;
  BS::Clipped_mesh_3 clipped;
};

Index cell_at(const Hierarchy& cells, double x, double y, double z)
{
  return cells.locate(Point_3(x, y, z));
}

} // namespace

TEST_CASE("Weights at gaps: the factor is 1000 times the square of cell width over gap, in cells with parallel facets")
{
  for(double thickness : { 0.4, 0.25, 0.05 }) {
    const Plate plate(thickness);
    CHECK(plate.factor(plate.cells, cell_at(plate.cells, 4.5, 4.5, 1.5)) == Approx(1000 / (thickness * thickness)));
    CHECK(plate.factor(plate.cells, cell_at(plate.cells, 0.6, 4.5, 1.5)) == 1); // contains an edge
    CHECK(plate.factor(plate.cells, cell_at(plate.cells, 4.5, 4.5, 2.5)) == 0); // empty
  }
  // wider than 24 gaps
  const Plate sheet(0.04);
  CHECK(sheet.factor(sheet.cells, cell_at(sheet.cells, 4.5, 4.5, 1.5)) == 1);
  const Hierarchy finer = sheet.cells.refined({ cell_at(sheet.cells, 4.5, 4.5, 1.5) }, 0);
  CHECK(sheet.factor(finer, cell_at(finer, 4.4, 4.4, 1.42)) == Approx(1000 * 0.25 / (0.04 * 0.04)));
  // narrower than the gap
  const Plate block(0.55);
  const Hierarchy half = block.cells.refined({ cell_at(block.cells, 4.5, 4.5, 1.5) }, 0);
  CHECK(block.factor(half, cell_at(half, 4.4, 4.4, 1.42)) == 0);
}

TEST_CASE("Weights at gaps: a gap grows from one cell over all connected cells with the gap, and to no other part")
{
  Mesh two = box(Point_3(0.5, 0.5, 1.4), Point_3(3.5, 7.5, 1.6));
  CGAL::copy_face_graph(box(Point_3(6.5, 0.5, 1.4), Point_3(9.5, 7.5, 1.6)), two);
  const BS::Input_mesh_3 input = input_of(two);
  const BS::Local_gap_3 gap(input);
  const Hierarchy cells(all_cells(1, { -4, -4, -4 }, { 13, 11, 7 }));
  const BS::Clipped_mesh_3 clipped = BS::clip_mesh_to_cells<Tag>(input, cells);
  BS::Weights_at_gaps<Tag> weights;
  CHECK(weights.factors().empty());
  CHECK(weights.add(cells, clipped, gap, { cell_at(cells, 1.5, 1.5, 2.5) }).empty()); // without mesh
  const Cells increased = weights.add(cells, clipped, gap, { cell_at(cells, 1.5, 1.5, 1.5) });
  Cells expected;
  for(double x : { 1.5, 2.5 })
    for(double y : { 1.5, 2.5, 3.5, 4.5, 5.5, 6.5 }) expected.push_back(cell_at(cells, x, y, 1.5));
  std::sort(expected.begin(), expected.end());
  CHECK(increased == expected);
  REQUIRE(weights.factors().size() == cells.number_of_cells());
  std::size_t wrong = 0;
  for(Index c = 0; c < cells.number_of_cells(); ++c) {
    const bool is_increased = std::binary_search(expected.begin(), expected.end(), c);
    wrong += weights.factors()[c] != (is_increased ? Approx(25000) : Approx(1));
  }
  CHECK(wrong == 0);
  CHECK(weights.add(cells, clipped, gap, { cell_at(cells, 1.5, 1.5, 1.5) }).empty()); // again

  BS::Weights_at_gaps<CGAL::Parallel_if_available_tag> parallel;
  CHECK(parallel.add(cells, clipped, gap, { cell_at(cells, 1.5, 1.5, 1.5) }) == increased);
  CHECK(parallel.factors() == weights.factors());
}

TEST_CASE("Weights at gaps: in finer cells, the factor is that of their width, and other cells keep theirs")
{
  const Plate plate(0.2);
  BS::Weights_at_gaps<Tag> weights;
  weights.add(plate.cells, plate.clipped, plate.gap, { cell_at(plate.cells, 4.5, 4.5, 1.5) });
  const Hierarchy finer = plate.cells.refined({ cell_at(plate.cells, 4.5, 4.5, 1.5) }, 0);
  weights.refine(plate.cells, finer, plate.clip(finer), plate.gap);
  REQUIRE(weights.factors().size() == finer.number_of_cells());
  CHECK(weights.factors()[cell_at(finer, 4.4, 4.4, 1.42)] == Approx(1000 * 0.25 / (0.2 * 0.2)));
  CHECK(weights.factors()[cell_at(finer, 4.4, 4.4, 1.58)] == Approx(1000 * 0.25 / (0.2 * 0.2)));
  CHECK(weights.factors()[cell_at(finer, 6.3, 4.5, 1.5)] == Approx(1000 / (0.2 * 0.2)));
}

TEST_CASE("Weighable cells: causing cells, if at least half of them can have a larger weight, at half of the obstacles")
{
  const Plate plate(0.2);
  const BS::Hierarchical_bspline_field_3<> field{ Hierarchy(plate.cells) };
  const Index flat = cell_at(plate.cells, 4.5, 4.5, 1.5), near_flat = cell_at(plate.cells, 3.5, 4.5, 1.5),
              edge = cell_at(plate.cells, 0.6, 4.5, 1.5), near_edge = cell_at(plate.cells, 0.6, 5.5, 1.5);
  std::vector<BS::Level_range> ranges(field.number_of_cells());
  const auto set_large = [&](const Cells& large) {
    std::fill(ranges.begin(), ranges.end(), BS::Level_range{ 0, 0 });
    for(Index c : large) ranges[c] = { -1, 1 };
  };
  const auto weighable = [&](const std::vector<BS::Threshold_obstacle>& obstacles) {
    return BS::weighable_cells<Tag>(field, plate.clipped, plate.gap, ranges, obstacles, 0.5);
  };
  const BS::Threshold_obstacle at_flat = { flat, { 4.5, 4.5, 1.5 }, CGAL::NEGATIVE, 1 },
                               at_edge = { edge, { 0.6, 4.5, 1.5 }, CGAL::NEGATIVE, 1 },
                               zero = { flat, { 4.5, 4.5, 1.5 } };
  set_large({ flat });
  CHECK(weighable({ at_flat }) == Cells{ flat });
  CHECK(weighable({ at_flat, zero }) == Cells{ flat });
  CHECK(weighable({ at_flat, zero, zero }).empty());
  CHECK(weighable({}).empty());
  set_large({ flat, near_flat });
  CHECK(weighable({ at_flat }) == Cells{ (std::min)(flat, near_flat), (std::max)(flat, near_flat) });
  set_large({ edge, near_edge });
  CHECK(weighable({ at_edge }).empty());
  set_large({}); // without causing cells
  CHECK(weighable({ at_flat }).empty());
}
} // namespace test_Weights_at_gaps
