/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `FittableBsplineField_3` describes a field to which an energy can be fitted: a linear function of its *free*
coefficients, the unknowns. On a lattice of each level, the field has coefficients at *points*. Coefficients at points
without a free coefficient depend linearly on the free ones. On each leaf cell, the 64 coefficients at the points around
it determine the polynomial.

Points of all levels have common indices, level by level, and so have free coefficients. Indices are of type
`Cell_index`.

\cgalRefines `BsplineField_3`

\cgalHasModel `CGAL::Bspline_shells::Hierarchical_bspline_field_3`

\sa `CGAL::Bspline_shells::Fit_energy`
\sa `CGAL::Bspline_shells::fit_field()`
*/
class FittableBsplineField_3
{
public:
  /// \name Points and Coefficients
  /// @{

  /// returns the number of levels of cells.
  int number_of_levels() const;

  /// returns the number of points of all levels.
  std::size_t number_of_points() const;

  /// returns the points of a level, in the order of their indices.
  const CGAL::Bspline_shells::Lattice_set_3& points(int level) const;

  /// returns the index of the first point of a level.
  Cell_index first_point(int level) const;

  /// returns the number of unknowns.
  std::size_t number_of_coefficients() const;

  /// returns the free coefficient at a point, or `npos` if the coefficient there depends on others.
  Cell_index coefficient_of_point(Cell_index point) const;

  /// returns the point of a free coefficient.
  Cell_index point_of_coefficient(Cell_index coefficient) const;

  /// returns, for each of the sixteen rows of four consecutive points around a leaf cell, the index of its first point.
  std::array<Cell_index, 16> coefficient_rows(Cell_index c) const;

  /// @}

  /// \name Coefficients at All Points
  /// @{

  /// returns the coefficients at all points, computed from the free ones by a linear map.
  Eigen::VectorXd extend(const Eigen::VectorXd& x) const;

  /// applies the transposed map.
  Eigen::VectorXd collect(const Eigen::VectorXd& all) const;

  /// @}

  /// \name Modification
  /// @{

  /// replaces the free coefficients, in the units of the input coordinates.
  /// \pre `x.size() == number_of_coefficients()`
  template <typename ConcurrencyTag>
  void set_coefficients(Eigen::VectorXd x);

  /// @}
};
