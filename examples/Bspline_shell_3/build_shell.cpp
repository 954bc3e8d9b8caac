// Builds the shell of a closed mesh on equal cells, and prints its properties. Writes the two bounding surfaces, and
// the mesh with f and colors at its vertices; render_shell.py draws them. The usage below lists the exit codes.
#include "example_output.h"

#include <CGAL/bspline_shell_3.h>

#include <CGAL/IO/Color.h>
#include <CGAL/Real_timer.h>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>

const char* const usage =
  "Usage: build_shell MESH [--resolution CELLS] [--paper] [--output PREFIX]\n"
  "Builds the shell of a mesh on equal cells.\n"
  "  --resolution CELLS    cells along the longest side of the bounding box (default 80)\n"
  "  --paper               use all cells of the bounding box, and all terms of the paper's energy\n"
  "  --output PREFIX       prefix of the file names (default: shell)\n"
  "Writes the bounding surfaces PREFIX_{inner,outer}.ply, and PREFIX_mesh.ply with the values of f. The files are\n"
  "replaced together at the end. If the run fails, the results of an earlier run are kept.\n"
  "Exit codes\n"
  "  0   success\n"
  "  2   wrong usage\n"
  "  3   a file cannot be written\n"
  "  4   a bounding surface cannot be extracted; the other files are written\n"
  "  10 or more    there is no shell: 10 + the number of the status (Shell_status)\n";

// Maps negative values to blue, zero to white, and positive values to red. The threshold farther from zero has the full
// color.
CGAL::IO::Color color(double f, double inner, double outer)
{
  const double full = (std::max)(std::abs(inner), std::abs(outer));
  const double t = full > 0 ? (std::min)(std::abs(f) / full, 1.) : 0;
  const unsigned char fade = static_cast<unsigned char>(255 * (1 - t));
  return f < 0 ? CGAL::IO::Color(fade, fade, 255) : CGAL::IO::Color(255, fade, fade);
}

struct Options
{
  std::string file, output = "shell";
  double resolution = 80;
  bool paper = false;
};

// Computes and writes all results, and returns the exit code.
int run(const Options& options, const Results& results)
{
  Mesh mesh;
  BS::Offending_simplices offenders;
  const BS::Shell_status read = BS::read_polygon_mesh(options.file, mesh, offenders);
  if(read != BS::Shell_status::SUCCESS) return refuse(read, message(read), offenders, options.file);

  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
  Step_printer printer;
  const CGAL::Bspline_shell_3<> shell = CGAL::bspline_shell_3(
    mesh, BS::parameters::resolution(options.resolution)
            .dense_grid(options.paper)
            .energy_weights(options.paper ? BS::Energy_weights::paper() : BS::Energy_weights())
            .memory_limit(0.8 * memory)
            .visitor(std::ref(printer)));
  printer.clear();
  if(!shell) return refuse(shell.status(), shell.message(), shell.report().offending_simplices, options.file);

  CGAL::Real_timer timer;
  timer.start();
  const int inner = write_surface(results.pending("_inner.ply"), shell, shell.inner_threshold());
  const int outer = write_surface(results.pending("_outer.ply"), shell, shell.outer_threshold());
  auto f_map = mesh.add_property_map<Mesh::Vertex_index, double>("v:f", 0).first;
  auto color_map = mesh.add_property_map<Mesh::Vertex_index, CGAL::IO::Color>("v:color").first;
  for(auto v : mesh.vertices()) {
    f_map[v] = shell.field().value(mesh.point(v)).value_or(0);
    color_map[v] = color(f_map[v], shell.inner_level(), shell.outer_level());
  }
  const bool has_mesh = write_mesh(results.pending("_mesh.ply"), mesh);
  if(!has_mesh || inner == CANNOT_WRITE || outer == CANNOT_WRITE) return CANNOT_WRITE;
  const double output_seconds = timer.time();

  const BS::Shell_report& r = shell.report();
  struct rusage used;
  getrusage(RUSAGE_SELF, &used);
  const auto row = [](const std::string& what) -> std::ostream& {
    return std::cout << std::left << std::setw(22) << what;
  };
  row("mesh") << options.file << "\n";
  row("facets, components") << r.triangles << ", " << r.components << "\n";
  row("resolution") << r.gamma << " cells along the longest side of the bounding box\n";
  row("cells") << r.cells << "\n";
  row("unknowns") << r.unknowns << "\n";
  row("eps1, eps2") << shell.inner_level() << ", " << shell.outer_level() << "\n";
  row("thickness") << 100 * shell.relative_thickness() << " % of the bounding box\n";
  std::cout << std::fixed << std::setprecision(2);
  for(int s = 0; s < 5; ++s) row(std::string("seconds: ") + name(BS::Shell_step(s))) << r.seconds[s] << "\n";
  row("seconds: surfaces") << output_seconds << "\n";
  row("seconds: total") << r.total_seconds() + output_seconds << "\n";
  row("peak memory") << used.ru_maxrss / 1024 << " MB\n";
  return (std::max)(inner, outer);
}

int main(int argc, char** argv)
{
  Options options;
  const auto code = Arguments(usage)
                      .required(options.file)
                      .option("--output", options.output)
                      .option("--resolution", options.resolution)
                      .flag("--paper", options.paper)
                      .read(argc, argv);
  if(code) return *code;
  const Results results(options.output, { "_inner.ply", "_outer.ply", "_mesh.ply" });
  if(const int refused = results.prepare(options.file)) return refused;
  return results.finish(run(options, results));
}
