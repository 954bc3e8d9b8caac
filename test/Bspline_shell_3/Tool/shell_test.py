"""Checks the files that describe a shell, for input of several kinds and formats, and refusals.

A refusal names the file, and does not affect earlier results.

Usage: shell_test.py BSPLINE_SHELL MESHES     (MESHES: the folder of CGAL's meshes)
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from mesh_files import write

program, meshes = sys.argv[1:]
WRONG_INPUT, WRONG_USAGE, CANNOT_WRITE, NOT_CERTIFIED = 1, 2, 3, 4
CERTIFICATE = ["certificate.txt", "mesh.off", "shell.txt"]
CUBE = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
TRIANGLES = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (1, 3, 7), (1, 7, 5), (3, 2, 6), (3, 6, 7), (2, 0, 4), (2, 4, 6)]


def run(*arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)


with tempfile.TemporaryDirectory() as folder:
    folder = Path(folder)

    def shell(file, stem, *options):
        return run("shell", file, "-o", folder / stem, *options)

    def files(stem):
        """Returns the ends of the names that begin with this stem."""
        return sorted(name[len(stem) + 1:] for name in os.listdir(folder) if name.startswith((stem + ".", stem + "_")))

    def report(stem):
        return json.loads((folder / f"{stem}.json").read_text())

    certified = sorted([*CERTIFICATE, "inner.ply", "json", "mesh.ply", "outer.ply", "shell"])

    # STL: triangles do not share points
    stl = "solid cube\n"
    for t in TRIANGLES:
        stl += "facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % CUBE[v] for v in t) + "endloop\nendfacet\n"
    cube = write(folder / "a.stl", stl + "endsolid cube\n")
    done = shell(cube, "cube")
    assert done.returncode == 0 and report("cube")["kind"] == "closed", (done, report("cube"))
    assert files("cube") == certified, files("cube")

    # OBJ: a tray with one facet reversed
    facets = TRIANGLES[:2] + TRIANGLES[4:]
    facets[3] = facets[3][::-1]
    obj = "".join("v %g %g %g\n" % p for p in CUBE) + "".join("f %d %d %d\n" % tuple(v + 1 for v in t) for t in facets)
    done = shell(write(folder / "a.obj", obj), "tray", "--thickness", "2%")
    assert done.returncode == 0, done
    assert report("tray")["kind"] == "virtually closed" and report("tray")["repairs"]["reversed_polygons"] == 1, report("tray")
    assert report("tray")["closing"]["holes"] == 1, report("tray")

    # A few facets intersect others, and are excised.
    done = shell(f"{meshes}/pig.off", "pig")
    result = report("pig")
    assert done.returncode == 0 and result["status"] == "certified except for excised triangles" and result["kind"] == "excised", (done, result)
    assert 0 < result["excision"]["excised_area"] < 0.05 and "excised" in done.stdout and "excised.ply" in files("pig"), (done, result)
    assert "intersects itself" in result["mesh_itself"]["message"] and "proxy" not in result["mesh_itself"]["message"], result

    # Too many facets intersect others.
    done = shell(f"{meshes}/degtri_sliding.off", "proxy")
    result = report("proxy")
    assert done.returncode == 0 and result["status"] == "certified" and result["kind"] == "proxy", (done, result)
    assert "intersects itself" in result["mesh_itself"]["message"] and result["mesh_itself"]["facets"], result
    assert result["proxy"]["carried"] > 0 and abs(sum(result["proxy"][k] for k in ("carried", "continued", "hidden")) - 1) < 1e-6, result
    assert all(verdict == "proved" for verdict in result["claims"].values()) and "soup.ply" in files("proxy"), result

    # Each refusal gives a sentence with the file and the line; results of an earlier run are kept.
    def contents():
        return {name: (folder / f"cube{'_' if name.endswith('.ply') else '.'}{name}").read_bytes() for name in certified}

    before = contents()
    ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face %d\n" \
          "property list uchar int vertex_indices\nend_header\n%s 0 0\n1 0 0\n0 1 0\n"
    for name, text, said in (("missing.off", None, "missing.off: The file does not exist"),
                             ("broken.off", "OFF\n3 1 0\n0 0 0\n", "broken.off, line 3: "),
                             ("text.txt", "no mesh", "text.txt: The file format"),
                             ("none.stl", "", "none.stl: The file is empty"),
                             ("empty.off", "OFF\n0 0 0\n", "no polygons"), ("points.ply", ply % (0, "0"), "no polygons"),
                             ("nan.ply", ply % (1, "nan") + "3 0 1 2\n", "vertices, counted from 0: 0")):
        done = shell(folder / name if text is None else write(folder / name, text), "cube")
        assert done.returncode == WRONG_INPUT and said in done.stderr, (name, done)
        assert contents() == before, name
    line = write(folder / "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
    done = shell(line, "cube")
    assert done.returncode == WRONG_INPUT and "cube_failed.json" in done.stderr and contents() == before, done
    assert report("cube_failed")["status"] == "refused", done
    # A shell that is not certified has places where the proof fails.
    done = shell(f"{meshes}/triceratops.off", "cube", "--excise", "0", "--thickness", "30%", "--memory-limit", "1")
    assert done.returncode in (WRONG_INPUT, NOT_CERTIFIED) and "--memory-limit" in done.stderr and contents() == before, done

    # A successful run replaces all results of the earlier ones.
    write(folder / "cube_soup.ply", "")
    done = shell(cube, "cube", "--thickness", "2%")
    assert done.returncode == 0 and files("cube") == certified and contents() != before, (done, files("cube"))
    before = contents()

    # An edit writes the files of its shell as well, and none of them replaces its result.
    done = run("simplify", f"{meshes}/eight.off", "-o", folder / "small.off", "--shell", folder / "eight", "--threads", "1", "--json")
    assert done.returncode == 0 and files("eight") == sorted(set(certified) - set(CERTIFICATE)), (done, files("eight"))
    assert run("certify", folder / "eight.shell", folder / "small.off").returncode == 0
    done = run("remesh", f"{meshes}/eight.off", "--edge", "5%", "-o", folder / "eight_mesh.ply", "--shell", folder / "eight")
    assert done.returncode == WRONG_USAGE and "eight_mesh.ply" in done.stderr, done
    done = run("simplify", line, "-o", folder / "line.off", "--shell", folder / "line")
    assert done.returncode == WRONG_INPUT and files("line") == ["failed.json"], (done, files("line"))

    # wrong usage
    for options in (["--thickness", "0"], ["--thickness", "x"], ["--time-limit", "-1"], ["--threads", "0"], ["--nonsense"]):
        done = shell(cube, "cube", *options)
        assert done.returncode == WRONG_USAGE and options[0] in done.stderr and done.stdout == "", done
    assert shell(cube, "no/such/folder/x").returncode == CANNOT_WRITE
    os.mkdir(folder / "taken_mesh.ply")
    assert shell(cube, "taken").returncode == CANNOT_WRITE and files("taken") == ["mesh.ply"]
    assert contents() == before
    assert not [name for name in os.listdir(folder) if ".part" in name], os.listdir(folder)
