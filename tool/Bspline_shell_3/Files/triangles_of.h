// The triangles of polygons, for formats that have only triangles.
#ifndef TOOL_FILES_TRIANGLES_OF_H
#define TOOL_FILES_TRIANGLES_OF_H

#include "Model.h"

#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Tool {

// Returns triangles as positions of corners in the polygon. There are none if it has fewer than three corners.
inline std::vector<std::array<std::size_t, 3> > triangles_of(const Model& model, std::size_t polygon)
{
  const auto& corners = model.soup.polygons[polygon];
  if(corners.size() < 3) return {};
  if(corners.size() == 3) return { { 0, 1, 2 } };
  Model::Points points;
  for(std::size_t v : corners) points.push_back(model.soup.points[v]);
  return BS::triangulate_polygon(points);
}

} // namespace Tool

#endif // TOOL_FILES_TRIANGLES_OF_H
