// extract_shell_surface.h: the surfaces of a shell are closed manifolds on their thresholds, beside the mesh.
#include <CGAL/Bspline_shell_3/Surface/extract_shell_surface.h>
#include "coefficient_functions.h"
#include "shell_reports.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Surface/extract_level_set.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/helpers.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace test_extract_shell_surface {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace PMP = CGAL::Polygon_mesh_processing;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef CGAL::Bspline_shell_3<Field> Shell;
typedef BS::Shell_certificate_3<Field> Certificate;
using BS::Level_set_status;
using BS::extract_shell_surface;

// Checks that a mesh is a closed manifold, and returns its Euler characteristic.
int check_closed_manifold(const Mesh& mesh)
{
  CHECK(CGAL::is_valid_polygon_mesh(mesh));
  CHECK(CGAL::is_triangle_mesh(mesh));
  CHECK(CGAL::is_closed(mesh));
  std::vector<Mesh::Halfedge_index> non_manifold;
  PMP::non_manifold_vertices(mesh, std::back_inserter(non_manifold));
  CHECK(non_manifold.empty());
  return int(mesh.number_of_vertices()) - int(mesh.number_of_edges()) + int(mesh.number_of_faces());
}

// Returns the surface at a threshold, which is a closed manifold with the given Euler characteristic.
template <typename Shell, typename Threshold>
Mesh closed_surface(const Shell& shell, const Threshold& threshold, int euler_characteristic)
{
  Mesh surface;
  REQUIRE(extract_shell_surface(shell, threshold, surface) == Level_set_status::SUCCESS);
  CHECK(check_closed_manifold(surface) == euler_characteristic);
  return surface;
}

// Checks that both surfaces are closed, on their thresholds, and have the given Euler characteristic. Returns the
// volumes inside.
template <typename Shell>
std::array<double, 2> check_surfaces(const Shell& shell, int euler_characteristic)
{
  std::array<double, 2> volumes;
  for(int side = 0; side < 2; ++side) {
    const auto& threshold = side == 1 ? shell.outer_threshold() : shell.inner_threshold();
    const Mesh surface = closed_surface(shell, threshold, euler_characteristic);
    CHECK_FALSE(PMP::does_self_intersect(surface));
    double largest = 0;
    for(auto v : surface.vertices())
      largest = (std::max)(largest,
                           std::abs(*shell.field().value(surface.point(v)) - threshold.value(surface.point(v))));
    CHECK(largest < 1e-11 * shell.report().unit);
    volumes[std::size_t(side)] = PMP::volume(surface);
  }
  return volumes;
}

// The field is close to -8 (r - 0.7)^2 in spherical coordinates. The levels occur on both sides of its ridge, and cells
// are wider than the gap between both shells. The ridge of the spline is at 0.693.
const double ridge = 0.693;
constexpr BS::Level_range levels{ -0.36, -0.062 };

const Field& two_shells()
{
  static const Field field = radial_spline<Field>(9, 0.125, [](double r) { return -8 * (r - 0.7) * (r - 0.7); });
  return field;
}

Mesh small_sphere()
{
  return sphere(3, 0.56);
}
Mesh both_spheres()
{
  return joined(reversed(sphere(3, 0.85)), small_sphere());
}

Certificate certificate_of(const Mesh& mesh)
{
  Certificate certificate(two_shells(), BS::Constant_threshold(levels.min), BS::Constant_threshold(levels.max));
  REQUIRE(certificate.verify<CGAL::Sequential_tag>(mesh));
  return certificate;
}

// Returns the boxes of a certificate's cover, without those beyond the ridge. Boxes that touch at the ridge join both
// shells in the cover, but each of them is on one side, or excluded.
std::vector<BS::Cover_box> boxes_within_ridge(const Certificate& certificate)
{
  std::vector<BS::Cover_box> boxes = certificate.cover()->boxes();
  for(BS::Cover_box& box : boxes) {
    const CGAL::Bbox_3 b = certificate.cover()->bbox(box);
    const Point_3 center((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2);
    if(CGAL::squared_distance(center, Point_3(0, 0, 0)) > ridge * ridge) box.component = BS::Cover_box::no_component;
  }
  return boxes;
}

// Returns the shell of a certificate's mesh, with the given boxes.
Shell shell_of(const Certificate& certificate, const std::vector<BS::Cover_box>& boxes, bool has_cover = true)
{
  Shell shell(two_shells(), levels, cells_of_cover(boxes, two_shells().number_of_cells()), {},
              successful_report(1, certificate.report()));
  if(has_cover) BS::internal::Shell_access::set_proved_cover(shell, boxes);
  REQUIRE(shell.is_certified());
  return shell;
}

bool is_small(const Mesh& mesh)
{
  return std::all_of(mesh.vertices().begin(), mesh.vertices().end(),
                     [&](auto v) { return CGAL::squared_distance(mesh.point(v), Point_3(0, 0, 0)) < ridge * ridge; });
}

} // namespace

