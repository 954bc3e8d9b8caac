// certified_bspline_shell_3() where meshes are thin, gaps narrow, and fans folded: thresholds give way, and refinement
// ends.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_tuning.h>
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace test_thin_parts {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;
typedef CGAL::Certified_bspline_shell_3 Shell;
typedef Shell::Field Field;
typedef Shell::Threshold Threshold;
typedef BS::Shell_certificate_3<Field, Threshold> Certificate;
typedef Field::Cell_index Index;
using BS::Claim;
using BS::Verdict;

// Returns the width of the shell at a point of the mesh.
double width_at(const Shell& shell, const Point_3& p)
{
  return shell.outer_threshold().value(p) - shell.inner_threshold().value(p);
}

bool is_outside(const Shell& shell, const Point_3& p)
{
  return shell.bounded_side(p) == CGAL::ON_UNBOUNDED_SIDE;
}

void check_certified(const Mesh& mesh, const Shell& shell)
{
  REQUIRE(shell);
  CHECK(shell.is_certified());
  Certificate certificate(shell);
  CHECK(certificate.verify<CGAL::Sequential_tag>(mesh));
}

// Returns a sphere with one vertex moved over an edge of its link, just so far that the least cone margin is `margin`.
Mesh folded(double margin, Mesh::Vertex_index& vertex)
{
  const Mesh ball = sphere(2);
  vertex = *ball.vertices().begin();
  const auto h = ball.halfedge(vertex);
  const Point_3 p = ball.point(vertex);
  const Point_3 opposite = CGAL::midpoint(ball.point(ball.source(h)), ball.point(ball.target(ball.next(h))));
  const auto displaced = [&](double s) {
    Mesh mesh = ball;
    mesh.point(vertex) = p + s * (opposite - p) + 0.02 * (p - CGAL::ORIGIN);
    return mesh;
  };
  const auto least_margin = [](const Mesh& mesh) {
    double least = 1;
    for(auto v : mesh.vertices()) least = (std::min)(least, BS::vertex_cone_margin(mesh, v));
    return least;
  };
  double low = 0, high = 4;
  REQUIRE(least_margin(displaced(low)) > margin);
  REQUIRE(least_margin(displaced(high)) < margin);
  for(int n = 0; n < 60; ++n) {
    const double middle = (low + high) / 2;
    (least_margin(displaced(middle)) > margin ? low : high) = middle;
  }
  REQUIRE(least_margin(displaced(low)) == Approx(margin).epsilon(1e-3));
  return displaced(low);
}

} // namespace

TEST_CASE("Thin parts: at a neck, only the inner threshold is narrowed, and excludes the axis")
{
  const double thickness = 0.1;
  for(double radius : { 0.03, 0.012 }) {
    const Mesh mesh = dumbbell(radius);
    const Shell shell = CGAL::certified_bspline_shell_3(mesh, parameters::thickness(thickness));
    check_certified(mesh, shell);
    for(auto v : mesh.vertices()) {
      const Point_3& p = mesh.point(v);
      const double width = width_at(shell, p);
      CHECK(width > 0);
      CHECK(width <= thickness * (1 + 1e-9));
      // Only the inner threshold gives way.
      if(std::abs(p.x()) < 0.4) {
        CHECK(-shell.inner_threshold().value(p) < radius);
        CHECK(shell.outer_threshold().value(p) > radius);
      }
      if(std::abs(p.x()) > 2) CHECK(width == Approx(thickness).epsilon(1e-6));
    }
    // The axis of the neck is beyond the inner threshold.
    for(double x : { -0.3, 0., 0.3 }) CHECK(is_outside(shell, Point_3(x, 0, 0)));
    CHECK(shell.thickness() == Approx(thickness).epsilon(1e-6));
    CHECK(shell.report().narrowed_area > 0);
    CHECK(shell.report().narrowed_area < 0.3);
  }
}

TEST_CASE("Thin parts: the middle of a gap between two plates is not in the shell, however narrow the gap")
{
  const double thickness = 0.06;
  double last = thickness;
  for(double gap : { thickness, thickness / 2 }) {
    const Mesh mesh = joined(box(Point_3(0, 0, 0), Point_3(1, 1, 0.3)),
                             box(Point_3(0.4, 0.4, 0.3 + gap), Point_3(0.6, 0.6, 0.5 + gap)));
    const Shell shell = CGAL::certified_bspline_shell_3(mesh, parameters::thickness(thickness).resolution(15));
    check_certified(mesh, shell);
    for(double x : { 0.45, 0.5, 0.55 }) {
      const Point_3 middle(x, 0.5, 0.3 + gap / 2);
      CHECK(is_outside(shell, middle));
      CHECK(shell.field().value(middle).value() > shell.outer_threshold().value(middle));
      CHECK_FALSE(is_outside(shell, Point_3(x, 0.5, 0.3)));
      // The narrower the gap, the narrower the shell.
      const double outer = shell.outer_threshold().value(Point_3(x, 0.5, 0.3));
      CHECK(outer < gap / 2);
    }
    // Far away, the width is as requested.
    CHECK(width_at(shell, Point_3(0, 0, 0)) == Approx(thickness).epsilon(1e-6));
    const double narrow = width_at(shell, Point_3(0.5, 0.5, 0.3));
    CHECK(narrow < last);
    last = narrow;
  }
}

