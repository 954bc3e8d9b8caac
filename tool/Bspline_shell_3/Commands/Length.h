// Lengths on the command line.
#ifndef TOOL_COMMANDS_LENGTH_H
#define TOOL_COMMANDS_LENGTH_H

#include "../Files/Words.h"

#include <cmath>
#include <optional>
#include <string>

namespace Tool {

// A length in the unit of the file, or in percent of the longest side of the bounding box.
struct Length
{
  double value = 0;
  bool is_in_percent = false;

  double in_box(double longest_side) const { return is_in_percent ? value / 100 * longest_side : value; }
};

inline std::optional<Length> read_length(std::string text)
{
  Length length;
  length.is_in_percent = !text.empty() && text.back() == '%';
  if(length.is_in_percent) text.pop_back();
  if(!read_number(text, length.value) || !std::isfinite(length.value) || !(length.value > 0)) return std::nullopt;
  return length;
}

} // namespace Tool

#endif // TOOL_COMMANDS_LENGTH_H
