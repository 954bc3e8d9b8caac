#!/usr/bin/env bash
# From nothing to the shell of a mesh, with pictures (Debian 12):
#   bash examples/quickstart.sh [MESH] [RESOLUTION]
# Installs what is missing, builds, runs, and says where the results are. MESH is OFF, OBJ, PLY or STL; without it, the
# elephant of the Debian package libcgal-demo is used. RESOLUTION: cells along the longest side of the mesh's box.
# If there is no shell, the exit code is that of build_shell, whose usage explains it.
set -euo pipefail
mesh=${1-} options=()
if [ -n "$mesh" ]; then
  [[ -f $mesh && -r $mesh ]] || { echo "$mesh is not a file that can be read." >&2; exit 2; }
  mesh=$(realpath -- "$mesh")
fi
if [ $# -ge 2 ]; then
  [[ $2 =~ ^[0-9]*\.?[0-9]*$ && $2 =~ [1-9] ]] ||
    { echo "The resolution must be a positive number such as 80, not $2." >&2; exit 2; }
  options=(--resolution "$2")
fi
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

if [ -z "$mesh" ]; then
  mesh=$build/data/meshes/elephant.off
  [ -f "$mesh" ] || {
    echo "There is no $mesh: data.tar.gz of libcgal-demo is missing or broken; see $build/build.log, or give a mesh." >&2
    exit 1
  }
fi
name=$(basename -- "$mesh")
name=${name%.*}
mkdir -p results
rm -f "results/$name"_{inner,outer,mesh}.ply "results/$name.png"
"$build/examples/Bspline_shell_3/build_shell" "$mesh" "${options[@]}" --output "results/$name"
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
