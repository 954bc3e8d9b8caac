// What the examples that write a shell share: messages, progress, and files that are complete or not there.
#ifndef EXAMPLE_OUTPUT_H
#define EXAMPLE_OUTPUT_H

#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/IO/write_file.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Surface/extract_level_set.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/io.h>
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

// One of the two bounding surfaces. Returns 0, or what is to be returned. Where a threshold varies, parts of its level set that are no
// part of the surface may pass the cells.
template <typename Shell>
int write_surface(const std::string& file, const Shell& shell, const typename Shell::Threshold& threshold)
{
  Mesh surface;
  const BS::Level_set_status status = BS::extract_level_set<CGAL::Parallel_if_available_tag>(
    shell.field(), threshold, surface, BS::parameters::filter([&](auto cell) { return shell.shell_cells()[cell] != 0; })
                                                      .skip_open_components(!Shell::Threshold::is_constant));
  if(status != BS::Level_set_status::SUCCESS) {
    std::cerr << "No " << file << ". " << message(status) << std::endl;
    return NO_SURFACE;
  }
  return write_mesh(file, surface) ? 0 : cannot_write(file);
}

#endif // EXAMPLE_OUTPUT_H