TEST_CASE("Thin parts: a plate is certified on cells wider than its thickness, even at its rim", "[slow]")
{
  const double thickness = 0.01;
  const Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, thickness));
  const Shell shell = CGAL::certified_bspline_shell_3(mesh,
                                                      parameters::resolution(15.).relative_thickness(2 * thickness));
  check_certified(mesh, shell);
  const auto& cells = shell.field().cells();
  CHECK(cells.lattice().spacing() / double(1 << (cells.number_of_levels() - 1)) > 1.5 * thickness);
  // The field is fitted again on the same cells, so that cells in the middle need not be split.
  const std::vector<BS::Refinement_round>& rounds = shell.report().rounds;
  REQUIRE(rounds.size() > 1);
  CHECK(rounds[1].cells == rounds[0].cells);
  CHECK(rounds[1].undecided_cells < rounds[0].undecided_cells / 2);
  CHECK(cells.level(cells.locate(Point_3(0.5, 0.5, thickness / 2))) == 0);
  CHECK(width_at(shell, Point_3(0.5, 0.5, 0)) < 2 * thickness);
  CHECK(is_outside(shell, Point_3(0.5, 0.5, thickness / 2)));
}

TEST_CASE("Thin parts: a threshold steeper than the field is rejected, and the place is reported", "[slow]")
{
  const Mesh mesh = sphere(2);
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, parameters::relative_thickness(0.05).resolution(60));
  check_certified(mesh, shell);
  const Field& field = shell.field();
  // Find the basis function that is best placed for a bump that hangs over the outer boundary: its center is one and a
  // half of its cells beyond.
  const double level = shell.outer_threshold().value(Point_3(0, 0.6, 0.8));
  Index bump = Field::npos;
  double width = 0, nearest = std::numeric_limits<double>::infinity();
  Point_3 center;
  for(Index n = 0; n < field.number_of_coefficients(); ++n) {
    const CGAL::Bbox_3 b = field.support(n);
    const Point_3 c((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2);
    if(!field.value(c)) continue;
    const double w = b.x_span() / 4, distance = std::abs((field.value(c).value() - level) / w - 1.5);
    if(distance < nearest) {
      nearest = distance;
      bump = n;
      width = w;
      center = c;
    }
  }
  REQUIRE(nearest < 0.1);
  Vector_3 r = center - CGAL::ORIGIN;
  r = r / std::sqrt(r.squared_length());
  Vector_3 s = CGAL::cross_product(r, std::abs(r.x()) < 0.5 ? Vector_3(1, 0, 0) : Vector_3(0, 1, 0));
  s = s / std::sqrt(s.squared_length());
  const Vector_3 t = CGAL::cross_product(r, s);
  const auto certify = [&](double height) {
    Field outer = shell.outer_threshold().field();
    Eigen::VectorXd x = outer.coefficients();
    x[bump] += height * width;
    outer.set_coefficients(x);
    Certificate certificate(field, shell.inner_threshold(), Threshold(outer));
    certificate.verify<CGAL::Sequential_tag>(mesh);
    // Compare the steepest slope of the threshold with that of the field, where they meet: the field must be steeper.
    double least = 1;
    for(int i = -40; i <= 40; ++i)
      for(int j = -40; j <= 40; ++j) {
        double last = -1;
        for(int k = -40; k <= 40; ++k) {
          const Point_3 p = center + width * (k / 20. * r + i / 20. * s + j / 20. * t);
          if(!field.value(p)) continue;
          const double difference = field.value(p).value() - outer.value(p).value();
          if(k > -40 && (difference > 0) != (last > 0)) {
            const Vector_3 g = field.gradient(p).value();
            least = (std::min)(least, g * (g - outer.gradient(p).value()));
          }
          last = difference;
        }
      }
    CHECK((least > 0) == (height < 1));
    return certificate;
  };
  CHECK(certify(0.5).is_certified());
  const Certificate steep = certify(14);
  CHECK(steep.verdict(Claim::CONTAINMENT) == Verdict::PROVED);
  CHECK(steep.verdict(Claim::TRANSVERSALITY) == Verdict::PROVED);
  CHECK(steep.verdict(Claim::GRADIENT) != Verdict::PROVED);
  CHECK(steep.least_gradient() == 0);
  int places = 0;
  for(const BS::Certificate_witness& w : steep.witnesses()) {
    if(w.claim != Claim::GRADIENT) continue;
    ++places;
    for(int a = 0; a < 3; ++a) CHECK(std::abs(w.point[std::size_t(a)] - center[a]) <= 2 * width);
  }
  CHECK(places > 0);
}

