// A mesh, and equal cells around it to which it is clipped.
#ifndef MESH_IN_CELLS_H
#define MESH_IN_CELLS_H

#include "input_of_mesh.h"
#include "random_hierarchies.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Fit/Slope_condition.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/tags.h>

#include <array>
#include <cmath>

struct Mesh_in_cells
{
  typedef CGAL::Bspline_shells::Hierarchical_bspline_field_3<> Field;

  CGAL::Bspline_shells::Input_mesh_3 input;
  Field field;
  CGAL::Bspline_shells::Clipped_mesh_3 clipped;

  // pre: the width is a power of two
  Mesh_in_cells(const Mesh& mesh, double width = 0.5) : input(input_of(mesh))
  {
    const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
    std::array<int, 3> first, last;
    for(int a = 0; a < 3; ++a) {
      first[a] = int(std::floor(box.min_coord(a) / width)) - 1;
      last[a] = int(std::floor(box.max_coord(a) / width)) + 1;
    }
    field = Field(Hierarchy(all_cells(width, first, last)));
    clipped = CGAL::Bspline_shells::clip_mesh_to_cells<CGAL::Sequential_tag>(input, field.cells());
  }

  Point_3 point(const CGAL::Bspline_shells::Slope_condition& c) const
  {
    const auto cell = field.cell(c.cell);
    return Point_3(cell.corner()[0] + cell.width() * c.position[0], cell.corner()[1] + cell.width() * c.position[1],
                   cell.corner()[2] + cell.width() * c.position[2]);
  }
};

#endif // MESH_IN_CELLS_H
