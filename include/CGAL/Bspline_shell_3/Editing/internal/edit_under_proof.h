// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDIT_UNDER_PROOF_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDIT_UNDER_PROOF_H

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_report.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_termination.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_status.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Closed_for_edit.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Edit_options.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Frozen_facets.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Frozen_state.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Mesh_backup.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Mesh_truncated_for_edit.h>
#include <CGAL/Bspline_shell_3/Editing/internal/find_rejected_facets.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Mesh/count_removed_border_points.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <CGAL/FPU.h>
#include <CGAL/Real_timer.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/property_map.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns whether a mesh is closed, or has the border of a closing, which may be null.
template <typename TriangleMesh, typename VertexPointMap>
bool has_border_of(const std::shared_ptr<const Shell_closing_3>& closing, const TriangleMesh& mesh, VertexPointMap vpm)
{
  return CGAL::is_closed(mesh) || (closing && closing->match_border(mesh, vpm));
}

// Returns whether a mesh passes the cheap tests for edits in a shell.
template <typename TriangleMesh, typename VertexPointMap, typename Shell>
Edit_status check_before_edits(const TriangleMesh& mesh, VertexPointMap vpm, const Shell& shell,
                               const std::shared_ptr<const Shell_closing_3>& closing)
{
  if(!shell) return Edit_status::NO_SHELL;
  if(faces(mesh).begin() == faces(mesh).end() || !CGAL::is_triangle_mesh(mesh)) return Edit_status::NOT_TRIANGULATED;
  if(!has_border_of(closing, mesh, vpm)) return Edit_status::OPEN_MESH;
  for(auto v : vertices(mesh)) {
    const auto& p = get(vpm, v);
    if(!(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()))) return Edit_status::NOT_FINITE;
  }
  return Edit_status::SUCCESS;
}

// Checks the mesh, edits it, and certifies the result. If the result is not certified, the edit is undone, unless
// facets are frozen and all others are accepted. `edit(oracle, frozen, all)` writes images and counts to the result,
// and returns success or the reason why the edit must be undone. It must remove all properties that it attaches to the
// mesh. `all` contains a vertex for each original vertex: the vertex itself, or a vertex nearby if the mesh was
// truncated first, as in the shell. During the edit, an open mesh is closed; `frozen` contains the facets that close
// it, and does so after the edit.
// \pre `check_before_edits()` accepts the mesh
// \param proofs which of the facets that the oracle accepts are proved. If facets may be frozen, all of them must be.
template <typename ConcurrencyTag, typename TriangleMesh, typename VertexPointMap, typename Field, typename Threshold,
          typename Result, typename Edit>
