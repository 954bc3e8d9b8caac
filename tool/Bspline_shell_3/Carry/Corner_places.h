// The places on the source of a map from which the corners of its target get values.
#ifndef TOOL_CARRY_CORNER_PLACES_H
#define TOOL_CARRY_CORNER_PLACES_H

#include "Mesh_origins.h"

#include <CGAL/Bspline_shell_3/Transfer/transfer_corner_attribute.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace Tool {

// A point of a facet of the source, as weights of its corners (halfedges to them). Places are transferred instead of
// values, so that one transfer serves all attributes.
struct Place
{
  typedef Mesh::Halfedge_index Halfedge;
  std::array<Halfedge, 3> corner;
  std::array<double, 3> weight = {};
  std::size_t group = 0; // corners at a vertex with equal values have the same

  bool operator==(const Place& other) const { return group == other.group; }
};

// Interpolates the places of the corners of a facet.
struct Place_interpolation
{
  Place operator()(const std::array<Place, 3>& corners, const std::array<double, 3>& weights) const
  {
    return { { corners[0].corner[0], corners[1].corner[0], corners[2].corner[0] }, weights };
  }
};

// Finds the places of all corners of the target. At vertices that did not move, these are the corners of the source.
template <typename Map>
class Corner_places
{
public:
  explicit Corner_places(const Map& map) : m_map(map) {}

  // Returns the place of each vertex of the target. `missed` is the number of vertices without an image, which get the
  // nearest places.
  std::vector<Place> of_vertices(std::size_t& missed) const
  {
    const Mesh& target = m_map.target();
    std::vector<Place> places(target.num_vertices());
    const auto source_place = boost::make_function_property_map<Mesh::Vertex_index>([this](Mesh::Vertex_index v) {
      auto h = m_map.source().halfedge(v);
      if(m_map.source().is_border(h)) h = m_map.source().prev(m_map.source().opposite(h));
      return at_corner(h, 0);
    });
    const auto report = BS::transfer_vertex_attribute(
      m_map, source_place, boost::make_iterator_property_map(places.begin(), get(boost::vertex_index, target)),
      BS::parameters::interpolation(Place_interpolation()));
    missed = report.failures.size();
    for(const auto& failure : report.failures) {
      const Mesh::Vertex_index v = Mesh::Vertex_index(Mesh::size_type(failure.first));
      places[v] = nearest(target.point(v));
    }
    for(auto v : target.vertices()) snap(places[v], target.point(v));
    return places;
  }

  // Returns the place of each corner of the target, by halfedge. Facets are not stretched across seams of the groups.
  // `across` is the number of facets that lie across one.
  std::vector<Place> of_corners(const std::vector<std::size_t>& group, std::size_t& across) const
  {
    const Mesh& target = m_map.target();
    std::vector<Place> places(target.num_halfedges());
    const auto source_place = boost::make_function_property_map<Mesh::Halfedge_index>(
      [&](Mesh::Halfedge_index h) { return at_corner(h, m_map.source().is_border(h) ? 0 : group[h]); });
    const auto report = BS::transfer_corner_attribute(
      m_map, source_place, boost::make_iterator_property_map(places.begin(), get(boost::halfedge_index, target)),
      BS::parameters::interpolation(Place_interpolation()));
    across = report.facets_across_seams.size();
    for(const auto& failure : report.failures)
      for(auto h : target.halfedges_around_face(target.halfedge(Mesh::Face_index(Mesh::size_type(failure.first)))))
        places[h] = nearest(target.point(target.target(h)));
    for(auto f : target.faces())
      for(auto h : target.halfedges_around_face(target.halfedge(f))) snap(places[h], target.point(target.target(h)));
    return places;
  }

  // Returns the place that is nearest to a point.
  Place nearest(const Mesh::Point& p) const
  {
    const auto& source = m_map.to_source().target();
    const auto closest = source.closest({ p.x(), p.y(), p.z() });
    return { corners_of(m_map.source(), source.face_of(closest.first)), closest.second };
  }

private:
  static Place at_corner(Mesh::Halfedge_index h, std::size_t group) { return { { h, h, h }, { 1, 0, 0 }, group }; }

  // Replaces a place by a corner of the source at exactly this point.
  void snap(Place& place, const Mesh::Point& p) const
  {
    const auto largest = std::max_element(place.weight.begin(), place.weight.end());
    const Mesh::Halfedge_index h = place.corner[std::size_t(largest - place.weight.begin())];
    if(m_map.source().point(m_map.source().target(h)) == p) place = at_corner(h, 0);
  }

  const Map& m_map;
};

} // namespace Tool

#endif // TOOL_CARRY_CORNER_PLACES_H
