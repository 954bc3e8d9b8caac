// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_CONTAINMENT_3_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_CONTAINMENT_3_H

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_cover_3.h>
#include <CGAL/Bspline_shell_3/Certificate/match_components.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/arithmetic_self_test.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/FPU.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/Point_3.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief tests whether points, segments, triangles, and meshes lie in a shell, with the call operators of
 * `CGAL::Polyhedral_envelope`.
 *
 * The result `true` is proved: every point of the query lies between the thresholds, in the domain, and in the cover
 * with which the shell was certified. If the shell has no cover (`Bspline_shell_3::proved_cover()`), the points are
 * only proved to lie in cells that the shell may meet. The result `false` means that this does not hold, or holds by a
 * margin that is too small to be proved. Const member functions may be called concurrently.
 *
 * \tparam Field a model of `BsplineField_3`
 * \tparam Threshold a model of `ShellThreshold`
 */
template <typename Field = Hierarchical_bspline_field_3<>, typename Threshold = Constant_threshold>
class Shell_containment_3
{
public:
  typedef typename Field::Point_3 Point_3;

  /// \pre the shell outlives this object
  explicit Shell_containment_3(const Bspline_shell_3<Field, Threshold>& shell)
    : m_shell(&shell), m_is_empty(!shell || arithmetic_self_test() != Arithmetic_status::SOUND),
      m_predicates(shell.field())
  {
    if(m_is_empty || !shell.proved_cover()) return;
    m_cover.emplace(shell.field(), shell.inner_threshold(), shell.outer_threshold());
    m_cover->adopt(*shell.proved_cover());
  }
  explicit Shell_containment_3(const Bspline_shell_3<Field, Threshold>&&) = delete; // the pointer would dangle

  /// \name Queries
  /// Points may belong to any kernel whose `FT` is `double`.
  /// @{

  /// tests a point; exact for constant thresholds
  template <typename Kernel>
  bool operator()(const CGAL::Point_3<Kernel>& q) const
  {
    const Point_3& p = point(q);
    if(m_is_empty || !(m_cover ? is_in_cover(p) : is_in_cell(p))) return false;
    if constexpr(Threshold::is_constant) {
      Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
      const auto inner = m_predicates.compare(p, m_shell->inner_level()),
                 outer = m_predicates.compare(p, m_shell->outer_level());
      return *inner != SMALLER && *outer != LARGER;
    } else return contains(std::array<Point_3, 2>{ p, p });
  }

  /// tests a segment
  template <typename Kernel>
  bool operator()(const CGAL::Point_3<Kernel>& source, const CGAL::Point_3<Kernel>& target) const
  {
    return contains(std::array<Point_3, 2>{ point(source), point(target) });
  }

  /// tests a triangle
  template <typename Kernel>
  bool operator()(const CGAL::Point_3<Kernel>& t0, const CGAL::Point_3<Kernel>& t1,
                  const CGAL::Point_3<Kernel>& t2) const
  {
    return contains(std::array<Point_3, 3>{ point(t0), point(t1), point(t2) });
  }

  /// tests all facets of a triangle mesh
  /// \tparam TriangleMesh a model of `FaceListGraph`
  /// \param mesh the mesh
  /// \param np `vertex_point_map`: a property map from the vertices of `mesh` to their points
  template <typename TriangleMesh, typename T, typename Tag, typename Base>
  bool operator()(const TriangleMesh& mesh, const CGAL::Named_function_parameters<T, Tag, Base>& np) const
  {
    using CGAL::parameters::choose_parameter;
    using CGAL::parameters::get_parameter;
    auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                get_const_property_map(vertex_point, mesh));
    for(auto f : faces(mesh)) {
      const auto h = halfedge(f, mesh);
      if(!(*this)(get(vpm, source(h, mesh)), get(vpm, target(h, mesh)), get(vpm, target(next(h, mesh), mesh))))
        return false;
    }
    return true;
  }
  template <typename TriangleMesh>
  bool operator()(const TriangleMesh& mesh) const
  {
    return (*this)(mesh, CGAL::parameters::default_values());
  }

  /// tests all triangles of a soup
  /// \tparam PointRange a random access range of points
  /// \tparam TriangleRange a range of random access ranges of three indices of `points`
  template <typename PointRange, typename TriangleRange, typename = typename TriangleRange::value_type,
            typename = typename PointRange::value_type>
  bool operator()(const PointRange& points, const TriangleRange& triangles) const
  {
    for(const auto& t : triangles)
      if(!(*this)(points[t[0]], points[t[1]], points[t[2]])) return false;
    return true;
  }
  /// @}

  /// returns the component of a certified shell in which each component of a mesh lies. The mesh must be closed, or
  /// have the border of the shell's closing. A contained mesh may have no component in some component of the shell, or
  /// several; in this case, no map onto the mesh of the shell is one-to-one, and the verdict is not `PROVED`. If the
  /// shell is not certified, or the mesh is rejected (`Input_mesh_3`), the verdict is undecided.
  /// \pre all facets are contained and face along the gradient (`Shell_certificate_3` proves this, and makes the same
  ///   comparison)
  /// \param mesh a model of `FaceListGraph`
  /// \param np `vertex_point_map`: a property map from the vertices of `mesh` to their points
  template <typename PolygonMesh, typename CGAL_NP_TEMPLATE_PARAMETERS>
  Component_match match(const PolygonMesh& mesh, const CGAL_NP_CLASS& np = CGAL::parameters::default_values()) const
  {
    using CGAL::parameters::choose_parameter;
    using CGAL::parameters::get_parameter;
    Component_match match;
    if(m_is_empty || !m_shell->is_certified()) return match;
    auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                get_const_property_map(vertex_point, mesh));
    Input_mesh_3::Tolerated_defects tolerated;
    tolerated.self_intersections = tolerated.singular_vertices = tolerated.orientation = true;
    Input_mesh_3 input;
    const Shell_status status = input.template build<Sequential_tag>(mesh, vpm, tolerated, m_shell->closing());
    if(status != Shell_status::SUCCESS) return match;
    return match_components(m_shell->component_paths(), input);
  }

  /// returns whether nothing is contained, because there is no shell or floating-point arithmetic is not sound
  bool is_empty() const { return m_is_empty; }

private:
  template <typename Kernel>
  static decltype(auto) point(const CGAL::Point_3<Kernel>& p)
  {
    return internal::converted<Point_3>(p);
  }

  // Returns whether a point that lies between the thresholds is in the shell. If so, everything connected to it between
  // the thresholds is in the shell as well, because the boxes around the cover are excluded.
  bool is_in_cover(const Point_3& p) const { return m_cover->component(p) != Cover_box::no_component; }
  bool is_in_cell(const Point_3& p) const
  {
    const typename Field::Cell_index c = m_shell->field().locate(p);
    return c != Field::npos && m_shell->shell_cells()[c];
  }

  template <std::size_t size>
  bool contains(const std::array<Point_3, size>& simplex) const
  {
    if(m_is_empty) return false;
    Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
    const Threshold &inner = m_shell->inner_threshold(), &outer = m_shell->outer_threshold();
    if(m_cover) return is_in_cover(simplex[0]) && m_predicates.values_within(simplex, inner, outer) == Verdict::PROVED;
    return is_in_cell(simplex[0])
           && m_predicates.values_within(simplex, inner, outer, m_shell->shell_cells()) == Verdict::PROVED;
  }

  const Bspline_shell_3<Field, Threshold>* m_shell;
  bool m_is_empty;
  Field_predicates_3<Field> m_predicates;
  std::optional<Shell_cover_3<Field, Threshold> > m_cover;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_CONTAINMENT_3_H
