#!/usr/bin/env python3
"""Introduces defects of real files into closed meshes.

   break_meshes.py FOLDER MESH...       (OFF, triangles)

For each mesh, writes the following files to FOLDER:
  NAME_dropped.off   every 200th facet is missing
  NAME_turned.off    every tenth facet is reversed
  NAME_doubled.off   every tenth facet occurs twice
  NAME_split.off     no facets share a vertex
  NAME_rounded.off   the same, with different rounding errors at each vertex
  NAME_pushed.off    the mesh, and a copy that intersects it
  NAME_gaps.off      each facet is scaled by 0.999 about its centroid
  NAME_flipped.off   five facets are reversed
  NAME_moved.off     five vertices are moved by 5 % of the box, so that facets at them intersect others
  NAME_float.off     no facets share a vertex; each coordinate is a float, with a random last bit at each facet
  NAME_fins.off      five triangles are attached to edges, and five to vertices
  NAME_corner.off    a tetrahedron touches the mesh at a vertex, and five pairs of facets that touch at a vertex are missing
"""
import os
import random
import struct
import sys

from open_meshes import read, write


def split(points, facets, gap=0.0):
    new_points, new_facets = [], []
    for t in facets:
        center = [sum(points[v][a] for v in t) / 3 for a in range(3)]
        new_facets.append(tuple(range(len(new_points), len(new_points) + 3)))
        new_points += [tuple(points[v][a] + gap * (center[a] - points[v][a]) for a in range(3)) for v in t]
    return new_points, new_facets


def size(points, facets):
    used = {v for t in facets for v in t}
    return max(max(points[v][a] for v in used) - min(points[v][a] for v in used) for a in range(3))


def pushed(points, facets):
    unit = size(points, facets)
    moved = [(p[0] + 0.17 * unit, p[1] + 0.11 * unit, p[2] + 0.05 * unit) for p in points]
    return points + moved, facets + [tuple(v + len(points) for v in t) for t in facets]


def shifted(p, length, generator):
    return tuple(x + length * generator.uniform(-1, 1) for x in p)


def with_moved_vertices(points, facets, generator):
    moved = list(points)
    for v in generator.sample(sorted({v for t in facets for v in t}), 5):
        moved[v] = shifted(points[v], 0.05 * size(points, facets), generator)
    return moved, facets


def rounded_to_floats(points, facets, generator):
    def rounded(x):
        bits = struct.unpack("<I", struct.pack("<f", x))[0]
        return struct.unpack("<f", struct.pack("<I", bits ^ generator.getrandbits(1) if bits & 0x7fffffff else bits))[0]
    return [tuple(rounded(x) for x in points[v]) for t in facets for v in t], [(3 * n, 3 * n + 1, 3 * n + 2) for n in range(len(facets))]


def with_fins(points, facets, generator):
    points, fins, length = list(points), [], 0.03 * size(points, facets)
    for n, t in enumerate(generator.sample(facets, 10)):
        first = len(points)
        points += [shifted(points[t[0]], length, generator) for _ in range(1 + n % 2)]
        fins.append((t[0], t[1], first) if n % 2 == 0 else (t[0], first, first + 1))
    return points, facets + fins


def with_touching_corners(points, facets, generator):
    tip = generator.choice(facets)[0]
    first, length = len(points), 0.03 * size(points, facets)
    center = [sum(p[a] for p in points) / len(points) for a in range(3)]
    out = [points[tip][a] - center[a] for a in range(3)]
    scale = length / sum(x * x for x in out) ** 0.5
    base = [points[tip][a] + scale * out[a] for a in range(3)]
    points = points + [tuple(base[a] + 0.4 * length * d[a] for a in range(3)) for d in ((1, 0, 0), (-0.5, 1, 0), (-0.5, -1, 1))]
    around = {}
    for n, t in enumerate(facets):
        for v in t:
            around.setdefault(v, []).append(n)
    missing = set()
    for v in generator.sample(sorted(around), 5):
        pairs = [(m, n) for m in around[v] for n in around[v] if m < n and set(facets[m]) & set(facets[n]) == {v}]
        missing.update(pairs[0] if pairs else ())
    tetrahedron = [(first, first + 1, first + 2), (tip, first + 1, first), (tip, first + 2, first + 1), (tip, first, first + 2)]
    return points, [t for n, t in enumerate(facets) if n not in missing] + tetrahedron


if len(sys.argv) < 3:
    sys.exit(__doc__)
folder = sys.argv[1]
os.makedirs(folder, exist_ok=True)
for file in sys.argv[2:]:
    points, facets = read(file)
    name = os.path.join(folder, os.path.splitext(os.path.basename(file))[0])
    write(name + "_dropped.off", points, [t for n, t in enumerate(facets) if n % 200 != 7])
    write(name + "_turned.off", points, [t[::-1] if n % 10 == 3 else t for n, t in enumerate(facets)])
    write(name + "_doubled.off", points, [u for n, t in enumerate(facets) for u in ([t, t] if n % 10 == 3 else [t])])
    write(name + "_split.off", *split(points, facets))
    write(name + "_rounded.off", *split(points, facets, 1e-15))
    write(name + "_pushed.off", *pushed(points, facets))
    write(name + "_gaps.off", *split(points, facets, 0.001))
    generator = random.Random(1)
    flipped = set(generator.sample(range(len(facets)), 5))
    write(name + "_flipped.off", points, [t[::-1] if n in flipped else t for n, t in enumerate(facets)])
    write(name + "_moved.off", *with_moved_vertices(points, facets, generator))
    write(name + "_float.off", *rounded_to_floats(points, facets, generator))
    write(name + "_fins.off", *with_fins(points, facets, generator))
    write(name + "_corner.off", *with_touching_corners(points, facets, generator))
