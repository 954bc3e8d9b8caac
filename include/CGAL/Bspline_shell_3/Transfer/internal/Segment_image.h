// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_SEGMENT_IMAGE_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_SEGMENT_IMAGE_H

#include <CGAL/Bspline_shell_3/Mesh/common_facet.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Transfer/Polyline_image.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Tuning parameters of images of polylines. They affect which deviations are noticed.
struct Polyline_tuning
{
  // Places at which the distance of the image curve from a chord is checked, as fractions of the chord's parameters.
  std::array<double, 3> checks = { 0.25, 0.5, 0.75 };
  // Largest distance at a check, as a fraction of the tolerance. A polynomial of degree four that vanishes at both ends
  // is at most 2.21 times as large as at the checks: this is the Lebesgue constant of five equidistant points.
  double share_at_checks = 0.45;
  // Smallest tolerance, in tolerances of the map. Images, and moves to edges, each have an error of up to one tolerance
  // of the map. The distance of a straight image from its chord may thus seem to be four of them.
  double least_tolerance = 16;
};

inline constexpr Polyline_tuning polyline_tuning = {};

// The image of a segment in a facet of the source. The result is a `Polyline_image`.
template <typename Map>
class Segment_image
{
public:
  typedef Polyline_image<typename Map::Target_mesh, typename Map::Shell::Point_3> Result;
  typedef typename Result::Location Location;
  typedef typename Map::Source_location Source_location;
  typedef typename Map::Coordinates Coordinates;

  // A point of the segment and its image. Images closer to an edge or a vertex than the map's tolerance are moved to
  // it: a curve that runs along an edge then does not alternate between the two facets.
  struct Sample
  {
    double t = 0; // 0 at the first end, 1 at the last end
    Flow_status status = Flow_status::CANCELED;
    Location location;
    Coordinates point = {};
    bool is_continued = false;

    bool has_image() const { return status == Flow_status::SUCCESS; }
  };

  // The ends lie in a common facet. `number` is that of the segment in its polyline.
  Segment_image(const Map& map, double tolerance, std::size_t number, Source_location first, Source_location last)
    : m_map(&map), m_tolerance(tolerance), m_number(number), m_ends{ std::move(first), std::move(last) }
  {}

  // Adds the image to the result. If the first end has an image, it must be the last vertex of the result.
  void trace(const Sample& first, const Sample& last, Result& result)
  {
    m_result = &result;
    if(first.has_image() || last.has_image()) return connect_or_end(first, last);
    // A part between the ends may still have an image.
    Sample before = first;
    for(double check : polyline_tuning.checks) {
      const Sample s = sample(check);
      connect_or_end(before, s);
      before = s;
    }
    connect_or_end(before, last);
  }

  static Sample sample_of(const Map& map, double t, const typename Map::Target_image& image)
  {
    Sample s;
    s.t = t;
    s.status = image.status;
    if(!image) return s;
    s.is_continued = image.is_continued;
    s.location = snapped(map, image.location, rounded_coordinates(image.point));
    s.point = target(map).point(target(map).facet_of(s.location.first), s.location.second);
    return s;
  }

  static void begin_part(Result& result, std::size_t number, const Sample& s)
  {
    result.parts.push_back({ vertex(number, s) });
  }

  static void add_gap(Result& result, const Polyline_gap& gap)
  {
    // Parts without an image are found in pieces.
    if(!result.gaps.empty() && result.gaps.back().end == gap.begin && result.gaps.back().status == gap.status)
      result.gaps.back().end = gap.end;
    else result.gaps.push_back(gap);
  }

private:
  static const auto& target(const Map& map) { return map.to_target().target(); }
  const auto& target() const { return target(*m_map); }
  const auto& mesh() const { return m_map->target(); }

  static double distance(const Coordinates& p, const Coordinates& q)
  {
    return norm(Coordinates{ p[0] - q[0], p[1] - q[1], p[2] - q[2] });
  }

  static typename Result::Vertex vertex(std::size_t number, const Sample& s)
  {
    typename Result::Vertex v;
    v.location = s.location;
    v.point = typename Map::Shell::Point_3(s.point[0], s.point[1], s.point[2]);
    v.parameter = double(number) + s.t;
    v.is_continued = s.is_continued;
    return v;
  }

