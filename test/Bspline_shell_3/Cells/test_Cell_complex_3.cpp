// Lattices whose corners are doubles. Sets of lattice cells, compared with searches through all cells.
#include <CGAL/Bspline_shell_3/Cells/Cell_complex_3.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace test_Cell_complex_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_rational Rational;
typedef BS::Lattice_3 Lattice;
typedef BS::Cell_complex_3 Cells;
typedef BS::Lattice_set_3 Lattice_set;
typedef BS::Lattice_key Key;
typedef Lattice::Point Lattice_point;
typedef std::array<double, 3> Point;

const double inf = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

bool is_double(const Rational& x)
{
  return Rational(CGAL::to_double(x)) == x;
}

CGAL::Bbox_3 random_box(CGAL::Random& random, double distance)
{
  Point a, b;
  for(int n = 0; n < 3; ++n) {
    a[n] = distance * random.get_double(-1, 1) + random.get_double(-1, 1);
    b[n] = a[n] + random.get_double(0.1, 1);
  }
  return CGAL::Bbox_3(a[0], a[1], a[2], b[0], b[1], b[2]);
}

// Checks that selected multiples of 2^-12 spacings are doubles: at the ends of the box, next to it, and in between.
void check_corners(const Lattice& lattice, const CGAL::Bbox_3& box)
{
  for(int a = 0; a < 3; ++a) {
    const Rational origin(lattice.origin()[a]), spacing(lattice.spacing());
    const int first = lattice.interval(a, box.min(a)) - 3, last = lattice.interval(a, box.max(a)) + 3;
    for(int i : { first, first + (last - first) / 3, 0, last - 1, last }) {
      CHECK(Rational(lattice.coordinate(a, i)) == origin + i * spacing);
      const int halved = 1 << Lattice::finest_level;
      for(int k : { 1, 2, 3, halved / 3, halved / 2, halved - 1 })
        CHECK(is_double(origin + i * spacing + k * spacing / halved));
    }
  }
}

// The keys of a cell set, and its expected points.
struct Sparse_cells
{
  std::set<Lattice_point> points;
  std::vector<std::uint64_t> keys;

  // Inserts roughly the given share of the cells in [first, last]^3.
  Sparse_cells(CGAL::Random& random, int first, int last, double share)
  {
    for(int k = first; k <= last; ++k)
      for(int j = first; j <= last; ++j)
        for(int i = first; i <= last; ++i)
          if(random.get_double() < share) insert(i, j, k);
    BS::sort_unique(keys);
  }
  void insert(int i, int j, int k)
  {
    points.insert(Lattice_point{ i, j, k });
    keys.push_back(Key::encode(i, j, k));
  }
};

bool contains(const Cells& cells, Cells::Index c, const Point& p)
{
  for(int a = 0; a < 3; ++a) {
    const int i = cells.lattice_point(c)[a];
    if(p[a] < cells.lattice().coordinate(a, i) || p[a] > cells.lattice().coordinate(a, i + 1)) return false;
  }
  return true;
}

std::vector<Cells::Index> cells_at(const Cells& cells, const Point& p)
{
  std::vector<Cells::Index> found;
  for(Cells::Index c = 0; c < cells.number_of_cells(); ++c)
    if(contains(cells, c, p)) found.push_back(c);
  return found;
}

// spacing 1/4 around the origin
const Lattice quarters(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 0.25);

} // namespace

TEST_CASE("Lattice: all corners are doubles, even those of cells halved twelve times and far from the origin")
{
  CGAL::Random random(1);
  for(double distance : { 0., 1., 1e3, 1e6 })
    for(int n = 0; n < 20; ++n) {
      const CGAL::Bbox_3 box = random_box(random, distance);
      const double spacing = std::pow(10, random.get_double(-3, 0));
      const Lattice lattice(box, spacing);
      CAPTURE(distance, spacing);
      REQUIRE(lattice.is_exact());
      check_corners(lattice, box);
      // The spacing is the requested one, up to the bits that are available.
      CHECK(std::abs(lattice.spacing() - spacing) <= spacing / (distance < 10 ? 1 << 19 : 1 << 4));
      CHECK(std::floor(std::ldexp(lattice.spacing(), 20 - std::ilogb(lattice.spacing()) - 1))
            == std::ldexp(lattice.spacing(), 20 - std::ilogb(lattice.spacing()) - 1));
      for(int a = 0; a < 3; ++a) // the lattice begins at the middle of the box
        CHECK(std::abs(lattice.origin()[a] - (box.min(a) + box.max(a)) / 2) <= spacing);
    }
}

