// Projects points one at a time, in several threads, to a mesh in a shell.
#include "second_mesh.h"

#include <CGAL/Bspline_shell_3/Projection/Shell_projection_3.h>

#include <atomic>
#include <cstdlib>
#include <iostream>
#include <thread>

typedef BS::Shell_projection_3<Shell, Mesh> Projection;

int main(int argc, char** argv)
{
  Mesh mesh, moved;
  Shell shell;
  if(const auto code = begin_example(argc, argv, mesh, shell, moved)) return *code;

  const Projection projection(shell, moved); // builds a search tree once; may be shared by threads
  std::atomic<std::size_t> projected(0);
  const auto project_vertices = [&](unsigned int begin, unsigned int end) {
    Projection::Hint hint; // one per thread: the search begins at the previous image
    for(unsigned int n = begin; n < end; ++n) {
      const Projection::Image image = projection(mesh.point(Mesh::Vertex_index(n)), hint);
      if(image) ++projected; // image.point, image.location
    }
  };
  const unsigned int all = unsigned(mesh.number_of_vertices()), half = all / 2;
  std::thread other(project_vertices, 0, half);
  project_vertices(half, all);
  other.join();

  std::cout << projected << " of " << all << " vertices were projected to the other mesh." << std::endl;
  return projected == all ? EXIT_SUCCESS : EXIT_FAILURE;
}
