// The load case of elastic_proxy.cpp: facets at one end of the longest axis of the mesh are held. Facets at the other
// end are moved as if the mesh were bent to a circular arc.
#ifndef BEND_ENDS_H
#define BEND_ENDS_H

#include "Neo_hookean_solid.h"

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

enum class End
{
  NONE,
  HELD,
  MOVED
};

template <typename Point>
Eigen::Vector3d to_Eigen(const Point& p)
{
  return { p[0], p[1], p[2] };
}

class Bend
{
public:
  // Bends the box of a mesh by an angle, in radians.
  template <typename Mesh>
  Bend(const Mesh& mesh, double angle) : m_angle(angle)
  {
    const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
    for(int i = 0; i < 3; ++i) {
      m_low[i] = (box.min)(i);
      m_high[i] = (box.max)(i);
    }
    // The longest axis is bent toward the shortest one.
    const Eigen::Vector3d size = m_high - m_low;
    size.maxCoeff(&m_along);
    m_towards = (m_along + 1) % 3;
    if(size[(m_along + 2) % 3] < size[m_towards]) m_towards = (m_along + 2) % 3;
  }

  double length() const { return m_high[m_along] - m_low[m_along]; }

  // Labels facets at the ends of the longest axis, up to the fraction `part` of its length, as End::HELD or End::MOVED.
  template <typename Mesh, typename LabelMap>
  void label_ends(const Mesh& mesh, LabelMap labels, double part = 0.05) const
  {
    for(auto f : mesh.faces()) {
      double sum = 0;
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) sum += mesh.point(v)[m_along];
      const double x = (sum / 3 - m_low[m_along]) / length();
      put(labels, f, x < part ? End::HELD : x > 1 - part ? End::MOVED : End::NONE);
    }
  }

  // Returns the position of a point of the moved end at the load t: the end of an arc as long as the bounding box.
  Eigen::Vector3d operator()(const Eigen::Vector3d& p, double t) const
  {
    const double angle = t * m_angle;
    if(angle == 0) return p;
    Eigen::Vector3d pivot = (m_low + m_high) / 2, arrival = pivot;
    pivot[m_along] = m_high[m_along];
    arrival[m_along] = m_low[m_along] + length() * std::sin(angle) / angle;
    arrival[m_towards] += length() * (1 - std::cos(angle)) / angle;
    return arrival
           + Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(m_along).cross(Eigen::Vector3d::Unit(m_towards)))
               * (p - pivot);
  }

private:
  Eigen::Vector3d m_low, m_high;
  double m_angle;
  int m_along = 0, m_towards = 0;
};

// Returns the corners of a facet in the order of barycentric coordinates, beginning with the source of its halfedge.
template <typename Mesh>
std::array<std::size_t, 3> corners(const Mesh& mesh, typename Mesh::Face_index f)
{
  const auto h = mesh.halfedge(f);
  return { std::size_t(mesh.source(h)), std::size_t(mesh.target(h)), std::size_t(mesh.target(mesh.next(h))) };
}

// Solves the problem on tetrahedra that fill a mesh, with conditions at labeled facets. The first nodes must be the
// vertices of the mesh, in their order.
template <typename Solid, typename Mesh, typename LabelMap>
typename Solid::Result bend(const Solid& solid, const Mesh& mesh, LabelMap labels, const Bend& motion,
                            unsigned int load_steps)
{
  std::vector<End> end(solid.number_of_nodes(), End::NONE);
  for(auto f : mesh.faces())
    if(get(labels, f) != End::NONE)
      for(std::size_t n : solid.facet_nodes(corners(mesh, f))) end[n] = get(labels, f);
  std::vector<typename Solid::Condition> conditions;
  for(std::size_t n = 0; n < end.size(); ++n)
    if(end[n] != End::NONE) conditions.push_back({ n });
  typename Solid::Options options;
  options.load_steps = load_steps;
  return solid.solve(
    conditions,
    [&](std::size_t n, double t) -> Eigen::Vector3d {
      const Eigen::Vector3d& p = solid.node(n);
      return (end[n] == End::MOVED ? motion(p, t) : p) - p;
    },
    options);
}

#endif // BEND_ENDS_H
