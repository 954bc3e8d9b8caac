// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_NAMED_PARAMETERS_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_NAMED_PARAMETERS_H

#include <CGAL/Named_function_parameters.h>

#include <type_traits>

namespace CGAL {
namespace Bspline_shells {

namespace parameter_tags {

enum resolution_t
{
  resolution
};
enum relative_thickness_t
{
  relative_thickness
};
enum thickness_t
{
  thickness
};
enum sizing_t
{
  sizing
};
enum constant_thresholds_t
{
  constant_thresholds
};
enum number_of_rings_t
{
  number_of_rings
};
enum dense_grid_t
{
  dense_grid
};
enum energy_weights_t
{
  energy_weights
};
enum spd_solver_t
{
  spd_solver
};
enum signed_distance_oracle_t
{
  signed_distance_oracle
};
enum memory_limit_t
{
  memory_limit
};
enum effort_limit_t
{
  effort_limit
};
enum allow_singular_vertices_t
{
  allow_singular_vertices
};
enum virtual_closing_t
{
  virtual_closing
};
enum closing_t
{
  closing
};
enum truncate_t
{
  truncate
};
enum least_cone_margin_t
{
  least_cone_margin
};
enum alpha_t
{
  alpha
};
enum offset_t
{
  offset
};
enum allow_open_shell_t
{
  allow_open_shell
};
enum skip_open_components_t
{
  skip_open_components
};
enum tolerance_t
{
  tolerance
};
enum interpolation_t
{
  interpolation
};
enum mapping_t
{
  mapping
};
enum symmetry_t
{
  symmetry
};
enum linear_reconstruction_t
{
  linear_reconstruction
};
enum samples_per_facet_t
{
  samples_per_facet
};
enum default_value_t
{
  default_value
};
enum stop_t
{
  stop
};
enum locate_vertices_t
{
  locate_vertices
};
enum freeze_rejected_facets_t
{
  freeze_rejected_facets
};

} // namespace parameter_tags

// A pack of named parameters. Parameters of this package and of CGAL can be added in any order. Functions take packs by
// the base class, CGAL::Named_function_parameters.
template <typename T, typename Tag, typename Base = internal_np::No_property>
struct Named_parameters : CGAL::Named_function_parameters<T, Tag, Base>
{
  typedef CGAL::Named_function_parameters<T, Tag, Base> Pack;

  explicit Named_parameters(const T& v) : Pack(v) {}
  explicit Named_parameters(const Pack& pack) : Pack(pack) {}
  template <typename B>
  Named_parameters(const T& v, const B& base) : Pack(v, base)
  {}

#define CGAL_BSPLINE_SHELLS_ADD_PARAMETER(TAG, NAME)                                                                   \
  template <typename K>                                                                                                \
  Named_parameters<K, TAG, Pack> NAME(const K& k) const                                                                \
  {                                                                                                                    \
    return Named_parameters<K, TAG, Pack>(k, static_cast<const Pack&>(*this));                                         \
  }

#define CGAL_BSPLINE_SHELLS_PARAMETERS(ADD)                                                                            \
  ADD(parameter_tags::resolution_t, resolution)                                                                        \
  ADD(parameter_tags::relative_thickness_t, relative_thickness)                                                        \
  ADD(parameter_tags::thickness_t, thickness)                                                                          \
  ADD(parameter_tags::sizing_t, sizing)                                                                                \
  ADD(parameter_tags::constant_thresholds_t, constant_thresholds)                                                      \
  ADD(parameter_tags::number_of_rings_t, number_of_rings)                                                              \
  ADD(parameter_tags::dense_grid_t, dense_grid)                                                                        \
  ADD(parameter_tags::energy_weights_t, energy_weights)                                                                \
  ADD(parameter_tags::spd_solver_t, spd_solver)                                                                        \
  ADD(parameter_tags::signed_distance_oracle_t, signed_distance_oracle)                                                \
  ADD(parameter_tags::memory_limit_t, memory_limit)                                                                    \
  ADD(parameter_tags::effort_limit_t, effort_limit)                                                                    \
  ADD(parameter_tags::allow_singular_vertices_t, allow_singular_vertices)                                              \
  ADD(parameter_tags::virtual_closing_t, virtual_closing)                                                              \
  ADD(parameter_tags::closing_t, closing)                                                                              \
  ADD(parameter_tags::truncate_t, truncate)                                                                            \
  ADD(parameter_tags::least_cone_margin_t, least_cone_margin)                                                          \
  ADD(parameter_tags::alpha_t, alpha)                                                                                  \
  ADD(parameter_tags::offset_t, offset)                                                                                \
  ADD(parameter_tags::allow_open_shell_t, allow_open_shell)                                                            \
  ADD(parameter_tags::skip_open_components_t, skip_open_components)                                                    \
  ADD(parameter_tags::tolerance_t, tolerance)                                                                          \
  ADD(parameter_tags::interpolation_t, interpolation)                                                                  \
  ADD(parameter_tags::mapping_t, mapping)                                                                              \
  ADD(parameter_tags::symmetry_t, symmetry)                                                                            \
  ADD(parameter_tags::linear_reconstruction_t, linear_reconstruction)                                                  \
  ADD(parameter_tags::samples_per_facet_t, samples_per_facet)                                                          \
  ADD(parameter_tags::default_value_t, default_value)                                                                  \
  ADD(parameter_tags::stop_t, stop)                                                                                    \
  ADD(parameter_tags::locate_vertices_t, locate_vertices)                                                              \
  ADD(parameter_tags::freeze_rejected_facets_t, freeze_rejected_facets)                                                \
  ADD(internal_np::maximum_running_time_t, time_limit)                                                                 \
  ADD(internal_np::allow_self_intersections_t, allow_self_intersections)                                               \
  ADD(internal_np::vertex_point_t, vertex_point_map)                                                                   \
  ADD(internal_np::grid_spacing_t, grid_spacing)                                                                       \
  ADD(internal_np::visitor_t, visitor)                                                                                 \
  ADD(internal_np::filter_t, filter)                                                                                   \
  ADD(internal_np::get_cost_policy_t, get_cost)                                                                        \
  ADD(internal_np::get_placement_policy_t, get_placement)                                                              \
  ADD(internal_np::edge_is_constrained_t, edge_is_constrained_map)                                                     \
  ADD(internal_np::vertex_is_constrained_t, vertex_is_constrained_map)                                                 \
  ADD(internal_np::protect_constraints_t, protect_constraints)                                                         \
  ADD(internal_np::do_project_t, do_project)                                                                           \
  ADD(internal_np::number_of_iterations_t, number_of_iterations)                                                       \
  ADD(internal_np::number_of_relaxation_steps_t, number_of_relaxation_steps)                                           \
  ADD(internal_np::subdivision_ratio_t, subdivision_ratio)

