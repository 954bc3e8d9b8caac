/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `SignedDistanceOracle_3` describes functors that return the signed distance of a point from a surface. The
field of a shell is fitted to it.

Near the mesh of the shell, the function should be a distance: across the mesh, it increases by about one per unit of
length, in the direction of the facets' normals. If these point outward, it is negative inside. It is sampled at eight
points of each cell of the field, and at a few other points.

The functor is called concurrently, unless a sequential construction is requested. If it is passed with `std::cref()`,
it need be neither copyable nor assignable.

\cgalHasModel `CGAL::Bspline_shells::Mesh_signed_distance_3`

\sa `CGAL::bspline_shell_3()`
\sa `CGAL::Bspline_shells::sample_signed_distance()`
*/
class SignedDistanceOracle_3
{
public:
  /// \name Types
  /// @{

  /// A point, constructible from three coordinates of type `double`, and movable. A model without this type, such as a
  /// lambda expression or a function, is called with a `CGAL::Exact_predicates_inexact_constructions_kernel::Point_3`.
  typedef unspecified_type Point_3;

  /// @}

  /// \name Operations
  /// @{

  /// returns the signed distance, in the units of the input coordinates. It must be finite. The type need not be
  /// `double`, but must convert to it.
  double operator()(const Point_3& p) const;

  /// @}
};
