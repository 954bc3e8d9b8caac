// Compares the narrow band with the paper's dense grid in one run: time, peak memory, unknowns, levels, and the growth
// of the band with the resolution. Prints one JSON object per line. Every shell is built in a separate process, to get
// separate peaks of memory.
//
//   fit_benchmark [--gamma G[,G...]] [--paper-energy] [MESH ...]
//
// Default: gamma 30, 50, 70, 90 and 100 on elephant and fandisk. --paper-energy adds E_singularH in both modes.
#include "../json.h"

#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

struct Measurement
{
  double seconds = 0, peak_mb = 0, unknowns = 0, eps1 = 0, eps2 = 0;
};

std::string mesh_name(const std::string& file)
{
  const std::size_t slash = file.find_last_of('/');
  const std::string base = slash == std::string::npos ? file : file.substr(slash + 1);
  return base.substr(0, base.find_last_of('.'));
}

// Builds the shell, prints its line, and returns the measurement through a pipe.
bool measure(const std::string& file, double gamma, bool dense, bool paper_energy, Measurement& result)
{
  int ends[2];
  if(pipe(ends) != 0) return false;
  std::cout.flush();
  const pid_t child = fork();
  if(child < 0) return false;
  if(child == 0) {
    close(ends[0]);
    Mesh mesh;
    BS::Offending_simplices offenders;
    if(BS::read_polygon_mesh(file, mesh, offenders) != BS::Shell_status::SUCCESS) _exit(1);
    const auto shell = CGAL::bspline_shell_3(mesh,
                                             BS::parameters::resolution(gamma).dense_grid(dense).energy_weights(
                                               paper_energy ? BS::Energy_weights::paper() : BS::Energy_weights()));
    const BS::Shell_report& r = shell.report();
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"facets\":" << r.triangles << ",\"gamma\":" << gamma
              << ",\"mode\":\"" << (dense ? "reference" : "band") << "\",\"energy\":\""
              << (paper_energy ? "paper" : "quadratic") << "\",\"status\":\""
              << (shell ? "success" : message(shell.status())) << "\",\"cells\":" << r.cells
              << ",\"unknowns\":" << r.unknowns << ",\"widenings\":" << r.widenings;
    if(shell)
      std::cout << ",\"eps1\":" << shell.inner_level() / r.unit << ",\"eps2\":" << shell.outer_level() / r.unit
                << ",\"thickness\":" << shell.relative_thickness();
    std::cout << ",\"solves\":" << r.fit.linear_solves << ",\"iterations\":" << r.fit.iterations
              << ",\"residual\":" << r.fit.residual << ",\"seconds\":{";
    for(int s = 0; s < 5; ++s) std::cout << "\"" << name(BS::Shell_step(s)) << "\":" << r.seconds[s] << ",";
    std::cout << "\"total\":" << r.total_seconds() << "},\"peak_mb\":" << usage.ru_maxrss / 1024. << "}" << std::endl;
    if(shell) {
      const Measurement m = { r.total_seconds(), usage.ru_maxrss / 1024., double(r.unknowns),
                              shell.inner_level() / r.unit, shell.outer_level() / r.unit };
      if(write(ends[1], &m, sizeof m) != ssize_t(sizeof m)) _exit(1);
    }
    _exit(shell ? 0 : 1);
  }
  close(ends[1]);
  const bool complete = read(ends[0], &result, sizeof result) == ssize_t(sizeof result);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return complete && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  std::vector<double> gammas = { 30, 50, 70, 90, 100 };
  std::vector<std::string> files;
  bool paper_energy = false;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if(arg == "--paper-energy") paper_energy = true;
    else if(arg == "--gamma" && i + 1 < argc) {
      gammas.clear();
      std::istringstream list(argv[++i]);
      for(std::string g; std::getline(list, g, ',');) gammas.push_back(std::atof(g.c_str()));
    } else files.push_back(arg);
  }
  if(files.empty()) files = { MESHES "/elephant.off", MESHES "/fandisk.off" };

  for(const std::string& file : files) {
    std::map<double, Measurement> band;
    for(double gamma : gammas) {
      Measurement narrow, dense;
      const bool both = measure(file, gamma, false, paper_energy, narrow)
                        & measure(file, gamma, true, paper_energy, dense);
      if(!both) continue;
      band[gamma] = narrow;
      const double thickness = dense.eps2 - dense.eps1;
      std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"gamma\":" << gamma
                << ",\"reference_over_band\":{\"seconds\":" << dense.seconds / narrow.seconds
                << ",\"memory\":" << dense.peak_mb / narrow.peak_mb
                << ",\"unknowns\":" << dense.unknowns / narrow.unknowns
                << "},\"level_difference\":{\"eps1\":" << (narrow.eps1 - dense.eps1) / dense.eps1
                << ",\"eps2\":" << (narrow.eps2 - dense.eps2) / dense.eps2
                << ",\"of_thickness\":" << (narrow.eps2 - narrow.eps1 - thickness) / thickness << "}}" << std::endl;
    }
    if(band.count(50) && band.count(100))
      std::cout << "{\"mesh\":" << quoted(mesh_name(file))
                << ",\"growth\":\"gamma 50 to 100\",\"seconds\":" << band[100].seconds / band[50].seconds
                << ",\"memory\":" << band[100].peak_mb / band[50].peak_mb << "}" << std::endl;
  }
  return EXIT_SUCCESS;
}
