#include "edit.h"
#include "Input.h"
#include "Result_model.h"
#include "Shell_files.h"
#include "View_file.h"
#include "number.h"

#include "../Carry/carry_attributes.h"
#include "../Files/File_status.h"

#include <utility>

namespace Tool {

Outcome open_edit(const Edit_options& options, Model& model)
{
  if(const Outcome output = check_output(options.output, { options.input }); !output) return output;
  if(const Outcome read = read_input(options.input, model); !read) return read;
  if(!is_writable(options.output)) return { CANNOT_WRITE, options.output, message(File_status::CANNOT_WRITE) };
  if(!options.view.empty())
    if(const Outcome view = check_view(options.view); !view) return view;
  return options.shell.empty() ? DONE : check_shell_files(options.shell, { options.input, options.output });
}

Outcome fail_edit(const Outcome& outcome, const Edit_options& options, const Model& model,
                  const BS::Shell_of_soup_3& found)
{
  Outcome failure = outcome;
  if(!options.shell.empty()) failure = write_failure(failure, options.shell, found, options.input);
  if(!options.view.empty()) failure = write_failure_view(failure, options.view, model, found);
  return failure;
}

Outcome check_tolerance(const Edit_options& options, const Model& model, const Edited& result)
{
  if(result.distances.largest() <= tolerance_of(options, longest_side(model))) return DONE;
  return { NOT_CERTIFIED, options.input,
           "The tolerance is not kept: the distance is at most " + number(result.distances.largest())
             + ". Use a larger --tolerance."
             + (result.found->proxy
                  ? " A proxy around the polygons was edited. " + with_options(result.found->mesh_message())
                  : std::string()) };
}

Outcome write_edit(const Edit_options& options, const Model& model, const Edited& result, Progress& progress,
                   Edit_summary& summary)
{
  const Model output = carry_attributes(model, *result.found, result.mesh, result.closing, result.rejoined,
                                        options.carries_normals ? Normals::CARRIED : Normals::RECOMPUTED,
                                        summary.carried,
                                        [&](double fraction) { progress.show("attributes", fraction); });
  progress.clear();
  Contents others = options.shell.empty() ? Contents() : shell_files(options.shell, *result.found, options.input);
  if(!options.view.empty())
    for(auto& file : view_of_edit(options.view, model, output, *result.found, summary))
      others.push_back(std::move(file));
  return write_result(output, options.output, { &model }, others, summary.attributes, summary.warnings);
}

} // namespace Tool
