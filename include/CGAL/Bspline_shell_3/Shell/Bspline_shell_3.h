// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_BSPLINE_SHELL_3_H
#define CGAL_BSPLINE_SHELL_3_SHELL_BSPLINE_SHELL_3_H

#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Shell/Cover_box.h>
#include <CGAL/Bspline_shell_3/Shell/Shell_report.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

#include <CGAL/assertions.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {

namespace Bspline_shells {
template <typename Field, typename Threshold>
class Second_order_bounds_3;
namespace internal {
struct Shell_access;
}
} // namespace Bspline_shells

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief a cubic B-spline shell: a \f$C^2\f$ field \f$f\f$ that approximates the signed distance to a mesh, and two
 * thresholds that enclose \f$f\f$ on the mesh. The shell is the set \f$\{\epsilon_1 \le f \le \epsilon_2\}\f$.
 *
 * Shells are built by `certified_bspline_shell_3()` and `bspline_shell_3()`. Const member functions may be called
 * concurrently.
 *
 * \tparam Field_ a model of `BsplineField_3`
 * \tparam Threshold_ a model of `ShellThreshold`
 */
template <typename Field_ = Bspline_shells::Hierarchical_bspline_field_3<>,
          typename Threshold_ = Bspline_shells::Constant_threshold>
class Bspline_shell_3
{
public:
  typedef Field_ Field;
  typedef Threshold_ Threshold;
  typedef typename Field::Geom_traits Geom_traits;
  typedef typename Field::FT FT;
  typedef typename Field::Point_3 Point_3;
  typedef Bspline_shells::Shell_status Shell_status;
  typedef Bspline_shells::Shell_report Shell_report;
  typedef Bspline_shells::Level_range Level_range;
  typedef Bspline_shells::Second_order_bounds_3<Field, Threshold> Bounds;

  /// constructs an object without a shell; `report` contains the reason
  explicit Bspline_shell_3(Shell_report report = Shell_report()) : m_report(std::move(report)) {}

  Bspline_shell_3(Field field, Threshold inner, Threshold outer, std::vector<char> cells,
                  std::vector<Level_range> facets, Shell_report report)
    : Bspline_shell_3(std::make_shared<const Field>(std::move(field)), std::move(inner), std::move(outer),
                      std::move(cells), std::move(facets), std::move(report))
  {}

  /// constructs a shell that shares the field instead of copying it
  /// \pre `field` is not null and does not change
  Bspline_shell_3(std::shared_ptr<const Field> field, Threshold inner, Threshold outer, std::vector<char> cells,
                  std::vector<Level_range> facets, Shell_report report)
    : m_field(std::move(field)), m_inner(std::move(inner)), m_outer(std::move(outer)), m_cells(std::move(cells)),
      m_facets(std::move(facets)), m_report(std::move(report))
  {
    if(m_report.status == Shell_status::SUCCESS && !(m_inner.has_cells_of(*m_field) && m_outer.has_cells_of(*m_field)))
      m_report.status = Shell_status::THRESHOLDS_ON_OTHER_CELLS;
  }

  /// constructs a shell with two constant thresholds
  Bspline_shell_3(Field field, const Level_range& levels, std::vector<char> cells, std::vector<Level_range> facets,
                  Shell_report report)
    : Bspline_shell_3(std::move(field), Threshold(levels.min), Threshold(levels.max), std::move(cells),
                      std::move(facets), std::move(report))
  {}

  /// returns whether the object contains a shell. If not, `status()` is the reason, and only `status()`, `message()`,
  /// and `report()` may be called.
  explicit operator bool() const { return status() == Shell_status::SUCCESS; }
  Shell_status status() const { return m_report.status; }
  const Shell_report& report() const { return m_report; }

