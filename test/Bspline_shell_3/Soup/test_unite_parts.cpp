// The union of a mesh's parts is the expected one, and each of its facets has its place in a facet of the input.
#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3.h>
#include <CGAL/Bspline_shell_3/Soup/unite_parts.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include "test_meshes.h"
#include "test_random.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Random.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace test_unite_parts {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace PMP = CGAL::Polygon_mesh_processing;

struct United : BS::United_mesh
{
  BS::Unite_report report;

  explicit United(const Mesh& input) : report(BS::unite_parts(input, *this)) {}
};

Mesh joined_all(std::initializer_list<Mesh> meshes)
{
  Mesh all;
  for(const Mesh& mesh : meshes) all = joined(all, mesh);
  return all;
}

std::array<Mesh::Vertex_index, 3> vertices_of(const Mesh& mesh, Mesh::Face_index f)
{
  const auto h = mesh.halfedge(f);
  return { mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)) };
}

// Returns how often the mesh winds around a point.
int winding(const BS::Crossing_counter_3& counter, const Point_3& p)
{
  for(const Vector_3& far : { Vector_3(61, 83, 71), Vector_3(-53, 97, 31), Vector_3(37, -59, 89) })
    if(const auto crossings = counter.crossings(p, p + far)) {
      int sum = 0;
      for(const auto& crossing : *crossings) sum += crossing.second;
      return sum;
    }
  throw std::runtime_error("no generic segment");
}

// Checks what holds for each union: it is embedded, and contains a point if and only if a solid of the input does.
// Facets lie in their sources, at their barycentric coordinates, and cover the shares of their area that are visible.
void check_union(const Mesh& input, const United& united)
{
  REQUIRE(united.report);
  CHECK(united.report.offending_facets.empty());
  const Mesh& mesh = united.mesh;
  CHECK(CGAL::is_closed(mesh));
  CHECK_FALSE(PMP::does_self_intersect(mesh));
  REQUIRE(united.source.size() == mesh.number_of_faces());
  REQUIRE(united.corners.size() == mesh.number_of_faces());
  REQUIRE(united.hidden_share.size() == input.number_of_faces());
  CHECK(std::is_sorted(united.source.begin(), united.source.end()));

  const CGAL::Bbox_3 box = PMP::bbox(input);
  const double unit = (std::max)({ box.x_span(), box.y_span(), box.z_span() });
  const double near = 1e-14 * unit;
  std::vector<double> visible(input.number_of_faces(), 0);
  std::map<std::pair<std::size_t, Mesh::Vertex_index>, BS::United_mesh::Barycentric> at; // by source and vertex
  std::map<std::tuple<Mesh::Vertex_index, Mesh::Vertex_index, Mesh::Vertex_index>, double> on_edge;
  std::size_t misplaced = 0, moved = 0, torn = 0, turned = 0, negative = 0;
  for(Mesh::Face_index f : mesh.faces()) {
    const Mesh::Face_index s(Mesh::size_type(united.source[f]));
    const auto v = vertices_of(mesh, f), w = vertices_of(input, s);
    const BS::United_mesh::Corners& c = united.corners[f];
    for(std::size_t i = 0; i < 3; ++i) {
      const auto& b = c[i];
      const Point_3 p = CGAL::barycenter(input.point(w[0]), b[0], input.point(w[1]), b[1], input.point(w[2]), b[2]);
      misplaced += distance(p, mesh.point(v[i])) > near ? 1 : 0;
      moved += at.emplace(std::make_pair(united.source[f], v[i]), b).first->second != b ? 1 : 0;
      for(std::size_t j = 0; j < 3; ++j)
        if(b[j] == 0) {
          std::size_t k = (j + 1) % 3, l = (j + 2) % 3;
          if(w[l] < w[k]) std::swap(k, l);
          torn += on_edge.emplace(std::make_tuple(w[k], w[l], v[i]), b[l]).first->second != b[l] ? 1 : 0;
        }
    }
    visible[s] += PMP::face_area(f, mesh);
    turned += PMP::compute_face_normal(f, mesh) * PMP::compute_face_normal(s, input) < 0.98 ? 1 : 0;
    negative += CGAL::determinant(c[0][0], c[0][1], c[0][2], c[1][0], c[1][1], c[1][2], c[2][0], c[2][1], c[2][2]) > 0
                  ? 0
                  : 1;
  }
  CHECK(misplaced == 0);
  CHECK(moved == 0);
  CHECK(torn == 0);
  CHECK(turned == 0);
  CHECK(negative == 0);
  double area = 0, hidden = 0;
  std::size_t wrong_shares = 0, hidden_facets = 0, partly_hidden_facets = 0;
  for(Mesh::Face_index f : input.faces()) {
    const double of_facet = PMP::face_area(f, input), share = united.hidden_share[f];
    area += of_facet;
    hidden += share * of_facet;
    const bool is_source = std::binary_search(united.source.begin(), united.source.end(), std::size_t(f));
    wrong_shares += std::abs((1 - share) * of_facet - visible[f]) > 1e-12 * unit * unit || (share == 1) == is_source
                        || share < 0
                      ? 1
                      : 0;
    (share == 1 ? hidden_facets : partly_hidden_facets) += share > 0 ? 1 : 0;
  }
  CHECK(wrong_shares == 0);
  CHECK(united.report.hidden_facets == hidden_facets);
  CHECK(united.report.partly_hidden_facets == partly_hidden_facets);
  CHECK(united.report.hidden_area == Approx(hidden / area));
  CHECK(PMP::area(mesh) == Approx(area - hidden));

  const BS::Crossing_counter_3 of_input(input), of_union(mesh);
  const int outwards = PMP::is_outward_oriented(mesh) ? 1 : -1;
  CGAL::Random random(1);
  std::size_t wrong_points = 0;
  for(int n = 0; n < 300; ++n) {
    const Point_3 p(random_number(random, box.xmin(), box.xmax()), random_number(random, box.ymin(), box.ymax()),
                    random_number(random, box.zmin(), box.zmax()));
    const bool is_in_solid = outwards * winding(of_input, p) > 0;
    wrong_points += winding(of_union, p) != (is_in_solid ? outwards : 0) ? 1 : 0;
  }
  CHECK(wrong_points == 0);
}

