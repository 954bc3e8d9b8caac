// Verifies the claims of the certificate for a mesh in a shell of equal cells. The certificate has a verdict for each
// claim, and witnesses where a proof fails. The same object verifies other meshes in the shell. Single facets can be
// tested before a mesh is changed.
#include "example_files.h"

#include <CGAL/Bspline_shell_3/IO/write_certificate.h>
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_containment_3.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

int main(int argc, char** argv)
{
  std::string file;
  double resolution;
  const auto code = Arguments("Usage: certify_shell MESH RESOLUTION\n"
                              "  RESOLUTION: number of cells along the longest side of the bounding box\n"
                              "  Writes certified.shell.txt, certified.mesh.off, and certified.certificate.txt.\n")
                      .required(file)
                      .required(resolution)
                      .read(argc, argv);
  if(code) return *code;
  Mesh mesh;
  if(!read_mesh(file, mesh)) return EXIT_FAILURE;
  const CGAL::Bspline_shell_3<> shell = CGAL::bspline_shell_3(mesh, BS::parameters::resolution(resolution));
  if(!shell) {
    std::cerr << shell.message() << std::endl;
    return EXIT_FAILURE;
  }

  BS::Shell_certificate_3<> certificate(shell);
  certificate.verify(mesh);
  for(BS::Claim claim : { BS::Claim::CONTAINMENT, BS::Claim::TRANSVERSALITY, BS::Claim::GRADIENT, BS::Claim::ONE_SHEET,
                          BS::Claim::DEGREE_ONE })
    std::cout << name(claim) << ": " << name(certificate.verdict(claim)) << "\n";
  for(const BS::Certificate_witness& w : certificate.witnesses())
    std::cout << name(w.claim) << " is " << name(w.verdict) << " at " << place(w) << "\n";
  if(certificate)
    std::cout << "No point is farther than " << certificate.displacement_bound()
              << " from its image on another certified mesh.\n";

  // Would a facet still be in the shell if one of its vertices were moved?
  const BS::Shell_containment_3<> is_in_shell(shell);
  const auto h = mesh.halfedge(*mesh.faces().begin());
  const Kernel::Point_3 p = mesh.point(mesh.source(h)), q = mesh.point(mesh.target(h)),
                        r = mesh.point(mesh.target(mesh.next(h)));
  const bool remains = is_in_shell(p + Kernel::Vector_3(0, 0, shell.thickness() / 100), q, r);
  std::cout << "After one vertex is moved by 1 % of the shell's thickness, the facet is " << (remains ? "" : "not ")
            << "in the shell." << std::endl;

  // Write the input of check_certificate, a program that checks the proof independently: the shell as text, the
  // examined mesh with all digits, and the certificate, which identifies both by their checksums.
  const bool has_shell = BS::write_shell("certified.shell.txt", shell) == BS::Shell_file_status::SUCCESS;
  const bool has_mesh = save("certified.mesh.off", certificate.examined_mesh());
  const bool has_certificate = BS::write_certificate("certified.certificate.txt", shell, certificate);
  if(!is_written(has_shell, "certified.shell.txt") || !has_mesh
     || !is_written(has_certificate, "certified.certificate.txt"))
    return EXIT_FAILURE;
  return certificate ? EXIT_SUCCESS : 2;
}
