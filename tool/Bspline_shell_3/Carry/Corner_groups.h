// Corners at a vertex that have equal values, and the seams between the others.
#ifndef TOOL_CARRY_CORNER_GROUPS_H
#define TOOL_CARRY_CORNER_GROUPS_H

#include "Mesh_origins.h"
#include "Mix.h"

#include "../Files/Model.h"

#include <cstddef>
#include <vector>

namespace Tool {

// Returns the attributes of points and corners that are interpolated, and have several values at a vertex of the mesh.
// Attributes of points are among them if several points are the same vertex.
std::vector<const Attribute*> attributes_with_seams(const Model& model, const Mesh& mesh, const Mesh_origins& origins);

// Numbers of groups, by halfedge: at a vertex, corners have the same number if and only if all attributes have the same
// values.
std::vector<std::size_t> corner_groups(const std::vector<const Attribute*>& attributes, const Mixer& mixer,
                                       const Mesh& mesh, const Mesh_origins& origins);

// Marks edges that a simplification should keep: seams, and edges between different labels or colors of polygons. An
// attribute that changes at more than half of the edges has no such lines.
std::vector<char> find_lines(const Model& model, const Mesh& mesh, const Mesh_origins& origins);

} // namespace Tool

#endif // TOOL_CARRY_CORNER_GROUPS_H
