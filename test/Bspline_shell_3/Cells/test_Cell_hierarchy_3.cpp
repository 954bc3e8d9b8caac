// Cells of different sizes. Refinement is compared with the least set that its rules require, and look-up with searches
// through all leaves.
#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include "random_hierarchies.h"

#include <CGAL/Exact_rational.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace test_Cell_hierarchy_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_rational Rational;
typedef std::array<double, 3> Point;
typedef Hierarchy::Index Index;
typedef std::set<std::pair<int, Lattice_point> > Split_cells;

const double inf = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

// The spacing is not a power of two, and the origin is not a corner of a cell by coincidence.
const BS::Lattice_3 lattice(CGAL::Bbox_3(9, -1, -4, 11, 2, 1), 0.3);

// Returns cells of three levels, with holes and negative coordinates.
Hierarchy some_hierarchy(unsigned seed)
{
  CGAL::Random random(seed);
  return random_hierarchy(random, some_cells(random, lattice, { -6, -3, -4 }, { 4, 2, 1 }, seed % 2 ? 1 : 0.8), 3);
}

Split_cells split_cells(const Hierarchy& cells)
{
  Split_cells split;
  for(int l = 0; l < cells.number_of_levels(); ++l)
    for(Index n = 0; n < cells.cells(l).size(); ++n)
      if(cells.leaf(l, cells.cells(l).point(n)) == Hierarchy::npos) split.insert({ l, cells.cells(l).point(n) });
  return split;
}

Lattice_point parent(Lattice_point p)
{
  for(int& i : p) i = int(std::floor(i / 2.));
  return p;
}

template <typename Visitor>
void for_each_around(const Lattice_point& p, int rings, const Visitor& visit)
{
  for(int k = -rings; k <= rings; ++k)
    for(int j = -rings; j <= rings; ++j)
      for(int i = -rings; i <= rings; ++i) visit(Lattice_point{ p[0] + i, p[1] + j, p[2] + k });
}

bool has_root(const Hierarchy& cells, int level, Lattice_point p)
{
  for(; level > 0; --level) p = parent(p);
  return cells.roots().cell(p) != Hierarchy::npos;
}

// Returns the least set of split cells that contains the marked cells and the rings around them, and is closed under
// grading: the parents of all cells in three rings around a split cell are split.
Split_cells least_split_cells(const Hierarchy& cells, const std::vector<Index>& leaves, int rings)
{
  Split_cells split = split_cells(cells);
  std::vector<std::pair<int, Lattice_point> > stack(split.begin(), split.end());
  const auto insert = [&](int l, const Lattice_point& p) {
    if(has_root(cells, l, p) && split.insert({ l, p }).second) stack.push_back({ l, p });
  };
  for(Index c : leaves)
    if(cells.level(c) < cells.max_level())
      for_each_around(cells.lattice_point(c), rings, [&](const Lattice_point& p) { insert(cells.level(c), p); });
  while(!stack.empty()) {
    const std::pair<int, Lattice_point> cell = stack.back();
    stack.pop_back();
    if(cell.first > 0)
      for_each_around(cell.second, 3, [&](const Lattice_point& p) {
        if(has_root(cells, cell.first, p)) insert(cell.first - 1, parent(p));
      });
  }
  return split;
}

bool meets(const Hierarchy& cells, Index c, const CGAL::Bbox_3& box)
{
  for(int a = 0; a < 3; ++a)
    if(cells.corner(c)[a] > (box.max)(a) || cells.corner(c)[a] + cells.width(c) < (box.min)(a)) return false;
  return true;
}

CGAL::Bbox_3 box_at(const Point& p)
{
  return CGAL::Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
}

std::vector<Index> leaves_that_meet(const Hierarchy& cells, const CGAL::Bbox_3& box)
{
  std::vector<Index> found;
  for(Index c = 0; c < cells.number_of_cells(); ++c)
    if(meets(cells, c, box)) found.push_back(c);
  return found;
}

