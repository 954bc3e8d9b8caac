// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_SAMPLE_COMPONENTS_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_SAMPLE_COMPONENTS_H

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Points of a mesh, and the component of the mesh that each belongs to: as close to each other as the field's cells there are wide.
template <typename Field>
std::vector<std::pair<typename Field::Point_3, std::uint32_t> > sample_components(const Field& field, const Input_mesh_3& input)
{
  typedef typename Field::Point_3 Point;
  constexpr int most_halvings = 40;
  struct Part { std::array<Point, 3> corners; int halvings; };
  std::vector<std::pair<Point, std::uint32_t> > samples;
  std::vector<Part> stack;
  for(auto f : input.mesh().faces()) {
    const auto t = input.triangle(f);
    const auto corner = [&](int v) { return Point(t[v].x(), t[v].y(), t[v].z()); };
    stack.push_back({ { corner(0), corner(1), corner(2) }, 0 });
    while(!stack.empty()) {
      const Part part = stack.back();
      stack.pop_back();
      const std::array<Point, 3>& p = part.corners;
      std::size_t longest = 0;
      double length = 0;
      for(std::size_t v = 0; v < 3; ++v) {
        double squared = 0;
        for(int a = 0; a < 3; ++a) squared += (p[(v + 1) % 3][a] - p[v][a]) * (p[(v + 1) % 3][a] - p[v][a]);
        if(squared > length) {
          length = squared;
          longest = v;
        }
      }
      const Point &q = p[longest], &r = p[(longest + 1) % 3], &s = p[(longest + 2) % 3];
      const Point middle((q[0] + r[0]) / 2, (q[1] + r[1]) / 2, (q[2] + r[2]) / 2);
      samples.emplace_back(middle, std::uint32_t(input.component(f)));
      const auto c = field.locate(middle);
      const double width = c == Field::npos ? 0 : field.cell(c).width();
      if(length <= width * width || part.halvings == most_halvings) continue;
      stack.push_back({ { q, middle, s }, part.halvings + 1 });
      stack.push_back({ { middle, r, s }, part.halvings + 1 });
    }
  }
  return samples;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_SAMPLE_COMPONENTS_H
