// Builds a shell from a user-defined signed distance, here that of a sphere.
#include <CGAL/bspline_shell_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

int main(int argc, char** argv)
{
  const double radius = argc > 1 ? std::atof(argv[1]) : 1;
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Kernel::Point_3(CGAL::ORIGIN), radius);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(3));
  for(auto v : mesh.vertices()) {
    const Kernel::Vector_3 d = mesh.point(v) - CGAL::ORIGIN;
    mesh.point(v) = CGAL::ORIGIN + radius / std::sqrt(d.squared_length()) * d;
  }

  const auto distance_to_sphere = [radius](const Kernel::Point_3& p) {
    return std::sqrt(CGAL::squared_distance(p, Kernel::Point_3(CGAL::ORIGIN))) - radius;
  };
  namespace parameters = CGAL::Bspline_shells::parameters;
  const auto shell = CGAL::bspline_shell_3(mesh, parameters::resolution(30).signed_distance_oracle(distance_to_sphere));
  if(!shell) {
    std::cerr << shell.message() << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "The mesh of the sphere lies between the thresholds " << shell.inner_level() << " and "
            << shell.outer_level() << "." << std::endl;
  return EXIT_SUCCESS;
}
