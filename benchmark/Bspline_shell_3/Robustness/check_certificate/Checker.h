// Checks the claims.
#ifndef CHECK_CERTIFICATE_CHECKER_H
#define CHECK_CERTIFICATE_CHECKER_H

#include "Certificate.h"
#include "Mesh.h"
#include "Shell.h"
#include "interval.h"
#include "polynomials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

// Maximum subdivisions of a box of the certificate, and of a part of a triangle that is no larger than the leaves that
// it meets. Parts that are still undecided count as unconfirmed.
const int triangle_levels = 16, box_levels = 4;

inline int sign(const Rational& r)
{
  return r.sign();
}

template <class Number>
std::array<Number, 3> cross(const Point& a, const Point& b, const Point& c)
{
  std::array<Number, 3> u, v;
  for(int i = 0; i < 3; ++i) {
    u[i] = Number(b[i]) - Number(a[i]);
    v[i] = Number(c[i]) - Number(a[i]);
  }
  return { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
}

template <class Number>
Number volume(const Point& a, const Point& b, const Point& c, const Point& d)
{
  const std::array<Number, 3> n = cross<Number>(a, b, c);
  return n[0] * (Number(d[0]) - Number(a[0])) + n[1] * (Number(d[1]) - Number(a[1]))
         + n[2] * (Number(d[2]) - Number(a[2]));
}

// Returns a positive number if d is on the side of (a, b, c) to which (b - a) x (c - a) points.
inline int orientation(const Point& a, const Point& b, const Point& c, const Point& d)
{
  const Interval about = volume<Interval>(a, b, c, d);
  return about.lo > 0 ? 1 : about.hi < 0 ? -1 : sign(volume<Rational>(a, b, c, d));
}

// Returns an enclosure of the facet's normal, which is narrow even for needles.
inline std::array<Interval, 3> normal(const std::array<Point, 3>& t)
{
  std::array<Interval, 3> n = cross<Interval>(t[0], t[1], t[2]);
  double width = 0, length = 0;
  for(const Interval& i : n) {
    width = (std::max)(width, i.hi - i.lo);
    length = (std::max)(length, (std::max)(std::abs(i.lo), std::abs(i.hi)));
  }
  if(width > 1e-12 * length) {
    const std::array<Rational, 3> exact = cross<Rational>(t[0], t[1], t[2]);
    for(int i = 0; i < 3; ++i) n[i] = enclose(exact[i]);
  }
  return n;
}

class Checker
{
public:
  Checker(const Shell& shell, const Mesh& mesh, const Certificate& certificate)
    : shell(shell), mesh(mesh), certificate(certificate), cover(certificate.box.size()), known(shell.leaf.size())
  {}

  void check()
  {
    const std::array<bool, 5>& claimed = certificate.claimed;
    // The arguments for the last three claims require P1.
    for(int i = 2; i < 5; ++i)
      if(claimed[i] && !claimed[0]) throw Unconfirmed("P" + std::to_string(i + 1) + " is claimed without P1");
    if(!mesh.is_closed_and_oriented())
      throw Unconfirmed("The mesh is not closed, or its facets are not oriented consistently");
    if(claimed[0] || claimed[1])
      for(std::size_t f = 0; f < mesh.facet.size(); ++f) check_facet(f);
    if(claimed[2] || claimed[3]) check_boxes();
    if(claimed[4]) check_paths();
  }

private:
  struct Candidate
  {
    Extent extent;
    const Leaf* leaf; // null outside the domain
  };
  typedef std::array<std::array<Integer, 3>, 3> Corners;

  const Splines& splines(const Leaf& l) const
  {
    if(!known[l.number]) known[l.number] = std::make_unique<Splines>(shell.splines(l));
    return *known[l.number];
  }

  // Returns whether, for each leaf, the range of the polynomial form(splines on the leaf) satisfies `holds` on the part
  // of a triangle in the leaf. The part has the given corners, barycentric coordinates in units of 2^-depth. It is
  // subdivided until it is not larger than any leaf that it may meet. These leaves are the candidates; later
  // subdivisions keep the undecided ones.
  template <class Form, class Holds>
  bool holds_on(const std::array<Point, 3>& t, const Form& form, const Holds& holds,
                const Corners& corners = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, int depth = 0,
                int levels = triangle_levels, const std::vector<Candidate>* candidates = nullptr) const
  {
    Triangle corner;
    Extent box;
    Integer widest = 0;
    for(int axis = 0; axis < 3; ++axis) {
      for(int i = 0; i < 3; ++i) {
        Interval x;
        for(int j = 0; j < 3; ++j)
          if(corners[i][j] != 0) x = x + Interval(std::ldexp(double(corners[i][j]), -depth)) * t[j][axis];
        corner[i][axis] = x;
      }
      const Interval cells = shell.lattice_coordinate(
        axis, hull(std::array<Interval, 3>{ corner[0][axis], corner[1][axis], corner[2][axis] }));
      if(!(cells.lo >= double(-largest_index) && cells.hi < double(largest_index))) return false;
      box.low[axis] = Integer(std::floor(cells.lo * double(root_edge)));
      box.high[axis] = Integer(std::ceil(cells.hi * double(root_edge)));
      widest = (std::max)(widest, box.high[axis] - box.low[axis] - 2); // without the effect of rounding
    }

    std::vector<Candidate> undecided;
    bool large = !candidates && widest > root_edge;
    if(candidates) {
      for(const Candidate& c : *candidates)
        if(c.extent.touches(box)) undecided.push_back(c);
    } else if(!large)
      shell.visit_leaves(box, [&](const Cell& c, const Leaf* l) {
        undecided.push_back({ c.extent(), l });
        large = large || (l && widest > l->edge());
      });
    if(large) {
      if(depth == 2 * largest_depth) return false;
    } else {
      undecided.erase(std::remove_if(undecided.begin(), undecided.end(),
                                     [&](const Candidate& c) {
                                       if(!c.leaf) return false; // the part may turn out not to meet it
                                       const Coefficients b = form(splines(*c.leaf));
                                       if(holds(hull(b))) return true;
                                       Triangle local;
                                       for(int i = 0; i < 3; ++i)
                                         for(int axis = 0; axis < 3; ++axis)
                                           local[i][axis] = (corner[i][axis] - c.leaf->corner[axis]) / c.leaf->width;
                                       return holds(range_on_triangle(b, local));
                                     }),
                      undecided.end());
      if(undecided.empty()) return true;
      if(levels-- == 0) return false;
      candidates = &undecided;
    }

    Corners middle, doubled;
    for(int i = 0; i < 3; ++i)
      for(int j = 0; j < 3; ++j) {
        middle[i][j] = corners[(i + 1) % 3][j] + corners[(i + 2) % 3][j];
        doubled[i][j] = 2 * corners[i][j];
      }
    for(const Corners& part :
        { middle, Corners{ doubled[0], middle[2], middle[1] }, Corners{ middle[2], doubled[1], middle[0] },
          Corners{ middle[1], middle[0], doubled[2] } })
      if(!holds_on(t, form, holds, part, depth + 1, levels, candidates)) return false;
    return true;
  }

  // Returns f, or f minus a threshold.
  static Coefficients above(const Splines& s, int threshold)
  {
    return threshold == FIELD ? s[FIELD] : difference(s[FIELD], s[threshold]);
  }

  bool rises_on(const std::array<Point, 3>& t, const std::array<Interval, 3>& direction, int threshold = FIELD) const
  {
    return holds_on(
      t, [&](const Splines& s) { return derivative(above(s, threshold), direction); },
      [](const Interval& r) { return r.lo > 0; });
  }

  // P1 and P2
  void check_facet(std::size_t f) const
  {
    const std::array<Point, 3> t = mesh.triangle(f);
    if(certificate.claimed[0]
       && !(holds_on(
              t, [](const Splines& s) { return above(s, INNER); }, [](const Interval& r) { return r.lo >= 0; })
            && holds_on(
              t, [](const Splines& s) { return above(s, OUTER); }, [](const Interval& r) { return r.hi <= 0; })))
      throw Unconfirmed("P1, facet " + std::to_string(f)
                        + ": cannot confirm that the facet is in the leaves, with f between the thresholds");
    if(certificate.claimed[1] && !rises_on(t, normal(t)))
      throw Unconfirmed("P2, facet " + std::to_string(f)
                        + ": cannot confirm that the gradient makes an acute angle with the normal");
  }

  // Returns whether holds(splines on the part, part) is true for all parts of a box. If it is false, the part is
  // subdivided.
  struct Part
  {
    std::array<double, 3> low = {}; // in edges of the box
    double edge = 1;
  };
  template <class Holds>
  static bool holds_on_part(const Splines& s, const Part& part, const Holds& holds, int levels)
  {
    if(holds(s, part)) return true;
    if(levels == 0) return false;
    for(int octant = 0; octant < 8; ++octant) {
      Splines half = s;
      for(Coefficients& c : half)
        for(int axis = 0; axis < 3; ++axis) halve(c, axis, octant >> axis & 1);
      Part of_part = part;
      of_part.edge /= 2;
      for(int axis = 0; axis < 3; ++axis)
        if(octant >> axis & 1) of_part.low[axis] += of_part.edge;
      if(!holds_on_part(half, of_part, holds, levels - 1)) return false;
    }
    return true;
  }
  Splines splines_on_box(const Box& box) const
  {
    Splines s = splines(shell.leaf[box.leaf]);
    for(Coefficients& c : s)
      for(int d = box.depth - 1; d >= 0; --d)
        for(int axis = 0; axis < 3; ++axis) halve(c, axis, box.place[axis] >> d & 1);
    return s;
  }
  template <class Holds>
  bool holds_on_box(const Box& box, const Holds& holds) const
  {
    return holds_on_part(splines_on_box(box), Part(), holds, box_levels);
  }
  // The same on the face, edge or vertex that a box has in common with a cell. Splines are made constant towards the
  // cell.
  template <class Holds>
  bool holds_towards_cell(const Box& box, const Extent& cell, const Holds& holds) const
  {
    const Extent extent = box.extent(shell);
    Splines s = splines_on_box(box);
    for(int axis = 0; axis < 3; ++axis)
      for(Coefficients& c : s) {
        if(cell.high[axis] == extent.low[axis]) make_constant(c, axis, false);
        if(cell.low[axis] == extent.high[axis]) make_constant(c, axis, true);
      }
    return holds_on_part(s, Part(), holds, box_levels);
  }

  static bool is_excluded(const Splines& s) { return hull(above(s, INNER)).hi < 0 || hull(above(s, OUTER)).lo > 0; }

  // Returns whether f rises along the direction on a whole cube, and is steeper than each threshold that it may equal.
  // This implies grad f . grad (f - threshold) > 0. Numbers are divided by the largest one, so that squares do not
  // underflow.
  static bool is_crossed(const Splines& s, std::array<Interval, 3> direction)
  {
    const double longest = largest_of(direction);
    if(!(longest > 0)) return false;
    for(Interval& d : direction) d = d / longest;
    // |grad f| >= slope / |direction|
    return are_less_steep(s, hull(derivative(s[FIELD], direction)).lo, squared(direction));
  }

  // Returns whether, on a whole cube, f is beyond a threshold at its critical points, and steeper than each threshold
  // that it may equal. With v = (x - center) / 2 and g = f - threshold: if g - v . grad f < 0, then v . grad f > 0
  // wherever g >= 0. For the outer threshold, signs are opposite.
  static bool is_critical_beyond(const Splines& s, int threshold, const std::array<Interval, 3>& center)
  {
    const Interval r = hull(difference(above(s, threshold), along_half_offset(s[FIELD], center)));
    const Interval beyond = threshold == INNER ? Interval(-r.hi) : Interval(r.lo);
    std::array<Interval, 3> farthest;
    for(int axis = 0; axis < 3; ++axis) {
      const Interval other = Interval(1) - center[axis];
      farthest[axis] = Interval((std::max)({ std::abs(center[axis].lo), std::abs(center[axis].hi), std::abs(other.lo),
                                             std::abs(other.hi) }))
                       / 2;
    }
    // |grad f| >= beyond / |v| in the shell
    return are_less_steep(s, beyond, squared(farthest));
  }

  // Returns whether f is steeper than the thresholds that it may equal on a cube. Its slope is at least slope /
  // sqrt(length).
  static bool are_less_steep(const Splines& s, const Interval& slope, const Interval& length)
  {
    if(!(slope.lo > 0)) return false;
    for(int threshold : { INNER, OUTER }) {
      const Interval r = hull(above(s, threshold));
      if(r.lo > 0 || r.hi < 0) continue;
      std::array<Interval, 3> steepest;
      for(int axis = 0; axis < 3; ++axis) {
        std::array<Interval, 3> along;
        along[axis] = 1;
        const Interval g = hull(derivative(s[threshold], along));
        steepest[axis] = (std::max)(std::abs(g.lo), std::abs(g.hi));
      }
      const double unit = (std::max)(slope.lo, largest_of(steepest));
      for(Interval& g : steepest) g = g / unit;
      const Interval part = slope / unit;
      if(!((squared(steepest) * length).hi < (part * part).lo)) return false;
    }
    return true;
  }
  static double largest_of(const std::array<Interval, 3>& v)
  {
    double most = 0;
    for(const Interval& i : v) most = (std::max)(most, (std::max)(std::abs(i.lo), std::abs(i.hi)));
    return most;
  }
  static Interval squared(const std::array<Interval, 3>& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

  // Returns whether the boxes begin..end of a leaf are a partition of it: in octree order, each begins at the end of
  // the previous one.
  bool is_partition(std::size_t begin, std::size_t end) const
  {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> range;
    for(std::size_t n = begin; n < end; ++n) {
      const Box& b = certificate.box[n];
      std::uint64_t code = 0;
      for(int d = largest_depth - 1; d >= 0; --d)
        for(int axis = 0; axis < 3; ++axis)
          code = (code << 1) | (std::uint64_t(b.place[axis]) << (largest_depth - b.depth) >> d & 1);
      range.emplace_back(code, code + (std::uint64_t(1) << 3 * (largest_depth - b.depth)));
    }
    std::sort(range.begin(), range.end());
    std::uint64_t covered = 0;
    for(const auto& r : range) {
      if(r.first != covered) return false;
      covered = r.second;
    }
    return covered == std::uint64_t(1) << 3 * largest_depth;
  }

  // P3 and P4. Omega* is in the cover: each component of A begins in a cover box (at its seed). {EPS1 <= f <= EPS2} is
  // connected to it only through cover boxes. These are surrounded by cover boxes, excluded boxes, and ends of the
  // leaves outside of {EPS1 <= f <= EPS2}.
  void check_boxes()
  {
    const std::vector<Box>& box = certificate.box;
    std::vector<std::size_t> begin(shell.leaf.size() + 1, box.size());
    for(std::size_t n = box.size(); n-- > 0;) begin[box[n].leaf] = n;
    for(std::size_t l = shell.leaf.size(); l-- > 0;) begin[l] = (std::min)(begin[l], begin[l + 1]);

    for(std::size_t l = 0; l < shell.leaf.size(); ++l)
      if(begin[l] < begin[l + 1] && !is_partition(begin[l], begin[l + 1]))
        throw Unconfirmed("P3, leaf " + std::to_string(l) + ": its boxes are not a partition of the leaf");
    for(std::size_t n = 0; n < box.size(); ++n) check_range(n);
    for(std::size_t n = 0; n < box.size(); ++n)
      if(box[n].is_cover()) check_surroundings(n, begin);

    std::vector<std::size_t> root;
    for(std::size_t n = 0; n < box.size(); ++n)
      if(box[n].is_cover() && cover.find(n) == n) root.push_back(n);
    if(root.size() != certificate.covers)
      throw Unconfirmed("P4: the cover has " + std::to_string(root.size()) + " components, but the certificate states "
                        + std::to_string(certificate.covers));
    std::vector<std::size_t> root_of_seed;
    for(std::size_t c = 0; c < mesh.components; ++c) root_of_seed.push_back(cover.find(cover_box_of_seed(c, begin)));
    if(!certificate.claimed[3]) return;
    std::sort(root_of_seed.begin(), root_of_seed.end());
    const bool are_apart = std::adjacent_find(root_of_seed.begin(), root_of_seed.end()) == root_of_seed.end();
    root_of_seed.erase(std::unique(root_of_seed.begin(), root_of_seed.end()), root_of_seed.end());
    if(root_of_seed != root) throw Unconfirmed("P4: a component of the cover contains no component of the mesh");
    // Components of A in the same component of the cover are in different components of Omega*. Without critical
    // points, all curves of a component of Omega* meet each component of A in it equally often, and at least once. So
    // does a path through one of them, which meets A once.
    if(!are_apart && !(certificate.claimed[1] && certificate.claimed[2] && certificate.claimed[4]))
      throw Unconfirmed(
        "P4: a component of the cover contains several components of the mesh, and P2, P3 and P5 are not all claimed");
  }

  // Checks the claim about f on a box.
  void check_range(std::size_t n) const
  {
    const Box& b = certificate.box[n];
    const std::string name = name_of(n);
    if(b.kind == 'x' && !holds_on_box(b, [](const Splines& s, const Part&) { return is_excluded(s); }))
      throw Unconfirmed(name
                        + "cannot confirm that f is below the inner threshold or above the outer one on the whole box");
    if(!certificate.claimed[2]) return;
    if(b.kind == 'u') throw Unconfirmed(name + "the box is undecided");
    const std::array<Interval, 3> direction = { b.proof[0], b.proof[1], b.proof[2] };
    if(b.kind == 'g' && !holds_on_box(b, [&](const Splines& s, const Part&) { return is_crossed(s, direction); }))
      throw Unconfirmed(name
                        + "cannot confirm that f increases along the direction on the whole box, faster than a "
                          "threshold that it meets");
    const auto is_critical = [&](const Splines& s, const Part& part) {
      std::array<Interval, 3> center;
      for(int axis = 0; axis < 3; ++axis) center[axis] = (Interval(b.proof[axis]) - part.low[axis]) / part.edge;
      return is_critical_beyond(s, b.kind == 'b' ? INNER : OUTER, center);
    };
    if((b.kind == 'b' || b.kind == 'a') && !holds_on_box(b, is_critical))
      throw Unconfirmed(name
                        + "cannot confirm that f has no critical point in the shell on the box, and is steeper than a "
                          "threshold that it meets");
  }

  // A cover box must be surrounded by cover boxes and excluded boxes. Where leaves end, f must be beyond a threshold.
  // The box is joined with the cover boxes around it.
  void check_surroundings(std::size_t n, const std::vector<std::size_t>& begin)
  {
    const std::string name = name_of(n);
    const Extent extent = certificate.box[n].extent(shell);
    shell.visit_leaves(extent, [&](const Cell& cell, const Leaf* leaf) {
      if(!leaf) {
        if(!holds_towards_cell(certificate.box[n], cell.extent(),
                               [](const Splines& s, const Part&) { return is_excluded(s); }))
          throw Unconfirmed(
            name + "cannot confirm that f is below the inner threshold or above the outer one where the leaves end");
        return;
      }
      if(begin[leaf->number] == begin[leaf->number + 1])
        throw Unconfirmed(name + "the box touches a leaf without boxes");
      for(std::size_t m = begin[leaf->number]; m < begin[leaf->number + 1]; ++m) {
        const Box& other = certificate.box[m];
        if(other.kind == 'x' || !extent.touches(other.extent(shell))) continue;
        if(other.kind == 'o')
          throw Unconfirmed(name + "the box touches box " + std::to_string(m) + ", for which there is no claim");
        cover.join(n, m);
      }
    });
  }

  std::size_t cover_box_of_seed(std::size_t component, const std::vector<std::size_t>& begin) const
  {
    const std::array<Rational, 3> place = shell.exact_place(mesh.point[certificate.seed[component]]);
    std::size_t found = certificate.box.size();
    shell.visit_leaves(Shell::extent(place), [&](const Cell&, const Leaf* leaf) {
      if(!leaf) return;
      for(std::size_t n = begin[leaf->number]; n < begin[leaf->number + 1]; ++n)
        if(certificate.box[n].is_cover() && Shell::contains(certificate.box[n].extent(shell), place)) found = n;
    });
    if(found == certificate.box.size())
      throw Unconfirmed("P3, component " + std::to_string(component) + ": the seed is not in a cover box");
    return found;
  }

  std::string name_of(std::size_t n) const
  {
    return "P3, box " + std::to_string(n) + " (leaf " + std::to_string(certificate.box[n].leaf) + "): ";
  }

  // P5
  void check_paths() const
  {
    if(certificate.path.size() != mesh.components)
      throw Unconfirmed("P5: the number of paths is not the number of components");
    for(const Path& path : certificate.path) {
      const std::string name = "P5, path " + std::to_string(path.component) + ": ";
      if(mesh.component[mesh.facet[path.facet][0]] != path.component)
        throw Unconfirmed(name + "its facet belongs to another component");
      if(!(shell.value(FIELD, path.p) < shell.value(INNER, path.p)))
        throw Unconfirmed(name + "the path does not begin below the inner threshold");
      if(!(shell.value(FIELD, path.q) > shell.value(OUTER, path.q)))
        throw Unconfirmed(name + "the path does not end above the outer threshold");
      std::array<Interval, 3> direction;
      for(int i = 0; i < 3; ++i) direction[i] = Interval(path.q[i]) - Interval(path.p[i]);
      for(int threshold : { FIELD, INNER, OUTER })
        if(!rises_on({ path.p, path.q, path.q }, direction, threshold))
          throw Unconfirmed(name
                            + "cannot confirm that the path is in the leaves, and that f and its distances from the "
                              "thresholds increase along it");
      int count = 0;
      bool crosses = false; // the path's own facet
      for(std::size_t f = 0; f < mesh.facet.size(); ++f) {
        const int crossing = cross_facet(path, mesh.triangle(f), name + "at facet " + std::to_string(f));
        count += crossing;
        crosses = crosses || (f == path.facet && crossing != 0);
      }
      if(count != 1) throw Unconfirmed(name + "the path crosses the mesh with count " + std::to_string(count));
      if(!crosses) throw Unconfirmed(name + "the path does not cross its facet");
    }
  }

  // Returns 1 if the path passes through the interior of the facet to its positive side, -1 if to its negative side,
  // and 0 if they are disjoint.
  static int cross_facet(const Path& path, const std::array<Point, 3>& t, const std::string& name)
  {
    for(int axis = 0; axis < 3; ++axis) {
      const auto range = std::minmax({ t[0][axis], t[1][axis], t[2][axis] });
      if((std::max)(path.p[axis], path.q[axis]) < range.first || (std::min)(path.p[axis], path.q[axis]) > range.second)
        return 0;
    }
    const int at_p = orientation(t[0], t[1], t[2], path.p), at_q = orientation(t[0], t[1], t[2], path.q);
    if(at_p * at_q > 0) return 0;
    bool left = false, right = false, on = at_p * at_q == 0; // sides on which the edges pass the line of the path
    for(int i = 0; i < 3; ++i) {
      const int side = orientation(path.p, path.q, t[i], t[(i + 1) % 3]);
      (side > 0 ? left : side < 0 ? right : on) = true;
    }
    if(left && right) return 0;
    if(on) throw Unconfirmed(name + ", the path does not pass through the interior of the facet");
    return at_q;
  }

  const Shell& shell;
  const Mesh& mesh;
  const Certificate& certificate;
  Disjoint_sets cover;
  mutable std::vector<std::unique_ptr<const Splines>> known; // cached splines of leaves
};

#endif // CHECK_CERTIFICATE_CHECKER_H
