// The front door for files: reads polygons as they are, repairs what can be repaired, and writes a certified shell of the mesh, closed
// virtually if it is open, or of a proxy around what is no mesh.
#include "example_output.h"

#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/Bspline_shell_3/Soup/sample_soup_shares.h>
#include <CGAL/Bspline_shell_3/Soup/write_report.h>
#include <CGAL/certified_shell_of_soup_3.h>

#include <CGAL/IO/Color.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>

const char* const usage =
  "Usage: shell_of_file FILE [--thickness T] [--time-limit SECONDS] [--output PREFIX]\n"
  "  T is a part of the longest side of the box, by default 0.01; PREFIX is shell if not given. By default, time is not limited.\n"
  "  Writes\n"
  "    PREFIX.shell                the shell\n"
  "    PREFIX_mesh.ply             the mesh that the shell is of: the file's, repaired, or a proxy\n"
  "    PREFIX_{inner,outer}.ply    the surfaces that bound the shell\n"
  "    PREFIX_soup.ply             with a proxy, the file's polygons; green: carried by curves, yellow: continued to the nearest point,\n"
  "                                grey: hidden from the proxy\n"
  "    PREFIX_places.ply           without a proof, points that stand in the way\n"
  "    PREFIX.json                 what was done, and why\n"
  "  Exit codes: 0 certified; 2 wrong usage; 3 a file cannot be written; 4 a bounding surface cannot be extracted; 5 not certified;\n"
  "  10 + the status (Status.h) if there is no shell.\n";

// the polygons as a mesh, and what becomes of their points
bool write_soup(const std::string& file, const BS::Soup_proxy_3& proxy, const BS::Soup_shares& shares)
{
  Mesh soup = proxy.soup().mesh();
  auto color = soup.add_property_map<Mesh::Face_index, CGAL::IO::Color>("f:color").first;
  std::size_t n = 0;
  for(auto f : soup.faces()) {
    const BS::Soup_point p = shares.facets[n++];
    color[f] = p == BS::Soup_point::CARRIED ? CGAL::IO::Color(90, 170, 90)
             : p == BS::Soup_point::CONTINUED ? CGAL::IO::Color(235, 190, 60) : CGAL::IO::Color(150, 150, 150);
  }
  std::cout << "carried       " << 100 * shares.carried << " % of the area; " << 100 * shares.continued << " % continued to the nearest point, "
            << 100 * shares.hidden << " % hidden\n";
  return write_mesh(file, soup);
}

int main(int argc, char** argv)
{
  std::string file, output = "shell";
  double thickness = 0.01, limit = std::numeric_limits<double>::infinity();
  bool is_usable = true;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    const bool has_value = i + 1 < argc;
    const auto positive = [&](double& x) {
      char* end;
      x = std::strtod(argv[++i], &end);
      is_usable = is_usable && *end == '\0' && end != argv[i] && std::isfinite(x) && x > 0;
    };
    if(arg == "--thickness" && has_value) positive(thickness);
    else if(arg == "--time-limit" && has_value) positive(limit);
    else if(arg == "--output" && has_value) output = argv[++i];
    else if(file.empty() && arg[0] != '-') file = arg;
    else is_usable = false;
  }
  if(file.empty() || !is_usable) {
    std::cerr << usage;
    return WRONG_USAGE;
  }
  const std::string shell_file = output + ".shell", mesh_file = output + "_mesh.ply", inner_file = output + "_inner.ply",
                    outer_file = output + "_outer.ply", soup_file = output + "_soup.ply", places_file = output + "_places.ply",
                    report_file = output + ".json";
  if(const int code = prepare_results(file, { shell_file, mesh_file, inner_file, outer_file, soup_file, places_file, report_file })) return code;

  BS::Polygon_soup soup;
  BS::Offending_simplices offenders;
  const BS::Shell_status read = BS::read_polygon_soup(file, soup, offenders);
  if(read != BS::Shell_status::SUCCESS) return refuse(read, offenders);
  Step_printer printer;
  const BS::Shell_of_soup_3 found = CGAL::certified_shell_of_soup_3(
    soup, BS::parameters::relative_thickness(thickness).time_limit(limit).visitor(std::ref(printer)));
  printer.clear();
  const BS::Soup_shares shares = found.proxy ? BS::sample_soup_shares(found.proxy->map()) : BS::Soup_shares();
  if(!BS::write_file(report_file, [&](std::ostream& out) { return BS::write_report(out, found, shares, file); })) return cannot_write(report_file);
  if(!found) return refuse(found.status(), found.offending_simplices);

  print_repairs(found.repairs);
  if(found.proxy) std::cout << "no mesh       " << found.mesh_message() << "\n";
  const BS::Shell_report& report = found.shell().report();
  std::cout << "shell         of " << found.mesh().number_of_faces() << " facets, " << name(found.kind()) << "; " << report.cells << " cells\n"
            << "thickness     " << 100 * found.shell().relative_thickness() << " % of the box, less on " << 100 * report.narrowed_area
            << " % of the mesh\n" << found.message() << std::endl;
  if(!write_mesh(mesh_file, found.mesh())) return cannot_write(mesh_file);
  if(found.proxy && !write_soup(soup_file, *found.proxy, shares)) return cannot_write(soup_file);
  if(BS::write_shell(shell_file, found.shell()) != BS::Shell_file_status::SUCCESS) return cannot_write(shell_file);
  if(!found.is_certified()) {
    list_witnesses(report.certificate);
    return report_obstacles(report, places_file) ? int(NOT_CERTIFIED) : cannot_write(places_file);
  }
  return (std::max)(write_surface(inner_file, found.shell(), found.shell().inner_threshold()),
                    write_surface(outer_file, found.shell(), found.shell().outer_threshold()));
}
