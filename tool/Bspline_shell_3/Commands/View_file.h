// The page of a command that shows its result in a browser.
#ifndef TOOL_COMMANDS_VIEW_FILE_H
#define TOOL_COMMANDS_VIEW_FILE_H

#include "Edit_summary.h"
#include "Outcome.h"
#include "Result_files.h"

#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>

#include <string>

namespace Tool {

// Returns whether pages with this name can be written.
Outcome check_view(const std::string& file);

// Returns the page that shows a model and its edited mesh. The page of an earlier failure is removed.
Contents view_of_edit(const std::string& file, const Model& model, const Model& result,
                      const BS::Shell_of_soup_3& found, const Edit_summary& summary);

// Returns the page that shows a model and its shell. The page of an earlier failure is removed.
Contents view_of_shell(const std::string& file, const Model& model, const BS::Shell_of_soup_3& found,
                       const std::string& input);

// Returns the page that shows a model with attributes, and the result to which they are transferred.
// \param map_message which part of the map is proved
Contents view_of_transfer(const std::string& file, const Model& from, const Model& result,
                          const BS::Shell_of_soup_3& found, const std::string& output, const std::string& map_message);

// Writes a page with the places where the proof fails, under a name that ends in `_failed.html`. The page of an earlier
// success is kept. Returns the outcome with a sentence about the page.
Outcome write_failure_view(const Outcome& outcome, const std::string& file, const Model& model,
                           const BS::Shell_of_soup_3& found);

} // namespace Tool

#endif // TOOL_COMMANDS_VIEW_FILE_H
