// The mesh is clipped to cells of equal or different sizes. General properties of the pieces are measured exactly; in
// special cases, pieces are counted.
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include "exact_vectors.h"
#include "random_hierarchies.h"
#include "input_of_mesh.h"

#include <CGAL/Random.h>
#include <CGAL/boost/graph/generators.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace test_clip_mesh_to_cells {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Clipped_mesh_3 Clipped;
typedef Clipped::Point Point;
typedef std::array<Point, 3> Triangle;
typedef CGAL::Sequential_tag Tag;

const double eps = std::numeric_limits<double>::epsilon();

std::vector<Triangle> triangles_of(const BS::Input_mesh_3& input)
{
  std::vector<Triangle> triangles;
  for(auto f : input.mesh().faces()) {
    Triangle t;
    for(int v = 0; v < 3; ++v)
      for(int a = 0; a < 3; ++a) t[v][a] = input.triangle(f)[v][a];
    triangles.push_back(t);
  }
  return triangles;
}

Exact_point minus(const Point& p, const Point& q)
{
  return ::minus(exact(p), exact(q));
}
double norm(const Exact_point& u)
{
  return std::sqrt(CGAL::to_double(dot(u, u)));
}
double distance(const Point& p, const Point& q)
{
  return norm(minus(p, q));
}

// Returns the number of successive cuts: six, and three for each lower level.
int number_of_cuts(const Hierarchy& cells)
{
  return 6 + 3 * (cells.number_of_levels() - 1);
}

// Each cut is off by at most ten roundings of coordinates, along three axes.
double allowance(const Triangle& t, int cuts)
{
  double reach = 0;
  for(const Point& p : t)
    for(double x : p) reach = (std::max)(reach, std::abs(x));
  return 5 * cuts * std::sqrt(3.) * eps * reach;
}

typedef std::map<std::string, int> Faults; // numbers of faults, by kind

// Returns the cells that a mesh enters.
Root_cells cells_of(const BS::Input_mesh_3& input, const BS::Lattice_3& lattice)
{
  return Root_cells(lattice, BS::cells_entered_by_mesh<Tag>(input, lattice));
}

// Checks all properties of pieces, point by point, in exact arithmetic.
Faults faults_of(const Clipped& clipped, const std::vector<Triangle>& triangles, const Hierarchy& cells)
{
  Faults faults;
  std::vector<double> area(triangles.size(), 0), area_error(triangles.size(), 0);
  const Clipped::Piece* last = nullptr;
  for(const Clipped::Piece& piece : clipped.pieces()) {
    faults["unsorted"] += last && !(std::make_pair(last->cell, last->facet) < std::make_pair(piece.cell, piece.facet));
    last = &piece;
    const Triangle& t = triangles[piece.facet];
    const double allowed = allowance(t, number_of_cuts(cells));
    const Exact_point n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const double norm_n = norm(n);
    const std::array<double, 3> corner = cells.corner(piece.cell);
    double perimeter = 0;
    for(std::uint32_t v = 0; v < piece.size; ++v) {
      const Point& x = clipped.point(piece.first + v);
      const Point& next = clipped.point(piece.first + (v + 1) % piece.size);
      const Point& after_next = clipped.point(piece.first + (v + 2) % piece.size);
      int planes = 0;
      for(int a = 0; a < 3; ++a) {
        const double lower = corner[a], upper = corner[a] + cells.width(piece.cell);
        faults["outside cell"] += x[a] < lower || x[a] > upper;
        planes += x[a] == lower || x[a] == upper;
      }
      faults["not cut"] += planes == 0 && std::find(t.begin(), t.end(), x) == t.end();
      faults["off plane"] += std::abs(CGAL::to_double(dot(n, minus(x, t[0])))) > allowed * norm_n;
      for(int e = 0; e < 3; ++e) {
        const Exact_point edge = minus(t[(e + 1) % 3], t[e]);
        faults["off facet"] += CGAL::to_double(dot(n, cross(edge, minus(x, t[e])))) < -allowed * norm_n * norm(edge);
      }
      const double length = distance(x, next);
      perimeter += length;
      faults["not convex"] += CGAL::to_double(dot(n, cross(minus(next, x), minus(after_next, next))))
                              < -2 * allowed * norm_n * (length + distance(next, after_next));
    }
    area[piece.facet] += clipped.area(piece);
    // errors of corners, and roundings in area()
    area_error[piece.facet] += 2 * allowed * perimeter + 16 * eps * perimeter * perimeter;
  }
  for(std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    const Exact_point n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const double expected = norm(n) / 2;
    // The normal is computed from rounded edges. On needles, its precision is limited by their width.
    const double longest = (std::max)({ distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0]) });
    const double angle = (std::min)(1., 16 * eps * longest * longest / expected);
    double deviation = 0, length = 0;
    for(int a = 0; a < 3; ++a) {
      deviation = (std::max)(deviation, std::abs(clipped.normal(f)[a] - CGAL::to_double(n[a]) / norm(n)));
      length += clipped.normal(f)[a] * clipped.normal(f)[a];
    }
    faults["normal"] += deviation > angle || std::abs(length - 1) > 8 * eps;
    faults["area"] += std::abs(area[f] - expected) > area_error[f] + angle * expected;
    faults["lost"] += !(area[f] > 0);
  }
  return faults;
}

