// Maps points from one mesh in a shell to another one, and back. The map between the meshes is one-to-one, so the
// points return to their positions up to numerical errors.
#include "second_mesh.h"

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Projection/project_points.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

typedef BS::Shell_map_3<Shell, Mesh> Map;

int main(int argc, char** argv)
{
  Mesh mesh, moved;
  Shell shell;
  if(const auto code = begin_example(argc, argv, mesh, shell, moved)) return *code;

  // Map points that are given by coordinates.
  std::vector<Kernel::Point_3> points;
  for(Mesh::Edge_index e : mesh.edges())
    points.push_back(CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  const auto images = BS::project_points(shell, points, moved);
  const auto first = images.front();
  if(!first) {
    std::cerr << message(first.status) << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "The point " << points.front() << "\nis mapped to " << first.point << "\non facet "
            << first.location.first << " with barycentric coordinates " << first.location.second[0] << " "
            << first.location.second[1] << " " << first.location.second[2] << ".\n";

  // Map locations on the meshes. The map can be used repeatedly.
  const Map map(shell, mesh, moved);
  std::vector<Map::Target_location> locations;
  for(const auto& image : images) {
    if(!image) {
      std::cerr << message(image.status) << std::endl;
      return EXIT_FAILURE;
    }
    locations.push_back(image.location);
  }
  const auto back = map.inverse().project(locations);
  double farthest_away = 0, farthest_back = 0;
  for(std::size_t n = 0; n < points.size(); ++n) {
    if(!back[n]) {
      std::cerr << message(back[n].status) << std::endl;
      return EXIT_FAILURE;
    }
    farthest_away = (std::max)(farthest_away, CGAL::squared_distance(points[n], images[n].point));
    farthest_back = (std::max)(farthest_back, CGAL::squared_distance(points[n], back[n].point));
  }
  std::cout << points.size() << " points were moved by at most " << std::sqrt(farthest_away)
            << ".\nAfter the round trip, their error is at most " << std::sqrt(farthest_back) << "." << std::endl;
  return farthest_back <= CGAL::square(1e-8 * shell.report().unit) ? EXIT_SUCCESS : EXIT_FAILURE;
}
