// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_CLOSING_ARGUMENT_H
#define CGAL_BSPLINE_SHELL_3_MESH_CLOSING_ARGUMENT_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>

#include <memory>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the closing that was passed as the named parameter `closing`, by value or as a shared pointer. If there is
// none, or if the pointer is null, returns `other`.
template <typename NamedParameters>
std::shared_ptr<const Shell_closing_3> closing_argument(const NamedParameters& np,
                                                        const std::shared_ptr<const Shell_closing_3>& other)
{
  if constexpr(!CGAL::parameters::is_default_parameter<NamedParameters, parameter_tags::closing_t>::value) {
    const auto& closing = CGAL::parameters::get_parameter_reference(np, parameter_tags::closing);
    if constexpr(std::is_convertible<decltype(closing), std::shared_ptr<const Shell_closing_3> >::value)
      return closing ? std::shared_ptr<const Shell_closing_3>(closing) : other;
    else return std::make_shared<const Shell_closing_3>(closing);
  } else {
    return other;
  }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_CLOSING_ARGUMENT_H
