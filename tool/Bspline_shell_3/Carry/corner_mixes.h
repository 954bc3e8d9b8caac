// The corners of a model from which the corners of a mesh get values.
#ifndef TOOL_CARRY_CORNER_MIXES_H
#define TOOL_CARRY_CORNER_MIXES_H

#include "Corner_groups.h"
#include "Corner_places.h"
#include "Mesh_origins.h"
#include "Mix.h"

#include "../Files/Model.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace Tool {

struct Corner_mixes
{
  std::vector<const Attribute*> with_seams; // attributes for which the corners have their own values
  std::vector<Mix> smooth;                  // for other attributes, by vertex of the target
  std::vector<Mix> split;                   // for attributes with seams, by halfedge; empty if there are none
  std::size_t points_without_image = 0;     // they have the nearest corners
  std::size_t facets_across_seams = 0;
};

// Replaces corners of the source mesh, given as halfedges to them, by corners of the model.
inline Mix mix_of(const std::array<Mesh::Halfedge_index, 3>& corners, const std::array<double, 3>& weights,
                  const Mesh_origins& origins)
{
  Mix mix;
  for(std::size_t i = 0; i < 3; ++i) {
    if(weights[i] == 0) continue;
    for(const auto& term : origins.at(corners[i])) {
      const auto same = std::find_if(mix.begin(), mix.end(), [&](const auto& t) { return t.first == term.first; });
      if(same == mix.end()) mix.emplace_back(term.first, weights[i] * term.second);
      else same->second += weights[i] * term.second;
    }
  }
  return mix;
}

// Maps the vertices and corners of the target to the source.
// \param map a map from a mesh or a soup of the model to the target
// \param progress called with the fraction of the work that is done
template <typename Map>
Corner_mixes corner_mixes(const Map& map, const Model& model, const Mesh_origins& origins,
                          const std::function<void(double)>& progress)
{
  const Mesh &source = map.source(), &target = map.target();
  const Corner_places<Map> places(map);
  const auto mix = [&](const Place& place) { return mix_of(place.corner, place.weight, origins); };
  Corner_mixes result;
  result.with_seams = attributes_with_seams(model, source, origins);
  progress(0.1);
  for(const Place& place : places.of_vertices(result.points_without_image)) result.smooth.push_back(mix(place));
  progress(0.5);
  if(result.with_seams.empty()) return result;
  const std::vector<Place> split = places.of_corners(corner_groups(result.with_seams, Mixer(model), source, origins),
                                                     result.facets_across_seams);
  result.split.resize(split.size());
  for(auto f : target.faces())
    for(auto h : target.halfedges_around_face(target.halfedge(f))) result.split[h] = mix(split[h]);
  return result;
}

} // namespace Tool

#endif // TOOL_CARRY_CORNER_MIXES_H
