"""The figures of the gallery: contents, quotation of the paper, programs, and measurements."""
import json
from collections import namedtuple

from paths import MESHES, ROOT
from results import NOT_GIVEN, Results, count, parsed, percent
from studies import make_gamma, make_gamma_impact, make_mu

# `thumbnail` is the part of the first picture that represents the figure: width of the picture and its position, as
# percentages in CSS. `programs` are run by `make`, which returns Results.
Figure = namedtuple("Figure", "name title text quotation source thumbnail programs make")


def make_shells(making):
    # direction of view, up, and the direction in which layers are removed
    views = {
        "armadillo": ((0.5, 0.3, -1), (0, 1, 0), (0, 1, 0)),
        "couplingdown": ((0.5, -1, 0.6), (0, 0, 1), (1, 0, 0)),
        "elephant": ((0.4, 0.15, 1), (0, 1, 0), (1, 0, 0)),
        "knot1": ((0.3, -1, 0.5), (0, 0, 1), (1, 0, 0)),
    }
    certified, times, lines, shells = 0, [], [], []
    for name, view in views.items():
        output = making.run("simplify_and_transfer", MESHES / f"{name}.off", "--output", making.folder / name)
        facets, = parsed(r"mesh +(\d+) facets", output)
        state, width, cells, seconds = parsed(r"shell +(\w+); thickness (\S+) % of the bounding box; (\d+) cells; (\S+) s", output)
        certified += state == "certified"
        times.append(float(seconds))
        lines.append(f"{name}: {percent(width)}, {count(cells)} cells, {times[-1]:.1f} s")
        shells.append((str(making.folder / name), f"{name}: {facets} facets", *view))
    making.draw("drawing.draw_layers", shells, "shells.png")
    all_of_them = f"{certified} of {len(views)}"
    return Results(
        (f"{min(times):.1f} to {max(times):.1f} s", f"to build certified shells of {len(views)} meshes"),
        [("shells.png", "Shells cut open layer by layer: outer surface (red), mesh, inner surface (blue).")],
        [("The mesh is between both surfaces", "sampled at 100K points: 499 of 500 models", [f"proved for every point: {all_of_them}"]),
         ("The gradient does not vanish", "“no critical points are observed”", [f"proved: {all_of_them}"]),
         ("Thickness (of the bounding box), cells, and time with the proof", "Figure 8: plots over the resolution", lines)])


def make_simplification(making):
    names = "anchor_dense", "triceratops"
    meshes = [MESHES / f"{name}.off" for name in names]
    found = [json.loads(line) for line in making.run("simplify_benchmark", *meshes).splitlines()]
    for name, mesh in zip(names, meshes):
        making.run("simplify_and_transfer", mesh, "--output", making.folder / name)
        making.draw("render_shell.main", making.folder / name, f"{name}.png")

    def lines(text):
        return [f"{name}: {text(of_mesh, of_mesh['plain'], of_mesh['in_shell'])}" for name, of_mesh in zip(names, found)]
    pairs = [sum(of_mesh[which]["self_intersections"] for of_mesh in found) for which in ("plain", "in_shell")]
    return Results(
        ("{} → {}".format(*pairs), "pairs of intersecting facets: plain edge collapse, and in the shell"),
        [("anchor_dense.png", "The mesh; the mesh simplified as far as the shell allows, with transferred colors; "
                               "a section through both and the shell."),
         ("triceratops.png", "The same for a mesh about as fine as that of the paper.")],
        [("Facets", f"{count(6494)} → 300", lines(lambda mesh, plain, ours: f"{count(mesh['facets'])} → {count(ours['facets'])}")),
         ("Plain quadric edge collapse to the same number of facets", "“introduces self-intersections”",
          lines(lambda mesh, plain, ours: f"{plain['self_intersections']} pairs of facets intersect")),
         ("In the shell", "“significantly reduces the likelihood”",
          lines(lambda mesh, plain, ours: f"{ours['self_intersections']} pairs; {'proved' if ours['certified'] else 'not proved'}")),
         ("Hausdorff distance (of the bounding box): plain → in the shell", NOT_GIVEN,
          lines(lambda mesh, plain, ours: f"{percent(100 * plain['hausdorff'])} → {percent(100 * ours['hausdorff'])}")),
         ("Time in seconds: plain → in the shell, with the proof", NOT_GIVEN,
          lines(lambda mesh, plain, ours: f"{plain['seconds']:.2g} → {ours['seconds']['total']:.2g}"))])


