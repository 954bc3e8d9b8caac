// Shell_projection_3.h, Projection_target_3.h, project_points.h: images are where the curve meets the target, as found
// in other ways. Points without an image get a status with the reason.
#include "exact_vectors.h"
#include "polynomial_fields.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Projection/project_points.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <set>

namespace test_Shell_projection_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
using BS::Flow_status;
typedef CGAL::Bspline_shell_3<Field> Shell;
typedef BS::Shell_projection_3<Shell, Mesh> Projection;
typedef Projection::Image Image;

const double infinity = std::numeric_limits<double>::infinity();

template <typename Shell, typename TriangleMesh>
BS::Shell_projection_3<Shell, TriangleMesh> projection(const Shell& shell, const TriangleMesh& target,
                                                       double tolerance = 0)
{
  return BS::Shell_projection_3<Shell, TriangleMesh>(shell, target, BS::parameters::tolerance(tolerance));
}

// f = |x|^2; curves are the rays from the origin
const Shell& radial_shell()
{
  static const Shell shell = shell_of(uniform_field(squared_distance), 0.3, 0.9);
  return shell;
}

// f = z; curves are vertical
const Shell& slab()
{
  static const Shell shell = shell_of(uniform_field({ { 1, { 0, 0, 1 } } }), -0.9, 0.9);
  return shell;
}

// Returns the intersection of the ray from the origin through p with a star-shaped polyhedron, in exact arithmetic.
Point_3 hit_of_ray(const Mesh& mesh, const Point_3& p)
{
  const Exact_point d = exact(p);
  for(auto f : mesh.faces()) {
    const std::array<Point_3, 3> t = corners(mesh, f);
    const Exact_point a = exact(t[0]), b = exact(t[1]), c = exact(t[2]);
    if(dot(d, cross(a, b)) < 0 || dot(d, cross(b, c)) < 0 || dot(d, cross(c, a)) < 0) continue;
    const Exact_point n = cross(minus(b, a), minus(c, a));
    const Rational s = dot(n, a) / dot(n, d);
    return Point_3(CGAL::to_double(s * d[0]), CGAL::to_double(s * d[1]), CGAL::to_double(s * d[2]));
  }
  FAIL("the mesh has holes");
  return p;
}

// Checks that location, point and value of an image belong to the same point of the mesh.
template <typename Shell>
void check_consistent(const Shell& shell, const Mesh& mesh, const Image& image, double tolerance)
{
  REQUIRE(image.status == Flow_status::SUCCESS);
  double sum = 0;
  for(double w : image.location.second) {
    CHECK(w >= 0);
    sum += w;
  }
  CHECK(sum == Approx(1).epsilon(1e-15));
  CHECK(distance(CGAL::Polygon_mesh_processing::construct_point(image.location, mesh), image.point)
        <= 1e-15 * shell.report().unit);
  const double g = std::sqrt(shell.field().gradient(image.point)->squared_length());
  CHECK(std::abs(*shell.field().value(image.point) - image.value) <= 2 * tolerance * g);
}

// Returns random points in the radial shell.
std::vector<Point_3> random_points(int number, int seed = 1)
{
  CGAL::Random random(seed);
  std::vector<Point_3> points;
  while(int(points.size()) < number) {
    const Point_3 p(random.get_double(-1, 1), random.get_double(-1, 1), random.get_double(-1, 1));
    const double f = (p - CGAL::ORIGIN).squared_length();
    if(f > 0.3 && f < 0.9) points.push_back(p);
  }
  return points;
}

