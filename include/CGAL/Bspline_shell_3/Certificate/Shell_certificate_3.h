// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_CERTIFICATE_3_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_CERTIFICATE_3_H

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Second_order_bounds_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_cover_3.h>
#include <CGAL/Bspline_shell_3/Certificate/critical_point.h>
#include <CGAL/Bspline_shell_3/Certificate/displacement_bounds.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Recent_samples.h>
#include <CGAL/Bspline_shell_3/Certificate/match_components.h>
#include <CGAL/Bspline_shell_3/Certificate/segment_through_shell.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>
#include <CGAL/Bspline_shell_3/Spline/monotone_direction.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/arithmetic_self_test.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/FPU.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/Real_timer.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief Decides, rigorously, whether the integral curves of a field map a mesh one-to-one onto all other certified
 * meshes in the same shell.
 *
 * If all five claims are proved, then every integral curve of the field in the shell meets the mesh in exactly one
 * point. The mesh does not intersect itself. It is isotopic in the shell to every level set between the largest value
 * of the inner threshold and the least value of the outer one. Two such meshes in the same components of the shell are
 * mapped onto each other by a homeomorphism. Nothing is sampled: values and slopes are enclosed on whole facets and
 * boxes, and counts are exact.
 *
 * The components of a certified shell are those of the mesh for which it was built. A certificate of such a shell
 * requires that a mesh has exactly one component in each of them, and no other component. So all meshes with a
 * certificate of the same certified shell are mapped onto each other. For certificates between other thresholds, see
 * `matches()`.
 *
 * \tparam Field_ a model of `BsplineField_3`
 * \tparam Threshold a model of `ShellThreshold`
 */
template <typename Field_ = Uniform_bspline_field_3<>, typename Threshold = Constant_threshold>
class Shell_certificate_3
{
public:
  typedef Field_ Field;
  typedef Shell_cover_3<Field, Threshold> Cover;
  typedef Second_order_bounds_3<Field, Threshold> Bounds;
  typedef Input_mesh_3::Triangle_mesh Triangle_mesh;

  /// the result for a facet
  struct Facet_verdict
  {
    Verdict containment = Verdict::UNDECIDED;
    Verdict transversality = Verdict::UNDECIDED;
    /// lower bound of \f$n \cdot \nabla f\f$, unit normal, user units; 0 if transversality is not proved. The bound is
    /// close only if the slope is near the least slope of all facets.
    double slope = 0;
  };

  /// \pre `field` outlives this object; it may change between verifications
  Shell_certificate_3(const Field& field, const Threshold& inner, const Threshold& outer)
    : m_field(&field), m_inner(inner), m_outer(outer)
  {}
  Shell_certificate_3(const Field&&, const Threshold&, const Threshold&) = delete; // it would dangle

  /// Constructs a certificate for meshes in a shell. Data that does not depend on the mesh is reused: the cover, if the
  /// shell has one, and bounds on cells, if the shell has some or they are given. A shell that is not certified may
  /// have candidates of paths through its components, from a file (`Bspline_shell_3::path_candidates()`). A mesh must
  /// then have exactly one component in each component through which such a path is proved to lead, and no other
  /// component. If there is no shell, `verify()` sets `status()` to the status of the shell.
  /// \pre the shell outlives this object and stays as it is; `bounds` are those of the shell
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

  /// Examines a mesh: the one for which the shell was built, or any other.
  ///
  /// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
  /// \tparam PolygonMesh a model of `FaceListGraph`
  /// \param mesh a closed mesh, or one with the border of the shell's closing. The closing is certified with it: its
  ///   triangles count as facets after those of the mesh. If the shell truncates tips of the mesh, so does the
  ///   certificate, and the triangles of discs count as the facets that follow. Polygons are triangulated as for the
  ///   construction of a shell.
  /// \param np `vertex_point_map` as in all of \cgal
  /// \return `true` if all claims are proved
  template <typename ConcurrencyTag = Parallel_if_available_tag, typename PolygonMesh,
            typename CGAL_NP_TEMPLATE_PARAMETERS>
  bool verify(const PolygonMesh& mesh, const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
  {
    using CGAL::parameters::choose_parameter;
    using CGAL::parameters::get_parameter;
    unsay();
    auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                get_const_property_map(vertex_point, mesh));
    Input_mesh_3::Tolerated_defects tolerated;
    tolerated.self_intersections = tolerated.singular_vertices = tolerated.orientation = true;
    auto input = std::make_shared<Input_mesh_3>();
    input->template build<ConcurrencyTag>(mesh, vpm, tolerated, Input_mesh_3::closer(m_closing),
                                          Input_mesh_3::truncator(m_truncation));
    return verify<ConcurrencyTag>(std::shared_ptr<const Input_mesh_3>(std::move(input)));
  }

  /// Examines a mesh in the package's representation; facets and vertices are those of the user's mesh.
  /// \param input the mesh; not null
  template <typename ConcurrencyTag = Parallel_if_available_tag>
  bool verify(std::shared_ptr<const Input_mesh_3> input);

  /// Certifies the shell with the mesh that was verified last, as described for `Bspline_shells::certify()`. Returns
  /// `false`, and leaves the shell unchanged, if the mesh is not certified.
  /// \pre `shell` is the one with which this object was constructed
  bool certify(Bspline_shell_3<Field, Threshold>& shell)
  {
    CGAL_precondition(m_is_of_shell && &shell.field() == m_field);
    if(!is_certified()) return false;
    shell.set_certificate(m_report);
    shell.set_cell_bounds(m_bounds);
    shell.set_proved_cover(m_cover->boxes());
    reuse_certificate_of(shell);
    return true;
  }