// Returns the points of a facet's pieces on the line through two of its vertices.
std::set<Point> points_on_edge(const Clipped& clipped, const std::vector<const Clipped::Piece*>& pieces, const Point& a,
                               const Point& b, double allowed)
{
  std::set<Point> points;
  for(const Clipped::Piece* piece : pieces)
    for(std::uint32_t v = 0; v < piece->size; ++v) {
      const Point& x = clipped.point(piece->first + v);
      if(norm(cross(minus(b, a), minus(x, a))) <= allowed * norm(minus(b, a))) points.insert(x);
    }
  return points;
}

void check_pieces(const BS::Input_mesh_3& input, const Hierarchy& cells, bool with_edges)
{
  const Clipped clipped = BS::clip_mesh_to_cells<Tag>(input, cells);
  const std::vector<Triangle> triangles = triangles_of(input);
  REQUIRE(clipped.number_of_facets() == triangles.size());
  REQUIRE(clipped.number_of_pieces() >= triangles.size());

  const Faults faults = faults_of(clipped, triangles, cells);
  for(const auto& [kind, number] : faults) {
    CAPTURE(kind);
    CHECK(number == 0);
  }

  std::set<std::uint32_t> entered;
  std::vector<std::vector<const Clipped::Piece*> > pieces(triangles.size());
  for(const Clipped::Piece& piece : clipped.pieces()) {
    entered.insert(piece.cell);
    pieces[piece.facet].push_back(&piece);
  }
  CHECK(clipped.cells() == std::vector<std::uint32_t>(entered.begin(), entered.end()));

  if(!with_edges) return;
  // The two facets at an edge have exactly the same points on it.
  std::map<std::pair<Point, Point>, std::set<Point> > points_on;
  std::size_t cut_edges = 0, different = 0;
  for(std::size_t f = 0; f < triangles.size(); ++f)
    for(int e = 0; e < 3; ++e) {
      const Point& p = triangles[f][e];
      const Point& q = triangles[f][(e + 1) % 3];
      const std::set<Point> points = points_on_edge(clipped, pieces[f], p, q,
                                                    allowance(triangles[f], number_of_cuts(cells)));
      const auto inserted = points_on.insert({ { (std::min)(p, q), (std::max)(p, q) }, points });
      if(inserted.second) continue;
      cut_edges += points.size() > 2;
      different += points != inserted.first->second;
    }
  CHECK(points_on.size() == triangles.size() * 3 / 2);
  CHECK(cut_edges > 0);
  CHECK(different == 0);
}

