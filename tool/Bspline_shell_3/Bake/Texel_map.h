// The texels that the facets of a mesh cover in texture coordinates.
#ifndef TOOL_BAKE_TEXEL_MAP_H
#define TOOL_BAKE_TEXEL_MAP_H

#include "../Carry/Mix.h"
#include "../Carry/Triangulated_model.h"
#include "../Files/Model.h"

#include <array>
#include <cstddef>
#include <vector>

namespace Tool {

// Texels are numbered row by row, from the upper left corner of the image.
class Texel_map
{
public:
  // \param texture texture coordinates of the model, at points or corners
  // \param size number of texels along each side of the image
  // \pre the arguments outlive this object
  Texel_map(const Model& model, const Triangulated_model& mesh, const Attribute& texture, std::size_t size);

  std::size_t size() const { return m_size; }
  // Returns the first facet that covers the center of a texel, or the null facet if there is none.
  Mesh::Face_index facet(std::size_t texel) const { return m_facet[texel]; }
  // Returns the barycentric coordinates of the center of a texel, as for `Face_location`.
  // \pre a facet covers it
  std::array<double, 3> weights(std::size_t texel) const { return weights(texel, corners(m_facet[texel])); }

  // Returns the number of texels whose centers are covered.
  std::size_t covered() const { return m_covered; }
  // Returns the number of texels whose centers lie in several facets.
  std::size_t overlapping() const { return m_overlapping; }
  // Returns polygons of two of these facets.
  const std::array<std::size_t, 2>& overlapping_polygons() const { return m_overlapping_polygons; }
  // Returns the number of facets that are not in the image, or only in part.
  std::size_t outside() const { return m_outside; }

private:
  typedef std::array<double, 2> Position; // unit: texels; the origin is the upper left corner
  typedef std::array<Position, 3> Corners;

  Corners corners(Mesh::Face_index f) const;
  std::array<double, 3> weights(std::size_t texel, const Corners& corner) const;

  const Triangulated_model& m_mesh;
  const Attribute& m_texture;
  Mixer m_mixer;
  std::size_t m_size;
  std::vector<Mesh::Face_index> m_facet; // by texel
  std::size_t m_covered = 0, m_overlapping = 0, m_outside = 0;
  std::array<std::size_t, 2> m_overlapping_polygons = {};
};

} // namespace Tool

#endif // TOOL_BAKE_TEXEL_MAP_H
