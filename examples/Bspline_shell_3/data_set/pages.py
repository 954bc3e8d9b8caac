"""Writes the results of a data set: table.csv, index.html, and a page for each mesh. The pages work offline.

Usage: pages.py BATCHES     (BATCHES: the number of files batches/N.jsonl)
"""
import csv
import io
import json
import sys
from collections import Counter
from html import escape
from pathlib import Path
from statistics import median
from textwrap import shorten
from urllib.parse import quote

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
BLUE, RED, SOFT = "#336bd9", "#d94033", "#5b6472"

# columns: key, title, format, description
COLUMNS = (
    ("kind", "Kind", str, "mesh of the shell: closed, truncated at singular vertices, virtually closed (an open mesh), united (closed parts that intersect), excised (without triangles that have defects), or a proxy of a polygon soup"),
    ("facets", "Facets", "{:,}", "number of triangles of the mesh or the proxy"),
    ("simplified_facets", "Simplified", "{:,}", "number of triangles of the simplified mesh"),
    ("thickness", "Thickness", "{:.2f} %", "thickness of the shell, in percent of the longest side of the bounding box"),
    ("distance", "Distance", "{:.2f} %",
     "no point of the mesh or of the simplified mesh is farther than this from the other, in percent of the longest side of the bounding box"),
    ("cells", "Cells", "{:,}", "number of cells of the field that defines the shell"),
    ("seconds", "Time", "{:.1f} s", "time without drawing the picture"),
    ("peak_mb", "Memory", "{:,.0f} MB", "peak memory"),
)
EXTRA = "file", "exit", "reason", "cpu_seconds", "points_without_image", "drawing_seconds"


