"""Checks the pages of --view in headless Chromium: pictures, keys, touch, and images of points against the library.

The exact images are those of the program: coordinates of the input are stored as properties, which it carries to the
result. Exits with 77 if Chromium is missing or cannot draw, or if the program makes no pages.

Usage: view_test.py BSPLINE_SHELL MESHES     (MESHES: the folder of CGAL's meshes)
"""
import base64
import math
import os
import re
import struct
import subprocess
import sys
import tempfile

from browser import Browser, find_chromium
from mesh_files import as_glb, as_obj, as_ply, read, read_ply, sphere, torus, write
from png_files import as_png, read_png

program, meshes = sys.argv[1:]
WRONG_INPUT, WRONG_USAGE, CANNOT_WRITE, NOT_CERTIFIED = 1, 2, 3, 4
WIDTH, HEIGHT = 1000, 700


def run(*arguments, code=0):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == code, done
    return done


def distance_to_triangle(p, a, b, c):
    """Returns the distance from a point of the triangle's prism to the plane, and otherwise from an edge."""
    sub = lambda u, v: [x - y for x, y in zip(u, v)]
    dot = lambda u, v: sum(x * y for x, y in zip(u, v))
    u, v, w = sub(b, a), sub(c, a), sub(p, a)
    d = dot(u, u) * dot(v, v) - dot(u, v) ** 2
    s = (dot(v, v) * dot(u, w) - dot(u, v) * dot(v, w)) / d
    t = (dot(u, u) * dot(v, w) - dot(u, v) * dot(u, w)) / d
    if s >= 0 and t >= 0 and s + t <= 1:
        return math.dist(p, [x + s * y + t * z for x, y, z in zip(a, u, v)])
    least = math.inf
    for q, r in ((a, b), (b, c), (c, a)):
        e = sub(r, q)
        k = min(max(dot(sub(p, q), e) / dot(e, e), 0), 1)
        least = min(least, math.dist(p, [x + k * y for x, y in zip(q, e)]))
    return least


def array_of(page, name):
    """Returns the doubles of an array in a page."""
    data = base64.b64decode(re.search(f'data-name="{name}"[^>]*>([^<]*)<', page).group(1))
    return struct.unpack(f"<{len(data) // 8}d", data)


def with_array(page, name, numbers):
    data = base64.b64encode(struct.pack(f"<{len(numbers)}f", *numbers)).decode()
    return page.replace("<script>", f'<script type="text/plain" data-name="{name}" data-type="Float32">{data}</script>\n<script>', 1)


def pixel(browser, x, y):
    """Returns the color at a place of the window."""
    file = os.path.join(browser.profile.name, "picture.png")
    browser.screenshot(file)
    return read_png(file)[2][y][x]


def center_of_view(browser, side, number=2):
    left, top, width, height = browser.run("(r => [r.left, r.top, r.width, r.height])(document.getElementById('stage').getBoundingClientRect())")
    return round(left + (side + 0.5) * width / number), round(top + height / 2)


def is_pressed(browser, button):
    return browser.run(f"document.getElementById('{button}').getAttribute('aria-pressed')") == "true"


def check_exact_images(browser, path):
    """A bumpy sphere far from the origin: each vertex of the result has the place on the input from which it gets its attributes."""
    center, (unit, triangles) = (1e5, -2e5, 3e4), sphere(24, 48)
    bump = lambda p: 1 + 0.1 * math.sin(5 * p[0]) * math.cos(4 * p[1])
    points = [tuple(c + bump(p) * x for c, x in zip(center, p)) for p in unit]
    names = [(name, "double", lambda p, a=a: p[a]) for a, name in enumerate(("x0", "y0", "z0"))]
    write(path("in.ply"), as_ply("binary_little_endian", points, triangles, names, [("label", "short", lambda p: 1 if p[2] > center[2] else 2)]))
    run("simplify", path("in.ply"), "-o", path("out.ply"), "--thickness", "3%", "--facets", 200, "--view", path("page.html"))
    result = read_ply(path("out.ply"))[2]
    column = lambda name: result["vertex"][1][name]
    vertices = list(zip(*(column(a) for a in "xyz")))
    exact = list(zip(*(column(a) for a in ("x0", "y0", "z0"))))
    nearest = lambda p: min(range(len(vertices)), key=lambda n: math.dist(p, vertices[n]))

    browser.open(path("page.html"))
    box, errors = 2.2, []
    for n in range(browser.run("shellView.numberOfVertices(1)")):
        found = browser.run(f"shellView.imageOfVertex(1, {n})")
        v = nearest(found["point"])
        assert math.dist(found["point"], vertices[v]) < 1e-6 * box, found
        errors.append(math.dist(found["image"], exact[v]) / box)
    moved = sum(math.dist(p, q) > 1e-3 for p, q in zip(vertices, exact))
    assert moved > len(vertices) / 2, moved
    print("images of vertices of the result: largest difference %.2g of the box" % max(errors))
    assert max(errors) < 1e-4, max(errors)

    # Images of vertices of the input lie on the result.
    faces = result["face"][1]["vertex_indices"]
    for n in range(0, browser.run("shellView.numberOfVertices(0)"), 20):
        image = browser.run(f"shellView.imageOfVertex(0, {n})")["image"]
        assert min(distance_to_triangle(image, *(vertices[v] for v in f)) for f in faces) < 1e-5 * box, image

    # The pointer shows the same map in both directions, and the curve passes through the point and its image.
    x, y = center_of_view(browser, 0)
    browser.click(x, y)
    there = browser.run("shellView.cursor")
    assert there["side"] == 0 and max(min(math.dist(q, p) for q in there["curve"]) for p in (there["point"], there["image"])) < 0.01 * box, there
    assert "Image" in browser.run("document.getElementById('cursor').textContent")
    browser.key("Escape")
    assert browser.run("shellView.cursor") is None
    browser.point(5, y)
    assert browser.run("shellView.cursor") is None
    return x, y


