// Builds the model of a result from the corners of its polygons.
#ifndef TOOL_CARRY_RESULT_BUILDER_H
#define TOOL_CARRY_RESULT_BUILDER_H

#include "Mix.h"

#include "../Files/Model.h"

#include <array>
#include <cstddef>
#include <vector>

namespace Tool {

// A triangle of the result.
struct Result_triangle
{
  struct Corner
  {
    std::size_t point; // index of a point of the result
    Mix smooth;        // source of attributes without seams
    Mix split;         // source of attributes with seams
  };
  std::array<Corner, 3> corners;
};

// Returns a model with the attributes of points and corners; attributes of polygons are empty. Points are split where
// attributes of points have several values.
// \param with_seams attributes for which the corners have their own values
// \param recomputes_normals whether normals are those of the result; otherwise, they are mixed
Model build_result(const Model& source, const Model::Points& points, const std::vector<Result_triangle>& triangles,
                   const std::vector<const Attribute*>& with_seams, bool recomputes_normals);

} // namespace Tool

#endif // TOOL_CARRY_RESULT_BUILDER_H
