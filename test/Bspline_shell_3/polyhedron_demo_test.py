"""Runs the actions of the plugin in CGAL's Polyhedron demo, by a script of the demo, and checks items and pictures.

Exits with 77 if the demo was not built by examples/polyhedron_demo.sh, or if Xvfb is missing.

Usage: polyhedron_demo_test.py DEMO MESHES [FOLDER]     (MESHES: the folder of CGAL's meshes; FOLDER: for the pictures)
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent / "Tool"))
from mesh_files import as_ply, sphere      # noqa: E402  (needs the path)
from png_files import read_png             # noqa: E402

demo, meshes = Path(sys.argv[1]), Path(sys.argv[2])
SCRIPT = """
function report(name, value) { print("REPORT " + JSON.stringify([name, value])) }
function names() {
  var all = []
  for(var i = 0; i < scene.numberOfEntries; ++i) all.push(scene.item(i).name)
  return all
}
function open(name, plugin) {
  main_window.open(name, plugin)
  return scene.numberOfEntries - 1
}
function remove_all() { while(scene.numberOfEntries > 0) scene.erase(0) }
var shells = bspline_shell_plugin

open(SPHERE, "ply_plugin")
report("no shell", shells.simplify(0, 100, 60))
report("build", shells.build_shell(0, 4, 60))
report("shell", names())
viewer.showEntireScene()
viewer.saveSnapshot(FOLDER + "/shell.png", 600, 600)
report("simplify", shells.simplify(0, 300, 60))
var simplified = scene.numberOfEntries - 1
report("simplified", names()[simplified])
report("carry", shells.carry(0, simplified))
for(var i = 0; i < simplified; ++i) scene.item(i).visible = false
viewer.saveSnapshot(FOLDER + "/carried.png", 600, 600)
report("remesh", shells.remesh(0, 0.3, 60))
var remeshed = scene.numberOfEntries - 1
report("remeshed", names()[remeshed])
report("project", shells.project(remeshed, simplified))
report("projected", names().slice(remeshed + 1))
var cloud = open(POINTS, "ply_plugin")
report("project points", shells.project(cloud, 0))
report("projected points", names().slice(cloud + 1))
report("not a mesh", shells.build_shell(cloud, 1, 60))
report("invalid", shells.build_shell(0, 1000, 60))
report("late", shells.build_shell(0, 0.01, 1e-3))
remove_all()

