#!/usr/bin/env python3
"""Writes closed meshes with singular vertices and folded edges, for which shells need truncation, as OFF files.

   singular_models.py FOLDER [--cones N]

  cone_0000.off, ...       100 or N parts of a ball on one side of a random polyhedral cone with a singular apex
  cone_tight_00.off, ...   the same, with parts of the cone about 5 degrees apart
  monkey_3.off             a saddle with three ridges, each of which leans over a valley
  pleated_6.off            a fan of six upright pleats, whose apex is nearly singular
  pleated_leaning_6.off    leaning pleats with a singular apex
  eight_faces.off          two opposite octants, joined
  knife_175.off            a blade whose edge has facets with normals that differ by 175 degrees
  spike_2.off              a needle, a cone with an apex angle of two degrees
  double_singular.off      two singular vertices joined by an edge
  singular_on_fold.off     a singular vertex at the end of an edge whose facets' normals differ by 175 degrees

Each mesh is checked to be a closed manifold of genus zero. Vertices that should be singular are checked in exact
arithmetic.
"""
import argparse
import fractions
import itertools
import math
import os
import random
import sys

sys.dont_write_bytecode = True
from thin_models import Blocks, facets_between, revolved, write

EDGE = 0.2
LINK_RADIUS, MIDDLE_RADIUS = 0.3, 0.65


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def unit(a):
    return times(a, 1 / math.sqrt(dot(a, a)))


def det(a, b, c):
    return dot(a, cross(b, c))


def angle(a, b):
    return math.atan2(math.sqrt(dot(cross(a, b), cross(a, b))), dot(a, b))


def on_sphere(latitude, longitude):
    """Returns a point on the unit sphere; angles are in degrees."""
    a, b = math.radians(latitude), math.radians(longitude)
    return (math.cos(a) * math.cos(b), math.cos(a) * math.sin(b), math.sin(a))


def arc_points(p, q, pieces):
    """Returns points that divide a great arc, including its ends."""
    a = angle(p, q)
    inner = [[math.sin(a * (pieces - k) / pieces), math.sin(a * k / pieces)] for k in range(1, pieces)]
    return [p] + [unit(tuple(s * x + t * y for x, y in zip(p, q))) for s, t in inner] + [q]


def arcs_cross(a, b, c, d):
    n, m = cross(a, b), cross(c, d)
    return dot(n, c) * dot(n, d) < 0 and dot(m, a) * dot(m, b) < 0 and dot(n, c) * dot(m, b) > 0


def angle_to_arc(p, a, b):
    n = cross(a, b)
    if dot(cross(n, a), p) > 0 and dot(cross(b, n), p) > 0:
        return abs(math.pi / 2 - angle(n, p))
    return min(angle(p, a), angle(p, b))


def fan(points, facets, v):
    """Returns the exact normals of the facets at a vertex."""
    normals = []
    for f in facets:
        if v in f:
            p, q, r = (tuple(map(fractions.Fraction, points[w])) for w in f)
            normals.append(cross(minus(q, p), minus(r, p)))
    return normals


def is_singular(normals):
    """Returns whether no direction has a positive product with all normals.

    The directions with nonnegative products form a cone. If the normals span space, each extreme ray of the cone is
    orthogonal to two of them. If the cone has inner points, the sum of all extreme rays is one. The normals at all
    vertices considered here span space.
    """
    if not any(det(*n) for n in itertools.combinations(normals, 3)):
        raise ValueError("the facets at a vertex are flat, or form a wedge")
    total = (0, 0, 0)
    for a, b in itertools.combinations(normals, 2):
        ray = cross(a, b)
        for sign in (1, -1):
            if all(sign * dot(n, ray) >= 0 for n in normals):
                total = tuple(t + sign * r for t, r in zip(total, ray))
    return any(dot(n, total) <= 0 for n in normals)