int number_of_differences(const Clipped& a, const Clipped& b)
{
  REQUIRE(a.number_of_pieces() == b.number_of_pieces());
  int different = 0;
  for(std::size_t n = 0; n < a.number_of_pieces(); ++n) {
    const Clipped::Piece &p = a.pieces()[n], &q = b.pieces()[n];
    different += p.cell != q.cell || p.facet != q.facet || p.size != q.size || p.first != q.first;
    for(std::uint32_t v = 0; v < p.size && different == 0; ++v)
      different += a.point(p.first + v) != b.point(q.first + v);
  }
  return different;
}

BS::Lattice_3 lattice_around(const BS::Input_mesh_3& input, double spacing, const Point_3& center)
{
  const CGAL::Bbox_3 c = center.bbox(), b = input.bbox();
  const double reach = (std::max)({ b.xmax() - c.xmin(), c.xmax() - b.xmin(), b.ymax() - c.ymin(), c.ymax() - b.ymin(),
                                    b.zmax() - c.zmin(), c.zmax() - b.zmin() });
  const BS::Lattice_3 lattice(CGAL::Bbox_3(c.xmin() - reach, c.ymin() - reach, c.zmin() - reach, c.xmax() + reach,
                                           c.ymax() + reach, c.zmax() + reach),
                              spacing);
  REQUIRE(lattice.is_exact());
  return lattice;
}

void check_clip(const Mesh& mesh, double spacing, const Point_3& lattice_center = CGAL::ORIGIN, bool with_edges = true)
{
  const BS::Input_mesh_3 input = input_of(mesh, false);
  const BS::Lattice_3 lattice = lattice_around(input, spacing, lattice_center);
  const Root_cells cells = cells_of(input, lattice);
  check_pieces(input, cells, with_edges);
  // All cells that the mesh enters have a piece.
  CHECK(BS::clip_mesh_to_cells<Tag>(input, cells).cells().size() == cells.number_of_cells());
  CHECK(BS::cells_entered_by_mesh<CGAL::Parallel_if_available_tag>(input, lattice)
        == BS::cells_entered_by_mesh<Tag>(input, lattice));
}

// Refines leaves at random places of the mesh.
Hierarchy refined_at_mesh(const BS::Input_mesh_3& input, const Root_cells& roots, unsigned seed, int levels)
{
  CGAL::Random random(seed);
  Hierarchy cells(roots);
  while(cells.number_of_levels() < levels) {
    const std::vector<std::uint32_t> entered = BS::clip_mesh_to_cells<Tag>(input, cells).cells();
    const Hierarchy::Index finest = cells.first_leaf(cells.number_of_levels() - 1);
    std::vector<Hierarchy::Index> marked;
    for(std::uint32_t c : entered)
      if(c >= finest && random.get_double() < 3. / double(entered.size())) marked.push_back(c);
    cells = cells.refined(marked);
  }
  return cells;
}

void check_clip_to_leaves(const Mesh& mesh, double spacing, const Point_3& lattice_center = CGAL::ORIGIN,
                          bool with_edges = true)
{
  const BS::Input_mesh_3 input = input_of(mesh, false);
  const BS::Lattice_3 lattice = lattice_around(input, spacing, lattice_center);
  const Root_cells roots(lattice, BS::dilate(BS::cells_entered_by_mesh<Tag>(input, lattice), -1, 1));
  const Hierarchy cells = refined_at_mesh(input, roots, 7, 3);
  check_pieces(input, cells, with_edges);
  // Without splits, the pieces are those of the root cells.
  CHECK(number_of_differences(BS::clip_mesh_to_cells<Tag>(input, roots),
                              BS::clip_mesh_to_cells<Tag>(input, Hierarchy(roots)))
        == 0);
}

