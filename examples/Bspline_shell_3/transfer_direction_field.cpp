// Computes the smoothest direction field of a mesh (1: vectors, 2: lines, 4: crosses), and transfers it to the mesh
// simplified in its shell and back. Compares the singularities on both meshes, and measures the mean angle between the
// field before and after the round trip.
#include "direction_field.h"
#include "example_files.h"

#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_tangent_vectors.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <numeric>
#include <string>
#include <vector>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Certified_bspline_shell_3 Shell;
typedef BS::Shell_map_3<Shell, Mesh> Map;

Vectors vectors(Mesh& mesh, const char* name)
{
  return mesh.add_property_map<Mesh::Face_index, Kernel::Vector_3>(name).first;
}

int sum_of_indices(const std::vector<Singularity>& singularities)
{
  return std::accumulate(singularities.begin(), singularities.end(), 0,
                         [](int sum, const Singularity& s) { return sum + s.index; });
}

// Returns how many of the singularities `before` can be matched one-to-one with a singularity of the same index at the
// facet of their image.
std::size_t number_found(const Map& map, const std::vector<Singularity>& before, std::vector<Singularity> after)
{
  std::size_t found = 0;
  for(const Singularity& s : before) {
    const auto image = map(s.vertex);
    if(!image) continue;
    const auto ring = CGAL::vertices_around_face(map.target().halfedge(image.location.first), map.target());
    const auto t = std::find_if(after.begin(), after.end(), [&](const Singularity& t) {
      return t.index == s.index && std::find(ring.begin(), ring.end(), t.vertex) != ring.end();
    });
    if(t == after.end()) continue;
    ++found;
    after.erase(t);
  }
  return found;
}

// Writes the mesh with the coordinates of the field and the indices of singularities.
bool write(const std::string& file, Mesh& mesh, Vectors field, const std::vector<Singularity>& singularities)
{
  for(int i = 0; i < 3; ++i) {
    const auto coordinate = mesh.add_property_map<Mesh::Face_index, double>("f:field_" + std::string(1, "xyz"[i]))
                              .first;
    for(Mesh::Face_index f : mesh.faces()) coordinate[f] = field[f][i];
  }
  const auto index = mesh.add_property_map<Mesh::Vertex_index, int>("v:singularity", 0).first;
  for(const Singularity& s : singularities) index[s.vertex] = s.index;
  return save(file, mesh);
}

int main(int argc, char** argv)
{
  std::string file;
  int directions = 4, facets = 0;
  const Arguments arguments = Arguments("Usage: transfer_direction_field MESH [DIRECTIONS [FACETS]]\n"
                                        "  DIRECTIONS: 1 for vectors, 2 for lines, 4 for crosses (default 4)\n"
                                        "  FACETS: target number of facets (default: as few as the shell allows)\n"
                                        "  Writes direction_field.ply and direction_field_simplified.ply.\n")
                                .required(file)
                                .optional(directions)
                                .optional(facets);
  if(const auto code = arguments.read(argc, argv)) return *code;
  if(directions < 1) return *arguments.wrong("DIRECTIONS must be at least 1.");
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  if(!CGAL::is_closed(mesh)) {
    std::cerr << "The mesh is open: close its holes." << std::endl;
    return EXIT_FAILURE;
  }
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  if(!shell.is_certified()) {
    std::cerr << shell.message() << std::endl;
    return EXIT_FAILURE;
  }
  Mesh coarse = mesh;
  const auto result = BS::simplify_in_shell(coarse, shell,
                                            BS::parameters::stop(BS::Facet_count_stop_predicate(std::size_t(facets))));
  if(!result) {
    std::cerr << result.message() << std::endl;
    return EXIT_FAILURE;
  }
  coarse.collect_garbage();

  const Vectors field = vectors(mesh, "f:field"), back = vectors(mesh, "f:back"), there = vectors(coarse, "f:field");
  const Direction_field_space on_mesh(mesh, directions), on_coarse(coarse, directions);
  if(!on_mesh.find_smoothest(field)) {
    std::cerr << "The smoothest field could not be computed: choose another MESH." << std::endl;
    return EXIT_FAILURE;
  }
  const Map map(shell, mesh, coarse);
  for(const BS::Transfer_report& report :
      { BS::transfer_tangent_vectors(map, field, there, BS::parameters::symmetry(directions).samples_per_facet(16)),
        BS::transfer_tangent_vectors(map.inverse(), there, back,
                                     BS::parameters::symmetry(directions).linear_reconstruction(true)) })
    if(!report) {
      std::cerr << report.failures.size() << " facets have no vector: " << message(report.failures[0].second)
                << std::endl;
      return EXIT_FAILURE;
    }

  const std::vector<Singularity> before = on_mesh.singularities(field), after = on_coarse.singularities(there);
  const std::size_t found = number_found(map, before, after);
  double angles = 0;
  for(Mesh::Face_index f : mesh.faces()) angles += on_mesh.angle(f, field, back) / double(mesh.number_of_faces());
  std::cout << "facets: " << result.facets_before << " before, " << result.facets << " after\n"
            << "singularities: " << before.size() << " before, " << after.size() << " after; " << found
            << " of them at their images\n"
            << "sum of indices: " << sum_of_indices(before) << "/" << directions << " before, " << sum_of_indices(after)
            << "/" << directions << " after\n"
            << "mean error after the round trip: " << angles << " degrees\n";
  const bool are_written = write("direction_field.ply", mesh, field, before)
                           && write("direction_field_simplified.ply", coarse, there, after);
  return are_written ? EXIT_SUCCESS : EXIT_FAILURE;
}