std::vector<Point_3> vertices_midpoints_and_centroids(const Mesh& mesh)
{
  std::vector<Point_3> points;
  for(auto v : mesh.vertices()) points.push_back(mesh.point(v));
  for(auto e : mesh.edges())
    points.push_back(CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  for(auto f : mesh.faces()) points.push_back(centroid(mesh, f));
  return points;
}

// Splits an edge at a new vertex, and the triangles beside it. Returns the halfedge to the new vertex.
Mesh::Halfedge_index split(Mesh& mesh, Mesh::Halfedge_index h, const Point_3& p)
{
  const auto to_new = CGAL::Euler::split_edge(h, mesh);
  mesh.point(mesh.target(to_new)) = p;
  for(auto g : { to_new, mesh.prev(mesh.opposite(to_new)) }) CGAL::Euler::split_face(g, mesh.next(mesh.next(g)), mesh);
  return to_new;
}

// Returns an icosahedron with a very short edge in the middle of each edge that crosses an axis, and needles on both
// sides. Coordinates close to zero permit this. Corefinement creates such edges if a vertex of one mesh is almost on an
// edge of the other.
Mesh icosahedron_with_needles(double length)
{
  Mesh mesh = sphere(0, 0.9);
  const std::vector<Mesh::Edge_index> edges(mesh.edges_begin(), mesh.edges_end());
  for(auto e : edges) {
    const auto h = mesh.halfedge(e);
    const Point_3 p = mesh.point(mesh.source(h)), q = mesh.point(mesh.target(h)), m = CGAL::midpoint(p, q);
    if((m.x() == 0) + (m.y() == 0) + (m.z() == 0) != 2) continue;
    split(mesh, h, m);
    // The second vertex is off the edge, so that differences to other vertices are rounded.
    const Vector_3 along = (q - p) / distance(p, q),
                   across = CGAL::cross_product(m - CGAL::ORIGIN, along) / distance(m, CGAL::ORIGIN);
    split(mesh, h, m + length * (0.8 * along + 0.6 * across));
  }
  return mesh;
}

// Returns whether two images are equal.
template <typename Image>
bool same(const Image& a, const Image& b)
{
  return a.status == b.status && (!a || (a.point == b.point && a.value == b.value && a.location == b.location));
}

} // namespace

TEST_CASE("Projection: in a shell between spheres, images on a polyhedron are where exact rays meet it")
{
  const Mesh mesh = sphere(1, 0.85);
  for(double tolerance : { 0., 1e-6, 1e-12 }) {
    const Projection project = projection(radial_shell(), mesh, tolerance);
    if(tolerance == 0) CHECK(project.tolerance() == 2e-9); // 1e-9 of the box
    else CHECK(project.tolerance() == tolerance);
    std::vector<Point_3> points = random_points(300);
    // also points on rays through vertices, edges and facets of the target, exactly or nearly
    for(const Point_3& p : vertices_midpoints_and_centroids(mesh)) {
      points.push_back(p);
      points.push_back(CGAL::ORIGIN + 0.75 * (p - CGAL::ORIGIN));
      points.push_back(CGAL::ORIGIN + 1.0625 * (p - CGAL::ORIGIN));
    }
    for(const Point_3& p : points) {
      const Image image = project(p);
      INFO(p << ", tolerance " << tolerance);
      check_consistent(radial_shell(), mesh, image, project.tolerance());
      CHECK(distance(image.point, hit_of_ray(mesh, p)) <= project.tolerance());
    }
  }
}

TEST_CASE("Projection: points on the thresholds have images")
{
  const Mesh mesh = sphere(1, 0.85);
  const Projection project = projection(radial_shell(), mesh);
  for(const Point_3& p : random_points(200, 2))
    for(double level : { 0.3, 0.9 }) {
      const Vector_3 d = p - CGAL::ORIGIN;
      const Point_3 q = CGAL::ORIGIN + std::sqrt(level / d.squared_length()) * d;
      const Image image = project(q);
      REQUIRE(image.status == Flow_status::SUCCESS);
      // The points are up to two cells away; see the tests of the flow.
      CHECK(distance(image.point, hit_of_ray(mesh, q)) <= 2 * project.tolerance());
    }
  // Here, values are exact, and the target is on a threshold.
  const Mesh top = sheet({ -0.5, 0, 0.5 }, { -0.5, 0, 0.5 }, 0.875);
  const Shell exact_slab = shell_of(uniform_field({ { 1, { 0, 0, 1 } } }), -0.75, 0.875);
  for(const Point_3& p :
      { Point_3(0, 0, -0.75), Point_3(0.25, 0.3, -0.75), Point_3(-0.5, 0.5, -0.75), Point_3(0.1, 0.2, 0.875) }) {
    const Image image = projection(exact_slab, top)(p);
    REQUIRE(image.status == Flow_status::SUCCESS);
    CHECK(distance(image.point, Point_3(p.x(), p.y(), 0.875)) < 1e-13);
  }
}

TEST_CASE("Projection: a mesh is mapped to itself by the identity")
{
  for(const Mesh& mesh : { sphere(0, 0.9), sphere(2, 0.8), box(Point_3(-0.5, -0.5, -0.5), Point_3(0.5, 0.5, 0.5)) }) {
    const Projection project = projection(radial_shell(), mesh);
    std::size_t n = 0;
    for(const Point_3& p : vertices_midpoints_and_centroids(mesh)) {
      if((p - CGAL::ORIGIN).squared_length() <= 0.3) continue; // outside the shell, on the box's sides
      const Image image = project(p);
      check_consistent(radial_shell(), mesh, image, project.tolerance());
      CHECK(distance(image.point, p) <= 1e-14);
      ++n;
    }
    CHECK(n > 20);
    for(auto f : mesh.faces()) {
      const Point_3 c = centroid(mesh, f);
      if((c - CGAL::ORIGIN).squared_length() > 0.3) CHECK(project(c).location.first == f);
      for(auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
        // At a vertex, the image may be in any of its facets.
        const auto found = mesh.vertices_around_face(mesh.halfedge(project(mesh.point(mesh.target(h))).location.first));
        CHECK(std::count(found.begin(), found.end(), mesh.target(h)) == 1);
      }
    }
  }
}

