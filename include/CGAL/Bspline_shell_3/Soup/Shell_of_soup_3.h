// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_SHELL_OF_SOUP_3_H
#define CGAL_BSPLINE_SHELL_3_SOUP_SHELL_OF_SOUP_3_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/Soup_proxy_3.h>
#include <CGAL/Bspline_shell_3/Soup/Unite_report.h>
#include <CGAL/Bspline_shell_3/Soup/United_mesh.h>
#include <CGAL/Bspline_shell_3/Soup/near_duplicates.h>
#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include <CGAL/Bspline_shell_3/Soup/weld_soup.h>
#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <CGAL/assertions.h>

#include <cstddef>
#include <iomanip>
#include <locale>
#include <memory>
#include <sstream>
#include <string>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Soup
/// the kind of mesh for which a shell was built
enum class Shell_kind
{
  CLOSED,           ///< the mesh itself
  TRUNCATED,        ///< the mesh itself, with truncated tips (`Bspline_shell_3::truncation()`)
  VIRTUALLY_CLOSED, ///< the mesh itself, which is open, with triangles that close it; tips may be truncated
  UNITED,           ///< the boundary of the union of the mesh's parts (`unite_parts()`); tips may be truncated
  EXCISED,          ///< the triangles that remain after some were excised (`Excised_soup_3`)
  PROXY             ///< a closed mesh around the polygons
};

/// \ingroup PkgBsplineShell3Soup
/// returns the name that reports use
inline const char* name(Shell_kind kind)
{
  switch(kind) {
    case Shell_kind::CLOSED: return "closed";
    case Shell_kind::TRUNCATED: return "truncated";
    case Shell_kind::VIRTUALLY_CLOSED: return "virtually closed";
    case Shell_kind::UNITED: return "united";
    case Shell_kind::EXCISED: return "excised";
    case Shell_kind::PROXY: return "proxy";
  }
  return "";
}

/// \ingroup PkgBsplineShell3Soup
/// the mesh for which the claims of a certificate are proved
enum class Certification
{
  NONE,           ///< no mesh
  EXCEPT_EXCISED, ///< the mesh of the shell, which is the input except for the excised triangles
  WHOLE           ///< the mesh of the shell; no triangle is excised, but the mesh may be a proxy
};

/// \ingroup PkgBsplineShell3Soup
/// returns the name that reports use
inline const char* name(Certification certification)
{
  switch(certification) {
    case Certification::NONE: return "not certified";
    case Certification::EXCEPT_EXCISED: return "certified except for excised triangles";
    case Certification::WHOLE: return "certified";
  }
  return "";
}

