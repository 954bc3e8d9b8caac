#!/usr/bin/env bash
# Simplifies a mesh in its shell with the program bspline_shell, transfers test colors to the result, and draws a picture
# (Debian 12):
#   bash examples/quickstart.sh [MESH] [FACETS]
# Installs missing packages, builds the program, and lists the results. MESH is a PLY, OBJ, OFF, STL, or glTF file; it
# may be open, or a polygon soup. Default: the elephant of the Debian package libcgal-demo. FACETS is the target number
# of facets; default: as few as a shell with a thickness of 1 % of the bounding box allows.
# The exit code is that of bspline_shell; see its help. If a run fails, results of an earlier run are kept.
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
echo "Building (about five minutes the first time) ..."
mkdir -p "$build"
{ cmake -S . -B "$build" -G Ninja -Wno-dev "${launcher[@]}" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF &&
  cmake --build "$build" --target bspline_shell; } >"$build/build.log" 2>&1 ||
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
trap 'rm -f "$begin" "results/${name}_new.png" "results/${name}_subdivided.ply"' EXIT
tool=$build/tool/Bspline_shell_3/bspline_shell prefix=results/$name
"$tool" simplify "$mesh" "${options[@]}" -o "${prefix}_simplified.ply" --shell "$prefix" --view "$prefix.html" || status=$?
draw() {      # PREFIX
  xvfb-run -a /usr/bin/python3 examples/Bspline_shell_3/render_shell.py "$1" "${prefix}_new.png" 2>"$build/render.log" &&
    [ -s "${prefix}_new.png" ] && mv "${prefix}_new.png" "$1.png"
}
if [ "$status" != 0 ]; then
  if [ "${prefix}_failed_places.ply" -nt "$begin" ] && draw "${prefix}_failed"; then
    echo "${prefix}_failed.png shows these places on the mesh."
  fi
  exit "$status"
fi
rm -f "${prefix}"{.png,_failed.png,_painted.ply,_detail.ply}      # files of an earlier run
/usr/bin/python3 examples/Bspline_shell_3/paint_meshes.py "$prefix" &&
  "$tool" transfer "${prefix}"{_painted.ply,_subdivided.ply} -o "${prefix}_detail.ply" || true
echo
if draw "$prefix"; then
  echo "$prefix.png shows the mesh before and after, and a cross section of both meshes and the shell."
else
  echo "The picture could not be drawn: see $build/render.log."
fi
cat <<END
Results:
  $prefix.html             a page to turn both meshes and the shell, and to see the map between them
  ${prefix}_simplified.ply   the simplified mesh, with everything that the file has attached to the mesh
  ${prefix}.shell            the shell
  ${prefix}.json             report on the file, its repairs, and the shell
  ${prefix}_mesh.ply         the mesh of the shell, or a proxy of the polygons
  ${prefix}_{inner,outer}.ply        the surfaces that bound the shell
  ${prefix}_{painted,detail}.ply     the mesh with test colors, and the simplified mesh with the transferred colors
Your other files: $tool --help
END
