// Mesh_ranges.h: enclosures of a field on the mesh in each cell are compared with samples. Unchanged ranges are kept,
// and changed ones are computed again.
#include <CGAL/Bspline_shell_3/Construction/Mesh_ranges.h>
#include "field_on_mesh.h"

#include <CGAL/Random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace test_Mesh_ranges {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Level_range Range;
typedef BS::Mesh_ranges Ranges;
typedef CGAL::Sequential_tag Sequential;

struct Problem : Field_on_mesh
{
  using Field_on_mesh::Field_on_mesh;

  // Calls visit(piece, value of the field at a point of the piece).
  template <typename Visitor>
  void sample(const Visitor& visit) const
  {
    constexpr int steps = 12;
    for(const BS::Clipped_mesh_3::Piece& piece : clipped.pieces()) {
      const auto cell = field.cell(piece.cell);
      for(std::uint32_t v = 1; v + 1 < piece.size; ++v)
        for(int i = 0; i <= steps; ++i)
          for(int j = 0; i + j <= steps; ++j) {
            std::array<double, 3> x;
            for(int a = 0; a < 3; ++a) {
              const double p = clipped.point(piece.first)[a];
              x[a] = p + (clipped.point(piece.first + v)[a] - p) * i / steps
                     + (clipped.point(piece.first + v + 1)[a] - p) * j / steps;
            }
            visit(piece, cell.value(x));
          }
    }
  }

  std::vector<Range> sampled_cells() const
  {
    std::vector<Range> ranges(field.number_of_cells());
    sample([&](const BS::Clipped_mesh_3::Piece& piece, double f) { ranges[piece.cell].include(f); });
    return ranges;
  }
};

Problem ball()
{
  return Problem(sphere(2), BS::Lattice_3(CGAL::Bbox_3(-1.01, -1.02, -0.99, 1, 1, 1), 0.3));
}

const auto everywhere = [](double size) { return [size](Ranges::Cell_index) { return size; }; };

double size_of(const Range& r)
{
  return (std::max)(-r.min, r.max);
}

bool are_equal(const std::vector<Range>& a, const std::vector<Range>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Range& r, const Range& s) { return r.min == s.min && r.max == s.max; });
}

} // namespace

