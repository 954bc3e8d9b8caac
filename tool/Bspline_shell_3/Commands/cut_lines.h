// Cuts a simplified mesh along the images of lines of the original mesh.
#ifndef TOOL_COMMANDS_CUT_LINES_H
#define TOOL_COMMANDS_CUT_LINES_H

#include "../Carry/Mesh_origins.h"

#include <CGAL/Bspline_shell_3/Editing/Cut_report.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace Tool {

struct Cut_lines
{
  BS::Cut_report cut;   // if the mesh was not cut, with the reason
  std::size_t gaps = 0; // number of parts of edges without an image
};

// \param is_line edges of the mesh of the shell on lines
// \param mesh the simplified mesh, certified in the shell; without garbage
// \param closing triangles that close it if it is open
Cut_lines cut_lines(const BS::Shell_of_soup_3& found, const std::vector<char>& is_line, Mesh& mesh,
                    const std::shared_ptr<const BS::Shell_closing_3>& closing);

} // namespace Tool

#endif // TOOL_COMMANDS_CUT_LINES_H
