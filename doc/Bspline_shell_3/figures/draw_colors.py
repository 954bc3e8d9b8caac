"""Draws meshes with colored facets: a union of solids, and a bowl with two sides."""
import matplotlib.pyplot as plt
import numpy as np
import vtk
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from vtk.util.numpy_support import vtk_to_numpy

from palette import DPI, INNER, MESH, OUTER, WIDTH, figure, save
from render_shell import read
from rendering import edges, fit, painted, plane, render, show, surface, tubes


def color_borders(data):
    """Returns the edges between facets of different colors."""
    colors = vtk_to_numpy(data.GetCellData().GetScalars())
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    sides = np.sort(np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1)
    order = np.lexsort(sides.T)             # makes the two sides of an edge neighbors, because the meshes are closed
    first, second = (colors[order[i::2] % len(triangles)] for i in (0, 1))
    ends = sides[order[::2]][(first != second).any(axis=1)]
    return vtk_to_numpy(data.GetPoints().GetData())[ends]


def draw_boolean(prefix, direction, up, picture):
    size = 650, 560
    fig, (axes,) = figure(1, 2, 420)
    before, after = (read(f"{prefix}{part}.ply") for part in ("", "_colors"))
    view = fit(before, size, direction, up)
    for ax, data, what, width in zip(axes, (before, after), ("union", "simplified in its shell"), (0.25, 0.6)):
        data.GetCellData().SetActiveScalars("RGBA")
        image = render([surface(data), edges(data, MESH, width), tubes(color_borders(data), MESH, 0.003 * view[-1])], size, *view)
        show(ax, image, f"{what}: {data.GetNumberOfPolys()} facets")
    fig.subplots_adjust(0.005, 0.01, 0.995, 0.93, 0.02)
    save(fig, picture)


def section(data, cut):
    """Returns the line segments of a cross section of a mesh, and the colors of their facets."""
    cutter = vtk.vtkCutter()
    cutter.SetInputData(data)
    cutter.SetCutFunction(cut)
    cutter.Update()
    points = vtk_to_numpy(cutter.GetOutput().GetPoints().GetData())
    colors = cutter.GetOutput().GetCellData().GetArray("RGBA")
    segments = points[vtk_to_numpy(cutter.GetOutput().GetLines().GetConnectivityArray()).reshape(-1, 2)]
    return segments, vtk_to_numpy(colors) / 255 if colors else MESH


def draw_sides(prefix, picture):
    size, direction, up = (430, 360), (0.25, -1, 0.95), (0, 0, 1)
    bowl, coarse = read(f"{prefix}_mesh.ply"), painted(f"{prefix}_painted.ply")
    fig = plt.figure(figsize=(WIDTH / DPI, 4.4))
    grid = fig.add_gridspec(2, 3, height_ratios=(290, 130))
    panels = ("painted", f"simplified and painted: {coarse.GetNumberOfPolys()} facets"), \
             ("closest_point", "color of the closest point"), ("shell_map", "color of the image")
    view = fit(coarse, size, direction, up)
    for n, (part, title) in enumerate(panels):
        data = painted(f"{prefix}_{part}.ply")
        image = render([surface(data, ambient=0.35)] + ([edges(data, MESH, 0.5)] if part == "painted" else []), size, *view)
        show(fig.add_subplot(grid[0, n]), image, title)

    # A cross section of the wall, and the closest points of points inside the bowl.
    axes = fig.add_subplot(grid[1, :])
    cut = plane((0, 0, 0), (0, 1, 0))
    for data, width in ((coarse, 3.5), (bowl, 1.5)):
        segments, colors = section(data, cut)
        axes.add_collection(LineCollection(segments[:, :, (0, 2)], colors=colors, linewidths=width))
    top = -0.405
    locator = vtk.vtkCellLocator()
    locator.SetDataSet(coarse)
    locator.BuildLocator()
    segments, _ = section(bowl, cut)
    corners, radii = segments.reshape(-1, 3), np.linalg.norm(segments.reshape(-1, 3), axis=1)
    for p in set(map(tuple, corners[(radii < (radii.min() + radii.max()) / 2) & (corners[:, 2] < top)])):
        closest, cell, sub, square = [0, 0, 0], vtk.mutable(0), vtk.mutable(0), vtk.mutable(0)
        locator.FindClosestPoint(p, closest, vtk.vtkGenericCell(), cell, sub, square)
        axes.annotate("", (closest[0], closest[2]), (p[0], p[2]), arrowprops={"arrowstyle": "->", "color": OUTER, "shrinkA": 0, "shrinkB": 0})
    axes.set_xlim(-0.36, 0.36)
    axes.set_ylim(-0.51, top)
    axes.set_aspect("equal")
    axes.axis("off")
    handles = [Line2D([], [], color=color, lw=width, label=label)
               for color, width, label in ((MESH, 1.5, "bowl"), ("#fac850", 3.5, "simplified: inside"), (INNER, 3.5, "simplified: outside"),
                                           (OUTER, 1, "to the closest point"))]
    fig.legend(handles=handles[:2], loc="lower left", frameon=False, handlelength=1.2)
    fig.legend(handles=handles[2:], loc="lower right", frameon=False, handlelength=1.2)
    fig.subplots_adjust(0.005, 0.01, 0.995, 0.945, 0.02, 0.04)
    save(fig, picture)
