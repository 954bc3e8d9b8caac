// Shell_projection_3.h, Shell_map_3.h: between certified meshes in a certified shell, no point is lost, and the way
// there and back ends at the start. A search through all facets finds the same images.
#include "meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Random.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace test_shell_round_trips {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
typedef CGAL::Certified_bspline_shell_3 Shell;
typedef BS::Shell_map_3<Shell, Mesh> Map;
typedef Map::Source_location Location;

Mesh triangulated(Mesh mesh)
{
  CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
  return mesh;
}

// Returns vertices, midpoints of edges, centroids, and random points.
std::vector<Location> locations(const Mesh& mesh, int random_ones)
{
  std::vector<Location> result;
  for(auto f : mesh.faces()) {
    for(int i = 0; i < 3; ++i) {
      Location corner(f, { 0, 0, 0 }), middle(f, { 0.5, 0.5, 0.5 });
      corner.second[i] = 1;
      middle.second[i] = 0;
      result.push_back(corner);
      result.push_back(middle);
    }
    result.push_back(Location(f, { 1 / 3., 1 / 3., 1 / 3. }));
  }
  CGAL::Random random(1);
  const std::vector<Mesh::Face_index> faces(mesh.faces_begin(), mesh.faces_end());
  for(int n = 0; n < random_ones; ++n) {
    double u = random.get_double(), v = random.get_double();
    if(u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    result.push_back(Location(faces[std::size_t(random.get_int(0, int(faces.size())))], { 1 - u - v, u, v }));
  }
  return result;
}

void check_round_trips(const Shell& shell, const Mesh& a, const Mesh& b)
{
  const Map map(shell, a, b);
  for(const Map& m : { map, map.inverse() }) {
    const std::vector<Location> starts = locations(m.source(), 3000);
    const auto images = m.project(starts);
    std::vector<Location> ends;
    std::size_t lost = 0;
    for(const auto& image : images) {
      lost += !image;
      ends.push_back(image.location);
    }
    REQUIRE(lost == 0);
    const auto back = m.inverse().project(ends);
    double farthest = 0;
    for(std::size_t n = 0; n < starts.size(); ++n) {
      if(!back[n]) ++lost;
      else {
        const auto p = m.point(starts[n]);
        farthest = (std::max)(farthest, distance(back[n].point, Point_3(p[0], p[1], p[2])));
      }
    }
    CHECK(lost == 0);
    CHECK(farthest <= 10 * map.to_target().tolerance());
  }
}

} // namespace

TEST_CASE("Round trips: on ten meshes, every point has an image and returns", "[slow]")
{
  for(const char* name : { "tetrahedron", "cube", "octahedron", "icosahedron", "cross", "tripod", "part", "ellipsoid",
                           "sphere", "eight" }) {
    INFO(name);
    const Mesh a = triangulated(demo_mesh(std::string(name) + ".off"));
    const Shell shell = CGAL::certified_bspline_shell_3(a, P::relative_thickness(0.02));
    REQUIRE(shell);
    REQUIRE(shell.is_certified());
    check_round_trips(shell, a, certified_mesh_in_shell(shell, a));
  }
}

TEST_CASE("Round trips: far from the origin, the default tolerance allows for the rounding of coordinates")
{
  for(double radius : { 6., 200. }) {
    const Mesh a = sphere(2, radius, Point_3(5e5, 5e6, 100));
    const Shell shell = CGAL::certified_bspline_shell_3(a, P::relative_thickness(0.05));
    REQUIRE(shell.is_certified());
    const double tolerance = Map(shell, a, a).to_target().tolerance();
    CHECK(tolerance >= 1e-9 * shell.report().unit);
    CHECK(tolerance > 200 * 1e-9); // at 5e6, a unit in the last place is 0.93e-9
    CHECK(tolerance <= 512 * 1e-9);
    check_round_trips(shell, a, certified_mesh_in_shell(shell, a));
  }
}