void check_exact_planes(const Mesh& input, const United& united)
{
  for(Mesh::Face_index f : united.mesh.faces()) {
    const auto s = corners(input, Mesh::Face_index(Mesh::size_type(united.source[f])));
    for(const Point_3& p : corners(united.mesh, f)) CHECK(CGAL::orientation(s[0], s[1], s[2], p) == CGAL::COPLANAR);
  }
}

std::size_t number_of_components(const Mesh& mesh)
{
  std::vector<std::size_t> component(mesh.number_of_faces());
  return PMP::connected_components(mesh, CGAL::make_property_map(component));
}

Mesh cube(double a, double b)
{
  return box(Point_3(a, a, a), Point_3(b, b, b));
}

} // namespace

TEST_CASE("Uniting parts: two cubes that overlap at a corner become one solid with exact planes")
{
  const Mesh input = joined(cube(0, 2), cube(1, 3));
  const United united(input);
  check_union(input, united);
  check_exact_planes(input, united);
  CHECK(PMP::volume(united.mesh) == Approx(15));
  CHECK(PMP::area(united.mesh) == Approx(42));
  CHECK(united.report.parts == 2);
  CHECK(united.report.solids == 2);
  CHECK(united.report.united_solids == 2);
  CHECK(united.report.groups == 1);
  CHECK(united.report.coplanar_pairs == 0);
  CHECK(united.report.hidden_area == Approx(6. / 48));
  CHECK(message(united.report).find("2 overlapping closed parts") == 0);

  SECTION("turned inside out, the result is inside out")
  {
    const Mesh inwards = reversed(input);
    const United result(inwards);
    check_union(inwards, result);
    CHECK(PMP::volume(result.mesh) == Approx(-15));
  }
}

TEST_CASE("Uniting parts: two spheres become one surface, and small facets within the other one are hidden")
{
  const Mesh input = joined(sphere(3, 1), sphere(3, 0.8, Point_3(0.9, 0.2, -0.1)));
  const United united(input);
  check_union(input, united);
  CHECK(number_of_components(united.mesh) == 1);
  CHECK(united.report.hidden_facets > 300);
  CHECK(united.report.partly_hidden_facets > 30);
}

