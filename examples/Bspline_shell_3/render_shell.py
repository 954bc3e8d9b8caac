#!/usr/bin/python3
"""Draws a shell that build_shell has written: the whole mesh coloured by f, and a cut through mesh and shell.

Usage: render_shell.py PREFIX PICTURE.png      (reads PREFIX_{inner,outer,mesh}.ply)
"""
import os
import sys

import vtk


def read(name):
    if not os.path.isfile(name):
        sys.exit(f"{name} is missing")
    reader = vtk.vtkPLYReader()
    reader.SetFileName(name)
    reader.Update()
    data = reader.GetOutput()
    if data.GetNumberOfPolys() == 0:
        sys.exit(f"{name} has no facets")
    return data


def actor(data, color=None, opacity=1.0, edges=False):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    if color is not None:
        mapper.ScalarVisibilityOff()
    a = vtk.vtkActor()
    a.SetMapper(mapper)
    p = a.GetProperty()
    if color is not None:
        p.SetColor(*color)
    p.SetOpacity(opacity)
    p.SetInterpolationToFlat() if edges else p.SetInterpolationToPhong()
    if edges:
        p.EdgeVisibilityOn()
        p.SetEdgeColor(0.35, 0.35, 0.35)
        p.SetLineWidth(0.5)
    return a


def half(data, plane):
    clip = vtk.vtkClipPolyData()
    clip.SetInputData(data)
    clip.SetClipFunction(plane)
    clip.Update()
    return clip.GetOutput()


def outline(data, plane, color, width):
    cut = vtk.vtkCutter()
    cut.SetInputData(data)
    cut.SetCutFunction(plane)
    cut.Update()
    a = actor(cut.GetOutput(), color)
    a.GetProperty().SetLineWidth(width)
    a.GetProperty().LightingOff()
    return a


def main(prefix, picture):
    mesh, inner, outer = (read(f"{prefix}_{part}.ply") for part in ("mesh", "inner", "outer"))
    bounds = mesh.GetBounds()
    center = [(bounds[2*a] + bounds[2*a + 1]) / 2 for a in range(3)]
    spans = [bounds[2*a + 1] - bounds[2*a] for a in range(3)]
    size = max(spans)
    thin = spans.index(min(spans))          # look along the shortest side of the box
    view = [0.0, 0.0, 0.0]
    view[thin] = 1.0
    up = [0.0, 0.0, 0.0]
    up[1 if thin != 1 else 2] = 1.0
    plane = vtk.vtkPlane()
    plane.SetOrigin(center)
    plane.SetNormal(*[-x for x in view])

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(1600, 800)
    blue, red, grey = (0.25, 0.45, 0.85), (0.85, 0.3, 0.25), (0.9, 0.9, 0.88)

    left = vtk.vtkRenderer()
    left.SetViewport(0, 0, 0.5, 1)
    left.AddActor(actor(mesh, edges=True))
    right = vtk.vtkRenderer()
    right.SetViewport(0.5, 0, 1, 1)
    right.AddActor(actor(half(inner, plane), blue))
    right.AddActor(actor(half(mesh, plane), grey))
    right.AddActor(actor(half(outer, plane), red, 0.35))
    right.AddActor(outline(mesh, plane, (0.1, 0.1, 0.1), 2))
    right.AddActor(outline(inner, plane, blue, 2))
    right.AddActor(outline(outer, plane, red, 2))
    for renderer, tilt in ((left, 0.5), (right, 0.25)):
        renderer.SetBackground(1, 1, 1)
        window.AddRenderer(renderer)
        camera = renderer.GetActiveCamera()
        side = [tilt * up[(a + 1) % 3] for a in range(3)]
        camera.SetFocalPoint(center)
        camera.SetPosition([center[a] + 3 * size * (view[a] + 0.25 * up[a] + side[a]) for a in range(3)])
        camera.SetViewUp(up)
        renderer.ResetCamera()
        camera.Zoom(1.25)
    window.Render()

    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
