// Time limits, and visitors that cancel. A run that is not ended gives the result of a run without them; otherwise
// there is no result, and the status has the reason.
#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/bspline_shell_3.h>
#include <CGAL/certified_bspline_shell_3.h>
#include <CGAL/certified_shell_of_soup_3.h>
#include <CGAL/certified_soup_proxy_3.h>
#include "test_meshes.h"

#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/tags.h>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace test_time_limits {
namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;
typedef CGAL::Certified_bspline_shell_3 Shell;
typedef BS::Shell_status Status;

namespace {

constexpr double long_time = 1e6, no_time = 1e-9;

// Cancels at the n-th poll.
struct Impatient_visitor
{
  std::size_t most = std::size_t(-1), polls = 0;
  std::array<std::size_t, 6> polls_of_step = {};
  BS::Shell_step step = BS::Shell_step::CHECK;

  bool start_step(BS::Shell_step s)
  {
    step = s;
    return true;
  }
  bool go_on()
  {
    ++polls_of_step[std::size_t(step)];
    return ++polls < most;
  }
};

// Calls f for the first and the last poll of a run, and for some between them, at increasing distances.
template <typename Function>
void sweep(std::size_t polls, const Function& f)
{
  REQUIRE(polls > 50);
  for(std::size_t n = 1; n < polls; n += 1 + n) f(n);
  f(polls);
}

// Returns a mesh whose shell takes several rounds.
Mesh wall()
{
  return box(Point_3(0, 0, 0), Point_3(1, 1, 0.03));
}

bool are_equal(const Shell& a, const Shell& b)
{
  return a.status() == b.status() && a.is_certified() == b.is_certified()
         && a.field().number_of_cells() == b.field().number_of_cells()
         && a.field().coefficients() == b.field().coefficients() && a.report().thickness == b.report().thickness
         && a.report().rounds.size() == b.report().rounds.size();
}

BS::Polygon_soup soup_of(const Mesh& mesh)
{
  BS::Polygon_soup soup;
  CGAL::Polygon_mesh_processing::polygon_mesh_to_polygon_soup(mesh, soup.points, soup.polygons);
  return soup;
}

// Returns three facets at a common edge. They are not a mesh, so a proxy is built.
BS::Polygon_soup fan()
{
  BS::Polygon_soup soup;
  soup.points = { Point_3(0, 0, 0), Point_3(0, 0, 1), Point_3(1, 0, 0.5), Point_3(-1, 1, 0.5), Point_3(-1, -1, 0.5) };
  soup.polygons = { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } };
  return soup;
}

bool are_equal(const Mesh& a, const Mesh& b)
{
  if(a.number_of_faces() != b.number_of_faces() || a.number_of_vertices() != b.number_of_vertices()) return false;
  for(auto v : a.vertices())
    if(a.point(v) != b.point(v)) return false;
  for(auto h : a.halfedges())
    if(a.target(h) != b.target(h) || a.next(h) != b.next(h)) return false;
  return true;
}

} // namespace

TEST_CASE("Time limit: a limit that is not reached does not change a shell, and a limit that is reached leaves none")
{
  const Mesh mesh = wall();
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  REQUIRE(shell.is_certified());
  CHECK(are_equal(shell, CGAL::certified_bspline_shell_3(mesh, parameters::time_limit(long_time))));
  const Shell late = CGAL::certified_bspline_shell_3(mesh, parameters::time_limit(no_time));
  CHECK(late.status() == Status::TIME_LIMIT_EXCEEDED);
  CHECK_FALSE(late);
  CHECK_FALSE(late.is_certified());
  CHECK(CGAL::bspline_shell_3(mesh, parameters::time_limit(no_time)).status() == Status::TIME_LIMIT_EXCEEDED);
  CHECK(CGAL::bspline_shell_3(mesh, parameters::time_limit(long_time).resolution(30)).status()
        == CGAL::bspline_shell_3(mesh, parameters::resolution(30)).status());
  for(double wrong : { 0., -1., std::nan("") }) {
    CHECK(CGAL::certified_bspline_shell_3(mesh, parameters::time_limit(wrong)).status() == Status::INVALID_PARAMETER);
    CHECK(CGAL::bspline_shell_3(mesh, parameters::time_limit(wrong)).status() == Status::INVALID_PARAMETER);
    CHECK(CGAL::certified_shell_of_soup_3(soup_of(mesh), parameters::time_limit(wrong)).status()
          == Status::INVALID_PARAMETER);
  }
}

