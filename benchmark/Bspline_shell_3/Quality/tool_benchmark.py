#!/usr/bin/env python3
"""Runs the program bspline_shell on files with attributes that are known functions, and compares the results with them.

   tool_benchmark.py BSPLINE_SHELL MESHES [--hausdorff PROGRAM] [--only NAME] [--output FILE.json]

MESHES is the folder of CGAL's meshes. PROGRAM is the benchmark hausdorff_distance (default: that of the build to which
BSPLINE_SHELL belongs). Each file is simplified within a tolerance, to a quarter of its triangles, and, if it has labels
or a texture, with --cut-seams; it is remeshed; and its attributes are transferred to the remeshed mesh.

Columns of the table:
  facets      of the result
  distance    printed by the program, in % of the box side
  median, max errors of the attribute with the largest ones, in % of its range. The known function is evaluated at the
              position of the value in the result. A point with the right value may have moved by about the distance,
              which changes the function by at most as many % of the range.
  label       share of the area, in %, that has the label of another region. Borders may move by about the distance.
  across      facets across a seam of the texture, as the program counts them; and facets that lie in another region
              than their own by more than the thickness of the shell
  kept        points at the position of a point of the file
  changed     points within 1e-9 box sides of a point of the file that differ from it in a bit, except with --cut-seams,
              which computes the points of images of seams; kept points with another value; for `transfer`, points that
              differ from those of the given mesh
  true        CGAL's bounded-error Hausdorff distance, in % of the box side, up to 0.05; unknown after 60 seconds
  time        processor time, divided by that for the same file without attributes (median of three runs each; not
              if a run takes more than ten seconds)

The exit code is 1 if a distance exceeds the tolerance or the printed bound, a seam is crossed with --cut-seams, or a
point or value changed that did not move. Real attributes of points are linear functions, which are exact in the file:
an error comes from the map, from the 8 bits of a color (0.2 %), or from single precision. Those of polygons are constant
on each polygon of the file, so that errors are up to the size of a polygon.
"""
import argparse
import concurrent.futures
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile

import known_models as known

TOLERANCE = 1           # % of the box side, for simplification
EDGE = 3                # % of the box side, for remeshing
HAUSDORFF_ERROR = 0.05  # % of the box side, much less than the tolerance
SAME = 1e-9             # box sides; no edit moves a point by so little
RUNS = 3                # number of runs, whose median is the time
SLOW = 10               # seconds; longer runs are not repeated
LIMIT = 60              # seconds; a command takes a few
LATTICE = [(i + 1 / 3, j + 1 / 3, 4 - i - j - 2 / 3) for i in range(4) for j in range(4 - i)]  # sums are 4


