"""Draws direction fields on meshes by evenly spaced streamlines, and their singularities."""
import numpy as np
import vtk
from matplotlib.lines import Line2D
from vtk.util.numpy_support import numpy_to_vtk

from palette import FACET, INNER, OUTER, figure, save
from rendering import balls, edges, fit, polydata, render, show, surface, tubes

LINE, EDGE = "#1f5a78", "#a39d90"
DISTANCE, LENGTH = 0.016, 0.35      # spacing of streamlines and length of their halves, relative to the box size
SEEDS = 8000
SEED = 1                # seed of the random numbers


def read_field(name):
    """Reads points, triangles, vectors of facets, and positions and indices of singularities from an ASCII file."""
    with open(name) as rows:
        elements = []
        for row in rows:
            words = row.split()
            if words[0] == "element":
                elements.append((int(words[2]), []))
            elif words[0] == "property":
                elements[-1][1].append(words[-1])
            elif words[0] == "end_header":
                break
        (vertices, of_vertex), (facets, of_facet) = elements
        points = np.array([next(rows).split() for _ in range(vertices)], float)
        polygons = np.array([next(rows).split() for _ in range(facets)], float)
    index = points[:, of_vertex.index("singularity")].astype(int)
    column = 3 + of_facet.index("field_x")          # the list of vertices has four numbers
    return points[:, :3], polygons[:, 1:4].astype(int), polygons[:, column:column + 3], points[index != 0, :3], index[index != 0]


def dot(a, b):
    return (a * b).sum(axis=-1)


def unit(v):
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-300)