TEST_CASE("Cancellation: a shell can be canceled at any poll of any step, and is then empty")
{
  const Mesh mesh = wall();
  Impatient_visitor visitor;
  const Shell shell = CGAL::certified_bspline_shell_3<CGAL::Sequential_tag>(mesh,
                                                                            parameters::visitor(std::ref(visitor)));
  REQUIRE(shell.is_certified());
  for(std::size_t polls : visitor.polls_of_step) CHECK(polls > 1);
  sweep(visitor.polls, [&](std::size_t n) {
    Impatient_visitor impatient{ n };
    const Shell canceled = CGAL::certified_bspline_shell_3<CGAL::Sequential_tag>(
      mesh, parameters::visitor(std::ref(impatient)));
    CHECK(canceled.status() == Status::CANCELED);
    CHECK_FALSE(canceled);
    CHECK(impatient.polls == n);
  });
  CHECK(are_equal(shell, CGAL::certified_bspline_shell_3<CGAL::Sequential_tag>(mesh)));
}

TEST_CASE("Cancellation: uniform shells, and shells built by several threads, can be canceled within a step")
{
  const Mesh mesh = sphere(2);
  // Each step begins with a poll of the calling thread. The number of further polls depends on the other threads.
  for(std::size_t n : { 1, 4 }) {
    Impatient_visitor impatient{ n };
    CHECK(CGAL::bspline_shell_3(mesh, parameters::resolution(20).visitor(std::ref(impatient))).status()
          == Status::CANCELED);
    impatient = { n };
    CHECK(CGAL::certified_bspline_shell_3(mesh, parameters::visitor(std::ref(impatient))).status() == Status::CANCELED);
    CHECK(impatient.polls == n);
  }
}

TEST_CASE("Time limit: a limit that is not reached does not change a proxy, and a limit that is reached leaves none")
{
  const BS::Polygon_soup soup = fan();
  const auto of_soup = [&](const auto& np) { return CGAL::certified_shell_of_soup_3(soup, np); };
  const BS::Shell_of_soup_3 any = of_soup(parameters::alpha(0.2)),
                            limited = of_soup(parameters::alpha(0.2).time_limit(long_time));
  REQUIRE(any.is_certified());
  REQUIRE(any.proxy);
  REQUIRE(limited.proxy);
  CHECK(are_equal(any.mesh(), limited.mesh()));
  CHECK(are_equal(any.shell(), limited.shell()));
  const BS::Shell_of_soup_3 late = of_soup(parameters::time_limit(no_time));
  CHECK_FALSE(late);
  CHECK(late.status() == Status::TIME_LIMIT_EXCEEDED);
  CHECK(late.message() == std::string(message(Status::TIME_LIMIT_EXCEEDED)));
  CHECK(CGAL::certified_soup_proxy_3(soup.points, soup.polygons, parameters::time_limit(no_time)).status()
        == Status::TIME_LIMIT_EXCEEDED);
  // A mesh that could have a shell itself does not get a proxy instead.
  CHECK(CGAL::certified_shell_of_soup_3(soup_of(wall()), parameters::time_limit(no_time)).proxy_status
        == Status::NOT_BUILT);
}

