"""Checks the files that shell_of_file writes, for input of several kinds and formats, and its refusals.

A refusal names the file, and does not affect earlier results.

Usage: shell_of_file_test.py SHELL_OF_FILE MESHES     (MESHES: the folder of CGAL's meshes)
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

program, meshes = sys.argv[1:]
STATUS = 10      # plus the position of the status in Status.h
WRONG_USAGE, CANNOT_WRITE = 2, 3


def run(file, prefix, *options):
    return subprocess.run([program, file, "--output", prefix, *options], capture_output=True, text=True)


def write(name, text):
    with open(name, "w") as file:
        file.write(text)
    return name


CUBE = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
TRIANGLES = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (1, 3, 7), (1, 7, 5), (3, 2, 6), (3, 6, 7), (2, 0, 4), (2, 4, 6)]

with tempfile.TemporaryDirectory() as folder:
    def path(name):
        return os.path.join(folder, name)

    def files(stem):
        return sorted(name for name in os.listdir(folder) if name == stem + ".json" or name == stem + ".shell" or name.startswith(stem + "_"))

    def report(stem):
        with open(path(stem + ".json")) as file:
            return json.load(file)

    # STL: triangles do not share points
    stl = "solid cube\n"
    for t in TRIANGLES:
        stl += "facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % CUBE[v] for v in t) + "endloop\nendfacet\n"
    done = run(write(path("cube.stl"), stl + "endsolid cube\n"), path("stl"))
    assert done.returncode == 0, done
    assert report("stl")["kind"] == "closed" and report("stl")["repairs"]["merged_points"] in (0, 28), report("stl")
    assert files("stl") == ["stl.json", "stl.shell", "stl_inner.ply", "stl_mesh.ply", "stl_outer.ply"], files("stl")

    # OBJ: a tray with one facet reversed
    facets = TRIANGLES[:2] + TRIANGLES[4:]
    facets[3] = facets[3][::-1]
    obj = "".join("v %g %g %g\n" % p for p in CUBE) + "".join("f %d %d %d\n" % tuple(v + 1 for v in t) for t in facets)
    done = run(write(path("tray.obj"), obj), path("obj"), "--thickness", "0.02")
    assert done.returncode == 0, done
    assert report("obj")["kind"] == "virtually closed" and report("obj")["repairs"]["reversed_polygons"] == 1, report("obj")
    assert report("obj")["closing"]["holes"] == 1 and "polygons reversed" in done.stdout, done

    # OFF: a few facets intersect others, and are excised
    done = run(os.path.join(meshes, "pig.off"), path("excised"))
    assert done.returncode == 0, done
    result = report("excised")
    assert result["status"] == "certified except for excised triangles" and result["kind"] == "excised", result
    assert 0 < result["excision"]["excised_area"] < 0.05 and "are excised" in done.stdout, result
    assert "intersects itself" in result["mesh_itself"]["message"] and "proxy" not in result["mesh_itself"]["message"], result
    assert "excised_excised.ply" in files("excised"), files("excised")

    # OFF: too many facets intersect others
    done = run(os.path.join(meshes, "degtri_sliding.off"), path("off"))
    assert done.returncode == 0, done
    result = report("off")
    assert result["status"] == "certified" and result["kind"] == "proxy", result
    assert "intersects itself" in result["mesh_itself"]["message"] and result["mesh_itself"]["facets"], result
    assert result["proxy"]["carried"] > 0 and abs(sum(result["proxy"][k] for k in ("carried", "continued", "hidden")) - 1) < 1e-6, result
    assert all(verdict == "proved" for verdict in result["claims"].values()), result
    assert "off_soup.ply" in files("off"), files("off")

    # Each refusal prints a sentence with the file and the line; results of an earlier run are kept.
    def contents():
        return {name: (Path(folder) / name).read_bytes() for name in files("stl")}

    before = contents()
    ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face %d\n" \
          "property list uchar int vertex_indices\nend_header\n%s 0 0\n1 0 0\n0 1 0\n"
    codes = {}
    for name, text, said in (("missing.off", None, "missing.off: The file does not exist"),
                             ("broken.off", "OFF\n3 1 0\n0 0 0\n", "broken.off, line 3: "),
                             ("text.txt", "no mesh", "text.txt: The file format"),
                             ("none.stl", "", "none.stl: The file is empty"),
                             ("empty.off", "OFF\n0 0 0\n", "no facets"), ("points.ply", ply % (0, "0"), "no facets"),
                             ("nan.ply", ply % (1, "nan") + "3 0 1 2\n", "nan.ply, line 10: ")):
        done = run(path(name) if text is None else write(path(name), text), path("stl"))
        codes[name] = done.returncode
        assert done.returncode > STATUS and said in done.stderr and "Traceback" not in done.stderr, (name, done)
        assert contents() == before, name
    assert "vertices: 0" in done.stderr, done
    assert codes["empty.off"] == codes["points.ply"] and len(set(codes.values())) == len(codes) - 1, codes
    degenerate = write(path("line.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
    done = run(degenerate, path("line"))
    assert done.returncode > STATUS and report("line")["status"] == "refused", done
    assert files("line") == ["line.json"], files("line")
    done = run(degenerate, path("stl"))
    assert contents() == before and report("stl.failed")["status"] == "refused" and "stl.failed" in done.stderr, done

    # wrong usage
    for options in (["--thickness", "0"], ["--thickness", "x"], ["--time-limit", "-1"], ["--nonsense"]):
        done = run(path("cube.stl"), path("stl"), *options)
        assert done.returncode == WRONG_USAGE and options[0] in done.stderr and done.stdout == "", done
    done = run(path("cube.stl"), path("stl"), "--help")
    assert done.returncode == 0 and done.stdout.startswith("Usage:") and done.stderr == "", done
    assert run(path("cube.stl"), path("no/such/folder/x")).returncode == CANNOT_WRITE
    os.mkdir(path("taken_mesh.ply"))
    assert run(path("cube.stl"), path("taken")).returncode == CANNOT_WRITE and files("taken") == ["taken_mesh.ply"]
    assert contents() == before
    assert not [name for name in os.listdir(folder) if ".new" in name or ".part" in name], os.listdir(folder)

    # A successful run replaces all results of the earlier one.
    write(path("stl_places.ply"), "")
    done = run(path("cube.stl"), path("stl"), "--thickness", "0.02")
    assert done.returncode == 0 and files("stl") == sorted(before) and contents() != before, (done, files("stl"))
