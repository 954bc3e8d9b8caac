/*!
 * \ingroup PkgBsplineShell3Concepts
 * \cgalConcept
 *
 * is told how far `CGAL::Bspline_shells::remesh_in_shell()` has come, and may end it. What has been done until then is
 * certified and kept; `CGAL::Bspline_shells::Edit_report::end` is `VISITOR`, then. If the edit is done again with a
 * proof for each facet, iterations begin at 0 again.
 *
 * \cgalHasModel `CGAL::Bspline_shells::Default_remeshing_visitor`
 */
class RemeshingVisitor
{
public:
  /// \name Operations
  /// @{

  /// called when an iteration begins, the first being 0, by the thread that called `remesh_in_shell()`.
  /// \return whether to go on
  bool start_iteration(unsigned int iteration);

  /// called before each operation, by the same thread, and so to be cheap.
  /// \return whether to go on
  bool go_on();

  /// @}
};
