// Conversion of numbers between the types of files.
#ifndef TOOL_FILES_NUMBERS_H
#define TOOL_FILES_NUMBERS_H

#include "Model.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Tool {

// Calls `visit` with a value of the type.
template <typename Visit>
auto with_type(Number_type type, const Visit& visit)
{
  switch(type) {
    case Number_type::INT8: return visit(static_cast<signed char>(0));
    case Number_type::UINT8: return visit(static_cast<unsigned char>(0));
    case Number_type::INT16: return visit(short(0));
    case Number_type::UINT16: return visit(static_cast<unsigned short>(0));
    case Number_type::INT32: return visit(int(0));
    case Number_type::UINT32: return visit(0u);
    case Number_type::FLOAT32: return visit(0.f);
    case Number_type::FLOAT64: break;
  }
  return visit(0.);
}

// Rounds a value to a type. Values beyond the range of an integer type become its ends, and NaN becomes zero.
template <typename T>
T rounded_to(double x)
{
  if constexpr(std::numeric_limits<T>::is_integer) {
    const double low = double(std::numeric_limits<T>::lowest()), high = double((std::numeric_limits<T>::max)());
    return std::isnan(x) ? T(0) : static_cast<T>((std::min)((std::max)(std::nearbyint(x), low), high));
  } else return static_cast<T>(x);
}

inline double rounded_to(Number_type type, double x)
{
  return with_type(type, [&](auto zero) { return double(rounded_to<decltype(zero)>(x)); });
}

// Returns the factor by which colors of one type become colors of another.
inline double color_factor(Number_type from, Number_type to)
{
  return is_real(from) == is_real(to) ? 1 : is_real(to) ? 1 / 255. : 255;
}

} // namespace Tool

#endif // TOOL_FILES_NUMBERS_H
