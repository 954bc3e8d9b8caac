#include "distance_bound.h"
#include "patch_bound.h"

#include "../Carry/closest_weights.h"
#include "../Carry/for_each_number.h"

#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <set>
#include <vector>

namespace Tool {

namespace {

typedef BS::Projection_target_3<Mesh> Target;
typedef Eigen::Vector3d Vector_3;
typedef std::array<Vector_3, 3> Triangle;

constexpr double excess = 1.01;                                          // largest ratio of a bound and a distance
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon(); // relative error of lengths

// A point, and the facet of the other mesh that is closest to it.
struct Sample
{
  Vector_3 point;
  Target::Index facet;
  double distance;
};

typedef std::array<Sample, 3> Part; // of a facet

struct One_sided_bound
{
  double distance = 0;
  std::vector<Target::Index> beyond_limit; // facets that are not within the limit
  std::vector<Target::Index> closest;      // facets of the other mesh to which they are closest
};

class Distance_to
{
public:
  Distance_to(const Mesh& mesh, const Mesh& other, const Target& target, double largest_coordinate, double resolution,
              double limit)
    : m_mesh(mesh), m_other(other), m_target(target), m_largest_coordinate(largest_coordinate),
      m_resolution(resolution), m_limit((limit - rounding * largest_coordinate) / (1 + rounding))
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
    std::vector<double> bound(m_mesh.num_faces());
    for_each_number(bound.size(), [&](std::size_t n) {
      const Part c = corners(n);
      bound[n] = (std::max)(
        { sample((c[0].point + c[1].point + c[2].point) / 3).distance, c[0].distance, c[1].distance, c[2].distance });
    });
    const double known = (std::max)(excess * *std::max_element(bound.begin(), bound.end()), m_resolution);
    std::vector<std::vector<Target::Index> > closest(bound.size());
    for_each_number(bound.size(), [&](std::size_t n) { bound[n] = of_triangle(corners(n), known, closest[n]); });
    One_sided_bound result;
    result.distance = *std::max_element(bound.begin(), bound.end()) * (1 + rounding) + rounding * m_largest_coordinate;
    for(std::size_t n = 0; n < bound.size(); ++n)
      if(bound[n] > m_limit) result.beyond_limit.push_back(Target::Index(n));
    for(const auto& list : closest) result.closest.insert(result.closest.end(), list.begin(), list.end());
    return result;
  }

private:
  Part corners(std::size_t facet) const
  {
    Part result;
    std::size_t i = 0;
    for(auto v : m_mesh.vertices_around_face(m_mesh.halfedge(Mesh::Face_index(Mesh::size_type(facet)))))
      result[i++] = m_samples[v];
    return result;
  }

  Sample sample(const Vector_3& p) const
  {
    const Target::Index facet = m_target.closest({ p[0], p[1], p[2] }).first;
    return { p, facet, distance(p, facet) };
  }

  Triangle triangle(Target::Index facet) const
  {
    Triangle t;
    for(int i = 0; i < 3; ++i) t[std::size_t(i)] = Vector_3(m_target.vertex(facet, i).data());
    return t;
  }

  // Returns the distance from a point of a facet that is close to the closest one.
  double distance(const Vector_3& p, Target::Index facet) const
  {
    const Triangle t = triangle(facet);
    const auto w = closest_weights(p, t);
    return (w[0] * t[0] + w[1] * t[1] + w[2] * t[2] - p).norm();
  }

  // Returns a point between two samples that is about as far from the closest facet of each. The middle is returned if
  // this point is too close to a sample for parts to become smaller.
  Vector_3 split_point(const Sample& s, const Sample& t) const
  {
    constexpr int steps = 20;
    constexpr double least = 0.02; // fraction of the distance between the samples
    double low = 0, high = 1;
    for(int i = 0; i < steps; ++i) {
      const double middle = (low + high) / 2;
      const Vector_3 p = (1 - middle) * s.point + middle * t.point;
      (distance(p, s.facet) < distance(p, t.facet) ? low : high) = middle;
    }
    if(!(low >= least && high <= 1 - least)) low = 0.5;
    return (1 - low) * s.point + low * t.point;
  }

