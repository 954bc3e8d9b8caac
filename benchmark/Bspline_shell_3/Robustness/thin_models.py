#!/usr/bin/env python3
"""Writes closed meshes with thin walls, narrow gaps and shallow steps, difficult input of certify_meshes, as OFF files.

   thin_models.py FOLDER

Lengths are fractions of the longest side of a model's box; names contain them in percent: plate_0.1.off is 0.1 % thick.
Those of grooves and fins contain half of the width at the surface.
"""
import itertools
import math
import os
import sys


def write(path, points, facets):
    temporary = path + ".part"
    with open(temporary, "w", encoding="ascii") as out:
        out.write(f"OFF\n{len(points)} {len(facets)} 0\n")
        out.writelines("%r %r %r\n" % tuple(p) for p in points)
        out.writelines("3 %d %d %d\n" % tuple(f) for f in facets)
    os.replace(temporary, path)


class Blocks:
    """A solid made of boxes: each cell of a grid with planes at the given coordinates is filled or empty."""

    def __init__(self, *planes):
        self.planes = [sorted(set(p)) for p in planes]
        self.filled = set()

    def _cells(self, low, high):
        ranges = []
        for axis in range(3):
            planes = self.planes[axis]
            ranges.append(range(planes.index(low[axis]), planes.index(high[axis])))
        return itertools.product(*ranges)

    def add(self, low, high):
        self.filled.update(self._cells(low, high))
        return self

    def remove(self, low, high):
        self.filled.difference_update(self._cells(low, high))
        return self

    def mesh(self):
        number, facets = {}, []
        for cell in sorted(self.filled):
            for axis in range(3):
                for side in (0, 1):
                    neighbor = list(cell)
                    neighbor[axis] += 2 * side - 1
                    if tuple(neighbor) in self.filled:
                        continue
                    u, v = (axis + 1) % 3, (axis + 2) % 3
                    corners = []
                    for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        corner = list(cell)
                        corner[axis] += side
                        corner[u] += du
                        corner[v] += dv
                        corners.append(number.setdefault(tuple(corner), len(number)))
                    if side == 0:
                        corners.reverse()
                    facets += [corners[:3], [corners[0], corners[2], corners[3]]]
        return [[self.planes[a][c[a]] for a in range(3)] for c in number], facets


def revolved(profile, segments):
    """Rotates a curve in the (r, z) half plane from axis to axis; the inside is on the left of the curve."""
    points, rings = [], []
    for r, z in profile:
        if r == 0:
            rings.append([len(points)] * segments)
            points.append([0., 0., z])
        else:
            rings.append(range(len(points), len(points) + segments))
            points += [[r * math.cos(2 * math.pi * s / segments), r * math.sin(2 * math.pi * s / segments), z] for s in range(segments)]
    return points, facets_between(rings, segments)


def facets_between(rings, segments):
    facets = []
    for below, above in zip(rings, rings[1:]):
        for s in range(segments):
            t = (s + 1) % segments
            for f in ([below[s], below[t], above[t]], [below[s], above[t], above[s]]):
                if len(set(f)) == 3:
                    facets.append(f)
    return facets


def plate(t):
    """Returns a plate with nine holes and two ribs."""
    holes = [(x, x + 0.125) for x in (0.125, 0.4375, 0.75)]
    lines = [0., 1.] + [c for h in holes for c in h]
    ribs = [(0.3, 0.3 + t), (0.625, 0.625 + t)]
    blocks = Blocks(lines + [c for r in ribs for c in r], lines, [0., t, 0.1])
    blocks.add((0., 0., 0.), (1., 1., t))
    for x in holes:
        for y in holes:
            blocks.remove((x[0], y[0], 0.), (x[1], y[1], t))
    for r in ribs:
        blocks.add((r[0], 0., t), (r[1], 1., 0.1))
    return blocks.mesh()


def plain_plate(t):
    return Blocks([0., 1.], [0., 1.], [0., t]).add((0., 0., 0.), (1., 1., t)).mesh()


def near_plates(t):
    """Returns two slabs at the distance t."""
    blocks = Blocks([0., 0.2, 0.8, 1.], [0., 0.2, 0.8, 1.], [0., 0.2, 0.2 + t, 0.4 + t])
    return blocks.add((0., 0., 0.), (1., 1., 0.2)).add((0.2, 0.2, 0.2 + t), (0.8, 0.8, 0.4 + t)).mesh()


def comb(t):
    """Returns a comb with twenty teeth of thickness t."""
    teeth = [(k / 20, k / 20 + t) for k in range(20)]
    blocks = Blocks([c for tooth in teeth for c in tooth], [0., 0.1, 0.6], [0., 0.05])
    blocks.add((0., 0., 0.), (teeth[-1][1], 0.1, 0.05))
    for tooth in teeth:
        blocks.add((tooth[0], 0.1, 0.), (tooth[1], 0.6, 0.05))
    return blocks.mesh()


def hollow_box(t):
    planes = [0., t, 1. - t, 1.]
    return Blocks(planes, planes, planes).add((0., 0., 0.), (1., 1., 1.)).remove((t, t, t), (1. - t, 1. - t, 1. - t)).mesh()


