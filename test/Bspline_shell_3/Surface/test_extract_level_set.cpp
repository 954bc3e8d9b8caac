// extract_level_set.h: level sets are closed manifolds on the level, for uniform and hierarchical fields.
#include <CGAL/Bspline_shell_3/Surface/extract_level_set.h>
#include "coefficient_functions.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>

#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/helpers.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace test_extract_level_set {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using CGAL::Bspline_shells::Level_set_status;
using CGAL::Bspline_shells::extract_level_set;

typedef CGAL::Bspline_shells::Hierarchical_bspline_field_3<Kernel> Field;
typedef CGAL::Bspline_shells::Lattice_3 Lattice;

const double pi = 3.14159265358979323846;

// Returns a field on the cells with corners from -size to size, in cells, around the center. `coefficient` is a
// function of the point, relative to the center.
template <typename Coefficient>
Field make_field(int size, double width, const Coefficient& coefficient, const Point_3& center = CGAL::ORIGIN)
{
  const Lattice lattice(center.bbox(), width);
  REQUIRE(lattice.is_exact());
  REQUIRE(lattice.spacing() == width);
  Field field(all_cells(lattice, { -size, -size, -size }, { size - 1, size - 1, size - 1 }));
  set_coefficients(field, [&](const Point_3& p, double) { return coefficient(p - center); });
  return field;
}

// Returns |x|^2, which cubic splines reproduce.
Field squared_norm(int size, double width, const Point_3& center = CGAL::ORIGIN)
{
  return make_field(
    size, width, [width](const Vector_3& g) { return g.squared_length() - width * width; }, center);
}

// Returns a field on the same cells, some of them split, with the given number of levels.
template <typename Coefficient>
Field make_hierarchical_field(unsigned seed, int size, double width, int levels, const Coefficient& coefficient)
{
  CGAL::Random random(seed);
  const Lattice lattice(Point_3(0, 0, 0).bbox(), width);
  REQUIRE(lattice.spacing() == width);
  Field field(
    random_hierarchy(random, all_cells(lattice, { -size, -size, -size }, { size - 1, size - 1, size - 1 }), levels));
  REQUIRE(field.number_of_levels() == levels);
  set_coefficients(field, [&](const Point_3& p, double h) { return coefficient(p - CGAL::ORIGIN, h); });
  return field;
}

Field hierarchical_squared_norm(unsigned seed, int size, double width, int levels)
{
  return make_hierarchical_field(seed, size, width, levels,
                                 [](const Vector_3& g, double h) { return g.squared_length() - h * h; });
}

// A field whose polynomials have errors up to a given bound, different in every cell.
template <typename Field>
class Rough_field
{
public:
  typedef typename Field::Cell Cell;
  typedef typename Field::Cell_index Cell_index;
  static constexpr Cell_index npos = Field::npos;

  Rough_field(const Field& field, double error) : m_field(field), m_error(error)
  {
    std::mt19937 random(0);
    std::uniform_real_distribution<double> any(-error, error);
    for(Cell_index c = 0; c < field.number_of_cells(); ++c)
      for(int n = 0; n < 64; ++n) m_coefficients.push_back(field.cell(c).coefficients()[n] + any(random));
  }
  std::size_t number_of_cells() const { return m_field.number_of_cells(); }
  const auto& cells() const { return m_field.cells(); }
  Cell cell(Cell_index c) const
  {
    const Cell exact = m_field.cell(c);
    return Cell(exact.corner(), exact.width(), &m_coefficients[64 * c], m_error + exact.error_radius());
  }

private:
  const Field& m_field;
  double m_error;
  std::vector<double> m_coefficients;
};

// Returns a random coefficient, or a large one at the end of the cells, so that level sets do not leave them. Multiples
// of 216 make all values at corners exact, and many of them equal.
constexpr double large_value = 216 * 4;
double random_coefficient(std::mt19937& random, const Vector_3& g)
{
  std::uniform_int_distribution<int> any(-3, 3);
  return (std::max)({ std::abs(g.x()), std::abs(g.y()), std::abs(g.z()) }) > 3 ? large_value : 216. * any(random);
}

