// relax_vertices.h: vertices that are moved concurrently do not depend on each other.
#include <CGAL/Bspline_shell_3/Editing/internal/relax_vertices.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Guarded_mesh.h>
#include "test_meshes.h"

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <set>
#include <vector>

namespace test_relax_vertices {

namespace BS = CGAL::Bspline_shells;

namespace {

// An oracle that accepts all stars, and records them.
struct Recording_oracle
{
  typedef Kernel::Point_3 Point_3;
  struct Memory
  {};
  struct Star
  {
    Point_3 center;
    std::vector<Point_3> link;
  };

  std::vector<Star>* stars;

  BS::Placement_verdict operator()(const Point_3& p, const std::vector<Point_3>& link, Memory&) const
  {
    stars->push_back({ p, link });
    return BS::Placement_verdict::ACCEPTED;
  }
};

} // namespace

TEST_CASE("Remeshing: no vertex is in the star of another one that is moved at the same time")
{
  Mesh mesh = torus(1, 0.4, 24, 12);
  const Mesh before = mesh;
  std::vector<Recording_oracle::Star> stars;
  const Recording_oracle oracle{ &stars };
  BS::internal::Remeshing_options<Mesh, Kernel::Point_3> options;
  options.target_length = [](const Kernel::Point_3&) { return 1.; };
  options.go_on = [] { return true; };
  const BS::internal::Frozen_facets<Mesh> frozen(mesh);
  BS::Remeshing_report report;
  BS::internal::Guarded_mesh guarded(mesh, mesh.points(), oracle, frozen, options, {}, report);
  BS::internal::relax_vertices<CGAL::Sequential_tag>(guarded, [](const Kernel::Point_3& p) { return p; });
  REQUIRE(stars.size() > 100);
  REQUIRE(report.moves == stars.size());
  // If vertices are moved one by one, each has the link with which it was accepted.
  Mesh replayed = before;
  for(const auto& star : stars) {
    const auto found = std::find_if(replayed.vertices_begin(), replayed.vertices_end(), [&](Mesh::Vertex_index v) {
      std::set<Kernel::Point_3> link;
      for(auto h : CGAL::halfedges_around_target(v, replayed)) link.insert(replayed.point(replayed.source(h)));
      return link == std::set<Kernel::Point_3>(star.link.begin(), star.link.end());
    });
    REQUIRE(found != replayed.vertices_end());
    replayed.point(*found) = star.center;
  }
  CHECK(is_equal(replayed, mesh));
}
} // namespace test_relax_vertices
