// Intensities of light, and the numbers that stand for them in images and material libraries.
#ifndef TOOL_FILES_SRGB_H
#define TOOL_FILES_SRGB_H

#include <cmath>

namespace Tool {

// Both functions map 0 to 0, and 1 to 1 up to rounding errors (IEC 61966-2-1).
inline double to_linear(double x)
{
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}
inline double to_sRGB(double x)
{
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

} // namespace Tool

#endif // TOOL_FILES_SRGB_H
