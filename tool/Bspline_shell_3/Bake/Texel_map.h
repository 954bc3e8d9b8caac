// The texels that the facets of a mesh cover in texture coordinates.
#ifndef TOOL_BAKE_TEXEL_MAP_H
#define TOOL_BAKE_TEXEL_MAP_H

#include "../Carry/Triangulated_model.h"
#include "../Files/Model.h"

#include <array>
#include <cstddef>
#include <vector>

namespace Tool {

struct Texel
{
  std::size_t position; // in the image
  Mesh::Face_index facet;
  std::array<double, 3> weights; // barycentric coordinates of the center of the texel, as for `Face_location`
};

struct Texel_map
{
  std::vector<Texel> texels;                            // at most one at each position
  std::size_t overlapping = 0;                          // number of texels whose centers lie in several facets
  std::array<std::size_t, 2> overlapping_polygons = {}; // an example
  std::size_t outside = 0;                              // number of facets that are not in the image, or only in part
};

// \param texture texture coordinates of the model, at points or corners
// \param size number of texels along each side of the image
Texel_map map_texels(const Model& model, const Triangulated_model& mesh, const Attribute& texture, std::size_t size);

} // namespace Tool

#endif // TOOL_BAKE_TEXEL_MAP_H
