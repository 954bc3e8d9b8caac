// Computes the distances of the polygons of two files from each other with CGAL's bounded-error method. Prints one JSON
// object.
//
//   hausdorff_distance FIRST SECOND ERROR
//
// `to_second` is the largest distance of a point of the first file from the polygons of the second one, up to ERROR;
// `to_first` is the converse. Polygons are divided into triangles, and triangles without an area are left out. The
// files need not be meshes.
#include "../json.h"

#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/tags.h>

#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>

namespace BS = CGAL::Bspline_shells;
namespace PMP = CGAL::Polygon_mesh_processing;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

// Adds each triangle with its own vertices, because the triangles of a file may intersect or share edges in any way.
bool read_separate_triangles(const std::string& file, Mesh& mesh)
{
  BS::Polygon_soup soup;
  BS::Offending_simplices offenders;
  if(BS::read_polygon_soup(file, soup, offenders) != BS::Shell_status::SUCCESS) return false;
  for(const auto& polygon : soup.polygons)
    for(std::size_t i = 2; i < polygon.size(); ++i) {
      const Kernel::Point_3 &p = soup.points[polygon[0]], &q = soup.points[polygon[i - 1]],
                            &r = soup.points[polygon[i]];
      if(!CGAL::collinear(p, q, r)) mesh.add_face(mesh.add_vertex(p), mesh.add_vertex(q), mesh.add_vertex(r));
    }
  return mesh.number_of_faces() > 0;
}

int main(int argc, char** argv)
{
  const double error = argc == 4 ? std::atof(argv[3]) : 0;
  if(!(error > 0)) {
    std::cerr << "Usage: hausdorff_distance FIRST SECOND ERROR" << std::endl;
    return EXIT_FAILURE;
  }
  Mesh meshes[2];
  for(int n = 0; n < 2; ++n)
    if(!read_separate_triangles(argv[n + 1], meshes[n])) {
      std::cerr << argv[n + 1] << " has no triangles that can be read." << std::endl;
      return EXIT_FAILURE;
    }
  print_JSON_numbers();
  std::cout.precision(17);
  const auto distance = [&](const Mesh& from, const Mesh& to) {
    return PMP::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(from, to, error);
  };
  std::cout << "{\"to_second\":" << distance(meshes[0], meshes[1]) << ",\"to_first\":" << distance(meshes[1], meshes[0])
            << ",\"error\":" << error << "}" << std::endl;
}
