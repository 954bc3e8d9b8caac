#include "edit.h"
#include "Input.h"
#include "Result_model.h"
#include "Shell_files.h"

#include "../Carry/carry_attributes.h"
#include "../Files/File_status.h"

namespace Tool {

Outcome open_edit(const Edit_options& options, Model& model)
{
  if(const Outcome output = check_output(options.output, { options.input }); !output) return output;
  if(const Outcome read = read_input(options.input, model); !read) return read;
  if(!is_writable(options.output)) return { CANNOT_WRITE, options.output, message(File_status::CANNOT_WRITE) };
  return options.shell.empty() ? DONE : check_shell_files(options.shell, { options.input, options.output });
}

Outcome write_edit(const Edit_options& options, const Model& model, const Edited& result, Progress& progress,
                   Edit_summary& summary)
{
  const Model output = carry_attributes(model, *result.found, result.mesh, result.closing, result.rejoined,
                                        options.carries_normals ? Normals::CARRIED : Normals::RECOMPUTED,
                                        summary.carried,
                                        [&](double fraction) { progress.show("attributes", fraction); });
  progress.clear();
  const Contents of_shell = options.shell.empty() ? Contents()
                                                  : shell_files(options.shell, *result.found, options.input);
  return write_result(output, options.output, { &model }, of_shell, summary.attributes, summary.warnings);
}

} // namespace Tool
