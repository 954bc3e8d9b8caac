"""Drawings and measurements that only the gallery needs.

Usage: drawing.py MODULE.FUNCTION ARGUMENTS         calls a drawing function; its arguments are a list in JSON
"""
import importlib
import json
import sys

import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

import paths        # adds the folders of the next modules    # noqa: F401
from palette import FACET, INNER, MESH, OUTER, figure, save
from render_shell import half, read
from rendering import edges, fit, painted, plane, render, show, surface


def draw_layers(shells, picture):
    """Draws shells with layers removed one by one: the outer surface, the mesh, the inner surface."""
    size = 650, 520
    fig, rows = figure(2, 2, 780)
    for axes, (prefix, title, direction, up, along) in zip(rows.flat, shells):
        inner, mesh, outer = (read(f"{prefix}_{part}.ply") for part in ("inner", "mesh", "outer"))
        normal = np.array(along, float)
        heights = vtk_to_numpy(mesh.GetPoints().GetData()) @ normal
        first, second = (heights.min() + share * np.ptp(heights) for share in (0.36, 0.62))
        layer = half(half(mesh, plane(first * normal, normal)), plane(second * normal, -normal))
        actors = [surface(half(outer, plane(first * normal, -normal)), OUTER, ambient=0.35),
                  surface(layer, FACET, ambient=0.35), edges(layer, MESH, 0.5),
                  surface(half(inner, plane(second * normal, normal)), INNER, ambient=0.35)]
        show(axes, render(actors, size, *fit(outer, size, direction, up)), title)
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.96, 0.02, 0.08)
    save(fig, picture)


def wrong_side(name):
    """Returns the fraction of the area that has the color of the other side.

    The mesh is a bowl around the origin that is yellow inside. Facets of the rim, which face neither inward nor outward,
    are ignored.
    """
    data = painted(name)
    corners = vtk_to_numpy(data.GetPoints().GetData())[vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)].astype(float)
    normals, centers = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), corners.mean(axis=1)
    areas, outwards = np.linalg.norm(normals, axis=1), np.einsum("ij,ij->i", normals, centers)
    is_side = np.abs(outwards) > 0.5 * areas * np.linalg.norm(centers, axis=1)
    yellow = vtk_to_numpy(data.GetCellData().GetScalars())[:, 2] < 128
    return areas[is_side & (yellow != (outwards < 0))].sum() / areas.sum()


if __name__ == "__main__":
    module, function = sys.argv[1].split(".")
    getattr(importlib.import_module(module), function)(*json.loads(sys.argv[2]))
