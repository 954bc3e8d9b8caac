// The file from which a verb begins.
#ifndef TOOL_VERBS_INPUT_H
#define TOOL_VERBS_INPUT_H

#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Tool {

// Reads a file and prints warnings; if it cannot be read, prints the reason and returns false.
bool read_input(const std::string& file, Model& model);

// Returns the length of the longest side of the bounding box.
double longest_side(const Model& model);

// Prints a message about a file, followed by the first facets and vertices concerned.
void complain(const std::string& file, const std::string& message,
              const BS::Offending_simplices& offenders = BS::Offending_simplices());

} // namespace Tool

#endif // TOOL_VERBS_INPUT_H