  // Returns the point of a part that is closest to a corner of one of its closest facets, unless it is near the border
  // of the part.
  std::optional<Vector_3> inner_corner(const Part& part) const
  {
    constexpr double least = 0.1; // barycentric coordinate; otherwise, the parts would be slivers
    const Triangle t = { part[0].point, part[1].point, part[2].point };
    for(const Sample& s : part)
      for(int i = 0; i < 3; ++i) {
        const auto w = closest_weights(Vector_3(m_target.vertex(s.facet, i).data()), t);
        if((std::min)({ w[0], w[1], w[2] }) > least) return w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
      }
    return std::nullopt;
  }

  // Splits a part at a corner of the other mesh; or where neither of the facets that are closest to the ends of an edge
  // is within a distance of the whole edge; or in the middle of the longest edge. Short edges are not split, so that
  // parts become smaller.
  void split(const Part& part, double within, std::vector<Part>& parts) const
  {
    const auto add = [&](const Sample& s, std::initializer_list<std::size_t> replaced) {
      for(std::size_t i : replaced) {
        parts.push_back(part);
        parts.back()[i] = s;
      }
    };
    if(const auto corner = inner_corner(part)) return add(sample(*corner), { 0, 1, 2 });
    const auto length = [&](std::size_t i) { return (part[i].point - part[(i + 1) % 3].point).norm(); };
    const auto changes = [&](std::size_t i) {
      const Sample &s = part[i], &t = part[(i + 1) % 3];
      return distance(t.point, s.facet) > within && distance(s.point, t.facet) > within;
    };
    std::size_t longest = 0;
    for(std::size_t i = 1; i < 3; ++i)
      if(length(i) > length(longest)) longest = i;
    std::size_t changing = 3;
    for(std::size_t i = 0; i < 3; ++i)
      if(2 * length(i) >= length(longest) && changes(i) && (changing == 3 || length(i) > length(changing)))
        changing = i;
    const std::size_t i = changing < 3 ? changing : longest, next = (i + 1) % 3;
    add(sample(changing < 3 ? split_point(part[i], part[next]) : Vector_3((part[i].point + part[next].point) / 2)),
        { i, next });
  }

  // Parts that are not within the limit add the closest facets to a list.
  double of_triangle(const Part& corners, double known, std::vector<Target::Index>& closest) const
  {
    double bound = 0;
    std::vector<Part> parts = { corners };
    while(!parts.empty()) {
      const Part part = parts.back();
      parts.pop_back();
      double of_part = std::numeric_limits<double>::infinity();
      for(const Sample& nearest : part) {
        double of_facet = 0;
        for(const Sample& s : part) of_facet = (std::max)(of_facet, distance(s.point, nearest.facet));
        of_part = (std::min)(of_part, of_facet);
      }
      double least = 0;
      for(const Sample& s : part) least = (std::max)(least, s.distance);
      const double sufficient = (std::max)((std::min)((std::max)(known, bound), m_limit), excess * least);
      if(of_part > sufficient) of_part = bound_of_patch(part, sufficient);
      if(of_part <= sufficient) {
        bound = (std::max)(bound, of_part);
        if(of_part > m_limit)
          for(const Sample& s : part) closest.push_back(s.facet);
      } else split(part, sufficient, parts);
    }
    return bound;
  }

  // Returns a bound on the distance of a part from facets that cover it, or infinity. Parts that are not larger than
  // these facets are left to other bounds.
  double bound_of_patch(const Part& part, double within) const
  {
    constexpr double least_ratio = 4; // of areas
    const Triangle t = { part[0].point, part[1].point, part[2].point };
    const Sample center = sample(incenter(t));
    const auto area = [](const Triangle& s) { return (s[1] - s[0]).cross(s[2] - s[0]).norm(); };
    if(!(area(t) >= least_ratio * area(triangle(center.facet)))) return std::numeric_limits<double>::infinity();
    return patch_bound(t, m_other, m_target.face_of(center.facet), center.distance, within,
                       rounding * m_largest_coordinate);
  }

  const Mesh& m_mesh;
  const Mesh& m_other;
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
  const One_sided_bound to_second = Distance_to(first, second, second_target, largest, resolution, limit)(),
                        to_first = Distance_to(second, first, first_target, largest, resolution, limit)();
  std::set<Mesh::Face_index> beyond;
  for(Target::Index n : to_second.beyond_limit) beyond.insert(Mesh::Face_index(Mesh::size_type(n)));
  for(Target::Index n : to_first.closest) beyond.insert(first_target.face_of(n));
  return { to_second.distance, to_first.distance, { beyond.begin(), beyond.end() } };
}

} // namespace Tool