class Flow:
    """A field on a closed mesh: N-th powers at corners, interpolated on each facet; continuous up to the angles between facets."""

    def __init__(self, points, triangles, vectors, directions):
        self.directions = directions
        self.origins = points[triangles[:, 0]]
        self.normals = unit(np.cross(points[triangles[:, 1]] - self.origins, points[triangles[:, 2]] - self.origins))
        x = unit(points[triangles[:, 1]] - self.origins)
        self.axes = np.stack([x, np.cross(self.normals, x)], axis=1)
        # Each facet has its corners in its plane, and the directions and inward normals of its edges.
        self.corners = np.einsum("fij,fcj->fci", self.axes, points[triangles] - self.origins[:, None])
        sides = np.roll(self.corners, -1, axis=1) - self.corners
        self.sides = unit(sides)
        self.inwards = np.stack([-self.sides[..., 1], self.sides[..., 0]], axis=-1)
        self.heights = dot(self.inwards, np.roll(self.corners, -2, axis=1) - self.corners)
        self.areas = np.linalg.norm(sides[:, 0], axis=-1) * self.heights[:, 0] / 2
        self._connect(triangles)
        self._interpolate(triangles, vectors, sides)

    def _connect(self, triangles):
        """Stores the neighbor across each edge, and the index of the edge in the neighbor."""
        ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1).reshape(-1, 2)
        order = np.lexsort(np.sort(ends, axis=1).T)         # makes the two sides of an edge neighbors
        other = np.empty(len(ends), int)
        other[order[::2]], other[order[1::2]] = order[1::2], order[::2]
        self.across = np.stack(np.divmod(other, 3), axis=-1).reshape(-1, 3, 2)

    def _interpolate(self, triangles, vectors, sides):
        """Stores, at each corner, the mean of the facets at the vertex, weighted by angles and rotated into the plane of the facet."""
        angles = np.arccos(np.clip(-dot(unit(sides), np.roll(unit(sides), 1, axis=1)), -1, 1)).ravel()
        corners = np.argsort(triangles.ravel(), kind="stable")
        valence = np.bincount(triangles.ravel())
        first = np.cumsum(valence) - valence
        of_corner = valence[triangles.ravel()]              # facets at its vertex
        corner = np.repeat(np.arange(triangles.size), of_corner)
        rank = np.arange(len(corner)) - np.repeat(np.cumsum(of_corner) - of_corner, of_corner)
        other = corners[first[triangles.ravel()[corner]] + rank]
        f, g = corner // 3, other // 3
        v, n, m = vectors[g], self.normals[g], self.normals[f]
        axis = np.cross(n, m)
        rotated = v + np.cross(axis, v) + np.cross(axis, np.cross(axis, v)) / np.maximum(1 + dot(n, m), 1e-6)[:, None]
        z = dot(self.axes[f, 0], rotated) + 1j * dot(self.axes[f, 1], rotated)
        length = np.abs(z)
        powers = np.zeros(triangles.size, complex)
        np.add.at(powers, corner, angles[other] * length * (z / np.maximum(length, 1e-300))**self.directions)
        self.powers = powers.reshape(-1, 3)

    def direction(self, f, p, last, powers):
        """Returns the one of the N directions of the field that is closest to the last direction."""
        weights = np.roll(dot(self.inwards[f], p[:, None] - self.corners[f]) / self.heights[f], -1, axis=1)
        full = 2 * np.pi / self.directions
        angle = np.angle((weights * powers[f]).sum(axis=1)) / self.directions
        angle += full * np.rint((np.arctan2(last[:, 1], last[:, 0]) - angle) / full)
        return np.stack([np.cos(angle), np.sin(angle)], axis=-1)

    def in_space(self, f, v):
        return np.einsum("fi,fij->fj", v, self.axes[f])

    def trace(self, f, p, d, sign, length, step):
        """Traces lines along the field, or against it, from points in facets. Returns arrays of points, directions, and normals for each line."""
        powers = self.powers * float(sign)**self.directions
        line, passed, stuck = np.arange(len(f)), np.zeros(len(f)), np.zeros(len(f), int)
        places, d, number = [], sign * d, len(f)
        while len(line):
            last, d = d, self.direction(f, p, d, powers)
            places.append((line, self.origins[f] + self.in_space(f, p), self.in_space(f, d), self.normals[f]))
            # the field turns fast only at singularities
            keep = (dot(d, last) > 0.5) & (passed < length) & (stuck < 4)
            f, p, d, line, passed, stuck = (values[keep] for values in (f, p, d, line, passed, stuck))
            rate = dot(self.inwards[f], d[:, None])
            away = np.maximum(dot(self.inwards[f], p[:, None] - self.corners[f]), 0)
            until = np.where(rate < 0, away / np.where(rate < 0, -rate, 1), np.inf)
            edge, until = until.argmin(axis=1), until.min(axis=1)
            move = np.minimum(until, step)
            p, passed, stuck = p + move[:, None] * d, passed + move, np.where(move < 1e-6 * step, stuck + 1, 0)
            # into the plane of the next facet, around the edge
            out = np.flatnonzero(until <= step)
            there = self.origins[f[out]] + self.in_space(f[out], p[out])
            along, across = (dot(d[out], vectors[f[out], edge[out]])[:, None] for vectors in (self.sides, self.inwards))
            f[out], edge[out] = self.across[f[out], edge[out]].T
            p[out] = np.einsum("fij,fj->fi", self.axes[f[out]], there - self.origins[f[out]])
            d[out] = -along * self.sides[f[out], edge[out]] - across * self.inwards[f[out], edge[out]]
        line, *values = (np.concatenate(parts) for parts in zip(*places))
        order = np.argsort(line, kind="stable")
        ends = np.cumsum(np.bincount(line, minlength=number))[:-1]
        return list(zip(*(np.split(v[order], ends) for v in values)))