TEST_CASE("Lattice: is_exact() holds only if all corners are doubles, at any distance from the origin")
{
  int exact = 0, inexact = 0;
  for(int e = 0; e < 60; ++e) {
    const double distance = std::ldexp(1.2345, e);
    const CGAL::Bbox_3 box(distance, -distance, 0, distance + 1, -distance + 1, 1);
    const Lattice lattice(box, 0.37);
    if(lattice.is_exact()) {
      ++exact;
      check_corners(lattice, box);
    } else ++inexact;
  }
  CHECK(exact > 30); // at a distance of 2^30 cells, enough bits are left for a spacing with ten bits
  CHECK(inexact > 20);
  CHECK_FALSE(Lattice(CGAL::Bbox_3(1e15, 0, 0, 1e15 + 1, 1, 1), 1e-3).is_exact());
  CHECK_FALSE(Lattice(CGAL::Bbox_3(0, 0, 0, inf, 1, 1), 1e-3).is_exact());
  CHECK_FALSE(Lattice(CGAL::Bbox_3(-1e308, 0, 0, 1e308, 1, 1), 1e-3).is_exact());
  CHECK_FALSE(Lattice(CGAL::Bbox_3(-1.7e308, 0, 0, 1.7e308, 1, 1), 1e308).is_exact()); // no room for another cell
  CHECK_FALSE(Lattice(CGAL::Bbox_3(0, 0, 0, 1e-310, 1e-310, 1e-310), 1e-321).is_exact());
  CHECK_FALSE(Lattice().is_exact());
  const CGAL::Bbox_3 huge(-1e308, 0, 0, 1e308, 1e300, 1), tiny(0, 0, 0, 1e-300, 1e-301, 1e-300);
  for(const std::pair<CGAL::Bbox_3, double>& p : { std::make_pair(huge, 1e306), std::make_pair(tiny, 1e-302) }) {
    const Lattice lattice(p.first, p.second);
    REQUIRE(lattice.is_exact());
    check_corners(lattice, p.first);
  }
}

TEST_CASE("Lattice: a mirrored, rotated or scaled box yields the mirrored, rotated or scaled lattice")
{
  CGAL::Random random(2);
  for(int n = 0; n < 2000; ++n) {
    CGAL::Bbox_3 box = random_box(random, n % 2 ? 0. : 100.);
    double spacing = n % 2 ? 0.1 : 1.;
    if(n % 4 == 3) {
      // Up to the last bits, the middle is halfway between two possible origins.
      spacing = 0.125;
      const double bit = std::ldexp(spacing, -19), middle = (random.get_int(1, 1000000) + 0.5) * bit;
      const double lower = random.get_double(-0.01, 0);
      box = CGAL::Bbox_3(lower, box.ymin(), box.zmin(), 2 * middle - lower, box.ymax(), box.zmax());
    }
    const Lattice lattice(box, spacing);
    const Lattice mirrored(CGAL::Bbox_3(-box.xmax(), box.ymin(), box.zmin(), -box.xmin(), box.ymax(), box.zmax()),
                           spacing);
    CHECK(mirrored.spacing() == lattice.spacing());
    CHECK(mirrored.origin() == Point{ -lattice.origin()[0], lattice.origin()[1], lattice.origin()[2] });
    // maps (x, y, z) to (-y, x, z)
    const Lattice turned(CGAL::Bbox_3(-box.ymax(), box.xmin(), box.zmin(), -box.ymin(), box.xmax(), box.zmax()),
                         spacing);
    CHECK(turned.spacing() == lattice.spacing());
    CHECK(turned.origin() == Point{ -lattice.origin()[1], lattice.origin()[0], lattice.origin()[2] });
    for(double s : { 0.125, 1024. }) {
      const Lattice scaled(
        CGAL::Bbox_3(s * box.xmin(), s * box.ymin(), s * box.zmin(), s * box.xmax(), s * box.ymax(), s * box.zmax()),
        s * spacing);
      CHECK(scaled.spacing() == s * lattice.spacing());
      for(int a = 0; a < 3; ++a) CHECK(scaled.origin()[a] == s * lattice.origin()[a]);
    }
  }
}