TEST_CASE("Projection: needles, caps and facets of very different sizes are valid targets")
{
  // Steps in x begin at 1e-7; there are rows of needles.
  const std::vector<double> xs = { -0.8, -0.5, -0.5 + 1e-7, -0.5 + 3e-7, -0.1, 0, 1e-6, 1e-4, 0.01, 0.8 },
                            ys = { -0.8, -1e-7, 0, 0.3, 0.8 };
  const auto plane = [](double x, double y) { return 0.25 * x - 0.5 * y + 0.0625; };
  Mesh mesh = sheet(xs, ys, plane);
  // Caps: a point is added next to the middle of an edge, on either side of it.
  std::vector<Mesh::Face_index> facets(mesh.faces_begin(), mesh.faces_end());
  for(std::size_t n = 0; n < facets.size(); n += 3) {
    const std::array<Point_3, 3> t = corners(mesh, facets[n]);
    // Caps of needles would be as thin as the last digits of coordinates.
    if(CGAL::squared_area(t[0], t[1], t[2]) < 1e-8) continue;
    const Point_3 p = CGAL::barycenter(t[0], 0.5, t[1], 0.5 - 1e-9, t[2], 1e-9);
    const auto h = CGAL::Euler::add_center_vertex(mesh.halfedge(facets[n]), mesh);
    mesh.point(mesh.target(h)) = Point_3(p.x(), p.y(), plane(p.x(), p.y()));
  }
  REQUIRE(CGAL::is_triangle_mesh(mesh));
  const Projection project = projection(slab(), mesh);
  CGAL::Random random(4);
  for(int n = 0; n < 2000; ++n) {
    double x = random.get_double(-0.79, 0.79), y = random.get_double(-0.79, 0.79);
    if(n % 4 == 1) x = -0.5 + random.get_double(-1e-7, 4e-7);
    if(n % 4 == 2) x = xs[std::size_t(random.get_int(1, int(xs.size()) - 1))];
    if(n % 8 == 3) x = random.get_double(-1e-6, 1e-5);
    if(n % 3 == 1) y = ys[std::size_t(random.get_int(1, int(ys.size()) - 1))];
    if(n % 3 == 2) y = random.get_double(-2e-7, 1e-7);
    const Image image = project(Point_3(x, y, random.get_double(-0.85, 0.85)));
    INFO(x << " " << y);
    REQUIRE(image.status == Flow_status::SUCCESS);
    CHECK(distance(image.point, Point_3(x, y, plane(x, y))) <= project.tolerance());
  }
  // Inner vertices are their own images.
  for(auto v : mesh.vertices())
    if(!mesh.is_border(v)) CHECK(distance(project(mesh.point(v)).point, mesh.point(v)) <= project.tolerance());
}

TEST_CASE("Projection: the image is on the sheet that the curve meets, not on the closest one")
{
  // f = z^2 increases away from the plane z = 0, so the shell has two parts.
  const Shell shell = shell_of(uniform_field({ { 1, { 0, 0, 2 } } }), 0.01, 0.8);
  const std::vector<double> grid = { -0.5, 0.1, 0.5 };
  for(bool lower_faces_down : { true, false }) {
    const Mesh lower = sheet(grid, grid, -0.2),
               mesh = joined(lower_faces_down ? reversed(lower) : lower, sheet(grid, grid, 0.5));
    const Projection project = projection(shell, mesh);
    for(double z : { 0.11, 0.14, 0.85 }) {
      const Image image = project(Point_3(0.2, 0.3, z));
      REQUIRE(image.status == Flow_status::SUCCESS);
      CHECK(distance(image.point, Point_3(0.2, 0.3, 0.5)) <= project.tolerance());
    }
    const Image below = project(Point_3(0.2, 0.3, -0.3));
    CHECK(below.status == (lower_faces_down ? Flow_status::SUCCESS : Flow_status::WRONG_ORIENTATION));
    CHECK(project(Point_3(0.2, 0.3, 0.01)).status == Flow_status::STARTS_OUTSIDE);
    CHECK(project(Point_3(0.2, 0.3, 0)).status == Flow_status::STARTS_OUTSIDE); // no curve starts here
  }
}

