// Numbers for different values.
#ifndef TOOL_CARRY_NUMBERED_VALUES_H
#define TOOL_CARRY_NUMBERED_VALUES_H

#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace Tool {

// Values may be NaN, which is not equal to itself; here, NaN and NaN have the same number.
class Numbered_values
{
public:
  typedef std::vector<double> Value;

  // Returns the number of a value.
  std::size_t operator()(const Value& value)
  {
    std::pair<Value, std::vector<bool> > key(value, {});
    for(double& x : key.first) {
      key.second.push_back(std::isnan(x));
      if(std::isnan(x)) x = 0;
    }
    const auto [found, is_new] = m_number.emplace(std::move(key), m_value.size());
    if(is_new) m_value.push_back(value);
    return found->second;
  }
  // Returns the value with a number.
  const Value& operator[](std::size_t number) const { return m_value[number]; }

private:
  std::map<std::pair<Value, std::vector<bool> >, std::size_t> m_number;
  std::vector<Value> m_value;
};

} // namespace Tool

#endif // TOOL_CARRY_NUMBERED_VALUES_H
