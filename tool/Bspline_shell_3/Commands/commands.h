// The commands of the program. They print their results.
#ifndef TOOL_COMMANDS_COMMANDS_H
#define TOOL_COMMANDS_COMMANDS_H

#include "Edit_options.h"
#include "Outcome.h"
#include "find_shell.h"
#include "simplify_model.h"

#include <cstddef>
#include <optional>
#include <string>

namespace Tool {

Outcome simplify(const Simplify_options& options, bool writes_json);

struct Remesh_options : Edit_options
{
  std::optional<Length> edge; // always given
  double feature = 60;        // in degrees; edges with a larger angle between the normals of their facets are kept
};
Outcome remesh(const Remesh_options& options, bool writes_json);

// The input and the shell are those of the mesh with attributes.
struct Transfer_options : Shell_options
{
  std::string to, output;
  std::string view; // page that shows both meshes; empty if it is not written
  bool includes_normals = false;
  std::string image, normal_image; // files to bake; empty if there is none
  std::size_t size = 1024;         // number of texels along each side
  std::size_t margin = 8;          // in texels
};
Outcome transfer(const Transfer_options& options, bool writes_json);

// \param view page that shows the shell; empty if it is not written
Outcome shell(const Shell_options& options, const std::string& prefix, const std::string& view, bool writes_json);

struct Check_options : Shell_options
{
  std::string other; // a mesh whose distance is bounded; empty if there is none
};
Outcome check(const Check_options& options, bool writes_json);

Outcome certify(const std::string& shell, const std::string& mesh, bool writes_json);

} // namespace Tool

#endif // TOOL_COMMANDS_COMMANDS_H
