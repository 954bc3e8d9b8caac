// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_CLOSED_FOR_EDIT_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_CLOSED_FOR_EDIT_H

#include <CGAL/Bspline_shell_3/Editing/internal/Frozen_facets.h>
#include <CGAL/Bspline_shell_3/Editing/internal/collect_closing.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Closes a mesh for an edit, and opens it afterward, even if an exception is thrown.
template <typename TriangleMesh>
class Closed_for_edit
{
public:
  explicit Closed_for_edit(TriangleMesh& mesh) : m_mesh(mesh) {}
  Closed_for_edit(const Closed_for_edit&) = delete;
  Closed_for_edit& operator=(const Closed_for_edit&) = delete;
  ~Closed_for_edit() { open(); }

  // Returns whether the mesh is closed now.
  template <typename VertexPointMap>
  bool close(const Shell_closing_3& closing, VertexPointMap vpm)
  {
    auto attached = closing.attach(m_mesh, vpm);
    if(!attached) return false;
    m_attached = std::move(*attached);
    m_kinds = closing.kinds();
    return true;
  }
  // Forgets the facets that the edit removed.
  void update(const Frozen_facets<TriangleMesh>& frozen)
  {
    std::size_t kept = 0;
    for(std::size_t n = 0; n < m_attached.faces.size(); ++n) {
      if(!frozen.closes(m_attached.faces[n])) continue;
      m_attached.faces[kept] = m_attached.faces[n];
      m_kinds[kept++] = m_kinds[n];
    }
    m_attached.faces.resize(kept);
    m_kinds.resize(kept);
  }
  // Returns the facets that close the mesh now.
  template <typename VertexPointMap>
  Shell_closing_3 closing(VertexPointMap vpm) const
  {
    return collect_closing(m_mesh, vpm, m_attached.faces, m_kinds);
  }
  const std::vector<typename boost::graph_traits<TriangleMesh>::face_descriptor>& faces() const
  {
    return m_attached.faces;
  }
  void open()
  {
    Shell_closing_3::detach(m_mesh, m_attached);
    forget();
  }
  // Must be called if the mesh was replaced, because there is nothing to open then.
  void forget() { m_attached = Attached(); }

private:
  typedef Shell_closing_3::Attached<TriangleMesh> Attached;
  TriangleMesh& m_mesh;
  Attached m_attached; // empty if the mesh was not closed
  std::vector<Shell_closing_3::Kind> m_kinds;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_CLOSED_FOR_EDIT_H