TEST_CASE("Shell surfaces: the surfaces are closed, lie on either side of the mesh, and have its topology", "[slow]")
{
  const CGAL::Certified_bspline_shell_3 shell = CGAL::certified_bspline_shell_3(
    box(Point_3(0, 0, 0), Point_3(1, 0.6, 0.3)), BS::parameters::resolution(12).relative_thickness(0.005));
  REQUIRE(shell.is_certified());
  REQUIRE(shell.field().number_of_levels() > 1);
  const auto [inner, outer] = check_surfaces(shell, 2);
  CHECK(inner < 0.18);
  CHECK(outer > 0.18);
}

TEST_CASE("Shell surfaces: the surfaces of an open mesh also surround its closing")
{
  const Mesh mesh = sheet({ 0, 0.2, 0.4, 0.6, 0.8, 1 }, { 0, 0.25, 0.5 }, [](double x, double) { return x * x / 8; });
  const CGAL::Certified_bspline_shell_3 shell = CGAL::certified_bspline_shell_3(mesh);
  REQUIRE(shell.is_certified());
  REQUIRE(shell.closing());
  const auto [inner, outer] = check_surfaces(shell, 2);
  CHECK(0 < inner);
  CHECK(inner < outer);
}

TEST_CASE("Shell surfaces: in a plate thinner than a cell, both sides of the inner surface are separate")
{
  const Mesh plate = box(Point_3(0, 0, 0), Point_3(1, 1, 0.05));
  const CGAL::Certified_bspline_shell_3 shell = CGAL::certified_bspline_shell_3(plate);
  REQUIRE(shell.is_certified());
  check_surfaces(shell, 2);
}

TEST_CASE("Shell surfaces: other parts of the level set in the same cells are excluded by smaller boxes of the cover")
{
  const Certificate certificate = certificate_of(small_sphere());
  const Shell shell = shell_of(certificate, boxes_within_ridge(certificate));
  // Cells alone do not separate the surfaces.
  Mesh surface;
  const auto is_in_shell = [&](Field::Cell_index c) { return shell.shell_cells()[c] != 0; };
  CHECK(BS::extract_level_set(two_shells(), levels.max, surface, BS::parameters::filter(is_in_shell))
        == Level_set_status::LEVEL_SET_LEAVES_CELLS);
  double volume = 0;
  for(const auto& threshold : { shell.inner_threshold(), BS::Constant_threshold(-0.2), shell.outer_threshold() }) {
    const Mesh inside = closed_surface(shell, threshold, 2);
    CHECK(is_small(inside));
    CHECK(PMP::volume(inside) > volume);
    volume = PMP::volume(inside);
  }
}

TEST_CASE("Shell surfaces: other parts of the level set in the same cover component are excluded by paths")
{
  std::vector<BS::Cover_box> cover = certificate_of(both_spheres()).cover()->boxes();
  for(BS::Cover_box& box : cover)
    if(box.component != BS::Cover_box::no_component) box.component = 0;
  const Shell shell = shell_of(certificate_of(small_sphere()), cover);
  CHECK(is_small(closed_surface(shell, shell.outer_threshold(), 2)));

  // Surfaces at other components of the mesh are not left out.
  const Shell shell_of_both = shell_of(certificate_of(both_spheres()), cover);
  closed_surface(shell_of_both, shell.outer_threshold(), 4);
}

TEST_CASE("Shell surfaces: without a cover, all surfaces in the shell's cells are extracted")
{
  const Certificate of_both = certificate_of(both_spheres()), of_one = certificate_of(small_sphere());
  const Shell shell = shell_of(of_both, of_both.cover()->boxes(), false);
  closed_surface(shell, shell.outer_threshold(), 4);
  Mesh surface;
  const Shell one = shell_of(of_one, boxes_within_ridge(of_one), false);
  CHECK(extract_shell_surface(one, one.outer_threshold(), surface) == Level_set_status::LEVEL_SET_LEAVES_CELLS);
}

#ifdef CGAL_LINKED_WITH_TBB
TEST_CASE("Shell surfaces: several threads yield the same mesh, which is added to the output mesh")
{
  const Certificate certificate = certificate_of(small_sphere());
  const Shell shell = shell_of(certificate, certificate.cover()->boxes());
  const auto& threshold = shell.outer_threshold();
  Mesh one, several;
  REQUIRE(extract_shell_surface<CGAL::Sequential_tag>(shell, threshold, one) == Level_set_status::SUCCESS);
  REQUIRE(extract_shell_surface<CGAL::Parallel_tag>(shell, threshold, several) == Level_set_status::SUCCESS);
  CHECK(is_equal(one, several));
  const auto coarse = CGAL::parameters::subdivision_ratio(1);
  REQUIRE(extract_shell_surface(shell, shell.inner_threshold(), one, coarse) == Level_set_status::SUCCESS);
  CHECK(check_closed_manifold(one) == 4);
}
#endif
} // namespace test_extract_shell_surface
