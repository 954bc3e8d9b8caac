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
/// the honest answer to a question that is decided in bounded time
enum class Verdict
{
  PROVED,   ///< it holds, rigorously
  REFUTED,  ///< it does not hold: there is a witness
  UNDECIDED ///< the bounds were not tight enough; there is a place
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
 * \brief how often each tier of a predicate decided.
 */
struct Predicate_statistics
{
  std::size_t by_cell = 0; ///< coefficients of a whole cell
  std::size_t by_form = 0; ///< coefficients on a part of the triangle
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
 * \brief the five claims that together make the integral curves of the field map a mesh one-to-one.
 */
enum class Claim
{
  CONTAINMENT,    ///< P1: \f$\epsilon_1 < f < \epsilon_2\f$ on every point of every facet
  TRANSVERSALITY, ///< P2: \f$n_T \cdot \nabla f > 0\f$ on every point of every closed facet \f$T\f$
  GRADIENT,       ///< P3: the shell lies in the interior of the domain, and has no critical point
  ONE_SHEET,      ///< P4: every component of the shell contains exactly one component of the mesh
  DEGREE_ONE      ///< P5: a path through each component, from below to above, crosses the mesh once
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
 * \brief where a claim fails or is undecided, and why.
 */
struct Certificate_witness
{
  enum Reason
  {
    FACET,          ///< the claim fails or is undecided on `facet`, at `point`
    OUTSIDE,        ///< a `point` of `facet` lies outside the field's domain
    CRITICAL_POINT, ///< there certainly is one within \f$10^{-1}\f$ cells of `point`, in the shell
    BOX,            ///< the box around `point` in the leaf `cell` is undecided
    END_OF_DOMAIN,  ///< the cover of the shell reaches the end of the domain in the leaf `cell`
    TWO_SHEETS,     ///< `component` and `other_component` of the mesh share a component of the cover; refuted if they
                    ///< certainly share one of the shell
    /// no component of the mesh was found in `component` of the shell; refuted if there certainly is none
    EMPTY_COMPONENT,
    OTHER_COMPONENT, ///< `component` of the mesh was found in no component of the shell; refuted if it certainly is in
                     ///< none
    NO_PATH,   ///< no segment through `component` was found whose count says something; `facet` is a large one of it
    CROSSINGS, ///< the path through `component` that goes through `facet` at `point` crosses the mesh `count` times
    SHELL_CROSSINGS,   ///< a path through `component` of the shell, near `point`, crosses the mesh `count` times
    CONTAINMENT_NEEDED ///< the claim was not examined, as containment is not proved
  };
  static constexpr std::size_t none = std::size_t(-1);

