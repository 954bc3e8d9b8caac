// Measures images of curves on simplified meshes, and cuts along them. Prints one JSON object per mesh and tolerance.
//
//   curves_benchmark [--facets N] [FILE ...]
//
// The curves are four horizontal sections of a mesh, in a shell of 1 % thickness. They are mapped to the mesh
// simplified to N facets (default 1000), and back. Distances are in units of the tolerance: `traced` is the largest
// distance of points of the curves, 11 on each segment, from the image; `back` is that of their vertices from the
// returned curve.
#include "../meshes_in_shell.h"
#include "../../../examples/Bspline_shell_3/horizontal_section.h"

#include <CGAL/Bspline_shell_3/Editing/cut_along_polylines.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/map_polyline.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Real_timer.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace PMP = CGAL::Polygon_mesh_processing;
typedef BS::Shell_map_3<Shell, Mesh> Map;
typedef BS::Polyline_image<Mesh, Shell::Point_3> Image;

// Returns the distance of a point from the part of an image between two parameters.
double distance(const Image& image, const Kernel::Point_3& p, double first, double last)
{
  double least = std::numeric_limits<double>::infinity();
  for(const auto& part : image.parts)
    for(std::size_t n = 1; n < part.size(); ++n)
      if(part[n].parameter >= first && part[n - 1].parameter <= last)
        least = (std::min)(least, CGAL::squared_distance(Kernel::Segment_3(part[n - 1].point, part[n].point), p));
  return std::sqrt(least);
}

double distance_of_traced_points(const Map& map, const Polyline& curve, const Image& image)
{
  constexpr int parts = 12;
  double largest = 0;
  for(std::size_t n = 0; n + 1 < curve.size(); ++n) {
    const auto a = curve[n], b = PMP::locate_in_adjacent_face(curve[n + 1], a.first, map.source());
    for(int i = 1; i < parts; ++i) {
      auto location = a;
      for(std::size_t k = 0; k < 3; ++k) location.second[k] += (b.second[k] - a.second[k]) * i / parts;
      if(const auto traced = map(location))
        largest = (std::max)(largest, distance(image, traced.point, double(n), double(n + 1)));
    }
  }
  return largest;
}

void measure(const std::string& file, std::size_t facets)
{
  Mesh mesh;
  if(!read_triangles(file, mesh)) return;
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  Mesh coarse = mesh;
  if(!shell.is_certified()
     || !BS::simplify_in_shell(coarse, shell, BS::parameters::stop(BS::Facet_count_stop_predicate(facets))))
    return;
  coarse.collect_garbage();
  std::vector<Polyline> curves;
  const CGAL::Bbox_3 box = PMP::bbox(mesh);
  for(double level : { 0.2345, 0.4321, 0.6123, 0.81234 })
    for(Polyline& curve : horizontal_section(mesh, box.zmin() + level * (box.zmax() - box.zmin())))
      curves.push_back(std::move(curve));

  const Map map(shell, mesh, coarse);
  const auto inverse = map.inverse();
  for(double relative : { 1e-4, 1e-5, 1e-6 }) {
    const double tolerance = relative * shell.report().unit;
    std::size_t vertices = 0, of_images = 0, projections = 0, gaps = 0;
    double traced = 0, back = 0;
    std::vector<Polyline> images;
    CGAL::Real_timer timer;
    for(const Polyline& curve : curves) {
      timer.start();
      const Image image = BS::map_polyline<CGAL::Sequential_tag>(map, curve, BS::parameters::tolerance(tolerance));
      timer.stop();
      vertices += curve.size();
      projections += image.traced_points;
      gaps += image.gaps.size();
      for(const auto& part : image.parts) {
        of_images += part.size();
        images.emplace_back();
        for(const auto& v : part) images.back().push_back(v.location);
      }
      if(!image) continue;
      traced = (std::max)(traced, distance_of_traced_points(map, curve, image));
      const Image returned = BS::map_polyline(inverse, images.back(), BS::parameters::tolerance(tolerance));
      gaps += returned.gaps.size();
      constexpr double all = std::numeric_limits<double>::infinity();
      for(const auto& location : curve)
        back = (std::max)(back, distance(returned, PMP::construct_point(location, mesh), 0, all));
    }
    Mesh cut = coarse;
    const BS::Cut_report report = BS::cut_along_polylines(cut, images, shell);
    std::cout << "{\"mesh\": " << quoted(mesh_name(file)) << ", \"facets\": " << coarse.number_of_faces()
              << ", \"tolerance\": " << relative << ", \"vertices\": " << vertices << ", \"of_images\": " << of_images
              << ", \"projections_per_vertex\": " << double(projections) / double(of_images)
              << ", \"microseconds_per_vertex\": " << 1e6 * timer.time() / double(of_images) << ", \"gaps\": " << gaps
              << ", \"traced\": " << traced / tolerance << ", \"back\": " << back / tolerance
              << ", \"is_cut\": " << (report ? "true" : "false") << ", \"facets_after_cut\": " << report.facets << "}"
              << std::endl;
  }
}

int main(int argc, char** argv)
{
  print_JSON_numbers();
  std::size_t facets = 1000;
  std::vector<std::string> files;
  for(int i = 1; i < argc; ++i)
    if(std::string(argv[i]) == "--facets" && i + 1 < argc) facets = std::size_t(std::atol(argv[++i]));
    else files.push_back(argv[i]);
  if(files.empty())
    for(const char* name : { "elephant", "bunny00", "armadillo", "anchor" })
      files.push_back(std::string(MESHES) + "/" + name + ".off");
  for(const std::string& file : files) measure(file, facets);
  return EXIT_SUCCESS;
}
