// A cross field, four directions at each facet, is moved to another mesh in the same shell. It is written as a mesh of small
// crosses, one quadrangle for each facet, that can be looked at together with the mesh.
#include "second_mesh.h"

#include <CGAL/Bspline_shell_3/Transfer/transfer_tangent_vectors.h>

#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <algorithm>
#include <cstdlib>

namespace PMP = CGAL::Polygon_mesh_processing;
typedef Mesh::Property_map<Mesh::Face_index, Kernel::Vector_3> Vectors;

Kernel::Point_3 centroid(const Mesh& mesh, Mesh::Face_index f)
{
  const Mesh::Halfedge_index h = mesh.halfedge(f);
  return CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))));
}

int main(int argc, char** argv)
{
  Mesh mesh, moved;
  Shell shell;
  if(!begin_example(argc, argv, mesh, shell, moved)) return EXIT_FAILURE;

  // one of the four directions stands for all of them: here, along the first edge of each facet
  Vectors cross = mesh.add_property_map<Mesh::Face_index, Kernel::Vector_3>("f:cross").first,
          cross_on_moved = moved.add_property_map<Mesh::Face_index, Kernel::Vector_3>("f:cross").first;
  for(Mesh::Face_index f : mesh.faces()) {
    const Mesh::Halfedge_index h = mesh.halfedge(f);
    const Kernel::Vector_3 edge = mesh.point(mesh.target(h)) - mesh.point(mesh.source(h));
    cross[f] = edge / std::sqrt(edge.squared_length());
  }

  const BS::Shell_map_3<Shell, Mesh> map(shell, mesh, moved);
  if(!is_complete(BS::transfer_tangent_vectors(map, cross, cross_on_moved, BS::parameters::symmetry(4)))) return EXIT_FAILURE;

  Mesh crosses;
  double shortest = 1e9, longest = 0;
  for(Mesh::Face_index f : moved.faces()) {
    const Kernel::Vector_3 n = PMP::compute_face_normal(f, moved), u = cross_on_moved[f], v = CGAL::cross_product(n, u);
    const double length = std::sqrt(u.squared_length()), size = 0.3 * std::sqrt(PMP::face_area(f, moved)) / length;
    shortest = (std::min)(shortest, length);
    longest = (std::max)(longest, length);
    const Kernel::Point_3 c = centroid(moved, f);
    crosses.add_face(crosses.add_vertex(c + size * u), crosses.add_vertex(c + size * v), crosses.add_vertex(c - size * u),
                     crosses.add_vertex(c - size * v));
  }
  std::cout << moved.number_of_faces() << " crosses; the map stretches their directions, which had length 1, to between " << shortest
            << " and " << longest << std::endl;
  if(!CGAL::IO::write_polygon_mesh("transfer_cross_field.off", crosses)) {
    std::cerr << "transfer_cross_field.off cannot be written." << std::endl;
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
