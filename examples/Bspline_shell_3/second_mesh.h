// Shared by the examples of maps: a mesh, its certified shell, and a second mesh in the shell.
#ifndef SECOND_MESH_H
#define SECOND_MESH_H

#include "example_files.h"

#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Transfer/Transfer_report.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef CGAL::Certified_bspline_shell_3 Shell;

// Moves vertices along the integral curves toward one of the thresholds. While the moved mesh is not certified, the
// displacements are halved.
inline bool move_in_shell(const Shell& shell, const Mesh& mesh, Mesh& moved)
{
  const BS::Gradient_flow_3<Shell> flow(shell);
  BS::Shell_certificate_3<Shell::Field, Shell::Threshold> certificate(shell);
  for(double amount = 0.8; amount > 0.01; amount /= 2) {
    moved = mesh;
    for(Mesh::Vertex_index v : moved.vertices()) {
      const Kernel::Point_3 p = mesh.point(v);
      const double wave = amount * std::sin(10 * (p.x() + 2 * p.y() + 3 * p.z()) / shell.report().unit);
      const double value = *shell.field().value(p);
      const double end = wave > 0 ? shell.outer_threshold().value(p) : shell.inner_threshold().value(p);
      const auto arrival = flow.trace(p, value + std::abs(wave) * (end - value));
      if(!arrival) {
        std::cerr << message(arrival.status) << std::endl;
        return false;
      }
      moved.point(v) = arrival.point;
    }
    if(certificate.verify(moved)) return true;
  }
  std::cerr << "No other mesh in the shell was certified: choose another MESH." << std::endl;
  return false;
}

// Reads a mesh, and builds its shell and another mesh in it. Returns the exit code if the program has to end.
inline std::optional<int> begin_example(int argc, char** argv, Mesh& mesh, Shell& shell, Mesh& moved)
{
  std::string file;
  const auto code = Arguments("Usage: " + std::string(argv[0]) + " MESH\n").required(file).read(argc, argv);
  if(code) return code;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(0.02));
  if(!shell.is_certified()) {
    std::cerr << shell.message() << std::endl;
    return EXIT_FAILURE;
  }
  return move_in_shell(shell, mesh, moved) ? std::nullopt : std::optional<int>(EXIT_FAILURE);
}

// Returns whether all values were transferred, and prints a message otherwise.
inline bool is_complete(const BS::Transfer_report& report)
{
  if(!report)
    std::cerr << report.failures.size() << " values are missing, the first one at position " << report.failures[0].first
              << ": " << message(report.failures[0].second) << std::endl;
  return bool(report);
}

#endif // SECOND_MESH_H
