// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_CERTIFICATE_3_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_CERTIFICATE_3_H

#include <CGAL/Bspline_shell_3/Certificate/Facet_verdict.h>
#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Second_order_bounds_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_cover_3.h>
#include <CGAL/Bspline_shell_3/Certificate/displacement_bounds.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Certificate_draft.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Examined_shell.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/examine_components.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/examine_cover.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/examine_facets.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/examine_paths.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/examine_sheets.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/examine_vertices.h>
#include <CGAL/Bspline_shell_3/Certificate/match_components.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/closing_argument.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/arithmetic_self_test.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/FPU.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/Real_timer.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief proves that the integral curves of a field map a mesh one-to-one onto every other certified mesh in the same
 * shell, or reports where the proof fails.
 *
 * Consider the components of the shell that contain the mesh. If all five claims (`Claim`) are proved, every integral
 * curve in them meets the mesh in exactly one point, and the mesh does not intersect itself. Let \f$c\f$ be a value
 * between the largest inner and the smallest outer threshold in these components. The mesh is isotopic in the shell to
 * the level set \f$\{f = c\}\f$. Two such meshes in the same components of the shell are mapped onto each other by a
 * homeomorphism. No proof relies on samples: values and slopes are enclosed on whole facets and boxes, and crossings
 * are counted exactly.
 *
 * The components of a certified shell are those of the mesh for which it was built. A mesh is certified in such a shell
 * only if it has exactly one component in each of them, and no other component. Hence all meshes that are certified in
 * the same certified shell are mapped onto each other. To compare certificates without a certified shell, see
 * `matches()`.
 *
 * Results scale exactly with powers of two. If the field and the thresholds, or all coordinates, are multiplied by one,
 * verdicts and angles stay the same, and the other bounds are multiplied. This holds as long as neither numbers nor
 * their rounding errors overflow or underflow: let the values of the field, also divided by the width of a cell once
 * and twice, be between \f$2^{-800}\f$ and \f$2^{800}\f$.
 *
 * \tparam Field_ a model of `BsplineField_3`
 * \tparam Threshold a model of `ShellThreshold`
 */
template <typename Field_ = Hierarchical_bspline_field_3<>, typename Threshold = Constant_threshold>
class Shell_certificate_3
{
public:
  typedef Field_ Field;
  typedef Shell_cover_3<Field, Threshold> Cover;
  typedef Second_order_bounds_3<Field, Threshold> Bounds;
  typedef Input_mesh_3::Triangle_mesh Triangle_mesh;

  typedef Bspline_shells::Facet_verdict Facet_verdict;

  /// \pre `field` outlives this object; its coefficients may change between calls of `verify()`
  Shell_certificate_3(const Field& field, const Threshold& inner, const Threshold& outer)
    : m_field(&field), m_inner(inner), m_outer(outer)
  {}
  Shell_certificate_3(const Field&&, const Threshold&, const Threshold&) = delete; // the pointer would dangle

  /// constructs a certificate for meshes in a shell. Data of the shell that does not depend on the mesh is reused: its
  /// cover, and its bounds on cells unless `bounds` are given. A shell from a file that is not yet certified may have
  /// candidates for paths through its components (`Bspline_shell_3::path_candidates()`). A mesh must then have exactly
  /// one component in each component through which such a path is proved to lead, and no other component. If there is
  /// no shell, `verify()` sets `status()` to the status of the shell.
  /// \pre the shell outlives this object and is not modified; `bounds` are those of the shell
  explicit Shell_certificate_3(const Bspline_shell_3<Field, Threshold>& shell,
                               std::shared_ptr<const Bounds> bounds = nullptr)
    : Shell_certificate_3(shell.field(), shell.inner_threshold(), shell.outer_threshold())
  {
    m_is_of_shell = true;
    m_shell_status = shell.status();
    m_bounds = bounds ? std::move(bounds) : shell.cell_bounds();
    m_closing = shell.closing();
    m_truncation = shell.truncation();
    reuse_certificate_of(shell);
  }
  explicit Shell_certificate_3(const Bspline_shell_3<Field, Threshold>&&,
                               std::shared_ptr<const Bounds> = nullptr) = delete;

