/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `ShellThreshold` describes a bound of a shell: a number, or a function that is tricubic on the leaf cells of
the field that it bounds. Predicates and certificate only access its range on a cell and its difference from the field.

\cgalHasModel `CGAL::Bspline_shells::Constant_threshold`
\cgalHasModel `CGAL::Bspline_shells::Spline_threshold`

\sa `CGAL::Bspline_shells::Shell_certificate_3`
*/
class ShellThreshold
{
public:
  /// whether the threshold is the same everywhere. If so, `level()` is defined, and comparisons with it are exact.
  static constexpr bool is_constant;

  /// returns the value of a constant threshold, in units of the field.
  double level() const;

  /// returns whether the two thresholds are the same function. Thresholds on other cells may count as different.
  bool operator==(const ShellThreshold& other) const;

  /// returns whether the threshold is tricubic on the leaf cells of a field: no cell of the field meets two of its
  /// polynomials.
  template <typename Field>
  bool has_cells_of(const Field& field) const;

  /// returns the rounded value at a point, as a hint.
  template <typename Point_3>
  double value(const Point_3& p) const;

  /// returns the rounded value at a point in or next to a leaf cell: `p` has three coordinates `p[0]`, `p[1]`, `p[2]`.
  template <typename Point_3>
  double value(const Point_3& p, std::uint32_t cell) const;

  /// returns an enclosure of the threshold on a leaf cell.
  CGAL::Bspline_shells::Level_range range(std::uint32_t cell) const;

  /// returns an enclosure of a function minus the threshold on a leaf cell, as a polynomial over the cell with a radius
  /// that covers all rounding errors.
  CGAL::Bspline_shells::Enclosed_tricubic difference(const CGAL::Bspline_shells::Enclosed_tricubic& f,
                                                     std::uint32_t cell) const;
};
