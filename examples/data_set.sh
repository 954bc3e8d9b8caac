#!/usr/bin/env bash
# Simplifies each mesh of a data set in its shell with the program bspline_shell, and draws a picture; then writes a
# table and web pages (Debian 12):
#   bash examples/data_set.sh FOLDER|LIST [OPTION=VALUE...] [SNAKEMAKE OPTION...]
# Installs missing packages, builds the program, processes the meshes on all processors, and prints the path of the
# result: results/data_set/index.html. Meshes are PLY, OBJ, OFF, STL, or glTF files; LIST is a file with one mesh per line.
# OPTION: results (a folder), facets, time_limit (seconds), memory_limit (megabytes), pictures, keep, batch; see
# examples/Bspline_shell_3/data_set/data_set.py.
# Complete results are not computed again, so an interrupted run can be resumed. If a mesh has no result, the reason is
# recorded, other meshes are not affected, and the exit code is still 0.
# For a cluster: --profile slurm. To use fewer processors: --cores N.
set -euo pipefail
[ $# -ge 1 ] && [ -r "$1" ] || { echo "Usage: bash examples/data_set.sh FOLDER|LIST [OPTION=VALUE...] [SNAKEMAKE OPTION...]" >&2; exit 2; }
meshes=$(realpath -- "$1") from=$PWD
shift
cd "$(dirname "$0")/.."
here=examples/Bspline_shell_3/data_set build=build/data_set results=results/data_set
config=(batch=20) options=() cores=(--cores all)
while [ $# -gt 0 ]; do
  case $1 in
    --profile)
      # Starting a cluster job takes longer than starting a local one.
      cores=() config=(batch=100 "${config[@]:1}")
      options+=(--profile "$([ -d "$here/${2-}" ] && realpath "$here/$2" || echo "${2-}")")
      shift 2 ;;
    -c* | -j* | --cores* | --jobs*) cores=(); options+=("$1"); shift ;;
    -*) options+=("$1"); shift ;;
    results=*) results=$(cd "$from" && realpath -m -- "${1#results=}"); shift ;;
    [a-z]*=*) config+=("$1"); shift ;;
    *) options+=("$1"); shift ;;
  esac
done
. cmake/install_packages.sh
install_packages "${BUILD_PACKAGES[@]}" python3 python3-matplotlib python3-pil python3-vtk9 snakemake xvfb

launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
echo "Building (about five minutes the first time) ..."
mkdir -p "$build"
{ cmake -S . -B "$build" -G Ninja -Wno-dev "${launcher[@]}" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF &&
  cmake --build "$build" --target bspline_shell; } >"$build/build.log" 2>&1 ||
  { tail -n 30 "$build/build.log"; echo "The build failed: see $build/build.log."; exit 1; }

snakemake --snakefile "$here/Snakefile" --scheduler greedy --rerun-incomplete --keep-going "${cores[@]}" "${options[@]}" \
          --directory "$results" --config meshes="$meshes" "${config[@]}" || {
  echo "Some results are missing. Complete results are kept: run the command again to continue." >&2
  exit 1
}
echo "$results/index.html"
