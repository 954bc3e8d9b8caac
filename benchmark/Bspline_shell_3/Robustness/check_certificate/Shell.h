// The shell: its leaves with their splines, the triangles that close the user's mesh, and the truncation of its tips.
#ifndef CHECK_CERTIFICATE_SHELL_H
#define CHECK_CERTIFICATE_SHELL_H

#include "Reader.h"
#include "Truncation.h"
#include "interval.h"
#include "polynomials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

typedef std::array<Integer, 3> Position;

// Bounds of lattice positions, levels of leaves and depths of boxes. With them, corners of boxes are exact integers.
// The unit is a cell of level 0, halved largest_level + largest_depth times.
const Integer largest_index = 1 << 20;
const int largest_level = 10, largest_depth = 20;
const Integer root_edge = Integer(1) << (largest_level + largest_depth);

// A closed box with corners in this unit.
struct Extent
{
  Position low, high;

  bool touches(const Extent& other) const
  {
    bool touch = true;
    for(int axis = 0; axis < 3; ++axis) touch = touch && low[axis] <= other.high[axis] && other.low[axis] <= high[axis];
    return touch;
  }
};

// A cube of the lattice of a level.
struct Cell
{
  int level;
  Position position;

  Integer edge() const { return root_edge >> level; }
  Extent extent() const
  {
    Extent e;
    for(int axis = 0; axis < 3; ++axis) {
      e.low[axis] = position[axis] * edge();
      e.high[axis] = e.low[axis] + edge();
    }
    return e;
  }
  Cell parent() const
  {
    Cell p = { level - 1, position };
    for(Integer& i : p.position) i = (i - (i & 1)) / 2;
    return p;
  }
  Cell child(int number) const
  {
    Cell c = { level + 1, position };
    for(int axis = 0; axis < 3; ++axis) c.position[axis] = 2 * c.position[axis] + (number >> axis & 1);
    return c;
  }
};

inline bool in_range(const Position& p)
{
  return std::all_of(p.begin(), p.end(), [](Integer i) { return i >= -largest_index && i < largest_index; });
}

// Returns the key of a position in range.
inline std::uint64_t key(const Position& p)
{
  std::uint64_t k = 0;
  for(int axis = 2; axis >= 0; --axis) k = (k << 21) | std::uint64_t(p[axis] + largest_index);
  return k;
}

// f, EPS1 and EPS2
enum Spline
{
  FIELD,
  INNER,
  OUTER
};
typedef std::array<Coefficients, 3> Splines; // on a leaf or a part of it

struct Leaf : Cell
{
  std::size_t number;
  double width;
  std::array<Interval, 3> corner;
};

