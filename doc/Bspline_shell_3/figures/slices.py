"""Cross sections of fields written by write_VTU(), evaluated as the polynomials of their cells."""
from math import comb

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy


def bernstein(t):
    return np.stack([comb(3, i) * t**i * (1 - t)**(3 - i) for i in range(4)], axis=-1)


class Slice:
    """The cross section of a field with the plane where the coordinate `axis` is `at`; keeps the order of the other coordinates."""

    def __init__(self, file, axis, at):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(file)
        reader.Update()
        grid = reader.GetOutput()
        nodes = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 64)
        points = vtk_to_numpy(grid.GetPoints().GetData())
        corner, opposite = points[nodes[:, 0]], points[nodes[:, 6]]
        width = (opposite - corner).max(axis=1)
        keep = (corner[:, axis] <= at) & (at < corner[:, axis] + width)
        nodes, corner, width = nodes[keep], corner[keep], width[keep]
        # VTK lists control points of corners, edges, faces, and the interior: sort them by position
        place = np.rint(3 * (points[nodes[0]] - corner[0]) / width[0]).astype(int)
        order = np.empty((4, 4, 4), int)
        order[tuple(place.T)] = np.arange(64)
        coefficients = vtk_to_numpy(grid.GetPointData().GetArray("f"))[nodes[:, order]]
        rest = [a for a in range(3) if a != axis]
        weights = bernstein((at - corner[:, axis]) / width)
        self.coefficients = np.einsum("ni,nijk->njk", weights, np.moveaxis(coefficients, 1 + axis, 1))
        self.corner, self.width = corner[:, rest], width

    def raster(self, window, pixels):
        """Returns values at the centers of pixels in a window (x0, x1, y0, y1), with `pixels` along its first side; nan outside."""
        x0, x1, y0, y1 = window
        size = (x1 - x0) / pixels
        x, y = np.arange(x0 + size / 2, x1, size), np.arange(y0 + size / 2, y1, size)
        values = np.full((len(y), len(x)), np.nan)
        for (cx, cy), w, c in zip(self.corner, self.width, self.coefficients):
            i, j = slice(*np.searchsorted(x, (cx, cx + w))), slice(*np.searchsorted(y, (cy, cy + w)))
            values[j, i] = np.einsum("xi,yj,ij->yx", bernstein((x[i] - cx) / w), bernstein((y[j] - cy) / w), c)
        return x, y, values


def section(file, axis, at):
    """Returns the segments in which a mesh meets the plane."""
    reader = vtk.vtkPLYReader()
    reader.SetFileName(file)
    plane = vtk.vtkPlane()
    plane.SetOrigin(*(at * (a == axis) for a in range(3)))
    plane.SetNormal(*(float(a == axis) for a in range(3)))
    cut = vtk.vtkCutter()
    cut.SetInputConnection(reader.GetOutputPort())
    cut.SetCutFunction(plane)
    cut.Update()
    data = cut.GetOutput()
    points = vtk_to_numpy(data.GetPoints().GetData())[:, [a for a in range(3) if a != axis]]
    lines = vtk_to_numpy(data.GetLines().GetConnectivityArray()).reshape(-1, 2)
    return points[lines]
