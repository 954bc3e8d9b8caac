#include "Drawn_shell.h"

#include <CGAL/Bspline_shell_3/Surface/extract_shell_surface.h>

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace Tool {

void write_field(Page& page, const Shell& shell, const std::array<double, 3>& center)
{
  typedef Shell::Field Field;
  const Field& field = shell.field();
  std::vector<int> cells; // level and lattice point of each cell
  std::vector<char> is_used(field.number_of_points(), 0);
  for(std::size_t n = 0; n < field.number_of_cells(); ++n) {
    if(shell.shell_cells()[n] == 0) continue;
    const Field::Cell_index c = Field::Cell_index(n);
    const auto& corner = field.cells().lattice_point(c);
    cells.insert(cells.end(), { field.cells().level(c), corner[0], corner[1], corner[2] });
    for(auto row : field.coefficient_rows(c))
      for(std::size_t i = 0; i < 4; ++i) is_used[row + i] = 1;
  }
  const std::array<Eigen::VectorXd, 3> splines = {
    field.extend(field.coefficients()),
    shell.inner_threshold().field().extend(shell.inner_threshold().field().coefficients()),
    shell.outer_threshold().field().extend(shell.outer_threshold().field().coefficients())
  };
  std::vector<int> points; // level and lattice point
  std::vector<float> coefficients;
  for(int level = 0; level < field.number_of_levels(); ++level)
    for(Field::Cell_index n = 0; n < field.points(level).size(); ++n) {
      const Field::Cell_index point = field.first_point(level) + n;
      if(is_used[point] == 0) continue;
      const auto& p = field.points(level).point(n);
      points.insert(points.end(), { level, p[0], p[1], p[2] });
      for(const auto& spline : splines) coefficients.push_back(float(spline[point]));
    }
  const auto& lattice = field.cells().lattice();
  std::vector<double> frame; // origin, and width of the cells of level 0
  for(std::size_t i = 0; i < 3; ++i) frame.push_back(lattice.origin()[i] - center[i]);
  frame.push_back(field.cells().level_width(0));
  page.add("field.frame", frame);
  page.add("field.cells", cells);
  page.add("field.points", points);
  page.add("field.coefficients", coefficients);
}

void write_surfaces(Page& page, const Shell& shell, const std::array<double, 3>& center, int subdivision)
{
  const auto write = [&](const std::string& name, const Shell::Threshold& threshold) {
    Mesh surface;
    if(BS::extract_shell_surface<CGAL::Parallel_if_available_tag>(shell, threshold, surface,
                                                                  BS::parameters::subdivision_ratio(subdivision))
       != BS::Level_set_status::SUCCESS)
      return;
    std::vector<float> points;
    std::vector<unsigned int> triangles;
    for(auto v : surface.vertices())
      for(int i = 0; i < 3; ++i) points.push_back(float(surface.point(v)[i] - center[std::size_t(i)]));
    for(auto f : surface.faces())
      for(auto v : surface.vertices_around_face(surface.halfedge(f))) triangles.push_back(v);
    page.add(name + ".points", points);
    page.add(name + ".triangles", triangles);
  };
  write("inner", shell.inner_threshold());
  write("outer", shell.outer_threshold());
}

} // namespace Tool
