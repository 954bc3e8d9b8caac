/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `SignedDistanceOracle_3` describes functors that answer how far a point is from a surface and on which side
of it: what the field of a shell is fitted to.

The function should be a distance near the mesh of the shell, that is, grow by about one per unit of length across it,
in the direction that the facets face: for facets that face outwards it is negative inside. It is sampled in all cells
of the field, at two points per cell and axis.

The functor is called from several threads at once, unless the construction is asked to be sequential. It need be
neither copyable nor assignable if it is passed with `std::cref()`.

\cgalHasModel `CGAL::Bspline_shells::Mesh_signed_distance_3`

\sa `CGAL::bspline_shell_3()`
\sa `CGAL::Bspline_shells::sample_signed_distance()`
*/
class SignedDistanceOracle_3
{
public:
  /// \name Types
  /// @{

  /// A point, constructible from three coordinates of type `double`, and movable.
  typedef unspecified_type Point_3;

  /// A type that converts to `double`.
  typedef unspecified_type FT;

  /// @}

  /// \name Operations
  /// @{

  /// the signed distance, in user units, finite
  FT operator()(const Point_3& p) const;

  /// @}
};
