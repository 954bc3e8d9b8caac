/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `AttributeInterpolation` describes how an attribute is computed in a facet from its values at the three
corners.

\cgalHasModel `CGAL::Bspline_shells::Barycentric_interpolation`

\sa `CGAL::Bspline_shells::transfer_vertex_attribute()`
\sa `CGAL::Bspline_shells::transfer_corner_attribute()`
*/
class AttributeInterpolation
{
public:
  /// returns the value at a location, from the values at the corners and barycentric coordinates that sum to one. The
  /// coordinates are nonnegative, except in `transfer_corner_attribute()`, which extrapolates across seams. Calls are
  /// sequential.
  template <typename T>
  T operator()(const std::array<T, 3>& values, const std::array<double, 3>& barycentric) const;
};
