// operand_labels.h of the examples, Line_filter.h: after Boolean operations, the labels of facets must fit their
// positions.
#include "../../../examples/Bspline_shell_3/operand_labels.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Editing/Line_filter.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace test_boolean_labels {
namespace {

namespace BS = CGAL::Bspline_shells;

constexpr std::array<Boolean, 3> operations = { Boolean::UNION, Boolean::INTERSECTION, Boolean::DIFFERENCE };

// Returns the number of the side of an axis-parallel box that contains a facet: the axis, plus three for the upper
// side.
int side(const std::array<Point_3, 3>& t, const Point_3& low, const Point_3& high)
{
  for(int axis = 0; axis < 3; ++axis) {
    if(t[0][axis] == low[axis] && t[1][axis] == low[axis] && t[2][axis] == low[axis]) return axis;
    if(t[0][axis] == high[axis] && t[1][axis] == high[axis] && t[2][axis] == high[axis]) return axis + 3;
  }
  return -1;
}

std::vector<Kernel::Segment_3> segments_of(const Mesh& mesh, Curve curve)
{
  std::vector<Kernel::Segment_3> segments;
  for(Mesh::Edge_index e : mesh.edges())
    if(curve[e]) segments.emplace_back(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)));
  return segments;
}

typedef CGAL::Exact_predicates_exact_constructions_kernel Exact;

// By default, CGAL rounds points with a relative error of up to 1e-5.
constexpr double precision = 1e-15;
struct Precise_rounding
{
  Precise_rounding() { Exact::FT::set_relative_precision_of_to_double(precision); }
  ~Precise_rounding() { Exact::FT::set_relative_precision_of_to_double(before); }
  const double before = Exact::FT::get_relative_precision_of_to_double();
};

// Solids whose facets are numbered by labels. The numbers of the second solid follow those of the first.
struct Numbered_solids
{
  explicit Numbered_solids(std::vector<Mesh> m) : meshes(std::move(m))
  {
    for(std::size_t i = 0; i < meshes.size(); ++i) {
      REQUIRE(is_operand(meshes[i]));
      const Labels labels = labels_of(meshes[i]);
      for(Mesh::Face_index f : meshes[i].faces()) {
        labels[f] = int(solid.size());
        solid.push_back(i);
        triangles.push_back(exact(meshes[i], f));
      }
    }
  }
  static Exact::Triangle_3 exact(const Mesh& mesh, Mesh::Face_index f)
  {
    const CGAL::Cartesian_converter<Kernel, Exact> convert;
    const auto t = corners(mesh, f);
    return { convert(t[0]), convert(t[1]), convert(t[2]) };
  }

  // Returns how many corners of a result's facets are outside the triangles whose labels the facets have. Coordinates
  // are less than two, and were rounded `roundings` times. The distance from a triangle is convex, so the errors add
  // up.
  std::size_t misplaced(Mesh& mesh, int roundings) const
  {
    const Labels labels = labels_of(mesh);
    const double move = roundings * 2 * precision;
    std::size_t number = 0;
    for(Mesh::Face_index f : mesh.faces()) {
      REQUIRE(labels[f] >= 0);
      const Exact::Triangle_3 part = exact(mesh, f), whole = triangles[std::size_t(labels[f])];
      for(int i = 0; i < 3; ++i)
        if(CGAL::squared_distance(part.vertex(i), whole) > 3 * move * move) ++number;
    }
    return number;
  }

  std::vector<Mesh> meshes;
  std::vector<std::size_t> solid; // by label
  std::vector<Exact::Triangle_3> triangles;
};

} // namespace

TEST_CASE("Boolean labels: facets of Booleans of two boxes carry the labels of their sides, and areas add up")
{
  const Point_3 low_0(0, 0, 0), high_0(1, 1, 1), low_1(0.5, 0.25, 0.125), high_1(1.5, 1.25, 1.125);
  Mesh first = box(low_0, high_0), second = box(low_1, high_1);
  for(Mesh* mesh : { &first, &second }) {
    const Labels labels = labels_of(*mesh);
    for(Mesh::Face_index f : mesh->faces())
      labels[f] = mesh == &first ? side(corners(first, f), low_0, high_0) : 6 + side(corners(second, f), low_1, high_1);
  }
  // Three sides of each box reach into the other box; `inside` is the area of their parts there.
  const double x = 0.5, y = 0.75, z = 0.875, inside = x * y + y * z + z * x;
  for(Boolean operation : operations) {
    Mesh mesh;
    REQUIRE(compute(operation, first, second, mesh));
    const Labels labels = labels_of(mesh);
    std::array<double, 2> area = {};
    std::size_t wrong = 0;
    for(Mesh::Face_index f : mesh.faces()) {
      const auto t = corners(mesh, f);
      const bool is_second = labels[f] >= 6;
      const int expected = is_second ? 6 + side(t, low_1, high_1) : side(t, low_0, high_0);
      wrong += labels[f] == expected ? 0 : 1;
      area[is_second] += std::sqrt(CGAL::squared_area(t[0], t[1], t[2]));
    }
    CHECK(wrong == 0);
    CHECK(area[0] == Approx(operation == Boolean::INTERSECTION ? inside : 6 - inside));
    CHECK(area[1] == Approx(operation == Boolean::UNION ? 6 - inside : inside));
  }
}

