"""Checks that the workflow for data sets processes all meshes once, and records failures. Requires snakemake.

Usage: data_set_test.py BSPLINE_SHELL MESHES DATA_SET   (MESHES: CGAL's meshes; DATA_SET: the workflow)
"""
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

program, meshes, workflow = sys.argv[1:]
if not shutil.which("snakemake"):
    print("Skipped: snakemake is not installed.")
    sys.exit(77)
has_pictures = shutil.which("Xvfb") and subprocess.run(["/usr/bin/python3", "-c", "import vtk, PIL"], capture_output=True).returncode == 0
if subprocess.run(["/usr/bin/python3", "-c", "import matplotlib"], capture_output=True).returncode != 0:
    print("Skipped: matplotlib is not installed.")
    sys.exit(77)

# Possible misbehavior of a program; "die" also kills the job.
NASTY = """#!/usr/bin/python3
import os, sys
what = os.path.basename(sys.argv[2])
if what.startswith("sleep"):
    import time
    time.sleep(60)
if what.startswith("memory"):
    try:
        x = bytearray(10**9)
    except MemoryError:
        sys.exit("terminate called after throwing an instance of 'std::bad_alloc'")
if what.startswith("crash"):
    os.kill(os.getpid(), 11)
if what.startswith("die"):
    os.kill(os.getppid(), 9)
print('{"error": "The facets are wrong."}')
sys.exit(1)
"""


class Data_set:
    def __init__(self, folder, files, **options):
        self.folder, self.results = folder / "in", folder / "out"
        self.folder.mkdir(parents=True)
        for name, text in files.items():
            (self.folder / name).write_text(text)
        self.options = options

    def run(self):
        config = {"meshes": self.folder, "program": program, **self.options}
        return subprocess.run(["snakemake", "-s", f"{workflow}/Snakefile", "-d", self.results, "-c", "2", "--scheduler", "greedy", "--keep-going",
                               "--rerun-incomplete", "--config", *(f"{key}={value}" for key, value in config.items())], capture_output=True, text=True)

    def table(self):
        with open(self.results / "table.csv", newline="") as file:
            return {line["name"]: line for line in csv.DictReader(file)}

    def times(self):
        return {path.parent.name: path.stat().st_mtime_ns for path in self.results.glob("meshes/*/record.json")}


with tempfile.TemporaryDirectory() as folder:
    broken, line = "OFF\n3 1 0\n0 0 0\n1 0 0\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n"
    eight, sphere = (Path(meshes, name).read_text() for name in ("eight.off", "sphere.off"))
    good = Data_set(Path(folder, "good"), {"eight.off": eight, "a {strange} name's.off": sphere, "broken.off": broken, "line.off": line, "notes.txt": ""},
                    pictures=bool(has_pictures), batch=2)
    done = good.run()
    assert done.returncode == 0, done
    table = good.table()
    assert {name: r["outcome"] for name, r in table.items()} == {"eight": "done", "a__strange__name_s": "done", "broken": "refused", "line": "refused"}, table
    assert all((r["reason"] != "") == (r["outcome"] != "done") and float(r["seconds"]) > 0 and float(r["peak_mb"]) > 1 for r in table.values()), table
    for name in "eight", "a__strange__name_s":
        r = table[name]
        assert 0 < float(r["distance"]) < 2 and int(r["simplified_facets"]) <= int(r["facets"]), r
        assert 0 < float(r["thickness"]) < 100 and int(r["cells"]) > 0, r
        files = {path.name for path in (good.results / "meshes" / name).iterdir()}
        assert {f"{name}.json", f"{name}_simplified.ply", "index.html", "record.json", "log.txt"} <= files, files
        assert ("thumbnail.png" in files) == bool(has_pictures) and f"{name}.shell" not in files, files
    page = (good.results / "index.html").read_text()
    assert all(f"meshes/{name}/index.html" in page and (good.results / "meshes" / name / "index.html").exists() for name in table)
    assert "http://" not in page.replace("http://www.w3.org", "")

    # Nothing is processed again; then only changed files are.
    times = good.times()
    done = good.run()
    assert done.returncode == 0 and "Nothing to be done" in done.stderr + done.stdout and good.times() == times, done
    (good.folder / "broken.off").write_text(eight)
    done = good.run()
    assert done.returncode == 0 and good.table()["broken"]["outcome"] == "done", done
    assert {name for name, time in good.times().items() if time != times[name]} == {"broken"}
    good.options["time_limit"] = 100
    times = good.times()
    assert good.run().returncode == 0 and not set(times.items()) & set(good.times().items()), "an option does not count"
    os.remove(good.folder / "line.off")
    assert good.run().returncode == 0 and "line" not in good.table()

    # Limits and crashes are recorded for a list with a missing mesh.
    nasty = Path(folder, "nasty.py")
    nasty.write_text(NASTY)
    nasty.chmod(0o755)
    names = "sleep", "memory", "crash", "other", "die"
    bad = Data_set(Path(folder, "bad"), {f"{name}.off": "" for name in names}, program=nasty, time_limit=2, memory_limit=500, batch=3)
    bad.folder.joinpath("list.txt").write_text("".join(f"{name}.off\n" for name in (*names, "missing")) + "# a comment\n")
    bad.options["meshes"] = bad.folder / "list.txt"
    assert bad.run().returncode == 1 and bad.run().returncode == 1
    times = bad.times()
    done = bad.run()
    assert done.returncode == 0, done
    outcomes = {name: r["outcome"] for name, r in bad.table().items()}
    assert outcomes == {"sleep": "time limit", "memory": "memory limit", "crash": "crashed", "other": "refused", "missing": "refused", "die": "killed"}, outcomes
    assert all(bad.times()[name] == time for name, time in times.items()), "records were made again"
    record = json.loads((bad.results / "meshes/crash/record.json").read_text())
    assert record["exit"] == -11 and "SIGSEGV" in record["reason"], record

    # wrong usage
    for options in {"meshes": Path(folder, "nowhere")}, {"time_limit": 0}, {"nonsense": 1}, {"program": Path(folder, "none")}:
        wrong = Data_set(Path(folder, "wrong" + next(iter(options))), {"eight.off": eight}, **options)
        done = wrong.run()
        assert done.returncode == 1 and "Traceback" not in done.stderr, done
print("ok")