def check_without_field(browser, path, place):
    """A page without the field interpolates between images of vertices."""
    page = read(path("page.html")).decode()
    center = array_of(page, "center")
    browser.open(path("page.html"))
    browser.click(*place)
    exact = browser.run("shellView.cursor")
    images = [browser.run(f"Array.from({{ length: shellView.numberOfVertices({side}) }}, (_, n) => shellView.imageOfVertex({side}, n).image)")
              for side in (0, 1)]
    page = page.replace('data-name="field.frame"', 'data-name="unused"')
    for side in (0, 1):
        page = with_array(page, f"mesh{side}.images", [x - c for image in images[side] for x, c in zip(image, center)])
    write(path("without.html"), page)
    browser.open(path("without.html"))
    browser.click(*place)
    found = browser.run("shellView.cursor")
    assert found["point"] == exact["point"] and "curve" not in found, found
    assert 0 < math.dist(found["image"], exact["image"]) < 0.01, (found, exact)


def check_keys(browser, path, place):
    """Keys and buttons change the picture and the state of the buttons."""
    browser.open(path("page.html"))
    before = browser.screenshot()
    for key, button in (("s", "surfaces"), ("e", "edges"), ("m", "meshes"), ("x", "clip-x"), ("f", "flip"), ("y", "clip-y")):
        was_pressed = is_pressed(browser, button)
        browser.key(key)
        after = browser.screenshot()
        assert is_pressed(browser, button) != was_pressed and after != before, key
        browser.press(button)
        assert is_pressed(browser, button) == was_pressed, button
        if key in "xy":
            assert browser.run("document.getElementById('legend').hidden") is False
    for key in ("ArrowLeft", "ArrowUp", "+", "c", "]"):
        before = browser.screenshot()
        browser.key(key)
        assert browser.screenshot() != before, key
    browser.key("x")
    before = browser.screenshot()
    browser.drag(*place, place[0] + 80, place[1] + 30)
    assert browser.screenshot() != before and browser.run("shellView.cursor") is None

    # Without a mouse, the cursor is at the center of the first view, and follows it.
    browser.key("p")
    first = browser.run("shellView.cursor.point")
    browser.key("ArrowRight")
    assert math.dist(first, browser.run("shellView.cursor.point")) > 0.01 and browser.run("shellView.cursor.image")
    browser.key("Enter")
    assert pixel(browser, *place) != pixel(browser, 2, 2)
    browser.key("h")
    assert browser.run("document.getElementById('help-text').open")
    browser.key("h")
    assert not browser.run("document.getElementById('help-text').open")
    unnamed = browser.run("[...document.querySelectorAll('button, input, select')].filter(e => !(e.textContent.trim() || e.ariaLabel || e.labels?.length)).map(e => e.id)")
    assert unnamed == [], unnamed


