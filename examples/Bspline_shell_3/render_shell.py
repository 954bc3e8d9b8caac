#!/usr/bin/python3
"""Draws files that the program bspline_shell writes: `shell -o PREFIX`, or `simplify -o PREFIX_simplified.ply --shell PREFIX`.

Usage: render_shell.py PREFIX PICTURE.png

Reads PREFIX_{mesh,inner,outer}.ply. Draws the mesh, and a cross section of the mesh and the shell with an enlarged
detail. If there is PREFIX_simplified.ply, draws the simplified mesh between them, and adds it to the cross section.
If paint_meshes.py has prepared PREFIX_painted.ply, and there is PREFIX_detail.ply, both meshes have their colors.

If there is PREFIX_places.ply, draws only the mesh and these points, where the proof fails.
"""
import os
import sys

import vtk

PANEL = 600             # width, in pixels
TITLE = 40              # height, in pixels
MAGNIFIER = 0.32        # size of the enlarged detail, fraction of a panel
SAMPLES = 3             # per pixel and direction
BLUE, RED, GREY, BLACK, GREEN = (0.20, 0.42, 0.85), (0.85, 0.25, 0.20), (0.93, 0.92, 0.90), (0.1, 0.1, 0.1), (0.0, 0.55, 0.25)


def read(name, points=False):
    if not os.path.isfile(name):
        sys.exit(f"{name} does not exist.")
    reader = vtk.vtkPLYReader()
    reader.SetFileName(name)
    reader.Update()
    data = reader.GetOutput()
    if points and data.GetNumberOfPoints() == 0:
        sys.exit(f"{name} has no points.")
    if not points and data.GetNumberOfPolys() == 0:
        sys.exit(f"{name} has no facets.")
    return data


def actor(data, color=None, opacity=1.0):
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
    p.SetInterpolationToFlat()
    p.SetAmbient(0.45)
    p.SetDiffuse(0.6)
    return a


def lines(data, color, width):
    a = actor(data, color)
    a.GetProperty().LightingOff()
    a.GetProperty().SetLineWidth(SAMPLES * width)
    a.GetMapper().SetResolveCoincidentTopologyToPolygonOffset()
    a.GetMapper().SetRelativeCoincidentTopologyLineOffsetParameters(-4, -4)
    return a


def edges(data):
    extract = vtk.vtkExtractEdges()
    extract.SetInputData(data)
    extract.Update()
    return lines(extract.GetOutput(), (0.15, 0.15, 0.15), 0.6)


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
    return lines(cut.GetOutput(), color, width)


def largest_loop(data, plane):
    cut = vtk.vtkCutter()
    cut.SetInputData(data)
    cut.SetCutFunction(plane)
    loop = vtk.vtkPolyDataConnectivityFilter()
    loop.SetInputConnection(cut.GetOutputPort())
    loop.SetExtractionModeToLargestRegion()
    used = vtk.vtkCleanPolyData()           # removes points of the other loops
    used.SetInputConnection(loop.GetOutputPort())
    used.Update()
    return used.GetOutput()


def square(center, right, up, radius):
    source = vtk.vtkPlaneSource()
    source.SetOrigin([center[a] - radius * (right[a] + up[a]) for a in range(3)])
    source.SetPoint1([center[a] + radius * (right[a] - up[a]) for a in range(3)])
    source.SetPoint2([center[a] - radius * (right[a] - up[a]) for a in range(3)])
    border = vtk.vtkFeatureEdges()
    border.SetInputConnection(source.GetOutputPort())
    border.ColoringOff()
    border.Update()
    return lines(border.GetOutput(), BLACK, 1)


def in_view(data, camera):
    transform = vtk.vtkTransform()
    transform.SetMatrix(camera.GetViewTransformMatrix())
    move = vtk.vtkTransformPolyDataFilter()
    move.SetInputData(data)
    move.SetTransform(transform)
    move.Update()
    return move.GetOutput()


def emptiest_corner(data, scale, rows):
    """Returns the corner of a panel, above its title, with the fewest points.

    The data are in view coordinates, with the origin in the middle of the panel.
    """
    width, height, middle = scale * PANEL, scale * (rows - TITLE), scale * TITLE / 2
    points = [data.GetPoint(i) for i in range(data.GetNumberOfPoints())]
    size = MAGNIFIER * width

    def covered(corner):
        x, y = corner
        return sum(x * p[0] > width / 2 - size and y * (p[1] - middle) > height / 2 - size for p in points)
    return min(((-1, 1), (1, 1), (-1, -1), (1, -1)), key=covered)


