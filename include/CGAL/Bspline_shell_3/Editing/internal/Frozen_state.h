// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FROZEN_STATE_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FROZEN_STATE_H

#include <CGAL/Bspline_shell_3/Editing/internal/Frozen_facets.h>

#include <CGAL/property_map.h>

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The corners of frozen facets, and their positions in faces(mesh).
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

  // Returns whether all facets are the same as in an earlier state. `numbers` receives their current positions, in the
  // earlier order. The order of facets may change if a mesh reuses the places of removed facets.
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

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FROZEN_STATE_H
