// Collapses edges with CGAL's edge_collapse(), by Lindstrom-Turk costs and placements. A filter keeps the mesh in its
// shell, and the certificate verifies the result. Any kernel with double coordinates can be used.
#include "example_files.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/Shell_filter.h>
#include <CGAL/Bspline_shell_3/Editing/Shell_placement.h>
#include <CGAL/Bspline_shell_3/Editing/stop_predicates.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
namespace SMS = CGAL::Surface_mesh_simplification;

int main(int argc, char** argv)
{
  std::string file;
  std::size_t facets = 1000;
  const auto code = Arguments("Usage: collapse_edges MESH [FACETS]\n"
                              "  FACETS: target number of facets (default 1000)\n"
                              "  Writes collapsed.off.\n")
                      .required(file)
                      .optional(facets)
                      .read(argc, argv);
  if(code) return *code;
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  const auto shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::truncate(false));
  if(!shell) {
    std::cerr << shell.message() << std::endl;
    return EXIT_FAILURE;
  }

  const SMS::LindstromTurk_placement<Mesh> placement;
  const BS::Shell_filter filter(shell, SMS::Bounded_normal_change_filter<>()); // CGAL's filter is called first
  SMS::edge_collapse(mesh, BS::Facet_count_stop_predicate(facets),
                     CGAL::parameters::get_cost(SMS::LindstromTurk_cost<Mesh>())
                       .get_placement(BS::Shell_placement(shell, placement))
                       .filter(filter));
  mesh.collect_garbage();

  BS::Shell_certificate_3 certificate(shell);
  const bool is_certified = certificate.verify(mesh);
  std::cout << mesh.number_of_faces() << " facets remain, and " << filter.statistics().rejected()
            << " placements were rejected. The mesh is " << (is_certified ? "" : "not ") << "certified." << std::endl;
  return is_certified && save("collapsed.off", mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
}