TEST_CASE("Projection: a point without an image has a status, and no other data")
{
  const Point_3 p(0.1, 0.2, 0.8);
  const auto check = [](const Image& image, Flow_status status) {
    CHECK(image.status == status);
    CHECK_FALSE(image);
    CHECK(image.location.first == Mesh::null_face());
    CHECK(image.value == 0);
  };
  const Mesh good = sphere(1, 0.85);
  const Projection project = projection(radial_shell(), good);
  CHECK(project(p));
  check(project(Point_3(0, 0, 0)), Flow_status::STARTS_OUTSIDE);
  check(project(Point_3(0.1, 0.1, 0.1)), Flow_status::STARTS_OUTSIDE);
  check(project(Point_3(0.9, 0.9, 0.9)), Flow_status::STARTS_OUTSIDE);
  check(project(Point_3(1e9, 0, 0)), Flow_status::STARTS_OUTSIDE);
  check(project(Point_3(0.1, std::numeric_limits<double>::quiet_NaN(), 0)), Flow_status::NOT_FINITE);
  check(project(Point_3(0.1, infinity, 0)), Flow_status::NOT_FINITE);

  // The target is outside the shell, on either side.
  for(double radius : { 0.3, 1.5 }) check(projection(radial_shell(), sphere(1, radius))(p), Flow_status::LEAVES_SHELL);

  const Mesh turned = reversed(good);
  for(const Point_3& q : random_points(50))
    check(projection(radial_shell(), turned)(q), Flow_status::WRONG_ORIENTATION);

  const Mesh empty;
  CHECK(projection(radial_shell(), empty).target().is_valid());
  check(projection(radial_shell(), empty)(p), Flow_status::LEAVES_SHELL);

  Mesh polygons = box(Point_3(-0.5, -0.5, -0.5), Point_3(0.5, 0.5, 0.5), false);
  CHECK_FALSE(projection(radial_shell(), polygons).target().is_valid());
  check(projection(radial_shell(), polygons)(p), Flow_status::INVALID_MESH);
  check(projection(radial_shell(), polygons)(Point_3(0, 0, 0)), Flow_status::INVALID_MESH);

  for(double bad : { infinity, std::numeric_limits<double>::quiet_NaN() }) {
    Mesh mesh = good;
    mesh.point(Mesh::Vertex_index(7)) = Point_3(0, bad, 0);
    check(projection(radial_shell(), mesh)(p), Flow_status::INVALID_MESH);
    // A vertex without facets is irrelevant.
    Mesh with_vertex = good;
    with_vertex.add_vertex(Point_3(0, bad, 0));
    CHECK(projection(radial_shell(), with_vertex)(p));
  }
}

TEST_CASE("Projection: curves leave the shell through holes, and not beside them")
{
  Mesh mesh = sphere(1, 0.85);
  std::vector<Point_3> removed;
  std::set<Mesh::Face_index> holes;
  for(std::size_t n : { 0, 7, 33, 60 }) holes.insert(Mesh::Face_index(Mesh::size_type(n)));
  const Mesh closed = mesh;
  for(auto f : holes) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  REQUIRE(mesh.has_garbage());
  const Projection project = projection(radial_shell(), mesh), to_closed = projection(radial_shell(), closed);
  std::size_t lost = 0;
  for(const Point_3& p : random_points(3000)) {
    const Image image = project(p), whole = to_closed(p);
    if(holes.count(whole.location.first)) {
      CHECK(image.status == Flow_status::LEAVES_SHELL);
      ++lost;
    } else CHECK(same(image, whole));
  }
  CHECK(lost > 50);
  // A degenerate facet is not met, whichever way it might face.
  const auto h = std::find_if(mesh.halfedges_begin(), mesh.halfedges_end(), [&](auto e) { return mesh.is_border(e); });
  const std::array<Point_3, 3> t = corners(closed, Mesh::Face_index(0));
  const auto a = mesh.add_vertex(t[0]), b = mesh.add_vertex(CGAL::midpoint(t[1], t[2])),
             c = mesh.add_vertex(CGAL::midpoint(t[0], CGAL::midpoint(t[1], t[2])));
  mesh.add_face(a, b, c);
  REQUIRE(h != mesh.halfedges_end());
  CHECK(projection(radial_shell(), mesh)(CGAL::centroid(t[0], t[1], t[2])).status == Flow_status::LEAVES_SHELL);
}

