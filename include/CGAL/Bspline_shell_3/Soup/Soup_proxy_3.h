// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_SOUP_PROXY_3_H
#define CGAL_BSPLINE_SHELL_3_SOUP_SOUP_PROXY_3_H

#include <CGAL/Bspline_shell_3/Construction/build_certified_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Soup_map_3.h>
#include <CGAL/Bspline_shell_3/Soup/Proxy_report.h>
#include <CGAL/Bspline_shell_3/Soup/Soup_mesh_3.h>
#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <string>
#include <utility>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief a polygon soup, its proxy (a closed mesh around it without self-intersections), and the shell of the proxy.
 * Attributes are transferred between the soup and the proxy.
 *
 * Proxies are made by `certified_soup_proxy_3()`. Maps refer to this object, which must outlive them and must not be
 * moved.
 */
class Soup_proxy_3
{
public:
  typedef Soup_mesh_3::Mesh Mesh;
  typedef Certified_bspline_shell_3 Shell;
  typedef Soup_map_3<Shell, Mesh> Map;

  /// constructs an object without a proxy, with the reason
  explicit Soup_proxy_3(Shell_status status = Shell_status::NOT_BUILT,
                        Offending_simplices offenders = Offending_simplices(),
                        const Invalid_parameter& invalid = Invalid_parameter())
    : m_status(status), m_offenders(std::move(offenders)), m_invalid_parameter(invalid)
  {}
  Soup_proxy_3(Soup_mesh_3 soup, Mesh mesh, Shell shell, const Proxy_report& report)
    : m_status(shell.status()), m_invalid_parameter(shell.report().invalid_parameter), m_soup(std::move(soup)),
      m_mesh(std::move(mesh)), m_shell(std::move(shell)), m_report(report)
  {}

  /// returns whether there is a shell; otherwise, `status()` is the reason
  explicit operator bool() const { return m_status == Shell_status::SUCCESS; }
  Shell_status status() const { return m_status; }
  /// if there is no proxy: positions of the polygons and points of the soup that are the cause
  const Offending_simplices& offending_simplices() const { return m_offenders; }
  /// the rejected parameter if the status is `INVALID_PARAMETER`
  const Invalid_parameter& invalid_parameter() const { return m_invalid_parameter; }
  bool is_certified() const { return m_shell.is_certified(); }
  /// returns the outcome in one or two sentences
  std::string message() const
  {
    if(!*this) return Bspline_shells::message(m_status, m_invalid_parameter);
    if(is_certified() && m_report.exceeds_requested_thickness)
      return "All claims are proved for the shell of the proxy. To reach the polygons, it is thicker than requested.";
    return m_shell.message();
  }

  const Soup_mesh_3& soup() const { return m_soup; }
  const Mesh& mesh() const { return m_mesh; }    ///< the proxy
  const Shell& shell() const { return m_shell; } ///< the shell of the proxy
  const Proxy_report& report() const { return m_report; }

  /// returns the map from the soup's mesh to the proxy; `Map::inverse()` returns the inverse map. Keep the map if it is
  /// used several times, because it builds a search tree for each mesh.
  /// \pre there is a proxy, and no other thread prepares a map of it
  Map map() const;
  /// returns the map from the soup's mesh to another mesh in the shell, such as an edited proxy
  Map map(const Mesh& mesh) const;

private:
  Shell_status m_status;
  Offending_simplices m_offenders;
  Invalid_parameter m_invalid_parameter;
  Soup_mesh_3 m_soup;
  Mesh m_mesh;
  Shell m_shell;
  Proxy_report m_report;
};

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/Soup_proxy_3_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_SOUP_PROXY_3_H
