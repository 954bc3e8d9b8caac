// Shared by programs that measure maps: a certified shell, and a second mesh that is certified for it.
#ifndef BENCHMARK_MESHES_IN_SHELL_H
#define BENCHMARK_MESHES_IN_SHELL_H

#include "json.h"

#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef CGAL::Certified_bspline_shell_3 Shell;

inline std::string mesh_name(const std::string& file)
{
  const std::string base = file.substr(file.find_last_of('/') + 1);
  return base.substr(0, base.find_last_of('.'));
}

inline bool read_triangles(const std::string& file, Mesh& mesh)
{
  return BS::read_triangle_mesh(file, mesh) == BS::Shell_status::SUCCESS;
}

// Returns the mesh with its vertices moved along the flow, inwards and outwards. They are moved by up to 80 % of the
// way to the thresholds; this is halved until the mesh is certified. `part` is that share.
inline std::optional<Mesh> moved_along_flow(const Shell& shell, const Mesh& mesh, double& part)
{
  const BS::Gradient_flow_3<Shell> flow(shell);
  BS::Shell_certificate_3<Shell::Field, Shell::Threshold> certificate(shell);
  const double unit = shell.report().unit;
  for(part = 0.8; part > 0.001; part /= 2) {
    Mesh moved = mesh;
    bool complete = true;
    for(Mesh::Vertex_index v : moved.vertices()) {
      const Kernel::Point_3 p = mesh.point(v);
      const double f = *shell.field().value(p);
      const double wave = std::sin(25 * p.x() / unit) * std::cos(21 * p.y() / unit) * std::cos(17 * p.z() / unit);
      const double room = wave > 0 ? shell.outer_threshold().value(p) - f : f - shell.inner_threshold().value(p);
      const auto arrival = flow.trace(p, f + part * wave * room);
      complete = complete && arrival;
      if(arrival) moved.point(v) = arrival.point;
    }
    if(complete && certificate.verify(moved)) return moved;
  }
  return std::nullopt;
}

// Returns uniformly distributed locations on the surface.
inline std::vector<std::pair<Mesh::Face_index, std::array<double, 3> > > random_locations(const Mesh& mesh,
                                                                                          std::size_t number,
                                                                                          unsigned int seed)
{
  std::vector<double> area;
  std::vector<Mesh::Face_index> facets;
  double sum = 0;
  for(Mesh::Face_index f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    sum += std::sqrt(CGAL::squared_area(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                        mesh.point(mesh.target(mesh.next(h)))));
    area.push_back(sum);
    facets.push_back(f);
  }
  CGAL::Random random(seed);
  std::vector<std::pair<Mesh::Face_index, std::array<double, 3> > > result;
  while(result.size() < number) {
    const std::size_t f = std::size_t(std::lower_bound(area.begin(), area.end(), random.get_double(0, sum))
                                      - area.begin());
    double u = random.get_double(), v = random.get_double();
    if(u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    result.emplace_back(facets[(std::min)(f, facets.size() - 1)], std::array<double, 3>{ 1 - u - v, u, v });
  }
  return result;
}

// [--points N] [MESH ...]
struct Benchmark_arguments
{
  Benchmark_arguments(int argc, char** argv, std::size_t default_points, const std::string& default_file)
    : points(default_points)
  {
    for(int i = 1; i < argc; ++i) {
      if(std::string(argv[i]) == "--points" && i + 1 < argc) points = std::size_t(std::atoll(argv[++i]));
      else files.push_back(argv[i]);
    }
    if(files.empty()) files.push_back(default_file);
  }

  std::size_t points;
  std::vector<std::string> files;
};

// Calls measure(name, shell, mesh, moved, part) for each mesh with a certified shell and a second mesh in it.
// Otherwise, prints a status.
template <typename Measure>
void for_each_pair(const std::vector<std::string>& files, const Measure& measure)
{
  for(const std::string& file : files) {
    Mesh mesh;
    double part = 0;
    std::optional<Mesh> moved;
    std::optional<Shell> shell;
    if(read_triangles(file, mesh)) shell = CGAL::certified_bspline_shell_3(mesh);
    if(shell && shell->is_certified()) moved = moved_along_flow(*shell, mesh, part);
    if(moved) measure(mesh_name(file), *shell, mesh, *moved, part);
    else
      std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"status\":\"no certified pair of meshes\"}"
                << std::endl;
  }
}

#endif // BENCHMARK_MESHES_IN_SHELL_H
