// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_PROVE_CONTAINMENT_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_PROVE_CONTAINMENT_H

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <array>
#include <atomic>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief returns whether a mesh is proved to lie between two thresholds, in the field's domain: only the first claim of
 * the certificate.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Field a model of `BsplineField_3`
 * \tparam Threshold a model of `ShellThreshold`
 */
template <typename ConcurrencyTag, typename Field, typename Threshold>
bool prove_containment(const Field& field, const Threshold& inner, const Threshold& outer, const Input_mesh_3& input)
{
  typedef typename Field::Point_3 Point_3;
  constexpr std::size_t chunk = 64;
  const Field_predicates_3<Field> predicates(field);
  std::atomic<bool> is_proved(true);
  internal::for_each_chunk<ConcurrencyTag>(
    input.mesh().number_of_faces(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end && is_proved; ++n) {
        const auto t = input.triangle(Input_mesh_3::Face_index(n));
        const auto point = [&](int v) { return Point_3(t[v].x(), t[v].y(), t[v].z()); };
        const std::array<Point_3, 3> triangle = { point(0), point(1), point(2) };
        if(predicates.values_within(triangle, inner, outer) != Verdict::PROVED) is_proved = false;
      }
    });
  return is_proved;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_PROVE_CONTAINMENT_H
