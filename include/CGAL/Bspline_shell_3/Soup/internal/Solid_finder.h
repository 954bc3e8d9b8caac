// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_SOLID_FINDER_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_SOLID_FINDER_H

#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Mesh/check_orientation.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Mesh/fan_winding.h>
#include <CGAL/Bspline_shell_3/Mesh/intersecting_facets.h>
#include <CGAL/Bspline_shell_3/Mesh/validate_mesh.h>
#include <CGAL/Bspline_shell_3/Soup/Unite_report.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Solids of a mesh, and their colors.
struct Solids
{
  typedef std::pair<std::size_t, std::size_t> Pair;
  static constexpr std::size_t none = std::size_t(-1);

  Unite_report report;                     // the status is `UNITED` unless the mesh is rejected
  bool faces_outwards = true;              // whether outermost parts do
  std::vector<std::size_t> solid_of_facet; // by facet of the user's mesh
  std::vector<char> meets_others;          // by facet of the user's mesh: whether it meets another part
  // By solid: a color that no other solid has which intersects it, or contains a part of it. `none` for solids that
  // are apart from all others.
  std::vector<std::size_t> color;
  std::size_t number_of_colors = 0;
  std::vector<Pair> coplanar_pairs; // facets of the user's mesh that overlap, and face the same side
};

// Returns the index of the largest component of a normal.
inline std::size_t main_axis(const std::array<double, 3>& normal)
{
  const auto is_smaller = [](double x, double y) { return std::abs(x) < std::abs(y); };
  return std::size_t(std::max_element(normal.begin(), normal.end(), is_smaller) - normal.begin());
}

// Returns whether two triangles face the same side of a common plane, and their interiors intersect.
inline bool do_overlap_facing_same_side(const std::array<Mesh_with_origins::Kernel::Point_3, 3>& s,
                                        const std::array<Mesh_with_origins::Kernel::Point_3, 3>& t)
{
  typedef Mesh_with_origins::Kernel::Point_2 Point_2;
  for(const auto& p : t)
    if(CGAL::orientation(s[0], s[1], s[2], p) != COPLANAR) return false;
  const std::array<double, 3> normal = facet_normal(s[0], s[1], s[2]).direction;
  if(!(dot(normal, facet_normal(t[0], t[1], t[2]).direction) > 0)) return false;
  const int axis = int(main_axis(normal));
  const auto projected = [axis](const auto& p) { return Point_2(p[(axis + 1) % 3], p[(axis + 2) % 3]); };
  const Orientation inner_side = normal[std::size_t(axis)] > 0 ? LEFT_TURN : RIGHT_TURN;
  // Interiors of convex polygons are disjoint if and only if a line through an edge separates them.
  const auto separates = [&](const auto& a, const auto& b) {
    for(int i = 0; i < 3; ++i) {
      const Point_2 p = projected(a[i]), q = projected(a[(i + 1) % 3]);
      if(std::none_of(b.begin(), b.end(),
                      [&](const auto& r) { return CGAL::orientation(p, q, projected(r)) == inner_side; }))
        return true;
    }
    return false;
  };
  return !separates(s, t) && !separates(t, s);
}

// Finds the solids of a mesh.
class Solid_finder
{
  typedef Mesh_with_origins::Face_index Face_index;
  typedef Solids::Pair Pair;
public:
  template <typename ConcurrencyTag>
  Solids find(const Mesh_with_origins::Triangle_mesh& mesh)
  {
    m_mesh = copy_mesh<ConcurrencyTag>(mesh, get(vertex_point, mesh));
    if(!m_mesh.refusal) m_mesh.refusal = validate_mesh<ConcurrencyTag>(m_mesh, false);
    if(m_mesh.refusal) fail(Unite_status::UNSUITABLE_MESH, m_mesh.refusal.offending_simplices.facets);
    else if(find_parts<ConcurrencyTag>() && find_containers<ConcurrencyTag>() && assign_parts()) color_solids();
    return std::move(m_solids);
  }

private:
  bool fail(Unite_status status, std::vector<std::size_t> facets)
  {
    sort_unique(facets);
    m_solids.report.status = status;
    m_solids.report.offending_facets = std::move(facets);
    return false;
  }
  // Fails if there are such parts, and lists a facet of each.
  bool fail_at_parts_if_any(Unite_status status, const std::vector<std::size_t>& parts)
  {
    std::vector<std::size_t> facets;
    for(std::size_t c : parts) facets.push_back(m_parts.first_facet[c]);
    return facets.empty() || fail(status, std::move(facets));
  }

