/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `FlowVisitor` describes what is told how many of many points have been moved along their curves, and may
stop the rest.

\cgalHasModel `CGAL::Bspline_shells::Default_flow_visitor`

\sa `CGAL::Bspline_shells::project_points()`
*/
class FlowVisitor
{
public:
  /// Called from the calling thread, after every 16384 points and at the end; the points are not dealt with in the
  /// order in which they are given. `false` stops: the points that are left have no image, and the status
  /// `CGAL::Bspline_shells::Flow_status::CANCELED`.
  bool advance(std::size_t done, std::size_t total);
};
