// Compares the paper's check (Section 5.2) with the proof: W is the share of Poisson-disk samples on the mesh that lie
// between the levels. If containment is proved, W must be one. Prints one JSON object per line.
//
//   sample_containment [--gamma G[,G...]] [--samples N] FILE...
#include "../json.h"

#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <unordered_map>
#include <vector>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef Kernel::Point_3 Point_3;
typedef CGAL::Surface_mesh<Point_3> Mesh;

// Dart throwing: keeps each uniform sample without an earlier kept one within the radius. With a radius of 3/4 of the
// mean spacing, about ten times as many samples are needed.
std::vector<Point_3> poisson_disk_samples(const Mesh& mesh, std::size_t size)
{
  const double radius = 0.75 * std::sqrt(CGAL::Polygon_mesh_processing::area(mesh) / double(size));
  const double cell = radius / std::sqrt(3.); // contains at most one sample
  std::unordered_map<std::uint64_t, std::size_t> grid;
  const auto key = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    constexpr std::uint64_t mask = (1u << 21) - 1;
    return (std::uint64_t(i) & mask) << 42 | (std::uint64_t(j) & mask) << 21 | (std::uint64_t(k) & mask);
  };
  std::vector<Point_3> kept;
  for(unsigned int round = 0; round < 40 && kept.size() < size; ++round) {
    std::vector<Point_3> darts;
    CGAL::Polygon_mesh_processing::sample_triangle_mesh(mesh, std::back_inserter(darts),
                                                        CGAL::parameters::use_random_uniform_sampling(true)
                                                          .number_of_points_on_faces(size)
                                                          .do_sample_vertices(false)
                                                          .do_sample_edges(false)
                                                          .random_seed(round + 1));
    for(const Point_3& p : darts) {
      const std::int64_t i = std::int64_t(std::floor(p.x() / cell)), j = std::int64_t(std::floor(p.y() / cell)),
                         k = std::int64_t(std::floor(p.z() / cell));
      bool alone = true;
      for(int dk = -2; dk <= 2 && alone; ++dk)
        for(int dj = -2; dj <= 2 && alone; ++dj)
          for(int di = -2; di <= 2 && alone; ++di) {
            const auto it = grid.find(key(i + di, j + dj, k + dk));
            alone = it == grid.end() || CGAL::squared_distance(kept[it->second], p) >= radius * radius;
          }
      if(!alone || kept.size() == size) continue;
      grid[key(i, j, k)] = kept.size();
      kept.push_back(p);
    }
  }
  return kept;
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  std::vector<double> gammas = { 50 };
  std::vector<std::string> files;
  std::size_t size = 100000;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if(arg == "--gamma" && i + 1 < argc) {
      gammas.clear();
      std::istringstream list(argv[++i]);
      for(std::string g; std::getline(list, g, ',');) gammas.push_back(std::atof(g.c_str()));
    } else if(arg == "--samples" && i + 1 < argc) size = std::size_t(std::atol(argv[++i]));
    else files.push_back(arg);
  }
  if(files.empty()) {
    std::cerr << "Usage: sample_containment [--gamma G[,G...]] [--samples N] FILE...\n";
    return 2;
  }
  int exit_code = EXIT_SUCCESS;
  for(const std::string& file : files) {
    Mesh mesh;
    if(BS::read_triangle_mesh(file, mesh) != BS::Shell_status::SUCCESS) continue;
    std::vector<Point_3> samples;
    for(double gamma : gammas) {
      const auto shell = CGAL::bspline_shell_3(
        mesh, BS::parameters::resolution(gamma).allow_open_shell(true).allow_singular_vertices(true));
      if(!shell) continue;
      BS::Shell_certificate_3<> certificate(shell);
      certificate.verify(mesh);
      const bool proved = certificate.verdict(BS::Claim::CONTAINMENT) == BS::Verdict::PROVED;
      if(samples.empty()) samples = poisson_disk_samples(mesh, size);
      std::size_t contained = 0;
      for(const Point_3& p : samples) {
        const auto f = shell.field().value(p);
        contained += f && *f >= shell.inner_level() && *f <= shell.outer_level();
      }
      const double w = double(contained) / double(samples.size());
      std::cout << "{\"mesh\":" << quoted(file) << ",\"gamma\":" << gamma << ",\"samples\":" << samples.size()
                << ",\"W\":" << w << ",\"containment\":\"" << name(certificate.verdict(BS::Claim::CONTAINMENT)) << "\"}"
                << std::endl;
      if(proved && contained < samples.size()) exit_code = EXIT_FAILURE;
    }
  }
  return exit_code;
}
