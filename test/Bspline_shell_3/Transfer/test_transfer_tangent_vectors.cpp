// transfer_tangent_vectors.h between meshes of different resolution: means and interpolation are correct, and
// singularities keep their places.
#include "flat_and_round_maps.h"

#include <CGAL/Bspline_shell_3/Transfer/transfer_tangent_vectors.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace test_transfer_tangent_vectors {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
typedef Polynomial_map Map;
typedef Mesh::Vertex_index Vertex;
typedef Mesh::Face_index Face;
typedef std::function<Vector_3(const Point_3&)> Field;

Mesh::Property_map<Face, Vector_3> at_facets(Mesh& mesh, const std::string& name)
{
  return mesh.add_property_map<Face, Vector_3>("f:" + name).first;
}
Mesh::Property_map<Vertex, Vector_3> at_vertices(Mesh& mesh, const std::string& name)
{
  return mesh.add_property_map<Vertex, Vector_3>("v:" + name).first;
}

Vector_3 in_plane(const Vector_3& v, const Vector_3& normal)
{
  return v - (v * normal) / normal.squared_length() * normal;
}

// Returns the field at centroids.
Mesh::Property_map<Face, Vector_3> sampled(Mesh& mesh, const Field& field, const std::string& name)
{
  auto result = at_facets(mesh, name);
  for(Face f : mesh.faces()) result[f] = in_plane(field(centroid(mesh, f)), normal(mesh, f));
  return result;
}

// Returns the angle between two symmetric directions, in degrees.
double angle_between(const Vector_3& u, const Vector_3& v, const Vector_3& normal, int symmetry)
{
  const double step = 360. / symmetry,
               angle = std::atan2(CGAL::cross_product(u, v) * normal / std::sqrt(normal.squared_length()), u * v) * 180
                       / CGAL_PI;
  return std::abs(angle - step * std::round(angle / step));
}

double mean_angle(
  const Mesh& mesh, const Field& field, const Mesh::Property_map<Face, Vector_3>& vectors, int symmetry,
  const std::function<bool(const Point_3&)>& counts = [](const Point_3&) { return true; })
{
  double sum = 0;
  std::size_t number = 0;
  for(Face f : mesh.faces()) {
    if(!counts(centroid(mesh, f))) continue;
    sum += angle_between(in_plane(field(centroid(mesh, f)), normal(mesh, f)), vectors[f], normal(mesh, f), symmetry);
    ++number;
  }
  return sum / double(number);
}

// Returns the index of the field at a vertex, in turns by 2 pi / symmetry. Vectors are carried across edges from facet
// to unfolded facet. Their total turn plus the angle defect at the vertex is a multiple of that turn.
int index_at(const Mesh& mesh, Vertex v, const Mesh::Property_map<Face, Vector_3>& vectors, int symmetry)
{
  const double step = 2 * CGAL_PI / symmetry;
  double turn = 0, angles = 0;
  for(auto h : CGAL::halfedges_around_target(v, mesh)) {
    const Vector_3 edge = mesh.point(mesh.source(h)) - mesh.point(v),
                   next = mesh.point(mesh.target(mesh.next(h))) - mesh.point(v);
    angles += std::atan2(std::sqrt(CGAL::cross_product(edge, next).squared_length()), edge * next);
    const auto angle = [&](Face f) {
      const Vector_3 n = normal(mesh, f);
      return std::atan2(CGAL::cross_product(edge, vectors[f]) * n / std::sqrt(n.squared_length()), edge * vectors[f]);
    };
    // Counterclockwise, the facet of h ends at this edge.
    const double change = angle(mesh.face(mesh.opposite(h))) - angle(mesh.face(h));
    turn += change - step * std::round(change / step);
  }
  return int(std::lround((turn + 2 * CGAL_PI - angles) / step));
}

// Returns the vertices with nonzero index, and their indices.
std::vector<std::pair<Point_3, int> > singularities(const Mesh& mesh, const Mesh::Property_map<Face, Vector_3>& vectors,
                                                    int symmetry)
{
  std::vector<std::pair<Point_3, int> > result;
  for(Vertex v : mesh.vertices())
    if(const int index = index_at(mesh, v, vectors, symmetry)) result.emplace_back(mesh.point(v), index);
  return result;
}

// Returns the sum of indices within 30 degrees of a direction from the origin.
int index_near(const std::vector<std::pair<Point_3, int> >& all, const Vector_3& direction)
{
  int sum = 0;
  for(const auto& s : all) {
    const Vector_3 p = s.first - CGAL::ORIGIN;
    if(p * direction > std::sqrt(0.75 * p.squared_length() * direction.squared_length())) sum += s.second;
  }
  return sum;
}

