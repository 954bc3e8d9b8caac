"""Checks what `bspline_shell remesh` writes: lengths of edges, features, borders, seams, and attributes against known
functions.

Usage: remesh_test.py BSPLINE_SHELL MESHES     (MESHES: the folder of CGAL's meshes)
"""
import json
import math
import os
import subprocess
import sys
import tempfile

from mesh_files import as_obj, as_ply, centroid, read, read_obj, read_ply, sphere, write

program, meshes = sys.argv[1:]
WRONG_INPUT, WRONG_USAGE, NOT_CERTIFIED = 1, 2, 4


def run(*arguments):
    return subprocess.run([program, "remesh", *arguments], capture_output=True, text=True)


def result(*arguments):
    done = run(*arguments, "--json")
    assert done.returncode == 0, done
    return json.loads(done.stdout)


def mesh_of(name):
    """Returns points and triangles of a PLY file."""
    vertex, face = (read_ply(name)[2][e][1] for e in ("vertex", "face"))
    return list(zip(*(vertex[a] for a in "xyz"))), face["vertex_indices"]


def edges_of(triangles):
    """Returns the number of triangles at each edge."""
    number = {}
    for t in triangles:
        for i in range(3):
            edge = tuple(sorted((t[i], t[(i + 1) % 3])))
            number[edge] = number.get(edge, 0) + 1
    return number


def area(points, triangles):
    sum = 0
    for t in triangles:
        u, v = ([points[t[i]][a] - points[t[0]][a] for a in range(3)] for i in (1, 2))
        sum += math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2
    return sum


def share_near(points, triangles, length):
    edges = edges_of(triangles)
    return sum(0.8 * length <= math.dist(points[v], points[w]) <= 4 / 3 * length for v, w in edges) / len(edges)


unit = lambda p: [x / math.sqrt(sum(y * y for y in p)) for x in p]
channel = lambda a: lambda p: round(127.5 + 127.5 * p[a])
side = lambda p: 1 if p[0] > 0.01 else 2
points, triangles = sphere()

