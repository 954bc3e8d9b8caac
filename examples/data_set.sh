#!/usr/bin/env bash
# The shell, the simplified mesh, the round trip and a picture of every mesh of a data set, a table and pages to look at (Debian 12):
#   bash examples/data_set.sh FOLDER|LIST [OPTION=VALUE...] [SNAKEMAKE OPTION...]
# Installs what is missing, builds, runs on all processors, and says where the results are: results/data_set/index.html. Meshes are OFF, OBJ, PLY
# or STL; LIST is a file with one a line. OPTION: results (a folder), facets, time_limit (seconds), memory_limit (megabytes), pictures, keep, batch; see
# examples/Bspline_shell_3/data_set/data_set.py. What is complete is not made again, so that a run that was interrupted can be resumed. A mesh without
# a result is recorded with the reason, and harms no other: the exit code is 0 then, too.
# On a cluster: --profile slurm. On some processors: --cores N.
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
      # a job of a cluster takes longer to start than one here
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
echo "Building (a minute or two, the first time) ..."
mkdir -p "$build"
{ cmake -S . -B "$build" -G Ninja -Wno-dev "${launcher[@]}" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF &&
  cmake --build "$build" --target simplify_and_transfer; } >"$build/build.log" 2>&1 ||
  { tail -n 30 "$build/build.log"; echo "The build failed; see $build/build.log"; exit 1; }

snakemake --snakefile "$here/Snakefile" --scheduler greedy --rerun-incomplete --keep-going "${cores[@]}" "${options[@]}" \
          --directory "$results" --config meshes="$meshes" "${config[@]}" || {
  echo "Not everything was made. What is complete is kept; run it again to go on." >&2
  exit 1
}
echo "$results/index.html"
