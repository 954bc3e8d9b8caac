// A filter of edge collapses that keeps vertices: pins, and those where excised triangles touch the mesh.
#ifndef TOOL_COMMANDS_PIN_FILTER_H
#define TOOL_COMMANDS_PIN_FILTER_H

#include "../Carry/Mesh_origins.h"

#include <CGAL/Bspline_shell_3/Soup/Excision_filter.h>

#include <memory>
#include <optional>
#include <set>

namespace Tool {

class Pin_filter
{
  typedef Mesh::Point Point;

public:
  // \param excised null if there are no excised triangles
  Pin_filter(const BS::Excised_soup_3* excised, const std::set<Point>& other_pins)
  {
    auto pins = std::make_shared<std::set<Point> >(other_pins);
    m_pins = pins;
    if(excised == nullptr) return;
    for(auto v : excised->pinned_vertices()) pins->insert(excised->mesh().point(v));
    for(auto e : excised->pinned_edges())
      for(unsigned int i = 0; i < 2; ++i) pins->insert(excised->mesh().point(excised->mesh().vertex(e, i)));
    m_excision.emplace(*excised, BS::New_contacts::REJECTED);
  }

  template <typename Profile, typename Place>
  Place operator()(const Profile& profile, const Place& place) const
  {
    if(!place) return place;
    for(const Point& p : { Point(profile.p0()), Point(profile.p1()) })
      if(*place != p && m_pins->count(p) > 0) return Place();
    return m_excision ? (*m_excision)(profile, place) : place;
  }

private:
  std::shared_ptr<const std::set<Point> > m_pins;
  std::optional<BS::Excision_filter> m_excision;
};

} // namespace Tool

#endif // TOOL_COMMANDS_PIN_FILTER_H
