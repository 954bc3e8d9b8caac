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
#include <CGAL/Bspline_shell_3/Editing/internal/Frozen_facets.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include <CGAL/Bspline_shell_3/Projection/project_points.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/FPU.h>
#include <CGAL/Real_timer.h>
#include <CGAL/Surface_mesh/Surface_mesh_fwd.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// whether a mesh is closed, or has the border of the shell's closing
template <typename TriangleMesh, typename VertexPointMap, typename Shell>
bool has_border_of_shell(const TriangleMesh& mesh, VertexPointMap vpm, const Shell& shell)
{
  return CGAL::is_closed(mesh) || (shell.closing() && shell.closing()->match_border(mesh, vpm));
}

// whether a mesh is one that can be edited in a shell, as far as that is cheap to tell
template <typename TriangleMesh, typename VertexPointMap, typename Shell>
Edit_status check_before_edits(const TriangleMesh& mesh, VertexPointMap vpm, const Shell& shell)
{
  if(!shell) return Edit_status::NO_SHELL;
  if(faces(mesh).begin() == faces(mesh).end() || !CGAL::is_triangle_mesh(mesh)) return Edit_status::NOT_TRIANGULATED;
  if(!has_border_of_shell(mesh, vpm, shell)) return Edit_status::OPEN_MESH;
  for(auto v : vertices(mesh)) {
    const auto& p = get(vpm, v);
    if(!(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()))) return Edit_status::NOT_FINITE;
  }
  return Edit_status::SUCCESS;
}

// an edge of length zero, or a facet with one
template <typename TriangleMesh, typename VertexPointMap>
bool is_zero(typename boost::graph_traits<TriangleMesh>::halfedge_descriptor h, const TriangleMesh& mesh,
             VertexPointMap vpm)
{
  return get(vpm, source(h, mesh)) == get(vpm, target(h, mesh));
}
template <typename TriangleMesh, typename VertexPointMap>
bool has_zero_edge(typename boost::graph_traits<TriangleMesh>::face_descriptor f, const TriangleMesh& mesh,
                   VertexPointMap vpm)
{
  const auto h = halfedge(f, mesh);
  return is_zero(h, mesh, vpm) || is_zero(next(h, mesh), mesh, vpm) || is_zero(prev(h, mesh), mesh, vpm);
}

// The facets that the oracle rejects, and those at vertices whose facets it accepts but whose fan does not wind once.
// Frozen facets, and fans that have some, do not count, nor fans at a border, nor, on request, facets with an edge of
// length zero.
template <typename ConcurrencyTag, typename TriangleMesh, typename VertexPointMap, typename Oracle>
Frozen_facets<TriangleMesh> find_rejected_facets(const TriangleMesh& mesh, VertexPointMap vpm, const Oracle& oracle,
                                                 const Frozen_facets<TriangleMesh>& frozen, bool are_zero_edges_allowed,
                                                 Offending_simplices& offenders)
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point;
  constexpr std::size_t chunk = 256;
  const std::vector<typename Graph_traits::vertex_descriptor> all(vertices(mesh).begin(), vertices(mesh).end());
  const auto number = get(dynamic_vertex_property_t<std::size_t>(), mesh);
  for(std::size_t n = 0; n < all.size(); ++n) put(number, all[n], n);
  std::vector<typename Oracle::Sample> samples(all.size());
  for_each_chunk<ConcurrencyTag>(all.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) samples[n] = oracle.sample(get(vpm, all[n]));
  });
  const std::vector<typename Graph_traits::face_descriptor> facets(faces(mesh).begin(), faces(mesh).end());
  std::vector<char> is_good(facets.size(), 1);
  for_each_chunk<ConcurrencyTag>(facets.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) {
      if(frozen.has_facet(facets[n]) || frozen.closes(facets[n])
         || (are_zero_edges_allowed && has_zero_edge(facets[n], mesh, vpm)))
        continue;
      const auto h = halfedge(facets[n], mesh);
      const auto p = source(h, mesh), q = target(h, mesh), r = target(next(h, mesh), mesh);
      is_good[n] = oracle(get(vpm, p), get(vpm, q), get(vpm, r),
                          { samples[get(number, p)], samples[get(number, q)], samples[get(number, r)] })
                   == Placement_verdict::ACCEPTED;
    }
  });
  Frozen_facets<TriangleMesh> rejected(mesh);
  for(std::size_t n = 0; n < facets.size(); ++n)
    if(!is_good[n]) {
      offenders.facets.push_back(n);
      rejected.freeze(facets[n]);
    }
  const auto folded = collect_from_chunks<ConcurrencyTag, std::size_t>(
    all.size(), chunk, [&](std::size_t begin, std::size_t end, auto& found) {
      std::vector<Point> link;
      for(std::size_t n = begin; n < end; ++n) {
        const auto v = all[n];
        if(halfedge(v, mesh) == Graph_traits::null_halfedge() || frozen.has_vertex(v) || rejected.has_vertex(v))
          continue;
        if(CGAL::is_border(v, mesh) || frozen.is_fixed(v)) continue;
        link.clear();
        bool is_degenerate = false;
        for(auto h : CGAL::halfedges_around_target(v, mesh)) {
          link.push_back(get(vpm, source(h, mesh)));
          is_degenerate = is_degenerate || is_zero(h, mesh, vpm) || is_zero(prev(h, mesh), mesh, vpm);
        }
        if(is_degenerate) continue;
        std::reverse(link.begin(), link.end());
        if(oracle.winding_number(get(vpm, v), samples[n], link) != 1) found.push_back(n);
      }
    });
  offenders.vertices.insert(offenders.vertices.end(), folded.begin(), folded.end());
  for(std::size_t n : folded)
    for(auto f : CGAL::faces_around_target(halfedge(all[n], mesh), mesh)) rejected.freeze(f);
  return rejected;
}

