// Measures the effect of tuning parameters: builds a certified shell, simplifies and remeshes the mesh in it, and maps
// its vertices to the remeshed mesh and back. Prints one JSON object per line, with processor times.
//
//   tuning_figures MESH...
#include "../meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>

#include <CGAL/squared_distance_3.h>

#include <sys/resource.h>

#include <cmath>
#include <iostream>

double processor_seconds()
{
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Returns the processor time since the last call.
double lap()
{
  static double before = 0;
  const double now = processor_seconds(), seconds = now - before;
  before = now;
  return seconds;
}

void measure(const std::string& file)
{
  Mesh mesh;
  if(!read_triangles(file, mesh)) return;
  lap();
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"certified\":" << shell.is_certified()
            << ",\"cells\":" << shell.report().cells << ",\"shell_seconds\":" << lap();
  if(shell.is_certified()) {
    Mesh coarse = mesh, regular = mesh;
    const auto simplified = BS::simplify_in_shell(coarse, shell);
    std::cout << ",\"simplified\":" << simplified.facets << ",\"simplify_seconds\":" << lap();
    const auto remeshed = BS::remesh_in_shell(regular, shell.report().unit / 40, shell);
    std::cout << ",\"remeshed\":" << remeshed.facets << ",\"remesh_seconds\":" << lap();
    regular.collect_garbage();
    const BS::Shell_map_3<Shell, Mesh> map(shell, mesh, regular);
    const auto back = map.inverse();
    std::size_t lost = 0;
    double farthest = 0;
    for(auto v : mesh.vertices()) {
      const auto image = map(v);
      const auto again = image ? back(image.location) : decltype(back(image.location))();
      if(!again) ++lost;
      else farthest = (std::max)(farthest, CGAL::squared_distance(again.point, mesh.point(v)));
    }
    std::cout << ",\"lost\":" << lost << ",\"farthest\":" << std::sqrt(farthest) / shell.report().unit
              << ",\"map_seconds\":" << lap();
  }
  std::cout << "}" << std::endl;
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  for(int n = 1; n < argc; ++n) measure(argv[n]);
}
