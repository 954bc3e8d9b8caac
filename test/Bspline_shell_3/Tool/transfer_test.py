"""Checks what `bspline_shell transfer` writes: values against known functions, the points and polygons of the second
mesh, marks, and baked images.

Usage: transfer_test.py BSPLINE_SHELL
"""
import base64
import json
import math
import os
import subprocess
import sys
import tempfile

from mesh_files import as_glb, as_obj, as_ply, centroid, read, read_obj, read_ply, sphere, torus, write
from png_files import as_png, read_png

program, = sys.argv[1:]
WRONG_INPUT, WRONG_USAGE, NOT_CERTIFIED = 1, 2, 4
ONE_TO_ONE, CONTINUED, NEAREST = 0, 1, 2


def run(*arguments):
    return subprocess.run([program, "transfer", *arguments], capture_output=True, text=True)


def result(*arguments, code=0):
    done = run(*arguments, "--json")
    assert done.returncode == code, done
    return json.loads(done.stdout)


def unit(p):
    length = math.sqrt(sum(x * x for x in p))
    return [x / length for x in p]


def turned(points, angle, scale=1.0):
    """Rotates about an axis that is none of the coordinate axes, so that the vertices of two meshes differ."""
    c, s = math.cos(angle), math.sin(angle)
    return [tuple(scale * x for x in (p[0] * c - p[1] * s, (p[0] * s + p[1] * c) * c - p[2] * s,
                                      (p[0] * s + p[1] * c) * s + p[2] * c)) for p in points]


def points_of(ply):
    return list(zip(*(ply[2]["vertex"][1][a] for a in "xyz")))


channel = lambda a: lambda p: round(127.5 + 127.5 * p[a])
color = lambda p: tuple(127.5 + 127.5 * x for x in unit(p))
side = lambda p: 1 if p[0] > 0 else 2
of_points = [("red", "uchar", channel(0)), ("green", "uchar", channel(1)), ("blue", "uchar", channel(2)),
             ("heat", "double", lambda p: p[0] - 2 * p[2])]
of_triangles = [("label", "short", side), ("quality", "float", lambda p: p[1])]
points, triangles = sphere(32, 64)
other, other_triangles = sphere(24, 50)
other = turned(other, 0.4, 1.002)

