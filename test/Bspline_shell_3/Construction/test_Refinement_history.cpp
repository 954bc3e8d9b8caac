// Refinement_history.h: conclusions from the rounds of a refinement.
#include <CGAL/Bspline_shell_3/Construction/Refinement_history.h>

#include <catch2/catch.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace test_Refinement_history {
namespace {

namespace BS = CGAL::Bspline_shells;
using BS::Obstacle_kind;

BS::Refinement_round round_with(std::size_t thick_cells, std::size_t failing_facets, std::size_t undecided_cells)
{
  BS::Refinement_round round;
  round.thick_cells = thick_cells;
  round.failing_facets = failing_facets;
  round.undecided_cells = undecided_cells;
  return round;
}

} // namespace

TEST_CASE("Refinement history: refinement is stalled after too many successive rounds without progress")
{
  const BS::Refinement_tuning tuning;
  BS::Refinement_history history(0, tuning);
  history.add_round(round_with(0, 5, 100), 1);
  for(int n = 1; n < tuning.max_stalled_rounds; ++n) {
    history.add_round(round_with(0, 5, 100), 1);
    CHECK_FALSE(history.is_stalled());
  }
  SECTION("one more round without progress")
  {
    history.add_round(round_with(0, 9, 200), 2);
    CHECK(history.is_stalled());
  }
  SECTION("a round with progress resets the count")
  {
    SECTION("fewer facets") history.add_round(round_with(0, 4, 100), 1);
    SECTION("clearly fewer obstacles") history.add_round(round_with(0, 5, 89), 1);
    SECTION("clearly smaller volume of obstacles") history.add_round(round_with(0, 5, 100), 0.89);
    SECTION("rounds with fields that are too large do not count") history.add_round(round_with(1, 5, 100), 1);
    CHECK_FALSE(history.is_stalled());
    for(int n = 0; n < tuning.max_stalled_rounds; ++n) history.add_round(round_with(0, 5, 100), 1);
    CHECK(history.is_stalled());
  }
  SECTION("slightly fewer obstacles are no progress")
  {
    history.add_round(round_with(0, 5, 91), 0.91);
    CHECK(history.is_stalled());
  }
}

TEST_CASE("Refinement history: refinement is stalled if failing cells are at folds and do not become fewer")
{
  BS::Refinement_tuning tuning;
  tuning.max_rounds_at_folds = 3;
  const auto is_stalled_after = [&](const std::vector<std::array<std::size_t, 2> >& rounds) {
    BS::Refinement_history history(0, tuning);
    for(const auto& round : rounds) {
      CHECK_FALSE(history.is_stalled());
      history.add_failing_cells(round[0], round[1]);
    }
    return history.is_stalled();
  };
  CHECK(is_stalled_after({ { 20, 15 }, { 20, 15 }, { 40, 30 }, { 80, 60 } }));
  CHECK(is_stalled_after({ { 20, 20 }, { 1, 1 }, { 5, 5 }, { 5, 5 }, { 7, 7 } }));
  CHECK_FALSE(is_stalled_after({ { 20, 15 }, { 20, 15 }, { 40, 30 }, { 80, 59 } })); // many other cells fail
  CHECK_FALSE(is_stalled_after({ { 1, 1 }, { 90, 90 }, { 60, 60 }, { 30, 30 } }));   // fewer than before
  CHECK_FALSE(is_stalled_after({ { 20, 20 }, { 20, 20 }, { 0, 0 }, { 20, 20 }, { 20, 20 }, { 20, 20 } }));
}

TEST_CASE("Refinement history: a facet causes a few refinements only, at most one per round")
{
  BS::Refinement_tuning tuning;
  tuning.max_refinements_of_a_facet = 2;
  BS::Refinement_history history(8, tuning);
  const std::vector<BS::Sloping_facet> facets = { { 10, 7 }, { 11, 3 }, { 12, 7 } };
  for(int n = 0; n < 2; ++n) {
    CHECK(history.cells_worth_refining(facets) == std::vector<std::uint32_t>{ 10, 11, 12 });
    history.add_refinements(facets);
  }
  CHECK(history.cells_worth_refining(facets).empty());
  CHECK(history.cells_worth_refining({ { 5, 0 }, { 6, 3 } }) == std::vector<std::uint32_t>{ 5 });
}

TEST_CASE("Refinement history: whether obstacles are few or many depends on the size of the mesh")
{
  const BS::Refinement_tuning tuning;
  const auto kind = [&](std::size_t cells, std::size_t cells_at_mesh) {
    return BS::Refinement_history(0, tuning).kind_of_obstacles(cells, cells_at_mesh, false);
  };
  CHECK(kind(0, 1000) == Obstacle_kind::FEW);
  CHECK(kind(100, 2000) == Obstacle_kind::FEW);
  CHECK(kind(101, 2000) == Obstacle_kind::MANY);
  CHECK(kind(1000, 128000) == Obstacle_kind::FEW);
  CHECK(kind(1001, 128000) == Obstacle_kind::MANY);
}

TEST_CASE("Refinement history: many obstacles of a field that is too large on the mesh do not indicate narrow gaps")
{
  const BS::Refinement_tuning tuning;
  BS::Refinement_history history(0, tuning);
  CHECK(history.kind_of_obstacles(900, 1000, true) == Obstacle_kind::THICK_FIELD);
  CHECK_FALSE(history.are_gaps_narrow());
  CHECK(history.kind_of_obstacles(9, 1000, true) == Obstacle_kind::FEW);
}

TEST_CASE("Refinement history: gaps remain narrow after one round with very many obstacles, or two with many")
{
  const BS::Refinement_tuning tuning;
  BS::Refinement_history history(0, tuning);
  const std::size_t all = 12000;
  SECTION("very many obstacles")
  {
    CHECK(history.kind_of_obstacles(2400, all, false) == Obstacle_kind::MANY);
    BS::Refinement_history other(0, tuning);
    CHECK(other.kind_of_obstacles(2401, all, false) == Obstacle_kind::NARROW_GAPS);
    CHECK(other.kind_of_obstacles(1, all, false) == Obstacle_kind::NARROW_GAPS);
    CHECK(other.kind_of_obstacles(0, all, false) == Obstacle_kind::FEW);
    CHECK(other.kind_of_obstacles(2401, all, true) == Obstacle_kind::THICK_FIELD);
    CHECK(other.are_gaps_narrow());
  }
  SECTION("many obstacles twice in a row")
  {
    CHECK(history.kind_of_obstacles(1001, all, false) == Obstacle_kind::MANY);
    CHECK(history.kind_of_obstacles(1001, all, false) == Obstacle_kind::NARROW_GAPS);
  }
  SECTION("many obstacles, with fewer in between")
  {
    CHECK(history.kind_of_obstacles(1001, all, false) == Obstacle_kind::MANY);
    CHECK(history.kind_of_obstacles(999, all, false) == Obstacle_kind::MANY);
    CHECK(history.kind_of_obstacles(1001, all, false) == Obstacle_kind::MANY);
    CHECK_FALSE(history.are_gaps_narrow());
  }
}
} // namespace test_Refinement_history
