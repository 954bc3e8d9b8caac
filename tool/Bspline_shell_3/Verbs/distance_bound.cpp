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
#include <numeric>
#include <set>
#include <vector>

namespace Tool {

namespace {

typedef BS::Projection_target_3<Mesh> Target;
typedef Eigen::Vector3d Vector_3;
typedef std::array<Vector_3, 3> Triangle;

constexpr double excess = 1.01;                                          // largest ratio of a bound and a distance
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon(); // of lengths, relative

template <typename Function>
void for_each_number(std::size_t size, const Function& function)
{
  std::vector<std::size_t> numbers(size);
  std::iota(numbers.begin(), numbers.end(), 0);
  CGAL::for_each<CGAL::Parallel_if_available_tag>(numbers, [&](std::size_t n) {
    function(n);
    return true;
  });
}

// A point, and the facet of the other mesh that is closest to it.
struct Sample
{
  Vector_3 point;
  Target::Index facet;
  double distance;
};

struct One_sided_bound
{
  double distance = 0;
  std::vector<Target::Index> beyond_limit; // facets that are not within the limit
  std::vector<Target::Index> closest;      // facets of the other mesh to which they are closest
};

class Distance_to
{
public:
  Distance_to(const Mesh& mesh, const Target& target, double largest_coordinate, double resolution, double limit)
    : m_mesh(mesh), m_target(target), m_largest_coordinate(largest_coordinate), m_resolution(resolution),
      m_limit((limit - rounding * largest_coordinate) / (1 + rounding))
  {
    m_samples.resize(mesh.num_vertices());
    for_each_number(m_samples.size(), [&](std::size_t n) {
      const auto& p = mesh.point(Mesh::Vertex_index(Mesh::size_type(n)));
      m_samples[n] = sample({ p.x(), p.y(), p.z() });
    });
  }

  // Returns a bound for all facets. Parts of facets are not subdivided if their bound is less than the limit and a
  // known distance.
  One_sided_bound operator()() const
  {
    double farthest = 0;
    for(const Sample& s : m_samples) farthest = (std::max)(farthest, s.distance);
    const double known = (std::max)(excess * farthest, m_resolution);
    std::vector<double> bound(m_mesh.num_faces());
    std::vector<std::vector<Target::Index> > closest(bound.size());
    for_each_number(bound.size(), [&](std::size_t n) {
      std::array<Sample, 3> corners;
      std::size_t i = 0;
      for(auto v : m_mesh.vertices_around_face(m_mesh.halfedge(Mesh::Face_index(Mesh::size_type(n)))))
        corners[i++] = m_samples[v];
      bound[n] = of_triangle(corners, known, closest[n]);
    });
    One_sided_bound result;
    result.distance = *std::max_element(bound.begin(), bound.end()) * (1 + rounding) + rounding * m_largest_coordinate;
    for(std::size_t n = 0; n < bound.size(); ++n)
      if(bound[n] > m_limit) result.beyond_limit.push_back(Target::Index(n));
    for(const auto& list : closest) result.closest.insert(result.closest.end(), list.begin(), list.end());
    return result;
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

  // Parts that are not within the limit add the closest facets to a list.
  double of_triangle(const std::array<Sample, 3>& corners, double known, std::vector<Target::Index>& closest) const
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
      const double sufficient = (std::min)((std::max)(known, bound), m_limit);
      if(of_part <= (std::max)(sufficient, excess * least)) {
        bound = (std::max)(bound, of_part);
        if(of_part > m_limit)
          for(const Sample& s : part) closest.push_back(s.facet);
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
  double m_largest_coordinate, m_resolution, m_limit;
  std::vector<Sample> m_samples; // by vertex
};

} // namespace

Distance_bounds distance_bounds(const Mesh& first, const Mesh& second, double resolution, double limit)
{
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(first) + CGAL::Polygon_mesh_processing::bbox(second);
  double largest = 0; // coordinate
  for(int axis = 0; axis < 3; ++axis)
    largest = (std::max)({ largest, std::abs((box.min)(axis)), std::abs((box.max)(axis)) });
  const Target first_target(first, first.points()), second_target(second, second.points());
  const One_sided_bound to_second = Distance_to(first, second_target, largest, resolution, limit)(),
                        to_first = Distance_to(second, first_target, largest, resolution, limit)();
  std::set<Mesh::Face_index> beyond;
  for(Target::Index n : to_second.beyond_limit) beyond.insert(Mesh::Face_index(Mesh::size_type(n)));
  for(Target::Index n : to_first.closest) beyond.insert(first_target.face_of(n));
  return { to_second.distance, to_first.distance, { beyond.begin(), beyond.end() } };
}

} // namespace Tool
