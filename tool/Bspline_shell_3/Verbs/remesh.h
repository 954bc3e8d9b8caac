// The verb that remeshes a file.
#ifndef TOOL_VERBS_REMESH_H
#define TOOL_VERBS_REMESH_H

#include "Length.h"
#include "Outcome.h"

#include <limits>
#include <optional>
#include <string>

namespace Tool {

struct Remesh_options
{
  std::string input, output;
  std::optional<Length> edge, thickness;
  double feature = 60; // in degrees
  double seconds = std::numeric_limits<double>::infinity();
  bool carries_normals = false;
};
// \pre there is an edge length
Outcome remesh(const Remesh_options& options, bool writes_json);

} // namespace Tool

#endif // TOOL_VERBS_REMESH_H
