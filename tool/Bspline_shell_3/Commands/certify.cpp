#include "Json.h"
#include "commands.h"

#include "../Carry/Mesh_origins.h"

#include <CGAL/Bspline_shell_3/Certificate/certify.h>
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/IO/read_shell.h>

#include <iostream>
#include <string>
#include <vector>

namespace Tool {

Outcome certify(const std::string& shell_file, const std::string& mesh_file, bool writes_json)
{
  Shell shell;
  const BS::Shell_file_status read = BS::read_shell(shell_file, shell);
  if(read == BS::Shell_file_status::NOT_A_SHELL)
    return { WRONG_INPUT, shell_file,
             "The file is not a shell: give the file PREFIX.shell that the command `shell` wrote." };
  if(read != BS::Shell_file_status::SUCCESS) return { WRONG_INPUT, shell_file, message(read) };
  Mesh mesh;
  BS::Offending_simplices offenders;
  const BS::Shell_status mesh_read = BS::read_polygon_mesh(mesh_file, mesh, offenders);
  if(mesh_read != BS::Shell_status::SUCCESS) return { WRONG_INPUT, mesh_file, message(mesh_read), offenders };
  const auto certificate = BS::certify(shell, mesh);
  if(certificate.status() != BS::Shell_status::SUCCESS)
    return { WRONG_INPUT, mesh_file, message(certificate.status()), certificate.offending_simplices() };
  Json claims;
  for(BS::Claim claim : { BS::Claim::CONTAINMENT, BS::Claim::TRANSVERSALITY, BS::Claim::GRADIENT, BS::Claim::ONE_SHEET,
                          BS::Claim::DEGREE_ONE }) {
    claims.add(name(claim), name(certificate.verdict(claim)));
    if(!writes_json) std::cout << name(claim) << ": " << name(certificate.verdict(claim)) << "\n";
  }
  constexpr std::size_t most = 10;
  std::vector<std::string> witnesses;
  for(const auto& witness : certificate.witnesses())
    if(witnesses.size() < most)
      witnesses.push_back(name(witness.claim) + std::string(" is ") + name(witness.verdict) + " at " + place(witness));
  if(writes_json) {
    Json json;
    json.add("shell", shell_file)
      .add("mesh", mesh_file)
      .add("certified", bool(certificate))
      .add("claims", claims)
      .add("displacement_bound", certificate.displacement_bound())
      .add("witnesses", witnesses);
    std::cout << json.text() << std::endl;
  } else if(certificate)
    std::cout << "The mesh is certified: no point is farther than " << certificate.displacement_bound()
              << " from its image on another certified mesh." << std::endl;
  else {
    std::cout
      << "The mesh is not certified: correct it at the listed places, or build a shell with a larger --thickness."
      << std::endl;
    for(const std::string& witness : witnesses) std::cerr << witness << "\n";
  }
  return certificate ? DONE : NOT_CERTIFIED;
}

} // namespace Tool
