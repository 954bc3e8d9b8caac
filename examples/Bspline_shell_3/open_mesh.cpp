// Simplifies an open mesh. Its shell is built around the mesh and triangles that close it, which are not part of the
// result. The border stays the same, bit for bit, and the map between the meshes is one-to-one.
#include "example_files.h"

#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef CGAL::Certified_bspline_shell_3 Shell;

int main(int argc, char** argv)
{
  std::string file;
  if(const auto code = Arguments("Usage: open_mesh MESH\n").required(file).read(argc, argv)) return *code;
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  std::cout << shell.message() << "\n";
  if(!shell.is_certified()) return EXIT_FAILURE;
  const BS::Closing_report& closing = shell.report().closing;
  std::cout << "holes: " << closing.holes.size() << "; closed with " << closing.caps() << " caps and " << closing.sheets
            << " back sheets of " << closing.triangles << " triangles\n";

  Mesh coarse = mesh;
  const auto result = BS::simplify_in_shell(coarse, shell);
  if(!result) {
    std::cerr << result.message() << std::endl;
    return EXIT_FAILURE;
  }
  coarse.collect_garbage();
  std::cout << "facets: " << result.facets_before << " before, " << result.facets << " after\n";

  const BS::Shell_map_3 map(shell, mesh, coarse);
  std::size_t lost = 0, moved = 0;
  for(auto v : mesh.vertices()) {
    const auto image = map(v);
    if(!image) ++lost;
    else if(mesh.is_border(v) && image.point != mesh.point(v)) ++moved;
  }
  std::cout << "vertices without an image: " << lost << "; border vertices that moved: " << moved << "\n";

  // the closed mesh that was certified, for inspection
  Mesh closed = mesh;
  if(shell.closing() && !shell.closing()->attach(closed, closed.points())) return EXIT_FAILURE;
  const bool are_saved = save("simplified.off", coarse) && save("closed.off", closed);
  return lost == 0 && moved == 0 && are_saved ? EXIT_SUCCESS : EXIT_FAILURE;
}