  /// Returns whether the integral curves map the mesh one-to-one onto the mesh of another certificate: both are
  /// certified, and their components lie in the same components of the shell. The verdict is undecided if one of them
  /// is not certified, if their field objects or thresholds differ, or if every path through a component is degenerate.
  Verdict matches(const Shell_certificate_3& other) const
  {
    const bool is_same_shell = m_field == other.m_field && m_inner == other.m_inner && m_outer == other.m_outer;
    if(!is_same_shell || !is_certified() || !other.is_certified()) return Verdict::UNDECIDED;
    std::vector<Crossing_path> paths = other.m_report.paths;
    paths.insert(paths.end(), other.m_report.spare_paths.begin(), other.m_report.spare_paths.end());
    return match_components(paths, *m_input).verdict();
  }

  /// Returns `true` if all claims were proved when the mesh was last verified.
  bool is_certified() const
  {
    return m_status == Shell_status::SUCCESS && m_arithmetic == Arithmetic_status::SOUND
           && std::all_of(m_report.verdicts.begin(), m_report.verdicts.end(),
                          [](Verdict v) { return v == Verdict::PROVED; });
  }
  explicit operator bool() const { return is_certified(); }

  /// Returns `SUCCESS` if the mesh could be examined, otherwise the reason.
  Shell_status status() const { return m_status; }
  const Offending_simplices& offending_simplices() const { return m_offenders; }
  Arithmetic_status arithmetic() const { return m_arithmetic; }

  /// Returns all results, without the data that they refer to.
  const Certificate_report& report() const { return m_report; }
  Verdict verdict(Claim claim) const { return m_report.verdict(claim); }
  /// Returns places where a claim is not proved; their full number is `Certificate_report::number_of_witnesses`.
  const std::vector<Certificate_witness>& witnesses() const { return m_report.witnesses; }
  /// Returns the verdicts on facets, in the order of `faces(mesh)`, then on those of the closing, and of discs.
  const std::vector<Facet_verdict>& facets() const { return m_facets; }
  /// Returns the cover of the shell by boxes, if containment is proved.
  const std::optional<Cover>& cover() const { return m_cover; }
  /// Returns the examined triangles, which have `double` coordinates.
  const Triangle_mesh& examined_mesh() const { return m_input->mesh(); }
  /// Returns, for each component of the mesh, the vertex of the examined mesh from which the cover is flooded, if
  /// containment is proved.
  const std::vector<Triangle_mesh::Vertex_index>& seeds() const { return m_seeds; }
  /// Returns the number of components of the cover.
  std::size_t number_of_covers() const { return m_report.covers; }
  /// Returns the paths that prove the degree.
  const std::vector<Crossing_path>& paths() const { return m_report.paths; }
  /// Returns, for each component of the mesh, the component of the shell that certainly contains it, or
  /// `Certificate_witness::none`.
  const std::vector<std::size_t>& components() const { return m_report.components; }
  const Certificate_statistics& statistics() const { return m_report.statistics; }
  /// Returns the bounds on the cells that facets meet; null if there are none yet.
  const std::shared_ptr<const Bounds>& bounds() const { return m_bounds; }

  /// \name Quantities
  /// @{
  /// Returns a lower bound of \f$|\nabla f|\f$ in the shell; 0 if the gradient claim is not proved.
  double least_gradient() const { return m_report.least_gradient; }
  /// Bounds, in user units, the distance of a point from its image on any other certified mesh: an integral curve in
  /// the shell is not longer. The bound is infinite if the gradient claim is not proved.
  double displacement_bound() const { return m_report.displacement_bound; }
  /// Bounds, for each facet in the order of `faces(mesh)`, the length in the shell of the integral curves that meet the
  /// facet. The bounds depend on the gradient and the thresholds nearby, and in most places are much smaller than
  /// `displacement_bound()`. This takes several times as long as the proof.
  template <typename ConcurrencyTag = Parallel_if_available_tag>
  std::vector<double> displacement_bounds() const
  {
    if(!(displacement_bound() < std::numeric_limits<double>::infinity()))
      return std::vector<double>(m_facets.size(), displacement_bound());
    return Bspline_shells::displacement_bounds<ConcurrencyTag>(*m_cover, m_inner, m_outer, *m_input,
                                                               displacement_bound());
  }
  /// Returns a lower bound, in radians, of the angle at which integral curves pass through facets; 0 if containment or
  /// transversality is not proved.
  double least_angle() const { return m_report.least_angle; }
  /// Returns the smallest cone margin of a vertex (`vertex_cone_margin()`).
  double least_cone_margin() const { return m_report.least_cone_margin; }
  /// Returns the vertices, by their position in `vertices(mesh)`, at which no field can be transversal: exact.
  const std::vector<std::size_t>& singular_vertices() const { return m_report.singular_vertices; }
  /// @}

private:
  typedef typename Field::Cell_index Cell_index;
  typedef typename Field::Point_3 Point_3;
  typedef Triangle_mesh::Face_index Face_index;
  typedef Triangle_mesh::Vertex_index Vertex_index;

  void reuse_certificate_of(const Bspline_shell_3<Field, Threshold>& shell)
  {
    const Certificate_report& report = shell.report().certificate;
    m_proved = { shell.proved_cover(), report.covers, report.least_gradient, report.greatest_gradient };
    m_is_shell_certified = m_are_paths_proved = shell.is_certified();
    m_shell_paths = m_is_shell_certified ? shell.component_paths() : shell.path_candidates();
  }

