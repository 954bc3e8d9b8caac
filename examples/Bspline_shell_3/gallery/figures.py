"""The figures of the gallery: contents, quotation of the paper, programs, and measurements."""
import json
from collections import namedtuple

from paths import HERE, MESHES, ROOT
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
        found = json.loads(making.run("bspline_shell", "shell", MESHES / f"{name}.off", "-o", making.folder / name, "--json"))
        certified += found["certification"] == "certified"
        times.append(found["seconds"])
        lines.append(f"{name}: {percent(100 * found['relative_thickness'])}, {count(found['cells'])} cells, {times[-1]:.1f} s")
        shells.append((str(making.folder / name), f"{name}: {found['facets']} facets", *view))
    making.draw("drawing.draw_layers", shells, "shells.png")
    all_of_them = f"{certified} of {len(views)}"
    return Results(
        (f"{min(times):.1f} to {max(times):.1f} s", f"for certified shells of {len(views)} meshes, proofs included"),
        [("shells.png", "Shells with their layers removed one by one: outer surface (red), mesh, and inner surface (blue).")],
        [("The mesh lies between the two surfaces", "sampled at 100K points: 499 of 500 models", [f"proved for every point: {all_of_them}"]),
         ("The gradient does not vanish", "“no critical points are observed”", [f"proved: {all_of_them}"]),
         ("Thickness, relative to the box size; cells; seconds, proof included", "Figure 8: plots over the resolution", lines)])


def make_simplification(making):
    names = "anchor_dense", "triceratops"
    meshes = [MESHES / f"{name}.off" for name in names]
    found = [json.loads(line) for line in making.run("simplify_benchmark", *meshes).splitlines()]
    for name, mesh in zip(names, meshes):
        making.run("bspline_shell", "simplify", mesh, "-o", making.folder / f"{name}_simplified.ply", "--shell", making.folder / name,
                   "--view", making.folder / f"{name}.html")
        making.script(HERE.parent / "paint_meshes.py", making.folder / name)
        making.run("bspline_shell", "transfer", *(making.folder / f"{name}_{part}.ply" for part in ("painted", "subdivided")),
                   "-o", making.folder / f"{name}_detail.ply")
        making.draw("render_shell.main", making.folder / name, f"{name}.png")

    def lines(text):
        return [f"{name}: {text(of_mesh, of_mesh['plain'], of_mesh['in_shell'])}" for name, of_mesh in zip(names, found)]
    pairs = [sum(of_mesh[which]["self_intersections"] for of_mesh in found) for which in ("plain", "in_shell")]
    return Results(
        ("{} → {}".format(*pairs), "pairs of intersecting facets: plain edge collapse → in the shell"),
        [("anchor_dense.png", "Left: the mesh. Middle: the mesh simplified as far as the shell allows, with transferred colors. "
                             "Right: a cross section of both meshes and the shell."),
         ("triceratops.png", "The same for a mesh with about as many facets as the paper's.")],
        [("Facets", f"{count(6494)} → 300", lines(lambda mesh, plain, ours: f"{count(mesh['facets'])} → {count(ours['facets'])}")),
         ("Plain quadric edge collapse, to the same number of facets", "“introduces self-intersections”",
          lines(lambda mesh, plain, ours: f"{plain['self_intersections']} pairs of facets intersect")),
         ("In the shell", "“significantly reduces the likelihood”",
          lines(lambda mesh, plain, ours: f"{ours['self_intersections']} pairs; {'certified' if ours['certified'] else 'not certified'}")),
         ("Hausdorff distance, relative to the box size: plain → in the shell", NOT_GIVEN,
          lines(lambda mesh, plain, ours: f"{percent(100 * plain['hausdorff'])} → {percent(100 * ours['hausdorff'])}")),
         ("Time in seconds: plain → in the shell, with the proof", NOT_GIVEN,
          lines(lambda mesh, plain, ours: f"{plain['seconds']:.2g} → {ours['seconds']['total']:.2g}"))],
        [(f"{name}.html", f"{name} and its map") for name in names])


def make_geodesics(making):
    # edges along the longest side of the bounding box, source, direction of view, up
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
        [("rotor.png", "Top: the mesh, distances by the heat method on it, and exact distances. Bottom: the remeshed mesh, distances by the "
                      "heat method on it, and these distances transferred back to the mesh."),
         ("dino.png", "Dino, with thin legs and neck."),
         ("elephant.png", "Elephant, whose triangles are well shaped.")],
        [("Heat method on the mesh: mean error (largest)", "“highly inaccurate”", directly),
         ("On the mesh remeshed in its shell, transferred back", "“better aligns with the exact geodesic computation”", by_proxy)])


