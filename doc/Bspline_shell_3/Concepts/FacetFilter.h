/*!
 * \ingroup PkgBsplineShell3Concepts
 * \cgalConcept
 *
 * The concept `FacetFilter` describes a filter of `CGAL::Bspline_shells::remesh_in_shell()`: it can reject facets, in
 * addition to the shell.
 *
 * \cgalHasModel `CGAL::Bspline_shells::Excision_filter`
 */
class FacetFilter
{
public:
  /// returns whether an operation may create a facet with these corners, which are in counterclockwise order as seen
  /// from the side of larger values of the field. Facets that keep their corners are not passed to the filter. It must
  /// be fast. Unless `ConcurrencyTag` is `Sequential_tag`, it is called concurrently.
  /// \tparam Point_3 the type of the points of the mesh
  template <typename Point_3>
  bool operator()(const Point_3& p, const Point_3& q, const Point_3& r) const;
};