  // Clears the results for the last mesh; does not throw.
  void unsay()
  {
    m_status = Shell_status::NOT_BUILT;
    m_report = Certificate_report();
    m_facets.clear();
  }

  // Clears all data that depends on the mesh. Other data is kept; bounds on cells, however, only for a shell, as the
  // coefficients of a field may have changed.
  void forget()
  {
    Shell_certificate_3 empty(*m_field, m_inner, m_outer);
    empty.m_is_of_shell = m_is_of_shell;
    if(m_is_of_shell) empty.m_bounds = std::move(m_bounds);
    empty.m_closing = m_closing;
    empty.m_truncation = m_truncation;
    empty.m_proved = std::move(m_proved);
    empty.m_shell_paths = std::move(m_shell_paths);
    empty.m_shell_status = m_shell_status;
    empty.m_is_shell_certified = m_is_shell_certified;
    empty.m_are_paths_proved = m_are_paths_proved;
    *this = std::move(empty);
  }

  static Point_3 to_field(const Triangle_mesh::Point& p) { return Point_3(p.x(), p.y(), p.z()); }
  static std::array<double, 3> to_array(const Triangle_mesh::Point& p) { return { p.x(), p.y(), p.z() }; }
  static Verdict worse(Verdict a, Verdict b)
  {
    if(a == Verdict::REFUTED || b == Verdict::REFUTED) return Verdict::REFUTED;
    return a == Verdict::UNDECIDED || b == Verdict::UNDECIDED ? Verdict::UNDECIDED : Verdict::PROVED;
  }

  // Returns the verdict so far.
  Verdict found(Claim claim) const { return m_draft.verdict(claim); }
  void begin(Claim claim) { m_draft.verdicts[std::size_t(claim)] = Verdict::PROVED; }

  static Certificate_witness witness(Claim claim, Verdict verdict, Certificate_witness::Reason reason)
  {
    Certificate_witness w;
    w.claim = claim;
    w.verdict = verdict;
    w.reason = reason;
    return w;
  }

  // Lowers the claim's verdict to the verdict of the witness.
  void conclude(const Certificate_witness& w)
  {
    Verdict& verdict = m_draft.verdicts[std::size_t(w.claim)];
    verdict = worse(verdict, w.verdict);
    m_draft.add(w);
  }
  void conclude(Claim claim, Verdict verdict, Certificate_witness::Reason reason)
  {
    conclude(witness(claim, verdict, reason));
  }

  template <typename ConcurrencyTag>
  void examine_vertices(const Input_mesh_3& input)
  {
    const Triangle_mesh& mesh = input.mesh();
    constexpr std::size_t chunk = 256;
    const std::vector<Vertex_index> vertices(mesh.vertices().begin(), mesh.vertices().end());
    struct Result
    {
      double least_margin = 1;
      std::vector<std::size_t> singular;
    };
    std::vector<Result> results((vertices.size() + chunk - 1) / chunk);
    internal::for_each_chunk<ConcurrencyTag>(vertices.size(), chunk, [&](std::size_t begin, std::size_t end) {
      Result& result = results[begin / chunk];
      for(std::size_t n = begin; n < end; ++n) {
        if(mesh.is_isolated(vertices[n])) continue;
        const std::optional<double> margin = bounded_vertex_cone_margin(mesh, vertices[n], result.least_margin);
        if(margin) result.least_margin = *margin; // existence is decided exactly, unlike the value
        else result.singular.push_back(input.vertex_of_origin(vertices[n]));
      }
    });
    m_draft.least_cone_margin = 1;
    for(const Result& result : results) {
      m_draft.least_cone_margin = (std::min)(m_draft.least_cone_margin, result.least_margin);
      m_draft.singular_vertices.insert(m_draft.singular_vertices.end(), result.singular.begin(), result.singular.end());
    }
    std::sort(m_draft.singular_vertices.begin(), m_draft.singular_vertices.end());
    if(!m_draft.singular_vertices.empty()) m_draft.least_cone_margin = 0;
  }

  // Returns a slope that some facet has, rounded. If facets are alike, it is not much above the least slope. No claim
  // depends on it; it only limits the range in which slopes must be bounded closely.
  double least_slope_at_some_corners(const Input_mesh_3& input, const std::vector<Face_index>& triangles) const
  {
    constexpr std::size_t some = 512;
    double least = std::numeric_limits<double>::infinity();
    for(std::size_t n = 0; n < triangles.size(); n += 1 + triangles.size() / some) {
      const auto t = input.triangle(triangles[n]);
      const std::array<double, 3> normal = facet_normal(t[0], t[1], t[2]).direction;
      const double slope = Bounds::slope(m_bounds->sample(to_field(t[0])), normal) / internal::norm(normal);
      if(slope > 0) least = (std::min)(least, slope);
    }
    return least;
  }

