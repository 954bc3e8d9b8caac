#!/usr/bin/env bash
# Generates figures like those of the paper on other meshes, and a page: results/gallery/index.html (Debian 12).
#   bash examples/gallery.sh [--again] [FIGURE...]
# FIGURE: shells, gamma, gamma_impact, mu, simplification, geodesics, elasticity, booleans, fields, closest_point,
# self_intersections; default: all.
# Installs missing packages and builds the programs. Complete figures are generated again only with --again, so an
# interrupted run can be resumed.
# If a figure fails, the page shows the reason, the other figures are generated, and the exit code is 1. After wrong
# usage, it is 2.
set -euo pipefail
cd "$(dirname "$0")/.."
. cmake/install_packages.sh
install_packages "${BUILD_PACKAGES[@]}" libtet1.5-dev python3 python3-matplotlib python3-pil python3-vtk9 xvfb xauth

here=examples/Bspline_shell_3/gallery build=build/gallery page=results/gallery/index.html
export PYTHONDONTWRITEBYTECODE=1
gallery() { /usr/bin/python3 "$here/gallery.py" "$@"; }
mkdir -p results/gallery
exec 9>results/gallery/.lock
flock -n 9 || { echo "Another run is making figures: wait until it has ended." >&2; exit 2; }
pending=$(gallery pending "$@") || exit 2
if [ -n "$pending" ]; then
  mapfile -t figures <<<"$pending"
  mapfile -t programs < <(gallery programs "${figures[@]}")
  launcher=()
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  echo "Building ${programs[*]} (about five minutes the first time) ..."
  mkdir -p "$build"
  # If a program cannot be built, the others are still built.
  { cmake -S "$here" -B "$build" -G Ninja -Wno-dev "${launcher[@]}" -DCMAKE_BUILD_TYPE=Release &&
    cmake --build "$build" --target "${programs[@]}" -- -k 0; } >"$build/build.log" 2>&1 ||
    { tail -n 10 "$build/build.log"; echo "Some programs could not be built: see $build/build.log."; }
else
  figures=()
fi

status=0
for figure in "${figures[@]}"; do
  gallery make "$figure" || status=1
done
gallery page
echo "$page"
exit "$status"
