// Builds the shell of a closed mesh on equal cells. Prints its two thresholds, and the value, gradient, and Hessian of
// f at a vertex.
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/bspline_shell_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

namespace BS = CGAL::Bspline_shells;

int main(int argc, char** argv)
{
  Mesh mesh;
  if(argc < 2) {
    std::cerr << "Usage: uniform_shell MESH\n";
    return EXIT_FAILURE;
  }
  const BS::Shell_status read = BS::read_polygon_mesh(argv[1], mesh);
  if(read != BS::Shell_status::SUCCESS) {
    std::cerr << argv[1] << ": " << message(read) << std::endl;
    return EXIT_FAILURE;
  }

  // 60 cells along the longest side of the bounding box
  const CGAL::Bspline_shell_3<> shell = CGAL::bspline_shell_3(mesh, BS::parameters::resolution(60));
  if(!shell) {
    std::cerr << shell.message() << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "thresholds " << shell.inner_level() << " and " << shell.outer_level() << ", thickness "
            << 100 * shell.relative_thickness() << " % of the bounding box\n";

  const Kernel::Point_3 p = mesh.point(*mesh.vertices().begin()); // f is defined on the mesh
  std::cout << "At the first vertex: f = " << *shell.field().value(p) << ", grad f = " << *shell.field().gradient(p)
            << ", Hessian =\n"
            << *shell.field().hessian(p) << "\n"
            << "The first vertex is " << (shell.bounded_side(p) == CGAL::ON_BOUNDED_SIDE ? "" : "not ")
            << "in the shell." << std::endl;
  return EXIT_SUCCESS;
}
