// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_PREPARE_MESH_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_PREPARE_MESH_H

#include <CGAL/Bspline_shell_3/Construction/build_certified_shell.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Shell/Shell_report.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Construction
/// validates, closes, and truncates a copy of a mesh.
/// \param mesh the result of `copy_mesh()`
/// \param tolerated defects that are not checked
/// \param parameters how the mesh is closed and truncated
/// \param[out] report how the mesh was closed and truncated
/// \return the mesh, or the reason why it is rejected
template <typename ConcurrencyTag>
Input_mesh_3 prepare_mesh(Mesh_with_origins mesh, const Input_mesh_3::Tolerated_defects& tolerated,
                          const Certified_shell_parameters& parameters, Shell_report& report);

/// \ingroup PkgBsplineShell3Construction
/// copies a mesh, and prepares the copy.
/// \param mesh a model of `FaceListGraph`
/// \param vpm the points of its vertices
template <typename ConcurrencyTag, typename FaceGraph, typename VertexPointMap>
Input_mesh_3 prepare_mesh(const FaceGraph& mesh, VertexPointMap vpm, const Input_mesh_3::Tolerated_defects& tolerated,
                          const Certified_shell_parameters& parameters, Shell_report& report)
{
  return prepare_mesh<ConcurrencyTag>(copy_mesh<ConcurrencyTag>(mesh, vpm), tolerated, parameters, report);
}

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Construction/prepare_mesh_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_PREPARE_MESH_H