TEST_CASE("Thin parts: whole cells cover both sides of a wall in its cover, because the mesh is on both sides")
{
  const Mesh plate = box(Point_3(0, 0, 0), Point_3(1, 1, 0.03));
  const Shell shell = CGAL::certified_bspline_shell_3(plate);
  check_certified(plate, shell);
  const auto is_whole_cell_within_wall = [](const BS::Cover_box& box) {
    return box.kind == BS::Box_kind::CRITICAL_BELOW && box.component == 0 && box.depth == 0;
  };
  const auto& boxes = *shell.proved_cover();
  CHECK(std::count_if(boxes.begin(), boxes.end(), is_whole_cell_within_wall) > 100);
}

TEST_CASE("Thin parts: grooves and fins of 10 degrees, narrower than a root cell, are certified with few cells")
{
  for(double depth : { 0.05, 0.1, -0.05, -0.1 }) {
    const Mesh mesh = grooved_block(10, depth);
    const Shell shell = CGAL::certified_bspline_shell_3(mesh);
    check_certified(mesh, shell);
    CHECK(shell.report().cells < 10000);
  }
}

TEST_CASE("Thin parts: a sharp rim is certified, although more cells along it are thick in each round")
{
  const double pi = std::acos(-1.), angle = 13.4 * pi / 180;
  const Mesh mesh = joined(bipyramid(24, 1, std::tan(angle / 2)), sphere(0, 0.1, Point_3(19, 0, 0)));
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, parameters::relative_thickness(0.0008));
  check_certified(mesh, shell);
  const auto& rounds = shell.report().rounds;
  const std::size_t stalled = std::size_t(BS::Refinement_tuning().max_rounds_at_folds);
  REQUIRE(rounds.size() > stalled);
  for(std::size_t n = 1; n <= stalled; ++n) CHECK(rounds[n].thick_cells > rounds[n - 1].thick_cells);
}

TEST_CASE("Thin parts: refinement at a folded fan ends, and reports the place if it is not certified", "[slow]")
{
  for(double margin : { 0.1, 0.01 }) {
    Mesh::Vertex_index vertex;
    const Mesh mesh = folded(margin, vertex);
    const Shell shell = CGAL::certified_bspline_shell_3(
      mesh, parameters::relative_thickness(0.06).resolution(15).truncate(false));
    REQUIRE(shell);
    CHECK(shell.report().rounds.size() < BS::Refinement_parameters().max_rounds);
    CHECK(shell.report().certificate.least_cone_margin == Approx(margin).epsilon(1e-2));
    CHECK(shell.report().certificate.singular_vertices.empty());
    if(shell.is_certified()) {
      check_certified(mesh, shell);
      continue;
    }
    CHECK(shell.report().refinement == BS::Refinement_status::NO_PROGRESS);
    bool named = false;
    for(const BS::Certificate_witness& w : shell.report().certificate.witnesses)
      if((w.claim == Claim::TRANSVERSALITY || w.claim == Claim::GRADIENT)
         && CGAL::squared_distance(Point_3(w.point[0], w.point[1], w.point[2]), mesh.point(vertex)) < 0.3 * 0.3)
        named = true;
    CHECK(named);
  }
}

TEST_CASE(
  "Thin parts: with enforced slopes, narrowed thresholds and partial fits, the number of threads does not matter")
{
  const Mesh mesh = demo_mesh("homer.off");
  const Shell one = CGAL::certified_bspline_shell_3<CGAL::Sequential_tag>(mesh),
              two = CGAL::certified_bspline_shell_3<CGAL::Parallel_if_available_tag>(mesh);
  REQUIRE(one);
  REQUIRE(two);
  CHECK(std::any_of(one.report().rounds.begin(), one.report().rounds.end(),
                    [](const auto& round) { return round.sloping_cells > 0; }));
  CHECK(std::any_of(one.report().rounds.begin(), one.report().rounds.end(),
                    [](const auto& round) { return round.partial; }));
  CHECK(one.report().narrowed_area > 0);
  CHECK(BS::shell_checksum(one) == BS::shell_checksum(two));
  const BS::Certificate_report &a = one.report().certificate, &b = two.report().certificate;
  CHECK(a.verdicts == b.verdicts);
  CHECK(a.least_gradient == b.least_gradient);
  CHECK(a.displacement_bound == b.displacement_bound);
  CHECK(a.least_angle == b.least_angle);
  CHECK(a.witnesses.size() == b.witnesses.size());
  REQUIRE(one.report().rounds.size() == two.report().rounds.size());
  for(std::size_t n = 0; n < one.report().rounds.size(); ++n) {
    const BS::Refinement_round &r = one.report().rounds[n], &s = two.report().rounds[n];
    CHECK(r.cells == s.cells);
    CHECK(r.partial == s.partial);
    CHECK(r.thickness == s.thickness);
    CHECK(r.sloping_cells == s.sloping_cells);
    CHECK(r.sloping_cells_left == s.sloping_cells_left);
    CHECK(r.undecided_cells == s.undecided_cells);
    CHECK(r.marked_cells == s.marked_cells);
  }
}
} // namespace test_thin_parts
