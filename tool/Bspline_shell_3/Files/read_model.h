// Reads mesh files with everything that is in them.
#ifndef TOOL_FILES_READ_MODEL_H
#define TOOL_FILES_READ_MODEL_H

#include "File_status.h"
#include "Model.h"

#include <string>
#include <string_view>

namespace Tool {

// Reads a file, whose extension selects the format, or the standard input, whose first bytes select it. Attributes that
// cannot be kept are named in warnings.
File_report read_model(const std::string& file, Model& model);

// Each function reads the text of a file of one format.
File_report read_PLY(std::string_view text, Model& model);
File_report read_OBJ(std::string_view text, Model& model); // also reads material libraries in `model.folder`
File_report read_OFF(std::string_view text, Model& model);
File_report read_STL(std::string_view text, Model& model);
File_report read_GLTF(std::string_view text, Model& model); // also reads buffers in `model.folder`

// Returns the extension of a file name in lower case, with the dot.
std::string extension_of(const std::string& file);

// Returns whether a text begins like an STL file.
bool is_STL(std::string_view text);

// Reads a file or the standard input, and returns whether it can be read.
File_status read_text(const std::string& file, std::string& text);

} // namespace Tool

#endif // TOOL_FILES_READ_MODEL_H