def title(text, x=0.5, color=(0.15, 0.15, 0.15)):
    a = vtk.vtkTextActor()
    a.SetInput(text)
    p = a.GetTextProperty()
    p.SetFontSize(20 * SAMPLES)
    p.SetColor(*color)
    p.SetJustificationToCentered()
    p.SetVerticalJustificationToBottom()
    a.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    a.SetPosition(x, 0.015)
    return a


def save(window, picture):
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    shrink = vtk.vtkImageShrink3D()
    shrink.SetInputConnection(image.GetOutputPort())
    shrink.SetShrinkFactors(SAMPLES, SAMPLES, 1)
    shrink.AveragingOn()
    writer = vtk.vtkPNGWriter()
    writer.SetCompressionLevel(9)
    writer.SetFileName(picture + ".part")
    writer.SetInputConnection(shrink.GetOutputPort())
    writer.Write()
    os.replace(picture + ".part", picture)


def draw_places(prefix, picture):
    mesh, places = read(f"{prefix}_mesh.ply"), read(f"{prefix}_places.ply", points=True)
    bounds = mesh.GetBounds()
    spans = [bounds[2*a + 1] - bounds[2*a] for a in range(3)]
    ball = vtk.vtkSphereSource()
    ball.SetRadius(0.008 * max(spans))
    balls = vtk.vtkGlyph3D()
    balls.SetInputData(places)
    balls.SetSourceConnection(ball.GetOutputPort())
    balls.ScalingOff()
    balls.Update()
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    outlines = edges(mesh)
    outlines.GetProperty().SetOpacity(0.4)
    for a in (actor(mesh, GREY, 0.3), outlines, actor(balls.GetOutput(), RED)):
        renderer.AddActor(a)
    renderer.AddActor2D(title("where the proof fails", color=RED))
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.AddRenderer(renderer)
    window.SetSize(SAMPLES * PANEL, SAMPLES * (PANEL + TITLE))
    thin = spans.index(min(spans))
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition([1.0 if a == thin else 0.45 for a in range(3)])
    camera.SetViewUp([1.0 if a == (1 if thin != 1 else 2) else 0.0 for a in range(3)])
    renderer.ResetCamera()
    window.Render()
    save(window, picture)