  CGAL_BSPLINE_SHELLS_PARAMETERS(CGAL_BSPLINE_SHELLS_ADD_PARAMETER)
#undef CGAL_BSPLINE_SHELLS_ADD_PARAMETER
};

namespace internal {

// Returns a mutable argument, for example a solver. If it was passed with `std::ref`, this is a reference. If it was
// passed by value, it is a copy, as packs are constant. Otherwise it is a new `Default`. Use: `auto&& solver =
// argument<Default>(np, tag)`.
template <typename Default, typename NP, typename Tag, typename... Arguments>
decltype(auto) argument(const NP& np, Tag tag, const Arguments&... arguments_of_default)
{
  if constexpr(CGAL::parameters::is_default_parameter<NP, Tag>::value) {
    return Default(arguments_of_default...);
  } else {
    typedef decltype(CGAL::parameters::get_parameter_reference(np, tag)) Reference;
    typedef std::remove_reference_t<Reference> Object;
    return static_cast<std::conditional_t<std::is_const<Object>::value, std::remove_const_t<Object>, Reference> >(
      CGAL::parameters::get_parameter_reference(np, tag));
  }
}

} // namespace internal

/// \ingroup PkgBsplineShell3Support
/// Functions that begin a sequence of named parameters, such as `parameters::resolution(60).vertex_point_map(vpm)`. The
/// parameters are documented with the functions that read them.
namespace parameters {

#define CGAL_BSPLINE_SHELLS_BEGIN_PARAMETERS(TAG, NAME)                                                                \
  template <typename K>                                                                                                \
  Named_parameters<K, TAG> NAME(const K& k)                                                                            \
  {                                                                                                                    \
    return Named_parameters<K, TAG>(k);                                                                                \
  }

/// Continues a sequence that began in `CGAL::parameters`, such as
/// `with(CGAL::parameters::vertex_point_map(vpm)).resolution(60)`.
template <typename T, typename Tag, typename Base>
Named_parameters<T, Tag, Base> with(const CGAL::Named_function_parameters<T, Tag, Base>& np)
{
  return Named_parameters<T, Tag, Base>(np);
}

CGAL_BSPLINE_SHELLS_PARAMETERS(CGAL_BSPLINE_SHELLS_BEGIN_PARAMETERS)
#undef CGAL_BSPLINE_SHELLS_BEGIN_PARAMETERS
#undef CGAL_BSPLINE_SHELLS_PARAMETERS

} // namespace parameters

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_NAMED_PARAMETERS_H