def make_elasticity(making):
    mesh = MESHES / "anchor.off"
    output = making.run("elastic_proxy", mesh, 25)
    facets, of_proxy, tetrahedra = parsed(r"mesh: (\d+) facets; proxy: (\d+) facets, the border of (\d+) tetrahedra", output)
    iterations, steps, least = parsed(r"(\d+) iterations in (\d+) load steps; smallest Jacobian determinant: (\S+)", output)
    moved, = parsed(r"maximum displacement: (\S+) of", output)
    making.draw("draw_elasticity.draw_elasticity", mesh, making.folder, "bent.png")
    return Results(
        (count(tetrahedra), "tetrahedra in a solid whose surface triangles are needles"),
        [("bent.png", "Top: a mesh of needles, and the remeshed mesh. Bottom: the tetrahedra that fill the remeshed mesh, cut open, and the "
                     "bent mesh, colored by displacement.")],
        [("Facets: mesh → remeshed mesh", NOT_GIVEN, [f"{count(facets)} → {count(of_proxy)}"]),
         ("Tetrahedra (TetGen)", "“conforming tetrahedral mesh”", [f"{count(tetrahedra)}; their boundary facets are those of the remeshed mesh"]),
         ("Problem", "“nonlinear plastic deformation”", [f"nonlinear elasticity: {iterations} iterations in {steps} load steps",
                                                         f"smallest ratio of deformed to initial volume: {float(least):.2g}"]),
         ("Back on the mesh", "“the solution is transferred back”",
          [f"displacements at all vertices, of up to {percent(100 * float(moved))} of the box size"])])


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
          [f"{others} of {count(after)} facets have another color than most of their image"])])


