#include "carry_attributes.h"
#include "Corner_groups.h"
#include "Corner_places.h"
#include "Result_builder.h"

#include "../Files/numbers.h"

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace Tool {

namespace {

typedef BS::Shell_map_3<Shell, Mesh> Mesh_map;

// Replaces corners of the source mesh by corners of the model.
Mix mix_of(const Place& place, const Mesh_origins& origins)
{
  Mix mix;
  for(std::size_t i = 0; i < 3; ++i) {
    if(place.weight[i] == 0) continue;
    for(const auto& term : origins.at(place.corner[i])) {
      const auto same = std::find_if(mix.begin(), mix.end(), [&](const auto& t) { return t.first == term.first; });
      if(same == mix.end()) mix.emplace_back(term.first, place.weight[i] * term.second);
      else same->second += place.weight[i] * term.second;
    }
  }
  return mix;
}

// Returns values of an attribute of polygons on the facets of the target. Labels and colors are those of the largest
// part of a facet's area; other values are averaged.
template <typename Map>
std::vector<double> polygon_values(const Map& map, const Mesh_origins& origins, const Attribute& a)
{
  typedef std::vector<double> Value;
  const auto value_of = [&](Mesh::Face_index f) {
    const double* const v = a[origins.polygon_of(f)];
    return Value(v, v + a.dimension());
  };
  std::vector<Value> values(map.target().num_faces());
  if(a.kind == Kind::LABEL || a.kind == Kind::COLOR) {
    // Values may be NaN, which is not equal to itself: their numbers are transferred.
    std::map<Value, std::size_t> number;
    std::vector<Value> value;
    std::vector<std::size_t> numbers(map.source().num_faces());
    for(auto f : map.source().faces()) {
      Value key = value_of(f);
      for(double& x : key)
        if(std::isnan(x)) x = -1;
      const auto found = number.emplace(key, value.size());
      if(found.second) value.push_back(value_of(f));
      numbers[f] = found.first->second;
    }
    std::vector<std::size_t> transferred(map.target().num_faces(), 0);
    const auto report = BS::transfer_face_labels(
      map, boost::make_iterator_property_map(numbers.begin(), get(boost::face_index, map.source())),
      boost::make_iterator_property_map(transferred.begin(), get(boost::face_index, map.target())));
    for(std::size_t n = 0; n < values.size(); ++n) values[n] = value[transferred[n]];
    for(const auto& failure : report.failures) {
      const auto& target = map.target();
      const auto h = target.halfedge(Mesh::Face_index(Mesh::size_type(failure.first)));
      const auto p = CGAL::centroid(target.point(target.source(h)), target.point(target.target(h)),
                                    target.point(target.target(target.next(h))));
      const auto& source = map.to_source().target();
      values[failure.first] = value_of(source.face_of(source.closest({ p.x(), p.y(), p.z() }).first));
    }
  } else {
    const std::vector<std::array<double, 3> > samples = {
      { 1 / 3., 1 / 3., 1 / 3. }, { 2 / 3., 1 / 6., 1 / 6. }, { 1 / 6., 2 / 3., 1 / 6. }, { 1 / 6., 1 / 6., 2 / 3. }
    };
    const auto inverse = map.inverse();
    for(auto f : map.target().faces()) {
      Value sum(a.dimension(), 0);
      for(const auto& sample : samples) {
        const auto image = inverse({ f, sample });
        const auto& source = map.to_source().target();
        const auto p = inverse.point({ f, sample });
        const Value value = value_of(image ? image.location.first : source.face_of(source.closest(p).first));
        for(std::size_t i = 0; i < sum.size(); ++i) sum[i] += value[i] / double(samples.size());
      }
      values[f] = sum;
    }
  }
  std::vector<double> result;
  for(const Value& value : values) result.insert(result.end(), value.begin(), value.end());
  return result;
}

template <typename Map>
Model carry(const Map& map, const Model& model, const BS::Excised_soup_3* excised, const BS::Rejoined_soup_3& rejoined,
            Normals normals, Carry_report& report, const std::function<void(double)>& progress)
{
  const Mesh &source = map.source(), &target = map.target();
  const Mesh_origins origins(model, source);
  const std::vector<const Attribute*> with_seams = attributes_with_seams(model, source, origins);
  const Corner_places<Map> places(map);
  progress(0.1);
  std::vector<Result_triangle> triangles(target.num_faces());
  const std::vector<Place> smooth = places.of_vertices(report.points_without_image);
  progress(0.4);
  std::vector<Place> split;
  if(!with_seams.empty())
    split = places.of_corners(corner_groups(with_seams, Mixer(model), source, origins), report.facets_across_seams);
  progress(0.7);
  for(auto f : target.faces()) {
    std::size_t i = 0;
    for(auto h : target.halfedges_around_face(target.halfedge(f))) {
      Result_triangle::Corner& corner = triangles[f].corners[i++];
      corner.point = target.target(h);
      corner.smooth = mix_of(smooth[target.target(h)], origins);
      if(!split.empty()) corner.split = mix_of(split[h], origins);
    }
  }

  Model::Points points;
  for(auto v : target.vertices()) points.push_back(target.point(v));
  const std::vector<std::size_t> first = model.first_corners();
  if(excised != nullptr) {
    points = rejoined.soup.points;
    for(std::size_t n = rejoined.facets; n < rejoined.soup.polygons.size(); ++n) {
      const std::size_t t = excised->excised_triangles()[n - rejoined.facets], polygon = excised->soup().polygon_of[t];
      triangles.emplace_back();
      for(std::size_t i = 0; i < 3; ++i) {
        const std::size_t v = rejoined.soup.polygons[n][i];
        const auto& corners = model.soup.polygons[polygon];
        const auto is_here = [&](std::size_t u) { return model.soup.points[u] == points[v]; };
        const std::size_t k = std::size_t(std::find_if(corners.begin(), corners.end(), is_here) - corners.begin());
        const Mix own = { { first[polygon] + (k < corners.size() ? k : 0), 1. } };
        triangles.back().corners[i] = { v, own, own };
      }
    }
  }
  Model result = build_result(model, points, triangles, with_seams, normals == Normals::RECOMPUTED);
  for(Attribute& a : result.attributes) {
    if(a.element != Element::POLYGON) continue;
    const Attribute& before = model.attributes[std::size_t(&a - result.attributes.data())];
    a.values = polygon_values(map, origins, before);
    for(std::size_t n = target.num_faces(); n < triangles.size(); ++n) {
      const double* const v = before[excised->soup().polygon_of[excised->excised_triangles()[n - target.num_faces()]]];
      a.values.insert(a.values.end(), v, v + a.dimension());
    }
  }
  progress(1);
  return result;
}

} // namespace

Model carry_attributes(const Model& model, const BS::Shell_of_soup_3& found, const Mesh& mesh,
                       const std::shared_ptr<const BS::Shell_closing_3>& closing, const BS::Rejoined_soup_3& rejoined,
                       Normals normals, Carry_report& report, const std::function<void(double)>& progress)
{
  if(found.proxy) {
    const auto map = found.proxy->map(mesh);
    return carry(map, model, nullptr, rejoined, normals, report, progress);
  }
  const Mesh_map map(found.shell(), found.mesh(), mesh, BS::parameters::closing(found.shell().closing()),
                     BS::parameters::closing(closing));
  return carry(map, model, found.excised.get(), rejoined, normals, report, progress);
}

} // namespace Tool
