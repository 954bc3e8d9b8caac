/*!
 * \ingroup PkgBsplineShell3Concepts
 * \cgalConcept
 *
 * The concept `RemeshingVisitor` describes a visitor of `CGAL::Bspline_shells::remesh_in_shell()`: it receives the
 * progress and can end the edit. The mesh is then certified and kept in its current state, and
 * `CGAL::Bspline_shells::Edit_report::end` is `VISITOR`. If the edit is repeated with a proof for each facet,
 * iterations start at 0 again.
 *
 * \cgalHasModel `CGAL::Bspline_shells::Default_remeshing_visitor`
 */
class RemeshingVisitor
{
public:
  /// \name Operations
  /// @{

  /// called when an iteration begins, the first being 0, by the thread that called `remesh_in_shell()`.
  /// \return whether to continue
  bool start_iteration(unsigned int iteration);

  /// called before each operation, by the same thread; it must be fast.
  /// \return whether to continue
  bool go_on();

  /// @}
};