double torus_distance(const Vector_3& g)
{
  return std::hypot(std::hypot(g.x(), g.y()) - 1, g.z()) - 0.4;
}

template <typename TriangleMesh>
int euler_characteristic(const TriangleMesh& mesh)
{
  return int(vertices(mesh).size()) - int(halfedges(mesh).size() / 2) + int(faces(mesh).size());
}

template <typename TriangleMesh>
void check_closed_manifold(const TriangleMesh& mesh)
{
  CHECK(CGAL::is_valid_polygon_mesh(mesh));
  CHECK(CGAL::is_triangle_mesh(mesh));
  CHECK(CGAL::is_closed(mesh));
  std::vector<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor> non_manifold;
  PMP::non_manifold_vertices(mesh, std::back_inserter(non_manifold));
  CHECK(non_manifold.empty());
  for(auto f : faces(mesh))
    if(PMP::is_degenerate_triangle_face(f, mesh)) FAIL("a facet of zero area");
}

// Returns the level set, after a check that it is a closed manifold.
template <typename Field, typename Level>
Mesh closed_level_set(const Field& field, const Level& level, int ratio = 2)
{
  Mesh mesh;
  REQUIRE(extract_level_set(field, level, mesh, CGAL::parameters::subdivision_ratio(ratio))
          == Level_set_status::SUCCESS);
  check_closed_manifold(mesh);
  return mesh;
}

template <typename TriangleMesh, typename Field>
double largest_error(const TriangleMesh& mesh, const Field& field, double level)
{
  double largest = 0;
  for(auto v : vertices(mesh))
    largest = (std::max)(largest, std::abs(*field.value(get(CGAL::vertex_point, mesh, v)) - level));
  return largest;
}

// Checks level sets through corners and another point of random fields, unless they leave the cells. Returns their
// number.
template <typename Field>
std::size_t check_random_level_sets(const Field& field)
{
  std::size_t passed = 0;
  for(int ratio : { 1, 2 })
    for(const Point_3& p : { Point_3(0, 0, 0), Point_3(1, -1, 2), Point_3(-2, 1, 1), Point_3(0.5, 0, 1) }) {
      const double level = *field.value(p);
      CAPTURE(ratio, p, level);
      Mesh mesh;
      const Level_set_status status = extract_level_set(field, level, mesh, CGAL::parameters::subdivision_ratio(ratio));
      REQUIRE((status == Level_set_status::SUCCESS || level >= large_value));
      if(status != Level_set_status::SUCCESS) continue;
      ++passed;
      check_closed_manifold(mesh);
      CHECK(euler_characteristic(mesh) % 2 == 0);
      CHECK_FALSE(PMP::does_self_intersect(mesh));
      CHECK(largest_error(mesh, field, level) < 1e-8);
    }
  return passed;
}

// Checks that the unit sphere has no cracks where adjacent cells are consistent only within an error radius.
template <typename Field>
void check_rough_sphere(const Field& field, double error, bool is_embedded)
{
  for(int ratio : { 1, 2, 3 }) {
    CAPTURE(error, ratio);
    const Mesh mesh = closed_level_set(Rough_field(field, error), 1, ratio);
    if(error < 1e-3) CHECK(euler_characteristic(mesh) == 2);
    CHECK(largest_error(mesh, field, 1) < 1e-12 + 3 * error);
    if(is_embedded) CHECK_FALSE(PMP::does_self_intersect(mesh));
  }
}

