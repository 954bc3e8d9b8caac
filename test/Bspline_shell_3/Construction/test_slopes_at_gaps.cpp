// slopes_at_gaps.h: slopes that a field can have on cells wider than a wall, compared with a field that attains them.
#include <CGAL/Bspline_shell_3/Construction/slopes_at_gaps.h>
#include "random_hierarchies.h"
#include "input_of_mesh.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace test_slopes_at_gaps {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef Hierarchy::Index Index;

} // namespace

TEST_CASE(
  "Slopes at gaps: the limit is a quarter of the slope of a parabola across the wall, and infinite at wide walls")
{
  for(double width : { 0.25, 0.5, 1. })
    for(double thickness : { 0.4, 0.1, 0.001 }) {
      const BS::Input_mesh_3 input = input_of(box(Point_3(-3, -3, 0.2), Point_3(3, 3, 0.2 + thickness)));
      const int n = int(4 / width);
      const Hierarchy cells(all_cells(width, { -n, -n, -n }, { n - 1, n - 1, n - 1 }));
      const BS::Clipped_mesh_3 clipped = BS::clip_mesh_to_cells<CGAL::Sequential_tag>(input, cells);
      const BS::Local_gap_3 gap(input);
      const Index below = cells.locate(Point_3(1.1, 1.2, 0.2)), empty = cells.locate(Point_3(1.1, 1.2, 2.2));
      const std::vector<double> slopes = BS::slopes_at_gaps<CGAL::Sequential_tag>(cells, { below, empty }, gap,
                                                                                  clipped);
      REQUIRE(slopes.size() == 2);
      CHECK(slopes[1] == std::numeric_limits<double>::infinity());
      if(thickness < width) CHECK(slopes[0] == Approx(thickness / width / 4));
      else CHECK(slopes[0] == std::numeric_limits<double>::infinity());

      // The field is (z - low) (z - high) / width. The coefficients of a quadratic polynomial are its values at the
      // nodes minus width^2 / 3 times its leading coefficient.
      Field field(cells);
      std::vector<double> coefficients(field.number_of_coefficients());
      for(Index u = 0; u < coefficients.size(); ++u) {
        const CGAL::Bbox_3 support = field.support(u);
        const double z = (support.zmin() + support.zmax()) / 2;
        coefficients[u] = ((z - 0.2) * (z - 0.2 - thickness) - width * width / 3) / width;
      }
      field.set_coefficients<CGAL::Sequential_tag>(
        Eigen::Map<const Eigen::VectorXd>(coefficients.data(), Eigen::Index(coefficients.size())));
      const Field::Point_3 on_mesh(1.1, 1.2, 0.2);
      CHECK(std::abs(*field.value(on_mesh)) < 1e-12);
      const double slope = -(*field.gradient(on_mesh))[2];
      CHECK(slope == Approx(thickness / width));
      CHECK((thickness < width ? slope >= 4 * slopes[0] * (1 - 1e-9) : true));

      std::vector<Index> all(cells.number_of_cells());
      std::iota(all.begin(), all.end(), Index(0));
      CHECK(BS::slopes_at_gaps<CGAL::Sequential_tag>(cells, all, gap, clipped)
            == BS::slopes_at_gaps<CGAL::Parallel_if_available_tag>(cells, all, gap, clipped));
    }
}
} // namespace test_slopes_at_gaps