with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    source = write(path("from.ply"), as_ply("binary_little_endian", points, triangles, of_points, of_triangles))

    # Values at images, and everything that the second mesh keeps
    target = write(path("to.ply"), as_ply("ascii", other, other_triangles,
                                          [("id", "int", lambda p: round(1000 * p[0])), ("heat", "float", lambda p: 7.0)], []))
    report = result(source, target, "-o", path("out.ply"))
    assert report["is_one_to_one"] and report["one_to_one_area"] > 0.999, report
    assert report["replaced"] == ["heat"] and "color" in report["attributes"], report
    assert 0.001 < report["distance"] < 0.02, report
    before, after = read_ply(target), read_ply(path("out.ply"))
    assert points_of(before) == points_of(after) and before[:2] == after[:2], after[:2]
    assert before[2]["face"][1]["vertex_indices"] == after[2]["face"][1]["vertex_indices"]
    vertex, face = after[2]["vertex"][1], after[2]["face"][1]
    assert vertex["id"] == before[2]["vertex"][1]["id"] and "mapped" not in vertex
    assert after[2]["vertex"][0]["heat"] == "double" and after[2]["face"][0]["label"] == "short", after[2]["vertex"][0]
    for i, p in enumerate(points_of(after)):
        q = unit(p)
        assert all(abs(vertex[c][i] - color(q)[a]) < 1.5 for a, c in enumerate(("red", "green", "blue"))), p
        assert abs(vertex["heat"][i] - (q[0] - 2 * q[2])) < 0.005, (p, vertex["heat"][i])
    for i, t in enumerate(face["vertex_indices"]):
        c = centroid(other, t)
        assert face["label"][i] == side(c) or abs(c[0]) < 0.12, c
        assert abs(face["quality"][i] - c[1]) < 0.06, c

    # Attributes of points and triangles with the same name, and marks of an earlier transfer
    twice = [("quality", "double", lambda p: p[0]), ("mapped", "uchar", lambda p: NEAREST)]
    write(path("twice.ply"), as_ply("ascii", points, triangles, twice, [("quality", "float", lambda p: p[1])]))
    write(path("marked.ply"), as_ply("ascii", other, other_triangles, [(n, t, lambda p: 1) for n, t, _ in twice], []))
    report = result(path("twice.ply"), path("marked.ply"), "-o", path("twice_out.ply"))
    assert report["is_one_to_one"] and report["replaced"] == ["quality"] and report["attributes"] == ["quality"] * 2, report
    after = read_ply(path("twice_out.ply"))[2]
    assert "mapped" not in after["vertex"][1], after["vertex"][0]
    assert max(abs(x - p[0]) for x, p in zip(after["vertex"][1]["quality"], map(unit, other))) < 0.01
    assert max(abs(x - centroid(other, t)[1]) for x, t in zip(after["face"][1]["quality"], other_triangles)) < 0.06

    # A torus; quadrangles remain, and the mesh may be turned inside out
    smooth = lambda p: p[0] + p[1] * p[2]
    ring, quads = torus(60, 30)
    write(path("ring.ply"), as_ply("ascii", ring, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))],
                                   [("heat", "double", smooth)], []))
    coarse, coarse_quads = torus(40, 17, phase=0.3)
    for polygons in (coarse_quads, [q[::-1] for q in coarse_quads]):
        write(path("ring.obj"), as_obj(coarse, polygons))
        report = result(path("ring.ply"), path("ring.obj"), "-o", path("ring_out.ply"))
        assert report["is_one_to_one"], report
        after = read_ply(path("ring_out.ply"))
        assert points_of(after) == coarse and [tuple(f) for f in after[2]["face"][1]["vertex_indices"]] == polygons
        assert max(abs(h - smooth(p)) for h, p in zip(after[2]["vertex"][1]["heat"], coarse)) < 0.02

    # A mesh and itself: all values are equal.
    report = result(source, source, "-o", path("same.ply"))
    before, after = read_ply(source), read_ply(path("same.ply"))
    assert report["is_one_to_one"] and all(before[2][e][1] == after[2][e][1] for e in ("vertex", "face")), report

    # A part outside of the shell is marked, and has the values of the nearest points.
    bump = [tuple(x * (1 + 8 * max(0, p[2] - 0.9)) for x in p) for p in other]
    write(path("bump.ply"), as_ply("ascii", bump, other_triangles, [], []))
    report = result(source, path("bump.ply"), "-o", path("bump_out.ply"), "--thickness", "4%")
    shares = [report[name] for name in ("one_to_one_area", "continued_area", "nearest_area")]
    assert abs(sum(shares) - 1) < 1e-9 and shares[0] > 0.6 and shares[2] > 0.05 and not report["is_one_to_one"], report
    vertex = read_ply(path("bump_out.ply"))[2]["vertex"][1]
    for i, p in enumerate(bump):
        distance = abs(math.sqrt(sum(x * x for x in p)) - 1)
        mapped = vertex["mapped"][i]
        assert mapped == NEAREST or distance < 0.05, (p, mapped)
        assert mapped == ONE_TO_ONE or p[2] > 0.8, (p, mapped)
        q = unit(p)
        assert abs(vertex["heat"][i] - (q[0] - 2 * q[2])) < 0.005 + 2 * distance, (p, mapped)
    report = result(source, path("bump.ply"), "-o", path("bump_out.ply"))
    assert report["one_to_one_area"] > 0.6 and report["nearest_area"] + report["continued_area"] > 0, report

    # Two sheets over each other are not both one-to-one.
    inner, number = [tuple(0.99 * x for x in p) for p in other], len(other)
    write(path("two.ply"), as_ply("ascii", other + inner, other_triangles + [tuple(v + number for v in t) for t in other_triangles],
                                  [], []))
    report = result(source, path("two.ply"), "-o", path("two_out.ply"), "--thickness", "4%")
    assert not report["is_one_to_one"] and report["one_to_one_area"] < 0.55, report

    # Nothing can be mapped: the result is written and marked.
    write(path("far.ply"), as_ply("ascii", [(p[0] + 9, p[1], p[2]) for p in other], other_triangles, [], []))
    report = result(source, path("far.ply"), "-o", path("far_out.ply"), code=NOT_CERTIFIED)
    assert report["nearest_area"] == 1 and set(read_ply(path("far_out.ply"))[2]["vertex"][1]["mapped"]) == {NEAREST}, report

    # A point without polygons, a polygon without area, and one without points
    odd = as_ply("ascii", other + [(0.0, 1.5, 0.0)], other_triangles + [(5, 5, 6)], [], []) + b"0\n"
    number = len(other_triangles) + 2
    write(path("odd.ply"), odd.replace(b"element face %d" % (number - 1), b"element face %d" % number))
    report = result(source, path("odd.ply"), "-o", path("odd_out.ply"))
    vertex, face = (read_ply(path("odd_out.ply"))[2][e][1] for e in ("vertex", "face"))
    assert abs(vertex["heat"][-1]) < 0.01 and len(face["label"]) == number, vertex["heat"][-1]

    # Excised triangles and proxies: a stray triangle, and a gap that is too large
    stray = [(0.9, -0.02, 0.3), (1.1, 0.0, 0.31), (0.9, 0.02, 0.32)]
    write(path("stray.ply"), as_ply("ascii", points + stray, triangles + [tuple(len(points) + i for i in range(3))],
                                    of_points, of_triangles))
    report = result(path("stray.ply"), target, "-o", path("stray_out.ply"))
    assert report["kind"] == "excised" and report["one_to_one_area"] > 0.9, report
    vertex = read_ply(path("stray_out.ply"))[2]["vertex"][1]
    assert all(abs(vertex["heat"][i] - (q[0] - 2 * q[2])) < 0.01 for i, q in enumerate(map(unit, other))
               if math.dist(q, unit(stray[1])) > 0.2), report

    # Texture coordinates with a seam
    def uv(p, near=0.5):
        u = 0.5 + math.atan2(p[1], p[0]) / (2 * math.pi)
        return u + round(near - u), 0.5 + math.asin(unit(p)[2]) / math.pi

    def corners_of(points, triangles):
        found = []
        for t in triangles:
            middle = uv(centroid(points, t))[0]
            found.append([uv(points[v], middle) if abs(points[v][2]) < 1 - 1e-9 else (middle, uv(points[v])[1]) for v in t])
        return found

    materials = "newmtl painted\nKd 1 1 1\nmap_Kd paint.png\n"
    write(path("textured.mtl"), materials)
    textured = write(path("textured.obj"), as_obj(points, triangles, corners_of(points, triangles),
                                                  "mtllib textured.mtl\nusemtl painted\n"))
    def paint(x, y):
        u, v = 2 * math.pi * ((x + 0.5) / 512 - 0.5), math.pi * (0.5 - (y + 0.5) / 256)
        p = (math.cos(u) * math.cos(v), math.sin(u) * math.cos(v), math.sin(v))
        return tuple(round(c) for c in color(p))

    write(path("paint.png"), as_png(512, 256, paint))
    write(path("plain.obj"), as_obj(other, other_triangles))
    report = result(textured, path("plain.obj"), "-o", path("textured_out.obj"))
    assert report["is_one_to_one"] and "texture" in report["attributes"] and "material" in report["attributes"], report
    found = read_obj(path("textured_out.obj"))
    assert [tuple(p) for p in found["v"]] == other and read(path("textured_out.mtl")).decode() == materials
    wrong = 0
    for corners, state in found["f"]:
        assert state["usemtl"] == "painted", state
        middle = found["vt"][corners[0][1]][0]
        for v, t in corners:
            if abs(found["v"][v][2]) < 0.9:
                wrong += math.dist(found["vt"][t], uv(found["v"][v], middle)) > 0.01
    assert 0 < report["facets_across_seams"] < 100 and wrong == 0, (wrong, report)

    # Baked images: six charts, one for each side of a cube, with gaps between them
    def chart(p):
        a = max(range(3), key=lambda a: abs(p[a]))
        return a if p[a] > 0 else a + 3

    def unwrapped(p, side):
        a = side % 3
        q = unit(p)
        x, y = q[(a + 1) % 3] / abs(q[a]), q[(a + 2) % 3] / abs(q[a])
        return (side % 3 + 0.5 + 0.36 * x) / 3, (side // 3 + 0.5 + 0.36 * y) / 2

    charts = [chart(centroid(other, t)) for t in other_triangles]
    atlas = [[unwrapped(other[v], charts[n]) for v in t] for n, t in enumerate(other_triangles)]
    write(path("atlas.obj"), as_obj(other, other_triangles, atlas))

    def check_image(name, size, function, largest, mean):
        width, height, rows = read_png(name)
        assert (width, height) == (size, size), (width, height)
        errors, covered = [], [[False] * size for _ in range(size)]
        for n, t in enumerate(other_triangles):
            a, b, c = [(u * size, (1 - v) * size) for u, v in atlas[n]]
            area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            for y in range(math.floor(min(a[1], b[1], c[1])), math.ceil(max(a[1], b[1], c[1]))):
                for x in range(math.floor(min(a[0], b[0], c[0])), math.ceil(max(a[0], b[0], c[0]))):
                    v = ((x + 0.5 - a[0]) * (c[1] - a[1]) - (y + 0.5 - a[1]) * (c[0] - a[0])) / area
                    w = ((b[0] - a[0]) * (y + 0.5 - a[1]) - (b[1] - a[1]) * (x + 0.5 - a[0])) / area
                    if min(v, w, 1 - v - w) < 0:
                        continue
                    p = [(1 - v - w) * other[t[0]][k] + v * other[t[1]][k] + w * other[t[2]][k] for k in range(3)]
                    errors.append(max(abs(e - f) for e, f in zip(function(p), rows[y][x])))
                    covered[y][x] = True
        assert max(errors) <= largest and sum(errors) / len(errors) <= mean, (name, max(errors), sum(errors) / len(errors))
        return rows, covered

    for name in (textured, source):
        report = result(name, path("atlas.obj"), "-o", path("baked.obj"), "--bake", path("baked.png"), "--size", "256", "--margin", "4")
        assert report["is_one_to_one"] and report["overlapping_texels"] == 0 and report["warnings"] == [] or name == source, report
        rows, covered = check_image(path("baked.png"), 256, color, 3, 0.7)
        found = read_obj(path("baked.obj"))
        assert b"map_Kd baked.png" in read(path("baked.mtl")) and found["f"][0][1]["usemtl"] == "baked"
        assert all(tuple(found["vt"][c[1]]) == uv for (corners, _), polygon in zip(found["f"], atlas)
                   for c, uv in zip(corners, polygon))
        # The margin has the colors of covered texels; the rest is empty.
        margin = 0
        for y in range(256):
            for x in range(256):
                near = [(u, v) for v in range(max(0, y - 4), min(256, y + 5)) for u in range(max(0, x - 4), min(256, x + 5)) if covered[v][u]]
                if covered[y][x]:
                    continue
                assert (rows[y][x] != (0, 0, 0)) == bool(near), (x, y)
                if near:
                    margin += 1
                    assert min(max(abs(a - b) for a, b in zip(rows[y][x], rows[v][u])) for u, v in near) < 12, (x, y)
        assert margin > 1000, margin
    both = [path("baked.png"), path("normals.png")]
    os.remove(both[0])
    report = result(source, path("atlas.obj"), "-o", path("baked.obj"), "--bake", both[0], "--bake-normals", both[1], "--size", "256")
    assert report["images"] == both, report
    for image in both:
        check_image(image, 256, color, 3, 0.7)

    # Textures of glTF files, in the file and beside it
    columns = [("POSITION", 5126, "VEC3", [points[v] for t in triangles for v in t]),
               ("TEXCOORD_0", 5126, "VEC2", [(u, 1 - v) for corners in corners_of(points, triangles) for u, v in corners])]
    painted = {"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}]}
    image = read(path("paint.png"))
    for uri in (None, "data:image/png;base64," + base64.b64encode(image).decode(), "paint.png"):
        more = {"images": [{"uri": uri}]} if uri else {}
        write(path("painted.glb"), as_glb(columns, [range(3 * len(triangles))], image, {**painted, **more}))
        report = result(path("painted.glb"), path("atlas.obj"), "-o", path("baked.obj"), "--bake", path("baked.png"), "--size", "256")
        assert report["warnings"] == [], report
        check_image(path("baked.png"), 256, color, 3, 0.7)

    # PLY files and the standard output
    def textures(ply):
        return [line for line in ply.split(b"end_header")[0].split(b"\n") if line.startswith(b"comment TextureFile")]

    os.mkdir(path("results"))
    result(source, path("atlas.obj"), "-o", path("results/atlas.ply"), "--bake", path("baked.png"), "--size", "64")
    assert textures(read(path("results/atlas.ply"))) == [b"comment TextureFile ../baked.png"]

    def in_folder(*arguments):
        done = subprocess.run([program, "transfer", *arguments, "-o", "-"], capture_output=True, cwd=folder)
        assert done.returncode == 0, done
        return done.stdout

    files = sorted(os.listdir(folder))
    assert textures(in_folder("from.ply", "results/atlas.ply")) == [b"comment TextureFile baked.png"]
    assert textures(in_folder("from.ply", "results/atlas.ply", "--bake", "normals.png", "--size", "64")) == [b"comment TextureFile normals.png"]
    for name in ("painted.glb", "results/atlas.ply"):
        assert b"mtllib" not in in_folder(name, "plain.obj")
    assert sorted(os.listdir(folder)) == files, os.listdir(folder)
    result(path("results/atlas.ply"), textured, "-o", path("results/again.obj"))
    assert b"map_Kd ../baked.png" in read(path("results/again.mtl"))

    # A baked image never replaces a texture.
    for first, second, name in (("textured.obj", "atlas.obj", "paint.png"), ("from.ply", "textured.obj", "paint.png"),
                                ("results/atlas.ply", "atlas.obj", "baked.png"), ("painted.glb", "atlas.obj", "paint.png")):
        before = read(path(name))
        done = run(path(first), path(second), "-o", path("x.obj"), "--bake", path(name))
        assert done.returncode == WRONG_USAGE and "part of the input" in done.stderr, done
        assert read(path(name)) == before and not os.path.exists(path("x.obj")), name

    # Overlapping charts, coordinates beyond the image, and files without them
    write(path("overlap.obj"), as_obj(other, other_triangles, [[unwrapped(other[v], charts[n] % 3) for v in t] for n, t in enumerate(other_triangles)]))
    report = result(source, path("overlap.obj"), "-o", path("baked.obj"), "--bake", path("baked.png"), "--size", "64")
    assert report["overlapping_texels"] > 100 and "overlap" in report["warnings"][0], report
    write(path("beyond.obj"), as_obj(other, other_triangles, [[(2 * u, v) for u, v in corners] for corners in atlas]))
    report = result(source, path("beyond.obj"), "-o", path("baked.obj"), "--bake", path("baked.png"), "--size", "64")
    assert any("outside [0, 1]" in warning for warning in report["warnings"]), report
    done = run(source, path("plain.obj"), "-o", path("baked.obj"), "--bake", path("baked.png"))
    assert done.returncode == WRONG_INPUT and "no texture coordinates" in done.stderr, done
    write(path("line.obj"), as_obj(other, other_triangles, [[(0.5,)] * 3] * len(other_triangles)))
    done = run(source, path("line.obj"), "-o", path("baked.obj"), "--bake", path("baked.png"))
    assert done.returncode == WRONG_INPUT and "no texture coordinates" in done.stderr, done
    done = run(path("plain.obj"), path("atlas.obj"), "-o", path("baked.obj"), "--bake", path("baked.png"))
    assert done.returncode == WRONG_INPUT and "no colors" in done.stderr, done
    os.remove(path("paint.png"))
    done = run(textured, path("atlas.obj"), "-o", path("baked.obj"), "--bake", path("baked.png"))
    assert "paint.png cannot be read" in done.stderr, done

    # manners
    done = run("--help")
    assert done.returncode == 0 and "--bake" in done.stdout and done.stderr == "", done
    before = [read(source), read(target)]
    for arguments in ((source, target, "-o", source), (source, target, "-o", target), (source, target), (source, "-o", path("x.ply")),
                      (source, path("atlas.obj"), "-o", path("x.ply"), "--bake", path("x.jpg")),
                      (textured, path("atlas.obj"), "-o", path("textured.obj")),
                      (source, path("atlas.obj"), "-o", path("x.ply"), "--bake", path("x.png"), "--bake-normals", path("x.png"))):
        done = run(*arguments)
        assert done.returncode == WRONG_USAGE, done
    assert run(path("missing.ply"), target, "-o", path("x.ply")).returncode == WRONG_INPUT
    assert before == [read(source), read(target)] and not os.path.exists(path("x.ply"))
    assert not [name for name in os.listdir(folder) if ".part" in name], os.listdir(folder)
