// A loop over numbers, in parallel if possible.
#ifndef TOOL_CARRY_FOR_EACH_NUMBER_H
#define TOOL_CARRY_FOR_EACH_NUMBER_H

#include <CGAL/for_each.h>
#include <CGAL/tags.h>

#include <cstddef>
#include <numeric>
#include <vector>

namespace Tool {

// Calls a function with the numbers 0, ..., size - 1.
template <typename Function>
void for_each_number(std::size_t size, const Function& f)
{
  std::vector<std::size_t> numbers(size);
  std::iota(numbers.begin(), numbers.end(), 0);
  CGAL::for_each<CGAL::Parallel_if_available_tag>(numbers, [&](std::size_t& n) {
    f(n);
    return true;
  });
}

} // namespace Tool

#endif // TOOL_CARRY_FOR_EACH_NUMBER_H
