// refined_coefficients.h, visit_parent_points.h: the function stays the same on finer cells.
#include "random_hierarchies.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/refined_coefficients.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace test_refined_coefficients {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef Field::Cell_index Index;
typedef Field::Point_3 Point_3;

const BS::Lattice_3 lattice = BS::Lattice_3::from_origin({ 0, 0, 0 }, 0.5, { -4, -4, -4 }, { 4, 4, 4 });

Eigen::VectorXd random_coefficients(CGAL::Random& random, const Field& field)
{
  Eigen::VectorXd x(Eigen::Index(field.number_of_coefficients()));
  for(double& value : x) value = random.get_int(-1000, 1000);
  return x;
}

// Returns the cells after a few more splits, at random levels.
Hierarchy finer(CGAL::Random& random, const Hierarchy& cells, int times)
{
  Hierarchy result = cells;
  for(int n = 0; n < times; ++n)
    result = result.refined({ Index(random.get_int(0, int(result.number_of_cells()))) }, n % 2 + 1);
  return result;
}

} // namespace

TEST_CASE("Refined coefficients: the function is unchanged, and exactly so where no nearby cell was split")
{
  CGAL::Random random(5);
  std::size_t same_leaves = 0, split_leaves = 0;
  for(int n = 0; n < 12; ++n) {
    const Field coarse(random_hierarchy(
      random, some_cells(random, lattice, { -2, -2, -2 }, { 2, 2, 2 }, n % 3 == 0 ? 0.7 : 1), 1 + n % 3));
    const Field fine(finer(random, coarse.cells(), 1 + n % 4));
    const Eigen::VectorXd x = random_coefficients(random, coarse);
    Field before = coarse, after = fine;
    before.set_coefficients(x);
    after.set_coefficients(BS::refined_coefficients(coarse, x, fine));
    double worst = 0;
    for(Index c = 0; c < after.number_of_cells(); ++c) {
      const std::array<double, 3> corner = after.cells().corner(c);
      const double w = after.cells().width(c);
      for(int p = 0; p < 4; ++p) {
        const Point_3 at(corner[0] + w * random.get_double(), corner[1] + w * random.get_double(),
                         corner[2] + w * random.get_double());
        worst = (std::max)(worst, std::abs(after.value(at).value() - before.value(at).value()));
      }
      // Coefficients are integers, and weights are multiples of powers of two. Sums are exact, so old leaves keep their
      // function.
      const Index old = after.cells().level(c) < before.number_of_levels()
                          ? before.cells().leaf(after.cells().level(c), after.cells().lattice_point(c))
                          : Field::npos;
      if(old == Field::npos) {
        ++split_leaves;
        continue;
      }
      ++same_leaves;
      CHECK(
        std::equal(after.cell(c).coefficients(), after.cell(c).coefficients() + 64, before.cell(old).coefficients()));
    }
    CHECK(worst < 1e-9);
  }
  CHECK(same_leaves > 100);
  CHECK(split_leaves > 100);
}

TEST_CASE("Refined coefficients: on the same cells, the coefficients are unchanged")
{
  CGAL::Random random(6);
  const Field field(random_hierarchy(random, some_cells(random, lattice, { -2, -2, -2 }, { 2, 2, 2 }), 3));
  const Eigen::VectorXd x = random_coefficients(random, field);
  CHECK((BS::refined_coefficients(field, x, field) == x));
}
} // namespace test_refined_coefficients
