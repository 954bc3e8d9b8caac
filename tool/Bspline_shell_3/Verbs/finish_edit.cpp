#include "finish_edit.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>

#include <utility>

namespace Tool {

bool round_coordinates(Mesh& mesh, const Shell& shell)
{
  Mesh rounded = mesh;
  for(auto v : rounded.vertices()) {
    const auto& p = mesh.point(v);
    rounded.point(v) = Mesh::Point(float(p.x()), float(p.y()), float(p.z()));
  }
  BS::Shell_certificate_3<Shell::Field, Shell::Threshold> certificate(shell);
  if(!certificate.verify(rounded)) return false;
  mesh = std::move(rounded);
  return true;
}

Distance_bounds distances_of_edit(const BS::Shell_of_soup_3& found, const Mesh& mesh, double resolution)
{
  Distance_bounds bounds = distance_bounds(found.proxy ? found.proxy->soup().mesh() : found.mesh(), mesh, resolution);
  if(!found.weld.is_none()) {
    bounds.to_first += found.weld.tolerance;
    bounds.to_second += found.weld.tolerance;
  }
  return bounds;
}

} // namespace Tool
