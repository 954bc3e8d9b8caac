// The remeshed mesh of a model.
#ifndef TOOL_COMMANDS_REMESHED_H
#define TOOL_COMMANDS_REMESHED_H

#include "Edited.h"
#include "Progress.h"
#include "Time_limit.h"

#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Editing/Edit_termination.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>

#include <cstddef>
#include <limits>
#include <memory>

namespace Tool {

struct Remesh_target
{
  double thickness = 0;            // of the shell
  double edge = 0;                 // length of edges
  double feature = 0;              // in degrees; edges with a larger angle between the normals of their facets are kept
  bool rounds_coordinates = false; // to floats, if the result remains certified
  double tolerance = std::numeric_limits<double>::infinity(); // distance of the surfaces
};

struct Remeshed : Edited
{
  BS::Edit_termination end = BS::Edit_termination::NOT_EDITED;
  std::size_t features = 0;     // edges on features
  bool protects_lines = false;  // whether lines and features are neither split nor collapsed
  double mean_edge = 0;         // mean length of the edges
  double share_near_target = 0; // share of edges from 4/5 to 4/3 of the length
};

// Remeshes the mesh of a certified shell. If the time is short, the result is that of fewer operations.
Remeshed remesh_in_shell(const Model& model, const std::shared_ptr<const BS::Shell_of_soup_3>& shell,
                         const Remesh_target& target, const Time_limit& time, Progress& progress);

} // namespace Tool

#endif // TOOL_COMMANDS_REMESHED_H