// Returns the least cosine of the angle between a facet's normal and the gradient at its center.
template <typename TriangleMesh, typename Field>
double least_cosine(const TriangleMesh& mesh, const Field& field)
{
  double least = 1;
  for(auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    const Point_3 c = CGAL::centroid(get(CGAL::vertex_point, mesh, source(h, mesh)),
                                     get(CGAL::vertex_point, mesh, target(h, mesh)),
                                     get(CGAL::vertex_point, mesh, target(next(h, mesh), mesh)));
    const Vector_3 g = *field.gradient(c);
    least = (std::min)(least, PMP::compute_face_normal(f, mesh) * g / std::sqrt(g.squared_length()));
  }
  return least;
}

} // namespace

TEST_CASE("Level set: the level set of |x|^2 is a sphere of the right radius whose facets face outwards")
{
  for(const Point_3& center : { Point_3(0, 0, 0), Point_3(1000, -500, 0.25) })
    for(int ratio : { 1, 2, 3 }) {
      CAPTURE(center, ratio);
      const Field field = squared_norm(6, 0.25, center);
      const double radius = 1.1;
      REQUIRE(*field.value(center + Vector_3(0.3, 0.4, 1.2)) == Approx(1.69));
      const Mesh mesh = closed_level_set(field, radius * radius, ratio);
      CHECK(euler_characteristic(mesh) == 2);
      CHECK(PMP::is_outward_oriented(mesh));
      CHECK(least_cosine(mesh, field) > 0.9);
      const double rounding = 1e-16 * (1 + std::abs(center.x()));
      CHECK(largest_error(mesh, field, radius * radius) < 1e-11 + 1e4 * rounding);
      for(auto v : mesh.vertices())
        if(std::abs(distance(mesh.point(v), center) - radius) > 1e-11 + 1e4 * rounding) FAIL("a vertex off the sphere");
    }
}

TEST_CASE("Level set: the error on a sphere decreases quadratically with the size of the subcells")
{
  const Field field = squared_norm(6, 0.25);
  double last = 0;
  for(int ratio : { 1, 2, 4 }) {
    const double error = 4. / 3 * pi * std::pow(1.2, 1.5) - PMP::volume(closed_level_set(field, 1.2, ratio));
    CHECK(error > 0);
    if(ratio > 1) CHECK(error < 0.3 * last);
    last = error;
  }
}

TEST_CASE("Level set: the level set of the distance to a circle is a torus")
{
  const Field field = make_field(13, 0.125, torus_distance);
  for(double level : { -0.1, 0., 0.1 }) {
    CAPTURE(level);
    const Mesh mesh = closed_level_set(field, level);
    CHECK(euler_characteristic(mesh) == 0);
    CHECK(PMP::is_outward_oriented(mesh));
    CHECK(least_cosine(mesh, field) > 0.5);
    CHECK(largest_error(mesh, field, level) < 1e-12);
    CHECK_FALSE(PMP::does_self_intersect(mesh));
  }
}

TEST_CASE("Level set: facets face along the gradient, even inwards")
{
  const Field field = make_field(5, 0.25, [](const Vector_3& g) { return 1 - g.squared_length(); });
  const Mesh mesh = closed_level_set(field, 0.3);
  CHECK_FALSE(PMP::is_outward_oriented(mesh));
  CHECK(least_cosine(mesh, field) > 0.5);
}

TEST_CASE("Level set: a set that leaves the cells is rejected, and the mesh is unchanged")
{
  const Field field = make_field(3, 0.5, [](const Vector_3& g) { return g.x() + 2 * g.y(); });
  Mesh mesh;
  mesh.add_vertex(Point_3(1, 2, 3));
  for(double level : { 0., 0.1, 3. }) {
    CHECK(extract_level_set(field, level, mesh) == Level_set_status::LEVEL_SET_LEAVES_CELLS);
    CHECK(mesh.number_of_vertices() == 1);
    CHECK(mesh.number_of_faces() == 0);
  }
  // A cap of the sphere is outside the cells.
  CHECK(extract_level_set(squared_norm(3, 0.5), 2.3, mesh) == Level_set_status::LEVEL_SET_LEAVES_CELLS);
}

