/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `BsplineField_3` describes a real function that is \f$C^2\f$ and, on each of the closed cubic *cells* that
make up its domain, a tricubic polynomial. Bounds, shells and level sets access only the cells of a field: their boxes,
Bernstein coefficients and neighbors. They do not depend on how the coefficients were computed.

Const member functions may be called concurrently. Models are default constructible (a field without cells), copyable
and movable.

The package has one model. A second one, with only these members, is in the tests (`test_concepts.cpp`).

\cgalHasModel `CGAL::Bspline_shells::Hierarchical_bspline_field_3`

\sa `CGAL::Bspline_shell_3`
\sa `CGAL::Bspline_shells::facet_ranges()`
\sa `CGAL::Bspline_shells::extract_level_set()`
*/
class BsplineField_3
{
public:
  /// \name Types
  /// @{

  /// A tag for the geometry of the field, usually a \cgal kernel.
  typedef unspecified_type Geom_traits;

  /// The type of values: `double`.
  typedef unspecified_type FT;

  /// A point with coordinates `p[0]`, `p[1]` and `p[2]` that convert to `double`.
  typedef unspecified_type Point_3;

  /// A vector, constructible from three `double`s.
  typedef unspecified_type Vector_3;

  /// A cell with its polynomial: `CGAL::Bspline_shells::Tricubic_cell_3`. It is a view, valid until the field is
  /// changed or destroyed.
  typedef unspecified_type Cell;

  /// The index of a cell, an unsigned integer. The indices of the cells of a field begin with 0.
  typedef unspecified_type Cell_index;

  /// An index that no cell has.
  static constexpr Cell_index npos;

  /// @}

  /// \name Cells
  /// @{

  /// returns the number of cells.
  std::size_t number_of_cells() const;

  /// returns a cell.
  Cell cell(Cell_index c) const;

  /// returns a cell that contains `p`, or `npos` if `p` is outside the domain or has a coordinate that is not finite.
  /// Cells are closed: for a point on a common face, either cell may be returned.
  Cell_index locate(const Point_3& p) const;

  /// returns whether the corners of cells, and of cells split up to eight times, are exact. For 0 <= i <= 256,
  /// `corner()[a] + i * width() / 256` must be computed without rounding, and must be the same `double` for all cells
  /// that share the corner. Nothing is proved for other fields.
  bool has_exact_cells() const;

  /// calls `visit(n)` for every neighbor of `c` at a face, and returns whether there is any. The face is orthogonal to
  /// an axis (0, 1 or 2), on the side of larger (`positive`) or smaller coordinates. A neighbor shares a part of the
  /// face with `c`. If a part of the face is on the boundary of the domain, all of it is.
  template <typename Visitor>
  bool visit_neighbors(Cell_index c, int axis, bool positive, const Visitor& visit) const;

  /// calls `visit(c)` once for each cell that meets the closed box, and returns whether the cells cover the box.
  template <typename Visitor>
  bool visit_cells(const CGAL::Bbox_3& box, const Visitor& visit) const;

  /// returns the 64 Bernstein coefficients of the function on a cell. If `NT` is an exact number type, they are exact,
  /// and determine signs for which rounded coefficients are not sufficient.
  template <typename NT>
  std::array<NT, 64> bernstein_coefficients(Cell_index c) const;

  /// returns the cells as cells of lattices, with the same indices. Only fits, `extract_level_set()` and the file
  /// functions use it. Bounds, predicates, certificate and containment do not.
  const CGAL::Bspline_shells::Cell_hierarchy_3& cells() const;

  /// @}

  /// \name Evaluation
  /// These functions return an empty object outside the domain. Derivatives are per unit of the input coordinates.
  /// @{

  /// returns the value.
  std::optional<FT> value(const Point_3& p) const;

  /// returns the gradient.
  std::optional<Vector_3> gradient(const Point_3& p) const;

  /// returns the matrix of second derivatives.
  std::optional<Eigen::Matrix3d> hessian(const Point_3& p) const;

  /// @}
};
