"""Draws geodesic distances."""
import numpy as np
import vtk
from matplotlib import colormaps
from vtk.util.numpy_support import numpy_to_vtk

from palette import FACET, MESH, figure, rgb, save
from render_shell import lines, read
from rendering import edges, fit, render, show, surface


def vertex_values(name):
    """Returns the vertex attributes of an ASCII file, by name. VTK's reader drops attributes that it does not support."""
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
    """Returns colored bands of values, and the isolines between them."""
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
        return f"{100 * np.abs(values[name] - exact).mean() / exact.max():.1f} % error"
    titles = (f"mesh: {mesh.GetNumberOfPolys()} facets", f"heat method: {off('direct')}", "exact distances",
              f"remeshed mesh: {proxy.GetNumberOfPolys()} facets", "heat method", f"transferred back: {off('distance')}")
    for axes, panel, title in zip(rows.flat, panels, titles):
        show(axes, render(panel, size, *view), title)
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.95, 0.02, 0.08)
    save(fig, picture)
