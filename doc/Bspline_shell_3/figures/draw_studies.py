#!/usr/bin/python3
"""Draws the output of resolution_benchmark and weights_benchmark: the effects of the paper's gamma and mu.

Usage: draw_studies.py PREFIX PICTURE.png           surfaces of the shells of the armadillo that PREFIX.jsonl lists
"""
import json
import sys

import numpy as np
from matplotlib import colormaps
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from vtk.util.numpy_support import vtk_to_numpy

from draw_geodesics import vertex_values, with_isolines
from palette import CELL, CURVE, FAILURE, INNER, MESH, OUTER, figure, save
from render_shell import read
from rendering import balls, fit, render, show, surface
from slices import section

CERTIFIED = "certified"
LOST = "#5a5f66"


def label(parameter):
    """Returns the part of a file name that denotes a parameter."""
    return CERTIFIED if parameter is None else f"{parameter:g}"


def title(shell):
    """Returns the title of a shell that resolution_benchmark printed."""
    what = "refined cells" if shell["gamma"] is None else f"γ = {shell['gamma']:g}"
    return f"{what}\n|f| ≤ {100 * shell['largest_value']:.2g} %"


def draw_surfaces(prefix, shells, direction, up, picture):
    size = 330, 390
    fig, rows = figure(2, len(shells), 475)
    for column, shell in zip(rows.T, shells):
        for axes, part, color in zip(column, ("inner", "outer"), (INNER, OUTER)):
            data = read(f"{prefix}_{label(shell['gamma'])}_{part}.ply")
            show(axes, render([surface(data, color, ambient=0.3)], size, *fit(data, size, direction, up)), title(shell) if part == "inner" else "")
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.91, 0.02, 0.02)
    save(fig, picture)


class Grid:
    """Values on a plane, written by resolution_benchmark."""

    def __init__(self, name, axis):
        with open(name) as lines:
            columns, rows, *origin, step = map(float, next(lines).split())
            self.f, self.place = np.loadtxt(lines).T.reshape(2, int(rows), int(columns))
        self.axis, self.at = axis, origin.pop(axis)
        self.x, self.y = (start + step * np.arange(int(number)) for start, number in zip(origin, (columns, rows)))
        self.window = self.x[0], self.x[-1], self.y[0], self.y[-1]

    def value_at(self, points):
        """Returns the values at the nearest points of the grid."""
        step = self.x[1] - self.x[0]
        return self.f[tuple(np.rint((points[:, a] - origin) / step).astype(int) for a, origin in ((1, self.y[0]), (0, self.x[0])))]


def draw_sections(prefix, shells, axis, magnified, picture):
    """Draws cross sections perpendicular to an axis, and enlarges the window `magnified`."""
    most = 0.04
    colors = LinearSegmentedColormap.from_list("f", colormaps["RdBu_r"](np.linspace(0.15, 0.85, 256)))
    fig, rows = figure(2, len(shells), 475, gridspec_kw={"height_ratios": [207, 138]})
    for (whole, near), shell in zip(rows.T, shells):
        grid = Grid(f"{prefix}_{label(shell['gamma'])}_slice.txt", axis)
        segments = section(f"{prefix}_mesh.ply", axis, grid.at)
        largest = segments[np.nanargmax(np.abs(grid.value_at(segments[:, 0]))), 0]
        for axes, window, width in ((whole, grid.window, 0.8), (near, magnified, 1.8)):
            shown = axes.imshow(grid.f, origin="lower", extent=grid.window, cmap=colors, vmin=-most, vmax=most, interpolation="bilinear")
            for level, color in ((0, INNER), (1, OUTER)):
                axes.contour(grid.x, grid.y, grid.place, [level], colors=[color], linewidths=width)
            axes.add_collection(LineCollection(segments, colors=MESH, linewidths=width))
            axes.plot(*largest, "o", mfc="none", mec=FAILURE, ms=9, mew=1.8)
            axes.set(xlim=window[:2], ylim=window[2:], aspect="equal", xticks=[], yticks=[])
        whole.axis("off")
        whole.set_title(title(shell), pad=3)
        whole.add_patch(Rectangle(magnified[::2], magnified[1] - magnified[0], magnified[3] - magnified[2], fill=False, edgecolor=MESH))
    fig.subplots_adjust(0.005, 0.13, 0.995, 0.9, 0.03, 0.04)
    bar = fig.colorbar(shown, cax=fig.add_axes([0.70, 0.075, 0.27, 0.025]), orientation="horizontal", ticks=[-most, 0, most])
    bar.ax.set_xticklabels([f"{100 * x:g} %" for x in bar.get_ticks()])
    fig.text(0.68, 0.085, "f", ha="center", va="center")
    fig.legend(handles=[Line2D([], [], color=INNER, lw=2, label="inner surface"), Line2D([], [], color=MESH, lw=2, label="mesh"),
                        Line2D([], [], color=OUTER, lw=2, label="outer surface"),
                        Line2D([], [], color=FAILURE, marker="o", mfc="none", ms=9, mew=1.8, ls="", label="largest |f| in the section")],
               loc="lower left", ncol=4, frameon=False, handlelength=1.3, columnspacing=1.1)
    save(fig, picture)


