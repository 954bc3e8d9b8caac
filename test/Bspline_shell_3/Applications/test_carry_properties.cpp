// carry_properties.h of the plugin for the Polyhedron demo: the target gets the values of the source's points on the
// same curves.
#include "../../../examples/polyhedron_demo/carry_properties.h"
#include "test_meshes.h"

#include <CGAL/certified_bspline_shell_3.h>

#include <cmath>
#include <string>
#include <vector>

namespace test_carry_properties {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef Mesh::Vertex_index Vertex;
typedef Mesh::Face_index Facet;

const CGAL::IO::Color above(255, 0, 0), below(0, 0, 255);

template <typename Value, typename Function>
void add_vertex_values(Mesh& mesh, const char* name, const Function& value)
{
  auto values = mesh.add_property_map<Vertex, Value>(name).first;
  for(auto v : mesh.vertices()) values[v] = value(mesh.point(v));
}

TEST_CASE("carried properties: numbers and colors on a sphere are those of the nearby points of another sphere")
{
  Mesh source = sphere(3), target = sphere(2);
  add_vertex_values<double>(source, "v:height", [](const Point_3& p) { return p.z(); });
  add_vertex_values<float>(source, "v:single", [](const Point_3& p) { return float(p.x()); });
  add_vertex_values<int>(source, "v:label", [](const Point_3&) { return 7; });
  add_vertex_values<CGAL::IO::Color>(source, "v:color", [](const Point_3& p) { return p.z() > 0 ? above : below; });
  auto labels = source.add_property_map<Facet, CGAL::IO::Color>("f:color").first;
  for(auto f : source.faces()) labels[f] = centroid(source, f).z() > 0 ? above : below;
  // The coarse sphere lies inside the fine one, by up to 0.04.
  const auto shell = CGAL::certified_bspline_shell_3(source, BS::parameters::relative_thickness(0.08));
  REQUIRE(shell.is_certified());

  BS::Default_flow_visitor visitor;
  const Carried_properties carried = carry_properties(shell, source, target, visitor);
  CHECK(carried.names == std::vector<std::string>{ "v:height", "v:single", "v:color", "f:color" });
  CHECK(carried.report);
  CHECK_FALSE(target.property_map<Vertex, int>("v:label").second);

  const auto height = target.property_map<Vertex, double>("v:height").first;
  const auto single = target.property_map<Vertex, float>("v:single").first;
  const auto color = target.property_map<Vertex, CGAL::IO::Color>("v:color").first;
  const double tolerance = 0.02; // The curves are nearly radial, and facets of the source are flat.
  const double edge = 0.16;      // longest edge of the source, within which colors are interpolated
  for(auto v : target.vertices()) {
    const Point_3& p = target.point(v);
    CHECK(std::abs(height[v] - p.z()) < tolerance);
    CHECK(std::abs(single[v] - p.x()) < tolerance);
    if(std::abs(p.z()) > edge) CHECK(color[v] == (p.z() > 0 ? above : below));
  }
  const auto label = target.property_map<Facet, CGAL::IO::Color>("f:color").first;
  for(auto f : target.faces()) {
    const double z = centroid(target, f).z();
    if(std::abs(z) > 2 * edge) CHECK(label[f] == (z > 0 ? above : below));
  }
}

TEST_CASE("carried properties: vertices outside of the shell are reported, and keep their values")
{
  Mesh source = sphere(2), target = sphere(2, 2);
  add_vertex_values<double>(source, "v:height", [](const Point_3& p) { return p.z(); });
  add_vertex_values<double>(target, "v:height", [](const Point_3&) { return 5; });
  const auto shell = CGAL::certified_bspline_shell_3(source);
  BS::Default_flow_visitor visitor;
  const Carried_properties carried = carry_properties(shell, source, target, visitor);
  CHECK(carried.report.transferred == 0);
  CHECK(carried.report.failures.size() == target.number_of_vertices());
  const auto height = target.property_map<Vertex, double>("v:height").first;
  for(auto v : target.vertices()) CHECK(height[v] == 5);
}

} // namespace
} // namespace test_carry_properties
