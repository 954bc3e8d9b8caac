// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_READ_POLYGON_MESH_H
#define CGAL_BSPLINE_SHELL_3_IO_READ_POLYGON_MESH_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/properties.h>

#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief reads the polygons of a file as a polygon soup. Other data in the file, such as colors and texture
 * coordinates, is ignored.
 *
 * The extension of the file selects the format: OFF, OBJ, PLY, STL, or GOCAD (ts). An STL file is binary if and only if
 * it has 84 bytes plus 50 bytes per facet. Points of an STL file at equal positions are merged.
 *
 * \param file path of the file
 * \param[out] soup the polygon soup if the status is `SUCCESS`; otherwise unchanged
 * \param[out] offenders positions of points with coordinates that are infinite or not a number, and of facets that
 *   refer to missing points; for text files, the number of the offending line
 * \return `SUCCESS`; `MISSING_FILE`, `UNREADABLE_FILE`, `UNSUPPORTED_FILE`, `EMPTY_FILE`, `MALFORMED_FILE`, or
 *   `TRIANGLE_STRIPS` if the file cannot be read; `EMPTY_MESH` if it has no polygons; `NOT_FINITE`
 */
Shell_status read_polygon_soup(const std::string& file, Polygon_soup& soup, Offending_simplices& offenders);

namespace internal {

// Reads a polygon soup, merges points at equal positions, and orients it as a mesh.
Shell_status read_oriented_soup(const std::string& file, Polygon_soup& soup, Offending_simplices& offenders);

template <typename PolygonMesh>
void assign_soup(const Polygon_soup& soup, PolygonMesh& mesh)
{
  typedef
    typename boost::property_traits< typename boost::property_map<PolygonMesh, CGAL::vertex_point_t>::type>::value_type
      Point_3;
  std::vector<Point_3> points;
  points.reserve(soup.points.size());
  for(const auto& p : soup.points) points.emplace_back(p.x(), p.y(), p.z());
  mesh.clear();
  Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, soup.polygons, mesh);
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief reads a surface mesh, or reports why the file does not contain one.
 *
 * The formats are those of `read_polygon_soup()`. Vertices at equal positions are merged, and facets are reversed where
 * necessary for a consistent orientation. Nothing else is repaired.
 *
 * \tparam PolygonMesh a model of `MutableFaceGraph` whose points have a constructor from three `double` coordinates
 * \param file path of the file
 * \param[out] mesh the mesh if the status is `SUCCESS`; otherwise unchanged
 * \param[out] offenders positions of facets and vertices in the file, ascending; for vertices at equal positions, that
 *   of the first
 */
template <typename PolygonMesh>
Shell_status read_polygon_mesh(const std::string& file, PolygonMesh& mesh, Offending_simplices& offenders)
{
  Polygon_soup soup;
  const Shell_status status = internal::read_oriented_soup(file, soup, offenders);
  if(status == Shell_status::SUCCESS) internal::assign_soup(soup, mesh);
  return status;
}

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief reads a surface mesh without reporting positions of errors.
 */
template <typename PolygonMesh>
Shell_status read_polygon_mesh(const std::string& file, PolygonMesh& mesh)
{
  Offending_simplices offenders;
  return read_polygon_mesh(file, mesh, offenders);
}

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief reads a surface mesh like `read_polygon_mesh()`, and triangulates its facets with `triangulate_polygon()`.
 * Maps and edits require triangle meshes.
 */
template <typename TriangleMesh>
Shell_status read_triangle_mesh(const std::string& file, TriangleMesh& mesh, Offending_simplices& offenders)
{
  Polygon_soup soup;
  const Shell_status status = internal::read_oriented_soup(file, soup, offenders);
  if(status != Shell_status::SUCCESS) return status;
  if(!internal::triangulate(soup)) return Shell_status::DEGENERATE_FACET;
  internal::assign_soup(soup, mesh);
  return Shell_status::SUCCESS;
}

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief reads a triangle mesh without reporting positions of errors.
 */
template <typename TriangleMesh>
Shell_status read_triangle_mesh(const std::string& file, TriangleMesh& mesh)
{
  Offending_simplices offenders;
  return read_triangle_mesh(file, mesh, offenders);
}

#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
namespace internal {
extern template void assign_soup(const Polygon_soup&,
                                 Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>&);
}
#endif

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_IO_READ_POLYGON_MESH_H
