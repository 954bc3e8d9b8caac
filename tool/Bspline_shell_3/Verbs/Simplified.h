// The simplified mesh of a model.
#ifndef TOOL_VERBS_SIMPLIFIED_H
#define TOOL_VERBS_SIMPLIFIED_H

#include "Progress.h"
#include "cut_lines.h"
#include "distance_bound.h"

#include "../Carry/Mesh_origins.h"
#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Editing/Edit_termination.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>

#include <cstddef>
#include <optional>
#include <string>

namespace Tool {

enum class Simplify_status
{
  SUCCESS,
  NO_SHELL,
  NOT_CERTIFIED,
  NOT_SIMPLIFIED
};

// A mesh that replaces the mesh of a shell, and is certified in it. Objects are not copied, because maps refer to them.
struct Simplified
{
  Simplified() = default;
  Simplified(const Simplified&) = delete;
  Simplified& operator=(const Simplified&) = delete;

  Simplify_status status = Simplify_status::NO_SHELL;
  std::string message; // the reason if the status is not `SUCCESS`
  BS::Shell_of_soup_3 found;
  Mesh mesh;
  BS::Rejoined_soup_3 rejoined; // the mesh and the excised triangles, if there are any
  BS::Edit_termination end = BS::Edit_termination::NOT_EDITED;
  std::size_t facets_before = 0, facets = 0; // numbers for the whole surface
  std::size_t lines = 0;                     // edges on lines that were kept together, or at which facets were cut
  std::optional<Cut_lines> cut;              // if the mesh was to be cut along lines
  bool gave_up_lines = false;                // whether lines were given up to reach the number of facets
  bool is_rounded = false;                   // whether coordinates are those of a file of floats
  Distance_bounds distances;                 // between the model and the result
};

struct Simplify_target
{
  double thickness;
  std::size_t facets; // 0 for as few as possible
  bool rounds_coordinates;
  bool cuts_lines; // instead of keeping the edges on lines together
  double seconds;
};

void simplify_model(const Model& model, const Simplify_target& target, Progress& progress, Simplified& result);

} // namespace Tool

#endif // TOOL_VERBS_SIMPLIFIED_H