  // Examines P1 and P2.
  template <typename ConcurrencyTag>
  std::vector<Facet_verdict> examine_facets(const Input_mesh_3& input)
  {
    const Triangle_mesh& mesh = input.mesh();
    const std::vector<Face_index> triangles(mesh.faces().begin(), mesh.faces().end());
    const std::size_t chunk = internal::chunk_size(triangles.size(), 1024);
    struct Result
    {
      std::vector<Certificate_witness> witnesses;
      Predicate_statistics containment, transversality;
      double least_slope = std::numeric_limits<double>::infinity();
    };
    std::vector<Result> results((triangles.size() + chunk - 1) / chunk);
    std::vector<Facet_verdict> verdicts(triangles.size());
    constexpr std::size_t most_bisections = 65536; // large facets meet thousands of cells
    if(!m_bounds) m_bounds = std::make_shared<const Bounds>(*m_field, m_inner, m_outer);
    const double slope_somewhere = least_slope_at_some_corners(input, triangles);
    internal::for_each_chunk<ConcurrencyTag>(triangles.size(), chunk, [&](std::size_t begin, std::size_t end) {
      Result& result = results[begin / chunk];
      internal::Recent_samples<Bounds> samples(*m_bounds);
      for(std::size_t n = begin; n < end; ++n) {
        const auto t = input.triangle(triangles[n]);
        const std::array<Point_3, 3> triangle = { to_field(t[0]), to_field(t[1]), to_field(t[2]) };
        const auto note = [&](Claim claim, Verdict verdict, const Witness& place) {
          Certificate_witness w = witness(claim, verdict,
                                          place.outside ? Certificate_witness::OUTSIDE : Certificate_witness::FACET);
          w.facet = input.facet_of_origin(triangles[n]);
          w.part = input.part_of_facet(w.facet);
          w.triangle = std::size_t(triangles[n]);
          w.point = place.point;
          w.value = place.value;
          result.witnesses.push_back(w);
        };
        const auto h = mesh.halfedge(triangles[n]); // points to the second corner
        const auto found = m_bounds->examine(
          { samples(mesh.source(h), triangle[0]), samples(mesh.target(h), triangle[1]),
            samples(mesh.target(mesh.next(h)), triangle[2]) },
          facet_normal(triangle[0], triangle[1], triangle[2]), most_bisections,
          (std::min)(slope_somewhere, result.least_slope)); // slopes above this need no close bound
        Witness w;
        verdicts[n].containment = Verdict::PROVED;
        if(!found.is_contained) {
          verdicts[n].containment = m_predicates->values_within(triangle, m_inner, m_outer, &w, &result.containment);
          if(verdicts[n].containment != Verdict::PROVED) note(Claim::CONTAINMENT, verdicts[n].containment, w);
        }
        verdicts[n].transversality = Verdict::PROVED;
        verdicts[n].slope = found.slope;
        if(!found.is_transversal) {
          verdicts[n].slope = (std::min)(result.least_slope, 0.25);
          verdicts[n].transversality = m_predicates->crosses_upwards(triangle, &w, &result.transversality,
                                                                     &verdicts[n].slope);
          if(verdicts[n].transversality != Verdict::PROVED) note(Claim::TRANSVERSALITY, verdicts[n].transversality, w);
        }
        result.least_slope = (std::min)(result.least_slope, verdicts[n].slope);
      }
    });
    m_least_slope = std::numeric_limits<double>::infinity();
    for(const Result& result : results) {
      for(const Certificate_witness& w : result.witnesses) m_draft.add(w);
      m_draft.statistics.containment += result.containment;
      m_draft.statistics.transversality += result.transversality;
      m_least_slope = (std::min)(m_least_slope, result.least_slope);
    }
    // A facet, and the mesh, has the worst verdict of its triangles. A facet without triangles is undecided.
    std::vector<Facet_verdict> facets(input.number_of_facets_of_origin());
    std::vector<char> is_known(facets.size(), 0);
    begin(Claim::CONTAINMENT);
    begin(Claim::TRANSVERSALITY);
    Verdict &containment = m_draft.verdicts[std::size_t(Claim::CONTAINMENT)],
            &transversality = m_draft.verdicts[std::size_t(Claim::TRANSVERSALITY)];
    for(std::size_t n = 0; n < triangles.size(); ++n) {
      containment = worse(containment, verdicts[n].containment);
      transversality = worse(transversality, verdicts[n].transversality);
      const std::size_t f = input.facet_of_origin(triangles[n]);
      Facet_verdict& facet = facets[f];
      if(!is_known[f]) {
        is_known[f] = 1;
        facet = verdicts[n];
      } else {
        facet.containment = worse(facet.containment, verdicts[n].containment);
        facet.transversality = worse(facet.transversality, verdicts[n].transversality);
        facet.slope = (std::min)(facet.slope, verdicts[n].slope);
      }
    }
    return facets;
  }

  // Returns an upper bound, by differences of coefficients, of the length of the gradient on a leaf cell, per user
  // unit.
  double greatest_gradient(std::uint32_t c) const
  {
    const typename Field::Cell cell = m_field->cell(c);
    const double* b = cell.coefficients();
    std::array<double, 3> greatest = {};
    internal::for_each_coefficient_line([&](int axis, int n, auto stride) {
      double& most = greatest[std::size_t(axis)];
      for(int m = 0; m < 3; ++m) most = (std::max)(most, std::abs(b[n + (m + 1) * stride] - b[n + m * stride]));
    });
    for(double& largest : greatest) largest = 3 * (largest + 2 * cell.error_radius());
    return internal::length_bound(greatest) / cell.width() * (1 + 16 * internal::rounding)
           + std::numeric_limits<double>::denorm_min();
  }

  typedef typename Cover::Shared Shared;