TEST_CASE("Lattice: number_of_halvings() keeps all corners exact, and is nearly the largest possible number")
{
  CGAL::Random random(20);
  int tight = 0;
  for(double distance : { 0., 1., 1e3, 1e6 })
    for(int n = 0; n < 20; ++n) {
      const CGAL::Bbox_3 box = random_box(random, distance);
      const Lattice lattice(box, std::pow(10, random.get_double(-3, 0)));
      REQUIRE(lattice.is_exact());
      Lattice_point first, last;
      double furthest = 0;
      for(int a = 0; a < 3; ++a) {
        first[a] = lattice.interval(a, box.min(a));
        last[a] = lattice.interval(a, box.max(a));
        furthest = (std::max)(
          { furthest, std::abs(lattice.coordinate(a, first[a])), std::abs(lattice.coordinate(a, last[a] + 1)) });
      }
      const int halvings = lattice.number_of_halvings(first, last);
      CHECK(halvings >= Lattice::finest_level);
      const Rational part(std::ldexp(lattice.spacing(), -halvings));
      bool once_more = true;
      for(int a = 0; a < 3; ++a)
        for(int i : { first[a], (first[a] + last[a]) / 2, last[a] })
          for(double k : { 1., 3., std::ldexp(1., halvings) - 1 }) {
            CHECK(is_double(Rational(lattice.coordinate(a, i)) + Rational(k) * part));
            once_more = once_more && is_double(Rational(lattice.coordinate(a, i)) + Rational(k) * part / 2)
                        && is_double(Rational(lattice.coordinate(a, i + 1)) - part / 2);
          }
      tight += !once_more; // one or two halvings are lost where the origin has more bits than the spacing
    }
  CHECK(tight > 20);
  CHECK(Lattice().number_of_halvings({ 0, 0, 0 }, { 0, 0, 0 }) == 0);
}

