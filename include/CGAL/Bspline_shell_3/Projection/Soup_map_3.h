// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_SOUP_MAP_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_SOUP_MAP_3_H

#include <CGAL/Bspline_shell_3/Projection/Proxy_projection_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Projection/Soup_projection_3.h>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief the map from a polygon soup, as a mesh that may intersect itself (`Soup_proxy_3::soup()`), to a mesh in the
 * shell of its proxy: the proxy or an edited proxy.
 *
 * Each point of the soup that lies in the shell has one image on a mesh that is certified in the shell. In the other
 * direction (`Soup_map_3::inverse()`), a point of the mesh is mapped to the first part of the soup along its curve
 * (`Soup_projection_3`). Attributes are transferred in both directions by the same functions as between two meshes.
 */
template <typename Shell, typename SoupMesh, typename TriangleMesh = SoupMesh>
using Soup_map_3 = Shell_map_3<Shell, SoupMesh, TriangleMesh, Soup_projection_3<Shell, SoupMesh>,
                               Proxy_projection_3<Shell, TriangleMesh> >;

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_SOUP_MAP_3_H
