// Refinement_budget.h: what the rounds so far say of the next one. Seconds are put in by hand: no clock runs, but in the last test.
#include <CGAL/Bspline_shell_3/Construction/Refinement_budget.h>

#include <catch2/catch.hpp>

#include <cstddef>
#include <limits>

namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Refinement_budget Budget;
using BS::Refinement_resource;

constexpr double no_limit = std::numeric_limits<double>::infinity();

BS::Refinement_parameters limits(double seconds, double bytes)
{
  BS::Refinement_parameters parameters;
  parameters.max_seconds = seconds;
  parameters.max_bytes = bytes;
  return parameters;
}

// of 1000 cells: two seconds for the fit, of ten
void add_round(Budget& budget, bool is_partial, bool is_examined, double rest = 8)
{
  BS::Refinement_round& round = budget.begin_round();
  round.cells = 1000;
  round.partial = is_partial;
  round.examined = is_examined;
  round.seconds[Budget::ASSEMBLY] = 1;
  round.seconds[Budget::SOLVER] = 1;
  round.seconds[Budget::BOUNDS] = rest;
}

const Budget::Size now = { 1000, 3000 };

} // namespace

TEST_CASE("Budget: a round takes as much a cell as the last one, and the fit's time once more if thresholds were not chosen")
{
  for(bool is_examined : { true, false }) {
    Budget budget(limits(no_limit, no_limit));
    add_round(budget, false, is_examined);
    const BS::Refinement_limit limit = budget.limit_of_round(3000, now, false, no_limit);
    CHECK(limit.resource == Refinement_resource::NONE);
    CHECK(limit.cells == 3000);
    CHECK(limit.seconds == (is_examined ? 30 : 36));
    CHECK(limit.bytes == 1600. * 3000 + 4000. * 9000);
  }
}

TEST_CASE("Budget: what is beyond a limit is said, time before memory before numbers")
{
  const auto resource = [](double seconds, double bytes, double points) {
    Budget budget(limits(seconds, bytes));
    add_round(budget, false, true);
    return budget.limit_of_round(2000, now, false, points).resource;
  };
  CHECK(resource(20, 27.2e6, 6000) == Refinement_resource::NONE);
  CHECK(resource(19.9, 27.1e6, 5999) == Refinement_resource::TIME);
  CHECK(resource(20, 27.1e6, 5999) == Refinement_resource::MEMORY);
  CHECK(resource(20, 27.2e6, 5999) == Refinement_resource::NUMBERS);
}

TEST_CASE("Budget: a round with few cells more costs what a partial one did, others what the last full one did")
{
  Budget budget(limits(no_limit, no_limit));
  add_round(budget, false, true, 18);
  add_round(budget, true, true, 2);
  const auto seconds = [&](std::size_t cells, bool may_be_partial) { return budget.limit_of_round(cells, now, may_be_partial, no_limit).seconds; };
  CHECK(seconds(1024, true) == Approx(1.024 * 4));
  CHECK(seconds(1024, false) == Approx(1.024 * 20));
  CHECK(seconds(1033, true) == Approx(1.033 * 20));
}

TEST_CASE("Budget: a partial round was in vain if it left as much to be mended, or did not get as far")
{
  const auto was_in_vain = [](bool is_partial, bool examined_before, bool examined, std::size_t undecided_before, std::size_t undecided) {
    Budget budget(limits(no_limit, no_limit));
    add_round(budget, false, examined_before);
    budget.round().undecided_cells = undecided_before;
    add_round(budget, is_partial, examined);
    budget.round().undecided_cells = undecided;
    return budget.was_part_in_vain();
  };
  CHECK_FALSE(was_in_vain(true, true, true, 5, 4));
  CHECK(was_in_vain(true, true, true, 5, 5));
  CHECK_FALSE(was_in_vain(true, false, true, 5, 50));
  CHECK(was_in_vain(true, true, false, 5, 0));
  CHECK_FALSE(was_in_vain(false, true, true, 5, 50));
  Budget budget(limits(no_limit, no_limit));
  CHECK_FALSE(budget.was_part_in_vain());
}

TEST_CASE("Budget: the time of steps is that of all, and no time is left when it is up")
{
  Budget budget(limits(0, no_limit));
  budget.start();
  budget.begin_round();
  const auto sum = [&] {
    double seconds = 0;
    for(double s : budget.rounds()[0].seconds) seconds += s;
    return seconds;
  };
  // each step may be shorter than the clock's tick
  do {
    budget.end_step(Budget::CELLS);
    budget.end_step(Budget::SOLVER);
  } while(!(sum() > 0) && budget.seconds() < 60);
  CHECK(sum() > 0);
  CHECK(sum() <= budget.seconds());
  CHECK(budget.is_late());
  CHECK(budget.seconds_left() < 0);
  CHECK(budget.limit_of_round(1, { 1, 1 }, false, no_limit).resource == Refinement_resource::TIME);
}
