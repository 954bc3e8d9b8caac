// choose_resolution.h: shares of cells at known edges and folds, and the resolution that follows from them.
#include <CGAL/Bspline_shell_3/Construction/choose_resolution.h>
#include <CGAL/certified_bspline_shell_3.h>
#include "input_of_mesh.h"

namespace test_choose_resolution {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;

template <typename Tag = CGAL::Sequential_tag>
BS::Bend_shares shares(const Mesh& mesh, double spacing)
{
  const BS::Input_mesh_3 in = input_of(mesh);
  return BS::bend_shares<Tag>(in, BS::Lattice_3::off_the_ends(in.bbox(), spacing));
}

double chosen(const Mesh& mesh, double thickness)
{
  return BS::choose_resolution<CGAL::Sequential_tag>(input_of(mesh), thickness);
}

} // namespace

TEST_CASE("Resolution: a cube is bent in the cells at its edges, and folded in those at its corners")
{
  const Mesh cube = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  for(int n : { 4, 8, 32 }) {
    // Faces of the cube are in the middle of cells; each edge enters n + 1 cells.
    const double all = (n + 1) * (n + 1) * (n + 1) - (n - 1) * (n - 1) * (n - 1), at_edges = 12 * (n - 1),
                 at_corners = 8;
    const BS::Bend_shares s = shares(cube, 1. / n);
    CHECK(s.bent == Approx((at_edges + at_corners) / all));
    CHECK(s.folded == Approx(at_corners / all));
  }
}

TEST_CASE("Resolution: two sides of a plate in one cell count as a fold, and all cells are folded if they are wide")
{
  CHECK(shares(box(Point_3(0, 0, 0), Point_3(1, 1, 0.01)), 0.05).folded == 1);
  const BS::Bend_shares ball = shares(sphere(3), 1. / 16), in_one_cell = shares(sphere(3), 100);
  CHECK(ball.bent == 0);
  CHECK(ball.folded == 0);
  CHECK(in_one_cell.folded == 1);
}

TEST_CASE("Resolution: cells are as wide as the mesh and the thickness allow")
{
  CHECK(chosen(box(Point_3(0, 0, 0), Point_3(1, 1, 1)), 0.01) == 20);
  CHECK(chosen(box(Point_3(0, 0, 0), Point_3(7, 7, 7)), 0.07) == 20);
  CHECK(chosen(sphere(4), 0.02) == 20);
  CHECK(chosen(demo_mesh("hole.off"), 0.01 * input_of(demo_mesh("hole.off")).unit()) == 24);
  CHECK(chosen(demo_mesh("fandisk.off"), 0.01 * input_of(demo_mesh("fandisk.off")).unit())
        == BS::resolution_tuning.finest);
  CHECK(chosen(box(Point_3(0, 0, 0), Point_3(1, 1, 0.01)), 0.01) == BS::resolution_tuning.finest);
  CHECK(chosen(box(Point_3(0, 0, 0), Point_3(1, 1, 1)), 0.005) == BS::resolution_tuning.finest);
}

TEST_CASE("Resolution: a shell has the chosen or the requested resolution, for any number of threads")
{
  const Mesh cube = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  CHECK(CGAL::certified_bspline_shell_3(cube).report().gamma == Approx(20));
  CHECK(CGAL::certified_bspline_shell_3(cube, parameters::resolution(12).relative_thickness(0.05)).report().gamma
        == Approx(12));
  CHECK(CGAL::certified_bspline_shell_3(cube, parameters::relative_thickness(0.005)).report().gamma
        == Approx(BS::resolution_tuning.finest));
  const Mesh elephant = demo_mesh("elephant.off");
  const BS::Bend_shares one = shares(elephant, 0.05), two = shares<CGAL::Parallel_if_available_tag>(elephant, 0.05);
  CHECK(one.bent == two.bent);
  CHECK(one.folded == two.folded);
}
} // namespace test_choose_resolution