// Facets with an edge of length zero vanish, unless a frozen vertex keeps the edge: then they are frozen, too.
template <typename TriangleMesh, typename VertexPointMap>
void freeze_zero_edges(const TriangleMesh& mesh, VertexPointMap vpm, Frozen_facets<TriangleMesh>& frozen)
{
  for(bool has_grown = true; has_grown;) {
    has_grown = false;
    for(auto e : edges(mesh)) {
      const auto h = halfedge(e, mesh);
      if(!frozen.has_end_of(e) || !is_zero(h, mesh, vpm)) continue;
      for(auto f : { face(h, mesh), face(opposite(h, mesh), mesh) }) has_grown = frozen.freeze(f) || has_grown;
    }
  }
}

// the corners of frozen facets, and where they are in faces(mesh)
template <typename TriangleMesh, typename VertexPointMap>
class Frozen_state
{
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point;
public:
  Frozen_state(const Frozen_facets<TriangleMesh>& frozen, const TriangleMesh& mesh, VertexPointMap vpm)
  {
    std::size_t position = 0;
    for(face_descriptor f : faces(mesh)) {
      const std::size_t n = position++;
      if(!frozen.has_facet(f)) continue;
      m_facets.push_back(f);
      m_positions.push_back(n);
      const auto h = halfedge(f, mesh);
      m_corners.push_back(
        { get(vpm, source(h, mesh)), get(vpm, target(h, mesh)), get(vpm, target(next(h, mesh), mesh)) });
    }
  }

  const std::vector<std::size_t>& positions() const { return m_positions; }

  // Whether all facets are what they were in another state; `numbers` are their positions now, in the order that they
  // had then. The order of facets may change where a mesh uses the places of removed ones.
  bool is_as(const Frozen_state& before, std::vector<std::size_t>& numbers) const
  {
    std::unordered_map<face_descriptor, std::size_t> now;
    for(std::size_t n = 0; n < m_facets.size(); ++n) now.emplace(m_facets[n], n);
    for(std::size_t n = 0; n < before.m_facets.size(); ++n) {
      const auto found = now.find(before.m_facets[n]);
      if(found == now.end() || m_corners[found->second] != before.m_corners[n]) return false;
      numbers.push_back(m_positions[found->second]);
    }
    return true;
  }

private:
  std::vector<face_descriptor> m_facets;
  std::vector<std::size_t> m_positions;
  std::vector<std::array<Point, 3> > m_corners;
};

template <typename TriangleMesh>
void assign(const TriangleMesh& before, TriangleMesh& mesh)
{
  mesh = before;
}

