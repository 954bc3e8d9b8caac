// Transfers a scalar field and colors at the vertices of a mesh to another mesh in the same shell, and writes that mesh
// with its colors.
#include "second_mesh.h"

#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>

#include <CGAL/IO/Color.h>

#include <algorithm>
#include <cstdlib>

int main(int argc, char** argv)
{
  Mesh mesh, moved;
  Shell shell;
  if(const auto code = begin_example(argc, argv, mesh, shell, moved)) return *code;

  auto height = mesh.add_property_map<Mesh::Vertex_index, double>("v:height").first;
  auto color = mesh.add_property_map<Mesh::Vertex_index, CGAL::IO::Color>("v:color").first;
  for(Mesh::Vertex_index v : mesh.vertices()) {
    height[v] = mesh.point(v).z();
    color[v] = std::sin(30 * height[v] / shell.report().unit) > 0 ? CGAL::IO::red() : CGAL::IO::white();
  }

  // The map can be used for any number of transfers, in both directions.
  const BS::Shell_map_3<Shell, Mesh> map(shell, mesh, moved);
  auto height_on_moved = moved.add_property_map<Mesh::Vertex_index, double>("v:height").first;
  auto color_on_moved = moved.add_property_map<Mesh::Vertex_index, CGAL::IO::Color>("v:color").first;
  if(!is_complete(BS::transfer_vertex_attribute(map, height, height_on_moved))
     || !is_complete(BS::transfer_vertex_attribute(map, color, color_on_moved)))
    return EXIT_FAILURE;

  // The heights of a point and its image differ by at most their distance, which the certificate bounds.
  double largest = 0;
  for(Mesh::Vertex_index v : moved.vertices())
    largest = (std::max)(largest, std::abs(height_on_moved[v] - moved.point(v).z()));
  const double bound = shell.report().certificate.displacement_bound;
  std::cout << "The largest error of a height is " << largest << "; the bound on the displacement is " << bound << "."
            << std::endl;
  return save("transfer_scalar_field.ply", moved) && largest <= bound ? EXIT_SUCCESS : EXIT_FAILURE;
}