TEST_CASE("Lattice: a lattice built from origin and spacing is exact if and only if its corners are, even when halved")
{
  const auto is_exact = [](double origin, double spacing, int first, int last) {
    return Lattice::from_origin({ 0, origin, 0 }, spacing, Lattice_point{ 0, first, 0 }, Lattice_point{ 0, last, 0 })
      .is_exact();
  };
  const double bit = std::ldexp(1., -19);
  CHECK(is_exact(0, 1, 0, 0));
  CHECK(is_exact(-3.5, 0.75, -100, 100));
  CHECK(is_exact(0, 1 + bit, -1000, 1000));
  CHECK_FALSE(is_exact(0, 1 + bit / 2, 0, 0)); // 21 bits
  CHECK_FALSE(is_exact(0, 0.1, 0, 0));
  CHECK_FALSE(is_exact(0.1, 1, 0, 1000));       // 0.1 + 1000 is rounded
  CHECK(is_exact(std::ldexp(1., 40), 1, 0, 0)); // 2^40 + 2^-12 has 53 bits
  CHECK_FALSE(is_exact(std::ldexp(1., 41), 1, 0, 0));
  CHECK_FALSE(is_exact(0, std::numeric_limits<double>::denorm_min(), 0, 0)); // cells could not be halved
  CHECK(is_exact(0, std::ldexp(1., -1074 + 12), 0, 0));
  CHECK_FALSE(is_exact(0, std::ldexp(1., -1074 + 11), 0, 0));
  for(double x : { not_a_number, inf }) {
    CHECK_FALSE(is_exact(x, 1, 0, 0));
    CHECK_FALSE(is_exact(0, x, 0, 0));
    CHECK_FALSE(is_exact(0, -x, 0, 0));
  }
  CHECK_FALSE(is_exact(0, 0, 0, 0));
  CHECK_FALSE(is_exact(0, -1, 0, 0));
  CHECK_FALSE(is_exact(0, std::ldexp(1., 1023), 0, 2)); // corners exceed all doubles

  // Lattices of the other constructor are included, with all cells that a shell may have.
  CGAL::Random random(19);
  for(int n = 0; n < 2000; ++n) {
    const double size = std::pow(10., random.get_double(-60, 60)), far = std::pow(10., random.get_double(0, 8));
    double a[3], b[3];
    for(int k = 0; k < 3; ++k) {
      a[k] = size * far * random.get_double(-1, 1);
      b[k] = a[k] + size * random.get_double(0.1, 1);
    }
    const CGAL::Bbox_3 box(a[0], a[1], a[2], b[0], b[1], b[2]);
    const Lattice lattice = Lattice::off_the_ends(box, size / std::pow(10., random.get_double(0, 5)));
    if(!lattice.is_exact()) continue;
    Lattice_point first, last;
    for(int k = 0; k < 3; ++k) {
      first[std::size_t(k)] = lattice.interval(k, a[k]) - 1020;
      last[std::size_t(k)] = lattice.interval(k, b[k]) + 1020;
    }
    const Lattice same = Lattice::from_origin(lattice.origin(), lattice.spacing(), first, last);
    REQUIRE(same.is_exact());
    REQUIRE(same.origin() == lattice.origin());
    REQUIRE(same.spacing() == lattice.spacing());
  }
}

TEST_CASE("Lattice: intervals are half-open, so a plane belongs to the interval that it starts")
{
  CGAL::Random random(3);
  for(double distance : { 0., 1e6 }) {
    const Lattice lattice(random_box(random, distance), 0.0123);
    for(int n = 0; n < 1000; ++n) {
      const int i = random.get_int(-5000, 5000);
      const double x = lattice.coordinate(n % 3, i);
      CHECK(lattice.interval(n % 3, x) == i);
      CHECK(lattice.interval(n % 3, std::nextafter(x, inf)) == i);
      CHECK(lattice.interval(n % 3, std::nextafter(x, -inf)) == i - 1);
      const double between = x + random.get_double(0.01, 0.99) * lattice.spacing();
      CHECK(lattice.interval(n % 3, between) == i);
    }
  }
}

TEST_CASE("Lattice: on an inexact lattice, intervals lie between the rounded planes")
{
  CGAL::Random random(32);
  for(int n = 0; n < 2000; ++n) {
    const double spacing = random.get_double(0.1, 1) / 3,
                 origin = random.get_double(-1, 1) * std::ldexp(1., n % 20) / 3;
    const int i = random.get_int(-1000, 1001);
    const Lattice lattice = Lattice::from_origin({ origin, origin, origin }, spacing, { -1001, -1001, -1001 },
                                                 { 1001, 1001, 1001 });
    REQUIRE_FALSE(lattice.is_exact());
    const double x = lattice.coordinate(n % 3, i);
    CHECK(lattice.interval(n % 3, x) == i);
    CHECK(lattice.interval(n % 3, std::nextafter(x, inf)) == i);
    CHECK(lattice.interval(n % 3, std::nextafter(x, -inf)) == i - 1);
  }
}

