// slope_conditions.h, condition_points.h: slopes that are possible at vertices, and points on the mesh in each cell.
#include <CGAL/Bspline_shell_3/Construction/slope_conditions.h>
#include "mesh_in_cells.h"

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace test_slope_conditions {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Sequential_tag Tag;
typedef Mesh_in_cells::Field::Cell_index Index;

const auto everywhere = [](Index) { return true; };
const auto any_size = [](Index) { return std::numeric_limits<double>::infinity(); };

} // namespace

TEST_CASE(
  "Slope conditions: the target slope is a fraction of the slope at the worst vertex, and zero at singular vertices")
{
  for(double fraction : { 0.2, 0.5 }) {
    const std::vector<double> cube = BS::target_slopes<Tag>(
      Mesh_in_cells(box(Point_3(-1, -1, -1), Point_3(1, 1, 1))).input, fraction);
    CHECK(cube.size() == 12);
    for(double slope : cube) CHECK(slope == Approx(fraction / std::sqrt(3.)).epsilon(1e-6));
  }
  const Mesh_in_cells round(sphere(3));
  const std::vector<double> slopes = BS::target_slopes<Tag>(round.input, 0.2);
  CHECK(*std::min_element(slopes.begin(), slopes.end()) > 0.19);
  CHECK(slopes == BS::target_slopes<CGAL::Parallel_if_available_tag>(round.input, 0.2));
  // At one vertex, facets have no common direction. The slopes of these facets are zero, and no others.
  const Mesh_in_cells turning(screw());
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
    const Mesh_in_cells in(sphere(subdivisions));
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
  const Mesh_in_cells in(sphere(2));
  const std::vector<double> target = BS::target_slopes<Tag>(in.input, 0.2);
  const Index c = in.clipped.pieces().front().cell;
  const auto there = BS::slope_conditions(
    in.field, in.clipped, [&](Index, std::uint32_t facet) { return target[facet]; }, [&](Index n) { return n == c; },
    any_size);
  CHECK_FALSE(there.empty());
  CHECK(std::all_of(there.begin(), there.end(), [&](const auto& condition) { return condition.cell == c; }));
}
} // namespace test_slope_conditions