TEST_CASE("Boolean labels: each facet lies in the facet of its label, on the correct side of the other solid")
{
  const Precise_rounding rounding;
  const Kernel::Aff_transformation_3 turn(0.36, -0.48, 0.8, 0.3, 0.8, 0.6, 0, 0.2, -0.48, 0.64, 0.6, 0.1);
  const Mesh cube = box({ 0, 0, 0 }, { 1, 1, 1 }), ball = sphere(2);
  Mesh turned_cube = cube, other_ball = sphere(2, 0.8, { 0.7, 0.3, 0.2 });
  PMP::transform(turn, turned_cube);
  PMP::transform(turn, other_ball);
  for(const auto& pair : { std::pair(cube, turned_cube), std::pair(ball, other_ball), std::pair(cube, ball) }) {
    const Numbered_solids solids({ pair.first, pair.second });
    const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side_of_first(solids.meshes[0]), side_of_second(solids.meshes[1]);
    for(Boolean operation : operations) {
      Mesh mesh;
      REQUIRE(compute(operation, solids.meshes[0], solids.meshes[1], mesh));
      CHECK(solids.misplaced(mesh, 1) == 0);
      const Labels labels = labels_of(mesh);
      std::size_t wrong_side = 0;
      std::array<std::size_t, 2> facets = {};
      for(Mesh::Face_index f : mesh.faces()) {
        const std::size_t solid = solids.solid[std::size_t(labels[f])];
        ++facets[solid];
        const auto t = corners(mesh, f);
        const auto where = (solid == 1 ? side_of_first : side_of_second)(CGAL::centroid(t[0], t[1], t[2]));
        const bool is_within = operation == Boolean::INTERSECTION || (operation == Boolean::DIFFERENCE && solid == 1);
        if(where != (is_within ? CGAL::ON_BOUNDED_SIDE : CGAL::ON_UNBOUNDED_SIDE)) ++wrong_side;
      }
      CHECK(wrong_side == 0);
      CHECK(facets[0] > 0);
      CHECK(facets[1] > 0);
    }
  }
}

TEST_CASE("Boolean labels: labels survive a second Boolean operation")
{
  const Precise_rounding rounding;
  const Numbered_solids solids({ sphere(2, 0.8, { -1, 0.1, 0 }), sphere(2, 0.8), sphere(2, 0.8, { 1, 0.05, 0.1 }) });
  Mesh two, three;
  REQUIRE(compute(Boolean::UNION, solids.meshes[0], solids.meshes[1], two));
  REQUIRE(compute(Boolean::UNION, two, solids.meshes[2], three));
  CHECK(solids.misplaced(three, 2) == 0);
  std::array<std::size_t, 3> facets = {};
  for(Mesh::Face_index f : three.faces()) ++facets[solids.solid[std::size_t(labels_of(three)[f])]];
  for(std::size_t number : facets) CHECK(number > 0);
}

TEST_CASE("Boolean labels: simplification keeps the labels, and the curve that separates them stays near the original")
{
  Mesh first = sphere(3), second = sphere(3, 0.8, { 0.9, 0.3, 0.2 }), mesh;
  set_labels(first, 0);
  set_labels(second, 1);
  for(Boolean operation : operations) {
    mesh.clear();
    REQUIRE(compute(operation, first, second, mesh));
    const std::size_t curve_edges = mark_curve(mesh, labels_of(mesh), curve_of(mesh));
    REQUIRE(curve_edges > 20);
    const auto shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(0.02));
    REQUIRE(shell.is_certified());
    Mesh coarse = mesh;
    const double distance = 0.001 * shell.report().unit;
    const BS::Line_filter filter(coarse, curve_of(coarse), distance);
    const auto result = BS::simplify_in_shell(
      coarse, shell,
      BS::parameters::edge_is_constrained_map(curve_of(coarse)).protect_constraints(false).filter(std::cref(filter)));
    REQUIRE(result);
    coarse.collect_garbage();
    CHECK(result.constrained_edges < curve_edges);
    const Labels labels = labels_of(coarse);
    const Curve curve = curve_of(coarse);
    std::size_t wrong = 0;
    for(Mesh::Edge_index e : coarse.edges()) {
      const int a = labels[coarse.face(coarse.halfedge(e, 0))], b = labels[coarse.face(coarse.halfedge(e, 1))];
      wrong += a < 0 || b < 0 || curve[e] != (a != b) ? 1 : 0;
    }
    CHECK(wrong == 0);
    auto patch = coarse.add_property_map<Mesh::Face_index, std::size_t>("f:patch").first;
    CHECK(PMP::connected_components(coarse, patch, CGAL::parameters::edge_is_constrained_map(curve)) == 2);
    // distances from corners of the original curve to the new curve
    const auto segments = segments_of(coarse, curve);
    double farthest = 0;
    for(const Kernel::Segment_3& s : segments_of(mesh, curve_of(mesh))) {
      double nearest = std::numeric_limits<double>::infinity();
      for(const Kernel::Segment_3& t : segments) nearest = (std::min)(nearest, CGAL::squared_distance(s.source(), t));
      farthest = (std::max)(farthest, std::sqrt(nearest));
    }
    CHECK(farthest <= distance);
    CHECK(farthest > 0);
  }
}
} // namespace test_boolean_labels