Vector_3 around_z(const Point_3& p)
{
  const double r = std::sqrt(p.x() * p.x() + p.y() * p.y());
  return Vector_3(-p.y() / r, p.x() / r, 0);
}

// Returns one direction of the cross along the edges of a cube around the origin. The corners of the cube have index
// 1/4.
Vector_3 along_cube(const Point_3& p)
{
  const double x = std::abs(p.x()), y = std::abs(p.y()), z = std::abs(p.z());
  return x >= y && x >= z ? Vector_3(0, 1, 0) : Vector_3(1, 0, 0);
}

// Replaces the vectors of some facets by other representatives of the same symmetric direction.
void turn_some(const Mesh& mesh, Mesh::Property_map<Face, Vector_3>& vectors, int symmetry)
{
  for(Face f : mesh.faces()) {
    const Eigen::Vector3d
      n = Eigen::Vector3d(normal(mesh, f).x(), normal(mesh, f).y(), normal(mesh, f).z()).normalized(),
      v = Eigen::AngleAxisd(2 * CGAL_PI * int(std::size_t(f) * 7 % std::size_t(symmetry)) / symmetry, n)
          * Eigen::Vector3d(vectors[f].x(), vectors[f].y(), vectors[f].z());
    vectors[f] = Vector_3(v[0], v[1], v[2]);
  }
}

} // namespace

TEST_CASE("Tangent vectors: the mean over a facet is the mean of the source facets that it covers")
{
  // Each facet of the target covers 16 facets of the source; their centroids are the samples.
  Mesh coarse = sheet(steps(-0.6, 0.6, 2), steps(-0.6, 0.6, 2), 0.4),
       fine = sheet(steps(-0.6, 0.6, 8), steps(-0.6, 0.6, 8));
  CGAL::Random random(3);
  auto v = at_facets(fine, "v"), mean = at_facets(coarse, "mean");
  std::map<std::size_t, std::vector<Vector_3> > covered;
  const auto triangle_of = [](const Mesh& mesh, const Point_3& p) {
    for(Face f : mesh.faces()) {
      const auto t = corners(mesh, f);
      bool inside = true;
      for(int i = 0; i < 3; ++i) {
        const Vector_3 e = t[(i + 1) % 3] - t[i], d = p - t[i];
        inside = inside && e.x() * d.y() - e.y() * d.x() > 0;
      }
      if(inside) return std::size_t(f);
    }
    return std::size_t(-1);
  };
  for(Face f : fine.faces()) {
    v[f] = Vector_3(random.get_double(-1, 1), random.get_double(-1, 1), 0);
    covered[triangle_of(coarse, centroid(fine, f))].push_back(v[f]);
  }
  REQUIRE(covered.size() == coarse.number_of_faces());
  const BS::Transfer_report report = BS::transfer_tangent_vectors(Map(slab(), fine, coarse), v, mean,
                                                                  P::samples_per_facet(std::size_t(16)));
  CHECK(report);
  CHECK(report.transferred == coarse.number_of_faces());
  for(Face f : coarse.faces()) {
    Vector_3 sum = CGAL::NULL_VECTOR;
    REQUIRE(covered[f].size() == 16);
    for(const Vector_3& u : covered[f]) sum = sum + u;
    CHECK((mean[f] - sum / 16).squared_length() < 1e-24);
  }
}

TEST_CASE("Tangent vectors: means and interpolation of crosses do not depend on the vectors that represent them")
{
  for(int symmetry : { 2, 3, 4, 6 }) {
    Mesh fine = sphere(3, 0.7), coarse = turned(sphere(2, 0.85), 0.3);
    auto v = sampled(
           fine, [](const Point_3&p) { return Vector_3(p.y() + 0.2, -p.z(), p.x()); }, "v"),
         w = at_facets(fine, "w"), v2 = at_facets(coarse, "v2"), w2 = at_facets(coarse, "w2");
    for(Face f : fine.faces()) w[f] = v[f];
    turn_some(fine, w, symmetry);
    const Map map(ball(), fine, coarse);
    for(bool linear : { false, true }) {
      const auto np = P::symmetry(symmetry).samples_per_facet(std::size_t(9)).linear_reconstruction(linear);
      CHECK(BS::transfer_tangent_vectors(map, v, v2, np));
      CHECK(BS::transfer_tangent_vectors(map, w, w2, np));
      for(Face f : coarse.faces()) {
        CHECK(angle_between(v2[f], w2[f], normal(coarse, f), symmetry) < 1e-7);
        CHECK(w2[f].squared_length() == Approx(v2[f].squared_length()));
      }
    }
  }
}