class Shell
{
public:
  explicit Shell(const std::string& name)
  {
    const std::string text = read_file(name);
    Reader in(name, text, true);
    in.expect("cubic_bspline_shell");
    in.integer(5, 5); // the version
    in.expect("ascii").end_line();
    in.expect("unit");
    if(!(in.number() > 0)) in.fail("the unit is not positive");
    in.end_line();
    const std::string thresholds = in.word();
    constant = thresholds == "levels";
    if(!constant && thresholds != "thickness") in.fail("expected \"levels\" or \"thickness\"");
    if(constant) {
      level[0] = in.number();
      level[1] = in.number();
      if(!(level[0] < level[1])) in.fail("the levels are not in ascending order");
    } else in.number();
    in.end_line();
    in.expect("triangles").integer(0, (std::numeric_limits<Integer>::max)());
    in.expect("components").integer(0, (std::numeric_limits<Integer>::max)());
    in.end_line();
    const std::string kind = in.expect("field").word();
    if(kind != "uniform" && kind != "hierarchical")
      in.fail("unknown kind of field: expected \"uniform\" or \"hierarchical\"");
    const int last_level = kind == "uniform" ? 0 : largest_level;
    origin = in.point();
    spacing = in.number();
    if(!(spacing >= 1 / largest)) in.fail("the spacing is less than 1e-60");
    in.end_line();
    const Integer functions = count(in, "functions");
    for(Integer n = 0; n < functions; ++n) {
      const Cell at = cell(in, last_level);
      if(n > 0
         && !(at.level < function_cell.back().level
              || (at.level == function_cell.back().level && key(at.position) > key(function_cell.back().position))))
        in.fail("the functions are not in order");
      function_of[at.level].emplace(key(at.position), function_cell.size());
      function_cell.push_back(at);
      for(int spline = 0; spline < (constant ? 1 : 3); ++spline) coefficient[spline].push_back(in.number());
      in.end_line();
    }
    const Integer leaves = count(in, "leaves");
    for(Integer n = 0; n < leaves; ++n) {
      Leaf l;
      static_cast<Cell&>(l) = cell(in, last_level);
      in.integer(0, 1);
      if(n > 0
         && !(l.level > leaf.back().level
              || (l.level == leaf.back().level && key(l.position) > key(leaf.back().position))))
        in.fail("the leaves are not in order");
      l.number = leaf.size();
      l.width = std::ldexp(spacing, -l.level);
      for(int axis = 0; axis < 3; ++axis)
        l.corner[axis] = Interval(origin[axis]) + Interval(double(l.position[axis])) * l.width;
      leaf_of[l.level].emplace(key(l.position), leaf.size());
      leaf.push_back(l);
      in.end_line();
    }
    const Integer ranges = count(in, "facet_ranges");
    for(Integer n = 0; n < ranges; ++n) {
      const double least = in.number();
      if(!(least <= in.number())) in.fail("a facet range is empty");
      in.end_line();
    }
    read_closing(in);
    const Integer paths = count(in, "paths"); // candidates; not used by any claim
    for(Integer n = 0; n < paths; ++n) {
      in.integer(0, (std::numeric_limits<Integer>::max)());
      in.point();
      in.point();
      in.end_line();
    }
    in.expect("truncation").end_line();
    truncation.emplace(in);
    if(truncation->is_empty()) truncation.reset();
    in.end_file();
    checksum = in.checksum;
    check_leaves();
    check_smoothness();
  }

  // Calls visit(cell, leaf) for the leaves that the box touches, and visit(cell, nullptr) for touched cells outside the
  // domain.
  template <class Visit>
  void visit_leaves(const Extent& box, const Visit& visit) const
  {
    Position first, last, p;
    for(int axis = 0; axis < 3; ++axis) {
      first[axis] = floor_quotient(box.low[axis] - 1, root_edge);
      last[axis] = floor_quotient(box.high[axis], root_edge);
    }
    for(p[2] = first[2]; p[2] <= last[2]; ++p[2])
      for(p[1] = first[1]; p[1] <= last[1]; ++p[1])
        for(p[0] = first[0]; p[0] <= last[0]; ++p[0]) visit_leaves_in(Cell{ 0, p }, box, visit);
  }

  // Returns f, EPS1 and EPS2 on a leaf.
  Splines splines(const Leaf& l) const
  {
    Splines s;
    for(int spline = 0; spline < 3; ++spline) {
      if(spline != FIELD && constant) {
        s[spline].fill(level[spline - 1]);
        continue;
      }
      std::array<Interval, 64> c;
      for(int n = 0; n < 64; ++n) c[n] = function_coefficient<Interval>(spline, acting(l, n));
      s[spline] = bernstein(c);
    }
    return s;
  }

  // Returns the exact value of a spline at a point.
  Rational value(int spline, const Point& p) const
  {
    if(spline != FIELD && constant) return level[spline - 1];
    const std::array<Rational, 3> place = exact_place(p);
    const Leaf* l = nullptr;
    visit_leaves(extent(place), [&](const Cell& c, const Leaf* there) {
      if(there && contains(c.extent(), place)) l = there;
    });
    if(!l) throw Unconfirmed("A point is not in any leaf");
    std::array<std::array<Rational, 4>, 3> weight;
    for(int axis = 0; axis < 3; ++axis) {
      const Rational t = place[axis] / l->edge() - l->position[axis], s = 1 - t;
      weight[axis] = { s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
                       t * t * t / 6 };
    }
    Rational sum = 0;
    for(int n = 0; n < 64; ++n)
      sum += function_coefficient<Rational>(spline, acting(*l, n)) * weight[0][n % 4] * weight[1][n / 4 % 4]
             * weight[2][n / 16];
    return sum;
  }