TEST_CASE("Round trips: points return between meshes without a common facet")
{
  const Mesh coarse = sphere(1);
  const Shell thick = CGAL::certified_bspline_shell_3(coarse, P::relative_thickness(0.1));
  REQUIRE(thick.is_certified());
  BS::Shell_certificate_3<Shell::Field, Shell::Threshold> certificate(thick);
  Mesh fine = sphere(3, 0.97);
  for(auto v : fine.vertices()) { // turned, so that no vertex is on an edge or at a vertex of the other mesh
    const Point_3 p = fine.point(v);
    fine.point(v) = Point_3(0.8 * p.x() - 0.6 * p.y(), 0.6 * p.x() + 0.8 * p.y(), p.z());
  }
  REQUIRE(certificate.verify(fine));
  check_round_trips(thick, coarse, fine);
}

TEST_CASE("Round trips: images are the only points where densely traced curves meet the target")
{
  const Mesh a = triangulated(demo_mesh("part.off"));
  const Shell shell = CGAL::certified_bspline_shell_3(a);
  REQUIRE(shell.is_certified());
  const Mesh b = certified_mesh_in_shell(shell, a);
  const Map map(shell, a, b);
  const BS::Gradient_flow_3<Shell> flow(shell, 1e-12 * shell.report().unit);
  const std::vector<Location> all = locations(a, 0);
  CGAL::Random random(9);
  int met = 0;
  for(int n = 0; n < 60; ++n) {
    const Location& location = all[std::size_t(random.get_int(0, int(all.size())))];
    const auto image = map(location);
    REQUIRE(image);
    const auto start = map.point(location);
    const double f = *shell.field().value(Point_3(start[0], start[1], start[2]));
    // Trace the curve within the shell.
    std::vector<std::pair<double, Point_3> > curve;
    constexpr int parts = 64;
    const double most = 2 * shell.thickness();
    for(int i = -parts; i <= parts; ++i) {
      const auto arrival = flow.trace(start, f + most * i / parts);
      if(arrival) curve.emplace_back(f + most * i / parts, arrival.point);
    }
    REQUIRE(curve.size() > parts / 4);
    // Find all changes of side, and keep those in facets, or nearly so.
    for(auto facet : b.faces()) {
      const std::array<Point_3, 3> t = corners(b, facet);
      const Point_3 &p = t[0], &q = t[1], &r = t[2];
      const Vector_3 normal = CGAL::cross_product(q - p, r - p);
      const auto height = [&](const Point_3& x) { return normal * (x - p); };
      for(std::size_t i = 1; i < curve.size(); ++i) {
        double low = curve[i - 1].first, high = curve[i].first;
        const bool below = height(curve[i - 1].second) < 0;
        if(below == (height(curve[i].second) < 0)) continue;
        Point_3 x = curve[i].second;
        for(int k = 0; k < 45; ++k) {
          const double middle = (low + high) / 2;
          const auto arrival = flow.trace(start, middle);
          REQUIRE(arrival);
          x = arrival.point;
          (((height(x) < 0) == below) ? low : high) = middle;
        }
        // in the facet, or within 1e-9 of the box
        const double far = -1e-9 * shell.report().unit * std::sqrt(normal.squared_length());
        const auto inside = [&](const Point_3& u, const Point_3& v) {
          return CGAL::cross_product(v - u, x - u) * normal >= far * std::sqrt((v - u).squared_length());
        };
        if(!inside(p, q) || !inside(q, r) || !inside(r, p)) continue;
        ++met;
        CHECK(below); // never from above
        // The allowance covers the tolerances of the image, the bisection and the edges. Curves do not meet facets at
        // small angles.
        CHECK(distance(x, image.point) <= 5e-9 * shell.report().unit);
      }
    }
  }
  CHECK(met >= 60); // more if edges are met
}
} // namespace test_shell_round_trips
