// The point of a triangle that is closest to a point.
#ifndef TOOL_CARRY_CLOSEST_WEIGHTS_H
#define TOOL_CARRY_CLOSEST_WEIGHTS_H

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace Tool {

// Returns barycentric coordinates that are not negative, up to the rounding of their sum. Their point is the closest
// one up to rounding errors, which are large only for degenerate triangles.
inline std::array<double, 3> closest_weights(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& triangle)
{
  const Eigen::Vector3d u = triangle[1] - triangle[0], v = triangle[2] - triangle[0], w = p - triangle[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w), d = uu * vv - uv * uv;
  if(d > 0) {
    const double b = (vv * uw - uv * vw) / d, c = (uu * vw - uv * uw) / d;
    if(b >= 0 && c >= 0 && b + c <= 1) return { 1 - b - c, b, c };
  }
  std::array<double, 3> best = { 1, 0, 0 };
  double least = -1;
  for(std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Eigen::Vector3d e = triangle[j] - triangle[i];
    const double length = e.squaredNorm();
    const double t = length > 0 ? (std::min)((std::max)(e.dot(p - triangle[i]) / length, 0.), 1.) : 0;
    const double distance = (triangle[i] + t * e - p).squaredNorm();
    if(least >= 0 && !(distance < least)) continue;
    least = distance;
    best = {};
    best[i] = 1 - t;
    best[j] = t;
  }
  return best;
}

} // namespace Tool

#endif // TOOL_CARRY_CLOSEST_WEIGHTS_H
