// A filter of edge collapses that keeps lines and pins of a mesh in their places.
#ifndef TOOL_VERBS_LINE_FILTER_H
#define TOOL_VERBS_LINE_FILTER_H

#include "../Carry/Mesh_origins.h"

#include <CGAL/Bspline_shell_3/Soup/Excision_filter.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace Tool {

typedef Mesh::Property_map<Mesh::Edge_index, bool> Edge_marks;

// An edge may replace a part of a line only if all points of the part are within a given distance of the edge. Pins,
// where excised triangles touch the mesh, are kept.
class Line_filter
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
  typedef Kernel::Point_3 Point;

public:
  typedef std::set<Point> Points;

  // \param mesh the mesh before the simplification
  // \param is_line its edges on lines, which change with the mesh
  // \param excised null if there are no excised triangles
  // \param pins vertices that are kept
  Line_filter(const Mesh& mesh, Edge_marks is_line, double distance, const BS::Excised_soup_3* excised,
              const Points& pins)
    : m_is_line(is_line), m_squared_distance(distance * distance), m_pins(pins)
  {
    for(Mesh::Edge_index e : mesh.edges()) {
      const Point &p = mesh.point(mesh.vertex(e, 0)), &q = mesh.point(mesh.vertex(e, 1));
      if(!is_line[e] || p == q) continue;
      m_neighbors[p].push_back(q);
      m_neighbors[q].push_back(p);
    }
    if(excised == nullptr) return;
    for(auto v : excised->pinned_vertices()) m_pins.insert(excised->mesh().point(v));
    for(auto e : excised->pinned_edges())
      for(unsigned int i = 0; i < 2; ++i) m_pins.insert(excised->mesh().point(excised->mesh().vertex(e, i)));
    m_excision.emplace(*excised, BS::New_contacts::REJECTED);
  }

  template <typename Profile, typename Place>
  Place operator()(const Profile& profile, const Place& place) const
  {
    if(!place) return place;
    for(const Point& p : { Point(profile.p0()), Point(profile.p1()) })
      if(*place != p && m_pins.count(p) > 0) return Place();
    if(m_is_line[profile.surface_mesh().edge(profile.v0_v1())] && !keeps_line(profile, *place)) return Place();
    return m_excision ? (*m_excision)(profile, place) : place;
  }

private:
  template <typename Profile>
  bool keeps_line(const Profile& profile, const Point& place) const
  {
    const Mesh& mesh = profile.surface_mesh();
    const bool keeps_first = place == profile.p0();
    const Mesh::Vertex_index removed = keeps_first ? profile.v1() : profile.v0(),
                             kept = keeps_first ? profile.v0() : profile.v1();
    for(Mesh::Halfedge_index h : mesh.halfedges_around_target(mesh.halfedge(removed)))
      if(m_is_line[mesh.edge(h)] && mesh.source(h) != kept)
        return is_near(mesh.point(removed), Kernel::Segment_3(mesh.point(kept), mesh.point(mesh.source(h))));
    return true;
  }

  // Returns whether the part of the initial line through the point, between the ends of the segment, is within the
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

  Edge_marks m_is_line;
  double m_squared_distance;
  std::map<Point, std::vector<Point> > m_neighbors; // on the initial lines
  Points m_pins;
  std::optional<BS::Excision_filter> m_excision;
};

} // namespace Tool

#endif // TOOL_VERBS_LINE_FILTER_H