  // Adopts the proved cover, if there is one and it contains all components of the mesh. Returns the components of the
  // mesh that share a component of the cover with an earlier one.
  std::optional<std::vector<Shared> > adopt_proved_cover(const Triangle_mesh& mesh)
  {
    if(!m_proved.cover) return std::nullopt;
    std::vector<Point_3> points;
    for(Vertex_index v : m_seeds) points.push_back(to_field(mesh.point(v)));
    m_cover.emplace(*m_field, m_inner, m_outer);
    return m_cover->adopt(*m_proved.cover, points);
  }

  template <typename ConcurrencyTag>
  std::vector<Shared> find_cover(const Input_mesh_3& input)
  {
    // The cells at the mesh are needed in any case.
    std::vector<std::uint32_t> cells;
    for(Face_index f : input.mesh().faces())
      cells.push_back(m_field->locate(to_field(input.mesh().point(input.mesh().target(input.mesh().halfedge(f))))));
    m_cover.emplace(*m_field, m_inner, m_outer);
    m_cover->template prepare<ConcurrencyTag>(std::move(cells));
    std::vector<Shared> shared;
    for(std::size_t c = 0; c < input.number_of_components(); ++c) {
      const std::uint32_t known = m_cover->template flood<ConcurrencyTag>(to_field(input.mesh().point(m_seeds[c])),
                                                                          std::uint32_t(c));
      if(known != c) shared.push_back({ known, c });
    }
    return shared;
  }

  void find_seeds(const Input_mesh_3& input)
  {
    const Triangle_mesh& mesh = input.mesh();
    m_seeds.assign(input.number_of_components(), Triangle_mesh::null_vertex());
    for(Face_index f : mesh.faces())
      if(m_seeds[input.component(f)] == Triangle_mesh::null_vertex())
        m_seeds[input.component(f)] = mesh.target(mesh.halfedge(f));
  }

