// Simplifies a mesh, maps a closed curve from the mesh to the result, and cuts the result along its image. The curve is
// where a horizontal plane meets the mesh. Writes cut.ply, whose facets have the color of their side of the curve.
#include "example_files.h"
#include "horizontal_section.h"

#include <CGAL/Bspline_shell_3/Editing/cut_along_polylines.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/map_polyline.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace PMP = CGAL::Polygon_mesh_processing;

int main(int argc, char** argv)
{
  std::string file;
  std::size_t facets = 1000;
  const auto code = Arguments("Usage: map_polyline MESH [FACETS]\n").required(file).optional(facets).read(argc, argv);
  if(code) return *code;
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  const auto shell = CGAL::certified_bspline_shell_3(mesh);
  Mesh coarse = mesh;
  if(!shell.is_certified()
     || !BS::simplify_in_shell(coarse, shell, BS::parameters::stop(BS::Facet_count_stop_predicate(facets)))) {
    std::cerr << "The mesh cannot be simplified: " << shell.message() << std::endl;
    return EXIT_FAILURE;
  }
  coarse.collect_garbage();

  std::vector<Polyline> images;
  const BS::Shell_map_3 map(shell, mesh, coarse);
  const CGAL::Bbox_3 box = PMP::bbox(mesh);
  for(const Polyline& curve : horizontal_section(mesh, box.zmin() + 0.4321 * (box.zmax() - box.zmin()))) {
    const auto image = BS::map_polyline(map, curve);
    for(const auto& gap : image.gaps)
      std::cerr << "No image from " << gap.begin << " to " << gap.end << ": " << gap.message() << std::endl;
    for(const auto& part : image.parts) {
      images.emplace_back();
      for(const auto& vertex : part) images.back().push_back(vertex.location);
      std::cout << "A polyline with " << curve.size() << " vertices has an image with " << part.size() << ".\n";
    }
  }

  // The cut changes `coarse`, so the map must not be used afterwards.
  auto is_cut = coarse.add_property_map<Mesh::Edge_index, bool>("e:is_cut", false).first;
  const auto report = BS::cut_along_polylines(coarse, images, shell, BS::parameters::edge_is_constrained_map(is_cut));
  std::cout << message(report.status) << "\n"
            << report.cut_facets << " of " << report.facets_before << " facets were cut; there are now "
            << report.facets << ", and " << report.cut_edges << " edges on curves." << std::endl;
  if(!report) return EXIT_FAILURE;
  auto side = coarse.add_property_map<Mesh::Face_index, std::size_t>("f:side").first;
  PMP::connected_components(coarse, side, CGAL::parameters::edge_is_constrained_map(is_cut));
  auto color = coarse.add_property_map<Mesh::Face_index, CGAL::IO::Color>("f:color").first;
  for(Mesh::Face_index f : coarse.faces()) color[f] = side[f] % 2 == 0 ? CGAL::IO::red() : CGAL::IO::white();
  return save("cut.ply", coarse) ? EXIT_SUCCESS : EXIT_FAILURE;
}
