// Cuts a simplified mesh along the images of lines of the original mesh.
#ifndef TOOL_VERBS_CUT_LINES_H
#define TOOL_VERBS_CUT_LINES_H

#include "../Carry/Mesh_origins.h"

#include <CGAL/Bspline_shell_3/Editing/Cut_report.h>

#include <cstddef>
#include <vector>

namespace Tool {

struct Cut_lines
{
  BS::Cut_report cut;   // if the mesh was not cut, with the reason
  std::size_t gaps = 0; // number of parts of edges without an image
};

// \param is_line edges of the original mesh on lines
// \param mesh the simplified mesh, certified in the shell; without garbage
Cut_lines cut_lines(const Shell& shell, const Mesh& original, const std::vector<char>& is_line, Mesh& mesh);

} // namespace Tool

#endif // TOOL_VERBS_CUT_LINES_H
