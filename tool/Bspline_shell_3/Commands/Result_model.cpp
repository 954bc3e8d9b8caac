#include "Result_model.h"

#include "../Files/File_status.h"
#include "../Files/write_model.h"

#include <iostream>

namespace Tool {

Outcome check_output(const std::string& output, const std::vector<std::string>& inputs)
{
  if(!is_supported(output)) return { WRONG_USAGE, output, message(File_status::UNSUPPORTED) };
  for(const std::string& input : inputs)
    if(is_same_file(output, input))
      return { WRONG_USAGE, output, "The result would replace the input: choose another name." };
  return DONE;
}

Outcome check_files(const std::vector<std::string>& outputs, const std::vector<const Model*>& inputs)
{
  for(const std::string& output : outputs)
    for(const Model* model : inputs)
      for(const std::string& input : model->files)
        if(is_same_file(output, input))
          return { WRONG_USAGE, output, "The result would replace a part of the input: choose another name." };
  return DONE;
}

bool rounds_coordinates(const Model& input, const std::string& output)
{
  return input.coordinates == Number_type::FLOAT32 || has_single_precision(output);
}

Outcome write_result(const Model& model, const std::string& output, const std::vector<const Model*>& inputs,
                     const Contents& other_files, std::vector<std::string>& attributes,
                     std::vector<std::string>& warnings)
{
  const Written_files written = write_model(model, output);
  Contents files(written.files.begin(), written.files.end());
  files.insert(files.end(), other_files.begin(), other_files.end());
  std::vector<std::string> names;
  for(const auto& file : files) names.push_back(file.first);
  if(const Outcome names_are_free = check_files(names, inputs); !names_are_free) return names_are_free;
  const std::string failed = write_files(files);
  if(!failed.empty()) return { CANNOT_WRITE, failed, message(File_status::CANNOT_WRITE) };
  attributes.insert(attributes.end(), written.attributes.begin(), written.attributes.end());
  warnings.insert(warnings.end(), written.warnings.begin(), written.warnings.end());
  for(const std::string& warning : warnings) std::cerr << output << ": " << warning << "\n";
  return DONE;
}

} // namespace Tool
