// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_INSTANCES_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_INSTANCES_H

// By default, the package is header-only. The CMake target Bspline_shell_3::Instances defines
// CGAL_BSPLINE_SHELL_3_INSTANCES, and links a library of the functions that are not templates and of the instances that
// most programs need. Headers then do not include their *_impl.h, and declare these instances at their ends.
#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
#define CGAL_BSPLINE_SHELL_3_INLINE
#else
#define CGAL_BSPLINE_SHELL_3_INLINE inline
#endif

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_INSTANCES_H