// Assigned to, a Surface_mesh would replace its properties: maps of the caller's would dangle, and those that are
// dynamic would remove others when they go. So it is emptied, and filled again.
// \pre `before` is a copy of what the mesh was
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

// What a map says of the edges of a mesh, for when these are edited, and restored: maps that are not part of the mesh
// do not come back with it. Maps that cannot be written to need no care.
template <typename TriangleMesh, typename EdgeIsConstrainedMap>
class Constraints_before
{
  typedef boost::property_traits<EdgeIsConstrainedMap> Traits;
  static constexpr bool is_writable =
    std::is_convertible<typename Traits::category, boost::writable_property_map_tag>::value
    && !std::is_const<std::remove_reference_t<typename Traits::reference> >::value;
public:
  Constraints_before(const TriangleMesh& mesh, EdgeIsConstrainedMap map) : m_map(map)
  {
    if constexpr(is_writable)
      for(auto e : edges(mesh)) m_values.push_back(get(map, e) ? 1 : 0);
  }

  // of edges that are about to vanish: they may be keys of the map
  void release(const TriangleMesh& mesh)
  {
    if constexpr(is_writable)
      for(auto e : edges(mesh)) put(m_map, e, false);
  }

  // \pre the mesh is what it was
  void restore(const TriangleMesh& mesh)
  {
    std::size_t n = 0;
    if constexpr(is_writable)
      for(auto e : edges(mesh)) put(m_map, e, m_values[n++] != 0);
  }

private:
  EdgeIsConstrainedMap m_map;
  std::vector<char> m_values; // in the order of edges(mesh)
};

// where the integral curves through points meet a mesh
template <typename ConcurrencyTag, typename Result, typename Shell, typename Point, typename TriangleMesh,
          typename VertexPointMap>
void locate(const Shell& shell, const std::vector<Point>& points, const TriangleMesh& mesh, VertexPointMap vpm,
            Result& result)
{
  for(const auto& image : project_points<ConcurrencyTag>(shell, points, mesh, CGAL::parameters::vertex_point_map(vpm)))
    result.locations.push_back(image.location);
}

// Truncates a mesh as its shell does, and stores where the elements of the truncated mesh were before.
template <typename TriangleMesh>
class Mesh_truncated_for_edit
{
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;
public:
  // Returns false if the truncation fails; the mesh must not be used then.
  // \param all in the order of `vertices(mesh)`; vertices that vanish are replaced by vertices nearby
  template <typename VertexPointMap>
  bool truncate(const Shell_truncation_3& truncation, TriangleMesh& mesh, VertexPointMap vpm,
                std::vector<vertex_descriptor>& all)
  {
    const auto in_mesh = truncation.match(mesh, vpm);
    const auto none_there = boost::graph_traits<TriangleMesh>::null_halfedge();
    const auto is_there = [&](std::size_t f) { return in_mesh[f] != none_there; };
    std::unordered_map<vertex_descriptor, std::size_t> disc_of; // by center
    for(std::size_t d = 0; d < truncation.discs().size(); ++d) {
      const std::size_t f = truncation.discs()[d].facets.front();
      if(!is_there(f)) continue;
      auto h = in_mesh[f];
      for(int i = 0; truncation.cut_facets()[f][i] != truncation.discs()[d].center; ++i) h = next(h, mesh);
      disc_of.emplace(source(h, mesh), d);
    }
    if(disc_of.empty()) return true;
    for(face_descriptor f : faces(mesh)) m_facets.emplace(f, m_facets.size());
    for(vertex_descriptor v : vertices(mesh)) m_vertices.emplace(v, m_vertices.size());
    std::vector<std::size_t> cut(in_mesh.size(), none), center(truncation.discs().size(), none);
    for(std::size_t f = 0; f < in_mesh.size(); ++f)
      if(is_there(f)) cut[f] = m_facets.at(face(in_mesh[f], mesh));
    for(const auto& pair : disc_of) center[pair.second] = m_vertices.at(pair.first);
    const auto truncated = truncation.apply(mesh, vpm);
    if(!truncated) return false;
    for(vertex_descriptor& v : all) {
      const auto found = disc_of.find(v);
      if(found != disc_of.end()) v = truncated->vertices[truncation.discs()[found->second].rim.front()];
    }
    for(std::size_t n = 0; n < truncated->facets.size(); ++n) {
      const face_descriptor f = truncated->facets[n];
      if(f == boost::graph_traits<TriangleMesh>::null_face()) continue;
      const auto d = truncation.disc_of_new_facet(n);
      m_facets[f] = d == Shell_truncation_3::npos ? cut[truncation.cores()[n].facet] : none;
      if(d == Shell_truncation_3::npos) continue;
      m_center_of_facet[f] = center[d];
      for(auto p : truncation.new_facet(n)) m_vertices[truncated->vertices[p]] = center[d];
    }
    return true;
  }

