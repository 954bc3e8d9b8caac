"""Draws meshes before and after they are remeshed, closed, truncated, or simplified around excised triangles."""
from palette import FACET, MESH, OUTER, figure, save
from render_shell import read
from rendering import borders, creases, edges, fit, render, show, surface


def draw_remeshing(prefix, picture):
    before, after = (read(f"{prefix}_{part}.ply") for part in ("mesh", "remeshed"))
    size = 650, 700
    view = fit(before, size, (0.5, 0.6, 1), (0, 1, 0))
    fig, (axes,) = figure(1, 2, 510)
    for ax, data, what in zip(axes, (before, after), ("before", "after")):
        image = render([surface(data, FACET, ambient=0.3), edges(data, MESH, 0.8), creases(data)], size, *view)
        show(ax, image, f"{what}: {data.GetNumberOfPolys()} facets")
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.94, 0.02)
    save(fig, picture)


def draw_closing(prefixes, picture):
    size = 440, 330
    fig, rows = figure(2, 3, 520)
    for axes, (prefix, direction, up) in zip(rows, prefixes):
        mesh, closing, simplified = (read(f"{prefix}_{part}.ply") for part in ("mesh", "closing", "simplified"))
        view = fit(closing if closing.GetNumberOfPolys() > mesh.GetNumberOfPolys() else mesh, size, direction, up)
        for ax, data, more, what in zip(axes, (mesh, mesh, simplified), ([], [surface(closing, OUTER, ambient=0.3), edges(closing, MESH, 0.4)], []),
                                        ("open", "virtually closed", "simplified")):
            image = render([surface(data, FACET, ambient=0.3), edges(data, MESH, 0.4), borders(data)] + more, size, *view)
            show(ax, image, f"{what}: {data.GetNumberOfPolys() + (closing.GetNumberOfPolys() if more else 0)} facets")
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.95, 0.02, 0.08)
    save(fig, picture)


def draw_truncation(prefix, center, picture):
    size, direction, up = (430, 420), (0.75, 0.2, 0.65), (0, 0, 1)
    fig, (axes,) = figure(1, 3, 330)
    mesh, truncated, simplified = (read(f"{prefix}_{part}.ply") for part in ("mesh", "truncated", "simplified"))
    whole = fit(mesh, size, direction, up)
    near = center, direction, up, 0.09
    for ax, data, view, what in zip(axes, (mesh, truncated, simplified), (whole, near, whole), ("mesh", "truncated, near the vertex", "simplified")):
        image = render([surface(data, FACET, ambient=0.3), edges(data, MESH, 0.8)], size, *view)
        show(ax, image, f"{what}: {data.GetNumberOfPolys()} facets")
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.93, 0.02)
    save(fig, picture)


def draw_excision(prefix, picture):
    mesh, excised, simplified = (read(f"{prefix}_{part}.ply") for part in ("mesh", "excised", "simplified"))
    size = 650, 560
    center, direction, up, height = (0, 0, 0.2), (-0.5, -1, 0.35), (0, 0, 1), 2.6
    fig, (axes,) = figure(1, 2, 410)
    for ax, data, what in zip(axes, (mesh, simplified), ("mesh", "simplified")):
        image = render([surface(data, FACET, ambient=0.3), edges(data, MESH, 0.6), surface(excised, OUTER, ambient=0.4), edges(excised, MESH, 0.8)],
                       size, center, direction, up, height)
        show(ax, image, f"{what}: {data.GetNumberOfPolys()} facets, and {excised.GetNumberOfPolys()} excised triangles")
    fig.subplots_adjust(0.005, 0.0, 0.995, 0.94, 0.02)
    save(fig, picture)
