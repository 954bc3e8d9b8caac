// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_SOUP_PROXY_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_SOUP_PROXY_3_IMPL_H

#include <CGAL/Bspline_shell_3/Soup/Soup_proxy_3.h>

#include <CGAL/assertions.h>

namespace CGAL {
namespace Bspline_shells {

CGAL_BSPLINE_SHELL_3_INLINE
Soup_proxy_3::Map Soup_proxy_3::map() const
{
  CGAL_precondition(bool(m_shell));
  return map(m_mesh);
}

CGAL_BSPLINE_SHELL_3_INLINE
Soup_proxy_3::Map Soup_proxy_3::map(const Mesh& mesh) const
{
  return Map(m_shell, m_soup.mesh(), mesh);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_SOUP_PROXY_3_IMPL_H
