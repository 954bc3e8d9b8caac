// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_TRANSFER_IN_EXCISED_SOUP_H
#define CGAL_BSPLINE_SHELL_3_SOUP_TRANSFER_IN_EXCISED_SOUP_H

#include <CGAL/Bspline_shell_3/Soup/Excised_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/Transfer_report.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>

#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief transfers values of points from an excised soup to the rejoined soup: `transfer_vertex_attribute()` for the
 * mesh, while points of excised triangles keep their values.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \param map the map between the soups
 * \param values by point of `Excised_soup_3::soup()`
 * \param transferred receives the values by point of `Rejoined_soup_3::soup`; points without an image get `Value()`
 * \return the report on the vertices of the mesh
 * \pre `values` has as many elements as the soup has points
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Shell, typename Value>
Transfer_report transfer_point_attribute(const Excised_map_3<Shell>& map, const std::vector<Value>& values,
                                         std::vector<Value>& transferred)
{
  typedef Excised_soup_3::Mesh::Vertex_index Vertex_index;
  const Excised_soup_3& soup = map.soup();
  const Rejoined_soup_3& rejoined = map.rejoined();
  CGAL_precondition(values.size() == soup.soup().points.size());
  const auto value_of = boost::make_function_property_map<Vertex_index>(
    [&](Vertex_index v) -> Value { return values[soup.point_of(v)]; });
  transferred.assign(rejoined.soup.points.size(), Value());
  const Transfer_report report = transfer_vertex_attribute<ConcurrencyTag>(
    map.map(), value_of,
    boost::make_iterator_property_map(transferred.begin(), get(boost::vertex_index, map.map().target())));
  for(std::size_t p = 0; p < transferred.size(); ++p)
    if(rejoined.excised_point[p] != Rejoined_soup_3::none) transferred[p] = values[rejoined.excised_point[p]];
  return report;
}

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief transfers labels of triangles from an excised soup to the rejoined soup: `transfer_face_labels()` for the
 * mesh, while excised triangles keep their labels.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \param map the map between the soups
 * \param labels by triangle of `Excised_soup_3::soup()`
 * \param transferred receives the labels by triangle of `Rejoined_soup_3::soup`; triangles without an image get
 *   `Label()`
 * \return the report on the facets of the mesh
 * \pre `labels` has as many elements as the soup has triangles
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Shell, typename Label>
Transfer_report transfer_triangle_labels(const Excised_map_3<Shell>& map, const std::vector<Label>& labels,
                                         std::vector<Label>& transferred)
{
  typedef Excised_soup_3::Mesh::Face_index Face_index;
  const Excised_soup_3& soup = map.soup();
  CGAL_precondition(labels.size() == soup.soup().triangles.size());
  const auto label_of = boost::make_function_property_map<Face_index>(
    [&](Face_index f) -> Label { return labels[soup.triangle_of(f)]; });
  transferred.assign(map.rejoined().soup.polygons.size(), Label());
  const Transfer_report report = transfer_face_labels<ConcurrencyTag>(
    map.map(), label_of,
    boost::make_iterator_property_map(transferred.begin(), get(boost::face_index, map.map().target())));
  for(std::size_t n = 0; n < soup.excised_triangles().size(); ++n)
    transferred[map.rejoined().facets + n] = labels[soup.excised_triangles()[n]];
  return report;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_TRANSFER_IN_EXCISED_SOUP_H
