#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds all tests, examples and benchmarks, and runs the tests.
#   bash test/run.sh [--sanitize]
# --sanitize: unit tests of what counts, addresses and proves, compiled with address and undefined-behavior sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."
. cmake/install_packages.sh
install_packages "${BUILD_PACKAGES[@]}" catch2 libsuitesparse-dev libopenmesh-dev libtet1.5-dev doxygen libjs-mathjax python3 python3-matplotlib python3-pil \
                 python3-vtk9 snakemake xvfb xauth

# Assertions are on. More optimization would take longer to compile than it saves. The compiler is a tenth faster if it collects no garbage below 4 GB.
options=(-DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DBUILD_TESTING=ON
         "-DCMAKE_CXX_FLAGS=--param=ggc-min-expand=1000 --param=ggc-min-heapsize=4000000")
command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
if [ "${1-}" = --sanitize ]; then
  build=${BUILD_DIR:-build/sanitize}
  # -Og compiles hardly longer than -O0, and what it compiles runs three times faster
  options+=(-DCMAKE_CXX_FLAGS_RELEASE=-Og -DBSPLINE_SHELL_3_SANITIZE=ON -DBSPLINE_SHELL_3_EXAMPLES=OFF)
  target=(--target shell_tests)
  # what is allocated once by libraries is no leak of ours
  export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
else
  build=${BUILD_DIR:-build/test}
  options+=(-DBSPLINE_SHELL_3_EXAMPLES=ON -DBSPLINE_SHELL_3_BENCHMARKS=ON)
  target=()
fi
cmake -S . -B "$build" -G Ninja -Wno-dev "${options[@]}"
cmake --build "$build" --parallel "$(nproc)" "${target[@]}"
ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)"
