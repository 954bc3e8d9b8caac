// The edited mesh of a model.
#ifndef TOOL_COMMANDS_EDITED_H
#define TOOL_COMMANDS_EDITED_H

#include "distance_bound.h"

#include "../Carry/Mesh_origins.h"

#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>

#include <cstddef>
#include <memory>
#include <string>

namespace Tool {

// A mesh that replaces the mesh of a shell, and is certified in it.
struct Edited
{
  std::string message;                              // the reason if there is no result
  std::shared_ptr<const BS::Shell_of_soup_3> found; // the shell
  double thickness = 0;                             // requested thickness of the shell
  Mesh mesh;
  BS::Rejoined_soup_3 rejoined;                       // the mesh and the excised triangles, if there are any
  std::shared_ptr<const BS::Shell_closing_3> closing; // triangles that close the mesh if it is open
  std::size_t facets_before = 0, facets = 0;          // numbers for the whole surface
  std::size_t lines = 0;                              // edges on seams and borders of labels
  bool is_rounded = false;                            // whether coordinates are those of a file of floats
  Distance_bounds distances;                          // between the model and the result

  explicit operator bool() const { return message.empty(); }
};

} // namespace Tool

#endif // TOOL_COMMANDS_EDITED_H
