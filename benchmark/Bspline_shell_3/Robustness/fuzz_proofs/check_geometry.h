// Checks normals, windings, crossings, and arithmetic of enclosed polynomials, by exact closed forms and brute force.
#ifndef CHECK_GEOMETRY_H
#define CHECK_GEOMETRY_H

#include "Exact_shell.h"

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Mesh/fan_winding.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

// Returns how often the link turns around the axis through `p`: the number of edges that pass a half-plane bounded by
// the axis. If an edge does not turn forwards, returns zero.
inline int exact_turns(CGAL::Random& random, const Dyadic_vector& p, const Dyadic_vector& axis,
                       const std::vector<Point_3>& link)
{
  std::vector<Dyadic_vector> spokes;
  for(const Point_3& q : link) spokes.push_back(minus(dyadic(q), p));
  for(std::size_t n = 0; n < spokes.size(); ++n)
    if(sign(dot(axis, cross(spokes[n], spokes[(n + 1) % spokes.size()]))) <= 0) return 0;
  for(;;) {
    const Dyadic_vector half_plane = dyadic(random_direction(random));
    int turns = 0;
    bool is_generic = true;
    for(std::size_t n = 0; n < spokes.size() && is_generic; ++n) {
      const int begin = sign(dot(axis, cross(half_plane, spokes[n]))),
                end = sign(dot(axis, cross(half_plane, spokes[(n + 1) % spokes.size()])));
      is_generic = begin != 0 && end != 0;
      // Less than half a turn forwards, from one side of the line to the other, passes the half-plane or the opposite
      // one.
      turns += begin < 0 && end > 0;
    }
    if(is_generic) return turns;
  }
}

inline void check_winding(Tally& tally, CGAL::Random& random)
{
  const double scale = std::ldexp(1., random.get_int(-150, 151)),
               far = chance(random, 0.3) ? std::ldexp(1., random.get_int(0, 40)) : 1;
  const Vector p = far * random_vector(random), axis = random_direction(random),
               x = axis.cross(random_direction(random)).normalized(), y = axis.cross(x);
  const int number = random.get_int(3, 12), turns = random.get_int(1, 4);
  const double noise = power_of_ten(random, -17, 0);
  std::vector<Point_3> link;
  const auto point = [&](const Vector& v) { return Point_3(scale * v[0], scale * v[1], scale * v[2]); };
  for(int n = 0; n < number; ++n) {
    const double angle = 2 * CGAL_PI * n * turns / number + noise * random.get_double(-1, 1);
    link.push_back(point(p + power_of_ten(random, -2, 1) * (std::cos(angle) * x + std::sin(angle) * y)
                         + random.get_double(-1, 1) * axis));
  }
  const Point_3 at = point(p), on_axis = point(p + axis);
  const int truth = exact_turns(random, dyadic(at), minus(dyadic(on_axis), dyadic(at)), link);
  tally.count("winding", int(BS::link_winding_number(at, on_axis, link)) == truth,
              "wrong around" + describe(Segment{ at, on_axis }));
}

inline void check_normal(Tally& tally, CGAL::Random& random)
{
  const double scale = std::ldexp(1., random.get_int(-300, 301)),
               far = chance(random, 0.5) ? std::ldexp(1., random.get_int(0, 50)) : 1;
  Vector u[3];
  u[0] = far * random_vector(random);
  for(int v = 1; v < 3; ++v) u[v] = u[0] + power_of_ten(random, -8, 0) * random_vector(random);
  if(chance(random, 0.5))
    u[2] = u[0] + random.get_double(-1, 2) * (u[1] - u[0]) + power_of_ten(random, -17, -5) * random_vector(random);
  for(int a = 0; a < 3; ++a)
    if(chance(random, 0.2)) u[2][a] = u[1][a] = u[0][a];
  Triangle t;
  for(int v = 0; v < 3; ++v) t[v] = Point_3(scale * u[v][0], scale * u[v][1], scale * u[v][2]);
  if(is_degenerate(t)) return;
  const BS::Facet_normal found = BS::facet_normal(t[0], t[1], t[2]);
  const Dyadic_vector n = cross(minus(dyadic(t[1]), dyadic(t[0])), minus(dyadic(t[2]), dyadic(t[0])));
  // Factors l with |l n_a - d_a| <= r lie between quotients. Lower ones must not exceed upper ones, and an upper one
  // must be positive.
  bool is_right = true;
  std::vector<std::pair<Dyadic, Dyadic> > lower, upper; // numerators and positive denominators
  for(int a = 0; a < 3; ++a) {
    const int s = sign(n[a]);
    const Dyadic d = Dyadic(s < 0 ? -found.direction[a] : found.direction[a]), size = s < 0 ? Dyadic(0) - n[a] : n[a],
                 r(found.radius);
    if(s == 0) {
      is_right = is_right && d <= r && Dyadic(0) - d <= r;
      continue;
    }
    lower.emplace_back(d - r, size);
    upper.emplace_back(d + r, size);
  }
  for(const auto& u : upper) {
    is_right = is_right && sign(u.first) > 0;
    for(const auto& l : lower) is_right = is_right && l.first * u.second <= u.first * l.second;
  }
  tally.count("facet_normal", is_right, "wrong for" + describe(t));
}

