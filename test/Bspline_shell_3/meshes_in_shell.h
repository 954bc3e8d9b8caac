// Second meshes in a certified shell: vertices are moved along the integral curves, by amounts that vary smoothly.
#ifndef MESHES_IN_SHELL_H
#define MESHES_IN_SHELL_H

#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>

#include <cmath>

// Moves each vertex towards one of the thresholds, by at most the share `amount` of the way.
// \pre the mesh is in the shell
template <typename Shell>
Mesh moved_along_flow(const Shell& shell, Mesh mesh, double amount)
{
  const CGAL::Bspline_shells::Gradient_flow_3<Shell> flow(shell);
  const double unit = shell.report().unit;
  for(auto v : mesh.vertices()) {
    const Point_3 p = mesh.point(v);
    const double wave = std::sin(7 * p.x() / unit + 1) * std::cos(5 * p.y() / unit + 3 * p.z() / unit);
    const double f = *shell.field().value(p);
    const double end = wave > 0 ? shell.outer_threshold().value(p) : shell.inner_threshold().value(p);
    const auto arrival = flow.trace(p, f + amount * std::abs(wave) * (end - f));
    REQUIRE(arrival);
    mesh.point(v) = arrival.point;
  }
  return mesh;
}

// Moves vertices as far as the certificate permits, for meshes whose shells are certified.
template <typename Shell>
Mesh certified_mesh_in_shell(const Shell& shell, const Mesh& mesh)
{
  CGAL::Bspline_shells::Shell_certificate_3<typename Shell::Field, typename Shell::Threshold> certificate(shell);
  for(double amount = 0.7; amount > 0.01; amount /= 2) {
    const Mesh moved = moved_along_flow(shell, mesh, amount);
    if(certificate.verify(moved)) return moved;
  }
  FAIL("no other mesh is certified");
  return mesh;
}

#endif // MESHES_IN_SHELL_H
