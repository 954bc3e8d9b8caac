#!/usr/bin/env bash
# Starts the Polyhedron demo of CGAL 5.5 with a plugin for shells (Debian 12):
#   bash examples/polyhedron_demo.sh [--build] [MESH|SCRIPT...]
# Installs missing packages, and builds the demo from the sources in the Debian package libcgal-demo. Other plugins of the
# demo are built only if they read or write OFF or PLY files, or repair what our plugin rejects. Then the script opens the
# meshes, and runs the demo's scripts (.js). --build: only builds.
set -euo pipefail
mode=
if [ "${1-}" = --build ]; then mode=$1; shift; fi
files=()
for file in "$@"; do
  [[ -f $file && -r $file ]] || { echo "$file cannot be read: check its path and permissions." >&2; exit 2; }
  files+=("$(realpath -- "$file")")
done
cd "$(dirname "$0")/.."
. cmake/install_packages.sh
install_packages "${BUILD_PACKAGES[@]}" libcgal-qt5-dev qtscript5-dev libgl1-mesa-dri

build=$PWD/build/polyhedron_demo demo=$PWD/build/polyhedron_demo/sources/demo/Polyhedron
sources=/usr/share/doc/libcgal-dev/demo.tar.gz
[ -f "$sources" ] || { echo "$sources is missing: install libcgal-demo with its documentation." >&2; exit 1; }
mkdir -p "$build"
if [ ! -d "$build/sources" ]; then
  # After an interruption, the folder exists completely or not at all.
  rm -rf "$build/sources.part"
  mkdir "$build/sources.part"
  tar -xzf "$sources" -C "$build/sources.part" demo/Polyhedron
  mv "$build/sources.part" "$build/sources"
fi
ln -sfn "$PWD/examples/polyhedron_demo" "$demo/Plugins/Bspline_shell_3"

plugins=(bspline_shell_plugin off_plugin ply_plugin orient_soup_plugin triangulate_facets_plugin)
options=(-G Ninja -Wno-dev -DCMAKE_BUILD_TYPE=Release)
command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
echo "Building (about ten minutes the first time) ..."
{ cmake -S . -B "$build/library" "${options[@]}" -DBUILD_TESTING=OFF -DBSPLINE_SHELL_3_EXAMPLES=OFF -DBSPLINE_SHELL_3_TOOL=OFF &&
  cmake --build "$build/library" && cmake --install "$build/library" --prefix "$build/installed" &&
  cmake -S "$demo" -B "$build/demo" "${options[@]}" -DCMAKE_PREFIX_PATH="$build/installed" &&
  cmake --build "$build/demo" --target Polyhedron_3 "${plugins[@]}"; } >"$build/build.log" 2>&1 ||
  { tail -n 30 "$build/build.log"; echo "The build failed: see $build/build.log."; exit 1; }
[ -z "$mode" ] || exit 0

[ -n "${DISPLAY-}${WAYLAND_DISPLAY-}" ] || {
  echo "$build/demo/Polyhedron_3 was built, but there is no display: start it on a desktop, or with ssh -X." >&2
  exit 1
}
[ ${#files[@]} -gt 0 ] || echo "Open a mesh (File > Load), select it in the list, and choose Operations > Cubic B-Spline Shell."
exec "$build/demo/Polyhedron_3" "${files[@]}"
