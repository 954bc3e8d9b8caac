// Simplifies an open mesh. Its shell is built around the mesh and triangles that close it, which are not part of the
// result. The border stays the same, bit for bit, and the map between the meshes is one-to-one. With --border, the
// border is simplified within a distance, and the map is one-to-one except for strips along the border.
#include "example_files.h"

#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/squared_distance_3.h>

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
  double tolerance = 0;
  Arguments arguments("Usage: open_mesh MESH [--border DISTANCE]\n"
                      "DISTANCE is in percent of the box size.\n");
  if(const auto code = arguments.required(file).option("--border", tolerance).read(argc, argv)) return *code;
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  std::cout << shell.message() << "\n";
  if(!shell.is_certified()) return EXIT_FAILURE;
  const BS::Closing_report& closing = shell.report().closing;
  std::cout << "holes: " << closing.holes.size() << "; closed with " << closing.caps() << " caps and " << closing.sheets
            << " back sheets of " << closing.triangles << " triangles\n";

  Mesh coarse = mesh;
  const auto result = BS::simplify_in_shell(coarse, shell,
                                            BS::parameters::border_tolerance(tolerance / 100 * shell.report().unit));
  if(!result) {
    std::cerr << result.message() << std::endl;
    return EXIT_FAILURE;
  }
  coarse.collect_garbage();
  std::cout << "facets: " << result.facets_before << " before, " << result.facets << " after; "
            << result.removed_border_edges << " border edges were removed, in " << result.total_seconds() << " s\n";

  const BS::Shell_map_3 map(shell, mesh, coarse, BS::parameters::closing(shell.closing()),
                            BS::parameters::closing(result.closing));
  const auto back = map.inverse();
  std::size_t lost = 0, moved = 0, beyond = 0;
  double error = 0;
  for(auto v : mesh.vertices()) {
    if(mesh.is_isolated(v)) continue;
    const auto image = map(v);
    if(!image) {
      ++lost;
      continue;
    }
    if(mesh.is_border(v) && image.point != mesh.point(v)) ++moved;
    if(image.is_continued) {
      ++beyond;
      continue;
    }
    const auto again = back(image.location);
    if(!again) ++lost;
    else error = (std::max)(error, CGAL::squared_distance(again.point, mesh.point(v)));
  }
  std::cout << "vertices without an image: " << lost << "; beyond the border: " << beyond
            << "; border vertices that moved: " << moved << "; largest error of a round trip: " << std::sqrt(error)
            << "\n";

  // the closed mesh that was certified, for inspection
  Mesh closed = mesh;
  if(shell.closing() && !shell.closing()->attach(closed, closed.points())) return EXIT_FAILURE;
  const bool are_saved = save("simplified.off", coarse) && save("closed.off", closed);
  return lost == 0 && (moved == 0 || tolerance > 0) && are_saved ? EXIT_SUCCESS : EXIT_FAILURE;
}
