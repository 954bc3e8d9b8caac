"""Rendering of meshes: actors, views, and reading and construction of meshes."""
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from palette import MESH, rgb
from render_shell import lines, read

SAMPLES = 3         # per pixel and direction


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


def borders(data):
    features = vtk.vtkFeatureEdges()
    features.SetInputData(data)
    features.BoundaryEdgesOn()
    features.FeatureEdgesOff()
    features.NonManifoldEdgesOff()
    features.ColoringOff()
    features.Update()
    return lines(features.GetOutput(), rgb(MESH), 2.5)


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
    """Returns a picture of `size` pixels in parallel projection; `height` is the visible height in the units of the actors."""
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
    """Returns the arguments with which `render` shows the whole mesh: focus, direction, up, and height."""
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


def painted(name):
    data = read(name)
    data.GetCellData().SetActiveScalars("RGBA")
    return data
