// Measures large meshes: certified shell, another certification, simplification, and an attribute there and back. Each
// stage has its wall-clock and processor seconds, and the resident memory at its end and at its peak, in bytes per
// facet of the mesh. Prints one JSON object per line; every mesh has a separate process.
//
//   large_mesh_benchmark [--thickness T] [--ratio R] [--policy plane|probabilistic-plane] [--plain] MESH...
//
// MESH: a file, or a number of facets. In the latter case, a synthetic scan is used, a sphere with bumps and grooves,
// whose shape does not depend on the number.
// --thickness: thickness of the shell (default 0.01, of the longest box side). --ratio: share of facets that
// simplification keeps (default 0.01). --policy: costs and placements (default plane, that of the library). --plain:
// also CGAL's edge collapse without a shell, with CGAL's policy.
// "mesh" is the memory of the mesh itself, which is subtracted from the peaks of the other stages.
#include "../json.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Support/keep_freed_memory.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Real_timer.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/generators.h>

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace BS = CGAL::Bspline_shells;
namespace SMS = CGAL::Surface_mesh_simplification;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef Kernel::Point_3 Point;
typedef CGAL::Surface_mesh<Point> Mesh;

struct Options
{
  double thickness = 0.01, ratio = 0.01;
  bool is_probabilistic = false, is_plain_too = false;
};

