#!/usr/bin/env bash
# From nothing to a mesh that is simplified in its shell and keeps what the mesh carried, with a picture (Debian 12):
#   bash examples/quickstart.sh [MESH] [FACETS]
# Installs what is missing, builds, runs, and says where the results are. MESH is OFF, OBJ, PLY or STL, also if it is open or no surface
# at all; without it, the elephant of the Debian package libcgal-demo is used. FACETS: how many are to be left; by default, as few as the shell allows.
# If there is no result, the exit code is that of simplify_and_transfer, whose usage explains it.
set -euo pipefail
mesh=${1-} options=()
if [ -n "$mesh" ]; then
  [[ -f $mesh && -r $mesh ]] || { echo "$mesh is not a file that can be read." >&2; exit 2; }
  mesh=$(realpath -- "$mesh")
fi
if [ $# -ge 2 ]; then
  [[ $2 =~ ^0*[1-9][0-9]*$ ]] || { echo "The number of facets must be a positive integer such as 1000, not $2." >&2; exit 2; }
  options=(--facets "$2")
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
  cmake --build "$build" --target simplify_and_transfer; } >"$build/build.log" 2>&1 ||
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
rm -f "results/$name"_{mesh,simplified,detail,inner,outer,places}.ply "results/$name"{,_simplified}.json "results/$name.png"
status=0
"$build/examples/Bspline_shell_3/simplify_and_transfer" "$mesh" "${options[@]}" --output "results/$name" || status=$?
draw() {
  xvfb-run -a /usr/bin/python3 examples/Bspline_shell_3/render_shell.py "results/$name" "results/$name.png" 2>"$build/render.log" &&
    [ -s "results/$name.png" ]
}
if [ "$status" -ne 0 ]; then
  if [ -s "results/${name}_places.ply" ]; then
    echo "results/${name}_places.ply has the places where the proof fails, in results/${name}_mesh.ply."
    if draw; then echo "results/$name.png shows them."; fi
  fi
  exit "$status"
fi
if draw; then
  picture="
  results/$name.png              before and after, and a cut: inner surface blue, meshes black and green, outer surface red"
else
  picture="
  (no picture: see $build/render.log)"
fi
cat <<END
Results:
  results/${name}.json             what was done with the file, and why
  results/${name}_simplified.json  how far it is simplified, and how far points arrive from where they started, there and back
  results/${name}_mesh.ply         the mesh, or a proxy of what is none, with colors and a distance at its vertices
  results/${name}_simplified.ply   the simplified mesh, with what was carried over
  results/${name}_detail.ply       the same surface in small triangles, with the color at every vertex
  results/${name}_inner.ply        inner bounding surface of the shell
  results/${name}_outer.ply        outer bounding surface$picture
END
