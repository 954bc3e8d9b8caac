// The verbs of the program. Each function returns an exit code.
#ifndef TOOL_VERBS_VERBS_H
#define TOOL_VERBS_VERBS_H

#include "Length.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace Tool {

struct Simplify_options
{
  std::string input, output;
  std::optional<Length> tolerance, thickness;
  std::size_t facets = 0; // 0 if there is no target
  double ratio = 0;       // 0 if there is no target
  double seconds = std::numeric_limits<double>::infinity();
  bool cuts_lines = false, carries_normals = false, writes_json = false;
};
int simplify(const Simplify_options& options);

struct Shell_options
{
  std::string input, prefix;
  std::optional<Length> thickness;
  double seconds = std::numeric_limits<double>::infinity();
  bool writes_json = false;
};
int shell(const Shell_options& options);

struct Check_options
{
  std::string input;
  std::optional<Length> thickness;
  bool writes_json = false;
};
int check(const Check_options& options);

struct Certify_options
{
  std::string shell, mesh;
  bool writes_json = false;
};
int certify(const Certify_options& options);

} // namespace Tool

#endif // TOOL_VERBS_VERBS_H