  const Field& field() const { return *m_field; }
  const Threshold& inner_threshold() const { return m_inner; } ///< \f$\epsilon_1\f$
  const Threshold& outer_threshold() const { return m_outer; } ///< \f$\epsilon_2\f$
  /// returns the value of a constant threshold
  FT inner_level() const { return m_inner.level(); }
  FT outer_level() const { return m_outer.level(); }
  /// returns the largest \f$\epsilon_2 - \epsilon_1\f$ on the mesh for which the shell was built. It is a difference of
  /// values of \f$f\f$, which are close to distances in the units of the coordinates, but it is not a bound on
  /// distances (see `Bspline_shells::Certificate_report::displacement_bound`).
  FT thickness() const
  {
    if constexpr(Threshold::is_constant) return outer_level() - inner_level();
    else return m_report.thickness;
  }
  /// returns the thickness as a fraction of the longest side of the mesh's bounding box
  FT relative_thickness() const { return thickness() / m_report.unit; }
  /// returns whether all claims are proved for the mesh for which the shell was built, or for the mesh passed to
  /// `Bspline_shells::certify()`. `Bspline_shells::Shell_certificate_3` examines other meshes in the shell.
  bool is_certified() const { return status() == Shell_status::SUCCESS && m_report.certificate.are_all_proved(); }
  /// returns the outcome in one or two sentences: whether the shell is certified, or why none was built
  std::string message() const
  {
    if(status() == Shell_status::SOLVER_FAILED && m_report.fit.status != Bspline_shells::Solver_status::SUCCESS)
      return Bspline_shells::message(m_report.fit.status);
    if(!*this) return Bspline_shells::message(status(), m_report.invalid_parameter);
    typedef Bspline_shells::Refinement_status Refinement_status;
    const Refinement_status refinement = m_report.refinement;
    if(is_certified())
      return refinement == Refinement_status::CERTIFIED ? Bspline_shells::message(refinement)
                                                        : "The shell is certified.";
    if(refinement == Refinement_status::NOT_REFINED) return Bspline_shells::message(status());
    return refinement == Refinement_status::LIMIT_REACHED
             ? "The shell contains the mesh, but is not certified: a limit of memory, effort or rounds was reached. "
               "The report lists this limit and the obstacles."
             : "The shell contains the mesh, but is not certified: smaller cells are not expected to help. The report "
               "lists the obstacles.";
  }
  /// returns a flag for each cell of the field: whether the shell may intersect it (`Bspline_shells::Shell_component`)
  const std::vector<char>& shell_cells() const { return m_cells; }
  /// returns the triangles that close the open mesh for which the shell was built, and every other mesh with the same
  /// border; null if the mesh is closed
  const std::shared_ptr<const Bspline_shells::Shell_closing_3>& closing() const { return m_closing; }
  /// returns the discs that replace tips of the mesh for which the shell was built, and the map between the mesh and
  /// the truncated mesh; null if no tip is truncated. The truncated mesh lies in the shell; maps, edits, and
  /// certificates take the original mesh and truncate it.
  const std::shared_ptr<const Bspline_shells::Shell_truncation_3>& truncation() const { return m_truncation; }
  /// returns an enclosure of \f$f\f$ on each facet of the mesh for which the shell was built, in the order of
  /// `faces(mesh)`. Enclosures on the triangles of the closing, and then on those of discs, follow.
  const std::vector<Level_range>& facet_ranges() const { return m_facets; }

  /// returns one or more paths through each component of a certified shell, with which
  /// `Bspline_shells::match_components()` finds the components in which a mesh lies. The vector is empty if the shell
  /// is not certified.
  std::vector<Bspline_shells::Crossing_path> component_paths() const
  {
    std::vector<Bspline_shells::Crossing_path> paths;
    if(!is_certified()) return paths;
    paths = m_report.certificate.paths;
    const auto& spare = m_report.certificate.spare_paths;
    paths.insert(paths.end(), spare.begin(), spare.end());
    return paths;
  }

  /// returns the paths from a file that may lead through the components of the shell. They are candidates: a
  /// certificate uses only those that it proves. The vector is empty if the shell is certified.
  const std::vector<Bspline_shells::Crossing_path>& path_candidates() const { return m_path_candidates; }

  /// returns the boxes of the cover with which the certificate of the shell proved that it has no critical point.
  /// Certificates of other meshes in the shell reuse them. The pointer is null if this claim was not proved, in
  /// particular for shells from a file until they are certified.
  const std::shared_ptr<const std::vector<Bspline_shells::Cover_box> >& proved_cover() const { return m_cover; }
  /// returns bounds on the field in cells, computed by the certificate with which the shell was built. Certificates and
  /// edits of meshes use them, and add bounds on further cells. They take up to 425 bytes per cell of the field. The
  /// pointer is null if no certificate has examined the shell.
  const std::shared_ptr<const Bounds>& cell_bounds() const { return m_cell_bounds; }

