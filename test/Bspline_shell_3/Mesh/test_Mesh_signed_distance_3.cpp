// The signed distance from a mesh is compared with a search through all facets in exact arithmetic, with winding
// numbers, and with closed forms. Sides by the closest point, and samples on cells, are compared with single exact
// queries.
#include <CGAL/Bspline_shell_3/Mesh/Mesh_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Fit/sample_signed_distance.h>
#include "exact_vectors.h"
#include "random_hierarchies.h"
#include "input_of_mesh.h"

#include <CGAL/Random.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace test_Mesh_signed_distance_3 {
namespace {

namespace BS = CGAL::Bspline_shells;

const double eps = std::numeric_limits<double>::epsilon();

// Returns the least distance from all facets: from the plane if the foot of the perpendicular is in the facet, and from
// the sides.
double brute_force_distance(const BS::Input_mesh_3& input, const Point_3& point)
{
  const Exact_point p = exact(point);
  Rational least(-1);
  const auto include = [&](const Rational& d) {
    if(least < 0 || d < least) least = d;
  };
  for(auto f : input.mesh().faces()) {
    const auto t = input.triangle(f);
    const Exact_point v[3] = { exact(t[0]), exact(t[1]), exact(t[2]) };
    const Exact_point n = cross(minus(v[1], v[0]), minus(v[2], v[0]));
    bool above = true;
    for(int e = 0; e < 3; ++e) {
      const Exact_point edge = minus(v[(e + 1) % 3], v[e]), to_p = minus(p, v[e]);
      above = above && dot(n, cross(edge, to_p)) >= 0;
      Rational s = dot(edge, to_p) / dot(edge, edge);
      if(s < 0) s = 0;
      if(s > 1) s = 1;
      const Exact_point d = minus(to_p, { s * edge[0], s * edge[1], s * edge[2] });
      include(dot(d, d));
    }
    if(above) {
      const Rational height = dot(n, minus(p, v[0]));
      include(height * height / dot(n, n));
    }
  }
  return std::sqrt(CGAL::to_double(least));
}

// Returns the winding number of the mesh around a point: the sum of the solid angles of its facets.
double winding_number(const BS::Input_mesh_3& input, const Point_3& p)
{
  double sum = 0;
  for(auto f : input.mesh().faces()) {
    const auto t = input.triangle(f);
    const Vector_3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = std::sqrt(a.squared_length()), lb = std::sqrt(b.squared_length()),
                 lc = std::sqrt(c.squared_length());
    sum += 2 * std::atan2(CGAL::determinant(a, b, c), la * lb * lc + (a * b) * lc + (b * c) * la + (c * a) * lb);
  }
  return sum / (4 * std::acos(-1.));
}

// Coordinates have size one; rounding changes a closest point by a few bits.
const double rounding = 32 * eps;

void check_against_brute_force(const Mesh& mesh, int points, double reach)
{
  const BS::Input_mesh_3 input = input_of(mesh);
  const BS::Mesh_signed_distance_3 oracle(input);
  CGAL::Random random(1);
  int negative = 0, positive = 0;
  for(int n = 0; n < points; ++n) {
    const Point_3 p(random.get_double(-reach, reach), random.get_double(-reach, reach),
                    random.get_double(-reach, reach));
    const double distance = brute_force_distance(input, p), winding = winding_number(input, p);
    REQUIRE(std::abs(winding - std::round(winding)) < 1e-9);
    // Facets that face outwards wind once around the inside. Facets that face inwards wind around it -1 times, and the
    // outside is behind them.
    const bool behind = input.faces_outwards() ? std::round(winding) == 1 : std::round(winding) == 0;
    CHECK(oracle.distance(p) == Approx(distance).epsilon(0).margin(rounding * reach));
    CHECK(oracle.sign(p) == (behind ? -1 : 1));
    CHECK(oracle(p) == oracle.sign(p) * oracle.distance(p));
    ++(behind ? negative : positive);
  }
  CHECK(negative > points / 20);
  CHECK(positive > points / 20);
}

double distance_to_box(const Point_3& p, const Point_3& a, const Point_3& b)
{
  double outside = 0, inside = -std::numeric_limits<double>::infinity();
  for(int n = 0; n < 3; ++n) {
    const double d = (std::max)(a[n] - p[n], p[n] - b[n]);
    inside = (std::max)(inside, d);
    if(d > 0) outside += d * d;
  }
  return inside > 0 ? std::sqrt(outside) : inside;
}

Root_cells all_cells(const BS::Input_mesh_3& input, double spacing, int rings)
{
  const BS::Lattice_3 lattice(input.bbox(), spacing);
  return Root_cells(lattice,
                    BS::dilate(BS::cells_entered_by_mesh<CGAL::Sequential_tag>(input, lattice), -rings, rings));
}

// The samples that are computed together, compared with single queries.
struct Comparison
{
  std::size_t samples = 0, negative = 0, positive = 0, wrong_sign = 0, wrong_distance = 0;
};

Comparison compare(const BS::Mesh_signed_distance_3& oracle, const Hierarchy& cells, const std::vector<double>& samples)
{
  Comparison c;
  c.samples = samples.size();
  for(std::size_t n = 0; n < samples.size(); ++n) {
    const Point_3 p = BS::Distance_samples::point<Point_3>(cells, Hierarchy::Index(n / 8), int(n % 8));
    const double expected = oracle(p);
    ++(expected < 0 ? c.negative : c.positive);
    c.wrong_sign += (expected < 0) != (samples[n] < 0);
    c.wrong_distance += !(std::abs(std::abs(expected) - std::abs(samples[n])) <= 4 * rounding);
  }
  return c;
}

void check_samples(const BS::Mesh_signed_distance_3& oracle, const Hierarchy& cells)
{
  const std::vector<double> samples = BS::sample_signed_distance<CGAL::Sequential_tag>(oracle, cells);
  REQUIRE(samples.size() == 8 * cells.number_of_cells());
  const Comparison c = compare(oracle, cells, samples);
  CHECK(c.negative > c.samples / 20);
  CHECK(c.positive > c.samples / 20);
  CHECK(c.wrong_sign == 0);
  CHECK(c.wrong_distance == 0);
  CHECK(BS::sample_signed_distance<CGAL::Parallel_if_available_tag>(oracle, cells) == samples);
}

void check_samples(const Mesh& mesh, double spacing, int rings)
{
  const BS::Input_mesh_3 input = input_of(mesh);
  const BS::Mesh_signed_distance_3 oracle(input);
  const Root_cells cells = all_cells(input, spacing, rings);
  check_samples(oracle, cells);
  // The same check on leaves of different sizes.
  CGAL::Random random(7);
  check_samples(oracle, random_hierarchy(random, cells, 2));
}

// Returns two fans over a ring with alternating radii and heights. Their creases are convex and concave, and end at
// saddles.
Mesh star(int points, double inner, double outer, double zigzag, double height)
{
  Mesh mesh;
  const auto top = mesh.add_vertex(Point_3(0, 0, height)), bottom = mesh.add_vertex(Point_3(0, 0, -height));
  std::vector<Mesh::Vertex_index> ring;
  for(int n = 0; n < 2 * points; ++n) {
    const double angle = std::acos(-1.) * n / points + 0.1, r = n % 2 ? inner : outer;
    ring.push_back(mesh.add_vertex(Point_3(r * std::cos(angle), r * std::sin(angle), n % 2 ? zigzag : -zigzag)));
  }
  for(int n = 0; n < 2 * points; ++n) {
    mesh.add_face(ring[n], ring[(n + 1) % (2 * points)], top);
    mesh.add_face(ring[(n + 1) % (2 * points)], ring[n], bottom);
  }
  return mesh;
}

// Adds a vertex to a facet, next to the middle of one of its sides. This gives two facets and a needle of the given
// relative width.
void add_needle(Mesh& mesh, Mesh::Face_index f, double width)
{
  const auto [p, q, r] = corners(mesh, f);
  const auto center = mesh.target(CGAL::Euler::add_center_vertex(mesh.halfedge(f), mesh));
  mesh.point(center) = CGAL::midpoint(p, q) + width * (r - CGAL::midpoint(p, q));
}

Mesh with_needles(Mesh mesh, double width)
{
  const std::vector<Mesh::Face_index> faces(mesh.faces().begin(), mesh.faces().end());
  for(std::size_t n = 0; n < faces.size(); n += 2) add_needle(mesh, faces[n], width);
  return mesh;
}

// Compares the side by the closest point with the exact side, for points at all distances from vertices, edges and
// facets.
// \param coordinates size of coordinates relative to the mesh
void check_sides(const Mesh& mesh, double coordinates = 1)
{
  for(bool inside_out : { false, true }) {
    const BS::Input_mesh_3 input = input_of(inside_out ? reversed(mesh) : mesh);
    const BS::Mesh_signed_distance_3 oracle(input);
    BS::Mesh_signed_distance_3::Hint hint;
    CGAL::Random random(8);
    const auto direction = [&] {
      return Vector_3(random.get_double(-1, 1), random.get_double(-1, 1), random.get_double(-1, 1));
    };
    int wrong = 0, negative = 0, positive = 0;
    for(auto f : input.mesh().faces()) {
      const auto t = input.triangle(f);
      for(int n = 0; n < 100; ++n) {
        // barycentric coordinates of a corner, of a point on an edge, or of an inner point
        double b[3] = { random.get_double(), n % 4 > 0 ? random.get_double() : 0.,
                        n % 4 > 1 ? random.get_double() : 0. };
        const double sum = b[0] + b[1] + b[2];
        Point_3 p = CGAL::barycenter(t[n % 3], b[0] / sum, t[(n + 1) % 3], b[1] / sum, t[(n + 2) % 3], b[2] / sum);
        p = p + coordinates * std::pow(10, random.get_double(-13, 0)) * direction();
        const double signed_distance = oracle.signed_distance(p, hint), distance = oracle.distance(p);
        if(!(distance > 1e-12 * coordinates)) continue; // rounding of the closest point decides
        wrong += (signed_distance > 0 ? 1 : -1) != oracle.sign(p);
        wrong += !(std::abs(std::abs(signed_distance) - distance) <= 4 * rounding * coordinates);
        ++(signed_distance > 0 ? positive : negative);
      }
    }
    CAPTURE(inside_out);
    CHECK(wrong == 0);
    CHECK(negative > 20);
    CHECK(positive > 20);
  }
}

// A user's oracle, which needs no mesh.
struct Ball
{
  typedef ::Point_3 Point_3;
  typedef double FT;
  double radius;
  FT operator()(const Point_3& p) const { return std::sqrt((p - CGAL::ORIGIN).squared_length()) - radius; }
};

} // namespace