def engraved(t):
    """Returns a plate with engraved letters of depth t."""
    letters = ("### #.# ### #.. #..", "#.. #.# #.. #.. #..", "### ### ### #.. #..", "..# #.# #.. #.. #..", "### #.# ### ### ###")
    rows = [row.replace(" ", ".") for row in letters]
    width, height = len(rows[0]) + 2, len(rows) + 2
    unit = 1 / width
    depth = 0.1
    blocks = Blocks([k * unit for k in range(width + 1)], [k * unit for k in range(height + 1)], [0., depth - t, depth])
    blocks.add((0., 0., 0.), (width * unit, height * unit, depth))
    for j, row in enumerate(reversed(rows)):
        for i, mark in enumerate(row):
            if mark == "#":
                blocks.remove(((i + 1) * unit, (j + 1) * unit, depth - t), ((i + 2) * unit, (j + 2) * unit, depth))
    return blocks.mesh()


def wine_glass(t):
    outer = [(0., 0.), (0.2, 0.), (0.2, 0.01), (0.03, 0.03), (0.02, 0.06), (0.02, 0.4), (0.03, 0.42)]
    bowl = [(0.25 * math.sin(a), 0.7 - 0.28 * math.cos(a)) for a in (0.3 + 0.1 * k for k in range(13))]
    rim = [(0.22, 1.)]
    inner = [(r - t * math.sin(a), z + t * math.cos(a)) for (r, z), a in zip(bowl, (0.3 + 0.1 * k for k in range(13)))]
    profile = outer + bowl + rim + [(rim[0][0] - t, 1.)] + inner[::-1] + [(0., 0.42 + t)]
    return revolved(profile, 64)


def bowl(t):
    """Returns half of a hollow sphere around the origin."""
    angles = [k / 16 for k in range(25)]
    return revolved([(r * math.sin(a), -r * math.cos(a)) for r, side in ((0.5, angles), (0.5 - t, angles[::-1])) for a in side], 64)


def propeller(t):
    """Returns a twisted blade of maximum thickness t with sharp edges."""
    chord, sections = 0.2, 40
    points, rings = [], []
    for s in range(sections + 1):
        x = s / sections
        turn, scale = 0.9 * (1 - x) + 0.2, 1 - 0.6 * x
        ring = []
        for k in range(24):
            a = 2 * math.pi * k / 24
            y, z = 0.5 * chord * scale * math.cos(a), 0.5 * t * math.sin(a) * abs(math.sin(a))
            ring.append(len(points))
            points.append([x, y * math.cos(turn) - z * math.sin(turn), y * math.sin(turn) + z * math.cos(turn)])
        rings.append(ring)
    for x in (0., 1.):
        points.append([x, 0., 0.])
    root, tip = len(points) - 2, len(points) - 1
    facets = facets_between([[root] * 24] + rings + [[tip] * 24], 24)
    return points, facets


def prism(section, cap, length):
    """Returns a prism over a polygon in the (x, z) plane, with the triangles of its front."""
    n = len(section)
    points = [[x, y, z] for y in (0., length) for x, z in section]
    facets = []
    for i in range(n):
        j = (i + 1) % n
        facets += [[i, n + i, n + j], [i, n + j, j]]
    for a, b, c in cap:
        facets += [[a, b, c], [n + a, n + c, n + b]]
    return points, facets


def groove(half_width):
    """Returns a block with a groove that narrows toward its bottom, at 10 % of the box size below the surface."""
    section = [(0., 0.), (1., 0.), (1., 0.4), (0.5 + half_width, 0.4), (0.5, 0.3), (0.5 - half_width, 0.4), (0., 0.4)]
    return prism(section, [(0, 1, 4), (1, 2, 3), (1, 3, 4), (0, 4, 5), (0, 5, 6)], 0.5)


def fin(half_width):
    """Returns a block with a fin that narrows toward its edge, at 10 % of the box size above the surface."""
    section = [(0., 0.), (1., 0.), (1., 0.4), (0.5 + half_width, 0.4), (0.5, 0.5), (0.5 - half_width, 0.4), (0., 0.4)]
    return prism(section, [(0, 1, 3), (1, 2, 3), (3, 4, 5), (0, 3, 5), (0, 5, 6)], 0.5)


def main():
    if len(sys.argv) != 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    models = [(plate, (2, 0.5, 0.1, 0.02)), (plain_plate, (0.1,)), (near_plates, (0.5, 0.1)), (comb, (1, 0.2)), (hollow_box, (1, 0.1)),
              (engraved, (1, 0.1)), (wine_glass, (2, 1, 0.2)), (bowl, (2,)), (propeller, (1, 0.2)), (groove, (1, 0.5, 0.2)), (fin, (1, 0.5, 0.2))]
    for make, percents in models:
        for percent in percents:
            write(os.path.join(folder, f"{make.__name__}_{percent:g}.off"), *make(percent / 100))
    return 0


if __name__ == "__main__":
    sys.exit(main())
