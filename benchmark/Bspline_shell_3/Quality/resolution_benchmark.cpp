// Measures the effect of the paper's resolution gamma, the number of equal cells along the longest side of the mesh's
// box (Figures 7 and 8). Prints one JSON object per line, for each mesh and gamma, and for the certified shell of the
// mesh, whose cells are as small as the proof requires.
//
//   resolution_benchmark [--gamma G,G,...] [--points N] [--thickness T] [--output PREFIX AXIS PART] [MESH ...]
//
// Default: 30, 50, 70, 90, 110 and 130, as in the paper; 100000 random points on the mesh; a certified shell of 0.01.
// Lengths are in units of the longest side.
//
//   gamma                    null for the certified shell
//   seconds                  of the shell; for the certified shell, including its proof
//   inner, outer             lowest and highest threshold on the mesh
//   thickness                largest difference of both thresholds at a point of the mesh
//   largest_value            bounds |f| on the mesh
//   contained                share of the points that are in the shell
//   certificate, certified   verdicts for the mesh, and whether all claims are proved
//   certificate_seconds      for equal cells
//
// --output writes PREFIX_mesh.ply, the surfaces PREFIX_{G,certified}_{inner,outer}.ply, and
// PREFIX_{G,certified}_slice.txt, a grid in a plane: its coordinate AXIS (0, 1 or 2) is at the fraction PART (0 to 1)
// of the mesh's box. The first line has the columns, rows, first point and step. Each point follows in a line, row by
// row: f, and its position between the thresholds, from 0 to 1. Both are nan outside the cells of the shell.
#include "../meshes_in_shell.h"
#include "../write_ply.h"

#include <CGAL/Real_timer.h>
#include <CGAL/bspline_shell_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <locale>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

typedef CGAL::Bspline_shell_3<> Uniform_shell;

struct Options
{
  std::vector<double> gammas = { 30, 50, 70, 90, 110, 130 };
  std::size_t points = 100000;
  double thickness = 0.01;
  std::string prefix;
  int axis = 0;
  double part = 0;
};

constexpr int pixels = 800;     // along the longest side of a slice
constexpr double margin = 0.08; // around the mesh's box in the slice

template <typename Shell_>
bool write_slice(const std::string& file, const Shell_& shell, const Mesh& mesh, int axis, double part)
{
  const CGAL::Bbox_3 box = CGAL::bbox_3(mesh.points().begin(), mesh.points().end());
  const double unit = shell.report().unit, step = (1 + 2 * margin) * unit / pixels;
  std::array<double, 3> origin;
  std::array<int, 3> size;
  for(int a = 0; a < 3; ++a) {
    origin[a] = a == axis ? (1 - part) * (box.min)(a) + part * (box.max)(a) : (box.min)(a)-margin * unit;
    size[a] = a == axis ? 1 : int(((box.max)(a) - (box.min)(a) + 2 * margin * unit) / step) + 1;
  }
  return BS::write_file(file, [&](std::ostream& out) {
    out.imbue(std::locale::classic());
    out << size[axis == 0 ? 1 : 0] << " " << size[axis == 2 ? 1 : 2];
    for(double x : origin) out << " " << x;
    out << " " << step << "\n";
    for(int k = 0; k < size[2]; ++k)
      for(int j = 0; j < size[1]; ++j)
        for(int i = 0; i < size[0]; ++i) {
          const typename Shell_::Point_3 p(origin[0] + i * step, origin[1] + j * step, origin[2] + k * step);
          const auto f = shell.field().value(p);
          if(!f) {
            out << "nan nan\n";
            continue;
          }
          const double inner = shell.inner_threshold().value(p);
          out << *f / unit << " " << (*f - inner) / (shell.outer_threshold().value(p) - inner) << "\n";
        }
    return bool(out);
  });
}

template <typename Shell_>
bool write_output(const Options& options, const std::string& name, const Shell_& shell, const Mesh& mesh)
{
  const std::string prefix = options.prefix + "_" + name + "_";
  return write_surface(prefix + "inner.ply", shell, shell.inner_threshold())
         && write_surface(prefix + "outer.ply", shell, shell.outer_threshold())
         && write_slice(prefix + "slice.txt", shell, mesh, options.axis, options.part);
}