def main(prefix, picture):
    if os.path.isfile(f"{prefix}_places.ply"):
        draw_places(prefix, picture)
        return
    mesh, inner, outer = (read(f"{prefix}_{part}.ply") for part in ("mesh", "inner", "outer"))
    simplified = read(f"{prefix}_simplified.ply") if os.path.isfile(f"{prefix}_simplified.ply") else None
    painted, detail = mesh, simplified
    if simplified and os.path.isfile(f"{prefix}_detail.ply"):
        painted, detail = (read(f"{prefix}_{part}.ply") for part in ("painted", "detail"))
    simplified_legend = []

    bounds = outer.GetBounds()
    center = [(bounds[2*a] + bounds[2*a + 1]) / 2 for a in range(3)]
    spans = [bounds[2*a + 1] - bounds[2*a] for a in range(3)]
    thin = spans.index(min(spans))          # look along the shortest side of the box
    view = [0.0, 0.0, 0.0]
    view[thin] = 1.0
    up = [0.0, 0.0, 0.0]
    up[1 if thin != 1 else 2] = 1.0
    plane = vtk.vtkPlane()
    plane.SetOrigin(center)
    plane.SetNormal(*[-x for x in view])

    # contents and titles of panels
    panels = [([actor(painted), edges(mesh)], [title(f"mesh: {mesh.GetNumberOfPolys()} facets")])]
    cut = [actor(half(inner, plane), BLUE), actor(half(outer, plane), RED, 0.3)]
    cut += [outline(inner, plane, BLUE, 1.5), outline(outer, plane, RED, 1.5), outline(mesh, plane, BLACK, 1.5)]
    if simplified:
        panels.append(([actor(detail), edges(simplified)],
                       [title(f"simplified: {simplified.GetNumberOfPolys()} facets"
                              + (", with transferred colors" if detail is not simplified else ""))]))
        cut += [actor(half(simplified, plane), GREY), outline(simplified, plane, GREEN, 1.5)]
        simplified_legend = [("simplified", GREEN)]
    else:
        cut.append(actor(half(mesh, plane), GREY))
    legend = [("inner surface", BLUE), ("mesh", BLACK)] + simplified_legend + [("outer surface", RED)]
    panels.append((cut, [title(text, (n + 0.5) / len(legend), color) for n, (text, color) in enumerate(legend)]))

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    renderers = []
    for n, (actors, titles) in enumerate(panels):
        renderer = vtk.vtkRenderer()
        renderer.SetViewport(n / len(panels), 0, (n + 1) / len(panels), 1)
        renderer.SetBackground(1, 1, 1)
        for a in actors:
            renderer.AddActor(a)
        for t in titles:
            renderer.AddActor2D(t)
        window.AddRenderer(renderer)
        tilt = 0.5 if actors is not cut else 0.25
        side = [tilt * up[(a + 1) % 3] for a in range(3)]
        camera = renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(center)
        camera.SetPosition([center[a] + max(spans) * (view[a] + 0.25 * up[a] + side[a]) for a in range(3)])
        camera.SetViewUp(up)
        renderers.append(renderer)

    # The outer surface fills each panel above the title.
    extents = [in_view(outer, r.GetActiveCamera()).GetBounds() for r in renderers]
    width = 1.06 * max(b[1] - b[0] for b in extents)
    height = 1.06 * max(b[3] - b[2] for b in extents)
    rows = int(min(max(PANEL * height / width, 0.5 * PANEL), 1.3 * PANEL)) + TITLE
    scale = max(width / PANEL, height / (rows - TITLE))        # the size of a pixel
    window.SetSize(SAMPLES * PANEL * len(panels), SAMPLES * rows)
    for renderer, b in zip(renderers, extents):
        camera = renderer.GetActiveCamera()
        camera.SetParallelScale(scale * rows / 2)
        matrix = camera.GetViewTransformMatrix()
        x, y = (b[0] + b[1]) / 2, (b[2] + b[3]) / 2 - TITLE / 2 * scale
        shift = [matrix.GetElement(0, a) * x + matrix.GetElement(1, a) * y for a in range(3)]
        camera.SetFocalPoint([camera.GetFocalPoint()[a] + shift[a] for a in range(3)])
        camera.SetPosition([camera.GetPosition()[a] + shift[a] for a in range(3)])
        renderer.ResetCameraClippingRange()

    # an enlarged detail at the upper left of the cross section
    loop = largest_loop(mesh, plane)
    right = [up[(a + 1) % 3] * view[(a + 2) % 3] - up[(a + 2) % 3] * view[(a + 1) % 3] for a in range(3)]
    place = max((loop.GetPoint(i) for i in range(loop.GetNumberOfPoints())),
                key=lambda p: sum(p[a] * (up[a] - right[a]) for a in range(3)), default=center)
    radius = 0.025 * max(spans)
    renderers[-1].AddActor(square(place, right, up, radius))
    magnifier = vtk.vtkRenderer()
    magnifier.SetBackground(1, 1, 1)
    x, y = emptiest_corner(in_view(half(mesh, plane), renderers[-1].GetActiveCamera()), scale, rows)
    first = (len(panels) - 1 + (0.01 if x < 0 else 0.99 - MAGNIFIER)) / len(panels)
    bottom = (TITLE if y < 0 else rows - (MAGNIFIER + 0.01) * PANEL) / rows
    magnifier.SetViewport(first, bottom, first + MAGNIFIER / len(panels), bottom + MAGNIFIER * PANEL / rows)
    window.AddRenderer(magnifier)
    for a in cut:
        magnifier.AddActor(a)
    magnifier.AddActor(square(place, right, up, 0.995 * radius))
    camera = magnifier.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(radius)
    camera.SetFocalPoint(place)
    camera.SetPosition([place[a] + 2 * max(spans) * view[a] for a in range(3)])
    camera.SetViewUp(up)
    magnifier.ResetCameraClippingRange()
    window.Render()
    save(window, picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
