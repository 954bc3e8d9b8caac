// Shell_truncation_3.h: a handmade truncation and its map are proved, and each error in it is found. It is applied to
// meshes that have its facets, and to no others.
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include "truncations.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace test_Shell_truncation_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace PMP = CGAL::Polygon_mesh_processing;
typedef BS::Shell_truncation_3 Truncation;
typedef Truncation::Index Index;

typedef Truncation_parts Parts;

// The apex of `pyramid(4, 1)` is cut off halfway, and replaced by a square. With `has_point`, it is replaced by a roof
// with a point in the middle.
Parts square_pyramid(bool has_point = false)
{
  Parts parts;
  const Index apex = 0, npos = Truncation::npos;
  const Mesh mesh = pyramid(4, 1);
  for(std::uint32_t v : { 0u, 2u, 3u, 4u, 5u }) {
    const Point_3& p = mesh.point(Mesh::Vertex_index(v));
    parts.points.push_back({ p.x(), p.y(), p.z() });
  }
  for(Index i = 0; i < 4; ++i) parts.cut_facets.push_back({ apex, 1 + i, 1 + (i + 1) % 4 });
  Truncation::Disc disc;
  disc.center = apex;
  for(Index i = 0; i < 4; ++i) {
    const auto p = parts.points[1 + i]; // a copy, as the vector grows
    parts.points.push_back({ p[0] / 2, p[1] / 2, 0.5 });
    parts.cuts.push_back({ apex, 1 + i, npos, 0.5, 0 });
    parts.planar.push_back({ p[0], p[1] });
    disc.rim.push_back(5 + i);
    disc.facets.push_back(i);
    const Index j = (i + 1) % 4;
    parts.cores.push_back({ { 5 + i, 1 + i, 1 + j }, i });
    parts.cores.push_back({ { 5 + i, 1 + j, 5 + j }, i });
  }
  if(has_point) {
    parts.points.push_back({ 0.05, 0, 0.6 });
    parts.planar.push_back({ 0.1, 0.2 });
    for(Index i = 0; i < 4; ++i) disc.triangles.push_back({ 5 + i, 5 + (i + 1) % 4, 9 });
  } else disc.triangles = { { 5, 6, 7 }, { 5, 7, 8 } };
  parts.discs.push_back(disc);
  return parts;
}

// Returns the position of a place in one of the cut facets, or in a new one.
Point_3 point(const Truncation& t, const Truncation::Place& place, bool is_new)
{
  const Truncation::Triangle triangle = is_new ? t.new_facet(place.facet) : t.cut_facets()[place.facet];
  Vector_3 p = CGAL::NULL_VECTOR;
  for(int i = 0; i < 3; ++i) {
    const auto& q = t.points()[triangle[i]];
    p = p + place.barycentric[i] * Vector_3(q[0], q[1], q[2]);
  }
  return CGAL::ORIGIN + p;
}

double distance(const Point_3& p, const Point_3& q)
{
  return std::sqrt(CGAL::squared_distance(p, q));
}

std::array<double, 3> random_barycentric(std::mt19937& random)
{
  const auto uniform = [&] { return double(random()) / double(std::mt19937::max()); };
  const double u = uniform(), v = uniform();
  return u + v > 1 ? std::array<double, 3>{ u + v - 1, 1 - u, 1 - v } : std::array<double, 3>{ 1 - u - v, u, v };
}

} // namespace

TEST_CASE("Truncation: a handmade truncation is proved valid")
{
  CHECK(square_pyramid(false).is_valid());
  CHECK(square_pyramid(true).is_valid());
  CHECK_FALSE(Truncation().is_valid());
  const Truncation t = square_pyramid(true).assembled();
  CHECK(t.number_of_corners() == 5);
  CHECK(t.number_of_new_facets() == 12);
  CHECK(t.disc_of_new_facet(7) == Truncation::npos);
  CHECK(t.disc_of_new_facet(8) == 0);
}

