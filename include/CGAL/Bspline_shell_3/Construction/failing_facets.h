// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FAILING_FACETS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FAILING_FACETS_H

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief a facet that is not proved to face along the gradient of a field, and a point where the proof fails.
 */
struct Facet_failure
{
  std::uint32_t facet;
  std::uint32_t cell; ///< cell that contains the point; `npos` if the point is outside the field's cells
  std::array<double, 3> point;
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns those of the chosen facets of a mesh that are not proved to face along the gradient of a field
 * (`Field_predicates_3::crosses_upwards()`).
 *
 * \param chosen for each facet, whether to test it
 */
template <typename ConcurrencyTag, typename Field>
std::vector<Facet_failure> failing_facets(const Field& field, const Input_mesh_3& input,
                                          const std::vector<char>& chosen)
{
  typedef typename Field::Point_3 Point_3;
  const Field_predicates_3<Field> predicates(field);
  std::vector<std::uint32_t> facets;
  for(auto f : input.mesh().faces())
    if(chosen[f]) facets.push_back(std::uint32_t(f));
  const std::size_t chunk = internal::chunk_size(facets.size(), 64);
  return internal::collect_from_chunks<ConcurrencyTag, Facet_failure>(
    facets.size(), chunk, [&](std::size_t begin, std::size_t end, std::vector<Facet_failure>& found) {
      for(std::size_t n = begin; n < end; ++n) {
        const auto t = input.triangle(Input_mesh_3::Face_index(facets[n]));
        const auto point = [&](int v) { return Point_3(t[v].x(), t[v].y(), t[v].z()); };
        Witness w;
        if(predicates.crosses_upwards({ point(0), point(1), point(2) }, &w) != Verdict::PROVED)
          found.push_back({ facets[n], field.locate(Point_3(w.point[0], w.point[1], w.point[2])), w.point });
      }
    });
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FAILING_FACETS_H