  static Location snapped(const Map& map, Location location, const Coordinates& p)
  {
    const double snap = map.to_target().tolerance();
    const auto& facets = target(map);
    const auto f = facets.facet_of(location.first);
    auto& w = location.second;
    int nearest = 0;
    for(int i = 1; i < 3; ++i)
      if(distance(p, facets.vertex(f, i)) < distance(p, facets.vertex(f, nearest))) nearest = i;
    if(distance(p, facets.vertex(f, nearest)) <= snap) {
      w = {};
      w[std::size_t(nearest)] = 1;
      return location;
    }
    const auto distance_from_edge = [&](int i) { return w[std::size_t(i)] * height(map, f, i); };
    int least = 0;
    for(int i = 1; i < 3; ++i)
      if(distance_from_edge(i) < distance_from_edge(least)) least = i;
    if(!(distance_from_edge(least) <= snap)) return location;
    const int j = (least + 1) % 3, k = (least + 2) % 3;
    const Coordinates &a = facets.vertex(f, j), &b = facets.vertex(f, k);
    const Coordinates edge = { b[0] - a[0], b[1] - a[1], b[2] - a[2] }, to = { p[0] - a[0], p[1] - a[1], p[2] - a[2] };
    const double u = (std::min)((std::max)(dot(to, edge) / dot(edge, edge), 0.), 1.);
    // The smaller weight is one minus the larger weight, so that their exact sum is one.
    const int larger = u < 0.5 ? j : k, smaller = u < 0.5 ? k : j;
    w[std::size_t(least)] = 0;
    w[std::size_t(larger)] = u < 0.5 ? 1 - u : u;
    w[std::size_t(smaller)] = 1 - w[std::size_t(larger)];
    return location;
  }

  // Returns the distance of a vertex of a facet from the opposite edge.
  template <typename Index>
  static double height(const Map& map, Index f, int i)
  {
    const auto& facets = target(map);
    return norm(facets.normal(f)) / distance(facets.vertex(f, (i + 1) % 3), facets.vertex(f, (i + 2) % 3));
  }

  Sample sample(double t)
  {
    ++m_result->traced_points;
    Source_location location = m_ends[0];
    for(std::size_t i = 0; i < 3; ++i) location.second[i] = (1 - t) * m_ends[0].second[i] + t * m_ends[1].second[i];
    return sample_of(*m_map, t, m_map->to_target()(m_map->traced_point(location), m_hint));
  }

  void add_gap(const Sample& a, const Sample& b, Polyline_status status, Flow_status flow = Flow_status::SUCCESS)
  {
    add_gap(*m_result, { double(m_number) + a.t, double(m_number) + b.t, status, flow });
  }

  void add(const Sample& s)
  {
    auto& part = m_result->parts.back();
    const auto v = vertex(m_number, s);
    if(part.back().point != v.point) part.push_back(v);
  }

  // Adds the image of the part from a to b, of which each may or may not have an image.
  void connect_or_end(const Sample& a, const Sample& b)
  {
    if(a.has_image() && b.has_image()) return connect(a, b);
    if(!a.has_image() && !b.has_image()) return add_gap(a, b, Polyline_status::NO_IMAGE, a.status);
    Sample found = a.has_image() ? a : b, missed = a.has_image() ? b : a;
    const double length = distance(m_map->point(m_ends[0]), m_map->point(m_ends[1]));
    while(std::abs(found.t - missed.t) * length > m_map->to_target().tolerance()) {
      const Sample middle = sample((found.t + missed.t) / 2);
      if(middle.t == found.t || middle.t == missed.t) break;
      (middle.has_image() ? found : missed) = middle;
    }
    if(a.has_image()) {
      connect(a, found);
      add_gap(found, b, Polyline_status::NO_IMAGE, missed.status);
    } else {
      add_gap(a, found, Polyline_status::NO_IMAGE, missed.status);
      begin_part(*m_result, m_number, found);
      connect(found, b);
    }
  }

  // Adds the image of the part from a to b, which have images. The last vertex of the result is the image of a.
  void connect(Sample a, const Sample& b)
  {
    while(a.t != b.t) {
      Sample next;
      Location of_a = a.location, of_b = b.location;
      if(move_to_common_facet(mesh(), of_a, of_b)) {
        const std::optional<Sample> bend = find_bend(a, b);
        if(!bend) return add(b);
        if(!bend->has_image()) {
          connect_or_end(a, *bend);
          return connect_or_end(*bend, b);
        }
        if(bend->t == a.t || bend->t == b.t) { // the parameters of a and b have no double between them
          if(distance(a.point, b.point) <= m_tolerance) return add(b);
          add_gap(a, b, Polyline_status::JUMPS);
          return begin_part(*m_result, m_number, b);
        }
        next = *bend;
      } else {
        Sample inside = a, outside = b;
        leave_facets(a.location, inside, outside);
        if(!outside.has_image()) {
          connect(a, inside);
          connect_or_end(inside, outside);
          return connect_or_end(outside, b);
        }
        if(inside.t == outside.t) next = inside;
        else {
          connect(a, inside);
          add_gap(inside, outside, Polyline_status::JUMPS);
          begin_part(*m_result, m_number, outside);
          a = outside;
          continue;
        }
      }
      connect(a, next);
      a = next;
    }
  }

