"""Draws meshes with a texture: a simplified mesh, and a proxy of polygons."""
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

from palette import MESH, OUTER, figure, rgb, save
from render_shell import half, outline, read
from rendering import edges, fit, polydata, render, show, surface

CHECKS = (64, 140, 140), (246, 236, 214)        # colors; 16 squares along a unit of the texture


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
    for ax, what, title in zip(axes, ("before", "after"), ("polygons", "simplified proxy")):
        data, actor = textured(f"{prefix}_{what}.txt")
        view = fit(data, size, direction, up)
        show(ax, render([actor, edges(data, MESH, 0.4)], size, *view), f"{title}: {data.GetNumberOfPolys()} facets")
    plane = vtk.vtkPlane()
    plane.SetOrigin(0, 0.05, 0)
    plane.SetNormal(0, 1, 0)
    shares, proxy = read(f"{prefix}_shares.ply"), read(f"{prefix}_proxy.ply")
    shares.GetCellData().SetActiveScalars("RGBA")
    behind = half(shares, plane)
    show(axes[2], render([surface(behind), edges(behind, MESH, 0.3), outline(proxy, plane, rgb(OUTER), 2.5)], size, *view), "cross section")
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
