/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `FlowVisitor` describes visitors of functions that map many points along integral curves: they receive the
progress and can stop the function.

\cgalHasModel `CGAL::Bspline_shells::Default_flow_visitor`

\sa `CGAL::Bspline_shells::project_points()`
*/
class FlowVisitor
{
public:
  /// called by the thread that called the function, after every 16384 points and at the end. Points are not processed
  /// in the given order. If it returns `false`, the remaining points have no image, and their status is
  /// `CGAL::Bspline_shells::Flow_status::CANCELED`.
  bool advance(std::size_t done, std::size_t total);
};