  // Returns a point between a and b whose image is missing, or else the middle if the image of a check is too far from
  // the chord. Returns nothing if all checks pass.
  std::optional<Sample> find_bend(const Sample& a, const Sample& b)
  {
    std::optional<Sample> middle;
    bool is_far = false;
    for(double check : polyline_tuning.checks) {
      const Sample s = sample(a.t + check * (b.t - a.t));
      if(!s.has_image()) return s;
      if(check == 0.5) middle = s;
      is_far = is_far
               || !(distance_from_chord(s.point, a.point, b.point) <= polyline_tuning.share_at_checks * m_tolerance);
    }
    return is_far ? middle : std::nullopt;
  }

  static double distance_from_chord(const Coordinates& p, const Coordinates& a, const Coordinates& b)
  {
    const Coordinates ab = { b[0] - a[0], b[1] - a[1], b[2] - a[2] }, ap = { p[0] - a[0], p[1] - a[1], p[2] - a[2] };
    const double squared = dot(ab, ab);
    const double u = squared > 0 ? (std::min)((std::max)(dot(ap, ab) / squared, 0.), 1.) : 0;
    return distance(p, { a[0] + u * ab[0], a[1] + u * ab[1], a[2] + u * ab[2] });
  }

  // Finds where the curve leaves the facets around `from`, by the regula falsi. Both samples are then the last point in
  // these facets. If it is not found, they are next to each other, or `outside` has no image.
  // pre: the image of `inside` is in one of these facets, and that of `outside` is not
  void leave_facets(const Location& from, Sample& inside, Sample& outside)
  {
    double depth = -side(from, inside), height = side(from, outside);
    int same = 0; // number of times in a row that the same end moved; a negative number for `inside`
    while(true) {
      // In every other step, the interval is halved, so that it shrinks even if the distances are useless.
      constexpr int most_in_a_row = 2;
      double share = std::abs(same) > most_in_a_row ? 0.5 : depth / (depth + height);
      if(!(share > 0 && share < 1)) share = 0.5;
      Sample s = sample(inside.t + share * (outside.t - inside.t));
      if(s.t == inside.t || s.t == outside.t) {
        s = sample((inside.t + outside.t) / 2);
        if(s.t == inside.t || s.t == outside.t) return;
      }
      if(!s.has_image()) {
        outside = s;
        return;
      }
      const double d = side(from, s);
      if(d == 0) {
        inside = outside = s;
        return;
      }
      if(d < 0) {
        inside = s;
        depth = -d;
        if(same < 0) height /= 2; // Illinois variant
        same = (std::min)(same, 0) - 1;
      } else {
        outside = s;
        height = d;
        if(same > 0) depth /= 2;
        same = (std::max)(same, 0) + 1;
      }
    }
  }

  // Returns the distance of an image from the facets around a location if it is outside of them. Otherwise, returns
  // minus its distance from the edges that bound them.
  double side(const Location& from, const Sample& s) const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double inside = infinity, outside = infinity;
    visit_locations(mesh(), from, [&](const Location& a) {
      const auto f = target().facet_of(a.first);
      visit_locations(mesh(), s.location, [&](const Location& b) {
        if(a.first != b.first) return false;
        for(int i = 0; i < 3; ++i)
          if(a.second[std::size_t(i)] > 0) inside = (std::min)(inside, b.second[std::size_t(i)] * height(*m_map, f, i));
        return true;
      });
      if(target().has_area(f))
        outside = (std::min)(outside, distance(s.point, target().point(f, target().position(f, s.point).nearest)));
      return false;
    });
    if(inside < infinity) return -inside;
    return (std::max)(outside, (std::numeric_limits<double>::min)()); // 0 would mean a bounding edge
  }

  const Map* m_map;
  double m_tolerance;
  std::size_t m_number;
  std::array<Source_location, 2> m_ends;
  typename Map::Projection_to_target::Hint m_hint;
  Result* m_result = nullptr;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_SEGMENT_IMAGE_H
