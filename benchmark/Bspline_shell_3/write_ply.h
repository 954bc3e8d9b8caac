// Meshes and surfaces of shells as binary PLY files.
#ifndef WRITE_PLY_H
#define WRITE_PLY_H

#include <CGAL/Bspline_shell_3/IO/write_file.h>
#include <CGAL/Bspline_shell_3/Surface/extract_shell_surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/io.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>
#include <CGAL/tags.h>

#include <ostream>
#include <string>

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

// Returns whether the file is complete.
inline bool write_mesh(const std::string& file, const Mesh& mesh)
{
  return BS::write_file(file, [&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    return CGAL::IO::write_PLY(out, mesh);
  });
}

// Writes one of the two bounding surfaces, and returns whether it was found and the file is complete.
template <typename Shell>
bool write_surface(const std::string& file, const Shell& shell, const typename Shell::Threshold& threshold)
{
  Mesh surface;
  return BS::extract_shell_surface<CGAL::Parallel_if_available_tag>(shell, threshold, surface)
           == BS::Level_set_status::SUCCESS
         && write_mesh(file, surface);
}

#endif // WRITE_PLY_H
