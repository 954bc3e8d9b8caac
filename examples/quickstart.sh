#!/usr/bin/env bash
# From nothing to the shell of a mesh, with pictures (Debian 12):
#   bash examples/quickstart.sh [MESH] [RESOLUTION]
# Installs what is missing, builds, runs, and says where the results are. MESH is OFF, OBJ, PLY or STL; without it, the
# elephant of the Debian package libcgal-demo is used.
set -euo pipefail
mesh=${1:+$(realpath -- "$1")}
resolution=${2:-80}
cd "$(dirname "$0")/.."
. cmake/install_packages.sh
install_packages "${BUILD_PACKAGES[@]}" python3 python3-vtk9 xvfb xauth

build=build/quickstart
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
echo "Building (a minute or two, the first time) ..."
mkdir -p "$build"
{ cmake -S . -B "$build" -G Ninja -Wno-dev "${launcher[@]}" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF &&
  cmake --build "$build" --target build_shell; } >"$build/build.log" 2>&1 ||
  { tail -n 30 "$build/build.log"; echo "The build failed; see $build/build.log"; exit 1; }

mesh=${mesh:-$build/data/meshes/elephant.off}
name=$(basename "${mesh%.*}")
mkdir -p results
"$build/examples/Bspline_shell_3/build_shell" "$mesh" --resolution "$resolution" --output "results/$name"
rm -f "results/$name.png"
if xvfb-run -a /usr/bin/python3 examples/Bspline_shell_3/render_shell.py "results/$name" "results/$name.png" 2>"$build/render.log" &&
   [ -s "results/$name.png" ]; then
  picture="
  results/$name.png         the mesh coloured by f, and a cut: inner surface blue, mesh grey, outer surface red"
else
  picture="
  (no picture: see $build/render.log)"
fi
cat <<END
Results:
  results/${name}_inner.ply   inner bounding surface, f = eps1
  results/${name}_outer.ply   outer bounding surface, f = eps2
  results/${name}_mesh.ply    the mesh, with f and a colour at its vertices$picture
END
