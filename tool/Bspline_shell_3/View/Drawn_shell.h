// A shell as it is drawn: the field from which scripts trace curves, and its surfaces.
#ifndef TOOL_VIEW_DRAWN_SHELL_H
#define TOOL_VIEW_DRAWN_SHELL_H

#include "Page.h"

#include "../Carry/Mesh_origins.h"

#include <array>

namespace Tool {

// Adds the field and its thresholds on the cells that the shell may meet: the cells, the lattice points whose functions
// act on them, and three coefficients for each of these points. Coordinates are relative to a center.
void write_field(Page& page, const Shell& shell, const std::array<double, 3>& center);

// Adds the inner and the outer surface, if they can be extracted.
// \param subdivision number of parts along each edge of a cell
void write_surfaces(Page& page, const Shell& shell, const std::array<double, 3>& center, int subdivision);

} // namespace Tool

#endif // TOOL_VIEW_DRAWN_SHELL_H
