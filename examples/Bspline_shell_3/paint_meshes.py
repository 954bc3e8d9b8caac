#!/usr/bin/python3
"""Prepares pictures that show where a map takes each point.

Usage: paint_meshes.py PREFIX

Reads PREFIX_mesh.ply and PREFIX_simplified.ply. Writes PREFIX_painted.ply, the mesh with stripes around a vertex as
colors, and PREFIX_subdivided.ply, the simplified mesh subdivided without changing the surface. Then the program
bspline_shell can transfer the colors from the former to the latter: its verb transfer. Coordinates are rounded to float.
"""
import math
import sys

import vtk

FACETS = 100_000        # enough to show a stripe on large facets
PALETTE = (253, 200, 60), (225, 85, 85), (125, 60, 150), (35, 110, 170)
WAVES = 9               # number of stripes


def read(name):
    reader = vtk.vtkPLYReader()
    reader.SetFileName(name)
    reader.Update()
    if reader.GetOutput().GetNumberOfPolys() == 0:
        sys.exit(f"{name} has no facets.")
    return reader.GetOutput()


def write(name, mesh, colors=None):
    writer = vtk.vtkPLYWriter()
    writer.SetFileName(name)
    writer.SetInputData(mesh)
    writer.SetFileTypeToBinary()
    if colors:
        mesh.GetPointData().SetScalars(colors)
        writer.SetArrayName(colors.GetName())
    writer.Write()


def stripes(mesh):
    """Returns colors that depend on the distance from the vertex with the largest sum of coordinates."""
    points = [mesh.GetPoint(i) for i in range(mesh.GetNumberOfPoints())]
    top = max(points, key=sum)
    distances = [math.dist(p, top) for p in points]
    largest = max(distances)
    colors = vtk.vtkUnsignedCharArray()
    colors.SetName("RGB")
    colors.SetNumberOfComponents(3)
    for distance in distances:
        t = distance / largest
        i = min(int(3 * t), 2)
        weight = 0.65 + 0.35 * math.tanh(2 * math.cos(2 * WAVES * math.pi * t))
        full = (a + (3 * t - i) * (b - a) for a, b in zip(PALETTE[i], PALETTE[i + 1]))
        colors.InsertNextTuple3(*(round(weight * c + (1 - weight) * 255) for c in full))
    return colors


def main(prefix):
    mesh, simplified = read(f"{prefix}_mesh.ply"), read(f"{prefix}_simplified.ply")
    write(f"{prefix}_painted.ply", mesh, stripes(mesh))
    while simplified.GetNumberOfPolys() < FACETS:
        subdivision = vtk.vtkLinearSubdivisionFilter()
        subdivision.SetInputData(simplified)
        subdivision.SetNumberOfSubdivisions(1)
        subdivision.Update()
        simplified = subdivision.GetOutput()
    write(f"{prefix}_subdivided.ply", simplified)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
