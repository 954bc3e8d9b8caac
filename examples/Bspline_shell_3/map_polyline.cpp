// Simplifies a mesh, maps a closed curve from the mesh to the result, and cuts the result along its image. The curve is
// where a horizontal plane meets the mesh. Writes cut.ply, whose facets have the color of their side of the curve.
#include "example_files.h"

#include <CGAL/Bspline_shell_3/Editing/cut_along_polylines.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/map_polyline.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace PMP = CGAL::Polygon_mesh_processing;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef std::vector<PMP::Face_location<Mesh, double> > Polyline;

// Returns the closed polylines in which a horizontal plane that contains no vertex meets a closed mesh.
std::vector<Polyline> section(const Mesh& mesh, double z)
{
  const auto is_above = [&](Mesh::Vertex_index v) { return mesh.point(v).z() > z; };
  std::vector<Polyline> result;
  std::vector<char> is_done(mesh.num_halfedges(), 0);
  for(Mesh::Halfedge_index h : mesh.halfedges())
    if(!is_done[h] && !is_above(mesh.source(h)) && is_above(mesh.target(h))) {
      result.emplace_back();
      while(!is_done[h]) {
        is_done[h] = 1;
        const double a = mesh.point(mesh.source(h)).z() - z, b = mesh.point(mesh.target(h)).z() - z;
        result.back().push_back(PMP::locate_on_halfedge<double>(h, a / (a - b), mesh));
        h = mesh.next(h); // the facet's other edge with ends on both sides
        if(is_above(mesh.source(h)) == is_above(mesh.target(h))) h = mesh.next(h);
        h = mesh.opposite(h);
      }
      result.back().push_back(result.back().front());
    }
  return result;
}

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
  for(const Polyline& curve : section(mesh, box.zmin() + 0.4321 * (box.zmax() - box.zmin()))) {
    const auto image = BS::map_polyline(map, curve);
    for(const auto& gap : image.gaps)
      std::cerr << "No image from " << gap.begin << " to " << gap.end << ": " << gap.message() << std::endl;
    for(const auto& part : image.parts) {
      images.emplace_back();
      for(const auto& vertex : part) images.back().push_back(vertex.location);
      std::cout << "A polyline with " << curve.size() << " vertices has an image with " << part.size() << ".\n";
    }
  }

  // The map is of no use for the cut mesh.
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