TEST_CASE("Uniting parts: boxes that overlap each other in pairs need several unions")
{
  const Mesh input = joined_all({ box(Point_3(0, 0, 0), Point_3(4, 2, 2)), box(Point_3(1, -1, 0.5), Point_3(3, 3, 1.5)),
                                  box(Point_3(1.5, 0.5, -1), Point_3(2.5, 1.5, 3)) });
  const United united(input);
  check_union(input, united);
  check_exact_planes(input, united);
  CHECK(PMP::volume(united.mesh) == Approx(22));
  CHECK(united.report.groups == 1);
}

TEST_CASE("Uniting parts: spheres in general position that overlap each other need several unions")
{
  const Mesh input = joined_all({ sphere(2, 1), sphere(2, 1, Point_3(0.71, 0.13, 0.05)),
                                  sphere(2, 1, Point_3(0.31, 0.67, -0.11)), sphere(2, 0.9, Point_3(0.4, 0.3, 0.6)),
                                  sphere(2, 0.5, Point_3(2, 2, 2)), sphere(2, 0.5, Point_3(2.4, 2.1, 2)) });
  const United united(input);
  check_union(input, united);
  CHECK(united.report.groups == 2);
  CHECK(united.report.united_solids == 6);
  CHECK(number_of_components(united.mesh) == 2);
}

TEST_CASE("Uniting parts: a box within a box is removed if it is a solid, and kept if it is a cavity")
{
  const United solid(joined(cube(0, 3), cube(1, 2)));
  check_union(joined(cube(0, 3), cube(1, 2)), solid);
  CHECK(is_equal(solid.mesh, cube(0, 3)));
  CHECK(solid.report.hidden_facets == 12);
  CHECK(solid.report.partly_hidden_facets == 0);
  CHECK(solid.report.groups == 1);

  const Mesh hollow = joined(cube(0, 3), reversed(cube(1, 2)));
  const United cavity(hollow);
  check_union(hollow, cavity);
  CHECK(is_equal(cavity.mesh, hollow));
  CHECK(cavity.report.solids == 1);
  CHECK(cavity.report.groups == 0);
  CHECK(cavity.report.hidden_area == 0);

  // A cube with a cavity, which is in the cavity of another cube.
  const Mesh nested = joined_all({ reversed(cube(3, 4)), cube(0, 7), cube(2, 5), reversed(cube(1, 6)) });
  const United layers(nested);
  check_union(nested, layers);
  CHECK(is_equal(layers.mesh, nested));
  CHECK(layers.report.solids == 2);
  CHECK(layers.report.united_solids == 0);
  // A point at some distance from the inner cube is beyond the wall of the cavity.
  CHECK(United(joined_all({ cube(0, 1), cube(-5, 6), reversed(cube(-0.03, 1.03)) })).report.united_solids == 0);
}

TEST_CASE("Uniting parts: a cavity stays where another solid does not fill it, and is hidden elsewhere")
{
  const Mesh hollow = joined(cube(0, 4), reversed(cube(1, 3)));
  const Mesh bar = box(Point_3(2, 1.5, 1.5), Point_3(6, 2.5, 2.5));
  const United united(joined(hollow, bar));
  check_union(joined(hollow, bar), united);
  CHECK(PMP::volume(united.mesh) == Approx(59));
  CHECK(united.report.solids == 2);
  CHECK(number_of_components(united.mesh) == 2);

  // This solid fills the cavity, and is within the other one.
  const United filled(joined(hollow, cube(0.5, 3.5)));
  check_union(joined(hollow, cube(0.5, 3.5)), filled);
  CHECK(is_equal(filled.mesh, cube(0, 4)));
}

