// The verbs of the program. They print their results.
#ifndef TOOL_VERBS_VERBS_H
#define TOOL_VERBS_VERBS_H

#include "Outcome.h"
#include "find_shell.h"
#include "simplify_model.h"

#include <string>

namespace Tool {

struct Simplify_options : Edit_options
{
  bool carries_normals = false;
};
Outcome simplify(const Simplify_options& options, bool writes_json);
Outcome shell(const Shell_options& options, const std::string& prefix, bool writes_json);
Outcome check(const Shell_options& options, bool writes_json);
Outcome certify(const std::string& shell, const std::string& mesh, bool writes_json);

} // namespace Tool

#endif // TOOL_VERBS_VERBS_H
