// thickness_on_mesh.h: the largest thickness, and the share of the area where the shell is thinner than requested,
// compared with a sum over cells.
#include <CGAL/Bspline_shell_3/Construction/thickness_on_mesh.h>
#include "random_hierarchies.h"
#include "input_of_mesh.h"

#include <CGAL/Bspline_shell_3/Construction/Shell_thresholds_3.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>

#include <algorithm>

namespace test_thickness_on_mesh {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Sequential_tag Tag;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef BS::Spline_threshold<Field> Threshold;
typedef Field::Cell_index Index;

} // namespace

TEST_CASE(
  "Thickness on a mesh: the largest thickness is as requested, and the narrowed area covers the cells near a cap")
{
  const BS::Input_mesh_3 input = input_of(sphere(3));
  const Field field(Hierarchy(all_cells(0.25, { -8, -8, -8 }, { 7, 7, 7 })));
  const BS::Clipped_mesh_3 clipped = BS::clip_mesh_to_cells<Tag>(input, field.cells());
  const double requested = 0.25;
  BS::Shell_thresholds_3<Field> thresholds(field, [&](const Point_3&) { return requested; });
  const auto thickness = [&](double wanted) {
    return BS::thickness_on_mesh(clipped, Threshold(thresholds.threshold<Tag>(CGAL::NEGATIVE)),
                                 Threshold(thresholds.threshold<Tag>(CGAL::POSITIVE)), [&](Index) { return wanted; });
  };
  CHECK(thickness(requested).largest == Approx(requested));
  CHECK(thickness(requested).narrowed_area == 0);
  CHECK(thickness(requested * 1.005).narrowed_area == 0);
  CHECK(thickness(requested * 1.02).narrowed_area == 1);

  thresholds.cap(field.locate(Point_3(0.95, 0.1, 0.1)), CGAL::POSITIVE, 0.05);
  const Field inner = thresholds.threshold<Tag>(CGAL::NEGATIVE), outer = thresholds.threshold<Tag>(CGAL::POSITIVE);
  double area = 0, narrow = 0;
  for(const auto& piece : clipped.pieces()) {
    double least = 1; // the least difference of coefficients; both thresholds are sums of functions that add up to one
    for(int n = 0; n < 64; ++n)
      least = (std::min)(least, outer.cell(piece.cell).coefficients()[n] - inner.cell(piece.cell).coefficients()[n]);
    area += clipped.area(piece);
    if(least < 0.99 * requested) narrow += clipped.area(piece);
  }
  const BS::Thickness_on_mesh capped = thickness(requested);
  CHECK(capped.largest == Approx(requested));
  CHECK(capped.narrowed_area == Approx(narrow / area));
  CHECK(capped.narrowed_area > 0.05);
  CHECK(capped.narrowed_area < 0.95);
}
} // namespace test_thickness_on_mesh
