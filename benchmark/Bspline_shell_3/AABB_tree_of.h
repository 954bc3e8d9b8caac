// CGAL's AABB trees, whose traits class was renamed in CGAL 6.0.
#ifndef BENCHMARK_AABB_TREE_OF_H
#define BENCHMARK_AABB_TREE_OF_H

#include <CGAL/AABB_tree.h>
#include <CGAL/version_macros.h>
#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif

#if CGAL_VERSION_MAJOR >= 6
template <typename Kernel, typename Primitive>
using AABB_tree_of = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive> >;
#else
template <typename Kernel, typename Primitive>
using AABB_tree_of = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive> >;
#endif

#endif // BENCHMARK_AABB_TREE_OF_H
