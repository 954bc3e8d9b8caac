// Checks Field_predicates_3, Second_order_bounds_3 and Shell_facet_oracle_3, on triangles close to a change of the
// verdict.
#ifndef CHECK_PREDICATES_H
#define CHECK_PREDICATES_H

#include "Exact_shell.h"
#include "check_geometry.h"

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Second_order_bounds_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>

// Returns a double near x, displaced by some units in the last place, or by a random share of `size`.
inline double nearby(CGAL::Random& random, double x, double size)
{
  if(chance(random, 0.1)) {
    for(int n = random.get_int(-2, 3); n != 0; n += n < 0 ? 1 : -1)
      x = std::nextafter(x, n < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity());
    return x;
  }
  return x + random_distance(random) * size;
}

// Returns a lower bound on a function on a simplex. If the function has a smaller value between the vertices, the bound
// is usually false, but holds at the vertices.
template <std::size_t size, typename Function>
double random_bound(CGAL::Random& random, const std::array<Point_3, size>& simplex, const Function& f,
                    double size_of_values)
{
  const double least = f(rounded_point(simplex, worst_points(simplex, f).front()));
  double at_vertices = std::numeric_limits<double>::infinity();
  for(const Point_3& p : simplex) at_vertices = (std::min)(at_vertices, f({ p[0], p[1], p[2] }));
  if(least < at_vertices && chance(random, 0.6))
    return least + (at_vertices - least) * (random.get_bool() ? random.get_double(0, 1) : power_of_ten(random, -6, 0));
  return nearby(random, least, size_of_values);
}

// Returns the magnitude of coefficients around a point.
inline double magnitude(const Field& field, const Point_3& p)
{
  const auto c = field.locate(p);
  if(c == Field::npos) return 1;
  const auto range = field.cell(c).coefficient_range();
  return (std::max)(std::abs(range.first), std::abs(range.second));
}

inline void check_compare(Tally& tally, CGAL::Random& random, const Random_cells& cells, const Exact_field& exact)
{
  const BS::Field_predicates_3<Field> predicates(exact.field());
  Vector u = cells.anywhere(random) + (chance(random, 0.1) ? 1 : 0) * random_vector(random);
  if(chance(random, 0.4))
    for(int a = 0; a < 3; ++a)
      if(random.get_bool()) u[a] = std::ldexp(std::nearbyint(std::ldexp(u[a], 2)), -2);
  const Point_3 p = cells.to_user(u);
  const Dyadic_vector at = dyadic(p);
  const double level = nearby(random, rounded_value(exact.field(), { p[0], p[1], p[2] }), magnitude(exact.field(), p));
  const auto result = predicates.compare(p, level);
  if(!result) {
    tally.count("compare", Verdict::UNDECIDED);
    Field::Cell_index c;
    // The library may use another cell at the point, on which there is no value.
    bool has_value = std::isfinite(level) && exact.locate(at, c) == Exact_field::INSIDE;
    for(auto other : exact.cells_at(at))
      has_value = has_value && exact.bernstein(other) && std::isfinite(exact.field().cell(other).error_radius());
    if(has_value) tally.wrong("compare", "no answer at" + describe(std::array<Point_3, 1>{ p }));
    return;
  }
  Field::Cell_index c;
  tally.count("compare", *result == CGAL::SMALLER ? Verdict::REFUTED : Verdict::PROVED);
  if(exact.locate(at, c) != Exact_field::INSIDE) {
    tally.wrong("compare", "answer outside the domain");
    return;
  }
  const int truth = std::isfinite(level) ? sign(exact.jet(c, at).value - Dyadic(level) * exact.scale(c))
                    : level > 0          ? -1
                                         : 1;
  if(truth != int(*result)) tally.wrong("compare", "wrong at" + describe(std::array<Point_3, 1>{ p }));
}

