// is_same_in_cell.h: fields are the same in a cell if no coefficient there has changed, even if cells were renumbered.
#include <CGAL/Bspline_shell_3/Field/is_same_in_cell.h>
#include "random_hierarchies.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <limits>

namespace test_is_same_in_cell {
namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef Field::Cell_index Index;

TEST_CASE("Same in a cell: fields differ exactly in the cells on which a changed coefficient acts")
{
  CGAL::Random random(1);
  const Hierarchy cells = random_hierarchy(random, all_cells(1, { -4, -4, -4 }, { 3, 3, 3 }), 2);
  Field f(cells), g(cells);
  Eigen::VectorXd x(Eigen::Index(f.number_of_coefficients()));
  for(double& value : x) value = random.get_double(1, 2);
  f.set_coefficients(x);
  for(int n = 0; n < 10; ++n) {
    const Index u = Index(random.get_int(0, int(x.size())));
    Eigen::VectorXd y = x;
    // A change of the last digit would not suffice: for a function on small cells, it may vanish in sums.
    y[u] = n % 2 == 0 ? x[u] + 1e-9 : -x[u];
    g.set_coefficients(y);
    std::size_t wrong = 0;
    for(Index c = 0; c < f.number_of_cells(); ++c) {
      bool acts = false;
      f.visit_coefficients(c, [&](int, Index v, double) { acts |= v == u; });
      wrong += BS::is_same_in_cell(f, c, g, c) == acts;
    }
    CHECK(wrong == 0);
  }
  CHECK_FALSE(BS::is_same_in_cell(f, 0, f, 1));
  CHECK(BS::is_same_in_cell(f, 1, f, 1));
}
} // namespace test_is_same_in_cell