TEST_CASE("Lattice keys: decoding inverts encoding, and keys are sorted like (k, j, i)")
{
  const int m = Key::max_coordinate;
  std::vector<Lattice_point> points = { { -m, -m, -m }, { m, -m, -m }, { -m, 0, -m }, { 0, 0, 0 },   { 1, 0, 0 },
                                        { -1, 1, 0 },   { -m, m, 0 },  { m, m, 0 },   { -m, -m, 1 }, { m, m, m } };
  for(std::size_t n = 0; n < points.size(); ++n) {
    const Lattice_point& p = points[n];
    CHECK(Key::decode(Key::encode(p[0], p[1], p[2])) == p);
    if(n > 0) CHECK(Key::encode(points[n - 1][0], points[n - 1][1], points[n - 1][2]) < Key::encode(p[0], p[1], p[2]));
    for(int a = 0; a < 3; ++a) {
      Lattice_point next = p;
      ++next[a];
      CHECK(Key::encode(p[0], p[1], p[2]) + Key::step(a) == Key::encode(next[0], next[1], next[2]));
    }
  }
}

TEST_CASE("Lattice sets: index() and index_range() agree with a search, with holes and negative coordinates")
{
  CGAL::Random random(4);
  for(double share : { 0.05, 0.5, 0.9, 1. }) {
    const Sparse_cells sparse(random, -4, 3, share);
    const Lattice_set set(sparse.keys);
    REQUIRE(set.size() == sparse.points.size());
    for(Lattice_set::Index n = 0; n < set.size(); ++n) {
      CHECK(sparse.points.count(set.point(n)) == 1);
      CHECK(set.index(set.point(n)) == n);
    }
    int wrong = 0;
    for(int k = -6; k <= 5; ++k)
      for(int j = -6; j <= 5; ++j)
        for(int i = -6; i <= 5; ++i) {
          const bool there = sparse.points.count(Lattice_point{ i, j, k }) == 1;
          wrong += (set.index(i, j, k) != Lattice_set::npos) != there;
          for(int end = i; end <= 6; ++end) {
            const std::pair<Lattice_set::Index, Lattice_set::Index> range = set.index_range(i, end, j, k);
            std::vector<Lattice_point> expected, found;
            for(int ii = i; ii < end; ++ii)
              if(sparse.points.count(Lattice_point{ ii, j, k })) expected.push_back({ ii, j, k });
            for(Lattice_set::Index n = range.first; n < range.second; ++n) found.push_back(set.point(n));
            wrong += found != expected;
          }
        }
    CHECK(wrong == 0);
  }
  const Lattice_set empty;
  CHECK(empty.size() == 0);
  CHECK(empty.index(0, 0, 0) == Lattice_set::npos);
  CHECK(Lattice_set(std::vector<std::uint64_t>()).index_range(-1, 1, 0, 0).first == Lattice_set::npos);
}

TEST_CASE("Lattice sets: dilation is the Minkowski sum with a cube")
{
  CGAL::Random random(5);
  typedef std::pair<int, int> Range;
  for(const Range& cube : { Range(-1, 2), Range(-1, 1), Range(0, 0), Range(1, 3) }) {
    const Sparse_cells sparse(random, -5, 4, 0.03);
    std::set<std::uint64_t> sum;
    for(const Lattice_point& p : sparse.points)
      for(int k = cube.first; k <= cube.second; ++k)
        for(int j = cube.first; j <= cube.second; ++j)
          for(int i = cube.first; i <= cube.second; ++i) sum.insert(Key::encode(p[0] + i, p[1] + j, p[2] + k));
    CHECK(BS::dilate(sparse.keys, cube.first, cube.second) == std::vector<std::uint64_t>(sum.begin(), sum.end()));
  }
}

TEST_CASE("Cells: a point is located in a closed cell that contains it, preferably the cell of larger coordinates")
{
  CGAL::Random random(6);
  for(double share : { 0.2, 0.6, 1. }) {
    const Sparse_cells sparse(random, -2, 1, share);
    const Cells cells(quarters, sparse.keys);
    REQUIRE(cells.number_of_cells() == sparse.points.size());
    // points are multiples of half a cell: corners, middles of edges and faces, centers; some are outside
    for(int k = -6; k <= 6; ++k)
      for(int j = -6; j <= 6; ++j)
        for(int i = -6; i <= 6; ++i) {
          const Point p = { i * 0.125, j * 0.125, k * 0.125 };
          const std::vector<Cells::Index> expected = cells_at(cells, p);
          const Cells::Index c = cells.locate(p);
          CAPTURE(i, j, k);
          if(expected.empty()) {
            CHECK(c == Cells::npos);
            continue;
          }
          CHECK(std::count(expected.begin(), expected.end(), c) == 1);
          const auto half = [](int n) { return int(std::floor(n / 2.)); };
          const Cells::Index upper = cells.cell({ half(i), half(j), half(k) });
          if(upper != Cells::npos) CHECK(c == upper);
        }
  }
}