// Checks the field on one triangle or segment, with levels close to its extrema.
template <typename Shell, std::size_t size>
void check_levels(Tally& tally, CGAL::Random& random, const Shell& shell,
                  const BS::Field_predicates_3<typename Shell::Field>& predicates,
                  const std::array<Point_3, size>& simplex)
{
  const auto& field = shell.field();
  const auto value = [&](const std::array<double, 3>& p) { return rounded_value(field, p); };
  const auto negative = [&](const std::array<double, 3>& p) { return -value(p); };
  const double size_of_values = magnitude(field, simplex[0]),
               least = random_bound(random, simplex, value, size_of_values),
               most = -random_bound(random, simplex, negative, size_of_values);
  BS::Level_range levels;
  const bool at_least = random.get_bool(), at_most = !at_least || random.get_bool();
  levels.min = at_least ? least : least - size_of_values;
  levels.max = at_most ? most : most + size_of_values;
  if(!std::isfinite(levels.min) || !std::isfinite(levels.max)) return;
  BS::Witness witness;
  const Verdict verdict = predicates.values_within(simplex, levels, &witness);
  const auto margin = [&](const std::array<double, 3>& p) {
    return (std::min)(value(p) - levels.min, levels.max - value(p));
  };
  check_verdict(
    tally, size == 2 ? "segment_within_levels" : "triangle_within_levels", verdict, witness, shell, simplex, margin,
    [&](const typename Shell::Jets& j) {
      return j.f.value >= Dyadic(levels.min) * j.scale && j.f.value <= Dyadic(levels.max) * j.scale;
    },
    Shell::FIELD);
}

template <typename Shell>
bool is_between(const typename Shell::Jets& j)
{
  return j.f.value >= j.inner.value && j.f.value <= j.outer.value;
}

template <typename Shell, std::size_t size>
void check_thresholds(Tally& tally, const Shell& shell, const BS::Field_predicates_3<typename Shell::Field>& predicates,
                      const std::array<Point_3, size>& simplex)
{
  BS::Witness witness;
  const Verdict verdict = predicates.values_within(simplex, shell.inner(), shell.outer(), &witness);
  const auto margin = [&](const std::array<double, 3>& p) {
    return (std::min)(shell.above_inner(p), shell.below_outer(p));
  };
  check_verdict(tally, size == 2 ? "segment_within_thresholds" : "triangle_within_thresholds", verdict, witness, shell,
                simplex, margin, &is_between<Shell>, Shell::INNER | Shell::OUTER);
}

template <typename Shell>
void check_slope(Tally& tally, CGAL::Random& random, const Shell& shell,
                 const BS::Field_predicates_3<typename Shell::Field>& predicates, const Triangle& triangle)
{
  const Vector n = rounded_normal(triangle);
  const Exact_slope exact(triangle);
  const auto slope = [&](const std::array<double, 3>& p) { return n.dot(rounded_gradient(shell.field(), p)); };
  BS::Witness witness;
  Verdict verdict = predicates.crosses_upwards(triangle, &witness);
  check_verdict(
    tally, "crosses_upwards", verdict, witness, shell, triangle, slope,
    [&](const typename Shell::Jets& j) { return exact(j.f, j.scale, 0); }, Shell::FIELD);
  double bound = slope({ triangle[0][0], triangle[0][1], triangle[0][2] }) / n.norm() * random.get_double(0, 2);
  verdict = predicates.crosses_upwards(triangle, &witness, nullptr, &bound);
  if(verdict != Verdict::PROVED && bound != 0)
    tally.wrong("slope_bound", "bound without a proof on" + describe(triangle));
  check_verdict(
    tally, "slope_bound", verdict, witness, shell, triangle, slope,
    [&](const typename Shell::Jets& j) { return exact(j.f, j.scale, bound); }, Shell::FIELD);
}

