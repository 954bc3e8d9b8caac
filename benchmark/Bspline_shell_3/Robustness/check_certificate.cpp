// Checks the certificate of a shell: whether what it says about the shell and a mesh is true.
//
//   check_certificate SHELL.shell.txt MESH.off CERTIFICATE.certificate.txt
//
// Exit code 0 and the line "certified: P1 ..." on stdout if everything that the certificate claims as proved holds;
// 1 and a sentence on stderr if a claim is wrong or cannot be confirmed; 2 if a file cannot be read or is malformed.
//
// f is the spline of the functions that the shell lists, A the mesh, n_T the normal of a facet T, Omega* the components of
// {EPS1 <= f <= EPS2} that meet A. The claims are
//   P1  EPS1 <= f <= EPS2 on A;
//   P2  n_T . grad f > 0 on every closed facet T;
//   P3  Omega* lies in the interior of the leaves, and grad f is not zero on it;
//   P4  every component of Omega* contains exactly one component of A;
//   P5  every component of Omega* contains a path from {f < EPS1} to {f > EPS2} that crosses A with count one.
//
// Nothing is sampled. Real numbers are enclosed by intervals of doubles, rounded outwards after every operation; what has
// to be exact is an integer or a rational. On a facet, f and its derivatives are bounded by the Bernstein coefficients (of
// degree 9) of the leaf's polynomial over a triangle, on boxes by those of the polynomial over the box.
//
// This program shares no code with the package that writes the files. What has to be trusted: this file; the compiler, the
// standard library and Boost (Multiprecision for rationals, CRC for checksums); double arithmetic as in IEEE 754, rounded
// to nearest, which is tested at the start; and the theorem that P1 to P5 imply what one wants to know. The user has to
// see to it that the mesh and the shell are those that are meant. Not checked, as no claim depends on them: the shell's
// unit, numbers of triangles and components, marks of leaves, and facet ranges.
#include <boost/crc.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

typedef boost::multiprecision::cpp_rational Rational;
typedef std::array<double, 3> Point;
typedef long long Integer;

struct Malformed : std::runtime_error { using std::runtime_error::runtime_error; };
struct Unconfirmed : std::runtime_error { using std::runtime_error::runtime_error; };

// Numbers are not larger than this, and edges of cells not smaller than its inverse, so that nothing can overflow.
const double largest = 1e60;
// lattice positions and depths of boxes are at most this large, so that positions of boxes are exact integers
const Integer largest_index = 1 << 20;
const int largest_depth = 20;
const Integer leaf_edge = Integer(1) << largest_depth;
// how often a triangle as large as a cell, and a box of the certificate, is subdivided before it counts as unconfirmed
const int triangle_levels = 16;
const int box_levels = 4;

// ---------------------------------------------------------------------------------------------------- interval arithmetic

// std::nextafter to +infinity for finite numbers; written here because it has to be inlined
inline double up(double x)
{
  x += 0.; // -0 has a successor of its own otherwise
  std::int64_t bits;
  std::memcpy(&bits, &x, sizeof x);
  bits += bits >= 0 ? 1 : -1;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}
inline double down(double x) { return -up(-x); }

struct Interval
{
  Interval(double x = 0) : lo(x), hi(x) {}
  Interval(double l, double h) : lo(l), hi(h) {}
  double lo, hi;
};

inline Interval operator+(const Interval& a, const Interval& b) { return Interval(down(a.lo + b.lo), up(a.hi + b.hi)); }
inline Interval operator-(const Interval& a, const Interval& b) { return Interval(down(a.lo - b.hi), up(a.hi - b.lo)); }
inline Interval operator*(const Interval& a, const Interval& b)
{
  const double c = a.lo * b.lo, d = a.lo * b.hi, e = a.hi * b.lo, f = a.hi * b.hi;
  return Interval(down((std::min)((std::min)(c, d), (std::min)(e, f))), up((std::max)((std::max)(c, d), (std::max)(e, f))));
}
// by a positive number
inline Interval operator/(const Interval& a, double b) { return Interval(down(a.lo / b), up(a.hi / b)); }

template <class Range>
Interval hull(const Range& range)
{
  Interval h = range[0];
  for(const Interval& i : range) h = Interval((std::min)(h.lo, i.lo), (std::max)(h.hi, i.hi));
  return h;
}

Interval enclose(const Rational& r)
{
  const double d = r.convert_to<double>();
  Interval i(down(d), up(d));
  while(Rational(i.lo) > r) i.lo = down(i.lo);
  while(Rational(i.hi) < r) i.hi = up(i.hi);
  return i;
}

// whether double arithmetic is the one that intervals rely on
bool usable_arithmetic()
{
#ifdef __FAST_MATH__
  return false;
#endif
  volatile double one = 1, least = (std::numeric_limits<double>::min)(), half = 0.5, nan = std::numeric_limits<double>::quiet_NaN();
  volatile double u = std::ldexp(1., -53), more = std::ldexp(1., -53) + std::ldexp(1., -64), minus = -1;
  volatile double denormal = least * half, back = denormal * 2, to_even = one + u, above = one + more, below = minus - u, toward = one - u * half;
  const volatile double copy = nan;
  bool usable = FLT_EVAL_METHOD == 0 && std::numeric_limits<double>::is_iec559 && denormal != 0 && back == least && copy != nan
             && to_even == 1 && above == 1 + DBL_EPSILON && below == -1 && toward == 1;
  volatile double third = one / 3, product = third * 3;
  usable = usable && product == 1 && std::fma(double(third), 3., -1.) == -u / 2;
  for(double x : { 0., -0., 1., -1., 0.1, -0.1, 1e300, -1e-300, DBL_TRUE_MIN, -DBL_TRUE_MIN, DBL_MIN, -DBL_MIN, 2., -2. }) {
    volatile double v = x;
    usable = usable && up(v) == std::nextafter(x, HUGE_VAL) && down(v) == std::nextafter(x, -HUGE_VAL)
          && Rational(x).convert_to<double>() == x && (x == 0 || Rational(x) != Rational(up(v)));
  }
  return usable && Rational(0.1) == Rational(3602879701896397LL) / (Integer(1) << 55);
}

