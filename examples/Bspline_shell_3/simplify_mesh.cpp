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
  const auto code = Arguments("Usage: simplify_mesh MESH [FACETS [THICKNESS]]\n"
                              "  FACETS: target number of facets (default: as few as the shell allows)\n"
                              "  THICKNESS: thickness of the shell, as a fraction of the longest side of the bounding\n"
                              "    box (default 0.01)\n"
                              "  Writes simplified.off.\n")
                      .required(file)
                      .optional(facets)
                      .optional(thickness)
                      .read(argc, argv);
  if(code) return *code;
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  const auto shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(thickness));
  if(!shell.is_certified()) {
    std::cerr << shell.message() << std::endl;
    return EXIT_FAILURE;
  }

  const auto result = BS::simplify_in_shell(mesh, shell, BS::parameters::stop(BS::Facet_count_stop_predicate(facets)));
  std::cout << result.message() << "\n";
  if(!result) return EXIT_FAILURE;
  std::cout << "facets: " << result.facets_before << " before, " << result.facets << " after\nrejected placements:";
  for(auto verdict :
      { BS::Placement_verdict::LEAVES_SHELL, BS::Placement_verdict::FACES_AWAY, BS::Placement_verdict::WINDS_TWICE })
    std::cout << " " << result.placements.number(verdict) << " (" << name(verdict) << ")";
  const Mesh::Vertex_index v = result.images[0];
  std::cout << "\nThe first vertex is now at " << mesh.point(v) << ".\nNo point is farther than "
            << result.certificate.displacement_bound << " from its image.\nseconds: " << result.edit_seconds
            << " for the collapses, " << result.certificate_seconds << " for the certificate\n";
  mesh.collect_garbage();
  return save("simplified.off", mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
}
