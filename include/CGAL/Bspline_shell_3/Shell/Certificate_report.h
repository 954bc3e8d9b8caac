// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_CERTIFICATE_REPORT_H
#define CGAL_BSPLINE_SHELL_3_SHELL_CERTIFICATE_REPORT_H

#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Shell
/// the verdict on a claim
enum class Verdict
{
  PROVED,   ///< rigorously proved
  REFUTED,  ///< refuted by a witness
  UNDECIDED ///< neither was proved, because bounds were too coarse at some place; the claim may still be true
};

inline const char* name(Verdict verdict)
{
  switch(verdict) {
    case Verdict::PROVED: return "proved";
    case Verdict::REFUTED: return "refuted";
    case Verdict::UNDECIDED: return "undecided";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief A place where a claim fails or is undecided.
 */
struct Witness
{
  /// exact, dyadic barycentric coordinates of the point, by the vertices of the triangle or the ends of the segment
  std::array<double, 3> barycentric = {};
  /// the point, rounded
  std::array<double, 3> point = {};
  /// encloses the value at the point: of the field, or of the derivative along the normal per user unit
  Level_range value;
  /// whether the point lies outside the field's domain
  bool outside = false;
};

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief counts how often each method of a predicate decided.
 */
struct Predicate_statistics
{
  std::size_t by_cell = 0; ///< by the coefficients of a whole cell
  std::size_t by_form = 0; ///< by the coefficients on a part of the triangle
  std::size_t subdivisions = 0;

  Predicate_statistics& operator+=(const Predicate_statistics& o)
  {
    by_cell += o.by_cell;
    by_form += o.by_form;
    subdivisions += o.subdivisions;
    return *this;
  }
};

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief the five claims about a mesh and a shell (\ref BsplineShell3Certificate). Together, they imply that the
 * integral curves map the mesh one-to-one.
 */
enum class Claim
{
  CONTAINMENT,    ///< P1: \f$\epsilon_1 < f < \epsilon_2\f$ on every point of every facet
  TRANSVERSALITY, ///< P2: \f$n_T \cdot \nabla f > 0\f$ on every facet \f$T\f$ with normal \f$n_T\f$, edges included
  /// P3: the shell lies in the interior of the domain and has no critical point, and \f$\nabla f \cdot \nabla (f -
  /// \epsilon_i) > 0\f$ on its thresholds \f$\epsilon_i\f$
  GRADIENT,
  ONE_SHEET, ///< P4: every component of the shell contains exactly one component of the mesh
  /// P5: a path through each component, from the inner to the outer surface, crosses the mesh once, counted with signs
  DEGREE_ONE
};

inline const char* name(Claim claim)
{
  switch(claim) {
    case Claim::CONTAINMENT: return "containment";
    case Claim::TRANSVERSALITY: return "transversality";
    case Claim::GRADIENT: return "gradient";
    case Claim::ONE_SHEET: return "one_sheet";
    case Claim::DEGREE_ONE: return "degree_one";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief a place where a claim fails or is undecided, and the reason.
 */
struct Certificate_witness
{
  enum Reason
  {
    FACET,              ///< the claim fails or is undecided on `facet`, at `point`
    OUTSIDE,            ///< a `point` of `facet` lies outside the field's domain
    CRITICAL_POINT,     ///< the shell is proved to have a critical point within 1/10 of a cell's width of `point`
    BOX,                ///< the claim is undecided in the box around `point` in the leaf `cell`
    BOUNDARY_OF_DOMAIN, ///< the shell may reach the boundary of the domain in the leaf `cell`
    /// `component` and `other_component` of the mesh may lie in the same component of the shell; refuted if this is
    /// proved
    TWO_SHEETS,
    /// no component of the mesh was found in `component` of the shell; refuted if it is proved that there is none
    EMPTY_COMPONENT,
    /// `component` of the mesh was found in no component of the shell; refuted if it is proved to lie in none
    OTHER_COMPONENT,
    NO_PATH,   ///< no segment through `component` was found that proves the count; `facet` is one of its large facets
    CROSSINGS, ///< the path through `component` that passes through `facet` at `point` crosses the mesh `count` times
    SHELL_CROSSINGS,       ///< a path through `component` of the shell, near `point`, crosses the mesh `count` times
    CONTAINMENT_NOT_PROVED ///< the claim was not examined because containment is not proved
  };
  static constexpr std::size_t none = std::size_t(-1);

  Claim claim;
  Verdict verdict;
  Reason reason;
  /// position in `faces(mesh)` if `part` is `MESH`; larger numbers are triangles of the closing, then of discs
  std::size_t facet = none;
  Surface_part part = Surface_part::MESH;               ///< the part of the surface to which `facet` belongs
  std::size_t triangle = none;                          ///< index of the triangle of `facet` in the triangulated mesh
  std::size_t cell = none;                              ///< leaf cell of the field
  std::size_t component = none, other_component = none; ///< components of the mesh, in the order of their first facets
  std::array<double, 3> point = {};
  /// an interval that contains the field's value (containment) or slope (transversality) at the point that refutes the
  /// claim; otherwise empty
  Level_range value;
  int count = 0;
};

inline const char* name(Certificate_witness::Reason reason)
{
  switch(reason) {
    case Certificate_witness::FACET: return "facet";
    case Certificate_witness::OUTSIDE: return "outside";
    case Certificate_witness::CRITICAL_POINT: return "critical point";
    case Certificate_witness::BOX: return "box";
    case Certificate_witness::BOUNDARY_OF_DOMAIN: return "boundary of domain";
    case Certificate_witness::TWO_SHEETS: return "two sheets";
    case Certificate_witness::EMPTY_COMPONENT: return "empty component";
    case Certificate_witness::OTHER_COMPONENT: return "other component";
    case Certificate_witness::NO_PATH: return "no path";
    case Certificate_witness::CROSSINGS: return "crossings";
    case Certificate_witness::SHELL_CROSSINGS: return "crossings of the shell";
    case Certificate_witness::CONTAINMENT_NOT_PROVED: return "containment needed";
  }
  return "";
}

/// \ingroup PkgBsplineShell3Shell
/// returns the place of a witness as text: its point, and its facet if it has one. For triangles of the closing and of
/// discs, no number is given.
inline std::string place(const Certificate_witness& witness)
{
  std::ostringstream out;
  out << witness.point[0] << " " << witness.point[1] << " " << witness.point[2];
  if(witness.facet == Certificate_witness::none) return out.str();
  if(witness.part == Surface_part::MESH) out << ", facet " << witness.facet;
  else out << ", on a " << name(witness.part);
  return out.str();
}

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief a segment through a component of the shell on which the field increases from below the inner threshold to
 * above the outer threshold.
 */
struct Crossing_path
{
  std::size_t component; ///< component of the mesh
  std::size_t triangle;  ///< index of the triangle in the triangulated mesh through whose center the segment passes
  std::array<double, 3> source, target;
};

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief the cost of a certificate: its time, and the number of boxes and of decisions by each method.
 */
struct Certificate_statistics
{
  Predicate_statistics containment, transversality;
  std::size_t cover_cells = 0; ///< leaf cells that the flood fill visited
  std::size_t cover_boxes = 0; ///< boxes of the cover
  std::size_t excluded_boxes = 0, monotone_boxes = 0, undecided_boxes = 0;
  std::size_t critical_boxes = 0; ///< boxes whose critical points are proved to lie beyond a threshold
  std::size_t deepest_box = 0;    ///< largest number of subdivisions of a cell
  double seconds = 0;
};

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief the results of a certificate.
 */
struct Certificate_report
{
  std::array<Verdict, 5> verdicts = { { Verdict::UNDECIDED, Verdict::UNDECIDED, Verdict::UNDECIDED, Verdict::UNDECIDED,
                                        Verdict::UNDECIDED } }; ///< verdicts in the order of `Claim`
  /// places where a claim is not proved: the first `max_witnesses` of each claim
  std::vector<Certificate_witness> witnesses;
  /// number of witnesses of each claim, including those that are not listed
  std::array<std::size_t, 5> number_of_witnesses = {};
  static constexpr std::size_t max_witnesses = 256;
  /// by component of the mesh: the component of the shell that is proved to contain it, or
  /// `Certificate_witness::none`. Components of a shell are numbered like those of the mesh for which it was built.
  std::vector<std::size_t> components;
  /// a path through each component of the mesh for which degree one is proved
  std::vector<Crossing_path> paths;
  /// more paths through the same components, for other meshes that have an edge or a vertex on a path of `paths`
  std::vector<Crossing_path> spare_paths;
  /// a lower bound on \f$|\nabla f|\f$ in the shell; 0 if the gradient claim is not proved
  double least_gradient = 0;
  /// an upper bound on \f$|\nabla f|\f$ on the cells of the cover; infinite if there is none
  double largest_gradient = std::numeric_limits<double>::infinity();
  /// an upper bound on the length of integral curves in the shell, in the units of the coordinates. It bounds the
  /// distance between a point and its image on any other certified mesh. Infinite if the gradient claim is not proved.
  /// `Shell_certificate_3::displacement_bounds()` returns a bound for each facet.
  double displacement_bound = std::numeric_limits<double>::infinity();
  /// a lower bound on the angle between integral curves and facets, in radians; 0 if containment or transversality is
  /// not proved
  double least_angle = 0;
  double least_cone_margin = 0; ///< smallest cone margin of a vertex (`vertex_cone_margin()`)
  /// positions in `vertices(mesh)` of the singular vertices: no direction is at less than 90 degrees to the normals of
  /// all facets there, so no field can be transversal (decided exactly). Larger numbers are vertices of the closing and
  /// of discs.
  std::vector<std::size_t> singular_vertices;
  std::size_t covers = 0; ///< number of components of the cover
  Certificate_statistics statistics;

  Verdict verdict(Claim claim) const { return verdicts[std::size_t(claim)]; }
  bool are_all_proved() const
  {
    return std::all_of(verdicts.begin(), verdicts.end(), [](Verdict v) { return v == Verdict::PROVED; });
  }

  /// returns the number of witnesses of all claims, including those that are not listed
  std::size_t total_number_of_witnesses() const
  {
    return std::accumulate(number_of_witnesses.begin(), number_of_witnesses.end(), std::size_t(0));
  }

  /// adds a witness, or only counts it if the list is full
  void add(const Certificate_witness& witness)
  {
    const auto is_of_claim = [&](const Certificate_witness& w) { return w.claim == witness.claim; };
    if(number_of_witnesses[std::size_t(witness.claim)]++ < max_witnesses) {
      witnesses.push_back(witness);
      return;
    }
    if(witness.verdict != Verdict::REFUTED) return;
    // A witness that refutes the claim is always listed.
    const auto is_refuting = [&](const Certificate_witness& w) {
      return is_of_claim(w) && w.verdict == Verdict::REFUTED;
    };
    if(std::none_of(witnesses.begin(), witnesses.end(), is_refuting))
      *std::find_if(witnesses.rbegin(), witnesses.rend(), is_of_claim) = witness;
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_CERTIFICATE_REPORT_H
