#!/usr/bin/env python3
"""Halves and doubles each tuning parameter, and prints the effects.

   tuning_sensitivity.py [--work FOLDER] [--jobs N] [--meshes FOLDER] [WORDS ...]

Tuning parameters are the members of the structs in headers `*_tuning.h`. In a copy of the sources in FOLDER
(build/tuning), they are read from the environment, so that tuning_figures is compiled only once. With WORDS, only
parameters whose names contain one of these words are examined. Instead of being doubled, a fraction above 1/2 is moved
halfway to 1.

Prints a table (Markdown) of the parameters with an effect: processor times of shells, simplification, remeshing and maps,
and numbers of cells and facets, relative to their present values; certified shells; and vertices that the map loses.
Relative differences up to NOISE are omitted. FOLDER stores the measurements in figures.json, so an interrupted run can be
resumed.
"""
import argparse
import concurrent.futures
import hashlib
import json
import math
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(HERE)))
MESHES = ["elephant", "part", "helmet", "triceratops", "joint", "dino", "mpi", "negative", "pinion_small", "spool",
          "3torus"]
NOISE = {"seconds": 0.3, "counts": 0.05}     # relative; equal runs differ by up to 0.25 in time on a busy machine
SWITCH = """#ifndef TUNED_NUMBER_H
#define TUNED_NUMBER_H
#include <cstdlib>
#include <string>
// the environment has the name of one number, and its value
template <typename T>
inline T tuned(const char* name, T value)
{
  static const char* const changed = std::getenv("TUNED_NUMBER");
  return changed && std::string(name) == changed ? T(std::atof(std::getenv("TUNED_VALUE"))) : value;
}
#endif
"""


def run(command, **options):
    if subprocess.run(command, **options).returncode != 0:
        sys.exit("This command failed: " + " ".join(command))


def tuned_numbers(text):
    """Returns names and values of a header's numbers, and the header with numbers read from the environment."""
    struct = re.search(r"struct (\w+_tuning)\b", text).group(1)
    numbers = {}

    def read(declaration):
        def member(match):
            name = f"{struct}.{match.group(1)}"
            numbers[name] = (declaration.group(1), eval(match.group(2)))
            return f'{match.group(1)} = tuned<{declaration.group(1)}>("{name}", {match.group(2)})'
        return re.sub(r"(\w+) = ([^,;]+)", member, declaration.group(0))

    changed = re.sub(r"^  (double|int|std::size_t) \w+ = [^;]*;", read, text, flags=re.MULTILINE)
    return numbers, changed.replace("inline constexpr", "inline const")


def stage(source):
    """Copies the sources; returns all numbers, and a checksum of the sources"""
    numbers, checksum = {}, hashlib.sha256()
    for folder, folders, names in os.walk(ROOT):
        folders[:] = sorted(name for name in folders if not name.startswith(("build", "results", "__pycache__", ".")))
        for path in (os.path.join(folder, name) for name in sorted(names)):
            text = open(path, "rb").read()
            checksum.update(text)
            if path.startswith(os.path.join(ROOT, "include")) and path.endswith("_tuning.h"):
                found, changed_text = tuned_numbers(text.decode())
                numbers.update(found)
                text = changed_text.encode()
            copy = os.path.join(source, os.path.relpath(path, ROOT))
            os.makedirs(os.path.dirname(copy), exist_ok=True)
            if not os.path.exists(copy) or open(copy, "rb").read() != text:
                open(copy, "wb").write(text)
    open(os.path.join(source, "tuned_number.h"), "w", encoding="utf-8").write(SWITCH)
    return numbers, checksum.hexdigest()


def build(source, folder):
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF", "-DBSPLINE_SHELL_3_EXAMPLES=OFF", "-DBSPLINE_SHELL_3_TOOL=OFF",
               "-DBSPLINE_SHELL_3_BENCHMARKS=ON",
               "-DCMAKE_CXX_FLAGS=-include " + os.path.join(source, "tuned_number.h")]
    if shutil.which("ccache"):
        options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
    run(["cmake", "-S", source, "-B", folder, "-G", "Ninja", "-Wno-dev", *options], stdout=subprocess.DEVNULL)
    run(["cmake", "--build", folder, "--target", "tuning_figures"])