TEST_CASE("Level set: a level that the field does not attain yields an empty set")
{
  const Field field = squared_norm(3, 0.5);
  Mesh mesh;
  for(double level : { -1., 100., std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                       std::numeric_limits<double>::quiet_NaN() })
    CHECK(extract_level_set(field, level, mesh) == Level_set_status::LEVEL_SET_EMPTY);
  CHECK(extract_level_set(Field(), 0, mesh) == Level_set_status::LEVEL_SET_EMPTY);
  CHECK(mesh.is_empty());
}

TEST_CASE("Level set: levels attained at corners of cells cause no defects")
{
  // 3 |x|^2 on cells of width one: all values at corners are integers, and exact
  const Field field = make_field(6, 1, [](const Vector_3& g) { return 3 * g.squared_length() - 3; });
  REQUIRE(field.cell(field.locate(Point_3(2, 2, 1))).value(Point_3(2, 2, 1)) == 27);
  for(int ratio : { 1, 2, 3 })
    for(int squared_radius : { 1, 2, 3, 4, 5, 6, 8, 9, 14, 17, 18, 21, 25 }) {
      CAPTURE(ratio, squared_radius);
      const Mesh mesh = closed_level_set(field, 3 * squared_radius, ratio);
      CHECK(euler_characteristic(mesh) == 2);
      CHECK(PMP::is_outward_oriented(mesh));
      CHECK(largest_error(mesh, field, 3 * squared_radius) < 1e-9);
      CHECK_FALSE(PMP::does_self_intersect(mesh));
    }
  // At the minimum, which is at a corner, no value is below the level. Slightly above it, the set encloses a single
  // corner.
  Mesh mesh;
  CHECK(extract_level_set(field, 0, mesh) == Level_set_status::LEVEL_SET_EMPTY);
  CHECK(extract_level_set(field, 1e-9, mesh) == Level_set_status::SUCCESS);
  check_closed_manifold(mesh);
}

TEST_CASE("Level set: the level set of a random field is a closed manifold", "[slow]")
{
  for(unsigned seed = 0; seed < 8; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    CHECK(check_random_level_sets(make_field(5, 1, [&](const Vector_3& g) { return random_coefficient(random, g); }))
          == 8);
  }
}

TEST_CASE("Level set: cells that disagree on their common faces cause no cracks")
{
  for(double error : { 1e-15, 1e-6, 1e-2, 0.2 }) check_rough_sphere(squared_norm(6, 0.25), error, true);
}

TEST_CASE("Level set: across cells of different sizes, the set is closed and on the level", "[slow]")
{
  for(unsigned seed = 0; seed < 6; ++seed) {
    const int levels = 2 + int(seed) % 3;
    // Levels change at the sphere, so it crosses cells of two sizes.
    const Field field = hierarchical_squared_norm(seed, levels < 4 ? 10 : 14, 0.25, levels);
    REQUIRE(*field.value(Point_3(0.3, 0.4, 1.2)) == Approx(1.69));
    for(double level : { 1.21, 1., 1.5625, 2.1 }) // some pass through corners of cells
      for(int ratio : { 1, 2, 3 }) {
        CAPTURE(seed, level, ratio);
        const Mesh mesh = closed_level_set(field, level, ratio);
        CHECK(euler_characteristic(mesh) == 2);
        CHECK(PMP::is_outward_oriented(mesh));
        CHECK(largest_error(mesh, field, level) < 1e-11);
        CHECK_FALSE(PMP::does_self_intersect(mesh));
      }
  }
}

TEST_CASE("Level set: the level set of a random field on cells of different sizes is a closed manifold", "[slow]")
{
  std::size_t passed = 0;
  for(unsigned seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    passed += check_random_level_sets(make_hierarchical_field(
      seed, 6, 1, 2 + int(seed) % 2, [&](const Vector_3& g, double) { return random_coefficient(random, g); }));
  }
  CHECK(passed > 60);
}