TEST_CASE("Tangent vectors at vertices: a linear field on a plane is interpolated and mapped exactly")
{
  Mesh flat = sheet(steps(-0.8, 0.8, 7), steps(-0.8, 0.8, 9)),
       tilted = sheet(steps(-0.7, 0.65, 11), steps(-0.6, 0.7, 6),
                      [](double x, double y) { return 0.2 + 0.3 * x - 0.25 * y; });
  const auto linear = [](double x, double y) { return Vector_3(1 + x - 2 * y, 0.5 * x + y - 2, 0); };
  auto v = at_vertices(flat, "v"), w = at_vertices(tilted, "w");
  // The normal component is lost.
  for(Vertex a : flat.vertices()) v[a] = linear(flat.point(a).x(), flat.point(a).y()) + Vector_3(0, 0, 5);
  CHECK(BS::transfer_vertex_tangent_vectors(Map(slab(), flat, tilted), v, w));
  // Images are tangent to the level sets of z, whatever the facets of the target.
  for(Vertex b : tilted.vertices())
    CHECK((w[b] - linear(tilted.point(b).x(), tilted.point(b).y())).squared_length() < 1e-20);
}

TEST_CASE("Tangent vectors at vertices: crosses on spheres converge quadratically with the length of the edges")
{
  const Field field = [](const Point_3& p) { return in_plane(Vector_3(0.3, -0.4, 1), p - CGAL::ORIGIN); };
  for(int symmetry : { 1, 2, 4 }) {
    double before = 0;
    for(int level : { 2, 3, 4 }) {
      Mesh a = sphere(level, 0.7), b = turned(sphere(3, 0.85), 0.4);
      auto v = at_vertices(a, "v"), w = at_vertices(b, "w");
      for(Vertex p : a.vertices()) {
        v[p] = field(a.point(p));
        if(symmetry == 4 && std::size_t(p) % 2) v[p] = CGAL::cross_product(a.point(p) - CGAL::ORIGIN, v[p]) / 0.7;
        if(symmetry == 2 && std::size_t(p) % 2) v[p] = -v[p];
      }
      CHECK(BS::transfer_vertex_tangent_vectors(Map(ball(), a, b), v, w, P::symmetry(symmetry)));
      double most = 0;
      for(Vertex p : b.vertices()) {
        const Vector_3 n = b.point(p) - CGAL::ORIGIN, expected = field(b.point(p));
        if(expected.squared_length() < 0.1) continue; // close to the two zeros of the field
        CHECK(std::abs(w[p] * n) < 1e-9);
        most = (std::max)(most, angle_between(w[p], expected, n, symmetry));
      }
      INFO("symmetry " << symmetry << ", level " << level << ": " << most << " degrees");
      if(before > 0) CHECK(most < before / 3);
      before = most;
    }
  }
}

TEST_CASE("Tangent vectors: means and linear reconstruction halve the error of a round trip")
{
  const Field field = [](const Point_3& p) {
    return CGAL::cross_product(Vector_3(0.2, 0.3, 1), p - CGAL::ORIGIN) + 0.5 * Vector_3(p.z(), p.x(), p.y());
  };
  for(int symmetry : { 1, 4 }) {
    Mesh fine = sphere(4, 0.7), coarse = turned(sphere(2, 0.85), 0.3);
    auto v = sampled(fine, field, "v"), there = at_facets(coarse, "there"), back = at_facets(fine, "back");
    const Map map(ball(), fine, coarse);
    CHECK(BS::transfer_tangent_vectors(map, v, there, P::symmetry(symmetry)));
    CHECK(BS::transfer_tangent_vectors(map.inverse(), there, back, P::symmetry(symmetry)));
    const double before = mean_angle(fine, field, back, symmetry);
    CHECK(BS::transfer_tangent_vectors(map, v, there, P::symmetry(symmetry).samples_per_facet(std::size_t(16))));
    CHECK(BS::transfer_tangent_vectors(map.inverse(), there, back, P::symmetry(symmetry).linear_reconstruction(true)));
    const double after = mean_angle(fine, field, back, symmetry);
    INFO(before << " degrees, then " << after);
    CHECK(after < before / 2);
  }
}

