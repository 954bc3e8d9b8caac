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

// All named parameters. The tags of those of this package are in `parameter_tags`; others have tags of CGAL's.
// clang-format off
#define CGAL_BSPLINE_SHELLS_PARAMETERS(OWN, ADD)                                                                       \
  OWN(resolution)                                                                                                      \
  OWN(relative_thickness)                                                                                              \
  OWN(thickness)                                                                                                       \
  OWN(sizing)                                                                                                          \
  OWN(constant_thresholds)                                                                                             \
  OWN(number_of_rings)                                                                                                 \
  OWN(dense_grid)                                                                                                      \
  OWN(energy_weights)                                                                                                  \
  OWN(spd_solver)                                                                                                      \
  OWN(signed_distance_oracle)                                                                                          \
  OWN(memory_limit)                                                                                                    \
  OWN(effort_limit)                                                                                                    \
  OWN(allow_singular_vertices)                                                                                         \
  OWN(virtual_closing)                                                                                                 \
  OWN(closing)                                                                                                         \
  OWN(hole_requires_cap)                                                                                               \
  OWN(truncate)                                                                                                        \
  OWN(least_cone_margin)                                                                                               \
  OWN(alpha)                                                                                                           \
  OWN(offset)                                                                                                          \
  OWN(weld_tolerance)                                                                                                  \
  OWN(largest_excised_share)                                                                                           \
  OWN(allow_open_shell)                                                                                                \
  OWN(skip_open_components)                                                                                            \
  OWN(tolerance)                                                                                                       \
  OWN(interpolation)                                                                                                   \
  OWN(mapping)                                                                                                         \
  OWN(symmetry)                                                                                                        \
  OWN(linear_reconstruction)                                                                                           \
  OWN(samples_per_facet)                                                                                               \
  OWN(default_value)                                                                                                   \
  OWN(stop)                                                                                                            \
  OWN(locate_vertices)                                                                                                 \
  OWN(freeze_rejected_facets)                                                                                          \
  OWN(border_tolerance)                                                                                                \
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
// clang-format on

namespace parameter_tags {
#define CGAL_BSPLINE_SHELLS_TAG(NAME) enum NAME##_t{ NAME };
#define CGAL_BSPLINE_SHELLS_NO_TAG(TAG, NAME)
CGAL_BSPLINE_SHELLS_PARAMETERS(CGAL_BSPLINE_SHELLS_TAG, CGAL_BSPLINE_SHELLS_NO_TAG)
#undef CGAL_BSPLINE_SHELLS_TAG
#undef CGAL_BSPLINE_SHELLS_NO_TAG
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

#define CGAL_BSPLINE_SHELLS_ADD(TAG, NAME)                                                                             \
  template <typename K>                                                                                                \
  Named_parameters<K, TAG, Pack> NAME(const K& k) const                                                                \
  {                                                                                                                    \
    return Named_parameters<K, TAG, Pack>(k, static_cast<const Pack&>(*this));                                         \
  }
#define CGAL_BSPLINE_SHELLS_ADD_OWN(NAME) CGAL_BSPLINE_SHELLS_ADD(parameter_tags::NAME##_t, NAME)
  CGAL_BSPLINE_SHELLS_PARAMETERS(CGAL_BSPLINE_SHELLS_ADD_OWN, CGAL_BSPLINE_SHELLS_ADD)
#undef CGAL_BSPLINE_SHELLS_ADD_OWN
#undef CGAL_BSPLINE_SHELLS_ADD
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

/// Continues a sequence that began in `CGAL::parameters`, such as
/// `with(CGAL::parameters::vertex_point_map(vpm)).resolution(60)`.
template <typename T, typename Tag, typename Base>
Named_parameters<T, Tag, Base> with(const CGAL::Named_function_parameters<T, Tag, Base>& np)
{
  return Named_parameters<T, Tag, Base>(np);
}

#define CGAL_BSPLINE_SHELLS_BEGIN(TAG, NAME)                                                                           \
  template <typename K>                                                                                                \
  Named_parameters<K, TAG> NAME(const K& k)                                                                            \
  {                                                                                                                    \
    return Named_parameters<K, TAG>(k);                                                                                \
  }
#define CGAL_BSPLINE_SHELLS_BEGIN_OWN(NAME) CGAL_BSPLINE_SHELLS_BEGIN(parameter_tags::NAME##_t, NAME)
CGAL_BSPLINE_SHELLS_PARAMETERS(CGAL_BSPLINE_SHELLS_BEGIN_OWN, CGAL_BSPLINE_SHELLS_BEGIN)
#undef CGAL_BSPLINE_SHELLS_BEGIN_OWN
#undef CGAL_BSPLINE_SHELLS_BEGIN
#undef CGAL_BSPLINE_SHELLS_PARAMETERS

} // namespace parameters

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_NAMED_PARAMETERS_H
