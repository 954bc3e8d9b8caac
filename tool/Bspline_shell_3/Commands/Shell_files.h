// Files that describe a shell.
#ifndef TOOL_COMMANDS_SHELL_FILES_H
#define TOOL_COMMANDS_SHELL_FILES_H

#include "Outcome.h"
#include "Result_files.h"

#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>

#include <string>
#include <vector>

namespace Tool {

// Returns whether the files can be created and replace none of the other files, which need not exist.
Outcome check_shell_files(const std::string& prefix, const std::vector<std::string>& others);

// Returns the files of a certified shell: the shell, its report, mesh, and surfaces, and excised triangles or the
// polygons around which a proxy is wrapped. On request, the files from which an independent checker verifies the
// certificate follow. Other files of an earlier run are removed.
Contents shell_files(const std::string& prefix, const BS::Shell_of_soup_3& found, const std::string& input,
                     bool includes_certificate = false);

// Writes the report, the mesh, and the places where the proof fails under names that begin with PREFIX_failed. Files of
// a certified shell are kept. Returns the outcome with a sentence about these files.
Outcome write_failure(const Outcome& outcome, const std::string& prefix, const BS::Shell_of_soup_3& found,
                      const std::string& input);

} // namespace Tool

#endif // TOOL_COMMANDS_SHELL_FILES_H
