// Builds a proxy of polygons that intersect, have gaps, or are inconsistently oriented, with a certified shell.
// Simplifies the proxy in the shell. Transfers the part numbers and texture coordinates of the polygons to the proxy,
// and a scalar from the proxy back to the polygons.
#include "broken_models.h"
#include "example_files.h"

#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Soup/sample_soup_shares.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_corner_attribute.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>
#include <CGAL/certified_soup_proxy_3.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>

typedef BS::Soup_proxy_3::Mesh Mesh;
typedef CGAL::Exact_predicates_inexact_constructions_kernel::Vector_2 Vector_2;

// A property map with the texture coordinates of the corners of the soup's mesh, found by polygon and point.
struct Texture_of_corner
{
  typedef Mesh::Halfedge_index key_type;
  typedef Vector_2 value_type, reference;
  typedef boost::readable_property_map_tag category;

  friend Vector_2 get(const Texture_of_corner& map, Mesh::Halfedge_index h)
  {
    const std::size_t polygon = map.soup->polygon_of(map.soup->mesh().face(h)),
                      point = map.soup->point_of(map.soup->mesh().target(h));
    const auto& points = map.model->soup.polygons[polygon];
    const auto& uv = map.model
                       ->texture[polygon][std::size_t(std::find(points.begin(), points.end(), point) - points.begin())];
    return Vector_2(uv[0], uv[1]);
  }

  const Broken_model* model;
  const BS::Soup_mesh_3* soup;
};

int main(int argc, char** argv)
{
  std::string name = "figure";
  const Arguments arguments = Arguments("Usage: soup_proxy [balls | figure | part]\n").optional(name);
  if(const auto code = arguments.read(argc, argv)) return *code;
  const Broken_model model = name == "balls"    ? two_balls()
                             : name == "figure" ? figure()
                             : name == "part"   ? machine_part()
                                                : Broken_model();
  if(model.soup.polygons.empty()) return *arguments.wrong("There is no model " + name + ".");
  const BS::Soup_proxy_3 proxy = CGAL::certified_soup_proxy_3(model.soup.points, model.soup.polygons);
  std::cout << proxy.message() << "\n";
  if(!proxy.is_certified()) return EXIT_FAILURE;
  const BS::Soup_shares shares = BS::sample_soup_shares(proxy.map());
  std::cout << "polygons: " << model.soup.polygons.size() << "; facets of the proxy: " << proxy.mesh().number_of_faces()
            << "\narea: " << 100 * shares.carried << " % carried along curves, " << 100 * shares.continued
            << " % continued to the nearest point, " << 100 * shares.hidden << " % hidden\n";

  // Simplify the proxy in its shell.
  Mesh coarse = proxy.mesh();
  const auto simplified = BS::simplify_in_shell(coarse, proxy.shell(),
                                                BS::parameters::stop(BS::Facet_count_stop_predicate(1000)));
  if(!simplified) {
    std::cerr << simplified.message() << std::endl;
    return EXIT_FAILURE;
  }
  coarse.collect_garbage();

  // Transfer part numbers and texture coordinates from the polygons to the proxy.
  const BS::Soup_mesh_3& soup = proxy.soup();
  const BS::Soup_proxy_3::Map map = proxy.map(coarse);
  Mesh soup_mesh = soup.mesh();
  auto part_of = soup_mesh.add_property_map<Mesh::Face_index, int>("f:part").first;
  for(auto f : soup_mesh.faces()) part_of[f] = int(model.part[soup.polygon_of(f)]);
  auto part = coarse.add_property_map<Mesh::Face_index, int>("f:part", -1).first;
  auto texture = coarse.add_property_map<Mesh::Halfedge_index, Vector_2>("h:texture").first;
  const BS::Transfer_report parts = BS::transfer_face_labels(map, part_of, part);
  const BS::Transfer_report corners = BS::transfer_corner_attribute(map, Texture_of_corner{ &model, &soup }, texture);
  std::cout << "facets after simplification: " << simplified.facets << "; " << parts.failures.size()
            << " without a part, " << corners.failures.size() << " without texture, " << corners.continued.size()
            << " with texture from the nearest point\n";

  // Transfer a scalar from the proxy back to the polygons.
  auto height = coarse.add_property_map<Mesh::Vertex_index, double>("v:height", 0).first;
  for(auto v : coarse.vertices()) height[v] = coarse.point(v).z();
  auto height_of = soup_mesh.add_property_map<Mesh::Vertex_index, double>("v:height", 0).first;
  const BS::Transfer_report heights = BS::transfer_vertex_attribute(map.inverse(), height, height_of);
  std::cout << "points of the polygons with a value from the proxy: " << heights.transferred << "; "
            << heights.continued.size() << " of them from its nearest point" << std::endl;

  return save("proxy.ply", coarse) && parts && corners && heights ? EXIT_SUCCESS : EXIT_FAILURE;
}