TEST_CASE("Projection: images do not depend on the number of threads, bit for bit")
{
  const Mesh mesh = sphere(2, 0.85);
  std::vector<Point_3> points = random_points(40000);
  points[3] = Point_3(0, 0, 0); // has no image
  const Projection project = projection(radial_shell(), mesh);
  const std::vector<Image> one = project.project<CGAL::Sequential_tag>(points),
                           several = project.project<CGAL::Parallel_tag>(points),
                           by_function = BS::project_points<CGAL::Parallel_tag>(radial_shell(), points, mesh);
  REQUIRE(one.size() == points.size());
  REQUIRE(several.size() == points.size());
  REQUIRE(by_function.size() == points.size());
  bool equal = true;
  for(std::size_t n = 0; n < points.size(); ++n)
    equal = equal && same(one[n], several[n]) && same(one[n], by_function[n]);
  CHECK(equal);
  // Up to the tolerance, each image is that of the single point.
  for(std::size_t n : { 0, 12345, 39999 })
    CHECK(distance(one[n].point, project(points[n]).point) <= 2 * project.tolerance());
  CHECK(same(one[3], project(points[3])));
  CHECK(one[3].status == Flow_status::STARTS_OUTSIDE);
  CHECK(BS::project_points(radial_shell(), std::vector<Point_3>(), mesh).empty());
  // A larger tolerance is passed on.
  const auto loose = BS::project_points(radial_shell(), points, mesh, P::tolerance(1e-3));
  CHECK_FALSE(same(loose[0], one[0]));
  CHECK(distance(loose[0].point, projection(radial_shell(), mesh, 1e-3)(points[0]).point) <= 2e-3);
}

TEST_CASE("Projection: the start of the search affects the image by no more than the tolerance")
{
  const Mesh mesh = sphere(3, 0.85);
  const Projection project = projection(radial_shell(), mesh);
  const std::size_t facets = mesh.number_of_faces();
  CGAL::Random random(3);
  std::size_t near = 0;
  for(const Point_3& p : random_points(2000)) {
    const Image reference = project(p);
    REQUIRE(reference.status == Flow_status::SUCCESS);
    Projection::Hint hint;
    hint.facet = Projection::Target::Index(random.get_int(0, int(facets))); // usually far away
    const Image image = project(p, hint);
    check_consistent(radial_shell(), mesh, image, project.tolerance());
    CHECK(distance(image.point, reference.point) <= 2 * project.tolerance());
    CHECK(project.target().face_of(hint.facet) == image.location.first);
    // The search begins at a neighbor.
    hint.facet = project.target().traced_facets().neighbor(hint.facet, 0);
    const Image from_neighbor = project(p, hint);
    CHECK(distance(from_neighbor.point, reference.point) <= 2 * project.tolerance());
    near += from_neighbor.location.first == reference.location.first;
  }
  CHECK(near > 1990);

  // f = z^2; each curve meets only the sheet on its side of the plane
  const Shell shell = shell_of(uniform_field({ { 1, { 0, 0, 2 } } }), 0.01, 0.8);
  const std::vector<double> grid = { -0.5, 0.1, 0.5 };
  const Mesh lower = reversed(sheet(grid, grid, -0.2)), sheets = joined(lower, sheet(grid, grid, 0.5));
  const std::size_t of_lower = lower.number_of_faces();
  const Projection to_sheets = projection(shell, sheets);
  for(double z : { 0.11, 0.85, -0.11, -0.3 })
    for(std::size_t f = 0; f < 2 * of_lower; ++f) {
      Projection::Hint hint;
      hint.facet = Projection::Target::Index(f);
      const Image image = to_sheets(Point_3(0.2, 0.3, z), hint);
      REQUIRE(image.status == Flow_status::SUCCESS);
      CHECK(distance(image.point, Point_3(0.2, 0.3, z > 0 ? 0.5 : -0.2)) <= to_sheets.tolerance());
    }
  // hints beyond the target's facets
  for(Projection::Target::Index f : { Projection::Target::Index(2 * of_lower), Projection::Target::npos - 1 }) {
    Projection::Hint beyond;
    beyond.facet = f;
    CHECK(distance(to_sheets(Point_3(0.2, 0.3, 0.11), beyond).point, Point_3(0.2, 0.3, 0.5)) <= to_sheets.tolerance());
    CHECK(beyond.facet < 2 * of_lower);
  }
  // A point without an image does not change the hint.
  Projection::Hint hint;
  hint.facet = 1;
  CHECK(to_sheets(Point_3(0.2, 0.3, 0.01), hint).status == Flow_status::STARTS_OUTSIDE);
  CHECK(hint.facet == 1);
}

