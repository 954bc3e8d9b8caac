// The parts of a mesh that are mapped one-to-one to a model.
#ifndef TOOL_CARRY_MAPPED_PARTS_H
#define TOOL_CARRY_MAPPED_PARTS_H

#include "Model_map.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace Tool {

enum class Mapped
{
  ONE_TO_ONE, // along curves that each meet the mesh once
  CONTINUED,  // from a point in the shell, without a proof
  NEAREST     // from a point outside of the shell to the nearest point
};

struct Mapped_parts
{
  // Whether the map of the whole mesh is proved to be one-to-one. Otherwise, one-to-one facets are proved to lie in the
  // shell and to face along the curves; their corners and centers are mapped to the model and back to themselves.
  bool is_certified = false;
  std::vector<Mapped> of_vertices, of_facets;
  std::array<double, 3> area = {}; // fractions, by `Mapped`

  double share(Mapped part) const { return area[std::size_t(part)]; }
  bool is_one_to_one() const
  {
    return is_certified
           && std::count(of_facets.begin(), of_facets.end(), Mapped::ONE_TO_ONE) == std::ptrdiff_t(of_facets.size());
  }
};

Mapped_parts mapped_parts(const Model_map& map);

} // namespace Tool

#endif // TOOL_CARRY_MAPPED_PARTS_H
