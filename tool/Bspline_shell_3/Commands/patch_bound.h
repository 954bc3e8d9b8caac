// A bound of the distance from a triangle to facets of a mesh that cover it.
#ifndef TOOL_COMMANDS_PATCH_BOUND_H
#define TOOL_COMMANDS_PATCH_BOUND_H

#include "../Carry/Mesh_origins.h"

#include <Eigen/Core>

#include <array>

namespace Tool {

// Returns a bound of the distance of all points of a triangle from a mesh; infinity if this function finds none that is
// at most `within`. It is meant for triangles that are large compared with the facets of the mesh. The time is
// proportional to the number of facets over the triangle.
//
// Facets are collected from `start` over the edges that meet the triangle in the projection along its normal, where the
// triangle is shrunk. If all of them have the same orientation in the projection, and no edge is on a border, then the
// projection of the collected surface is open, and closed, in the shrunk triangle: it covers it. So each point of the
// triangle has a point of the surface close to it in the projection, and the largest difference of heights bounds the
// distance along the normal.
// \param start a facet
// \param distance its distance from the center of the triangle's inscribed circle
// \param rounding bound of the error of a projected coordinate
double patch_bound(const std::array<Eigen::Vector3d, 3>& triangle, const Mesh& mesh, Mesh::Face_index start,
                   double distance, double within, double rounding);

// Returns the center of the inscribed circle of a triangle.
Eigen::Vector3d incenter(const std::array<Eigen::Vector3d, 3>& triangle);

} // namespace Tool

#endif // TOOL_COMMANDS_PATCH_BOUND_H
