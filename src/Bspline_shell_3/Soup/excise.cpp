// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3_impl.h>
#include <CGAL/Bspline_shell_3/Soup/check_excision_impl.h>
#include <CGAL/Bspline_shell_3/Soup/choose_excision_impl.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excised_simplices_impl.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excision_growth_impl.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excision_holes_impl.h>
#include <CGAL/Bspline_shell_3/Soup/internal/facets_to_excise_impl.h>
#include <CGAL/Bspline_shell_3/Soup/provenance_impl.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised_impl.h>
