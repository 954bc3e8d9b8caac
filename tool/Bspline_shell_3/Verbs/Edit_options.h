// Options of all edits.
#ifndef TOOL_VERBS_EDIT_OPTIONS_H
#define TOOL_VERBS_EDIT_OPTIONS_H

#include "find_shell.h"

#include <string>

namespace Tool {

struct Edit_options : Shell_options
{
  std::string output;
  std::string shell; // prefix of the files of the shell; empty if they are not written
  std::string view;  // page that shows the result; empty if it is not written
  bool carries_normals = false;
};

} // namespace Tool

#endif // TOOL_VERBS_EDIT_OPTIONS_H
