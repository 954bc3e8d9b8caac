// The verb that transfers attributes of one file to another.
#ifndef TOOL_VERBS_TRANSFER_H
#define TOOL_VERBS_TRANSFER_H

#include "Length.h"
#include "Outcome.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace Tool {

struct Transfer_options
{
  std::string from, to, output;
  std::optional<Length> thickness; // in percent of the box of `from`
  double seconds = std::numeric_limits<double>::infinity();
  bool includes_normals = false;
  std::string image, normal_image; // names of the files to bake; empty if there is none
  std::size_t size = 1024;         // number of texels along each side
  std::size_t margin = 8;          // in texels
};
Outcome transfer(const Transfer_options& options, bool writes_json);

} // namespace Tool

#endif // TOOL_VERBS_TRANSFER_H
