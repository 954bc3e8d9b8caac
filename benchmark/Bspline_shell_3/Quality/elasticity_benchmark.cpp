// Nonlinear elasticity in tetrahedra on input meshes, and on proxies in their certified shells: quality of tetrahedra,
// iterations, time, and differences of solutions from that of the finest proxy. Prints one JSON object per line; every
// mesh has a separate process.
//
//   elasticity_benchmark [--edges N]... [--angle A] [--unknowns U] [--gmsh] [--max-seconds S] [MESH ...]
//
// --edges: the target length of the proxy's edges is the longest side of the box divided by N; default: 20, 30 and 45.
// --angle: angle in degrees by which one end of the longest side is bent, while the other is held (default 45).
// --unknowns: larger systems are skipped (default 300000). --gmsh: tetrahedra by Gmsh instead of TetGen. --max-seconds:
// time limit of a process.
//
// Quality is the mean ratio, 12 (3 volume)^(2/3) divided by the sum of the squared lengths of all edges. Differences
// are over the vertices of the mesh, in percent of the largest displacement. The reference is the solution with
// quadratic elements on the finest proxy that is not skipped. self_intersections: pairs of facets of the bent mesh.
#include "../meshes_in_shell.h"

#include "../../../examples/Bspline_shell_3/Neo_hookean_solid.h"
#include "../../../examples/Bspline_shell_3/bend_ends.h"
#include "../../../examples/Bspline_shell_3/tetrahedralize.h"

#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Real_timer.h>

#ifdef HAVE_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include <sys/wait.h>
#include <unistd.h>

#include <iterator>
#include <list>
#include <utility>

namespace PMP = CGAL::Polygon_mesh_processing;
#ifdef HAVE_CHOLMOD
struct Factorization : Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower>
{
  Factorization() { cholmod().print = 0; } // its messages would go to the standard output
};
typedef Neo_hookean_solid<Factorization> Solid;
#else
typedef Neo_hookean_solid<> Solid;
#endif
typedef Mesh::Property_map<Mesh::Face_index, End> Ends;
typedef BS::Shell_map_3<Shell, Mesh> Map;

struct Options
{
  std::vector<double> edges;
  double angle = 45;
  std::size_t unknowns = 300000;
  unsigned int max_seconds = 0;
  std::string generator = "TetGen";
};

// Calls the generator with this name, if the program is linked with it.
Tetrahedra tetrahedralize([[maybe_unused]] const Mesh& mesh, const std::string& generator)
{
#ifdef HAVE_TETGEN
  if(generator == "TetGen") return tetrahedralize_with_TetGen(mesh);
#endif
#ifdef HAVE_GMSH
  if(generator == "Gmsh") return tetrahedralize_with_Gmsh(mesh);
#endif
  Tetrahedra none;
  none.error = "not built with " + generator;
  return none;
}

std::vector<double> sorted_mean_ratios(const Tetrahedra& tetrahedra)
{
  std::vector<double> result;
  for(const auto& t : tetrahedra.cells) {
    std::array<Kernel::Point_3, 4> p;
    for(int i = 0; i < 4; ++i) p[i] = tetrahedra.points[t[i]];
    double squares = 0;
    for(int i = 0; i < 4; ++i)
      for(int j = 0; j < i; ++j) squares += CGAL::squared_distance(p[i], p[j]);
    const double volume = CGAL::volume(p[0], p[1], p[2], p[3]);
    result.push_back(volume > 0 ? 12 * std::cbrt(9 * volume * volume) / squares : 0);
  }
  std::sort(result.begin(), result.end());
  return result;
}

// A filled mesh, and the map that transfers a solution to the vertices of the examined mesh.
struct Domain
{
  std::string name;
  double edges;
  Mesh surface;
  Ends ends;
  std::optional<Map> map; // none for the mesh itself
  Tetrahedra tetrahedra;
  double seconds = 0;