std::vector<Index> visited(const Hierarchy& cells, const CGAL::Bbox_3& box, bool& covered)
{
  std::vector<Index> found;
  covered = cells.visit_cells(box, [&](Index c) { found.push_back(c); });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Index> neighbors(const Hierarchy& cells, Index c, int axis, bool positive, bool& any)
{
  std::vector<Index> found;
  any = cells.visit_neighbors(c, axis, positive, [&](Index n) { found.push_back(n); });
  std::sort(found.begin(), found.end());
  return found;
}

// Refines the leaf around a point `times` times, or as often as possible.
Hierarchy refined_at(Hierarchy cells, const Point& p, int times)
{
  for(int n = 0; n < times; ++n) cells = cells.refined({ cells.locate(p) });
  return cells;
}

} // namespace

TEST_CASE("Hierarchy: leaves tile the root cells, and are numbered from coarse to fine")
{
  for(unsigned seed = 1; seed <= 4; ++seed) {
    const Hierarchy cells = some_hierarchy(seed);
    REQUIRE(cells.number_of_levels() == 3);
    const Smallest_cells smallest(cells);
    CHECK(smallest.overlaps == 0);
    CHECK(smallest.covered == 64 * cells.roots().number_of_cells());
    std::size_t outside = 0, wrong = 0;
    int leaves_of_level[3] = { 0, 0, 0 };
    for(Index c = 0; c < cells.number_of_cells(); ++c) {
      const int l = cells.level(c);
      ++leaves_of_level[l];
      outside += !has_root(cells, l, cells.lattice_point(c));
      wrong += c > 0 && cells.level(c - 1) > l;
      wrong += cells.leaf(l, cells.lattice_point(c)) != c;
      wrong += cells.cells(l).index(cells.lattice_point(c)) == Hierarchy::npos;
      wrong += !cells.is_in_domain(l, cells.lattice_point(c));
      wrong += cells.width(c) != lattice.spacing() / (1 << l);
      for(int a = 0; a < 3; ++a)
        wrong += Rational(cells.corner(c)[a])
                 != Rational(lattice.origin()[a]) + cells.lattice_point(c)[a] * Rational(lattice.spacing()) / (1 << l);
    }
    CHECK(outside == 0);
    CHECK(wrong == 0);
    for(int n : leaves_of_level) CHECK(n > 0);
    CHECK(cells.first_leaf(0) == 0);
    CHECK(int(cells.first_leaf(1)) == leaves_of_level[0]);
    CHECK(int(cells.first_leaf(2)) == leaves_of_level[0] + leaves_of_level[1]);
    // A cell of a level, split or not, contains a leaf; a split cell has children.
    for(const std::pair<int, Lattice_point>& s : split_cells(cells))
      wrong += !has_root(cells, s.first, s.second) || cells.level(smallest.leaf(s.first, s.second)) <= s.first;
    CHECK(wrong == 0);
    for(int l = 0; l < 3; ++l) CHECK(cells.leaf(l, { 1000, 0, 0 }) == Hierarchy::npos);
  }
}

TEST_CASE("Hierarchy: without splits, the leaves are the root cells")
{
  CGAL::Random random(5);
  const Root_cells roots = some_cells(random, lattice, { -2, -3, -1 }, { 2, 1, 1 }, 0.7);
  const Hierarchy cells(roots);
  REQUIRE(cells.number_of_cells() == roots.number_of_cells());
  CHECK(cells.number_of_levels() == 1);
  CHECK(cells.is_exact());
  for(Index c = 0; c < cells.number_of_cells(); ++c) {
    CHECK(cells.lattice_point(c) == roots.lattice_point(c));
    CHECK(cells.corner(c) == roots.corner(c));
  }
  CHECK(cells.refined({}).number_of_cells() == roots.number_of_cells());
  const Hierarchy none;
  CHECK(none.number_of_cells() == 0);
  CHECK(none.refined({}).number_of_cells() == 0);
  CHECK(none.locate(Point{ 0, 0, 0 }) == Hierarchy::npos);
  CHECK_FALSE(none.visit_cells(CGAL::Bbox_3(0, 0, 0, 1, 1, 1), [](Index) {}));
}

