// Geodesic distances by the heat method: solved on the mesh itself, and on a proxy with good triangles in its shell,
// from which they are transferred back. They are compared with exact distances along the mesh
// (Surface_mesh_shortest_path). Prints one JSON object per line, for each mesh and number of edges along the longest
// side of the box.
//
//   geodesics_benchmark [--edges N,N,...] [--sources K] [--thickness T] [MESH ...]
//
// By default, N is 25, 50, 100 and 150, and K is 5: sources are vertices at equal steps of their indices. The proxy
// keeps them as constrained vertices. Errors are in percent of the largest exact distance, over all vertices and
// sources; "beyond_3" is the share of vertices with an error of more than 3 %, as in the histograms of the paper.
// Facets outside the certified shell are frozen, and "certified" is false.
#include "../meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>

#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Real_timer.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace HM = CGAL::Heat_method_3;
typedef Mesh::Vertex_index Vertex;
typedef Mesh::Property_map<Vertex, double> Distance;
typedef std::vector<double> Values; // values at the vertices of the mesh, in their order

Values exact_distances(const Mesh& mesh, Vertex source)
{
  CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh> > paths(mesh);
  paths.add_source_point(source);
  Values result;
  for(Vertex v : mesh.vertices()) result.push_back(paths.shortest_distance_to_source_points(v).first);
  return result;
}

template <typename Mode>
void heat_distances(Mesh& mesh, Vertex source, Distance distance)
{
  HM::Surface_mesh_geodesic_distances_3<Mesh, Mode> heat(mesh);
  heat.add_source(source);
  heat.estimate_geodesic_distances(distance);
}

struct Errors
{
  void add(const Values& exact, const Values& found)
  {
    const double largest = *std::max_element(exact.begin(), exact.end());
    for(std::size_t n = 0; n < exact.size(); ++n) {
      const double error = 100 * std::abs(found[n] - exact[n]) / largest;
      ++number;
      if(!std::isfinite(error)) {
        ++missing;
        continue;
      }
      sum += error;
      most = (std::max)(most, error);
      beyond += error > 3;
    }
  }
  std::size_t number = 0, missing = 0, beyond = 0;
  double sum = 0, most = 0, seconds = 0;
};

std::ostream& operator<<(std::ostream& out, const Errors& e)
{
  return out << "{\"mean\":" << e.sum / double(e.number - e.missing) << ",\"max\":" << e.most
             << ",\"beyond_3\":" << double(e.beyond) / double(e.number - e.missing) << ",\"missing\":" << e.missing
             << ",\"seconds\":" << e.seconds << "}";
}

template <typename Mode>
Errors direct(const Mesh& mesh, const std::vector<Vertex>& sources, const std::vector<Values>& exact)
{
  Errors errors;
  CGAL::Real_timer timer;
  timer.start();
  Mesh copy = mesh;
  const Distance distance = copy.add_property_map<Vertex, double>("v:distance").first;
  for(std::size_t s = 0; s < sources.size(); ++s) {
    heat_distances<Mode>(copy, sources[s], distance);
    Values found;
    for(Vertex v : copy.vertices()) found.push_back(distance[v]);
    errors.add(exact[s], found);
  }
  errors.seconds = timer.time();
  return errors;
}

