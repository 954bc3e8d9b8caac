// Builds a certified shell of a mesh, and prints its properties: cells are refined until the map between meshes in the
// shell is proved to be one-to-one, or until a limit is reached. Then moves the vertices of the mesh along the
// gradient, and verifies the moved mesh in the same shell.
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iostream>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef CGAL::Certified_bspline_shell_3 Shell;

int main(int argc, char** argv)
{
  Mesh mesh;
  if(argc < 2) {
    std::cerr << "Usage: certified_shell MESH [THICKNESS]\n"
                 "  THICKNESS: fraction of the longest side of the bounding box (default 0.01)\n";
    return EXIT_FAILURE;
  }
  const BS::Shell_status read = BS::read_polygon_mesh(argv[1], mesh);
  if(read != BS::Shell_status::SUCCESS) {
    std::cerr << argv[1] << ": " << message(read) << std::endl;
    return EXIT_FAILURE;
  }
  const double thickness = argc > 2 ? std::atof(argv[2]) : 0.01;
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, BS::parameters::relative_thickness(thickness));
  if(!shell) {
    std::cerr << shell.message() << std::endl;
    return EXIT_FAILURE;
  }
  const BS::Shell_report& report = shell.report();
  std::cout << shell.message() << "\n"
            << report.rounds.size() << " rounds, " << report.cells << " cells, " << report.unknowns
            << " unknowns\nthickness " << 100 * shell.relative_thickness() << " % of the bounding box; narrower on "
            << 100 * report.narrowed_area << " % of the mesh area\n";
  if(report.limit.resource != BS::Refinement_resource::NONE) std::cout << message(report.limit) << "\n";
  for(std::size_t n = 0; n < (std::min)(report.obstacles.size(), std::size_t(5)); ++n)
    std::cout << message(report.obstacles[n], report.unit, report.refinement) << "\n";
  if(!shell.is_certified())
    std::cout << report.certificate.total_number_of_witnesses() << " witnesses, " << report.certificate.witnesses.size()
              << " of them listed:\n";
  for(const BS::Certificate_witness& w : report.certificate.witnesses)
    std::cout << name(w.claim) << " is " << name(w.verdict) << " at " << place(w) << "\n";

  // Verify another mesh in the same shell.
  Mesh moved = mesh;
  for(Mesh::Vertex_index v : moved.vertices()) {
    const auto gradient = shell.field().gradient(moved.point(v));
    if(gradient) moved.point(v) = moved.point(v) + shell.thickness() / 100 * *gradient;
  }
  BS::Shell_certificate_3<Shell::Field, Shell::Threshold> certificate(shell);
  std::cout << "The moved mesh is " << (certificate.verify(moved) ? "" : "not ") << "certified." << std::endl;
  return shell.is_certified() ? EXIT_SUCCESS : 2;
}
