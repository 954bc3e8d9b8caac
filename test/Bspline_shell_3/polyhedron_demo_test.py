"""Runs the actions of the plugin in CGAL's Polyhedron demo, by scripts of the demo, and checks items and pictures.

Exits with 77 if the demo was not built by examples/polyhedron_demo.sh, or if Xvfb is missing.

Usage: polyhedron_demo_test.py DEMO [FOLDER]     (FOLDER: for screenshots)
"""
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent / "Tool"))
from mesh_files import as_ply, sphere      # noqa: E402  (needs the path)
from png_files import as_png               # noqa: E402

demo = Path(sys.argv[1]).resolve()
SECONDS = 300       # A slow machine runs each script in less.
FUNCTIONS = """
function report(name, value) { print("REPORT " + JSON.stringify([name, value])) }
function names() {
  var all = []
  for(var i = 0; i < scene.numberOfEntries; ++i) all.push(scene.item(i).name)
  return all
}
function open(name) {
  main_window.open(name, "ply_plugin")
  return scene.numberOfEntries - 1
}
var shells = bspline_shell_plugin
"""
SHELL = """
open("sphere.ply")
report("no shell", shells.simplify(0, 100, 60))
report("build", shells.build_shell(0, 4, 60))
report("shell", names())
"""
EDITS = """
open("sphere.ply")
shells.build_shell(0, 4, 60)
report("simplify", shells.simplify(0, 300, 60))
var simplified = scene.numberOfEntries - 1
report("simplified", names()[simplified])
report("carry", shells.carry(0, simplified))
report("remesh", shells.remesh(0, 0.3, 60))
var remeshed = scene.numberOfEntries - 1
report("remeshed", names()[remeshed])
report("project", shells.project(remeshed, simplified))
report("projected", names().slice(remeshed + 1))
var cloud = open("points.ply")
report("project points", shells.project(cloud, 0))
report("projected points", names().slice(cloud + 1))
report("not a mesh", shells.build_shell(cloud, 1, 60))
report("invalid", shells.build_shell(0, 1000, 60))
report("late", shells.build_shell(0, 0.01, 1e-3))
for(var i = 0; i < scene.numberOfEntries; ++i) scene.item(i).visible = i == simplified
"""
BAD = """
for(var i = 0; i < FILES.length; ++i) {
  open(FILES[i])
  report(FILES[i], [shells.build_shell(0, 1, 60), shells.simplify(0, 0, 60), shells.remesh(0, 0.5, 60), names()])
  while(scene.numberOfEntries > 0) scene.erase(0)
}
"""
NO_SHELL = "has no shell"
# parts of the outcomes of building, simplifying, and remeshing, and whether places are marked
OUTCOMES = {"self_intersecting.ply": ("intersects itself", NO_SHELL, NO_SHELL, True),
            "inside_out.ply": ("do not bound one volume", NO_SHELL, NO_SHELL, True),
            "quads.ply": ("", "not triangles", "not triangles", False),
            "sheet.ply": ("", "", "", False)}


def skip(reason):
    print(reason)
    sys.exit(77)


