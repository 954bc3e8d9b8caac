#include "transfer_attributes.h"
#include "corner_mixes.h"
#include "finished_value.h"
#include "polygon_values.h"
#include "texture_comments.h"

#include <CGAL/Polygon_mesh_processing/measure.h>

#include <algorithm>
#include <cstddef>
#include <map>
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
  std::vector<std::map<Value, double> > areas(polygons);
  for(auto f : mesh.mesh().faces()) {
    const auto first = of_facets.begin() + std::ptrdiff_t(std::size_t(f) * a.dimension());
    areas[mesh.polygon_of(f)][Value(first, first + std::ptrdiff_t(a.dimension()))] +=
      CGAL::Polygon_mesh_processing::face_area(f, mesh.mesh());
  }
  const bool is_label = a.kind == Kind::LABEL || a.kind == Kind::COLOR;
  std::vector<double> values;
  for(std::size_t n = 0; n < polygons; ++n) {
    if(areas[n].size() < 2 || is_label) {
      const auto largest = std::max_element(areas[n].begin(), areas[n].end(),
                                            [](const auto& p, const auto& q) { return p.second < q.second; });
      append(values, a, largest == areas[n].end() ? otherwise(n) : largest->first);
      continue;
    }
    double area = 0;
    for(const auto& part : areas[n]) area += part.second;
    Value mean(a.dimension(), 0);
    for(const auto& part : areas[n])
      for(std::size_t i = 0; i < mean.size(); ++i) mean[i] += part.second / area * part.first[i];
    append(values, a, mean);
  }
  return values;
}

} // namespace

Model transfer_attributes(const Model& from, const Model& to, const Triangulated_model& mesh, const Model_map& map,
                          const Mapped_parts& parts, const Transfer_choice& choice, Attribute_transfer& report,
                          const std::function<void(double)>& progress)
{
  Model result = to;
  const Mixer mixer(from);
  const auto add = [&](Attribute a) {
    const auto has_name = [&](const Attribute& other) { return other.name == a.name; };
    const auto removed = std::remove_if(result.attributes.begin(), result.attributes.end(), has_name);
    if(removed != result.attributes.end()) report.replaced.push_back(a.name);
    result.attributes.erase(removed, result.attributes.end());
    result.attributes.push_back(std::move(a));
  };

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
    const auto is_left_out = [&](const Attribute& a) {
      const bool is_of_textures = a.name == texture_name || a.name == material_name;
      return (a.kind == Kind::NORMAL && !choice.includes_normals) || (is_of_textures && !choice.includes_textures);
    };
    for(const Attribute& a : from.attributes) {
      if(is_left_out(a)) continue;
      report.transferred.push_back(a.name);
      Attribute copy = a;
      copy.values.clear();
      const bool has_seams = std::find(mixes.with_seams.begin(), mixes.with_seams.end(), &a) != mixes.with_seams.end();
      if(a.element == Element::POLYGON) {
        const auto nearest = [&](std::size_t polygon) {
          const Place place = places.nearest(to.soup.points[to.soup.polygons[polygon].at(0)]);
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
      add(std::move(copy));
    }
  });
  if(choice.includes_textures && from.find(material_name, Element::POLYGON) != nullptr) {
    result.materials = from.materials;
    result.assets = from.assets;
    result.folder = from.folder;
  }
  const std::vector<std::string> textures = texture_comments(from);
  if(choice.includes_textures && !textures.empty()) set_texture_comments(result, textures);
  progress(1);
  if(parts.is_one_to_one()) return result;
  Attribute mapped{ mapped_name, Element::POINT, Kind::LABEL, Number_type::UINT8, { mapped_name }, {}, {} };
  for(std::size_t n = 0; n < to.soup.points.size(); ++n) {
    const auto v = mesh.vertex_at(n);
    mapped.values.push_back(double(v == Mesh::null_vertex() ? Mapped::NEAREST : parts.of_vertices[v]));
  }
  add(std::move(mapped));
  return result;
}

} // namespace Tool
