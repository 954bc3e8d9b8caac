// Carries all attributes of a model to a mesh that replaces it.
#ifndef TOOL_CARRY_CARRY_ATTRIBUTES_H
#define TOOL_CARRY_CARRY_ATTRIBUTES_H

#include "Mesh_origins.h"

#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>

#include <cstddef>
#include <functional>
#include <memory>

namespace Tool {

enum class Normals
{
  RECOMPUTED,
  CARRIED
};

struct Carry_report
{
  std::size_t points_without_image = 0; // their values are those of the nearest points
  std::size_t facets_across_seams = 0;
};

// Returns a model with the facets of a mesh in the shell of a model, and with the attributes of the model. Excised
// triangles follow the facets, and keep their attributes.
// \param closing the triangles that close the mesh if it is open
// \param rejoined the mesh and the excised triangles; empty if there are none
// \param progress called with the fraction of the work that is done
Model carry_attributes(const Model& model, const BS::Shell_of_soup_3& found, const Mesh& mesh,
                       const std::shared_ptr<const BS::Shell_closing_3>& closing, const BS::Rejoined_soup_3& rejoined,
                       Normals normals, Carry_report& report, const std::function<void(double)>& progress);

} // namespace Tool

#endif // TOOL_CARRY_CARRY_ATTRIBUTES_H