TEST_CASE("Truncation: each error is detected")
{
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::function<void(Parts&)> > errors = {
    [](Parts& p) { p.points[2] = p.points[1]; }, // two corners at one position
    [=](Parts& p) { p.points[6][1] = infinity; },
    [=](Parts& p) { p.planar[1][1] = infinity; },
    [](Parts& p) { p.planar.pop_back(); },
    [](Parts& p) { p.cuts[0].s = 0; },
    [](Parts& p) { p.cuts[0].s = 1; },
    [](Parts& p) { p.cuts[0].t = 0.25; },  // on an edge, and in a facet
    [](Parts& p) { p.cuts[0].first = 2; }, // on another edge than in the facets that use it
    [](Parts& p) { p.cuts[0].center = 1; },
    [](Parts& p) {
      p.cuts[0].second = 2;
      p.cuts[0].t = 0.25;
    }, // within a facet, so its neighbor has a gap
    [](Parts& p) {
      p.cuts[0].second = 2;
      p.cuts[0].t = 0.75;
    }, // beyond the facet
    [](Parts& p) { p.cores.pop_back(); },
    [](Parts& p) { p.cores.push_back(p.cores.back()); },
    [](Parts& p) { std::swap(p.cores[3].triangle[0], p.cores[3].triangle[1]); },
    [](Parts& p) { p.cores[3].facet = 0; },
    [](Parts& p) { p.cores[3].triangle[0] = 0; }, // the vertex that is cut off
    [](Parts& p) { p.cores[3].facet = 17; },
    [](Parts& p) { p.cut_facets[1][0] = 77; },
    [](Parts& p) { p.cut_facets[1] = p.cut_facets[0]; },
    [](Parts& p) { p.cut_facets.pop_back(); },
    [](Parts& p) { p.discs.clear(); },
    [](Parts& p) { p.discs.push_back(p.discs[0]); },
    [](Parts& p) { p.discs[0].center = 1; },
    [](Parts& p) { p.discs[0].facets[2] = 1; },
    [](Parts& p) {
      p.discs[0].rim.pop_back();
      p.discs[0].facets.pop_back();
    },
    [](Parts& p) { std::swap(p.discs[0].rim[0], p.discs[0].rim[2]); },
    [](Parts& p) { std::reverse(p.discs[0].rim.begin(), p.discs[0].rim.end()); },
    [](Parts& p) { p.discs[0].triangles.pop_back(); },
    [](Parts& p) { p.discs[0].triangles.push_back(p.discs[0].triangles.back()); },
    [](Parts& p) { std::swap(p.discs[0].triangles[1][0], p.discs[0].triangles[1][1]); },
    [](Parts& p) { p.discs[0].triangles[1][0] = 1; }, // does not belong to the disc
    [](Parts& p) {
      p.planar[0] = { -0.5, 0.25 };
    }, // the polygon is not star-shaped
    [](Parts& p) {
      for(auto& q : p.planar) q[1] = -q[1];
    }, // clockwise
  };
  for(bool has_point : { false, true })
    for(std::size_t n = 0; n < errors.size(); ++n) {
      CAPTURE(has_point, n);
      Parts parts = square_pyramid(has_point);
      errors[n](parts);
      CHECK_FALSE(parts.is_valid());
    }
  Parts parts = square_pyramid(true);
  parts.planar[4] = { 0.7, 0.7 }; // the inner point of the disc is outside the polygon
  CHECK_FALSE(parts.is_valid());
  parts.planar = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 }, { 0.5, 0.5 } }; // on the boundary of the polygon
  CHECK_FALSE(parts.is_valid());
}

TEST_CASE("Truncation: overlapping parts do not tile a facet")
{
  // A cut within the first facet is closer to the apex than the cuts on its edges, as the cores require.
  Parts parts = square_pyramid();
  const Index inner = 9;
  const auto p = parts.planar[0], q = parts.planar[1];
  parts.points.push_back({ 0, 0, 0.75 });
  parts.planar.push_back({ 0.6 * (p[0] + q[0]), 0.6 * (p[1] + q[1]) });
  parts.cuts.push_back({ 0, 1, 2, 0.125, 0.125 });
  parts.cores[0].triangle = { 5, 1, 6 };
  parts.cores[1].triangle = { 1, 2, 6 };
  parts.cores.push_back({ { 5, 6, inner }, 0 });
  Truncation::Disc& disc = parts.discs[0];
  disc.rim = { 5, inner, 6, 7, 8 };
  disc.facets = { 0, 0, 1, 2, 3 };
  disc.triangles = { { inner, 6, 7 }, { inner, 7, 8 }, { inner, 8, 5 } };
  CHECK(parts.is_valid());
  // At these places it is farther away: the same edges bound triangles, but one of them is inverted.
  for(double s : { 0.375, 0.625 }) {
    parts.cuts.back().s = parts.cuts.back().t = s;
    CHECK_FALSE(parts.is_valid());
  }
}