class Crowd:
    """A search structure for points on lines, with the cells of a grid."""

    def __init__(self, size):
        self.size = size
        self.cells = {}

    def cell(self, p):
        return tuple(int(c // self.size) for c in p)

    def add(self, places):
        for place in zip(*places):
            self.cells.setdefault(self.cell(place[0]), []).append(place)

    def is_near(self, p, direction, normal, distance):
        """Returns whether there is a nearly parallel line on the same side within this distance, at most the size of a cell."""
        i, j, k = self.cell(p)
        for cell in ((i + a, j + b, k + c) for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)):
            for q, other_direction, other_normal in self.cells.get(cell, ()):
                r = p - q
                if r @ r < distance**2 and abs(direction @ other_direction) > 0.7 and normal @ other_normal > 0:
                    return True
        return False


def thinned(places, distance):
    """Returns a line whose points have about this distance from each other."""
    passed = np.cumsum(np.linalg.norm(np.diff(places[0], axis=0), axis=1)) // distance
    kept = np.concatenate([[0], 1 + np.flatnonzero(np.diff(passed, prepend=0))])
    return [values[kept] for values in places]


def streamlines(flow, size):
    """Returns lines that begin at least DISTANCE from all others, and end where they would come closer than half of it."""
    random = np.random.default_rng(SEED)
    distance = DISTANCE * size
    f = random.choice(len(flow.areas), SEEDS, p=flow.areas / flow.areas.sum())
    r, s = np.sqrt(random.random(SEEDS)), random.random(SEEDS)
    p = np.einsum("fc,fcj->fj", np.stack([1 - r, r * (1 - s), r * s], axis=-1), flow.corners[f])
    angle = random.random(SEEDS) * 2 * np.pi
    d = flow.direction(f, p, np.stack([np.cos(angle), np.sin(angle)], axis=-1), flow.powers)
    halves = zip(*(flow.trace(f, p, d, sign, LENGTH * size, 0.2 * distance) for sign in (1, -1)))
    crowd, lines = Crowd(distance), []
    for half in halves:
        first = [values[0] for values in half[0]]
        if crowd.is_near(*first, distance):
            continue
        parts = []
        for places in half:
            places = thinned(places, 0.2 * distance)
            until = next((n for n, place in enumerate(zip(*places)) if crowd.is_near(*place, distance / 2)), None)
            parts.append([values[:until] for values in places])
        line = [np.concatenate([b[:0:-1], a]) for a, b in zip(*parts)]
        if len(line[0]) > 10:
            crowd.add(line)
            lines.append(line[0])
    return lines


def arrows(lines, color, size):
    """Returns cones in the middle of the lines."""
    middles = [(line[len(line) // 2], line[len(line) // 2 + 1] - line[len(line) // 2]) for line in lines]
    data = polydata([p for p, _ in middles])
    data.GetPointData().SetVectors(numpy_to_vtk(np.array([d for _, d in middles]), deep=True))
    cone = vtk.vtkConeSource()
    cone.SetResolution(12)
    cone.SetHeight(size)
    cone.SetRadius(0.38 * size)
    glyph = vtk.vtkGlyph3D()
    glyph.SetInputData(data)
    glyph.SetSourceConnection(cone.GetOutputPort())
    glyph.SetVectorModeToUseVector()
    glyph.SetScaleModeToDataScalingOff()
    glyph.Update()
    actor = surface(glyph.GetOutput(), color)
    actor.GetProperty().SetInterpolationToGouraud()
    return actor


def draw_fields(rows_of_panels, picture):
    """Draws rows of two panels. Each row: number of directions, folder of the output of transfer_direction_field, direction of view, and up."""
    size = 650, 560
    fig, rows = figure(len(rows_of_panels), 2, 420 * len(rows_of_panels))
    for axes, (directions, prefix, direction, up) in zip(rows, rows_of_panels):
        view = None
        for ax, part, what in zip(axes, ("", "_simplified"), ("mesh", "simplified")):
            points, triangles, vectors, places, indices = read_field(f"{prefix}/direction_field{part}.ply")
            mesh = polydata(points, polygons=triangles)
            view = view or fit(mesh, size, direction, up)
            box = np.ptp(points, axis=0).max()
            lines = streamlines(Flow(points, triangles, vectors, directions), box)
            actors = [surface(mesh, FACET, ambient=0.4), tubes(lines, LINE, 0.0014 * box)]
            if part:
                actors.append(edges(mesh, EDGE, 0.8))
            if directions == 1:
                actors.append(arrows(lines, LINE, 0.02 * box))
            actors += [balls(places[chosen], color, 0.012 * box) for chosen, color in ((indices > 0, OUTER), (indices < 0, INNER)) if chosen.any()]
            show(ax, render(actors, size, *view), f"{what}: {len(triangles)} facets, {len(indices)} singularities")
    fig.subplots_adjust(0.005, 0.05, 0.995, 0.965, 0.02, 0.08)
    fig.legend(handles=[Line2D([], [], color=LINE, lw=2, label="streamlines"),
                        Line2D([], [], color=OUTER, marker="o", ls="", ms=8, label="singularities of positive index"),
                        Line2D([], [], color=INNER, marker="o", ls="", ms=8, label="of negative index")],
               loc="lower center", ncol=3, frameon=False)
    save(fig, picture)
