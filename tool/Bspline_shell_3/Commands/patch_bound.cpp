#include "patch_bound.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_set>
#include <vector>

namespace Tool {

namespace {

typedef Eigen::Vector3d Vector_3;
typedef Eigen::Vector2d Vector_2;
typedef std::array<Vector_3, 3> Triangle;

// The triangle in coordinates whose first two are those of the projection along its normal, and the third is the
// height.
class Projection
{
public:
  explicit Projection(const Triangle& triangle) : m_origin(triangle[0])
  {
    // The axes are orthonormal even if rounding turns the normal of a narrow triangle.
    const Vector_3 side = triangle[1] - triangle[0], normal = side.cross(triangle[2] - triangle[0]);
    const Vector_3 x = side.normalized(), y = normal.cross(x).normalized();
    m_axes << x.transpose(), y.transpose(), x.cross(y).transpose();
    double area = 0, perimeter = 0;
    for(std::size_t i = 0; i < 3; ++i) {
      const Vector_3 p = (*this)(triangle[i]), q = (*this)(triangle[(i + 1) % 3]);
      const Vector_2 edge = (q - p).head<2>();
      m_corners[i] = p.head<2>();
      m_normals[i] = Vector_2(-edge.y(), edge.x()).normalized();
      lowest = (std::min)(lowest, p.z());
      highest = (std::max)(highest, p.z());
      perimeter += edge.norm();
      area += (p.x() * q.y() - p.y() * q.x()) / 2;
    }
    inradius = 2 * area / perimeter;
    for(std::size_t i = 0; i < 3; ++i) {
      const double cosine = -m_normals[i].dot(m_normals[(i + 2) % 3]); // of the angle at corner i
      spread = (std::max)(spread, std::sqrt(2 / (1 - cosine)));
    }
  }

  Vector_3 operator()(const Vector_3& p) const { return m_axes * (p - m_origin); }
  Vector_3 operator()(const Mesh::Point& p) const { return (*this)(Vector_3(p.x(), p.y(), p.z())); }

  // Returns whether two points are on the outer side of a line at this distance inside one of the edges.
  bool are_outside(const Vector_3& p, const Vector_3& q, double depth) const
  {
    for(std::size_t i = 0; i < 3; ++i)
      if(m_normals[i].dot(p.head<2>() - m_corners[i]) <= depth && m_normals[i].dot(q.head<2>() - m_corners[i]) <= depth)
        return true;
    return false;
  }

  double lowest = 0, highest = 0; // heights of the corners; not zero because of rounding
  double inradius = 0;
  // A point of the triangle is within this multiple of a depth of a point at least so deep inside.
  double spread = 0;

private:
  Vector_3 m_origin;
  Eigen::Matrix3d m_axes;
  std::array<Vector_2, 3> m_corners, m_normals; // normals of the edges from the corners; they point inside
};

} // namespace

double patch_bound(const Triangle& triangle, const Mesh& mesh, Mesh::Face_index start, double distance, double within,
                   double rounding)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double share = 0.25; // of the bound, for the distance from the shrunk triangle; 97 % remain for heights
  const Projection projection(triangle);
  const double depth = share * within / projection.spread;
  // Edges are left out if they are outside at half of the depth, so that rounding has no effect.
  if(!(projection.inradius > depth + distance + rounding && depth > 4 * rounding)) return infinity;
  double height = 0, sign = 0; // largest difference of heights, and orientation of the facets
  std::unordered_set<Mesh::size_type> reached = { start };
  std::vector<Mesh::Face_index> facets = { start };
  while(!facets.empty()) {
    const auto h = mesh.halfedge(facets.back());
    facets.pop_back();
    const std::array<Mesh::Halfedge_index, 3> sides = { h, mesh.next(h), mesh.prev(h) };
    Triangle t;
    for(std::size_t i = 0; i < 3; ++i) {
      t[i] = projection(mesh.point(mesh.source(sides[i])));
      height = (std::max)({ height, t[i].z() - projection.lowest, projection.highest - t[i].z() });
    }
    if(!(std::hypot(height, share * within) <= within)) return infinity;
    const Vector_2 a = (t[1] - t[0]).head<2>(), b = (t[2] - t[0]).head<2>();
    const double determinant = a.x() * b.y() - a.y() * b.x();
    const double error = 16 * rounding * (a.lpNorm<1>() + b.lpNorm<1>() + rounding);
    if(sign == 0) sign = determinant > 0 ? 1 : -1;
    if(!(sign * determinant > error)) return infinity;
    for(std::size_t i = 0; i < 3; ++i) {
      if(projection.are_outside(t[i], t[(i + 1) % 3], depth / 2)) continue;
      const auto other = mesh.opposite(sides[i]);
      if(mesh.is_border(other)) return infinity;
      if(reached.insert(mesh.face(other)).second) facets.push_back(mesh.face(other));
    }
  }
  return std::hypot(height, share * within);
}

Eigen::Vector3d incenter(const Triangle& triangle)
{
  Vector_3 sum = Vector_3::Zero();
  double perimeter = 0;
  for(std::size_t i = 0; i < 3; ++i) {
    const double opposite = (triangle[(i + 1) % 3] - triangle[(i + 2) % 3]).norm();
    sum += opposite * triangle[i];
    perimeter += opposite;
  }
  return sum / perimeter;
}

} // namespace Tool