template <typename Shell>
void check_segment(Tally& tally, const Shell& shell, const BS::Field_predicates_3<typename Shell::Field>& predicates,
                   const Segment& segment)
{
  const Dyadic_vector along = minus(dyadic(segment[1]), dyadic(segment[0]));
  const Vector direction(segment[1][0] - segment[0][0], segment[1][1] - segment[0][1], segment[1][2] - segment[0][2]);
  const auto slope = [&](const std::array<double, 3>& p) { return direction.dot(rounded_gradient(shell.field(), p)); };
  BS::Witness witness;
  Verdict verdict = predicates.increases(segment, &witness);
  check_verdict(
    tally, "increases", verdict, witness, shell, segment, slope,
    [&](const typename Shell::Jets& j) { return sign(dot(along, j.f.gradient)) > 0; }, Shell::FIELD);
  if constexpr(!Shell::Threshold::is_constant) {
    verdict = predicates.increases_above(segment, shell.outer(), &witness);
    check_verdict(
      tally, "increases_above", verdict, witness, shell, segment,
      [&](const std::array<double, 3>& p) {
        return slope(p) - direction.dot(rounded_gradient(shell.outer().field(), p));
      },
      [&](const typename Shell::Jets& j) { return sign(dot(along, minus(j.f.gradient, j.outer.gradient))) > 0; },
      Shell::OUTER);
  }
}

template <typename Shell>
void check_is_beyond(Tally& tally, const Shell& shell, const BS::Field_predicates_3<typename Shell::Field>& predicates,
                     const Point_3& p)
{
  for(CGAL::Sign side : { CGAL::NEGATIVE, CGAL::POSITIVE }) {
    const bool is_beyond = predicates.is_beyond(p, shell.inner(), side);
    tally.count("is_beyond", is_beyond ? Verdict::PROVED : Verdict::UNDECIDED);
    if(is_beyond
       && shell.ask(
            dyadic(p), [&](const typename Shell::Jets& j) { return sign(j.f.value - j.inner.value) == int(side); },
            Shell::INNER)
            != Shell::HOLDS)
      tally.wrong("is_beyond", "wrong at" + describe(std::array<Point_3, 1>{ p }));
  }
}

template <typename Bounds, typename Shell>
void check_examination(Tally& tally, CGAL::Random& random, const Shell& shell, const Bounds& bounds, const Triangle& t)
{
  const Vector n = rounded_normal(t);
  const Exact_slope exact(t);
  const auto margin = [&](const std::array<double, 3>& p) {
    return (std::min)(shell.above_inner(p), shell.below_outer(p));
  };
  const auto slope = [&](const std::array<double, 3>& p) { return n.dot(rounded_gradient(shell.field(), p)); };
  const double wanted = random.get_bool() ? 0
                                          : slope({ t[0][0], t[0][1], t[0][2] }) / n.norm() * random.get_double(0, 2);
  const auto found = bounds.examine({ bounds.sample(t[0]), bounds.sample(t[1]), bounds.sample(t[2]) },
                                    BS::facet_normal(t[0], t[1], t[2]), 1024, wanted);
  const auto faces_along = [&](const typename Shell::Jets& j) {
    return exact(j.f, j.scale, found.is_transversal ? found.slope : 0);
  };
  check_verdict(tally, "examine_contained", found.is_contained ? Verdict::PROVED : Verdict::UNDECIDED, BS::Witness(),
                shell, t, margin, &is_between<Shell>, Shell::INNER | Shell::OUTER);
  check_verdict(tally, "examine_transversal", found.is_transversal ? Verdict::PROVED : Verdict::UNDECIDED,
                BS::Witness(), shell, t, slope, faces_along, Shell::FIELD);
}

