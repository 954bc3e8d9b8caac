// Shared by examples that write a shell: messages, progress, and files that are replaced together.
#ifndef EXAMPLE_OUTPUT_H
#define EXAMPLE_OUTPUT_H

#include "example_files.h"

#include <CGAL/Bspline_shell_3/Shell/Shell_report.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Surface/extract_shell_surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/PLY.h>
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
#include <utility>
#include <vector>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

// nonzero exit codes
enum Exit_code
{
  WRONG_USAGE = Arguments::wrong_usage,
  CANNOT_WRITE = 3,
  NO_SURFACE = 4,
  NOT_CERTIFIED = 5,
  NOT_SIMPLIFIED = 6,
  POINTS_LOST = 7,
  NO_SHELL = 10
};

// Shows the current step in one line of a terminal, and prints nothing if the output is redirected.
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
  void clear() const
  {
    if(on_terminal) std::cerr << "\r\033[K" << std::flush;
  }

  const bool on_terminal = isatty(STDERR_FILENO);
};

inline int refuse(BS::Shell_status status, const std::string& message, const BS::Offending_simplices& offenders,
                  const std::string& file)
{
  complain(message, offenders, file);
  return NO_SHELL + int(status);
}

// The files of a run: PREFIX and an ending. They are written under temporary names, and renamed together at the end.
// Thus, a failed run does not change the results of an earlier run.
class Results
{
public:
  Results(std::string prefix, std::vector<std::string> endings)
    : m_prefix(std::move(prefix)), m_endings(std::move(endings))
  {}
  ~Results()
  {
    for(const std::string& ending : m_endings) std::remove(pending(ending).c_str());
  }
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  // Returns 0, or the exit code if a result would replace the mesh or cannot be written. Such errors are reported
  // before the long computation.
  int prepare(const std::string& mesh_file) const
  {
    for(const std::string& ending : m_endings) {
      std::error_code error;
      if(std::filesystem::equivalent(m_prefix + ending, mesh_file, error)) {
        std::cerr << "The results would overwrite the input " << mesh_file << ": choose another PREFIX." << std::endl;
        return WRONG_USAGE;
      }
      const bool is_folder = std::filesystem::is_directory(m_prefix + ending, error);
      const bool is_writable = !is_folder && std::ofstream(pending(ending)).is_open();
      std::remove(pending(ending).c_str());
      if(!is_written(is_writable, m_prefix + ending)) return CANNOT_WRITE;
    }
    return 0;
  }

  // Returns the temporary name of a result.
  std::string pending(const std::string& ending) const { return m_prefix + ".new" + ending; }

  // Renames the written files, and returns the exit code. After success, complete or partial, they replace all results
  // of an earlier run. After a failure, earlier results are kept, and the names of the files begin with PREFIX.failed;
  // without earlier results, they begin with PREFIX.
  int finish(int code) const
  {
    const auto any_exists = [&](const std::string& prefix) {
      std::error_code error;
      const auto exists = [&](const std::string& ending) { return std::filesystem::exists(prefix + ending, error); };
      return std::any_of(m_endings.begin(), m_endings.end(), exists);
    };
    if(!any_exists(m_prefix + ".new")) return code;
    const bool has_results = code == 0 || code == NO_SURFACE || code == POINTS_LOST;
    const bool is_beside = !has_results && any_exists(m_prefix);
    const std::string prefix = m_prefix + (is_beside ? ".failed" : "");
    for(const std::string& ending : m_endings) {
      const std::string place = prefix + ending;
      std::error_code error;
      if(!std::filesystem::exists(pending(ending), error)) std::remove(place.c_str());
      else if(!is_written(std::rename(pending(ending).c_str(), place.c_str()) == 0, place)) code = CANNOT_WRITE;
    }
    if(is_beside)
      std::cerr << "The results of an earlier run were kept. The files of this run begin with " << prefix << "."
                << std::endl;
    return code;
  }

private:
  std::string m_prefix;
  std::vector<std::string> m_endings;
};

