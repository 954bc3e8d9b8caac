// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SURFACE_EXTRACT_LEVEL_SET_H
#define CGAL_BSPLINE_SHELL_3_SURFACE_EXTRACT_LEVEL_SET_H

#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Surface/Level_set_status.h>
#include <CGAL/Bspline_shell_3/Surface/internal/Field_cells.h>
#include <CGAL/Bspline_shell_3/Surface/internal/Level_set_soup.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/tags.h>

#include <cmath>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

struct All_cells
{
  template <typename Index>
  bool operator()(Index) const
  {
    return true;
  }
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Surface
 *
 * \brief extracts a triangle mesh of the level set \f$\{f = level\}\f$ of a field, or of the points where the field
 * equals a threshold. See `extract_shell_surface()` for the surfaces of a shell.
 *
 * Each leaf cell is divided into subcells, and these into tetrahedra, which conform also where small leaves meet larger
 * leaves. Each tetrahedron that the level set intersects yields one or two triangles (*marching tetrahedra*). By
 * construction, the mesh is closed and 2-manifold across leaves of all sizes, and also where the level set is singular;
 * there, it is the mesh of a slightly lower level. The normals of facets point in the direction in which the field
 * increases.
 *
 * Vertices lie on the level set up to rounding. They are kept away from the ends of the tetrahedra's edges by about a
 * thousand roundings of the coordinates, so that no two vertices coincide. Because facets may be that small,
 * coordinates must be written with all digits. Parts of the level set that are smaller than a tetrahedron may be
 * missed, and parts that are closer together may be joined.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Field a model of `BsplineField_3`
 * \tparam Level a number type, or a model of `ShellThreshold`
 * \tparam TriangleMesh a model of `MutableFaceGraph`
 * \tparam NamedParameters a sequence of \ref BsplineShell3NamedParameters "named parameters"
 *
 * \param field the field
 * \param level a value of the field, or a threshold on the same cells
 * \param out the mesh to which the level set is added; unchanged if there is nothing to add
 * \param np optional named parameters:
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{filter}
 *       \cgalParamDescription{a functor `bool(Field::Cell_index)` that selects the cells to use, and thus the
 *         components of a level set in these cells; it is copied unless it is passed by `std::cref()`}
 *       \cgalParamDefault{all cells}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{skip_open_components}
 *       \cgalParamDescription{whether components of the level set that leave the selected cells are omitted; otherwise,
 *         such a component makes the extraction fail. If all components leave the cells, there is no mesh.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{subdivision_ratio}
 *       \cgalParamDescription{number of subcells along each axis of a cell}
 *       \cgalParamType{`int`}
 *       \cgalParamDefault{2}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{vertex_point_map}
 *       \cgalParamDescription{a property map from the vertices of `out` to their points}
 *       \cgalParamDefault{`get(CGAL::vertex_point, out)`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 *
 * \return `SUCCESS`, or the reason why there is no mesh
 * \pre `subdivision_ratio` is at least 1 and at most 256
 * \cgalHeading{Cost} Linear in the number of cells and in the number of subcells of the cells that the level set may
 *   intersect.
 */
template <typename ConcurrencyTag = Sequential_tag, typename Field, typename Level, typename TriangleMesh,
          typename CGAL_NP_TEMPLATE_PARAMETERS>
Level_set_status extract_level_set(const Field& field, const Level& level, TriangleMesh& out,
                                   const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  typedef std::conditional_t<std::is_arithmetic<Level>::value, Constant_threshold, Level> Threshold;
  typedef internal::Field_cells<Field, Threshold> Cells;
  typedef internal::Level_set_soup<Cells> Soup;

  auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point), get_property_map(vertex_point, out));
  const int ratio = choose_parameter(get_parameter(np, internal_np::subdivision_ratio), 2);
  const bool skip_open = choose_parameter(get_parameter(np, parameter_tags::skip_open_components), false);
  auto&& filter = internal::argument<internal::All_cells>(np, internal_np::filter);
  CGAL_precondition(ratio >= 1 && ratio <= 256);
  if constexpr(std::is_arithmetic<Level>::value)
    if(!std::isfinite(double(level))) return Level_set_status::LEVEL_SET_EMPTY;

  std::vector<typename Soup::Point> points;
  std::vector<typename Soup::Triangle> triangles;
  const Threshold threshold(level);
  const Level_set_status status = Soup::template extract<ConcurrencyTag>(Cells(field, threshold), ratio, filter,
                                                                         skip_open, points, triangles);
  if(status == Level_set_status::SUCCESS)
    Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, out, CGAL::parameters::default_values(),
                                                          CGAL::parameters::vertex_point_map(vpm));
  return status;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SURFACE_EXTRACT_LEVEL_SET_H
