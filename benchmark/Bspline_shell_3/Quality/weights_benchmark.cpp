// What the paper's weight mu does to shells of equal cells (its Figure 10): one JSON object a line, for each mesh and mu.
//
//   weights_benchmark [--gamma G] [--points N] [MESH ...]
//
// Default: 20 cells along the longest side of the mesh's box, as in the figure, and 100000 random points on fandisk; mu from 1e-4 to 100. Lengths are
// in units of that side. The paper carries geodesic distances and shows where they are off by more than 0.03; here the points themselves go to a
// second mesh and back: the mesh with its vertices moved along the flow, by 40 % of the way to a level at most.
//
//   contained        share of the points that are in the shell
//   largest_angle    between the facet's normal and the gradient at a point, in degrees
//   wrong_side       share of the points where the gradient does not point to the side that the facet faces
//   certificate      verdicts about the mesh, and about the second one
//   kept_vertices    vertices of the second mesh that are where they were, as their curve does not get that far
//   round_trip       number of points that come back to within 1e-6, 1e-3 and 0.03, those that are farther away, and those that are lost
#include "../meshes_in_shell.h"

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Polygon_mesh_processing/compute_normal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

typedef CGAL::Bspline_shell_3<> Uniform_shell;

// along the flow, inwards here and outwards there, as moved_along_flow(), but without a certificate
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

std::string verdicts(const Uniform_shell& shell, const Mesh& mesh)
{
  BS::Shell_certificate_3 certificate(shell);
  certificate.verify(mesh);
  std::string result;
  for(BS::Claim claim : { BS::Claim::CONTAINMENT, BS::Claim::TRANSVERSALITY, BS::Claim::GRADIENT, BS::Claim::ONE_SHEET, BS::Claim::DEGREE_ONE })
    result += std::string(result.empty() ? "{" : ",") + "\"" + name(claim) + "\":\"" + name(certificate.verdict(claim)) + "\"";
  return result + "}";
}

void measure(const std::string& file, double gamma, double mu, std::size_t number)
{
  const auto give_up = [&](const std::string& reason) {
    std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"mu\":" << mu << ",\"status\":" << quoted(reason) << "}" << std::endl;
  };
  Mesh mesh;
  if(!read_triangles(file, mesh)) return give_up("no mesh");
  BS::Energy_weights weights;
  weights.mu = mu;
  const Uniform_shell shell = CGAL::bspline_shell_3(mesh, BS::parameters::resolution(gamma).energy_weights(weights));
  if(!shell) return give_up(message(shell.status()));
  std::size_t kept = 0;
  const Mesh second = moved_without_proof(shell, mesh, kept);
  const BS::Shell_map_3<Uniform_shell, Mesh> map(shell, mesh, second), inverse = map.inverse();

  const auto locations = random_locations(mesh, number, 3);
  const auto images = map.project(locations);
  std::vector<typename decltype(inverse)::Source_location> image_locations;
  for(const auto& image : images) image_locations.push_back(image.location);
  std::size_t contained = 0, wrong_side = 0, lost = 0;
  std::array<std::size_t, 4> histogram = {};
  double least_cosine = 1;
  for(std::size_t n = 0; n < locations.size(); ++n) {
    const auto c = map.point(locations[n]);
    const Kernel::Point_3 p(c[0], c[1], c[2]);
    if(shell.bounded_side(p) == CGAL::ON_BOUNDED_SIDE) ++contained;
    const Kernel::Vector_3 g = *shell.field().gradient(p);
    const Kernel::Vector_3 normal = CGAL::Polygon_mesh_processing::compute_face_normal(locations[n].first, mesh);
    const double cosine = normal * g / std::sqrt(g.squared_length());
    least_cosine = (std::min)(least_cosine, cosine);
    if(!(cosine > 0)) ++wrong_side;
    const auto returned = images[n] ? inverse(image_locations[n]) : typename decltype(inverse)::Target_image();
    if(!images[n] || !returned) { ++lost; continue; }
    const double way = std::sqrt(CGAL::squared_distance(p, returned.point)) / shell.report().unit;
    ++histogram[way < 1e-6 ? 0 : way < 1e-3 ? 1 : way < 0.03 ? 2 : 3];
  }
  const double points = double(locations.size());
  std::cout << "{\"mesh\":" << quoted(mesh_name(file)) << ",\"gamma\":" << gamma << ",\"mu\":" << mu << ",\"thickness\":"
            << shell.relative_thickness() << ",\"points\":" << locations.size() << ",\"contained\":" << double(contained) / points
            << ",\"largest_angle\":" << std::acos((std::max)(-1., least_cosine)) * 180 / CGAL_PI << ",\"wrong_side\":" << double(wrong_side) / points
            << ",\"certificate\":" << verdicts(shell, mesh) << ",\"certificate_of_second\":" << verdicts(shell, second) << ",\"kept_vertices\":"
            << kept << ",\"round_trip\":{\"1e-6\":" << histogram[0] << ",\"1e-3\":" << histogram[1] << ",\"0.03\":" << histogram[2] << ",\"more\":"
            << histogram[3] << ",\"lost\":" << lost << "}}" << std::endl;
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  double gamma = 20;
  std::size_t points = 100000;
  std::vector<std::string> files;
  for(int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if(arg == "--gamma" && i + 1 < argc) gamma = std::atof(argv[++i]);
    else if(arg == "--points" && i + 1 < argc) points = std::size_t(std::atoll(argv[++i]));
    else files.push_back(arg);
  }
  if(!(gamma > 0 && points > 0)) {
    std::cerr << "Usage: weights_benchmark [--gamma G] [--points N] [MESH ...]\n";
    return 2;
  }
  if(files.empty()) files.push_back(MESHES "/fandisk.off");
  for(const std::string& file : files)
    for(double mu : { 1e-4, 1e-2, 0.1, 1., 10., 100. }) measure(file, gamma, mu, points);
  return EXIT_SUCCESS;
}