with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)

    # Lengths and attributes on a sphere
    write(path("in.ply"), as_ply("ascii", points, triangles, [("red", "uchar", channel(0)), ("green", "uchar", channel(1)),
                                                              ("blue", "uchar", channel(2)), ("heat", "float", lambda p: p[2])],
                                 [("part", "short", side)]))
    for length in (0.1, 0.2):
        report = result(path("in.ply"), "-o", path("out.ply"), "--edge", str(length))
        assert report["certification"] == "certified" and report["edge"] == length, report
        assert max(report["distance_to_result"], report["distance_to_input"]) < 0.02, report
        found, facets = mesh_of(path("out.ply"))
        share = share_near(found, facets, length)
        assert share > 0.85 and abs(share - report["share_near_edge"]) < 1e-6, (share, report)
        assert set(edges_of(facets).values()) == {2} and len(facets) == report["facets"]
        _, _, elements = read_ply(path("out.ply"))
        assert elements["vertex"][0]["heat"] == "float" and elements["face"][0]["part"] == "short", elements
        for i, p in enumerate(found):
            q = unit(p)
            assert all(abs(elements["vertex"][1][c][i] - (127.5 + 127.5 * q[a])) < 4 for a, c in enumerate(("red", "green", "blue"))), p
            assert abs(elements["vertex"][1]["heat"][i] - q[2]) < 0.02, p
        for i, t in enumerate(facets):
            c = centroid(found, t)
            assert elements["face"][1]["part"][i] == side(c) or abs(c[0]) < 0.08, c

    # The edges of a cube are kept, so that each facet lies on one side.
    cube = [tuple(2.0 * (n >> a & 1) for a in range(3)) for n in range(8)]
    sides = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (1, 3, 7), (1, 7, 5), (3, 2, 6), (3, 6, 7), (2, 0, 4), (2, 4, 6)]
    write(path("cube.obj"), as_obj(cube, sides))
    report = result(path("cube.obj"), "-o", path("cube.ply"), "--edge", "10%")
    found, facets = mesh_of(path("cube.ply"))
    assert report["edges_on_features"] == 12 and share_near(found, facets, 0.2) > 0.85, report
    for t in facets:
        assert any(all(abs(found[v][a] - x) < 0.02 for v in t) for a in range(3) for x in (0, 2)), t
    on_edges = [p for p in found if sum(x in (0, 2) for x in p) >= 2]
    assert len(on_edges) >= 12 * 6 + 8 and all(p in found for p in cube), len(on_edges)
    assert abs(area(found, facets) - 24) < 0.1, area(found, facets)

    # Borders are kept, point by point.
    report = result(os.path.join(meshes, "holes.off"), "-o", path("holes.ply"), "--edge", "4%")
    lines = [line.split() for line in read(os.path.join(meshes, "holes.off")).decode().split("\n") if line.strip() and line[0] != "#"]
    size, facets_before = int(lines[1][0]), [[int(v) for v in line[1:4]] for line in lines[2 + int(lines[1][0]):]]
    before = [tuple(float(x) for x in line[:3]) for line in lines[2:2 + size]]
    found, facets = mesh_of(path("holes.ply"))
    border = lambda points, facets: {tuple(sorted((points[v], points[w]))) for (v, w), n in edges_of(facets).items() if n == 1}
    assert border(before, facets_before) == border(found, facets) and border(found, facets), report

    # A texture with a seam, which is kept as a line
    def uv(p, near):
        u = math.atan2(p[1], p[0]) / (2 * math.pi)
        return u + round(near - u), p[2]

    corners = []
    for t in triangles:
        c = centroid(points, t)
        middle = math.atan2(c[1], c[0]) / (2 * math.pi)
        corners.append([uv(points[v], middle) for v in t])
    write(path("textured.obj"), as_obj(points, triangles, corners))
    report = result(path("textured.obj"), "-o", path("textured_out.obj"), "--edge", "0.15")
    found = read_obj(path("textured_out.obj"))
    assert report["edges_on_lines"] > 0 and report["facets_across_seams"] <= 0.02 * len(found["f"]), report
    wrong = 0
    for facet, _ in found["f"]:
        middle = found["vt"][facet[0][1]][0]
        for v, t in facet:
            p = unit(found["v"][v])
            if abs(p[2]) < 0.9:         # the texture is singular at the poles
                wrong += math.dist(found["vt"][t], uv(p, middle)) > 0.03
    assert wrong <= 6 * report["facets_across_seams"], (wrong, report)

    # Excised triangles stay as they are.
    stray = [(0.9, -0.02, 0.3), (1.1, 0.0, 0.31), (0.9, 0.02, 0.32)]
    write(path("stray.ply"), as_ply("ascii", points + stray, triangles + [tuple(len(points) + i for i in range(3))], [], []))
    report = result(path("stray.ply"), "-o", path("stray_out.ply"), "--edge", "0.15")
    assert report["certification"] == "certified except for excised triangles", report
    found, facets = mesh_of(path("stray_out.ply"))
    assert [t for t in facets if sorted(found[v] for v in t) == sorted(stray)], report

    # A tolerance leaves shorter edges where the surface is curved.
    loose, tight = (result(path("in.ply"), "-o", path("tight.ply"), "--edge", "0.5", *tolerance)
                    for tolerance in ((), ("--tolerance", "0.5%")))
    distance = lambda report: max(report["distance_to_result"], report["distance_to_input"])
    assert distance(tight) <= 0.01 < distance(loose) and tight["facets"] > 1.5 * loose["facets"], (loose, tight)
    done = run(path("in.ply"), "-o", path("x.ply"), "--edge", "0.5", "--tolerance", "0.5%", "--thickness", "1%")
    assert done.returncode == NOT_CERTIFIED and "tolerance" in done.stderr, done

    # manners
    done = run("--help")
    assert done.returncode == 0 and "--features" in done.stdout and done.stderr == "", done
    before = read(path("in.ply"))
    for arguments in ((path("in.ply"), "-o", path("x.ply")), (path("in.ply"), "-o", path("x.ply"), "--edge", "0"),
                      (path("in.ply"), "-o", path("in.ply"), "--edge", "1"), (path("in.ply"), "-o", path("x.xyz"), "--edge", "1")):
        done = run(*arguments)
        assert done.returncode == WRONG_USAGE, done
    assert run(path("missing.ply"), "-o", path("x.ply"), "--edge", "1").returncode == WRONG_INPUT
    assert read(path("in.ply")) == before and not os.path.exists(path("x.ply"))
