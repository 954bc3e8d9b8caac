// Transfers tangent vectors at the facets of a mesh to another mesh in the same shell, by the differential of the map,
// and back.
#include "second_mesh.h"

#include <CGAL/Bspline_shell_3/Transfer/transfer_tangent_vectors.h>

#include <CGAL/Polygon_mesh_processing/compute_normal.h>

#include <algorithm>
#include <cstdlib>

typedef Mesh::Property_map<Mesh::Face_index, Kernel::Vector_3> Vectors;

int main(int argc, char** argv)
{
  Mesh mesh, moved;
  Shell shell;
  if(const auto code = begin_example(argc, argv, mesh, shell, moved)) return *code;

  // a wind along the x-axis, projected to the surface
  Vectors wind = mesh.add_property_map<Mesh::Face_index, Kernel::Vector_3>("f:wind").first,
          back = mesh.add_property_map<Mesh::Face_index, Kernel::Vector_3>("f:back").first,
          wind_on_moved = moved.add_property_map<Mesh::Face_index, Kernel::Vector_3>("f:wind").first;
  for(Mesh::Face_index f : mesh.faces()) {
    const Kernel::Vector_3 n = CGAL::Polygon_mesh_processing::compute_face_normal(f, mesh), x(1, 0, 0);
    wind[f] = x - (x * n) * n;
  }

  const BS::Shell_map_3<Shell, Mesh> map(shell, mesh, moved);
  if(!is_complete(BS::transfer_tangent_vectors(map, wind, wind_on_moved))
     || !is_complete(BS::transfer_tangent_vectors(map.inverse(), wind_on_moved, back)))
    return EXIT_FAILURE;

  double off_plane = 0, change = 0;
  for(Mesh::Face_index f : moved.faces())
    off_plane = (std::max)(off_plane,
                           std::abs(wind_on_moved[f] * CGAL::Polygon_mesh_processing::compute_face_normal(f, moved)));
  // The round trip is not the identity: each facet has one vector, and centroids are not mapped to centroids.
  for(Mesh::Face_index f : mesh.faces()) change = (std::max)(change, std::sqrt((back[f] - wind[f]).squared_length()));
  std::cout << "The images leave the planes of their facets by at most " << off_plane
            << ".\nAfter the round trip, vectors of length 1 or less have changed by at most " << change << "."
            << std::endl;
  return off_plane < 1e-8 ? EXIT_SUCCESS : EXIT_FAILURE;
}
