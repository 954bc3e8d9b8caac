// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDIT_UNDER_PROOF_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDIT_UNDER_PROOF_H

#include <CGAL/Bspline_shell_3/Certificate/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_report.h>
#include <CGAL/Bspline_shell_3/Projection/project_points.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/FPU.h>
#include <CGAL/Real_timer.h>
#include <CGAL/Surface_mesh/Surface_mesh_fwd.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// whether a mesh is one that can be edited in a shell, as far as that is cheap to tell
template <typename TriangleMesh, typename VertexPointMap, typename Shell>
Edit_status check_before_edits(const TriangleMesh& mesh, VertexPointMap vpm, const Shell& shell)
{
  if(!shell) return Edit_status::NO_SHELL;
  if(faces(mesh).begin() == faces(mesh).end() || !CGAL::is_triangle_mesh(mesh)) return Edit_status::NOT_TRIANGULATED;
  if(!CGAL::is_closed(mesh)) return Edit_status::OPEN_MESH;
  for(auto v : vertices(mesh)) {
    const auto& p = get(vpm, v);
    if(!(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()))) return Edit_status::NOT_FINITE;
  }
  return Edit_status::SUCCESS;
}

// What a filter keeps must hold to begin with: facets accepted, fans that wind once. Facets with an edge of length zero do not count:
// they are collapsed first.
template <typename ConcurrencyTag, typename TriangleMesh, typename VertexPointMap, typename Oracle>
bool is_accepted(const TriangleMesh& mesh, VertexPointMap vpm, const Oracle& oracle, Offending_simplices& offenders)
{
  typedef typename boost::property_traits<VertexPointMap>::value_type Point;
  constexpr std::size_t chunk = 256;
  const auto has_zero_edge = [&](const auto& h) {
    return get(vpm, source(h, mesh)) == get(vpm, target(h, mesh));
  };
  const std::vector<typename boost::graph_traits<TriangleMesh>::face_descriptor> facets(faces(mesh).begin(), faces(mesh).end());
  std::vector<char> is_good(facets.size(), 1);
  for_each_chunk<ConcurrencyTag>(facets.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) {
      const auto h = halfedge(facets[n], mesh);
      if(has_zero_edge(h) || has_zero_edge(next(h, mesh)) || has_zero_edge(prev(h, mesh))) continue;
      is_good[n] = oracle(get(vpm, source(h, mesh)), get(vpm, target(h, mesh)), get(vpm, target(next(h, mesh), mesh)))
                     == Placement_verdict::ACCEPTED;
    }
  });
  for(std::size_t n = 0; n < is_good.size(); ++n)
    if(!is_good[n]) offenders.facets.push_back(n);
  if(!offenders.facets.empty()) return false;
  std::vector<Point> link;
  std::size_t position = 0;
  for(auto v : vertices(mesh)) {
    const std::size_t n = position++;
    if(halfedge(v, mesh) == boost::graph_traits<TriangleMesh>::null_halfedge()) continue;
    link.clear();
    bool is_degenerate = false;
    for(auto h : CGAL::halfedges_around_target(v, mesh)) {
      link.push_back(get(vpm, source(h, mesh)));
      is_degenerate = is_degenerate || has_zero_edge(h) || has_zero_edge(prev(h, mesh));
    }
    if(is_degenerate) continue;
    std::reverse(link.begin(), link.end());
    if(oracle.winding_number(get(vpm, v), link) != 1) offenders.vertices.push_back(n);
  }
  return offenders.vertices.empty();
}

template <typename TriangleMesh>
void assign(const TriangleMesh& before, TriangleMesh& mesh)
{
  mesh = before;
}

// Assigned to, a Surface_mesh would replace its properties: maps of the caller's would dangle, and those that are dynamic would remove others when
// they go. So it is emptied, and filled again. \pre `before` is a copy of what the mesh was
template <typename Point>
void assign(const Surface_mesh<Point>& before, Surface_mesh<Point>& mesh)
{
  for(auto v : mesh.vertices()) mesh.remove_vertex(v);
  for(auto e : mesh.edges()) mesh.remove_edge(e);
  for(auto f : mesh.faces()) mesh.remove_face(f);
  mesh.collect_garbage();
  mesh.join(before);
}

