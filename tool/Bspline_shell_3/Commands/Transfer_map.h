// The shell of a model in which another model is mapped to it.
#ifndef TOOL_COMMANDS_TRANSFER_MAP_H
#define TOOL_COMMANDS_TRANSFER_MAP_H

#include "Outcome.h"
#include "Progress.h"
#include "Time_limit.h"
#include "find_shell.h"

#include "../Carry/Mapped_parts.h"
#include "../Carry/Model_map.h"
#include "../Carry/Triangulated_model.h"
#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>

#include <memory>

namespace Tool {

// Objects are not copied, because the map refers to them.
struct Transfer_map
{
  explicit Transfer_map(const Model& to) : mesh(to) {}
  Transfer_map(const Transfer_map&) = delete;
  Transfer_map& operator=(const Transfer_map&) = delete;

  BS::Shell_of_soup_3 found;
  Outcome outcome; // outcome of the search for a certified shell
  double thickness = 0;
  Triangulated_model mesh; // triangles of the mapped model, oriented like the mesh of the shell
  std::unique_ptr<const Model_map> map;
  Mapped_parts parts;
};

// Chooses the thickness for which the largest part of the area is one-to-one. First, the shell is so thick that it can
// contain all of `to`; then so thick that it can contain most of it.
// \param options the options of the shell, whose thickness is used if it is given
// \param distance no point of `to` is farther than this from `from`
std::unique_ptr<const Transfer_map> transfer_map(const Model& from, const Model& to, const Shell_options& options,
                                                 double distance, const Time_limit& time, Progress& progress);

} // namespace Tool

#endif // TOOL_COMMANDS_TRANSFER_MAP_H
