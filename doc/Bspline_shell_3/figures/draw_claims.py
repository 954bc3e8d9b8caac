#!/usr/bin/python3
"""Draws two-dimensional examples in which a claim of the certificate fails, with level sets and integral curves.

Usage: draw_claims.py PICTURE.png
"""
import sys

import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon, Rectangle

from palette import CELL, CURVE, FAILURE, INNER, MESH, OUTER, SHELL, figure, save

STEP = 0.004        # along integral curves


def unit(v):
    return v / max(np.hypot(*v), 1e-12)


def empty_axes(axes, window):
    axes.set(xlim=window[:2], ylim=window[2:], aspect="equal", xticks=[], yticks=[])
    for side in axes.spines.values():
        side.set_visible(False)


def title(axes, claim, what):
    axes.set_title(claim, fontweight="bold", fontsize=11, pad=3)
    axes.set_xlabel(what, fontsize=10, labelpad=4)


def draw_arrow(axes, source, target, color, size=9, zorder=3, width=0):
    axes.annotate("", target, source, zorder=zorder,
                  arrowprops={"arrowstyle": "-|>", "color": color, "lw": width, "mutation_scale": size, "shrinkA": 0, "shrinkB": 0})


class Panel:
    """A shell in the plane: a function, two thresholds, which are functions or numbers, and a domain."""

    def __init__(self, axes, window, f, inner, outer, domain=lambda x, y: x == x):
        self.axes, self.f, self.domain = axes, f, domain
        self.above_inner = lambda x, y: f(x, y) - (inner(x, y) if callable(inner) else inner)
        self.below_outer = lambda x, y: (outer(x, y) if callable(outer) else outer) - f(x, y)
        empty_axes(axes, window)
        x, y = np.meshgrid(np.linspace(*window[:2], 600), np.linspace(*window[2:], 600))
        levels = [np.where(domain(x, y), g(x, y), np.nan) for g in (self.above_inner, self.below_outer)]
        axes.contourf(x, y, np.minimum(*levels), [0, 1e9], colors=[SHELL], zorder=1)
        for level, color in zip(levels, (INNER, OUTER)):
            axes.contour(x, y, level, [0], colors=[color], linewidths=1.8, zorder=4)

    def contains(self, p):
        return self.domain(*p) and self.above_inner(*p) >= 0 and self.below_outer(*p) >= 0

    def gradient(self, p):
        h = 1e-5
        return np.array([self.f(p[0] + h, p[1]) - self.f(p[0] - h, p[1]), self.f(p[0], p[1] + h) - self.f(p[0], p[1] - h)]) / (2 * h)

    def curve(self, start, keep=None):
        """Returns the integral curve through a point, by the midpoint rule, up to where `keep` is false (default: outside the shell)."""
        keep = keep or self.contains
        halves = []
        for step in (-STEP, STEP):
            p, points = np.array(start, float), []
            while True:
                g = self.gradient(p + step / 2 * unit(self.gradient(p)))
                p = p + step * unit(g)
                if np.hypot(*g) < 0.01 or not keep(p):
                    break
                points.append(p)
            halves.append(points)
        return np.array([*halves[0][::-1], start, *halves[1]])

    def draw_curve(self, curve, lines, color):
        """Draws a curve with an arrow at its end, and dots where it crosses lines."""
        self.axes.plot(*curve.T, color=color, lw=1.3, zorder=3)
        draw_arrow(self.axes, curve[-8], curve[-1], color)
        hits = [h for line in lines for h in crossings(curve, line)]
        if hits:
            self.axes.plot(*np.transpose(hits), "o", color=color, mec="white", mew=0.5, ms=4.8, zorder=6)

    def draw_mesh(self, points):
        self.axes.plot(*np.transpose(points), "-o", color=MESH, lw=1.8, ms=3.2, zorder=5)


def crossings(curve, line):
    """Returns the points where two polygonal lines cross."""
    hits = []
    a, b = curve[:-1], curve[1:]
    for p, q in zip(line[:-1], line[1:]):
        d, e, r = b - a, np.subtract(q, p), np.subtract(p, a)
        det = d[:, 0] * e[1] - d[:, 1] * e[0]
        with np.errstate(divide="ignore", invalid="ignore"):
            s = (r[:, 0] * e[1] - r[:, 1] * e[0]) / det
            t = (r[:, 0] * d[:, 1] - r[:, 1] * d[:, 0]) / det
        for n in np.flatnonzero((s >= 0) & (s < 1) & (t >= 0) & (t < 1)):
            hits.append(a[n] + s[n] * d[n])
    return hits


# a strip, with f = y - wave, and a mesh in it
WINDOW = (-1.5, 1.5, -0.75, 0.95)


def wave(x):
    return 0.22 * np.sin(1.9 * x)


def strip(x, y):
    return y - wave(x)


def on_strip(x, level):
    return np.array([x, wave(x) + level])


