// sample_signed_distance.h: samples on finer cells, computed from those on coarser cells.
#include <CGAL/Bspline_shell_3/Fit/sample_signed_distance.h>
#include "random_hierarchies.h"

#include <CGAL/tags.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace test_sample_signed_distance {
namespace BS = CGAL::Bspline_shells;

namespace {

// The distance of a ball, with a counter of evaluations.
struct Counting_ball
{
  typedef BS::Any_signed_distance_3::Point_3 Point_3;
  typedef double FT;
  std::size_t* calls;
  double operator()(const Point_3& p) const
  {
    ++*calls;
    return std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z()) - 1;
  }
};

} // namespace

TEST_CASE("Distance samples: samples of unchanged cells are kept, and the oracle is called for new cells only")
{
  CGAL::Random random(11);
  std::size_t calls = 0;
  const Counting_ball ball = { &calls };
  const BS::Any_signed_distance_3 oracle(ball);
  Hierarchy before(some_cells(random, BS::Lattice_3::from_origin({ 0, 0, 0 }, 0.5, { -4, -4, -4 }, { 3, 3, 3 }),
                              { -4, -4, -4 }, { 3, 3, 3 }));
  std::vector<double> samples = BS::sample_signed_distance<CGAL::Sequential_tag>(oracle, before);
  for(int round = 0; round < 3; ++round) {
    const Hierarchy cells = before.refined(random_leaves(random, before, 2));
    std::vector<std::uint32_t> expected;
    for(Hierarchy::Index c = 0; c < cells.number_of_cells(); ++c) {
      bool is_old = false;
      for(Hierarchy::Index b = 0; b < before.number_of_cells(); ++b)
        is_old = is_old || (before.level(b) == cells.level(c) && before.lattice_point(b) == cells.lattice_point(c));
      if(!is_old) expected.push_back(c);
    }
    calls = 0;
    CHECK(BS::update_signed_distance<CGAL::Sequential_tag>(oracle, before, cells, samples) == expected);
    CHECK(calls == expected.size() * std::size_t(BS::Distance_samples::per_cell));
    CHECK(samples == BS::sample_signed_distance<CGAL::Sequential_tag>(oracle, cells));
    CHECK_FALSE(expected.empty());
    CHECK(expected.size() < cells.number_of_cells());
    before = cells;
  }
  // If no cell has changed, nothing is sampled.
  calls = 0;
  CHECK(BS::update_signed_distance<CGAL::Sequential_tag>(oracle, before, before, samples).empty());
  CHECK(calls == 0);
}
} // namespace test_sample_signed_distance