def make_geodesics(making):
    # edges along the box, source, direction of view, up
    meshes = {
        "rotor": (100, 1, (0.6, 0.9, 0.7), (0, 0, 1)),
        "dino": (150, 0, (1, -0.7, 0.3), (0, 0, 1)),
        "elephant": (100, 0, (0.3, 0.15, 1), (0, 1, 0)),
    }
    directly, by_proxy, means = [], [], []
    for name, (edges, source, direction, up) in meshes.items():
        output = making.run("heat_geodesics", MESHES / f"{name}.off", edges, source, folder=name)
        for where, lines in (("on the mesh itself", directly), ("on the proxy, transferred back", by_proxy)):
            mean, most = parsed(rf"{where}: mean error (\S+) %, maximum error (\S+) %", output)
            lines.append(f"{name}: {percent(mean)} ({percent(most)})")
            means.append(percent(mean))
        making.draw("draw_geodesics.draw_geodesics", making.folder / name / "heat_geodesics", direction, up, f"{name}.png")
    return Results(
        (f"{means[0]} → {means[1]}", "mean error of the distances on rotor"),
        [("rotor.png", "Above: the mesh, the heat method on it, and exact distances. "
                       "Below: the proxy, the heat method on it, and the distances transferred back."),
         ("dino.png", "Dino, with thin legs and a thin neck."),
         ("elephant.png", "Elephant, with well-shaped triangles.")],
        [("Heat method on the mesh: mean error (maximum)", "“highly inaccurate”", directly),
         ("Heat method on a proxy in the shell, transferred back", "“better aligns with the exact geodesic computation”", by_proxy)])


def make_elasticity(making):
    mesh = MESHES / "anchor.off"
    output = making.run("elastic_proxy", mesh, 25)
    facets, of_proxy, tetrahedra = parsed(r"mesh: (\d+) facets; proxy: (\d+) facets, the border of (\d+) tetrahedra", output)
    iterations, steps, least = parsed(r"(\d+) iterations in (\d+) load steps; smallest Jacobian determinant: (\S+)", output)
    moved, = parsed(r"maximum displacement: (\S+) of", output)
    making.draw("draw_elasticity.draw_elasticity", mesh, making.folder, "bent.png")
    return Results(
        (count(tetrahedra), "tetrahedra, to bend a solid whose surface mesh consists of needles"),
        [("bent.png", "A mesh of needles; its proxy; the proxy filled with tetrahedra; the bent mesh, colored by displacement.")],
        [("Facets: mesh → proxy", NOT_GIVEN, [f"{count(facets)} → {count(of_proxy)}"]),
         ("Tetrahedra (TetGen)", "“conforming tetrahedral mesh”", [f"{count(tetrahedra)}; their border has exactly the facets of the proxy"]),
         ("Solved", "“nonlinear plastic deformation”", [f"nonlinear elasticity: {iterations} iterations in {steps} load steps",
                                                        f"smallest Jacobian determinant: {float(least):.2g}"]),
         ("Back on the mesh", "“the solution is transferred back”",
          [f"displacements of all vertices, up to {percent(100 * float(moved))} of the bounding box"])])


def make_booleans(making):
    output = making.run("boolean_colors", MESHES / "bear.off")
    before, after = parsed(r"facets: (\d+) before, (\d+) after", output)
    curve_before, curve = parsed(r"edges of the intersection curve: (\d+) before, (\d+) after", output)
    others, = parsed(r"facets with most of their image on the other solid: (\d+)", output)
    making.draw("draw_colors.draw_boolean", making.folder / "boolean", (0.4, 0.3, 1), (0, 1, 0), "union.png")
    return Results(
        (f"{count(before)} → {count(after)}", "facets of a union that keeps its colors"),
        [("union.png", "The union of two bears, and the union simplified in its shell. The intersection curve is black.")],
        [("Facets", "“low-poly mesh”", [f"{count(before)} → {count(after)}"]),
         ("Edges of the intersection curve", NOT_GIVEN, [f"{count(curve_before)} → {count(curve)}"]),
         ("Colors", "“effectively preserves the original color information”",
          [f"{others} of {count(after)} facets have most of their image on the other solid"])])


