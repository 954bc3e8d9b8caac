// Refinement_budget.h: decides whether the limits allow another round. Only the last test measures time.
#include <CGAL/Bspline_shell_3/Construction/Refinement_budget.h>

#include <catch2/catch.hpp>

#include <cstddef>
#include <limits>

namespace test_Refinement_budget {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Refinement_budget Budget;
using BS::Refinement_resource;

constexpr double no_limit = std::numeric_limits<double>::infinity();

BS::Refinement_parameters limits(double bytes)
{
  BS::Refinement_parameters parameters;
  parameters.max_bytes = bytes;
  return parameters;
}

// Adds a round of 1000 cells.
void add_round(Budget& budget, bool is_partial, bool is_examined)
{
  BS::Refinement_round& round = budget.begin_round();
  round.cells = 1000;
  round.partial = is_partial;
  round.examined = is_examined;
}

} // namespace

TEST_CASE("Budget: a round takes memory per cell and per point, and memory limits precede index limits")
{
  const BS::Refinement_limit limit = Budget(limits(no_limit)).limit_of_round(3000, 9000, no_limit);
  CHECK(limit.resource == Refinement_resource::NONE);
  CHECK(limit.cells == 3000);
  CHECK(limit.bytes == 1600. * 3000 + 4000. * 9000);
  const auto resource = [](double bytes, double points) {
    return Budget(limits(bytes)).limit_of_round(2000, 6000, points).resource;
  };
  CHECK(resource(27.2e6, 6000) == Refinement_resource::NONE);
  CHECK(resource(27.1e6, 5999) == Refinement_resource::MEMORY);
  CHECK(resource(27.2e6, 5999) == Refinement_resource::NUMBERS);
}

TEST_CASE("Budget: the effort of a round includes the cells fitted in earlier rounds")
{
  BS::Refinement_parameters parameters;
  parameters.max_cells = 10000;
  Budget budget(parameters);
  const auto resource = [&](std::size_t cells) { return budget.limit_of_round(cells, 1, no_limit).resource; };
  CHECK(resource(10000) == Refinement_resource::NONE);
  CHECK(resource(10001) == Refinement_resource::EFFORT);
  for(std::size_t fitted : { 3000, 500 }) {
    budget.begin_round().cells = 3500; // only a part of these may be fitted
    budget.add_fitted_cells(fitted);
  }
  CHECK(resource(6500) == Refinement_resource::NONE);
  CHECK(resource(6501) == Refinement_resource::EFFORT);
}

TEST_CASE(
  "Budget: a partial round is stalled if it leaves as many undecided cells, or does not reach their examination")
{
  const auto was_in_vain = [](bool is_partial, bool examined_before, bool examined, std::size_t undecided_before,
                              std::size_t undecided) {
    Budget budget(limits(no_limit));
    add_round(budget, false, examined_before);
    budget.round().undecided_cells = undecided_before;
    add_round(budget, is_partial, examined);
    budget.round().undecided_cells = undecided;
    return budget.was_partial_round_stalled();
  };
  CHECK_FALSE(was_in_vain(true, true, true, 5, 4));
  CHECK(was_in_vain(true, true, true, 5, 5));
  CHECK_FALSE(was_in_vain(true, false, true, 5, 50));
  CHECK(was_in_vain(true, true, false, 5, 0));
  CHECK_FALSE(was_in_vain(false, true, true, 5, 50));
  Budget budget(limits(no_limit));
  CHECK_FALSE(budget.was_partial_round_stalled());
}

TEST_CASE("Budget: the time of a step starts at the end of the previous step")
{
  Budget budget(limits(no_limit));
  budget.start();
  budget.begin_round();
  // A step may be shorter than the resolution of the clock.
  const auto& seconds = budget.rounds()[0].seconds;
  for(int n = 0; n < 10000000 && !(seconds[Budget::CELLS] > 0); ++n) budget.end_step(Budget::CELLS);
  CHECK(seconds[Budget::CELLS] > 0);
  CHECK(seconds[Budget::SOLVER] == 0);
}
} // namespace test_Refinement_budget
