// Names of files that are written beside a result.
#ifndef TOOL_FILES_NAME_BESIDE_H
#define TOOL_FILES_NAME_BESIDE_H

#include <string>

namespace Tool {

// Returns a name without its folder: the stem of the result and an ending, such as part.mtl for part.obj. A number is
// inserted (part_1.mtl) if the file would replace one of another model: one that exists, has other contents, and is not
// named in the earlier result.
std::string name_beside(const std::string& result, const std::string& ending, const std::string& contents);

} // namespace Tool

#endif // TOOL_FILES_NAME_BESIDE_H