  /// examines the five claims for a mesh: the one for which the shell was built, or any other.
  ///
  /// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
  /// \tparam PolygonMesh a model of `FaceListGraph`
  /// \param mesh a closed mesh, or one with the border of its closing. The triangles of the closing are
  ///   certified with the mesh, and follow its facets. Tips that the shell truncates are truncated here as well, and
  ///   the triangles of discs follow those of the closing. Polygons are triangulated as for the construction of a
  ///   shell.
  /// \param np `vertex_point_map`: a property map from the vertices of `mesh` to their points. `closing`: triangles
  ///   that close the mesh if it is open, used instead of the shell's; a `Shell_closing_3` or a shared pointer to one,
  ///   which may be null (`Edit_report::closing`).
  /// \return `true` if all claims are proved
  template <typename ConcurrencyTag = Parallel_if_available_tag, typename PolygonMesh,
            typename CGAL_NP_TEMPLATE_PARAMETERS>
  bool verify(const PolygonMesh& mesh, const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
  {
    using CGAL::parameters::choose_parameter;
    using CGAL::parameters::get_parameter;
    m_last = Examination();
    auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                get_const_property_map(vertex_point, mesh));
    Input_mesh_3::Tolerated_defects tolerated;
    tolerated.self_intersections = tolerated.singular_vertices = tolerated.orientation = true;
    auto input = std::make_shared<Input_mesh_3>();
    input->template build<ConcurrencyTag>(mesh, vpm, tolerated, internal::closing_argument(np, m_closing),
                                          m_truncation);
    return verify<ConcurrencyTag>(std::shared_ptr<const Input_mesh_3>(std::move(input)));
  }

  /// examines a mesh in the package's representation; reported facets and vertices are those of the user's mesh.
  /// \param input the mesh; not null
  template <typename ConcurrencyTag = Parallel_if_available_tag>
  bool verify(std::shared_ptr<const Input_mesh_3> input);

  /// marks the shell as certified with the mesh that was verified last, as described for `Bspline_shells::certify()`.
  /// If the mesh is not certified, returns `false` and leaves the shell unchanged.
  /// \pre `shell` is the one with which this object was constructed
  bool certify(Bspline_shell_3<Field, Threshold>& shell)
  {
    CGAL_precondition(m_is_of_shell && &shell.field() == m_field);
    if(!is_certified()) return false;
    internal::Shell_access::set_certificate(shell, report());
    internal::Shell_access::set_cell_bounds(shell, m_bounds);
    internal::Shell_access::set_proved_cover(shell, cover()->boxes());
    reuse_certificate_of(shell);
    return true;
  }

  /// returns whether the integral curves map the mesh one-to-one onto the mesh of another certificate: the two are
  /// certified, and their components lie in the same components of the shell. Open meshes are compared together with
  /// their closings, which may differ (\ref BsplineShell3OpenBorder). The verdict is undecided if one of them is not
  /// certified, if their field objects or thresholds differ, or if all paths through some component are degenerate.
  Verdict matches(const Shell_certificate_3& other) const
  {
    const bool is_same_shell = m_field == other.m_field && m_inner == other.m_inner && m_outer == other.m_outer;
    if(!is_same_shell || !is_certified() || !other.is_certified()) return Verdict::UNDECIDED;
    std::vector<Crossing_path> paths = other.report().paths;
    paths.insert(paths.end(), other.report().spare_paths.begin(), other.report().spare_paths.end());
    return match_components(paths, *m_last.input).verdict();
  }

  /// returns whether all claims were proved in the last call of `verify()`
  bool is_certified() const
  {
    return status() == Shell_status::SUCCESS && arithmetic() == Arithmetic_status::SOUND && report().are_all_proved();
  }
  explicit operator bool() const { return is_certified(); }

  /// returns `SUCCESS` if the mesh could be examined, otherwise the reason
  Shell_status status() const { return m_last.status; }
  const Offending_simplices& offending_simplices() const { return m_last.offending_simplices; }
  Arithmetic_status arithmetic() const { return m_last.arithmetic; }

