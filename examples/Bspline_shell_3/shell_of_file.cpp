// Builds a certified shell of the polygons in a file, without requirements on their quality. They are repaired if
// possible. The shell is that of the mesh, virtually closed if it is open. If the polygons are not a mesh, or this
// shell is not certified, it is that of a proxy.
#include "example_output.h"

#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/Bspline_shell_3/Soup/sample_soup_shares.h>
#include <CGAL/Bspline_shell_3/Soup/write_report.h>
#include <CGAL/certified_shell_of_soup_3.h>

#include <CGAL/IO/Color.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

const char* const usage =
  "Usage: shell_of_file FILE [--thickness T] [--time-limit SECONDS] [--output PREFIX]\n"
  "  T is a part of the longest side of the box, by default 0.01; PREFIX is shell if not given. By default, time is "
  "not limited.\n"
  "  Writes\n"
  "    PREFIX.shell                the shell\n"
  "    PREFIX_mesh.ply             the mesh that the shell is of: the file's, repaired, or a proxy\n"
  "    PREFIX_{inner,outer}.ply    the surfaces that bound the shell\n"
  "    PREFIX_soup.ply             with a proxy, the file's polygons; green: carried by curves, yellow: continued to "
  "the nearest point,\n"
  "                                grey: hidden from the proxy\n"
  "    PREFIX_places.ply           without a proof, points that stand in the way\n"
  "    PREFIX.json                 what was done, and why\n"
  "  Files take their places together at the end. If the run fails (3, 5, 10 or more), results of an earlier run "
  "stay,\n"
  "  and the files of this one are named PREFIX.failed.\n"
  "  Exit codes: 0 certified; 2 wrong usage; 3 a file cannot be written; 4 a bounding surface cannot be extracted, "
  "the\n"
  "  other files are written; 5 not certified; 10 + the status (Status.h) if there is no shell.\n";

// Writes the polygons as a mesh, colored by the status of their points.
bool write_soup(const Results& results, const BS::Soup_proxy_3& proxy, const BS::Soup_shares& shares)
{
  Mesh soup = proxy.soup().mesh();
  auto color = soup.add_property_map<Mesh::Face_index, CGAL::IO::Color>("f:color").first;
  std::size_t n = 0;
  for(auto f : soup.faces()) {
    const BS::Soup_point p = shares.facets[n++];
    color[f] = p == BS::Soup_point::CARRIED     ? CGAL::IO::Color(90, 170, 90)
               : p == BS::Soup_point::CONTINUED ? CGAL::IO::Color(235, 190, 60)
                                                : CGAL::IO::Color(150, 150, 150);
  }
  std::cout << "carried       " << 100 * shares.carried << " % of the area; " << 100 * shares.continued
            << " % continued to the nearest point, " << 100 * shares.hidden << " % hidden\n";
  return write_mesh(results.pending("_soup.ply"), soup);
}

struct Options
{
  std::string file, output = "shell";
  double thickness = 0.01, limit = std::numeric_limits<double>::infinity();
};

// Computes and writes all results, and returns the exit code.
int run(const Options& options, const Results& results)
{
  BS::Polygon_soup soup;
  BS::Offending_simplices offenders;
  const BS::Shell_status read = BS::read_polygon_soup(options.file, soup, offenders);
  if(read != BS::Shell_status::SUCCESS) return refuse(read, message(read), offenders, options.file);
  Step_printer printer;
  const BS::Shell_of_soup_3 found = CGAL::certified_shell_of_soup_3(
    soup, BS::parameters::relative_thickness(options.thickness).time_limit(options.limit).visitor(std::ref(printer)));
  printer.clear();
  const BS::Soup_shares shares = found.proxy ? BS::sample_soup_shares(found.proxy->map()) : BS::Soup_shares();
  const auto write_report = [&](std::ostream& out) { return BS::write_report(out, found, shares, options.file); };
  if(!write_result(results.pending(".json"), write_report)) return CANNOT_WRITE;
  if(!found) return refuse(found.status(), found.message(), found.offending_simplices, options.file);

  print_repairs(found.repairs);
  if(found.proxy) print_reason(found);
  const BS::Shell_report& report = found.shell().report();
  std::cout << "shell         of " << found.mesh().number_of_faces() << " facets, " << name(found.kind()) << "; "
            << report.cells << " cells\n"
            << "thickness     " << 100 * found.shell().relative_thickness() << " % of the box, less on "
            << 100 * report.narrowed_area << " % of the mesh\n"
            << found.message() << std::endl;
  if(!write_mesh(results.pending("_mesh.ply"), found.mesh())) return CANNOT_WRITE;
  if(found.proxy && !write_soup(results, *found.proxy, shares)) return CANNOT_WRITE;
  const bool has_shell = BS::write_shell(results.pending(".shell"), found.shell()) == BS::Shell_file_status::SUCCESS;
  if(!is_written(has_shell, results.pending(".shell"))) return CANNOT_WRITE;
  if(!found.is_certified()) {
    list_witnesses(report.certificate);
    return report_obstacles(report, results.pending("_places.ply")) ? NOT_CERTIFIED : CANNOT_WRITE;
  }
  const int inner = write_surface(results.pending("_inner.ply"), found.shell(), found.shell().inner_threshold());
  const int outer = write_surface(results.pending("_outer.ply"), found.shell(), found.shell().outer_threshold());
  return inner == CANNOT_WRITE || outer == CANNOT_WRITE ? int(CANNOT_WRITE) : (std::max)(inner, outer);
}

int main(int argc, char** argv)
{
  Options options;
  const auto code = Arguments(usage)
                      .required(options.file)
                      .option("--output", options.output)
                      .option("--thickness", options.thickness)
                      .option("--time-limit", options.limit)
                      .read(argc, argv);
  if(code) return *code;
  const Results results(options.output,
                        { ".json", ".shell", "_mesh.ply", "_inner.ply", "_outer.ply", "_soup.ply", "_places.ply" });
  if(const int refused = results.prepare(options.file)) return refused;
  return results.finish(run(options, results));
}