  Claim claim;
  Verdict verdict;
  Reason reason;
  /// position in `faces(mesh)`, if `part` is `MESH`. Triangles of the closing have the numbers that follow, then those
  /// of discs.
  std::size_t facet = none;
  Surface_part part = Surface_part::MESH;               ///< the part of the surface that `facet` belongs to
  std::size_t triangle = none;                          ///< of the examined mesh, part of the facet
  std::size_t cell = none;                              ///< leaf cell of the field
  std::size_t component = none, other_component = none; ///< of the mesh, in the order of their first facets
  std::array<double, 3> point = {};
  /// encloses the field's value (containment) or slope (transversality) at the point where it refutes the claim;
  /// otherwise empty
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
    case Certificate_witness::END_OF_DOMAIN: return "end of domain";
    case Certificate_witness::TWO_SHEETS: return "two sheets";
    case Certificate_witness::EMPTY_COMPONENT: return "empty component";
    case Certificate_witness::OTHER_COMPONENT: return "other component";
    case Certificate_witness::NO_PATH: return "no path";
    case Certificate_witness::CROSSINGS: return "crossings";
    case Certificate_witness::SHELL_CROSSINGS: return "crossings of the shell";
    case Certificate_witness::CONTAINMENT_NEEDED: return "containment needed";
  }
  return "";
}

/// \ingroup PkgBsplineShell3Shell
/// the place of a witness in words: its point, and its facet if it has one. Triangles of the closing and of discs are
/// not numbered.
inline std::string place(const Certificate_witness& witness)
{
  std::ostringstream out;
  out << witness.point[0] << " " << witness.point[1] << " " << witness.point[2];
  if(witness.facet == Certificate_witness::none) return out.str();
  if(witness.part == Surface_part::MESH) out << ", facet " << witness.facet;
  else out << ", on a " << name(witness.part) << ", not on a facet of the mesh";
  return out.str();
}

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief a segment through a component of the shell on which the field increases from below the inner threshold to
 * above the outer one.
 */
struct Crossing_path
{
  std::size_t component; ///< of the mesh
  std::size_t triangle;  ///< of the examined mesh, through whose middle it goes
  std::array<double, 3> source, target;
};

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief what the certificate cost, and which tier decided how much.
 */
struct Certificate_statistics
{
  Predicate_statistics containment, transversality;
  std::size_t cover_cells = 0; ///< leaf cells that the flood looked at
  std::size_t cover_boxes = 0; ///< of the cover
  std::size_t excluded_boxes = 0, monotone_boxes = 0, undecided_boxes = 0;
  std::size_t critical_boxes = 0; ///< whose critical points are certainly beyond a threshold
  std::size_t deepest_box = 0;    ///< halvings
  double seconds = 0;
};

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief what a certificate says.
 */
struct Certificate_report
{
  std::array<Verdict, 5> verdicts = { { Verdict::UNDECIDED, Verdict::UNDECIDED, Verdict::UNDECIDED, Verdict::UNDECIDED,
                                        Verdict::UNDECIDED } }; ///< in the order of `Claim`
  /// places where a claim is not proved: of each claim the first `max_witnesses`
  std::vector<Certificate_witness> witnesses;
  /// of each claim, those that are left out of the list included
  std::array<std::size_t, 5> number_of_witnesses = {};
  static constexpr std::size_t max_witnesses = 256;
  /// for each component of the mesh, the component of the shell that certainly contains it, or
  /// `Certificate_witness::none`. The components of a shell are numbered like those of the mesh that it was built for.
  std::vector<std::size_t> components;
  /// a path through each component of the mesh for which degree one is proved
  std::vector<Crossing_path> paths;
  /// more paths through the same components, for meshes that meet one of the former in an edge or a vertex
  std::vector<Crossing_path> spare_paths;
  /// a lower bound of \f$|\nabla f|\f$ in the shell; 0 if the gradient claim is not proved
  double least_gradient = 0;
  /// an upper bound of \f$|\nabla f|\f$ on the cells of the cover; infinite if there is none
  double greatest_gradient = std::numeric_limits<double>::infinity();
  /// how far, in user units, a point can be from its image on any other certified mesh: the length of an integral curve
  /// in the shell is at most this. Infinite if the gradient claim is not proved. The certificate has one for each
  /// facet.
  double displacement_bound = std::numeric_limits<double>::infinity();
  /// a lower bound, in radians, of the angle at which integral curves pass through facets; 0 if containment or
  /// transversality is not proved
  double least_angle = 0;
  double least_cone_margin = 0; ///< smallest cone margin of a vertex (`vertex_cone_margin()`)
  /// vertices, by their position in `vertices(mesh)`, at which no field can be transversal: exact. Larger numbers are
  /// of vertices of the closing and of discs.
  std::vector<std::size_t> singular_vertices;
  std::size_t covers = 0; ///< number of components of the cover
  Certificate_statistics statistics;

  Verdict verdict(Claim claim) const { return verdicts[std::size_t(claim)]; }
  bool are_all_proved() const
  {
    return std::all_of(verdicts.begin(), verdicts.end(), [](Verdict v) { return v == Verdict::PROVED; });
  }

  /// of all claims, those that are left out of the list included
  std::size_t total_number_of_witnesses() const
  {
    return std::accumulate(number_of_witnesses.begin(), number_of_witnesses.end(), std::size_t(0));
  }

  /// adds a witness, or counts it if there are enough
  void add(const Certificate_witness& witness)
  {
    const auto is_of_claim = [&](const Certificate_witness& w) { return w.claim == witness.claim; };
    if(number_of_witnesses[std::size_t(witness.claim)]++ < max_witnesses) {
      witnesses.push_back(witness);
      return;
    }
    if(witness.verdict != Verdict::REFUTED) return;
    // what refutes the claim is listed in any case
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
