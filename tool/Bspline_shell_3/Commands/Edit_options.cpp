#include "Edit_options.h"
#include "Search_tuning.h"

#include <algorithm>
#include <limits>

namespace Tool {

double tolerance_of(const Edit_options& options, double longest_side)
{
  return options.tolerance ? options.tolerance->in_box(longest_side) : std::numeric_limits<double>::infinity();
}

double first_thickness(const Edit_options& options, double longest_side)
{
  if(options.thickness || !options.tolerance) return thickness_of(options, longest_side);
  return std::clamp(tolerance_of(options, longest_side), search_tuning.thinnest * longest_side,
                    search_tuning.thickest_first * longest_side);
}

} // namespace Tool