TEST_CASE("Signed distance: distance and sign agree with an exact search through all facets")
{
  SECTION("torus") check_against_brute_force(torus(1, 0.5, 8, 6), 60, 1.5);
  SECTION("inside out") check_against_brute_force(reversed(torus(1, 0.5, 8, 6)), 60, 1.5);
  SECTION("with a cavity") check_against_brute_force(joined(sphere(0), reversed(sphere(0, 0.6))), 80, 1.);
  SECTION("two components")
  {
    check_against_brute_force(joined(sphere(0, 0.7, Point_3(-1, 0, 0)), box(Point_3(0, -1, -1), Point_3(1, 1, 1))), 80,
                              1.5);
  }
}

TEST_CASE("Signed distance: the distance to a box agrees with the closed form")
{
  const Point_3 a(-1, -0.5, -0.25), b(1, 0.75, 0.5);
  const BS::Input_mesh_3 input = input_of(box(a, b));
  const BS::Mesh_signed_distance_3 oracle(input);
  CGAL::Random random(2);
  for(int n = 0; n < 2000; ++n) {
    const Point_3 p(random.get_double(-2, 2), random.get_double(-1, 1), random.get_double(-1, 1));
    CHECK(oracle(p) == Approx(distance_to_box(p, a, b)).epsilon(0).margin(rounding));
  }
}

