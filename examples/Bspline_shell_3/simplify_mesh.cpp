// Simplifies a mesh as far as its shell allows, or to a given number of facets. It is proved that the result does not
// intersect itself, and that the map between the meshes is one-to-one. `result.images` contains, for each vertex of
// the initial mesh, the vertex into which it was collapsed.
#include "example_files.h"

#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

int main(int argc, char** argv)
{
  std::string file;
  std::size_t facets = 0;
  double thickness = 0.01;
  const auto code = Arguments("Usage: simplify_mesh MESH [FACETS, default: as few as the shell allows] "
                              "[THICKNESS, of the box, default 0.01]\n  Writes simplified.off.\n")
                      .required(file)
                      .optional(facets)
                      .optional(thickness)
                      .read(argc, argv);
  if(code) return *code;
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  const auto shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(thickness));
  if(!shell) {
    std::cerr << message(shell.status()) << std::endl;
    return EXIT_FAILURE;
  }

  const auto result = BS::simplify_in_shell(mesh, shell, BS::parameters::stop(BS::Facet_count_stop_predicate(facets)));
  std::cout << BS::message(result.status) << "\n";
  if(!result) return EXIT_FAILURE;
  std::cout << result.facets_before << " facets before, " << result.facets << " now; places rejected: ";
  for(auto verdict :
      { BS::Placement_verdict::LEAVES_SHELL, BS::Placement_verdict::FACES_AWAY, BS::Placement_verdict::WINDS_TWICE })
    std::cout << result.placements.number(verdict) << " (" << name(verdict) << ") ";
  const Mesh::Vertex_index v = result.images[0];
  std::cout << "\nthe first vertex is now at " << mesh.point(v) << "\nno point is farther than "
            << result.certificate.displacement_bound << " from its image\nseconds: " << result.edit_seconds
            << " (collapses) " << result.certificate_seconds << " (certificate)\n";
  mesh.collect_garbage();
  return save("simplified.off", mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
}
