// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Soup/Soup_mesh_3_impl.h>
#include <CGAL/Bspline_shell_3/Soup/repair_soup_impl.h>
#include <CGAL/Bspline_shell_3/Soup/wrap_soup_impl.h>
