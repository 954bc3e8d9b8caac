// The reference for the times of run_all.sh, independent of the package: CGAL's edge collapse of a mesh on one core,
// and closest points of random points on it on all cores. Prints the seconds of both as a JSON object.
//
//   reference_computation [MESH]
//
// Default: armadillo.
#include "../AABB_tree_of.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Random.h>
#include <CGAL/Real_timer.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/for_each.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace PMP = CGAL::Polygon_mesh_processing;
namespace SMS = CGAL::Surface_mesh_simplification;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

int main(int argc, char** argv)
{
  const std::string file = argc > 1 ? argv[1] : MESHES "/armadillo.off";
  Mesh mesh;
  if(!PMP::IO::read_polygon_mesh(file, mesh)) {
    std::cerr << file << ": The mesh cannot be read." << std::endl;
    return EXIT_FAILURE;
  }
  const CGAL::Bbox_3 box = PMP::bbox(mesh);
  CGAL::Real_timer timer;
  timer.start();
  Mesh simplified = mesh;
  SMS::edge_collapse(simplified, SMS::Edge_length_stop_predicate<double>((box.xmax() - box.xmin()) / 10));
  const double collapse = timer.time();

  timer.reset();
  AABB_tree_of<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh> > tree(faces(mesh).begin(), faces(mesh).end(),
                                                                             mesh);
  tree.build();
  tree.accelerate_distance_queries();
  CGAL::Random random(1);
  std::vector<Kernel::Point_3> points;
  for(int n = 0; n < 20000; ++n)
    points.emplace_back(random.get_double(box.xmin(), box.xmax()), random.get_double(box.ymin(), box.ymax()),
                        random.get_double(box.zmin(), box.zmax()));
  CGAL::for_each<CGAL::Parallel_if_available_tag>(points, [&](Kernel::Point_3& p) {
    p = tree.closest_point(p);
    return true;
  });
  const double closest = timer.time();
  double sum = 0; // keeps the compiler from removing the computation
  for(const Kernel::Point_3& p : points) sum += p.x();
  std::cout << "{\"edge_collapse\":" << collapse << ",\"closest_points\":" << closest
            << ",\"facets\":" << simplified.number_of_faces() << ",\"sum\":" << sum << "}" << std::endl;
  return EXIT_SUCCESS;
}