TEST_CASE("Truncation: a disc and a core must not share an edge, as the mesh would have four facets there")
{
  // There are three cuts within the first facet. The core has the edge between the two outer ones.
  Parts parts = square_pyramid();
  const auto p = parts.points[1], q = parts.points[2];
  for(const auto& st : { Truncation::Planar_point{ 0.0625, 0.25 }, { 0.0625, 0.0625 }, { 0.25, 0.0625 } }) {
    parts.cuts.push_back({ 0, 1, 2, st[0], st[1] });
    parts.points.push_back({ st[0] * p[0] + st[1] * q[0], st[0] * p[1] + st[1] * q[1], 1 - st[0] - st[1] });
  }
  parts.planar = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 }, { 0.4, 0.9 }, { 0.7, 0.7 }, { 0.9, 0.4 } };
  Truncation::Disc& disc = parts.discs[0];
  disc.rim = { 5, 11, 10, 9, 6, 7, 8 };
  disc.facets = { 0, 0, 0, 0, 1, 2, 3 };
  const auto core = [](Index p, Index q, Index r) { return Truncation::Core{ { p, q, r }, 0 }; };
  parts.cores[0] = core(5, 1, 6);
  parts.cores[1] = core(1, 2, 6);
  const std::vector<Truncation::Core> others = parts.cores;
  const auto with = [&](const std::vector<Truncation::Core>& added) {
    parts.cores = others;
    parts.cores.insert(parts.cores.end(), added.begin(), added.end());
    return parts.is_valid();
  };
  disc.triangles = { { 8, 5, 11 }, { 8, 11, 10 }, { 8, 10, 9 }, { 8, 9, 6 }, { 8, 6, 7 } };
  CHECK(with({ core(5, 6, 9), core(5, 9, 11), core(11, 9, 10) }));
  CHECK_FALSE(with({ core(5, 6, 9), core(5, 9, 11) })); // a gap between cuts
  disc.triangles = { { 5, 11, 10 }, { 5, 10, 9 }, { 5, 9, 6 }, { 5, 6, 7 }, { 5, 7, 8 } };
  CHECK_FALSE(with({ core(5, 6, 9), core(5, 9, 11), core(11, 9, 10) }));
}

TEST_CASE("Truncation: a disc must not extend beyond its rim")
{
  Parts parts = square_pyramid();
  parts.planar = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 }, { 0, 3 } };
  parts.points.push_back({ 0, 0.3, 0.8 });
  parts.discs[0].triangles.insert(parts.discs[0].triangles.end(), { { 6, 5, 9 }, { 7, 6, 9 } });
  CHECK_FALSE(parts.is_valid());
}

TEST_CASE("Truncation: two discs must not share a point")
{
  const Mesh mesh = subdivided(box(Point_3(0, 0, 0), Point_3(1, 1, 1)));
  Parts parts = truncation_at(mesh, { Mesh::Vertex_index(0), Mesh::Vertex_index(6) }, true);
  REQUIRE(parts.is_valid());
  REQUIRE(parts.discs.size() == 2);
  const Index first = Index(parts.points.size() - 2), second = first + 1;
  for(Truncation::Triangle& t : parts.discs[1].triangles) std::replace(t.begin(), t.end(), second, first);
  parts.points.pop_back();
  parts.planar.pop_back();
  CHECK_FALSE(parts.is_valid());
}

TEST_CASE("Truncation: a facet with a vertex that is cut off must be cut there")
{
  Parts parts = square_pyramid();
  parts.cut_facets.push_back({ 0, 1, 3 });
  parts.cores.push_back({ { 0, 1, 3 }, 4 });
  CHECK_FALSE(parts.is_valid());
}