TEST_CASE(
  "Hierarchy: refinement splits the marked leaves, rings around them, and cells required by the grading, no others")
{
  for(unsigned seed = 6; seed <= 9; ++seed) {
    CGAL::Random random(seed);
    Hierarchy cells(some_cells(random, lattice, { -6, -3, -3 }, { 5, 2, 1 }, seed % 2 ? 1 : 0.85));
    for(int round = 0; round < 4; ++round) {
      // leaves of all sizes; one of them twice
      std::vector<Index> leaves = random_leaves(random, cells, 1);
      leaves.push_back(Index(random.get_int(0, int(cells.number_of_cells()))));
      leaves.push_back(leaves.front());
      const int rings = 1 + round % 2;
      const Split_cells expected = least_split_cells(cells, leaves, rings), before = split_cells(cells);
      const Hierarchy finer = cells.refined(leaves, rings);
      const Split_cells split = split_cells(finer);
      CAPTURE(seed, round);
      CHECK(split == expected);
      CHECK(std::includes(split.begin(), split.end(), before.begin(), before.end()));
      CHECK(split.size() > before.size());
      // The rules, checked directly: the rings around marked cells are split, and three rings of cells of the same size
      // surround each split cell.
      std::size_t missing = 0, wrong = 0;
      for(Index c : leaves)
        for_each_around(cells.lattice_point(c), rings, [&](const Lattice_point& p) {
          if(has_root(cells, cells.level(c), p)) missing += split.count({ cells.level(c), p }) == 0;
        });
      for(const std::pair<int, Lattice_point>& s : split)
        for_each_around(s.second, 3, [&](const Lattice_point& p) {
          wrong += finer.is_in_domain(s.first, p) != has_root(finer, s.first, p);
          if(has_root(finer, s.first, p)) missing += finer.cells(s.first).index(p) == Hierarchy::npos;
        });
      CHECK(missing == 0);
      CHECK(wrong == 0);
      cells = finer;
    }
    CHECK(cells.number_of_levels() > 3);
  }
}

TEST_CASE("Hierarchy: a point is located in a closed leaf that contains it")
{
  for(unsigned seed = 10; seed <= 12; ++seed) {
    const Hierarchy cells = some_hierarchy(seed);
    const Smallest_cells smallest(cells);
    CGAL::Random random(seed);
    int inside = 0, outside = 0, on_several = 0;
    for(int n = 0; n < 1500; ++n) {
      // multiples of half a smallest cell: corners, edges, faces, and points beyond the ends
      Point p;
      for(int a = 0; a < 3; ++a) {
        const int i = random.get_int(2 * smallest.first()[a] - 4, 2 * smallest.last()[a] + 6);
        p[a] = lattice.origin()[a] + i * (lattice.spacing() / 8);
        if(n % 4 == 3) p[a] = std::nextafter(p[a], n % 8 == 3 ? inf : -inf);
      }
      const std::vector<Index> expected = leaves_that_meet(cells, box_at(p));
      const Index c = cells.locate(p);
      if(expected.empty()) {
        ++outside;
        CHECK(c == Hierarchy::npos);
        continue;
      }
      ++inside;
      on_several += expected.size() > 1;
      CHECK(std::count(expected.begin(), expected.end(), c) == 1);
    }
    CHECK(inside > 300);
    CHECK(outside > 100);
    CHECK(on_several > 200);
    for(double x : { not_a_number, inf, -inf, 1e300, -1e9 }) CHECK(cells.locate(Point{ 10, x, -1 }) == Hierarchy::npos);
  }
}