def make_closest_point(making):
    from drawing import wrong_side
    making.script(ROOT / "benchmark/Bspline_shell_3/Robustness/thin_models.py", making.folder / "thin")
    making.run("figure_data", "sides", making.folder / "thin/bowl_2.off", making.folder / "bowl", 0.1)
    making.draw("draw_colors.draw_sides", making.folder / "bowl", "bowl.png")
    closest, mapped = (percent(100 * wrong_side(f"{making.folder}/bowl_{part}.ply")) for part in ("closest_point", "shell_map"))
    return Results(
        (f"{closest} → {mapped}", "of the area has the color of the wrong side: closest point → map"),
        [("bowl.png", "A thin bowl is simplified and painted inside and outside, and the colors are transferred back. Bottom: a cross "
                      "section. For points inside, the closest point is often on the outside.")],
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
        (of_visible, "of the visible area of a polygon soup is mapped one-to-one"),
        [("figure.png", "Left: intersecting polygons. Middle: their proxy, simplified, with their texture. Right: a cross section of the "
                        "proxy (red), and of the polygons, which are mapped along curves (green) or hidden inside (gray).")],
        [("Shell", "inner and outer surface differ in topology",
          [f"certified, for a proxy with {count(facets)} facets around {count(polygons)} polygons"]),
         ("One-to-one", "“cannot be guaranteed”",
          [f"mapped along curves, one-to-one: {percent(carried)} of the area", f"mapped to the nearest point: {percent(continued)}",
           f"hidden inside: {percent(hidden)}"]),
         ("Parts and texture, on the simplified proxy", NOT_GIVEN,
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
        (", ".join(found), "singularities are kept, in the two fields shown"),
        [("fields.png", "Left: the smoothest fields on two meshes, vectors (top) and crosses (bottom). Right: the fields on the simplified meshes.")],
        [("Facets", NOT_GIVEN, facets),
         ("Singularities", "“smooth and consistent data propagation”",
          [*singularities, "pairs closer to each other than the size of the simplified facets cancel or merge"]),
         ("Sum of their indices", NOT_GIVEN, sums),
         ("Mean angle between the field and its round trip", "“bidirectional field mapping”", angles)])


FIGURES = [
    Figure(
        "shells", "Certified shells",
        "A smooth function defines the inner and the outer surface of each shell. Its cells are refined until it is proved that the mesh lies "
        "between the two surfaces, and meets each of the curves that map it to other meshes in exactly one point.",
        "In all cases, our algorithm successfully generates well-defined implicit shells.", "Figure 6, Section 5.2",
        (100, 50, 7), ["bspline_shell"], make_shells),
    Figure(
        "gamma", "Effect of the resolution γ",
        "γ is the number of equal cells along the longest side of the bounding box. Details smaller than a cell are lost: the shell becomes thick, "
        "and its surfaces lose their hands and feet. Cells that are refined where the proof requires it preserve them.",
        "A larger γ results in shells that better preserve the geometric features of the input model, whereas a smaller γ leads to a loss of "
        "geometric details.", "Figure 7, Section 5.2",
        (300, 0, 18), ["resolution_benchmark"], make_gamma),
    Figure(
        "gamma_impact", "Cost of the resolution γ",
        "Smaller equal cells give a thinner shell but take longer, and do not guarantee that its map is one-to-one.",
        "… highlighting its dual impact on geometric fidelity (shell thickness) and computational efficiency.", "Figure 8, Section 5.2",
        (300, 0, 40), ["resolution_benchmark"], make_gamma_impact),
    Figure(
        "mu", "Effect of the weight μ",
        "The fit weighs directions against distances by μ. Here, geodesic distances are transferred to another mesh in the shell and back. If μ is "
        "small, the gradient points to the wrong side of some facets, and some distances are wrong; if μ is large, the shell is thick, and some "
        "curves do not reach the other mesh.",
        "… proper tuning of μ is essential for preserving bijectivity and ensuring accurate attribute transfer.", "Figure 10, Section 5.4",
        (320, 5, 14), ["weights_benchmark"], make_mu),
    Figure(
        "simplification", "Simplification without self-intersections",
        "A mesh that is simplified in its shell does not intersect itself, and the attributes are transferred to it along the curves.",
        "While QEM successfully reduces the triangle count, it introduces self-intersections.", "Figure 11",
        (300, 50, 20), ["simplify_benchmark", "bspline_shell"], make_simplification),
    Figure(
        "geodesics", "Accurate distances on badly shaped triangles",
        "The heat method requires well-shaped triangles. It is applied to the mesh remeshed in its shell, and the distances are transferred back "
        "along the curves.",
        "When applying the heat method to a low-quality input mesh, the resulting distance field is highly inaccurate and deviates significantly "
        "from the exact discrete geodesic distance.", "Figures 1, 9 and 14",
        (300, 50, 12), ["heat_geodesics"], make_geodesics),
    Figure(
        "elasticity", "Elasticity on a mesh of needles",
        "The boundary conditions are transferred to the remeshed mesh, which is filled with tetrahedra, and the displacements are transferred back "
        "to every vertex. The facets of the mesh need not be good finite elements.",
        "Finally, the solution is transferred back to the original mesh, yielding the final deformed result.", "Figure 13",
        (205, 100, 90), ["elastic_proxy"], make_elasticity),
    Figure(
        "booleans", "A union keeps its colors",
        "Each facet is labeled with its solid. Edges of the intersection curve are collapsed along the curve, and all other edges as the shell "
        "allows.",
        "The union of two input models with distinct colors undergoes remeshing within our shell, and the resulting low-poly mesh effectively "
        "preserves the original color information.", "Figure 15",
        (205, 100, 60), ["boolean_colors"], make_booleans),
    Figure(
        "fields", "Vector fields and cross fields",
        "Vectors and crosses are transferred to the simplified mesh and back by the differential of the map. Singularities are kept if the facets "
        "of the simplified mesh are small enough to separate them.",
        "This operator ensures seamless transfer of both vector fields and cross-field, enabling smooth and consistent data propagation.", "Figure 12",
        (205, 100, 85), ["transfer_direction_field"], make_fields),
    Figure(
        "closest_point", "Where closest points fail",
        "Attributes are usually transferred from the closest point. This fails where a wall is thinner than the distance between the meshes.",
        "… simple orthogonal, spherical, and cage-based projections, which, despite their efficiency, often introduce artifacts due to "
        "discontinuities and a lack of bijectivity.", "Section 2.3; no figure",
        (300, 50, 20), ["figure_data"], make_closest_point),
    Figure(
        "self_intersections", "A surface for a polygon soup",
        "Polygons that intersect, have inconsistent orientations, or leave gaps get a proxy: a closed mesh around them, with a certified shell. The "
        "polygons are mapped to the proxy one-to-one where they are visible along the curves; all other points are marked.",
        "… due to the topological discrepancy between the two surfaces, a bijective projection in the shell space cannot be guaranteed.",
        "Figure 16, a limitation",
        (300, 50, 50), ["soup_proxy", "figure_data"], make_self_intersections),
]
