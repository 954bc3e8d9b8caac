// Checks Shell_cover_3: claims about its boxes, flooding against brute force over all pairs of boxes, and bounds on the
// gradient.
#ifndef CHECK_COVER_H
#define CHECK_COVER_H

#include "Exact_shell.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_cover_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

typedef std::array<double, 3> Place;

// Returns an approximate minimizer of a function in a closed box.
template <typename Function>
Place worst_place(const CGAL::Bbox_3& box, const Function& f)
{
  const auto value = [&](const Place& p) {
    const double x = f(p);
    return std::isnan(x) ? -std::numeric_limits<double>::infinity() : x;
  };
  const auto at = [&](int a, double t) {
    return (std::min)((box.max)(a), (std::max)((box.min)(a), (box.min)(a) + t * ((box.max)(a) - (box.min)(a))));
  };
  Place best = { box.xmin(), box.ymin(), box.zmin() };
  double least = value(best);
  for(int k = 0; k <= 2; ++k)
    for(int j = 0; j <= 2; ++j)
      for(int i = 0; i <= 2; ++i) {
        const Place p = { i == 2 ? box.xmax() : at(0, i / 2.), j == 2 ? box.ymax() : at(1, j / 2.),
                          k == 2 ? box.zmax() : at(2, k / 2.) };
        const double x = value(p);
        if(x < least) {
          least = x;
          best = p;
        }
      }
  for(double step = 0.25; step > 1e-7;) {
    const Place center = best;
    for(int a = 0; a < 3; ++a)
      for(double s : { -step, step }) {
        Place p = center;
        p[a] = (std::min)((box.max)(a), (std::max)((box.min)(a), p[a] + s * ((box.max)(a) - (box.min)(a))));
        const double x = value(p);
        if(x < least) {
          least = x;
          best = p;
        }
      }
    if(best == center) step /= 4;
  }
  return best;
}

template <typename Shell>
class Cover_check
{
  typedef typename Shell::Field Field;
  typedef typename Shell::Threshold Threshold;
  typedef BS::Shell_cover_3<Field, Threshold> Cover;
  typedef typename Shell::Jets Jets;

public:
  Cover_check(Tally& tally, CGAL::Random& random, const Shell& shell, const std::vector<Point_3>& seeds)
    : m_tally(tally), m_random(random), m_shell(shell), m_cover(shell.field(), shell.inner(), shell.outer())
  {
    const std::vector<std::uint32_t> components = flood(seeds);
    for(const BS::Cover_box& box : m_cover.boxes()) m_bbox.push_back(m_cover.bbox(box));
    check_boxes();
    check_tiling();
    if(m_cover.boxes().size() < 6000) check_flood(seeds, components);
    check_ends();
    check_gradients();
  }

private:
  std::vector<std::uint32_t> flood(const std::vector<Point_3>& seeds)
  {
    std::vector<std::uint32_t> components;
    for(std::size_t n = 0; n < seeds.size(); ++n)
      components.push_back(m_cover.template flood<CGAL::Sequential_tag>(seeds[n], std::uint32_t(n)));
    return components;
  }

  static bool touch(const CGAL::Bbox_3& a, const CGAL::Bbox_3& b)
  {
    for(int d = 0; d < 3; ++d)
      if((a.max)(d) < (b.min)(d) || (b.max)(d) < (a.min)(d)) return false;
    return true;
  }
  static bool contains(const CGAL::Bbox_3& b, const Point_3& p) { return touch(b, p.bbox()); }

  std::string describe_box(std::size_t n) const
  {
    const CGAL::Bbox_3& b = m_bbox[n];
    return "box " + std::to_string(n) + " of cell " + std::to_string(m_cover.boxes()[n].cell)
           + describe(Segment{ Point_3(b.xmin(), b.ymin(), b.zmin()), Point_3(b.xmax(), b.ymax(), b.zmax()) });
  }