for(var i = 0; i < BAD.length; ++i) {
  open(BAD[i], "ply_plugin")
  report("bad", [shells.build_shell(0, 1, 60), shells.simplify(0, 0, 60), shells.remesh(0, 0.1, 60), names()])
  remove_all()
}
main_window.close()
"""
NO_SHELL = "has no shell"
# files, parts of the outcomes of building, simplifying, and remeshing, and whether places are marked
BAD = [("self_intersecting.ply", "intersects itself", NO_SHELL, NO_SHELL, True),
       ("inside_out.ply", "do not bound one volume", NO_SHELL, NO_SHELL, True),
       ("quads.ply", "", "not triangles", "not triangles", False),
       ("sheet.ply", "", "", "", False)]


def skip(reason):
    print(reason)
    sys.exit(77)


def mesh(name, points, facets):
    """Writes a file of a mesh without properties."""
    lines = ["ply", "format ascii 1.0", f"element vertex {len(points)}", "property double x", "property double y", "property double z",
             f"element face {len(facets)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(str, p)) for p in points] + [" ".join(map(str, [len(f), *f])) for f in facets]
    Path(name).write_text("\n".join(lines) + "\n", encoding="utf-8")


if not demo.is_file():
    skip(f"{demo} does not exist: build it with bash examples/polyhedron_demo.sh --build.")
if not shutil.which("xvfb-run"):
    skip("xvfb-run is missing: install xvfb and xauth.")
with tempfile.TemporaryDirectory() as home:
    folder = Path(sys.argv[3] if len(sys.argv) > 3 else home).resolve()
    os.chdir(home)
    points, triangles = sphere(20, 40)
    red, blue = (lambda p: 255 if p[2] > 0 else 0), (lambda p: 0 if p[2] > 0 else 255)
    Path("sphere.ply").write_bytes(as_ply("ascii", points, triangles, [
        ("red", "uchar", red), ("green", "uchar", lambda p: 0), ("blue", "uchar", blue), ("height", "double", lambda p: p[2])], []))
    far = [(1.01, 0, 0), (0, -0.99, 0), (3, 0, 0)]
    mesh("points.ply", far, [])
    shifted = [(x + 1.5, y, z) for x, y, z in points]
    mesh("self_intersecting.ply", points + shifted, triangles + [[v + len(points) for v in t] for t in triangles])
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    mesh("quads.ply", corners, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
    mesh("sheet.ply", [(x, y, 0) for x in range(3) for y in range(3)],
         [t for i in range(2) for j in range(2) for t in ((3 * i + j, 3 * i + j + 3, 3 * i + j + 4), (3 * i + j, 3 * i + j + 4, 3 * i + j + 1))])
    mesh("inside_out.ply", points + [(x / 2, y / 2, z / 2) for x, y, z in points],
         triangles + [[v + len(points) for v in t] for t in triangles])
    here = {"SPHERE": "sphere.ply", "POINTS": "points.ply", "FOLDER": str(folder), "BAD": [name for name, *_ in BAD]}
    script = "".join(f"var {name} = {json.dumps(value)}\n" for name, value in here.items()) + SCRIPT
    Path("script.js").write_text(script, encoding="utf-8")
    environment = {**os.environ, "HOME": home, "XDG_CONFIG_HOME": home, "QT_QPA_PLATFORM": "xcb", "LIBGL_ALWAYS_SOFTWARE": "1"}
    done = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1280x900x24", demo.resolve(), "script.js"], env=environment,
                          capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == 0, (done.returncode, done.stdout, done.stderr)
    reports = [json.loads(line.split("REPORT ", 1)[1]) for line in done.stdout.split("\n") if "REPORT " in line]
    print(*reports, sep="\n")
    found = dict(reports)
    for name in ("build", "simplify", "carry", "remesh", "project"):
        assert found[name] == "", (name, found[name])
    assert found["shell"] == ["sphere", "shell of sphere (certified)", "inner surface", "outer surface"], found["shell"]
    kept, = re.fullmatch(r"sphere, simplified \((\d+) facets\)", found["simplified"]).groups()
    assert 0 < int(kept) <= 300, kept
    assert re.fullmatch(r"sphere, remeshed \(\d+ facets\)", found["remeshed"]), found["remeshed"]
    assert found["projected"] == [f"{found['remeshed']} on {found['simplified']}"], found["projected"]

    # Each failure has a reason, and its places are marked.
    assert "has no shell" in found["no shell"]
    assert "2 of 3 points are on sphere" in found["project points"] and "not in the shell" in found["project points"]
    assert found["projected points"] == ["points on sphere", "points, without an image"]
    assert "not a surface mesh" in found["not a mesh"]
    assert "relative_thickness" in found["invalid"] and "time_limit" in found["late"]
    outcomes = [value for name, value in reports if name == "bad"]
    assert len(outcomes) == len(BAD)
    for (name, built, simplified, remeshed, marked), outcome in zip(BAD, outcomes):
        for expected, reason in zip((built, simplified, remeshed), outcome):
            assert (expected in reason) if expected else reason == "", (name, expected, reason)
        assert any("without a proof" in item for item in outcome[3]) == marked, (name, outcome[3])

    # The pictures show the shell, and the colors above and below the equator.
    def share(picture, is_counted):
        _, _, rows = read_png(folder / picture)
        return sum(is_counted(*color) for row in rows for color in row) / sum(map(len, rows))

    assert share("shell.png", lambda r, g, b: r > b + 20) > 0.1
    assert share("carried.png", lambda r, g, b: r > 100 and b < 30) > 0.03
    assert share("carried.png", lambda r, g, b: b > 100 and r < 30) > 0.03