// Returns a closed surface: a double pyramid over a star or a polygon, with displaced vertices.
inline CGAL::Surface_mesh<Point_3> random_bipyramid(CGAL::Random& random, int sides, int turns, double noise,
                                                    double scale)
{
  CGAL::Surface_mesh<Point_3> mesh;
  const auto add = [&](const Vector& v) {
    const Vector moved = scale * (v + noise * random_vector(random));
    return mesh.add_vertex(Point_3(moved[0], moved[1], moved[2]));
  };
  const auto north = add({ 0, 0, 1 }), south = add({ 0, 0, -1 });
  std::vector<CGAL::SM_Vertex_index> link;
  for(int n = 0; n < sides; ++n) {
    const double angle = 2 * CGAL_PI * n * turns / sides;
    link.push_back(add({ std::cos(angle), std::sin(angle), 0 }));
  }
  for(int n = 0; n < sides; ++n) {
    mesh.add_face(link[n], link[(n + 1) % sides], north);
    mesh.add_face(link[(n + 1) % sides], link[n], south);
  }
  return mesh;
}

template <typename Mesh, typename Face>
Triangle triangle_of(const Mesh& mesh, Face f)
{
  const auto h = mesh.halfedge(f);
  return { mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))) };
}

// Returns whether a segment in the plane of a triangle meets it, by projection along the largest component of the
// normal.
inline bool meet_in_plane(const Triangle& t, const Point_3& p, const Point_3& q)
{
  const Exact_slope slope(t);
  int axis = 0;
  while(sign(slope.normal()[axis]) == 0) ++axis;
  const auto side = [&](const Point_3& a, const Point_3& b, const Point_3& c) {
    const Dyadic_vector n = cross(minus(dyadic(b), dyadic(a)), minus(dyadic(c), dyadic(a)));
    return sign(n[axis]);
  };
  // Two closed convex sets in a plane are disjoint if and only if the line of an edge separates them. For a point, it
  // is an edge of the triangle.
  const auto separates = [&](const Point_3& a, const Point_3& b, const std::vector<Point_3>& first,
                             const std::vector<Point_3>& second) {
    for(int s : { 1, -1 }) {
      bool is_separated = true;
      for(const Point_3& x : first) is_separated = is_separated && s * side(a, b, x) >= 0;
      for(const Point_3& x : second) is_separated = is_separated && s * side(a, b, x) < 0;
      if(is_separated) return true;
    }
    return false;
  };
  const std::vector<Point_3> triangle(t.begin(), t.end()), segment = { p, q };
  for(int v = 0; v < 3; ++v)
    if(separates(t[v], t[(v + 1) % 3], triangle, segment)) return false;
  return !separates(p, q, segment, triangle);
}

