#!/usr/bin/env python3
"""Runs the benchmarks of run_all.sh five times, and compares the measurements with figures.json.

Usage: compare_figures.py BUILD [--update]

Times are the minimum of five runs, divided by the minimum time of a reference computation, which precedes each run.
They are compared with figures of machines with the same number of processors; other figures are compared with those of
any machine. --update stores the measurements as the figures of this kind of machine: run it on an otherwise idle
machine, and review the changes before they are committed.
"""
import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
FIGURES = HERE / "figures.json"
RUNS = 5
NOISE = 1.3                     # the minima of two runs on the same machine differ by a factor of up to 1.2
MESHES = "elephant", "dino", "homer", "fandisk", "bear", "armadillo", "rotor"
EDITED = "elephant", "knot1", "fandisk", "bear"


def objects(build, program, *arguments):
    """Returns the JSON objects that a program prints, one per line."""
    folder = build / "benchmark/Bspline_shell_3"
    path = next(folder.glob(f"*/{program}"))
    done = subprocess.run([path, *map(str, arguments)], capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def name(found):
    return Path(found["mesh"]).stem


def measure(build):
    """Yields names and values of figures; the names contain the unit."""
    meshes = build / "data/meshes"
    for found in objects(build, "certify_meshes", "--no-proxy", *(meshes / f"{m}.off" for m in MESHES)):
        if found["status"] != "certified":
            sys.exit(f"{found['mesh']} was not certified.")
        yield f"shell of {name(found)}, seconds", found["seconds"]["total"]
        yield f"shell of {name(found)}, cells", found["cells"]
        yield f"shell of {name(found)}, megabytes", found["peak_mb"]
    for found in objects(build, "simplify_benchmark", *(meshes / f"{m}.off" for m in EDITED)):
        yield f"simplification of {name(found)}, seconds", found["in_shell"]["seconds"]["total"]
        yield f"simplification of {name(found)}, facets", found["in_shell"]["facets"]
    for found in objects(build, "remesh_benchmark", *(meshes / f"{m}.off" for m in EDITED)):
        yield f"remeshing of {name(found)}, seconds", found["in_shell"]["seconds"]["total"]
        yield f"remeshing of {name(found)}, facets", found["in_shell"]["facets"]
    for found in objects(build, "projection_benchmark", "--points", 300000):
        if found["tolerance"] == 1e-9:
            yield f"projection to {name(found)}, one core, seconds", found["microseconds"]["one_core"]
            yield f"projection to {name(found)}, all cores, seconds", found["microseconds"]["all_cores"]


def measured(build):
    reference, least = float("inf"), {}
    for run in range(RUNS):
        found, = objects(build, "reference_computation")
        reference = min(reference, found["edge_collapse"] + found["closest_points"])
        print(f"Run {run + 1} of {RUNS}: the reference computation takes {reference:.2f} s.", flush=True)
        for figure, value in measure(build):
            least[figure] = min(value, least.get(figure, value))
    return {figure: round(value / reference, 4) if figure.endswith("seconds") else value for figure, value in least.items()}


def compare(figure, before, now):
    """Returns a comment on a figure, and whether it is worse than before."""
    if before is None:
        return "new", False
    change = now / before if before else float(now != before) + 1
    if figure.endswith("seconds"):
        return ("slower" if change > NOISE else "faster" if change < 1 / NOISE else ""), change > NOISE
    if figure.endswith("megabytes"):
        return ("more" if change > NOISE else "less" if change < 1 / NOISE else ""), change > NOISE
    return ("changed" if now != before else ""), now != before


def main(build, *options):
    if set(options) - {"--update"}:
        sys.exit(__doc__)
    all_figures = json.loads(FIGURES.read_text(encoding="utf-8")) if FIGURES.exists() else {}
    machine = f"{os.cpu_count()} processors"
    now = measured(Path(build).resolve())
    if "--update" in options:
        for figure, value in now.items():
            all_figures.setdefault(machine if figure.endswith("seconds") else "any", {})[figure] = value
        text = json.dumps(all_figures, indent=1, sort_keys=True) + "\n"
        part = Path(f"{FIGURES}.part")
        part.write_text(text, encoding="utf-8")
        part.replace(FIGURES)
        print(f"Stored {len(now)} figures for machines with {machine} in {FIGURES.name}.")
        return 0
    if machine not in all_figures:
        print(f"There are no figures for machines with {machine}, so times are not compared: store them with --update.")
    worse = 0
    for figure, value in now.items():
        before = all_figures.get(machine if figure.endswith("seconds") else "any", {}).get(figure)
        said, is_worse = compare(figure, before, value)
        worse += is_worse
        print(f"{figure:50} {'' if before is None else before:>10} -> {value:<10} {said}")
    print(f"{worse} of {len(now)} figures are worse or have changed. Times are multiples of the time of the reference computation.")
    return 1 if worse else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