  bool is_truncated() const { return !m_facets.empty(); }

  // Positions in `faces(mesh)` before, of facets at positions now. Parts of a facet have its position, and triangles of
  // discs `no_facet`.
  std::vector<std::size_t> facets_before(const TriangleMesh& mesh, const std::vector<std::size_t>& positions) const
  {
    const std::vector<face_descriptor> now(faces(mesh).begin(), faces(mesh).end());
    std::vector<std::size_t> result;
    for(std::size_t n : positions) result.push_back(m_facets.at(now[n]));
    return result;
  }

  // The same of places that are to blame, each once. Discs are named by the vertices that they replace.
  Offending_simplices before(const TriangleMesh& mesh, const Offending_simplices& now) const
  {
    const std::vector<face_descriptor> facets(faces(mesh).begin(), faces(mesh).end());
    const std::vector<vertex_descriptor> all(vertices(mesh).begin(), vertices(mesh).end());
    Offending_simplices result = now;
    result.facets.clear();
    result.vertices.clear();
    for(std::size_t n : now.facets) {
      const std::size_t before = m_facets.at(facets[n]);
      if(before != none) result.facets.push_back(before);
      else result.vertices.push_back(m_center_of_facet.at(facets[n]));
    }
    for(std::size_t n : now.vertices) result.vertices.push_back(m_vertices.at(all[n]));
    for(auto* numbers : { &result.facets, &result.vertices }) {
      sort_unique(*numbers);
    }
    return result;
  }

private:
  static constexpr std::size_t none = Edit_report::no_facet;

  std::unordered_map<face_descriptor, std::size_t> m_facets, m_center_of_facet;
  std::unordered_map<vertex_descriptor, std::size_t> m_vertices;
};

// Opens a mesh again that was closed for an edit, also when an exception ends that.
template <typename TriangleMesh>
class Closed_for_edit
{
public:
  explicit Closed_for_edit(TriangleMesh& mesh) : m_mesh(mesh) {}
  Closed_for_edit(const Closed_for_edit&) = delete;
  Closed_for_edit& operator=(const Closed_for_edit&) = delete;
  ~Closed_for_edit() { open(); }

  // whether the mesh is closed now
  template <typename VertexPointMap>
  bool close(const Shell_closing_3& closing, VertexPointMap vpm)
  {
    auto attached = closing.attach(m_mesh, vpm);
    if(!attached) return false;
    m_attached = std::move(*attached);
    return true;
  }
  const std::vector<typename boost::graph_traits<TriangleMesh>::face_descriptor>& faces() const
  {
    return m_attached.faces;
  }
  void open()
  {
    Shell_closing_3::detach(m_mesh, m_attached);
    forget();
  }
  // the mesh is another one
  void forget() { m_attached = Attached(); }

private:
  typedef Shell_closing_3::Attached<TriangleMesh> Attached;
  TriangleMesh& m_mesh;
  Attached m_attached; // nothing if the mesh is as it was
};

// Whether a mesh that is restored has the elements that it had, so that descriptors that others have stay what they
// are.
template <typename TriangleMesh>
bool is_restored_in_place(const TriangleMesh&)
{
  return false;
}
template <typename Point>
bool is_restored_in_place(const Surface_mesh<Point>& mesh)
{
  return !mesh.has_garbage();
}

// Checks the mesh, edits it, and certifies the result; what is not certified is undone, unless facets are frozen and
// all others accepted. `edit(oracle, frozen, all)` writes images and counts to the result, and returns why it is to be
// undone, or success; properties that it attaches to the mesh must be gone when it returns. `all` has a vertex for each
// that the mesh had: itself, or, where the mesh was truncated first, as the shell does it, one nearby. While it runs,
// an open mesh is closed by what closes it in the shell; `frozen` has these facets.
// \pre `check_before_edits()` accepts the mesh
// \param proofs which of the facets that the oracle accepts are proved. All of them are where facets may be frozen.
template <typename ConcurrencyTag, typename TriangleMesh, typename VertexPointMap, typename EdgeIsConstrainedMap,
          typename Field, typename Threshold, typename NamedParameters, typename Result, typename Edit>
