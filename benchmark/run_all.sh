#!/usr/bin/env bash
# Measures a fixed set of shells, edits and maps in less than ten minutes, and compares the results with the figures in
# benchmark/Bspline_shell_3/Regressions (Debian 12):
#   bash benchmark/run_all.sh [--update]
# Installs missing packages, and builds. Seconds are compared as multiples of those of a reference computation in the
# same run, so machines with the same number of processors are comparable. Numbers of cells and facets are compared
# directly. No other program should run meanwhile.
# The exit code is 1 if a figure is worse by more than noise, or if a fixed figure has changed; --update stores the new
# figures instead. It does not include the program bspline_shell, whose results Quality/tool_benchmark.py compares with
# known functions.
set -euo pipefail
cd "$(dirname "$0")/.."
. cmake/install_packages.sh
install_packages "${BUILD_PACKAGES[@]}" python3

build=build/benchmark programs=(reference_computation certify_meshes simplify_benchmark remesh_benchmark projection_benchmark)
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
echo "Building (about five minutes the first time) ..."
mkdir -p "$build"
{ cmake -S . -B "$build" -G Ninja -Wno-dev "${launcher[@]}" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DBSPLINE_SHELL_3_BENCHMARKS=ON &&
  cmake --build "$build" --target "${programs[@]}"; } >"$build/build.log" 2>&1 ||
  { tail -n 30 "$build/build.log"; echo "The build failed: see $build/build.log."; exit 2; }
PYTHONDONTWRITEBYTECODE=1 python3 benchmark/Bspline_shell_3/Regressions/compare_figures.py "$build" "$@"
