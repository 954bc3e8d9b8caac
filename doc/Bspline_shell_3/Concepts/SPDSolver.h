/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `SPDSolver` describes solvers of linear systems \f$A x = b\f$ with a sparse, symmetric and positive definite
matrix: the normal equations of a fit.

A solver is used for several systems, one after the other, each time with a call to `compute()` and then one to
`solve()`. It is never called concurrently. A solver that is passed by value is copied before its first use; one that is
passed with `std::ref()` need not be copyable.

\cgalHasModel `CGAL::Bspline_shells::Conjugate_gradient_solver`
\cgalHasModel `CGAL::Bspline_shells::Cholmod_solver`
\cgalHasModel `CGAL::Bspline_shells::Solver_traits_adaptor`

\sa `CGAL::Bspline_shells::fit_field()`
*/
class SPDSolver
{
public:
  /// \name Operations
  /// @{

  /// receives a matrix, and may factorize it. `lower` contains only the lower triangle, in compressed columns with
  /// ascending rows. It does not change until the last call to `solve()`, so the solver may refer to it. `blocks` are
  /// sets of strongly coupled unknowns, for preconditioners. They are valid only during the call.
  /// \return `SUCCESS`, or the reason why the system cannot be solved; in this case, `solve()` is not called
  CGAL::Bspline_shells::Solver_status compute(const Eigen::SparseMatrix<double>& lower,
                                              const CGAL::Bspline_shells::Unknown_blocks& blocks);

  /// solves the system with the last matrix.
  /// \param b the right-hand side
  /// \param[in,out] x an approximation of the solution, from which an iterative solver may start, and the solution
  /// \return `SUCCESS`, or the reason why `x` does not solve the system to the solver's tolerance. With `SUCCESS`, `x`
  /// must have the size of `b`, and \f$|b - Ax| \le |b| / 10\f$: `CGAL::Bspline_shells::Any_spd_solver` checks both.
  CGAL::Bspline_shells::Solver_status solve(const Eigen::VectorXd& b, Eigen::VectorXd& x);

  /// @}

  /// \name Queries
  /// For reports on the last call to `solve()`. Before the first call, the values are unspecified.
  /// @{

  /// returns the number of iterations; 1 for a direct solver.
  std::size_t iterations() const;

  /// returns the relative residual \f$|b - Ax| / |b|\f$.
  double residual() const;

  /// @}
};
