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
 * \brief reads the polygons of a file, whatever they form.
 *
 * The format follows from the file's extension: OFF, OBJ, PLY, STL, and GOCAD (ts). An STL file is binary if and only
 * if it has 84 bytes and 50 for each of its facets. Its points at equal positions become one.
 *
 * \param file its name
 * \param[out] soup what was read, if the status is `SUCCESS`; otherwise it is left as it is
 * \param[out] offenders positions of points with coordinates that are infinite or not a number; positions of facets
 *   with points that do not exist; and the line, of a text
 * \return `SUCCESS`; `MISSING_FILE`, `UNREADABLE_FILE`, `UNSUPPORTED_FILE`, `EMPTY_FILE`, `MALFORMED_FILE` or
 *         `TRIANGLE_STRIPS` if the file cannot be read; `EMPTY_MESH` if it has no polygon; `NOT_FINITE`
 */
Shell_status read_polygon_soup(const std::string& file, Polygon_soup& soup, Offending_simplices& offenders);

namespace internal {

// reads a soup that is a mesh
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
 * \brief reads a surface mesh and says what is wrong with it, if it is none.
 *
 * The formats are those of `read_polygon_soup()`. Vertices at equal positions are identified (STL files have no shared
 * vertices), and facets are turned round where they do not agree with their neighbors; nothing else is repaired.
 *
 * \tparam PolygonMesh a model of `MutableFaceGraph` whose points have a constructor from three `double` coordinates
 * \param file its name
 * \param[out] mesh the mesh, if the status is `SUCCESS`; otherwise it is left as it is
 * \param[out] offenders positions of facets and vertices in the file, ascending; of vertices at equal positions, the
 *   first
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
 * \brief the same, for callers who do not ask where the file is wrong.
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
 * \brief reads a surface mesh as `read_polygon_mesh()` does, and triangulates its facets (`triangulate_polygon()`):
 * maps and edits are of triangle meshes.
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
 * \brief the same, for callers who do not ask where the file is wrong.
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
