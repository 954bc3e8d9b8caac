// The remeshed mesh of a model.
#ifndef TOOL_VERBS_REMESHED_H
#define TOOL_VERBS_REMESHED_H

#include "Progress.h"
#include "Time_limit.h"
#include "distance_bound.h"

#include "../Carry/Mesh_origins.h"
#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Editing/Edit_termination.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>

#include <cstddef>
#include <memory>
#include <string>

namespace Tool {

struct Remesh_target
{
  double thickness = 0;            // of the shell
  double edge = 0;                 // length of edges
  double feature = 0;              // in degrees; edges with a larger angle between the normals of their facets are kept
  bool rounds_coordinates = false; // to floats, if the result remains certified
};

// A mesh that replaces the mesh of a shell, and is certified in it.
struct Remeshed
{
  std::string message; // the reason if there is no result
  Mesh mesh;
  BS::Rejoined_soup_3 rejoined;                       // the mesh and the excised triangles, if there are any
  std::shared_ptr<const BS::Shell_closing_3> closing; // triangles that close the mesh if it is open
  BS::Edit_termination end = BS::Edit_termination::NOT_EDITED;
  std::size_t facets_before = 0, facets = 0; // numbers for the whole surface
  std::size_t features = 0, lines = 0;       // edges on features; on seams and borders of labels
  bool protects_lines = false;               // whether these edges are neither split nor collapsed
  bool is_rounded = false;                   // whether coordinates are those of a file of floats
  double thickness = 0;                      // requested thickness of the shell
  Distance_bounds distances;                 // between the model and the result
  double mean_edge = 0;                      // mean length of the edges
  double share_near_target = 0;              // of the edges: those from 4/5 to 4/3 of the length

  explicit operator bool() const { return message.empty(); }
};

// Remeshes the mesh of a certified shell. If the time is short, the result is that of fewer operations.
Remeshed remesh_in_shell(const Model& model, const BS::Shell_of_soup_3& found, const Remesh_target& target,
                         const Time_limit& time, Progress& progress);

} // namespace Tool

#endif // TOOL_VERBS_REMESHED_H
