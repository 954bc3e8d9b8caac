// Computes geodesic distances on a mesh with badly shaped triangles: the heat method is applied to the mesh remeshed in
// its shell, and the distances are transferred back along the integral curves. Remeshing keeps the source vertex.
#include "example_files.h"

#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef CGAL::Certified_bspline_shell_3 Shell;
typedef Mesh::Property_map<Mesh::Vertex_index, double> Distance;
typedef CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh> > Shortest_paths;

// Prints errors in percent of the largest distance.
void print_errors(const char* name, const Mesh& mesh, Distance distance, Distance exact)
{
  double sum = 0, most = 0, largest = 0;
  for(Mesh::Vertex_index v : mesh.vertices()) {
    const double error = std::abs(distance[v] - exact[v]);
    sum += error;
    most = (std::max)(most, error);
    largest = (std::max)(largest, exact[v]);
  }
  std::cout << name << ": mean error " << 100 * sum / double(mesh.number_of_vertices()) / largest
            << " %, maximum error " << 100 * most / largest << " % of the largest distance\n";
}

int main(int argc, char** argv)
{
  std::string file;
  double edges = 100;
  int number = 0;
  const Arguments arguments = Arguments("Usage: heat_geodesics MESH [EDGES [SOURCE]]\n"
                                        "  EDGES: edges of the proxy along the longest side of the bounding box "
                                        "(default 100)\n"
                                        "  SOURCE: number of the source vertex (default 0)\n"
                                        "  Writes heat_geodesics.ply and heat_geodesics_proxy.ply.\n")
                                .required(file)
                                .optional(edges)
                                .optional(number);
  if(const auto code = arguments.read(argc, argv)) return *code;
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  const Mesh::Vertex_index source{ Mesh::size_type(number) };
  if(!mesh.has_valid_index(source)) return *arguments.wrong("The mesh has no vertex " + std::to_string(number) + ".");
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  if(!shell.is_certified()) {
    std::cerr << shell.message() << std::endl;
    return EXIT_FAILURE;
  }

  // Remesh with nearly equilateral triangles, and keep sharp edges and the source.
  Mesh proxy = mesh;
  auto sharp = proxy.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
  auto is_source = proxy.add_property_map<Mesh::Vertex_index, bool>("v:source", false).first;
  CGAL::Polygon_mesh_processing::detect_sharp_edges(proxy, 60, sharp);
  is_source[source] = true;
  const auto report = BS::remesh_in_shell(
    proxy, shell.report().unit / edges, shell,
    BS::parameters::edge_is_constrained_map(sharp).vertex_is_constrained_map(is_source));
  if(!report) {
    std::cerr << report.message() << std::endl;
    return EXIT_FAILURE;
  }
  proxy.collect_garbage();

  // Compute distances on the remeshed mesh, and transfer them back.
  const Distance on_proxy = proxy.add_property_map<Mesh::Vertex_index, double>("v:distance").first,
                 distance = mesh.add_property_map<Mesh::Vertex_index, double>("v:distance").first,
                 direct = mesh.add_property_map<Mesh::Vertex_index, double>("v:direct").first,
                 exact = mesh.add_property_map<Mesh::Vertex_index, double>("v:exact").first;
  CGAL::Heat_method_3::estimate_geodesic_distances(proxy, on_proxy,
                                                   *std::find_if(proxy.vertices().begin(), proxy.vertices().end(),
                                                                 [&](Mesh::Vertex_index v) { return is_source[v]; }));
  const BS::Shell_map_3<Shell, Mesh> map(shell, proxy, mesh);
  const BS::Transfer_report transfer = BS::transfer_vertex_attribute(map, on_proxy, distance);
  if(!transfer) {
    std::cerr << transfer.failures.size() << " vertices have no distance: " << message(transfer.failures[0].second)
              << std::endl;
    return EXIT_FAILURE;
  }

  // The heat method on the mesh itself and exact distances serve for comparison.
  CGAL::Heat_method_3::estimate_geodesic_distances(mesh, direct, source);
  Shortest_paths paths(mesh);
  paths.add_source_point(source);
  for(Mesh::Vertex_index v : mesh.vertices()) exact[v] = paths.shortest_distance_to_source_points(v).first;
  print_errors("on the mesh itself", mesh, direct, exact);
  print_errors("on the proxy, transferred back", mesh, distance, exact);
  return save("heat_geodesics.ply", mesh) && save("heat_geodesics_proxy.ply", proxy) ? EXIT_SUCCESS : EXIT_FAILURE;
}