LEVELS = [(-1.7, 0.02), (-1.25, -0.08), (-0.8, 0.1), (-0.35, -0.05), (0.05, 0.08), (0.5, -0.1), (0.95, 0.06), (1.35, -0.06), (1.7, 0.03)]


def strip_mesh(levels):
    return np.array([on_strip(*v) for v in levels])


def draw_on_strip(panel, mesh, fails):
    panel.draw_mesh(mesh)
    for x in np.linspace(-1.35, 1.35, 11):
        curve = panel.curve(on_strip(x, 0))
        panel.draw_curve(curve, [mesh], FAILURE if fails(curve) else CURVE)


def all_hold(axes):
    draw_on_strip(Panel(axes, WINDOW, strip, -0.4, 0.4), strip_mesh(LEVELS), lambda curve: False)
    title(axes, "All claims hold", "each curve in the shell meets\nthe mesh in exactly one point")


def containment(axes):
    mesh = strip_mesh([*LEVELS[:3], (-0.25, 0.58), (0.25, 0.68), *LEVELS[5:]])
    draw_on_strip(Panel(axes, WINDOW, strip, -0.4, 0.4), mesh, lambda curve: not crossings(curve, mesh))
    points = np.concatenate([np.linspace(p, q, 200) for p, q in zip(mesh[:-1], mesh[1:])])
    axes.plot(*points[strip(*points.T) > 0.4].T, color=FAILURE, lw=2.6, zorder=6)
    title(axes, "P1, containment", "curves leave the shell\nbefore they meet the mesh")


def transversality(axes):
    mesh = strip_mesh([*LEVELS[:2], (-0.9, 0.05), (0.4, 0.25), (-0.4, -0.25), (0.9, -0.03), *LEVELS[7:]])
    draw_on_strip(Panel(axes, WINDOW, strip, -0.4, 0.4), mesh, lambda curve: len(crossings(curve, mesh)) != 1)
    for n, t in ((2, 0.55), (3, 0.7), (4, 0.45)):         # the facets of the fold, with normals
        (p, q), color = mesh[n:n + 2], FAILURE if n == 3 else MESH
        axes.plot(*mesh[n:n + 2].T, color=color, lw=2.6 if n == 3 else 1.8, zorder=5)
        foot, normal = (1 - t) * p + t * q, unit(np.array([p[1] - q[1], q[0] - p[0]]))
        draw_arrow(axes, foot, foot + 0.19 * normal, color, 10, 7, 1.6)
    title(axes, "P2, transversality", "a facet faces against the gradient:\ncurves meet the mesh three times")


def critical_point(axes):
    # walls at x = g(y) and -g(y), with a gap between them in which f is positive
    def g(y):
        return 0.42 + 0.75 * y**2

    def f(x, y):
        return (g(y)**2 - x**2) / (2 * g(y))

    panel = Panel(axes, WINDOW, f, -0.28, 0.29)
    walls = []
    for side in (-1, 1):
        y = np.array([-1.0, -0.72, -0.45, -0.15, 0.15, 0.42, 0.7, 1.05]) + 0.04 * side
        walls.append(np.stack([side * g(y), y], axis=1))
        panel.draw_mesh(walls[-1])
    for side in (-1, 1):
        for y in (-0.62, -0.46, -0.3, -0.15, 0.15, 0.3, 0.46, 0.62):
            panel.draw_curve(panel.curve((side * g(y), y)), walls, CURVE)
        panel.draw_curve(panel.curve((side * g(0), 0)), walls, FAILURE)
        panel.draw_curve(panel.curve((0, side * 0.02)), [], FAILURE)
    axes.plot(0, 0, "*", color=FAILURE, ms=15, mec="white", mew=0.8, zorder=7)
    title(axes, "P3, gradient", "curves end where the gradient\nis zero, and others begin there")


def end_of_domain(axes):
    size, step, low, high = 0.3, -0.3, 0.4, 1.0         # cell size; the domain ends at `high` before `step`, and at `low` behind it

    def domain(x, y):
        return y < np.where(np.asarray(x) < step, high, low)

    panel = Panel(axes, WINDOW, strip, -0.4, 0.4, domain)
    cells = [Rectangle((x, y), size, size) for x in np.arange(-1.5, 1.4, size) for y in np.arange(-0.8, 0.9, size)
             if domain(x + size / 2, y + size / 2)]
    axes.add_collection(PatchCollection(cells, facecolor="none", edgecolor=CELL, linewidth=0.8, zorder=2))
    draw_on_strip(panel, strip_mesh(LEVELS), lambda curve: strip(*curve[-1]) < 0.4 - 2 * STEP)
    x = np.linspace(step, 1.5, 500)
    axes.plot(np.where(np.abs(strip(x, low)) < 0.4, x, np.nan), np.full(len(x), low), color=FAILURE, lw=2.6, zorder=4)
    title(axes, "P3, domain", "the shell reaches the boundary of\nthe domain: curves are cut off")