def check_manifold(points, facets):
    """Checks that a mesh is closed, connected, oriented outwards, and of genus zero."""
    after = {}
    for f in facets:
        for i in range(3):
            after.setdefault(f[i], {})
            if f[(i + 1) % 3] in after[f[i]]:
                raise ValueError("an edge has two facets on one side")
            after[f[i]][f[(i + 1) % 3]] = f[(i + 2) % 3]
    if len(after) != len(points) or len(set(map(tuple, points))) != len(points):
        raise ValueError("points are unused or coincident")
    for link in after.values():
        first, steps = next(iter(link)), 1
        w = link[first]
        while w != first and steps <= len(link):
            w, steps = link.get(w), steps + 1
        if steps != len(link):
            raise ValueError("the mesh has a border, or a vertex with several umbrellas")
    reached = [0]
    seen = {0}
    for v in reached:
        for w in after[v]:
            if w not in seen:
                seen.add(w)
                reached.append(w)
    if len(seen) != len(points) or 2 * len(points) - len(facets) != 4:
        raise ValueError("the mesh is not a topological sphere")
    if sum(det(*(points[v] for v in f)) for f in facets) <= 0:
        raise ValueError("the mesh is oriented inwards")


class Sphere_triangulation:
    """An incremental Delaunay triangulation, which on a sphere is the convex hull."""

    def __init__(self, points):
        self.points = list(points)
        self.third = {}
        corners = []
        for way in ((1, 1, 1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1)):
            corners.append(max(range(len(points)), key=lambda v: dot(points[v], way)))
        a, b, c, d = corners
        for f in ((a, b, c), (a, c, d), (a, d, b), (b, d, c)):
            if det(*(points[v] for v in f)) < 0:
                f = (f[0], f[2], f[1])
            self._add(*f)
        if len(self.third) != 12:
            raise ValueError("the first four points do not surround the center")
        self.last = (a, next(w for v, w in self.third if v == a))
        for v in range(len(points)):
            if v not in corners:
                self._insert(v)

    def add_point(self, p):
        self.points.append(p)
        self._insert(len(self.points) - 1)
        return len(self.points) - 1

    def _add(self, a, b, c):
        self.third[a, b], self.third[b, c], self.third[c, a] = c, a, b

    def _remove(self, a, b, c):
        del self.third[a, b], self.third[b, c], self.third[c, a]

    def _locate(self, p):
        a, b = self.last
        for _ in range(len(self.third)):
            c = self.third[a, b]
            for v, w in ((a, b), (b, c), (c, a)):
                if det(self.points[v], self.points[w], p) < -1e-14:
                    a, b = w, v
                    break
            else:
                return a, b, c
        raise ValueError("no triangle contains the point")

    def _insert(self, v):
        p = self.points[v]
        a, b, c = self._locate(p)
        self._remove(a, b, c)
        rim = [(a, b), (b, c), (c, a)]
        while rim:
            a, b = rim.pop()
            c = self.third.get((b, a))
            if c is None:
                raise ValueError("a cavity is not a disc")
            pa, pb, pc = (self.points[w] for w in (a, b, c))
            if det(minus(pb, p), minus(pa, p), minus(pc, p)) < -1e-13:
                self._remove(b, a, c)
                rim += [(a, c), (c, b)]
            else:
                self._add(a, b, v)
        self.last = (a, b)


def grid_on_sphere(polygon_points, generator):
    """Yields points about EDGE apart, not close to the polygon; a random rotation avoids degeneracies."""
    number = round(4 * math.pi / (EDGE ** 2 * math.sqrt(0.75)))
    z = random_direction(generator)
    x = unit(cross(z, random_direction(generator)))
    y = cross(z, x)
    for k in range(number):
        height, turn = 1 - (2 * k + 1) / number, math.pi * (3 - math.sqrt(5)) * k
        r = math.sqrt(1 - height ** 2)
        p = tuple(r * math.cos(turn) * a + r * math.sin(turn) * b + height * c for a, b, c in zip(x, y, z))
        if all(dot(p, q) < math.cos(0.6 * EDGE) for q in polygon_points):
            yield p


def random_direction(generator):
    return on_sphere(math.degrees(math.asin(2 * generator.random() - 1)), 360 * generator.random())