  void check_boxes()
  {
    const std::size_t stride = m_cover.boxes().size() / 200 + 1;
    for(std::size_t n = std::size_t(m_random.get_int(0, int(stride))); n < m_cover.boxes().size(); n += stride) {
      const BS::Cover_box& box = m_cover.boxes()[n];
      const auto c = box.cell;
      const auto cell = m_shell.field().cell(c);
      if(box.kind == BS::Box_kind::UNDECIDED) {
        m_tally.count("box_monotone", Verdict::UNDECIDED);
        continue;
      }
      const std::string kind = box.kind == BS::Box_kind::EXCLUDED   ? "box_excluded"
                               : box.kind == BS::Box_kind::MONOTONE ? "box_monotone"
                                                                    : "box_critical";
      m_tally.count(kind, Verdict::PROVED);
      // One threshold is enough to exclude a box.
      if(!m_shell.exact_field().bernstein(c)) {
        m_tally.wrong(kind, "the field is not finite on " + describe_box(n));
        continue;
      }
      // Boxes are closed, and are checked with the polynomials of their own cell.
      if(box.kind == BS::Box_kind::EXCLUDED) {
        const Place p = worst_place(m_bbox[n], [&](const Place& p) {
          const double f = cell.value(p);
          return (std::max)(m_shell.inner().value(p, c) - f, f - m_shell.outer().value(p, c));
        });
        const Jets j = m_shell.jets(c, dyadic(p));
        if(j.f.value >= j.inner.value && j.f.value <= j.outer.value) m_tally.wrong(kind, describe_box(n));
        continue;
      }
      if(box.kind == BS::Box_kind::MONOTONE) {
        const Place p = worst_place(m_bbox[n], [&](const Place& p) {
          const auto g = cell.first_order_jet(p).gradient;
          return box.proof[0] * g[0] + box.proof[1] * g[1] + box.proof[2] * g[2];
        });
        if(sign(dot(dyadic(box.proof), m_shell.jets(c, dyadic(p)).f.gradient)) <= 0)
          m_tally.wrong(kind, describe_box(n));
      } else check_critical_points(n);
      if constexpr(!Threshold::is_constant)
        for(const Threshold* threshold : { &m_shell.inner(), &m_shell.outer() }) check_crossing(n, *threshold);
    }
  }

  // The field minus the threshold, less half of the slope towards the center, has the same sign on the whole box.
  void check_critical_points(std::size_t n)
  {
    const BS::Cover_box& box = m_cover.boxes()[n];
    const auto c = box.cell;
    const auto cell = m_shell.field().cell(c);
    const bool below = box.kind == BS::Box_kind::CRITICAL_BELOW;
    const Threshold& threshold = below ? m_shell.inner() : m_shell.outer();
    const double width = m_bbox[n].xmax() - m_bbox[n].xmin();
    const Place corner = { m_bbox[n].xmin(), m_bbox[n].ymin(), m_bbox[n].zmin() };
    const Place p = worst_place(m_bbox[n], [&](const Place& p) {
      const auto g = cell.first_order_jet(p).gradient;
      double above = cell.value(p) - threshold.value(p, c);
      for(int a = 0; a < 3; ++a) above -= (p[a] - corner[a] - width * box.proof[a]) * g[a] / 2;
      return below ? -above : above;
    });
    const Jets j = m_shell.jets(c, dyadic(p));
    Dyadic above = j.f.value - (below ? j.inner : j.outer).value;
    for(int a = 0; a < 3; ++a)
      above = above
              - (Dyadic(p[a]) - Dyadic(corner[a]) - Dyadic(width) * Dyadic(box.proof[a])) * j.f.gradient[a]
                  * Dyadic(0.5);
    if(sign(above) != (below ? -1 : 1)) m_tally.wrong("box_critical", "wrong for " + describe_box(n));
  }

  // Where the field crosses a threshold, it must cross it upwards: in monotone boxes, and in the shell in other boxes.
  void check_crossing(std::size_t n, const Threshold& threshold)
  {
    const BS::Cover_box& box = m_cover.boxes()[n];
    const auto cell = m_shell.field().cell(box.cell), other = threshold.field().cell(box.cell);
    const bool is_inner = &threshold == &m_shell.inner();
    const auto margin = [&](const Place& p) { return cell.value(p) - other.value(p); };
    const auto slope = [&](const Place& p) {
      const auto g = cell.first_order_jet(p).gradient, t = other.first_order_jet(p).gradient;
      return g[0] * (g[0] - t[0]) + g[1] * (g[1] - t[1]) + g[2] * (g[2] - t[2]);
    };
    std::vector<std::pair<double, Place> > below, above; // least slopes first
    for(int i = 0; i < 27; ++i) {
      Place p;
      const int position[3] = { i % 3, i / 3 % 3, i / 9 };
      for(int a = 0; a < 3; ++a)
        p[a] = position[a] == 0   ? (m_bbox[n].min)(a)
               : position[a] == 2 ? (m_bbox[n].max)(a)
                                  : (m_bbox[n].min)(a) + ((m_bbox[n].max)(a) - (m_bbox[n].min)(a)) / 2;
      (margin(p) < 0 ? below : above).emplace_back(slope(p), p);
    }
    std::sort(below.begin(), below.end());
    std::sort(above.begin(), above.end());
    for(std::size_t k = 0; k < (std::min)({ below.size(), above.size(), std::size_t(3) }); ++k) {
      Place low = below[k].second, high = above[k].second;
      for(int step = 0; step < 60; ++step) {
        Place middle;
        for(int a = 0; a < 3; ++a) middle[a] = low[a] + (high[a] - low[a]) / 2;
        (margin(middle) < 0 ? low : high) = middle;
      }
      bool is_below = false, is_above = false, is_steep_enough = false, is_in_shell = true;
      for(const Place& p : { low, high }) {
        const Jets j = m_shell.jets(box.cell, dyadic(p));
        const Exact_jet& t = is_inner ? j.inner : j.outer;
        is_below = is_below || j.f.value <= t.value;
        is_above = is_above || j.f.value >= t.value;
        is_in_shell = is_in_shell && (is_inner ? j.f.value <= j.outer.value : j.f.value >= j.inner.value);
        is_steep_enough = is_steep_enough || sign(dot(j.f.gradient, minus(j.f.gradient, t.gradient))) > 0;
      }
      if(!is_below || !is_above || (box.kind != BS::Box_kind::MONOTONE && !is_in_shell)) continue;
      m_tally.count("box_crossing", is_steep_enough,
                    "the field does not increase through a threshold on " + describe_box(n));
    }
  }

