// Reads a mesh, builds its shell, prints a table, and writes the two bounding surfaces and the mesh with f and a colour
// at its vertices. The usage, below, says what it returns.
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
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

const char* const usage =
  "Usage: build_shell MESH [--resolution CELLS] [--paper] [--output PREFIX]\n"
  "  CELLS cells along the longest side of the mesh's box (80); --paper: all cells of the box and all\n"
  "  terms of the paper's energy. Writes PREFIX_{inner,outer,mesh}.ply; PREFIX is shell if not given.\n"
  "  Exit codes: 0 done; 2 wrong usage; 3 a file cannot be written; 4 a bounding surface cannot be extracted,\n"
  "  the other files are written; 10 + the status (Status.h) if the mesh is refused or the shell fails.\n";

// names the steps in one line of a terminal, and is quiet in a pipe
struct Step_printer : BS::Default_shell_visitor
{
  bool start_step(BS::Shell_step step)
  {
    clear();
    if(on_terminal) std::cerr << name(step) << " ..." << std::flush;
    return true;
  }
  void clear() const { if(on_terminal) std::cerr << "\r\033[K" << std::flush; }

  const bool on_terminal = isatty(STDERR_FILENO);
};

// whether all of the text is a positive number
bool read_positive(const char* text, double& number)
{
  char* end;
  number = std::strtod(text, &end);
  return *end == '\0' && std::isfinite(number) && number > 0;
}

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

// from blue below zero through white to red above; the level farther from zero has the full colour
CGAL::IO::Color color(double f, double inner, double outer)
{
  const double full = (std::max)(std::abs(inner), std::abs(outer));
  const double t = full > 0 ? (std::min)(std::abs(f) / full, 1.) : 0;
  const unsigned char fade = static_cast<unsigned char>(255 * (1 - t));
  return f < 0 ? CGAL::IO::Color(fade, fade, 255) : CGAL::IO::Color(255, fade, fade);
}

bool write_mesh(const std::string& file, const Mesh& mesh)
{
  return BS::write_file(file, [&](std::ostream& out) {
    return CGAL::IO::write_PLY(out, mesh, CGAL::parameters::stream_precision(17));
  });
}

// whether `write_mesh` can begin; better known before the long computation than after it
bool is_writable(const std::string& file)
{
  const std::string partial = file + ".part";
  const bool writable = std::ofstream(partial).is_open();
  std::remove(partial.c_str());
  return writable;
}

int cannot_write(const std::string& file)
{
  std::cerr << "Cannot write " << file << std::endl;
  return 3;
}

int main(int argc, char** argv)
{
  std::string file, output = "shell";
  double resolution = 80;
  bool paper = false, usable = true;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if(arg == "--resolution" && i + 1 < argc) usable = read_positive(argv[++i], resolution) && usable;
    else if(arg == "--output" && i + 1 < argc) output = argv[++i];
    else if(arg == "--paper") paper = true;
    else if(file.empty() && arg[0] != '-') file = arg;
    else usable = false;
  }
  if(file.empty() || !usable) {
    std::cerr << usage;
    return 2;
  }

  // results of an older run must not pass for those of a run that fails
  const std::string inner_file = output + "_inner.ply", outer_file = output + "_outer.ply", mesh_file = output + "_mesh.ply";
  for(const std::string& result : { inner_file, outer_file, mesh_file }) {
    std::error_code error;
    if(std::filesystem::equivalent(result, file, error)) {
      std::cerr << "The result would replace the mesh " << file << ": choose another PREFIX" << std::endl;
      return 2;
    }
    std::remove(result.c_str());
  }
  if(!is_writable(mesh_file)) return cannot_write(mesh_file);

  Mesh mesh;
  BS::Offending_simplices offenders;
  const BS::Shell_status read = BS::read_polygon_mesh(file, mesh, offenders);
  if(read != BS::Shell_status::SUCCESS) return refuse(read, offenders);

  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
  Step_printer printer;
  const CGAL::Bspline_shell_3<> shell = CGAL::bspline_shell_3(mesh,
    BS::parameters::resolution(resolution)
                   .dense_grid(paper)
                   .energy_weights(paper ? BS::Energy_weights::paper() : BS::Energy_weights())
                   .memory_limit(0.8 * memory)
                   .visitor(std::ref(printer)));
  printer.clear();
  if(!shell) return refuse(shell.status(), shell.report().offending_simplices);

  CGAL::Real_timer timer;
  timer.start();
  int exit_code = EXIT_SUCCESS;
  for(bool outer : { false, true }) {
    const std::string& surface_file = outer ? outer_file : inner_file;
    Mesh surface;
    const BS::Level_set_status status = BS::extract_level_set<CGAL::Parallel_if_available_tag>(
      shell.field(), outer ? shell.outer_level() : shell.inner_level(), surface,
      CGAL::parameters::filter([&](auto cell) { return shell.shell_cells()[cell] != 0; }));
    if(status != BS::Level_set_status::SUCCESS) {
      std::cerr << "No " << surface_file << ". " << message(status) << std::endl;
      exit_code = 4;
    }
    else if(!write_mesh(surface_file, surface)) return cannot_write(surface_file);
  }
  auto f_map = mesh.add_property_map<Mesh::Vertex_index, double>("v:f", 0).first;
  auto color_map = mesh.add_property_map<Mesh::Vertex_index, CGAL::IO::Color>("v:color").first;
  for(auto v : mesh.vertices()) {
    f_map[v] = shell.field().value(mesh.point(v)).value_or(0);
    color_map[v] = color(f_map[v], shell.inner_level(), shell.outer_level());
  }
  if(!write_mesh(mesh_file, mesh)) return cannot_write(mesh_file);
  const double output_seconds = timer.time();

  const BS::Shell_report& r = shell.report();
  struct rusage used;
  getrusage(RUSAGE_SELF, &used);
  const auto row = [](const std::string& what) -> std::ostream& { return std::cout << std::left << std::setw(22) << what; };
  row("mesh") << file << "\n";
  row("facets, components") << r.triangles << ", " << r.components << "\n";
  row("resolution") << r.gamma << " cells per box side\n";
  row("cells") << r.cells << "\n";
  row("unknowns") << r.unknowns << "\n";
  row("eps1, eps2") << shell.inner_level() << ", " << shell.outer_level() << "\n";
  row("thickness") << 100 * shell.relative_thickness() << " % of the box\n";
  std::cout << std::fixed << std::setprecision(2);
  for(int s = 0; s < 5; ++s) row(std::string("seconds: ") + name(BS::Shell_step(s))) << r.seconds[s] << "\n";
  row("seconds: surfaces") << output_seconds << "\n";
  row("seconds: total") << r.total_seconds() + output_seconds << "\n";
  row("peak memory") << used.ru_maxrss / 1024 << " MB\n";
  return exit_code;
}
