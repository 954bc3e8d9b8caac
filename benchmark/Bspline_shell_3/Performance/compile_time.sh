#!/usr/bin/env bash
# Measures compilation time and peak memory of examples, one at a time, header-only and with the compiled library (which
# is not built). Prints one JSON line for each.
#   bash benchmark/Bspline_shell_3/Performance/compile_time.sh [EXAMPLE ...]
# Environment: CXX is the compiler, CXXFLAGS the optimization (-O2), CGAL_INCLUDE a folder with the headers of another
# CGAL.
set -euo pipefail
cd "$(dirname "$0")/../../.."
. cmake/install_packages.sh
install_packages "${BUILD_PACKAGES[@]}" time

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
flags=(-std=c++17 ${CXXFLAGS:--O2} -DNDEBUG -frounding-math -DCGAL_USE_GMP -DCGAL_USE_MPFR -DCGAL_EIGEN3_ENABLED -DCGAL_LINKED_WITH_TBB
       -Iinclude -I/usr/include/eigen3)
[ -z "${CGAL_INCLUDE-}" ] || flags+=(-isystem "$CGAL_INCLUDE")

# CGAL without the package: its kernel, its mesh, and reading a file
cat > "$work/cgal_alone.cpp" <<'EOF'
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Surface_mesh.h>
int main(int, char** argv)
{
  CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> mesh;
  return !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh);
}
EOF

compile() {     # SOURCE LIBRARY [OPTION ...]
  local source=$1 library=$2 seconds user kilobytes
  shift 2
  command time -o "$work/time" -f '%e %U %M' "${CXX:-g++}" "${flags[@]}" "$@" -c "$source" -o "$work/object.o"
  read -r seconds user kilobytes < "$work/time"
  printf '{"source":"%s","library":%s,"seconds":%s,"user_seconds":%s,"peak_megabytes":%d,"object_kilobytes":%d}\n' \
    "$(basename "$source")" "$library" "$seconds" "$user" $((kilobytes / 1024)) $(($(stat -c %s "$work/object.o") / 1024))
}

examples=("$@")
[ $# -gt 0 ] || examples=(certified_shell uniform_shell simplify_mesh remesh_mesh transfer_texture_coordinates excised_triangles)
compile "$work/cgal_alone.cpp" false
for name in "${examples[@]}"; do
  compile "examples/Bspline_shell_3/${name%.cpp}.cpp" false
  compile "examples/Bspline_shell_3/${name%.cpp}.cpp" true -DCGAL_BSPLINE_SHELL_3_INSTANCES
done
