// Work that follows an edit of the mesh of a shell.
#ifndef TOOL_COMMANDS_FINISH_EDIT_H
#define TOOL_COMMANDS_FINISH_EDIT_H

#include "distance_bound.h"

#include "../Carry/Mesh_origins.h"

#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>

#include <memory>

namespace Tool {

// Rounds coordinates to floats if the mesh remains certified, and returns whether it does.
// \param closing triangles that close the mesh if it is open
bool round_coordinates(Mesh& mesh, const Shell& shell, const std::shared_ptr<const BS::Shell_closing_3>& closing);

// Returns bounds on the distances between the polygons of a shell and an edited mesh, as `distance_bounds()`.
Distance_bounds distances_of_edit(const BS::Shell_of_soup_3& found, const Mesh& mesh, double limit);

} // namespace Tool

#endif // TOOL_COMMANDS_FINISH_EDIT_H