  // Returns a coordinate in edges of cells of level 0.
  Interval lattice_coordinate(int axis, const Interval& x) const { return (x - origin[axis]) / spacing; }

  // Return a point in the units of extents, and a box around it.
  std::array<Rational, 3> exact_place(const Point& p) const
  {
    std::array<Rational, 3> place;
    for(int axis = 0; axis < 3; ++axis)
      place[axis] = (Rational(p[axis]) - Rational(origin[axis])) / Rational(spacing) * root_edge;
    return place;
  }
  static Extent extent(const std::array<Rational, 3>& place)
  {
    Extent e;
    for(int axis = 0; axis < 3; ++axis) {
      const Interval about = enclose(place[axis]);
      const double most = double(largest_index) * double(root_edge);
      if(!(about.lo >= -most && about.hi <= most)) throw Unconfirmed("A point is not in any leaf");
      e.low[axis] = Integer(std::floor(about.lo));
      e.high[axis] = Integer(std::ceil(about.hi));
    }
    return e;
  }
  static bool contains(const Extent& e, const std::array<Rational, 3>& place)
  {
    bool inside = true;
    for(int axis = 0; axis < 3; ++axis) inside = inside && place[axis] >= e.low[axis] && place[axis] <= e.high[axis];
    return inside;
  }

  std::vector<Leaf> leaf;
  // Triangles that close an open mesh. The mesh of the certificate contains them; its claims do not depend on this
  // list.
  std::vector<Located_facet> closing;
  std::optional<Truncation> truncation;
  std::string checksum;

private:
  void read_closing(Reader& in)
  {
    const Integer points = in.expect("closing").integer(0, (std::numeric_limits<Integer>::max)());
    in.integer(0, points);
    const Integer triangles = in.integer(0, (std::numeric_limits<Integer>::max)());
    in.end_line();
    std::vector<Point> point;
    for(Integer n = 0; n < points; ++n) {
      point.push_back(in.point());
      in.end_line();
    }
    for(Integer n = 0; n < triangles; ++n) {
      std::array<Point, 3> t;
      for(Point& p : t) p = point[std::size_t(in.integer(0, points - 1))];
      closing.push_back(located(t[0], t[1], t[2]));
      in.integer(0, 1);
      in.end_line();
    }
  }

  static Integer count(Reader& in, const char* what)
  {
    const Integer n = in.expect(what).integer(0, 1 << 30);
    in.end_line();
    return n;
  }
  // Reads a cell whose neighborhood is in range.
  static Cell cell(Reader& in, int last_level)
  {
    Cell c;
    c.level = int(in.integer(0, last_level));
    for(Integer& i : c.position) i = in.integer(-largest_index + 4, largest_index - 5);
    return c;
  }
  static Integer floor_quotient(Integer n, Integer d) { return n / d - (n % d < 0); }

  template <class Visit>
  void visit_leaves_in(const Cell& c, const Extent& box, const Visit& visit) const
  {
    if(!c.extent().touches(box)) return;
    if(const Leaf* l = find(c)) return visit(c, l);
    if(!is_split(c)) return visit(c, nullptr);
    for(int number = 0; number < 8; ++number) visit_leaves_in(c.child(number), box, visit);
  }

  const Leaf* find(const Cell& c) const
  {
    if(!in_range(c.position)) return nullptr;
    const auto found = leaf_of[c.level].find(key(c.position));
    return found == leaf_of[c.level].end() ? nullptr : &leaf[found->second];
  }
  bool is_split(const Cell& c) const { return in_range(c.position) && split[c.level].count(key(c.position)) != 0; }
  bool is_listed(const Cell& function) const
  {
    return in_range(function.position) && function_of[function.level].count(key(function.position)) != 0;
  }

