#!/usr/bin/env python3
"""Opens closed meshes: punches holes into them, and cuts sheets out of them.

   open_meshes.py FOLDER MESH...       (OFF, triangles)

For each mesh, writes two files to FOLDER: NAME_holes.off lacks the facets near three distant vertices, and
NAME_sheet.off is the largest connected set of facets that face upwards.
"""
import os
import sys


def read(name):
    with open(name, encoding="latin-1") as file:
        rows = [row for row in (line.split("#")[0].split() for line in file) if row]
    if not rows[0][0].endswith("OFF") or len(rows[0]) > 1:
        raise ValueError(f"{name}: expected an OFF file with the counts in the second line")
    v, f = map(int, rows[1][:2])
    points = [tuple(map(float, row[:3])) for row in rows[2:2 + v]]
    facets = [tuple(map(int, row[1:4])) for row in rows[2 + v:2 + v + f] if row[0] == "3"]
    if len(points) < v or len(facets) < f:
        raise ValueError(f"{name}: a facet is not a triangle, or the file is truncated")
    return points, facets


def write(name, points, facets):
    number = {}
    for t in facets:
        for v in t:
            number.setdefault(v, len(number))
    with open(name + ".part", "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(number)} {len(facets)} 0\n")
        for v in number:
            file.write("%.17g %.17g %.17g\n" % points[v])
        for t in facets:
            file.write("3 %d %d %d\n" % tuple(number[v] for v in t))
    os.replace(name + ".part", name)


def squared_distance(p, q):
    return sum((a - b) ** 2 for a, b in zip(p, q))


def without_holes(points, facets):
    used = sorted({v for t in facets for v in t})
    unit = max(max(points[v][a] for v in used) - min(points[v][a] for v in used) for a in range(3))
    centers = [used[0]]
    for _ in range(2):
        centers.append(max(used, key=lambda v: min(squared_distance(points[v], points[c]) for c in centers)))
    near = {v for v in used if min(squared_distance(points[v], points[c]) for c in centers) < (0.06 * unit) ** 2}
    return [t for t in facets if not near.intersection(t)]


def upward_part(points, facets):
    def normal_z(t):
        p, q, r = (points[v] for v in t)
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    up = [t for t in facets if normal_z(t) > 0]
    at_edge = {}
    for n, t in enumerate(up):
        for i in range(3):
            at_edge.setdefault(frozenset((t[i], t[(i + 1) % 3])), []).append(n)
    part, best = [None] * len(up), []
    for first in range(len(up)):
        if part[first] is not None:
            continue
        part[first], stack = first, [first]
        for n in stack:
            for i in range(3):
                for m in at_edge[frozenset((up[n][i], up[n][(i + 1) % 3]))]:
                    if part[m] is None:
                        part[m] = first
                        stack.append(m)
        best = max(best, stack, key=len)
    return [up[n] for n in best]


def largest_manifold(facets):
    """Removes facets until borders do not touch themselves."""
    while True:
        outgoing = {}
        edges = {(t[i], t[(i + 1) % 3]) for t in facets for i in range(3)}
        for a, b in edges:
            if (b, a) not in edges:
                outgoing.setdefault(a, []).append(b)
        pinched = {v for v, targets in outgoing.items() if len(targets) > 1}
        if not pinched:
            return facets
        facets = [t for t in facets if not pinched.intersection(t)]


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    for file_name in sys.argv[2:]:
        all_points, all_facets = read(file_name)
        stem = os.path.join(folder, os.path.splitext(os.path.basename(file_name))[0])
        for what, change in (("holes", without_holes), ("sheet", upward_part)):
            write(f"{stem}_{what}.off", all_points, largest_manifold(change(all_points, all_facets)))
