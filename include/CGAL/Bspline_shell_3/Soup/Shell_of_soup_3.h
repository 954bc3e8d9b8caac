// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_SHELL_OF_SOUP_3_H
#define CGAL_BSPLINE_SHELL_3_SOUP_SHELL_OF_SOUP_3_H

#include <CGAL/Bspline_shell_3/Soup/Soup_proxy_3.h>
#include <CGAL/Bspline_shell_3/Soup/near_duplicates.h>
#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <CGAL/assertions.h>

#include <cstddef>
#include <memory>
#include <string>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Soup
/// what a shell is of
enum class Shell_kind
{
  CLOSED,           ///< the mesh itself
  TRUNCATED,        ///< the mesh itself, with tips replaced (`Bspline_shell_3::truncation()`)
  VIRTUALLY_CLOSED, ///< the mesh itself, which is open, and the triangles that close it; tips may be replaced, too
  PROXY             ///< a closed mesh around it
};

/// \ingroup PkgBsplineShell3Soup
/// as in reports
inline const char* name(Shell_kind kind)
{
  switch(kind) {
    case Shell_kind::CLOSED: return "closed";
    case Shell_kind::TRUNCATED: return "truncated";
    case Shell_kind::VIRTUALLY_CLOSED: return "virtually closed";
    case Shell_kind::PROXY: return "proxy";
  }
  return "";
}

namespace internal {

// the message of a status, without the advice to take a proxy
inline const char* message_beside_proxy(Shell_status status)
{
  switch(status) {
    case Shell_status::NON_MANIFOLD: return "The mesh is not manifold at the listed facets or vertices.";
    case Shell_status::NOT_ORIENTABLE:
      return "The mesh is one-sided, as it has no orientation that neighboring facets share.";
    case Shell_status::NOT_CLOSABLE:
      return "The mesh is open, and cannot be closed, by caps of its holes or a sheet behind it, at the listed facets.";
    case Shell_status::SELF_INTERSECTION: return "The mesh intersects itself at the listed facets.";
    default: return message(status);
  }
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief what `certified_shell_of_soup_3()` makes of polygons: a mesh, its shell, and how both came about.
 */
struct Shell_of_soup_3
{
  typedef Soup_proxy_3::Mesh Mesh;
  typedef Soup_proxy_3::Shell Shell;

  Soup_repairs repairs; ///< of the mesh that was tried first
  /// what became of the polygons as a mesh, or why they are none. With `SUCCESS`, there is a shell of them, certified
  /// or not.
  Shell_status mesh_status = Shell_status::NOT_BUILT;
  /// what became of a proxy, if one was tried: that is, unless the mesh got a certified shell
  Shell_status proxy_status = Shell_status::NOT_BUILT;
  /// those to blame for `mesh_status`: positions in the soup, if there is no repaired mesh, and otherwise in that
  Offending_simplices offending_simplices;
  /// if the mesh is refused: the number of points of the soup that are almost at others (`number_of_near_duplicates()`)
  std::size_t near_duplicates = 0;
  Invalid_parameter invalid_parameter;       ///< the refused one, if a status is `INVALID_PARAMETER`
  Mesh repaired_mesh;                        ///< the polygons as a mesh, where they are one
  Shell shell_of_mesh;                       ///< of that mesh
  std::shared_ptr<const Soup_proxy_3> proxy; ///< not null if a proxy is the result: it is certified
  double seconds = 0;                        ///< that all of it took

  /// \pre there is a shell
  Shell_kind kind() const
  {
    CGAL_precondition(bool(shell()));
    return proxy                        ? Shell_kind::PROXY
           : shell_of_mesh.closing()    ? Shell_kind::VIRTUALLY_CLOSED
           : shell_of_mesh.truncation() ? Shell_kind::TRUNCATED
                                        : Shell_kind::CLOSED;
  }
  const Mesh& mesh() const { return proxy ? proxy->mesh() : repaired_mesh; } ///< what the shell is of
  const Shell& shell() const { return proxy ? proxy->shell() : shell_of_mesh; }
  explicit operator bool() const { return bool(shell()); } ///< whether there is a shell
  /// `SUCCESS`, or why there is no shell
  Shell_status status() const
  {
    return shell() ? Shell_status::SUCCESS : internal::ends_all_attempts(proxy_status) ? proxy_status : mesh_status;
  }
  bool is_certified() const { return shell().is_certified(); }
  /// what became of the polygons as a mesh, in one sentence or two: with a proxy, why there is one
  std::string mesh_message() const
  {
    if(mesh_status == Shell_status::SUCCESS) return shell_of_mesh.message();
    const bool has_proxy = proxy_status != Shell_status::NOT_BUILT;
    std::string text = has_proxy ? internal::message_beside_proxy(mesh_status)
                                 : Bspline_shells::message(mesh_status, invalid_parameter);
    if(near_duplicates > 0)
      text += " Of its points, " + std::to_string(near_duplicates)
              + " are closer than 1e-6 of the box to another one: merge them.";
    return text;
  }
  /// the outcome in one sentence or two
  std::string message() const
  {
    if(proxy) return proxy->message();
    if(!shell() && internal::ends_all_attempts(proxy_status))
      return Bspline_shells::message(proxy_status, invalid_parameter);
    return shell() || status() == mesh_status ? mesh_message() : Bspline_shells::message(status(), invalid_parameter);
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_SHELL_OF_SOUP_3_H
