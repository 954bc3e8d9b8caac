// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_SORT_UNIQUE_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_SORT_UNIQUE_H

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Support
/// sorts the values, and removes duplicates
template <typename T>
void sort_unique(std::vector<T>& values)
{
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_SORT_UNIQUE_H