TEST_CASE("Mesh ranges: ranges enclose the field on the mesh, and identify cells where the field is too large")
{
  Problem problem = ball();
  for(int seed = 0; seed < 4; ++seed) {
    problem.set_noisy_distance(0.1, seed);
    const std::vector<Range> sampled = problem.sampled_cells();
    std::vector<double> sizes;
    for(const Range& r : sampled)
      if(r.min <= r.max) sizes.push_back(size_of(r));
    std::sort(sizes.begin(), sizes.end());
    const double size = sizes[sizes.size() * 3 / 4];
    for(Ranges::Precision precision : { Ranges::SUFFICIENT, Ranges::SHARP }) {
      Ranges ranges(problem.field.number_of_cells());
      ranges.update<Sequential>(problem.field, problem.clipped, everywhere(size), precision);
      std::set<std::uint32_t> thick;
      for(const BS::Thick_cell& t : ranges.thick_cells()) thick.insert(t.cell);
      CHECK(thick.size() == ranges.thick_cells().size());
      std::size_t escaped = 0, missed = 0, too_many = 0, coarse = 0, empty = 0;
      for(std::size_t c = 0; c < sampled.size(); ++c) {
        const Range& range = ranges.cells()[c];
        if(!(sampled[c].min <= sampled[c].max)) {
          empty += !(range.min <= range.max);
          continue;
        }
        escaped += !(range.min <= sampled[c].min && sampled[c].max <= range.max);
        const bool is_thick = thick.count(std::uint32_t(c)) > 0;
        missed += !is_thick && size_of(range) > size;
        // Samples come close to the extrema.
        too_many += is_thick && size_of(sampled[c]) < 0.97 * size;
        coarse += precision == Ranges::SHARP && size_of(range) > 1.35 * size_of(sampled[c]) + 0.05 * size;
      }
      CHECK(escaped == 0);
      CHECK(missed == 0);
      CHECK(too_many == 0);
      CHECK(coarse == 0);
      CHECK(empty > 0);
      CHECK(thick.size() > sizes.size() / 5);
      CHECK(thick.size() < sizes.size() / 3);

      // At the reported place, the field is nearly as large as anywhere in the cell.
      std::size_t wrong = 0;
      for(const BS::Thick_cell& t : ranges.thick_cells()) {
        const auto triangle = problem.input.triangle(BS::Input_mesh_3::Face_index(t.facet));
        const Point_3 p(t.point[0], t.point[1], t.point[2]);
        wrong += !(CGAL::squared_distance(p, Kernel::Triangle_3(triangle[0], triangle[1], triangle[2])) < 1e-24);
        wrong += !(std::abs(problem.field.cell(t.cell).value(t.point)) > 0.9 * size_of(sampled[t.cell]));
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("Mesh ranges: a peak between corners is detected")
{
  // 1 - ((x - 0.3)^2 + (y - 0.2)^2) / 4 on the top of a box; no piece has a corner at the peak
  Problem problem(box(Point_3(-1, -1, -1), Point_3(1, 1, 1)), BS::Lattice_3(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.5));
  const double h = 0.5;
  problem.set([&](const Point_3& p) {
    const double x = p.x() - 0.3, y = p.y() - 0.2;
    return 1 - (x * x + y * y - 2 * h * h / 3) / 4;
  });
  for(double size : { 1 - 1e-3, 1 + 1e-3 }) {
    Ranges ranges(problem.field.number_of_cells());
    ranges.update<Sequential>(problem.field, problem.clipped, everywhere(size), Ranges::SUFFICIENT);
    double most = 0;
    problem.sample([&](const BS::Clipped_mesh_3::Piece&, double f) { most = (std::max)(most, f); });
    CHECK(most < 1 + 1e-12);
    CHECK(ranges.mesh().max >= most);
    CHECK(ranges.thick_cells().empty() == (size > 1));
    for(const BS::Thick_cell& t : ranges.thick_cells())
      CHECK(std::abs(t.point[0] - 0.3) + std::abs(t.point[1] - 0.2) < 0.5);
  }
}

TEST_CASE("Mesh ranges: ranges of unchanged cells are kept, and all others are updated")
{
  Problem problem = ball();
  problem.set_noisy_distance(0.1, 1);
  const double size = 0.06;
  Ranges ranges(problem.field.number_of_cells());
  ranges.update<Sequential>(problem.field, problem.clipped, everywhere(size), Ranges::SUFFICIENT);
  const std::vector<Range> before = ranges.cells();
  const std::size_t thick_before = ranges.thick_cells().size();
  REQUIRE(thick_before > 0);

  // Sharper ranges are contained in the others.
  Ranges sharper = ranges;
  sharper.update<Sequential>(problem.field, problem.clipped, everywhere(size), Ranges::SHARP);
  std::size_t wrong = 0, better = 0;
  for(std::size_t c = 0; c < before.size(); ++c) {
    wrong += !(sharper.cells()[c].min >= before[c].min && sharper.cells()[c].max <= before[c].max);
    better += sharper.cells()[c].max - sharper.cells()[c].min < before[c].max - before[c].min;
  }
  CHECK(wrong == 0);
  CHECK(better > 0);

  // The field changes everywhere; only the range of the forgotten cell is updated.
  problem.set_noisy_distance(0.02, 2);
  const std::uint32_t changed = ranges.thick_cells().front().cell;
  ranges.forget(changed);
  ranges.update<Sequential>(problem.field, problem.clipped, everywhere(size), Ranges::SUFFICIENT);
  for(std::size_t c = 0; c < before.size(); ++c)
    if(c != changed) wrong += ranges.cells()[c].min != before[c].min || ranges.cells()[c].max != before[c].max;
  CHECK(wrong == 0);
  CHECK(size_of(ranges.cells()[changed]) < size);
  CHECK(ranges.thick_cells().size() == thick_before - 1);

  // The same cells are renumbered.
  const std::uint32_t n = std::uint32_t(before.size()), fresh = ranges.thick_cells().front().cell;
  Ranges reversed(n);
  for(std::uint32_t c = 0; c < n; ++c) reversed.keep(ranges, c, n - 1 - c);
  std::set<std::uint32_t> thick, wanted;
  for(const BS::Thick_cell& t : reversed.thick_cells()) thick.insert(t.cell);
  for(const BS::Thick_cell& t : ranges.thick_cells()) wanted.insert(n - 1 - t.cell);
  CHECK(thick == wanted);
  for(std::uint32_t c = 0; c < n; ++c)
    wrong += reversed.cells()[n - 1 - c].min != ranges.cells()[c].min
             || reversed.cells()[n - 1 - c].max != ranges.cells()[c].max;
  CHECK(wrong == 0);

  // One range is not kept.
  Ranges others(n);
  for(std::uint32_t c = 0; c < n; ++c)
    if(c != fresh) others.keep(ranges, c, c);
  CHECK(others.thick_cells().size() == thick_before - 2);
  others.update<Sequential>(problem.field, problem.clipped, everywhere(size), Ranges::SUFFICIENT);
  CHECK(others.thick_cells().size() == thick_before - 2);
  for(std::uint32_t c = 0; c < n; ++c)
    if(c != fresh)
      wrong += others.cells()[c].min != ranges.cells()[c].min || others.cells()[c].max != ranges.cells()[c].max;
  CHECK(wrong == 0);
}

TEST_CASE("Mesh ranges: facet ranges enclose the field, and results do not depend on the number of threads")
{
  Problem problem = ball();
  problem.set_noisy_distance(0.1, 3);
  Ranges ranges(problem.field.number_of_cells()), parallel = ranges;
  ranges.update<Sequential>(problem.field, problem.clipped, everywhere(0.06), Ranges::SHARP);
  parallel.update<CGAL::Parallel_if_available_tag>(problem.field, problem.clipped, everywhere(0.06), Ranges::SHARP);
  const std::vector<Range> facets = ranges.facets<Sequential>(problem.field, problem.clipped);
  REQUIRE(facets.size() == problem.input.mesh().number_of_faces());
  std::size_t escaped = 0;
  problem.sample([&](const BS::Clipped_mesh_3::Piece& piece, double f) {
    escaped += !(facets[piece.facet].min <= f && f <= facets[piece.facet].max);
  });
  CHECK(escaped == 0);
  CHECK(are_equal(parallel.cells(), ranges.cells()));
  CHECK(are_equal(parallel.facets<CGAL::Parallel_if_available_tag>(problem.field, problem.clipped), facets));
  REQUIRE(parallel.thick_cells().size() == ranges.thick_cells().size());
  std::size_t different = 0;
  for(std::size_t n = 0; n < ranges.thick_cells().size(); ++n)
    different += parallel.thick_cells()[n].cell != ranges.thick_cells()[n].cell
                 || parallel.thick_cells()[n].point != ranges.thick_cells()[n].point;
  CHECK(different == 0);
}
} // namespace test_Mesh_ranges
