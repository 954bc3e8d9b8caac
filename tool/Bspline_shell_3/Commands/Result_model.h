// The file in which a command writes its result.
#ifndef TOOL_COMMANDS_RESULT_MODEL_H
#define TOOL_COMMANDS_RESULT_MODEL_H

#include "Outcome.h"
#include "Result_files.h"

#include "../Files/Model.h"

#include <string>
#include <vector>

namespace Tool {

// Returns whether a model can be written to a file with this name without replacing an input.
Outcome check_output(const std::string& output, const std::vector<std::string>& inputs);

// Returns whether files can be written without replacing those to which the inputs refer.
Outcome check_files(const std::vector<std::string>& outputs, const std::vector<const Model*>& inputs);

// Returns whether the file of the result has coordinates of single precision, if the result allows it.
bool rounds_coordinates(const Model& input, const std::string& output);

// Writes a model together with other files. Appends the names of attributes in the file, and warnings about data that
// the format cannot hold, which it prints to the error stream. Nothing is written if this would replace the files of
// another model.
Outcome write_result(const Model& model, const std::string& output, const std::vector<const Model*>& inputs,
                     const Contents& other_files, std::vector<std::string>& attributes,
                     std::vector<std::string>& warnings);

} // namespace Tool

#endif // TOOL_COMMANDS_RESULT_MODEL_H
