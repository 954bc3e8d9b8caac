// The report of an edit.
#ifndef TOOL_COMMANDS_EDIT_SUMMARY_H
#define TOOL_COMMANDS_EDIT_SUMMARY_H

#include "Edited.h"
#include "Json.h"
#include "distance_bound.h"

#include "../Carry/carry_attributes.h"
#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace Tool {

struct Edit_summary
{
  std::string input, output;
  std::size_t facets_before = 0, facets = 0; // numbers for the whole surface
  bool reaches_target = true;                // whether a requested number of facets is reached
  std::size_t removed_border_edges = 0;
  Distance_bounds distances; // between the model and the result
  double thickness = 0;      // requested thickness of the shell
  bool is_rounded = false;   // whether coordinates are those of a file of floats
  Carry_report carried;
  std::vector<std::string> attributes, warnings;
  std::string limit; // why the edit ended, as a sentence
  double seconds = 0;
};

// Begins a report with the numbers of an edited mesh.
Edit_summary summary_of(const Edited& result, const std::string& input, const std::string& output);

// Returns the report, to which a command may add members.
Json json_of(const Edit_summary& summary, const Model& model, const BS::Shell_of_soup_3& found);

// Prints the report.
// \param lines titles and texts of further lines
void print(const Edit_summary& summary, const Model& model, const BS::Shell_of_soup_3& found,
           const std::vector<std::pair<std::string, std::string> >& lines);

} // namespace Tool

#endif // TOOL_COMMANDS_EDIT_SUMMARY_H
