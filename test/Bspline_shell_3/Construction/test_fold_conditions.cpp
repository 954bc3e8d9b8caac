// fold_conditions.h: conditions along common directions in grooves and at fins, and nowhere else.
#include <CGAL/Bspline_shell_3/Construction/fold_conditions.h>
#include "mesh_in_cells.h"

#include <CGAL/squared_distance_3.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace test_fold_conditions {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef Mesh_in_cells::Field::Cell_index Index;

// Facets of the groove or fin are those whose normals are nearly horizontal along the x-axis.
bool is_in_groove(const Mesh_in_cells& in, std::uint32_t facet)
{
  const auto& normal = in.clipped.normal(facet);
  return std::abs(normal[0]) > 0.5 && std::abs(normal[0]) < 1;
}

std::vector<BS::Slope_condition> conditions_of(const Mesh_in_cells& in)
{
  return BS::fold_conditions(
    in.field, in.clipped, [&](std::uint32_t facet) { return is_in_groove(in, facet); }, [](Index) { return true; },
    0.2);
}

} // namespace

TEST_CASE("Fold conditions: in a groove and at a fin, the field must increase upwards on both sides")
{
  const double margin = std::sin(5 * std::acos(-1.) / 180);
  for(double depth : { 0.1, -0.1 })
    for(double width : { 0.125, 0.03125 }) {
      const Mesh_in_cells in(grooved_block(10, depth), width);
      const std::vector<BS::Slope_condition> conditions = conditions_of(in);
      bool has_left = false, has_right = false;
      std::size_t wrong = 0;
      for(const BS::Slope_condition& c : conditions) {
        const Point_3 p = in.point(c);
        if(p.y() < 0.13 || p.y() > 0.37) continue; // near the ends, normals have other directions, too
        wrong += !(c.direction[2] == Approx(1)) || !(c.least == Approx(0.2 * margin));
        const auto t = in.input.triangle(BS::Input_mesh_3::Face_index(c.facet));
        wrong += !(CGAL::squared_distance(p, Kernel::Triangle_3(t[0], t[1], t[2])) < 1e-24);
        if(is_in_groove(in, c.facet)) (in.clipped.normal(c.facet)[0] > 0 ? has_left : has_right) = true;
      }
      // Each cell at the groove or fin has conditions, except near the ends.
      std::size_t without = 0;
      for(const auto& piece : in.clipped.pieces()) {
        const double y = in.field.cell(piece.cell).corner()[1];
        if(!is_in_groove(in, piece.facet) || y < 0.12 || y + width > 0.38) continue;
        without += std::none_of(conditions.begin(), conditions.end(),
                                [&](const auto& c) { return c.cell == piece.cell; });
      }
      CHECK(without == 0);
      CHECK(wrong == 0);
      CHECK(has_left);
      CHECK(has_right);
      const std::vector<BS::Slope_condition> in_parallel = BS::fold_conditions<CGAL::Parallel_if_available_tag>(
        in.field, in.clipped, [&](std::uint32_t facet) { return is_in_groove(in, facet); }, [](Index) { return true; },
        0.2);
      CHECK(std::equal(conditions.begin(), conditions.end(), in_parallel.begin(), in_parallel.end(),
                       [](const auto& a, const auto& b) {
                         return a.cell == b.cell && a.facet == b.facet && a.position == b.position
                                && a.direction == b.direction && a.least == b.least;
                       }));
    }
}

TEST_CASE("Fold conditions: there are none in wide grooves, in grooves that are too narrow, or in cells that need none")
{
  CHECK(conditions_of(Mesh_in_cells(grooved_block(60, 0.1), 0.125)).empty());
  // The margin of the common direction is below least_common_cosine.
  CHECK(conditions_of(Mesh_in_cells(grooved_block(0.5, 0.1), 0.125)).empty());
  const Mesh_in_cells in(grooved_block(10, 0.1), 0.125);
  CHECK(BS::fold_conditions(
          in.field, in.clipped, [](std::uint32_t) { return false; }, [](Index) { return true; }, 0.2)
          .empty());
  const std::vector<BS::Slope_condition> all = conditions_of(in);
  REQUIRE_FALSE(all.empty());
  const Index c = all.front().cell;
  const std::vector<BS::Slope_condition> there = BS::fold_conditions(
    in.field, in.clipped, [&](std::uint32_t facet) { return is_in_groove(in, facet); }, [&](Index n) { return n == c; },
    0.2);
  CHECK(there.size() == std::size_t(std::count_if(all.begin(), all.end(), [&](const auto& condition) {
          return condition.cell == c;
        })));
}
} // namespace test_fold_conditions
