// Transfers the colors and the numbers that a mesh stores at its vertices, and the colors of its facets.
#ifndef POLYHEDRON_DEMO_CARRY_PROPERTIES_H
#define POLYHEDRON_DEMO_CARRY_PROPERTIES_H

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>

#include <CGAL/IO/Color.h>

#include <functional>
#include <string>
#include <vector>

struct Carried_properties
{
  std::vector<std::string> names;
  CGAL::Bspline_shells::Transfer_report report; // The report of the last property of vertices.
};

// Transfers the properties from one `Surface_mesh` to another along the integral curves of a shell. Elements without an
// image keep their values.
template <typename Shell, typename Mesh, typename Visitor>
Carried_properties carry_properties(const Shell& shell, const Mesh& source, Mesh& target, Visitor& visitor)
{
  namespace BS = CGAL::Bspline_shells;
  typedef typename Mesh::Vertex_index Vertex;
  typedef typename Mesh::Face_index Facet;
  const BS::Shell_map_3 map(shell, source, target);
  const auto np = BS::parameters::visitor(std::ref(visitor));
  Carried_properties carried;
  const auto carry = [&](const std::string& name, auto type) {
    const auto values = source.template property_map<Vertex, decltype(type)>(name);
    if(!values.second) return;
    const auto result = target.template add_property_map<Vertex, decltype(type)>(name).first;
    carried.report = BS::transfer_vertex_attribute(map, values.first, result, np);
    carried.names.push_back(name);
  };
  for(const std::string& name : source.template properties<Vertex>()) {
    carry(name, CGAL::IO::Color());
    carry(name, double());
    carry(name, float());
  }
  const auto colors = source.template property_map<Facet, CGAL::IO::Color>("f:color");
  if(colors.second) {
    BS::transfer_face_labels(map, colors.first,
                             target.template add_property_map<Facet, CGAL::IO::Color>("f:color").first, np);
    carried.names.push_back("f:color");
  }
  return carried;
}

#endif // POLYHEDRON_DEMO_CARRY_PROPERTIES_H