  bool bring_back(const Mesh& mesh, const Solid& solid, const Solid::Vectors& from, Solid::Vectors& to) const
  {
    to = from.leftCols(Eigen::Index(mesh.number_of_vertices()));
    if(!map) return true;
    for(Mesh::Vertex_index v : mesh.vertices()) {
      const auto image = (*map)(v);
      if(!image) return false;
      to.col(Eigen::Index(v)) = solid.displacement(from, corners(surface, image.location.first), image.location.second);
    }
    return true;
  }
};

// Solves and prints. The first solution is the reference of the others.
void measure(const std::string& name, const Mesh& mesh, const Domain& domain, int order, const Bend& motion,
             const Options& options, Solid::Vectors& reference)
{
  const Tetrahedra& tetrahedra = domain.tetrahedra;
  std::cout << "{\"mesh\":" << quoted(name) << ",\"domain\":" << quoted(domain.name) << ",\"edges\":" << domain.edges
            << ",\"facets\":" << domain.surface.number_of_faces() << ",\"generator\":" << quoted(options.generator)
            << ",\"conforms\":" << (tetrahedra ? "true" : "false") << ",\"seconds_for_tetrahedra\":" << domain.seconds
            << ",\"order\":" << order;
  if(!tetrahedra) {
    std::cout << ",\"status\":" << quoted(tetrahedra.error) << "}" << std::endl;
    return;
  }
  const std::vector<double> ratios = sorted_mean_ratios(tetrahedra);
  std::cout << ",\"tetrahedra\":" << ratios.size() << ",\"mean_ratio\":{\"least\":" << ratios.front()
            << ",\"percentile_1\":" << ratios[ratios.size() / 100] << ",\"median\":" << ratios[ratios.size() / 2]
            << "}";
  CGAL::Real_timer timer;
  timer.start();
  std::vector<Eigen::Vector3d> points;
  for(const Kernel::Point_3& p : tetrahedra.points) points.push_back(to_Eigen(p));
  const Solid solid(points, tetrahedra.cells, order == 2 ? Element_order::QUADRATIC : Element_order::LINEAR,
                    lame_parameters(1, 0.3));
  if(3 * solid.number_of_nodes() > options.unknowns) {
    std::cout << ",\"status\":\"left out: " << 3 * solid.number_of_nodes() << " unknowns\"}" << std::endl;
    return;
  }
  const Solid::Result result = bend(solid, domain.surface, domain.ends, motion, 2);
  std::cout << ",\"unknowns\":" << 3 * solid.number_of_nodes() << ",\"status\":" << quoted(message(result.status))
            << ",\"load\":" << result.load << ",\"load_steps\":" << result.load_steps
            << ",\"iterations\":" << result.iterations << ",\"projected_Hessians\":" << result.projections
            << ",\"energy\":" << result.energy << ",\"least_J\":" << result.least_jacobian
            << ",\"seconds\":" << timer.time();
  Solid::Vectors u;
  if(result && domain.bring_back(mesh, solid, result.displacements, u)) {
    Mesh bent = mesh;
    for(Mesh::Vertex_index v : bent.vertices()) {
      const auto d = u.col(Eigen::Index(v));
      bent.point(v) = bent.point(v) + Kernel::Vector_3(d[0], d[1], d[2]);
    }
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index> > pairs;
    PMP::self_intersections(bent, std::back_inserter(pairs));
    std::cout << ",\"self_intersections\":" << pairs.size();
    if(reference.size() == 0) {
      reference = u;
      std::cout << ",\"is_reference\":true";
    }
    const auto differences = (u - reference).colwise().norm();
    const double percent = 100 / reference.colwise().norm().maxCoeff();
    std::cout << ",\"difference\":{\"mean\":" << percent * differences.mean()
              << ",\"max\":" << percent * differences.maxCoeff() << "}";
  } else if(result) std::cout << ",\"lost\":\"a vertex has no image\"";
  std::cout << "}" << std::endl;
}

