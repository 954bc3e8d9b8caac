#include "page_of.h"
#include "Drawn_mesh.h"
#include "Drawn_shell.h"
#include "Surface_colors.h"
#include "page_template.h"

#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_projection_3.h>

#include <CGAL/Bbox_3.h>

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace Tool {

namespace {

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

Channel distances(const Drawn_mesh& mesh, const Drawn_mesh& other)
{
  const BS::Projection_target_3<Mesh> target(other.mesh(), other.mesh().points());
  Channel channel{ "distance (unit of the file)", false, {}, {} };
  for(std::size_t n = 0; n < mesh.vertices().size(); ++n) {
    const auto& p = mesh.point(n);
    const auto [facet, weights] = target.closest({ p.x(), p.y(), p.z() });
    const auto q = target.point(facet, weights);
    channel.values.push_back(float(std::hypot(p.x() - q[0], p.y() - q[1], p.z() - q[2])));
  }
  return channel;
}

// Returns the difference of the thresholds.
Channel thicknesses(const Drawn_mesh& mesh, const Shell& shell)
{
  Channel channel{ "thickness (unit of the file)", false, {}, {} };
  for(std::size_t n = 0; n < mesh.vertices().size(); ++n) {
    const auto& p = mesh.point(n);
    const auto cell = shell.field().locate(p);
    channel.values.push_back(cell == Shell::Field::npos ? nothing
                                                        : float(shell.outer_threshold().value(p, cell)
                                                                - shell.inner_threshold().value(p, cell)));
  }
  return channel;
}

// Returns the points of the other mesh to which the shell maps the vertices.
std::vector<float> images(const Drawn_mesh& mesh, const Drawn_mesh& other, const Shell& shell,
                          const std::array<double, 3>& center)
{
  std::vector<Mesh::Point> points;
  for(std::size_t n = 0; n < mesh.vertices().size(); ++n) points.push_back(mesh.point(n));
  std::vector<float> images;
  for(const auto& image : BS::Shell_projection_3<Shell, Mesh>(shell, other.mesh()).project(points))
    for(int i = 0; i < 3; ++i)
      images.push_back(image && !image.is_continued ? float(image.point[i] - center[std::size_t(i)]) : nothing);
  return images;
}

std::array<double, 3> center_of(const Model& model)
{
  CGAL::Bbox_3 box;
  for(const auto& p : model.soup.points)
    if(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())) box += p.bbox();
  return { (box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2 };
}

void write_places(Page& page, const View& view, const std::array<double, 3>& center)
{
  std::vector<float> points;
  std::string messages;
  for(const View::Place& place : view.places) {
    for(std::size_t i = 0; i < 3; ++i) points.push_back(float(place.point[i] - center[i]));
    messages += place.message + "\n";
  }
  page.add("places", points, view.places_title);
  page.add("places.messages", "text", messages);
}

} // namespace

std::string page_of(const View& view, std::size_t most_bytes)
{
  const std::array<double, 3> center = center_of(*view.sides[0].model);
  Image_files image_files;
  std::vector<std::unique_ptr<Drawn_mesh> > meshes;
  for(const View::Side& side : view.sides)
    meshes.push_back(std::make_unique<Drawn_mesh>(*side.model, Surface_colors(*side.model, image_files)));
  Page page;
  page.add("center", std::vector<double>(center.begin(), center.end()));
  for(std::size_t n = 0; n < meshes.size(); ++n) {
    Drawn_mesh& mesh = *meshes[n];
    if(view.shell != nullptr) mesh.channels.insert(mesh.channels.begin(), thicknesses(mesh, *view.shell));
    if(meshes.size() == 2) mesh.channels.insert(mesh.channels.begin(), distances(mesh, *meshes[1 - n]));
    const std::string name = "mesh" + std::to_string(n);
    page.add(name, "text", "", view.sides[n].title);
    mesh.write(page, name, center);
  }
  for(std::size_t n = 0; n < image_files.size(); ++n)
    page.add("image" + std::to_string(n), image_files[n].front() == '\x89' ? "image/png" : "image/jpeg",
             image_files[n]);
  if(!view.places.empty()) write_places(page, view, center);

  Page::Lines report = view.report;
  const std::size_t of_scripts = page_template().size();
  const auto fits = [&](const Page& part) { return of_scripts + page.size() + part.size() <= most_bytes; };
  if(view.shell != nullptr) {
    Page field;
    write_field(field, *view.shell, center);
    if(fits(field)) page.add(field);
    else if(meshes.size() == 2) {
      for(std::size_t n = 0; n < 2; ++n)
        page.add("mesh" + std::to_string(n) + ".images", images(*meshes[n], *meshes[1 - n], *view.shell, center));
      report.emplace_back("Curves", "are omitted, because the page would be too large. Images of points are "
                                    "interpolated between the images of vertices.");
    }
    bool has_surfaces = false;
    for(int subdivision : { 2, 1 }) {
      if(has_surfaces) break;
      Page surfaces;
      write_surfaces(surfaces, *view.shell, center, subdivision);
      has_surfaces = fits(surfaces);
      if(has_surfaces) page.add(surfaces);
    }
    if(!has_surfaces) report.emplace_back("Surfaces", "of the shell are omitted, because the page would be too large.");
  }
  return page.HTML(view.title, report);
}

} // namespace Tool