def write(path, text):
    """Writes a complete file, or no file."""
    part = Path(f"{path}.part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


def row(record):
    """Returns a record's row of the table."""
    report = record.get("report") or {}
    simplified = record["simplified"] if record["outcome"] == "done" else {}     # otherwise, an error
    shell = report.get("shell", {})
    certified = report.get("status", "").startswith("certified")

    def percentage(length):
        return 100 * length / shell["unit"]
    return {
        "name": record["name"], "outcome": record["outcome"], "kind": report.get("kind"),
        # The report also counts facets that close an open mesh.
        "facets": simplified.get("facets_before", shell.get("facets")),
        "simplified_facets": simplified.get("facets"), "thickness": percentage(shell["thickness"]) if certified else None,
        "distance": percentage(max(simplified["distance_to_result"], simplified["distance_to_input"])) if simplified else None,
        "cells": shell.get("cells"), "seconds": record.get("seconds"), "peak_mb": record.get("peak_mb"), "file": record["file"],
        "exit": record["exit"], "reason": record["reason"], "cpu_seconds": record.get("cpu_seconds"),
        "points_without_image": simplified.get("points_without_image"), "drawing_seconds": record.get("drawing_seconds")}


def write_table(path, rows):
    text = io.StringIO()
    writer = csv.DictWriter(text, ["name", "outcome", *(column[0] for column in COLUMNS), *EXTRA], lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write(path, text.getvalue())


def shown(value, form):
    if value is None:
        return ""
    return escape(value) if form is str else form.format(value)


def plot(draw, title):
    """Returns a plot as inline SVG."""
    figure, axes = plt.subplots(figsize=(4.2, 2.4), layout="constrained")
    draw(axes)
    axes.set_title(title, loc="left", fontsize=10, color="#1d2129")
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    axes.tick_params(colors=SOFT, labelsize=8, left=False)
    out = io.StringIO()
    figure.savefig(out, format="svg", transparent=True, metadata=dict.fromkeys(("Date", "Creator", "Format", "Type")))
    plt.close(figure)
    return out.getvalue()[out.getvalue().index("<svg"):]


def histogram(rows, key, title):
    values = np.array([r[key] for r in rows if r[key] is not None and r[key] > 0])
    if not len(values):
        return ""

    def draw(axes):
        low, high = values.min(), values.max()
        if high > 20 * low:
            axes.set_xscale("log")
            bins = np.geomspace(low, high, 25)
        else:
            bins = np.linspace(low, high if high > low else low * 1.01, 25)
        axes.hist(values, bins, color=BLUE)
        axes.yaxis.get_major_locator().set_params(integer=True)
    middle = median(values.tolist())
    return plot(draw, f"{title}; median {middle:,.0f}" if middle >= 100 else f"{title}; median {middle:.3g}")


def refusals(rows):
    counts = Counter(r["reason"] if r["outcome"] == "refused" else r["outcome"] for r in rows if r["outcome"] != "done").most_common(8)
    if not counts:
        return ""

    def draw(axes):
        names = [shorten(name, 62, placeholder=" ...") for name, _ in counts]
        bars = axes.barh(range(len(counts)), [n for _, n in counts], 0.4, color=RED)
        axes.bar_label(bars, padding=3, fontsize=8)
        for n, name in enumerate(names):
            axes.text(0, n - 0.32, name, fontsize=8, color=SOFT)
        axes.set_yticks([])
        axes.set_ylim(max(len(counts), 3) - 0.5, -0.7)
        axes.xaxis.get_major_locator().set_params(integer=True)
    return plot(draw, "Meshes without a result, by reason")


def page(path, title, lead, body):
    style = "".join((HERE / css).read_text(encoding="utf-8") for css in ("../gallery/page.css", "data_set.css"))
    write(path, f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(title)}</title>
<style>
{style}</style>
</head>
<body>
<header>
<h1>{escape(title)}</h1>
{lead}
</header>
<main>
{body}
</main>
</body>
</html>
""")


def badge(record):
    return f"<span class=\"{'good' if record['outcome'] == 'done' else 'bad'}\">{escape(record['outcome'])}</span>"


def obstacles(report):
    places = report.get("obstacles", [])
    if not places and "limit" not in report:
        return ""
    rows = "\n".join(f"<tr><td>{' '.join(f'{x:.6g}' for x in place['point'])}</td><td>{escape(place['message'])}</td></tr>" for place in places)
    limit = f"<p>{escape(report['limit'])}</p>\n" if "limit" in report else ""
    return f"""<section><h2>Where the proof fails</h2>
{limit}<table class="places"><thead><tr><th scope="col">Point</th><th scope="col">Obstacle</th></tr></thead>
<tbody>
{rows}
</tbody></table></section>"""


def offenders(report):
    """Returns the facets and vertices because of which the mesh itself is rejected."""
    return [(f"Offending {what}", ", ".join(map(str, found[:10])) + (" ..." if len(found) > 10 else ""))
            for what in ("facets", "vertices") if (found := report.get("mesh_itself", {}).get(what))]


def write_mesh_page(folder, record, line, before, after):
    report, name = record.get("report") or {}, record["name"]
    facts = [("File", record["file"]), *((title, shown(line[key], form)) for key, title, form, _ in COLUMNS)]
    if line["points_without_image"]:
        facts.append(("Points with attributes of the nearest point", f"{line['points_without_image']:,}"))
    if "mesh_itself" in report:
        facts.append(("The mesh itself", report["mesh_itself"]["message"]))
    facts += offenders(report)
    facts += [(claim.replace("_", " ").capitalize(), verdict) for claim, verdict in report.get("claims", {}).items()]
    facts += [(f"Repairs: {what.replace('_', ' ')}", str(number)) for what, number in report.get("repairs", {}).items() if number]
    table = "\n".join(f"<tr><th scope=\"row\">{escape(what)}</th><td>{escape(value)}</td></tr>" for what, value in facts if value)
    picture = "<figure><a href=\"picture.png\"><img src=\"picture.png\" alt=\"\"></a></figure>" if record.get("picture") else ""
    if record.get("picture") is False:
        picture = "<p class=\"failure\">The picture could not be drawn: see <a href=\"log.txt\">log.txt</a>.</p>"
    reason = f"<p class=\"failure\">{escape(record['reason'])}</p>" if record["reason"] else ""
    files = " ".join(f"<a href=\"{quote(file.name)}\">{escape(file.name)}</a>" for file in sorted(folder.iterdir())
                     if file.name not in ("index.html", "thumbnail.png", "running"))
    neighbors = " ".join(f"<a href=\"../{quote(other)}/index.html\">{text}</a>" for other, text in ((before, "Previous"), (after, "Next")) if other)
    page(folder / "index.html", name, f"<p class=\"links\">{badge(record)} <a href=\"../../index.html\">All meshes</a> {neighbors}</p>",
         f"{reason}\n{picture}\n<table class=\"facts\"><tbody>\n{table}\n</tbody></table>\n{obstacles(report)}\n"
         f"<section><h2>Files</h2><p class=\"links\">{files}</p></section>")


def write_index(records, rows):
    done = [r for r in rows if r["outcome"] == "done"]
    kinds = Counter(r["kind"] for r in done)
    hours = sum(r["seconds"] or 0 for r in rows) / 3600
    of_kinds = "".join(f"; {n:,} {kind}" for kind, n in kinds.most_common())
    facts = [(f"{len(done):,} of {len(rows):,}", f"meshes have a certified shell and are simplified in it{of_kinds}"),
             (f"{len(rows) - len(done):,}", "meshes without a result; their pages give the reason"),
             *([(f"{median(r['distance'] for r in done):.2f} %", "largest distance between both meshes, relative to the box: proved; median of the meshes")]
               if done else []),
             (f"{hours:.1f} h" if hours >= 1 else f"{60 * hours:.1f} min", "of processing time, without pictures")]
    cards = "\n".join(f"<div class=\"card\"><strong>{number}</strong><span>{escape(what)}</span></div>" for number, what in facts)
    plots = "\n".join(f"<figure>{svg}</figure>" for svg in (
        histogram(rows, "seconds", "Time (seconds)"), histogram(done, "cells", "Cells"),
        histogram(done, "thickness", "Thickness (% of the box size)"), refusals(rows)) if svg)
    heads = "".join(f"<th scope=\"col\" title=\"{escape(what)}\"><button>{title}</button></th>" for _, title, _, what in COLUMNS)
    lines = []
    for record, r in zip(records, rows):
        folder = f"meshes/{quote(r['name'])}"
        image = f"<img src=\"{folder}/thumbnail.png\" alt=\"\" loading=\"lazy\">" if record.get("picture") else ""
        cells = "".join(f"<td data-value=\"{'' if r[key] is None else escape(str(r[key]))}\">{shown(r[key], form)}</td>"
                        for key, _, form, _ in COLUMNS)
        reason = f"<small>{escape(shorten(r['reason'], 70, placeholder=' ...'))}</small>" if r["reason"] else ""
        lines.append(f"<tr><td>{image}</td><th scope=\"row\" data-value=\"{escape(r['name'])}\">"
                     f"<a href=\"{folder}/index.html\">{escape(r['name'])}</a>{reason}</th>"
                     f"<td data-value=\"{escape(r['outcome'])}\" title=\"{escape(r['reason'])}\">{badge(record)}</td>{cells}</tr>")
    script = (HERE / "table.js").read_text(encoding="utf-8")
    rows_of_table = "\n".join(lines)
    lead = f"{len(rows):,} meshes. For each: the certified shell, the simplified mesh, and a picture, or the reason why there is no result."
    page("index.html", "Data set", f"""<p class="lead">{lead}</p>
<p class="links"><a href="table.csv">table.csv</a></p>""", f"""<nav>
{cards}
</nav>
<div class="plots">
{plots}
</div>
<p class="filter"><input type="search" placeholder="Filter rows ..." aria-label="Filter rows"> <span id="count"></span></p>
<table class="meshes"><thead><tr><th></th><th scope="col"><button>Mesh</button></th><th scope="col"><button>Outcome</button></th>{heads}</tr></thead>
<tbody>
{rows_of_table}
</tbody></table>
<script>
{script}</script>""")


def main(batches):
    records = []
    for n in range(int(batches)):
        with open(f"batches/{n}.jsonl", encoding="utf-8") as lines:
            records += map(json.loads, lines)
    records.sort(key=lambda record: record["name"])
    rows = [row(record) for record in records]
    matplotlib.rcParams.update({"font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "svg.fonttype": "none", "svg.hashsalt": "data set"})
    names = [record["name"] for record in records]
    for record, line, before, after in zip(records, rows, [None, *names], [*names[1:], None]):
        write_mesh_page(Path("meshes") / record["name"], record, line, before, after)
    write_table("table.csv", rows)
    write_index(records, rows)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
