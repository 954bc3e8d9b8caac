// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_CHECK_ORIENTATION_H
#define CGAL_BSPLINE_SHELL_3_MESH_CHECK_ORIENTATION_H

#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Connected components of a mesh, in the order of their first facets of origin.
struct Components
{
  std::vector<std::size_t> of_facet;    // by facet
  std::vector<std::size_t> first_facet; // by component: the first of its facets of origin
};

inline Components find_components(const Mesh_with_origins& m)
{
  Components components;
  std::vector<std::size_t>&of_facet = components.of_facet, &first = components.first_facet;
  of_facet.resize(m.mesh.number_of_faces());
  const std::size_t size = Polygon_mesh_processing::connected_components(m.mesh, CGAL::make_property_map(of_facet));
  std::vector<std::size_t> first_in_order_of_mesh(size, m.number_of_facet_origins), number;
  for(auto f : m.mesh.faces()) {
    std::size_t& least = first_in_order_of_mesh[of_facet[f]];
    least = (std::min)(least, m.facet_origin[f]);
  }
  first = first_in_order_of_mesh;
  std::sort(first.begin(), first.end()); // all are different
  for(std::size_t f : first_in_order_of_mesh)
    number.push_back(std::size_t(std::lower_bound(first.begin(), first.end(), f) - first.begin()));
  for(std::size_t& c : of_facet) c = number[c];
  return components;
}

// Returns the components that contain a point in front of the facet, with no other facet between. If the mesh
// intersects itself, other facets may coincide with this one. Returns nothing if rounding leaves no such point near the
// middle of the facet.
template <typename ConcurrencyTag>
std::optional<std::vector<std::size_t> > components_around_front(Mesh_with_origins::Face_index f,
                                                                 const Mesh_with_origins& m,
                                                                 const Components& components,
                                                                 const Crossing_counter_3& counter)
{
  typedef Mesh_with_origins::Kernel Kernel;
  const auto t = m.triangle(f);
  const std::array<double, 3> n = facet_normal(t[0], t[1], t[2]).direction;
  const Kernel::Vector_3 normal(n[0], n[1], n[2]); // its largest component is near one
  const Kernel::Point_3 middle = CGAL::centroid(t[0], t[1], t[2]);
  const double size = std::sqrt(
    (std::max)({ (t[1] - t[0]).squared_length(), (t[2] - t[1]).squared_length(), (t[0] - t[2]).squared_length() }));
  for(int halvings = 4;; halvings *= 2) {
    const double step = std::ldexp(size, -halvings);
    const Kernel::Point_3 front = middle + step * normal;
    if(front == middle) return std::nullopt;
    const auto through = counter.crossings<ConcurrencyTag>(middle - step * normal, front);
    // Facets in the same plane are crossed at the same point.
    const auto is_in_plane = [&](const auto& crossing) {
      const auto u = m.triangle(crossing.first);
      return std::all_of(u.begin(), u.end(), [&](const Kernel::Point_3& p) { return coplanar(t[0], t[1], t[2], p); });
    };
    if(!through || std::find(through->begin(), through->end(), std::make_pair(f, 1)) == through->end()
       || !std::all_of(through->begin(), through->end(), is_in_plane))
      continue;
    // Tries directions until one touches no edge; the directions are generic.
    const double reach = 8 * m.unit();
    for(const Kernel::Vector_3& way :
        { Kernel::Vector_3(0.531, 0.677, 0.509), Kernel::Vector_3(-0.732, 0.417, 0.539),
          Kernel::Vector_3(0.389, -0.811, 0.437), Kernel::Vector_3(0.467, 0.353, -0.811) }) {
      const auto out = counter.crossings<ConcurrencyTag>(front, front + reach * way);
      if(!out) continue;
      std::vector<std::size_t> crossed, around;
      for(const auto& crossing : *out) crossed.push_back(components.of_facet[crossing.first]);
      std::sort(crossed.begin(), crossed.end());
      for(auto first = crossed.begin(), next = first; first != crossed.end(); first = next) {
        next = std::upper_bound(first, crossed.end(), *first);
        if((next - first) % 2 == 1) around.push_back(*first);
      }
      return around;
    }
  }
}

// All components must be oriented as the boundary of one volume, or all in the opposite way. For each component, a
// point is chosen close to one of its facets, in front of it. The facets crossed on a segment from there to the outside
// determine the components that contain the point.
// \param[out] faces_outwards whether facets face the unbounded side
// \pre components do not intersect
template <typename ConcurrencyTag>
Mesh_refusal check_nesting(const Mesh_with_origins& m, const Components& components, bool& faces_outwards)
{
  const Crossing_counter_3 counter(m.mesh);
  const std::size_t size = components.first_facet.size();
  std::vector<char> is_known(size, 0), is_outward(size, 0);
  std::vector<std::size_t> nesting(size, 0);
  for(auto f : m.mesh.faces()) {
    const std::size_t c = components.of_facet[f];
    if(is_known[c]) continue;
    Run::poll();
    const auto around = components_around_front<ConcurrencyTag>(f, m, components, counter);
    if(!around) continue;
    is_known[c] = 1;
    is_outward[c] = std::find(around->begin(), around->end(), c) == around->end();
    nesting[c] = around->size() - (is_outward[c] ? 0 : 1);
  }
  const auto refused_if = [&](Shell_status status, const auto& is_wrong) {
    std::vector<std::size_t> facets;
    for(std::size_t c = 0; c < size; ++c)
      if(is_wrong(c)) facets.push_back(components.first_facet[c]);
    return m.refuse_facets_if_any(status, std::move(facets));
  };
  const Mesh_refusal unknown = refused_if(Shell_status::DEGENERATE_FACET, [&](std::size_t c) { return !is_known[c]; });
  if(unknown) return unknown;
  const auto faces_out = [&](std::size_t c) { return bool(is_outward[c]) == (nesting[c] % 2 == 0); };
  faces_outwards = faces_out(components.of_facet[*m.mesh.faces().begin()]);
  return refused_if(Shell_status::INCONSISTENT_ORIENTATION,
                    [&](std::size_t c) { return faces_out(c) != faces_outwards; });
}

// Intersecting components have no nesting. The sign of the volume decides, if it exceeds the rounding error.
// \param[out] faces_outwards whether the volume is positive
inline Mesh_refusal check_volume(const Mesh_with_origins& m, bool& faces_outwards)
{
  typedef Mesh_with_origins::Kernel::Vector_3 Vector_3;
  const Mesh_with_origins::Kernel::Point_3 o((m.bbox.xmin() + m.bbox.xmax()) / 2, (m.bbox.ymin() + m.bbox.ymax()) / 2,
                                             (m.bbox.zmin() + m.bbox.zmax()) / 2);
  double volume = 0, products = 0;
  for(auto f : m.mesh.faces()) {
    const auto t = m.triangle(f);
    const Vector_3 u = t[0] - o, v = t[1] - o, w = t[2] - o;
    volume += CGAL::determinant(u, v, w);
    const auto size = [](const Vector_3& x) { return std::abs(x.x()) + std::abs(x.y()) + std::abs(x.z()); };
    products += size(u) * size(v) * size(w);
  }
  // Three roundings of differences and three of products in each term, and one for each sum.
  const double error = std::numeric_limits<double>::epsilon() * (8. + double(m.mesh.number_of_faces())) * products;
  faces_outwards = volume > 0;
  return std::abs(volume) > error ? Mesh_refusal() : m.refuse_facets(Shell_status::INCONSISTENT_ORIENTATION, { 0 });
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_CHECK_ORIENTATION_H
