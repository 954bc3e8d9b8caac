// The search for the simplified mesh of a model.
#ifndef TOOL_COMMANDS_SIMPLIFY_MODEL_H
#define TOOL_COMMANDS_SIMPLIFY_MODEL_H

#include "Edit_options.h"
#include "Progress.h"
#include "Simplified.h"
#include "Time_limit.h"

#include <cstddef>
#include <optional>

namespace Tool {

struct Simplify_options : Edit_options
{
  std::optional<Length> border;
  std::size_t facets = 0; // 0 if there is no target
  double ratio = 0;       // 0 if there is no target
  bool cuts_lines = false;
};

// Simplifies a model. The shell has the thickness of the options, or a thickness that is found by a few attempts:
// - With a tolerance, the first shell is as thick. Thicker ones are tried while much of the tolerance is left, and
//   thinner ones while it is exceeded at many places. At few places, the original facets are kept.
// - Without a tolerance, thicker shells are tried until the number of facets is reached.
// Lines are cut into the result, or they are kept as edges and given up if this is necessary and sufficient to reach
// the number of facets. If there is no certified shell, the result refers to the one of the first attempt.
Outcome simplify_model(const Model& model, const Simplify_options& options, const Time_limit& time, Progress& progress,
                       Simplified& result);

} // namespace Tool

#endif // TOOL_COMMANDS_SIMPLIFY_MODEL_H
