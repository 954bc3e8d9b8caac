// Computes the union, intersection, or difference of two solids, and simplifies it in its shell. Each facet keeps the
// color of its solid. Edges of the intersection curve are collapsed along the curve. The curve moves by at most 1/1000
// of the longest side of the bounding box, and still separates the colors.
#include "example_files.h"
#include "operand_labels.h"

#include <CGAL/Bspline_shell_3/Editing/Line_filter.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/IO/Color.h>

#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>

typedef CGAL::Certified_bspline_shell_3 Shell;

bool write(const char* name, Mesh& mesh)
{
  const Labels labels = labels_of(mesh);
  auto colors = mesh.add_property_map<Mesh::Face_index, CGAL::IO::Color>("f:color").first;
  for(Mesh::Face_index f : mesh.faces())
    colors[f] = labels[f] == 0 ? CGAL::IO::Color(224, 164, 88) : CGAL::IO::Color(92, 142, 173);
  return save(name, mesh);
}

int main(int argc, char** argv)
{
  std::string first_file, second_file, name;
  const Arguments arguments = Arguments(
                                "Usage: boolean_colors MESH [SECOND_MESH] [union | intersection | difference]\n"
                                "  SECOND_MESH: the second operand (default: MESH, rotated and translated)\n"
                                "  Writes boolean.ply and boolean_colors.ply. The default operation is union.\n")
                                .required(first_file)
                                .optional(second_file)
                                .optional(name);
  if(const auto code = arguments.read(argc, argv)) return *code;
  if(name.empty() && operation_of(second_file)) name.swap(second_file);
  const auto known = operation_of(name);
  if(!name.empty() && !known) return *arguments.wrong("There is no operation " + name + ".");
  const Boolean operation = known.value_or(Boolean::UNION);
  Mesh first, second;
  if(!read_mesh(first_file, first) || (!second_file.empty() && !read_mesh(second_file, second))) return EXIT_FAILURE;
  if(second_file.empty()) {
    second = first;
    place(second, first);
  }
  if(!is_operand(first) || !is_operand(second)) {
    std::cerr << "An operand is not a closed triangle mesh, intersects itself, or does not bound a volume: repair it."
              << std::endl;
    return EXIT_FAILURE;
  }
  set_labels(first, 0);
  set_labels(second, 1);
  Mesh mesh;
  if(!compute(operation, first, second, mesh)) {
    std::cerr << "The result is not a manifold: move one of the operands slightly." << std::endl;
    return EXIT_FAILURE;
  }
  const Labels labels = labels_of(mesh);
  const std::size_t curve_edges = mark_curve(mesh, labels, curve_of(mesh));

  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  if(!shell.is_certified()) {
    std::cerr << shell.message() << std::endl;
    return EXIT_FAILURE;
  }
  Mesh coarse = mesh;
  const Curve coarse_curve = curve_of(coarse);
  const BS::Line_filter near_curve(coarse, coarse_curve, 0.001 * shell.report().unit);
  const auto result = BS::simplify_in_shell(
    coarse, shell,
    BS::parameters::edge_is_constrained_map(coarse_curve).protect_constraints(false).filter(std::cref(near_curve)));
  if(!result) {
    std::cerr << result.message() << std::endl;
    return EXIT_FAILURE;
  }
  coarse.collect_garbage();
  std::cout << "facets: " << result.facets_before << " before, " << result.facets
            << " after; edges of the intersection curve: " << curve_edges << " before, " << result.constrained_edges
            << " after\n";

  // Facets of the simplified mesh keep their labels, except new facets at truncated tips. These get the most frequent
  // label of their image along the integral curves.
  const Labels coarse_labels = labels_of(coarse);
  const Labels carried = coarse.add_property_map<Mesh::Face_index, int>("f:carried", -1).first;
  const BS::Transfer_report report = BS::transfer_face_labels(BS::Shell_map_3<Shell, Mesh>(shell, mesh, coarse), labels,
                                                              carried);
  if(!report) {
    std::cerr << report.failures.size() << " facets have no image: " << message(report.failures[0].second) << std::endl;
    return EXIT_FAILURE;
  }
  std::size_t others = 0;
  for(Mesh::Face_index f : coarse.faces()) {
    if(coarse_labels[f] < 0) coarse_labels[f] = carried[f];
    others += coarse_labels[f] != carried[f] ? 1 : 0;
  }
  std::cout << "facets with most of their image on the other solid: " << others << "\n";
  return write("boolean.ply", mesh) && write("boolean_colors.ply", coarse) ? EXIT_SUCCESS : EXIT_FAILURE;
}
