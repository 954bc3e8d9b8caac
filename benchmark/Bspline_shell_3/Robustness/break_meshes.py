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
"""
import os
import sys

from open_meshes import read, write


def split(points, facets, gap=0.0):
    new_points, new_facets = [], []
    for t in facets:
        center = [sum(points[v][a] for v in t) / 3 for a in range(3)]
        new_facets.append(tuple(range(len(new_points), len(new_points) + 3)))
        new_points += [tuple(points[v][a] + gap * (center[a] - points[v][a]) for a in range(3)) for v in t]
    return new_points, new_facets


def pushed(points, facets):
    used = {v for t in facets for v in t}
    unit = max(max(points[v][a] for v in used) - min(points[v][a] for v in used) for a in range(3))
    moved = [(p[0] + 0.17 * unit, p[1] + 0.11 * unit, p[2] + 0.05 * unit) for p in points]
    return points + moved, facets + [tuple(v + len(points) for v in t) for t in facets]


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