double processor_seconds()
{
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Returns the field "VmRSS", or "VmHWM", the peak since the last reset, in bytes.
double memory(const std::string& field)
{
  std::ifstream in("/proc/self/status");
  for(std::string line; std::getline(in, line);)
    if(line.compare(0, field.size(), field) == 0) return 1024 * std::atof(line.c_str() + field.size() + 1);
  return 0;
}

// Measures a stage, from its construction to finish().
class Stage
{
public:
  Stage()
  {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;
    m_processor_seconds = processor_seconds();
    m_timer.start();
  }

  // \param mesh_bytes is subtracted
  std::string finish(const std::string& name, std::size_t facets, double mesh_bytes)
  {
    m_timer.stop();
    const double peak = memory("VmHWM");
    malloc_trim(0);
    std::ostringstream out;
    out << ",\"" << name << "\":{\"seconds\":" << m_timer.time()
        << ",\"processor_seconds\":" << processor_seconds() - m_processor_seconds
        << ",\"bytes_a_facet\":" << (memory("VmRSS") - mesh_bytes) / double(facets)
        << ",\"peak_bytes_a_facet\":" << (peak - mesh_bytes) / double(facets) << "}";
    return out.str();
  }

private:
  CGAL::Real_timer m_timer;
  double m_processor_seconds;
};

// Returns an icosahedron with edges of n parts, projected to a star-shaped surface with waves.
Mesh scan(std::size_t facets)
{
  const int n = int((std::max)(1., std::round(std::sqrt(double(facets) / 20))));
  Mesh icosahedron, mesh;
  CGAL::make_icosahedron(icosahedron, Point(0, 0, 0), 1.);
  mesh.reserve(Mesh::size_type(10 * n * n + 2), Mesh::size_type(30 * n * n), Mesh::size_type(20 * n * n));
  const auto displaced = [](const Kernel::Vector_3& v) {
    const double length = std::sqrt(v.squared_length()), x = v.x() / length, y = v.y() / length, z = v.z() / length;
    const double shape = 0.25 * std::sin(3 * x + 1) * std::sin(4 * y) * std::cos(3 * z)
                         + 0.08 * std::sin(11 * x) * std::sin(9 * y + 2) * std::sin(10 * z + 1);
    const double grooves = 0.01 * std::tanh(4 * std::sin(25 * x + 5 * std::sin(3 * y)))
                           + 0.004 * std::sin(61 * y) * std::sin(57 * z) * std::sin(64 * x);
    const double r = 1 + shape + grooves;
    return Point(r * x, r * y, r * z);
  };
  // Inner vertices belong to one facet; those on edges and corners are shared.
  std::map<std::array<std::size_t, 3>, Mesh::Vertex_index> shared; // corner, corner, steps from the lesser one
  for(auto f : icosahedron.faces()) {
    const auto h = icosahedron.halfedge(f);
    const std::array<Mesh::Vertex_index, 3> corner = { icosahedron.source(h), icosahedron.target(h),
                                                       icosahedron.target(icosahedron.next(h)) };
    const auto make = [&](int i, int j) { // steps towards the second and the third corner
      const std::array<double, 3> w = { double(n - i - j) / n, double(i) / n, double(j) / n };
      Kernel::Vector_3 v(0, 0, 0);
      for(int k = 0; k < 3; ++k) v = v + w[std::size_t(k)] * (icosahedron.point(corner[std::size_t(k)]) - CGAL::ORIGIN);
      return displaced(v);
    };
    std::vector<std::vector<Mesh::Vertex_index> > vertex(std::size_t(n) + 1);
    for(int i = 0; i <= n; ++i)
      for(int j = 0; i + j <= n; ++j) {
        const std::array<int, 3> step = { n - i - j, i, j };
        std::vector<std::pair<std::size_t, std::size_t> > on; // corners with a weight
        for(std::size_t k = 0; k < 3; ++k)
          if(step[k] > 0) on.emplace_back(std::size_t(corner[k]), std::size_t(step[k]));
        Mesh::Vertex_index v;
        if(on.size() == 3) v = mesh.add_vertex(make(i, j));
        else {
          std::sort(on.begin(), on.end());
          const std::array<std::size_t, 3> key = { on.front().first, on.back().first, on.front().second };
          const auto found = shared.find(key);
          v = found != shared.end() ? found->second : shared.emplace(key, mesh.add_vertex(make(i, j))).first->second;
        }
        vertex[std::size_t(i)].push_back(v);
      }
    for(std::size_t i = 0; i < std::size_t(n); ++i)
      for(std::size_t j = 0; i + j < std::size_t(n); ++j) {
        mesh.add_face(vertex[i][j], vertex[i + 1][j], vertex[i][j + 1]);
        if(i + j + 1 < std::size_t(n)) mesh.add_face(vertex[i + 1][j], vertex[i + 1][j + 1], vertex[i][j + 1]);
      }
  }
  return mesh;
}

typedef SMS::GarlandHeckbert_plane_policies<Mesh, Kernel> Plane_policies;
typedef SMS::GarlandHeckbert_probabilistic_plane_policies<Mesh, Kernel> Probabilistic_policies;

template <typename Policies>
void simplify_plain(Mesh& mesh, const BS::Facet_count_stop_predicate& stop)
{
  const Policies policies(mesh);
  SMS::edge_collapse(mesh, stop,
                     CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
}

BS::Edit_status simplify(Mesh& mesh, const CGAL::Certified_bspline_shell_3& shell, const Options& options,
                         const BS::Facet_count_stop_predicate& predicate)
{
  const auto stop = BS::parameters::stop(predicate);
  if(!options.is_probabilistic) return BS::simplify_in_shell(mesh, shell, stop).status;
  const Probabilistic_policies policies(mesh);
  return BS::simplify_in_shell(mesh, shell, stop.get_cost(policies.get_cost()).get_placement(policies.get_placement()))
    .status;
}

void measure(const std::string& name, const Options& options)
{
  const auto refuse = [&](const std::string& reason, const std::string& stages) {
    std::cout << "{\"mesh\":" << quoted(name) << ",\"status\":\"refused\",\"reason\":" << quoted(reason) << stages
              << "}" << std::endl;
  };
  const double empty = memory("VmRSS");
  std::string stages;
  Mesh mesh;
  {
    Stage stage;
    if(name.find_first_not_of("0123456789") == std::string::npos) {
      mesh = scan(std::size_t(std::atoll(name.c_str())));
    } else {
      const BS::Shell_status read = BS::read_triangle_mesh(name, mesh);
      if(read != BS::Shell_status::SUCCESS) return refuse(message(read), "");
    }
    stages += stage.finish("mesh", mesh.number_of_faces(), empty);
  }
  const std::size_t facets = mesh.number_of_faces();
  malloc_trim(0);
  const double mesh_bytes = memory("VmRSS");

  Stage of_shell;
  const auto shell = CGAL::certified_bspline_shell_3(
    mesh, BS::parameters::relative_thickness(options.thickness).memory_limit(1e10));
  stages += of_shell.finish("shell", facets, mesh_bytes);
  if(!shell.is_certified()) return refuse(shell.message(), stages);
  const BS::Shell_report& r = shell.report();
  {
    std::ostringstream out;
    out << ",\"cells\":" << r.cells << ",\"rounds\":" << r.rounds.size() << ",\"steps\":{";
    for(std::size_t s = 0; s < r.seconds.size(); ++s)
      out << (s > 0 ? "," : "") << "\"" << BS::name(BS::Shell_step(s)) << "\":" << r.seconds[s];
    stages += out.str() + "}";
  }

  {
    Stage stage;
    BS::Shell_certificate_3 certificate(shell);
    const bool is_certified = certificate.verify(mesh);
    stages += stage.finish("certificate", facets, mesh_bytes);
    if(!is_certified) return refuse("The mesh was not certified again.", stages);
  }

  const BS::Facet_count_stop_predicate stop(std::size_t(options.ratio * double(facets)));
  if(options.is_plain_too) {
    Mesh plain = mesh;
    Stage stage;
    if(options.is_probabilistic) simplify_plain<Probabilistic_policies>(plain, stop);
    else simplify_plain<Plane_policies>(plain, stop);
    stages += stage.finish("plain_simplification", facets, mesh_bytes);
  }
  Stage of_simplification;
  Mesh coarse = mesh;
  const BS::Edit_status status = simplify(coarse, shell, options, stop);
  coarse.collect_garbage();
  stages += of_simplification.finish("simplification", facets, mesh_bytes);
  if(status != BS::Edit_status::SUCCESS) return refuse(message(status), stages);

  // x, in units of the box
  auto fine_values = mesh.add_property_map<Mesh::Vertex_index, double>("v:x").first;
  auto back = mesh.add_property_map<Mesh::Vertex_index, double>("v:back").first;
  auto coarse_values = coarse.add_property_map<Mesh::Vertex_index, double>("v:x").first;
  for(auto v : mesh.vertices()) fine_values[v] = mesh.point(v).x() / r.unit;
  Stage of_transfer;
  const BS::Shell_map_3 there(shell, mesh, coarse);
  const auto averaged = BS::average_vertex_attribute(there, fine_values, coarse_values);
  stages += of_transfer.finish("transfer", facets, mesh_bytes);
  Stage of_transfer_back;
  const auto interpolated = BS::transfer_vertex_attribute(there.inverse(), coarse_values, back);
  stages += of_transfer_back.finish("transfer_back", facets, mesh_bytes);
  double sum = 0;
  for(auto v : mesh.vertices()) sum += std::abs(back[v] - fine_values[v]);
  std::cout << "{\"mesh\":" << quoted(name) << ",\"status\":\"done\",\"facets\":" << facets
            << ",\"coarse_facets\":" << coarse.number_of_faces()
            << ",\"lost\":" << averaged.failures.size() + averaged.left_out.size() + interpolated.failures.size()
            << ",\"mean_error\":" << sum / double(mesh.number_of_vertices()) << stages << "}" << std::endl;
}

int main(int argc, char** argv)
{
  BS::keep_freed_memory();
  print_JSON_numbers();
  Options options;
  std::vector<std::string> names;
  bool is_usable = true;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if((arg == "--thickness" || arg == "--ratio") && i + 1 < argc) {
      double& x = arg == "--ratio" ? options.ratio : options.thickness;
      x = std::atof(argv[++i]);
      is_usable = is_usable && x > 0;
    } else if(arg == "--policy" && i + 1 < argc) {
      const std::string policy = argv[++i];
      options.is_probabilistic = policy == "probabilistic-plane";
      is_usable = is_usable && (options.is_probabilistic || policy == "plane");
    } else if(arg == "--plain") options.is_plain_too = true;
    else if(arg.compare(0, 2, "--") == 0) is_usable = false;
    else names.push_back(arg);
  }
  if(!is_usable || names.empty()) {
    std::cerr << "Usage: large_mesh_benchmark [--thickness T] [--ratio R] [--policy plane|probabilistic-plane] "
                 "[--plain] MESH...\n";
    return 2;
  }
  for(const std::string& name : names) {
    std::cout.flush();
    const pid_t child = fork();
    if(child == 0) {
      measure(name, options);
      _exit(0);
    }
    int status = 0;
    if(child < 0 || waitpid(child, &status, 0) < 0 || !(WIFEXITED(status) && WEXITSTATUS(status) == 0))
      std::cout << "{\"mesh\":" << quoted(name) << ",\"status\":\"refused\",\"reason\":\"The process died.\"}"
                << std::endl;
  }
  return EXIT_SUCCESS;
}