TEST_CASE("Truncation: facets with a common edge must cut it at the same points")
{
  // Two edges connect the vertices 0 and 1, between four facets. Both vertices are cut off, and each edge is cut twice.
  const Index npos = Truncation::npos;
  Parts parts;
  parts.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } };
  for(int n = 0; n < 8; ++n) parts.points.push_back({ 0.1 * n, 0.5, 0.5 });
  parts.cut_facets = { { 0, 1, 2 }, { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 1 } };
  parts.cuts = { { 0, 1, npos, 0.25, 0 }, { 0, 2, npos, 0.25, 0 }, { 0, 1, npos, 0.375, 0 }, { 0, 3, npos, 0.25, 0 },
                 { 1, 0, npos, 0.25, 0 }, { 1, 2, npos, 0.25, 0 }, { 1, 0, npos, 0.25, 0 },  { 1, 3, npos, 0.25, 0 } };
  Truncation::Disc disc;
  disc.center = 0;
  disc.rim = { 4, 5, 6, 7 };
  disc.facets = { 0, 1, 2, 3 };
  disc.triangles = { { 5, 6, 7 }, { 5, 7, 4 } };
  parts.discs.push_back(disc);
  disc.center = 1;
  disc.rim = { 10, 9, 8, 11 };
  disc.facets = { 1, 0, 3, 2 };
  disc.triangles = { { 10, 9, 8 }, { 10, 8, 11 } };
  parts.discs.push_back(disc);
  parts.planar = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 }, { -1, 0 }, { 0, 1 }, { 1, 0 }, { 0, -1 } };
  parts.cores = { { { 2, 5, 4 }, 0 },  { { 2, 8, 9 }, 0 }, { { 9, 10, 6 }, 1 }, { { 9, 6, 5 }, 1 },
                  { { 9, 5, 2 }, 1 },  { { 3, 7, 6 }, 2 }, { { 3, 6, 10 }, 2 }, { { 3, 10, 11 }, 2 },
                  { { 3, 11, 8 }, 3 }, { { 3, 8, 4 }, 3 }, { { 3, 4, 7 }, 3 } };
  Parts same = parts;
  same.cores.push_back({ { 2, 4, 8 }, 0 });
  CHECK(same.is_valid());
  // The first facet also has a cut of the other edge.
  parts.cores.push_back({ { 2, 4, 6 }, 0 });
  parts.cores.push_back({ { 2, 6, 8 }, 0 });
  CHECK_FALSE(parts.is_valid());
}

TEST_CASE("Truncation: a disc must not have a hole")
{
  Parts parts = square_pyramid();
  Truncation::Disc& disc = parts.discs[0];
  disc.triangles.clear();
  for(Index i = 0; i < 4; ++i) {
    const auto p = parts.points[1 + i]; // a copy, as the vector grows
    parts.points.push_back({ p[0] / 4, p[1] / 4, 0.5 });
    parts.planar.push_back({ p[0] / 2, p[1] / 2 });
    const Index j = (i + 1) % 4;
    disc.triangles.push_back({ 5 + i, 5 + j, 9 + j });
    disc.triangles.push_back({ 5 + i, 9 + j, 9 + i });
  }
  CHECK_FALSE(parts.is_valid());
  disc.triangles.push_back({ 9, 10, 11 });
  CHECK_FALSE(parts.is_valid());
  disc.triangles.push_back({ 9, 11, 12 });
  CHECK(parts.is_valid());
}

TEST_CASE("Truncation: a fan that winds twice cannot be a tip")
{
  // five cuts in the order of a pentagram
  Parts parts;
  parts.points = { { 0, 0, 1 } };
  Truncation::Disc disc;
  disc.center = 0;
  const auto at = [](int i) {
    const double angle = 0.4 * CGAL_PI * (2 * i % 5);
    return Truncation::Planar_point{ std::cos(angle), std::sin(angle) };
  };
  for(int i = 0; i < 5; ++i) parts.points.push_back({ at(i)[0], at(i)[1], 0 });
  for(Index i = 0; i < 5; ++i) {
    const Index j = (i + 1) % 5;
    parts.cut_facets.push_back({ 0, 1 + i, 1 + j });
    parts.points.push_back({ at(int(i))[0] / 2, at(int(i))[1] / 2, 0.5 });
    parts.cuts.push_back({ 0, 1 + i, Truncation::npos, 0.5, 0 });
    parts.planar.push_back(at(int(i)));
    parts.cores.push_back({ { 6 + i, 1 + i, 1 + j }, i });
    parts.cores.push_back({ { 6 + i, 1 + j, 6 + j }, i });
    disc.rim.push_back(6 + i);
    disc.facets.push_back(i);
  }
  parts.points.push_back({ 0, 0, 0.5 });
  parts.planar.push_back({ 0, 0 });
  for(Index i = 0; i < 5; ++i) disc.triangles.push_back({ 6 + i, 6 + (i + 1) % 5, 11 });
  parts.discs.push_back(disc);
  CHECK_FALSE(parts.is_valid());
  for(Index i = 0; i < 5; ++i) parts.planar[i] = { std::cos(0.4 * CGAL_PI * i), std::sin(0.4 * CGAL_PI * i) };
  CHECK(parts.is_valid());
}

