// The page without its contents. CMake makes its text from the files of this folder and from three.js.
#ifndef TOOL_VIEW_PAGE_TEMPLATE_H
#define TOOL_VIEW_PAGE_TEMPLATE_H

#include <string_view>

namespace Tool {

// Returns the text, which has the marks @TITLE@, @HEADING@, @REPORT@, and @DATA@. It is empty if three.js was not
// installed when the program was built.
std::string_view page_template();

} // namespace Tool

#endif // TOOL_VIEW_PAGE_TEMPLATE_H
