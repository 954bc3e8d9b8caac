// A program outside the project, which uses only the installed package. It prints all bits of its shells.
#include <CGAL/bspline_shell_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <cstdlib>
#include <ios>
#include <iostream>

int main()
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
  typedef Kernel::Point_3 Point_3;
  CGAL::Surface_mesh<Point_3> mesh;
  CGAL::make_tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1), mesh);
  std::cout << std::hexfloat;

  // The package also uses this class of CGAL, whose layout depends on NDEBUG.
  CGAL::Min_sphere_of_spheres_d<CGAL::Min_sphere_of_points_d_traits_3<Kernel, double> > ball(mesh.points().begin(),
                                                                                             mesh.points().end());
  std::cout << ball.radius() << "\n";

  const auto shell = CGAL::bspline_shell_3(mesh, CGAL::Bspline_shells::parameters::resolution(12));
  if(!shell) return EXIT_FAILURE;
  std::cout << shell.inner_level() << "\n" << shell.outer_level() << "\n" << shell.field().coefficients() << "\n";

  const auto certified = CGAL::certified_bspline_shell_3(
    mesh, CGAL::Bspline_shells::parameters::relative_thickness(0.1).resolution(8));
  if(!certified.is_certified()) return EXIT_FAILURE;
  std::cout << certified.report().certificate.least_gradient << "\n"
            << certified.field().coefficients() << "\n"
            << certified.inner_threshold().field().coefficients() << "\n"
            << certified.outer_threshold().field().coefficients() << std::endl;
  return EXIT_SUCCESS;
}
