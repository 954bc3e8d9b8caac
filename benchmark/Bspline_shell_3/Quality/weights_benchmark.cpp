// Measures the effect of the paper's weight mu on shells of equal cells (Figure 10). Prints one JSON object per line,
// for each mesh and mu, and for the certified shell of the mesh.
//
//   weights_benchmark [--gamma G] [--mu M,M,...] [--points N] [--thickness T] [--output PREFIX] [MESH ...]
//
// Default: 20 cells along the longest side of the mesh's box, as in the figure, and 100000 random points on fandisk; mu
// from 1e-6 to 100; a certified shell of 0.05. Lengths are in units of that side. Points are mapped to a second mesh
// and back. So are distances along the mesh from its first vertex, computed by the heat method. The vertices of the
// second mesh are moved along the flow, by at most 40 % of the way to a level. In the certified shell, they are moved
// as far as the certificate permits: by 80 %, half as much, and so on.
//
//   mu               null for the certified shell
//   contained        share of the points that are in the shell
//   largest_angle    between the facet's normal and the gradient at a point, in degrees
//   wrong_side       share of the points where the gradient does not point to the side that the facet faces
//   certificate      verdicts for the mesh, and for the second one
//   kept_vertices    vertices of the second mesh that are not moved, as their curve does not reach the value
//   round_trip       number of points that return to within 1e-6, 1e-3 and 0.03, of farther ones, and of lost ones
//   distances        that return: mean and largest error; the number of points with an error of 0.03 to 0.06, and so
//                    on, finally of more than 0.3, and of those without a distance
//
// --output writes PREFIX_mesh.ply, the mesh with the distances, and PREFIX_{M,certified}.txt, points with an error of
// more than 0.03 as x y z error. The error is -1 for points without a returned distance.
#include "../meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/IO/write_file.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

typedef CGAL::Bspline_shell_3<> Uniform_shell;
typedef Mesh::Property_map<Mesh::Vertex_index, double> Distance;

struct Options
{
  double gamma = 20, thickness = 0.05;
  std::vector<double> mus = { 1e-6, 1e-5, 1e-4, 1e-2, 0.1, 1, 10, 100 };
  std::size_t points = 100000;
  std::string prefix;
};

constexpr double threshold = 0.03; // least error that the paper shows

// Moves vertices along the flow, inwards and outwards, like moved_along_flow(), but without a certificate.
Mesh moved_without_proof(const Uniform_shell& shell, const Mesh& mesh, std::size_t& kept)
{
  const BS::Gradient_flow_3<Uniform_shell> flow(shell);
  const double unit = shell.report().unit;
  Mesh moved = mesh;
  kept = 0;
  for(Mesh::Vertex_index v : moved.vertices()) {
    const Kernel::Point_3 p = mesh.point(v);
    const double f = *shell.field().value(p);
    const double wave = std::sin(25 * p.x() / unit) * std::cos(21 * p.y() / unit) * std::cos(17 * p.z() / unit);
    const double room = wave > 0 ? shell.outer_level() - f : f - shell.inner_level();
    const auto arrival = flow.trace(p, f + 0.4 * wave * room);
    if(arrival) moved.point(v) = arrival.point;
    else ++kept;
  }
  return moved;
}

template <typename Shell_>
std::string verdicts(const Shell_& shell, const Mesh& mesh)
{
  BS::Shell_certificate_3 certificate(shell);
  certificate.verify(mesh);
  std::string result;
  for(BS::Claim claim : { BS::Claim::CONTAINMENT, BS::Claim::TRANSVERSALITY, BS::Claim::GRADIENT, BS::Claim::ONE_SHEET,
                          BS::Claim::DEGREE_ONE })
    result += std::string(result.empty() ? "{" : ",") + "\"" + name(claim) + "\":\"" + name(certificate.verdict(claim))
              + "\"";
  return result + "}";
}

template <typename Location>
double interpolated(const Mesh& mesh, Distance values, const Location& location)
{
  Mesh::Halfedge_index h = mesh.halfedge(location.first);
  double value = 0;
  for(std::size_t k = 0; k < 3; ++k, h = mesh.next(h)) value += location.second[k] * values[mesh.source(h)];
  return value;
}