// Lists the first witnesses.
inline void list_witnesses(const BS::Certificate_report& certificate)
{
  const auto& witnesses = certificate.witnesses;
  for(std::size_t i = 0; i < (std::min)(witnesses.size(), std::size_t(10)); ++i) {
    const BS::Certificate_witness& w = witnesses[i];
    std::cerr << name(w.claim) << " is " << name(w.verdict) << " at " << place(w) << "\n";
  }
  if(certificate.total_number_of_witnesses() > 10)
    std::cerr << "... (" << certificate.total_number_of_witnesses() << " places in total)" << std::endl;
}

// Prints the reached limit, if any, and the narrowest obstacles, and writes all obstacles as points.
inline bool report_obstacles(const BS::Shell_report& report, const std::string& file)
{
  if(report.limit.resource != BS::Refinement_resource::NONE) std::cerr << message(report.limit) << "\n";
  std::vector<Kernel::Point_3> places;
  for(const BS::Refinement_obstacle& o : report.obstacles) {
    places.emplace_back(o.point[0], o.point[1], o.point[2]);
    if(places.size() <= 5) std::cerr << message(o, report.unit, report.refinement) << "\n";
  }
  if(places.size() > 5) std::cerr << "... (" << places.size() << " places in total)" << std::endl;
  return places.empty() || write_result(file, [&](std::ostream& out) {
           out.precision(17);
           return CGAL::IO::write_PLY(out, places);
         });
}

// Prints the repairs of the polygons, if any.
inline void print_repairs(const BS::Soup_repairs& repairs)
{
  const auto line = [](std::size_t number, const char* what) {
    if(number > 0) std::cout << "repaired      " << number << " " << what << "\n";
  };
  line(repairs.merged_points, "coincident points merged");
  line(repairs.removed_polygons, "polygons with fewer than three distinct points removed");
  line(repairs.split_polygons, "polygons with repeated points split");
  line(repairs.duplicate_polygons, "duplicate polygons removed");
  line(repairs.reversed_polygons, "polygons reversed");
  line(repairs.degenerate_facets, "degenerate facets removed");
  if(repairs.reversed_components) std::cout << "repaired      components reversed to bound a volume\n";
}

inline bool write_mesh(const std::string& file, const Mesh& mesh)
{
  return write_result(file, [&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    return CGAL::IO::write_PLY(out, mesh);
  });
}

// Prints the reason for a proxy, and the places where the polygons are not a mesh.
inline void print_reason(const BS::Shell_of_soup_3& found)
{
  std::cout << "proxy needed  " << found.mesh_message() << "\n";
  list_places(std::cout, "              facets", found.offending_simplices.facets);
  list_places(std::cout, "              vertices", found.offending_simplices.vertices);
}

inline bool write_excised(const std::string& file, const BS::Excised_soup_3& soup)
{
  BS::Polygon_soup::Polygons triangles;
  for(std::size_t t : soup.excised_triangles())
    triangles.emplace_back(soup.soup().triangles[t].begin(), soup.soup().triangles[t].end());
  return write_result(file, [&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    return CGAL::IO::write_PLY(out, soup.soup().points, triangles);
  });
}

// Writes one of the two bounding surfaces. Returns 0, or the exit code.
template <typename Shell>
int write_surface(const std::string& file, const Shell& shell, const typename Shell::Threshold& threshold)
{
  Mesh surface;
  const BS::Level_set_status status = BS::extract_shell_surface<CGAL::Parallel_if_available_tag>(shell, threshold,
                                                                                                 surface);
  if(status != BS::Level_set_status::SUCCESS) {
    std::cerr << file << ": " << message(status) << std::endl;
    return NO_SURFACE;
  }
  return write_mesh(file, surface) ? 0 : CANNOT_WRITE;
}

#endif // EXAMPLE_OUTPUT_H