TEST_CASE("Uniting parts: flat contacts disappear, and one copy of coplanar facets is kept")
{
  const Mesh stacked = joined(cube(0, 2), box(Point_3(2, 0.5, 0.5), Point_3(3, 1.5, 1.5)));
  const United glued(stacked);
  check_union(stacked, glued);
  CHECK(PMP::volume(glued.mesh) == Approx(9));
  CHECK(glued.report.coplanar_pairs == 0);

  const Mesh flush = joined(cube(0, 2), box(Point_3(1, 0, 0), Point_3(3, 2, 2)));
  const United flat(flush);
  check_union(flush, flat);
  CHECK(PMP::volume(flat.mesh) == Approx(12));
  CHECK(PMP::area(flat.mesh) == Approx(32));
  // Facets of the first box are kept. Those that are split and visible have no hidden share.
  CHECK(std::count(flat.hidden_share.begin(), flat.hidden_share.begin() + 12, 0.) == 10);
  CHECK(flat.report.hidden_facets == 4);
  CHECK(flat.report.partly_hidden_facets == 8);
  REQUIRE(flat.report.coplanar_pairs >= 8);
  CHECK(flat.coplanar_pairs.size() == flat.report.coplanar_pairs);
  for(const auto& [f, g] : flat.coplanar_pairs) {
    CHECK(f < 12);
    CHECK(g >= 12);
    const auto s = corners(flush, Mesh::Face_index(Mesh::size_type(f)));
    for(const Point_3& p : corners(flush, Mesh::Face_index(Mesh::size_type(g))))
      CHECK(CGAL::orientation(s[0], s[1], s[2], p) == CGAL::COPLANAR);
  }

  const United twice(joined(cube(0, 2), cube(0, 2)));
  check_union(joined(cube(0, 2), cube(0, 2)), twice);
  CHECK(twice.mesh.number_of_faces() == 12);
  CHECK(twice.report.hidden_facets == 12);
  CHECK(twice.report.coplanar_pairs == 12);
}

TEST_CASE("Uniting parts: parts that touch along an edge or at a vertex are rejected")
{
  const Mesh a = cube(0, 1);
  for(const Mesh& b :
      { box(Point_3(1, 1, 0), Point_3(2, 2, 1)), box(Point_3(1, 1, -0.5), Point_3(2, 2, 0.5)), cube(1, 2) }) {
    const United united(joined(a, b));
    CHECK(united.report.status == BS::Unite_status::CONTACT);
    CHECK(message(united.report).find("touch") != std::string::npos);
  }
}

TEST_CASE("Uniting parts: parts that intersect themselves, and wrong orientations, are rejected with their facets")
{
  Mesh spiked = sphere(2);
  spiked.point(Mesh::Vertex_index(0)) = CGAL::ORIGIN - 3 * (spiked.point(Mesh::Vertex_index(0)) - CGAL::ORIGIN);
  const std::size_t facets = spiked.number_of_faces();
  const United united(joined(cube(5, 6), spiked));
  CHECK(united.report.status == BS::Unite_status::PART_INTERSECTS_ITSELF);
  REQUIRE_FALSE(united.report.offending_facets.empty());
  CHECK(united.report.offending_facets.front() >= 12);
  CHECK(united.report.offending_facets.back() < 12 + facets);

  for(const Mesh& mesh :
      { joined(cube(0, 1), reversed(cube(2, 3))),                                               // apart
        joined(cube(0, 4), reversed(cube(1, 4.5))),                                             // not within
        joined_all({ cube(0, 9), reversed(cube(1, 3)), reversed(cube(2, 4)) }),                 // cavities that meet
        joined_all({ cube(0, 9), reversed(cube(1, 5)), reversed(cube(2, 4)) }),                 // nested cavities
        joined_all({ cube(0, 9), reversed(cube(2, 4)), reversed(cube(1, 5)), cube(12, 13) }) }) // in another order
  {
    const United wrong(mesh);
    CHECK(wrong.report.status == BS::Unite_status::INCONSISTENT_ORIENTATION);
    REQUIRE(wrong.report.offending_facets.size() == 1);
    CHECK(wrong.report.offending_facets.front() % 12 == 0);
  }

  Mesh open = joined(cube(0, 2), cube(1, 3));
  CGAL::Euler::remove_face(open.halfedge(Mesh::Face_index(0)), open);
  open.collect_garbage();
  CHECK(United(open).report.status == BS::Unite_status::UNSUITABLE_MESH);
}

TEST_CASE("Uniting parts: solids that are apart from others keep their vertices and facets, bit for bit")
{
  const Mesh ball = sphere(2, 0.7, Point_3(5.1, 0.3, 0.2));
  const Mesh input = joined_all({ sphere(2, 0.7, Point_3(-5, 0, 0)), cube(0, 2), ball, cube(1, 3) });
  const United united(input);
  check_union(input, united);
  const std::size_t n = ball.number_of_faces();
  std::size_t kept = 0;
  for(Mesh::Face_index f : united.mesh.faces()) {
    const std::size_t s = united.source[f];
    if(s >= n && (s < n + 12 || s >= 2 * n + 12)) continue;
    ++kept;
    CHECK(corners(united.mesh, f) == corners(input, Mesh::Face_index(Mesh::size_type(s))));
    CHECK(united.corners[f] == BS::United_mesh::Corners{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } });
  }
  CHECK(kept == 2 * n);
  // The first ball has the first vertices.
  for(std::size_t v = 0; v < ball.number_of_vertices(); ++v)
    CHECK(united.mesh.point(Mesh::Vertex_index(Mesh::size_type(v)))
          == input.point(Mesh::Vertex_index(Mesh::size_type(v))));

  const Mesh apart = joined(ball, cube(0, 1));
  CHECK(is_equal(United(apart).mesh, apart));
}

