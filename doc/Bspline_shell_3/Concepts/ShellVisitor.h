/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `ShellVisitor` describes visitors that receive the progress of the construction of a shell and can stop it.

A visitor need not be copyable if it is passed with `std::ref()`. A visitor that is passed by value is copied before its
first use, so the caller's object does not receive its state.

\cgalHasModel `CGAL::Bspline_shells::Default_shell_visitor`

\sa `CGAL::certified_bspline_shell_3()`
\sa `CGAL::bspline_shell_3()`
*/
class ShellVisitor
{
public:
  /// \name Operations
  /// @{

  /// called when a step begins, by the thread that called `CGAL::bspline_shell_3()`. Steps are in the order of
  /// `CGAL::Bspline_shells::Shell_step`. If the shell reaches the boundary of the domain and cells are added, steps
  /// from `CELLS` on are repeated. Each round of refinement repeats the steps from `DISTANCE` on.
  /// \return whether to continue; `false` ends the construction with `CGAL::Bspline_shells::Shell_status::CANCELED`
  bool start_step(CGAL::Bspline_shells::Shell_step step);

  /// called often within each step, by the same thread; it must be fast. Optional.
  /// \return whether to continue; `false` ends the construction with `CGAL::Bspline_shells::Shell_status::CANCELED`
  bool go_on();

  /// @}
};