// Checks single facets, and fans.
template <typename Shell>
void check_oracle(Tally& tally, CGAL::Random& random, const Shell& shell, const Triangle& t)
{
  typedef typename Shell::Field Field;
  typedef typename Shell::Threshold Threshold;
  BS::Shell_report report;
  report.status = BS::Shell_status::SUCCESS;
  const CGAL::Bspline_shell_3<Field, Threshold> all(shell.field(), shell.inner(), shell.outer(),
                                                    std::vector<char>(shell.field().number_of_cells(), 1), {}, report);
  const BS::Shell_facet_oracle_3<Field, Threshold> oracle(all);
  const auto margin = [&](const std::array<double, 3>& p) {
    return (std::min)(shell.above_inner(p), shell.below_outer(p));
  };
  const auto check_accepted = [&](const std::string& kind, const Triangle& facet) {
    const Vector n = rounded_normal(facet);
    const Exact_slope exact(facet);
    const auto slope = [&](const std::array<double, 3>& p) { return n.dot(rounded_gradient(shell.field(), p)); };
    const auto accepted = [&](const typename Shell::Jets& j) { return is_between<Shell>(j) && exact(j.f, j.scale, 0); };
    for(const Barycentric<3>& b : worst_points(facet, margin))
      if(shell.ask(exact_point(facet, b), accepted) != Shell::HOLDS) {
        tally.wrong(kind, "wrongly accepted" + describe(facet));
        return;
      }
    for(const Barycentric<3>& b : worst_points(facet, slope))
      if(shell.ask(exact_point(facet, b), accepted) != Shell::HOLDS) {
        tally.wrong(kind, "wrongly accepted" + describe(facet));
        return;
      }
  };
  const bool is_accepted = oracle(t[0], t[1], t[2]) == BS::Placement_verdict::ACCEPTED;
  tally.count("oracle_facet", is_accepted ? Verdict::PROVED : Verdict::UNDECIDED);
  if(is_accepted) check_accepted("oracle_facet", t);

  // a nearly planar fan
  typename BS::Shell_facet_oracle_3<Field, Threshold>::Memory memory;
  const auto in_plane = [&](double s, double u, const Vector& v) {
    return Point_3(t[0][0] + s * (t[1][0] - t[0][0]) + u * (t[2][0] - t[0][0]) + v[0],
                   t[0][1] + s * (t[1][1] - t[0][1]) + u * (t[2][1] - t[0][1]) + v[1],
                   t[0][2] + s * (t[1][2] - t[0][2]) + u * (t[2][2] - t[0][2]) + v[2]);
  };
  const double size = (Vector(t[1][0], t[1][1], t[1][2]) - Vector(t[0][0], t[0][1], t[0][2])).norm();
  const Point_3 p = in_plane(1. / 3, 1. / 3, Vector::Zero());
  std::vector<Point_3> link;
  const int number = random.get_int(3, 8), turns = chance(random, 0.3) && number > 4 ? 2 : 1;
  const double noise = chance(random, 0.5) ? power_of_ten(random, -16, -1) : 0.1;
  for(int n = 0; n < number; ++n) {
    const double angle = 2 * CGAL_PI * n * turns / number;
    link.push_back(
      in_plane(1. / 3 + 0.15 * std::cos(angle), 1. / 3 + 0.15 * std::sin(angle), noise * size * random_vector(random)));
  }
  for(int n = 0; n < number; ++n)
    if(is_degenerate({ p, link[n], link[(n + 1) % number] })) return;
  const auto fan = oracle(p, link, memory);
  tally.count("oracle_fan", fan == BS::Placement_verdict::ACCEPTED ? Verdict::PROVED : Verdict::UNDECIDED);
  if(fan != BS::Placement_verdict::ACCEPTED) return;
  for(int n = 0; n < number; ++n) check_accepted("oracle_fan", { p, link[n], link[(n + 1) % number] });
  if(shell.ask(dyadic(p),
               [&](const typename Shell::Jets& j) { return exact_turns(random, dyadic(p), j.f.gradient, link) == 1; })
     != Shell::HOLDS)
    tally.wrong("oracle_fan", "the accepted fan does not wind once around" + describe(Triangle{ p, link[0], link[1] }));
}

#endif // CHECK_PREDICATES_H
