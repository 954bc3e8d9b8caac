// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_ASSEMBLE_CLOSING_H
#define CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_ASSEMBLE_CLOSING_H

#include <CGAL/Bspline_shell_3/Closing/internal/Back_sheet.h>
#include <CGAL/Bspline_shell_3/Closing/internal/Hole_caps.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A closing, with its points and triangles in the numbering of a back sheet.
struct Assembled_closing
{
  Shell_closing_3 closing;
  std::vector<std::size_t> points;
  std::vector<Back_sheet::Triangle> triangles;
};

// Orders the triangles of caps and back sheets so that they can be added to the mesh one by one: each shares an edge
// with the border of the mesh or with an earlier triangle.
inline Assembled_closing assemble_closing(const Closing_mesh& mesh, const Hole_caps& caps, const Back_sheet& back)
{
  const Closing_mesh& capped = caps.capped_mesh();
  std::vector<Back_sheet::Triangle> all;
  for(auto f : capped.faces())
    if(caps.is_cap(f)) {
      const auto h = capped.halfedge(f);
      all.push_back(
        { std::size_t(capped.source(h)), std::size_t(capped.target(h)), std::size_t(capped.target(capped.next(h))) });
    }
  const std::size_t number_of_caps = all.size();
  all.insert(all.end(), back.triangles().begin(), back.triangles().end());
  const auto key = [](std::size_t p, std::size_t q) { return std::uint64_t(p) << 32 | q; };
  std::unordered_map<std::uint64_t, std::size_t> triangle_at; // by directed edge
  for(std::size_t n = 0; n < all.size(); ++n)
    for(int i = 0; i < 3; ++i) triangle_at.emplace(key(all[n][i], all[n][(i + 1) % 3]), n);

  std::vector<std::size_t> order;
  std::vector<char> is_known(all.size(), 0);
  for(std::size_t n = 0; n < all.size(); ++n)
    for(int i = 0; i < 3 && !is_known[n]; ++i)
      if(triangle_at.count(key(all[n][(i + 1) % 3], all[n][i])) == 0) {
        is_known[n] = 1;
        order.push_back(n);
      }
  for(std::size_t next = 0; next < order.size(); ++next)
    for(int i = 0; i < 3; ++i) {
      const auto& t = all[order[next]];
      const auto found = triangle_at.find(key(t[(i + 1) % 3], t[i]));
      if(found == triangle_at.end() || is_known[found->second]) continue;
      is_known[found->second] = 1;
      order.push_back(found->second);
    }

  std::vector<Shell_closing_3::Point> points;
  std::unordered_map<std::size_t, Shell_closing_3::Index> number;
  Assembled_closing assembled;
  const auto add = [&](std::size_t n) {
    if(!number.emplace(n, Shell_closing_3::Index(points.size())).second) return;
    const Closing_kernel::Point_3 p = back.point(n);
    points.push_back({ p.x(), p.y(), p.z() });
    assembled.points.push_back(n);
  };
  for(auto v : mesh.vertices())
    if(!mesh.is_isolated(v) && mesh.is_border(v)) add(std::size_t(v));
  const std::size_t border = points.size();
  std::vector<Shell_closing_3::Triangle> triangles;
  std::vector<Shell_closing_3::Kind> kinds;
  for(std::size_t n : order) {
    for(std::size_t v : all[n]) add(v);
    triangles.push_back({ number[all[n][0]], number[all[n][1]], number[all[n][2]] });
    kinds.push_back(n < number_of_caps ? Shell_closing_3::Kind::CAP : Shell_closing_3::Kind::BACK);
    assembled.triangles.push_back(all[n]);
  }
  assembled.closing = Shell_closing_3(std::move(points), border, std::move(triangles), std::move(kinds));
  return assembled;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_ASSEMBLE_CLOSING_H