def overhang(axes):
    def outer(x, y):
        return 0.18 + 0.26 * (1 + np.tanh(7 * (x + 2.3 * (y - wave(x) - 0.18) - 0.6)))

    def leaves_and_returns(curve):
        longer = panel.curve(curve[1], lambda p: curve[0][1] <= p[1] < WINDOW[3])
        inside = np.array([panel.contains(p) for p in longer])
        first, last = np.argmin(inside), len(inside) - 1 - np.argmax(inside[::-1])       # ends of the part inside
        if first < last:
            axes.plot(*longer[first:last].T, color=FAILURE, lw=1.3, ls=":", zorder=3)
        return first < last

    panel = Panel(axes, WINDOW, strip, -0.4, outer)
    draw_on_strip(panel, strip_mesh(LEVELS), leaves_and_returns)
    title(axes, "P3, thresholds", "the threshold grows faster than f:\ncurves leave and come back")


def ring(x, y):
    return np.hypot(x / 1.25, y) * 0.78 - 0.5


def on_ring(angle, level):
    r = (level + 0.5) / 0.78
    return np.array([1.25 * r * np.cos(angle), r * np.sin(angle)])


RING_WINDOW = (-1.5, 1.5, -0.92, 0.92)


def two_sheets(axes):
    panel = Panel(axes, RING_WINDOW, ring, -0.22, 0.19)
    meshes = [np.array([on_ring(2 * np.pi * k / n + 0.1, level + 0.01 * (-1)**k) for k in range(n + 1)])
              for n, level in ((14, -0.09), (18, 0.09))]
    for mesh in meshes:
        panel.draw_mesh(mesh)
    for angle in np.arange(0.2, 2 * np.pi, 2 * np.pi / 14):
        panel.draw_curve(panel.curve(on_ring(angle, 0)), meshes, FAILURE)
    title(axes, "P4, one sheet", "each curve meets\ntwo components of the mesh")


def degree_two(axes):
    panel = Panel(axes, RING_WINDOW, ring, -0.22, 0.19)
    n = 30
    mesh = np.array([on_ring(4 * np.pi * k / n + 0.3, 0.1 * np.cos(2 * np.pi * k / n + 0.5)) for k in range(n + 1)])
    panel.draw_mesh(mesh)
    for angle in np.arange(0.2, 2 * np.pi, 2 * np.pi / 14):
        panel.draw_curve(panel.curve(on_ring(angle, 0)), [mesh], FAILURE)
    title(axes, "P5, degree one", "the mesh winds around twice:\neach curve meets it twice")


def fan(axes):
    empty_axes(axes, RING_WINDOW)
    n = 9
    angles = 4 * np.pi * np.arange(n + 1) / n + 0.6
    radii = np.where(np.arange(n + 1) % n < n / 2, 0.86, 0.56)
    link = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)
    for p, q in zip(link[:-1], link[1:]):
        axes.add_patch(Polygon([(0, 0), p, q], facecolor=MESH, alpha=0.12, edgecolor="none", zorder=1))
        axes.plot([0, p[0]], [0, p[1]], color=MESH, lw=1.3, zorder=3)
    axes.plot(*link.T, "-o", color=MESH, lw=1.8, ms=3.2, zorder=3)
    t = np.linspace(0, 4 * np.pi, 200)
    spiral = np.stack([(0.42 - 0.018 * t) * np.cos(t + 0.6), (0.42 - 0.018 * t) * np.sin(t + 0.6)], axis=1)
    axes.plot(*spiral[:-4].T, color=FAILURE, lw=1.6, zorder=4)
    draw_arrow(axes, spiral[-6], spiral[-1], FAILURE, 12, 4)
    axes.plot(0, 0, "o", color=MESH, ms=6, zorder=5)
    title(axes, "P5, at a vertex", "its facets, seen along the curves,\nwind around it twice")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    fig, axes = figure(3, 3, 800)
    panels = all_hold, containment, transversality, critical_point, end_of_domain, overhang, two_sheets, degree_two, fan
    for draw, ax in zip(panels, axes.flat):
        draw(ax)
    fig.subplots_adjust(0.005, 0.095, 0.995, 0.97, 0.05, 0.32)
    fig.legend(handles=[Line2D([], [], color=MESH, marker="o", ms=3.2, lw=1.8, label="mesh"),
                        Line2D([], [], color=INNER, lw=2, label="inner surface"), Line2D([], [], color=OUTER, lw=2, label="outer surface"),
                        Line2D([], [], color=CURVE, lw=1.6, label="integral curve"),
                        Line2D([], [], color=FAILURE, lw=2.6, label="failure")],
               loc="lower center", ncol=5, frameon=False, handlelength=1.6, columnspacing=1.8)
    save(fig, sys.argv[1])
