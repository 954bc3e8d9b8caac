// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_FIND_CLOSE_POINTS_H
#define CGAL_BSPLINE_SHELL_3_SOUP_FIND_CLOSE_POINTS_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

typedef Box_intersection_d::Box_with_info_d<double, 3, std::size_t> Numbered_box;
typedef std::vector<std::pair<std::size_t, std::size_t> > Close_pairs;

// Counts candidates. It throws an exception, which ends a search, once there are more than `most_per_object` for each
// of the objects.
class Candidate_count
{
public:
  struct Too_many
  {};
  explicit Candidate_count(std::size_t objects) : m_most(most_per_object * objects) {}
  void operator++()
  {
    if(++m_count > m_most) throw Too_many();
    if(m_count % 1024 == 0) Run::poll();
  }

private:
  static constexpr std::size_t most_per_object = 64; // few border vertices are close to each other
  std::size_t m_most, m_count = 0;
};

inline Bbox_3 enlarged(const Bbox_3& box, double d)
{
  return { box.xmin() - d, box.ymin() - d, box.zmin() - d, box.xmax() + d, box.ymax() + d, box.zmax() + d };
}

// Returns the pairs of points whose distance is at most `distance`; nothing if there are too many candidates.
inline std::optional<Close_pairs> find_close_points(const Polygon_soup::Points& points,
                                                    const std::vector<std::size_t>& numbers, double distance)
{
  Close_pairs pairs;
  std::vector<Numbered_box> boxes;
  for(std::size_t v : numbers) boxes.emplace_back(enlarged(points[v].bbox(), distance), v);
  Candidate_count count(numbers.size());
  try {
    CGAL::box_self_intersection_d<Sequential_tag>(
      boxes.begin(), boxes.end(), [&](const Numbered_box& a, const Numbered_box& b) {
        ++count;
        const std::size_t v = a.info(), w = b.info();
        if(CGAL::squared_distance(points[v], points[w]) <= distance * distance) pairs.emplace_back(v, w);
      });
  } catch(const Candidate_count::Too_many&) {
    return std::nullopt;
  }
  return pairs;
}

// Returns pairs of a segment and a point, by their numbers, among them all whose distance is at most `distance`;
// nothing if there are too many candidates.
inline std::optional<Close_pairs> find_points_close_to_segments(
  const Polygon_soup::Points& points, const std::vector<std::size_t>& numbers,
  const std::vector<std::pair<std::size_t, std::size_t> >& segments, double distance)
{
  typedef Polygon_soup::Points::value_type Point_3;
  double total = 0, largest = 0;
  for(const auto& [v, w] : segments) {
    total += std::sqrt(CGAL::squared_distance(points[v], points[w]));
    for(int a = 0; a < 3; ++a) largest = (std::max)({ largest, std::abs(points[v][a]), std::abs(points[w][a]) });
  }
  // Boxes of long segments that are not parallel to an axis would contain many points. So each segment has boxes of
  // parts no longer than the mean; there are at most twice as many parts as segments.
  const double mean = total / double(segments.size());
  const double width = distance + 8 * std::numeric_limits<double>::epsilon() * largest; // ends of parts are rounded
  std::vector<Numbered_box> parts, boxes;
  for(std::size_t s = 0; s < segments.size(); ++s) {
    const Point_3 &p = points[segments[s].first], &q = points[segments[s].second];
    const double number = std::ceil(std::sqrt(CGAL::squared_distance(p, q)) / mean);
    for(double n = 0; n < number; ++n)
      parts.emplace_back(
        enlarged((p + (n / number) * (q - p)).bbox() + (p + ((n + 1) / number) * (q - p)).bbox(), width), s);
  }
  for(std::size_t v : numbers) boxes.emplace_back(points[v].bbox(), v);
  Close_pairs pairs;
  Candidate_count count(parts.size() + boxes.size());
  try {
    CGAL::box_intersection_d<Sequential_tag>(parts.begin(), parts.end(), boxes.begin(), boxes.end(),
                                             [&](const Numbered_box& part, const Numbered_box& point) {
                                               ++count;
                                               pairs.emplace_back(part.info(), point.info());
                                             });
  } catch(const Candidate_count::Too_many&) {
    return std::nullopt;
  }
  sort_unique(pairs);
  return pairs;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_FIND_CLOSE_POINTS_H
