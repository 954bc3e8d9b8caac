// What all edits do before and after the mesh is edited.
#ifndef TOOL_COMMANDS_EDIT_H
#define TOOL_COMMANDS_EDIT_H

#include "Edit_options.h"
#include "Edit_summary.h"
#include "Edited.h"
#include "Outcome.h"
#include "Progress.h"

#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>

namespace Tool {

// Reads the model, after it is clear that the results can be written and replace no input.
Outcome open_edit(const Edit_options& options, Model& model);

// Returns the outcome of an edit without a certified shell. Writes the report and the page of the failure if files of
// the shell or a page are requested.
Outcome fail_edit(const Outcome& outcome, const Edit_options& options, const Model& model,
                  const BS::Shell_of_soup_3& found);

// Returns a failure if the result is farther from the model than the tolerance of the options.
Outcome check_tolerance(const Edit_options& options, const Model& model, const Edited& result);

// Carries the attributes of the model to the edited mesh, and writes it, together with the files of its shell and the
// page if they are requested. Adds attributes and warnings to the summary.
Outcome write_edit(const Edit_options& options, const Model& model, const Edited& result, Progress& progress,
                   Edit_summary& summary);

} // namespace Tool

#endif // TOOL_COMMANDS_EDIT_H
