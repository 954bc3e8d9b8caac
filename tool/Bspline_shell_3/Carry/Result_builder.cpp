#include "Result_builder.h"
#include "corner_normals.h"
#include "finished_value.h"

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace Tool {

namespace {

// Returns the largest angle between facets that are shaded smoothly: 0 if the normals of the file are those of facets,
// and 180 degrees if each point has one normal.
double crease_angle(const Model& source, const Attribute& normals, const Mixer& mixer)
{
  std::vector<std::set<std::vector<double> > > at(source.soup.points.size());
  std::size_t corner = 0, several = 0, used = 0;
  for(const auto& polygon : source.soup.polygons)
    for(std::size_t v : polygon) {
      const double* const n = normals[mixer.element(normals, corner++)];
      at[v].emplace(n, n + normals.dimension());
    }
  for(const auto& values : at) {
    used += !values.empty();
    several += values.size() > 1;
  }
  constexpr double usual_crease = CGAL_PI / 6; // default of modelling programs
  return several == 0 ? CGAL_PI : 2 * several > used ? 0 : usual_crease;
}

// Returns -1 if the normals of the file point to the other side of the polygons.
double side(const std::vector<std::vector<double> >& carried, const std::vector<Vector>& computed)
{
  double sum = 0;
  for(std::size_t n = 0; n < carried.size(); ++n) {
    const double d = Vector(carried[n][0], carried[n][1], carried[n][2]) * computed[n];
    if(!std::isnan(d)) sum += d;
  }
  return sum < 0 ? -1 : 1;
}

} // namespace

Model build_result(const Model& source, const Model::Points& points, const std::vector<Result_triangle>& triangles,
                   const std::vector<const Attribute*>& with_seams, bool recomputes_normals)
{
  Model result = source;
  result.soup.points = points;
  result.soup.polygons.clear();
  for(const Result_triangle& t : triangles)
    result.soup.polygons.push_back({ t.corners[0].point, t.corners[1].point, t.corners[2].point });

  // values of all corners, by attribute
  const Mixer mixer(source);
  std::vector<std::vector<std::vector<double> > > values(source.attributes.size());
  for(std::size_t k = 0; k < source.attributes.size(); ++k) {
    const Attribute& a = source.attributes[k];
    if(a.element == Element::POLYGON) continue;
    const bool is_split = std::find(with_seams.begin(), with_seams.end(), &a) != with_seams.end();
    for(const Result_triangle& t : triangles)
      for(const Result_triangle::Corner& corner : t.corners) {
        values[k].push_back(mixer(a, is_split ? corner.split : corner.smooth));
        for(double& x : values[k].back()) x = finished_value(a, x);
      }
    if(a.kind != Kind::NORMAL || a.dimension() != 3) continue;
    const std::vector<Vector> computed = corner_normals(result.soup, crease_angle(source, a, mixer));
    const double sign = side(values[k], computed);
    for(std::size_t n = 0; n < computed.size(); ++n) {
      std::vector<double>& x = values[k][n];
      const Vector normal = recomputes_normals ? sign * computed[n] : unit(Vector(x[0], x[1], x[2]));
      x = { normal.x(), normal.y(), normal.z() };
    }
  }

  // Split points.
  std::map<std::pair<std::size_t, std::vector<double> >, std::size_t> point_with;
  std::vector<std::size_t> first_corner; // by point
  result.soup.points.clear();
  std::size_t corner = 0;
  for(auto& polygon : result.soup.polygons)
    for(std::size_t& v : polygon) {
      std::vector<double> key;
      for(const Attribute* a : with_seams) {
        const auto& value = values[std::size_t(a - source.attributes.data())][corner];
        if(a->element == Element::POINT) key.insert(key.end(), value.begin(), value.end());
      }
      const auto found = point_with.emplace(std::make_pair(v, std::move(key)), result.soup.points.size());
      if(found.second) {
        result.soup.points.push_back(points[v]);
        first_corner.push_back(corner);
      }
      v = found.first->second;
      ++corner;
    }
  for(std::size_t k = 0; k < values.size(); ++k) {
    Attribute& a = result.attributes[k];
    a.values.clear();
    if(a.element == Element::POINT)
      for(std::size_t c : first_corner) a.values.insert(a.values.end(), values[k][c].begin(), values[k][c].end());
    else
      for(const auto& value : values[k]) a.values.insert(a.values.end(), value.begin(), value.end());
  }
  return result;
}

} // namespace Tool