  /// returns all results, except for the meshes and boxes to which they refer
  const Certificate_report& report() const { return m_last.report; }
  Verdict verdict(Claim claim) const { return report().verdict(claim); }
  /// returns places where a claim is not proved; their total number is `Certificate_report::number_of_witnesses`
  const std::vector<Certificate_witness>& witnesses() const { return report().witnesses; }
  /// returns the verdicts on the facets of the mesh in the order of `faces(mesh)`, then on the triangles of the
  /// closing, then on those of discs
  const std::vector<Facet_verdict>& facets() const { return m_last.facets; }
  /// returns the cover of the shell by boxes, if containment is proved
  const std::optional<Cover>& cover() const { return m_last.cover; }
  /// returns the mesh of the examined triangles, which has `double` coordinates
  const Triangle_mesh& examined_mesh() const { return m_last.input->mesh(); }
  /// returns, for each component of the mesh, the vertex of the examined mesh from which the flood fill of the cover
  /// starts, if containment is proved
  const std::vector<Triangle_mesh::Vertex_index>& seeds() const { return m_last.seeds; }
  /// returns the number of components of the cover
  std::size_t number_of_covers() const { return report().covers; }
  /// returns the paths that prove the claim `DEGREE_ONE`
  const std::vector<Crossing_path>& paths() const { return report().paths; }
  /// returns, for each component of the mesh, the component of the shell that is proved to contain it, or
  /// `Certificate_witness::none`
  const std::vector<std::size_t>& components() const { return report().components; }
  const Certificate_statistics& statistics() const { return report().statistics; }
  /// returns the bounds on the cells that facets meet; null if there are none yet
  const std::shared_ptr<const Bounds>& bounds() const { return m_bounds; }

  /// \name Quantities
  /// @{
  /// returns a lower bound on \f$|\nabla f|\f$ in the shell; 0 if the gradient claim is not proved.
  double least_gradient() const { return report().least_gradient; }
  /// returns an upper bound on the length of integral curves in the shell, in the units of the coordinates. It bounds
  /// the distance between a point and its image on any other certified mesh. The bound is infinite if the gradient
  /// claim is not proved.
  double displacement_bound() const { return report().displacement_bound; }
  /// returns, for each facet in the order of `faces(mesh)`, an upper bound on the length in the shell of the integral
  /// curves that meet the facet. The bounds depend on the gradient and the thresholds nearby, and in most places are
  /// much smaller than `displacement_bound()`. This takes several times as long as the proof.
  template <typename ConcurrencyTag = Parallel_if_available_tag>
  std::vector<double> displacement_bounds() const
  {
    if(!(displacement_bound() < std::numeric_limits<double>::infinity()))
      return std::vector<double>(facets().size(), displacement_bound());
    return Bspline_shells::displacement_bounds<ConcurrencyTag>(*cover(), m_inner, m_outer, *m_last.input,
                                                               displacement_bound());
  }
  /// returns a lower bound, in radians, of the angle at which integral curves pass through facets; 0 if containment or
  /// transversality is not proved
  double least_angle() const { return report().least_angle; }
  /// returns the smallest cone margin of a vertex (`vertex_cone_margin()`)
  double least_cone_margin() const { return report().least_cone_margin; }
  /// returns the positions in `vertices(mesh)` of the vertices at which no field can be transversal; the test is exact
  const std::vector<std::size_t>& singular_vertices() const { return report().singular_vertices; }
  /// @}

private:
  // Results for the last mesh. While it is being examined, all claims are undecided.
  struct Examination
  {
    std::shared_ptr<const Input_mesh_3> input = std::make_shared<const Input_mesh_3>();
    Shell_status status = Shell_status::NOT_BUILT;
    Offending_simplices offending_simplices;
    Arithmetic_status arithmetic = Arithmetic_status::SOUND;
    Certificate_report report;
    std::vector<Facet_verdict> facets;
    std::optional<Cover> cover;
    internal::Seeds seeds;
  };

  void reuse_certificate_of(const Bspline_shell_3<Field, Threshold>& shell)
  {
    const Certificate_report& report = shell.report().certificate;
    m_proved_cover = { shell.proved_cover(), report.covers, report.least_gradient, report.largest_gradient };
    const bool is_certified = shell.is_certified();
    m_paths = { is_certified ? shell.component_paths() : shell.path_candidates(), is_certified, is_certified };
  }

