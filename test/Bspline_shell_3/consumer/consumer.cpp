// A program outside the project: the installed package is all that it knows. It is built with assertions on.
#include <CGAL/bspline_shell_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <cstdlib>

int main()
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  CGAL::Surface_mesh<Point_3> mesh;
  CGAL::make_tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1), mesh);
  const auto shell = CGAL::bspline_shell_3(mesh, CGAL::Bspline_shells::parameters::resolution(12));
  return shell && shell.inner_level() < 0 && shell.outer_level() > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
