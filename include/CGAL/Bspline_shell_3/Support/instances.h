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
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/properties.h>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The mesh of instances for a mesh type.
typedef Exact_predicates_inexact_constructions_kernel Instance_kernel;
typedef Surface_mesh<Instance_kernel::Point_3> Instance_mesh;
typedef boost::property_map<Instance_mesh, vertex_point_t>::type Instance_points;

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#define CGAL_BSPLINE_SHELL_3_INLINE
#else
#define CGAL_BSPLINE_SHELL_3_INLINE inline
#endif

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_INSTANCES_H
