// The simplified mesh of a model.
#ifndef TOOL_VERBS_SIMPLIFIED_H
#define TOOL_VERBS_SIMPLIFIED_H

#include "Progress.h"
#include "Time_limit.h"
#include "cut_lines.h"
#include "distance_bound.h"

#include "../Carry/Mesh_origins.h"
#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>

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

// A mesh that replaces the mesh of a shell, and is certified in it.
struct Simplified
{
  std::string message; // the reason if there is no result
  std::shared_ptr<const BS::Shell_of_soup_3> found;
  Mesh mesh;
  BS::Rejoined_soup_3 rejoined;                       // the mesh and the excised triangles, if there are any
  std::shared_ptr<const BS::Shell_closing_3> closing; // triangles that close the mesh if it is open
  Limit limit = Limit::MESH;
  std::size_t facets_before = 0, facets = 0; // numbers for the whole surface
  std::size_t removed_border_edges = 0;
  std::size_t lines = 0;        // edges on lines before the simplification, or at which facets were cut
  bool keeps_lines = true;      // whether lines were kept together
  std::optional<Cut_lines> cut; // if the mesh was to be cut along lines
  bool is_rounded = false;      // whether coordinates are those of a file of floats
  std::size_t pins = 0;         // vertices that were kept because of the tolerance
  double thickness = 0;         // requested thickness of the shell
  Distance_bounds distances;    // between the model and the result

  explicit operator bool() const { return message.empty(); }
};

// Simplifies the mesh of a certified shell. The search for facets ends when a part of the time is over, such that time
// remains for the proofs.
Simplified simplify_in_shell(const Model& model, const std::shared_ptr<const BS::Shell_of_soup_3>& found,
                             const Simplify_target& target, const Time_limit& time, Progress& progress);

} // namespace Tool

#endif // TOOL_VERBS_SIMPLIFIED_H