  // Examines P3, given P1: the mesh's components stay in the components of their seeds. Returns the components of the
  // mesh that share a component of the cover.
  template <typename ConcurrencyTag>
  std::vector<Shared> examine_cover(const Input_mesh_3& input)
  {
    const Triangle_mesh& mesh = input.mesh();
    const std::optional<std::vector<Shared> > known = adopt_proved_cover(mesh);
    const std::vector<Shared> shared = known ? *known : find_cover<ConcurrencyTag>(input);
    const Cover& cover = *m_cover;
    begin(Claim::GRADIENT);
    m_draft.covers = input.number_of_components() - shared.size();

    Level_range thresholds;
    const bool is_greatest_known = known && m_draft.covers == m_proved.components
                                   && m_proved.greatest_gradient < std::numeric_limits<double>::infinity();
    double greatest = is_greatest_known ? m_proved.greatest_gradient : 0;
    std::uint32_t last_cell = std::uint32_t(-1);
    std::size_t examined = 0;
    for(const Cover_box& box : cover.boxes()) {
      m_draft.statistics.deepest_box = (std::max)(m_draft.statistics.deepest_box, std::size_t(box.depth));
      if(box.kind == Box_kind::EXCLUDED) ++m_draft.statistics.excluded_boxes;
      if(box.component == Cover_box::no_component) continue;
      ++m_draft.statistics.cover_boxes;
      if(box.cell != last_cell) {
        last_cell = box.cell;
        thresholds.include(threshold_range(m_inner, m_outer, box.cell));
        if(!is_greatest_known) greatest = (std::max)(greatest, greatest_gradient(box.cell));
      }
      if(box.kind == Box_kind::MONOTONE) {
        ++m_draft.statistics.monotone_boxes;
        continue;
      }
      if(box.kind != Box_kind::UNDECIDED) {
        ++m_draft.statistics.critical_boxes;
        continue;
      }
      ++m_draft.statistics.undecided_boxes;
      internal::Run::poll();
      const Bbox_3 b = cover.bbox(box);
      std::array<double, 3> center = { (b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2,
                                       (b.zmin() + b.zmax()) / 2 };
      const bool critical = examined < max_examined && is_critical(mesh, box, center);
      ++examined;
      Certificate_witness w = witness(Claim::GRADIENT, critical ? Verdict::REFUTED : Verdict::UNDECIDED,
                                      critical ? Certificate_witness::CRITICAL_POINT : Certificate_witness::BOX);
      w.cell = box.cell;
      w.point = center;
      conclude(w);
    }
    for(typename Cover::Box_index b : cover.at_end()) {
      Certificate_witness w = witness(Claim::GRADIENT, Verdict::UNDECIDED, Certificate_witness::END_OF_DOMAIN);
      w.cell = cover.boxes()[b].cell;
      const Bbox_3 box = cover.bbox(cover.boxes()[b]);
      w.point = { (box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2 };
      conclude(w);
    }
    m_draft.statistics.cover_cells = cover.number_of_cells();
    m_draft.greatest_gradient = greatest;
    if(found(Claim::TRANSVERSALITY) == Verdict::PROVED)
      m_draft.least_angle = std::asin((std::min)(1., m_least_slope / greatest)) * (1 - 8 * internal::rounding);
    if(found(Claim::GRADIENT) == Verdict::PROVED)
      m_draft.least_gradient = known && m_proved.least_gradient > 0 ? m_proved.least_gradient
                                                                    : cover.template least_gradient<ConcurrencyTag>();
    if(m_draft.least_gradient > 0)
      m_draft.displacement_bound = internal::longest_curve(thresholds, m_draft.least_gradient);
    return shared;
  }

  // Examines P4, given P1. Components of the mesh in different components of the cover are in different components of
  // the shell. So are components of the mesh that share one, if P2, P3 and P5 hold. Then each component of the shell is
  // a product of a surface and the curves. All curves meet a component of the mesh in it equally often, and at least
  // once. As the path through such a component meets the whole mesh once, there is no other.
  void examine_sheets(const Input_mesh_3& input, const std::vector<Shared>& shared)
  {
    begin(Claim::ONE_SHEET);
    const bool is_product = found(Claim::TRANSVERSALITY) == Verdict::PROVED
                            && found(Claim::GRADIENT) == Verdict::PROVED;
    std::vector<char> has_path(input.number_of_components(), 0);
    for(const Crossing_path& path : m_draft.paths) has_path[path.component] = 1;
    for(const Shared& pair : shared) {
      if(is_product && has_path[pair[0]] && has_path[pair[1]]) continue;
      const std::optional<std::array<double, 3> > joint = joined(input, pair[0], pair[1]);
      Certificate_witness w = witness(Claim::ONE_SHEET, joint ? Verdict::REFUTED : Verdict::UNDECIDED,
                                      Certificate_witness::TWO_SHEETS);
      w.component = pair[0];
      w.other_component = pair[1];
      w.point = joint ? *joint : to_array(input.mesh().point(m_seeds[pair[1]]));
      conclude(w);
    }
  }

  // Returns true if there certainly is a critical point in an undecided box, and in the shell: between the thresholds,
  // and joined to a vertex of the mesh by a segment between them.
  bool is_critical(const Triangle_mesh& mesh, const Cover_box& box, std::array<double, 3>& point) const
  {
    const Enclosed_tricubic f = m_cover->function(box);
    const std::optional<Critical_point> critical = prove_critical_point(f);
    if(!critical) return false;
    const Bbox_3 b = m_cover->bbox(box);
    const double width = b.xmax() - b.xmin();
    for(int a = 0; a < 3; ++a) point[a] = (b.min)(a) + critical->center[a] * width;
    // The whole box must be in the shell, as the critical point may be anywhere in it.
    if(!m_cover->is_between_thresholds(box)) return false;
    const Triangle_mesh::Point p(point[0], point[1], point[2]);
    Triangle_mesh::Point nearest = p;
    double least = std::numeric_limits<double>::infinity();
    for(Vertex_index v : mesh.vertices()) {
      const double d = CGAL::squared_distance(p, mesh.point(v));
      if(d < least) {
        least = d;
        nearest = mesh.point(v);
      }
    }
    return m_predicates->values_within(std::array<Point_3, 2>{ to_field(p), to_field(nearest) }, m_inner, m_outer)
           == Verdict::PROVED;
  }

  // Returns a point on a segment in the shell from one component of the mesh to another, if one is found.
  std::optional<std::array<double, 3> > joined(const Input_mesh_3& input, std::size_t first, std::size_t second) const
  {
    const Triangle_mesh& mesh = input.mesh();
    typedef std::pair<double, std::pair<Vertex_index, Vertex_index> > Candidate;
    constexpr std::size_t samples = 256, tries = 16;
    std::array<std::vector<Vertex_index>, 2> vertices;
    for(Face_index f : mesh.faces())
      for(int side = 0; side < 2; ++side)
        if(input.component(f) == (side == 0 ? first : second)) vertices[side].push_back(mesh.target(mesh.halfedge(f)));
    std::vector<Candidate> candidates;
    const std::size_t stride = vertices[1].size() / samples + 1;
    for(std::size_t n = 0; n < vertices[1].size(); n += stride) {
      internal::Run::poll();
      Candidate best(std::numeric_limits<double>::infinity(), {});
      for(Vertex_index v : vertices[0]) {
        const double d = CGAL::squared_distance(mesh.point(v), mesh.point(vertices[1][n]));
        if(d < best.first) best = Candidate(d, { v, vertices[1][n] });
      }
      candidates.push_back(best);
    }
    std::sort(candidates.begin(), candidates.end());
    for(std::size_t n = 0; n < (std::min)(tries, candidates.size()); ++n) {
      const auto &p = mesh.point(candidates[n].second.first), &q = mesh.point(candidates[n].second.second);
      if(m_predicates->values_within(std::array<Point_3, 2>{ to_field(p), to_field(q) }, m_inner, m_outer)
         == Verdict::PROVED)
        return to_array(CGAL::midpoint(p, q));
    }
    return std::nullopt;
  }

  // Returns the facets of a component through which paths are tried. Large facets, whose middles are far from edges,
  // alternate with facets from everywhere. The largest facets of a symmetric mesh may be copies of each other, and all
  // lie at creases, where gradients turn too fast for a straight path.
  static std::vector<Face_index> path_facets(std::vector<std::pair<double, Face_index> >& facets)
  {
    constexpr std::size_t half = max_paths / 2;
    std::vector<Face_index> spread, candidates;
    if(facets.size() > max_paths)
      for(std::size_t n = 0; n < half; ++n) spread.push_back(facets[n * (facets.size() / half)].second);
    const std::size_t largest = (std::min)(max_paths, facets.size()) - spread.size();
    std::partial_sort(facets.begin(), facets.begin() + std::ptrdiff_t(largest), facets.end());
    for(std::size_t n = 0; n < largest; ++n) {
      candidates.push_back(facets[n].second);
      if(n < spread.size()) candidates.push_back(spread[n]);
    }
    return candidates;
  }

  // Examines P5.
  template <typename ConcurrencyTag>
  void examine_paths(const Input_mesh_3& input, const Crossing_counter_3& counter)
  {
    const Triangle_mesh& mesh = input.mesh();
    std::vector<std::vector<std::pair<double, Face_index> > > facets(input.number_of_components());
    for(Face_index f : mesh.faces()) {
      const auto t = input.triangle(f);
      facets[input.component(f)].emplace_back(-CGAL::cross_product(t[1] - t[0], t[2] - t[0]).squared_length(), f);
    }
    begin(Claim::DEGREE_ONE);
    for(std::size_t c = 0; c < input.number_of_components(); ++c) {
      internal::Run::poll();
      const std::vector<Face_index> candidates = path_facets(facets[c]);
      Verdict verdict = Verdict::UNDECIDED;
      Crossing_path path;
      path.component = c;
      int count = 0;
      Face_index facet = candidates.front();
      std::size_t n = 0;
      for(; n < max_paths && verdict == Verdict::UNDECIDED; ++n) {
        const Face_index tried = candidates[n % candidates.size()];
        const std::array<double, 3>& point = path_points[n / candidates.size() % path_points.size()];
        verdict = try_path<ConcurrencyTag>(input, counter, tried, point, path, count);
        if(verdict == Verdict::REFUTED) facet = tried;
      }
      if(verdict == Verdict::PROVED) {
        m_draft.paths.push_back(path);
        // Spare paths lead through other points of the next facets: a mesh may have vertices in the middles of facets.
        const std::size_t first = (n - 1) % candidates.size();
        const std::size_t end = (std::min)(first + max_spare_paths, candidates.size());
        for(std::size_t m = first; m < end; ++m)
          if(try_path<ConcurrencyTag>(input, counter, candidates[m], { 0.871, 0.978, 1.151 }, path, count)
             == Verdict::PROVED)
            m_draft.spare_paths.push_back(path);
        continue;
      }
      // The count is the same for all paths only if there are no critical points.
      if(found(Claim::GRADIENT) != Verdict::PROVED) verdict = Verdict::UNDECIDED;
      Certificate_witness w = witness(Claim::DEGREE_ONE, verdict,
                                      verdict == Verdict::REFUTED ? Certificate_witness::CROSSINGS
                                                                  : Certificate_witness::NO_PATH);
      w.component = c;
      if(verdict == Verdict::REFUTED) w.count = count;
      const auto t = input.triangle(facet);
      w.point = to_array(CGAL::centroid(t[0], t[1], t[2]));
      w.facet = input.facet_of_origin(facet);
      w.part = input.part_of_facet(w.facet);
      w.triangle = std::size_t(facet);
      conclude(w);
    }
  }

  // Keeps only the shell's paths that are proved.
  void prove_shell_paths()
  {
    if(m_are_paths_proved) return;
    const auto point = [](const std::array<double, 3>& p) { return Point_3(p[0], p[1], p[2]); };
    const auto is_unproved = [&](const Crossing_path& path) {
      return !leads_through_shell(*m_predicates, m_inner, m_outer, { point(path.source), point(path.target) });
    };
    m_shell_paths.erase(std::remove_if(m_shell_paths.begin(), m_shell_paths.end(), is_unproved), m_shell_paths.end());
    m_are_paths_proved = true;
  }

  // Examines whether the components of the mesh are those of the certified shell. All meshes for which this is proved
  // are mapped onto each other. Without paths through a shell, the mesh defines the components. A shell that is not
  // certified may have critical points away from the mesh, and a file may have any paths. So if such paths do not meet
  // a mesh, nothing is refuted.
  void examine_components(const Input_mesh_3& input)
  {
    m_draft.components.assign(input.number_of_components(), Certificate_witness::none);
    if(m_shell_paths.empty()) {
      for(const Crossing_path& path : m_draft.paths) m_draft.components[path.component] = path.component;
      return;
    }
    const Component_match match = match_components(m_shell_paths, input);
    m_draft.components = match.component_of_shell;
    // Components that face along the gradient are counted with the same sign.
    const bool is_transversal = found(Claim::TRANSVERSALITY) == Verdict::PROVED;
    bool is_known = is_transversal && m_is_shell_certified;
    for(std::size_t k = 0; k < match.crossings.size(); ++k) {
      const std::optional<int> count = match.crossings[k];
      is_known = is_known && count;
      if(count == 1) continue;
      const bool is_empty = !count || *count == 0, is_refuted = count && is_transversal && m_is_shell_certified;
      Certificate_witness w = witness(
        is_empty ? Claim::ONE_SHEET : Claim::DEGREE_ONE, is_refuted ? Verdict::REFUTED : Verdict::UNDECIDED,
        is_empty ? Certificate_witness::EMPTY_COMPONENT : Certificate_witness::SHELL_CROSSINGS);
      w.component = k;
      if(!is_empty) w.count = *count;
      for(const Crossing_path& path : m_shell_paths)
        if(path.component == k)
          for(int a = 0; a < 3; ++a) w.point[a] = (path.source[a] + path.target[a]) / 2;
      conclude(w);
    }
    for(std::size_t c = 0; c < input.number_of_components(); ++c)
      if(m_draft.components[c] == Certificate_witness::none) {
        Certificate_witness w = witness(Claim::ONE_SHEET, is_known ? Verdict::REFUTED : Verdict::UNDECIDED,
                                        Certificate_witness::OTHER_COMPONENT);
        w.component = c;
        w.point = to_array(input.mesh().point(m_seeds[c]));
        conclude(w);
      }
  }

  // Tries a segment through a facet, along the gradient at the point with the given barycentric coordinates. The count
  // proves or refutes the claim; if the segment does not qualify, the verdict is undecided.
  template <typename ConcurrencyTag>
  Verdict try_path(const Input_mesh_3& input, const Crossing_counter_3& counter, Face_index f,
                   const std::array<double, 3>& weights, Crossing_path& path, int& count) const
  {
    const auto t = input.triangle(f);
    const Triangle_mesh::Point middle = CGAL::barycenter(t[0], weights[0], t[1], weights[1], t[2], weights[2]);
    const auto segment = segment_through_shell(*m_predicates, m_inner, m_outer, to_field(middle));
    if(!segment) return Verdict::UNDECIDED;
    const auto point = [](const Point_3& p) { return Triangle_mesh::Point(p[0], p[1], p[2]); };
    const Triangle_mesh::Point p = point((*segment)[0]), q = point((*segment)[1]);
    const auto crossings = counter.crossings<ConcurrencyTag>(p, q);
    if(!crossings) return Verdict::UNDECIDED;
    count = 0;
    for(const auto& crossing : *crossings) count += crossing.second;
    path.triangle = std::size_t(f);
    path.source = to_array(p);
    path.target = to_array(q);
    const bool through = std::any_of(crossings->begin(), crossings->end(), [&](const auto& x) { return x.first == f; });
    if(!through) return Verdict::UNDECIDED;
    return count == 1 ? Verdict::PROVED : Verdict::REFUTED;
  }

  static constexpr std::size_t max_paths = 64; // paths tried for a component
  // Barycentric coordinates of the points at which paths pass facets; the first one for all facets, then the next.
  static constexpr std::array<std::array<double, 3>, 4> path_points = {
    { { 1, 1, 1 }, { 2, 1, 1 }, { 1, 2, 1 }, { 1, 1, 2 } }
  };
  static constexpr std::size_t max_spare_paths = 3; // per component
  static constexpr std::size_t max_examined = 64;   // undecided boxes that are searched for a critical point

  const Field* m_field;
  Threshold m_inner, m_outer;
  bool m_is_of_shell = false;
  std::shared_ptr<const Bounds> m_bounds;
  std::shared_ptr<const Shell_closing_3> m_closing;
  std::shared_ptr<const Shell_truncation_3> m_truncation;
  struct
  {
    std::shared_ptr<const std::vector<Cover_box> > cover;
    std::size_t components = 0;
    double least_gradient = 0, greatest_gradient = std::numeric_limits<double>::infinity();
  } m_proved;                               // proved results of the shell
  std::vector<Crossing_path> m_shell_paths; // through the components of the shell
  Shell_status m_shell_status = Shell_status::SUCCESS;
  bool m_is_shell_certified = false, m_are_paths_proved = true;
  std::optional<Field_predicates_3<Field> > m_predicates;
  std::shared_ptr<const Input_mesh_3> m_input = std::make_shared<const Input_mesh_3>();
  Shell_status m_status = Shell_status::NOT_BUILT;
  Offending_simplices m_offenders;
  Arithmetic_status m_arithmetic = Arithmetic_status::SOUND;
  Certificate_report m_draft, m_report; // results of the current examination, and the published ones
  std::vector<Facet_verdict> m_facets;
  std::optional<Cover> m_cover;
  std::vector<Vertex_index> m_seeds;
  double m_least_slope = 0;
};

template <typename Field, typename Threshold>
template <typename ConcurrencyTag>
bool Shell_certificate_3<Field, Threshold>::verify(std::shared_ptr<const Input_mesh_3> input)
{
  unsay();
  Real_timer timer;
  timer.start();
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  forget();
  m_arithmetic = arithmetic_self_test();
  if(m_arithmetic != Arithmetic_status::SOUND) return false;
  m_status = m_shell_status;
  if(m_status != Shell_status::SUCCESS) return false;
  if(!m_field->has_exact_cells()) {
    m_status = Shell_status::GRID_TOO_FINE;
    return false;
  }
  m_input = std::move(input);
  m_status = m_input->status();
  m_offenders = m_input->offending_simplices();
  if(m_status != Shell_status::SUCCESS) return false;
  if(!m_inner.has_cells_of(*m_field) || !m_outer.has_cells_of(*m_field)) {
    m_status = Shell_status::THRESHOLDS_ON_OTHER_CELLS;
    return false;
  }
  m_predicates.emplace(*m_field);
  prove_shell_paths();
  examine_vertices<ConcurrencyTag>(*m_input);
  std::vector<Facet_verdict> facets = examine_facets<ConcurrencyTag>(*m_input);
  find_seeds(*m_input);
  if(found(Claim::CONTAINMENT) == Verdict::PROVED) {
    const std::vector<Shared> shared = examine_cover<ConcurrencyTag>(*m_input);
    const Crossing_counter_3 counter(m_input->mesh());
    examine_paths<ConcurrencyTag>(*m_input, counter);
    examine_sheets(*m_input, shared);
    examine_components(*m_input);
  } else {
    for(Claim claim : { Claim::GRADIENT, Claim::ONE_SHEET, Claim::DEGREE_ONE })
      conclude(claim, Verdict::UNDECIDED, Certificate_witness::CONTAINMENT_NEEDED);
  }
  m_draft.statistics.seconds = timer.time();
  // Published last: an exception leaves every claim undecided.
  m_facets = std::move(facets);
  m_report = std::move(m_draft);
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