def conforming(corners, generator):
    """Returns a triangulation of the sphere with the polygon's arcs as edges; missing edges are split."""
    arcs = [arc_points(p, q, math.ceil(angle(p, q) / EDGE)) for p, q in zip(corners, corners[1:] + corners[:1])]
    polygon_points = [p for arc in arcs for p in arc[:-1]]
    grid = list(grid_on_sphere(polygon_points, generator))
    sphere = Sphere_triangulation(grid + polygon_points)
    numbers, first = [], len(grid)
    for arc in arcs:
        numbers.append(list(range(first, first + len(arc))))
        first += len(arc) - 1
    numbers[-1][-1] = len(grid)
    for _ in range(10):
        missing = 0
        for n, arc in enumerate(numbers):
            finer = arc[:1]
            for v, w in zip(arc, arc[1:]):
                if (v, w) not in sphere.third:
                    missing += 1
                    finer.append(sphere.add_point(unit(tuple(a + b for a, b in zip(sphere.points[v], sphere.points[w])))))
                finer.append(w)
            numbers[n] = finer
        if missing == 0:
            return sphere, numbers
    raise ValueError("the arcs are too close to each other")


def facets_on_left(sphere, numbers):
    walls = {edge for arc in numbers for edge in zip(arc, arc[1:])}
    facets, todo = set(), list(walls)
    for a, b in todo:
        c = sphere.third[a, b]
        f = min((a, b, c), (b, c, a), (c, a, b))
        if f in facets:
            continue
        facets.add(f)
        for v, w in ((a, b), (b, c), (c, a)):
            if (w, v) in walls:
                raise ValueError("the polygon does not separate the sphere")
            if (v, w) not in walls:
                todo.append((w, v))
    if any(det(*(sphere.points[v] for v in f)) < 1e-8 for f in facets):
        raise ValueError("a facet is degenerate")
    return sorted(facets)


def zipped(points, inner, outer):
    """Returns facets between two polylines in the same direction, with the shorter diagonals."""
    facets, i, j = [], 0, 0
    while i + 1 < len(inner) or j + 1 < len(outer):
        ahead = []
        if i + 1 < len(inner):
            ahead.append((math.dist(points[inner[i + 1]], points[outer[j]]), 1, 0))
        if j + 1 < len(outer):
            ahead.append((math.dist(points[inner[i]], points[outer[j + 1]]), 0, 1))
        _, di, dj = min(ahead)
        facets.append([inner[i], inner[i + di] if di else outer[j + dj], outer[j]])
        i, j = i + di, j + dj
    return facets


def part_of_ball(corners, generator):
    """Returns the part of the ball on the left of the polygon with these corners; the center is vertex 0.

    The center has one facet for each arc: the innermost ring around it consists only of the polygon's corners.
    """
    corners = [unit(p) for p in corners]
    sphere, numbers = conforming(corners, generator)
    on_left = facets_on_left(sphere, numbers)
    points = [(0., 0., 0.)]

    def add(p):
        points.append(p)
        return len(points) - 1

    number = {v: add(sphere.points[v]) for v in sorted({v for f in on_left for v in f})}
    link = [add(times(p, LINK_RADIUS)) for p in corners]
    middle = [add(times(p, MIDDLE_RADIUS)) for p in corners]
    facets = [[number[v] for v in f] for f in on_left]
    for i, p in enumerate(corners):
        k = (i + 1) % len(corners)
        line = arc_points(p, corners[k], math.ceil(MIDDLE_RADIUS * angle(p, corners[k]) / EDGE))
        ring = [middle[i]] + [add(times(q, MIDDLE_RADIUS)) for q in line[1:-1]] + [middle[k]]
        facets.append([0, link[k], link[i]])
        facets += zipped(points, [link[i], link[k]], ring) + zipped(points, ring, [number[v] for v in numbers[i]])
    return points, facets


