// The simplified mesh of a model.
#ifndef TOOL_COMMANDS_SIMPLIFIED_H
#define TOOL_COMMANDS_SIMPLIFIED_H

#include "Edited.h"
#include "Progress.h"
#include "Time_limit.h"
#include "cut_lines.h"

#include "../Carry/Mesh_origins.h"
#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <set>

namespace Tool {

// what ended a simplification
enum class Limit
{
  FACETS,    // the requested number of facets
  TOLERANCE, // of the surface
  TIME,
  SHELL, // of a thickness that does not depend on the tolerance
  LINES, // lines, or excised triangles
  MESH   // no edge can be collapsed
};

struct Simplify_target
{
  std::size_t facets = 0; // 0 for as few as possible
  bool keeps_lines = true;
  bool cuts_lines = false;                                            // instead of keeping their edges
  bool rounds_coordinates = false;                                    // to floats, if the result remains certified
  double line_tolerance = 0;                                          // distance of lines
  double border_tolerance = 0;                                        // distance of borders; they are kept if it is 0
  double surface_tolerance = std::numeric_limits<double>::infinity(); // distance of surfaces
  std::set<Mesh::Point> pins;                                         // vertices that are kept
};

struct Simplified : Edited
{
  Limit limit = Limit::MESH;
  std::size_t removed_border_edges = 0;
  bool keeps_lines = true;      // whether lines were kept together
  std::optional<Cut_lines> cut; // if the mesh was to be cut along lines
  std::size_t pins = 0;         // vertices that were kept because of the tolerance
};

// Simplifies the mesh of a certified shell. The search for facets ends when a part of the time is over, such that time
// remains for the proofs.
Simplified simplify_in_shell(const Model& model, const std::shared_ptr<const BS::Shell_of_soup_3>& found,
                             const Simplify_target& target, const Time_limit& time, Progress& progress);

} // namespace Tool

#endif // TOOL_COMMANDS_SIMPLIFIED_H
