// Shell_placement.h: if another policy places a vertex outside a shell, it is moved into the shell; other placements
// are kept.
#include "polynomial_fields.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/Shell_filter.h>
#include <CGAL/Bspline_shell_3/Editing/Shell_placement.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Filtered_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/helpers.h>

#include <cmath>
#include <optional>

namespace test_Shell_placement {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
namespace SMS = CGAL::Surface_mesh_simplification;

// A user's kernel with its own filtered predicates; it is not one of CGAL's kernels.
struct Own_filtered_kernel
  : CGAL::Filtered_kernel_adaptor<
      CGAL::Type_equality_wrapper<CGAL::Simple_cartesian<double>::Base<Own_filtered_kernel>::Type, Own_filtered_kernel>,
      true>
{};

// The part of an edge profile that a placement uses.
template <typename Kernel>
struct Edge
{
  typedef typename Kernel::Point_3 Point;
  Point a, b;

  Point p0() const { return a; }
  Point p1() const { return b; }
};

template <typename Kernel>
struct Fixed_placement
{
  std::optional<typename Kernel::Point_3> place;

  template <typename Profile>
  auto operator()(const Profile&) const
  {
    return place;
  }
};

template <typename Kernel>
std::optional<typename Kernel::Point_3> placed(std::optional<typename Kernel::Point_3> place)
{
  static const auto shell = shell_of(uniform_field(squared_distance), 0.36, 0.6561);
  typedef typename Kernel::Point_3 Point_3;
  const BS::Shell_placement placement(shell, Fixed_placement<Kernel>{ place });
  return placement(Edge<Kernel>{ Point_3(0.7, 0, 0), Point_3(0, 0.8, 0) });
}

} // namespace

TEMPLATE_TEST_CASE(
  "Placement: a point in the shell is kept, and others are moved along the gradient to the edge's level", "",
  CGAL::Exact_predicates_inexact_constructions_kernel, CGAL::Simple_cartesian<double>)
{
  typedef typename TestType::Point_3 Point_3;
  for(const Point_3& p : { Point_3(0.5, 0.5, 0), Point_3(0, 0, -0.61), Point_3(0.8, 0, 0.1) })
    CHECK(placed<TestType>(p) == p);
  for(const Point_3& p : { Point_3(0.3, 0.4, 0), Point_3(0, -0.85, 0.1) }) {
    const auto moved = placed<TestType>(p);
    REQUIRE(moved);
    CHECK((*moved - CGAL::ORIGIN).squared_length() == Approx((0.49 + 0.64) / 2).epsilon(1e-4));
    CHECK(std::sqrt(CGAL::cross_product(*moved - CGAL::ORIGIN, p - CGAL::ORIGIN).squared_length()) < 1e-12);
  }
}

TEST_CASE("Placement: a missing placement stays missing, and a placement outside the domain is unchanged")
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
  CHECK_FALSE(placed<Kernel>(std::nullopt));
  CHECK(placed<Kernel>(Kernel::Point_3(0, 0, 50)) == Kernel::Point_3(0, 0, 50));
}

TEST_CASE("Placement: filter and placement together lead to a coarser certified mesh than the filter alone")
{
  const Mesh start = sphere(3);
  const auto shell = CGAL::certified_bspline_shell_3(start, P::relative_thickness(0.02));
  typedef SMS::LindstromTurk_placement<Mesh> Outside; // preserves the volume, so its points are outside a ball
  REQUIRE(shell);
  const auto collapsed = [&](const auto& placement) {
    Mesh mesh = start;
    SMS::edge_collapse(mesh, BS::Never_stop_predicate(),
                       CGAL::parameters::get_cost(SMS::LindstromTurk_cost<Mesh>())
                         .get_placement(placement)
                         .filter(BS::Shell_filter(shell)));
    mesh.collect_garbage();
    CHECK(CGAL::is_closed(mesh));
    BS::Shell_certificate_3 certificate(shell);
    CHECK(certificate.verify(mesh));
    return mesh.number_of_faces();
  };
  const std::size_t by_filter = collapsed(Outside());
  const std::size_t by_both = collapsed(BS::Shell_placement(shell, Outside()));
  CAPTURE(start.number_of_faces(), by_filter, by_both);
  CHECK(by_filter < start.number_of_faces());
  CHECK(by_both < by_filter);
}
} // namespace test_Shell_placement