TEST_CASE("Truncation: the map fixes all points that are not cut off, and is undone by its inverse")
{
  for(bool has_point : { false, true }) {
    const Truncation t = square_pyramid(has_point).assembled();
    REQUIRE(t.is_valid());
    std::mt19937 random(1);
    for(int n = 0; n < 4000; ++n) {
      const Truncation::Place place = { Index(random() % 4), random_barycentric(random) };
      const Truncation::Place image = t.image(place);
      REQUIRE(image.facet < t.number_of_new_facets());
      const Truncation::Place back = t.preimage(image);
      CHECK(distance(point(t, place, false), point(t, back, false)) < 1e-14);
      const bool is_in_tip = place.barycentric[0] > 0.5;
      CHECK((t.disc_of_new_facet(image.facet) == 0) == is_in_tip);
      if(!is_in_tip) CHECK(distance(point(t, place, false), point(t, image, true)) < 1e-15);
    }
    for(int n = 0; n < 4000; ++n) {
      const Truncation::Place place = { Index(random() % t.number_of_new_facets()), random_barycentric(random) };
      CHECK(distance(point(t, place, true), point(t, t.image(t.preimage(place)), true)) < 1e-14);
    }
    // the image of the apex, computed in each of its facets
    const Point_3 apex = point(t, t.image({ 0, { 1, 0, 0 } }), true);
    for(Index f = 1; f < 4; ++f) CHECK(distance(apex, point(t, t.image({ f, { 1, 0, 0 } }), true)) < 1e-15);
    // It is in the middle of the planar square, on the diagonal of the disc.
    if(!has_point) CHECK(distance(apex, Point_3(0, 0, 0.5)) < 1e-15);
  }
}

TEST_CASE("Truncation: the map is one-to-one, and covers each disc once")
{
  const Truncation t = square_pyramid(true).assembled();
  // A fine grid of triangles in each tip is mapped to the disc. Areas are positive, and sum to the area of the disc.
  double area = 0;
  constexpr int n = 64;
  const auto planar = [&](const Truncation::Place& place) {
    const Truncation::Triangle triangle = t.new_facet(place.facet);
    Truncation::Planar_point x = {};
    for(int i = 0; i < 3; ++i)
      for(int a = 0; a < 2; ++a) x[a] += place.barycentric[i] * t.planar()[triangle[i] - t.number_of_corners()][a];
    return x;
  };
  for(Index f = 0; f < 4; ++f)
    for(int i = 0; i < n; ++i)
      for(int j = 0; i + j < n; ++j)
        for(int up = 0; up < (i + j + 1 < n ? 2 : 1); ++up) {
          std::array<Truncation::Planar_point, 3> x;
          const int di[2][3] = { { 0, 1, 0 }, { 1, 1, 0 } }, dj[2][3] = { { 0, 0, 1 }, { 0, 1, 1 } };
          for(int k = 0; k < 3; ++k) {
            const double u = 0.4999 * (i + di[up][k]) / n, v = 0.4999 * (j + dj[up][k]) / n;
            x[k] = planar(t.image({ f, { 1 - u - v, u, v } }));
          }
          const double twice = (x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[1][1] - x[0][1]) * (x[2][0] - x[0][0]);
          CHECK(twice > 0);
          area += twice / 2;
        }
  const double expected = 2 * 0.9998 * 0.9998;
  CHECK(area == Approx(expected).epsilon(1e-9));
}

TEST_CASE("Truncation: the derivative of the map agrees with finite differences")
{
  const Truncation t = square_pyramid(true).assembled();
  std::mt19937 random(1);
  int tried = 0;
  for(int n = 0; n < 400; ++n) {
    const Truncation::Place place = { Index(random() % 4), random_barycentric(random) };
    const auto columns = t.derivative(place);
    const Truncation::Place image = t.image(place);
    for(int k = 0; k < 3; ++k) {
      constexpr double step = 1e-7;
      Truncation::Place moved = place;
      moved.barycentric[k] += step;
      moved.barycentric[(k + 1) % 3] -= step;
      if(!(moved.barycentric[(k + 1) % 3] > 0) || t.image(moved).facet != image.facet) continue;
      ++tried;
      for(int i = 0; i < 3; ++i)
        CHECK((t.image(moved).barycentric[i] - image.barycentric[i]) / step
              == Approx(columns[k][i] - columns[(k + 1) % 3][i]).margin(1e-6));
    }
  }
  CHECK(tried > 800);
}

