// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_CERTIFY_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_CERTIFY_H

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief proves the claims for a mesh in a shell, and thereby certifies the shell, for a shell that was read from a
 * file or built by `bspline_shell_3()`.
 *
 * If all claims are proved, the shell is certified (`Bspline_shell_3::is_certified()`): it gets the report of the
 * certificate, the cover, the bounds on cells, and the paths through its components, as if it had been built for the
 * mesh. The components of the shell are those in which the mesh lies. If the shell was read from a file, the mesh must
 * have exactly one component in each component that the shell had when it was written; the paths in the file identify
 * these components, and are proved first. All other proofs use only the field and the thresholds.
 *
 * If a claim is not proved, the shell is not changed, and the witnesses of the certificate locate the failures.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Field a model of `BsplineField_3`
 * \tparam Threshold a model of `ShellThreshold`
 * \tparam PolygonMesh a model of `FaceListGraph`
 * \param shell the shell. Certificates, maps, and edits that refer to it must not be in use.
 * \param mesh the mesh for which the shell was built, or any other mesh in the shell, as for
 *   `Shell_certificate_3::verify()`
 * \param np `vertex_point_map`: a property map from the vertices of `mesh` to their points
 * \return the certificate of the mesh, which converts to `true` if all claims are proved, and otherwise contains the
 *   reasons
 * \cgalHeading{Cost} That of the certificate.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Field, typename Threshold, typename PolygonMesh,
          typename CGAL_NP_TEMPLATE_PARAMETERS>
Shell_certificate_3<Field, Threshold> certify(Bspline_shell_3<Field, Threshold>& shell, const PolygonMesh& mesh,
                                              const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  Shell_certificate_3<Field, Threshold> certificate(shell);
  certificate.template verify<ConcurrencyTag>(mesh, np);
  certificate.certify(shell);
  return certificate;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_CERTIFY_H
