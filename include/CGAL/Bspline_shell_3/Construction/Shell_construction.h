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
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/arithmetic_self_test.h>

#include <CGAL/Real_timer.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <cstddef>
#include <memory>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief what the construction of every shell begins with: the checked mesh and a lattice of cells; and its report, with the time of each step.
 *
 * \tparam Visitor a model of `ShellVisitor`
 */
template <typename Visitor>
class Shell_construction
{
public:
  /// \pre `visitor` outlives this object
  explicit Shell_construction(Visitor& visitor) : m_visitor(visitor) { m_timer.start(); }

  /// ends the last step and begins the next
  /// \return `false` if the visitor wants to stop
  bool start(Shell_step step)
  {
    end_step();
    m_step = step;
    return m_visitor.start_step(step);
  }

  /// ends the last step
  /// \return the report, with `status`
  Shell_report end(Shell_status status)
  {
    end_step();
    report.status = status;
    return report;
  }

  /// tests the arithmetic, and copies and checks the mesh.
  /// \param np `vertex_point_map`, `allow_self_intersections` and `allow_singular_vertices` as for `bspline_shell_3()`
  template <typename ConcurrencyTag, typename PolygonMesh, typename NP>
  Shell_status check(const PolygonMesh& mesh, const NP& np)
  {
    using CGAL::parameters::choose_parameter;
    using CGAL::parameters::get_parameter;
    if(arithmetic_self_test() != Arithmetic_status::SOUND) return Shell_status::UNSOUND_ARITHMETIC;
    if(!start(Shell_step::CHECK)) return Shell_status::CANCELED;
    Input_mesh_3::Tolerated_defects tolerated;
    tolerated.self_intersections = choose_parameter(get_parameter(np, parameter_tags::allow_self_intersections), false);
    tolerated.singular_vertices = choose_parameter(get_parameter(np, parameter_tags::allow_singular_vertices), false);
    const auto mesh_copy = std::make_shared<Input_mesh_3>();
    const Shell_status status = mesh_copy->template build<ConcurrencyTag>(
      mesh, choose_parameter(get_parameter(np, internal_np::vertex_point), get_const_property_map(vertex_point, mesh)), tolerated);
    input = mesh_copy;
    report.offending_simplices = input->offending_simplices();
    if(status != Shell_status::SUCCESS) return status;
    report.triangles = input->mesh().number_of_faces();
    report.components = input->number_of_components();
    report.unit = input->unit();
    return status;
  }

  /// chooses the lattice of cells, or of root cells.
  /// \pre the mesh is checked
  Shell_status choose_lattice(double spacing)
  {
    lattice = Lattice_3::off_the_ends(input->bbox(), spacing);
    if(!lattice.is_exact() || input->unit() / lattice.spacing() > Lattice_key::max_coordinate) return Shell_status::GRID_TOO_FINE;
    report.gamma = input->unit() / lattice.spacing();
    return Shell_status::SUCCESS;
  }

  Shell_report report;
  std::shared_ptr<const Input_mesh_3> input;
  Lattice_3 lattice;

private:
  void end_step()
  {
    report.seconds[std::size_t(m_step)] += m_timer.time();
    m_timer.reset();
  }

  Visitor& m_visitor;
  Real_timer m_timer;
  Shell_step m_step = Shell_step::CHECK;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SHELL_CONSTRUCTION_H
