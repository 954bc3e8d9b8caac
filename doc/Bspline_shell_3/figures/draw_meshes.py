#!/usr/bin/python3
"""Draws the figures of the manual that show meshes.

Usage: draw_meshes.py DATA PICTURES
"""
import sys

import numpy as np

from draw_colors import draw_boolean, draw_sides
from draw_curves import draw_curves
from draw_editing import draw_closing, draw_excision, draw_remeshing, draw_truncation
from draw_elasticity import draw_elasticity
from draw_fields import draw_fields
from draw_geodesics import draw_geodesics
from draw_textures import draw_soup, draw_texture

if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    data, pictures = sys.argv[1:]
    draw_curves(f"{data}/eight", f"{pictures}/integral_curves.png")
    draw_remeshing(f"{data}/joint", f"{pictures}/remeshing.png")
    draw_closing(((f"{data}/lion", (1, -0.8, 0.4), (0, 0, 1)), (f"{data}/three_peaks", (0.5, -1, 0.4), (0, 0, 1))), f"{pictures}/open_mesh.png")
    draw_truncation(f"{data}/four_cubes", np.array([1., 1., 1.]), f"{pictures}/singular_vertex.png")
    draw_excision(f"{data}/ball", f"{pictures}/excised_triangles.png")
    draw_texture(f"{data}/elephant", f"{pictures}/texture_transfer.png")
    draw_soup(f"{data}/figure", f"{pictures}/soup_proxy.png")
    draw_geodesics(f"{data}/heat_geodesics", (0.6, 0.9, 0.7), (0, 0, 1), f"{pictures}/heat_geodesics.png")
    draw_boolean(f"{data}/boolean", (0.4, 0.3, 1), (0, 1, 0), f"{pictures}/boolean_colors.png")
    draw_sides(f"{data}/bowl", f"{pictures}/closest_point.png")
    draw_elasticity(f"{data}/bent/anchor.off", f"{data}/bent", f"{pictures}/elastic_proxy.png")
    draw_fields(((1, f"{data}/fields_1", (0.4, 0.15, 1), (0, 1, 0)), (4, f"{data}/fields_4", (0.2, 0.2, 1), (0, 1, 0))), f"{pictures}/fields.png")
