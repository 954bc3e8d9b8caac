// Rounding an exact union: facets that become degenerate are combined with their neighbors in the same source.
#include <CGAL/Bspline_shell_3/Soup/internal/Rounded_union.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Solid_finder.h>
#include <CGAL/Bspline_shell_3/Soup/internal/exact_union.h>
#include <CGAL/Bspline_shell_3/Soup/unite_parts.h>
#include "test_meshes.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/tags.h>

#include <array>
#include <cstddef>
#include <vector>

namespace test_Rounded_union {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace BI = CGAL::Bspline_shells::internal;

typedef BI::Exact_kernel::Point_3 Exact_point;

} // namespace

TEST_CASE("Rounding of a union: the edge of a facet that becomes degenerate is flipped")
{
  const Mesh cube = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  // The first facet is (a, b, c), and its neighbor is (c, b, d). A new point m is in the middle of their common edge.
  // Another new point p is almost on the segment from a to m.
  const Mesh::Face_index first(0);
  const Mesh::Halfedge_index ab = cube.halfedge(first), cb = cube.opposite(cube.next(ab));
  const Mesh::Face_index second = cube.face(cb);
  const Mesh::Vertex_index a = cube.source(ab), b = cube.target(ab), c = cube.source(cb),
                           d = cube.target(cube.next(cb));

  BI::Exact_mesh exact;
  const BI::Exact_sources sources = BI::sources_of(exact);
  std::vector<BI::Exact_mesh::Vertex_index> v;
  for(auto n : cube.vertices())
    v.push_back(exact.add_vertex(Exact_point(cube.point(n).x(), cube.point(n).y(), cube.point(n).z())));
  const Exact_point at_m = CGAL::midpoint(exact.point(v[b]), exact.point(v[c]));
  const auto m = exact.add_vertex(at_m);
  const auto p = exact.add_vertex(CGAL::midpoint(exact.point(v[a]), at_m)
                                  + 1e-30 * (exact.point(v[b]) - exact.point(v[c])));
  const auto add = [&](auto i, auto j, auto k, Mesh::Face_index source) {
    const auto f = exact.add_face(i, j, k);
    REQUIRE(f.is_valid());
    sources[f] = source;
  };
  for(auto f : cube.faces()) {
    if(f == first || f == second) continue;
    const auto h = cube.halfedge(f);
    add(v[cube.source(h)], v[cube.target(h)], v[cube.target(cube.next(h))], f);
  }
  add(v[c], m, v[d], second);
  add(m, v[b], v[d], second);
  add(v[a], v[b], p, first);
  add(v[b], m, p, first);
  add(m, v[a], p, first); // becomes degenerate
  add(v[a], m, v[c], first);

  BI::Solids solids;
  solids.solid_of_facet.assign(cube.number_of_faces(), 0);
  solids.color = { 0 };
  solids.number_of_colors = 1;
  BS::United_mesh united;
  const auto [status, facets] = BI::Rounded_union(cube, solids, exact, united).compute<CGAL::Sequential_tag>();
  CHECK(status == BS::Unite_status::UNITED);
  CHECK(facets.empty());
  CHECK(united.mesh.number_of_faces() == 16);
  CHECK(CGAL::is_closed(united.mesh));
  CHECK_FALSE(CGAL::Polygon_mesh_processing::does_self_intersect(united.mesh));
  CHECK(united.hidden_share == std::vector<double>(12, 0));
  for(Mesh::Face_index f : united.mesh.faces()) {
    CHECK(CGAL::Polygon_mesh_processing::face_area(f, united.mesh) > 0.1);
    const auto t = corners(united.mesh, f), s = corners(cube, Mesh::Face_index(Mesh::size_type(united.source[f])));
    for(std::size_t i = 0; i < 3; ++i) {
      const auto& at = united.corners[f][i];
      CHECK(CGAL::barycenter(s[0], at[0], s[1], at[1], s[2], at[2]) == t[i]);
    }
  }
}
} // namespace test_Rounded_union
