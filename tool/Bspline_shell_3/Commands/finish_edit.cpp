#include "finish_edit.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>

#include <algorithm>
#include <utility>

namespace Tool {

bool round_coordinates(Mesh& mesh, const Shell& shell, const std::shared_ptr<const BS::Shell_closing_3>& closing)
{
  Mesh rounded = mesh;
  for(auto v : rounded.vertices()) {
    const auto& p = mesh.point(v);
    rounded.point(v) = Mesh::Point(float(p.x()), float(p.y()), float(p.z()));
  }
  BS::Shell_certificate_3<Shell::Field, Shell::Threshold> certificate(shell);
  if(!certificate.verify(rounded, BS::parameters::closing(closing))) return false;
  mesh = std::move(rounded);
  return true;
}

Distance_bounds distances_of_edit(const BS::Shell_of_soup_3& found, const Mesh& mesh, double limit)
{
  constexpr double relative_resolution = 0.01;
  const double resolution = relative_resolution * (std::min)(found.shell().thickness(), limit);
  const double welded = found.weld.is_none() ? 0 : found.weld.tolerance;
  Distance_bounds bounds = distance_bounds(found.proxy ? found.proxy->soup().mesh() : found.mesh(), mesh, resolution,
                                           (std::max)(limit - welded, resolution));
  bounds.to_first += welded;
  bounds.to_second += welded;
  return bounds;
}

} // namespace Tool
