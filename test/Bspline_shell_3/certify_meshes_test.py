"""Checks that certify_meshes prints one JSON object per line for every file, and continues after problems.

Usage: certify_meshes_test.py CERTIFY_MESHES MESHES     (MESHES: the folder of CGAL's meshes)
"""
import json
import os
import subprocess
import sys
import tempfile

program, meshes = sys.argv[1:]
keys = {"mesh", "kind", "closing", "facets", "components", "status", "reason", "gamma", "levels", "cells", "unknowns", "eps1", "eps2", "thickness",
        "min_cone_margin", "singular_vertices", "certificate", "violations", "tiers", "seconds", "peak_mb"}


def no_number(text):
    raise AssertionError(text + " is not JSON")


def run(*arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done
    return [json.loads(line, parse_constant=no_number) for line in done.stdout.splitlines()]


with tempfile.TemporaryDirectory() as folder:
    broken = os.path.join(folder, 'bro"ken.off')
    with open(broken, "w") as file:
        file.write("OFF\n3 1 0\n0 0 0\n1 0 0\n")
    eight, opened = os.path.join(meshes, "eight.off"), os.path.join(meshes, "mannequin-devil.off")
    lines = run(eight, os.path.join(folder, "missing.off"), broken, opened, os.path.join(meshes, "cube.off"),
                "--gamma", "14", "--write-shells", folder)
    assert [line["mesh"] for line in lines[:4]] == [eight, os.path.join(folder, "missing.off"), broken, opened], lines
    assert len(lines) == 5
    assert [line["status"] for line in lines[1:4]] == ["refused"] * 3, lines
    assert all(line["reason"] for line in lines[1:4])
    for line in (lines[0], lines[4]):
        assert keys <= set(line), keys - set(line)
        assert line["certificate"]["containment"] == "proved"
        proved = all(value == "proved" for value in line["certificate"].values())
        assert (line["status"] == "certified") == proved
        assert proved or line["places"]                 # unproved claims have places
    assert {"eight.shell", "eight.shell.txt", "eight.mesh.off", "eight.certificate.txt"} <= set(os.listdir(folder))

    # By default, cells are refined, and the files of such shells are written.
    for name in os.listdir(folder):
        if name.startswith("eight."):
            os.remove(os.path.join(folder, name))
    refined, = run(eight, "--write-shells", folder)
    assert refined["status"] == "certified" and refined["rounds"] == len(refined["round_figures"]) > 0, refined
    assert refined["round_figures"][-1]["cells"] == refined["cells"], refined
    assert {"eight.shell", "eight.shell.txt", "eight.mesh.off", "eight.certificate.txt"} <= set(os.listdir(folder))

    # If the polygons are not a mesh, triangles are excised or, if these are too many, the polygons get a proxy, unless
    # it is disabled.
    for name, kind, status in ("pig.off", "excised", "certified_except_excised"), ("degtri_sliding.off", "proxy", "certified"):
        found, = run(os.path.join(meshes, name))
        assert found["kind"] == kind and found["status"] == status and found["excision"]["excised"] > 0, found
        if kind == "proxy":
            assert found["proxy"]["carried"] > 0 and "intersects itself" in found["proxy"]["because"], found
        refused, = run(os.path.join(meshes, name), "--no-proxy")
        assert refused["status"] == "refused", refused

    # A plate is much thinner than the cells that the memory limit permits. The shell is thicker than requested, or
    # there is none.
    plate = os.path.join(folder, "plate.off")
    with open(plate, "w") as file:
        file.write("OFF\n8 6 0\n" + "".join("%g %g %g\n" % (x, y, z) for z in (0, 0.01) for y in (0, 1) for x in (0, 1))
                   + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 1 3 7 5\n4 3 2 6 7\n4 2 0 4 6\n")
    thin, = run(plate, "--thickness", "0.001", "--no-proxy", "--max-memory-mb", "20")
    assert thin["status"] in ("not_certified", "refused") and thin["reason"], thin
    if thin["status"] == "not_certified":
        assert "limit" in thin["reason"] and thin["certificate"]["containment"] == "proved", thin
        assert thin["eps1"] < thin["eps2"] and thin["thickness"] > 0.001, thin

    # Limits end one mesh, not the run.
    late, after = run(os.path.join(meshes, "elephant.off"), opened, "--gamma", "400", "--max-seconds", "1")
    assert late["status"] == "refused" and "time" in late["reason"], late
    assert after["status"] == "refused"
    large, = run(eight, "--gamma", "100", "--max-memory-mb", "20")
    assert large["status"] == "refused" and "memory" in large["reason"], large
    assert subprocess.run([program, "--gamma", "much", eight], capture_output=True).returncode == 2
print("ok")