def make_closest_point(making):
    from drawing import wrong_side
    making.script(ROOT / "benchmark/Bspline_shell_3/Robustness/thin_models.py", making.folder / "thin")
    making.run("figure_data", "sides", making.folder / "thin/bowl_2.off", making.folder / "bowl", 0.1)
    making.draw("draw_colors.draw_sides", making.folder / "bowl", "bowl.png")
    closest, mapped = (percent(100 * wrong_side(f"{making.folder}/bowl_{part}.ply")) for part in ("closest_point", "shell_map"))
    return Results(
        (f"{closest} → {mapped}", "of the area has the color of the wrong side: closest point, and shell map"),
        [("bowl.png", "A thin bowl is simplified and painted inside and outside, and the colors are transferred back. "
                      "Below, a section: from the inside, the closest point is often on the outside.")],
        [("By the closest point: wrong color", "“artifacts due to discontinuities and a lack of bijectivity”", [f"{closest} of the area"]),
         ("Along the integral curves: wrong color", "“a unique corresponding point”", [f"{mapped} of the area"])])


def make_self_intersections(making):
    output = making.run("soup_proxy", "figure")
    polygons, facets, carried, continued, hidden = parsed(
        r"polygons: (\d+); facets of the proxy: (\d+)\n"
        r"area: (\S+) % carried along curves, (\S+) % continued to the nearest point, (\S+) % hidden", output)
    simplified, = parsed(r"facets after simplification: (\d+)", output)
    parts, texture = parsed(r"; (\d+) without a part, (\d+) without texture", output)
    making.run("figure_data", "soup", making.folder / "figure")
    making.draw("draw_textures.draw_soup", making.folder / "figure", "figure.png")
    of_visible = percent(100 * float(carried) / (100 - float(hidden)))
    return Results(
        (of_visible, "of the visible area of a broken model is mapped one-to-one"),
        [("figure.png", "Intersecting polygons; a clean proxy with their texture; a section with the proxy (red), and the polygons where they "
                        "are carried along curves (green), continued to the nearest point (yellow), and hidden (gray).")],
        [("Shell", "inner and outer surface differ in topology",
          [f"certified, for a proxy with {count(facets)} facets around {count(polygons)} polygons"]),
         ("One-to-one", "“cannot be guaranteed”",
          [f"carried one-to-one along curves: {percent(carried)} of the area", f"continued to the nearest point: {percent(continued)}",
           f"hidden: {percent(hidden)}"]),
         ("Parts and texture on the simplified proxy", NOT_GIVEN,
          [f"{count(simplified)} facets: {parts} without a part, {texture} without texture"])])


def make_fields(making):
    # mesh, directions, target number of facets; direction of view and up of the drawing
    fields = [
        ("elephant", 1, 1200, ((0.4, 0.15, 1), (0, 1, 0))),
        ("bunny00", 4, 2000, ((0.2, 0.2, 1), (0, 1, 0))),
        ("elephant", 4, 1200, None),
    ]
    found, facets, singularities, sums, angles, panels = [], [], [], [], [], []
    for name, directions, number, view in fields:
        folder = f"{name}_{directions}"
        output = making.run("transfer_direction_field", MESHES / f"{name}.off", directions, number, folder=folder)
        kind = f"{name}, {'vectors' if directions == 1 else 'crosses'}"
        facets.append("{}: {} → {}".format(kind, *map(count, parsed(r"facets: (\d+) before, (\d+) after", output))))
        before, after, same = parsed(r"singularities: (\d+) before, (\d+) after; (\d+) of them at their images", output)
        singularities.append(f"{kind}: {before} → {after}, {same} of them at their images")
        sums.append("{}: {} → {}".format(kind, *parsed(r"sum of indices: (\S+) before, (\S+) after", output)))
        angle, = parsed(r"mean error after the round trip: (\S+) degrees", output)
        angles.append(f"{kind}: {float(angle):.1f}°")
        if view:
            found.append(f"{same} of {before}")
            panels.append((directions, str(making.folder / folder), *view))
    making.draw("draw_fields.draw_fields", panels, "fields.png")
    return Results(
        (", ".join(found), "singularities are preserved, for the two fields in the picture"),
        [("fields.png", "Smoothest fields on two meshes, and on the meshes simplified in their shells: vectors above, crosses below.")],
        [("Facets", NOT_GIVEN, facets),
         ("Singularities", "“smooth and consistent data propagation”",
          [*singularities, "singularities that are closer than the facets are large cancel or add up"]),
         ("Sum of the indices", NOT_GIVEN, sums),
         ("Mean error after the round trip", "“bidirectional field mapping”", angles)])