  // Returns the reason why a mesh cannot be examined, or `SUCCESS`.
  Shell_status obstacle_to_examination(const Input_mesh_3& input) const
  {
    if(m_shell_status != Shell_status::SUCCESS) return m_shell_status;
    if(!m_field->has_exact_cells()) return Shell_status::GRID_TOO_FINE;
    if(input.status() != Shell_status::SUCCESS) return input.status();
    const bool have_cells = m_inner.has_cells_of(*m_field) && m_outer.has_cells_of(*m_field);
    return have_cells ? Shell_status::SUCCESS : Shell_status::THRESHOLDS_ON_OTHER_CELLS;
  }

  const Field* m_field;
  Threshold m_inner, m_outer;
  // The shell, if there is one; its certificate is reused.
  bool m_is_of_shell = false;
  Shell_status m_shell_status = Shell_status::SUCCESS;
  std::shared_ptr<const Shell_closing_3> m_closing;
  std::shared_ptr<const Shell_truncation_3> m_truncation;
  internal::Proved_cover m_proved_cover;
  internal::Component_paths m_paths;
  std::shared_ptr<const Bounds> m_bounds; // reused for further meshes if the field is that of a shell

  Examination m_last;
};

template <typename Field, typename Threshold>
template <typename ConcurrencyTag>
bool Shell_certificate_3<Field, Threshold>::verify(std::shared_ptr<const Input_mesh_3> input)
{
  Real_timer timer;
  timer.start();
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  m_last = Examination();
  if(!m_is_of_shell) m_bounds.reset(); // the coefficients of the field may have changed
  m_last.arithmetic = arithmetic_self_test();
  if(m_last.arithmetic != Arithmetic_status::SOUND) return false;
  m_last.status = obstacle_to_examination(*input);
  if(m_last.status == input->status()) m_last.offending_simplices = input->offending_simplices();
  m_last.input = std::move(input);
  if(m_last.status != Shell_status::SUCCESS) return false;

  const Input_mesh_3& mesh = *m_last.input;
  const Field_predicates_3<Field> predicates(*m_field);
  const internal::Examined_shell<Field, Threshold> shell = { *m_field, m_inner, m_outer, predicates };
  if(!m_bounds) m_bounds = std::make_shared<const Bounds>(*m_field, m_inner, m_outer);
  m_paths.prove(shell);
  m_last.seeds = internal::find_seeds(mesh);
  internal::Certificate_draft draft;
  internal::examine_vertices<ConcurrencyTag>(mesh, draft);
  const auto facets = internal::examine_facets<ConcurrencyTag>(shell, *m_bounds, mesh, draft);
  if(draft.verdict(Claim::CONTAINMENT) == Verdict::PROVED) {
    const auto shared = internal::examine_cover<ConcurrencyTag>(shell, mesh, m_last.seeds, m_proved_cover,
                                                                facets.least_slope, m_last.cover, draft);
    internal::examine_paths<ConcurrencyTag>(shell, mesh, draft);
    internal::examine_sheets(shell, mesh, m_last.seeds, shared, draft);
    internal::examine_components(mesh, m_last.seeds, m_paths, draft);
  } else {
    for(Claim claim : { Claim::GRADIENT, Claim::ONE_SHEET, Claim::DEGREE_ONE })
      draft.conclude(internal::witness(claim, Verdict::UNDECIDED, Certificate_witness::CONTAINMENT_NOT_PROVED));
  }
  draft.statistics.seconds = timer.time();
  // Results are stored last, so that an exception leaves every claim undecided.
  m_last.facets = facets.facets;
  m_last.report = std::move(draft);
  return is_certified();
}

#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
extern template bool Shell_certificate_3<>::verify<Parallel_if_available_tag>(std::shared_ptr<const Input_mesh_3>);
extern template bool Shell_certificate_3<Hierarchical_bspline_field_3<>,
                                         Spline_threshold<Hierarchical_bspline_field_3<> > >::
  verify<Parallel_if_available_tag>(std::shared_ptr<const Input_mesh_3>);
#endif

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_CERTIFICATE_3_H
