// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_CGAL_COMPATIBILITY_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_CGAL_COMPATIBILITY_H

// Names and types that CGAL 6.0 changed.

#include <CGAL/version_macros.h>

#include <optional>
#include <string>

#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#include <variant>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <boost/optional.hpp>
#include <boost/variant/get.hpp>
#endif

namespace CGAL {
namespace Bspline_shells {
namespace internal {

#if CGAL_VERSION_MAJOR >= 6
template <typename Kernel, typename Primitive>
using AABB_traits_3 = CGAL::AABB_traits_3<Kernel, Primitive>;
template <typename Kernel, typename Iterator>
using AABB_triangle_primitive_3 = CGAL::AABB_triangle_primitive_3<Kernel, Iterator>;
template <typename T>
using Optional = std::optional<T>; // used by the policies of edge collapses
template <typename T, typename Variant>
const T* get_if(const Variant& variant)
{
  return std::get_if<T>(&variant);
}
#else
template <typename Kernel, typename Primitive>
using AABB_traits_3 = CGAL::AABB_traits<Kernel, Primitive>;
template <typename Kernel, typename Iterator>
using AABB_triangle_primitive_3 = CGAL::AABB_triangle_primitive<Kernel, Iterator>;
template <typename T>
using Optional = boost::optional<T>;
template <typename T, typename Variant>
const T* get_if(const Variant& variant)
{
  return boost::get<T>(&variant);
}
#endif

// Returns a property map of a `Surface_mesh`, if it exists.
template <typename Key, typename Value, typename Mesh>
std::optional<typename Mesh::template Property_map<Key, Value> > find_property_map(const Mesh& mesh,
                                                                                   const std::string& name)
{
  const auto found = mesh.template property_map<Key, Value>(name);
#if CGAL_VERSION_MAJOR >= 6
  return found;
#else
  if(found.second) return found.first;
  return std::nullopt;
#endif
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_CGAL_COMPATIBILITY_H
