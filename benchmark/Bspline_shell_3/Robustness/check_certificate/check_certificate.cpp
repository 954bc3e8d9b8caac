// Checks the certificate of a shell: whether what it says about the shell and a mesh is true.
//
//   check_certificate SHELL.shell.txt MESH.off CERTIFICATE.certificate.txt
//
// Exit code 0 and the line "certified: P1 ..." on stdout if everything that the certificate claims as proved holds;
// 1 and a sentence on stderr if a claim is wrong or cannot be confirmed; 2 if a file cannot be read or is malformed.
//
// f, EPS1 and EPS2 are the splines of the functions that the shell lists (EPS1 and EPS2 may be constants), A the mesh, n_T the
// normal of a facet T, Omega* the components of {EPS1 <= f <= EPS2} that meet A. The claims are
//   P1  EPS1 <= f <= EPS2 on A;
//   P2  n_T . grad f > 0 on every closed facet T;
//   P3  Omega* lies in the interior of the leaves, grad f is not zero on it, and grad f . grad(f - EPSi) > 0 where f = EPSi;
//   P4  every component of Omega* contains exactly one component of A;
//   P5  every component of Omega* contains a path from {f < EPS1} to {f > EPS2} that crosses A with count one.
//
// Nothing is sampled. Real numbers are enclosed by intervals of doubles, rounded outwards after every operation; what has
// to be exact is an integer or a rational. On a facet, f and its derivatives are bounded by the Bernstein coefficients (of
// degree 9) of the leaf's polynomial over a triangle, on boxes by those of the polynomial over the box.
//
// That the splines are twice continuously differentiable across leaves of different sizes is checked, too: by which functions are
// listed, whatever their coefficients are.
//
// This program shares no code with the package that writes the files. What has to be trusted: this folder; the compiler, the
// standard library and Boost (Multiprecision for rationals, CRC for checksums); double arithmetic as in IEEE 754, rounded
// to nearest, which is tested at the start; and the theorem that P1 to P5 imply what one wants to know. The user has to
// see to it that the mesh and the shell are those that are meant. Not checked, as no claim depends on them: the shell's
// unit, thickness, numbers of triangles and components, marks of leaves, and facet ranges.
#include "Certificate.h"
#include "Checker.h"
#include "Mesh.h"
#include "Shell.h"
#include "interval.h"

#include <exception>
#include <iostream>

int main(int argc, char** argv)
{
  if(argc != 4) {
    std::cerr << "Usage: check_certificate SHELL.shell.txt MESH.off CERTIFICATE.certificate.txt" << std::endl;
    return 2;
  }
  if(!usable_arithmetic()) {
    std::cerr << "Double arithmetic is not that of IEEE 754 rounded to nearest: compile without -ffast-math and the like" << std::endl;
    return 2;
  }
  try {
    const Shell shell(argv[1]);
    const Mesh mesh(argv[2]);
    const Certificate certificate(argv[3], shell, mesh);
    Checker(shell, mesh, certificate).check();
    std::cout << "certified:";
    for(int i = 0; i < 5; ++i)
      if(certificate.claimed[i]) std::cout << " P" << i + 1;
    std::cout << std::endl;
    return 0;
  }
  catch(const Unconfirmed& error) {
    std::cerr << error.what() << std::endl;
    return 1;
  }
  catch(const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
}
