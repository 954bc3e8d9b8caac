// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_EXCISED_MAP_3_H
#define CGAL_BSPLINE_SHELL_3_SOUP_EXCISED_MAP_3_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief a point of a soup of triangles: a triangle, and barycentric coordinates with respect to its corners.
 */
struct Triangle_location
{
  std::size_t triangle = Excised_soup_3::none;
  std::array<double, 3> coordinates = {};
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief the image of a point of a soup, or the reason why none was found.
 */
struct Triangle_image
{
  Flow_status status = Flow_status::CANCELED;
  bool is_excised = false; ///< whether the point belongs to an excised triangle, and is its own image
  Triangle_location location;

  explicit operator bool() const { return status == Flow_status::SUCCESS; }
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief the map between an excised soup and the soup in which another mesh replaces its mesh (`rejoin_excised()`). It
 * follows integral curves on the mesh, and is the identity on excised triangles.
 *
 * If both meshes are certified in the shell, the map is one-to-one (\ref BsplineShell3Excision). Const member functions
 * may be called concurrently. The shell, the soup, and the mesh must outlive the map and must not change.
 *
 * \tparam Shell_ a `CGAL::Bspline_shell_3`
 */
template <typename Shell_>
class Excised_map_3
{
public:
  typedef Shell_ Shell;
  typedef Excised_soup_3::Mesh Mesh;
  typedef Shell_map_3<Shell, Mesh> Map;

  /// \pre `rejoined` is the valid result of `rejoin_excised(soup, mesh)`
  Excised_map_3(const Shell& shell, const Excised_soup_3& soup, const Mesh& mesh, Rejoined_soup_3 rejoined)
    : m_soup(&soup), m_rejoined(std::move(rejoined)), m_map(shell, soup.mesh(), mesh)
  {
    CGAL_precondition(bool(m_rejoined));
    m_position.assign(soup.soup().triangles.size(), Excised_soup_3::none);
    for(std::size_t n = 0; n < soup.excised_triangles().size(); ++n)
      m_position[soup.excised_triangles()[n]] = m_rejoined.facets + n;
  }
  Excised_map_3(const Shell&&, const Excised_soup_3&, const Mesh&, Rejoined_soup_3) = delete; // would dangle
  Excised_map_3(const Shell&, const Excised_soup_3&&, const Mesh&, Rejoined_soup_3) = delete;
  Excised_map_3(const Shell&, const Excised_soup_3&, const Mesh&&, Rejoined_soup_3) = delete;

  const Excised_soup_3& soup() const { return *m_soup; }         ///< the source
  const Rejoined_soup_3& rejoined() const { return m_rejoined; } ///< the target
  const Map& map() const { return m_map; } ///< the map between the meshes without the excised triangles

  /// returns the image of a point of `Excised_soup_3::soup()` on `Rejoined_soup_3::soup`
  Triangle_image operator()(const Triangle_location& p) const
  {
    if(m_soup->is_excised(p.triangle)) return fixed(m_position[p.triangle], p);
    const Mesh::Face_index f = m_soup->facet_of(p.triangle);
    typename Map::Source_location start(f, {});
    for(std::size_t i = 0; i < 3; ++i) start.second[i] = p.coordinates[corner(p.triangle, i)];
    const auto image = m_map(start);
    Triangle_image result;
    result.status = image.status;
    if(image) result.location = { std::size_t(image.location.first), image.location.second };
    return result;
  }

  /// returns the image of a point of `Rejoined_soup_3::soup` on `Excised_soup_3::soup()`
  Triangle_image inverse(const Triangle_location& p) const
  {
    if(p.triangle >= m_rejoined.facets) return fixed(m_soup->excised_triangles()[p.triangle - m_rejoined.facets], p);
    const auto image = m_map.inverse()(
      typename Map::Target_location(Mesh::Face_index(Mesh::size_type(p.triangle)), p.coordinates));
    Triangle_image result;
    result.status = image.status;
    if(!image) return result;
    result.location.triangle = m_soup->triangle_of(image.location.first);
    for(std::size_t i = 0; i < 3; ++i)
      result.location.coordinates[corner(result.location.triangle, i)] = image.location.second[i];
    return result;
  }

private:
  static Triangle_image fixed(std::size_t triangle, const Triangle_location& p)
  {
    Triangle_image image;
    image.status = Flow_status::SUCCESS;
    image.is_excised = true;
    image.location = { triangle, p.coordinates };
    return image;
  }

  // Returns the corner of a kept triangle that is a corner of its facet, in the order of `Face_location`.
  std::size_t corner(std::size_t triangle, std::size_t of_facet) const
  {
    const Mesh& mesh = m_soup->mesh();
    auto h = mesh.halfedge(m_soup->facet_of(triangle));
    for(std::size_t i = 0; i < of_facet; ++i) h = mesh.next(h);
    const Soup_triangles::Triangle& corners = m_soup->soup().triangles[triangle];
    const std::size_t point = m_soup->point_of(mesh.source(h));
    return std::size_t(std::find(corners.begin(), corners.end(), point) - corners.begin());
  }

  const Excised_soup_3* m_soup;
  Rejoined_soup_3 m_rejoined;
  Map m_map;
  std::vector<std::size_t> m_position; // positions of excised triangles in the rejoined soup
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_EXCISED_MAP_3_H