TEST_CASE("Projection: a walk over edges finds the same facet on a line as the tree, or none")
{
  const Mesh mesh = sphere(3, 0.85);
  const Projection project = projection(radial_shell(), mesh);
  const BS::Projection_facets_3& facets = project.target().traced_facets();
  typedef BS::Projection_facets_3::Index Index;
  constexpr Index npos = BS::Projection_facets_3::npos;
  for(const Point_3& point : random_points(200)) {
    const std::array<double, 3> p = { point.x(), point.y(), point.z() };
    const Index found = facets.facet_on_line(p, p, -1, 1, 0); // along the ray from the center
    REQUIRE(found != npos);
    CHECK(facets.facet_on_line_near(found, p, p, -1, 1) == found);
    for(int i = 0; i < 3; ++i) {
      const Index neighbor = facets.neighbor(found, i);
      CHECK(facets.facet_on_line_near(neighbor, p, p, -1, 1) == found);
      for(int j = 0; j < 3; ++j) CHECK(facets.facet_on_line_near(facets.neighbor(neighbor, j), p, p, -1, 1) == found);
    }
    // The facet is beyond either end of the segment, or faces the other way.
    const double s = -facets.height(found, p)
                     / CGAL::to_double(
                       dot(exact(Point_3(facets.normal(found)[0], facets.normal(found)[1], facets.normal(found)[2])),
                           exact(point)));
    CHECK(facets.facet_on_line_near(found, p, p, s + 1e-6, 1) == npos);
    CHECK(facets.facet_on_line_near(found, p, p, -1, s - 1e-6) == npos);
    CHECK(facets.facet_on_line_near(found, p, { -p[0], -p[1], -p[2] }, -1, 1) == npos);
  }
  // One walk is short, one has too many moves, and one crosses a border.
  const std::vector<double> grid = { -0.9, -0.8, -0.7, -0.6, -0.5, -0.4, -0.3, -0.2, -0.1, 0,
                                     0.1,  0.2,  0.3,  0.4,  0.5,  0.6,  0.7,  0.8,  0.9 };
  const Mesh plane = sheet(grid, grid);
  const auto to_plane = projection(slab(), plane);
  const BS::Projection_facets_3& of_plane = to_plane.target().traced_facets();
  const auto at = [&](double x, double y) { return of_plane.facet_on_line({ x, y, 0.5 }, { 0, 0, 1 }, -1, 1, 0); };
  CHECK(of_plane.facet_on_line_near(at(-0.33, 0.52), { -0.21, 0.52, 0.5 }, { 0, 0, 1 }, -1, 1) == at(-0.21, 0.52));
  CHECK(of_plane.facet_on_line_near(at(-0.88, 0.52), { 0.88, 0.52, 0.5 }, { 0, 0, 1 }, -1, 1) == npos);
  CHECK(of_plane.facet_on_line_near(at(-0.88, 0.52), { -0.95, 0.52, 0.5 }, { 0, 0, 1 }, -1, 1) == npos);
}

TEST_CASE("Projection: a visitor is called with the progress, and can stop it")
{
  struct Visitor
  {
    std::vector<std::pair<std::size_t, std::size_t> > calls;
    std::size_t stop = std::size_t(-1); // stops once this many points are done
    bool advance(std::size_t done, std::size_t total)
    {
      calls.emplace_back(done, total);
      return done < stop;
    }
  };
  const Mesh mesh = sphere(1, 0.85);
  const std::vector<Point_3> points = random_points(50000);
  Visitor visitor;
  const auto images = BS::project_points<CGAL::Sequential_tag>(radial_shell(), points, mesh,
                                                               P::visitor(std::ref(visitor)));
  REQUIRE(visitor.calls.size() > 1);
  for(std::size_t n = 0; n < visitor.calls.size(); ++n) {
    CHECK(visitor.calls[n].second == points.size());
    if(n > 0) CHECK(visitor.calls[n].first > visitor.calls[n - 1].first);
  }
  CHECK(visitor.calls.back().first == points.size());

  Visitor stopping;
  stopping.stop = 1;
  const auto some = BS::project_points<CGAL::Parallel_tag>(radial_shell(), points, mesh,
                                                           P::visitor(std::ref(stopping)));
  REQUIRE(some.size() == points.size());
  REQUIRE(stopping.calls.size() == 1);
  const std::size_t done = stopping.calls[0].first;
  CHECK(done < points.size());
  // The order of points is unspecified.
  std::size_t canceled = 0;
  bool equal = true;
  for(std::size_t n = 0; n < points.size(); ++n)
    if(some[n].status == Flow_status::CANCELED) ++canceled;
    else equal = equal && same(some[n], images[n]);
  CHECK(equal);
  CHECK(canceled == points.size() - done);
}

