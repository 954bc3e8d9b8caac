// Checks the certificate of a shell: whether its claims about the shell and a mesh are true.
//
//   check_certificate SHELL.shell.txt MESH.off CERTIFICATE.certificate.txt [USER_MESH.off
//                     [--excised KEPT.off SOUP.off JOINED.off]]
//
// If everything that the certificate claims as proved holds, the exit code is 0, with the line "certified: P1 ..." on
// stdout. It is 1, with a sentence on stderr, if a claim is wrong or cannot be confirmed. It is 2 if a file cannot be
// read or is malformed.
//
// f, EPS1 and EPS2 are the splines of the functions that the shell lists (EPS1 and EPS2 may be constants). A is the
// mesh MESH.off, n_T the normal of a facet T, and Omega* the components of {EPS1 <= f <= EPS2} that meet A. The claims
// are
//   P1  EPS1 <= f <= EPS2 on A;
//   P2  n_T . grad f > 0 on every closed facet T;
//   P3  Omega* lies in the interior of the leaves, grad f is not zero on it, and grad f . grad(f - EPSi) > 0 where f =
//       EPSi;
//   P4  every component of Omega* contains exactly one component of A;
//   P5  every component of Omega* contains a path from {f < EPS1} to {f > EPS2} that crosses A with count one.
//
// The user's mesh U may have been modified before it was examined: closed by triangles that the shell lists, and its
// tips truncated as listed in the shell. If the shell has a truncation, the line ends with " T"; if U is given, it ends
// with " A":
//   T   A is the truncation of some mesh, and the map h from that mesh to A is a homeomorphism. A mesh that was
//       simplified in its shell may lack patches of the truncation; " T(1/3)" means that it has one of three. Without a
//       patch, h is the identity there;
//   A   that mesh is U, closed if it is open. Without a truncation, h is the identity, and A is that mesh itself.
// If T or A does not hold, the exit code is 1. Facets are compared by the coordinates of their corners and their
// orientation; the order of facets and vertices is irrelevant.
//
// The user's file may be a soup of triangles, only some of which form the mesh that the shell was built for. The others
// are *excised*: they stay where they are when the mesh is edited. With --excised, U is the edited mesh, and
// KEPT.off the mesh before the edit. SOUP.off contains all triangles of the user's file; some facets of KEPT may have
// the opposite orientation there. JOINED.off contains the edited mesh and the excised triangles. The line then ends
// with " E":
//   E   the facets of KEPT are triangles of SOUP, and the others are the excised ones. JOINED consists of U and the
//       excised triangles, bit for bit. KEPT and U have the same border, and the same vertices and edges, but no
//       triangles, in common with the excised triangles. No excised triangle has a corner at a truncated tip. No two
//       triangles of SOUP have the same corners.
// Vertices with equal coordinates are the same vertex. If E does not hold, the exit code is 1.
//
// The theorem: if P1 to P5 hold for A, each curve of the flow of grad f through Omega* meets A once. So the flow is a
// one-to-one map from A to any other mesh that is certified for the same claims. With T and A, the flow after h is
// one-to-one from U; h does not move the triangles that close U. P1 to P5 are about A alone; h is proved
// separately, in exact arithmetic on the numbers of the truncation: see Truncation.h.
//
// The theorem of excision: let KEPT have a certificate for the same shell, too, with the same components, which is
// checked with KEPT as the user's mesh. Each curve meets a closed mesh only once. So the flow from KEPT to U fixes
// every point that both have in common and h does not move, and the triangles that close both. It maps KEPT onto U. By
// E, it agrees with the identity of the excised triangles where these meet KEPT, and U meets them nowhere else. So both
// together are a one-to-one map from SOUP to JOINED, as complexes of triangles. These may intersect themselves.
//
// Nothing is sampled. Real numbers are enclosed by intervals of doubles, rounded outwards after every operation. Exact
// values are integers or rationals. On a facet, f and its derivatives are bounded by Bernstein coefficients (of degree
// 9) of the leaf's polynomial over a triangle; on boxes, by those of the polynomial over the box.
//
// The splines are twice continuously differentiable across leaves of different sizes. This is checked for the listed
// functions, independent of their coefficients.
//
// This program shares no code with the package that writes the files. It relies on this folder; the compiler, the
// standard library and Boost (Multiprecision for rationals, CRC for checksums); double arithmetic as in IEEE 754,
// rounded to nearest, which is tested at the start; and the theorem above. The user is responsible for passing the
// intended shell, U (or A if U is not given), KEPT and SOUP, and for comparing the components of two certificates. Some
// parts of the files are not checked, as no claim depends on them: the shell's unit, thickness, numbers of triangles
// and components, marks of leaves, facet ranges, and kinds of triangles that close a mesh. It is not checked either
// that the cut facets of U do not intersect others (P1 to P5 imply this for A). So h is one-to-one from U as an
// abstract surface, whose facets have only their common edges and corners in common.
#include "Certificate.h"
#include "Checker.h"
#include "Excision.h"
#include "Mesh.h"
#include "Shell.h"
#include "Truncation.h"
#include "interval.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <iostream>
#include <set>
#include <string>
#include <vector>

