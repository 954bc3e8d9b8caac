// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATED_FACETS_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATED_FACETS_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Truncation_map.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The facets of a mesh after its truncation, and the map between the mesh and these facets.
class Truncated_facets
{
public:
  typedef Projection_facets_3::Coordinates Coordinates;
  typedef Projection_facets_3::Index Index;
  typedef Projection_facets_3::Facet Facet;
  // a facet and barycentric coordinates in it
  typedef std::pair<Index, Coordinates> Place;

  // Facet `n` of the facets to be cut is facet `cut[n].facet` of the mesh; its first corner is corner `cut[n].corner`
  // there. `npos` if the mesh does not contain this facet.
  struct Cut_facet
  {
    Index facet;
    int corner;
  };

  Truncated_facets(const std::shared_ptr<const Shell_truncation_3>& truncation, const std::vector<Facet>& facets,
                   std::vector<Cut_facet> cut);

  const Projection_facets_3& facets() const { return m_facets; }
  bool is_cut(Index facet) const { return m_cut_of[facet] != npos; }

  // Maps a place of the mesh to the truncated mesh.
  Place traced(const Place& place) const;

  // Maps a place of the truncated mesh to the mesh.
  Place untraced(const Place& place) const;

  // Returns the derivative of the map at a place of a facet with these vertices. It maps the facet's plane to that of
  // the image, and the normal to the normal.
  Eigen::Matrix3d derivative(const Place& place, const std::array<Coordinates, 3>& vertices) const;

private:
  static constexpr Index npos = Projection_facets_3::npos;
  struct Origin
  {
    Index facet, new_facet;
  };

  Truncation_map::Place in_cut_facet(const Place& place) const;

  Truncation_map m_map;
  Projection_facets_3 m_facets;
  std::vector<Cut_facet> m_cut;
  std::vector<Index> m_cut_of, m_traced_of, m_traced_of_new; // by facet of the mesh, and by new facet
  std::vector<Origin> m_origins;                             // origins of traced facets
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Projection/internal/Truncated_facets_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATED_FACETS_H
