// An upper bound on the distance between two surfaces.
#ifndef TOOL_COMMANDS_DISTANCE_BOUND_H
#define TOOL_COMMANDS_DISTANCE_BOUND_H

#include "../Carry/Mesh_origins.h"

#include <algorithm>
#include <vector>

namespace Tool {

struct Distance_bounds
{
  double to_second = 0; // no point of the first mesh is farther than this from the second mesh
  double to_first = 0;  // and conversely
  // Facets of the first mesh without a proof that they are within the limit of the second mesh. Also those closest to
  // parts of the second mesh that lack the converse proof.
  std::vector<Mesh::Face_index> beyond_limit;

  double largest() const { return (std::max)(to_second, to_first); }
};

// Returns bounds that exceed the distances by at most about 1 %, or by the resolution if it is larger. The distance to
// a triangle is a convex function, so that it is largest at a corner of a facet. Facets are subdivided until this bound
// suffices, or until a part is covered by facets of the other mesh (`patch_bound()`). The distance to a triangle is
// bounded by that to one of its points, so that only the rounding of lengths has to be added.
Distance_bounds distance_bounds(const Mesh& first, const Mesh& second, double resolution, double limit);

} // namespace Tool

#endif // TOOL_COMMANDS_DISTANCE_BOUND_H