Mesh octahedron(double radius)
{
  Mesh mesh;
  Mesh::Vertex_index v[6];
  for(int a = 0; a < 3; ++a)
    for(int s = 0; s < 2; ++s) {
      const double x = s ? radius : -radius;
      v[2 * a + s] = mesh.add_vertex(Point_3(a == 0 ? x : 0, a == 1 ? x : 0, a == 2 ? x : 0));
    }
  for(int n = 0; n < 8; ++n) {
    const Mesh::Vertex_index x = v[n & 1], y = v[2 + (n >> 1 & 1)], z = v[4 + (n >> 2)];
    if(n == 1 || n == 2 || n == 4 || n == 7) mesh.add_face(x, y, z);
    else mesh.add_face(y, x, z);
  }
  return mesh;
}

Mesh tetrahedron(const Point_3& a, const Point_3& b, const Point_3& c, const Point_3& d)
{
  Mesh mesh;
  CGAL::make_tetrahedron(a, b, c, d, mesh);
  return mesh;
}

const BS::Lattice_3 quarters(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.25);

} // namespace

TEST_CASE("Clipped mesh: pieces lie in their cells and facets, and their areas add up")
{
  SECTION("facets larger than cells") check_clip(sphere(1), 0.21, Point_3(0.01, 0.02, -0.03));
  SECTION("facets smaller than cells") check_clip(sphere(2), 0.5, Point_3(0.03, 0.01, 0.02));
  SECTION("far from the origin") check_clip(sphere(1, 1, Point_3(1e6, -1e6, 12345)), 0.3, Point_3(1e6, -1e6, 12345));
  // If an edge is one bit away from a plane, its points cannot be distinguished from close points, so edges are not
  // compared.
  SECTION("edges one ulp away from lattice planes") check_clip(torus(1, 0.5, 12, 8), 0.25, CGAL::ORIGIN, false);
  SECTION("edges in lattice planes")
  {
    const auto rounded = [](double x) { return std::nearbyint(std::ldexp(x, 20)) / (1 << 20); };
    const auto at = [&](const Point_3& p) { return Point_3(rounded(p.x()), rounded(p.y()), rounded(p.z())); };
    check_clip(mapped(torus(1, 0.5, 12, 8), at), 0.25);
  }
  SECTION("axis-aligned, in lattice planes") check_clip(box(Point_3(-.5, -.5, -.5), Point_3(.5, .5, .75)), 0.25);
  SECTION("axis-aligned, next to lattice planes") check_clip(box(Point_3(-.6, -.5, -.4), Point_3(.7, .6, .9)), 0.3);
  SECTION("through lattice corners") check_clip(octahedron(1), 0.25);
}

TEST_CASE("Cells near a mesh: all cells near samples are found, and each has a part of the mesh in its enlarged box")
{
  for(int subdivisions : { 0, 3 }) { // subdivisions of an icosahedron
    const BS::Input_mesh_3 input = input_of(sphere(subdivisions), false);
    const BS::Lattice_3 lattice = lattice_around(input, 0.21, Point_3(0.01, 0.02, -0.03));
    const Root_cells entered = cells_of(input, lattice);
    const std::vector<std::uint64_t> entered_keys = BS::cells_entered_by_mesh<Tag>(input, lattice);
    const Clipped pieces = BS::clip_mesh_to_cells<Tag>(input, entered);
    for(double part : { 0.25, 0.8 }) {
      CAPTURE(part);
      const double distance = part * lattice.spacing();
      const BS::Cells_near_mesh cells = BS::cells_near_mesh<Tag>(input, lattice, distance);
      const std::vector<std::uint64_t>& keys = cells.near;
      CHECK(cells.entered == entered_keys);
      CHECK(BS::cells_near_mesh<CGAL::Parallel_if_available_tag>(input, lattice, distance).near == keys);
      // Cells near the boxes of all pieces are expected.
      std::set<std::uint64_t> near(entered_keys.begin(), entered_keys.end());
      std::size_t missing = 0;
      for(const Clipped::Piece& piece : pieces.pieces()) {
        CGAL::Bbox_3 box;
        for(std::uint32_t v = 0; v < piece.size; ++v) {
          const auto& p = pieces.point(piece.first + v);
          box += Point_3(p[0], p[1], p[2]).bbox();
          // Cells just within the distance, towards each corner, must not be missing.
          for(int corner = 0; corner < 8; ++corner) {
            int q[3];
            for(int a = 0; a < 3; ++a)
              q[a] = lattice.interval(a, p[std::size_t(a)] + (corner >> a & 1 ? 0.999 : -0.999) * distance);
            missing += !std::binary_search(keys.begin(), keys.end(), BS::Lattice_key::encode(q[0], q[1], q[2]));
          }
        }
        int first[3], last[3];
        for(int a = 0; a < 3; ++a) {
          first[a] = lattice.interval(a, (box.min)(a)-distance);
          last[a] = lattice.interval(a, (box.max)(a) + distance);
        }
        for(int k = first[2]; k <= last[2]; ++k)
          for(int j = first[1]; j <= last[1]; ++j)
            for(int i = first[0]; i <= last[0]; ++i) near.insert(BS::Lattice_key::encode(i, j, k));
      }
      CHECK(missing == 0);
      CHECK(std::vector<std::uint64_t>(near.begin(), near.end()) == keys);
    }
  }
}

