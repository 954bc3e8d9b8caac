// What all edits do before and after the mesh is edited.
#ifndef TOOL_VERBS_EDIT_H
#define TOOL_VERBS_EDIT_H

#include "Edit_options.h"
#include "Edit_summary.h"
#include "Edited.h"
#include "Outcome.h"
#include "Progress.h"

#include "../Files/Model.h"

namespace Tool {

// Reads the model, after it is clear that the results can be written and replace no input.
Outcome open_edit(const Edit_options& options, Model& model);

// Carries the attributes of the model to the edited mesh, and writes it, together with the files of its shell if they
// are requested. Adds what is in the file to the summary.
Outcome write_edit(const Edit_options& options, const Model& model, const Edited& result, Progress& progress,
                   Edit_summary& summary);

} // namespace Tool

#endif // TOOL_VERBS_EDIT_H