def random_polygon(size, generator, between_corners, between_arcs):
    """Returns a simple polygon, or None if none is found.

    Angles are in degrees; `between_arcs` is the permitted range of the least angle between a corner and another arc.
    """
    corners = []
    for _ in range(50 * size):
        p = random_direction(generator)
        if all(angle(p, q) > math.radians(between_corners) for q in corners):
            corners.append(p)
        if len(corners) == size:
            break
    else:
        return None

    def arcs():
        return list(zip(corners, corners[1:] + corners[:1]))

    for _ in range(100):
        crossing = next((pair for pair in itertools.combinations(range(size), 2) if arcs_cross(*arcs()[pair[0]], *arcs()[pair[1]])), None)
        if crossing is None:
            break
        i, j = crossing
        corners[i + 1:j + 1] = corners[i + 1:j + 1][::-1]
    else:
        return None
    if max(angle(p, q) for p, q in arcs()) > math.radians(130):
        return None
    nearest = min(angle_to_arc(p, a, b) for p in corners for a, b in arcs() if p not in (a, b))
    return corners if between_arcs[0] < math.degrees(nearest) < between_arcs[1] else None


def cone(number, between_corners, between_arcs):
    """Returns a cone of at least six facets: thousands of random ones with four or five were not singular."""
    generator = random.Random(f"{number} {between_corners}")
    while True:
        corners = random_polygon(6 + number % 5, generator, between_corners, between_arcs)
        if not corners or not is_singular([tuple(map(fractions.Fraction, cross(q, p))) for p, q in zip(corners, corners[1:] + corners[:1])]):
            continue
        try:
            mesh = part_of_ball(corners, generator)
        except ValueError:
            continue
        # Rounding of points may make a difference.
        if is_singular(fan(*mesh, 0)):
            return mesh


def zigzag(ridges, latitude, lean):
    """Returns a saddle with ridges and valleys; above the polygon is outside.

    By symmetry, a common direction of the facets would have to be the axis. If `lean`, in degrees, is positive, the
    facets on one side of each ridge face up, and those on the other side face down.
    """
    corners = []
    for k in range(ridges):
        corners += [on_sphere(-latitude, 360 * (k - 0.5) / ridges - lean / 2), on_sphere(latitude, 360 * k / ridges + lean / 2)]
    # The inside is below, so it is on the left in westward direction.
    return part_of_ball(corners[::-1], random.Random(ridges))


def monkey(ridges):
    return zigzag(ridges, 30, 180 / ridges + 10)


def pleated(pleats):
    return zigzag(pleats, 65, 0)


def pleated_leaning(pleats):
    return zigzag(pleats, 60, 180 / pleats * 1.3)


def joined_octants():
    """Returns the positive and the negative octant, each with a corner cut off, and a bridge between the cuts."""
    return [(1, 0, 0), (0, 1, 0), on_sphere(65, 90), on_sphere(-25, 180), (0, 0, -1), (0, -1, 0), on_sphere(0, 205), on_sphere(65, 0)]


def eight_faces():
    return part_of_ball(joined_octants(), random.Random(8))


def singular_on_fold():
    """Returns joined octants with a blade of 5 degrees on a face, which adds normals: the apex remains singular."""
    corners = joined_octants()
    half = math.degrees(math.atan(math.sin(math.radians(50)) * math.tan(math.radians(2.5))))
    corners[1:1] = [on_sphere(0, 45 - half), on_sphere(-50, 45), on_sphere(0, 45 + half)]
    return part_of_ball(corners, random.Random(11))


def double_singular():
    """Returns a staircase of cubes that turns around an edge and passes over itself.

    A slight twist prevents exactly opposite normals.
    """
    side = [0., 0.5, 1., 1.5, 2.]
    blocks = Blocks(side, side, [0., 0.5, 1., 1.5, 2., 2.5])
    for low, high, cells in ((0., 1., ((0, 0), (1, 0), (1, 1))), (1., 1.5, ((1, 1),)), (1.5, 2.5, ((1, 1), (0, 1), (0, 0)))):
        for x, y in cells:
            blocks.add((float(x), float(y), low), (x + 1., y + 1., high))
    points, facets = blocks.mesh()
    twisted = []
    for x, y, z in points:
        turn = 0.2 * (z - 1.25)
        x, y = x - 1, y - 1
        twisted.append((x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn), z))
    ends = [min(range(len(points)), key=lambda v: math.dist(points[v], (1, 1, z))) for z in (1, 1.5)]
    if not any(set(ends) <= set(f) for f in facets):
        raise ValueError("no facet contains both singular vertices")
    return twisted, facets, ends