TEST_CASE("Projection: targets may be Polyhedron_3, or have removed elements, other points, or points stored elsewhere")
{
  const Mesh mesh = sphere(1, 0.85);
  const std::vector<Point_3> points = random_points(500);
  const std::vector<Image> expected = BS::project_points(radial_shell(), points, mesh);

  typedef CGAL::Polyhedron_3<Kernel> Polyhedron;
  Polyhedron polyhedron;
  CGAL::copy_face_graph(mesh, polyhedron);
  const auto on_polyhedron = BS::project_points(radial_shell(), points, polyhedron);
  Mesh garbage = mesh;
  CGAL::copy_face_graph(sphere(1, 0.7), garbage);
  for(std::size_t n = 0; n < mesh.number_of_faces(); ++n) // only the second sphere remains
    CGAL::Euler::remove_face(garbage.halfedge(Mesh::Face_index(Mesh::size_type(n))), garbage);
  for(auto v : garbage.vertices()) {
    const Vector_3 d = garbage.point(v) - CGAL::ORIGIN;
    garbage.point(v) = CGAL::ORIGIN + 0.85 / std::sqrt(d.squared_length()) * d;
  }
  REQUIRE(garbage.has_garbage());
  const auto on_garbage = BS::project_points(radial_shell(), points, garbage);
  // Points are stored outside the mesh, with coordinates of another type.
  Mesh nowhere = mesh;
  auto elsewhere = nowhere.add_property_map<Mesh::Vertex_index, CGAL::Simple_cartesian<float>::Point_3>("v:elsewhere")
                     .first;
  for(auto v : nowhere.vertices()) {
    const Point_3 q = nowhere.point(v);
    elsewhere[v] = CGAL::Simple_cartesian<float>::Point_3(float(q.x()), float(q.y()), float(q.z()));
    nowhere.point(v) = Point_3(0, 0, 0);
  }
  const auto on_floats = BS::project_points(radial_shell(), points, nowhere, P::vertex_point_map(elsewhere));
  std::vector<std::array<double, 3> > arrays;
  for(const Point_3& p : points) arrays.push_back({ p.x(), p.y(), p.z() });
  const auto of_arrays = BS::project_points(radial_shell(), arrays, mesh);

  const double tolerance = 2e-9;
  for(std::size_t n = 0; n < points.size(); ++n) {
    REQUIRE(expected[n]);
    REQUIRE(on_polyhedron[n]);
    REQUIRE(on_garbage[n]);
    REQUIRE(on_floats[n]);
    CHECK(distance(on_polyhedron[n].point, expected[n].point) <= 2 * tolerance);
    CHECK(distance(CGAL::Polygon_mesh_processing::construct_point(on_polyhedron[n].location, polyhedron),
                   on_polyhedron[n].point)
          < 1e-14);
    CHECK(distance(on_garbage[n].point, expected[n].point) <= 2 * tolerance);
    CHECK_FALSE(garbage.is_removed(on_garbage[n].location.first));
    CHECK(distance(on_floats[n].point, expected[n].point) <= 1e-6); // the precision of floats
    CHECK(same(of_arrays[n], expected[n]));
  }
}

TEST_CASE("Projection: facets thinner than rounding may have no images, but never wrong ones")
{
  // Heights go down to 1e-18: vertices are rounded, and facets may face any direction.
  CGAL::Random random(8);
  std::vector<double> xs = { -0.8, 0.8 }, ys = { -0.8, 0.8 };
  for(int n = 0; n < 12; ++n) xs.push_back(0.3 + std::pow(10., -n - 6));
  std::sort(xs.begin(), xs.end());
  xs.erase(std::unique(xs.begin(), xs.end()), xs.end());
  const auto plane = [](double x, double y) { return 0.3 * x - 0.7 * y + 0.1; };
  Mesh mesh = sheet(xs, ys, plane);
  const std::vector<Mesh::Face_index> facets(mesh.faces_begin(), mesh.faces_end());
  for(auto f : facets) {
    const std::array<Point_3, 3> t = corners(mesh, f);
    const auto h = CGAL::Euler::add_center_vertex(mesh.halfedge(f), mesh);
    mesh.point(mesh.target(h)) = CGAL::barycenter(t[0], 0.4, t[1], 0.6 - 1e-7, t[2], 1e-7);
  }
  const Projection project = projection(slab(), mesh);
  std::size_t found = 0;
  for(int n = 0; n < 1000; ++n) {
    const double x = n % 2 ? 0.3 + std::pow(10., random.get_double(-18, -5)) : random.get_double(-0.79, 0.79),
                 y = random.get_double(-0.79, 0.79);
    const Image image = project(Point_3(x, y, random.get_double(-0.85, 0.85)));
    found += bool(image);
    if(image) CHECK(distance(image.point, Point_3(x, y, plane(x, y))) <= project.tolerance());
  }
  CHECK(found > 900);
}