FIGURES = [
    Figure(
        "shells", "Certified shells of meshes",
        "Two thresholds of a smooth function enclose each mesh. Cells are refined until it is proved that every point of the mesh is inside, and "
        "that the curves across the shell define a one-to-one map.",
        "In all cases, our algorithm successfully generates well-defined implicit shells.", "Figure 6, Section 5.2",
        (100, 50, 7), ["simplify_and_transfer"], make_shells),
    Figure(
        "gamma", "Effect of the resolution",
        "Equal cells lose details that are smaller than a cell: the shell becomes thick, and its surfaces lose hands and feet. Adaptive cells, "
        "which are small where the proof needs it, keep the details.",
        "A larger γ results in shells that better preserve the geometric features of the input model, whereas a smaller γ leads to a loss of "
        "geometric details.", "Figure 7, Section 5.2",
        (300, 0, 18), ["resolution_benchmark"], make_gamma),
    Figure(
        "gamma_impact", "Cost of the resolution",
        "Finer equal cells yield a thinner shell, and take longer. They do not ensure that the map is one-to-one.",
        "… highlighting its dual impact on geometric fidelity (shell thickness) and computational efficiency.", "Figure 8, Section 5.2",
        (300, 0, 40), ["resolution_benchmark"], make_gamma_impact),
    Figure(
        "mu", "Effect of the weight",
        "Distances are transferred to another mesh in the shell and back. With a small weight, the gradient faces the wrong way in places, and "
        "distances are wrong there. With a large weight, the shell is thick, and some curves do not reach the other mesh.",
        "… proper tuning of μ is essential for preserving bijectivity and ensuring accurate attribute transfer.", "Figure 10, Section 5.4",
        (320, 5, 14), ["weights_benchmark"], make_mu),
    Figure(
        "simplification", "Simplification without self-intersections",
        "Edge collapse in the shell cannot make a mesh intersect itself. The map transfers the attributes to the simplified mesh.",
        "While QEM successfully reduces the triangle count, it introduces self-intersections.", "Figure 11",
        (300, 50, 20), ["simplify_benchmark", "simplify_and_transfer"], make_simplification),
    Figure(
        "geodesics", "Accurate distances on bad triangles",
        "The heat method needs well-shaped triangles. It is applied to a remeshed proxy in the shell, and the distances are transferred back.",
        "When applying the heat method to a low-quality input mesh, the resulting distance field is highly inaccurate and deviates significantly "
        "from the exact discrete geodesic distance.", "Figures 1, 9 and 14",
        (300, 50, 12), ["heat_geodesics"], make_geodesics),
    Figure(
        "elasticity", "Bending a solid with a bad surface mesh",
        "Boundary conditions are transferred to the proxy, and displacements back to every vertex of the mesh. "
        "The facets of the mesh need not be good finite elements.",
        "Finally, the solution is transferred back to the original mesh, yielding the final deformed result.", "Figure 13",
        (205, 100, 90), ["elastic_proxy"], make_elasticity),
    Figure(
        "booleans", "A union keeps its colors",
        "Each facet has the label of its solid. Edges of the intersection curve are collapsed along the curve, all other edges as the shell allows.",
        "The union of two input models with distinct colors undergoes remeshing within our shell, and the resulting low-poly mesh effectively "
        "preserves the original color information.", "Figure 15",
        (205, 100, 60), ["boolean_colors"], make_booleans),
    Figure(
        "fields", "Transfer of direction fields",
        "The differential of the map transfers vectors and crosses to the simplified mesh and back. Singularities are preserved if the facets are "
        "small enough to separate them.",
        "This operator ensures seamless transfer of both vector fields and cross-field, enabling smooth and consistent data propagation.", "Figure 12",
        (205, 100, 85), ["transfer_direction_field"], make_fields),
    Figure(
        "closest_point", "Where the closest point is wrong",
        "Attributes are usually transferred to the closest point. This fails where a wall is thinner than the distance between the meshes.",
        "… simple orthogonal, spherical, and cage-based projections, which, despite their efficiency, often introduce artifacts due to "
        "discontinuities and a lack of bijectivity.", "Section 2.3; no figure",
        (300, 50, 20), ["figure_data"], make_closest_point),
    Figure(
        "self_intersections", "A surface for a polygon soup",
        "Polygons that intersect, face inconsistently or leave gaps get a clean proxy with a certified shell. The map reports for which of their "
        "points it is proved.",
        "… due to the topological discrepancy between the two surfaces, a bijective projection in the shell space cannot be guaranteed.",
        "Figure 16, a limitation",
        (300, 50, 50), ["soup_proxy", "figure_data"], make_self_intersections),
]