TEST_CASE(
  "Signed distance: distances to a sphere's mesh lie between distances to its inscribed and circumscribed spheres")
{
  const Mesh mesh = sphere(3);
  double inscribed = 1;
  for(auto f : mesh.faces()) {
    const auto [p, q, r] = corners(mesh, f);
    inscribed = (std::min)(inscribed, std::sqrt(CGAL::squared_distance(Kernel::Plane_3(p, q, r), Point_3(0, 0, 0))));
  }
  REQUIRE(inscribed > 0.98);
  const BS::Input_mesh_3 input = input_of(mesh);
  const BS::Mesh_signed_distance_3 oracle(input);
  CGAL::Random random(3);
  for(int n = 0; n < 1000; ++n) {
    const Point_3 p(random.get_double(-2, 2), random.get_double(-2, 2), random.get_double(-2, 2));
    const double r = std::sqrt((p - CGAL::ORIGIN).squared_length());
    CHECK(oracle(p) >= r - 1 - rounding);
    CHECK(oracle(p) <= r - inscribed + rounding);
  }
}

TEST_CASE("Signed distance: the distance is zero at points of the mesh, and has the right sign one ulp away")
{
  const Point_3 a(-1, -0.5, -0.3), b(1, 0.7, 0.5);
  for(bool inside_out : { false, true }) {
    const BS::Input_mesh_3 input = input_of(inside_out ? reversed(box(a, b)) : box(a, b));
    const BS::Mesh_signed_distance_3 oracle(input);
    CGAL::Random random(4);
    for(int n = 0; n < 200; ++n) {
      const int axis = n % 3;
      const double side = n % 2 ? a[axis] : b[axis];
      const auto at = [&](double x, const Point_3& p) {
        return Point_3(axis == 0 ? x : p.x(), axis == 1 ? x : p.y(), axis == 2 ? x : p.z());
      };
      // on a side, on its edges, at its corners
      const auto coordinate = [&](int d) {
        return n % 5 == 4 ? a[d] : n % 7 == 6 ? b[d] : random.get_double(a[d], b[d]);
      };
      const Point_3 p = at(side, Point_3(coordinate(0), coordinate(1), coordinate(2)));
      CHECK(oracle.sign(p) == 0);
      CHECK(oracle(p) == 0);
      CHECK(oracle.distance(p) <= rounding);
      const double out = n % 2 ? -10 : 10;
      CHECK(oracle.sign(at(std::nextafter(side, out), p)) == (inside_out ? -1 : 1));
      if(n % 5 < 4 && n % 7 < 6) CHECK(oracle.sign(at(std::nextafter(side, -out), p)) == (inside_out ? 1 : -1));
    }
  }
  const Mesh mesh = sphere(2);
  const BS::Input_mesh_3 input = input_of(mesh);
  const BS::Mesh_signed_distance_3 oracle(input);
  for(auto v : mesh.vertices()) CHECK(oracle(mesh.point(v)) == 0);
}

