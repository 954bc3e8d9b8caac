// Meshes as input, even if they have singular vertices or, unless this is excluded, intersect themselves.
#ifndef INPUT_OF_MESH_H
#define INPUT_OF_MESH_H

#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>

inline CGAL::Bspline_shells::Input_mesh_3 input_of(const Mesh& mesh, bool may_intersect_itself = true)
{
  CGAL::Bspline_shells::Input_mesh_3::Tolerated_defects tolerated;
  tolerated.singular_vertices = true;
  tolerated.self_intersections = may_intersect_itself;
  CGAL::Bspline_shells::Input_mesh_3 input;
  REQUIRE(input.build<CGAL::Sequential_tag>(mesh, mesh.points(), tolerated)
          == CGAL::Bspline_shells::Shell_status::SUCCESS);
  return input;
}

#endif // INPUT_OF_MESH_H
