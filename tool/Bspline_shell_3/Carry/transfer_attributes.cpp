#include "transfer_attributes.h"
#include "Numbered_values.h"
#include "corner_mixes.h"
#include "finished_value.h"
#include "polygon_values.h"

#include "../Files/texture_comments.h"

#include <CGAL/Polygon_mesh_processing/measure.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace Tool {

namespace {

void append(std::vector<double>& values, const Attribute& a, const std::vector<double>& value)
{
  for(double x : value) values.push_back(finished_value(a, x));
}

// Returns the attribute of polygons from the values on facets. Labels and colors are those of the largest part of a
// polygon's area; other values are averaged. Polygons without facets have the values at their first points.
std::vector<double> values_of_polygons(const Attribute& a, const std::vector<double>& of_facets,
                                       const Triangulated_model& mesh, std::size_t polygons,
                                       const std::function<std::vector<double>(std::size_t)>& otherwise)
{
  typedef std::vector<double> Value;
  Numbered_values number;
  std::vector<std::map<std::size_t, double> > areas(polygons); // by number of the value
  for(auto f : mesh.mesh().faces()) {
    const auto first = of_facets.begin() + std::ptrdiff_t(std::size_t(f) * a.dimension());
    areas[mesh.polygon_of(f)][number(Value(first, first + std::ptrdiff_t(a.dimension())))] +=
      CGAL::Polygon_mesh_processing::face_area(f, mesh.mesh());
  }
  const bool is_label = a.kind == Kind::LABEL || a.kind == Kind::COLOR;
  std::vector<double> values;
  for(std::size_t n = 0; n < polygons; ++n) {
    if(areas[n].size() < 2 || is_label) {
      const auto largest = std::max_element(areas[n].begin(), areas[n].end(),
                                            [](const auto& p, const auto& q) { return p.second < q.second; });
      append(values, a, largest == areas[n].end() ? otherwise(n) : number[largest->first]);
      continue;
    }
    double area = 0;
    for(const auto& part : areas[n]) area += part.second;
    Value mean(a.dimension(), 0);
    for(const auto& part : areas[n])
      for(std::size_t i = 0; i < mean.size(); ++i) mean[i] += part.second / area * number[part.first][i];
    append(values, a, mean);
  }
  return values;
}

bool is_left_out(const Attribute& a, const Transfer_choice& choice)
{
  const bool is_of_textures = is_texture(a) || a.name == material_name || a.name == texture_number_name;
  return a.name == mapped_name || (a.kind == Kind::NORMAL && !choice.includes_normals)
         || (is_of_textures && !choice.includes_textures);
}

} // namespace

Model transfer_attributes(const Model& from, const Model& to, const Triangulated_model& mesh, const Model_map& map,
                          const Mapped_parts& parts, const Transfer_choice& choice, Attribute_transfer& report,
                          const std::function<void(double)>& progress)
{
  Model result = to;
  const Mixer mixer(from);
  std::set<std::string> names = { mapped_name };
  for(const Attribute& a : from.attributes)
    if(!is_left_out(a, choice)) names.insert(a.name);
  std::set<std::string> replaced;
  const auto is_replaced = [&](const Attribute& a) { return names.count(a.name) != 0; };
  for(const Attribute& a : to.attributes)
    if(is_replaced(a) && a.name != mapped_name) replaced.insert(a.name);
  report.replaced.assign(replaced.begin(), replaced.end());
  auto& attributes = result.attributes;
  attributes.erase(std::remove_if(attributes.begin(), attributes.end(), is_replaced), attributes.end());

  map.visit([&](const auto& m) {
    const Corner_mixes mixes = corner_mixes(m, from, map.origins(), progress);
    report.facets_across_seams = mixes.facets_across_seams;
    const Corner_places places(m);
    // Points that are not in the mesh get values of the nearest points.
    std::vector<Mix> of_points;
    for(std::size_t n = 0; n < to.soup.points.size(); ++n) {
      const auto v = mesh.vertex_at(n);
      if(v != Mesh::null_vertex()) of_points.push_back(mixes.smooth[v]);
      else {
        const Place place = places.nearest(to.soup.points[n]);
        of_points.push_back(mix_of(place.corner, place.weight, map.origins()));
      }
    }
    for(const Attribute& a : from.attributes) {
      if(is_left_out(a, choice)) continue;
      report.transferred.push_back(a.name);
      Attribute copy = a;
      copy.values.clear();
      const bool has_seams = std::find(mixes.with_seams.begin(), mixes.with_seams.end(), &a) != mixes.with_seams.end();
      if(a.element == Element::POLYGON) {
        const auto nearest = [&](std::size_t polygon) {
          const auto& corners = to.soup.polygons[polygon];
          if(corners.empty()) return std::vector<double>(a.dimension(), std::numeric_limits<double>::quiet_NaN());
          const Place place = places.nearest(to.soup.points[corners[0]]);
          const double* const v = a[map.origins().polygon_of(m.source().face(place.corner[0]))];
          return std::vector<double>(v, v + a.dimension());
        };
        copy.values = values_of_polygons(a, polygon_values(m, map.origins(), a), mesh, to.soup.polygons.size(),
                                         nearest);
      } else if(a.element == Element::CORNER || (has_seams && a.name == texture_name)) {
        copy.element = Element::CORNER;
        std::size_t corner = 0;
        for(const auto& polygon : to.soup.polygons)
          for(std::size_t v : polygon) {
            const auto h = mesh.halfedge_to(corner++);
            append(copy.values, a, mixer(a, has_seams && h != Mesh::null_halfedge() ? mixes.split[h] : of_points[v]));
          }
      } else
        for(const Mix& mix : of_points) append(copy.values, a, mixer(a, mix));
      attributes.push_back(std::move(copy));
    }
  });
  const std::vector<std::string> textures = textures_in_comments(from, from.folder);
  const bool has_materials = from.find(material_name, Element::POLYGON) != nullptr || !textures.empty();
  if(choice.includes_textures && has_materials) {
    result.materials = from.materials;
    result.assets = from.assets;
    set_textures_in_comments(result, textures.empty() ? textures_in_comments(result, from.folder) : textures);
    result.folder = from.folder;
  }
  progress(1);
  if(parts.is_one_to_one()) return result;
  Attribute mapped{ mapped_name, Element::POINT, Kind::LABEL, Number_type::UINT8, { mapped_name }, {}, {} };
  for(std::size_t n = 0; n < to.soup.points.size(); ++n) {
    const auto v = mesh.vertex_at(n);
    mapped.values.push_back(double(v == Mesh::null_vertex() ? Mapped::NEAREST : parts.of_vertices[v]));
  }
  attributes.push_back(std::move(mapped));
  return result;
}

} // namespace Tool
