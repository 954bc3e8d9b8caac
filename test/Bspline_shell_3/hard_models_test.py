"""Checks the models that hard_models writes: sizes, topology, and tips.

Usage: hard_models_test.py HARD_MODELS CERTIFY_MESHES MESHES     (MESHES: the folder of CGAL's meshes)
"""
import json
import os
import subprocess
import sys
import tempfile

program, certify_meshes, meshes = sys.argv[1:]


def read_off(path):
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    points, facets = int(words[1]), int(words[2])
    corners = words[4 + 3 * points:]
    return points, [tuple(map(int, corners[4 * n + 1:4 * n + 4])) for n in range(facets)]


def is_closed(facets):
    edges = [(f[i], f[(i + 1) % 3]) for f in facets for i in range(3)]
    different = set(edges)
    return len(different) == len(edges) and all((b, a) in different for a, b in edges)


def components(points, facets):
    root = list(range(points))

    def find(v):
        while root[v] != v:
            root[v] = root[root[v]]
            v = root[v]
        return v

    for a, b, c in facets:
        root[find(a)] = root[find(b)] = find(c)
    return len({find(v) for f in facets for v in f})


with tempfile.TemporaryDirectory() as folder:
    # The pyramid has fewer facets than any target.
    inputs = [os.path.join(meshes, name) for name in ("elephant.off", "pyramid.off")]
    subprocess.run([program, folder, *inputs], check=True)
    models = {name: read_off(os.path.join(folder, name)) for name in os.listdir(folder)}
    for name, (points, facets) in models.items():
        assert is_closed(facets), name
        expected = 4 if name.startswith("layers_") else 1
        assert components(points, facets) == expected, name
    for target in 300, 1000:
        assert 0.9 * target < len(models[f"elephant_{target}.off"][1]) <= 1.05 * target
    for name in "cube_flat.off", "prism_flat.off":
        assert 90000 < len(models[name][1]) < 110000, name

    # Each tip is a singular vertex, and only points have moved.
    _, facets = read_off(inputs[0])
    for tips in 1, 5:
        name = f"elephant_tips_{tips}.off"
        assert models[name][1] == facets, name
        found = subprocess.run([certify_meshes, "--gamma", "14", os.path.join(folder, name)],
                               capture_output=True, text=True, check=True)
        assert json.loads(found.stdout)["singular_vertices"] == tips, found.stdout