TEST_CASE("Level set: cells of different sizes that disagree on their common faces cause no cracks")
{
  for(double error : { 1e-15, 1e-6, 1e-2, 0.1 })
    check_rough_sphere(hierarchical_squared_norm(3, 10, 0.25, 3), error, false);
}

TEST_CASE("Level set: on cells of different sizes, selected cells must contain the whole set")
{
  const Field field = hierarchical_squared_norm(5, 10, 0.25, 4);
  Mesh mesh;
  const Field::Cell_index last = field.locate(Point_3(0.7, 0.7, 0.1));
  std::vector<char> passed(field.number_of_cells(), 0);
  std::size_t rejected = 0, all = 0;
  for(Field::Cell_index c = 0; c < field.number_of_cells(); ++c) {
    const auto range = field.cell(c).coefficient_range();
    if(range.first > 0.98 || range.second < 0.98) continue;
    const CGAL::Bbox_3 box = field.cell(c).bbox();
    double least = 0, most = 0;
    for(int a = 0; a < 3; ++a) {
      least += std::pow((std::max)({ 0., (box.min)(a), -(box.max)(a) }), 2);
      most += std::pow((std::max)(std::abs((box.min)(a)), std::abs((box.max)(a))), 2);
    }
    if(least > 0.9 || most < 1.1) continue; // the sphere does not cross the middle of the cell
    ++all;
    if(all % 40 != 0 && c != last) continue;
    rejected += extract_level_set(field, 0.98, mesh, CGAL::parameters::filter([c](auto other) { return other != c; }))
                == Level_set_status::LEVEL_SET_LEAVES_CELLS;
    ++passed[c];
  }
  CHECK(rejected == std::size_t(std::count(passed.begin(), passed.end(), 1)));
  CHECK(rejected > 5);
  CHECK(mesh.is_empty());
}

TEST_CASE("Level set: the set of a varying threshold is where the field equals the threshold")
{
  // |x|^2 = 1 + x / 2 is a sphere around (1/4, 0, 0)
  const Field field = hierarchical_squared_norm(2, 10, 0.25, 3);
  const CGAL::Bspline_shells::Spline_threshold<Field> threshold(
    make_hierarchical_field(2, 10, 0.25, 3, [](const Vector_3& g, double) { return 1 + g.x() / 2; }));
  const Mesh mesh = closed_level_set(field, threshold);
  CHECK(euler_characteristic(mesh) == 2);
  CHECK(PMP::is_outward_oriented(mesh));
  double largest = 0;
  for(auto v : mesh.vertices())
    largest = (std::max)(largest, std::abs(distance(mesh.point(v), Point_3(0.25, 0, 0)) - std::sqrt(1.0625)));
  CHECK(largest < 1e-11);
  CHECK(closed_level_set(field, 1).number_of_faces()
        == closed_level_set(field, CGAL::Bspline_shells::Constant_threshold(1)).number_of_faces());
}

