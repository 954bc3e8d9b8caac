// Numbers in sentences.
#ifndef TOOL_COMMANDS_NUMBER_H
#define TOOL_COMMANDS_NUMBER_H

#include <cstdio>
#include <string>

namespace Tool {

inline std::string number(double x)
{
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g", x);
  return buffer;
}

inline std::string percent(double fraction)
{
  return number(100 * fraction) + " %";
}

} // namespace Tool

#endif // TOOL_COMMANDS_NUMBER_H
