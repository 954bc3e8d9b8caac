// Simplifies a mesh with a singular vertex, whose facets face no common direction, and maps its vertices to the result
// and back. The shell is built around a truncated mesh, but the map is one-to-one from the input mesh.
#include "example_files.h"

#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
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
  if(const auto code = Arguments("Usage: singular_vertex MESH\n").required(file).read(argc, argv)) return *code;
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(0.03));
  std::cout << shell.message() << "\n";
  if(!shell.is_certified()) return EXIT_FAILURE;
  for(const auto& v : shell.report().truncation.vertices)
    std::cout << "vertex " << v.vertex << ": " << name(v.outcome) << ", cone margin " << v.margin_before << " -> "
              << v.margin_after << ", radius " << v.radius << "\n";

  Mesh coarse = mesh;
  const auto result = BS::simplify_in_shell(coarse, shell);
  if(!result) {
    std::cerr << result.message() << std::endl;
    return EXIT_FAILURE;
  }
  coarse.collect_garbage();
  std::cout << "facets: " << result.facets_before << " before, " << result.facets << " after\n";

  const BS::Shell_map_3 map(shell, mesh, coarse);
  const auto inverse = map.inverse();
  double farthest = 0;
  for(auto v : mesh.vertices()) {
    const auto image = map(v);
    if(!image) return EXIT_FAILURE;
    const auto back = inverse(image.location);
    if(!back) return EXIT_FAILURE;
    farthest = (std::max)(farthest, std::sqrt(CGAL::squared_distance(mesh.point(v), back.point)));
  }
  std::cout << "After the round trip, the error of vertices is at most " << farthest << ".\n";

  // the truncated mesh that was certified, for inspection
  Mesh truncated = mesh;
  if(shell.truncation()) shell.truncation()->apply(truncated, truncated.points());
  truncated.collect_garbage();
  const bool are_saved = save("truncated_mesh.off", truncated) && save("simplified_truncated_mesh.off", coarse);
  return are_saved ? EXIT_SUCCESS : EXIT_FAILURE;
}