TEST_CASE("Uniting parts: an intersection too small for rounded coordinates is rejected with its facets")
{
  // The apex of the second part is within the first one by a few units in the last place. Towards its base, it bends
  // away such that coordinates increase.
  const auto united_at_depth = [](double depth, double bend) {
    const Mesh needle = reversed(mapped(pyramid(3, 1), [depth, bend](const Point_3& p) {
      const double x = 1 - p.z(), y = p.x() + bend * x, z = p.y() + bend * x;
      return Point_3((1 - depth) + x, 0.37 + 0.1 * y, 0.41 + 0.1 * z);
    }));
    REQUIRE(PMP::is_outward_oriented(needle));
    return United(joined(cube(0, 1), needle));
  };
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const United with_equal_points = united_at_depth(eps / 2, 2), with_turned_facets = united_at_depth(2 * eps, 0);
  CHECK(with_equal_points.report.status == BS::Unite_status::ROUNDED_BADLY);
  REQUIRE_FALSE(with_equal_points.report.offending_facets.empty());
  CHECK(with_equal_points.report.offending_facets.front() < 12);
  CHECK(with_equal_points.report.offending_facets.back() >= 12);
  CHECK(with_turned_facets.report.status == BS::Unite_status::ROUNDED_BADLY);
  CHECK_FALSE(with_turned_facets.report.offending_facets.empty());
}

TEST_CASE("Uniting parts: facets that intersect only after coordinates are rounded are rejected")
{
  const Mesh two = joined(sphere(2), sphere(2, 0.8, Point_3(0.9, 0.2, -0.1)));
  const United united(two);
  REQUIRE(united.report);
  // Looks for a point that is outside of the union by less than the error of rounding. A small third part has its apex
  // there.
  CGAL::Random random(1);
  std::size_t found = 0;
  for(Mesh::Face_index f : united.mesh.faces()) {
    const auto s = corners(two, Mesh::Face_index(Mesh::size_type(united.source[f]))), t = corners(united.mesh, f);
    if(s == t || PMP::face_area(f, united.mesh) < 1e-4) continue;
    Point_3 p = t[0];
    for(int n = 0; n < 1000 && p == t[0]; ++n) {
      const double x = random_number(random, 0.3, 0.4), y = random_number(random, 0.3, 0.4);
      const Point_3 q = CGAL::barycenter(t[0], x, t[1], y, t[2], 1 - x - y);
      if(CGAL::orientation(s[0], s[1], s[2], q) == CGAL::POSITIVE
         && CGAL::orientation(t[0], t[1], t[2], q) != CGAL::POSITIVE)
        p = q;
    }
    if(p == t[0]) continue;
    ++found;
    const Vector_3 n = PMP::compute_face_normal(f, united.mesh), u = 1e-4 * (t[1] - t[0]), v = 1e-4 * (t[2] - t[0]);
    Mesh part;
    CGAL::make_tetrahedron(p, p + 1e-4 * n, p + 1e-4 * n + u, p + 1e-4 * n + v, part);
    if(!PMP::is_outward_oriented(part)) PMP::reverse_face_orientations(part);
    const United three(joined(two, part));
    CHECK(three.report.status == BS::Unite_status::ROUNDED_BADLY);
    CHECK(three.report.solids == 3);
    CHECK(three.report.united_solids == 2);
    if(found == 3) break;
  }
  CHECK(found == 3);
}

TEST_CASE("Uniting parts: a run that has ended ends the union")
{
  const Mesh input = joined(cube(0, 2), cube(1, 3));
  BS::United_mesh united;
  BS::internal::Run run(0);
  const bool is_complete = run([&] { return bool(BS::unite_parts(input, united)); },
                               [](BS::internal::Run::End) { return false; });
  CHECK_FALSE(is_complete);
  CHECK(run.end() == BS::internal::Run::End::OUT_OF_TIME);
}
} // namespace test_unite_parts
