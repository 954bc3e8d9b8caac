// Values as files hold them.
#ifndef TOOL_CARRY_FINISHED_VALUE_H
#define TOOL_CARRY_FINISHED_VALUE_H

#include "../Files/Model.h"
#include "../Files/numbers.h"

#include <algorithm>
#include <cmath>

namespace Tool {

// Rounds a value as the file does. Colors that were extrapolated are brought back into their range.
inline double finished_value(const Attribute& a, double x)
{
  if(a.kind == Kind::COLOR && !std::isnan(x)) x = (std::min)((std::max)(x, 0.), is_real(a.type) ? 1. : 255.);
  return is_real(a.type) ? x : rounded_to(a.type, x);
}

} // namespace Tool

#endif // TOOL_CARRY_FINISHED_VALUE_H