TEST_CASE("Hierarchy: a box meets the leaves found by a search, each once, and is covered if the root cells cover it")
{
  for(unsigned seed = 13; seed <= 15; ++seed) {
    const Hierarchy cells = some_hierarchy(seed);
    const Smallest_cells smallest(cells);
    CGAL::Random random(seed);
    const double unit = lattice.spacing() / 8;
    int covered_boxes = 0, uncovered_boxes = 0, flat_boxes = 0;
    for(int n = 0; n < 1200; ++n) {
      Point least, most;
      for(int a = 0; a < 3; ++a) {
        // ends between cells and inside them; some boxes are flat, segments, or points
        const int i = random.get_int(2 * smallest.first()[a] - 2, 2 * smallest.last()[a] + 4),
                  w = random.get_int(0, 12);
        least[a] = lattice.origin()[a] + i * unit;
        most[a] = least[a] + (n % 3 == 0 ? 0 : w) * unit;
        if(n % 5 == 0) most[a] = std::nextafter(most[a], inf);
        if(n % 5 == 1) least[a] = std::nextafter(least[a], -inf);
        if(n % 5 == 2 && most[a] > least[a]) least[a] = std::nextafter(least[a], inf);
      }
      const CGAL::Bbox_3 box(least[0], least[1], least[2], most[0], most[1], most[2]);
      bool covered;
      CHECK(visited(cells, box, covered) == leaves_that_meet(cells, box));
      CHECK(covered == cells.roots().visit_cells(box, [](Index) {}));
      ++(covered ? covered_boxes : uncovered_boxes);
      flat_boxes += covered && (least[0] == most[0] || least[1] == most[1] || least[2] == most[2]);
    }
    CHECK(covered_boxes > 200);
    CHECK(uncovered_boxes > 100);
    CHECK(flat_boxes > 50);
    for(const CGAL::Bbox_3& box :
        { CGAL::Bbox_3(-inf, -inf, -inf, inf, inf, inf), CGAL::Bbox_3(-1e300, -1e300, -1e300, 1e300, 1e300, 1e300) }) {
      bool covered;
      CHECK(visited(cells, box, covered).size() == cells.number_of_cells());
      CHECK_FALSE(covered);
    }
    for(const CGAL::Bbox_3& box :
        { CGAL::Bbox_3(), CGAL::Bbox_3(not_a_number, 0, 0, 1, 1, 1), CGAL::Bbox_3(inf, 0, 0, inf, 1, 1) }) {
      bool covered;
      CHECK(visited(cells, box, covered).empty());
      CHECK_FALSE(covered);
    }
  }
}

TEST_CASE("Hierarchy: neighbors are exactly the leaves that share part of a face, and the relation is symmetric")
{
  for(unsigned seed = 16; seed <= 18; ++seed) {
    const Hierarchy cells = some_hierarchy(seed);
    const Smallest_cells smallest(cells);
    int ends = 0, same = 0, smaller = 0, larger = 0;
    std::size_t wrong = 0;
    for(Index c = 0; c < cells.number_of_cells(); ++c)
      for(int a = 0; a < 3; ++a)
        for(bool positive : { false, true }) {
          // the leaves that contain the smallest cells beyond the face
          std::set<Index> expected;
          bool outside = false;
          const int s = smallest.size(cells.level(c));
          Lattice_point p = smallest.begin(cells, c);
          p[a] += positive ? s : -1;
          for(int i = 0; i < s; ++i)
            for(int j = 0; j < s; ++j) {
              Lattice_point q = p;
              q[(a + 1) % 3] += i;
              q[(a + 2) % 3] += j;
              if(smallest.leaf(q) == Hierarchy::npos) outside = true;
              else expected.insert(smallest.leaf(q));
            }
          bool any;
          const std::vector<Index> found = neighbors(cells, c, a, positive, any);
          wrong += found != std::vector<Index>(expected.begin(), expected.end());
          wrong += any != !expected.empty();
          wrong += outside && any; // all of a face is inside the domain, or none of it
          if(!any) {
            ++ends;
            continue;
          }
          for(Index n : found) {
            ++(cells.level(n) == cells.level(c) ? same : cells.level(n) > cells.level(c) ? smaller : larger);
            const std::vector<Index> back = neighbors(cells, n, a, !positive, any);
            wrong += std::count(back.begin(), back.end(), c) != 1;
          }
        }
    CHECK(wrong == 0);
    CHECK(ends > 100);
    CHECK(same > 100);
    CHECK(smaller > 100);
    CHECK(larger == smaller);
  }
}

