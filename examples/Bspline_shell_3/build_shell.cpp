// Reads a mesh, builds its shell, prints a table, and writes the two bounding surfaces and the mesh with f and a colour
// at its vertices.
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/IO/write_file.h>
#include <CGAL/Bspline_shell_3/extract_level_set.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/Color.h>
#include <CGAL/Real_timer.h>
#include <CGAL/Surface_mesh.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <string>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

// names the steps on a terminal, and is quiet in a pipe
struct Step_printer : BS::Default_shell_visitor
{
  bool start_step(BS::Shell_step step)
  {
    if(isatty(STDERR_FILENO)) std::cerr << "\r\033[K" << name(step) << " ..." << std::flush;
    return true;
  }
  ~Step_printer() { if(isatty(STDERR_FILENO)) std::cerr << "\r\033[K"; }
};

int refuse(BS::Shell_status status, const BS::Offending_simplices& offenders)
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
  return 10 + int(status);
}

// blue at the inner level, white at zero, red at the outer level
CGAL::IO::Color color(double f, double inner, double outer)
{
  const double t = f < 0 ? f / inner : f / outer;
  const unsigned char fade = static_cast<unsigned char>(255 * (1 - (std::min)((std::max)(t, 0.), 1.)));
  return f < 0 ? CGAL::IO::Color(fade, fade, 255) : CGAL::IO::Color(255, fade, fade);
}

bool write_mesh(const std::string& file, const Mesh& mesh)
{
  return BS::write_file(file, [&](std::ostream& out) {
    return CGAL::IO::write_PLY(out, mesh, CGAL::parameters::stream_precision(17));
  });
}

int main(int argc, char** argv)
{
  std::string file, output = "shell";
  double resolution = 50;
  bool paper = false, usable = true;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if(arg == "--resolution" && i + 1 < argc) resolution = std::atof(argv[++i]);
    else if(arg == "--output" && i + 1 < argc) output = argv[++i];
    else if(arg == "--paper") paper = true;
    else if(file.empty() && arg[0] != '-') file = arg;
    else usable = false;
  }
  if(file.empty() || !usable || !(resolution > 0)) {
    std::cerr << "Usage: build_shell MESH [--resolution CELLS] [--paper] [--output PREFIX]\n"
                 "  CELLS cells along the longest side of the mesh's box (50); --paper: all cells of the box and all\n"
                 "  terms of the paper's energy. Writes PREFIX_{inner,outer,mesh}.ply.\n";
    return 2;
  }

  Mesh mesh;
  BS::Offending_simplices offenders;
  const BS::Shell_status read = BS::read_polygon_mesh(file, mesh, offenders);
  if(read != BS::Shell_status::SUCCESS) return refuse(read, offenders);

  Step_printer printer;
  const CGAL::Bspline_shell_3<> shell = CGAL::bspline_shell_3(mesh,
    BS::parameters::resolution(resolution)
                   .dense_grid(paper)
                   .energy_weights(paper ? BS::Energy_weights::paper() : BS::Energy_weights())
                   .visitor(std::ref(printer)));
  if(!shell) return refuse(shell.status(), shell.report().offending_simplices);

  CGAL::Real_timer timer;
  timer.start();
  for(bool outer : { false, true }) {
    Mesh surface;
    const BS::Level_set_status status = BS::extract_level_set<CGAL::Parallel_if_available_tag>(
      shell.field(), outer ? shell.outer_level() : shell.inner_level(), surface,
      CGAL::parameters::filter([&](auto cell) { return shell.shell_cells()[cell] != 0; }));
    if(status != BS::Level_set_status::SUCCESS) std::cerr << message(status) << std::endl;
    else if(!write_mesh(output + (outer ? "_outer.ply" : "_inner.ply"), surface)) {
      std::cerr << "Cannot write " << output << "_*.ply" << std::endl;
      return 3;
    }
  }
  auto f_map = mesh.add_property_map<Mesh::Vertex_index, double>("v:f", 0).first;
  auto color_map = mesh.add_property_map<Mesh::Vertex_index, CGAL::IO::Color>("v:color").first;
  for(auto v : mesh.vertices()) {
    f_map[v] = shell.field().value(mesh.point(v)).value_or(0);
    color_map[v] = color(f_map[v], shell.inner_level(), shell.outer_level());
  }
  if(!write_mesh(output + "_mesh.ply", mesh)) {
    std::cerr << "Cannot write " << output << "_mesh.ply" << std::endl;
    return 3;
  }
  const double output_seconds = timer.time();

  const BS::Shell_report& r = shell.report();
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto row = [](const std::string& what) -> std::ostream& { return std::cout << std::left << std::setw(22) << what; };
  row("mesh") << file << "\n";
  row("facets, components") << r.facets << ", " << r.components << "\n";
  row("resolution") << r.gamma << " cells per box side\n";
  row("cells") << r.cells << "\n";
  row("unknowns") << r.unknowns << "\n";
  row("eps1, eps2") << shell.inner_level() << ", " << shell.outer_level() << "\n";
  row("thickness") << 100 * shell.relative_thickness() << " % of the box\n";
  std::cout << std::fixed << std::setprecision(2);
  for(int s = 0; s < 5; ++s) row(std::string("seconds: ") + name(BS::Shell_step(s))) << r.seconds[s] << "\n";
  row("seconds: surfaces") << output_seconds << "\n";
  row("seconds: total") << r.total_seconds() + output_seconds << "\n";
  row("peak memory") << usage.ru_maxrss / 1024 << " MB\n";
  return EXIT_SUCCESS;
}
