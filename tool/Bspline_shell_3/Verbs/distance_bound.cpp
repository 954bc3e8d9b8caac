#include "distance_bound.h"

#include "../Carry/closest_weights.h"

#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/for_each.h>
#include <CGAL/tags.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace Tool {

namespace {

typedef BS::Projection_target_3<Mesh> Target;
typedef Eigen::Vector3d Vector_3;
typedef std::array<Vector_3, 3> Triangle;

// A point, and the facet of the other mesh that is closest to it.
struct Sample
{
  Vector_3 point;
  Target::Index facet;
  double distance;
};

class One_sided_bound
{
public:
  One_sided_bound(const Mesh& mesh, const Target& target, double largest_coordinate, double resolution)
    : m_mesh(mesh), m_target(target), m_largest_coordinate(largest_coordinate), m_resolution(resolution)
  {
    m_samples.resize(mesh.num_vertices());
    std::vector<std::size_t> numbers(mesh.num_vertices());
    for(std::size_t n = 0; n < numbers.size(); ++n) numbers[n] = n;
    CGAL::for_each<CGAL::Parallel_if_available_tag>(numbers, [&](std::size_t& n) {
      const auto& p = mesh.point(Mesh::Vertex_index(Mesh::size_type(n)));
      m_samples[n] = sample({ p.x(), p.y(), p.z() });
      return true;
    });
  }

  double farthest_vertex() const
  {
    double farthest = 0;
    for(const Sample& s : m_samples) farthest = (std::max)(farthest, s.distance);
    return farthest;
  }

  // Returns a bound for all facets. Parts of facets are not subdivided if their bound is less than a known distance.
  double operator()() const
  {
    constexpr double excess = 1.01, rounding = 64 * std::numeric_limits<double>::epsilon();
    std::vector<double> bound(m_mesh.num_faces());
    std::vector<std::size_t> numbers(bound.size());
    for(std::size_t n = 0; n < numbers.size(); ++n) numbers[n] = n;
    const double known = (std::max)(excess * farthest_vertex(), m_resolution);
    CGAL::for_each<CGAL::Parallel_if_available_tag>(numbers, [&](std::size_t& n) {
      std::array<Sample, 3> corners;
      std::size_t i = 0;
      for(auto v : m_mesh.vertices_around_face(m_mesh.halfedge(Mesh::Face_index(Mesh::size_type(n)))))
        corners[i++] = m_samples[v];
      bound[n] = of_triangle(corners, known, excess);
      return true;
    });
    return *std::max_element(bound.begin(), bound.end()) * (1 + rounding) + rounding * m_largest_coordinate;
  }

private:
  Sample sample(const Vector_3& p) const
  {
    const Target::Index facet = m_target.closest({ p[0], p[1], p[2] }).first;
    return { p, facet, distance(p, facet) };
  }

  // Returns the distance from a point of a facet that is close to the closest one.
  double distance(const Vector_3& p, Target::Index facet) const
  {
    Triangle t;
    for(int i = 0; i < 3; ++i) t[std::size_t(i)] = Vector_3(m_target.vertex(facet, i).data());
    const auto w = closest_weights(p, t);
    return (w[0] * t[0] + w[1] * t[1] + w[2] * t[2] - p).norm();
  }

  double of_triangle(const std::array<Sample, 3>& corners, double known, double excess) const
  {
    double bound = 0;
    std::vector<std::array<Sample, 3> > parts = { corners };
    while(!parts.empty()) {
      const std::array<Sample, 3> part = parts.back();
      parts.pop_back();
      double of_part = std::numeric_limits<double>::infinity();
      for(const Sample& nearest : part) {
        double of_facet = 0;
        for(const Sample& s : part) of_facet = (std::max)(of_facet, distance(s.point, nearest.facet));
        of_part = (std::min)(of_part, of_facet);
      }
      double least = 0;
      for(const Sample& s : part) least = (std::max)(least, s.distance);
      if(of_part <= (std::max)({ known, bound, excess * least })) {
        bound = (std::max)(bound, of_part);
        continue;
      }
      std::size_t longest = 0;
      const auto length = [&](std::size_t i) { return (part[i].point - part[(i + 1) % 3].point).squaredNorm(); };
      for(std::size_t i = 1; i < 3; ++i)
        if(length(i) > length(longest)) longest = i;
      const std::size_t next = (longest + 1) % 3;
      const Sample middle = sample((part[longest].point + part[next].point) / 2);
      parts.push_back(part);
      parts.back()[longest] = middle;
      parts.push_back(part);
      parts.back()[next] = middle;
    }
    return bound;
  }

  const Mesh& m_mesh;
  const Target& m_target;
  double m_largest_coordinate, m_resolution;
  std::vector<Sample> m_samples; // by vertex
};

} // namespace

Distance_bounds distance_bounds(const Mesh& first, const Mesh& second, double resolution)
{
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(first) + CGAL::Polygon_mesh_processing::bbox(second);
  double largest = 0; // coordinate
  for(int axis = 0; axis < 3; ++axis)
    largest = (std::max)({ largest, std::abs((box.min)(axis)), std::abs((box.max)(axis)) });
  const Target first_target(first, first.points()), second_target(second, second.points());
  return { One_sided_bound(first, second_target, largest, resolution)(),
           One_sided_bound(second, first_target, largest, resolution)() };
}

} // namespace Tool
