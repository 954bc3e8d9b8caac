// slope_conditions.h: slopes that are possible at vertices, points on the mesh in each cell, and common directions of
// facets.
#include <CGAL/Bspline_shell_3/Construction/slope_conditions.h>
#include "random_hierarchies.h"
#include "input_of_mesh.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace test_slope_conditions {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Sequential_tag Tag;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef Field::Cell_index Index;

struct In_cells
{
  BS::Input_mesh_3 input;
  Field field;
  BS::Clipped_mesh_3 clipped;

  // Clips a mesh to cells between -4 and 4. Their width is a power of two.
  In_cells(const Mesh& mesh, double width = 0.5) : input(input_of(mesh))
  {
    const int n = int(4 / width);
    field = Field(Hierarchy(all_cells(width, { -n, -n, -n }, { n - 1, n - 1, n - 1 })));
    clipped = BS::clip_mesh_to_cells<Tag>(input, field.cells());
  }

  Point_3 point(const BS::Slope_condition& c) const
  {
    const auto cell = field.cell(c.cell);
    return Point_3(cell.corner()[0] + cell.width() * c.position[0], cell.corner()[1] + cell.width() * c.position[1],
                   cell.corner()[2] + cell.width() * c.position[2]);
  }

  std::optional<BS::Slope_condition> common(const std::array<double, 3>& p, double distance) const
  {
    return BS::common_slope(field, clipped, field.locate(Point_3(p[0], p[1], p[2])), p, distance, 0.2);
  }
};

const auto everywhere = [](Index) { return true; };
const auto any_size = [](Index) { return std::numeric_limits<double>::infinity(); };

} // namespace

TEST_CASE(
  "Slope conditions: the target slope is a fraction of the slope at the worst vertex, and zero at singular vertices")
{
  for(double fraction : { 0.2, 0.5 }) {
    const std::vector<double> cube = BS::target_slopes<Tag>(In_cells(box(Point_3(-1, -1, -1), Point_3(1, 1, 1))).input,
                                                            fraction);
    CHECK(cube.size() == 12);
    for(double slope : cube) CHECK(slope == Approx(fraction / std::sqrt(3.)).epsilon(1e-6));
  }
  const In_cells round(sphere(3));
  const std::vector<double> slopes = BS::target_slopes<Tag>(round.input, 0.2);
  CHECK(*std::min_element(slopes.begin(), slopes.end()) > 0.19);
  CHECK(slopes == BS::target_slopes<CGAL::Parallel_if_available_tag>(round.input, 0.2));
  // At one vertex, facets have no common direction. The slopes of these facets are zero, and no others.
  const In_cells turning(screw());
  const std::vector<double> around = BS::target_slopes<Tag>(turning.input, 0.2);
  std::size_t zero = 0;
  for(auto f : turning.input.mesh().faces()) {
    bool is_there = false;
    for(auto v : turning.input.mesh().vertices_around_face(turning.input.mesh().halfedge(f))) {
      const auto& p = turning.input.mesh().point(v);
      is_there |= p.x() == 1 && p.y() == 1 && p.z() == 1;
    }
    CHECK((around[f] == 0) == is_there);
    zero += is_there;
  }
  CHECK(zero >= 6);
}

