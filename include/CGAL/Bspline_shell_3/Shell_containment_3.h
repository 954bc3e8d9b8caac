// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_CONTAINMENT_3_H
#define CGAL_BSPLINE_SHELL_3_SHELL_CONTAINMENT_3_H

#include <CGAL/Bspline_shell_3/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Field_predicates_3.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <array>
#include <cstddef>
#include <iterator>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief tells whether points, segments, triangles and meshes lie in a shell, with the call operators of
 * `CGAL::Polyhedral_envelope`.
 *
 * The answer `true` is proved: every point of the query lies between the levels, in the domain, and in a cell that the shell
 * may meet. The answer `false` means that this does not hold, or only by less than some 1e-13 of the coordinates.
 * Const member functions may be called from several threads at once.
 *
 * \tparam Field a model of `BsplineField_3`
 * \tparam Threshold a model of `ShellThreshold`
 */
template <typename Field = Uniform_bspline_field_3<>, typename Threshold = Constant_threshold>
class Shell_containment_3
{
public:
  typedef typename Field::Point_3 Point_3;

  /// \pre there is a shell, and it outlives this object
  explicit Shell_containment_3(const Bspline_shell_3<Field, Threshold>& shell)
    : m_shell(&shell), m_predicates(shell.field())
  {}

  /// a point; exact for constant thresholds
  bool operator()(const Point_3& p) const
  {
    if(!in_shell_cell(p)) return false;
    if constexpr(Threshold::is_constant) {
      const auto inner = m_predicates.compare(p, m_shell->inner_level()), outer = m_predicates.compare(p, m_shell->outer_level());
      return *inner != SMALLER && *outer != LARGER;
    } else
      return contains(std::array<Point_3, 2>{ p, p });
  }

  /// a segment
  bool operator()(const Point_3& source, const Point_3& target) const
  {
    return contains(std::array<Point_3, 2>{ source, target });
  }

  /// a triangle
  bool operator()(const Point_3& t0, const Point_3& t1, const Point_3& t2) const
  {
    return contains(std::array<Point_3, 3>{ t0, t1, t2 });
  }

  /// all facets of a triangle mesh.
  /// \tparam TriangleMesh a model of `FaceListGraph` with points of type `Point_3`
  /// \param mesh the mesh
  /// \param np `vertex_point_map` as in all of \cgal
  template <typename TriangleMesh, typename T, typename Tag, typename Base>
  bool operator()(const TriangleMesh& mesh, const CGAL::Named_function_parameters<T, Tag, Base>& np) const
  {
    using CGAL::parameters::choose_parameter;
    using CGAL::parameters::get_parameter;
    auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point), get_const_property_map(vertex_point, mesh));
    for(auto f : faces(mesh)) {
      const auto h = halfedge(f, mesh);
      if(!(*this)(get(vpm, source(h, mesh)), get(vpm, target(h, mesh)), get(vpm, target(next(h, mesh), mesh)))) return false;
    }
    return true;
  }
  template <typename TriangleMesh>
  bool operator()(const TriangleMesh& mesh) const { return (*this)(mesh, CGAL::parameters::default_values()); }

  /// all triangles of a soup.
  /// \tparam PointRange a random access range of points
  /// \tparam TriangleRange a range of random access ranges of three positions in `points`
  template <typename PointRange, typename TriangleRange,
            typename = typename TriangleRange::value_type, typename = typename PointRange::value_type>
  bool operator()(const PointRange& points, const TriangleRange& triangles) const
  {
    for(const auto& t : triangles)
      if(!(*this)(points[t[0]], points[t[1]], points[t[2]])) return false;
    return true;
  }

  /// whether nothing is contained: there is no shell
  bool is_empty() const { return !*m_shell; }

private:
  bool in_shell_cell(const Point_3& p) const
  {
    const typename Field::Cell_index c = m_shell->field().locate(p);
    return c != Field::npos && m_shell->shell_cells()[c];
  }

  template <std::size_t size>
  bool contains(const std::array<Point_3, size>& simplex) const
  {
    return in_shell_cell(simplex[0])
        && m_predicates.values_within(simplex, m_shell->inner_threshold(), m_shell->outer_threshold()) == Verdict::PROVED;
  }

  const Bspline_shell_3<Field, Threshold>* m_shell;
  Field_predicates_3<Field> m_predicates;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_CONTAINMENT_3_H
