#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds all tests, examples and benchmarks, and runs the tests.
set -euo pipefail
cd "$(dirname "$0")/.."
. cmake/install_packages.sh
install_packages "${BUILD_PACKAGES[@]}" catch2 libsuitesparse-dev python3-vtk9 xvfb xauth

build=${BUILD_DIR:-build/test}
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake -S . -B "$build" -G Ninja -Wno-dev "${launcher[@]}" \
      -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=ON -DBSPLINE_SHELL_3_EXAMPLES=ON -DBSPLINE_SHELL_3_BENCHMARKS=ON
cmake --build "$build" --parallel "$(nproc)"
ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)"