enum class Crossing
{
  NONE,
  UPWARDS,
  DOWNWARDS,
  TOUCHES
};
inline Crossing exact_crossing(const Triangle& t, const Point_3& p, const Point_3& q)
{
  const auto volume = [](const Point_3& a, const Point_3& b, const Point_3& c, const Point_3& d) {
    return sign(dot(minus(dyadic(d), dyadic(a)), cross(minus(dyadic(b), dyadic(a)), minus(dyadic(c), dyadic(a)))));
  };
  const int at_p = volume(t[0], t[1], t[2], p), at_q = volume(t[0], t[1], t[2], q);
  if(at_p == 0 && at_q == 0) return meet_in_plane(t, p, q) ? Crossing::TOUCHES : Crossing::NONE;
  if(at_p * at_q > 0) return Crossing::NONE;
  const int s[3] = { volume(p, q, t[0], t[1]), volume(p, q, t[1], t[2]), volume(p, q, t[2], t[0]) };
  const bool negative = s[0] < 0 || s[1] < 0 || s[2]< 0, positive = s[0] > 0 || s[1] > 0 || s[2] > 0,
             zero = s[0] == 0 || s[1] == 0 || s[2] == 0;
  if(negative && positive) return Crossing::NONE;
  if(zero || at_p == 0 || at_q == 0) return Crossing::TOUCHES;
  return at_q > 0 ? Crossing::UPWARDS : Crossing::DOWNWARDS;
}

inline void check_crossings(Tally& tally, CGAL::Random& random)
{
  const int sides = random.get_int(3, 9);
  const double scale = std::ldexp(1., random.get_int(-150, 151));
  const bool on_lattice = chance(random, 0.3);
  auto mesh = random_bipyramid(random, sides, random.get_int(1, 3),
                               chance(random, 0.5) ? 0 : power_of_ten(random, -16, 0), 1);
  for(auto v : mesh.vertices()) {
    auto& p = mesh.point(v);
    if(on_lattice) p = Point_3(std::nearbyint(4 * p.x()), std::nearbyint(4 * p.y()), std::nearbyint(4 * p.z()));
    p = Point_3(scale * p.x(), scale * p.y(), scale * p.z());
  }
  for(auto f : mesh.faces())
    if(is_degenerate(triangle_of(mesh, f))) return;
  const BS::Crossing_counter_3 counter(mesh);
  const std::vector<CGAL::SM_Vertex_index> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for(int n = 0; n < 16; ++n) {
    const auto end = [&]() {
      Vector v = 1.5 * random_vector(random);
      if(on_lattice)
        for(int a = 0; a < 3; ++a) v[a] = std::nearbyint(4 * v[a]);
      if(chance(random, 0.1)) return mesh.point(vertices[std::size_t(random.get_int(0, int(vertices.size())))]);
      return Point_3(scale * v[0], scale * v[1], scale * v[2]);
    };
    Point_3 p = end(), q = end();
    if(chance(random, 0.3)) { // nearly through an edge or a vertex
      const Point_3 a = mesh.point(vertices[std::size_t(random.get_int(0, int(vertices.size())))]),
                    b = mesh.point(vertices[0]);
      const Point_3 m = CGAL::midpoint(a, b);
      q = m + (m - p);
    }
    if(p == q) continue;
    std::map<CGAL::SM_Face_index, int> crossed;
    bool touches = false;
    for(auto f : mesh.faces()) {
      const Crossing c = exact_crossing(triangle_of(mesh, f), p, q);
      touches = touches || c == Crossing::TOUCHES;
      if(c == Crossing::UPWARDS || c == Crossing::DOWNWARDS) crossed[f] = c == Crossing::UPWARDS ? 1 : -1;
    }
    const auto found = counter.crossings(p, q);
    const bool is_right = found
                            ? !touches && std::map<CGAL::SM_Face_index, int>(found->begin(), found->end()) == crossed
                                && found->size() == crossed.size()
                            : touches;
    tally.count("crossings", is_right, "wrong for" + describe(Segment{ p, q }));
  }
}