TEST_CASE("Cells near a mesh: both sides are treated alike, even just beyond the distance")
{
  // The sides of a cube are between lattice planes; cells have width one.
  const BS::Input_mesh_3 input = input_of(box(Point_3(0.25, 0.25, 0.25), Point_3(1.75, 1.75, 1.75)), false);
  const BS::Lattice_3 lattice(CGAL::Bbox_3(-4, -4, -4, 6, 6, 6), 1);
  REQUIRE(lattice.spacing() == 1);
  REQUIRE(lattice.coordinate(0, lattice.interval(0, 0.5)) == 0);
  CHECK(BS::cells_near_mesh<Tag>(input, lattice, 0.25).near.size() == 8);
  CHECK(BS::cells_near_mesh<Tag>(input, lattice, 0.375).near.size() == 64);
}

TEST_CASE("Clipped mesh: needles a few ulps wide are not lost")
{
  const Point_3 a(-.9, -.8, -.7), b(.8, .9, .6);
  check_clip(tetrahedron(a, a + Vector_3(1e-12, -1e-12, 0), b, a + Vector_3(0, 1e-12, -1e-12)), 0.1);
  // along an edge of the lattice
  check_clip(tetrahedron(Point_3(0, 0, -.9), Point_3(1e-12, 0, -.9), Point_3(0, 0, .8), Point_3(0, 1e-12, -.9)), 0.25);
  check_clip(
    tetrahedron(Point_3(-1e-12, 0, -.9), Point_3(1e-12, 1e-12, -.9), Point_3(0, 0, .8), Point_3(0, -1e-12, -.9)), 0.25);
}

TEST_CASE("Clipped mesh: cuts do not overshoot the ends of an edge that lie on a lattice plane")
{
  // For t close to 1, p + t (q - p) may be beyond q, and thus in another cell. Here this happens in cells with zero
  // inside.
  const BS::Lattice_3 lattice(CGAL::Bbox_3(0, 0, 0, 24.7, 24.7, 24.7), 24.7);
  CGAL::Random random(1);
  Mesh mesh;
  for(int n = 0; n < 4000; ++n) {
    std::array<Point_3, 4> v;
    // coordinates with all 53 bits
    const auto coordinate = [&] { return random.get_double(-12, 12) + random.get_double(-1e-7, 1e-7); };
    for(Point_3& p : v) p = Point_3(coordinate(), coordinate(), coordinate());
    double x[3];
    for(int a = 0; a < 3; ++a) {
      x[a] = lattice.coordinate(a, random.get_int(-1, 1));
      if(a == n % 3) x[a] = std::nextafter(x[a], x[a] < 0 ? -1e3 : 1e3);
    }
    v[0] = Point_3(x[0], x[1], x[2]);
    if(CGAL::orientation(v[0], v[1], v[2], v[3]) == CGAL::NEGATIVE) std::swap(v[2], v[3]);
    CGAL::make_tetrahedron(v[0], v[1], v[2], v[3], mesh);
  }
  const BS::Input_mesh_3 input = input_of(mesh);
  const Root_cells roots = cells_of(input, lattice);
  const auto outside = [&](const Hierarchy& cells) {
    const Clipped clipped = BS::clip_mesh_to_cells<Tag>(input, cells);
    CHECK(clipped.number_of_pieces() > clipped.number_of_facets());
    int outside = 0;
    for(const Clipped::Piece& piece : clipped.pieces())
      for(std::uint32_t v = 0; v < piece.size; ++v)
        for(int a = 0; a < 3; ++a) {
          const double x = clipped.point(piece.first + v)[a], lower = cells.corner(piece.cell)[a];
          outside += x < lower || x > lower + cells.width(piece.cell);
        }
    return outside;
  };
  CHECK(outside(roots) == 0);
  CHECK(outside(Hierarchy(roots).refined({ 0 }).refined({ 0 })) == 0);
}