namespace {

template <typename FaceGraph>
void check_applied(bool has_point)
{
  FaceGraph mesh;
  const Mesh start = pyramid(4, 1);
  CGAL::copy_face_graph(start, mesh);
  Parts parts = square_pyramid(has_point);
  const double before = PMP::volume(mesh);
  const Truncation t = parts.assembled();
  auto vpm = get(CGAL::vertex_point, mesh);
  const auto found = t.match(mesh, vpm);
  REQUIRE(std::count(found.begin(), found.end(), boost::graph_traits<FaceGraph>::null_halfedge()) == 0);
  for(std::size_t n = 0; n < found.size(); ++n) {
    const auto &p = get(vpm, source(found[n], mesh)), &q = get(vpm, target(found[n], mesh));
    CHECK(Truncation::Point{ p[0], p[1], p[2] } == t.points()[t.cut_facets()[n][0]]);
    CHECK(Truncation::Point{ q[0], q[1], q[2] } == t.points()[t.cut_facets()[n][1]]);
  }
  const auto applied = t.apply(mesh, vpm);
  REQUIRE(applied);
  const auto& truncated = *applied;
  CHECK(truncated.patches == 1);
  CHECK(CGAL::is_valid_polygon_mesh(mesh));
  CHECK(CGAL::is_closed(mesh));
  CHECK(CGAL::is_triangle_mesh(mesh));
  CHECK(truncated.vertices[0] == boost::graph_traits<FaceGraph>::null_vertex());
  REQUIRE(truncated.facets.size() == t.number_of_new_facets());
  for(std::size_t n = 0; n < truncated.facets.size(); ++n) {
    REQUIRE(truncated.facets[n] != boost::graph_traits<FaceGraph>::null_face());
    std::vector<Truncation::Point> corners;
    for(auto v : CGAL::vertices_around_face(halfedge(truncated.facets[n], mesh), mesh)) {
      const auto& p = get(vpm, v);
      corners.push_back({ p[0], p[1], p[2] });
    }
    const Truncation::Triangle triangle = t.new_facet(n);
    const auto first = std::find(corners.begin(), corners.end(), t.points()[triangle[0]]);
    REQUIRE(first != corners.end());
    std::rotate(corners.begin(), first, corners.end());
    for(int i = 0; i < 3; ++i) CHECK(corners[i] == t.points()[triangle[i]]);
  }
  // The part that is cut off has half the size of the pyramid. The roof on its base has a fifth of its height.
  const double tip = before / 8;
  CHECK(PMP::volume(mesh) == Approx(before - tip + (has_point ? tip * 0.2 : 0)));
  // Nothing is left to truncate.
  const auto again = t.match(mesh, vpm);
  CHECK(std::count(again.begin(), again.end(), boost::graph_traits<FaceGraph>::null_halfedge()) == 4);
  CHECK(t.apply(mesh, vpm)->patches == 0);
}

} // namespace

TEST_CASE("Truncation: meshes of several types can be truncated")
{
  for(bool has_point : { false, true }) {
    check_applied<Mesh>(has_point);
    check_applied<CGAL::Polyhedron_3<Kernel> >(has_point);
  }
}

TEST_CASE("Truncation: a mesh that lacks a facet of a patch is left unchanged")
{
  const Truncation t = square_pyramid().assembled();
  for(int change = 0; change < 3; ++change) {
    CAPTURE(change);
    Mesh mesh = pyramid(4, 1);
    if(change == 0) mesh.point(Mesh::Vertex_index(2)) = Point_3(1, 0, -0.1);
    if(change == 1)
      mesh.point(mesh.target(CGAL::Euler::add_center_vertex(mesh.halfedge(Mesh::Vertex_index(0)), mesh))) = Point_3(
        0.3, 0.3, 0.35);
    if(change == 2) {
      for(auto f : mesh.faces()) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
      mesh.collect_garbage();
    }
    const Mesh before = mesh;
    const auto truncated = t.apply(mesh, mesh.points());
    REQUIRE(truncated);
    CHECK(truncated->patches == 0);
    const std::vector<Mesh::Face_index> none(t.number_of_new_facets(), Mesh::null_face());
    CHECK(truncated->facets == none);
    CHECK(is_equal(before, mesh));
  }
}

