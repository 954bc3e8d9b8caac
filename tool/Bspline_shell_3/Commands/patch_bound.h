// A bound on the distance from a triangle to facets of a mesh that cover it.
#ifndef TOOL_COMMANDS_PATCH_BOUND_H
#define TOOL_COMMANDS_PATCH_BOUND_H

#include "../Carry/Mesh_origins.h"

#include <Eigen/Core>

#include <array>

namespace Tool {

// Returns a bound on the distance of all points of a triangle from a mesh; infinity if this function finds none that is
// at most `within`. It is meant for triangles that are large compared with the facets of the mesh. The time is
// proportional to the number of facets over the triangle.
//
// Facets and the triangle are projected along the normal of the triangle, which is also shrunk. Facets are collected
// from `start`, over edges whose projection meets the shrunk triangle. Suppose that none of these edges is on a
// border, and that all collected facets have the same orientation in the projection. Then the projection of the
// collected surface is open in the shrunk triangle. It is also closed and not empty, so it covers the shrunk
// triangle. In the projection, each point of the triangle is therefore close to a point of the surface. The largest
// difference of heights bounds their distance along the normal.
// \param start a facet
// \param distance its distance from the center of the triangle's inscribed circle
// \param rounding bound on the error of a projected coordinate
double patch_bound(const std::array<Eigen::Vector3d, 3>& triangle, const Mesh& mesh, Mesh::Face_index start,
                   double distance, double within, double rounding);

// Returns the center of the inscribed circle of a triangle.
Eigen::Vector3d incenter(const std::array<Eigen::Vector3d, 3>& triangle);

} // namespace Tool

#endif // TOOL_COMMANDS_PATCH_BOUND_H
