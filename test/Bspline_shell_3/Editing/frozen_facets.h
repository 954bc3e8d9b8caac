// Meshes with facets that are not in the shell, and checks of edits of such meshes.
#ifndef FROZEN_FACETS_H
#define FROZEN_FACETS_H

#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_report.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

// Returns a sphere of slices around its axis, in `turns` turns. Triangles are thinner closer to the poles, which are
// the first two vertices. With two turns, the sphere is covered twice: all facets face outwards, but the fans at the
// poles wind twice.
inline Mesh sliced_sphere(int slices, int rings, int turns = 1)
{
  Mesh mesh;
  const double pi = std::acos(-1.);
  const auto north = mesh.add_vertex(Point_3(0, 0, 1)), south = mesh.add_vertex(Point_3(0, 0, -1));
  std::vector<Mesh::Vertex_index> v;
  for(int i = 1; i < rings; ++i)
    for(int j = 0; j < slices; ++j) {
      const double a = pi * i / rings, b = 2 * pi * turns * j / slices;
      v.push_back(mesh.add_vertex(Point_3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a))));
    }
  const auto at = [&](int i, int j) { return v[(i - 1) * slices + j % slices]; };
  for(int j = 0; j < slices; ++j) {
    mesh.add_face(north, at(1, j), at(1, j + 1));
    mesh.add_face(south, at(rings - 1, j + 1), at(rings - 1, j));
    for(int i = 1; i + 1 < rings; ++i) {
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

inline std::array<Point_3, 3> corners(const Mesh& mesh, Mesh::Face_index f)
{
  const auto h = mesh.halfedge(f);
  return { { mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))) } };
}

// Checks the guarantees for a mesh with frozen facets, with a separate oracle. Frozen facets are unchanged, all other
// facets are accepted, and so are all fans without a frozen facet.
template <typename Shell>
void check_frozen_result(const CGAL::Bspline_shells::Edit_report& report, const Shell& shell, const Mesh& before,
                         const Mesh& mesh)
{
  using namespace CGAL::Bspline_shells;
  CHECK(std::string(message(report.status)) == message(Edit_status::PARTIALLY_EDITED));
  CHECK_FALSE(report);
  CHECK(std::any_of(report.certificate.verdicts.begin(), report.certificate.verdicts.end(),
                    [](Verdict v) { return v != Verdict::PROVED; }));
  CHECK(mesh.is_valid());
  CHECK(CGAL::is_closed(mesh));
  CHECK(report.facets == mesh.number_of_faces());
  REQUIRE_FALSE(report.frozen_facets.empty());
  REQUIRE(report.frozen_facets.size() == report.frozen_facets_before.size());
  const std::vector<Mesh::Face_index> facets(mesh.faces().begin(), mesh.faces().end());
  const std::vector<Mesh::Face_index> facets_before(before.faces().begin(), before.faces().end());
  std::set<Mesh::Face_index> frozen;
  std::set<Mesh::Vertex_index> vertices;
  for(std::size_t n = 0; n < report.frozen_facets.size(); ++n) {
    const Mesh::Face_index f = facets.at(report.frozen_facets[n]), g = facets_before.at(report.frozen_facets_before[n]);
    CHECK(f == g);
    CHECK(corners(mesh, f) == corners(before, g));
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) vertices.insert(v);
    frozen.insert(f);
  }
  const Shell_facet_oracle_3<typename Shell::Field, typename Shell::Threshold> oracle(shell);
  std::size_t rejected = 0, folded = 0;
  for(auto f : facets) {
    const auto c = corners(mesh, f);
    rejected += frozen.count(f) == 0 && oracle(c[0], c[1], c[2]) != Placement_verdict::ACCEPTED;
  }
  for(auto v : mesh.vertices()) {
    if(vertices.count(v) > 0) continue;
    std::vector<Point_3> link;
    for(auto h : CGAL::halfedges_around_target(v, mesh)) link.push_back(mesh.point(mesh.source(h)));
    std::reverse(link.begin(), link.end());
    folded += oracle.winding_number(mesh.point(v), link) != 1;
  }
  CHECK(rejected == 0);
  CHECK(folded == 0);
}

#endif // FROZEN_FACETS_H
