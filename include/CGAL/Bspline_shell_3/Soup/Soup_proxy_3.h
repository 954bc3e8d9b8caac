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

#include <CGAL/assertions.h>

#include <string>
#include <utility>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief A polygon soup, a clean closed mesh around it, and the certified shell of that mesh. The shell transfers
 * attributes between the soup and the mesh.
 *
 * Proxies are made by `certified_soup_proxy_3()`. Maps refer to the proxy, which must outlive them and must not be
 * moved.
 */
class Soup_proxy_3
{
public:
  typedef Soup_mesh_3::Mesh Mesh;
  typedef Certified_bspline_shell_3 Shell;
  typedef Soup_map_3<Shell, Mesh> Map;

  /// Makes an object without a proxy, with the reason.
  explicit Soup_proxy_3(Shell_status status = Shell_status::NOT_BUILT,
                        Offending_simplices offenders = Offending_simplices(),
                        const Invalid_parameter& invalid = Invalid_parameter())
    : m_status(status), m_offenders(std::move(offenders)), m_invalid_parameter(invalid)
  {}
  Soup_proxy_3(Soup_mesh_3 soup, Mesh mesh, Shell shell, const Proxy_report& report)
    : m_status(shell.status()), m_invalid_parameter(shell.report().invalid_parameter), m_soup(std::move(soup)),
      m_mesh(std::move(mesh)), m_shell(std::move(shell)), m_report(report)
  {}

  /// Whether there is a shell; otherwise, `status()` is the reason.
  explicit operator bool() const { return m_status == Shell_status::SUCCESS; }
  Shell_status status() const { return m_status; }
  /// If there is no proxy: positions of polygons and points of the soup.
  const Offending_simplices& offending_simplices() const { return m_offenders; }
  /// The rejected parameter if the status is `INVALID_PARAMETER`.
  const Invalid_parameter& invalid_parameter() const { return m_invalid_parameter; }
  bool is_certified() const { return m_shell.is_certified(); }
  /// Returns the outcome in one or two sentences.
  std::string message() const
  {
    if(!*this) return Bspline_shells::message(m_status, m_invalid_parameter);
    return is_certified() && m_report.is_thicker_than_asked ? "All claims are proved for the shell of the proxy, which "
                                                              "is thicker than requested to reach the polygons."
                                                            : m_shell.message();
  }

  const Soup_mesh_3& soup() const { return m_soup; }
  const Mesh& mesh() const { return m_mesh; }    ///< The proxy, which is closed and has no self-intersections.
  const Shell& shell() const { return m_shell; } ///< Shell of the proxy.
  const Proxy_report& report() const { return m_report; }

  /// Returns the map from the soup's mesh to the proxy; `Map::inverse()` is the reverse map. A map builds a box tree
  /// for each mesh: reuse it.
  /// \pre there is a proxy, and no other thread prepares a map of it
  Map map() const
  {
    CGAL_precondition(bool(m_shell));
    return map(m_mesh);
  }
  /// Returns the map from the soup's mesh to another mesh in the shell, such as an edited proxy.
  Map map(const Mesh& mesh) const { return Map(m_shell, m_soup.mesh(), mesh); }

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

#endif // CGAL_BSPLINE_SHELL_3_SOUP_SOUP_PROXY_3_H
