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
  "Builds a certified shell of the polygons in FILE (OFF, OBJ, PLY or STL).\n"
  "  --thickness T           thickness, as a fraction of the longest side of the bounding box (default 0.01)\n"
  "  --time-limit SECONDS    time limit (default: none)\n"
  "  --output PREFIX         prefix of the file names (default: shell)\n"
  "Writes\n"
  "  PREFIX.shell                the shell\n"
  "  PREFIX_mesh.ply             the mesh of the shell: the repaired input, the union of its parts, the input without\n"
  "                              triangles that are excised, or a proxy\n"
  "  PREFIX_excised.ply          excised triangles, if any\n"
  "  PREFIX_{inner,outer}.ply    the bounding surfaces of the shell\n"
  "  PREFIX_soup.ply             if there is a proxy: the input polygons, green where they are carried along curves,\n"
  "                              yellow where they are continued to the nearest point, gray where they are hidden\n"
  "  PREFIX_places.ply           if the shell is not certified: points where the proof fails\n"
  "  PREFIX.json                 report on the repairs, the proxy and the shell\n"
  "The files are replaced together at the end. If the run fails (exit codes 3, 5, 10 or more), the results of an\n"
  "earlier run are kept, and the names of the new files begin with PREFIX.failed.\n"
  "Exit codes\n"
  "  0   the shell is certified, possibly except for excised triangles\n"
  "  2   wrong usage\n"
  "  3   a file cannot be written\n"
  "  4   a bounding surface cannot be extracted; the other files are written\n"
  "  5   the shell is not certified\n"
  "  10 or more    there is no shell: 10 + the number of the status (Shell_status)\n";

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
  std::cout << "area          " << 100 * shares.carried << " % carried along curves, " << 100 * shares.continued
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
  std::cout << "shell         " << found.mesh().number_of_faces() << " facets, " << name(found.kind()) << "; "
            << report.cells << " cells\n"
            << "thickness     " << 100 * found.shell().relative_thickness() << " % of the bounding box; narrower on "
            << 100 * report.narrowed_area << " % of the mesh area\n"
            << found.message() << std::endl;
  if(!write_mesh(results.pending("_mesh.ply"), found.mesh())) return CANNOT_WRITE;
  if(found.excised && !write_excised(results.pending("_excised.ply"), *found.excised)) return CANNOT_WRITE;
  if(found.proxy && !write_soup(results, *found.proxy, shares)) return CANNOT_WRITE;
  const bool has_shell = BS::write_shell(results.pending(".shell"), found.shell()) == BS::Shell_file_status::SUCCESS;
  if(!is_written(has_shell, results.pending(".shell"))) return CANNOT_WRITE;
  if(found.certification() == BS::Certification::NONE) {
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
  const Results results(options.output, { ".json", ".shell", "_mesh.ply", "_inner.ply", "_outer.ply", "_soup.ply",
                                          "_places.ply", "_excised.ply" });
  if(const int refused = results.prepare(options.file)) return refused;
  return results.finish(run(options, results));
}
