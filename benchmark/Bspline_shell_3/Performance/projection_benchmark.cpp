// How fast points move from a mesh to another one in its shell: microseconds a point, with one core and with all, and for several
// tolerances. One JSON object a line.
//
//   projection_benchmark [--points N] [MESH ...]
//
// Default: a million points of armadillo. The second mesh is the first with its vertices moved along the flow.
#include "../meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/Shell_map_3.h>

#include <CGAL/Real_timer.h>

#include <cstdlib>
#include <iostream>

template <typename ConcurrencyTag, typename Map, typename Locations>
double microseconds(const Map& map, const Locations& locations, std::size_t& lost)
{
  CGAL::Real_timer timer;
  timer.start();
  const auto images = map.template project<ConcurrencyTag>(locations);
  const double seconds = timer.time();
  lost = std::size_t(std::count_if(images.begin(), images.end(), [](const auto& image) { return !image; }));
  return 1e6 * seconds / double(locations.size());
}

int main(int argc, char** argv)
{
  std::size_t points = 1000000;
  std::vector<std::string> files;
  for(int i = 1; i < argc; ++i) {
    if(std::string(argv[i]) == "--points" && i + 1 < argc) points = std::size_t(std::atoll(argv[++i]));
    else files.push_back(argv[i]);
  }
  if(files.empty()) files.push_back(MESHES "/armadillo.off");
  for(const std::string& file : files) {
    Mesh mesh;
    double part = 0;
    std::optional<Mesh> moved;
    std::optional<Shell> shell;
    if(read_triangles(file, mesh)) shell = CGAL::certified_bspline_shell_3(mesh);
    if(shell && shell->is_certified()) moved = moved_along_flow(*shell, mesh, part);
    if(!moved) {
      std::cout << "{\"mesh\":\"" << mesh_name(file) << "\",\"status\":\"no certified pair of meshes\"}" << std::endl;
      continue;
    }
    const double unit = shell->report().unit;
    const auto locations = random_locations(mesh, points, 1);
    for(double tolerance : { 1e-6, 1e-9, 1e-12 }) {
      CGAL::Real_timer timer;
      timer.start();
      const BS::Shell_map_3<Shell, Mesh> map(*shell, mesh, *moved, BS::parameters::tolerance(tolerance * unit));
      const double preparation = timer.time();
      std::size_t lost, lost_too;
      const double one = microseconds<CGAL::Sequential_tag>(map, locations, lost);
      const double all = microseconds<CGAL::Parallel_if_available_tag>(map, locations, lost_too);
      std::cout << "{\"mesh\":\"" << mesh_name(file) << "\",\"facets\":" << mesh.number_of_faces() << ",\"points\":" << points
                << ",\"moved_by\":" << part << ",\"tolerance\":" << tolerance << ",\"lost\":" << lost
                << ",\"microseconds\":{\"one_core\":" << one << ",\"all_cores\":" << all << "},\"speedup\":" << one / all
                << ",\"preparation_seconds\":" << preparation << "}" << std::endl;
    }
  }
  return EXIT_SUCCESS;
}