// the mesh as it was; `points` are those that its vertices had, in their order
template <typename TriangleMesh, typename Point, typename VertexPointMap>
void restore(const TriangleMesh& before, const std::vector<Point>& points, TriangleMesh& mesh, VertexPointMap vpm)
{
  assign(before, mesh);
  // points in the mesh came back with it, others did not
  if constexpr(!std::is_same<VertexPointMap, typename boost::property_map<TriangleMesh, vertex_point_t>::type>::value) {
    std::size_t n = 0;
    for(auto v : vertices(mesh)) put(vpm, v, points[n++]);
  }
}

// where the integral curves through points meet a mesh
template <typename ConcurrencyTag, typename Result, typename Shell, typename Point, typename TriangleMesh, typename VertexPointMap>
void locate(const Shell& shell, const std::vector<Point>& points, const TriangleMesh& mesh, VertexPointMap vpm, Result& result)
{
  for(const auto& image : project_points<ConcurrencyTag>(shell, points, mesh, CGAL::parameters::vertex_point_map(vpm)))
    result.locations.push_back(image.location);
}

// Checks the mesh, edits it, and certifies the result; what is not certified is undone. `edit(oracle)` writes images and counts to the result, and
// returns why it is to be undone, or success; properties that it attaches to the mesh must be gone when it returns.
// \pre `check_before_edits()` accepts the mesh
template <typename ConcurrencyTag, typename TriangleMesh, typename VertexPointMap, typename Field, typename Threshold, typename NamedParameters,
          typename Result, typename Edit>
Edit_status edit_under_proof(TriangleMesh& mesh, VertexPointMap vpm, const Bspline_shell_3<Field, Threshold>& shell, const NamedParameters& np,
                             Result& result, const Edit& edit)
{
  typedef typename boost::property_traits<VertexPointMap>::value_type Point;
  Real_timer timer;
  timer.start();
  const auto lap = [&timer](double& seconds) {
    seconds = timer.time();
    timer.reset();
  };
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);      // that of exact predicates
  const Shell_facet_oracle_3<Field, Threshold, ConcurrencyTag> oracle(shell);
  const bool accepted = is_accepted<ConcurrencyTag>(mesh, vpm, oracle, result.offending_simplices);
  lap(result.check_seconds);
  if(!accepted) return Edit_status::NOT_IN_SHELL;

  const TriangleMesh before(mesh);
  std::vector<Point> points;
  for(auto v : vertices(mesh)) points.push_back(get(vpm, v));
  const auto undone = [&](Edit_status status) {
    restore(before, points, mesh, vpm);
    result.facets = result.facets_before;
    result.images.clear();
    return status;
  };
  const Edit_status edited = edit(oracle);
  result.facets = faces(mesh).size();
  lap(result.edit_seconds);
  if(edited != Edit_status::SUCCESS) return undone(edited);

  Shell_certificate_3<Field, Threshold> certificate(shell, oracle.bounds());
  const bool certified = certificate.template verify<ConcurrencyTag>(mesh, CGAL::parameters::vertex_point_map(vpm));
  result.certificate = certificate.report();
  lap(result.certificate_seconds);
  if(!certified) return undone(Edit_status::NOT_CERTIFIED);
  // not compiled for those who do not ask
  if constexpr(!CGAL::parameters::is_default_parameter<NamedParameters, parameter_tags::locate_vertices_t>::value)
    if(CGAL::parameters::get_parameter(np, parameter_tags::locate_vertices)) {
      locate<ConcurrencyTag>(shell, points, mesh, vpm, result);
      lap(result.location_seconds);
    }
  return Edit_status::SUCCESS;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDIT_UNDER_PROOF_H
