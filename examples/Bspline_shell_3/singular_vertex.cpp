// Simplifies a mesh with a vertex whose facets face no common direction, and maps it to the result and back. The shell is that of a truncated mesh, but
// the map is one-to-one from the mesh as it is.
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef CGAL::Certified_bspline_shell_3 Shell;

bool write(const char* name, const Mesh& mesh)
{
  std::ofstream out(name);
  out.precision(17);
  return bool(out << mesh);
}

int main(int argc, char** argv)
{
  Mesh mesh;
  if(argc < 2 || BS::read_triangle_mesh(argv[1], mesh) != BS::Shell_status::SUCCESS) {
    std::cerr << "Usage: singular_vertex MESH\n";
    return EXIT_FAILURE;
  }
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(0.03));
  std::cout << shell.message() << "\n";
  if(!shell.is_certified()) return EXIT_FAILURE;
  for(const auto& v : shell.report().truncation.vertices)
    std::cout << "vertex " << v.vertex << ": " << name(v.outcome) << ", cone margin " << v.margin_before << " -> " << v.margin_after << ", radius "
              << v.radius << "\n";

  Mesh coarse = mesh;
  const auto result = BS::simplify_in_shell(coarse, shell);
  if(!result) {
    std::cerr << BS::message(result.status) << std::endl;
    return EXIT_FAILURE;
  }
  coarse.collect_garbage();
  std::cout << result.facets_before << " facets before, " << result.facets << " now\n";

  const BS::Shell_map_3 map(shell, mesh, coarse);
  const auto inverse = map.inverse();
  double farthest = 0;
  for(auto v : mesh.vertices()) {
    const auto image = map(v);
    const auto back = inverse(image.location);
    if(!image || !back) return EXIT_FAILURE;
    farthest = (std::max)(farthest, std::sqrt(CGAL::squared_distance(mesh.point(v), back.point)));
  }
  std::cout << "vertices return to within " << farthest << "\n";

  // the mesh as it was certified, to look at
  Mesh truncated = mesh;
  if(shell.truncation()) shell.truncation()->apply(truncated, truncated.points());
  truncated.collect_garbage();
  return write("truncated_mesh.off", truncated) && write("simplified_truncated_mesh.off", coarse) ? EXIT_SUCCESS : EXIT_FAILURE;
}
