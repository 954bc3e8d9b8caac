"""Checks what the program bspline_shell writes: attributes against known functions, names and types, points that did
not move, and manners. It reads and writes the files itself.

Usage: bspline_shell_test.py BSPLINE_SHELL MESHES     (MESHES: the folder of CGAL's meshes)
"""
import json
import math
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time

from mesh_files import as_glb, as_ply, centroid, read, read_glb, read_obj, read_ply, sphere, write

program, meshes = sys.argv[1:]
WRONG_INPUT, WRONG_USAGE, CANNOT_WRITE, NOT_CERTIFIED = 1, 2, 3, 4


def run(*arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True)


def result(*arguments):
    done = run(*arguments, "--json")
    assert done.returncode == 0, done
    return json.loads(done.stdout)


points, triangles = sphere()
channel = lambda a: lambda p: round(127.5 + 127.5 * p[a])
side = lambda p: 1 if p[0] > 0.01 else 2
of_points = [("red", "uchar", channel(0)), ("green", "uchar", channel(1)), ("blue", "uchar", channel(2)),
             ("temperature", "float", lambda p: 20 + 5 * p[0] - p[2]), ("octant", "short", lambda p: 3 if p[2] > 0 else 5)]
of_triangles = [("material", "int", side), ("quality", "double", lambda p: p[1])]

