// Approximate minimizers of a function on a segment or a triangle, as candidates for exact checks.
#ifndef WORST_POINTS_H
#define WORST_POINTS_H

#include "Exact_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

// Barycentric coordinates, in units of 2^-barycentric_bits.
template <std::size_t size>
using Barycentric = std::array<std::int64_t, size>;
constexpr int barycentric_bits = 26;

template <typename Point, std::size_t size>
std::array<double, 3> rounded_point(const std::array<Point, size>& simplex, const Barycentric<size>& b)
{
  std::array<double, 3> p = {};
  for(std::size_t v = 0; v < size; ++v)
    for(int a = 0; a < 3; ++a) p[a] += std::ldexp(double(b[v]), -barycentric_bits) * simplex[v][a];
  return p;
}

template <typename Point, std::size_t size>
Dyadic_vector exact_point(const std::array<Point, size>& simplex, const std::array<double, size>& barycentric)
{
  Dyadic_vector p = { Dyadic(0), Dyadic(0), Dyadic(0) };
  for(std::size_t v = 0; v < size; ++v)
    for(int a = 0; a < 3; ++a) p[a] += Dyadic(barycentric[v]) * Dyadic(double(simplex[v][a]));
  return p;
}
template <typename Point, std::size_t size>
Dyadic_vector exact_point(const std::array<Point, size>& simplex, const Barycentric<size>& b)
{
  std::array<double, size> barycentric;
  for(std::size_t v = 0; v < size; ++v) barycentric[v] = std::ldexp(double(b[v]), -barycentric_bits);
  return exact_point(simplex, barycentric);
}

// Evaluates `f` at rounded points of a grid, and descends from its least places. NaN counts as the least value. Sorted,
// least first.
template <typename Point, std::size_t size, typename Function>
std::vector<Barycentric<size> > worst_points(const std::array<Point, size>& simplex, const Function& f,
                                             int grid = size == 3 ? 12 : 32, std::size_t starts = 2)
{
  typedef std::pair<double, Barycentric<size> > Place;
  const auto value = [&](const Barycentric<size>& b) {
    const double x = f(rounded_point(simplex, b));
    return std::isnan(x) ? -std::numeric_limits<double>::infinity() : x;
  };
  constexpr std::int64_t one = std::int64_t(1) << barycentric_bits;
  std::vector<Place> places;
  for(int i = 0; i <= grid; ++i)
    for(int j = 0; j <= (size == 3 ? grid - i : 0); ++j) {
      Barycentric<size> b;
      b[0] = one * i / grid;
      if(size == 3) b[1] = one * j / grid;
      b[size - 1] = one - b[0] - (size == 3 ? b[1] : 0);
      places.emplace_back(value(b), b);
    }
  starts = (std::min)(starts, places.size());
  std::partial_sort(places.begin(), places.begin() + starts, places.end());
  places.resize(starts);
  for(Place& place : places)
    for(std::int64_t step = one / (2 * grid); step > 0;) {
      Place best = place;
      for(std::size_t u = 0; u < size; ++u)
        for(std::size_t v = 0; v < size; ++v) {
          if(u == v || place.second[u] < step) continue;
          Barycentric<size> b = place.second;
          b[u] -= step;
          b[v] += step;
          const double x = value(b);
          if(x < best.first) best = Place(x, b);
        }
      if(best.first < place.first) place = best;
      else step /= 4;
    }
  std::sort(places.begin(), places.end());
  std::vector<Barycentric<size> > points;
  for(const Place& place : places) points.push_back(place.second);
  return points;
}

#endif // WORST_POINTS_H