TEST_CASE("Cells: points one ulp outside the domain, and points with NaN or infinite coordinates, are outside")
{
  const Cells cells(quarters, { Key::encode(0, 0, 0) });
  const Point inside = { 0.1, 0.1, 0.1 };
  for(int a = 0; a < 3; ++a) {
    const auto at = [&](double x) {
      Point p = inside;
      p[a] = x;
      return cells.locate(p);
    };
    CHECK(at(0) == 0);
    CHECK(at(0.25) == 0);
    CHECK(at(std::nextafter(0, -1)) == Cells::npos);
    CHECK(at(std::nextafter(0.25, 1)) == Cells::npos);
    for(double x : { not_a_number, inf, -inf, 1e300, -1e300, 1e9, 2.5e5, -2.7e5 }) CHECK(at(x) == Cells::npos);
  }
  CHECK(Cells().locate(inside) == Cells::npos);
}

TEST_CASE("Cells: each cell has the index of its lattice point and the corner there")
{
  CGAL::Random random(7);
  const Sparse_cells sparse(random, -3, 2, 0.5);
  const Cells cells(quarters, sparse.keys);
  REQUIRE(cells.number_of_cells() == sparse.points.size());
  for(Cells::Index c = 0; c < cells.number_of_cells(); ++c) {
    CHECK(sparse.points.count(cells.lattice_point(c)) == 1);
    CHECK(cells.cell(cells.lattice_point(c)) == c);
    for(int a = 0; a < 3; ++a) CHECK(cells.corner(c)[a] == 0.25 * cells.lattice_point(c)[a]);
  }
}

TEST_CASE("Cells: a box meets the cells found by a search, and is covered if and only if all its points are")
{
  CGAL::Random random(8);
  int covered_boxes = 0, flat_covered_boxes = 0;
  for(double share : { 0.5, 0.8, 0.97, 1. }) {
    const Sparse_cells sparse(random, -2, 1, share);
    const Cells cells(quarters, sparse.keys);
    // Boxes end at multiples of half a cell. Multiples of a quarter of a cell divide a box into open parts that are
    // covered as a whole or not at all. So one point of each part decides.
    constexpr int reach = 12;
    const auto unit = [](int i) { return i * 0.0625; };
    bool covered[2 * reach + 1][2 * reach + 1][2 * reach + 1];
    for(int k = -reach; k <= reach; ++k)
      for(int j = -reach; j <= reach; ++j)
        for(int i = -reach; i <= reach; ++i)
          covered[i + reach][j + reach][k + reach] = !cells_at(cells, { unit(i), unit(j), unit(k) }).empty();
    for(int n = 0; n < 1500; ++n) {
      int first[3], last[3];
      for(int a = 0; a < 3; ++a) {
        first[a] = 2 * random.get_int(-reach / 2, reach / 2 + 1);
        last[a] = (std::min)(reach, first[a] + 2 * random.get_int(0, 4)); // may be flat, or a point
      }
      const CGAL::Bbox_3 box(unit(first[0]), unit(first[1]), unit(first[2]), unit(last[0]), unit(last[1]),
                             unit(last[2]));
      bool all_covered = true;
      for(int k = first[2]; k <= last[2]; ++k)
        for(int j = first[1]; j <= last[1]; ++j)
          for(int i = first[0]; i <= last[0]; ++i)
            all_covered = all_covered && covered[i + reach][j + reach][k + reach];
      std::vector<Cells::Index> expected, visited;
      for(Cells::Index c = 0; c < cells.number_of_cells(); ++c) {
        bool meets = true;
        for(int a = 0; a < 3; ++a)
          meets = meets && cells.corner(c)[a] <= box.max(a) && cells.corner(c)[a] + cells.width() >= box.min(a);
        if(meets) expected.push_back(c);
      }
      const bool answer = cells.visit_cells(box, [&](Cells::Index c) { visited.push_back(c); });
      std::sort(visited.begin(), visited.end());
      CAPTURE(share, box);
      CHECK(visited == expected);
      CHECK(answer == all_covered);
      covered_boxes += answer;
      for(int a = 0; a < 3; ++a) // flat, between two layers of cells
        if(answer && first[a] == last[a] && first[a] % 4 == 0) {
          ++flat_covered_boxes;
          break;
        }
    }
  }
  CHECK(covered_boxes > 100);
  CHECK(flat_covered_boxes > 100);
}

