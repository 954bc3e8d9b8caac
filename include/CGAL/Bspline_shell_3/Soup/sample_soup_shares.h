// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_SAMPLE_SOUP_SHARES_H
#define CGAL_BSPLINE_SHELL_3_SOUP_SAMPLE_SOUP_SHARES_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Soup/Soup_shares.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_point.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief estimates the shares of a soup's area that its proxy represents.
 *
 * Samples are distributed over the facets by area, with at least one on each facet. Every call uses the same samples.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Map a `Soup_map_3`
 * \param map from the soup to the proxy
 * \param samples approximate number of samples, in addition to one per facet
 * \cgalHeading{Cost} About ten microseconds of processor time per sample.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Map>
Soup_shares sample_soup_shares(const Map& map, std::size_t samples = 20000)
{
  const auto& soup = map.to_source().target();
  typedef typename Map::Projection_to_source::Target Soup;
  typedef typename Soup::Index Index;
  typedef std::array<double, 3> Coordinates;
  Soup_shares shares;
  const std::size_t size = soup.number_of_facets();
  shares.facets.assign(size, Soup_point::HIDDEN);
  if(!map.maps_points()) return shares;
  double area = 0;
  for(std::size_t f = 0; f < size; ++f) area += internal::norm(soup.normal(Index(f)));
  if(!(area > 0)) return shares;
  std::vector<std::size_t> first{ 0 }; // first sample of each facet
  for(std::size_t f = 0; f < size; ++f)
    first.push_back(first.back() + 1 + std::size_t(double(samples) * (internal::norm(soup.normal(Index(f))) / area)));

  const auto facet_of = [&](std::size_t n) {
    return std::size_t(std::upper_bound(first.begin(), first.end(), n) - first.begin()) - 1;
  };
  // A low-discrepancy sequence in the unit square, folded into the triangle.
  const auto point = [&](std::size_t n) {
    const std::size_t f = facet_of(n), i = n - first[f];
    double u = 1. / 3 + 0.7548776662466927 * double(i), v = 1. / 3 + 0.5698402909980532 * double(i), whole;
    u = std::modf(u, &whole);
    v = std::modf(v, &whole);
    if(u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    return soup.point(Index(f), Coordinates{ 1 - u - v, u, v });
  };
  std::vector<Soup_point> found(first.back());
  const double near = 1000 * map.to_source().tolerance();
  Default_flow_visitor visitor;
  internal::for_each_point<ConcurrencyTag>(found.size(), point, visitor, [&](std::size_t n, const auto& p) {
    const Coordinates x = { p[0], p[1], p[2] };
    const auto image = map.to_target()(p);
    found[n] = Soup_point::HIDDEN;
    if(image && !image.is_continued) {
      const auto seen = map.to_source()(p);
      if(seen && !seen.is_continued
         && std::hypot(seen.point[0] - x[0], seen.point[1] - x[1], seen.point[2] - x[2]) <= near)
        found[n] = Soup_point::CARRIED;
    } else if(image) {
      const Coordinates q = { image.point[0], image.point[1], image.point[2] };
      bool is_hidden = false;
      const double length = std::hypot(x[0] - q[0], x[1] - q[1], x[2] - q[2]);
      const Coordinates d = { x[0] - q[0], x[1] - q[1], x[2] - q[2] };
      Bbox_3 box(q[0], q[1], q[2], q[0], q[1], q[2]);
      box += Bbox_3(x[0], x[1], x[2], x[0], x[1], x[2]);
      soup.visit_facets(box, [&](Index f) {
        const double h0 = soup.height(f, q), h1 = soup.height(f, x);
        if(is_hidden || !soup.has_area(f) || (h0 < 0) == (h1 < 0) || h0 == h1) return;
        const double t = h0 / (h0 - h1);
        if((1 - t) * length <= near) return;
        is_hidden = soup.position(f, { q[0] + t * d[0], q[1] + t * d[1], q[2] + t * d[2] }).outside <= 0;
      });
      if(!is_hidden) found[n] = Soup_point::CONTINUED;
    }
  });

  for(std::size_t f = 0; f < size; ++f) {
    std::array<std::size_t, 3> count = {};
    for(std::size_t n = first[f]; n < first[f + 1]; ++n) ++count[std::size_t(found[n])];
    shares.facets[f] = Soup_point(std::max_element(count.begin(), count.end()) - count.begin());
    const double each = internal::norm(soup.normal(Index(f))) / area / double(first[f + 1] - first[f]);
    shares.carried += each * double(count[std::size_t(Soup_point::CARRIED)]);
    shares.continued += each * double(count[std::size_t(Soup_point::CONTINUED)]);
    shares.hidden += each * double(count[std::size_t(Soup_point::HIDDEN)]);
  }
  return shares;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_SAMPLE_SOUP_SHARES_H
