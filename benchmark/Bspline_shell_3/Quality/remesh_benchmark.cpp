// Compares remeshing in a shell with CGAL's isotropic remeshing: quality of triangles, certificate, time. Prints one
// JSON object per line.
//
//   remesh_benchmark [--edges N] [--iterations I] [--thickness T] [MESH ...]
//
// The target length of edges is the longest side of the mesh's box divided by N (default 60); I is 5 by default.
// Quality is twice the ratio of inradius to circumradius. Edges sharper than 60 degrees are constrained in both
// methods.
#include "../meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Real_timer.h>

#include <cstdlib>
#include <iostream>
#include <unistd.h>
#include <sys/wait.h>

namespace PMP = CGAL::Polygon_mesh_processing;

struct Quality
{
  double least = 0, percentile = 0, median = 0;
};

Quality quality(const Mesh& mesh)
{
  std::vector<double> all;
  for(Mesh::Face_index f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Kernel::Point_3 &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h)),
                          &r = mesh.point(mesh.target(mesh.next(h)));
    const double a = std::sqrt(CGAL::squared_distance(q, r)), b = std::sqrt(CGAL::squared_distance(r, p)),
                 c = std::sqrt(CGAL::squared_distance(p, q));
    const double denominator = (a + b + c) * a * b * c;
    all.push_back(denominator > 0 ? 16 * CGAL::to_double(CGAL::squared_area(p, q, r)) / denominator : 0);
  }
  std::sort(all.begin(), all.end());
  return { all.front(), all[all.size() / 100], all[all.size() / 2] };
}

std::ostream& operator<<(std::ostream& out, const Quality& q)
{
  return out << "{\"least\":" << q.least << ",\"percentile_1\":" << q.percentile << ",\"median\":" << q.median << "}";
}

void measure(const std::string& file, double edges, unsigned int iterations, double thickness)
{
  Mesh mesh;
  std::optional<Shell> shell;
  if(read_triangles(file, mesh))
    shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(thickness));
  if(!shell || !shell->is_certified()) {
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"status\":\"no certified shell\"}" << std::endl;
    return;
  }
  const double length = shell->report().unit / edges;
  auto sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
  PMP::detect_sharp_edges(mesh, 60, sharp);
  Mesh plain = mesh;
  // the copy of the property map
  const auto sharp_of_plain = plain.add_property_map<Mesh::Edge_index, bool>("e:sharp").first;

  CGAL::Real_timer timer;
  timer.start();
  PMP::isotropic_remeshing(plain.faces(), length, plain,
                           CGAL::parameters::number_of_iterations(iterations)
                             .number_of_relaxation_steps(2)
                             .edge_is_constrained_map(sharp_of_plain));
  const double plain_seconds = timer.time();
  plain.collect_garbage();

  timer.reset();
  const Quality before = quality(mesh);
  const auto report = BS::remesh_in_shell(
    mesh, length, *shell,
    BS::parameters::number_of_iterations(iterations).number_of_relaxation_steps(2).edge_is_constrained_map(sharp));
  const double seconds = timer.time();
  std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"status\":\""
            << (report ? "certified" : message(report.status)) << "\",\"facets\":" << report.facets_before
            << ",\"before\":" << before << ",\"in_shell\":{\"facets\":" << report.facets
            << ",\"quality\":" << quality(mesh) << ",\"splits\":" << report.splits
            << ",\"collapses\":" << report.collapses << ",\"flips\":" << report.flips << ",\"moves\":" << report.moves
            << ",\"rejected\":{";
  for(auto v :
      { BS::Placement_verdict::LEAVES_SHELL, BS::Placement_verdict::FACES_AWAY, BS::Placement_verdict::WINDS_TWICE })
    std::cout << (v == BS::Placement_verdict::LEAVES_SHELL ? "" : ",") << "\"" << name(v)
              << "\":" << report.placements.number(v);
  std::cout << "},\"self_intersects\":" << (PMP::does_self_intersect(mesh) ? "true" : "false")
            << ",\"seconds\":{\"check\":" << report.check_seconds << ",\"operations\":" << report.edit_seconds
            << ",\"certificate\":" << report.certificate_seconds << ",\"total\":" << seconds
            << "}},\"isotropic_remeshing\":{\"facets\":" << plain.number_of_faces() << ",\"quality\":" << quality(plain)
            << ",\"self_intersects\":" << (PMP::does_self_intersect(plain) ? "true" : "false")
            << ",\"seconds\":" << plain_seconds << "},\"times\":" << seconds / plain_seconds << "}" << std::endl;
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  double edges = 60, thickness = 0.01;
  unsigned int iterations = 5;
  std::vector<std::string> files;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if(arg == "--edges" && i + 1 < argc) edges = std::atof(argv[++i]);
    else if(arg == "--iterations" && i + 1 < argc) iterations = static_cast<unsigned int>(std::atoi(argv[++i]));
    else if(arg == "--thickness" && i + 1 < argc) thickness = std::atof(argv[++i]);
    else files.push_back(arg);
  }
  if(!(edges > 0 && thickness > 0 && iterations > 0)) {
    std::cerr << "Usage: remesh_benchmark [--edges N] [--iterations I] [--thickness T] [MESH ...]\n";
    return 2;
  }
  if(files.empty()) files.push_back(MESHES "/anchor.off");
  for(const std::string& file : files) {
    // Each mesh has a separate process, as isotropic remeshing can fail.
    std::cout.flush();
    const pid_t child = fork();
    if(child == 0) {
      measure(file, edges, iterations, thickness);
      _exit(0);
    }
    int status = 1;
    if(child < 0 || waitpid(child, &status, 0) < 0 || status != 0)
      std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"status\":\"the process did not end well\"}"
                << std::endl;
  }
  return EXIT_SUCCESS;
}
