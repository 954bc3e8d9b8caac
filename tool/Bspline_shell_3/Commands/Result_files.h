// Files that take their places together.
#ifndef TOOL_COMMANDS_RESULT_FILES_H
#define TOOL_COMMANDS_RESULT_FILES_H

#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Tool {

// names and contents of files; a file without contents is removed
typedef std::vector<std::pair<std::string, std::optional<std::string> > > Contents;

// Returns whether a file can be created, without changing it.
bool is_writable(const std::string& file);

// Returns whether both names belong to the same existing file.
bool is_same_file(const std::string& file, const std::string& other);

// Returns the stream for the report about a result: the standard error if the result is the standard output.
std::ostream& report_stream(const std::string& result);

// Writes files under temporary names and renames them when all are complete. If one cannot be written, none is changed,
// and its name is returned; otherwise, the name is empty. SIGINT is ignored meanwhile, so that it leaves nothing
// behind.
std::string write_files(const Contents& files);

} // namespace Tool

#endif // TOOL_COMMANDS_RESULT_FILES_H