TEST_CASE("Level set: selected cells pick one of two spheres, and must contain it completely")
{
  const Field field = make_field(10, 0.25, [](const Vector_3& g) {
    const double x = std::abs(g.x()) - 1.25;
    return std::sqrt(x * x + g.y() * g.y() + g.z() * g.z()) - 0.7;
  });
  const Mesh both = closed_level_set(field, 0);
  CHECK(euler_characteristic(both) == 4);

  namespace P = CGAL::Bspline_shells::parameters;
  const auto is_left = [&](Field::Cell_index c) { return field.cell(c).corner()[0] < 0; };
  const auto is_low = [&](Field::Cell_index c) { return field.cell(c).corner()[2] < 0; };
  Mesh left;
  REQUIRE(extract_level_set(field, 0, left, P::filter(is_left)) == Level_set_status::SUCCESS);
  check_closed_manifold(left);
  CHECK(euler_characteristic(left) == 2);
  CHECK(2 * left.number_of_faces() == both.number_of_faces());
  for(auto v : left.vertices()) CHECK(left.point(v).x() < 0);

  // all cells of the left surface, and some of the other one
  const auto most = [&](Field::Cell_index c) { return is_left(c) || is_low(c); };
  Mesh closed;
  CHECK(extract_level_set(field, 0, closed, P::filter(most)) == Level_set_status::LEVEL_SET_LEAVES_CELLS);
  REQUIRE(extract_level_set(field, 0, closed, P::filter(most).skip_open_components(true)) == Level_set_status::SUCCESS);
  check_closed_manifold(closed);
  CHECK(closed.number_of_vertices() == left.number_of_vertices());
  CHECK(closed.number_of_faces() == left.number_of_faces());
  for(auto v : closed.vertices()) CHECK(closed.point(v).x() < 0);

  Mesh low; // all components are open
  for(const auto& np : { P::filter(is_low).skip_open_components(true), P::filter(is_low).skip_open_components(false) })
    CHECK(extract_level_set(field, 0, low, np) == Level_set_status::LEVEL_SET_LEAVES_CELLS);
  CHECK(low.is_empty());
  CHECK(extract_level_set(field, 0, low, P::filter([](Field::Cell_index) { return false; }))
        == Level_set_status::LEVEL_SET_EMPTY);

  // A second level set is added to the first one.
  REQUIRE(extract_level_set(field, 0.1, left) == Level_set_status::SUCCESS);
  check_closed_manifold(left);
  CHECK(euler_characteristic(left) == 6);
}

TEST_CASE("Level set: the output may be a Polyhedron_3, or have another point map")
{
  const Field field = make_field(13, 0.125, torus_distance);
  CGAL::Polyhedron_3<Kernel> polyhedron;
  REQUIRE(extract_level_set(field, 0.05, polyhedron) == Level_set_status::SUCCESS);
  check_closed_manifold(polyhedron);
  CHECK(euler_characteristic(polyhedron) == 0);

  Mesh mesh, other;
  auto points = mesh.add_property_map<Mesh::Vertex_index, Point_3>("v:other_point", CGAL::ORIGIN).first;
  REQUIRE(extract_level_set(field, 0.05, mesh, CGAL::parameters::vertex_point_map(points))
          == Level_set_status::SUCCESS);
  REQUIRE(extract_level_set(field, 0.05, other) == Level_set_status::SUCCESS);
  REQUIRE(mesh.number_of_vertices() == other.number_of_vertices());
  CHECK(polyhedron.size_of_vertices() == other.number_of_vertices());
  bool same = true;
  for(auto v : mesh.vertices()) same = same && get(points, v) == other.point(v);
  CHECK(same);
}

#ifdef CGAL_LINKED_WITH_TBB
TEST_CASE("Level set: several threads yield the same mesh, vertex by vertex")
{
  const Field field = make_field(13, 0.125, torus_distance);
  Mesh one, several;
  REQUIRE(extract_level_set<CGAL::Sequential_tag>(field, 0.05, one) == Level_set_status::SUCCESS);
  REQUIRE(extract_level_set<CGAL::Parallel_tag>(field, 0.05, several) == Level_set_status::SUCCESS);
  REQUIRE(one.number_of_vertices() == several.number_of_vertices());
  REQUIRE(one.number_of_faces() == several.number_of_faces());
  bool same = true;
  for(auto v : one.vertices()) same = same && one.point(v) == several.point(v);
  for(auto h : one.halfedges()) same = same && one.target(h) == several.target(h);
  CHECK(same);
}
#endif

TEST_CASE("Level set: every status has a message")
{
  for(Level_set_status s :
      { Level_set_status::SUCCESS, Level_set_status::LEVEL_SET_EMPTY, Level_set_status::LEVEL_SET_LEAVES_CELLS })
    CHECK_FALSE(std::string(CGAL::Bspline_shells::message(s)).empty());
}
} // namespace test_extract_level_set