// -------------------------------------------------------------------------------------------------------------- the files

std::uint64_t crc64(const char* data, std::size_t size)
{
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693ULL, 0xFFFFFFFFFFFFFFFFULL, 0xFFFFFFFFFFFFFFFFULL, true, true> crc;
  crc.process_bytes(data, size);
  return crc.checksum();
}

std::string hexadecimal(std::uint64_t number)
{
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

std::string read_file(const std::string& name)
{
  std::ifstream in(name, std::ios::binary | std::ios::ate);
  if(!in) throw Malformed("Cannot read " + name);
  std::string text(static_cast<std::size_t>((std::max)(std::streamoff(0), std::streamoff(in.tellg()))), '\0');
  in.seekg(0);
  if(!in.read(&text[0], std::streamsize(text.size()))) throw Malformed("Cannot read " + name);
  return text;
}

// The tokens of a text. Strict: single blanks and one '\n' after each line; not strict: any blanks, and comments.
class Reader
{
public:
  Reader(const std::string& name, const std::string& text, bool strict)
    : name(name), next(text.data()), end(next + text.size()), strict(strict)
  {
    if(!strict) return;
    // the last line is the checksum of all before it
    const std::size_t line_size = 9 + 16 + 1;
    if(text.size() < line_size || text.compare(text.size() - line_size, 9, "checksum ") != 0 || text.back() != '\n')
      fail("the last line is not a checksum");
    end -= line_size;
    checksum = hexadecimal(crc64(text.data(), text.size() - line_size));
    if(text.compare(text.size() - 17, 16, checksum) != 0) fail("the checksum is wrong");
  }

  [[noreturn]] void fail(const std::string& what) const { throw Malformed(name + ", line " + std::to_string(line) + ": " + what); }

  std::string word()
  {
    start_token();
    const char* const first = next;
    while(next != end && static_cast<unsigned char>(*next) > ' ') ++next;
    if(next == first) fail("something is missing");
    return std::string(first, next);
  }
  Reader& expect(const std::string& text)
  {
    if(word() != text) fail("\"" + text + "\" is expected");
    return *this;
  }
  double number()
  {
    double x = 0;
    parse(x);
    if(!(std::abs(x) <= largest)) fail("a number is not finite or too large");
    return x;
  }
  Integer integer(Integer least, Integer most)
  {
    Integer n = 0;
    parse(n);
    if(n < least || n > most) fail("an integer is out of range");
    return n;
  }
  Point point()
  {
    Point p;
    for(double& x : p) x = number();
    return p;
  }
  void end_line()
  {
    if(!strict) return;
    if(next == end || *next != '\n') fail("the line does not end where it should");
    ++next;
    ++line;
    at_line_start = true;
  }
  void end_file()
  {
    if(!strict) skip_blanks();
    if(next != end) fail("there is more than there should be");
  }

  std::string checksum;

private:
  void start_token()
  {
    if(!strict) return skip_blanks();
    if(!at_line_start && (next == end || *next++ != ' ')) fail("a blank is expected");
    at_line_start = false;
  }
  void skip_blanks()
  {
    for(; next != end && (std::strchr(" \t\r\n", *next) || *next == '#'); ++next) {
      if(*next == '#') next = std::find(next, end, '\n');
      if(next == end) return;
      line += *next == '\n';
    }
  }
  template <class T>
  void parse(T& value)
  {
    start_token();
    const std::from_chars_result result = std::from_chars(next, end, value);
    if(result.ec != std::errc() || (result.ptr != end && static_cast<unsigned char>(*result.ptr) > ' ')) fail("a number is expected");
    next = result.ptr;
  }

  std::string name;
  const char *next, *end;
  bool strict, at_line_start = true;
  std::size_t line = 1;
};

typedef std::array<Integer, 3> Position;
typedef std::array<Interval, 64> Coefficients; // of a tricubic polynomial, [i + 4 j + 16 k]

struct Leaf
{
  Position position;
  Point corner;
  double radius;
  std::array<double, 64> b;
};

std::uint64_t key(const Position& p)
{
  std::uint64_t k = 0;
  for(int axis = 2; axis >= 0; --axis) k = (k << 21) | std::uint64_t(p[axis] + largest_index);
  return k;
}

bool in_range(const Position& p)
{
  return std::all_of(p.begin(), p.end(), [](Integer i) { return i >= -largest_index && i < largest_index; });
}

class Shell
{
public:
  explicit Shell(const std::string& name)
  {
    const std::string text = read_file(name);
    Reader in(name, text, true);
    in.expect("cubic_bspline_shell").expect("1").expect("ascii").end_line();
    in.expect("unit");
    if(!(in.number() > 0)) in.fail("the unit is not positive");
    in.end_line();
    in.expect("levels");
    inner = in.number();
    outer = in.number();
    if(!(inner < outer)) in.fail("the levels are not in order");
    in.end_line();
    in.expect("triangles").integer(0, (std::numeric_limits<Integer>::max)());
    in.expect("components").integer(0, (std::numeric_limits<Integer>::max)());
    in.end_line();
    in.expect("field").expect("uniform");
    origin = in.point();
    spacing = in.number();
    if(!(spacing >= 1 / largest)) in.fail("the spacing is not positive or too small");
    in.end_line();
    const Integer functions = count(in, "functions");
    for(Integer n = 0; n < functions; ++n) {
      const Position p = position(in);
      if(!function_of.emplace(key(p), function.size()).second || (n > 0 && key(p) < key(function.back().first)))
        in.fail("the functions are not in order");
      function.emplace_back(p, in.number());
      in.end_line();
    }
    const Integer leaves = count(in, "leaves");
    for(Integer n = 0; n < leaves; ++n) {
      Leaf l;
      l.position = position(in);
      in.integer(0, 1);
      l.corner = in.point();
      for(int axis = 0; axis < 3; ++axis)
        if(!is_lattice_point(axis, l.position[axis], l.corner[axis]) || !is_lattice_point(axis, l.position[axis] + 1, l.corner[axis] + spacing))
          in.fail("the corner of leaf " + std::to_string(n) + " is not the lattice point, or not exact");
      if(in.number() != spacing) in.fail("leaf " + std::to_string(n) + " is not as large as the spacing");
      l.radius = in.number();
      if(!(l.radius >= 0)) in.fail("a radius is negative");
      for(double& b : l.b) b = in.number();
      if(!leaf_of.emplace(key(l.position), leaf.size()).second || (n > 0 && key(l.position) < key(leaf.back().position)))
        in.fail("the leaves are not in order");
      leaf.push_back(l);
      in.end_line();
    }
    const Integer ranges = count(in, "facet_ranges");
    for(Integer n = 0; n < ranges; ++n) {
      const double least = in.number();
      if(!(least <= in.number())) in.fail("a facet range is empty");
      in.end_line();
    }
    in.end_file();
    checksum = in.checksum;
    for(std::size_t n = 0; n < leaf.size(); ++n)
      if(!has_coefficients_of_spline(leaf[n]))
        throw Unconfirmed("Leaf " + std::to_string(n) + ": its Bernstein coefficients are not those of the spline, up to its radius");
  }

  const Leaf* find(const Position& p) const
  {
    const auto found = in_range(p) ? leaf_of.find(key(p)) : leaf_of.end();
    return found == leaf_of.end() ? nullptr : &leaf[found->second];
  }
  Interval lattice_coordinate(int axis, const Interval& x) const { return (x - origin[axis]) / spacing; }

  // f at a point, exactly
  Rational value(const Point& p) const
  {
    Position cell;
    std::array<std::array<Rational, 4>, 3> weight;
    for(int axis = 0; axis < 3; ++axis) {
      Rational t = (Rational(p[axis]) - Rational(origin[axis])) / Rational(spacing);
      const Interval about = enclose(t);
      cell[axis] = Integer(std::floor((std::min)((std::max)(about.lo, -2. * double(largest_index)), 2. * double(largest_index))));
      if(t >= cell[axis] + 1) ++cell[axis];
      t -= cell[axis];
      const Rational s = 1 - t;
      weight[axis] = { s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6 };
    }
    std::array<double, 64> c;
    if(!find(cell) || !function_coefficients(cell, c)) throw Unconfirmed("A point is not in a leaf");
    Rational sum = 0;
    for(int n = 0; n < 64; ++n) sum += Rational(c[n]) * weight[0][n % 4] * weight[1][n / 4 % 4] * weight[2][n / 16];
    return sum;
  }

  double inner = 0, outer = 0, spacing = 0;
  Point origin;
  std::vector<Leaf> leaf;
  std::string checksum;

private:
  static Integer count(Reader& in, const char* what)
  {
    const Integer n = in.expect(what).integer(0, 1 << 30);
    in.end_line();
    return n;
  }
  static Position position(Reader& in)
  {
    Position p;
    for(Integer& i : p) i = in.integer(-largest_index + 2, largest_index - 3);
    return p;
  }
  // whether x is origin + i spacing, without rounding
  bool is_lattice_point(int axis, Integer i, double x) const
  {
    const double step = double(i) * spacing, sum = origin[axis] + step;
    if(sum == x && std::fma(double(i), spacing, -step) == 0) {
      const double back = sum - origin[axis]; // the error of the sum, by Knuth
      return (origin[axis] - (sum - back)) + (step - back) == 0;
    }
    return Rational(origin[axis]) + i * Rational(spacing) == Rational(x);
  }
  bool function_coefficients(const Position& p, std::array<double, 64>& c) const
  {
    for(int row = 0; row < 16; ++row) {
      const Position first = { p[0] - 1, p[1] - 1 + row % 4, p[2] - 1 + row / 4 };
      const auto found = function_of.find(key(first));
      if(found == function_of.end()) return false;
      // the functions are sorted, so the other three of the row follow
      for(std::size_t i = 0; i < 4; ++i) {
        const std::size_t n = found->second + i;
        if(n >= function.size() || function[n].first != Position{ first[0] + Integer(i), first[1], first[2] }) return false;
        c[i + 4 * std::size_t(row)] = function[n].second;
      }
    }
    return true;
  }
  // Makes 6^3 times the Bernstein coefficients of the function coefficients, axis by axis
  template <class Number>
  static void convert(std::array<Number, 64>& c)
  {
    for(int stride = 1; stride < 64; stride *= 4)
      for(int n = 0; n < 64; ++n)
        if(n / stride % 4 == 0) {
          Number &c0 = c[n], &c1 = c[n + stride], &c2 = c[n + 2 * stride], &c3 = c[n + 3 * stride];
          const Number twice1 = c1 + c1, twice2 = c2 + c2, four1 = twice1 + twice1, four2 = twice2 + twice2;
          c0 = c0 + c2 + four1;
          c3 = c1 + c3 + four2;
          c1 = four1 + twice2;
          c2 = twice1 + four2;
        }
  }
  bool has_coefficients_of_spline(const Leaf& l) const
  {
    std::array<double, 64> c;
    if(!function_coefficients(l.position, c)) return false;
    Coefficients enclosure;
    std::copy(c.begin(), c.end(), enclosure.begin());
    convert(enclosure);
    const double allowed = down(216 * l.radius);
    bool close = true;
    for(int n = 0; n < 64 && close; ++n) {
      const Interval difference = Interval(216) * l.b[n] - enclosure[n];
      close = difference.lo >= -allowed && difference.hi <= allowed;
    }
    if(close) return true;
    std::array<Rational, 64> exact;
    std::copy(c.begin(), c.end(), exact.begin());
    convert(exact);
    for(int n = 0; n < 64; ++n)
      if(abs(Rational(l.b[n]) * 216 - exact[n]) > Rational(l.radius) * 216) return false;
    return true;
  }

  std::vector<std::pair<Position, double>> function;
  std::unordered_map<std::uint64_t, std::size_t> function_of, leaf_of;
};

class Disjoint_sets
{
public:
  explicit Disjoint_sets(std::size_t size) : parent(size) { std::iota(parent.begin(), parent.end(), std::size_t(0)); }
  std::size_t find(std::size_t i)
  {
    while(parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) { parent[find(i)] = find(j); }

private:
  std::vector<std::size_t> parent;
};

struct Mesh
{
  explicit Mesh(const std::string& name)
  {
    const std::string text = read_file(name);
    Reader in(name, text, false);
    in.expect("OFF");
    const Integer points = in.integer(0, 1 << 30), facets = in.integer(1, 1 << 30);
    in.integer(0, (std::numeric_limits<Integer>::max)());
    for(Integer n = 0; n < points; ++n) point.push_back(in.point());
    for(Integer n = 0; n < facets; ++n) {
      if(in.integer(0, 1 << 30) != 3) in.fail("a facet is not a triangle");
      std::array<std::uint32_t, 3> f;
      for(std::uint32_t& v : f) v = std::uint32_t(in.integer(0, points - 1));
      facet.push_back(f);
    }
    in.end_file();

    std::string bytes;
    const auto append = [&](std::uint64_t number, int size) { while(size-- > 0) { bytes += char(number & 255); number >>= 8; } };
    for(const Point& p : point)
      for(double x : p) {
        std::uint64_t bits;
        std::memcpy(&bits, &x, sizeof x);
        append(bits, 8);
      }
    for(const auto& f : facet)
      for(std::uint32_t v : f) append(v, 4);
    checksum = hexadecimal(crc64(bytes.data(), bytes.size()));

    Disjoint_sets sets(point.size());
    for(const auto& f : facet) {
      sets.join(f[0], f[1]);
      sets.join(f[0], f[2]);
    }
    // components are numbered by their first facets; vertices without facets have none
    std::vector<std::size_t> number(point.size(), none);
    for(const auto& f : facet)
      if(number[sets.find(f[0])] == none) number[sets.find(f[0])] = components++;
    for(std::size_t v = 0; v < point.size(); ++v) component.push_back(number[sets.find(v)]);
  }
  std::array<Point, 3> triangle(std::size_t f) const { return { point[facet[f][0]], point[facet[f][1]], point[facet[f][2]] }; }

  // whether every edge has two facets that pass it in opposite directions
  bool is_closed_and_oriented() const
  {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edge, opposite;
    for(const auto& f : facet)
      for(int i = 0; i < 3; ++i) {
        if(f[i] == f[(i + 1) % 3]) return false;
        edge.emplace_back(f[i], f[(i + 1) % 3]);
        opposite.emplace_back(f[(i + 1) % 3], f[i]);
      }
    std::sort(edge.begin(), edge.end());
    std::sort(opposite.begin(), opposite.end());
    return edge == opposite && std::adjacent_find(edge.begin(), edge.end()) == edge.end();
  }

  static const std::size_t none = std::size_t(-1);
  std::vector<Point> point;
  std::vector<std::array<std::uint32_t, 3>> facet;
  std::vector<std::size_t> component; // of each vertex
  std::size_t components = 0;
  std::string checksum;
};

struct Box
{
  std::size_t leaf;
  int depth;
  Position place; // of the least corner, in edges of the box from that of the leaf
  char kind;
  Point direction;

  Integer edge() const { return leaf_edge >> depth; }
  bool is_cover() const { return kind == 'g' || kind == 'u'; }
};

struct Path
{
  std::size_t component, facet;
  Point p, q;
};

struct Certificate
{
  Certificate(const std::string& name, const Shell& shell, const Mesh& mesh)
  {
    const std::string text = read_file(name);
    Reader in(name, text, true);
    in.expect("cubic_bspline_shell_certificate").expect("1").end_line();
    if(in.expect("shell").word() != shell.checksum) in.fail("the certificate is for another shell");
    in.end_line();
    const Integer vertices = in.expect("mesh").integer(0, 1 << 30), facets = in.integer(0, 1 << 30);
    if(std::size_t(vertices) != mesh.point.size() || std::size_t(facets) != mesh.facet.size() || in.word() != mesh.checksum)
      in.fail("the certificate is for another mesh");
    in.end_line();
    in.expect("verdicts");
    for(bool& claim : claimed) {
      const std::string verdict = in.word();
      claim = verdict == "proved";
      if(!claim && verdict != "refuted" && verdict != "undecided") in.fail("a verdict is none of the three");
    }
    in.end_line();
    const Integer boxes = in.expect("boxes").integer(0, 1 << 30);
    in.end_line();
    for(Integer n = 0; n < boxes; ++n) {
      Box b;
      b.leaf = std::size_t(in.integer(box.empty() ? 0 : Integer(box.back().leaf), Integer(shell.leaf.size()) - 1));
      b.depth = int(in.integer(0, largest_depth));
      for(Integer& i : b.place) i = in.integer(0, (Integer(1) << b.depth) - 1);
      const std::string kind = in.word();
      if(kind.size() != 1 || !std::strchr("xguo", kind[0])) in.fail("the kind of a box is none of x, g, u and o");
      b.kind = kind[0];
      b.direction = b.kind == 'g' ? in.point() : Point{ 0, 0, 0 };
      box.push_back(b);
      in.end_line();
    }
    if(std::size_t(in.expect("seeds").integer(0, 1 << 30)) != mesh.components) in.fail("there is not one seed for each component");
    in.end_line();
    for(Integer n = 0; n < Integer(mesh.components); ++n) {
      in.integer(n, n);
      seed.push_back(std::size_t(in.integer(0, vertices - 1)));
      if(mesh.component[seed.back()] != std::size_t(n)) in.fail("a seed is not a vertex of its component");
      in.end_line();
    }
    covers = std::size_t(in.expect("covers").integer(0, 1 << 30));
    in.end_line();
    const Integer paths = in.expect("paths").integer(0, Integer(mesh.components));
    in.end_line();
    for(Integer n = 0; n < paths; ++n) {
      Path p;
      p.component = std::size_t(in.integer(path.empty() ? 0 : Integer(path.back().component) + 1, Integer(mesh.components) - 1));
      p.facet = std::size_t(in.integer(0, facets - 1));
      p.p = in.point();
      p.q = in.point();
      path.push_back(p);
      in.end_line();
    }
    in.end_file();
  }

  std::array<bool, 5> claimed;
  std::vector<Box> box;
  std::vector<std::size_t> seed; // a vertex of each component
  std::size_t covers = 0;
  std::vector<Path> path;
};

// ------------------------------------------------------------------------------------------------- bounds of polynomials

// Homogeneous polynomials in three variables by the coefficients of their monomials, those of x^a y^b z^c by rising (a, b).
constexpr int number_of_terms(int degree) { return (degree + 1) * (degree + 2) / 2; }

template <int DEGREE>
std::array<std::array<int, 3>, number_of_terms(DEGREE)> exponents()
{
  std::array<std::array<int, 3>, number_of_terms(DEGREE)> result;
  int n = 0;
  for(int a = 0; a <= DEGREE; ++a)
    for(int b = 0; b <= DEGREE - a; ++b) result[n++] = { a, b, DEGREE - a - b };
  return result;
}

template <int DEGREE>
struct Polynomial : std::array<Interval, number_of_terms(DEGREE)> {};

template <int D, int E>
void add_product(const Polynomial<D>& p, const Polynomial<E>& q, Polynomial<D + E>& sum)
{
  static const auto index = [] {
    std::array<std::array<int, number_of_terms(E)>, number_of_terms(D)> table;
    const auto first = exponents<D>();
    const auto second = exponents<E>();
    const auto all = exponents<D + E>();
    for(std::size_t i = 0; i < first.size(); ++i)
      for(std::size_t j = 0; j < second.size(); ++j) {
        const std::array<int, 3> e = { first[i][0] + second[j][0], first[i][1] + second[j][1], first[i][2] + second[j][2] };
        table[i][j] = int(std::find(all.begin(), all.end(), e) - all.begin());
      }
    return table;
  }();
  for(std::size_t i = 0; i < p.size(); ++i)
    for(std::size_t j = 0; j < q.size(); ++j) {
      Interval& s = sum[index[i][j]];
      s = s + p[i] * q[j];
    }
}

template <int D, int E>
Polynomial<D + E> operator*(const Polynomial<D>& p, const Polynomial<E>& q)
{
  Polynomial<D + E> product;
  add_product(p, q, product);
  return product;
}

typedef std::array<std::array<Interval, 3>, 3> Triangle; // its corners' coordinates

// Range of a tricubic polynomial on a triangle, in coordinates for which the leaf is the unit cube. The polynomial is
// written in barycentric coordinates; its Bernstein coefficients are those of the monomials over the multinomials.
Interval range_on_triangle(const Coefficients& b, const Triangle& corner)
{
  std::array<std::array<Polynomial<3>, 4>, 3> bernstein;
  for(int axis = 0; axis < 3; ++axis) {
    Polynomial<1> u, v;
    for(int i = 0; i < 3; ++i) {
      // exponents<1>() begins with the third variable
      u[i] = corner[2 - i][axis];
      v[i] = Interval(1) - u[i];
    }
    const Polynomial<2> uu = u * u, vv = v * v;
    bernstein[axis] = { vv * v, vv * u, uu * v, uu * u };
    for(int i = 1; i < 3; ++i)
      for(Interval& c : bernstein[axis][i]) c = c * 3;
  }
  Polynomial<9> f;
  for(int k = 0; k < 4; ++k) {
    Polynomial<6> plane;
    for(int j = 0; j < 4; ++j) {
      Polynomial<3> row;
      for(std::size_t n = 0; n < row.size(); ++n)
        for(int i = 0; i < 4; ++i) row[n] = row[n] + b[i + 4 * j + 16 * k] * bernstein[0][i][n];
      add_product(row, bernstein[1][j], plane);
    }
    add_product(plane, bernstein[2][k], f);
  }
  static const auto exponents_of_f = exponents<9>();
  const double factorial[] = { 1, 1, 2, 6, 24, 120, 720, 5040, 40320, 362880 };
  for(std::size_t n = 0; n < f.size(); ++n) {
    const auto& e = exponents_of_f[n];
    f[n] = f[n] / (factorial[9] / (factorial[e[0]] * factorial[e[1]] * factorial[e[2]]));
  }
  return hull(f);
}

// Half of the unit cube's polynomial along an axis, by de Casteljau
void halve(Coefficients& b, int axis, bool upper)
{
  const int stride = axis == 0 ? 1 : axis == 1 ? 4 : 16;
  const auto middle = [](const Interval& x, const Interval& y) { return (x + y) / 2; };
  for(int n = 0; n < 64; ++n)
    if(n / stride % 4 == 0) {
      Interval* const c[] = { &b[n], &b[n + stride], &b[n + 2 * stride], &b[n + 3 * stride] };
      const Interval m01 = middle(*c[0], *c[1]), m12 = middle(*c[1], *c[2]), m23 = middle(*c[2], *c[3]);
      const Interval m012 = middle(m01, m12), m123 = middle(m12, m23), m = middle(m012, m123);
      if(upper) {
        *c[0] = m;
        *c[1] = m123;
        *c[2] = m23;
      }
      else {
        *c[1] = m01;
        *c[2] = m012;
        *c[3] = m;
      }
    }
}

// The coefficients of f on a leaf; those listed are within the radius of them.
Coefficients value_form(const Leaf& l)
{
  Coefficients c;
  for(int n = 0; n < 64; ++n) c[n] = Interval(l.b[n]) + Interval(-l.radius, l.radius);
  return c;
}

// The coefficients of d . grad f on a leaf times its edge, which does not change the sign; degrees raised to three again
Coefficients derivative_form(const Leaf& l, const std::array<Interval, 3>& d)
{
  const Coefficients c = value_form(l);
  Coefficients sum;
  for(int axis = 0, stride = 1; axis < 3; ++axis, stride *= 4)
    for(int n = 0; n < 64; ++n)
      if(n / stride % 4 == 0) {
        const Interval d0 = c[n + stride] - c[n], d1 = c[n + 2 * stride] - c[n + stride], d2 = c[n + 3 * stride] - c[n + 2 * stride];
        const Interval raised[] = { d0 * 3, d0 + d1 * 2, d1 * 2 + d2, d2 * 3 };
        for(int i = 0; i < 4; ++i) sum[n + i * stride] = sum[n + i * stride] + d[axis] * raised[i];
      }
  return sum;
}

// ------------------------------------------------------------------------------------------------------------- the claims

int sign(const Rational& r) { return r.sign(); }

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
  return n[0] * (Number(d[0]) - Number(a[0])) + n[1] * (Number(d[1]) - Number(a[1])) + n[2] * (Number(d[2]) - Number(a[2]));
}

// positive if d is on the side of (a, b, c) to which (b - a) x (c - a) points
int orientation(const Point& a, const Point& b, const Point& c, const Point& d)
{
  const Interval about = volume<Interval>(a, b, c, d);
  return about.lo > 0 ? 1 : about.hi < 0 ? -1 : sign(volume<Rational>(a, b, c, d));
}

// an enclosure of the facet's normal that is narrow even if the facet is a needle
std::array<Interval, 3> normal(const std::array<Point, 3>& t)
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
    : shell(shell), mesh(mesh), certificate(certificate), cover(certificate.box.size())
  {}

  void check()
  {
    const std::array<bool, 5>& claimed = certificate.claimed;
    // the arguments for the last three follow the mesh from P1 on
    for(int i = 2; i < 5; ++i)
      if(claimed[i] && !claimed[0]) throw Unconfirmed("P" + std::to_string(i + 1) + " is claimed without P1");
    if(!mesh.is_closed_and_oriented()) throw Unconfirmed("The mesh is not closed, or its facets do not agree on a side");
    if(claimed[0] || claimed[1])
      for(std::size_t f = 0; f < mesh.facet.size(); ++f) check_facet(f);
    if(claimed[2] || claimed[3]) check_boxes();
    if(claimed[4]) check_paths();
  }

private:
  struct Candidate
  {
    Position position;
    const Leaf* leaf;
  };
  typedef std::array<std::array<Integer, 3>, 3> Corners;

  // Whether for each leaf the polynomial form(leaf) has, on the part of a triangle in that leaf, a range for which `holds`.
  // The part is the one with the given corners, barycentric coordinates in units of 2^-depth. It is subdivided until it is
  // not larger than a cell; then the leaves that it may meet are the candidates, of which the undecided remain.
  template <class Form, class Holds>
  bool holds_on(const std::array<Point, 3>& t, const Form& form, const Holds& holds,
                const Corners& corners = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, int depth = 0, int levels = triangle_levels,
                const std::vector<Candidate>* candidates = nullptr) const
  {
    Triangle corner;
    std::array<Interval, 3> least; // per axis, in cells
    bool large = false;
    for(int axis = 0; axis < 3; ++axis) {
      for(int i = 0; i < 3; ++i) {
        Interval x;
        for(int j = 0; j < 3; ++j)
          if(corners[i][j] != 0) x = x + Interval(std::ldexp(double(corners[i][j]), -depth)) * t[j][axis];
        corner[i][axis] = x;
      }
      least[axis] = shell.lattice_coordinate(axis, hull(std::array<Interval, 3>{ corner[0][axis], corner[1][axis], corner[2][axis] }));
      large = large || !(least[axis].hi - least[axis].lo <= 1);
      if(!(least[axis].lo >= double(-largest_index) && least[axis].hi < double(largest_index))) return false;
    }

    std::vector<Candidate> undecided;
    if(!large || candidates) {
      Position first, last;
      for(int axis = 0; axis < 3; ++axis) {
        first[axis] = Integer(std::floor(least[axis].lo));
        last[axis] = Integer(std::floor(least[axis].hi));
      }
      if(!candidates) {
        Position p;
        for(p[2] = first[2]; p[2] <= last[2]; ++p[2])
          for(p[1] = first[1]; p[1] <= last[1]; ++p[1])
            for(p[0] = first[0]; p[0] <= last[0]; ++p[0]) undecided.push_back({ p, shell.find(p) });
      }
      else
        for(const Candidate& c : *candidates) {
          bool meets = true;
          for(int axis = 0; axis < 3; ++axis) meets = meets && first[axis] <= c.position[axis] && c.position[axis] <= last[axis];
          if(meets) undecided.push_back(c);
        }
      undecided.erase(std::remove_if(undecided.begin(), undecided.end(), [&](const Candidate& c) {
                        if(!c.leaf) return false; // the part may turn out not to meet it
                        const Coefficients b = form(*c.leaf);
                        if(holds(hull(b))) return true;
                        Triangle local;
                        for(int i = 0; i < 3; ++i)
                          for(int axis = 0; axis < 3; ++axis) local[i][axis] = (corner[i][axis] - c.leaf->corner[axis]) / shell.spacing;
                        return holds(range_on_triangle(b, local));
                      }), undecided.end());
      if(undecided.empty()) return true;
      if(levels-- == 0) return false;
      candidates = &undecided;
    }
    else if(depth == 2 * largest_depth) return false;

    Corners middle, doubled;
    for(int i = 0; i < 3; ++i)
      for(int j = 0; j < 3; ++j) {
        middle[i][j] = corners[(i + 1) % 3][j] + corners[(i + 2) % 3][j];
        doubled[i][j] = 2 * corners[i][j];
      }
    for(const Corners& part : { middle, Corners{ doubled[0], middle[2], middle[1] }, Corners{ middle[2], doubled[1], middle[0] },
                                Corners{ middle[1], middle[0], doubled[2] } })
      if(!holds_on(t, form, holds, part, depth + 1, levels, candidates)) return false;
    return true;
  }

  bool rises_on(const std::array<Point, 3>& t, const std::array<Interval, 3>& direction) const
  {
    return holds_on(t, [&](const Leaf& l) { return derivative_form(l, direction); }, [](const Interval& r) { return r.lo > 0; });
  }

  // P1 and P2
  void check_facet(std::size_t f) const
  {
    const std::array<Point, 3> t = mesh.triangle(f);
    const auto contained = [&](const Interval& r) { return shell.inner <= r.lo && r.hi <= shell.outer; };
    if(certificate.claimed[0] && !holds_on(t, value_form, contained))
      throw Unconfirmed("P1, facet " + std::to_string(f) + ": f is not between the levels on it, or it leaves the leaves");
    if(certificate.claimed[1] && !rises_on(t, normal(t)))
      throw Unconfirmed("P2, facet " + std::to_string(f) + ": the gradient does not make an acute angle with its normal");
  }

  template <class Holds>
  static bool holds_on_cube(const Coefficients& b, const Holds& holds, int levels)
  {
    if(holds(hull(b))) return true;
    if(levels == 0) return false;
    for(int part = 0; part < 8; ++part) {
      Coefficients c = b;
      for(int axis = 0; axis < 3; ++axis) halve(c, axis, part >> axis & 1);
      if(!holds_on_cube(c, holds, levels - 1)) return false;
    }
    return true;
  }
  template <class Holds>
  static bool holds_on_box(const Box& box, Coefficients b, const Holds& holds)
  {
    if(holds(hull(b))) return true;
    for(int d = box.depth - 1; d >= 0; --d)
      for(int axis = 0; axis < 3; ++axis) halve(b, axis, box.place[axis] >> d & 1);
    return holds_on_cube(b, holds, box_levels);
  }

  // whether the boxes begin..end of a leaf are a partition of it: in the order of an octree each begins where the last ends
  bool is_partition(std::size_t begin, std::size_t end) const
  {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> range;
    for(std::size_t n = begin; n < end; ++n) {
      const Box& b = certificate.box[n];
      std::uint64_t code = 0;
      for(int d = largest_depth - 1; d >= 0; --d)
        for(int axis = 0; axis < 3; ++axis) code = (code << 1) | (std::uint64_t(b.place[axis] * b.edge()) >> d & 1);
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

  // P3 and P4. Omega* is in the cover: each component of A begins in a cover box (at its seed), and {EPS1 <= f <= EPS2} is
  // connected to it through cover boxes only, because around these are other cover boxes and excluded ones.
  void check_boxes()
  {
    const std::vector<Box>& box = certificate.box;
    std::vector<std::size_t> begin(shell.leaf.size() + 1, box.size());
    for(std::size_t n = box.size(); n-- > 0;) begin[box[n].leaf] = n;
    for(std::size_t l = shell.leaf.size(); l-- > 0;) begin[l] = (std::min)(begin[l], begin[l + 1]);

    for(std::size_t l = 0; l < shell.leaf.size(); ++l)
      if(begin[l] < begin[l + 1] && !is_partition(begin[l], begin[l + 1]))
        throw Unconfirmed("P3, leaf " + std::to_string(l) + ": its boxes are not a partition of it");
    for(std::size_t n = 0; n < box.size(); ++n) check_range(n);
    for(std::size_t n = 0; n < box.size(); ++n)
      if(box[n].is_cover()) check_surroundings(n, begin);

    std::vector<std::size_t> root;
    for(std::size_t n = 0; n < box.size(); ++n)
      if(box[n].is_cover() && cover.find(n) == n) root.push_back(n);
    if(root.size() != certificate.covers)
      throw Unconfirmed("P4: the cover has " + std::to_string(root.size()) + " components, not " + std::to_string(certificate.covers));
    std::vector<std::size_t> root_of_seed;
    for(std::size_t c = 0; c < mesh.components; ++c) root_of_seed.push_back(cover.find(cover_box_of_seed(c, begin)));
    if(!certificate.claimed[3]) return;
    std::sort(root_of_seed.begin(), root_of_seed.end());
    if(root_of_seed != root) throw Unconfirmed("P4: a component of the cover does not contain exactly one component of the mesh");
  }

  // what is claimed about f on a box
  void check_range(std::size_t n) const
  {
    const Box& b = certificate.box[n];
    const Leaf& l = shell.leaf[b.leaf];
    const std::string name = "P3, box " + std::to_string(n) + " (leaf " + std::to_string(b.leaf) + "): ";
    if(b.kind == 'x' && !holds_on_box(b, value_form(l), [&](const Interval& r) { return r.hi < shell.inner || r.lo > shell.outer; }))
      throw Unconfirmed(name + "f is not less than the inner level, nor greater than the outer one, on all of it");
    if(!certificate.claimed[2]) return;
    if(b.kind == 'u') throw Unconfirmed(name + "it is undecided");
    if(b.kind == 'g' && !holds_on_box(b, derivative_form(l, { b.direction[0], b.direction[1], b.direction[2] }),
                                      [](const Interval& r) { return r.lo > 0; }))
      throw Unconfirmed(name + "f does not rise in its direction on all of it");
  }

  // Cover boxes and excluded ones have to surround a cover box; it is joined with the former.
  void check_surroundings(std::size_t n, const std::vector<std::size_t>& begin)
  {
    const Box& b = certificate.box[n];
    const std::string name = "P3, box " + std::to_string(n) + " (leaf " + std::to_string(b.leaf) + "): ";
    for(int part = 0; part < 27; ++part) {
      const Position step = { part % 3 - 1, part / 3 % 3 - 1, part / 9 - 1 };
      Position low, high, there = shell.leaf[b.leaf].position; // the box as seen from the leaf that is one step away
      bool meets = true;
      for(int axis = 0; axis < 3; ++axis) {
        there[axis] += step[axis];
        low[axis] = b.place[axis] * b.edge() - step[axis] * leaf_edge;
        high[axis] = low[axis] + b.edge();
        meets = meets && low[axis] <= leaf_edge && high[axis] >= 0;
      }
      if(!meets) continue;
      const Leaf* const leaf = shell.find(there);
      const std::size_t l = leaf ? std::size_t(leaf - shell.leaf.data()) : 0;
      if(!leaf || begin[l] == begin[l + 1]) throw Unconfirmed(name + "a cell that it touches has no boxes");
      for(std::size_t m = begin[l]; m < begin[l + 1]; ++m) {
        const Box& other = certificate.box[m];
        if(other.kind == 'x') continue;
        bool touch = true;
        for(int axis = 0; axis < 3; ++axis) {
          const Integer least = other.place[axis] * other.edge();
          touch = touch && low[axis] <= least + other.edge() && least <= high[axis];
        }
        if(!touch) continue;
        if(other.kind == 'o') throw Unconfirmed(name + "it touches box " + std::to_string(m) + ", about which nothing is claimed");
        cover.join(n, m);
      }
    }
  }

  std::size_t cover_box_of_seed(std::size_t component, const std::vector<std::size_t>& begin) const
  {
    const Point& p = mesh.point[certificate.seed[component]];
    Position base;
    for(int axis = 0; axis < 3; ++axis) {
      const double about = (p[axis] - shell.origin[axis]) / shell.spacing;
      base[axis] = std::abs(about) < double(largest_index) ? Integer(std::floor(about)) : 2 * largest_index;
    }
    for(int part = 0; part < 27; ++part) {
      const Leaf* const leaf = shell.find({ base[0] + part % 3 - 1, base[1] + part / 3 % 3 - 1, base[2] + part / 9 - 1 });
      if(!leaf) continue;
      std::array<Rational, 3> x; // in the units of places of boxes
      for(int axis = 0; axis < 3; ++axis)
        x[axis] = (Rational(p[axis]) - Rational(leaf->corner[axis])) / Rational(shell.spacing) * leaf_edge;
      const std::size_t l = std::size_t(leaf - shell.leaf.data());
      for(std::size_t n = begin[l]; n < begin[l + 1]; ++n) {
        const Box& b = certificate.box[n];
        bool contains = b.is_cover();
        for(int axis = 0; axis < 3 && contains; ++axis) {
          const Integer least = b.place[axis] * b.edge();
          contains = x[axis] >= least && x[axis] <= least + b.edge();
        }
        if(contains) return n;
      }
    }
    throw Unconfirmed("P3, component " + std::to_string(component) + ": its seed is in no cover box");
  }

  // P5
  void check_paths() const
  {
    if(certificate.path.size() != mesh.components) throw Unconfirmed("P5: there is not one path for each component");
    for(const Path& path : certificate.path) {
      const std::string name = "P5, path " + std::to_string(path.component) + ": ";
      if(mesh.component[mesh.facet[path.facet][0]] != path.component) throw Unconfirmed(name + "its facet is of another component");
      if(!(shell.value(path.p) < Rational(shell.inner))) throw Unconfirmed(name + "it does not begin below the inner level");
      if(!(shell.value(path.q) > Rational(shell.outer))) throw Unconfirmed(name + "it does not end above the outer level");
      std::array<Interval, 3> direction;
      for(int i = 0; i < 3; ++i) direction[i] = Interval(path.q[i]) - Interval(path.p[i]);
      if(!rises_on({ path.p, path.q, path.q }, direction)) throw Unconfirmed(name + "f does not rise on all of it, or it leaves the leaves");
      int count = 0;
      bool crosses = false; // the path's own facet
      for(std::size_t f = 0; f < mesh.facet.size(); ++f) {
        const int crossing = cross_facet(path, mesh.triangle(f), name + "at facet " + std::to_string(f));
        count += crossing;
        crosses = crosses || (f == path.facet && crossing != 0);
      }
      if(count != 1) throw Unconfirmed(name + "it crosses the mesh with count " + std::to_string(count));
      if(!crosses) throw Unconfirmed(name + "it does not cross its facet");
    }
  }

  // 1 if the path passes through the interior of the facet to its positive side, -1 if to the other, 0 if they are disjoint
  static int cross_facet(const Path& path, const std::array<Point, 3>& t, const std::string& name)
  {
    for(int axis = 0; axis < 3; ++axis) {
      const auto range = std::minmax({ t[0][axis], t[1][axis], t[2][axis] });
      if((std::max)(path.p[axis], path.q[axis]) < range.first || (std::min)(path.p[axis], path.q[axis]) > range.second) return 0;
    }
    const int at_p = orientation(t[0], t[1], t[2], path.p), at_q = orientation(t[0], t[1], t[2], path.q);
    if(at_p * at_q > 0) return 0;
    bool left = false, right = false, on = at_p * at_q == 0; // where the edges pass the line of the path
    for(int i = 0; i < 3; ++i) {
      const int side = orientation(path.p, path.q, t[i], t[(i + 1) % 3]);
      (side > 0 ? left : side < 0 ? right : on) = true;
    }
    if(left && right) return 0;
    if(on) throw Unconfirmed(name + " it does not pass through the interior");
    return at_q;
  }

  const Shell& shell;
  const Mesh& mesh;
  const Certificate& certificate;
  Disjoint_sets cover;
};

int main(int argc, char** argv)
{
  if(argc != 4) {
    std::cerr << "Usage: check_certificate SHELL.shell.txt MESH.off CERTIFICATE.certificate.txt" << std::endl;
    return 2;
  }
  if(!usable_arithmetic()) {
    std::cerr << "Double arithmetic is not that of IEEE 754 rounded to nearest: compile without -ffast-math and the like" << std::endl;
    return 2;
  }
  try {
    const Shell shell(argv[1]);
    const Mesh mesh(argv[2]);
    const Certificate certificate(argv[3], shell, mesh);
    Checker(shell, mesh, certificate).check();
    std::cout << "certified:";
    for(int i = 0; i < 5; ++i)
      if(certificate.claimed[i]) std::cout << " P" << i + 1;
    std::cout << std::endl;
    return 0;
  }
  catch(const Unconfirmed& error) {
    std::cerr << error.what() << std::endl;
    return 1;
  }
  catch(const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
}
