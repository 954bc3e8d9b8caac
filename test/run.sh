#!/usr/bin/env bash
# Installs missing packages (Debian 12), builds the tests and the examples, and runs them.
#   bash test/run.sh [--all | --sanitize]
# --all: also slow tests, benchmarks, the manual, and the tests with sanitizers.
# --sanitize: only fast unit tests of indexing, proofs and I/O, with address and undefined-behavior sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=${1-}
. cmake/install_packages.sh
packages=("${BUILD_PACKAGES[@]}" catch2 libsuitesparse-dev libopenmesh-dev python3)
if [ "$mode" = --all ]; then
  packages+=(libtet1.5-dev doxygen libjs-mathjax python3-matplotlib python3-pil python3-vtk9 snakemake xvfb xauth chromium)
fi
install_packages "${packages[@]}"

# Assertions are on. Higher optimization levels would take longer to compile than they save at run time. Compilation is
# 10 % faster without garbage collection below 4 GB.
options=(-G Ninja -Wno-dev -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=ON
         "-DCMAKE_CXX_FLAGS=--param=ggc-min-expand=1000 --param=ggc-min-heapsize=4000000")
command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)

test_project() {
  build=${BUILD_DIR:-build/test} benchmarks=OFF skipped=(--label-exclude slow)
  if [ "$mode" = --all ]; then benchmarks=ON skipped=(); fi
  cmake -S . -B "$build" "${options[@]}" -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DBSPLINE_SHELL_3_EXAMPLES=ON \
        -DBSPLINE_SHELL_3_BENCHMARKS=$benchmarks
  cmake --build "$build" --parallel "$(nproc)"
  ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)" "${skipped[@]}"
}

# -Og compiles nearly as fast as -O0, and its code runs three times faster.
test_with_sanitizers() {
  build=${BUILD_DIR:-build}/sanitize
  cmake -S . -B "$build" "${options[@]}" -DCMAKE_CXX_FLAGS_RELEASE=-Og -DBSPLINE_SHELL_3_SANITIZE=ON
  cmake --build "$build" --parallel "$(nproc)" --target shell_tests
  # Libraries allocate some memory once and never free it.
  ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 \
    ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)" --label-exclude slow
}

if [ "$mode" != --sanitize ]; then test_project; fi
if [ "$mode" = --all ] || [ "$mode" = --sanitize ]; then test_with_sanitizers; fi
