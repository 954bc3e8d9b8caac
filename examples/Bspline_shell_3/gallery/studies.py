"""The figures of the paper about its parameters gamma and mu."""
import json

from making import Failure
from paths import MESHES
from results import NOT_GIVEN, Results, count, percent


def read_lines(output):
    """Returns the lines that a benchmark printed about shells."""
    found = [json.loads(line) for line in output.splitlines()]
    refused = [line for line in found if "status" in line]
    if refused:
        raise Failure(f"{refused[0]['mesh']}: {refused[0]['status']}")
    return found


def verdict(shell):
    return "proved" if shell["certified"] else "not proved"


def make_gamma(making):
    mesh, direction, up = MESHES / "armadillo.off", (0.5, 0.3, -1), (0, 1, 0)
    toes = -62, -28, -62, -34
    prefix = making.folder / "armadillo"
    found = read_lines(making.run("resolution_benchmark", "--output", prefix, 2, 0.5, mesh))
    drawn = [shell for shell in found if shell["gamma"] in (30, 50, 90, 130, None)]
    making.draw("draw_studies.draw_surfaces", prefix, drawn, direction, up, "surfaces.png")
    making.draw("draw_studies.draw_sections", prefix, drawn, 2, toes, "sections.png")
    for file in making.folder.glob("armadillo_*"):      # 200 MB
        file.unlink()

    def lines(text):
        return [f"{'refined cells' if shell['gamma'] is None else 'γ = ' + format(shell['gamma'], 'g')}: {text(shell)}" for shell in found]
    finest, ours = found[-2:]
    return Results(
        (f"{count(finest['cells'])} → {count(ours['cells'])}", "cells of equally thin shells: equal → refined where the proof requires it"),
        [("surfaces.png", "Inner (blue) and outer (red) surfaces of shells of the armadillo, with bounds on |f| on the mesh in % of the box size."),
         ("sections.png", "Cross sections, with two toes enlarged, colored by f. White areas contain no cells.")],
        [("Largest |f| on the mesh", "0.19\u202f% at γ = 130, on a model of Thingi10K", lines(lambda shell: percent(100 * shell["largest_value"]))),
         ("Thickness, relative to the box size", NOT_GIVEN, lines(lambda shell: percent(100 * shell["thickness"]))),
         ("Cells; time", NOT_GIVEN, lines(lambda shell: f"{count(shell['cells'])}; {shell['seconds']:.1f} s")),
         ("One-to-one", NOT_GIVEN, lines(verdict))])


def make_gamma_impact(making):
    names = "bear", "blobby", "eight", "elephant", "fandisk", "homer", "retinal", "triceratops"
    found = [shell for name in names
             for shell in read_lines(making.run("resolution_benchmark", "--gamma", "30,50,70,90,110", MESHES / f"{name}.off"))]
    making.draw("draw_studies.draw_impact", found, "impact.png")
    gammas = sorted({shell["gamma"] for shell in found if shell["gamma"]})

    def lines(text):
        of_all = [(f"γ = {gamma}", [shell for shell in found if shell["gamma"] == gamma]) for gamma in gammas]
        return [f"{name}: {text(shells)}" for name, shells in of_all + [("refined cells", [shell for shell in found if not shell["gamma"]])]]

    def mean(name):
        return lambda shells: sum(shell[name] for shell in shells) / len(shells)

    def certified(shells):
        return sum(shell["certified"] for shell in shells)
    finest, ours = ([shell for shell in found if shell["gamma"] == gamma] for gamma in (gammas[-1], None))
    return Results(
        (f"{certified(finest)} → {certified(ours)} of {len(names)}",
         f"meshes whose map is proved to be one-to-one: equal cells at γ = {gammas[-1]} → refined cells"),
        [("impact.png", f"Time, thickness, and proofs for {len(names)} meshes. Times with refined cells include the proof; those with equal "
                        "cells do not. Refined cells give the requested thickness; equal cells give thin shells for smooth meshes, and "
                        "thick ones for others.")],
        [("Mean time", "plotted, as means over 100 models", lines(lambda shells: f"{mean('seconds')(shells):.2g} s")),
         ("Mean thickness, relative to the box size", "plotted", lines(lambda shells: percent(100 * mean("thickness")(shells)))),
         ("Samples in the shell", "100K points on each model: all, on 499 of 500 models",
          lines(lambda shells: f"all samples for {sum(shell['contained'] == 1 for shell in shells)} of {len(shells)} meshes")),
         ("Proved to be one-to-one", NOT_GIVEN, lines(lambda shells: f"{certified(shells)} of {len(shells)}"))])


def make_mu(making):
    direction, up = (0.6, 0.9, 0.7), (0, 0, 1)
    prefix = making.folder / "rotor"
    found = read_lines(making.run("weights_benchmark", "--mu", "1e-6,1e-4,1e-2,1e2", "--output", prefix, MESHES / "rotor.off"))
    making.draw("draw_studies.draw_weights", prefix, found, direction, up, "rotor.png")

    def lines(text):
        return [f"{'certified shell' if shell['mu'] is None else 'μ = ' + format(shell['mu'], 'g')}: {text(shell)}" for shell in found]

    def of_points(number, shell):
        return percent(100 * number / shell["points"]) if number else "none"
    worst = max(found, key=lambda shell: sum(shell["distances"]["errors"]))
    return Results(
        (f"{of_points(sum(worst['distances']['errors']), worst)} → {of_points(sum(found[-1]['distances']['errors']), found[-1])}",
         f"of the points have a wrong distance after the round trip: μ = {worst['mu']:g} → certified shell"),
        [("rotor.png", "Lines of equal distance on rotor, with the points whose distance is wrong after the round trip (purple) or missing "
                       "(gray), and their fractions. The vertices of the other mesh are moved by up to 40\u202f% of the way to a threshold; "
                       f"in the certified shell, by up to {percent(100 * found[-1]['moved'])}, as far as the mesh is certified.")],
        [("Distances with an error of more than 3\u202f% of the box size", "shown as histograms",
          lines(lambda shell: of_points(sum(shell["distances"]["errors"]), shell))),
         ("Points without a distance: without an image, or with one next to a vertex without a distance", NOT_GIVEN,
          lines(lambda shell: of_points(shell["distances"]["missing"], shell))),
         ("Points lost on the round trip; points with an error of more than 0.1\u202f% of the box size", NOT_GIVEN,
          lines(lambda shell: f"{of_points(shell['round_trip']['lost'], shell)}; "
                              f"{of_points(shell['round_trip']['0.03'] + shell['round_trip']['more'], shell)}")),
         ("Points where the gradient points to the wrong side of the facet", "“local gradient directions deviate”, if μ is small",
          lines(lambda shell: of_points(shell["wrong_side"] * shell["points"], shell))),
         ("Thickness, relative to the box size", "“the shell loses its geometric fidelity”, if μ is large",
          lines(lambda shell: percent(100 * shell["thickness"]))),
         ("Points in the shell", NOT_GIVEN,
          lines(lambda shell: "all" if shell["contained"] == 1 else of_points(shell["contained"] * shell["points"], shell)))])
