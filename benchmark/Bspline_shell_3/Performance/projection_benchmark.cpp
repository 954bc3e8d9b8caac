// Measures the projection of random points from a mesh to another one in its shell: microseconds per point, on one core
// and on all, for several tolerances. Points are also mapped one by one, so that no search begins near the last image.
// Prints one JSON object per line.
//
//   projection_benchmark [--points N] [MESH ...]
//
// Default: a million points of armadillo. The second mesh is the first one with its vertices moved along the flow.
#include "../meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>

#include <CGAL/Real_timer.h>

#include <algorithm>
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

template <typename Map, typename Locations>
double microseconds_one_by_one(const Map& map, const Locations& locations, std::size_t& lost)
{
  CGAL::Real_timer timer;
  timer.start();
  lost = 0;
  for(const auto& location : locations)
    if(!map(location)) ++lost;
  return 1e6 * timer.time() / double(locations.size());
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  const Benchmark_arguments arguments(argc, argv, 1000000, MESHES "/armadillo.off");
  for_each_pair(arguments.files, [&](const std::string& name, const Shell& shell, const Mesh& mesh, const Mesh& moved,
                                     double part) {
    const double unit = shell.report().unit;
    const auto locations = random_locations(mesh, arguments.points, 1);
    for(double tolerance : { 1e-6, 1e-9, 1e-12 }) {
      CGAL::Real_timer timer;
      timer.start();
      const BS::Shell_map_3<Shell, Mesh> map(shell, mesh, moved, BS::parameters::tolerance(tolerance * unit));
      const double preparation = timer.time();
      std::size_t lost, lost_by_all, lost_one_by_one;
      const double one = microseconds<CGAL::Sequential_tag>(map, locations, lost);
      const double all = microseconds<CGAL::Parallel_if_available_tag>(map, locations, lost_by_all);
      const double one_by_one = microseconds_one_by_one(map, locations, lost_one_by_one);
      std::cout << "{\"mesh\":" << quoted(name) << ",\"facets\":" << mesh.number_of_faces()
                << ",\"points\":" << arguments.points << ",\"moved_by\":" << part << ",\"tolerance\":" << tolerance
                << ",\"lost\":" << (std::max)({ lost, lost_by_all, lost_one_by_one })
                << ",\"microseconds\":{\"one_core\":" << one << ",\"all_cores\":" << all
                << ",\"one_by_one\":" << one_by_one << "},\"speedup\":" << one / all
                << ",\"preparation_seconds\":" << preparation << "}" << std::endl;
    }
  });
  return EXIT_SUCCESS;
}