Edit_status edit_and_certify(TriangleMesh& mesh, VertexPointMap vpm, const Bspline_shell_3<Field, Threshold>& shell,
                             Facet_proofs proofs, const Edit_options<TriangleMesh>& options, Result& result,
                             const Edit& edit)
{
  typedef Frozen_facets<TriangleMesh> Frozen;
  Real_timer timer;
  timer.start();
  const auto lap = [&timer](double& seconds) {
    seconds = timer.time();
    timer.reset();
  };
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates

  Mesh_backup<TriangleMesh, VertexPointMap> before(mesh, vpm, options.constraints);
  Closed_for_edit<TriangleMesh> closed(mesh);
  const auto undone = [&](Edit_status status) {
    closed.forget();
    before.restore(mesh);
    result.facets = result.facets_before;
    result.constrained_edges = 0;
    result.end = Edit_termination::NOT_EDITED;
    result.closing.reset();
    result.removed_border_edges = 0;
    result.images.clear();
    result.frozen_facets.clear();
    return status;
  };
  try {
    std::vector<typename boost::graph_traits<TriangleMesh>::vertex_descriptor> all(vertices(mesh).begin(),
                                                                                   vertices(mesh).end());
    std::vector<std::array<double, 3> > traced; // points from which vertices are located
    Mesh_truncated_for_edit<TriangleMesh> truncated;
    if(shell.truncation()) {
      if(options.locate) traced = Projection_target_3<TriangleMesh>(mesh, vpm, shell.truncation()).traced_vertices();
      if(!truncated.truncate(*shell.truncation(), mesh, vpm, all)) return undone(Edit_status::NOT_IN_SHELL);
    }
    const bool is_truncated = truncated.is_truncated();

    const Shell_facet_oracle_3<Field, Threshold, ConcurrencyTag> oracle(shell, proofs);
    Frozen frozen = find_rejected_facets<ConcurrencyTag>(mesh, vpm, oracle, Frozen(mesh), true,
                                                         result.offending_simplices);
    if(is_truncated) result.offending_simplices = truncated.before(mesh, result.offending_simplices);
    if(!frozen.empty()) freeze_zero_edges(mesh, vpm, frozen);
    lap(result.check_seconds);
    const bool freezes = options.freezes_rejected_facets;
    CGAL_assertion(!freezes || proofs == Facet_proofs::ALL);
    if(!frozen.empty() && (!freezes || frozen.size() == faces(mesh).size()))
      return is_truncated ? undone(Edit_status::NOT_IN_SHELL) : Edit_status::NOT_IN_SHELL;
    const Frozen_state<TriangleMesh, VertexPointMap> frozen_before(frozen, mesh, vpm);
    result.frozen_facets_before = frozen_before.positions();
    if(is_truncated) result.frozen_facets_before = truncated.facets_before(mesh, result.frozen_facets_before);

    const bool is_open = !CGAL::is_closed(mesh);
    if(is_open) {
      if(!closed.close(*options.closing, vpm)) return undone(Edit_status::NOT_CLOSABLE);
      for(auto f : closed.faces()) frozen.close(f);
      result.closing = options.closing;
    }
    const Edit_status edited = edit(oracle, frozen, all);
    lap(result.edit_seconds);
    if(edited != Edit_status::SUCCESS) return undone(edited);
    if(options.constraints.may_constrain())
      for(auto e : edges(mesh)) result.constrained_edges += !frozen.closes(e) && get(options.constraints, e) ? 1 : 0;

    Offending_simplices others;
    bool are_others_accepted = true;
    if(!frozen.empty())
      are_others_accepted = find_rejected_facets<ConcurrencyTag>(mesh, vpm, oracle, frozen, false, others).empty();
    if(is_open && options.border_tolerance > 0) {
      closed.update(frozen);
      auto simplified = std::make_shared<const Shell_closing_3>(closed.closing(vpm));
      const auto removed = count_removed_border_points(*options.closing, *simplified, options.border_tolerance);
      if(!removed) return undone(Edit_status::NOT_CERTIFIED);
      result.removed_border_edges = *removed;
      if(*removed > 0) result.closing = std::move(simplified);
    }
    closed.open();
    result.facets = faces(mesh).size();
    Shell_certificate_3<Field, Threshold> certificate(shell, oracle.bounds());
    const bool certified = certificate.template verify<ConcurrencyTag>(
      mesh, parameters::vertex_point_map(vpm).closing(result.closing));
    result.certificate = certificate.report();
    // A rejection proves nothing, so the certificate may succeed although facets were rejected. If it fails, the other
    // facets must still be accepted, and the mesh must have the border of its closing.
    const bool are_kept = Frozen_state<TriangleMesh, VertexPointMap>(frozen, mesh, vpm)
                            .is_as(frozen_before, result.frozen_facets);
    const bool is_proved = certified
                           || (!frozen.empty() && are_kept && are_others_accepted
                               && has_border_of(result.closing, mesh, vpm));
    lap(result.certificate_seconds);
    if(!is_proved) return undone(Edit_status::NOT_CERTIFIED);
    if(options.locate) {
      if(!is_truncated)
        for(const auto& p : before.points()) traced.push_back({ p.x(), p.y(), p.z() });
      options.locate(traced);
      lap(result.location_seconds);
    }
    return certified ? Edit_status::SUCCESS : Edit_status::PARTIALLY_EDITED;
  } catch(const Run::Ended&) {
    return undone(Edit_status::TIME_LIMIT_EXCEEDED);
  } catch(...) { // thrown by a function of the caller, or memory is exhausted
    undone(Edit_status::NOT_CERTIFIED);
    throw;
  }
}

// Returns whether a certificate failed because of a claim about the shell itself. This claim is only examined if the
// shell contains the mesh, and does not depend on edits.
inline bool is_shell_at_fault(const Certificate_report& report)
{
  return report.verdict(Claim::CONTAINMENT) == Verdict::PROVED && report.verdict(Claim::GRADIENT) != Verdict::PROVED;
}

// Edits a mesh like edit_and_certify(). If `may_repeat`, facets are proved only where they are doubtful, and the
// certificate decides. If it fails, the edit is undone and repeated with all proofs, unless the shell is at fault. In
// this case, the rollback must preserve external descriptors, and `edit` must be repeatable.
template <typename ConcurrencyTag, typename TriangleMesh, typename VertexPointMap, typename Field, typename Threshold,
          typename Result, typename Edit>
Edit_status edit_under_proof(TriangleMesh& mesh, VertexPointMap vpm, const Bspline_shell_3<Field, Threshold>& shell,
                             bool may_repeat, const Edit_options<TriangleMesh>& options, Result& result,
                             const Edit& edit)
{
  const auto edited = [&](Facet_proofs proofs) {
    return edit_and_certify<ConcurrencyTag>(mesh, vpm, shell, proofs, options, result, edit);
  };
  result.invalid_parameter.check("time_limit", options.max_seconds, Parameter_bounds::positive_or_infinite());
  if(result.invalid_parameter) return Edit_status::INVALID_PARAMETER;
  Run run(options.max_seconds);
  const Run::Scope scope(&run);
  if(!may_repeat || options.freezes_rejected_facets || !is_restored_in_place(mesh)) return edited(Facet_proofs::ALL);
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