Edit_status edit_and_certify(TriangleMesh& mesh, VertexPointMap vpm, EdgeIsConstrainedMap edge_is_constrained,
                             const Bspline_shell_3<Field, Threshold>& shell, Facet_proofs proofs,
                             const NamedParameters& np, Result& result, const Edit& edit)
{
  typedef typename boost::property_traits<VertexPointMap>::value_type Point;
  typedef Frozen_facets<TriangleMesh> Frozen;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  Real_timer timer;
  timer.start();
  const auto lap = [&timer](double& seconds) {
    seconds = timer.time();
    timer.reset();
  };
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // that of exact predicates

  const TriangleMesh before(mesh);
  std::vector<Point> points;
  for(auto v : vertices(mesh)) points.push_back(get(vpm, v));
  Constraints_before<TriangleMesh, EdgeIsConstrainedMap> constraints_before(mesh, edge_is_constrained);
  Closed_for_edit<TriangleMesh> closed(mesh);
  const auto undone = [&](Edit_status status) {
    closed.forget();
    constraints_before.release(mesh);
    restore(before, points, mesh, vpm);
    constraints_before.restore(mesh);
    result.facets = result.facets_before;
    result.constrained_edges = 0;
    result.end = Edit_end::NOT_EDITED;
    result.images.clear();
    result.frozen_facets.clear();
    return status;
  };
  try {
    std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor> all(vertices(mesh).begin(),
                                                                                   vertices(mesh).end());
    std::vector<std::array<double, 3> > traced; // points of the shell from which vertices are located
    Mesh_truncated_for_edit<TriangleMesh> truncated;
    if(shell.truncation()) {
      if(choose_parameter(get_parameter(np, parameter_tags::locate_vertices), false))
        traced = Projection_target_3<TriangleMesh>(mesh, vpm, shell.truncation()).traced_vertices();
      if(!truncated.truncate(*shell.truncation(), mesh, vpm, all)) return undone(Edit_status::NOT_IN_SHELL);
    }
    const bool is_truncated = truncated.is_truncated();

    const Shell_facet_oracle_3<Field, Threshold, ConcurrencyTag> oracle(shell, proofs);
    Frozen frozen = find_rejected_facets<ConcurrencyTag>(mesh, vpm, oracle, Frozen(mesh), true,
                                                         result.offending_simplices);
    if(is_truncated) result.offending_simplices = truncated.before(mesh, result.offending_simplices);
    if(!frozen.empty()) freeze_zero_edges(mesh, vpm, frozen);
    lap(result.check_seconds);
    const bool freezes = choose_parameter(get_parameter(np, parameter_tags::freeze_rejected_facets), false);
    CGAL_assertion(!freezes || proofs == Facet_proofs::ALL);
    if(!frozen.empty() && (!freezes || frozen.size() == faces(mesh).size()))
      return is_truncated ? undone(Edit_status::NOT_IN_SHELL) : Edit_status::NOT_IN_SHELL;
    const Frozen_state<TriangleMesh, VertexPointMap> frozen_before(frozen, mesh, vpm);
    result.frozen_facets_before = frozen_before.positions();
    if(is_truncated) result.frozen_facets_before = truncated.facets_before(mesh, result.frozen_facets_before);

    if(!CGAL::is_closed(mesh)) {
      if(!closed.close(*shell.closing(), vpm)) return undone(Edit_status::NOT_CLOSABLE);
      for(auto f : closed.faces()) frozen.close(f);
    }
    const Edit_status edited = edit(oracle, frozen, all);
    lap(result.edit_seconds);
    if(edited != Edit_status::SUCCESS) return undone(edited);

    Offending_simplices others;
    bool are_others_accepted = true;
    if(!frozen.empty())
      are_others_accepted = find_rejected_facets<ConcurrencyTag>(mesh, vpm, oracle, frozen, false, others).empty();
    closed.open();
    result.facets = faces(mesh).size();
    Shell_certificate_3<Field, Threshold> certificate(shell, oracle.bounds());
    const bool certified = certificate.template verify<ConcurrencyTag>(mesh, CGAL::parameters::vertex_point_map(vpm));
    result.certificate = certificate.report();
    // That facets are rejected proves nothing, and the certificate may hold all the same. If it does not, the others
    // must still be accepted, and the mesh must have the border that it had.
    const bool are_kept = Frozen_state<TriangleMesh, VertexPointMap>(frozen, mesh, vpm)
                            .is_as(frozen_before, result.frozen_facets);
    const bool is_proved = certified
                           || (!frozen.empty() && are_kept && are_others_accepted
                               && has_border_of_shell(mesh, vpm, shell));
    lap(result.certificate_seconds);
    if(!is_proved) return undone(Edit_status::NOT_CERTIFIED);
    // not compiled for those who do not ask
    if constexpr(!CGAL::parameters::is_default_parameter<NamedParameters, parameter_tags::locate_vertices_t>::value)
      if(get_parameter(np, parameter_tags::locate_vertices)) {
        if(is_truncated) locate<ConcurrencyTag>(shell, traced, mesh, vpm, result);
        else locate<ConcurrencyTag>(shell, points, mesh, vpm, result);
        lap(result.location_seconds);
      }
    return certified ? Edit_status::SUCCESS : Edit_status::EDITED_EXCEPT_FROZEN;
  } catch(const Run::Ended&) {
    return undone(Edit_status::TIME_LIMIT_EXCEEDED);
  } catch(...) { // thrown by a function of the caller's, or memory is exhausted
    undone(Edit_status::NOT_CERTIFIED);
    throw;
  }
}

