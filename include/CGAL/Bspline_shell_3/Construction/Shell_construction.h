// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SHELL_CONSTRUCTION_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SHELL_CONSTRUCTION_H

#include <CGAL/Bspline_shell_3/Cells/Cell_complex_3.h>
#include <CGAL/Bspline_shell_3/Cells/Lattice_set_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Shell/Shell_report.h>
#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/arithmetic_self_test.h>

#include <CGAL/Real_timer.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the common part of the two constructions of shells: the checked mesh, the lattice of cells, and a report with
 * the time of each step.
 */
class Shell_construction
{
public:
  /// \param max_seconds time limit of `run()`, measured from now on
  /// \pre `visitor` outlives this object
  template <typename Visitor>
  Shell_construction(Visitor& visitor, double max_seconds)
    : m_start_step([&visitor](Shell_step step) { return visitor.start_step(step); }),
      m_run(max_seconds, internal::Go_on<Visitor>::of(visitor))
  {
    m_timer.start();
  }

  /// returns `build()`, or an object without a shell if the time limit is reached or the visitor cancels
  template <typename Shell, typename Build>
  Shell run(const Build& build)
  {
    return m_run(build, [this](internal::Run::End ended) { return Shell(end(internal::status(ended))); });
  }

  /// ends the last step and begins the next one; ends `run()` if the visitor cancels
  void start(Shell_step step)
  {
    internal::Run::poll();
    end_step();
    m_step = step;
    if(!m_start_step(step)) m_run.cancel();
  }

  /// ends the last step
  /// \return the report, with `status`
  Shell_report end(Shell_status status)
  {
    end_step();
    m_report.status = status;
    return m_report;
  }

  /// ends the construction because of an invalid parameter
  /// \return the report, with `Shell_status::INVALID_PARAMETER`
  Shell_report refuse(const Invalid_parameter& parameter)
  {
    m_report.invalid_parameter = parameter;
    return end(Shell_status::INVALID_PARAMETER);
  }

  /// tests the arithmetic, copies the mesh and checks it.
  /// \param np `vertex_point_map`, `allow_self_intersections`, and `allow_singular_vertices` as for `bspline_shell_3()`
  /// \param closer closes open meshes, which are rejected without it
  /// \param truncator truncates singular and nearly singular vertices
  template <typename ConcurrencyTag, typename PolygonMesh, typename NP>
  Shell_status check(const PolygonMesh& mesh, const NP& np, const Input_mesh_3::Closer& closer = Input_mesh_3::Closer(),
                     const Input_mesh_3::Truncator& truncator = Input_mesh_3::Truncator())
  {
    using CGAL::parameters::choose_parameter;
    using CGAL::parameters::get_parameter;
    if(arithmetic_self_test() != Arithmetic_status::SOUND) return Shell_status::UNSOUND_ARITHMETIC;
    start(Shell_step::CHECK);
    Input_mesh_3::Tolerated_defects tolerated;
    tolerated.self_intersections = choose_parameter(get_parameter(np, internal_np::allow_self_intersections), false);
    tolerated.singular_vertices = choose_parameter(get_parameter(np, parameter_tags::allow_singular_vertices), false);
    const auto mesh_copy = std::make_shared<Input_mesh_3>();
    const Shell_status status = mesh_copy->template build<ConcurrencyTag>(
      mesh, choose_parameter(get_parameter(np, internal_np::vertex_point), get_const_property_map(vertex_point, mesh)),
      tolerated, closer, truncator);
    m_input = mesh_copy;
    m_report.offending_simplices = m_input->offending_simplices();
    if(status != Shell_status::SUCCESS) return status;
    if(m_input->closing()) m_report.closing.triangles = m_input->closing()->triangles().size();
    m_report.triangles = m_input->mesh().number_of_faces();
    m_report.components = m_input->number_of_components();
    m_report.unit = m_input->unit();
    return status;
  }

  /// returns the lattice of cells, or of root cells; nothing if it would have too many cells
  /// \pre the mesh is checked
  std::optional<Lattice_3> choose_lattice(double spacing)
  {
    const Lattice_3 lattice = Lattice_3::off_the_ends(m_input->bbox(), spacing);
    if(!lattice.is_exact() || m_input->unit() / lattice.spacing() > Lattice_key::max_coordinate) return std::nullopt;
    m_report.gamma = m_input->unit() / lattice.spacing();
    return lattice;
  }

  Shell_report& report() { return m_report; }
  /// returns the checked mesh
  const std::shared_ptr<const Input_mesh_3>& input() const { return m_input; }

private:
  void end_step()
  {
    m_report.seconds[std::size_t(m_step)] += m_timer.time();
    m_timer.reset();
  }

  std::function<bool(Shell_step)> m_start_step;
  internal::Run m_run;
  Shell_report m_report;
  std::shared_ptr<const Input_mesh_3> m_input;
  Real_timer m_timer;
  Shell_step m_step = Shell_step::CHECK;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SHELL_CONSTRUCTION_H
