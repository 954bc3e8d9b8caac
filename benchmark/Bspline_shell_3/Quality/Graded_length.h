// Edge lengths that vary over the mesh: shorter where a mesh is thin, or where the level sets of its shell's field are
// curved.
#ifndef BENCHMARK_GRADED_LENGTH_H
#define BENCHMARK_GRADED_LENGTH_H

#include "../meshes_in_shell.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <boost/container_hash/hash.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

// A length for each cell of a grid around the mesh. Between neighboring cells, it grows by at most 0.3 of the distance,
// so that facet sizes vary gradually.
class Graded_length
{
  typedef std::array<int, 3> Cell;
public:
  // `sizes` at points are scaled: a quarter of them give lengths below the geometric mean of both bounds.
  Graded_length(const std::vector<Kernel::Point_3>& points, const std::vector<double>& sizes, double least, double most)
    : m_width(least / 2)
  {
    std::vector<double> sorted = sizes;
    const auto quartile = sorted.begin() + std::ptrdiff_t(sorted.size() / 4);
    std::nth_element(sorted.begin(), quartile, sorted.end());
    const double scale = std::sqrt(least * most) / *quartile;
    for(std::size_t n = 0; n < points.size(); ++n) {
      double& length = m_lengths.emplace(cell(points[n]), most).first->second;
      length = (std::min)(length, (std::max)(least, scale * sizes[n]));
    }
    typedef std::pair<double, Cell> Item;
    std::priority_queue<Item, std::vector<Item>, std::greater<Item> > queue;
    for(const auto& known : m_lengths) queue.emplace(known.second, known.first);
    while(!queue.empty()) {
      const Item item = queue.top();
      queue.pop();
      if(item.first > m_lengths.at(item.second)) continue;
      visit_cells(item.second, 1, [&](const Cell& c, int squared_steps) {
        const auto found = m_lengths.find(c);
        const double length = item.first + 0.3 * m_width * std::sqrt(double(squared_steps));
        if(found != m_lengths.end() && length < found->second) queue.emplace(found->second = length, c);
      });
    }
  }

  double operator()(const Kernel::Point_3& p) const
  {
    double length = std::numeric_limits<double>::infinity();
    for(int radius = 0; std::isinf(length); ++radius) // edges are near the mesh
      visit_cells(cell(p), radius, [&](const Cell& c, int) {
        const auto found = m_lengths.find(c);
        if(found != m_lengths.end()) length = (std::min)(length, found->second);
      });
    return length;
  }

private:
  Cell cell(const Kernel::Point_3& p) const
  {
    return { int(std::floor(p.x() / m_width)), int(std::floor(p.y() / m_width)), int(std::floor(p.z() / m_width)) };
  }

  template <typename Visitor>
  static void visit_cells(const Cell& center, int radius, const Visitor& visit)
  {
    for(int i = -radius; i <= radius; ++i)
      for(int j = -radius; j <= radius; ++j)
        for(int k = -radius; k <= radius; ++k)
          visit({ center[0] + i, center[1] + j, center[2] + k }, i * i + j * j + k * k);
  }

  double m_width;
  std::unordered_map<Cell, double, boost::hash<Cell> > m_lengths;
};

// Returns the root of the least radius of curvature: chords with a length proportional to it have the same distance
// from arcs.
inline double root_of_least_radius(const Shell::Field& field, const Kernel::Point_3& p)
{
  const auto g = *field.gradient(p);
  const Eigen::Vector3d gradient(g.x(), g.y(), g.z()), normal = gradient.normalized();
  const Eigen::Matrix3d tangent_plane = Eigen::Matrix3d::Identity() - normal * normal.transpose();
  const Eigen::Matrix3d form = tangent_plane * *field.hessian(p) * tangent_plane;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> curvatures(form, Eigen::EigenvaluesOnly);
  return std::sqrt(gradient.norm() / curvatures.eigenvalues().cwiseAbs().maxCoeff());
}

#endif // BENCHMARK_GRADED_LENGTH_H
