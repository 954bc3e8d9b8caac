#!/usr/bin/env bash
# Measures the overhead of the data set workflow: the same meshes are processed alternately by the workflow and by
# `xargs -P`, which keeps no records, times or tables. Prints one JSON line per run, and one with the ratios of
# throughput in wall-clock and processor time. The latter does not depend on other load of the machine.
#   bash benchmark/Bspline_shell_3/Performance/data_set_benchmark.sh MESHES [NUMBER [TURNS [BATCH]]]
# MESHES: a folder with OFF files; files of up to LARGEST bytes (50000) are used, NUMBER (150) meshes: the files and
# random rotations of them. PICTURES=true also draws them. PROCESSES (all) is the number of processes. PROGRAM:
# bspline_shell; by default that of data_set.sh.
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,8s/^# \?//p' "$0" >&2; exit 2; }
meshes=$(realpath -- "$1") number=${2:-150} turns=${3:-2} batch=${4:-20}
cd "$(dirname "$0")/../../.."
root=$PWD
program=$(realpath -- "${PROGRAM:-build/data_set/tool/Bspline_shell_3/bspline_shell}")
[ -x "$program" ] || { echo "$program does not exist: run examples/data_set.sh once to build it." >&2; exit 2; }
processes=${PROCESSES:-$(nproc)} pictures=${PICTURES:-false}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 - "$meshes" "$work/meshes" "$number" "${LARGEST:-50000}" <<'END'
import math, os, random, shutil, sys
from pathlib import Path
sys.dont_write_bytecode = True
sys.path.append("benchmark/Bspline_shell_3/Robustness")
from open_meshes import read
source, target, number, largest = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
target.mkdir()
files = sorted(file for file in source.glob("*.off") if file.stat().st_size <= largest)
random.seed(1)
for n in range(number):
    file = files[n % len(files)]
    copy = target / f"{n // len(files):03}_{file.name}"
    try:
        points, facets = read(file) if n >= len(files) else (None, None)
    except (ValueError, IndexError):
        points = None
    if not points:
        shutil.copy(file, copy)
        continue
    a, b, c, d = (random.gauss(0, 1) for _ in range(4))
    s = math.sqrt(a*a + b*b + c*c + d*d)
    a, b, c, d = a / s, b / s, c / s, d / s
    rows = ((a*a + b*b - c*c - d*d, 2*(b*c - a*d), 2*(b*d + a*c)), (2*(b*c + a*d), a*a - b*b + c*c - d*d, 2*(c*d - a*b)),
            (2*(b*d - a*c), 2*(c*d + a*b), a*a - b*b - c*c + d*d))
    with open(copy, "w", encoding="ascii") as out:
        out.write(f"OFF\n{len(points)} {len(facets)} 0\n")
        out.writelines("%r %r %r\n" % tuple(sum(x * y for x, y in zip(row, p)) for row in rows) for p in points)
        out.writelines("3 %d %d %d\n" % f for f in facets)
END

by_xargs() {
  mkdir -p "$work/xargs"
  find "$work/meshes" -name '*.off' -print0 | sort -z | xargs -0 -P "$processes" -I{} sh -c '
    prefix=$1/$(basename "$2" .off)
    timeout 300 "$3" simplify "$2" -o "${prefix}_simplified.ply" --shell "$prefix" --json --threads 1 --time-limit 150 \
      --memory-limit 2667 >"$prefix.log" 2>&1
    [ "$4" = false ] || [ ! -f "${prefix}_mesh.ply" ] ||
      LP_NUM_THREADS=1 xvfb-run -a /usr/bin/python3 examples/Bspline_shell_3/render_shell.py "$prefix" "$prefix.png" >>"$prefix.log" 2>&1' - "$work/xargs" {} "$program" "$pictures" || true       # some meshes are refused
}
by_workflow() {
  snakemake --snakefile "$root/examples/Bspline_shell_3/data_set/Snakefile" --directory "$work/workflow" --cores "$processes" --scheduler greedy \
            --config meshes="$work/meshes" program="$program" pictures="$pictures" batch="$batch" >"$work/log" 2>&1 || { tail "$work/log" >&2; exit 1; }
}
run() {
  rm -rf "${work:?}/$1"
  local wall user system TIMEFORMAT="%R %U %S"
  read -r wall user system < <({ time "by_$1"; } 2>&1)
  printf '{"by":"%s","meshes":%d,"processes":%d,"batch":%d,"pictures":%s,"seconds":%s,"cpu_seconds":%s}\n' \
    "$1" "$number" "$processes" "$batch" "$pictures" "$wall" "$(python3 -c "print(round($user + $system, 2))")" | tee -a "$work/runs"
}
for turn in $(seq "$turns"); do
  if ((turn % 2)); then run xargs; run workflow; else run workflow; run xargs; fi
done
python3 - "$work/runs" "$work/workflow/table.csv" <<'END'
import csv, json, os, sys
runs = [json.loads(line) for line in open(sys.argv[1], encoding="utf-8")]
sums = {(by, key): sum(r[key] for r in runs if r["by"] == by) for by in ("xargs", "workflow") for key in ("seconds", "cpu_seconds")}
ratio = {key: round(sums["xargs", key] / sums["workflow", key], 3) for key in ("seconds", "cpu_seconds")}
done = None
if os.path.exists(sys.argv[2]):
    with open(sys.argv[2], encoding="utf-8", newline="") as table:
        done = sum(r["outcome"] == "done" for r in csv.DictReader(table))
print(json.dumps({"throughput_of_workflow_to_xargs": ratio, "done": done}))
END
