// Bakes colors and normals of a model into images over the texture coordinates of a mesh.
#ifndef TOOL_BAKE_BAKE_H
#define TOOL_BAKE_BAKE_H

#include "Image.h"
#include "Texel_map.h"

#include "../Carry/Model_map.h"

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace Tool {

// A point of the source of a `Model_map`.
struct Source_point
{
  Mesh::Face_index facet;
  std::array<Mesh::Halfedge_index, 3> corners; // halfedges to them
  std::array<double, 3> weights;
};

typedef std::function<Color(const Source_point&)> Color_of_point;

// Returns an image for each function, with its color at the center of each texel. Texels close to covered ones get the
// mean of their neighbors, so that colors at seams are not mixed with the background.
// \param margin number of texels that are filled around the covered ones
// \param progress called with the fraction of the work that is done
std::vector<Image> bake(const Model_map& map, const Texel_map& texels, std::size_t margin,
                        const std::vector<Color_of_point>& colors, const std::function<void(double)>& progress);

} // namespace Tool

#endif // TOOL_BAKE_BAKE_H
