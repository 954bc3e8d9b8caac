// Values of attributes of polygons on the facets of a mesh.
#ifndef TOOL_CARRY_POLYGON_VALUES_H
#define TOOL_CARRY_POLYGON_VALUES_H

#include "Mesh_origins.h"
#include "Numbered_values.h"

#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>

#include <CGAL/Kernel/global_functions.h>

#include <boost/property_map/function_property_map.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace Tool {

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
    Numbered_values number;
    std::vector<std::size_t> numbers(map.source().num_faces());
    for(auto f : map.source().faces()) numbers[f] = number(value_of(f));
    std::vector<std::size_t> transferred(map.target().num_faces(), 0);
    const auto report = BS::transfer_face_labels(
      map, boost::make_iterator_property_map(numbers.begin(), get(boost::face_index, map.source())),
      boost::make_iterator_property_map(transferred.begin(), get(boost::face_index, map.target())));
    for(std::size_t n = 0; n < values.size(); ++n) values[n] = number[transferred[n]];
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

} // namespace Tool

#endif // TOOL_CARRY_POLYGON_VALUES_H