  // Finds parts, and pairs of them that intersect or touch.
  template <typename ConcurrencyTag>
  bool find_parts()
  {
    constexpr unsigned int max_pairs = 10000000; // 160 MB
    m_parts = find_components(m_mesh);
    m_solids.report.parts = m_parts.first_facet.size();
    const auto pairs = intersecting_facets<ConcurrencyTag>(m_mesh.mesh, embedded_fans<ConcurrencyTag>(m_mesh.mesh),
                                                           max_pairs);
    if(pairs.size() >= max_pairs) return fail(Unite_status::TOO_MANY_INTERSECTIONS, {});
    m_solids.meets_others.assign(m_mesh.number_of_facet_origins, 0);
    std::vector<std::size_t> in_one_part;
    for(const auto& [f, g] : pairs) {
      Run::poll();
      const std::size_t c = m_parts.of_facet[f], d = m_parts.of_facet[g];
      const Pair origins = std::minmax({ m_mesh.facet_origin[f], m_mesh.facet_origin[g] });
      if(c == d) in_one_part.insert(in_one_part.end(), { origins.first, origins.second });
      else {
        m_meets.insert(std::minmax({ c, d }));
        m_solids.meets_others[origins.first] = m_solids.meets_others[origins.second] = 1;
        if(do_overlap_facing_same_side(m_mesh.triangle(f), m_mesh.triangle(g)))
          m_solids.coplanar_pairs.push_back(origins);
      }
    }
    sort_unique(m_solids.coplanar_pairs);
    m_solids.report.coplanar_pairs = m_solids.coplanar_pairs.size();
    return in_one_part.empty() || fail(Unite_status::PART_INTERSECTS_ITSELF, std::move(in_one_part));
  }

  // Finds the side that each part faces, and the other parts that contain all of it.
  template <typename ConcurrencyTag>
  bool find_containers()
  {
    const Crossing_counter_3 counter(m_mesh.mesh);
    const std::size_t size = m_parts.first_facet.size();
    std::vector<char> is_known(size, 0);
    m_is_outward.resize(size);
    m_containers.resize(size);
    for(Face_index f : m_mesh.mesh.faces()) {
      const std::size_t c = m_parts.of_facet[f];
      if(is_known[c]) continue;
      Run::poll();
      const auto around = components_around_front<ConcurrencyTag>(f, m_mesh, m_parts, counter);
      if(!around) continue;
      is_known[c] = 1;
      m_is_outward[c] = std::find(around->begin(), around->end(), c) == around->end();
      for(std::size_t d : *around)
        if(d != c && !do_meet(c, d)) m_containers[c].push_back(d);
    }
    // All facets of such a part coincide with others, or are too small for a point in front of them.
    std::vector<std::size_t> unknown;
    for(std::size_t c = 0; c < size; ++c)
      if(!is_known[c]) unknown.push_back(c);
    return fail_at_parts_if_any(Unite_status::CONTACT, unknown);
  }