  // The boxes of a cell fill it without overlapping, and their corners are exact.
  void check_tiling()
  {
    std::map<std::uint32_t, double> volume;
    for(std::size_t n = 0; n < m_bbox.size(); ++n) {
      const BS::Cover_box& box = m_cover.boxes()[n];
      const auto cell = m_shell.field().cell(box.cell);
      volume[box.cell] += std::ldexp(1., -3 * int(box.depth));
      bool is_exact = true;
      for(int a = 0; a < 3; ++a) {
        const double unit = std::ldexp(1., -int(box.depth));
        is_exact = is_exact && box.position[a] < 1 << box.depth
                   && Dyadic((m_bbox[n].min)(a))
                        == Dyadic(cell.corner()[a]) + Dyadic(box.position[a] * unit) * Dyadic(cell.width())
                   && Dyadic((m_bbox[n].max)(a))
                        == Dyadic(cell.corner()[a]) + Dyadic((box.position[a] + 1) * unit) * Dyadic(cell.width());
      }
      if(!is_exact) m_tally.wrong("box_tiling", "wrong corner of " + describe_box(n));
    }
    m_tally.count("box_tiling", Verdict::PROVED);
    for(const auto& v : volume)
      if(v.second != 1) m_tally.wrong("box_tiling", "the boxes do not fill cell " + std::to_string(v.first));
  }

  void check_flood(const std::vector<Point_3>& seeds, const std::vector<std::uint32_t>& components)
  {
    const auto& boxes = m_cover.boxes();
    std::vector<std::size_t> order;
    for(std::size_t n = 0; n < boxes.size(); ++n)
      if(boxes[n].kind != BS::Box_kind::EXCLUDED) order.push_back(n);
    std::vector<std::uint32_t> truth(boxes.size(), BS::Cover_box::no_component);
    for(std::size_t s = 0; s < seeds.size(); ++s) {
      std::vector<std::size_t> stack;
      std::uint32_t known = std::uint32_t(s);
      for(std::size_t n : order)
        if(contains(m_bbox[n], seeds[s])) {
          if(truth[n] != BS::Cover_box::no_component) known = truth[n];
          else {
            truth[n] = std::uint32_t(s);
            stack.push_back(n);
          }
        }
      m_tally.count("flood", known == components[s], "wrong component of seed " + std::to_string(s));
      while(!stack.empty()) {
        const std::size_t b = stack.back();
        stack.pop_back();
        for(std::size_t n : order)
          if(truth[n] == BS::Cover_box::no_component && touch(m_bbox[b], m_bbox[n])) {
            truth[n] = std::uint32_t(s);
            stack.push_back(n);
          }
      }
    }
    std::set<std::uint32_t> seen;
    for(const BS::Cover_box& box : boxes) seen.insert(box.cell);
    for(std::size_t n = 0; n < boxes.size(); ++n) {
      if(boxes[n].component != truth[n]) m_tally.wrong("flood", "wrong component of " + describe_box(n));
      if(truth[n] == BS::Cover_box::no_component) continue;
      for(std::uint32_t c = 0; c < m_shell.field().number_of_cells(); ++c)
        if(!seen.count(c) && touch(m_shell.field().cell(c).bbox(), m_bbox[n]))
          m_tally.wrong("flood", "a cell was not visited next to " + describe_box(n));
    }
  }