def draw_impact(found, picture):
    """Draws the numbers that resolution_benchmark printed for some meshes."""
    equal, ours = [f for f in found if f["gamma"]], [f for f in found if not f["gamma"]]
    gammas = sorted({f["gamma"] for f in equal})
    fig, ((time, thickness, proved),) = figure(1, 3, 340)
    for axes, name, scale in ((time, "seconds", 1), (thickness, "thickness", 100)):
        for mesh in {f["mesh"] for f in equal}:
            axes.plot(*np.transpose([(f["gamma"], scale * f[name]) for f in equal if f["mesh"] == mesh]), color=CELL, lw=1)
        axes.plot(gammas, [np.mean([scale * f[name] for f in equal if f["gamma"] == g]) for g in gammas], "-o", color=MESH, lw=2.4, ms=5)
        axes.axhline(np.mean([scale * f[name] for f in ours]), color=CURVE, lw=2.4, ls="--")
        axes.set_ylim(0)
    proved.bar(gammas, [100 * np.mean([f["certified"] for f in equal if f["gamma"] == g]) for g in gammas], 12, color=MESH)
    proved.axhline(100 * np.mean([f["certified"] for f in ours]), color=CURVE, lw=2.4, ls="--")
    proved.set_ylim(0, 105)
    for axes, name in ((time, "seconds"), (thickness, "thickness, % of the box size"), (proved, "proved one-to-one, % of meshes")):
        axes.set_title(name, pad=5, fontsize=11)
        axes.set_xticks(gammas)
        axes.set_xlabel("γ", labelpad=1)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    fig.subplots_adjust(0.035, 0.24, 0.995, 0.92, 0.16)
    fig.legend(handles=[Line2D([], [], color=CELL, lw=1, label="equal cells, each mesh"),
                        Line2D([], [], color=MESH, marker="o", ms=5, lw=2.4, label="equal cells, mean"),
                        Line2D([], [], color=CURVE, lw=2.4, ls="--", label="refined cells, mean")],
               loc="lower center", ncol=3, frameon=False, handlelength=1.8, columnspacing=1.8)
    save(fig, picture)


def draw_weights(prefix, found, direction, up, picture):
    """Draws the output of weights_benchmark for one mesh."""
    size, number = (360, 330), 14
    mesh, values = read(f"{prefix}_mesh.ply"), vertex_values(f"{prefix}_mesh.ply")["distance"]
    diagonal = np.linalg.norm(np.ptp(vtk_to_numpy(mesh.GetPoints().GetData()), axis=0))
    isolines = with_isolines(mesh, values, values.max() / number, number)
    fig, rows = figure(2, len(found), 420, gridspec_kw={"height_ratios": [1, 0.9]})
    for n, ((view, bars), shell) in enumerate(zip(rows.T, found)):
        with open(f"{prefix}_{label(shell['mu'])}.txt") as lines:
            points = np.array(lines.read().split(), float).reshape(-1, 4)
        actors = [balls(points[which, :3], color, 0.007 * diagonal) for which, color in ((points[:, 3] < 0, LOST), (points[:, 3] > 0, FAILURE))
                  if which.any()]
        name = "certified" if shell["mu"] is None else f"$\\mu = 10^{{{np.log10(shell['mu']):.0f}}}$"
        show(view, render([*isolines, *actors], size, *fit(mesh, size, direction, up)), f"{name}\n{100 * shell['thickness']:.2g} % thick")
        distances, share = shell["distances"], 100 / shell["points"]
        errors = share * np.array(distances["errors"])
        bars.bar(0.045 + 0.03 * np.arange(len(errors)), errors, 0.026, color=FAILURE)
        bars.bar(0.375, share * distances["missing"], 0.026, color=LOST)
        bars.set(xlim=(0.02, 0.4), ylim=(0.001, 600), yscale="log", xticks=[0.03, 0.3], yticks=[0.001, 0.01, 0.1, 1, 10, 100])
        bars.set_yticklabels([f"{y:g} %" for y in bars.get_yticks()] if n == 0 else [])
        bars.minorticks_off()
        bars.text(0.4, 180, f"{errors.sum():.2g} % wrong" if errors.any() else "none wrong", ha="right", color=FAILURE)
        bars.text(0.4, 50, f"{share * distances['missing']:.2g} % missing" if distances["missing"] else "none missing", ha="right", color=LOST)
        for side in ("top", "right"):
            bars.spines[side].set_visible(False)
    fig.subplots_adjust(0.085, 0.13, 0.995, 0.9, 0.08, 0.06)
    fig.text(0.5, 0.015, "error of the distance after the round trip, from 0.03 of the box size; missing distances (gray)", ha="center")
    save(fig, picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(f"{sys.argv[1]}.jsonl") as lines:
        draw_surfaces(sys.argv[1], [json.loads(line) for line in lines], (0.5, 0.3, -1), (0, 1, 0), sys.argv[2])