def write_mesh(name, points, facets):
    """Writes a file of a mesh without properties."""
    lines = ["ply", "format ascii 1.0", f"element vertex {len(points)}", *(f"property double {c}" for c in "xyz"),
             f"element face {len(facets)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(str, p)) for p in points] + [" ".join(map(str, [len(f), *f])) for f in facets]
    Path(name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_meshes():
    points, triangles = sphere(20, 40)
    red, blue = (lambda p: 255 if p[0] > 0 else 0), (lambda p: 0 if p[0] > 0 else 255)
    Path("sphere.ply").write_bytes(as_ply("ascii", points, triangles, [
        ("red", "uchar", red), ("green", "uchar", lambda p: 0), ("blue", "uchar", blue), ("height", "double", lambda p: p[2])], []))
    write_mesh("points.ply", [(1.01, 0, 0), (0, -0.99, 0), (3, 0, 0)], [])
    other = [[v + len(points) for v in t] for t in triangles]
    write_mesh("self_intersecting.ply", points + [(x + 1.5, y, z) for x, y, z in points], triangles + other)
    write_mesh("inside_out.ply", points + [(x / 2, y / 2, z / 2) for x, y, z in points], triangles + other)
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    write_mesh("quads.ply", corners, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
    write_mesh("sheet.ply", [(x, y, 0) for x in range(3) for y in range(3)],
               [t for v in (0, 1, 3, 4) for t in ((v, v + 3, v + 4), (v, v + 4, v + 1))])


class Screen:
    """A display without hardware, whose pixels are in a file."""

    def __init__(self):
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-fbdir", "."],
                                       pass_fds=[write], stderr=subprocess.DEVNULL)
        self.name = f":{os.read(read, 9).decode().strip()}"

    def pixels(self):
        data = Path("Xvfb_screen0").read_bytes()
        header = struct.unpack_from(">25I", data)
        width, height, order, line, start = header[4], header[5], header[7], header[12], header[0] + 12 * header[19]
        assert header[11] == 32
        at = (lambda i: data[i + 1:i + 4]) if order else (lambda i: data[i + 2:i - 1 if i else None:-1])
        return [[tuple(at(start + line * y + 4 * x)) for x in range(width)] for y in range(height)]

    def save(self, name):
        rows = self.pixels()
        Path(name).write_bytes(as_png(len(rows[0]), len(rows), lambda x, y: rows[y][x]))


def run(screen, name, script):
    """Runs a script in the demo, and returns what it reports. The demo stays open until the caller has left the loop."""
    Path(f"{name}.js").write_text(FUNCTIONS + script + 'report("end", "")', encoding="utf-8")
    environment = {**os.environ, "HOME": os.getcwd(), "XDG_CONFIG_HOME": os.getcwd(), "DISPLAY": screen.name, "LIBGL_ALWAYS_SOFTWARE": "1"}
    with open(f"{name}.log", "w+", encoding="utf-8") as log:
        running = subprocess.Popen([demo, f"{name}.js"], env=environment, stdout=log, stderr=log)
        try:
            for _ in range(SECONDS):
                time.sleep(1)
                text = Path(log.name).read_text(encoding="utf-8")
                reports = dict(json.loads(line) for line in re.findall(r"REPORT (.*)", text))
                assert running.poll() is None, text
                if "end" in reports:
                    time.sleep(2)       # draws the last state
                    assert running.poll() is None, text
                    yield reports
                    return
            raise AssertionError(text)
        finally:
            running.kill()
            running.wait()


def share(rows, is_counted):
    return sum(is_counted(*color) for row in rows for color in row) / sum(map(len, rows))


def test(screen, folder):
    for found in run(screen, "shell", SHELL):
        print(found)
        assert NO_SHELL in found["no shell"]
        assert found["build"] == ""
        assert found["shell"] == ["sphere", "certified shell of sphere", "inner surface", "outer surface"]
        if folder:
            screen.save(folder / "shell.png")

    for found in run(screen, "edits", EDITS):
        print(found)
        for name in ("simplify", "carry", "remesh", "project"):
            assert found[name] == "", name
        facets, = re.fullmatch(r"simplified sphere \((\d+) facets\)", found["simplified"]).groups()
        assert 0 < int(facets) <= 300
        assert re.fullmatch(r"remeshed sphere \(\d+ facets\)", found["remeshed"])
        assert found["projected"] == [f"projected {found['remeshed']}"]
        assert "2 of 3 points are on sphere" in found["project points"] and "not in the shell" in found["project points"]
        assert found["projected points"] == ["projected points", "no image: points"]
        assert "not a surface mesh" in found["not a mesh"]
        assert "relative_thickness" in found["invalid"] and "time_limit" in found["late"]
        if folder:
            screen.save(folder / "edits.png")
        rows = screen.pixels()      # the colors of two hemispheres
        assert share(rows, lambda r, g, b: r > 60 and b < r / 4 and g < r / 4) > 0.01
        assert share(rows, lambda r, g, b: b > 60 and r < b / 4 and g < b / 4) > 0.01

    for found in run(screen, "bad", f"var FILES = {json.dumps(list(OUTCOMES))}\n" + BAD):
        print(found)
        for name, (*expected, is_marked) in OUTCOMES.items():
            *outcomes, items = found[name]
            for part, outcome in zip(expected, outcomes):
                assert (part in outcome) if part else outcome == "", (name, part, outcome)
            assert any("without proof" in item for item in items) == is_marked, (name, items)


if not demo.is_file():
    skip(f"{demo} does not exist: build it with bash examples/polyhedron_demo.sh --build.")
if not shutil.which("Xvfb"):
    skip("Xvfb is missing: install xvfb.")
pictures = Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
with tempfile.TemporaryDirectory() as home:
    os.chdir(home)
    write_meshes()
    display = Screen()
    try:
        test(display, pictures)
    finally:
        display.server.kill()
        display.server.wait()
