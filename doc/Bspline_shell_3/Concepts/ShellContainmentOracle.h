/*!
\ingroup PkgBsplineShell3Concepts
\cgalConcept

The concept `ShellContainmentOracle` describes what decides whether the facets around a vertex may be where they are:
the part of `CGAL::Bspline_shells::Shell_filter` that knows about shells, envelopes or other sets that a mesh must not
leave.

Const member functions may be called from several threads at once, each with a memory of its own.

\cgalHasModel `CGAL::Bspline_shells::Shell_facet_oracle_3`
\cgalHasModel `CGAL::Bspline_shells::Triangle_predicate_oracle`

\sa `CGAL::Bspline_shells::Shell_filter`
*/
class ShellContainmentOracle
{
public:
  /// What the oracle remembers from one question to the next, if it can make use of it: default constructible, and
  /// owned by who asks.
  typedef unspecified_type Memory;

  /// judges the facets (`p`, `link[n]`, `link[n+1]`) around a vertex at `p`, a cycle. None of the points but `p` is a
  /// new one.
  template <typename Point_3>
  CGAL::Bspline_shells::Placement_verdict operator()(const Point_3& p, const std::vector<Point_3>& link,
                                                     Memory& memory) const;
};
