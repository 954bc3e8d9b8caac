#include "cut_lines.h"

#include <CGAL/Bspline_shell_3/Editing/cut_along_polylines.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/map_polyline.h>

#include <CGAL/Polygon_mesh_processing/locate.h>

namespace Tool {

namespace {

// Distance of a cut from the line, in box sizes. Facets beside a line that are narrower would lie across it.
constexpr double relative_tolerance = 1e-5;

} // namespace

Cut_lines cut_lines(const BS::Shell_of_soup_3& found, const std::vector<char>& is_line, Mesh& mesh,
                    const std::shared_ptr<const BS::Shell_closing_3>& closing)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  typedef PMP::Face_location<Mesh, double> Location;
  const Shell& shell = found.shell();
  const Mesh& original = found.mesh();
  Cut_lines result;
  std::vector<std::vector<Location> > images;
  {
    const BS::Shell_map_3<Shell, Mesh> map(shell, original, mesh, BS::parameters::closing(shell.closing()),
                                           BS::parameters::closing(closing));
    for(auto e : original.edges()) {
      if(!is_line[e]) continue;
      // Edges with a common vertex have images with a common end.
      const std::vector<Location> ends = { PMP::locate_vertex<double>(original.vertex(e, 0), original),
                                           PMP::locate_vertex<double>(original.vertex(e, 1), original) };
      const auto image = BS::map_polyline(map, ends,
                                          BS::parameters::tolerance(relative_tolerance * shell.report().unit));
      result.gaps += image.gaps.size();
      for(const auto& part : image.parts) {
        images.emplace_back();
        for(const auto& v : part) images.back().push_back(v.location);
      }
    }
  } // the map would be invalid for the cut mesh
  result.cut = BS::cut_along_polylines(mesh, images, shell, BS::parameters::closing(closing));
  return result;
}

} // namespace Tool