namespace internal {

// Returns the message of a status without the advice to use a proxy.
inline const char* message_beside_proxy(Shell_status status)
{
  switch(status) {
    case Shell_status::NON_MANIFOLD: return "The mesh is not manifold at the listed facets or vertices.";
    case Shell_status::NOT_ORIENTABLE:
      return "The mesh is not orientable, so its facets cannot be oriented consistently.";
    case Shell_status::NOT_CLOSABLE:
      return "The mesh is open, and neither caps of its holes nor a sheet behind it can close it at the listed facets.";
    case Shell_status::SELF_INTERSECTION: return "The mesh intersects itself at the listed facets.";
    default: return message(status);
  }
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief the result of `certified_shell_of_soup_3()`: a mesh, its shell, and how they were obtained from the polygons.
 */
struct Shell_of_soup_3
{
  typedef Soup_proxy_3::Mesh Mesh;
  typedef Soup_proxy_3::Shell Shell;

  Soup_repairs repairs; ///< repairs that were made to obtain `repaired_mesh`
  Weld_report weld;     ///< cracks that were closed to obtain `repaired_mesh`, or the reason why none were
  /// if the soup was welded: the origin of each polygon of the welded soup, of which `repaired_mesh` was made
  Weld_provenance weld_provenance;
  /// the outcome for the polygons as a mesh, or the reason why they do not form one. If it is `SUCCESS`, the mesh has a
  /// shell, which may be uncertified. If parts were united, it is the outcome for their union.
  Shell_status mesh_status = Shell_status::NOT_BUILT;
  /// the outcome for the mesh of an excised soup, which is tried if the polygons or their mesh have defects
  Shell_status excision_status = Shell_status::NOT_BUILT;
  /// the outcome for a proxy, which is tried unless the shell of the mesh, or of an excised soup, is certified
  Shell_status proxy_status = Shell_status::NOT_BUILT;
  /// facets and vertices that caused `mesh_status`: positions in the united mesh, if there is one; otherwise, in the
  /// repaired mesh, or in the soup if there is no repaired mesh
  Offending_simplices offending_simplices;
  /// if the mesh was rejected: the number of points close to another point (`number_of_near_duplicates()`)
  std::size_t near_duplicates = 0;
  Invalid_parameter invalid_parameter;       ///< the rejected parameter if a status is `INVALID_PARAMETER`
  Mesh repaired_mesh;                        ///< the polygons as a mesh, if they form one
  Unite_report unite_report;                 ///< the outcome of uniting parts, tried if a closed mesh intersects itself
  std::shared_ptr<const United_mesh> united; ///< not null if parts of the repaired mesh were united
  Shell shell_of_mesh;                       ///< the shell of `own_mesh()`
  Excision_report excision_report;           ///< the excision that was tried last, even if its shell is not certified
  double largest_excised_share = 0;          ///< the limit of the area that may be excised
  /// not null if the result is the mesh of an excised soup, whose shell is certified
  std::shared_ptr<const Excised_soup_3> excised;
  Shell shell_of_excised;                    ///< the shell of the mesh of `excised`
  std::shared_ptr<const Soup_proxy_3> proxy; ///< not null if the result is a proxy, whose shell is certified
  double seconds = 0;                        ///< total time, in seconds

  /// \pre there is a shell
  Shell_kind kind() const
  {
    CGAL_precondition(bool(shell()));
    return proxy                        ? Shell_kind::PROXY
           : excised                    ? Shell_kind::EXCISED
           : united                     ? Shell_kind::UNITED
           : shell_of_mesh.closing()    ? Shell_kind::VIRTUALLY_CLOSED
           : shell_of_mesh.truncation() ? Shell_kind::TRUNCATED
                                        : Shell_kind::CLOSED;
  }
  /// returns the union of the repaired mesh's parts, if they were united; otherwise, the repaired mesh
  const Mesh& own_mesh() const { return united ? united->mesh : repaired_mesh; }
  /// returns the mesh of the shell
  const Mesh& mesh() const { return proxy ? proxy->mesh() : excised ? excised->mesh() : own_mesh(); }
  const Shell& shell() const { return proxy ? proxy->shell() : excised ? shell_of_excised : shell_of_mesh; }
  explicit operator bool() const { return bool(shell()); } ///< whether there is a shell
  /// returns `SUCCESS`, or the reason why there is no shell
  Shell_status status() const
  {
    if(shell()) return Shell_status::SUCCESS;
    for(Shell_status last : { excision_status, proxy_status })
      if(internal::ends_all_attempts(last)) return last;
    return mesh_status;
  }
  Certification certification() const
  {
    if(!shell().is_certified()) return Certification::NONE;
    return kind() == Shell_kind::EXCISED && !excised->excised_triangles().empty() ? Certification::EXCEPT_EXCISED
                                                                                  : Certification::WHOLE;
  }
  /// returns whether the whole mesh of the shell is certified. If this mesh is a proxy, the map from the polygons is
  /// not one-to-one.
  bool is_certified() const { return certification() == Certification::WHOLE; }
  /// returns the outcome for the polygons as a mesh in a few sentences; for a proxy, the reason for using it
  std::string mesh_message() const
  {
    const std::string welding = Bspline_shells::message(weld);
    const bool concerns_welding = !welding.empty() && !(weld.is_none() && shell_of_mesh.is_certified());
    const std::string excision = excised ? "" : excision_message();
    return message_without_welding() + (concerns_welding ? " " + welding : "")
           + (excision.empty() ? "" : " " + excision);
  }
  /// returns the outcome of excision in a sentence or two; empty if nothing was excised
  std::string excision_message() const
  {
    if(excision_report.excised == 0) return "";
    if(excised) return Bspline_shells::message(excision_report);
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << "Excision does not help: ";
    if(excision_report.excised_area > largest_excised_share)
      text << std::setprecision(2) << 100 * excision_report.excised_area
           << " % of the area would be excised, more than " << 100 * largest_excised_share
           << " % (largest_excised_share).";
    else
      text << "the mesh without " << excision_report.excised << " of " << excision_report.triangles
           << " triangles has no certified shell, either.";
    return text.str();
  }
  /// returns the outcome in a few sentences
  std::string message() const
  {
    if(proxy) return proxy->message();
    if(excised) return shell_of_excised.message() + " " + Bspline_shells::message(excised->report());
    if(!shell() && internal::ends_all_attempts(status())) return Bspline_shells::message(status(), invalid_parameter);
    return shell() || status() == mesh_status ? mesh_message() : Bspline_shells::message(status(), invalid_parameter);
  }

private:
  std::string message_without_welding() const
  {
    std::string text;
    if(unite_report.status != Unite_status::NOT_TRIED) text = Bspline_shells::message(unite_report) + " ";
    if(mesh_status == Shell_status::SUCCESS) return text + shell_of_mesh.message();
    const bool is_replaced = proxy_status != Shell_status::NOT_BUILT || excised;
    text += is_replaced ? internal::message_beside_proxy(mesh_status)
                        : Bspline_shells::message(mesh_status, invalid_parameter);
    if(near_duplicates > 0)
      text += " In the input, " + std::to_string(near_duplicates)
              + " points are closer to another point than 1e-6 of the bounding box: merge them (weld_tolerance).";
    return text;
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_SHELL_OF_SOUP_3_H