TEST_CASE("Projection: points on needles, next to edges shorter than rounding, have images")
{
  for(double length : { 1e-15, 3.8e-17, 1e-20 }) {
    const Mesh mesh = icosahedron_with_needles(length);
    REQUIRE(mesh.number_of_vertices() == 12 + 12);
    REQUIRE(CGAL::is_triangle_mesh(mesh));
    const Projection project = projection(radial_shell(), mesh);
    std::size_t lost = 0;
    for(const Point_3& p : vertices_midpoints_and_centroids(mesh)) {
      INFO(p << ", edges of " << length);
      for(const Vector_3& aside :
          { Vector_3(0, 0, 0), Vector_3(1e-17, 0, 0), Vector_3(0, -1e-17, 0), Vector_3(0, 0, 1e-17) }) {
        const Image image = project(p + aside);
        lost += !image;
        CHECK(distance(image.point, p) <= 1e-15);
      }
      for(double factor : { 0.85, 1.03 }) {
        const Point_3 q = CGAL::ORIGIN + factor * (p - CGAL::ORIGIN);
        const Image image = project(q);
        lost += !image;
        CHECK(distance(image.point, hit_of_ray(mesh, q)) <= project.tolerance());
      }
    }
    CHECK(lost == 0);
  }
}

TEST_CASE("Projection: a point of a facet is located correctly, however thin the facet")
{
  CGAL::Random random(12);
  const auto coordinate = [&]() { return random.get_double(-1, 1); };
  for(int n = 0; n < 2000; ++n) {
    // Two vertices are close to the origin, where coordinates have enough digits for their difference.
    const double length = std::pow(10., random.get_double(-30, 0)), t = random.get_double(0, 1),
                 u = random.get_double(0, 1 - t);
    const Point_3 p(length * coordinate(), length * coordinate(), length * coordinate()),
      r(coordinate(), coordinate(), coordinate()),
      q(length * coordinate(), length * coordinate(), length * coordinate());
    Mesh mesh;
    mesh.add_face(mesh.add_vertex(p), mesh.add_vertex(q), mesh.add_vertex(r));
    const BS::Projection_target_3<Mesh> target(mesh, mesh.points());
    const Point_3 x = CGAL::barycenter(p, t, q, u, r, 1 - t - u);
    const auto position = target.position(0, { x.x(), x.y(), x.z() });
    const auto found = target.point(0, position.nearest);
    INFO("the shortest edge is about " << length << " long");
    CHECK(distance(Point_3(found[0], found[1], found[2]), x) <= 1e-15);
  }
}

TEST_CASE("Projection: the differential agrees with finite differences within a facet")
{
  // The curves are not straight.
  const Shell shell = shell_of(uniform_field({ { 1, { 2, 0, 0 } }, { -1, { 0, 2, 0 } }, { 1, { 0, 0, 1 } } }), -0.9,
                               0.9);
  const Mesh mesh = sheet({ -0.6, -0.2, 0.1, 0.6 }, { -0.6, 0, 0.3, 0.6 },
                          [](double x, double y) { return 0.2 * x + 0.1 * y * y; });
  const Projection project = projection(shell, mesh, 1e-13);
  CGAL::Random random(6);
  int checked = 0;
  for(int n = 0; n < 200; ++n) {
    const Point_3 p(random.get_double(-0.4, 0.4), random.get_double(-0.4, 0.4), random.get_double(-0.2, 0.2));
    const Image image = project(p);
    if(!image) continue;
    const BS::Flow_differential d = project.differential(p, image);
    REQUIRE(d);
    const auto& normal = project.target().normal(project.target().facet_of(image.location.first));
    const Eigen::Matrix3d onto = d.onto_plane({ normal[0], normal[1], normal[2] });
    const double h = 1e-4;
    for(int a = 0; a < 3; ++a) {
      const Vector_3 step(a == 0 ? h : 0, a == 1 ? h : 0, a == 2 ? h : 0);
      const Image up = project(p + step), down = project(p - step);
      if(!up || !down || up.location.first != image.location.first || down.location.first != image.location.first)
        continue;
      const Vector_3 difference = (up.point - down.point) / (2 * h);
      const Eigen::Vector3d column(difference.x(), difference.y(), difference.z());
      CHECK((column - onto.col(a)).norm() < 1e-6); // h^2 times third derivatives of a few tens, plus 1e-13 / h
      ++checked;
    }
  }
  CHECK(checked > 300);
}
} // namespace test_Shell_projection_3
