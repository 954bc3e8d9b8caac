// Simplifies each mesh in its certified shell, and for comparison by the same edge collapse without the shell to the
// same number of facets. Then simplifies it in the shell again, as far as possible. Prints one JSON object per line;
// every mesh has a separate process.
//
//   simplify_benchmark FILE... [--facets N] [--ratio R]
//                      [--policy plane|triangle|probabilistic-plane|probabilistic-triangle]
//                      [--thickness T] [--points N] [--max-seconds S]
//
// --facets (default 300) or --ratio: the target; if the shell does not allow it, its number of facets is used for the
// comparison. --thickness: of the shell (default 0.01, of the longest box side). --points: number of samples of the
// Hausdorff distances (default 50000). --max-seconds: time limit of a process. Distances are in units of the longest
// box side, angles in degrees.
#include "../json.h"

#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Real_timer.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace BS = CGAL::Bspline_shells;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace SMS = CGAL::Surface_mesh_simplification;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

struct Options
{
  std::size_t facets = 300, points = 50000;
  double ratio = 0, thickness = 0.01;
  unsigned max_seconds = 0;
  std::string policy = "plane";
};

void print_refused(const std::string& file, const std::string& reason)
{
  std::cout << "{\"mesh\":" << quoted(file) << ",\"status\":\"refused\",\"reason\":" << quoted(reason) << "}"
            << std::endl;
}

double least_angle(const Mesh& mesh)
{
  double least = 180;
  for(auto h : mesh.halfedges()) {
    const auto &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h)),
               &r = mesh.point(mesh.target(mesh.next(h)));
    least = (std::min)(least, CGAL::to_double(CGAL::approximate_angle(p, q, r)));
  }
  return least;
}

// Returns the number of intersecting pairs of facets, distances from and to the initial mesh, and the smallest angle.
std::string quality(const Mesh& before, Mesh mesh, double unit, const Options& options)
{
  mesh.collect_garbage();
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index> > pairs;
  PMP::self_intersections(mesh, std::back_inserter(pairs));
  const auto np =
    CGAL::parameters::use_random_uniform_sampling(true).number_of_points_on_faces(options.points).random_seed(1);
  const double from = PMP::approximate_Hausdorff_distance<CGAL::Sequential_tag>(before, mesh, np, np) / unit;
  const double to = PMP::approximate_Hausdorff_distance<CGAL::Sequential_tag>(mesh, before, np, np) / unit;
  std::ostringstream out;
  out << "\"facets\":" << mesh.number_of_faces() << ",\"self_intersections\":" << pairs.size()
      << ",\"distance_from_input\":" << from << ",\"distance_to_input\":" << to
      << ",\"hausdorff\":" << (std::max)(from, to) << ",\"least_angle\":" << least_angle(mesh);
  return out.str();
}

std::string numbers(const BS::Simplification_report& report)
{
  std::ostringstream out;
  out << "\"certified\":" << (report.status == BS::Edit_status::SUCCESS ? "true" : "false")
      << ",\"repeated\":" << (report.is_repeated ? "true" : "false") << ",\"selected\":" << report.selected
      << ",\"collapsed\":" << report.collapsed << ",\"retried\":" << report.retried << ",\"placements\":{";
  for(std::size_t n = 0; n < report.placements.by_verdict.size(); ++n)
    out << (n > 0 ? "," : "") << "\"" << name(BS::Placement_verdict(n)) << "\":" << report.placements.by_verdict[n];
  out << "},\"seconds\":{\"total\":" << report.total_seconds() << ",\"check\":" << report.check_seconds
      << ",\"collapse\":" << report.edit_seconds << ",\"certificate\":" << report.certificate_seconds << "}";
  return out.str();
}

typedef SMS::GarlandHeckbert_plane_policies<Mesh, Kernel> Plane_policies; // the library's default, with a term for ties