TEST_CASE("Tangent vectors: singularities of fields on a sphere keep their index and place")
{
  Mesh fine = turned(sphere(4, 0.7), 0.1), coarse = turned(sphere(2, 0.85), 0.35), finer = turned(sphere(4, 0.8), 0.2);
  struct Case
  {
    const char* name;
    Field field;
    int symmetry;
    std::vector<Vector_3> places;
  };
  std::vector<Vector_3> corners;
  for(int n = 0; n < 8; ++n) corners.emplace_back(n & 1 ? 1 : -1, n & 2 ? 1 : -1, n & 4 ? 1 : -1);
  const std::vector<Case> cases{ { "around the axis", around_z, 1, { Vector_3(0, 0, 1), Vector_3(0, 0, -1) } },
                                 { "lines around the axis", around_z, 2, { Vector_3(0, 0, 1), Vector_3(0, 0, -1) } },
                                 { "cross along a cube", along_cube, 4, corners } };
  for(const Case& c : cases) {
    INFO(c.name);
    const int index = 2 * c.symmetry / int(c.places.size()); // the Euler characteristic is 2
    auto v = sampled(fine, c.field, "v"), there = at_facets(coarse, "there"), back = at_facets(finer, "back");
    const auto check = [&](const Mesh& mesh, const Mesh::Property_map<Face, Vector_3>& vectors) {
      const auto all = singularities(mesh, vectors, c.symmetry);
      int sum = 0;
      for(const auto& s : all) sum += s.second;
      CHECK(sum == 2 * c.symmetry);
      for(const Vector_3& place : c.places) CHECK(index_near(all, place) == index);
    };
    check(fine, v);
    CHECK(BS::transfer_tangent_vectors(Map(ball(), fine, coarse), v, there,
                                       P::symmetry(c.symmetry).samples_per_facet(std::size_t(16))));
    check(coarse, there);
    CHECK(BS::transfer_tangent_vectors(Map(ball(), coarse, finer), there, back,
                                       P::symmetry(c.symmetry).linear_reconstruction(true)));
    check(finer, back);
  }
}

TEST_CASE("Tangent vectors: a field without singularities on a torus has none on a simplified torus")
{
  Mesh fine = torus(1, 0.4, 48, 24), coarse = fine;
  const CGAL::Certified_bspline_shell_3 shell = CGAL::certified_bspline_shell_3(fine, P::relative_thickness(0.05));
  REQUIRE(shell.is_certified());
  // The number of facets is so large that a cross turns by less than half of its 90 degrees on each.
  REQUIRE(BS::simplify_in_shell(coarse, shell, P::stop(BS::Facet_count_stop_predicate(1000))));
  coarse.collect_garbage();
  typedef BS::Shell_map_3<CGAL::Certified_bspline_shell_3, Mesh> Shell_map;
  for(int symmetry : { 1, 4 }) {
    auto v = sampled(fine, around_z, "v"), there = at_facets(coarse, "there"), back = at_facets(fine, "back");
    CHECK(singularities(fine, v, symmetry).empty());
    const Shell_map map(shell, fine, coarse);
    CHECK(BS::transfer_tangent_vectors(map, v, there, P::symmetry(symmetry).samples_per_facet(std::size_t(16))));
    CHECK(singularities(coarse, there, symmetry).empty());
    CHECK(BS::transfer_tangent_vectors(map.inverse(), there, back, P::symmetry(symmetry).linear_reconstruction(true)));
    CHECK(singularities(fine, back, symmetry).empty());
  }
}

TEST_CASE("Tangent vectors: failures are reported, and results do not depend on the number of threads")
{
  Mesh fine = sphere(3, 0.7), coarse = turned(sphere(1, 0.85), 0.3), outside = sphere(1, 2);
  auto v = sampled(fine, around_z, "v"), one = at_facets(coarse, "one"), two = at_facets(coarse, "two"),
       none = at_facets(outside, "none");
  const Map map(ball(), fine, coarse);
  // The number of samples is rounded up to a square.
  const auto np = P::symmetry(4).samples_per_facet(std::size_t(5)).linear_reconstruction(true);
  CHECK(BS::transfer_tangent_vectors<CGAL::Sequential_tag>(map, v, one, np));
  CHECK(BS::transfer_tangent_vectors<CGAL::Parallel_if_available_tag>(map, v, two, np));
  for(Face f : coarse.faces()) CHECK(one[f] == two[f]);

  const Vector_3 missing(7, 7, 7);
  const BS::Transfer_report report = BS::transfer_tangent_vectors(
    Map(ball(), fine, outside), v, none, P::samples_per_facet(std::size_t(4)).default_value(missing));
  CHECK(report.transferred == 0);
  CHECK(report.failures.size() == outside.number_of_faces());
  for(Face f : outside.faces()) CHECK(none[f] == missing);
  auto at_fine = at_vertices(fine, "v"), at_outside = at_vertices(outside, "v");
  CHECK(BS::transfer_vertex_tangent_vectors(Map(ball(), fine, outside), at_fine, at_outside, P::default_value(missing))
          .failures.size()
        == outside.number_of_vertices());
  for(Vertex p : outside.vertices()) CHECK(at_outside[p] == missing);
}
} // namespace test_transfer_tangent_vectors
