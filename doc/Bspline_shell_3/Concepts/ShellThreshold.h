/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `ShellThreshold` describes a bound of a shell: a number, or a function that is tricubic on the leaf cells of
the field that it bounds. Predicates and certificate know it by its range on a cell and its difference to the field
only.

\cgalHasModel `CGAL::Bspline_shells::Constant_threshold`
\cgalHasModel `CGAL::Bspline_shells::Spline_threshold`

\sa `CGAL::Bspline_shells::Shell_certificate_3`
*/
class ShellThreshold
{
public:
  /// whether the threshold is the same everywhere; if so, `level()` is there, and comparisons with it are exact
  static constexpr bool is_constant;

  /// the value of a constant threshold, in units of the field
  double level() const;

  /// whether both are the same function; on other cells, they may count as different
  bool operator==(const ShellThreshold& other) const;

  /// whether the threshold is tricubic on the leaf cells of a field: no cell of the field is met by two polynomials
  template <typename Field>
  bool has_cells_of(const Field& field) const;

  /// the value at a point, rounded: a hint
  template <typename Point_3>
  double value(const Point_3& p) const;

  /// the same, for a point of a leaf cell, or next to it: `p` has three coordinates `p[0]`, `p[1]`, `p[2]`
  template <typename Point_3>
  double value(const Point_3& p, std::uint32_t cell) const;

  /// encloses the threshold on a leaf cell
  CGAL::Bspline_shells::Level_range range(std::uint32_t cell) const;

  /// encloses a function on a leaf cell minus the threshold, as a polynomial over the cell with a radius that covers
  /// all rounding
  CGAL::Bspline_shells::Enclosed_tricubic difference(const CGAL::Bspline_shells::Enclosed_tricubic& f,
                                                     std::uint32_t cell) const;
};
