#!/usr/bin/python3
"""Draws the figures of the manual that show meshes.

Usage: draw_meshes.py DATA PICTURES
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import vtk
from matplotlib import colormaps
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from palette import CURVE, DPI, FACET, INNER, MESH, OTHER_MESH, OUTER, WIDTH, figure, rgb, save
from render_shell import half, lines, outline, read

SAMPLES = 3         # per pixel and direction
CHECKS = (64, 140, 140), (246, 236, 214)        # colors; 16 of them along a unit of the texture


def surface(data, color=None, opacity=1.0, ambient=0.45):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    p = actor.GetProperty()
    if color is not None:
        mapper.ScalarVisibilityOff()
        p.SetColor(*rgb(color))
    p.SetOpacity(opacity)
    p.SetInterpolationToFlat()
    p.SetAmbient(ambient)
    p.SetDiffuse(1.05 - ambient)
    return actor


def edges(data, color=MESH, width=1.0):
    extract = vtk.vtkExtractEdges()
    extract.SetInputData(data)
    extract.Update()
    return lines(extract.GetOutput(), rgb(color), width)


def creases(data):
    features = vtk.vtkFeatureEdges()
    features.SetInputData(data)
    features.SetFeatureAngle(60)
    features.ColoringOff()
    features.Update()
    return lines(features.GetOutput(), rgb(MESH), 2.2)


def polydata(points, polygons=None, polylines=None):
    data = vtk.vtkPolyData()
    data.SetPoints(vtk.vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    for cells, set_cells in ((polygons, data.SetPolys), (polylines, data.SetLines)):
        if cells is not None:
            array = vtk.vtkCellArray()
            for cell in cells:
                array.InsertNextCell(len(cell), list(map(int, cell)))
            set_cells(array)
    return data


def tubes(curves, color, radius):
    ends = np.cumsum([0] + [len(c) for c in curves])
    tube = vtk.vtkTubeFilter()
    tube.SetInputData(polydata(np.concatenate(curves), polylines=[range(a, b) for a, b in zip(ends[:-1], ends[1:])]))
    tube.SetRadius(radius)
    tube.SetNumberOfSides(12)
    tube.CappingOn()
    tube.Update()
    actor = surface(tube.GetOutput(), color)
    actor.GetProperty().SetInterpolationToGouraud()
    return actor


def balls(points, color, radius):
    source = vtk.vtkSphereSource()
    source.SetThetaResolution(16)
    source.SetPhiResolution(16)
    source.SetRadius(radius)
    glyph = vtk.vtkGlyph3D()
    glyph.SetInputData(polydata(points))
    glyph.SetSourceConnection(source.GetOutputPort())
    glyph.ScalingOff()
    glyph.Update()
    actor = surface(glyph.GetOutput(), color)
    actor.GetProperty().SetInterpolationToGouraud()
    return actor


def render(actors, size, focus, direction, up, height):
    """A picture of `size` pixels, in parallel projection; `height` is what fits, in the units of the actors."""
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    window.SetSize(*(SAMPLES * n for n in size))
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetUseDepthPeeling(1)
    renderer.SetMaximumNumberOfPeels(8)
    for actor in actors:
        renderer.AddActor(actor)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*(np.array(focus) + 10 * height * np.array(direction) / np.linalg.norm(direction)))
    camera.SetViewUp(*up)
    camera.SetParallelScale(height / 2)
    renderer.ResetCameraClippingRange()
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    shrink = vtk.vtkImageShrink3D()
    shrink.SetInputConnection(image.GetOutputPort())
    shrink.SetShrinkFactors(SAMPLES, SAMPLES, 1)
    shrink.AveragingOn()
    shrink.Update()
    data = shrink.GetOutput()
    width, height, _ = data.GetDimensions()
    return vtk_to_numpy(data.GetPointData().GetScalars()).reshape(height, width, -1)[::-1]


def fit(data, size, direction, up):
    """What `render` needs to show all of a mesh: focus, direction, up and height."""
    view = np.array(direction) / np.linalg.norm(direction)
    right = np.cross(up, view)
    right /= np.linalg.norm(right)
    axes = np.array([right, np.cross(view, right)])
    seen = vtk_to_numpy(data.GetPoints().GetData()) @ axes.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    width, height = 1.03 * (high - low)
    return (low + high) / 2 @ axes, direction, up, max(height, width * size[1] / size[0])


def plane(origin, normal):
    p = vtk.vtkPlane()
    p.SetOrigin(*origin)
    p.SetNormal(*normal)
    return p


def show(axes, image, title=""):
    axes.imshow(image)
    axes.axis("off")
    axes.set_title(title, pad=4)


def spread(curves, distance):
    """Some of the curves, whose outer ends are so far from each other."""
    kept = []
    for c in curves:
        if all(np.linalg.norm(c[-1] - k[-1]) > distance for k in kept):
            kept.append(c)
    return kept


def draw_curves(prefix, picture):
    mesh, simplified, inner, outer = (read(f"{prefix}_{part}.ply") for part in ("mesh", "simplified", "inner", "outer"))
    with open(f"{prefix}_curves.txt") as rows:
        curves = [np.array(row.split(), float).reshape(-1, 3) for row in rows]
    b = mesh.GetBounds()
    middle = (b[2] + b[3]) / 2

    # layers taken off one by one, along the longest side
    def part(data, from_, to):
        return half(half(data, plane((0, 0, from_), (0, 0, 1))), plane((0, 0, to), (0, 0, -1)))

    bottom, first, second, top = -1, -0.15, 0.15, 1
    layer = part(mesh, first, second)
    layers = [surface(part(outer, bottom, first), OUTER), surface(layer, FACET), edges(layer), surface(part(inner, second - 0.06, top), INNER),
              tubes([c[2:] for c in curves if c[0, 2] > first], CURVE, 0.0022)]
    left_view = render(layers, (570, 930), (0.0, middle, -0.01), (0.25, 1, 0.35), (0, 0, 1), 1.12)

    # a part of the half below the plane
    cut = plane((0, middle, 0), (0, -1, 0))
    at_cut = spread([c for c in curves if abs(c[0, 1] - middle) < 1e-6], 0.03)
    below = [surface(half(inner, cut), INNER), surface(half(outer, cut), OUTER, 0.3), surface(half(mesh, cut), FACET),
             edges(half(mesh, cut), MESH, 0.5), tubes([c[2:] for c in at_cut], CURVE, 0.0013),
             balls([c[0] for c in at_cut], MESH, 0.003), balls([c[1] for c in at_cut], OTHER_MESH, 0.003)]
    below += [outline(data, cut, rgb(color), 2.5) for data, color in ((inner, INNER), (outer, OUTER), (mesh, MESH), (simplified, OTHER_MESH))]
    right_view = render(below, (750, 930), (-0.07, middle, 0.30), (0.0, 1, 0.15), (0, 0, 1), 0.56)
    fig, ((left, right),) = figure(1, 2, 680, gridspec_kw={"width_ratios": [570, 750]})
    show(left, left_view)
    show(right, right_view)
    fig.subplots_adjust(0.005, 0.07, 0.995, 0.995, 0.02)
    names = (INNER, "inner surface"), (MESH, "mesh"), (OTHER_MESH, "simplified mesh"), (OUTER, "outer surface"), (CURVE, "integral curves")
    fig.legend(handles=[Line2D([], [], color=color, lw=3, label=label) for color, label in names],
               loc="lower center", ncol=5, frameon=False, handlelength=1.2, columnspacing=1.4)
    save(fig, picture)


def draw_remeshing(prefix, picture):
    before, after = (read(f"{prefix}_{part}.ply") for part in ("mesh", "remeshed"))
    size = 650, 700
    view = fit(before, size, (0.5, 0.6, 1), (0, 1, 0))
    fig, (axes,) = figure(1, 2, 510)
    for ax, data, what in zip(axes, (before, after), ("before", "after")):
        image = render([surface(data, FACET, ambient=0.3), edges(data, MESH, 0.8), creases(data)], size, *view)
        show(ax, image, f"{what}: {data.GetNumberOfPolys()} facets")
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.94, 0.02)
    save(fig, picture)


def borders(data):
    features = vtk.vtkFeatureEdges()
    features.SetInputData(data)
    features.BoundaryEdgesOn()
    features.FeatureEdgesOff()
    features.NonManifoldEdgesOff()
    features.ColoringOff()
    features.Update()
    return lines(features.GetOutput(), rgb(MESH), 2.5)


def draw_closing(prefixes, picture):
    size = 440, 330
    fig, rows = figure(2, 3, 520)
    for axes, (prefix, direction, up) in zip(rows, prefixes):
        mesh, closing, simplified = (read(f"{prefix}_{part}.ply") for part in ("mesh", "closing", "simplified"))
        view = fit(closing if closing.GetNumberOfPolys() > mesh.GetNumberOfPolys() else mesh, size, direction, up)
        for ax, data, more, what in zip(axes, (mesh, mesh, simplified), ([], [surface(closing, OUTER, ambient=0.3), edges(closing, MESH, 0.4)], []),
                                        ("open", "closed virtually", "simplified")):
            image = render([surface(data, FACET, ambient=0.3), edges(data, MESH, 0.4), borders(data)] + more, size, *view)
            show(ax, image, f"{what}: {data.GetNumberOfPolys() + (closing.GetNumberOfPolys() if more else 0)} facets")
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.95, 0.02, 0.08)
    save(fig, picture)


def draw_truncation(prefix, center, picture):
    size, direction, up = (430, 420), (0.75, 0.2, 0.65), (0, 0, 1)
    fig, (axes,) = figure(1, 3, 330)
    mesh, truncated, simplified = (read(f"{prefix}_{part}.ply") for part in ("mesh", "truncated", "simplified"))
    whole = fit(mesh, size, direction, up)
    near = center, direction, up, 0.09
    for ax, data, view, what in zip(axes, (mesh, truncated, simplified), (whole, near, whole), ("mesh", "truncated, at the vertex", "simplified")):
        image = render([surface(data, FACET, ambient=0.3), edges(data, MESH, 0.8)], size, *view)
        show(ax, image, f"{what}: {data.GetNumberOfPolys()} facets")
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.93, 0.02)
    save(fig, picture)


def vertex_values(name):
    """What vertices have in an ASCII file, by name: the reader drops what it does not know."""
    with open(name) as rows:
        names = []
        for row in rows:
            words = row.split()
            if words[:2] == ["element", "vertex"]:
                number = int(words[2])
            elif words[:2] == ["property", "double"]:
                names.append(words[2])
            elif words == ["end_header"]:
                break
        values = np.array([next(rows).split() for _ in range(number)], float)
    return dict(zip(names, values.T))


def with_isolines(data, values, unit, number):
    """Bands of color, and lines between them."""
    data.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(values), deep=True))
    bands = vtk.vtkBandedPolyDataContourFilter()
    bands.SetInputData(data)
    bands.GenerateValues(number + 1, 0, unit * number)
    bands.GenerateContourEdgesOn()
    bands.SetScalarModeToValue()
    bands.Update()
    filled = surface(bands.GetOutput(), ambient=0.4)
    colors = vtk.vtkLookupTable()
    colors.SetNumberOfTableValues(number)
    for n in range(number):
        colors.SetTableValue(n, *colormaps["YlGnBu_r"](0.15 + 0.8 * n / number))
    filled.GetMapper().SetScalarModeToUseCellData()
    filled.GetMapper().SetLookupTable(colors)
    filled.GetMapper().SetScalarRange(0, unit * number)
    return [filled, lines(bands.GetContourEdgesOutput(), rgb(MESH), 1.5)]


def draw_geodesics(prefix, direction, up, picture):
    size = 430, 400
    mesh, proxy = read(f"{prefix}.ply"), read(f"{prefix}_proxy.ply")
    values = vertex_values(f"{prefix}.ply")
    exact, number = values["exact"], 16
    unit = exact.max() / number
    view = fit(mesh, size, direction, up)
    fig, rows = figure(2, 3, 600)
    panels = [[surface(mesh, FACET, ambient=0.3), edges(mesh, MESH, 0.6)], with_isolines(mesh, values["direct"], unit, number),
              with_isolines(mesh, exact, unit, number), [surface(proxy, FACET, ambient=0.3), edges(proxy, MESH, 0.3)],
              with_isolines(proxy, vertex_values(f"{prefix}_proxy.ply")["distance"], unit, number), with_isolines(mesh, values["distance"], unit, number)]
    def off(name):
        return f"{100 * np.abs(values[name] - exact).mean() / exact.max():.1f} % off"
    titles = (f"mesh: {mesh.GetNumberOfPolys()} facets", f"heat method: {off('direct')}", "exact distances",
              f"proxy: {proxy.GetNumberOfPolys()} facets", "heat method", f"carried back: {off('distance')}")
    for axes, panel, title in zip(rows.flat, panels, titles):
        show(axes, render(panel, size, *view), title)
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.95, 0.02, 0.08)
    save(fig, picture)


def checkerboard():
    squares = (np.indices((16, 16)).sum(axis=0) % 2)[..., None]
    colors = np.where(squares, CHECKS[0], CHECKS[1]).repeat(16, axis=0).repeat(16, axis=1).astype(np.uint8)
    image = vtk.vtkImageData()
    image.SetDimensions(256, 256, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(colors.reshape(-1, 3), deep=True))
    texture = vtk.vtkTexture()
    texture.SetInputData(image)
    texture.RepeatOn()
    texture.InterpolateOn()
    return texture


def textured(name):
    corners = np.loadtxt(name)
    data = polydata(corners[:, :3], polygons=np.arange(len(corners)).reshape(-1, 3))
    data.GetPointData().SetTCoords(numpy_to_vtk(np.ascontiguousarray(corners[:, 3:]), deep=True))
    actor = surface(data)
    actor.SetTexture(checkerboard())
    return data, actor


def draw_soup(prefix, picture):
    size, direction, up = (430, 560), (0.35, -1, 0.25), (0, 0, 1)
    fig, (axes,) = figure(1, 3, 390)
    for ax, what, title in zip(axes, ("before", "after"), ("polygons", "proxy, simplified")):
        data, actor = textured(f"{prefix}_{what}.txt")
        view = fit(data, size, direction, up)
        show(ax, render([actor, edges(data, MESH, 0.4)], size, *view), f"{title}: {data.GetNumberOfPolys()} facets")
    plane = vtk.vtkPlane()
    plane.SetOrigin(0, 0.05, 0)
    plane.SetNormal(0, 1, 0)
    shares, proxy = read(f"{prefix}_shares.ply"), read(f"{prefix}_proxy.ply")
    shares.GetCellData().SetActiveScalars("RGBA")
    behind = half(shares, plane)
    show(axes[2], render([surface(behind), edges(behind, MESH, 0.3), outline(proxy, plane, rgb(OUTER), 2.5)], size, *view), "cut: carried and hidden; proxy")
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.94, 0.02)
    save(fig, picture)


def draw_texture(prefix, picture):
    size = 650, 750
    fig, (axes,) = figure(1, 2, 545)
    for ax, what in zip(axes, ("before", "after")):
        data, actor = textured(f"{prefix}_{what}.txt")
        image = render([actor, edges(data, MESH, 0.6)], size, *fit(data, size, (0.3, 0.15, 1), (0, 1, 0)))
        show(ax, image, f"{what}: {data.GetNumberOfPolys()} facets")
    fig.subplots_adjust(0.005, 0.01, 0.995, 0.94, 0.02)
    save(fig, picture)


def color_borders(data):
    """The edges between facets of different colors."""
    colors = vtk_to_numpy(data.GetCellData().GetScalars())
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    sides = np.sort(np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1)
    order = np.lexsort(sides.T)             # both sides of an edge are neighbors then: the meshes are closed
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


def painted(name):
    data = read(name)
    data.GetCellData().SetActiveScalars("RGBA")
    return data


def section(data, cut):
    """The line segments of a cut through a mesh, and the colors of the facets that they are on."""
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
             ("closest_point", "carried by the closest point"), ("shell_map", "carried by the map")
    view = fit(coarse, size, direction, up)
    for n, (part, title) in enumerate(panels):
        data = painted(f"{prefix}_{part}.ply")
        image = render([surface(data, ambient=0.35)] + ([edges(data, MESH, 0.5)] if part == "painted" else []), size, *view)
        show(fig.add_subplot(grid[0, n]), image, title)

    # a cut through the wall, and what is closest to points of the bowl that are inside
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
               for color, width, label in ((MESH, 1.5, "bowl, cut"), ("#fac850", 3.5, "simplified: inside"), (INNER, 3.5, "simplified: outside"),
                                           (OUTER, 1, "to the closest point"))]
    fig.legend(handles=handles[:2], loc="lower left", frameon=False, handlelength=1.2)
    fig.legend(handles=handles[2:], loc="lower right", frameon=False, handlelength=1.2)
    fig.subplots_adjust(0.005, 0.01, 0.995, 0.945, 0.02, 0.04)
    save(fig, picture)


def read_OFF(name):
    with open(name) as rows:
        numbers = " ".join(row.split("#")[0] for row in rows).split()[1:]
    points = np.array(numbers[3:3 + 3 * int(numbers[0])], float).reshape(-1, 3)
    triangles = np.array(numbers[3 + points.size:][:4 * int(numbers[1])], int).reshape(-1, 4)
    return polydata(points, polygons=triangles[:, 1:])


def grid_surface(grid):
    border = vtk.vtkGeometryFilter()
    border.SetInputData(grid)
    border.Update()
    return border.GetOutput()


def draw_elasticity(name, prefix, picture):
    mesh, bent = read_OFF(name), read(f"{prefix}/bent.ply")
    reader = vtk.vtkUnstructuredGridReader()
    reader.SetFileName(f"{prefix}/solid.vtk")
    reader.Update()
    solid = reader.GetOutput()
    proxy = grid_surface(solid)

    # whole tetrahedra, behind the middle
    b = mesh.GetBounds()
    extract = vtk.vtkExtractGeometry()
    extract.SetInputData(solid)
    extract.SetImplicitFunction(plane([(b[0] + b[1]) / 2, (b[2] + b[3]) / 2, (b[4] + b[5]) / 2], (0, -1, 0)))
    extract.ExtractInsideOn()
    extract.ExtractBoundaryCellsOn()
    extract.Update()
    opened = grid_surface(extract.GetOutput())

    moves = np.linalg.norm(vtk_to_numpy(bent.GetPoints().GetData()) - vtk_to_numpy(mesh.GetPoints().GetData()), axis=1)
    moves /= max(b[2 * i + 1] - b[2 * i] for i in range(3))
    bent.GetPointData().SetScalars(numpy_to_vtk(moves, deep=True))
    colored = surface(bent, ambient=0.35)
    colors = vtk.vtkLookupTable()
    colors.SetNumberOfTableValues(256)
    for n, color in enumerate(colormaps["viridis"](np.linspace(0, 1, 256))):
        colors.SetTableValue(n, *color)
    colored.GetMapper().SetLookupTable(colors)
    colored.GetMapper().SetScalarRange(0, moves.max())
    colored.GetMapper().SetInterpolateScalarsBeforeMapping(True)

    size = 650, 520
    fig, rows = figure(2, 2, 760)
    views = [(mesh, [surface(mesh, FACET, ambient=0.3), edges(mesh, MESH, 0.8)], f"mesh: {mesh.GetNumberOfPolys()} facets"),
             (mesh, [surface(proxy, FACET, ambient=0.3), edges(proxy, MESH, 0.8)], f"proxy: {proxy.GetNumberOfPolys()} facets"),
             (mesh, [surface(opened, FACET, ambient=0.3), edges(opened, MESH, 0.8)], f"filled with {solid.GetNumberOfCells()} tetrahedra, cut open"),
             (bent, [colored, edges(bent, MESH, 0.5)], f"mesh, bent: moved by up to {moves.max():.2f} of the box")]
    for ax, (seen, actors, title) in zip(rows.ravel(), views):
        show(ax, render(actors, size, *fit(seen, size, (0.3, -0.8, 0.6), (0, 0, 1))), title)
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.96, 0.02, 0.08)
    save(fig, picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    data, pictures = sys.argv[1:]
    draw_curves(f"{data}/eight", f"{pictures}/integral_curves.png")
    draw_remeshing(f"{data}/joint", f"{pictures}/remeshing.png")
    draw_closing(((f"{data}/lion", (1, -0.8, 0.4), (0, 0, 1)), (f"{data}/three_peaks", (0.5, -1, 0.4), (0, 0, 1))), f"{pictures}/open_mesh.png")
    draw_truncation(f"{data}/four_cubes", np.array([1., 1., 1.]), f"{pictures}/singular_vertex.png")
    draw_texture(f"{data}/elephant", f"{pictures}/texture_transfer.png")
    draw_soup(f"{data}/figure", f"{pictures}/soup_proxy.png")
    draw_geodesics(f"{data}/heat_geodesics", (0.6, 0.9, 0.7), (0, 0, 1), f"{pictures}/heat_geodesics.png")
    draw_boolean(f"{data}/boolean", (0.4, 0.3, 1), (0, 1, 0), f"{pictures}/boolean_colors.png")
    draw_sides(f"{data}/bowl", f"{pictures}/closest_point.png")
    draw_elasticity(f"{data}/bent/anchor.off", f"{data}/bent", f"{pictures}/elastic_proxy.png")
