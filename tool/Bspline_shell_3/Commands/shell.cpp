#include "Input.h"
#include "Json.h"
#include "Progress.h"
#include "Shell_files.h"
#include "View_file.h"
#include "number.h"
#include "commands.h"

#include "../Files/File_status.h"

#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace Tool {

Outcome shell(const Shell_options& options, const std::string& prefix, const std::string& view, bool writes_json)
{
  Model model;
  if(const Outcome read = read_input(options.input, model); !read) return read;
  if(const Outcome files = check_shell_files(prefix, { options.input }); !files) return files;
  if(!view.empty())
    if(const Outcome page = check_view(view); !page) return page;
  Progress progress;
  BS::Shell_of_soup_3 found;
  const double side = longest_side(model), thickness = thickness_of(options, side);
  if(const Outcome outcome = find_shell(model, options, thickness, options.seconds, progress, found); !outcome) {
    const Outcome failure = write_failure(outcome, prefix, found, options.input);
    return view.empty() ? failure : write_failure_view(failure, view, model, found);
  }

  Contents files = shell_files(prefix, found, options.input, true);
  if(!view.empty())
    for(auto& file : view_of_shell(view, model, found, options.input)) files.push_back(std::move(file));
  const std::string failed = write_files(files);
  if(!failed.empty()) return { CANNOT_WRITE, failed, message(File_status::CANNOT_WRITE) };
  std::vector<std::string> names;
  for(const auto& [name, text] : files)
    if(text) names.push_back(name);
  if(writes_json) {
    Json json;
    json.add("input", options.input)
      .add("certification", name(found.certification()))
      .add("kind", name(found.kind()))
      .add("facets", std::size_t(found.mesh().number_of_faces()))
      .add("cells", found.shell().report().cells)
      .add("thickness", found.shell().thickness())
      .add("relative_thickness", found.shell().relative_thickness())
      .add("files", names)
      .add("seconds", found.seconds);
    std::cout << json.text() << std::endl;
    return DONE;
  }
  std::cout << "shell       " << found.mesh().number_of_faces() << " facets, " << name(found.kind()) << "; "
            << found.shell().report().cells << " cells\n"
            << "thickness   " << number(found.shell().thickness()) << " (" << percent(found.shell().thickness() / side)
            << " of the box)\n"
            << with_options(found.message()) << "\nfiles      ";
  for(const std::string& name : names) std::cout << " " << name;
  std::cout << std::endl;
  return DONE;
}

} // namespace Tool
