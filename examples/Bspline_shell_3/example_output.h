// What the examples that write a shell share: messages, progress, and files that are complete or not there.
#ifndef EXAMPLE_OUTPUT_H
#define EXAMPLE_OUTPUT_H

#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/IO/write_file.h>
#include <CGAL/Bspline_shell_3/Shell/Shell_report.h>
#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Surface/extract_shell_surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/io.h>
#include <CGAL/IO/write_ply_points.h>
#include <CGAL/Surface_mesh.h>

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

// what both programs return if they cannot go on
enum Exit_code { WRONG_USAGE = 2, CANNOT_WRITE = 3, NO_SURFACE = 4, NOT_CERTIFIED = 5, NOT_SIMPLIFIED = 6, POINTS_LOST = 7, NO_SHELL = 10 };

// names the steps in one line of a terminal, and is quiet in a pipe
struct Step_printer : BS::Default_shell_visitor
{
  bool start_step(BS::Shell_step step)
  {
    show(name(step));
    return true;
  }
  void show(const char* what) const
  {
    clear();
    if(on_terminal) std::cerr << what << " ..." << std::flush;
  }
  void clear() const { if(on_terminal) std::cerr << "\r\033[K" << std::flush; }

  const bool on_terminal = isatty(STDERR_FILENO);
};

// says what is wrong, and where
template <typename Status>
void complain(Status status, const BS::Offending_simplices& offenders)
{
  std::cerr << message(status) << std::endl;
  const auto list = [](const char* what, const std::vector<std::size_t>& simplices) {
    if(simplices.empty()) return;
    std::cerr << what << ":";
    for(std::size_t i = 0; i < (std::min)(simplices.size(), std::size_t(10)); ++i) std::cerr << " " << simplices[i];
    std::cerr << (simplices.size() > 10 ? " ... (" + std::to_string(simplices.size()) + ")" : "") << std::endl;
  };
  list("facets", offenders.facets);
  list("vertices", offenders.vertices);
}

inline int refuse(BS::Shell_status status, const BS::Offending_simplices& offenders)
{
  complain(status, offenders);
  return NO_SHELL + int(status);
}

inline int cannot_write(const std::string& file)
{
  std::cerr << "Cannot write " << file << std::endl;
  return CANNOT_WRITE;
}

// the first places where a claim is not proved
inline void list_witnesses(const BS::Certificate_report& certificate)
{
  const auto& witnesses = certificate.witnesses;
  for(std::size_t i = 0; i < (std::min)(witnesses.size(), std::size_t(10)); ++i) {
    const BS::Certificate_witness& w = witnesses[i];
    std::cerr << name(w.claim) << " is " << name(w.verdict) << " at " << w.point[0] << " " << w.point[1] << " " << w.point[2];
    if(w.facet != BS::Certificate_witness::none) std::cerr << ", facet " << w.facet;
    std::cerr << "\n";
  }
  if(certificate.total_number_of_witnesses() > 10)
    std::cerr << "... (" << certificate.total_number_of_witnesses() << " places)" << std::endl;
}

// Says which limit was reached, if one was, lists the narrowest places that stand in the way, and writes all of them as points.
inline bool report_obstacles(const BS::Shell_report& report, const std::string& file)
{
  if(report.limit.resource != BS::Refinement_resource::NONE) std::cerr << message(report.limit) << "\n";
  std::vector<Kernel::Point_3> places;
  for(const BS::Refinement_obstacle& o : report.obstacles) {
    places.emplace_back(o.point[0], o.point[1], o.point[2]);
    if(places.size() <= 5) std::cerr << message(o, report.unit) << "\n";
  }
  if(places.size() > 5) std::cerr << "... (" << places.size() << " places are listed)" << std::endl;
  return places.empty() || BS::write_file(file, [&](std::ostream& out) { out.precision(17); return CGAL::IO::write_PLY(out, places); });
}

// what had to be done to polygons before they were a mesh, if anything
inline void print_repairs(const BS::Soup_repairs& repairs)
{
  const auto line = [](std::size_t number, const char* what) {
    if(number > 0) std::cout << "repaired      " << number << " " << what << "\n";
  };
  line(repairs.merged_points, "points merged with others at their positions");
  line(repairs.removed_polygons, "polygons without three points removed");
  line(repairs.split_polygons, "polygons with a point twice taken apart");
  line(repairs.doubled_polygons, "doubled polygons removed");
  line(repairs.turned_polygons, "polygons turned round");
  line(repairs.degenerate_facets, "facets without area removed");
  if(repairs.turned_components) std::cout << "repaired      components turned inside out, to bound a volume\n";
}

// Removes results of an older run: they must not pass for those of a run that fails. Returns what is to be returned if one of them is
// the mesh itself or cannot be written, which is better known before the long computation than after it; otherwise 0.
inline int prepare_results(const std::string& mesh_file, const std::vector<std::string>& results)
{
  for(const std::string& result : results) {
    std::error_code error;
    if(std::filesystem::equivalent(result, mesh_file, error)) {
      std::cerr << "The result would replace the mesh " << mesh_file << ": choose another PREFIX" << std::endl;
      return WRONG_USAGE;
    }
  }
  for(const std::string& result : results) {
    std::remove(result.c_str());
    const std::string partial = result + ".part";
    const bool writable = std::ofstream(partial).is_open();
    std::remove(partial.c_str());
    if(!writable) return cannot_write(result);
  }
  return 0;
}

inline bool write_mesh(const std::string& file, const Mesh& mesh)
{
  return BS::write_file(file, [&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    return CGAL::IO::write_PLY(out, mesh);
  });
}

// One of the two bounding surfaces. Returns 0, or what is to be returned.
template <typename Shell>
int write_surface(const std::string& file, const Shell& shell, const typename Shell::Threshold& threshold)
{
  Mesh surface;
  const BS::Level_set_status status
    = BS::extract_shell_surface<CGAL::Parallel_if_available_tag>(shell, threshold, surface);
  if(status != BS::Level_set_status::SUCCESS) {
    std::cerr << "No " << file << ". " << message(status) << std::endl;
    return NO_SURFACE;
  }
  return write_mesh(file, surface) ? 0 : cannot_write(file);
}

#endif // EXAMPLE_OUTPUT_H
