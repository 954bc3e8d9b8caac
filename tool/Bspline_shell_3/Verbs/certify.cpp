#include "Exit_code.h"
#include "Input.h"
#include "Json.h"
#include "verbs.h"

#include "../Carry/Mesh_origins.h"

#include <CGAL/Bspline_shell_3/Certificate/certify.h>
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/IO/read_shell.h>

#include <algorithm>
#include <iostream>

namespace Tool {

int certify(const Certify_options& options)
{
  Shell shell;
  const BS::Shell_file_status read = BS::read_shell(options.shell, shell);
  if(read != BS::Shell_file_status::SUCCESS) {
    complain(options.shell, message(read));
    return WRONG_INPUT;
  }
  Mesh mesh;
  BS::Offending_simplices offenders;
  const BS::Shell_status mesh_read = BS::read_polygon_mesh(options.mesh, mesh, offenders);
  if(mesh_read != BS::Shell_status::SUCCESS) {
    complain(options.mesh, message(mesh_read), offenders);
    return WRONG_INPUT;
  }
  const auto certificate = BS::certify(shell, mesh);
  if(certificate.status() != BS::Shell_status::SUCCESS) {
    complain(options.mesh, message(certificate.status()), certificate.offending_simplices());
    return WRONG_INPUT;
  }
  Json claims;
  for(BS::Claim claim : { BS::Claim::CONTAINMENT, BS::Claim::TRANSVERSALITY, BS::Claim::GRADIENT, BS::Claim::ONE_SHEET,
                          BS::Claim::DEGREE_ONE }) {
    claims.add(name(claim), name(certificate.verdict(claim)));
    if(!options.writes_json) std::cout << name(claim) << ": " << name(certificate.verdict(claim)) << "\n";
  }
  if(options.writes_json) {
    Json json;
    json.add("shell", options.shell)
      .add("mesh", options.mesh)
      .add("certified", bool(certificate))
      .add("claims", claims)
      .add("displacement_bound", certificate.displacement_bound());
    std::cout << json.text() << std::endl;
  } else if(certificate)
    std::cout << "The mesh is certified: no point is farther than " << certificate.displacement_bound()
              << " from its image on another certified mesh." << std::endl;
  constexpr std::size_t most = 10;
  const auto& witnesses = certificate.witnesses();
  for(std::size_t n = 0; n < (std::min)(witnesses.size(), most); ++n)
    std::cerr << name(witnesses[n].claim) << " is " << name(witnesses[n].verdict) << " at " << place(witnesses[n])
              << "\n";
  return certificate ? DONE : NOT_CERTIFIED;
}

} // namespace Tool
