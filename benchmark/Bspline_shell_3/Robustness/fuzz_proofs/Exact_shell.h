// The oracle of claims about values and slopes of a shell, at points.
#ifndef EXACT_SHELL_H
#define EXACT_SHELL_H

#include "Tally.h"
#include "random_shells.h"

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>

using BS::Verdict;

template <typename Threshold_>
class Exact_shell
{
public:
  typedef ::Field Field;
  typedef Threshold_ Threshold;
  typedef Field::Cell_index Cell_index;
  // Jets at a point, multiplied by a positive factor that depends on the cell.
  struct Jets
  {
    Exact_jet f, inner, outer;
    Dyadic scale;
  };
  enum Answer
  {
    HOLDS,
    FAILS,
    UNDEFINED
  };
  enum Needed
  {
    FIELD = 0,
    INNER = 1,
    OUTER = 2
  }; // functions that must be defined to decide that a claim holds

  // The field and the thresholds must outlive this object.
  Exact_shell(const Field& field, const Threshold& inner, const Threshold& outer)
    : m_field(field), m_inner_threshold(inner), m_outer_threshold(outer), m_inner(inner), m_outer(outer)
  {}

  const Field& field() const { return m_field.field(); }
  const Exact_field& exact_field() const { return m_field; }
  const Threshold& inner() const { return m_inner_threshold; }
  const Threshold& outer() const { return m_outer_threshold; }

  // The field must be defined on the cell. A threshold that is undefined gets the field's value.
  Jets jets(Cell_index c, const Dyadic_vector& p) const
  {
    const Exact_jet f = m_field.jet(c, p), unknown = { f.value, { Dyadic(0), Dyadic(0), Dyadic(0) } };
    return { f, m_inner.is_defined(c) ? m_inner.jet(m_field, c, p) : unknown,
             m_outer.is_defined(c) ? m_outer.jet(m_field, c, p) : unknown, m_field.scale(c) };
  }
  bool is_defined(Cell_index c) const { return m_field.bernstein(c) && m_inner.is_defined(c) && m_outer.is_defined(c); }

  // Returns whether `holds`, a function of jets, is true at a point. It is false outside the domain.
  template <typename Holds>
  Answer ask(const Dyadic_vector& p, const Holds& holds, int needed = INNER | OUTER) const
  {
    const auto cells = m_field.cells_at(p);
    for(Cell_index c : cells) {
      if(!m_field.bernstein(c)) continue;
      if(!holds(jets(c, p))) return FAILS;
      if((!(needed & INNER) || m_inner.is_defined(c)) && (!(needed & OUTER) || m_outer.is_defined(c))) return HOLDS;
    }
    return cells.empty() ? FAILS : UNDEFINED;
  }

  // Margins and slopes as rounded functions of rounded points, for searches.
  double above_inner(const std::array<double, 3>& p) const { return margin(p, 1, m_inner_threshold); }
  double below_outer(const std::array<double, 3>& p) const { return margin(p, -1, m_outer_threshold); }
  double above(const std::array<double, 3>& p, const Threshold& threshold) const { return margin(p, 1, threshold); }

private:
  double margin(const std::array<double, 3>& p, double sign, const Threshold& threshold) const
  {
    const auto c = field().locate(Point_3(p[0], p[1], p[2]));
    if(c == Field::npos) return std::numeric_limits<double>::quiet_NaN();
    return sign * (field().cell(c).value(p) - threshold.value(p, c));
  }

  Exact_field m_field;
  Threshold m_inner_threshold, m_outer_threshold;
  Exact_threshold<Threshold> m_inner, m_outer;
};

template <typename Point, std::size_t size>
std::string describe(const std::array<Point, size>& simplex)
{
  std::ostringstream text;
  text << std::setprecision(17);
  for(const Point& p : simplex) text << " (" << p[0] << ", " << p[1] << ", " << p[2] << ')';
  return text.str();
}

// Checks one verdict on a simplex. A proved claim must hold at the points where `margin`, rounded, is least. A refuted
// claim must fail at the witness.
template <typename Shell, std::size_t size, typename Margin, typename Holds>
void check_verdict(Tally& tally, const std::string& kind, Verdict verdict, const BS::Witness& witness,
                   const Shell& shell, const std::array<Point_3, size>& simplex, const Margin& margin,
                   const Holds& holds, int needed)
{
  tally.count(kind, verdict);
  if(verdict == Verdict::PROVED) {
    for(const Barycentric<size>& b : worst_points(simplex, margin))
      if(shell.ask(exact_point(simplex, b), holds, needed) != Shell::HOLDS) {
        tally.wrong(kind, "wrongly proved on" + describe(simplex));
        return;
      }
  } else if(verdict == Verdict::REFUTED) {
    std::array<double, size> b;
    double sum = 0;
    for(std::size_t v = 0; v < size; ++v) sum += b[v] = witness.barycentric[v];
    const Dyadic_vector p = exact_point(simplex, b);
    if(sum != 1 || shell.ask(p, holds, needed) != Shell::FAILS)
      tally.wrong(kind, "wrongly refuted on" + describe(simplex));
    if(witness.outside && !shell.exact_field().cells_at(p).empty())
      tally.wrong(kind, "a witness that should be outside the domain is inside, on" + describe(simplex));
  }
}

// For claims without a witness: returns whether a point is found where the claim fails.
template <typename Shell, std::size_t size, typename Margin, typename Holds>
bool fails_somewhere(const Shell& shell, const std::array<Point_3, size>& simplex, const Margin& margin,
                     const Holds& holds)
{
  for(int grid : { 12, 48 })
    for(const Barycentric<size>& b : worst_points(simplex, margin, grid, 4))
      if(shell.ask(exact_point(simplex, b), holds) != Shell::HOLDS) return true;
  return false;
}

// The exact normal of a triangle, for claims about slopes.
class Exact_slope
{
public:
  explicit Exact_slope(const Triangle& t)
    : m_normal(cross(minus(dyadic(t[1]), dyadic(t[0])), minus(dyadic(t[2]), dyadic(t[0]))))
  {}

  // Returns whether n . grad f is positive and, for the unit normal, at least `least`.
  bool operator()(const Exact_jet& f, const Dyadic& scale, double least) const
  {
    const Dyadic slope = dot(m_normal, f.gradient);
    if(sign(slope) <= 0) return false;
    if(!(least > 0)) return true;
    if(!std::isfinite(least)) return false;
    const Dyadic bound = Dyadic(least) * scale;
    return slope * slope >= bound * bound * dot(m_normal, m_normal);
  }
  const Dyadic_vector& normal() const { return m_normal; }

private:
  Dyadic_vector m_normal;
};

#endif // EXACT_SHELL_H