  /// returns the position of `p` relative to the shell; `ON_BOUNDED_SIDE` means inside the shell. Points outside the
  /// field's domain are outside the shell, and so are all points if there is no shell. The position is computed in
  /// `double` arithmetic.
  Bounded_side bounded_side(const Point_3& p) const
  {
    if(!*this) return ON_UNBOUNDED_SIDE;
    const typename Field::Cell_index c = m_field->locate(p);
    if(c == Field::npos || !m_cells[c]) return ON_UNBOUNDED_SIDE;
    const FT f = m_field->cell(c).value(p);
    const FT inner = m_inner.value(p), outer = m_outer.value(p);
    if(f < inner || f > outer) return ON_UNBOUNDED_SIDE;
    return f == inner || f == outer ? ON_BOUNDARY : ON_BOUNDED_SIDE;
  }

private:
  friend struct Bspline_shells::internal::Shell_access;

  // shared with copies, because other objects refer to it
  std::shared_ptr<const Field> m_field = std::make_shared<const Field>();
  Threshold m_inner, m_outer;
  std::vector<char> m_cells;
  std::vector<Level_range> m_facets;
  Shell_report m_report;
  std::vector<Bspline_shells::Crossing_path> m_path_candidates;
  std::shared_ptr<const std::vector<Bspline_shells::Cover_box> > m_cover;
  std::shared_ptr<const Bounds> m_cell_bounds;
  std::shared_ptr<const Bspline_shells::Shell_closing_3> m_closing;
  std::shared_ptr<const Bspline_shells::Shell_truncation_3> m_truncation;
};

/// \ingroup PkgBsplineShell3Ref
/// the type of shell that `certified_bspline_shell_3()` builds, with a hierarchy of cells and thresholds that vary in
/// space. An object of this type need not be certified (`Bspline_shell_3::is_certified()`).
typedef Bspline_shell_3<Bspline_shells::Hierarchical_bspline_field_3<>,
                        Bspline_shells::Spline_threshold<Bspline_shells::Hierarchical_bspline_field_3<> > >
  Certified_bspline_shell_3;

namespace Bspline_shells {
namespace internal {

// Sets the parts of a shell that only construction, certificates and readers may set.
struct Shell_access
{
  template <typename Shell>
  static void set_closing(Shell& shell, std::shared_ptr<const Shell_closing_3> closing)
  {
    shell.m_closing = std::move(closing);
  }
  template <typename Shell>
  static void set_truncation(Shell& shell, std::shared_ptr<const Shell_truncation_3> truncation)
  {
    shell.m_truncation = std::move(truncation);
  }
  template <typename Shell>
  static void set_path_candidates(Shell& shell, std::vector<Crossing_path> paths)
  {
    shell.m_path_candidates = std::move(paths);
  }
  // Certifies the shell with the report of the certificate of a mesh in it. The components of the shell are then those
  // of that mesh.
  // pre: all claims of the report are proved for this field and these thresholds
  template <typename Shell>
  static void set_certificate(Shell& shell, Certificate_report report)
  {
    CGAL_precondition(report.are_all_proved());
    shell.m_report.certificate = std::move(report);
    shell.m_cover.reset();
    shell.m_path_candidates.clear();
  }
  // Marks exactly the cells of the cover.
  // pre: the cover belongs to a certificate of a mesh in this shell, which proved
  // the gradient claim with it. If this is not the certificate of `report()`, `least_gradient` of `report()` is zero,
  // and the bound is computed on demand.
  template <typename Shell>
  static void set_proved_cover(Shell& shell, std::vector<Cover_box> boxes)
  {
    CGAL_precondition(shell.report().certificate.verdict(Claim::GRADIENT) == Verdict::PROVED);
    shell.m_cells.assign(shell.field().number_of_cells(), 0);
    for(const Cover_box& box : boxes)
      if(box.component != Cover_box::no_component) shell.m_cells[box.cell] = 1;
    shell.m_cover = std::make_shared<const std::vector<Cover_box> >(std::move(boxes));
  }
  // pre: `bounds` belong to the `field()` object of this shell and to its thresholds
  template <typename Shell>
  static void set_cell_bounds(Shell& shell, std::shared_ptr<const typename Shell::Bounds> bounds)
  {
    shell.m_cell_bounds = std::move(bounds);
  }
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_BSPLINE_SHELL_3_H
