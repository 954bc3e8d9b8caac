// Transfers the attributes of one model to another.
#ifndef TOOL_CARRY_TRANSFER_ATTRIBUTES_H
#define TOOL_CARRY_TRANSFER_ATTRIBUTES_H

#include "Mapped_parts.h"
#include "Model_map.h"
#include "Triangulated_model.h"

#include "../Files/Model.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace Tool {

struct Transfer_choice
{
  bool includes_normals = false;
  bool includes_textures = true; // texture coordinates and materials
};

struct Attribute_transfer
{
  std::vector<std::string> transferred, replaced; // names of attributes
  std::size_t facets_across_seams = 0;
};

constexpr const char* mapped_name = "mapped";

// Returns the model `to` with the attributes of the model `from`. Attributes of `to` with the same names are replaced.
// Points and polygons are not changed, nor are other attributes. Unless the whole map is proved to be one-to-one, the
// attribute `mapped_name` of points has values of `Mapped`; the attributes of both models with this name are left out.
// \param mesh the triangles of `to`
// \param map the map from the mesh to the polygons of `from`
// \param progress called with the fraction of the work that is done
Model transfer_attributes(const Model& from, const Model& to, const Triangulated_model& mesh, const Model_map& map,
                          const Mapped_parts& parts, const Transfer_choice& choice, Attribute_transfer& report,
                          const std::function<void(double)>& progress);

} // namespace Tool

#endif // TOOL_CARRY_TRANSFER_ATTRIBUTES_H
