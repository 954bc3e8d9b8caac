#!/usr/bin/env bash
# Simplifies a mesh in its shell, transfers test colors and distances to the result, and draws a picture (Debian 12):
#   bash examples/quickstart.sh [MESH] [FACETS]
# Installs missing packages, builds and runs the program, and lists the results. MESH is an OFF, OBJ, PLY, or STL file;
# it may be open, or a polygon soup, and its attributes are not read. Default: the elephant of the Debian package
# libcgal-demo. FACETS is the target number of facets; default: as few as the shell allows.
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
      echo "${prefix}_places.ply contains the points where the proof fails; the mesh is ${prefix}_mesh.ply."
      if draw "$prefix"; then echo "$prefix.png shows both."; fi
    fi
  done
  exit "$status"
fi
if draw "results/$name"; then
  picture="
  results/$name.png              the mesh before and after, and a cross section of both meshes and the shell"
else
  picture="
  (The picture could not be drawn: see $build/render.log.)"
  rm -f "results/$name.png"       # a picture of an earlier run
fi
cat <<END
Results:
  results/${name}.json             report on the repairs of the file, the shell, and the reason for a proxy
  results/${name}_simplified.json  numbers of facets, and the largest error of a round trip between the meshes
  results/${name}_mesh.ply         the mesh, or a proxy of the polygons, with test colors and distances from a vertex
  results/${name}_simplified.ply   the simplified mesh, with the transferred colors and distances
  results/${name}_detail.ply       the simplified mesh, subdivided to show the transferred color of every point
  results/${name}_inner.ply        the inner surface of the shell
  results/${name}_outer.ply        the outer surface of the shell$picture
END
exit "$status"