  // Assigns parts to solids. A part is an outer one if it faces the same side as the first outermost part, and a cavity
  // otherwise. Cavities of a solid must be in it, apart, and not within each other: then the solid is embedded, and
  // bounds a volume.
  bool assign_parts()
  {
    const std::size_t size = m_parts.first_facet.size();
    std::size_t outermost = 0;
    while(!m_containers[outermost].empty()) ++outermost;
    m_solids.faces_outwards = m_is_outward[outermost];
    m_is_outer.resize(size);
    m_solid.assign(size, Solids::none);
    for(std::size_t c = 0; c < size; ++c) {
      m_is_outer[c] = bool(m_is_outward[c]) == m_solids.faces_outwards;
      if(!m_is_outer[c]) continue;
      m_solid[c] = m_cavities.size();
      m_cavities.emplace_back();
    }
    std::vector<std::size_t> wrong;
    for(std::size_t c = 0; c < size; ++c) {
      if(m_is_outer[c]) continue;
      // Whatever contains an outer part contains the parts in it, so the innermost one has the most containers.
      std::size_t innermost = Solids::none;
      for(std::size_t d : m_containers[c])
        if(m_is_outer[d] && (innermost == Solids::none || m_containers[d].size() > m_containers[innermost].size()))
          innermost = d;
      if(innermost == Solids::none) {
        wrong.push_back(c);
        continue;
      }
      m_solid[c] = m_solid[innermost];
      for(std::size_t d : m_cavities[m_solid[c]])
        if(do_meet(c, d) || contains(c, d) || contains(d, c)) wrong.push_back(c);
      m_cavities[m_solid[c]].push_back(c);
    }
    m_solids.report.solids = m_cavities.size();
    m_solids.solid_of_facet.resize(m_mesh.number_of_facet_origins);
    for(Face_index f : m_mesh.mesh.faces())
      m_solids.solid_of_facet[m_mesh.facet_origin[f]] = m_solid[m_parts.of_facet[f]];
    return fail_at_parts_if_any(Unite_status::INCONSISTENT_ORIENTATION, wrong);
  }

  // Assigns the smallest color that is not taken, to the solids with most neighbors first.
  void color_solids()
  {
    const std::size_t size = m_cavities.size();
    std::vector<std::set<std::size_t> > neighbors(size);
    const auto connect = [&](std::size_t s, std::size_t t) {
      if(s == t) return;
      neighbors[s].insert(t);
      neighbors[t].insert(s);
    };
    for(const auto& [c, d] : m_meets) connect(m_solid[c], m_solid[d]);
    for(std::size_t c = 0; c < m_containers.size(); ++c)
      for(std::size_t d : m_containers[c]) {
        if(!m_is_outer[d]) continue;
        const std::vector<std::size_t>& cavities = m_cavities[m_solid[d]];
        if(std::none_of(cavities.begin(), cavities.end(), [&](std::size_t cavity) { return contains(cavity, c); }))
          connect(m_solid[c], m_solid[d]);
      }
    std::vector<std::size_t> order(size);
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t s, std::size_t t) { return neighbors[s].size() > neighbors[t].size(); });
    m_solids.color.assign(size, Solids::none);
    for(std::size_t s : order) {
      if(neighbors[s].empty()) continue;
      std::set<std::size_t> taken;
      for(std::size_t t : neighbors[s]) taken.insert(m_solids.color[t]);
      std::size_t& color = m_solids.color[s];
      for(color = 0; taken.count(color) > 0;) ++color;
      m_solids.number_of_colors = (std::max)(m_solids.number_of_colors, color + 1);
      ++m_solids.report.united_solids;
    }
    m_solids.report.groups = number_of_groups(neighbors);
    m_solids.report.status = Unite_status::UNITED;
  }

  // Returns the number of connected components with several solids.
  static std::size_t number_of_groups(const std::vector<std::set<std::size_t> >& neighbors)
  {
    std::size_t groups = 0;
    std::vector<char> is_known(neighbors.size(), 0);
    for(std::size_t s = 0; s < neighbors.size(); ++s) {
      if(is_known[s] || neighbors[s].empty()) continue;
      ++groups;
      std::vector<std::size_t> stack{ s };
      while(!stack.empty()) {
        const std::size_t t = stack.back();
        stack.pop_back();
        if(is_known[t]) continue;
        is_known[t] = 1;
        stack.insert(stack.end(), neighbors[t].begin(), neighbors[t].end());
      }
    }
    return groups;
  }

  bool do_meet(std::size_t c, std::size_t d) const { return m_meets.count(std::minmax({ c, d })) > 0; }
  // Returns whether the part d is within the part c.
  bool contains(std::size_t c, std::size_t d) const
  {
    return std::find(m_containers[d].begin(), m_containers[d].end(), c) != m_containers[d].end();
  }

  Mesh_with_origins m_mesh;
  Components m_parts;
  Solids m_solids;
  std::set<Pair> m_meets;                              // pairs of parts, ascending
  std::vector<std::vector<std::size_t> > m_containers; // by part
  std::vector<char> m_is_outward, m_is_outer;          // by part
  std::vector<std::size_t> m_solid;                    // by part
  std::vector<std::vector<std::size_t> > m_cavities;   // by solid
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_SOLID_FINDER_H