  // Returns the n-th of the 64 functions that act on a cell.
  static Cell acting(const Cell& c, int n)
  {
    return { c.level, { c.position[0] - 1 + n % 4, c.position[1] - 1 + n / 4 % 4, c.position[2] - 1 + n / 16 } };
  }

  // Calls visit(parent, weight) for the terms of the two-scale relation.
  template <class Visit>
  static void visit_parents(const Cell& function, const Visit& visit)
  {
    const double weight[] = { 0.75, 0.5, 0.125 }; // by the distance of both points
    const Position nearest = function.parent().position;
    for(int n = 0; n < 27; ++n) {
      const Cell parent = { function.level - 1,
                            { nearest[0] - 1 + n % 3, nearest[1] - 1 + n / 3 % 3, nearest[2] - 1 + n / 9 } };
      double product = 1;
      for(int axis = 0; axis < 3; ++axis) {
        const Integer away = std::abs(function.position[axis] - 2 * parent.position[axis]);
        product *= away < 3 ? weight[away] : 0;
      }
      if(product != 0) visit(parent, product);
    }
  }

  // Returns the listed coefficient, or computes it from the level above.
  template <class Number>
  Number function_coefficient(int spline, const Cell& function) const
  {
    const auto found = function_of[function.level].find(key(function.position));
    if(found != function_of[function.level].end()) return Number(coefficient[spline][found->second]);
    Number sum = 0;
    visit_parents(function, [&](const Cell& parent, double weight) {
      sum = sum + Number(weight) * Number(coefficient[spline][function_of[parent.level].at(key(parent.position))]);
    });
    return sum;
  }

  // Checks that leaves do not overlap.
  void check_leaves()
  {
    for(const Leaf& l : leaf)
      for(Cell c = l; c.level > 0;) {
        c = c.parent();
        if(!split[c.level].insert(key(c.position)).second) break; // its ancestors are already there
      }
    for(const Leaf& l : leaf)
      if(is_split(l)) throw Malformed("Leaf " + std::to_string(l.number) + " overlaps another leaf");
  }

  // Checks that the leaves' polynomials agree up to second derivatives wherever leaves touch. Leaves of one level share
  // their coefficients. Functions that also act on a coarser leaf are not listed. So on common faces, the finer level
  // follows from the coarser one by the two-scale relation, whose terms are listed.
  void check_smoothness() const
  {
    for(const Cell& function : function_cell)
      for(int n = 0; n < 64; ++n) {
        Cell c = { function.level,
                   { function.position[0] - 2 + n % 4, function.position[1] - 2 + n / 4 % 4,
                     function.position[2] - 2 + n / 16 } };
        while(c.level > 0) {
          c = c.parent();
          if(find(c))
            throw Malformed("A function of level " + std::to_string(function.level) + " acts on a coarser leaf");
        }
      }
    for(const Leaf& l : leaf)
      for(int n = 0; n < 64; ++n) {
        const Cell function = acting(l, n);
        bool known = is_listed(function);
        if(!known && l.level > 0) {
          known = true;
          visit_parents(function, [&](const Cell& parent, double) { known = known && is_listed(parent); });
        }
        if(!known)
          throw Malformed("Leaf " + std::to_string(l.number) + ": a function that acts on it has no coefficient");
      }
  }

  Point origin;
  double spacing = 0;
  bool constant = true;
  std::array<double, 2> level;     // values of constant thresholds
  std::vector<Cell> function_cell; // cells at the functions' points
  std::array<std::vector<double>, 3> coefficient;
  std::array<std::unordered_map<std::uint64_t, std::size_t>, largest_level + 1> function_of, leaf_of;
  std::array<std::unordered_set<std::uint64_t>, largest_level + 1> split;
};

#endif // CHECK_CERTIFICATE_SHELL_H