  // Checks boxes at the boundary of the domain, in integer arithmetic. If a box touches sides of its root cell, the
  // root cells behind them must exist, or the box must not be in the shell there.
  void check_ends()
  {
    const auto& boxes = m_cover.boxes();
    std::vector<char> is_at_end(boxes.size(), 0);
    for(auto b : m_cover.at_end()) is_at_end[b] = 1;
    const Root_cells& roots = m_shell.field().cells().roots();
    m_tally.count("end", Verdict::PROVED);
    for(std::size_t n = 0; n < boxes.size(); ++n) {
      if(boxes[n].component == BS::Cover_box::no_component) continue;
      const int depth = m_shell.field().cells().level(boxes[n].cell) + boxes[n].depth;
      const Lattice_point p = m_shell.field().cells().lattice_point(boxes[n].cell);
      Lattice_point root;
      std::array<int, 3> first, last;
      for(int a = 0; a < 3; ++a) {
        const int position = p[a] * (1 << boxes[n].depth) + boxes[n].position[a];
        root[a] = position >> depth;
        first[a] = position == root[a] * (1 << depth) ? -1 : 0;
        last[a] = position + 1 == (root[a] + 1) * (1 << depth) ? 1 : 0;
      }
      bool ends = false;
      for(int k = first[2]; k <= last[2]; ++k)
        for(int j = first[1]; j <= last[1]; ++j)
          for(int i = first[0]; i <= last[0]; ++i) {
            if(roots.cell(Lattice_point{ root[0] + i, root[1] + j, root[2] + k }) != Root_cells::npos) continue;
            ends = true;
            if(!is_at_end[n] && is_in_shell_towards({ i, j, k }, n))
              m_tally.wrong("end", "the boundary of the domain was missed at " + describe_box(n));
          }
      if(is_at_end[n] && !ends) m_tally.wrong("end", "no boundary of the domain at " + describe_box(n));
    }
  }

  // Returns whether a face, an edge or a vertex of a box seems to have a point in the shell: the point where the field
  // is farthest from both ends of the shell.
  bool is_in_shell_towards(const std::array<int, 3>& direction, std::size_t n) const
  {
    const auto c = m_cover.boxes()[n].cell;
    if(!m_shell.is_defined(c)) return false;
    double low[3], high[3];
    for(int a = 0; a < 3; ++a) {
      low[a] = direction[a] > 0 ? (m_bbox[n].max)(a) : (m_bbox[n].min)(a);
      high[a] = direction[a] < 0 ? (m_bbox[n].min)(a) : (m_bbox[n].max)(a);
    }
    const auto cell = m_shell.field().cell(c);
    const Place p = worst_place(CGAL::Bbox_3(low[0], low[1], low[2], high[0], high[1], high[2]), [&](const Place& p) {
      const double f = cell.value(p);
      return (std::max)(m_shell.inner().value(p, c) - f, f - m_shell.outer().value(p, c));
    });
    const Jets j = m_shell.jets(c, dyadic(p));
    return j.f.value >= j.inner.value && j.f.value <= j.outer.value;
  }

  void check_gradients()
  {
    if(m_cover.number_of_undecided_boxes() > 0) return;
    const double of_all = m_cover.template least_gradient<CGAL::Sequential_tag>();
    const std::vector<double> of_cells = m_cover.template least_gradients<CGAL::Sequential_tag>();
    const std::size_t stride = m_cover.boxes().size() / 200 + 1;
    for(std::size_t n = std::size_t(m_random.get_int(0, int(stride))); n < m_cover.boxes().size(); n += stride) {
      const BS::Cover_box& box = m_cover.boxes()[n];
      if(box.component == BS::Cover_box::no_component || !m_shell.is_defined(box.cell)) continue;
      const auto cell = m_shell.field().cell(box.cell);
      const Place p = worst_place(m_bbox[n], [&](const Place& p) {
        const double f = cell.value(p);
        if(f < m_shell.inner().value(p, box.cell) || f > m_shell.outer().value(p, box.cell))
          return std::numeric_limits<double>::infinity();
        const auto g = cell.first_order_jet(p).gradient;
        return Vector(g[0], g[1], g[2]).stableNorm();
      });
      const Jets j = m_shell.jets(box.cell, dyadic(p));
      if(j.f.value < j.inner.value || j.f.value > j.outer.value) continue;
      for(double bound : { of_all, of_cells[box.cell] }) {
        bool is_right = std::isfinite(bound);
        if(is_right) {
          const Dyadic least = Dyadic(bound) * j.scale;
          is_right = dot(j.f.gradient, j.f.gradient) >= least * least;
        }
        m_tally.count("least_gradient", is_right, "wrong for " + describe_box(n));
      }
    }
  }

  Tally& m_tally;
  CGAL::Random& m_random;
  const Shell& m_shell;
  Cover m_cover;
  std::vector<CGAL::Bbox_3> m_bbox;
};

#endif // CHECK_COVER_H