TEST_CASE("Clipped mesh: the checks of these tests detect planted errors")
{
  // Without this test, the tests above would prove nothing.
  const BS::Input_mesh_3 input = input_of(sphere(0), false);
  const BS::Lattice_3 lattice(input.bbox(), 0.31), wrong_lattice(input.bbox(), 0.3);
  const std::vector<std::uint64_t> keys = BS::cells_entered_by_mesh<Tag>(input, lattice);
  const Root_cells cells(lattice, keys), wrong_cells(wrong_lattice, keys);
  const Clipped clipped = BS::clip_mesh_to_cells<Tag>(input, cells);
  std::vector<Triangle> triangles = triangles_of(input);
  for(const auto& kind : faults_of(clipped, triangles, cells)) CHECK(kind.second == 0);
  CHECK(faults_of(clipped, triangles, wrong_cells)["outside cell"] > 0);
  CHECK(faults_of(clipped, triangles, wrong_cells)["not cut"] > 0);
  // Pieces of root cells are not pieces of their leaves.
  const Hierarchy finer = refined_at_mesh(input, cells, 8, 2);
  CHECK(faults_of(clipped, triangles, finer)["outside cell"] > 0);
  for(double& x : triangles[3][1]) x *= 1 + 1e-13; // away from the center of the sphere
  CHECK(faults_of(clipped, triangles, cells)["off plane"] > 0);
  triangles = triangles_of(input);
  std::swap(triangles[3], triangles[4]);
  CHECK(faults_of(clipped, triangles, cells)["off facet"] > 0);
  std::swap(triangles[3], triangles[4]);
  std::swap(triangles[3][0], triangles[3][1]);
  CHECK(faults_of(clipped, triangles, cells)["not convex"] > 0);
  CHECK(faults_of(clipped, triangles, cells)["normal"] > 0);
}