// Whether a certificate failed by what it says of the shell. That is examined only if the shell contains the mesh, and
// no edit changes it.
inline bool is_shell_at_fault(const Certificate_report& report)
{
  return report.verdict(Claim::CONTAINMENT) == Verdict::PROVED && report.verdict(Claim::GRADIENT) != Verdict::PROVED;
}

// The same, with proofs only where facets are doubtful, if `may_repeat`. The certificate decides; if it fails, all is
// undone, and done again with all proofs, unless the shell is at fault: that must not harm what others know of the
// mesh, and `edit` must do the same when it is called again.
template <typename ConcurrencyTag, typename TriangleMesh, typename VertexPointMap, typename EdgeIsConstrainedMap,
          typename Field, typename Threshold, typename NamedParameters, typename Result, typename Edit>
Edit_status edit_under_proof(TriangleMesh& mesh, VertexPointMap vpm, EdgeIsConstrainedMap edge_is_constrained,
                             const Bspline_shell_3<Field, Threshold>& shell, bool may_repeat, const NamedParameters& np,
                             Result& result, const Edit& edit)
{
  const auto edited = [&](Facet_proofs proofs) {
    return edit_and_certify<ConcurrencyTag>(mesh, vpm, edge_is_constrained, shell, proofs, np, result, edit);
  };
  const double max_seconds = CGAL::parameters::choose_parameter(
    CGAL::parameters::get_parameter(np, parameter_tags::time_limit), std::numeric_limits<double>::infinity());
  result.invalid_parameter.check("time_limit", max_seconds, Parameter_bounds::positive_or_infinite());
  if(result.invalid_parameter) return Edit_status::INVALID_PARAMETER;
  Run run(max_seconds);
  const Run::Scope scope(&run);
  const bool freezes = CGAL::parameters::choose_parameter(
    CGAL::parameters::get_parameter(np, parameter_tags::freeze_rejected_facets), false);
  if(!may_repeat || freezes || !is_restored_in_place(mesh)) return edited(Facet_proofs::ALL);
  const Result before = result;
  const Edit_status status = edited(Facet_proofs::WHERE_DOUBTFUL);
  if(status != Edit_status::NOT_CERTIFIED || is_shell_at_fault(result.certificate)) return status;
  const Edit_report first = result;
  result = before;
  const Edit_status again = edited(Facet_proofs::ALL);
  result.is_repeated = true;
  result.check_seconds += first.check_seconds;
  result.edit_seconds += first.edit_seconds;
  result.certificate_seconds += first.certificate_seconds;
  return again;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDIT_UNDER_PROOF_H
