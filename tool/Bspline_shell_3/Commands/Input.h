// The file from which a command begins.
#ifndef TOOL_COMMANDS_INPUT_H
#define TOOL_COMMANDS_INPUT_H

#include "Outcome.h"

#include "../Files/Model.h"

#include <string>

namespace Tool {

// Reads a file, and prints warnings to the error stream.
Outcome read_input(const std::string& file, Model& model);

// Returns the length of the longest side of the bounding box.
double longest_side(const Model& model);

} // namespace Tool

#endif // TOOL_COMMANDS_INPUT_H