TEST_CASE("Clipped mesh: a facet between two cells belongs to the one behind it")
{
  const auto check = [](const BS::Input_mesh_3& input, const Hierarchy& cells, double expected_area) {
    const Clipped clipped = BS::clip_mesh_to_cells<Tag>(input, cells);
    std::size_t in_plane = 0, wrong = 0;
    double area = 0;
    for(const Clipped::Piece& piece : clipped.pieces()) {
      area += clipped.area(piece);
      const std::array<double, 3> corner = cells.corner(piece.cell);
      const double width = cells.width(piece.cell);
      for(int a = 0; a < 3; ++a) {
        if(clipped.normal(piece.facet)[a] == 0) continue;
        const double x = clipped.point(piece.first)[a],
                     behind = corner[a] + (clipped.normal(piece.facet)[a] > 0 ? width : 0);
        const bool between = x == corner[a] || x == corner[a] + width;
        in_plane += between;
        wrong += between && x != behind;
      }
    }
    CHECK(wrong == 0);
    CHECK(area == Approx(expected_area).epsilon(1e-14)); // each part is counted once
    return std::make_pair(clipped.number_of_pieces(), in_plane);
  };
  const BS::Input_mesh_3 input = input_of(box(Point_3(-.5, -.5, -.5), Point_3(.5, .5, .75)), false);
  const Root_cells roots(quarters, BS::dilate(BS::cells_entered_by_mesh<Tag>(input, quarters), -2, 2));
  // Sides of 4 x 4 cells have 16 + 4 pieces, as the diagonal passes through 4 cells. Sides of 4 x 5 cells have 20 + 8
  // pieces, as it passes through 4 + 5 - 1.
  const std::size_t pieces = 2 * 20 + 4 * 28;
  CHECK(check(input, roots, 7) == std::make_pair(pieces, pieces));
  // Leaves on both sides of a plane have different sizes.
  const Hierarchy cells = refined_at_mesh(input, roots, 9, 3);
  const auto counts = check(input, cells, 7);
  CHECK(counts.first > 2 * pieces);
  CHECK(counts.first == counts.second);
  int between = 0;
  const Clipped clipped = BS::clip_mesh_to_cells<Tag>(input, cells);
  for(const Clipped::Piece& piece : clipped.pieces()) {
    const Clipped::Point& n = clipped.normal(piece.facet);
    for(int a = 0; a < 3; ++a)
      if(n[a] != 0)
        cells.visit_neighbors(piece.cell, a, n[a] > 0,
                              [&](Hierarchy::Index c) { between += cells.level(c) != cells.level(piece.cell); });
  }
  CHECK(between > 10);

  // The sides pass through the middles of root cells, and thus between the leaves of split cells.
  const BS::Input_mesh_3 other = input_of(box(Point_3(-.375, -.375, -.375), Point_3(.375, .375, .625)), false);
  const Root_cells other_roots(quarters, BS::dilate(BS::cells_entered_by_mesh<Tag>(other, quarters), -2, 2));
  CHECK(check(other, other_roots, 6 * 0.5625 + 3 * 0.25).second == 0);
  CHECK(check(other, refined_at_mesh(other, other_roots, 10, 3), 6 * 0.5625 + 3 * 0.25).second > 100);
}

TEST_CASE("Clipped mesh: on a hierarchy, pieces lie in their leaves and facets, and their areas add up")
{
  SECTION("facets larger than cells") check_clip_to_leaves(sphere(1), 0.37, Point_3(0.01, 0.02, -0.03));
  SECTION("facets smaller than cells") check_clip_to_leaves(sphere(2), 0.8, Point_3(0.03, 0.01, 0.02));
  SECTION("far from the origin")
  {
    check_clip_to_leaves(sphere(1, 1, Point_3(1e5, -1e5, 12345)), 0.5, Point_3(100000.03, -99999.98, 12345.01));
  }
  // A facet in a plane between leaves of different sizes is cut on one side of the plane or the other, so edges are not
  // compared.
  SECTION("edges one ulp away from lattice planes")
  {
    check_clip_to_leaves(torus(1, 0.5, 12, 8), 0.5, CGAL::ORIGIN, false);
  }
  SECTION("axis-aligned, next to lattice planes")
  {
    check_clip_to_leaves(box(Point_3(-.6, -.5, -.4), Point_3(.7, .6, .9)), 0.3);
  }
  SECTION("through lattice corners") check_clip_to_leaves(octahedron(1), 0.5, CGAL::ORIGIN, false);
  SECTION("needles")
  {
    const Point_3 a(-.9, -.8, -.7), b(.8, .9, .6);
    check_clip_to_leaves(tetrahedron(a, a + Vector_3(1e-12, -1e-12, 0), b, a + Vector_3(0, 1e-12, -1e-12)), 0.25,
                         CGAL::ORIGIN, false);
  }
}

