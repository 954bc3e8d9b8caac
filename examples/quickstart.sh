#!/usr/bin/env bash
# Simplifies a mesh in its shell, transfers its attributes, and draws a picture (Debian 12):
#   bash examples/quickstart.sh [MESH] [FACETS]
# Installs missing packages, builds, runs, and lists the results. MESH is OFF, OBJ, PLY or STL; it may be open, or not a
# surface. By default, it is the elephant of the Debian package libcgal-demo. FACETS is the target number; by default,
# as few as the shell allows.
# The exit code is that of simplify_and_transfer; see its usage. If a run fails, results of an earlier run are kept.
set -euo pipefail
mesh=${1-} options=()
if [ -n "$mesh" ]; then
  [[ -f $mesh && -r $mesh ]] || { echo "$mesh cannot be read: check its path and permissions." >&2; exit 2; }
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
echo "Building (one to two minutes the first time) ..."
mkdir -p "$build"
{ cmake -S . -B "$build" -G Ninja -Wno-dev "${launcher[@]}" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF &&
  cmake --build "$build" --target simplify_and_transfer; } >"$build/build.log" 2>&1 ||
  { tail -n 30 "$build/build.log"; echo "The build failed: see $build/build.log."; exit 1; }

if [ -z "$mesh" ]; then
  mesh=$build/data/meshes/elephant.off
  [ -f "$mesh" ] || {
    echo "$mesh does not exist, as data.tar.gz of libcgal-demo is missing or broken: see $build/build.log, or pass a mesh." >&2
    exit 1
  }
fi
name=$(basename -- "$mesh")
name=${name%.*}
mkdir -p results
begin=$(mktemp) status=0
trap 'rm -f "$begin" "results/$name.new.png"' EXIT
"$build/examples/Bspline_shell_3/simplify_and_transfer" "$mesh" "${options[@]}" --output "results/$name" || status=$?
draw() {      # PREFIX
  xvfb-run -a /usr/bin/python3 examples/Bspline_shell_3/render_shell.py "$1" "results/$name.new.png" \
    2>"$build/render.log" && [ -s "results/$name.new.png" ] && mv "results/$name.new.png" "$1.png"
}
# After exit codes 4 and 7, results are complete except for those named by the program.
if [[ $status != 0 && $status != 4 && $status != 7 ]]; then
  for prefix in "results/$name.failed" "results/$name"; do
    if [ "${prefix}_places.ply" -nt "$begin" ]; then
      echo "${prefix}_places.ply contains the points where the proof fails; ${prefix}_mesh.ply is the mesh."
      if draw "$prefix"; then echo "$prefix.png shows them."; fi
    fi
  done
  exit "$status"
fi
if draw "results/$name"; then
  picture="
  results/$name.png              before, after, and a section: inner surface blue, meshes black and green, outer surface red"
else
  picture="
  (The picture could not be drawn: see $build/render.log.)"
  rm -f "results/$name.png"       # a picture of an earlier run
fi
cat <<END
Results:
  results/${name}.json             report on the repairs, the proxy and the shell
  results/${name}_simplified.json  numbers of facets, and errors of points after the round trip between both meshes
  results/${name}_mesh.ply         the repaired mesh, or a proxy, with a color and a distance at each vertex
  results/${name}_simplified.ply   the simplified mesh, with the transferred attributes
  results/${name}_detail.ply       the same surface, subdivided, with the transferred color at each vertex
  results/${name}_inner.ply        inner bounding surface of the shell
  results/${name}_outer.ply        outer bounding surface$picture
END
exit "$status"
