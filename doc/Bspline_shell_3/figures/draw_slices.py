#!/usr/bin/python3
"""Draws cross sections of shells: a threshold that is narrowed at a gap, and the rounds of refinement.

Usage: draw_slices.py PREFIX PICTURES
"""
import glob
import sys

import numpy as np
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from palette import CELL, CURVE, FAILURE, INNER, MESH, OUTER, SHELL, figure, save
from slices import Slice, section

Z = 0.0                 # height of the plane
NEAR = 0.02             # largest distance of shown points from the plane; smaller than a cell
BODY = (-0.335, 0.335, -0.55, 0.552)        # windows
GAP = (-0.085, 0.085, -0.518, -0.375)


class Section:
    """The cross section of a shell after a round of refinement, with the plane z = Z."""

    def __init__(self, prefix, round_):
        self.field, self.inner, self.outer = (Slice(f"{prefix}_{round_}_{part}.vtu", 2, Z) for part in ("field", "inner", "outer"))
        self.mesh = section(f"{prefix}_mesh.ply", 2, Z)
        with open(f"{prefix}_{round_}_numbers.txt") as numbers:
            *counts, self.thickness = numbers.read().split()
        self.cells, self.thick, self.undecided = map(int, counts)
        self.thickness = float(self.thickness)
        with open(f"{prefix}_{round_}_failures.txt") as points:
            self.failures = np.array(points.read().split(), float).reshape(-1, 3)

    def squares(self, keep=None):
        return [Rectangle(c, w, w) for n, (c, w) in enumerate(zip(self.field.corner, self.field.width)) if keep is None or keep[n]]

    def split_in(self, finer):
        """Returns which cells of the section are split in a finer one."""
        there = {(*c, w) for c, w in zip(finer.field.corner, finer.field.width)}
        return [(*c, w) not in there for c, w in zip(self.field.corner, self.field.width)]

    def draw(self, axes, window, pixels, width=1.0, shading=None):
        x, y, f = self.field.raster(window, pixels)
        inner, outer = self.inner.raster(window, pixels)[2], self.outer.raster(window, pixels)[2]
        is_in_shell = (f > inner) & (f < outer)
        axes.add_collection(PatchCollection(self.squares(), facecolor="none", edgecolor=CELL, linewidth=0.5, zorder=2))
        if shading is None:
            shown = axes.contourf(x, y, np.minimum(f - inner, outer - f), [0, 1e9], colors=[SHELL], zorder=1)
        else:
            relative = np.where(is_in_shell, (outer - inner) / self.thickness, np.nan)
            shown = axes.imshow(relative, origin="lower", extent=window, cmap=shading, vmin=0, vmax=1, zorder=1, interpolation="nearest")
        axes.contour(x, y, f - inner, [0], colors=[INNER], linewidths=width, zorder=4)
        axes.contour(x, y, f - outer, [0], colors=[OUTER], linewidths=width, zorder=4)
        axes.add_collection(LineCollection(self.mesh, colors=MESH, linewidths=width, zorder=4))
        axes.set(xlim=window[:2], ylim=window[2:], aspect="equal", xticks=[], yticks=[])
        return shown, (x, y, f)


def legend(figure, more, **options):
    figure.legend(handles=[Line2D([], [], color=INNER, lw=2, label="inner surface"), Line2D([], [], color=MESH, lw=2, label="mesh"),
                           Line2D([], [], color=OUTER, lw=2, label="outer surface"), *more],
                  frameon=False, handlelength=1.5, columnspacing=1.2, **options)


def frame(axes, window):
    axes.add_patch(Rectangle((window[0], window[2]), window[1] - window[0], window[3] - window[2], fill=False, edgecolor=MESH, zorder=5))


def draw_gap(prefix, rounds, picture):
    s = Section(prefix, rounds)
    shading = LinearSegmentedColormap.from_list("shell", [CURVE, "#f3cf9a", SHELL])
    dots = (0, (1, 1.5))
    fig, ((body, gap),) = figure(1, 2, 590, gridspec_kw={"width_ratios": [0.62, 1]})
    s.draw(body, BODY, 900, shading=shading)
    frame(body, GAP)
    body.axis("off")
    shown, (x, y, f) = s.draw(gap, GAP, 900, 2.0, shading)
    half = s.thickness / 2
    for level, color in ((-half, INNER), (half, OUTER)):
        gap.contour(x, y, f, [level], colors=[color], linewidths=1.6, linestyles=[dots], zorder=3)
    fig.subplots_adjust(0.005, 0.17, 0.995, 0.99, 0.02)
    bar = fig.colorbar(shown, cax=fig.add_axes([0.53, 0.125, 0.42, 0.025]), orientation="horizontal", ticks=[0, 0.5, 1])
    bar.ax.set_xticklabels(["0", "50 %", "100 %"])
    bar.set_label("thickness / requested thickness")
    legend(fig, [Line2D([], [], color=OUTER, lw=1.6, ls=dots, label="outer surface at full thickness")], loc="lower left", ncol=2)
    save(fig, picture)


def draw_rounds(prefix, rounds, picture):
    states = [Section(prefix, k + 1) for k in range(rounds)]
    fig, axes = figure(2, rounds, 870, gridspec_kw={"height_ratios": [1.95, 1]})
    for k, (s, body, gap) in enumerate(zip(states, *axes)):
        s.draw(body, BODY, 900)
        body.axis("off")
        frame(body, GAP)
        s.draw(gap, GAP, 600, 1.6)
        if k + 1 < rounds:
            for ax in (body, gap):
                ax.add_collection(PatchCollection(s.squares(s.split_in(states[k + 1])), facecolor=FAILURE, alpha=0.22, linewidth=0, zorder=3))
        near = s.failures[np.abs(s.failures[:, 2] - Z) < NEAR]
        gap.plot(near[:, 0], near[:, 1], "x", color=FAILURE, ms=7, mew=1.8, zorder=6)
        what = f"{s.thick} cells too thick" if s.thick else f"{s.undecided} undecided places" if s.undecided else "certified"
        body.set_title(f"round {k + 1}: {s.cells} cells,\n{what}", pad=4)
    fig.subplots_adjust(0.005, 0.05, 0.995, 0.945, 0.03, 0.03)
    legend(fig, [Patch(facecolor=FAILURE, alpha=0.22, label="split next"),
                 Line2D([], [], color=FAILURE, marker="x", ms=7, mew=1.8, ls="", label="gradient undecided or zero")], loc="lower center", ncol=5)
    save(fig, picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    prefix, pictures = sys.argv[1:]
    rounds = len(glob.glob(f"{prefix}_*_field.vtu"))
    draw_gap(prefix, rounds, f"{pictures}/narrowed_threshold.png")
    draw_rounds(prefix, rounds, f"{pictures}/refinement_rounds.png")