TEST_CASE("Cancellation: a proxy can be canceled at any poll, within the wrap, its check or its shell")
{
  const BS::Polygon_soup soup = fan();
  Impatient_visitor visitor;
  const auto of_soup = [&](Impatient_visitor& v) {
    return CGAL::certified_soup_proxy_3<CGAL::Sequential_tag>(soup.points, soup.polygons,
                                                              parameters::alpha(0.2).visitor(std::ref(v)));
  };
  REQUIRE(of_soup(visitor).is_certified());
  std::size_t in_wrap = 0;
  sweep(visitor.polls, [&](std::size_t n) {
    Impatient_visitor impatient{ n };
    const BS::Soup_proxy_3 canceled = of_soup(impatient);
    CHECK(canceled.status() == Status::CANCELED);
    CHECK_FALSE(canceled.is_certified());
    in_wrap += canceled.mesh().number_of_faces() == 0;
  });
  CHECK(in_wrap >= 3); // CGAL 6 calls the visitor less often than CGAL 5
}

TEST_CASE("Time limit: an edit that ends at any poll leaves the mesh unchanged")
{
  const Mesh before = sphere(2);
  const Shell shell = CGAL::certified_bspline_shell_3(before, parameters::relative_thickness(0.05));
  REQUIRE(shell.is_certified());
  const auto edit = [&](Mesh& mesh, bool remeshes, double limit) {
    return remeshes ? BS::remesh_in_shell<CGAL::Sequential_tag>(mesh, 0.4, shell, parameters::time_limit(limit)).status
                    : BS::simplify_in_shell<CGAL::Sequential_tag>(mesh, shell, parameters::time_limit(limit)).status;
  };
  for(bool remeshes : { false, true }) {
    Mesh mesh = before;
    CHECK(edit(mesh, remeshes, no_time) == BS::Edit_status::TIME_LIMIT_EXCEEDED);
    CHECK(are_equal(mesh, before));
    CHECK(edit(mesh, remeshes, 0) == BS::Edit_status::INVALID_PARAMETER);
    CHECK(are_equal(mesh, before));
    // Limits are reached after a number of polls.
    std::size_t polls = 0, most = std::size_t(-1);
    BS::internal::Run run(long_time, [&] { return ++polls < most; });
    {
      const BS::internal::Run::Scope scope(&run);
      CHECK(edit(mesh, remeshes, long_time) == BS::Edit_status::SUCCESS);
    }
    CHECK_FALSE(are_equal(mesh, before));
    Mesh unlimited = before;
    if(remeshes) BS::remesh_in_shell<CGAL::Sequential_tag>(unlimited, 0.4, shell);
    else BS::simplify_in_shell<CGAL::Sequential_tag>(unlimited, shell);
    CHECK(are_equal(mesh, unlimited));
    sweep(polls, [&](std::size_t n) {
      polls = 0;
      most = n;
      Mesh edited = before;
      const BS::internal::Run::Scope scope(&run);
      CHECK(edit(edited, remeshes, long_time) == BS::Edit_status::TIME_LIMIT_EXCEEDED);
      CHECK(are_equal(edited, before));
    });
  }
}

TEST_CASE("Time limit: remeshing polls before each operation")
{
  struct Visitor
  {
    bool start_iteration(unsigned int) { return true; }
    bool go_on() { return ++operations > 0; }
    std::size_t operations = 0;
  } visitor;
  const std::size_t most_operations = 200;
  BS::internal::Run run(long_time, [&] { return visitor.operations < most_operations; });
  const BS::internal::Run::Scope scope(&run);
  const Mesh before = sphere(2);
  Mesh mesh = before;
  const Shell shell = CGAL::certified_bspline_shell_3(before, parameters::relative_thickness(0.05));
  REQUIRE(visitor.operations == 0);
  const auto result = BS::remesh_in_shell<CGAL::Sequential_tag>(mesh, 0.1, shell,
                                                                parameters::visitor(std::ref(visitor)));
  CHECK(result.status == BS::Edit_status::TIME_LIMIT_EXCEEDED);
  CHECK(visitor.operations == most_operations);
  CHECK(are_equal(mesh, before));
}
} // namespace test_time_limits