TEST_CASE("Signed distance: turning a mesh inside out negates the distance")
{
  const Mesh mesh = torus(1, 0.5, 16, 12);
  const BS::Input_mesh_3 input = input_of(mesh), reversed_input = input_of(reversed(mesh));
  REQUIRE(input.faces_outwards());
  REQUIRE_FALSE(reversed_input.faces_outwards());
  const BS::Mesh_signed_distance_3 oracle(input), opposite(reversed_input);
  CGAL::Random random(5);
  for(int n = 0; n < 500; ++n) {
    const Point_3 p(random.get_double(-2, 2), random.get_double(-2, 2), random.get_double(-1, 1));
    CHECK(opposite.sign(p) == -oracle.sign(p));
    CHECK(opposite(p) == Approx(-oracle(p)).epsilon(0).margin(rounding));
  }
}

TEST_CASE("Signed distance: the start of the search does not affect the result")
{
  const BS::Input_mesh_3 input = input_of(torus(1, 0.5, 24, 16));
  const BS::Mesh_signed_distance_3 oracle(input);
  CGAL::Random random(6);
  BS::Mesh_signed_distance_3::Hint hint;
  Point_3 p(0, 0, 0);
  for(int n = 0; n < 2000; ++n) {
    // Steps are usually short, as between the samples of a cell. After a jump, the hint is poor.
    const double step = n % 10 == 0 ? 1.5 : 0.05;
    p = Point_3(random.get_double(-step, step), random.get_double(-step, step), random.get_double(-step, step))
        + (n % 10 == 0 ? Vector_3(0, 0, 0) : p - CGAL::ORIGIN);
    CHECK(oracle.signed_distance(p, hint) == Approx(oracle(p)).epsilon(0).margin(rounding));
    // The new hint is the closest facet.
    const auto t = input.triangle(BS::Input_mesh_3::Face_index(hint.triangle));
    CHECK(std::sqrt(CGAL::squared_distance(Kernel::Triangle_3(t[0], t[1], t[2]), p))
          == Approx(oracle.distance(p)).epsilon(0).margin(rounding));
  }
}

