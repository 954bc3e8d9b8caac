// The oracle: fields and thresholds at dyadic points, in exact arithmetic, from their B-spline coefficients.
#ifndef EXACT_FIELD_H
#define EXACT_FIELD_H

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>

#include <CGAL/Mpzf.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;

// Sums and products of `double`s are exact.
typedef CGAL::Mpzf Dyadic;
typedef std::array<Dyadic, 3> Dyadic_vector;

template <typename Point>
Dyadic_vector dyadic(const Point& p)
{
  return { Dyadic(double(p[0])), Dyadic(double(p[1])), Dyadic(double(p[2])) };
}
inline Dyadic dot(const Dyadic_vector& u, const Dyadic_vector& v)
{
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
inline Dyadic_vector minus(const Dyadic_vector& u, const Dyadic_vector& v)
{
  return { u[0] - v[0], u[1] - v[1], u[2] - v[2] };
}
inline Dyadic_vector cross(const Dyadic_vector& u, const Dyadic_vector& v)
{
  return { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
}
inline int sign(const Dyadic& x)
{
  return x > Dyadic(0) ? 1 : x < Dyadic(0) ? -1 : 0;
}

// Value and gradient, both multiplied by the same positive factor of the cell, so that there are no divisions.
struct Exact_jet
{
  Dyadic value;
  Dyadic_vector gradient;
};

class Exact_field
{
public:
  typedef Field::Cell_index Cell_index;
  enum Where
  {
    INSIDE,
    OUTSIDE,
    UNDEFINED
  }; // undefined: all cells at the point have coefficients that are not finite

  // `field` must outlive this object, and not change.
  explicit Exact_field(const Field& field) : m_field(&field), m_cells(field.number_of_cells()) {}

  const Field& field() const { return *m_field; }

  // Returns 216 times the Bernstein coefficients, or null if coefficients are not finite.
  const std::array<Dyadic, 64>* bernstein(Cell_index c) const
  {
    std::unique_ptr<Cell_form>& form = m_cells[c];
    if(!form) {
      form = std::make_unique<Cell_form>();
      std::array<Dyadic, 64>& b = form->coefficients;
      b.fill(Dyadic(0));
      m_field->visit_coefficients(c, [&](int n, Cell_index coefficient, double weight) {
        const double x = m_field->coefficients()[coefficient];
        form->is_finite = form->is_finite && std::isfinite(x);
        if(form->is_finite) b[std::size_t(n)] += Dyadic(weight) * Dyadic(x);
      });
      if(form->is_finite)
        for(int axis = 0, stride = 1; axis < 3; ++axis, stride *= 4)
          for(int n = 0; n < 64; ++n) {
            if((n / stride) % 4 != 0) continue;
            const Dyadic x = b[n], y = b[n + stride], z = b[n + 2 * stride], u = b[n + 3 * stride], two(2), four(4);
            b[n] = x + four * y + z;
            b[n + stride] = four * y + two * z;
            b[n + 2 * stride] = two * y + four * z;
            b[n + 3 * stride] = y + four * z + u;
          }
    }
    return form->is_finite ? &form->coefficients : nullptr;
  }

  bool contains(Cell_index c, const Dyadic_vector& p) const
  {
    const auto cell = m_field->cell(c);
    for(int a = 0; a < 3; ++a) {
      const Dyadic corner(cell.corner()[a]);
      if(p[a] < corner || p[a] > corner + Dyadic(cell.width())) return false;
    }
    return true;
  }

  // Returns the closed cells that contain the point.
  std::vector<Cell_index> cells_at(const Dyadic_vector& p) const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> x, least, most;
    for(int a = 0; a < 3; ++a) {
      x[a] = p[a].to_double();
      least[a] = std::nextafter(std::nextafter(x[a], -infinity), -infinity);
      most[a] = std::nextafter(std::nextafter(x[a], infinity), infinity);
    }
    std::vector<Cell_index> cells;
    m_field->visit_cells(CGAL::Bbox_3(least[0], least[1], least[2], most[0], most[1], most[2]), [&](Cell_index c) {
      if(contains(c, p)) cells.push_back(c);
    });
    return cells;
  }

  Where locate(const Dyadic_vector& p, Cell_index& cell) const
  {
    const std::vector<Cell_index> cells = cells_at(p);
    for(Cell_index c : cells)
      if(bernstein(c)) {
        cell = c;
        return INSIDE;
      }
    return cells.empty() ? OUTSIDE : UNDEFINED;
  }

  // Returns the factor of a cell's jets: 216 w^9.
  Dyadic scale(Cell_index c) const
  {
    const Dyadic w(m_field->cell(c).width()), cubed = w * w * w;
    return Dyadic(216) * cubed * cubed * cubed;
  }

  // The coefficients of the cell must be finite.
  Exact_jet jet(Cell_index c, const Dyadic_vector& p) const
  {
    const std::array<Dyadic, 64>& b = *bernstein(c);
    const auto cell = m_field->cell(c);
    const Dyadic two(2), three(3);
    std::array<Dyadic, 4> weight[3], slope[3];
    for(int a = 0; a < 3; ++a) {
      const Dyadic t = p[a] - Dyadic(cell.corner()[a]), s = Dyadic(cell.width()) - t, tt = t * t, ts = t * s,
                   ss = s * s;
      weight[a] = { s * ss, three * t * ss, three * tt * s, t * tt };
      slope[a] = { Dyadic(0) - three * ss, three * (ss - two * ts), three * (two * ts - tt), three * tt };
    }
    std::array<Dyadic, 16> x, dx;
    for(int n = 0; n < 16; ++n) {
      x[n] = dot4(&b[4 * n], weight[0]);
      dx[n] = dot4(&b[4 * n], slope[0]);
    }
    std::array<Dyadic, 4> xy, dxy, xdy;
    for(int n = 0; n < 4; ++n) {
      xy[n] = dot4(&x[4 * n], weight[1]);
      dxy[n] = dot4(&dx[4 * n], weight[1]);
      xdy[n] = dot4(&x[4 * n], slope[1]);
    }
    return { dot4(&xy[0], weight[2]), { dot4(&dxy[0], weight[2]), dot4(&xdy[0], weight[2]), dot4(&xy[0], slope[2]) } };
  }

private:
  struct Cell_form
  {
    std::array<Dyadic, 64> coefficients;
    bool is_finite = true;
  };

  static Dyadic dot4(const Dyadic* b, const std::array<Dyadic, 4>& w)
  {
    return b[0] * w[0] + b[1] * w[1] + b[2] * w[2] + b[3] * w[3];
  }

  const Field* m_field;
  mutable std::vector<std::unique_ptr<Cell_form> > m_cells;
};

// Jets of thresholds, with the factors of the field's cells.
template <typename Threshold>
class Exact_threshold;

template <>
class Exact_threshold<BS::Constant_threshold>
{
public:
  explicit Exact_threshold(const BS::Constant_threshold& threshold) : m_level(threshold.level()) {}
  bool is_defined(std::uint32_t) const { return true; }
  Exact_jet jet(const Exact_field& field, std::uint32_t c, const Dyadic_vector&) const
  {
    return { m_level * field.scale(c), { Dyadic(0), Dyadic(0), Dyadic(0) } };
  }
private:
  Dyadic m_level;
};

template <>
class Exact_threshold<BS::Spline_threshold<Field> >
{
public:
  explicit Exact_threshold(const BS::Spline_threshold<Field>& threshold)
    : m_threshold(threshold), m_field(m_threshold.field())
  {}
  bool is_defined(std::uint32_t c) const { return m_field.bernstein(c) != nullptr; }
  Exact_jet jet(const Exact_field&, std::uint32_t c, const Dyadic_vector& p) const { return m_field.jet(c, p); }
private:
  BS::Spline_threshold<Field> m_threshold;
  Exact_field m_field;
};

#endif // EXACT_FIELD_H