with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    # PLY: each encoding, names, types, comments, and values
    for encoding in ("ascii", "binary_little_endian", "binary_big_endian"):
        source = write(path("in.ply"), as_ply(encoding, points, triangles, of_points, of_triangles))
        report = result("simplify", source, "-o", path("out.ply"), "--tolerance", "1%")
        assert report["facets"] < len(triangles) / 2 and report["certification"] == "certified", report
        assert max(report["distance_to_result"], report["distance_to_input"]) <= 0.02, report
        before, after = read_ply(source), read_ply(path("out.ply"))
        assert before[:2] == after[:2] and all(before[2][e][0] == after[2][e][0] for e in ("vertex", "face")), after[:2]
        vertex = after[2]["vertex"][1]
        moved = 0
        value = {p: i for i, p in enumerate(points)}
        for i, p in enumerate(zip(*(vertex[a] for a in "xyz"))):
            if p in value:
                for name, kind, _ in of_points:
                    assert vertex[name][i] == before[2]["vertex"][1][name][value[p]], (p, name)
                continue
            moved += 1
            length = math.sqrt(sum(x * x for x in p))
            q = [x / length for x in p]
            for name, _, function in of_points[:4]:
                allowed = 3 if name in ("red", "green", "blue") else 0.1
                assert abs(vertex[name][i] - function(q)) <= allowed, (name, vertex[name][i], function(q))
            assert vertex["octant"][i] == (3 if q[2] > 0 else 5) or abs(q[2]) < 0.15, q
        assert moved < len(vertex["x"]), report
        face = after[2]["face"][1]
        corners = list(zip(*(vertex[a] for a in "xyz")))
        for i, t in enumerate(face["vertex_indices"]):
            c = centroid(corners, t)
            # The border of the labels is kept, so that no facet lies across it by more than the tolerance.
            assert face["material"][i] == side(c) or abs(c[0]) < 0.08, c
            assert abs(face["quality"][i] - c[1]) < 0.1, c

    # The tolerance controls the number of facets; the other targets end earlier.
    sizes = [result("simplify", path("in.ply"), "-o", path("t.ply"), "--tolerance", t)["facets"] for t in ("0.3%", "1%", "0.06")]
    assert sizes == sorted(sizes, reverse=True) and sizes[0] > sizes[2], sizes
    report = result("simplify", path("in.ply"), "-o", path("t.ply"), "--facets", "1000")
    assert report["facets"] in (999, 1000) and "number of facets" in report["limit"], report
    assert report["reaches_target"], report
    report = result("simplify", path("in.ply"), "-o", path("t.ply"), "--facets", "100")
    assert report["facets"] in (99, 100) and report["reaches_target"] and report["thickness"] > 0.02, report
    report = result("simplify", path("in.ply"), "-o", path("t.ply"), "--facets", "100", "--thickness", "1%")
    assert report["facets"] > 100 and not report["reaches_target"] and report["keeps_lines"], report
    report = result("simplify", path("in.ply"), "-o", path("t.ply"), "--ratio", "0.5")
    assert abs(report["facets"] - len(triangles) / 2) <= 1, report

    # A time limit that is not reached changes nothing, and a number of threads never does.
    elephant = [os.path.join(meshes, "elephant.off"), "-o", path("t.off")]
    outputs = []
    for options in ((), ("--time-limit", "1000"), ("--threads", "1")):
        result("simplify", *elephant, *options)
        outputs.append(read(path("t.off")))
    assert outputs[0] == outputs[1] == outputs[2]

    # OBJ: a texture with a seam, two materials, groups, and smoothing groups
    def uv(p, near):
        u = math.atan2(p[1], p[0]) / (2 * math.pi)
        return u + round(near - u), p[2]

    text, corner = "# made by a test\nmtllib in.mtl\no ball\n", 0
    text += "".join("v %r %r %r\n" % p for p in points)
    for part, name in ((1, "east"), (2, "west")):
        text += "usemtl %s side\ng %s half\ns %d\n" % (name, name, part)
        for t in triangles:
            c = centroid(points, t)
            if side(c) != part:
                continue
            middle = math.atan2(c[1], c[0]) / (2 * math.pi)
            text += "".join("vt %r %r\n" % uv(points[v], middle) for v in t)
            text += "f " + " ".join("%d/%d" % (v + 1, corner + i + 1) for i, v in enumerate(t)) + "\n"
            corner += 3
    materials = "newmtl east side\nKd 1 0 0\nmap_Kd pictures/east.png\nnewmtl west side\nKd 0 1 0\n"
    write(path("in.mtl"), materials)
    source = write(path("in.obj"), text)
    os.mkdir(path("sub"))
    report = result("simplify", source, "-o", path("sub/out.obj"), "--tolerance", "2%")
    assert report["edges_on_lines"] > 0 and report["facets"] < len(triangles) / 2, report
    assert read(path("sub/out.mtl")).decode() == materials.replace("pictures/east.png", "../pictures/east.png"), report
    found = read_obj(path("sub/out.obj"))
    assert "# made by a test" in found["lines"] and "mtllib out.mtl" in found["lines"], found["lines"]
    assert report["facets_across_seams"] <= 0.02 * len(found["f"]), report
    wrong = 0
    for corners, state in found["f"]:
        c = centroid(found["v"], [v[0] for v in corners])
        part = "east" if state["usemtl"] == "east side" else "west"
        assert state["g"] == part + " half" and state["o"] == "ball" and state["s"] == ("1" if part == "east" else "2"), state
        corners = [(v, t) for v, t in corners if abs(found["v"][v][2]) < 0.95]      # the texture is singular at the poles
        for v, t in corners:
            p = found["v"][v]
            length = math.sqrt(sum(x * x for x in p))
            expected = uv([x / length for x in p], found["vt"][corners[0][1]][0])
            wrong += math.dist(found["vt"][t], expected) > 0.03
    assert wrong <= 6 * report["facets_across_seams"], (wrong, report)
    report = result("simplify", source, "-o", path("few.obj"), "--facets", "60", "--thickness", "20%")
    assert report["facets"] <= 60 and report["keeps_lines"], report

    # Borders between labels are given up only if this reaches the number of facets.
    patch = lambda c: 8 * int(4 * (c[2] + 1)) + int(4 * (math.atan2(c[1], c[0]) / math.pi + 1))
    write(path("patches.ply"), as_ply("ascii", points, triangles, [], [("patch", "int", patch)]))
    report = result("simplify", path("patches.ply"), "-o", path("t.ply"), "--facets", "60", "--thickness", "20%")
    assert report["facets"] <= 60 and report["reaches_target"] and not report["keeps_lines"], report
    report = result("simplify", path("patches.ply"), "-o", path("t.ply"), "--facets", "60", "--thickness", "1%")
    assert not report["reaches_target"] and report["keeps_lines"], report

    # GLB: vertices that are split at the seam of a texture, colors, an own attribute, two materials, and an image
    single = [struct.unpack("3f", struct.pack("3f", *p)) for p in points]
    vertices, index, parts = [], {}, [[], []]
    for t in triangles:
        c = centroid(points, t)
        middle = math.atan2(c[1], c[0]) / (2 * math.pi)
        for v in t:
            u = uv(points[v], middle)
            key = (v, u[0] if abs(points[v][2]) < 0.999 else 0)
            if key not in index:
                index[key] = len(vertices)
                vertices.append((single[v], (key[1], 1 - u[1])))
            parts[side(c) - 1].append(index[key])
    image = b"\x89PNG an image that is not decoded"
    extra = {"materials": [{"name": "east", "emissiveFactor": [1, 0, 0], "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
                           {"name": "west", "extensions": {"KHR_materials_unlit": {}}}],
             "textures": [{"source": 0}], "extensionsUsed": ["KHR_materials_unlit"]}
    source = write(path("in.glb"), as_glb(
        [("POSITION", 5126, "VEC3", [p for p, _ in vertices]), ("TEXCOORD_0", 5126, "VEC2", [t for _, t in vertices]),
         ("COLOR_0", 5121, "VEC4", [(*(channel(a)(p) for a in range(3)), 255) for p, _ in vertices]),
         ("_TEMPERATURE", 5126, "SCALAR", [(20 + 5 * p[0] - p[2],) for p, _ in vertices])], parts, image, extra))
    report = result("simplify", source, "-o", path("out.glb"), "--tolerance", "2%")
    assert report["facets"] < len(triangles) / 2 and not report["warnings"], report
    assert sorted(report["attributes"]) == ["TEMPERATURE", "color", "material", "object", "texture"], report
    gltf, kept, primitives = read_glb(path("out.glb"))
    assert kept == image and gltf["materials"] == extra["materials"], gltf
    assert [p[0] for p in primitives] == [0, 1] and gltf["nodes"][0]["name"] == "ball", gltf
    assert sum(len(p[1]) for p in primitives) == 3 * report["facets"], report
    wrong, same, value = 0, 0, {p: i for i, p in enumerate(single)}
    for material, corners, columns in primitives:
        for i in range(0, len(corners), 3):
            t = corners[i:i + 3]
            c = centroid(columns["POSITION"], t)
            assert side(c) == material + 1 or abs(c[0]) < 0.1, c
            middle = columns["TEXCOORD_0"][t[0]][0]
            for v in t:
                p = columns["POSITION"][v]
                q = [x / math.sqrt(sum(x * x for x in p)) for x in p]
                same += p in value
                assert all(abs(columns["COLOR_0"][v][a] - channel(a)(q)) <= 4 for a in range(3)), (p, columns["COLOR_0"][v])
                assert abs(columns["_TEMPERATURE"][v][0] - (20 + 5 * q[0] - q[2])) < 0.15, p
                if abs(p[2]) < 0.95:
                    expected = uv(q, middle)
                    wrong += math.dist(columns["TEXCOORD_0"][v], (expected[0], 1 - expected[1])) > 0.03
    assert same > 0 and wrong <= 6 * report["facets_across_seams"], (same, wrong, report)

    # A seam that zigzags: no facet lies across it if the result is cut along it.
    def turned_uv(p, near):
        return uv((p[0] + 0.7 * p[2], p[1] - 0.4 * p[2], p[2]), near)

    text = "".join("v %r %r %r\n" % p for p in points)
    for n, t in enumerate(triangles):
        middle = turned_uv(centroid(points, t), 0)[0]
        text += "".join("vt %r %r\n" % turned_uv(points[v], middle) for v in t)
        text += "f " + " ".join("%d/%d" % (v + 1, 3 * n + i + 1) for i, v in enumerate(t)) + "\n"
    source = write(path("zigzag.obj"), text)
    kept = result("simplify", source, "-o", path("kept.obj"), "--tolerance", "2%")
    report = result("simplify", source, "-o", path("cut.obj"), "--tolerance", "2%", "--cut-seams")
    assert report["cuts_lines"] and not kept["cuts_lines"], report
    assert report["facets_across_seams"] == 0 and report["edges_on_lines"] > kept["edges_on_lines"] > 0, (report, kept)
    assert len(read_obj(path("cut.obj"))["f"]) == report["facets"] > kept["facets"], report
    assert "along which facets were cut" in run("simplify", source, "-o", path("cut.obj"), "--cut-seams").stdout

    # OFF with colors, and STL with solids
    off = "COFF\n# colors\n%d %d 0\n" % (len(points), len(triangles))
    off += "".join("%r %r %r %d %d %d 255\n" % (*p, *(channel(a)(p) for a in range(3))) for p in points)
    off += "".join("3 %d %d %d\n" % t for t in triangles)
    report = result("simplify", write(path("in.off"), off), "-o", path("out.off"), "--tolerance", "1%")
    lines = read(path("out.off")).decode().split("\n")
    assert lines[:2] == ["COFF", "# colors"], lines[:3]
    for line in lines[3:3 + int(lines[2].split()[0])]:
        x = [float(word) for word in line.split()]
        length = math.sqrt(sum(a * a for a in x[:3]))
        assert all(abs(x[3 + a] - channel(a)([b / length for b in x[:3]])) <= 3 for a in range(3)) and x[6] == 255, line
    stl = ""
    for part, name in ((1, "east"), (2, "west")):
        stl += "solid %s\n" % name
        for t in triangles:
            if side(centroid(points, t)) == part:
                stl += "facet normal 0 0 0\nouter loop\n" + "".join("vertex %r %r %r\n" % points[v] for v in t) + "endloop\nendfacet\n"
        stl += "endsolid %s\n" % name
    report = result("simplify", write(path("in.stl"), stl), "-o", path("out.stl"), "--tolerance", "2%")
    solid, corners = None, []
    for line in read(path("out.stl")).decode().split("\n"):
        words = line.split()
        if words[:1] == ["solid"]:
            solid = words[1]
        elif words[:1] == ["vertex"]:
            corners.append([float(x) for x in words[1:]])
            if len(corners) == 3:
                c = centroid(corners, range(3))
                assert (solid == "east") == (side(c) == 1) or abs(c[0]) < 0.1, (solid, c)
                corners = []
    binary = b"made by a test".ljust(80) + struct.pack("<I", len(triangles))
    for t in triangles:
        binary += struct.pack("<12fH", 0, 0, 0, *(x for v in t for x in points[v]), side(centroid(points, t)))
    report = result("simplify", write(path("binary.stl"), binary), "-o", path("binary_out.stl"), "--tolerance", "2%")
    data = read(path("binary_out.stl"))
    assert data[:80] == binary[:80] and len(data) == 84 + 50 * report["facets"], report
    for i in range(report["facets"]):
        facet = struct.unpack_from("<12fH", data, 84 + 50 * i)
        c = [(facet[3 + a] + facet[6 + a] + facet[9 + a]) / 3 for a in range(3)]
        assert facet[12] == side(c) or abs(c[0]) < 0.1, facet

    # Each format is converted to every format; warnings name the omitted data.
    for source in ("in.ply", "in.obj", "in.off", "in.stl", "in.glb"):
        for target in ("x.ply", "x.obj", "x.off", "x.stl", "x.gltf", "x.glb"):
            done = run("simplify", path(source), "-o", path(target), "--facets", "600")
            assert done.returncode == 0, done
            if (source, target) == ("in.ply", "x.stl"):
                assert '"temperature" is omitted' in done.stderr, done

    # The standard input is recognized by its first bytes, and the standard output has its format.
    for name, form in (("in.ply", "ply, "), ("in.obj", "obj"), ("in.off", "off"), ("in.stl", "stl, ascii"), ("binary.stl", "stl, binary"),
                       ("in.glb", "glb"), ("x.gltf", "gltf")):
        done = subprocess.run([program, "check", "-", "--json"], input=read(path(name)), capture_output=True)
        assert done.returncode == 0 and json.loads(done.stdout)["format"].startswith(form), (name, done)
    done = subprocess.run([program, "simplify", "-", "-o", "-", "--facets", "600"], input=read(path("in.ply")), capture_output=True)
    assert done.returncode == 0 and b"facets " in done.stderr, done.stderr
    assert len(read_ply(write(path("piped.ply"), done.stdout))[2]["face"][1]["material"]) <= 600
    done = subprocess.run([program, "simplify", "-", "-o", "-"], input=b"", capture_output=True)
    assert done.returncode == WRONG_INPUT and b"is empty" in done.stderr and done.stdout == b"", done

    # A triangle that intersects the surface is excised, and stays as it is with its label.
    stray = [(0.9, -0.02, 0.3), (1.1, 0.0, 0.31), (0.9, 0.02, 0.32)]
    more, labelled = points + stray, triangles + [tuple(len(points) + i for i in range(3))]
    label = lambda p: 77 if p[0] > 0.96 and abs(p[2] - 0.31) < 1e-9 and abs(p[1]) < 1e-9 else 1
    write(path("stray.ply"), as_ply("ascii", more, labelled, [], [("label", "int", label)]))
    report = result("simplify", path("stray.ply"), "-o", path("stray_out.ply"), "--tolerance", "1%")
    assert report["certification"] == "certified except for excised triangles", report
    vertex, face = (read_ply(path("stray_out.ply"))[2][e][1] for e in ("vertex", "face"))
    corners = list(zip(*(vertex[a] for a in "xyz")))
    kept = [i for i, t in enumerate(face["vertex_indices"]) if sorted(corners[v] for v in t) == sorted(stray)]
    assert len(kept) == 1 and face["label"][kept[0]] == 77, kept
    assert report["facets"] < len(triangles) / 2, report

    # The border of an open mesh is kept, or simplified within a distance.
    n = 24
    grid = [(i / n, j / n, 0.05 * math.sin(6 * i / n) * math.cos(5 * j / n)) for j in range(n + 1) for i in range(n + 1)]
    firsts = [i + (n + 1) * j for j in range(n) for i in range(n)]
    squares = [t for a in firsts for t in ((a, a + 1, a + n + 1), (a + 1, a + n + 2, a + n + 1))]
    write(path("open.ply"), as_ply("ascii", grid, squares, [], []))
    kept = result("simplify", path("open.ply"), "-o", path("open_kept.ply"), "--tolerance", "1%")
    fewer = result("simplify", path("open.ply"), "-o", path("open_fewer.ply"), "--tolerance", "1%", "--border", "1%")
    assert kept["kind"] == "virtually closed" and kept["removed_border_edges"] == 0, kept
    assert fewer["removed_border_edges"] > n and fewer["facets"] < kept["facets"], fewer
    assert max(fewer["distance_to_result"], fewer["distance_to_input"]) <= 0.01, fewer

    # check, shell, certify
    report = result("check", path("in.ply"))
    assert report["kind"] == "closed" and report["components"] == 1 and report["polygons"] == len(triangles), report
    assert report["thinnest_wall"] is None and report["narrow_area"] == 0, report
    report = result("check", path("in.ply"), "--thickness", "60%")
    assert 1.8 < report["thinnest_wall"] <= 2.01 and report["narrow_area"] == 0, report
    report = result("check", path("stray.ply"))
    assert report["kind"] == "excised" and report["intersecting_facets"] > 0 and report["facets"], report
    # three triangles at an edge
    write(path("book.off"), "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 -1 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n")
    report = result("check", path("book.off"))
    assert report["edges_with_one_polygon"] == 6 and report["edges_with_several_polygons"] == 1, report
    report = result("check", os.path.join(meshes, "holes.off"))
    assert report["kind"] == "virtually closed" and report["border_edges"] > 0, report
    assert 'material (polygons: "east side", "west side")' in result("check", path("in.obj"))["attributes"], report
    report = result("check", path("in.ply"))
    assert "color (points: red, green, blue)" in report["attributes"], report
    write(path("twice.ply"), as_ply("ascii", [tuple(2 * x for x in p) for p in points], triangles, [], []))
    report = result("check", path("twice.ply"), "--distance", path("in.ply"))
    assert 0.99 < report["distance_from_other"] < 1.02 and 0.99 < report["distance_to_other"] < 1.02, report
    report = result("check", path("in.ply"), "--distance", path("in.ply"))
    assert max(report["distance_to_other"], report["distance_from_other"]) < 1e-4, report
    report = result("shell", path("in.ply"), "-o", path("shell"))
    for name in report["files"]:
        assert os.path.getsize(name) > 0, name
    report = result("certify", path("shell.shell"), path("in.off"))
    assert report["certified"] and set(report["claims"].values()) == {"proved"}, report
    write(path("big.off"), "OFF\n8 12 0\n" + "".join("%d %d %d\n" % (3 * (i & 1), 3 * (i >> 1 & 1), 3 * (i >> 2)) for i in range(8))
          + "".join("3 %d %d %d\n" % t for t in ((0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (1, 3, 7),
                                                 (1, 7, 5), (3, 2, 6), (3, 6, 7), (2, 0, 4), (2, 4, 6))))
    done = run("certify", path("shell.shell"), path("big.off"))
    assert done.returncode == NOT_CERTIFIED and "is not certified" in done.stdout and "containment" in done.stderr, done
    done = run("certify", path("in.ply"), path("big.off"))
    assert done.returncode == WRONG_INPUT and "is not a shell" in done.stderr, done

    # manners
    for arguments in ((), ("simplify",), ("check",), ("shell",), ("certify",)):
        done = run(*arguments, "--help")
        assert done.returncode == 0 and "Exit codes" in done.stdout and done.stderr == "", done
    assert run("--version").stdout.startswith("bspline_shell "), run("--version")
    done = run("simplify", path("in.ply"), "-o", path("t.ply"), "--tolerence", "1")
    assert done.returncode == WRONG_USAGE and "--tolerence" in done.stderr and "--tolerance" in done.stderr, done
    done = run("simplfy", path("in.ply"))
    assert done.returncode == WRONG_USAGE and "did you mean simplify" in done.stderr, done
    done = run("convert", path("in.ply"))
    assert done.returncode == WRONG_USAGE and "transfer" in done.stderr and "did you mean" not in done.stderr, done
    done = run("simplify", path("in.ply"), path("t.ply"))
    assert done.returncode == WRONG_USAGE and "-o " + path("t.ply") in done.stderr, done
    done = run("remesh", path("in.ply"), "-o", path("t.ply"), "--edge", "3")
    assert done.returncode == WRONG_USAGE and "longest side" in done.stderr, done
    for arguments in ((), ("simplify",), ("simplify", path("in.ply")), ("simplify", path("in.ply"), "-o", path("t.xyz")),
                      ("simplify", path("in.ply"), "-o", path("in.ply")),
                      ("simplify", path("in.ply"), "-o", path("t.ply"), "--tolerance", "0"),
                      ("simplify", path("in.ply"), "-o", path("t.ply"), "--tolerance", "x%"),
                      ("simplify", path("in.ply"), "-o", path("t.ply"), "--tolerance", "1", "%"),
                      ("simplify", path("in.ply"), "-o", path("t.ply"), "--facets", "1e3")):
        assert run(*arguments).returncode == WRONG_USAGE, arguments
    done = run("simplify", path("missing.ply"), "-o", path("t.ply"), "--json")
    failure = json.loads(done.stdout)
    assert "does not exist" in failure["error"] and failure["exit_code"] == done.returncode == WRONG_INPUT, done
    done = run("simplify", path("in.ply"), "-o", path("t.ply"), "--ratio", "2")
    assert done.returncode == WRONG_USAGE and "at most 1" in done.stderr, done
    before = read(path("t.ply"))
    for name, contents, said in (("missing.ply", None, "does not exist"), ("broken.off", "OFF\n3 1 0\n0 0 0\n", "broken.off, line 3"),
                                 ("none.obj", "", "is empty"), ("points.obj", "v 0 0 0\n", "no polygons"),
                                 ("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "not a number"),
                                 ("index.obj", "v 0 0 0\nf 1 2 3\n", "refers to a point")):
        done = run("simplify", path(name) if contents is None else write(path(name), contents), "-o", path("t.ply"))
        assert done.returncode == WRONG_INPUT and said in done.stderr, done
    assert run("simplify", path("in.ply"), "-o", path("no/such/folder/x.ply")).returncode == CANNOT_WRITE
    assert read(path("t.ply")) == before
    running = subprocess.Popen([program, "simplify", os.path.join(meshes, "armadillo.off"), "-o", path("t.ply")],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(0.5)
    running.send_signal(signal.SIGINT)
    assert running.wait() != 0 and read(path("t.ply")) == before
    assert not [name for name in os.listdir(folder) if ".part" in name], os.listdir(folder)