// Checks that the facets of the mesh are those of the user's mesh, closed by the shell's triangles if it is open, and
// truncated.
void check_user_mesh(const Shell& shell, const std::vector<Truncation::Patch>& patches, const Mesh& mesh,
                     const Mesh& user_mesh)
{
  std::vector<Located_facet> facets = located_facets(user_mesh), added;
  for(const Truncation::Patch& patch : patches) {
    if(!std::includes(facets.begin(), facets.end(), patch.cut_facets.begin(), patch.cut_facets.end()))
      throw Unconfirmed("A: the user's mesh lacks facets that the truncation cuts");
    facets = without(facets, patch.cut_facets);
    added.insert(added.end(), patch.new_facets.begin(), patch.new_facets.end());
  }
  if(!user_mesh.is_closed_and_oriented()) added.insert(added.end(), shell.closing.begin(), shell.closing.end());
  facets.insert(facets.end(), added.begin(), added.end());
  std::sort(facets.begin(), facets.end());
  if(facets != located_facets(mesh))
    throw Unconfirmed("A: the mesh is not the user's mesh after closing and truncation");
}

// The files that the user passes. The files of the excision are optional.
struct Arguments
{
  Arguments(int argc, char** argv) : file(argv + 1, argv + argc)
  {
    const auto option = std::find(file.begin(), file.end(), "--excised");
    excision.assign(option == file.end() ? option : option + 1, file.end());
    are_valid = option == file.end() || (excision.size() == 3 && option - file.begin() == 4);
    file.erase(option, file.end());
    are_valid = are_valid && (file.size() == 3 || file.size() == 4);
  }
  bool are_valid;
  std::vector<std::string> file, excision;
};

int main(int argc, char** argv)
{
  const Arguments arguments(argc, argv);
  if(!arguments.are_valid) {
    std::cerr << "Usage: check_certificate SHELL.shell.txt MESH.off CERTIFICATE.certificate.txt [USER_MESH.off]\n"
                 "With USER_MESH.off, also: --excised KEPT.off SOUP.off JOINED.off"
              << std::endl;
    return 2;
  }
  if(!usable_arithmetic()) {
    std::cerr << "Double arithmetic does not follow IEEE 754 with rounding to nearest: compile without -ffast-math and "
                 "similar options."
              << std::endl;
    return 2;
  }
  try {
    const Shell shell(arguments.file[0]);
    const Mesh mesh(arguments.file[1]);
    const Certificate certificate(arguments.file[2], shell, mesh);
    Checker(shell, mesh, certificate).check();
    std::vector<Truncation::Patch> patches;
    std::string truncation;
    if(shell.truncation) {
      shell.truncation->check();
      patches = shell.truncation->patches_of(mesh);
      const std::size_t all = shell.truncation->patches().size();
      truncation = patches.size() == all ? " T"
                                         : " T(" + std::to_string(patches.size()) + "/" + std::to_string(all) + ")";
    }
    std::string last_claims;
    if(arguments.file.size() == 4) {
      const Mesh user_mesh(arguments.file[3]);
      check_user_mesh(shell, patches, mesh, user_mesh);
      last_claims = " A";
      if(!arguments.excision.empty()) {
        const Mesh kept(arguments.excision[0]), soup(arguments.excision[1]), joined(arguments.excision[2]);
        Excision(kept, soup, user_mesh, joined)
          .check(shell.truncation ? shell.truncation->center_positions() : std::set<Point>());
        last_claims += " E";
      }
    }
    std::cout << "certified:";
    for(int i = 0; i < 5; ++i)
      if(certificate.claimed[i]) std::cout << " P" << i + 1;
    std::cout << truncation << last_claims << std::endl;
    return 0;
  } catch(const Unconfirmed& error) {
    std::cerr << error.what() << std::endl;
    return 1;
  } catch(const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
}
