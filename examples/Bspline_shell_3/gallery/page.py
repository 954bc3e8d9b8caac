"""Writes the page with the complete figures, and the status of the others."""
import json
import os
from html import escape

from figures import FIGURES
from making import write
from paths import HERE, RESULTS, ROOT


def is_complete(figure):
    return (RESULTS / figure.name / "figure.json").exists()


def read(figure):
    """Returns the results of a figure, the reason for its failure, or None if it was not attempted."""
    if is_complete(figure):
        return json.loads((RESULTS / figure.name / "figure.json").read_text(encoding="utf-8"))
    unfinished = RESULTS / f"{figure.name}.part"
    if not unfinished.exists():
        return None
    failure = unfinished / "failure.txt"
    return {"failure": failure.read_text(encoding="utf-8") if failure.exists() else "The run was interrupted."}


def link(path):
    return os.path.relpath(ROOT / path, RESULTS)


def card(figure, results):
    number, what = results["headline"]
    picture = f"{figure.name}/{results['pictures'][0][0]}"
    width, x, y = figure.thumbnail
    return f"""<a class="card" href="#{figure.name}"><span class="thumbnail" style="background: white url('{picture}') {x}% {y}% / {width}%"></span>
<strong>{escape(number)}</strong><span>{escape(what)}</span></a>"""


def pictures(figure, results):
    shown = []
    for file, caption in results["pictures"]:
        path = f"{figure.name}/{file}"
        shown.append(f"""<figure><a href="{path}"><img src="{path}" alt="{escape(caption)}"></a>
<figcaption>{escape(caption)}</figcaption></figure>""")
    return "<div class=\"pictures\">\n" + "\n".join(shown) + "\n</div>"


def table(results):
    rows = "\n".join(f"<tr><th scope=\"row\">{escape(what)}</th><td data-of=\"Paper\">{escape(paper)}</td><td data-of=\"Here\">"
                     + "<br>".join(map(escape, here)) + "</td></tr>" for what, paper, here in results["rows"])
    return f"""<table><thead><tr><td></td><th scope="col">Paper</th><th scope="col">Here</th></tr></thead>
<tbody>
{rows}
</tbody></table>"""


def commands(results):
    lines = "\n".join(f"<li><code>{escape(command)}</code><span>{seconds:.1f} s</span></li>" for command, seconds in results["commands"])
    return f"<ul class=\"commands\">\n{lines}\n</ul>"


def section(figure, results):
    if "failure" in results:
        body = f"<p class=\"failure\">This figure could not be made. {escape(results['failure'])}</p>"
    else:
        body = "\n".join([pictures(figure, results), table(results), commands(results)])
    return f"""<section id="{figure.name}">
<h2>{escape(figure.title)}</h2>
<p class="text">{escape(figure.text)}</p>
<blockquote>“{escape(figure.quotation)}” <cite>{escape(figure.source)}</cite></blockquote>
{body}
</section>"""


def write_page():
    found = [(figure, read(figure)) for figure in FIGURES]
    shown = [(figure, results) for figure, results in found if results]
    cards = "\n".join(card(figure, results) for figure, results in shown if "failure" not in results)
    sections = "\n\n".join(section(figure, results) for figure, results in shown)
    missing = " ".join(figure.name for figure, results in found if results is None)
    more = f"<p>Some figures are missing: run <code>bash examples/gallery.sh {missing}</code></p>" if missing else ""
    minutes = sum(results.get("seconds", 0) for _, results in shown) / 60
    with open(f"{HERE}/page.css", encoding="utf-8") as style:
        css = style.read()
    write(RESULTS / "index.html", f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Cubic B-spline shells: gallery</title>
<style>
{css}</style>
</head>
<body>
<header>
<h1>Cubic B-spline shells</h1>
<p class="lead">A smooth shell around a triangle mesh defines a map to other meshes in the shell, which is proved to be one-to-one. Meshes can be
simplified, remeshed and repaired, and keep their attributes.</p>
<p class="links"><a href="{link('README.md')}">README</a> <a href="{link('doc/Bspline_shell_3/Bspline_shell_3.txt')}">User manual</a>
<a href="{link('doc/Bspline_shell_3/Measurements.txt')}">Measurements</a> <a href="{link('examples/Bspline_shell_3')}">Examples</a></p>
<p class="try"><code>bash examples/quickstart.sh MESH</code> simplifies your own mesh, and draws it.</p>
</header>
<main>
<nav>
{cards}
</nav>
{sections}
</main>
<footer>
{more}
<p>All programs and pictures above took {minutes:.1f} minutes on {os.cpu_count()} processors: <code>bash examples/gallery.sh</code></p>
<p>The figures are those of the paper <cite>Smooth Bijective Projection of Polygonal Meshes via a Cubic B-Spline Shell</cite> (2025), reproduced
on other meshes: meshes of CGAL's data folder, and models that the programs generate. All numbers are read from the output of the programs. Run the commands
in the folder of the package. Quotations omit references.</p>
</footer>
</body>
</html>
""")
