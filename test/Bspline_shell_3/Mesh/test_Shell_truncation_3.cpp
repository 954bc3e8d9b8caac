// Shell_truncation_3.h: handmade truncations are proved, and each error in them is found.
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include "truncations.h"

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace test_Shell_truncation_3 {

namespace BS = CGAL::Bspline_shells;
typedef BS::Shell_truncation_3 Truncation;
typedef Truncation::Index Index;
typedef Truncation_parts Parts;

TEST_CASE("Truncation: a handmade truncation is proved valid")
{
  CHECK(square_pyramid(false).is_valid());
  CHECK(square_pyramid(true).is_valid());
  CHECK_FALSE(Truncation().is_valid());
  const Truncation t = square_pyramid(true).assembled();
  CHECK(t.number_of_corners() == 5);
  REQUIRE(t.new_facets().size() == 12);
  CHECK(t.new_facets()[7].disc == Truncation::npos);
  CHECK(t.new_facets()[8].disc == 0);
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
} // namespace test_Shell_truncation_3
