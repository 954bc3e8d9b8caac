// A filter of edge collapses that keeps a curve of constrained edges close to its initial position.
#ifndef CURVE_FILTER_H
#define CURVE_FILTER_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <map>
#include <vector>

// An edge may replace a part of the curve only if all points of the part are within a given distance of the edge. Since
// the part is connected and has the same end points, all points of the edge are then within this distance of the part.
class Curve_filter
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
  typedef Kernel::Point_3 Point;
  typedef CGAL::Surface_mesh<Point> Mesh;
  typedef Mesh::Property_map<Mesh::Edge_index, bool> Curve;

public:
  // The arguments are the mesh before the simplification, its map of constrained edges, and the distance.
  Curve_filter(const Mesh& mesh, Curve curve, double distance) : m_curve(curve), m_squared_distance(distance * distance)
  {
    for(Mesh::Edge_index e : mesh.edges()) {
      const Point &p = mesh.point(mesh.vertex(e, 0)), &q = mesh.point(mesh.vertex(e, 1));
      if(!curve[e] || p == q) continue;
      m_neighbors[p].push_back(q);
      m_neighbors[q].push_back(p);
    }
  }

  template <typename Profile, typename Place>
  Place operator()(const Profile& profile, const Place& place) const
  {
    const Mesh& mesh = profile.surface_mesh();
    if(!place || !m_curve[mesh.edge(profile.v0_v1())]) return place;
    const bool keeps_first = *place == profile.p0();
    const Mesh::Vertex_index removed = keeps_first ? profile.v1() : profile.v0(),
                             kept = keeps_first ? profile.v0() : profile.v1();
    for(Mesh::Halfedge_index h : mesh.halfedges_around_target(mesh.halfedge(removed)))
      if(m_curve[mesh.edge(h)] && mesh.source(h) != kept)
        return is_near(mesh.point(removed), Kernel::Segment_3(mesh.point(kept), mesh.point(mesh.source(h)))) ? place
                                                                                                             : Place();
    return place;
  }

private:
  // Returns whether the part of the initial curve through the point, between the ends of the segment, is within the
  // distance of the segment.
  bool is_near(const Point& middle, const Kernel::Segment_3& segment) const
  {
    const std::vector<Point>& both = m_neighbors.at(middle);
    if(both.size() != 2 || CGAL::squared_distance(middle, segment) > m_squared_distance) return false;
    for(Point current : both)
      for(Point previous = middle; current != segment.source() && current != segment.target();) {
        const std::vector<Point>& next = m_neighbors.at(current);
        if(next.size() != 2 || current == middle || CGAL::squared_distance(current, segment) > m_squared_distance)
          return false;
        const Point after = next[0] == previous ? next[1] : next[0];
        previous = current;
        current = after;
      }
    return true;
  }

  Curve m_curve;
  double m_squared_distance;
  std::map<Point, std::vector<Point> > m_neighbors; // on the initial curve
};

#endif // CURVE_FILTER_H
