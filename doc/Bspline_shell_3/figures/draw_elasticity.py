"""Draws the bending of a solid."""
import numpy as np
import vtk
from matplotlib import colormaps
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from palette import FACET, MESH, figure, save
from render_shell import read
from rendering import edges, fit, plane, polydata, render, show, surface


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

    # whole tetrahedra behind the plane through the middle
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
             (mesh, [surface(proxy, FACET, ambient=0.3), edges(proxy, MESH, 0.8)], f"remeshed mesh: {proxy.GetNumberOfPolys()} facets"),
             (mesh, [surface(opened, FACET, ambient=0.3), edges(opened, MESH, 0.8)], f"filled with {solid.GetNumberOfCells()} tetrahedra, cut open"),
             (bent, [colored, edges(bent, MESH, 0.5)], f"bent mesh: moved up to {100 * moves.max():.0f} % of the box size")]
    for ax, (seen, actors, title) in zip(rows.ravel(), views):
        show(ax, render(actors, size, *fit(seen, size, (0.3, -0.8, 0.6), (0, 0, 1))), title)
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.96, 0.02, 0.08)
    save(fig, picture)
