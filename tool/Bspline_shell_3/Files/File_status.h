// The outcome of reading and writing files.
#ifndef TOOL_FILES_FILE_STATUS_H
#define TOOL_FILES_FILE_STATUS_H

#include <cstddef>
#include <string>
#include <vector>

namespace Tool {

enum class File_status
{
  SUCCESS,
  MISSING,
  UNREADABLE,
  UNSUPPORTED,
  UNSUPPORTED_EXTENSION,
  EMPTY,
  MALFORMED,
  MISSING_POINT,
  NOT_FINITE,
  NO_POLYGONS,
  CANNOT_WRITE
};

inline const char* message(File_status status)
{
  switch(status) {
    case File_status::SUCCESS: return "The file is complete.";
    case File_status::MISSING: return "The file does not exist.";
    case File_status::UNREADABLE: return "The file cannot be read: it is a folder, or permission is denied.";
    case File_status::UNSUPPORTED: return "The file format is not supported: use PLY, OBJ, OFF, STL, glTF, or GLB.";
    case File_status::UNSUPPORTED_EXTENSION:
      return "The file requires an extension of glTF that is not supported: export it without compression.";
    case File_status::EMPTY: return "The file is empty.";
    case File_status::MALFORMED: return "The contents do not conform to the file format.";
    case File_status::MISSING_POINT: return "A polygon refers to a point that is not in the file.";
    case File_status::NOT_FINITE: return "A coordinate is infinite or not a number.";
    case File_status::NO_POLYGONS: return "The file has no polygons.";
    case File_status::CANNOT_WRITE: return "The file cannot be written.";
  }
  return "";
}

struct File_report
{
  File_status status = File_status::SUCCESS;
  std::size_t line = 0;                      // line at which reading failed; 0 if it is not known
  std::vector<std::size_t> polygons, points; // the first ones that are wrong
  std::vector<std::string> warnings;         // sentences about data that is left out

  explicit operator bool() const { return status == File_status::SUCCESS; }
};

} // namespace Tool

#endif // TOOL_FILES_FILE_STATUS_H
