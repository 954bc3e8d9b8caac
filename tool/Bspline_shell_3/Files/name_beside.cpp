#include "name_beside.h"
#include "Words.h"
#include "read_model.h"

#include <filesystem>

namespace Tool {

namespace {

// Returns whether a line of a text file names a file after its keyword.
bool refers_to(const std::string& file, const std::string& name)
{
  std::string text;
  if(read_text(file, text) != File_status::SUCCESS) return false;
  Lines lines(text);
  while(lines.next())
    if(lines.rest() == name) return true;
  return false;
}

} // namespace

std::string name_beside(const std::string& result, const std::string& ending, const std::string& contents)
{
  const std::filesystem::path path(result);
  for(int n = 0;; ++n) {
    const std::string name = path.stem().string() + (n > 0 ? "_" + std::to_string(n) : "") + ending;
    std::string existing;
    const File_status status = read_text((path.parent_path() / name).string(), existing);
    const bool is_equal = status == File_status::SUCCESS && existing == contents;
    if(status == File_status::MISSING || is_equal || refers_to(result, name)) return name;
  }
}

} // namespace Tool