def changed(kind, value, factor):
    """Returns half of a number, or twice the number."""
    if factor > 1 and 0.5 < value < 1:
        return (1 + value) / 2
    return value * factor if kind == "double" else math.floor(value * factor + 0.5)


def measure(program, meshes, name=None, value=None):
    environment = dict(os.environ)
    if name:
        environment.update(TUNED_NUMBER=name, TUNED_VALUE=repr(float(value)))
    figures = {}
    for mesh in meshes:
        try:
            done = subprocess.run([program, mesh], env=environment, capture_output=True, text=True, timeout=600)
            lines = done.stdout.splitlines() if done.returncode == 0 else []
        except subprocess.TimeoutExpired:
            lines = []
        figures[os.path.basename(mesh)] = json.loads(lines[0]) if lines else {"certified": False}
    return figures


def compare(before, after):
    """Returns the differences: ratios of sums over the meshes that are certified in both, and counts."""
    differences = []
    both = [m for m in before if before[m]["certified"] and after[m]["certified"]]
    for key, text in (("shell_seconds", "time of shells"), ("cells", "cells"), ("simplify_seconds", "time of simplification"),
                      ("simplified", "simplified facets"), ("remesh_seconds", "time of remeshing"), ("remeshed", "remeshed facets"),
                      ("map_seconds", "time of maps")):
        old, new = (sum(figures[m].get(key, 0) for m in both) for figures in (before, after))
        ratio = new / old if old > 0 else 1
        if abs(ratio - 1) > NOISE["seconds" if key.endswith("seconds") else "counts"]:
            differences.append(f"{text} × {ratio:.2f}")
    for key, text in (("certified", "certified"), ("lost", "lost vertices")):
        old, new = (sum(figures[m].get(key, 0) for m in before) for figures in (before, after))
        if old != new:
            differences.append(f"{text} {old} → {new}")
    return differences


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", default=os.path.join(ROOT, "build", "tuning"), help="working folder (default: build/tuning)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="number of processes (default: all processors)")
    parser.add_argument("--meshes", help="folder of the meshes (default: those of libcgal-demo)")
    parser.add_argument("words", nargs="*", metavar="WORDS", help="examine only numbers whose names contain one of these words")
    arguments = parser.parse_args()
    source, folder = os.path.join(arguments.work, "source"), os.path.join(arguments.work, "build")
    numbers, checksum = stage(source)
    build(source, folder)
    program = os.path.join(folder, "benchmark", "Bspline_shell_3", "Tuning", "tuning_figures")
    meshes = [os.path.join(arguments.meshes or os.path.join(folder, "data", "meshes"), name + ".off") for name in MESHES]
    path = os.path.join(arguments.work, "figures.json")
    key = [checksum, meshes]
    known = json.load(open(path)) if os.path.exists(path) else {}
    if known.get("key") != key:
        known = {"key": key}
    jobs = {"": (None, None)}
    for name, (kind, value) in numbers.items():
        if not arguments.words or any(word in name for word in arguments.words):
            jobs.update({f"{name} {factor}": (name, changed(kind, value, factor)) for factor in (0.5, 2)})
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        tasks = {pool.submit(measure, program, meshes, *job): key for key, job in jobs.items() if key not in known}
        for task in concurrent.futures.as_completed(tasks):
            known[tasks[task]] = task.result()
            json.dump(known, open(path + ".new", "w"))
            os.replace(path + ".new", path)
    print("| number | value | half | twice |\n|---|---|---|---|")
    same = []
    for name, (kind, value) in numbers.items():
        if f"{name} 2" not in jobs:
            continue
        cells = ["; ".join(compare(known[""], known[f"{name} {factor}"])) or "–" for factor in (0.5, 2)]
        if cells == ["–", "–"]:
            same.append(name)
        else:
            print(f"| `{name}` | {value:g} | {cells[0]} | {cells[1]} |")
    print("\nNumbers without an effect on these meshes: " + ", ".join(f"`{name}`" for name in same))


if __name__ == "__main__":
    main()
