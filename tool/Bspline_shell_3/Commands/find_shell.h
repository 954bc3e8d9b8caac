// The shell of a model.
#ifndef TOOL_COMMANDS_FIND_SHELL_H
#define TOOL_COMMANDS_FIND_SHELL_H

#include "Length.h"
#include "Outcome.h"
#include "Progress.h"

#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>

#include <limits>
#include <optional>
#include <string>

namespace Tool {

struct Shell_options
{
  std::string input;
  std::optional<Length> thickness, weld;
  double excised_percentage = 10; // largest part of the area that may be excised
  double seconds = std::numeric_limits<double>::infinity();
  double megabytes = 4000; // largest memory of the construction
};

// Returns the thickness of the options; by default, 1 % of the longest side of the bounding box.
double thickness_of(const Shell_options& options, double longest_side);

// Finds a certified shell of a thickness. `found` must not be moved afterwards, as maps refer to it.
Outcome find_shell(const Model& model, const Shell_options& options, double thickness, double seconds,
                   Progress& progress, BS::Shell_of_soup_3& found);

} // namespace Tool

#endif // TOOL_COMMANDS_FIND_SHELL_H