void measure(const std::string& file, const Options& options)
{
  Mesh mesh;
  std::optional<Shell> shell;
  if(read_triangles(file, mesh)) shell = CGAL::certified_bspline_shell_3(mesh);
  if(!shell || !shell->is_certified()) {
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"status\":\"no certified shell\"}" << std::endl;
    return;
  }
  const Bend motion(mesh, options.angle * std::acos(-1.) / 180);
  auto ends = mesh.add_property_map<Mesh::Face_index, End>("f:end", End::NONE).first;
  motion.label_ends(mesh, ends);

  std::list<Domain> domains; // maps point to their meshes
  for(double edges : options.edges) {
    Domain& domain = domains.emplace_back(Domain{ "proxy", edges, mesh, Ends(), std::nullopt, Tetrahedra() });
    Mesh& proxy = domain.surface;
    domain.ends = proxy.add_property_map<Mesh::Face_index, End>("f:end").first; // exists
    auto sharp = proxy.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
    PMP::detect_sharp_edges(proxy, 60, sharp);
    const auto report = BS::remesh_in_shell(proxy, shell->report().unit / edges, *shell,
                                            BS::parameters::edge_is_constrained_map(sharp));
    proxy.collect_garbage();
    domain.map.emplace(*shell, mesh, proxy);
    if(report && BS::transfer_face_labels(*domain.map, ends, domain.ends)) continue;
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"edges\":" << edges
              << ",\"status\":" << quoted(message(report.status)) << "}" << std::endl;
    domains.pop_back();
  }
  domains.push_back({ "input", 0, mesh, Ends(), std::nullopt, Tetrahedra() });
  domains.back().ends = domains.back().surface.add_property_map<Mesh::Face_index, End>("f:end").first;

  Solid::Vectors reference;
  for(int order : { 2, 1 })
    for(Domain& domain : domains) {
      CGAL::Real_timer timer;
      timer.start();
      if(order == 2) {
        domain.tetrahedra = tetrahedralize(domain.surface, options.generator);
        domain.seconds = timer.time();
      }
      measure(mesh_name(file), mesh, domain, order, motion, options, reference);
    }
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  Options options;
  std::vector<std::string> files;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if(arg == "--edges" && i + 1 < argc) options.edges.push_back(std::atof(argv[++i]));
    else if(arg == "--angle" && i + 1 < argc) options.angle = std::atof(argv[++i]);
    else if(arg == "--unknowns" && i + 1 < argc) options.unknowns = std::size_t(std::atoll(argv[++i]));
    else if(arg == "--max-seconds" && i + 1 < argc) options.max_seconds = unsigned(std::atol(argv[++i]));
    else if(arg == "--gmsh") options.generator = "Gmsh";
    else files.push_back(arg);
  }
  if(options.edges.empty()) options.edges = { 20, 30, 45 };
  std::sort(options.edges.rbegin(), options.edges.rend()); // the finest is the reference
  if(!(options.edges.back() > 0)) {
    std::cerr << "Usage: elasticity_benchmark [--edges N]... [--angle A] [--unknowns U] [--gmsh] [--max-seconds S] "
                 "[MESH ...]\n";
    return 2;
  }
  if(files.empty())
    for(const char* name : { "anchor", "rotor", "fandisk", "joint", "P", "pinion_small", "elephant", "dragknob" })
      files.push_back(MESHES "/" + std::string(name) + ".off");
  for(const std::string& file : files) {
    const pid_t child = fork();
    if(child == 0) {
      if(options.max_seconds > 0) alarm(options.max_seconds);
      measure(file, options);
      std::cout.flush();
      _exit(0);
    }
    int status = 1;
    if(child < 0 || waitpid(child, &status, 0) < 0 || status != 0)
      std::cout << "\n{\"mesh\":" << quoted(mesh_name(file)) << ",\"status\":\""
                << (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM ? "time limit" : "the process did not end well")
                << "\"}" << std::endl;
  }
  return EXIT_SUCCESS;
}