TEST_CASE("Cells: a box one ulp larger than the domain is not covered, and still meets the cells that it reaches")
{
  const Cells cells(quarters, { Key::encode(0, 0, 0), Key::encode(1, 0, 0) });
  const auto visited = [&](const CGAL::Bbox_3& box, bool covered) {
    std::size_t n = 0;
    CHECK(cells.visit_cells(box, [&](Cells::Index) { ++n; }) == covered);
    return n;
  };
  CHECK(visited({ 0.1, 0.1, 0.1, 0.2, 0.2, 0.2 }, true) == 1);
  CHECK(visited({ 0.1, 0.1, 0.1, 0.25, 0.2, 0.2 }, true) == 2);
  CHECK(visited({ 0.1, 0.1, 0.1, std::nextafter(0.25, 0), 0.2, 0.2 }, true) == 1);
  CHECK(visited({ 0, 0, 0, 0.5, 0.25, 0.25 }, true) == 2);
  CHECK(visited({ 0, 0, 0, std::nextafter(0.5, 1), 0.25, 0.25 }, false) == 2);
  CHECK(visited({ 0, std::nextafter(0, -1), 0, 0.5, 0.25, 0.25 }, false) == 2);
  CHECK(visited({ 0.5, 0, 0, 0.5, 0.25, 0.25 }, true) == 1);
  CHECK(visited({ std::nextafter(0.5, 1), 0, 0, 1, 0.25, 0.25 }, false) == 0);
  CHECK(visited({ -1, -1, -1, 0, 0, 0 }, false) == 1);
}

TEST_CASE("Cells: queries with huge, distant, empty or NaN boxes terminate immediately")
{
  const Cells cells(quarters, { Key::encode(0, 0, 0), Key::encode(1, 0, 0), Key::encode(3, 2, 1) });
  const auto visited = [](const Cells& cells, const CGAL::Bbox_3& box) {
    std::size_t n = 0;
    CHECK_FALSE(cells.visit_cells(box, [&](Cells::Index) { ++n; }));
    return n;
  };
  CHECK(visited(cells, { -1e5, -1e5, -1e5, 1e5, 1e5, 1e5 }) == 3);
  CHECK(visited(cells, { -1e300, -1e300, -1e300, 1e300, 1e300, 1e300 }) == 3);
  CHECK(visited(cells, { -inf, -inf, -inf, inf, inf, inf }) == 3);
  CHECK(visited(cells, { 1e300, 0, 0, 1e300, 1, 1 }) == 0);
  CHECK(visited(cells, { inf, 0, 0, inf, 1, 1 }) == 0);
  CHECK(visited(cells, { not_a_number, 0, 0, 1, 1, 1 }) == 0);
  CHECK(visited(cells, { 0, 0, 0, 1, not_a_number, 1 }) == 0);
  CHECK(visited(cells, CGAL::Bbox_3()) == 0);
  CHECK(visited(Cells(), { 0, 0, 0, 1, 1, 1 }) == 0);
}
} // namespace test_Cell_complex_3