TEST_CASE("Signed distance: the closest point determines the side, even at creases, saddles, needles and thin parts")
{
  SECTION("smooth") check_sides(sphere(1));
  SECTION("saddles") check_sides(torus(1, 0.5, 8, 6));
  SECTION("creases of all kinds") check_sides(star(5, 0.3, 1, 0.2, 0.5));
  SECTION("sharp creases") check_sides(star(7, 0.2, 1, 0, 0.01));
  SECTION("very sharp creases") check_sides(star(4, 0.9, 1, 0, 1e-4));
  SECTION("spikes") check_sides(star(3, 0.01, 1, 0.01, 0.02));
  SECTION("deep folds") check_sides(star(6, 0.1, 1, 0.3, 0.05));
  SECTION("a plate") check_sides(box(Point_3(-1, -1, 0), Point_3(1, 1, 1e-3)));
  SECTION("a thin plate") check_sides(box(Point_3(-1, -0.7, 0.3), Point_3(1, 0.7, 0.3 + 1e-6)));
  SECTION("a rod") check_sides(box(Point_3(-1, 0.1, 0.3), Point_3(1, 0.1 + 1e-4, 0.3 + 1e-4)));
  SECTION("needles") check_sides(with_needles(sphere(1), 1e-4));
  SECTION("thin needles") check_sides(with_needles(box(Point_3(-1, -1, -1), Point_3(1, 1, 1)), 1e-8));
  SECTION("needles at creases") check_sides(with_needles(star(5, 0.3, 1, 0.2, 0.5), 1e-6));
  SECTION("thin needles at sharp creases") check_sides(with_needles(star(5, 0.3, 1, 0, 0.01), 1e-8));
  SECTION("needles as thin as one ulp, at creases") check_sides(with_needles(star(5, 0.3, 1, 0, 0.5), 1e-14));
  SECTION("a cavity") check_sides(joined(sphere(1), reversed(sphere(1, 0.99))));
  SECTION("far from the origin")
  {
    for(const Mesh& mesh : { torus(1, 0.5, 8, 6), star(7, 0.2, 1, 0, 0.01), with_needles(sphere(1), 1e-4) })
      check_sides(mapped(mesh, [](const Point_3& p) { return p + Vector_3(300, -1000, 70); }), 1000);
  }
}