// Prints the properties common to both kinds of shells.
template <typename Shell_>
void print_shell(const Shell_& shell, const Mesh& mesh, double seconds, const BS::Certificate_report& certificate,
                 std::size_t points)
{
  const double unit = shell.report().unit;
  double inner = std::numeric_limits<double>::infinity(), outer = -inner, largest = 0;
  std::size_t contained = 0;
  for(const auto& [facet, weights] : random_locations(mesh, points, 3)) {
    const auto h = mesh.halfedge(facet);
    const Kernel::Point_3 p = CGAL::barycenter(mesh.point(mesh.source(h)), weights[0], mesh.point(mesh.target(h)),
                                               weights[1], mesh.point(mesh.target(mesh.next(h))), weights[2]);
    const auto f = shell.field().value(p);
    if(!f) continue;
    const double low = shell.inner_threshold().value(p), high = shell.outer_threshold().value(p);
    contained += low <= *f && *f <= high;
    inner = (std::min)(inner, low);
    outer = (std::max)(outer, high);
  }
  for(const BS::Level_range& range : shell.facet_ranges()) largest = (std::max)({ largest, -range.min, range.max });
  std::cout << ",\"cells\":" << shell.report().cells << ",\"seconds\":" << seconds << ",\"inner\":" << inner / unit
            << ",\"outer\":" << outer / unit << ",\"thickness\":" << shell.relative_thickness()
            << ",\"largest_value\":" << largest / unit << ",\"contained\":" << double(contained) / double(points)
            << ",\"certificate\":{";
  bool certified = true;
  for(BS::Claim claim : { BS::Claim::CONTAINMENT, BS::Claim::TRANSVERSALITY, BS::Claim::GRADIENT, BS::Claim::ONE_SHEET,
                          BS::Claim::DEGREE_ONE }) {
    std::cout << (claim == BS::Claim::CONTAINMENT ? "\"" : ",\"") << name(claim) << "\":\""
              << name(certificate.verdict(claim)) << "\"";
    certified = certified && certificate.verdict(claim) == BS::Verdict::PROVED;
  }
  std::cout << "},\"certified\":" << (certified ? "true" : "false");
}

bool measure(const std::string& file, const Options& options)
{
  Mesh mesh;
  CGAL::Real_timer timer;
  timer.start();
  const auto time = [&] {
    const double seconds = timer.time();
    timer.reset();
    return seconds;
  };
  const auto begin = [&](const std::string& gamma) {
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"facets\":" << mesh.number_of_faces()
              << ",\"gamma\":" << gamma;
  };
  const auto give_up = [&](const std::string& reason) {
    std::cout << ",\"status\":" << quoted(reason) << "}" << std::endl;
  };
  if(!read_triangles(file, mesh)) {
    begin("null");
    give_up("no mesh");
    return false;
  }
  bool written = options.prefix.empty() || write_mesh(options.prefix + "_mesh.ply", mesh);
  for(double gamma : options.gammas) {
    std::ostringstream number;
    number << gamma;
    time();
    const Uniform_shell shell = CGAL::bspline_shell_3(mesh, BS::parameters::resolution(gamma));
    const double seconds = time();
    begin(number.str());
    if(!shell) {
      give_up(message(shell.status()));
      continue;
    }
    BS::Shell_certificate_3 certificate(shell);
    certificate.verify(mesh);
    const double certificate_seconds = time();
    print_shell(shell, mesh, seconds, certificate.report(), options.points);
    std::cout << ",\"certificate_seconds\":" << certificate_seconds << "}" << std::endl;
    if(!options.prefix.empty()) written = write_output(options, number.str(), shell, mesh) && written;
  }
  time();
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(options.thickness));
  const double seconds = time();
  begin("null");
  if(!shell) {
    give_up(shell.message());
    return written;
  }
  print_shell(shell, mesh, seconds, shell.report().certificate, options.points);
  std::cout << "}" << std::endl;
  return (options.prefix.empty() || write_output(options, "certified", shell, mesh)) && written;
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  Options options;
  std::vector<std::string> files;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if(arg == "--gamma" && i + 1 < argc) {
      options.gammas.clear();
      std::istringstream list(argv[++i]);
      for(std::string g; std::getline(list, g, ',');) options.gammas.push_back(std::atof(g.c_str()));
    } else if(arg == "--points" && i + 1 < argc) options.points = std::size_t(std::atoll(argv[++i]));
    else if(arg == "--thickness" && i + 1 < argc) options.thickness = std::atof(argv[++i]);
    else if(arg == "--output" && i + 3 < argc) {
      options.prefix = argv[++i];
      options.axis = std::atoi(argv[++i]);
      options.part = std::atof(argv[++i]);
    } else files.push_back(arg);
  }
  const auto is_positive = [](double x) { return x > 0; };
  if(!(std::all_of(options.gammas.begin(), options.gammas.end(), is_positive) && options.points > 0
       && options.thickness > 0 && options.axis >= 0 && options.axis <= 2
       && (options.prefix.empty() || files.size() == 1))) {
    std::cerr << "Usage: resolution_benchmark [--gamma G,G,...] [--points N] [--thickness T] [--output PREFIX AXIS "
                 "PART] [MESH ...]\n"
                 "--output requires exactly one MESH.\n";
    return 2;
  }
  if(files.empty())
    for(const char* name :
        { "anchor_dense", "bear", "blobby", "elephant", "fandisk", "homer", "knot1", "retinal", "triceratops" })
      files.push_back(std::string(MESHES "/") + name + ".off");
  bool all = true;
  for(const std::string& file : files) all = measure(file, options) && all;
  return all ? EXIT_SUCCESS : EXIT_FAILURE;
}