void measure(const std::string& file, const std::vector<double>& all_edges, std::size_t number_of_sources,
             double thickness)
{
  Mesh mesh;
  std::optional<Shell> shell;
  CGAL::Real_timer timer;
  timer.start();
  if(read_triangles(file, mesh))
    shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(thickness));
  const double shell_seconds = timer.time();
  if(!shell || !*shell) {
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"status\":\"no shell\"}" << std::endl;
    return;
  }
  std::vector<Vertex> sources;
  std::vector<Values> exact;
  for(std::size_t s = 0; s < number_of_sources; ++s) {
    sources.push_back(Vertex(Vertex::size_type(s * mesh.number_of_vertices() / number_of_sources)));
    exact.push_back(exact_distances(mesh, sources.back()));
  }
  const Errors plain = direct<HM::Direct>(mesh, sources, exact),
               intrinsic = direct<HM::Intrinsic_Delaunay>(mesh, sources, exact);

  for(double edges : all_edges) {
    Mesh proxy = mesh;
    auto source = proxy.add_property_map<Vertex, int>("v:source", -1).first;
    auto is_source = proxy.add_property_map<Vertex, bool>("v:is_source", false).first;
    for(std::size_t s = 0; s < sources.size(); ++s) {
      source[sources[s]] = int(s);
      is_source[sources[s]] = true;
    }
    auto sharp = proxy.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
    CGAL::Polygon_mesh_processing::detect_sharp_edges(proxy, 60, sharp);
    timer.reset();
    const auto report = BS::remesh_in_shell(
      proxy, shell->report().unit / edges, *shell,
      BS::parameters::edge_is_constrained_map(sharp).vertex_is_constrained_map(is_source).freeze_rejected_facets(
        !shell->is_certified()));
    const double remeshing_seconds = timer.time();
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"facets\":" << mesh.number_of_faces()
              << ",\"certified\":" << (shell->is_certified() ? "true" : "false") << ",\"edges\":" << edges;
    if(!report && report.status != BS::Edit_status::PARTIALLY_EDITED) {
      std::cout << ",\"status\":" << quoted(BS::message(report.status)) << "}" << std::endl;
      continue;
    }
    proxy.collect_garbage();
    std::vector<Vertex> on_proxy(sources.size());
    for(Vertex v : proxy.vertices())
      if(source[v] >= 0) on_proxy[std::size_t(source[v])] = v;
    timer.reset();
    const BS::Shell_map_3<Shell, Mesh> map(*shell, proxy, mesh);
    const Distance on_mesh = mesh.add_property_map<Vertex, double>("v:distance").first,
                   distance = proxy.add_property_map<Vertex, double>("v:distance").first;
    Errors direct_errors, intrinsic_errors;
    const auto solve = [&](auto mode, Errors& errors) {
      timer.reset();
      for(std::size_t s = 0; s < sources.size(); ++s) {
        heat_distances<decltype(mode)>(proxy, on_proxy[s], distance);
        BS::transfer_vertex_attribute(map, distance, on_mesh,
                                      BS::parameters::default_value(std::numeric_limits<double>::quiet_NaN()));
        Values found;
        for(Vertex v : mesh.vertices()) found.push_back(on_mesh[v]);
        errors.add(exact[s], found);
      }
      errors.seconds = timer.time();
    };
    solve(HM::Direct(), direct_errors);
    solve(HM::Intrinsic_Delaunay(), intrinsic_errors);
    std::cout << ",\"direct\":" << plain << ",\"intrinsic\":" << intrinsic
              << ",\"proxy\":{\"facets\":" << proxy.number_of_faces() << ",\"direct\":" << direct_errors
              << ",\"intrinsic\":" << intrinsic_errors << "}"
              << ",\"seconds\":{\"shell\":" << shell_seconds << ",\"remeshing\":" << remeshing_seconds << "}}"
              << std::endl;
  }
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  std::vector<double> edges;
  std::size_t sources = 5;
  double thickness = 0.01;
  std::vector<std::string> files;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if(arg == "--edges" && i + 1 < argc) {
      std::istringstream list(argv[++i]);
      for(std::string n; std::getline(list, n, ',');) edges.push_back(std::atof(n.c_str()));
    } else if(arg == "--sources" && i + 1 < argc) sources = std::size_t(std::atoll(argv[++i]));
    else if(arg == "--thickness" && i + 1 < argc) thickness = std::atof(argv[++i]);
    else files.push_back(arg);
  }
  if(edges.empty()) edges = { 25, 50, 100, 150 };
  if(sources == 0 || !(thickness > 0) || !std::all_of(edges.begin(), edges.end(), [](double n) { return n > 0; })) {
    std::cerr << "Usage: geodesics_benchmark [--edges N,N,...] [--sources K] [--thickness T] [MESH ...]\n";
    return 2;
  }
  if(files.empty())
    for(const char* name : { "hand", "blobby", "elephant", "fandisk", "anchor_dense", "rotor", "bear", "dino" })
      files.push_back(std::string(MESHES "/") + name + ".off");
  for(const std::string& file : files) measure(file, edges, sources, thickness);
  return EXIT_SUCCESS;
}
