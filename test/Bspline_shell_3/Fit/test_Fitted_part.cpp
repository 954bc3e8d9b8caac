// Fitted_part.h: coefficients that act on cells, compared with a search.
#include "random_hierarchies.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Fit/Fitted_part.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace test_Fitted_part {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef Field::Cell_index Index;

const BS::Lattice_3 lattice = BS::Lattice_3::from_origin({ 0, 0, 0 }, 0.5, { -4, -4, -4 }, { 4, 4, 4 });

// Returns whether the basis function of a coefficient is nonzero on a cell.
bool acts(const Field& field, Index u, Index c)
{
  Field one = field;
  one.set_coefficients(Eigen::VectorXd::Unit(Eigen::Index(field.number_of_coefficients()), Eigen::Index(u)));
  const double* b = one.cell(c).coefficients();
  return std::any_of(b, b + 64, [](double x) { return x != 0; });
}

} // namespace

TEST_CASE(
  "Fitted part: a part has the coefficients acting on the given cells, and all cells and points affected by them")
{
  CGAL::Random random(7);
  const Field field(random_hierarchy(random, some_cells(random, lattice, { -1, -1, -1 }, { 1, 1, 1 }, 0.8), 2));
  const std::vector<std::uint32_t> chosen = random_leaves(random, field.cells(), 2);
  const BS::Fitted_part part(field, chosen);
  REQUIRE(part.coefficients.size() == field.number_of_coefficients());
  REQUIRE(part.cells.size() == field.number_of_cells());
  std::vector<char> coefficients(field.number_of_coefficients(), 0), cells(field.number_of_cells(), 0);
  for(Index u = 0; u < field.number_of_coefficients(); ++u)
    coefficients[u] = std::any_of(chosen.begin(), chosen.end(), [&](Index c) { return acts(field, u, c); });
  CHECK(part.coefficients == coefficients);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(coefficients.size()));
  for(std::size_t u = 0; u < coefficients.size(); ++u) x[Eigen::Index(u)] = coefficients[u];
  const Eigen::VectorXd all = field.extend(x);
  // Weights are positive, so terms do not cancel.
  for(Eigen::Index p = 0; p < all.size(); ++p) CHECK(bool(part.points[std::size_t(p)]) == (all[p] != 0));
  Field sum = field;
  sum.set_coefficients(x);
  for(Index c = 0; c < field.number_of_cells(); ++c) {
    const double* b = sum.cell(c).coefficients();
    cells[c] = std::any_of(b, b + 64, [](double y) { return y != 0; });
  }
  CHECK(part.cells == cells);
  CHECK(part.number_of_cells == std::size_t(std::count(cells.begin(), cells.end(), 1)));
  CHECK(part.number_of_cells < field.number_of_cells());
  CHECK(part.number_of_cells > chosen.size());
}
} // namespace test_Fitted_part