TEST_CASE("Signed distance: if a mesh intersects itself, the closest facet determines the side")
{
  // Two boxes overlap.
  const Mesh mesh = joined(box(Point_3(0, 0, 0), Point_3(1, 1, 1)),
                           box(Point_3(0.5, 0.2, 0.3), Point_3(1.6, 0.7, 0.8)));
  const BS::Input_mesh_3 input = input_of(mesh);
  const BS::Mesh_signed_distance_3 oracle(input);
  BS::Mesh_signed_distance_3::Hint hint;
  CGAL::Random random(9);
  int differ = 0;
  for(int n = 0; n < 3000; ++n) {
    const Point_3 p(random.get_double(-0.3, 1.9), random.get_double(-0.3, 1.3), random.get_double(-0.3, 1.3));
    const double first = distance_to_box(p, Point_3(0, 0, 0), Point_3(1, 1, 1)),
                 second = distance_to_box(p, Point_3(0.5, 0.2, 0.3), Point_3(1.6, 0.7, 0.8));
    if(std::abs(std::abs(first) - std::abs(second)) < 1e-9) continue;
    const double expected = std::abs(first) < std::abs(second) ? first : second;
    CHECK(oracle.signed_distance(p, hint) == Approx(expected).epsilon(0).margin(rounding));
    differ += first < 0 && second < 0;
  }
  CHECK(differ > 50); // the parity of crossed facets would give another side
}

TEST_CASE("Distance samples: all samples together form a uniform lattice, with two samples per cell and axis")
{
  const BS::Lattice_3 lattice(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.5);
  const Hierarchy cells(Root_cells(lattice, BS::dilate({ BS::Lattice_key::encode(0, 0, 0) }, 0, 1)));
  std::vector<std::array<double, 3> > expected, points;
  for(double z : { 1, 3, 5, 7 })
    for(double y : { 1, 3, 5, 7 })
      for(double x : { 1, 3, 5, 7 }) expected.push_back({ x / 8, y / 8, z / 8 });
  for(Hierarchy::Index c = 0; c < 8; ++c)
    for(int s = 0; s < BS::Distance_samples::per_cell; ++s) {
      const Point_3 p = BS::Distance_samples::point<Point_3>(cells, c, s);
      CHECK(cells.locate(p) == c);
      points.push_back({ p.x(), p.y(), p.z() });
    }
  std::sort(expected.begin(), expected.end());
  std::sort(points.begin(), points.end());
  CHECK(points == expected);
}

TEST_CASE("Distance samples: samples of many cells agree with single queries", "[slow]")
{
  SECTION("a torus") check_samples(torus(1, 0.5, 24, 16), 0.13, 2);
  SECTION("inside out") check_samples(reversed(torus(1, 0.5, 12, 8)), 0.2, 2);
  SECTION("a mesh with a cavity") check_samples(joined(sphere(2), reversed(sphere(2, 0.5))), 0.12, 2);
  SECTION("two components")
  {
    check_samples(joined(sphere(2, 0.7, Point_3(-1, 0, 0)), box(Point_3(0, -1, -1), Point_3(1, 1, 1))), 0.15, 3);
  }
  SECTION("a box in lattice planes") check_samples(box(Point_3(-.5, -.5, -.5), Point_3(.5, .5, .5)), 0.125, 2);
  SECTION("cells that do not touch the mesh") check_samples(sphere(3), 0.11, 4);
  SECTION("folds") check_samples(star(5, 0.3, 1, 0.2, 0.5), 0.11, 2);
}

TEST_CASE("Distance samples: the oracle may be given by the user")
{
  const BS::Input_mesh_3 input = input_of(sphere(1));
  const Hierarchy cells = all_cells(input, 0.2, 2);
  const Ball ball = { 0.9 };
  const std::vector<double> samples = BS::sample_signed_distance<CGAL::Sequential_tag>(ball, cells);
  REQUIRE(samples.size() == 8 * cells.number_of_cells());
  int wrong = 0;
  for(std::size_t n = 0; n < samples.size(); ++n) {
    const std::array<double, 3> corner = cells.corner(Hierarchy::Index(n / 8));
    const double w = cells.width(Hierarchy::Index(n / 8));
    wrong += samples[n]
             != ball(Point_3(corner[0] + (n & 1 ? .75 : .25) * w, corner[1] + (n & 2 ? .75 : .25) * w,
                             corner[2] + (n & 4 ? .75 : .25) * w));
  }
  CHECK(wrong == 0);
  CHECK(BS::sample_signed_distance<CGAL::Parallel_if_available_tag>(ball, cells) == samples);
}
} // namespace test_Mesh_signed_distance_3