TEST_CASE("Hierarchy: corners of the smallest leaves are doubles, even after eight more halvings")
{
  CGAL::Random random(19);
  std::vector<int> levels;
  for(double far : { 0., 1e3, 1e6 }) {
    const Point p = { far + 0.123, -far - 0.456, 0.789 };
    const BS::Lattice_3 around(CGAL::Bbox_3(far - 2, -far - 2, -2, far + 2, -far + 2, 2), 0.7);
    const Hierarchy cells = refined_at(Hierarchy(some_cells(random, around, { -4, -4, -4 }, { 4, 4, 4 })), p, 20);
    REQUIRE(cells.is_exact());
    levels.push_back(cells.max_level());
    CHECK(cells.number_of_levels() == cells.max_level() + 1);
    CHECK(cells.max_level() >= 4);
    std::size_t wrong = 0;
    for(Index c = 0; c< cells.number_of_cells(); c += cells.level(c) > 3 ? 1 : 7) {
      const double w = cells.width(c);
      wrong += Rational(w) != Rational(around.spacing()) / (1 << cells.level(c));
      for(int a = 0; a < 3; ++a) {
        const Rational exact = Rational(around.origin()[a]) + Rational(w) * cells.lattice_point(c)[a];
        wrong += Rational(cells.corner(c)[a]) != exact;
        for(int i : { 1, 85, 255, 256 })
          wrong += Rational(cells.corner(c)[a] + i * (w / 256)) != exact + i * Rational(w) / 256;
      }
    }
    CHECK(wrong == 0);
    CHECK(cells.level(cells.locate(p)) == cells.max_level());
  }
  CHECK(levels.front() == 10);
  CHECK(levels.back() < 10); // where coordinates are large, bits suffice for fewer levels
}

TEST_CASE("Hierarchy: leaves of the last level are not split, and fewer levels exist far from the lattice's origin")
{
  CGAL::Random random(20);
  const BS::Lattice_3 integers(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 1);
  for(int at : { 0, 1 << 8, -(1 << 14), 1 << 17, 1 << 19, -BS::Lattice_key::max_coordinate }) {
    const Point p = { at + 0.3, 0.3, at + 0.7 };
    Hierarchy cells = refined_at(Hierarchy(some_cells(random, integers, { at - 1, -1, at - 1 }, { at + 1, 1, at + 1 })),
                                 p, 12);
    CAPTURE(at);
    CHECK(cells.number_of_levels() == cells.max_level() + 1);
    CHECK(cells.max_level()
          == (std::abs(at) < 1 << 9     ? 10
              : std::abs(at) <= 1 << 14 ? 5
              : std::abs(at) == 1 << 17 ? 2
                                        : 0));
    const Index c = cells.locate(p);
    REQUIRE(c != Hierarchy::npos);
    CHECK(cells.level(c) == cells.max_level());
    CHECK(meets(cells, c, box_at(p)));
    const std::size_t size = cells.number_of_cells();
    CHECK(cells.refined({ c }).number_of_cells() == size);
    CHECK(Smallest_cells(refined_at(Hierarchy(cells.roots()), p, (std::min)(3, cells.max_level()))).overlaps == 0);
    // Leaves of the last level do not prevent others from being refined.
    if(cells.max_level() > 0) {
      const Index coarse = 0;
      CHECK(cells.level(coarse) < cells.max_level());
      CHECK(cells.refined({ c, coarse }).number_of_cells() == cells.refined({ coarse }).number_of_cells());
    }
  }
}

TEST_CASE("Hierarchy: cells on an inexact lattice are never split")
{
  CGAL::Random random(21);
  const BS::Lattice_3 inexact = BS::Lattice_3::from_origin({ 0.1, 0.1, 0.1 }, 0.1, { -3, -3, -3 }, { 3, 3, 3 });
  const Hierarchy cells(some_cells(random, inexact, { -3, -3, -3 }, { 3, 3, 3 }));
  CHECK_FALSE(cells.is_exact());
  CHECK(cells.max_level() == 0);
  CHECK(cells.refined({ 0, 5 }).number_of_cells() == cells.number_of_cells());
}

