"""Draws integral curves in a shell."""
import numpy as np
from matplotlib.lines import Line2D

from palette import CURVE, FACET, INNER, MESH, OTHER_MESH, OUTER, figure, rgb, save
from render_shell import half, outline, read
from rendering import balls, edges, plane, render, show, surface, tubes


def spread(curves, distance):
    """Returns some of the curves, whose outer ends have at least this distance from each other."""
    kept = []
    for c in curves:
        if all(np.linalg.norm(c[-1] - k[-1]) > distance for k in kept):
            kept.append(c)
    return kept


def draw_curves(prefix, picture):
    mesh, simplified, inner, outer = (read(f"{prefix}_{part}.ply") for part in ("mesh", "simplified", "inner", "outer"))
    with open(f"{prefix}_curves.txt") as rows:
        curves = [np.array(row.split(), float).reshape(-1, 3) for row in rows]
    b = mesh.GetBounds()
    middle = (b[2] + b[3]) / 2

    # layers are removed one by one along the longest side
    def part(data, from_, to):
        return half(half(data, plane((0, 0, from_), (0, 0, 1))), plane((0, 0, to), (0, 0, -1)))

    bottom, first, second, top = -1, -0.15, 0.15, 1
    layer = part(mesh, first, second)
    layers = [surface(part(outer, bottom, first), OUTER), surface(layer, FACET), edges(layer), surface(part(inner, second - 0.06, top), INNER),
              tubes([c[2:] for c in curves if c[0, 2] > first], CURVE, 0.0022)]
    left_view = render(layers, (570, 930), (0.0, middle, -0.01), (0.25, 1, 0.35), (0, 0, 1), 1.12)

    # a part of the lower half
    cut = plane((0, middle, 0), (0, -1, 0))
    at_cut = spread([c for c in curves if abs(c[0, 1] - middle) < 1e-6], 0.03)
    below = [surface(half(inner, cut), INNER), surface(half(outer, cut), OUTER, 0.3), surface(half(mesh, cut), FACET),
             edges(half(mesh, cut), MESH, 0.5), tubes([c[2:] for c in at_cut], CURVE, 0.0013),
             balls([c[0] for c in at_cut], MESH, 0.003), balls([c[1] for c in at_cut], OTHER_MESH, 0.003)]
    below += [outline(data, cut, rgb(color), 2.5) for data, color in ((inner, INNER), (outer, OUTER), (mesh, MESH), (simplified, OTHER_MESH))]
    right_view = render(below, (750, 930), (-0.07, middle, 0.30), (0.0, 1, 0.15), (0, 0, 1), 0.56)
    fig, ((left, right),) = figure(1, 2, 680, gridspec_kw={"width_ratios": [570, 750]})
    show(left, left_view)
    show(right, right_view)
    fig.subplots_adjust(0.005, 0.07, 0.995, 0.995, 0.02)
    names = (INNER, "inner surface"), (MESH, "mesh"), (OTHER_MESH, "simplified mesh"), (OUTER, "outer surface"), (CURVE, "integral curves")
    fig.legend(handles=[Line2D([], [], color=color, lw=3, label=label) for color, label in names],
               loc="lower center", ncol=5, frameon=False, handlelength=1.2, columnspacing=1.4)
    save(fig, picture)
