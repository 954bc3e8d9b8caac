// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_PROVENANCE_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_PROVENANCE_IMPL_H

#include <CGAL/Bspline_shell_3/Soup/provenance.h>
#include <CGAL/Bspline_shell_3/Soup/tidy_polygons.h>

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Shares of parts of polygons that are changed.
class Changed_parts
{
public:
  explicit Changed_parts(std::size_t polygons) : m_is_changed(polygons, 0), m_is_whole(polygons, 1) {}

  void add(std::size_t polygon, double changed_share)
  {
    if(changed_share > 0) m_is_changed[polygon] = 1;
    if(changed_share < 1) m_is_whole[polygon] = 0;
  }
  void apply(Polygon_change partly, Polygon_change completely, std::vector<Polygon_change>& change) const
  {
    for(std::size_t n = 0; n < change.size(); ++n)
      if(m_is_changed[n]) change[n] = m_is_whole[n] ? completely : partly;
  }

private:
  std::vector<char> m_is_changed, m_is_whole;
};

inline bool is_collinear(const Polygon_soup& soup, std::size_t polygon)
{
  const std::vector<std::size_t>& corners = soup.polygons[polygon];
  const auto& p = soup.points;
  const auto differs = std::find_if(corners.begin(), corners.end(),
                                    [&](std::size_t v) { return p[v] != p[corners.front()]; });
  return std::all_of(corners.begin(), corners.end(), [&](std::size_t v) {
    return differs == corners.end() || CGAL::collinear(p[corners.front()], p[*differs], p[v]);
  });
}

// Returns, for each facet of a mesh, a polygon with its corners.
inline std::vector<std::size_t> polygons_of_facets(const Polygon_soup& soup, const Shell_of_soup_3::Mesh& mesh)
{
  std::map<Shell_of_soup_3::Mesh::Point, std::vector<std::size_t> > polygons_at; // ascending
  for(std::size_t n = 0; n < soup.polygons.size(); ++n)
    for(std::size_t v : soup.polygons[n]) {
      std::vector<std::size_t>& here = polygons_at[soup.points[v]];
      if(here.empty() || here.back() != n) here.push_back(n);
    }
  std::vector<std::size_t> polygon;
  for(auto f : mesh.faces()) {
    std::vector<std::size_t> common;
    bool is_first = true;
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      const std::vector<std::size_t>& here = polygons_at[mesh.point(v)];
      if(std::exchange(is_first, false)) common = here;
      else {
        std::vector<std::size_t> both;
        std::set_intersection(common.begin(), common.end(), here.begin(), here.end(), std::back_inserter(both));
        common.swap(both);
      }
    }
    polygon.push_back(common.empty() ? soup.polygons.size() : common.front());
  }
  return polygon;
}

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE std::vector<Polygon_change> provenance(const Polygon_soup& soup,
                                                                   const Shell_of_soup_3& result)
{
  CGAL_precondition(bool(result));
  const std::size_t size = soup.polygons.size();
  if(result.proxy) return std::vector<Polygon_change>(size, Polygon_change::WRAPPED);
  std::vector<Polygon_change> change(size, Polygon_change::NONE);
  const Weld_provenance& weld = result.weld_provenance;
  for(std::size_t n = 0; n < weld.polygon_of.size(); ++n)
    if(weld.change[n] != Weld_change::NONE) change[weld.polygon_of[n]] = Polygon_change::WELDED;

  Polygon_soup tidy = soup;
  Soup_repairs repairs;
  std::vector<char> is_left_out(size, 1);
  for(std::size_t n : internal::tidy_polygons(tidy, repairs).polygon_of) is_left_out[n] = 0;
  for(std::size_t n = 0; n < size; ++n) {
    if(is_left_out[n]) change[n] = Polygon_change::DUPLICATE;
    if(internal::is_collinear(soup, n)) change[n] = Polygon_change::NO_AREA;
  }

  internal::Changed_parts parts(size);
  if(result.excised) {
    const Excised_soup_3& excised = *result.excised;
    for(std::size_t t = 0; t < excised.soup().triangles.size(); ++t)
      if(excised.reasons()[t] != Excision_reason::NO_AREA)
        parts.add(excised.soup().polygon_of[t], excised.is_excised(t) ? 1 : 0);
    parts.apply(Polygon_change::PARTLY_EXCISED, Polygon_change::EXCISED, change);
  } else if(result.united) {
    const std::vector<std::size_t> polygon = internal::polygons_of_facets(soup, result.repaired_mesh);
    for(std::size_t f = 0; f < polygon.size(); ++f)
      if(polygon[f] < size) parts.add(polygon[f], result.united->hidden_share[f]);
    parts.apply(Polygon_change::PARTLY_HIDDEN, Polygon_change::HIDDEN, change);
  }
  return change;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_PROVENANCE_IMPL_H