def check_colors(browser, path):
    """Textures and colors of materials are shown on both meshes."""
    points, polygons = torus(48, 24)
    uv = [[(0.2 + 0.1 * i, 0.3 + 0.1 * j) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))] for _ in polygons]
    write(path("red.png"), as_png(12, 9, lambda x, y: (230, 40, 30)))
    write(path("a.mtl"), "newmtl paint\nKd 1 1 1\nmap_Kd red.png\nnewmtl plain\nKd 0.1 0.2 0.9\n")
    corners = [(t, k) for t in polygons for k in ((0, 1, 2), (0, 2, 3))]
    columns = [("POSITION", 5126, "VEC3", [points[t[i]] for t, k in corners for i in k]), ("TEXCOORD_0", 5126, "VEC2", [uv[0][i] for _, k in corners for i in k])]
    write(path("glb.glb"), as_glb(columns, [range(3 * len(corners))], read(path("red.png")), {
        "materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}]}))
    for material in ("paint", "plain"):
        write(path(f"{material}.obj"), as_obj(points, polygons, uv, f"mtllib a.mtl\nusemtl {material}\n"))
    for file, strongest in (("paint.obj", 0), ("plain.obj", 2), ("glb.glb", 0)):
        run("remesh", path(file), "-o", path("out_" + file), "--edge", 0.2, "--view", path("torus.html"))
        browser.open(path("torus.html"))
        for side in (0, 1):
            x, y = center_of_view(browser, side)
            for _ in range(100):        # until the image is decoded
                browser.settle()
                colors = [pixel(browser, x + dx, y) for dx in (-150, 150)]
                if all(max(c) > 0 for c in colors):
                    break
            assert all(max(range(3), key=lambda i: c[i]) == strongest and max(c) - min(c) > 60 for c in colors), (file, side, colors)


def check_failures(browser, path):
    """A shell that is not certified: the places where the proof fails, with the sentences of the report."""
    write(path("shell.html"), "an earlier page")
    done = run("shell", f"{meshes}/elephant.off", "-o", path("elephant"), "--excise", 0, "--thickness", "8%", "--memory-limit", 20,
               "--view", path("shell.html"), code=NOT_CERTIFIED)
    assert "shell_failed.html" in done.stderr and read(path("shell.html")) == b"an earlier page", done
    browser.open(path("shell_failed.html"))
    places = browser.run("[...document.querySelectorAll('#places button')].map(b => b.textContent)")
    report = read(path("elephant_failed.json")).decode()
    assert places and all(p.startswith(("The wall at", "The gap at", "The proof fails at")) for p in places), places
    assert "is not certified" in browser.run("document.getElementById('report').textContent") and "obstacles" in report
    assert f"{len(places)} places where the proof fails" in browser.run("document.getElementById('places').textContent")
    before = browser.screenshot()
    browser.run("document.querySelector('#places button').click()")
    browser.settle()
    assert browser.screenshot() != before

    # Without a shell, facets with defects are listed.
    run("shell", f"{meshes}/degtri_sliding.off", "-o", path("slid"), "--memory-limit", 1, "--view", path("shell.html"), code=WRONG_INPUT)
    browser.open(path("shell_failed.html"))
    assert "facets and vertices with defects" in browser.run("document.getElementById('places').textContent")

    # A later success removes the page of the failure.
    run("shell", f"{meshes}/eight.off", "-o", path("eight"), "--view", path("shell.html"))
    assert not os.path.exists(path("shell_failed.html"))
    browser.open(path("shell.html"))
    browser.click(*center_of_view(browser, 0, 1))
    browser.key("s")


def check_phone(browser, path):
    """On a narrow screen, the meshes are above each other, and nothing is wider than the screen."""
    browser.resize(390, 844, 2, is_phone=True)
    browser.open(path("page.html"))
    assert browser.run("document.documentElement.scrollWidth") <= 390
    left, top, width, height = browser.run("(r => [r.left, r.top, r.width, r.height])(document.getElementById('stage').getBoundingClientRect())")
    assert height > 0.45 * 844, height
    for side in (0, 1):
        browser.send("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": left + width / 2, "y": top + (side + 0.5) * height / 2}])
        browser.send("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        browser.settle()
        assert browser.run("shellView.cursor.side") == side and browser.run("shellView.cursor.image"), side
    browser.resize(WIDTH, HEIGHT)


def check_refusals(path):
    write(path("small.off"), read(f"{meshes}/eight.off"))
    edit = ("simplify", path("small.off"), "-o", path("small_out.off"), "--view")
    assert "use the extension .html" in run(*edit, path("page.txt"), code=WRONG_USAGE).stderr
    assert "cannot be written" in run(*edit, path("missing/page.html"), code=CANNOT_WRITE).stderr
    assert not os.path.exists(path("small_out.off"))


if not find_chromium():
    print("Chromium is not installed: the pages are not tested.")
    sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    probe = subprocess.run([program, "shell", f"{meshes}/eight.off", "-o", path("probe"), "--view", path("probe.html")], capture_output=True, text=True)
    if "libjs-three" in probe.stderr:
        print("The program was built without three.js: there are no pages to test.")
        sys.exit(77)
    check_refusals(path)
    try:
        browser = Browser(WIDTH, HEIGHT)
        has_pictures = browser.run("!!document.createElement('canvas').getContext('webgl')")
    except (RuntimeError, OSError):
        has_pictures = False
    if not has_pictures:
        print("Skipped: Chromium cannot draw on this machine.")
        sys.exit(77)
    with browser:
        place = check_exact_images(browser, path)
        check_without_field(browser, path, place)
        check_keys(browser, path, place)
        check_colors(browser, path)
        check_failures(browser, path)
        check_phone(browser, path)
        assert browser.errors == [], browser.errors
        foreign = [url for url in browser.requests if not url.startswith(("file://" + folder, "data:", "about:"))]
        assert foreign == [], foreign
print("all pages are right")