namespace {

template <typename FaceGraph>
void check_truncated(const Mesh& start, const std::vector<Mesh::Vertex_index>& centers, std::size_t patches)
{
  for(bool has_point : { false, true }) {
    FaceGraph mesh;
    CGAL::copy_face_graph(start, mesh);
    const bool was_closed = CGAL::is_closed(mesh);
    const Truncation t = truncation_at(start, centers, has_point).assembled();
    REQUIRE(t.is_valid());
    const auto truncated = t.apply(mesh, get(CGAL::vertex_point, mesh));
    REQUIRE(truncated);
    CHECK(truncated->patches == patches);
    CHECK(CGAL::is_valid_polygon_mesh(mesh));
    CHECK(CGAL::is_triangle_mesh(mesh));
    CHECK(CGAL::is_closed(mesh) == was_closed);
    CHECK(faces(mesh).size() == start.number_of_faces() - t.cut_facets().size() + t.number_of_new_facets());
  }
}

} // namespace

TEST_CASE("Truncation: discs may share facets and edges, touch the border, and replace all vertices")
{
  const Mesh ball = sphere(1);
  std::vector<Mesh::Vertex_index> all(ball.vertices().begin(), ball.vertices().end());
  const Mesh::Vertex_index v(0), beside = ball.source(ball.halfedge(v));
  check_truncated<Mesh>(ball, { v, beside }, 1);
  check_truncated<Mesh>(ball, all, 1);
  check_truncated<CGAL::Polyhedron_3<Kernel> >(ball, { v, beside }, 1);
  check_truncated<CGAL::Polyhedron_3<Kernel> >(ball, all, 1);
  // All facets at the only inner vertex have an edge on the border.
  const Mesh roof = [] {
    Mesh mesh = pyramid(5, 1);
    for(auto g : std::vector<Mesh::Face_index>(mesh.faces().begin(), mesh.faces().end())) {
      bool has_apex = false;
      for(auto u : mesh.vertices_around_face(mesh.halfedge(g))) has_apex = has_apex || u == Mesh::Vertex_index(0);
      if(!has_apex) CGAL::Euler::remove_face(mesh.halfedge(g), mesh);
    }
    mesh.collect_garbage();
    return mesh;
  }();
  REQUIRE(roof.number_of_faces() == 5);
  Mesh::Vertex_index apex;
  for(auto u : roof.vertices())
    if(!roof.is_border(u)) apex = u;
  check_truncated<Mesh>(roof, { apex }, 1);
  check_truncated<CGAL::Polyhedron_3<Kernel> >(roof, { apex }, 1);
}

TEST_CASE("Truncation: a patch of two discs is matched as a whole or not at all")
{
  const Mesh ball = sphere(1);
  const Mesh::Vertex_index v(0), beside = ball.source(ball.halfedge(v));
  const Truncation t = truncation_at(ball, { v, beside }, false).assembled();
  REQUIRE(t.is_valid());
  // The moved corner belongs only to facets of the second disc.
  Mesh mesh = ball;
  for(auto u : mesh.vertices_around_target(mesh.halfedge(beside)))
    if(u != v && !mesh.halfedge(u, v).is_valid()) {
      mesh.point(u) = CGAL::ORIGIN + 1.01 * (mesh.point(u) - CGAL::ORIGIN);
      break;
    }
  REQUIRE_FALSE(is_equal(mesh, ball));
  const auto found = t.match(mesh, mesh.points());
  CHECK(std::count(found.begin(), found.end(), Mesh::null_halfedge()) == std::ptrdiff_t(found.size()));
}