def knife(angle_of_normals):
    """Returns a blade of length 1 with its edge up. It is high enough for a base of 2 percent, but at most 1.2."""
    half = math.tan(math.radians(180 - angle_of_normals) / 2)
    height = min(max(0.4, 0.01 / half), 1.2)
    rows, columns = round(height / 0.05), 20
    section = [(0., 0.)] + [(-k * height / rows * half, -k * height / rows) for k in range(1, rows + 1)]
    section += [(-x, z) for x, z in section[:0:-1]]
    size = len(section)
    points = [(x, y / columns, z) for y in range(columns + 1) for x, z in section]
    rings = [range(y * size, (y + 1) * size) for y in range(columns + 1)]
    facets = [f[::-1] for f in facets_between(rings, size)]
    for ring, turned in ((rings[0], False), (rings[-1], True)):
        cap = [[ring[0], ring[1], ring[-1]]]
        for k in range(1, rows):
            cap += [[ring[k], ring[k + 1], ring[-k - 1]], [ring[k], ring[-k - 1], ring[-k]]]
        facets += [f[::-1] if turned else f for f in cap]
    return points, facets


def spike(apex_angle):
    """Returns a needle of length 1 on a ball of diameter 1. Rings get closer towards the root and the tip."""
    slope = math.tan(math.radians(apex_angle) / 2)
    polar = [math.pi, 2.7, 2.3, 1.9]
    root = math.asin(2 * slope)
    number = math.ceil(math.log(math.pi / 2 / root) / math.log(1.4))
    polar += [math.pi / 2 * (2 * root / math.pi) ** (k / number) for k in range(number + 1)]
    profile = [(0., -0.5)] + [(0.5 * math.sin(a), 0.5 * math.cos(a)) for a in polar[1:-1]]
    top = 0.5 * math.cos(root) + 1
    profile += [(slope * 0.7 ** k, top - 0.7 ** k) for k in range(9)] + [(0., top)]
    return revolved(profile, 16)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--cones", type=int, default=100, metavar="N")
    arguments = parser.parse_args()
    os.makedirs(arguments.folder, exist_ok=True)

    def save(name, points, facets, singular=()):
        check_manifold(points, facets)
        for v in singular:
            if not is_singular(fan(points, facets, v)):
                raise ValueError(f"{name}.off: a vertex that should be singular is not")
        write(os.path.join(arguments.folder, name + ".off"), points, facets)

    for number in range(arguments.cones):
        save(f"cone_{number:04d}", *cone(number, 20, (10, 180)), [0])
    for number in range(10):
        save(f"cone_tight_{number:02d}", *cone(number, 10, (5, 6)), [0])
    for ridges in range(3, 9):
        save(f"monkey_{ridges}", *monkey(ridges), [0])
    for pleats in (6, 10, 16, 24):
        save(f"pleated_{pleats}", *pleated(pleats))
        save(f"pleated_leaning_{pleats}", *pleated_leaning(pleats), [0])
    for angle_of_normals in (170, 175, 178, 179, 179.5, 179.9):
        save(f"knife_{angle_of_normals:g}", *knife(angle_of_normals))
    for apex_angle in (5, 2, 1, 0.3):
        save(f"spike_{apex_angle:g}", *spike(apex_angle))
    save("double_singular", *double_singular())
    save("singular_on_fold", *singular_on_fold(), [0])
    save("eight_faces", *eight_faces(), [0])
    return 0


if __name__ == "__main__":
    sys.exit(main())