// Prints the rest of a line. Returns false if the points cannot be written.
template <typename Shell_>
bool measure_map(const Shell_& shell, const Mesh& mesh, Mesh& second, Distance distance, std::size_t kept,
                 const Options& options, const std::string& mu)
{
  const BS::Shell_map_3<Shell_, Mesh> map(shell, mesh, second), inverse = map.inverse();
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  const Distance on_second = second.add_property_map<Mesh::Vertex_index, double>("v:distance_there").first;
  BS::transfer_vertex_attribute(map, distance, on_second, BS::parameters::default_value(missing));

  const auto locations = random_locations(mesh, options.points, 3);
  const auto images = map.project(locations);
  std::size_t contained = 0, wrong_side = 0, lost = 0, without = 0;
  std::array<std::size_t, 4> histogram = {};
  std::array<std::size_t, 10> errors = {};
  double least_cosine = 1, sum = 0, most = 0;
  std::ostringstream failures;
  for(std::size_t n = 0; n < locations.size(); ++n) {
    const auto c = map.point(locations[n]);
    const Kernel::Point_3 p(c[0], c[1], c[2]);
    if(shell.bounded_side(p) != CGAL::ON_UNBOUNDED_SIDE) ++contained;
    const Kernel::Vector_3 g = *shell.field().gradient(p);
    const Kernel::Vector_3 normal = CGAL::Polygon_mesh_processing::compute_face_normal(locations[n].first, mesh);
    const double cosine = normal * g / std::sqrt(g.squared_length());
    least_cosine = (std::min)(least_cosine, cosine);
    if(!(cosine > 0)) ++wrong_side;
    const auto back = images[n] ? inverse(images[n].location) : typename decltype(inverse)::Target_image();
    if(back) {
      const double way = std::sqrt(CGAL::squared_distance(p, back.point)) / shell.report().unit;
      ++histogram[way < 1e-6 ? 0 : way < 1e-3 ? 1 : way < threshold ? 2 : 3];
    } else ++lost;
    const double carried = images[n] ? interpolated(second, on_second, images[n].location) : missing,
                 error = std::abs(carried - interpolated(mesh, distance, locations[n])) / shell.report().unit;
    if(!(error <= threshold)) failures << p << " " << (std::isfinite(error) ? error : -1) << "\n";
    if(!std::isfinite(error)) {
      ++without;
      continue;
    }
    sum += error;
    most = (std::max)(most, error);
    if(error > threshold) ++errors[(std::min)(std::size_t(error / threshold) - 1, errors.size() - 1)];
  }
  const double points = double(locations.size());
  std::cout << ",\"thickness\":" << shell.relative_thickness() << ",\"points\":" << locations.size()
            << ",\"contained\":" << double(contained) / points
            << ",\"largest_angle\":" << std::acos((std::max)(-1., least_cosine)) * 180 / CGAL_PI
            << ",\"wrong_side\":" << double(wrong_side) / points << ",\"certificate\":" << verdicts(shell, mesh)
            << ",\"certificate_of_second\":" << verdicts(shell, second) << ",\"kept_vertices\":" << kept
            << ",\"round_trip\":{\"1e-6\":" << histogram[0] << ",\"1e-3\":" << histogram[1]
            << ",\"0.03\":" << histogram[2] << ",\"more\":" << histogram[3] << ",\"lost\":" << lost
            << "},\"distances\":{\"mean\":" << sum / (points - double(without)) << ",\"most\":" << most
            << ",\"errors\":[";
  for(std::size_t n = 0; n < errors.size(); ++n) std::cout << (n == 0 ? "" : ",") << errors[n];
  std::cout << "],\"missing\":" << without << "}}" << std::endl;

  return options.prefix.empty() || BS::write_file(options.prefix + "_" + mu + ".txt", [&](std::ostream& out) {
           return bool(out << failures.str());
         });
}

bool measure(const std::string& file, const Options& options)
{
  Mesh mesh;
  const auto begin = [&](const std::string& mu) {
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"gamma\":" << options.gamma << ",\"mu\":" << mu;
  };
  const auto give_up = [&](const std::string& reason) {
    std::cout << ",\"status\":" << quoted(reason) << "}" << std::endl;
  };
  if(!read_triangles(file, mesh)) {
    begin("null");
    give_up("no mesh");
    return false;
  }
  const Distance distance = mesh.add_property_map<Mesh::Vertex_index, double>("v:distance").first;
  CGAL::Heat_method_3::estimate_geodesic_distances(mesh, distance, *mesh.vertices().begin());
  bool written = options.prefix.empty() || BS::write_file(options.prefix + "_mesh.ply", [&](std::ostream& out) {
                   return CGAL::IO::write_PLY(out, mesh);
                 });
  for(double mu : options.mus) {
    std::ostringstream number;
    number << mu;
    begin(number.str());
    BS::Energy_weights weights;
    weights.mu = mu;
    const Uniform_shell shell = CGAL::bspline_shell_3(
      mesh, BS::parameters::resolution(options.gamma).energy_weights(weights));
    if(!shell) {
      give_up(message(shell.status()));
      continue;
    }
    std::size_t kept = 0;
    Mesh second = moved_without_proof(shell, mesh, kept);
    written = measure_map(shell, mesh, second, distance, kept, options, number.str()) && written;
  }
  begin("null");
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(options.thickness));
  double part = 0;
  std::optional<Mesh> second;
  if(shell.is_certified()) second = moved_along_flow(shell, mesh, part);
  if(!second) {
    give_up("no certified pair of meshes");
    return written;
  }
  std::cout << ",\"moved\":" << part;
  return measure_map(shell, mesh, *second, distance, 0, options, "certified") && written;
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  Options options;
  std::vector<std::string> files;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if(arg == "--gamma" && i + 1 < argc) options.gamma = std::atof(argv[++i]);
    else if(arg == "--mu" && i + 1 < argc) {
      options.mus.clear();
      std::istringstream list(argv[++i]);
      for(std::string m; std::getline(list, m, ',');) options.mus.push_back(std::atof(m.c_str()));
    } else if(arg == "--points" && i + 1 < argc) options.points = std::size_t(std::atoll(argv[++i]));
    else if(arg == "--thickness" && i + 1 < argc) options.thickness = std::atof(argv[++i]);
    else if(arg == "--output" && i + 1 < argc) options.prefix = argv[++i];
    else files.push_back(arg);
  }
  const auto is_positive = [](double x) { return x > 0; };
  if(!(options.gamma > 0 && options.points > 0 && options.thickness > 0 && (options.prefix.empty() || files.size() == 1)
       && std::all_of(options.mus.begin(), options.mus.end(), is_positive))) {
    std::cerr << "Usage: weights_benchmark [--gamma G] [--mu M,M,...] [--points N] [--thickness T] [--output PREFIX] "
                 "[MESH ...]\n"
                 "--output requires exactly one MESH.\n";
    return 2;
  }
  if(files.empty()) files.push_back(MESHES "/fandisk.off");
  bool all = true;
  for(const std::string& file : files) all = measure(file, options) && all;
  return all ? EXIT_SUCCESS : EXIT_FAILURE;
}