TEST_CASE("Clipped mesh: leaves of one size yield the same pieces as cells of a finer lattice")
{
  const BS::Input_mesh_3 input = input_of(sphere(1), false);
  const BS::Lattice_3 lattice(CGAL::Bbox_3(-1.1, -1.1, -1.1, 1.1, 1.1, 1.1), 0.4),
    fine(CGAL::Bbox_3(-1.1, -1.1, -1.1, 1.1, 1.1, 1.1), 0.2);
  REQUIRE(lattice.spacing() == 2 * fine.spacing());
  REQUIRE(lattice.origin() == fine.origin());
  Hierarchy cells(cells_of(input, lattice));
  std::vector<Hierarchy::Index> all;
  for(Hierarchy::Index c = 0; c < cells.number_of_cells(); ++c) all.push_back(c);
  cells = cells.refined(all);
  const Clipped a = BS::clip_mesh_to_cells<Tag>(input, cells),
                b = BS::clip_mesh_to_cells<Tag>(input, cells_of(input, fine));
  REQUIRE(a.number_of_pieces() == b.number_of_pieces());
  // Compare leaves with the same corner: they must have the same facets and areas.
  typedef std::pair<std::array<double, 3>, std::uint32_t> Key;
  std::map<Key, double> areas;
  const Root_cells fine_cells = cells_of(input, fine);
  for(const Clipped::Piece& piece : b.pieces()) areas[Key(fine_cells.corner(piece.cell), piece.facet)] = b.area(piece);
  std::size_t wrong = 0;
  for(const Clipped::Piece& piece : a.pieces()) {
    const auto found = areas.find(Key(cells.corner(piece.cell), piece.facet));
    wrong += found == areas.end() || std::abs(found->second - a.area(piece)) > 1e-15;
  }
  CHECK(wrong == 0);
}

TEST_CASE("Clipped mesh: cells that are only touched get no piece")
{
  // The planes at multiples of 1/4 divide the facet in x + y + z = 1 into 16 triangles, all with corners at lattice
  // points.
  const BS::Input_mesh_3 input = input_of(octahedron(1), false);
  const Clipped clipped = BS::clip_mesh_to_cells<Tag>(input, cells_of(input, quarters));
  CHECK(clipped.number_of_pieces() == 8 * 16);
  for(const Clipped::Piece& piece : clipped.pieces()) {
    CHECK(piece.size == 3);
    CHECK(clipped.area(piece) == Approx(std::sqrt(3.) / 2 / 16).epsilon(1e-14));
  }
}

TEST_CASE("Clipped mesh: the result does not depend on the number of threads")
{
  const BS::Input_mesh_3 input = input_of(sphere(3), false); // enough for several chunks of facets
  const auto check = [&](const auto& cells) {
    CHECK(number_of_differences(BS::clip_mesh_to_cells<Tag>(input, cells),
                                BS::clip_mesh_to_cells<CGAL::Parallel_if_available_tag>(input, cells))
          == 0);
  };
  const Root_cells roots = cells_of(input, BS::Lattice_3(input.bbox(), 0.13));
  check(roots);
  check(refined_at_mesh(input, roots, 10, 3));
}

TEST_CASE("Clipped mesh: the number of pieces is estimated within a factor of two")
{
  // For random positions, the expected number of pieces of a facet with unit normal n is 1 + (sum of its widths) +
  // |n|_1 area, in cell units. The sum of the widths is estimated by half the perimeter, its lower bound; its upper
  // bound is sqrt(3)/2 of the perimeter.
  const BS::Input_mesh_3 input = input_of(sphere(2), false);
  for(double spacing : { 0.03, 0.1, 0.3, 1. }) {
    const BS::Lattice_3 lattice(CGAL::Bbox_3(-1.003, -1.013, -1.027, 1, 1, 1), spacing);
    const double pieces = double(BS::clip_mesh_to_cells<Tag>(input, cells_of(input, lattice)).number_of_pieces());
    const double estimate = Clipped::estimated_number_of_pieces(input, lattice.spacing());
    CAPTURE(spacing);
    CHECK(estimate >= 0.95 * pieces);
    CHECK(estimate <= 2 * pieces);
  }
}
} // namespace test_clip_mesh_to_cells
