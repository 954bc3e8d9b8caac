// A mesh, cells around it, and a field on these cells.
#ifndef FIELD_ON_MESH_H
#define FIELD_ON_MESH_H

#include "coefficient_functions.h"
#include "input_of_mesh.h"

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>

#include <CGAL/Random.h>

#include <cstdint>
#include <vector>

struct Field_on_mesh
{
  typedef CGAL::Bspline_shells::Hierarchical_bspline_field_3<> Field;

  CGAL::Bspline_shells::Input_mesh_3 input;
  CGAL::Bspline_shells::Clipped_mesh_3 clipped;
  Field field;

  Field_on_mesh(const Mesh& mesh, const CGAL::Bspline_shells::Lattice_3& lattice) : input(input_of(mesh))
  {
    using namespace CGAL::Bspline_shells;
    typedef CGAL::Sequential_tag Tag;
    REQUIRE(lattice.is_exact());
    field = Field(Cell_complex_3(lattice, dilate(cells_entered_by_mesh<Tag>(input, lattice), -1, 1)));
    clipped = clip_mesh_to_cells<Tag>(input, field.cells());
  }

  // Sets each coefficient to a function of its point.
  template <typename Function>
  void set(const Function& f)
  {
    set_coefficients(field, [&](const Point_3& p, double) { return f(p); });
  }

  // Sets the field close to the distance from a unit sphere, plus noise.
  void set_noisy_distance(double noise, int seed, const Point_3& center = CGAL::ORIGIN)
  {
    CGAL::Random random(seed);
    set([&](const Point_3& p) { return distance(p, center) - 1 + random.get_double(-noise, noise); });
  }
};

#endif // FIELD_ON_MESH_H
