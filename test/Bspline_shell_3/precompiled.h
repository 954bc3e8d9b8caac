// Headers that nearly every test includes.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/bspline_shell_3.h>

#include <catch2/catch.hpp>
