/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `ShellVisitor` describes objects that are told how far the construction of a shell has come, and may stop
it.

A visitor need not be copyable if it is passed with `std::ref()`; one that is passed by value is copied before its first
use, so that its state is lost.

\cgalHasModel `CGAL::Bspline_shells::Default_shell_visitor`

\sa `CGAL::certified_bspline_shell_3()`
\sa `CGAL::bspline_shell_3()`
*/
class ShellVisitor
{
public:
  /// \name Operations
  /// @{

  /// called when a step begins, by the thread that called `CGAL::bspline_shell_3()`. The steps come in the order of
  /// `CGAL::Bspline_shells::Shell_step`; where the shell runs out of the cells and more are added, those from `CELLS`
  /// on are repeated, and those from `DISTANCE` on in each round of refinement.
  /// \return whether to go on; `false` ends the construction with `CGAL::Bspline_shells::Shell_status::CANCELED`
  bool start_step(CGAL::Bspline_shells::Shell_step step);

  /// called often within each step, by the same thread, and so to be cheap; optional.
  /// \return whether to go on; `false` ends the construction with the status
  ///         `CGAL::Bspline_shells::Shell_status::CANCELED`
  bool go_on();

  /// @}
};