TEST_CASE("Truncation: a vertex with reordered neighbors or additional facets does not match the patch")
{
  const Mesh start = pyramid(5, 1);
  const Truncation t = truncation_at(start, { Mesh::Vertex_index(0) }, false).assembled();
  REQUIRE(t.is_valid());
  const auto is_found = [&](const Mesh& mesh) {
    const auto found = t.match(mesh, mesh.points());
    return std::count(found.begin(), found.end(), Mesh::null_halfedge()) == 0;
  };
  REQUIRE(is_found(start));
  // A pentagram around the apex, whose facets have the same orientation.
  Mesh star;
  std::vector<Mesh::Vertex_index> v;
  for(auto u : start.vertices()) v.push_back(star.add_vertex(start.point(u)));
  std::vector<Mesh::Vertex_index> ring;
  auto spoke = start.opposite(start.halfedge(Mesh::Vertex_index(0)));
  for(; ring.size() < 5; spoke = start.opposite(start.prev(spoke))) ring.push_back(v[start.target(spoke)]);
  for(int i = 0; i < 5; ++i) star.add_face(v[0], ring[2 * i % 5], ring[2 * (i + 1) % 5]);
  CHECK(star.degree(v[0]) == 5);
  CHECK_FALSE(is_found(star));
  // A fin: an edge is doubled, with two facets between both copies.
  Mesh fin = start;
  const auto h = fin.halfedge(Mesh::Vertex_index(0)), g = fin.opposite(h);
  const auto n = fin.next(h), e = fin.add_edge(); // a second edge beside h, and a facet with two edges between them
  const auto f = fin.face(h), digon = fin.add_face();
  const auto p = fin.prev(h);
  fin.set_target(e, fin.target(h));
  fin.set_target(fin.opposite(e), fin.source(h));
  fin.set_next(p, e);
  fin.set_next(e, n);
  fin.set_face(e, f);
  fin.set_halfedge(f, e);
  fin.set_next(h, fin.opposite(e));
  fin.set_next(fin.opposite(e), h);
  fin.set_face(h, digon);
  fin.set_face(fin.opposite(e), digon);
  fin.set_halfedge(digon, h);
  CHECK(fin.opposite(h) == g);
  const auto middle = fin.target(CGAL::Euler::add_center_vertex(h, fin));
  fin.point(middle) = Point_3(2, 2, 2);
  REQUIRE(fin.is_valid());
  REQUIRE(fin.degree(Mesh::Vertex_index(0)) == 7);
  CHECK_FALSE(is_found(fin));
}

TEST_CASE("Truncation: a polygon is only cut into triangles that triangulate it")
{
  typedef std::vector<std::pair<Truncation::Triangle, std::size_t> > Triangles;
  const auto is_cut = [](const Triangles& triangles) {
    Mesh mesh;
    std::vector<Mesh::Vertex_index> v;
    for(int i = 0; i < 6; ++i) v.push_back(mesh.add_vertex(Point_3(std::cos(i), std::sin(i), 0)));
    const auto f = mesh.add_face(std::vector<Mesh::Vertex_index>(v.begin(), v.begin() + 5));
    std::size_t cut = 0;
    const auto count = [&](std::size_t, Mesh::Face_index) { ++cut; };
    const bool is = BS::internal::cut_into_triangles(mesh.halfedge(f), mesh, v, triangles, count);
    if(is) CHECK(cut == 3);
    return is;
  };
  CHECK(is_cut({ { { 0, 1, 2 }, 0 }, { { 0, 2, 3 }, 1 }, { { 0, 3, 4 }, 2 } }));
  CHECK(is_cut({ { { 2, 4, 1 }, 0 }, { { 4, 0, 1 }, 1 }, { { 3, 4, 2 }, 2 } }));
  // a missing triangle; reversed triangles; a wrong point; overlapping triangles
  CHECK_FALSE(is_cut({ { { 0, 1, 2 }, 0 }, { { 0, 2, 3 }, 1 } }));
  CHECK_FALSE(is_cut({ { { 0, 2, 1 }, 0 }, { { 0, 3, 2 }, 1 }, { { 0, 4, 3 }, 2 } }));
  CHECK_FALSE(is_cut({ { { 0, 1, 2 }, 0 }, { { 0, 2, 3 }, 1 }, { { 0, 3, 5 }, 2 } }));
  CHECK_FALSE(is_cut({ { { 0, 1, 3 }, 0 }, { { 0, 2, 3 }, 1 }, { { 0, 3, 4 }, 2 } }));
}

TEST_CASE("Truncation: an invalid truncation leaves every mesh unchanged")
{
  Parts parts = square_pyramid();
  parts.cores.pop_back();
  Mesh mesh = pyramid(4, 1);
  const auto truncated = parts.assembled().apply(mesh, mesh.points());
  REQUIRE(truncated);
  CHECK(truncated->patches == 0);
  CHECK(is_equal(mesh, pyramid(4, 1)));
}
} // namespace test_Shell_truncation_3
