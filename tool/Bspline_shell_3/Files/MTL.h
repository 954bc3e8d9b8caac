// Material libraries of OBJ files.
#ifndef TOOL_FILES_MTL_H
#define TOOL_FILES_MTL_H

#include "Words.h"

#include <string>
#include <string_view>

namespace Tool {

// Returns the name of the texture file in a line of a material library, which follows options and may have spaces. The
// name is a part of the line; it is empty if the line does not name a texture.
std::string_view texture_of(const Lines& lines);

// Returns the name of a file for another folder: relative names are relative to the folder of the file that has them.
std::string moved_name(const std::string& name, const std::string& from, const std::string& to);

// Returns the text of material libraries for another folder.
std::string moved_materials(const std::string& text, const std::string& from, const std::string& to);

} // namespace Tool

#endif // TOOL_FILES_MTL_H