// The exact results for functions within the radius of an enclosed one are within the result's radius.
inline void check_tricubics(Tally& tally, CGAL::Random& random)
{
  typedef std::array<Dyadic, 64> Exact_form;
  const int magnitude = random.get_int(-300, 301), spread = chance(random, 0.5) ? 0 : random.get_int(0, 60);
  const auto random_tricubic = [&](Exact_form& exact) {
    BS::Enclosed_tricubic f;
    const double mean = chance(random, 0.3) ? random.get_double(-1, 1) : 0,
                 variation = mean == 0 ? 1 : power_of_ten(random, -16, 0);
    f.radius = chance(random, 0.3) ? 0 : std::ldexp(power_of_ten(random, -18, -1), magnitude);
    for(int n = 0; n < 64; ++n) {
      f.coefficients[n] = std::ldexp(mean + variation * random.get_double(-1, 1),
                                     magnitude - (spread ? random.get_int(0, spread) : 0));
      exact[n] = Dyadic(f.coefficients[n])
                 + Dyadic(chance(random, 0.5) ? sign(random) : random.get_double(-1, 1)) * Dyadic(f.radius);
    }
    return f;
  };
  const auto is_within = [](const BS::Enclosed_tricubic& f, const Exact_form& exact, int factor) {
    for(int n = 0; n < 64; ++n) {
      const Dyadic d = exact[n] - Dyadic(factor) * Dyadic(f.coefficients[n]), r = Dyadic(factor) * Dyadic(f.radius);
      if(d > r || Dyadic(0) - d > r) return false;
    }
    return true;
  };
  Exact_form f_exact, g_exact, result;
  const BS::Enclosed_tricubic f = random_tricubic(f_exact), g = random_tricubic(g_exact);
  for(int n = 0; n < 64; ++n) result[n] = f_exact[n] - g_exact[n];
  tally.count("tricubic_difference", is_within(BS::difference(f, g), result, 1), "wrong enclosure");

  std::array<double, 3> direction;
  Dyadic_vector exact_direction;
  const double radius = chance(random, 0.5) ? 0 : power_of_ten(random, -18, -1),
               size = std::ldexp(1., random.get_int(-200, 201));
  for(int a = 0; a < 3; ++a) {
    direction[a] = size * (chance(random, 0.2) ? 0 : random.get_double(-1, 1));
    exact_direction[a] = Dyadic(direction[a]) + Dyadic(size * radius) * Dyadic(sign(random));
  }
  result.fill(Dyadic(0));
  for(int axis = 0, stride = 1; axis < 3; ++axis, stride *= 4)
    for(int n = 0; n < 64; ++n) {
      if((n / stride) % 4 != 0) continue;
      const Dyadic s0 = f_exact[n + stride] - f_exact[n], s1 = f_exact[n + 2 * stride] - f_exact[n + stride],
                   s2 = f_exact[n + 3 * stride] - f_exact[n + 2 * stride];
      const Dyadic raised[4] = { Dyadic(3) * s0, s0 + Dyadic(2) * s1, Dyadic(2) * s1 + s2, Dyadic(3) * s2 };
      for(int m = 0; m < 4; ++m) result[n + m * stride] += exact_direction[axis] * raised[m];
    }
  tally.count("tricubic_derivative", is_within(BS::enclosed_derivative(f, direction, size * radius), result, 1),
              "wrong enclosure");

  const int octant = random.get_int(0, 8);
  result = f_exact;
  for(int axis = 0, stride = 1; axis < 3; ++axis, stride *= 4)
    for(int n = 0; n < 64; ++n) {
      if((n / stride) % 4 != 0) continue;
      // times eight: 8 0 0 0, 4 4 0 0, 2 4 2 0, 1 3 3 1, and mirrored
      Dyadic b[4];
      for(int m = 0; m < 4; ++m) b[m] = result[n + m * stride];
      const bool upper = (octant >> axis) & 1;
      if(upper) {
        std::swap(b[0], b[3]);
        std::swap(b[1], b[2]);
      }
      const Dyadic half[4] = { Dyadic(8) * b[0], Dyadic(4) * (b[0] + b[1]),
                               Dyadic(2) * (b[0] + b[2]) + Dyadic(4) * b[1], b[0] + b[3] + Dyadic(3) * (b[1] + b[2]) };
      for(int m = 0; m < 4; ++m) result[n + m * stride] = half[upper ? 3 - m : m];
    }
  tally.count("tricubic_octant", is_within(BS::restrict_to_octant(f, octant), result, 512), "wrong enclosure");

  // A point of a triangle in or near the cell, whose corners have errors of up to a shift.
  const double shift = chance(random, 0.5) ? 0 : power_of_ten(random, -17, -6), reach = chance(random, 0.7) ? 1 : 3;
  std::array<std::array<double, 3>, 3> corners;
  std::array<Dyadic_vector, 3> exact_corners;
  for(int v = 0; v < 3; ++v)
    for(int a = 0; a < 3; ++a) {
      corners[v][a] = chance(random, 0.2) ? random.get_int(0, 2) : 0.5 + reach * random.get_double(-0.5, 0.5);
      exact_corners[v][a] = Dyadic(corners[v][a]) + Dyadic(sign(random)) * Dyadic(shift);
    }
  const BS::Level_range range = BS::enclose_on_triangle(f, corners, shift);
  bool is_enclosed = true;
  for(int n = 0; n < 4; ++n) {
    int b[3] = {};
    if(n < 3) b[n] = 64;
    else {
      b[0] = random.get_int(0, 65);
      b[1] = random.get_int(0, 65 - b[0]);
      b[2] = 64 - b[0] - b[1];
    }
    std::array<Dyadic, 4> weight[3];
    for(int a = 0; a < 3; ++a) {
      Dyadic t(0);
      for(int v = 0; v < 3; ++v) t += Dyadic(b[v] / 64.) * exact_corners[v][a];
      const Dyadic s = Dyadic(1) - t;
      weight[a] = { s * s * s, Dyadic(3) * t * s * s, Dyadic(3) * t * t * s, t * t * t };
    }
    Dyadic value(0);
    for(int m = 0; m < 64; ++m) value += f_exact[m] * weight[0][m % 4] * weight[1][m / 4 % 4] * weight[2][m / 16];
    is_enclosed = is_enclosed && Dyadic(range.min) <= value && value <= Dyadic(range.max);
  }
  tally.count("tricubic_on_triangle", is_enclosed, "wrong enclosure");
}

