#include "Mapped_parts.h"
#include "for_each_number.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>

#include <CGAL/Polygon_mesh_processing/measure.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <set>

namespace Tool {

namespace {

typedef Mesh::Point Point;

// Maps points to the mesh of the shell and back.
class Round_trip
{
public:
  Round_trip(const BS::Shell_of_soup_3& found, const Mesh& mesh)
    : m_there(found.shell(), found.mesh()), m_back(found.shell(), mesh)
  {}

  bool returns(const Point& p) const
  {
    constexpr double factor = 100; // errors of both ways, and of curves that approach each other
    const auto there = m_there(p);
    if(!there) return false;
    const auto back = m_back(there.point);
    const double distance = factor * m_back.tolerance();
    return back && CGAL::squared_distance(Point(back.point[0], back.point[1], back.point[2]), p) <= distance * distance;
  }

private:
  BS::Shell_projection_3<Shell, Mesh> m_there, m_back;
};

} // namespace

Mapped_parts mapped_parts(const Model_map& map)
{
  const Mesh& mesh = map.mesh();
  const BS::Shell_of_soup_3& found = map.found();
  Mapped_parts parts;
  parts.of_vertices.assign(mesh.num_vertices(), Mapped::NEAREST);
  parts.of_facets.assign(mesh.num_faces(), Mapped::NEAREST);
  parts.area[std::size_t(Mapped::NEAREST)] = 1;
  if(found.certification() == BS::Certification::NONE) return parts;

  const Shell& shell = found.shell();
  BS::Shell_certificate_3<Shell::Field, Shell::Threshold> certificate(shell);
  parts.is_certified = certificate.verify(mesh);
  std::vector<char> is_proved(mesh.num_faces(), parts.is_certified);
  std::optional<Round_trip> trip;
  if(!parts.is_certified) {
    trip.emplace(found, mesh);
    const BS::Shell_facet_oracle_3<Shell::Field, Shell::Threshold> oracle(shell);
    for_each_number(is_proved.size(), [&](std::size_t n) {
      const auto h = mesh.halfedge(Mesh::Face_index(Mesh::size_type(n)));
      is_proved[n] = oracle(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                            mesh.point(mesh.target(mesh.next(h))))
                     == BS::Placement_verdict::ACCEPTED;
    });
  }
  std::set<std::size_t> excised; // polygons
  if(found.excised)
    for(std::size_t t : found.excised->excised_triangles()) excised.insert(found.excised->soup().polygon_of[t]);

  map.visit([&](const auto& m) {
    const auto& target = m.to_target().target();
    const auto state = [&](const std::array<double, 3>& traced) {
      const Point p(traced[0], traced[1], traced[2]);
      if(shell.bounded_side(p) == CGAL::ON_UNBOUNDED_SIDE) return Mapped::NEAREST;
      const auto image = m.to_source()(p);
      const bool is_exact = image && (found.proxy || !image.is_continued)
                            && excised.count(map.origins().polygon_of(image.location.first)) == 0;
      return is_exact && (!trip || trip->returns(p)) ? Mapped::ONE_TO_ONE : Mapped::CONTINUED;
    };
    for_each_number(parts.of_vertices.size(),
                    [&](std::size_t n) { parts.of_vertices[n] = state(target.traced_vertices()[n]); });
    for_each_number(parts.of_facets.size(), [&](std::size_t n) {
      constexpr std::array<double, 3> center = { 1 / 3., 1 / 3., 1 / 3. };
      parts.of_facets[n] = (std::max)(state(target.traced_point(BS::Projection_facets_3::Index(n), center)),
                                      is_proved[n] ? Mapped::ONE_TO_ONE : Mapped::CONTINUED);
    });
  });
  for(auto f : mesh.faces())
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      parts.of_facets[f] = (std::max)(parts.of_facets[f], parts.of_vertices[v]);
  for(auto f : mesh.faces())
    if(!is_proved[f])
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        parts.of_vertices[v] = (std::max)(parts.of_vertices[v], Mapped::CONTINUED);
  parts.area = {};
  for(auto f : mesh.faces())
    parts.area[std::size_t(parts.of_facets[f])] += CGAL::Polygon_mesh_processing::face_area(f, mesh);
  const double area = std::accumulate(parts.area.begin(), parts.area.end(), 0.);
  for(double& share : parts.area) share /= area;
  return parts;
}

} // namespace Tool
