// Builds the shell of a ball with two stray triangles, which are excised. Simplifies the ball, and joins it with these
// triangles again. The map between both soups is one-to-one; it transfers part numbers.
#include "broken_models.h"
#include "example_files.h"

#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Soup/Excised_map_3.h>
#include <CGAL/Bspline_shell_3/Soup/Excision_filter.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>
#include <CGAL/Bspline_shell_3/Soup/transfer_in_excised_soup.h>
#include <CGAL/certified_shell_of_soup_3.h>

#include <CGAL/IO/PLY.h>

#include <cstdlib>
#include <iostream>
#include <vector>

typedef BS::Shell_of_soup_3::Mesh Mesh;
typedef BS::Shell_of_soup_3::Shell Shell;

int main()
{
  const Broken_model model = ball_with_stray_triangles();
  const BS::Shell_of_soup_3 found = CGAL::certified_shell_of_soup_3(model.soup);
  std::cout << found.message() << "\n";
  if(found.certification() != BS::Certification::EXCEPT_EXCISED) return EXIT_FAILURE;
  const BS::Excised_soup_3& soup = *found.excised;

  // Simplify the mesh without the excised triangles. The edges and vertices to which they are attached are kept.
  Mesh coarse = soup.mesh();
  auto is_constrained = coarse.add_property_map<Mesh::Edge_index, bool>("e:is_constrained", false).first;
  BS::constrain_pins(soup, is_constrained);
  const auto simplified = BS::simplify_in_shell(
    coarse, found.shell(), BS::parameters::edge_is_constrained_map(is_constrained).filter(BS::Excision_filter(soup)));
  if(!simplified) {
    std::cerr << simplified.message() << std::endl;
    return EXIT_FAILURE;
  }
  coarse.collect_garbage();

  // Join both. This checks exactly that the mesh still has the same vertices and edges in common with the triangles.
  const BS::Rejoined_soup_3 whole = BS::rejoin_excised(soup, coarse);
  if(!whole) {
    std::cerr << message(whole.verdict.status) << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "triangles: " << soup.soup().triangles.size() << ", after simplification: " << whole.soup.polygons.size()
            << "\n";

  // Transfer part numbers. Excised triangles keep theirs.
  const BS::Excised_map_3<Shell> map(found.shell(), soup, coarse, whole);
  std::vector<std::size_t> part, part_of_whole;
  for(std::size_t polygon : soup.soup().polygon_of) part.push_back(model.part[polygon]);
  const BS::Transfer_report report = BS::transfer_triangle_labels(map, part, part_of_whole);
  std::cout << "triangles without a part: " << report.failures.size() << std::endl;
  return report && CGAL::IO::write_PLY("whole.ply", whole.soup.points, whole.soup.polygons) ? EXIT_SUCCESS
                                                                                            : EXIT_FAILURE;
}