TEST_CASE("Hierarchy: from_leaves() restores a hierarchy, and rejects leaves that do not form one")
{
  typedef std::vector<std::vector<std::uint64_t> > Leaves;
  CGAL::Random random(22);
  const BS::Lattice_3 lattice(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.3);
  std::size_t wrong = 0, accepted = 0, exchanged = 0;
  for(int n = 0; n < 20; ++n) {
    const Hierarchy cells = random_hierarchy(random, some_cells(random, lattice, { -4, -3, -2 }, { 3, 2, 4 }, 0.8),
                                             1 + n % 5, 2);
    Leaves leaves(std::size_t(cells.number_of_levels()));
    for(Index c = 0; c < cells.number_of_cells(); ++c) {
      const Lattice_point& p = cells.lattice_point(c);
      leaves[std::size_t(cells.level(c))].push_back(BS::Lattice_key::encode(p[0], p[1], p[2]));
    }
    const std::optional<Hierarchy> again = Hierarchy::from_leaves(lattice, leaves);
    REQUIRE(again);
    wrong += again->number_of_cells() != cells.number_of_cells()
             || again->number_of_levels() != cells.number_of_levels() || again->max_level() != cells.max_level()
             || again->roots().number_of_cells() != cells.roots().number_of_cells();
    for(Index c = 0; c < cells.number_of_cells(); ++c)
      wrong += again->lattice_point(c) != cells.lattice_point(c) || again->level(c) != cells.level(c);
    // Refinement is the same, so split cells are restored, too.
    const std::vector<Index> marked = random_leaves(random, cells, 1);
    wrong += again->refined(marked).number_of_cells() != cells.refined(marked).number_of_cells();

    for(std::size_t l = 1; l < leaves.size(); ++l) {
      Leaves missing = leaves;
      missing[l].erase(missing[l].begin() + random.get_int(0, int(missing[l].size())));
      accepted += Hierarchy::from_leaves(lattice, missing).has_value();
      // the parent of a leaf, added as a leaf
      Leaves overlapping = leaves;
      Lattice_point p = BS::Lattice_key::decode(leaves[l][0]);
      for(int& i : p) i = (i - (i & 1)) / 2;
      overlapping[l - 1].push_back(BS::Lattice_key::encode(p[0], p[1], p[2]));
      BS::sort_unique(overlapping[l - 1]);
      accepted += Hierarchy::from_leaves(lattice, overlapping).has_value();
      // The parent replaces a leaf of its level, so the numbers of leaves are as before.
      if(l > 1 && !leaves[l - 1].empty()) {
        Leaves in_place = leaves;
        in_place[l - 1].front() = BS::Lattice_key::encode(p[0], p[1], p[2]);
        BS::sort_unique(in_place[l - 1]);
        accepted += Hierarchy::from_leaves(lattice, in_place).has_value();
        ++exchanged;
      }
    }
  }
  CHECK(wrong == 0);
  CHECK(accepted == 0);
  CHECK(exchanged > 0);

  // A cell is split twice at a corner, without rings around it.
  std::vector<std::uint64_t> level[3];
  for(int o = 0; o < 8; ++o) {
    if(o > 0) level[1].push_back(BS::Lattice_key::encode(o & 1, o >> 1 & 1, o >> 2));
    level[2].push_back(BS::Lattice_key::encode(o & 1, o >> 1 & 1, o >> 2));
  }
  level[0].push_back(BS::Lattice_key::encode(1, 0, 0));
  CHECK_FALSE(Hierarchy::from_leaves(lattice, { level[0], level[1], level[2] }));
  // Alone, it has no neighbors, and needs no rings.
  CHECK(Hierarchy::from_leaves(lattice, { {}, level[1], level[2] }));
  // smaller than the smallest possible leaf
  CHECK_FALSE(Hierarchy::from_leaves(lattice, Leaves(20, { BS::Lattice_key::encode(0, 0, 0) })));
  CHECK(Hierarchy::from_leaves(lattice, {})->number_of_cells() == 0);
}
} // namespace test_Cell_hierarchy_3
