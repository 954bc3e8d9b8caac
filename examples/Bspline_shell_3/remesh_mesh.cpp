// Remeshes a mesh in its shell to edges of similar length, keeps sharp edges, and transfers a vertex attribute to the
// result. It is proved that the result does not intersect itself, and that the map between the meshes is one-to-one.
#include "example_files.h"

#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef CGAL::Certified_bspline_shell_3 Shell;

int main(int argc, char** argv)
{
  std::string file;
  double edges = 50, thickness = 0.01;
  const auto code = Arguments(
                      "Usage: remesh_mesh MESH [EDGES [THICKNESS]]\n"
                      "  EDGES: target number of edges along the longest side of the bounding box (default 50)\n"
                      "  THICKNESS: thickness of the shell, as a fraction of that side (default 0.01)\n"
                      "  Writes remeshed.ply.\n")
                      .required(file)
                      .optional(edges)
                      .optional(thickness)
                      .read(argc, argv);
  if(code) return *code;
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(thickness));
  if(!shell.is_certified()) {
    std::cerr << shell.message() << std::endl;
    return EXIT_FAILURE;
  }
  const double unit = shell.report().unit; // the longest side of the bounding box

  // a vertex attribute of the initial mesh
  Mesh before = mesh;
  auto wave = before.add_property_map<Mesh::Vertex_index, double>("v:wave").first;
  for(Mesh::Vertex_index v : before.vertices()) wave[v] = std::sin(20 * before.point(v).x() / unit);

  auto sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
  CGAL::Polygon_mesh_processing::detect_sharp_edges(mesh, 60, sharp);
  const auto report = BS::remesh_in_shell(mesh, unit / edges, shell, BS::parameters::edge_is_constrained_map(sharp));
  std::cout << report.message() << "\n";
  if(!report) return EXIT_FAILURE;
  std::cout << "facets: " << report.facets_before << " before, " << report.facets
            << " after\noperations: " << report.splits << " splits, " << report.collapses << " collapses, "
            << report.flips << " flips, " << report.moves << " moves; " << report.placements.rejected()
            << " rejected\nseconds: " << report.edit_seconds << " for the operations, " << report.certificate_seconds
            << " for the certificate\n";

  // Transfer the attribute to the result along the integral curves.
  mesh.collect_garbage();
  auto wave_now = mesh.add_property_map<Mesh::Vertex_index, double>("v:wave").first;
  const BS::Shell_map_3<Shell, Mesh> map(shell, before, mesh);
  const BS::Transfer_report transfer = BS::transfer_vertex_attribute(map, wave, wave_now);
  if(!transfer)
    std::cerr << transfer.failures.size() << " vertices have no value: " << message(transfer.failures[0].second)
              << "\n";
  return save("remeshed.ply", mesh) && transfer ? EXIT_SUCCESS : EXIT_FAILURE;
}
