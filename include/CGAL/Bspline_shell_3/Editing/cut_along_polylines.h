// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_CUT_ALONG_POLYLINES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_CUT_ALONG_POLYLINES_H

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/Cut_report.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Edge_constraints.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Mesh_backup.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Polyline_cuts.h>
#include <CGAL/Bspline_shell_3/Mesh/closing_argument.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>

#include <CGAL/FPU.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/tags.h>

#include <cstddef>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Cuts a mesh. Calls `check(vpm, report)` at the end; if it returns false, the mesh is restored.
template <typename TriangleMesh, typename PolylineRange, typename NamedParameters, typename Check>
Cut_report cut_and_check(TriangleMesh& mesh, const PolylineRange& polylines, const NamedParameters& np,
                         const Check& check)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  typedef typename GetVertexPointMap<TriangleMesh, NamedParameters>::type Vertex_point_map;
  static_assert(std::is_same<typename GetGeomTraits<TriangleMesh, NamedParameters>::type::FT, double>::value,
                "The coordinates must be of type double: other types would be rounded.");
  Vertex_point_map vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                          get_property_map(vertex_point, mesh));
  Edge_constraints<TriangleMesh> marks;
  if constexpr(!CGAL::parameters::is_default_parameter<NamedParameters, internal_np::edge_is_constrained_t>::value)
    marks = Edge_constraints<TriangleMesh>(get_parameter(np, internal_np::edge_is_constrained));

  Cut_report report;
  report.facets_before = report.facets = faces(mesh).size();
  const auto ended = [&](Cut_status status) {
    report.status = status;
    return report;
  };
  if(faces(mesh).begin() == faces(mesh).end() || !CGAL::is_triangle_mesh(mesh))
    return ended(Cut_status::NOT_TRIANGULATED);
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  Mesh_backup<TriangleMesh, Vertex_point_map> before(mesh, vpm, marks);
  const auto restored = [&] {
    before.restore(mesh);
    report.facets = report.facets_before;
    report.cut_facets = report.cut_edges = report.crossings = 0;
    return ended(Cut_status::NOT_CERTIFIED);
  };
  try {
    {
      Polyline_cuts<TriangleMesh, Vertex_point_map> cuts(mesh, vpm);
      for(const auto& polyline : polylines) {
        const Cut_status added = cuts.add(polyline, report.vertex);
        if(added != Cut_status::SUCCESS) return ended(added);
        ++report.polyline;
      }
      report.polyline = report.vertex = 0;
      const Cut_status triangulated = cuts.triangulate();
      if(triangulated != Cut_status::SUCCESS) return ended(triangulated);
      cuts.apply(marks, report);
    } // the properties of the cuts are removed before the mesh may be restored
    report.facets = faces(mesh).size();
    return check(vpm, report) ? ended(Cut_status::SUCCESS) : restored();
  } catch(...) { // thrown by a function of the caller, or memory is exhausted
    restored();
    throw;
  }
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief cuts facets of a mesh in a shell along polylines, and certifies the result: each polyline is then a sequence
 * of edges.
 *
 * Often, the polylines are the images of seams (`map_polyline()`): no facet of the result then lies across a seam. Each
 * facet that a polyline meets is replaced by a constrained Delaunay triangulation, whose predicates are exact: the
 * vertices of polylines become vertices, and so do crossings of polylines inside facets.
 *
 * The new facets are coplanar with the facet that they replace, up to the rounding of new vertices. Rounding may turn
 * very narrow facets, and a certificate holds for a mesh, not for a surface. The function therefore compares the
 * orientations of the new facets with that of the replaced one, in exact arithmetic, and then certifies the whole
 * result. If one of these checks fails, the mesh is unchanged, or was restored in the way that `simplify_in_shell()`
 * describes.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`, used for the certificate
 * \tparam TriangleMesh a model of `MutableFaceGraph`, `FaceListGraph`, and `HalfedgeListGraph`; copyable, with points
 *   of a kernel whose `FT` is `double`
 * \tparam PolylineRange a range of ranges of locations (`CGAL::Polygon_mesh_processing::Face_location`)
 *
 * \param mesh a closed mesh that can be certified in the shell, or a mesh with the border of its closing. Border
 *   edges of an open mesh must not be cut, because its closing has the same border.
 * \param polylines locations on the mesh, such as those of `Polyline_image::parts`. Consecutive vertices lie in a
 *   common facet. Coordinates of vertices on edges contain an exact 0.
 * \param shell a shell; it may be certified for another mesh
 * \param np optional named parameters
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{edge_is_constrained_map}
 *       \cgalParamDescription{a model of `ReadWritePropertyMap` from edges to `bool`. The edges on polylines are set to
 *         `true`, other new edges to `false`, and parts of a split edge to its value.}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{closing}
 *       \cgalParamDescription{triangles that close the mesh if it is open, used instead of the shell's}
 *       \cgalParamType{`Shell_closing_3`, or a shared pointer to one, which may be null}
 *       \cgalParamDefault{`Bspline_shell_3::closing()`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{vertex_point_map}
 *       \cgalParamDescription{a property map from the vertices of `mesh` to their points, which must accept new
 *         vertices}
 *       \cgalParamType{a model of `ReadWritePropertyMap`}
 *       \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 *
 * \cgalHeading{Cost} The cut takes time in proportion to the number of new facets, and the certificate as long as for
 * any mesh in the shell. A copy of the mesh is kept until the end.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename TriangleMesh, typename PolylineRange,
          typename Field, typename Threshold, typename CGAL_NP_TEMPLATE_PARAMETERS>
Cut_report cut_along_polylines(TriangleMesh& mesh, const PolylineRange& polylines,
                               const Bspline_shell_3<Field, Threshold>& shell,
                               const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  if(!shell) {
    Cut_report report;
    report.facets_before = report.facets = faces(mesh).size();
    return report;
  }
  return internal::cut_and_check(mesh, polylines, np, [&](const auto& vpm, Cut_report& report) {
    Shell_certificate_3<Field, Threshold> certificate(shell);
    const bool is_certified = certificate.template verify<ConcurrencyTag>(
      mesh, parameters::vertex_point_map(vpm).closing(internal::closing_argument(np, shell.closing())));
    report.certificate = certificate.report();
    return is_certified;
  });
}

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief cuts facets of a mesh along polylines, as above, but without a certificate.
 *
 * Only the orientations of the new facets are checked. The named parameters are `edge_is_constrained_map` and
 * `vertex_point_map`.
 */
template <typename TriangleMesh, typename PolylineRange, typename T = bool, typename Tag = internal_np::all_default_t,
          typename Base = internal_np::No_property>
Cut_report cut_along_polylines(
  TriangleMesh& mesh, const PolylineRange& polylines,
  const CGAL::Named_function_parameters<T, Tag, Base>& np = CGAL::parameters::default_values())
{
  return internal::cut_and_check(mesh, polylines, np, [](const auto&, Cut_report&) { return true; });
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_CUT_ALONG_POLYLINES_H
