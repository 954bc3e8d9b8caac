// Options of all edits.
#ifndef TOOL_COMMANDS_EDIT_OPTIONS_H
#define TOOL_COMMANDS_EDIT_OPTIONS_H

#include "find_shell.h"

#include <optional>
#include <string>

namespace Tool {

struct Edit_options : Shell_options
{
  std::string output;
  std::string shell; // prefix of the files of the shell; empty if they are not written
  std::string view;  // page that shows the result; empty if it is not written
  bool carries_normals = false;
  std::optional<Length> tolerance; // distance of the surfaces
};

// Returns the tolerance of the options; infinite if there is none.
double tolerance_of(const Edit_options& options, double longest_side);

// Returns the thickness of the first shell. By default, it is the tolerance, unless that is large.
double first_thickness(const Edit_options& options, double longest_side);

} // namespace Tool

#endif // TOOL_COMMANDS_EDIT_OPTIONS_H