TEST_CASE("Slope conditions: each cell has a few conditions on its part of the mesh, along the normals")
{
  for(int subdivisions : { 0, 1, 6 }) {
    const In_cells in(sphere(subdivisions));
    std::vector<double> target = BS::target_slopes<Tag>(in.input, 0.2);
    target[3] = 0;
    const auto in_triangles = [&](Index c, std::uint32_t facet) {
      return c % 2 == 0 ? target[facet] : target[facet] / 4;
    };
    const auto size = [](Index c) { return 1. + c; };
    const std::vector<BS::Slope_condition> conditions = BS::slope_conditions(in.field, in.clipped, in_triangles,
                                                                             everywhere, size);
    std::map<Index, std::size_t> in_cell, pieces;
    for(const auto& piece : in.clipped.pieces())
      if(piece.facet != 3) ++pieces[piece.cell];
    std::size_t wrong = 0;
    for(const BS::Slope_condition& c : conditions) {
      ++in_cell[c.cell];
      const auto t = in.input.triangle(BS::Input_mesh_3::Face_index(c.facet));
      const Point_3 p = in.point(c);
      for(double x : c.position) wrong += !(x > -1e-12 && x < 1 + 1e-12);
      wrong += !(CGAL::squared_distance(p, Kernel::Triangle_3(t[0], t[1], t[2])) < 1e-24)
               || c.direction != in.clipped.normal(c.facet);
      wrong += c.least != in_triangles(c.cell, c.facet) || c.largest != 1. + c.cell || c.facet == 3;
    }
    CHECK(wrong == 0);
    CHECK(std::is_sorted(conditions.begin(), conditions.end(),
                         [](const auto& a, const auto& b) { return a.cell < b.cell; }));
    CHECK(in_cell.size() == pieces.size());
    std::size_t most = 0, most_pieces = 0;
    for(const auto& n : in_cell) {
      if(n.second > most) most = n.second;
      most_pieces = (std::max)(most_pieces, pieces[n.first]);
    }
    // In cells with many pieces, conditions are evenly spread, however work is divided between threads.
    std::map<Index, std::size_t> all_pieces;
    for(const auto& piece : in.clipped.pieces()) ++all_pieces[piece.cell];
    for(const auto& n : in_cell) {
      const std::size_t size = all_pieces[n.first], stride = (size + 47) / 48;
      if(size > 8 && size == pieces[n.first]) wrong += n.second != (size + stride - 1) / stride;
    }
    CHECK(wrong == 0);
    const std::vector<BS::Slope_condition> in_parallel = BS::slope_conditions<CGAL::Parallel_if_available_tag>(
      in.field, in.clipped, in_triangles, everywhere, size);
    CHECK(std::equal(
      conditions.begin(), conditions.end(), in_parallel.begin(), in_parallel.end(),
      [](const auto& a, const auto& b) { return a.cell == b.cell && a.facet == b.facet && a.position == b.position; }));
    CHECK(most <= 48 * (subdivisions < 6 ? 8 : 1));
    CHECK((most_pieces > 48) == (subdivisions == 6));
  }
  // Conditions are returned for the requested cells only.
  const In_cells in(sphere(2));
  const std::vector<double> target = BS::target_slopes<Tag>(in.input, 0.2);
  const Index c = in.clipped.pieces().front().cell;
  const auto there = BS::slope_conditions(
    in.field, in.clipped, [&](Index, std::uint32_t facet) { return target[facet]; }, [&](Index n) { return n == c; },
    any_size);
  CHECK_FALSE(there.empty());
  CHECK(std::all_of(there.begin(), there.end(), [&](const auto& condition) { return condition.cell == c; }));
}

TEST_CASE("Slope conditions: the common direction is normal to a side, bisects an edge, and is absent in a plate")
{
  const In_cells in(box(Point_3(-3, -3, -3), Point_3(3, 3, 3)));
  const auto side = in.common({ 0.1, 0.2, 3.3 }, 0.3);
  REQUIRE(side);
  CHECK(side->direction[2] == Approx(1));
  CHECK(side->least == Approx(0.2));
  CHECK(in.point(*side).z() == Approx(3.3));
  CHECK(side->cell == in.field.locate(Point_3(0.1, 0.2, 3.3)));
  const auto edge = in.common({ 0.1, 3.1, 3.1 }, 0.1414);
  REQUIRE(edge);
  CHECK(edge->direction[1] == Approx(std::sqrt(0.5)));
  CHECK(edge->direction[2] == Approx(std::sqrt(0.5)));
  CHECK(edge->least == Approx(0.2 * std::sqrt(0.5)));
  // The mesh is farther away than the search distance.
  CHECK_FALSE(in.common({ 0, 0, 0 }, 0.1));
  const In_cells plate(box(Point_3(-3, -3, -0.1), Point_3(3, 3, 0.1)));
  CHECK_FALSE(plate.common({ 0.3, 0.2, 0 }, 0.1));
  // Near one side of the plate, within less than its thickness, there is a common direction.
  const auto near_side = plate.common({ 0.3, 0.2, 0.15 }, 0.05);
  REQUIRE(near_side);
  CHECK(near_side->direction[2] == Approx(1));
}
} // namespace test_slope_conditions