def run(program, *arguments):
    """Returns the report, or the error, and the processor time."""
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen([program, *arguments, "--json", "--time-limit", str(LIMIT)], stdout=output, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read().decode()
    report = json.loads(text) if text else {"error": "no report"}
    report["exit_code"] = process.returncode
    return report, usage.ru_utime + usage.ru_stime


def points_in(points, polygon):
    corners = [points[v] for v in polygon]
    for i in range(2, len(corners)):
        for w in LATTICE:
            yield [sum(x * p[a] for x, p in zip(w, (corners[0], corners[i - 1], corners[i]))) / 4 for a in range(3)]


def area(points, polygon):
    sum = 0
    for i in range(2, len(polygon)):
        u, v = ([points[polygon[k]][a] - points[polygon[0]][a] for a in range(3)] for k in (i - 1, i))
        sum += math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2
    return sum


def distance_in_range(name, found, expected):
    if not isinstance(found, (tuple, list)):
        found, expected = [found], [expected]
    return 100 * max(abs(x - y) for x, y in zip(found, expected)) / known.RANGES[name]


def errors_of(model, content):
    """Returns for each attribute its errors in % of the range."""
    errors = {}
    for name, values in content.of_points.items():
        errors[name] = [distance_in_range(name, x, model.value(name, p)) for x, p in zip(values, content.points)]
    for name, values in content.of_polygons.items():
        errors[name] = [distance_in_range(name, x, model.value(name, known.centroid_of(content.points, polygon)))
                        for x, polygon in zip(values, content.polygons)]
    if content.texture:
        errors["texture"] = [distance_in_range("texture", uv, model.texture(content.points[v], int(corners[0][0])))
                             for corners, polygon in zip(content.texture, content.polygons) for v, uv in zip(polygon, corners)]
    return errors


def compare_regions(model, content, allowed):
    """Returns the share of the area with a wrong label, in %, and the number of facets that lie in another region by
    more than an allowed distance."""
    label_of = {"group": known.group, "material": known.material, "region": lambda k: k}
    every = range(len(model.scores(model.points[0])))
    properties = [(label_of[name], values) for name, values in content.labels.items()]
    if content.texture:
        properties.append((lambda k: k, [int(sum(u for u, _ in corners) / len(corners)) for corners in content.texture]))
    worst, crossing = 0, set()
    for label, values in properties:
        total = wrong = 0
        for n, (value, polygon) in enumerate(zip(values, content.polygons)):
            own = [k for k in every if label(k) == value]
            if not own:
                sys.exit(f"{model.name}: the label {value} is new.")
            points = list(points_in(content.points, polygon))
            depths = [model.depth(p, own) for p in points]
            size = area(content.points, polygon)
            total += size
            wrong += size * sum(depth > 0 for depth in depths) / len(depths)
            if max(depths) > allowed:
                crossing.add(n)
        worst = max(worst, 100 * wrong / total)
    return worst, len(crossing)


def compare_points(model, before, after, has_images):
    """Returns the numbers of points that are kept, and of those that changed without moving.

    has_images: whether new points may be images of points of the file, and hence almost equal to them"""
    index = {p: n for n, p in enumerate(before.points)}
    cell = 4 * SAME * model.side
    grid = {}
    for p in before.points:
        key = [(x - low) / cell for x, low in zip(p, model.low)]
        for i in {math.floor(key[0] - 0.5), math.floor(key[0] + 0.5)}:
            for j in {math.floor(key[1] - 0.5), math.floor(key[1] + 0.5)}:
                for k in {math.floor(key[2] - 0.5), math.floor(key[2] + 0.5)}:
                    grid.setdefault((i, j, k), []).append(p)
    kept = changed = 0
    for n, p in enumerate(after.points):
        if p in index:
            kept += 1
            changed += any(values[n] != before.of_points[name][index[p]] for name, values in after.of_points.items())
        elif not has_images:
            near = grid.get(tuple(math.floor((x - low) / cell) for x, low in zip(p, model.low)), ())
            changed += any(math.dist(p, q) < SAME * model.side for q in near)
    return kept, changed


def write_off(content, name):
    with open(name, "w") as file:
        file.write("OFF\n%d %d 0\n" % (len(content.points), len(content.polygons)))
        file.writelines("%r %r %r\n" % tuple(p) for p in content.points)
        file.writelines("%d %s\n" % (len(polygon), " ".join(map(str, polygon))) for polygon in content.polygons)
    return name


class Measurement:
    def __init__(self, arguments, folder):
        self.program, self.hausdorff, self.folder = arguments.program, arguments.hausdorff, folder
        self.pool = concurrent.futures.ThreadPoolExecutor(os.cpu_count())

    def path(self, name):
        return os.path.join(self.folder, name)

    def measure(self, model):
        source = known.write_model(model, self.folder)
        before = known.read_model(source)
        original = write_off(before, self.path(model.name + ".off"))
        has_lines = model.has_texture or model.scores is not None
        tolerance = f"{TOLERANCE}%"
        commands = {"simplify": ["simplify", source, "--tolerance", tolerance],
                    "quarter": ["simplify", source, "--ratio", "0.25"],
                    "remesh": ["remesh", source, "--edge", f"{EDGE}%"]}
        if has_lines:
            commands["cut"] = ["simplify", source, "--tolerance", tolerance, "--cut-seams"]
        rows, even = {}, None
        for name, command in commands.items():
            row, after = self.edit(model, before, name, command)
            rows[name] = row
            if after is None:
                continue
            if name == "remesh":
                even = after
            result = write_off(after, self.path(f"{model.name}.{name}.off"))
            row["true"] = self.pool.submit(self.true_distance, original, result, HAUSDORFF_ERROR / 100 * model.side)
        if even is not None:
            target = known.Model("even_" + os.path.splitext(model.name)[0], "off", even.points, even.polygons)
            rows["transfer"], _ = self.edit(model, known.Content(even.points, even.polygons), "transfer",
                                            ["transfer", source, known.write_model(target, self.folder)])
        plain = known.write_model(model.stripped("plain_" + os.path.splitext(model.name)[0]), self.folder)
        for name in ("simplify", "remesh"):
            self.compare_time(rows[name], commands[name], plain)
        for row in rows.values():
            self.finish(row)
        return list(rows.values())

    def edit(self, model, before, name, command):
        output = self.path(name + "_" + model.name)
        report, seconds = run(self.program, *command, "-o", output)
        row = {"file": model.name, "command": name, "report": report, "seconds": seconds}
        if report["exit_code"] != 0:
            return row, None
        after = known.read_model(output)
        distance = max(report[key] for key in ("distance", "distance_to_result", "distance_to_input") if key in report)
        row["facets"] = len(after.polygons)
        row["side"] = model.side
        row["distance"] = 100 * distance / model.side
        row["errors"] = {name: {"median": statistics.median(values), "max": max(values)}
                         for name, values in errors_of(model, after).items()}
        if model.scores:
            row["wrong_area"], row["crossing"] = compare_regions(model, after, report["thickness"])
            row["across"] = report["facets_across_seams"]
        if name == "transfer":
            row["kept"] = len(set(before.points).intersection(after.points))
            row["changed"] = len(set(before.points)) - row["kept"]
        else:
            row["kept"], row["changed"] = compare_points(model, before, after, name == "cut")
        return row, after

    def true_distance(self, original, result, error):
        try:
            done = subprocess.run([self.hausdorff, original, result, repr(error)], capture_output=True, text=True, timeout=LIMIT)
        except subprocess.TimeoutExpired:
            return None
        return json.loads(done.stdout) if done.returncode == 0 else None

    def compare_time(self, row, command, plain):
        if row["report"]["exit_code"] != 0 or row["seconds"] > SLOW:
            return
        times = {command[1]: [row["seconds"]], plain: []}
        for n in range(RUNS):
            for source, seconds in times.items():
                if len(seconds) <= n:
                    output = self.path("time_" + os.path.basename(source))
                    seconds.append(run(self.program, command[0], source, *command[2:], "-o", output)[1])
        row["time"] = statistics.median(times[command[1]]) / statistics.median(times[plain])

    def finish(self, row):
        """Waits for the true distance, and lists what is wrong with a row."""
        faults = row["faults"] = []
        if "facets" not in row:
            return
        if row["changed"] > 0:
            faults.append("points or values that did not move have changed")
        if row["command"] == "cut" and row["across"] + row["crossing"] > 0:
            faults.append("a seam is crossed")
        keeps_tolerance = row["command"] in ("simplify", "cut")
        if keeps_tolerance and row["distance"] > TOLERANCE:
            faults.append("the printed distance exceeds the tolerance")
        found = row["true"] = row["true"].result() if "true" in row else None
        if found is None:
            return
        row["true_distance"] = 100 * max(found["to_second"], found["to_first"]) / row["side"]
        if keeps_tolerance and row["true_distance"] - HAUSDORFF_ERROR > TOLERANCE:
            faults.append("the tolerance is exceeded")
        for key, bound in (("to_second", "distance_to_result"), ("to_first", "distance_to_input")):
            if found[key] - found["error"] > row["report"][bound]:
                faults.append("the printed distance is too small")


def worst_errors(row):
    """Returns the errors of the attribute with the largest one."""
    return max(row["errors"].values(), key=lambda e: e["max"]) if row.get("errors") else None


def cell(value, width, digits=2):
    if value is None:
        return "-".rjust(width)
    return (str(value) if isinstance(value, (int, str)) else f"{value:.{digits}f}").rjust(width)


HEAD = "file               command   facets  distance    true  median     max   label   across      kept changed  time"


def print_rows(rows):
    for row in rows:
        line = f"{row['file']:<18} {row['command']:<8}"
        if "facets" not in row:
            print(line, f"exit code {row['report']['exit_code']}: {row['report'].get('error', '')}", flush=True)
            continue
        errors = worst_errors(row) or {}
        across = f"{row['across']}/{row['crossing']}" if "crossing" in row else None
        print(line, cell(row["facets"], 7), cell(row["distance"], 9), cell(row.get("true_distance"), 7), cell(errors.get("median"), 7),
              cell(errors.get("max"), 7), cell(row.get("wrong_area"), 7), cell(across, 8), cell(row["kept"], 9), cell(row["changed"], 7),
              cell(row.get("time"), 5), *(f" FAULT: {fault}" for fault in row["faults"]), flush=True)


def print_summary(rows):
    def of(values):
        values = [x for x in values if x is not None]
        return f"{statistics.median(values):7.2f} {max(values):7.2f}" if values else f"{'-':>7} {'-':>7}"

    print("\nmedian and maximum over the files:")
    print("command  results  distance         median error     max error        label            time")
    for name in dict.fromkeys(row["command"] for row in rows):
        every = [row for row in rows if row["command"] == name]
        done = [row for row in every if "facets" in row]
        errors = [e for e in map(worst_errors, done) if e]
        print(f"{name:<9}{len(done):>2} of {len(every):<2}", of(row["distance"] for row in done), of(e["median"] for e in errors),
              of(e["max"] for e in errors), of(row.get("wrong_area") for row in done), of(row.get("time") for row in done), sep="  ")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="BSPLINE_SHELL")
    parser.add_argument("meshes", metavar="MESHES")
    parser.add_argument("--hausdorff", metavar="PROGRAM")
    parser.add_argument("--only", metavar="NAME", help="measure files whose names contain NAME")
    parser.add_argument("--output", metavar="FILE.json")
    arguments = parser.parse_args()
    if not arguments.hausdorff:
        build = os.path.join(os.path.dirname(arguments.program), "..", "..")
        arguments.hausdorff = os.path.join(build, "benchmark", "Bspline_shell_3", "Quality", "hausdorff_distance")
    for program in (arguments.program, arguments.hausdorff):
        if not os.access(program, os.X_OK):
            parser.error(f"{program} is not a program")
    rows = []
    print(HEAD, flush=True)
    with tempfile.TemporaryDirectory() as folder:
        measurement = Measurement(arguments, folder)
        for model in known.models(arguments.meshes):
            if not arguments.only or arguments.only in model.name:
                of_model = measurement.measure(model)
                print_rows(of_model)
                rows += of_model
    print_summary(rows)
    if arguments.output:
        with open(arguments.output, "w") as file:
            json.dump(rows, file, indent=1)
    sys.exit(any(row["faults"] for row in rows))


if __name__ == "__main__":
    main()
