#!/usr/bin/env bash
# Measures a fixed set of shells, edits and maps, in less than ten minutes, and compares with the figures in benchmark/Bspline_shell_3/Regressions (Debian 12):
#   bash benchmark/run_all.sh [--update]
# Installs what is missing, and builds. Seconds are compared as multiples of those of a reference computation in the same run, so that machines
# with as many processors are alike; numbers of cells and facets are compared as they are. Nothing else should run meanwhile.
# The exit code is 1 if a figure is worse than it was by more than is noise, or has changed though it must not; --update keeps the new ones instead.
set -euo pipefail
cd "$(dirname "$0")/.."
. cmake/install_packages.sh
install_packages "${BUILD_PACKAGES[@]}" python3

build=build/benchmark programs=(reference_computation certify_meshes simplify_benchmark remesh_benchmark projection_benchmark)
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
echo "Building (five minutes, the first time) ..."
mkdir -p "$build"
{ cmake -S . -B "$build" -G Ninja -Wno-dev "${launcher[@]}" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DBSPLINE_SHELL_3_BENCHMARKS=ON &&
  cmake --build "$build" --target "${programs[@]}"; } >"$build/build.log" 2>&1 ||
  { tail -n 30 "$build/build.log"; echo "The build failed; see $build/build.log"; exit 2; }
PYTHONDONTWRITEBYTECODE=1 python3 benchmark/Bspline_shell_3/Regressions/compare_figures.py "$build" "$@"
