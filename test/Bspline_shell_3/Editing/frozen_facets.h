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

// Returns a shell with additional room around its mesh.
template <typename Shell>
Shell widened(const Shell& shell, double room)
{
  return Shell(shell.field(),
               CGAL::Bspline_shells::Level_range{ shell.inner_level() - room, shell.outer_level() + room },
               std::vector<char>(shell.field().number_of_cells(), 1), shell.facet_ranges(), shell.report());
}

template <typename Oracle>
bool is_accepted(const Oracle& oracle, const Mesh& mesh, Mesh::Face_index f)
{
  const std::array<Point_3, 3> t = corners(mesh, f);
  return oracle(t[0], t[1], t[2]) == CGAL::Bspline_shells::Placement_verdict::ACCEPTED;
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
  for(auto f : facets) rejected += frozen.count(f) == 0 && !is_accepted(oracle, mesh, f);
  for(auto v : mesh.vertices())
    if(vertices.count(v) == 0) folded += oracle.winding_number(mesh.point(v), link_of(mesh, v)) != 1;
  CHECK(rejected == 0);
  CHECK(folded == 0);
}

#endif // FROZEN_FACETS_H