template <typename Policies>
int simplify(const std::string& file, const Mesh& input, const CGAL::Certified_bspline_shell_3& shell,
             const Options& options)
{
  const std::size_t wanted = options.ratio > 0 ? std::size_t(options.ratio * double(input.number_of_faces()))
                                               : options.facets;
  const double unit = shell.report().unit;
  const auto in_shell = [&](Mesh& mesh, const auto& np) {
    if constexpr(std::is_same_v<Policies, Plane_policies>) return BS::simplify_in_shell(mesh, shell, np);
    const Policies policies(mesh);
    return BS::simplify_in_shell(mesh, shell, np.get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  };
  Mesh ours = input;
  const auto report = in_shell(ours, BS::parameters::stop(BS::Facet_count_stop_predicate(wanted)));
  if(!report) {
    print_refused(file, BS::message(report.status));
    return EXIT_FAILURE;
  }

  CGAL::Real_timer timer;
  Mesh plain = input;
  timer.start();
  Policies policies(plain);
  SMS::edge_collapse(plain, BS::Facet_count_stop_predicate(report.facets),
                     CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  const double plain_seconds = timer.time();

  Mesh coarsest = input;
  const auto last = in_shell(coarsest, BS::parameters::stop(BS::Never_stop_predicate()));

  std::cout << "{\"mesh\":" << quoted(file) << ",\"status\":\"simplified\",\"policy\":" << quoted(options.policy)
            << ",\"facets\":" << input.number_of_faces() << ",\"wanted\":" << wanted
            << ",\"shell\":{\"certified\":" << (shell.is_certified() ? "true" : "false")
            << ",\"seconds\":" << shell.report().total_seconds() << "},\"in_shell\":{"
            << quality(input, ours, unit, options) << "," << numbers(report) << "},\"plain\":{"
            << quality(input, plain, unit, options) << ",\"seconds\":" << plain_seconds << "},\"coarsest\":{"
            << quality(input, coarsest, unit, options) << "," << numbers(last) << "}}" << std::endl;
  return EXIT_SUCCESS;
}

int run(const std::string& file, const Options& options)
{
  Mesh mesh;
  const BS::Shell_status read = BS::read_triangle_mesh(file, mesh);
  if(read != BS::Shell_status::SUCCESS) {
    print_refused(file, message(read));
    return EXIT_FAILURE;
  }
  const auto shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(options.thickness));
  if(!shell) {
    print_refused(file, message(shell.status()));
    return EXIT_FAILURE;
  }
  if(options.policy == "triangle")
    return simplify<SMS::GarlandHeckbert_triangle_policies<Mesh, Kernel> >(file, mesh, shell, options);
  if(options.policy == "probabilistic-plane")
    return simplify<SMS::GarlandHeckbert_probabilistic_plane_policies<Mesh, Kernel> >(file, mesh, shell, options);
  if(options.policy == "probabilistic-triangle")
    return simplify<SMS::GarlandHeckbert_probabilistic_triangle_policies<Mesh, Kernel> >(file, mesh, shell, options);
  return simplify<Plane_policies>(file, mesh, shell, options);
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  Options options;
  std::vector<std::string> files;
  for(int n = 1; n < argc; ++n) {
    const std::string argument = argv[n];
    const bool has_value = n + 1 < argc;
    if(argument == "--facets" && has_value) options.facets = std::size_t(std::atol(argv[++n]));
    else if(argument == "--ratio" && has_value) options.ratio = std::atof(argv[++n]);
    else if(argument == "--policy" && has_value) options.policy = argv[++n];
    else if(argument == "--thickness" && has_value) options.thickness = std::atof(argv[++n]);
    else if(argument == "--points" && has_value) options.points = std::size_t(std::atol(argv[++n]));
    else if(argument == "--max-seconds" && has_value) options.max_seconds = unsigned(std::atol(argv[++n]));
    else files.push_back(argument);
  }
  if(files.empty()) {
    std::cerr
      << "Usage: simplify_benchmark FILE... [--facets N] [--ratio R] [--policy "
         "plane|triangle|probabilistic-plane|probabilistic-triangle] [--thickness T] [--points N] [--max-seconds S]\n";
    return EXIT_FAILURE;
  }
  bool failed = false;
  for(const std::string& file : files) {
    const pid_t child = fork();
    if(child == 0) {
      if(options.max_seconds > 0) alarm(options.max_seconds);
      std::_Exit(run(file, options));
    }
    int status = 0;
    waitpid(child, &status, 0);
    if(WIFSIGNALED(status))
      print_refused(file, WTERMSIG(status) == SIGALRM ? "The time limit was reached." : "The process died.");
    failed = failed || status != 0;
  }
  return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
