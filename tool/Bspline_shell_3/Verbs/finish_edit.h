// Work that follows an edit of the mesh of a shell.
#ifndef TOOL_VERBS_FINISH_EDIT_H
#define TOOL_VERBS_FINISH_EDIT_H

#include "distance_bound.h"

#include "../Carry/Mesh_origins.h"

#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>

namespace Tool {

// Rounds coordinates to floats if the mesh remains certified, and returns whether it does.
bool round_coordinates(Mesh& mesh, const Shell& shell);

// Returns bounds of the distances between the polygons of a shell and an edited mesh, up to a resolution.
Distance_bounds distances_of_edit(const BS::Shell_of_soup_3& found, const Mesh& mesh, double resolution);

} // namespace Tool

#endif // TOOL_VERBS_FINISH_EDIT_H