// Copies of polynomials in cells are within their radius. Where cells meet, values and gradients agree.
inline void check_cells(Tally& tally, CGAL::Random& random, const Exact_field& exact)
{
  const Field& field = exact.field();
  const std::size_t stride = field.number_of_cells() / 16 + 1;
  for(std::size_t c = std::size_t(random.get_int(0, int(stride))); c < field.number_of_cells(); c += stride) {
    const auto cell = field.cell(Field::Cell_index(c));
    const auto* b = exact.bernstein(Field::Cell_index(c));
    const double radius = cell.error_radius();
    if(!b || !std::isfinite(radius)) {
      tally.count("error_radius", Verdict::UNDECIDED);
      if(!b && std::isfinite(radius)) tally.wrong("error_radius", "finite although coefficients are not");
      continue;
    }
    bool is_right = true;
    for(int n = 0; n < 64; ++n) {
      if(!std::isfinite(cell.coefficients()[n])) {
        is_right = false;
        continue;
      }
      const Dyadic d = (*b)[n] - Dyadic(216) * Dyadic(cell.coefficients()[n]), r = Dyadic(216) * Dyadic(radius);
      is_right = is_right && d <= r && Dyadic(0) - d <= r;
    }
    tally.count("error_radius", is_right, "wrong for cell " + std::to_string(c));
    // a point of a side, in all cells around it
    std::array<double, 3> p;
    const int side = random.get_int(0, 3);
    for(int a = 0; a < 3; ++a)
      p[a] = cell.corner()[a] + cell.width() * (a == side ? random.get_int(0, 2) : random.get_int(0, 9) / 8.);
    const Exact_jet here = exact.jet(Field::Cell_index(c), dyadic(p));
    const Dyadic scale = exact.scale(Field::Cell_index(c));
    bool agree = true;
    for(auto other : exact.cells_at(dyadic(p))) {
      if(!exact.bernstein(other)) continue;
      const Exact_jet there = exact.jet(other, dyadic(p));
      const Dyadic other_scale = exact.scale(other);
      agree = agree && here.value * other_scale == there.value * scale;
      for(int a = 0; a < 3; ++a) agree = agree && here.gradient[a] * other_scale == there.gradient[a] * scale;
    }
    tally.count("continuity", agree, "the field is discontinuous on a side of cell " + std::to_string(c));
  }
}

#endif // CHECK_GEOMETRY_H
