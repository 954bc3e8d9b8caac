"""Models whose attributes are known functions of the position, and their files.

Real attributes are linear, and change by their range over a box side. So they change by at most x % of the range when
a point moves by x % of the box side. Labels and charts of texture coordinates are regions, whose borders are edges.
"""
import math
import os
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), *[".."] * 3, "test", "Bspline_shell_3", "Tool"))
from mesh_files import as_glb, as_ply, centroid, read_glb, read_obj, read_ply, torus, write  # noqa: E402

EXTENSION = {"ascii": ".ply", "binary_little_endian": ".ply", "binary_big_endian": ".ply", "obj": ".obj", "off": ".off",
             "stl": ".stl", "binary_stl": ".stl", "glb": ".glb"}
MATERIALS = "red brick", "slate"
FRONT = 3               # The first regions have the first material.
MAPS = "newmtl red brick\nKd 1 0 0\nmap_Kd brick.png\nnewmtl slate\nKd 0 0 1\n"
IMAGE = b"\x89PNG an image that is not decoded"


class Model:
    """Polygons with attributes.

    reals: the names of `colors`, `confidence`, `elevation`, which points have, and of `quality`, which polygons have
    scores: returns a number for each region; a point belongs to the region with the largest number. Between adjacent
            regions, the difference of two numbers changes by at most sqrt(2) times the distance.
    """

    def __init__(self, name, encoding, points, polygons, reals=(), scores=None, has_texture=False):
        self.name, self.encoding, self.points, self.polygons = name + EXTENSION[encoding], encoding, points, polygons
        self.reals, self.scores, self.has_texture = reals, scores, has_texture
        self.low = [min(p[a] for p in points) for a in range(3)]
        self.side = max(max(p[a] for p in points) - self.low[a] for a in range(3))

    def stripped(self, name, encoding=None):
        return Model(name, encoding or self.encoding, self.points, self.polygons)

    def in_box(self, p):
        return [(x - low) / self.side for x, low in zip(p, self.low)]

    def value(self, name, p):
        t = self.in_box(p)
        if name == "colors":
            return tuple(255 * x for x in t)
        return {"confidence": 0.6 * t[0] + 0.8 * t[1], "elevation": 100 * t[2], "quality": 0.8 * t[1] - 0.6 * t[2]}[name]

    def region(self, p):
        scores = self.scores(p)
        return scores.index(max(scores))

    def depth(self, p, regions):
        """Returns a lower bound on the distance of a point from regions."""
        scores = self.scores(p)
        return (max(scores) - max(scores[k] for k in regions)) / math.sqrt(2)

    def texture(self, p, region):
        """The charts lie beside each other, so that the first coordinate tells the region."""
        t = self.in_box(p)
        return region + 0.1 + 0.8 * t[region // 2 % 3 - 2], 0.1 + 0.8 * t[region // 2 % 3 - 1]

    def regions(self):
        return [self.region(centroid_of(self.points, polygon)) for polygon in self.polygons]


RANGES = {"colors": 255, "confidence": 1, "elevation": 100, "quality": 1, "texture": 0.8}


def centroid_of(points, polygon):
    return [sum(points[v][a] for v in polygon) / len(polygon) for a in range(3)]


def material(region):
    return MATERIALS[0] if region < FRONT else MATERIALS[1]


def group(region):
    return "part %d" % region


# Shapes

def ball(cells, scale=1.0, center=(0.0, 0.0, 0.0)):
    """Returns a sphere with bumps, divided into six regions by the faces of a cube, and their scores."""
    index, points, triangles = {}, [], []

    def vertex(grid):
        if grid not in index:
            index[grid] = len(points)
            d = [math.tan(math.pi / 4 * (2 * x / cells - 1)) for x in grid]
            d = [x / math.hypot(*d) for x in d]
            r = 1 + 0.05 * math.sin(5 * d[0]) * math.cos(4 * d[1]) + 0.03 * math.sin(7 * d[2])
            points.append(tuple(c + scale * r * x for c, x in zip(center, d)))
        return index[grid]

    for axis in range(3):
        for end in (0, cells):
            for i in range(cells):
                for j in range(cells):
                    corners = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        grid = [end] * 3
                        grid[axis - 2], grid[axis - 1] = a, b
                        corners.append(vertex(tuple(grid)))
                    p, q, r, s = corners if end else corners[::-1]
                    triangles += [(p, q, r), (p, r, s)]

    def scores(p):
        return [s * (p[a] - center[a]) for a in range(3) for s in (1, -1)]

    return points, triangles, scores


def sector_scores(p):
    return [p[0], p[1], -p[0], -p[1]]


def washer(around=96, radial=8, axial=5, inner=0.5, height=0.3):
    """Returns a flat ring with a rectangular section, whose four sides are regions."""
    profile = [(inner + (1 - inner) * i / radial, 0.0) for i in range(radial)] + [(1.0, height * i / axial) for i in range(axial)]
    profile += [(1 - (1 - inner) * i / radial, height) for i in range(radial)] + [(inner, height * (1 - i / axial)) for i in range(axial)]
    size = len(profile)
    points = [(r * math.cos(2 * math.pi * i / around), r * math.sin(2 * math.pi * i / around), z)
              for i in range(around) for r, z in profile]
    triangles = []
    for i in range(around):
        for j in range(size):
            p, q, r, s = (i % around * size + j % size for i, j in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
            triangles += [(p, q, r), (p, r, s)]

    def scores(p):
        r = math.hypot(p[0], p[1])
        return [-abs(r - 1), -abs(r - inner), -abs(p[2] - height), -abs(p[2])]

    return points, triangles, scores


def terrain(cells=64):
    points = [(float(i), float(j), 8 * math.sin(i / 7) * math.cos(j / 9) + i / 20) for i in range(cells + 1) for j in range(cells + 1)]
    at = lambda i, j: i * (cells + 1) + j
    return points, [t for i in range(cells) for j in range(cells)
                    for t in ((at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1)))]


def halved(quadrangles):
    return [t for p, q, r, s in quadrangles for t in ((p, q, r), (p, r, s))]


def with_spikes(points, triangles):
    """Adds five triangles that intersect the surface."""
    points, triangles = list(points), list(triangles)
    for n in range(5):
        p = points[triangles[97 * n][0]]
        a = [0.02 * math.cos(n), 0.02 * math.sin(n), 0.02]
        triangles.append(tuple(range(len(points), len(points) + 3)))
        points += [tuple(0.9 * x for x in p), tuple(1.1 * x for x in p), tuple(x + y for x, y in zip(p, a))]
    return points, triangles


def in_pieces(points, triangles, gap=0.02):
    """Scales each triangle, so that they have no common vertex, and gaps between them."""
    new_points, new_triangles = [], []
    for t in triangles:
        c = centroid(points, t)
        new_triangles.append(tuple(range(len(new_points), len(new_points) + 3)))
        new_points += [tuple(x + gap * (y - x) for x, y in zip(points[v], c)) for v in t]
    return new_points, new_triangles


def rounded(points):
    return [struct.unpack("3f", struct.pack("3f", *p)) for p in points]


def models(meshes):
    def painted(mesh, name, encoding, *reals):
        points, polygons = read_off(os.path.join(meshes, mesh + ".off"))[:2]
        return Model(name, encoding, points, polygons, reals)

    def unpacked(shape, name, encoding, reals=(), has_texture=False, has_regions=True):
        points, polygons, scores = shape
        return Model(name, encoding, points, polygons, reals, scores if has_regions else None, has_texture)

    ball_points, ball_triangles, ball_scores = ball(16)
    ring_points, ring_quadrangles = torus(64, 32)
    ring_triangles = halved(ring_quadrangles)
    far, tiny = ball(16, 50, (5e5, 5e6, 120)), ball(16, 1e-6)
    small = ball(6)
    yield unpacked(ball(16), "textured", "obj", has_texture=True)
    yield unpacked(ball(16), "scan", "ascii", ("colors", "confidence"), has_regions=False)
    yield painted("knot1", "knot", "binary_little_endian", "colors", "confidence")
    yield unpacked(washer(), "solids", "stl")
    yield Model("textured", "glb", rounded(ball_points), ball_triangles, ("colors",), ball_scores, True)
    yield painted("elephant", "colored", "off", "colors")
    yield Model("labels", "binary_little_endian", ring_points, ring_triangles, ("quality",), sector_scores)
    yield painted("eight", "plain", "obj")
    yield Model("terrain", "ascii", *terrain(), ("elevation",))
    yield Model("spikes", "binary_little_endian", *with_spikes(ball_points, ball_triangles), ("colors", "confidence"))
    yield Model("pieces", "binary_little_endian", *in_pieces(*small[:2]), ("colors",))
    yield Model("quads", "obj", ring_points, ring_quadrangles, (), sector_scores, True)
    yield unpacked(far, "far", "obj", has_texture=True)
    yield unpacked(tiny, "tiny", "binary_little_endian", ("colors", "confidence"), has_regions=False)
    yield painted("fandisk", "fandisk", "ascii", "confidence", "quality")
    yield painted("homer", "homer", "binary_big_endian", "colors")
    yield painted("rotor", "rotor", "binary_stl")
    yield painted("bear", "bear", "obj", "colors")
    yield painted("dino", "dino", "glb", "colors")
    yield painted("blobby", "blobby", "binary_little_endian", "colors", "confidence", "quality")


# Files

def write_model(model, folder):
    name = os.path.join(folder, model.name)
    if model.encoding == "obj":
        write(os.path.join(folder, "parts.mtl"), MAPS)
    return write(name, {"obj": obj_of, "off": off_of, "stl": stl_of, "binary_stl": binary_stl_of, "glb": glb_of}
                 .get(model.encoding, ply_of)(model))


def bytes_of(color):
    return [min(max(round(x), 0), 255) for x in color]


def ply_of(model):
    of_points, of_polygons = [], []
    for name in model.reals:
        if name == "colors":
            of_points += [(channel, "uchar", lambda p, a=a: bytes_of(model.value("colors", p))[a])
                          for a, channel in enumerate(("red", "green", "blue"))]
        elif name == "quality":
            of_polygons.append((name, "double", lambda p: model.value("quality", p)))
        else:
            of_points.append((name, "float", lambda p, name=name: model.value(name, p)))
    if model.scores:
        of_polygons.append(("region", "int", model.region))
    return as_ply(model.encoding, model.points, model.polygons, of_points, of_polygons)


def obj_of(model):
    has_color = "colors" in model.reals
    text = "mtllib parts.mtl\n" if model.scores else ""
    for p in model.points:
        text += "v %r %r %r" % tuple(p) + (" %r %r %r" % tuple(x / 255 for x in model.value("colors", p)) if has_color else "") + "\n"
    regions = model.regions() if model.scores else [0] * len(model.polygons)
    lines, corner, current = [], 1, None
    for region, polygon in sorted(zip(regions, model.polygons), key=lambda pair: pair[0]):
        if model.scores and region != current:
            lines.append("g %s\nusemtl %s\n" % (group(region), material(region)))
            current = region
        if model.has_texture:
            lines += ["vt %r %r\n" % model.texture(model.points[v], region) for v in polygon]
            lines.append("f " + " ".join("%d/%d" % (v + 1, corner + i) for i, v in enumerate(polygon)) + "\n")
            corner += len(polygon)
        else:
            lines.append("f " + " ".join(str(v + 1) for v in polygon) + "\n")
    return text + "".join(lines)


def off_of(model):
    has_color = "colors" in model.reals
    text = "%sOFF\n%d %d 0\n" % ("C" if has_color else "", len(model.points), len(model.polygons))
    for p in model.points:
        text += "%r %r %r" % tuple(p) + (" %d %d %d 255" % tuple(bytes_of(model.value("colors", p))) if has_color else "") + "\n"
    return text + "".join("%d %s\n" % (len(t), " ".join(map(str, t))) for t in model.polygons)


def stl_of(model):
    regions = model.regions() if model.scores else [0] * len(model.polygons)
    text = ""
    for region in sorted(set(regions)):
        text += "solid %s\n" % group(region)
        for k, t in zip(regions, model.polygons):
            if k == region:
                text += "facet normal 0 0 0\nouter loop\n" + "".join("vertex %r %r %r\n" % model.points[v] for v in t) + "endloop\nendfacet\n"
        text += "endsolid %s\n" % group(region)
    return text


def binary_stl_of(model):
    return (b"made by a benchmark".ljust(80) + struct.pack("<I", len(model.polygons))
            + b"".join(struct.pack("<12fH", 0, 0, 0, *(x for v in t for x in model.points[v]), 0) for t in model.polygons))


def glb_of(model):
    regions = model.regions() if model.scores else [0] * len(model.polygons)
    index, rows, parts = {}, [], [[], []]
    for region, t in zip(regions, model.polygons):
        for v in t:
            key = v, region if model.has_texture else 0
            if key not in index:
                index[key] = len(rows)
                rows.append(key)
            parts[MATERIALS.index(material(region))].append(index[key])
    attributes = [("POSITION", 5126, "VEC3", [model.points[v] for v, _ in rows])]
    if model.has_texture:
        uv = [model.texture(model.points[v], region) for v, region in rows]
        attributes.append(("TEXCOORD_0", 5126, "VEC2", [(u, 1 - v) for u, v in uv]))
    if "colors" in model.reals:
        attributes.append(("COLOR_0", 5121, "VEC4", [(*bytes_of(model.value("colors", model.points[v])), 255) for v, _ in rows]))
    return as_glb(attributes, [part for part in parts if part], IMAGE, {"materials": [{"name": name} for name in MATERIALS]})


class Content:
    """What is in a file. of_points: values of names; labels: of polygons; texture: of corners of polygons."""

    def __init__(self, points, polygons):
        self.points, self.polygons = points, polygons
        self.of_points, self.of_polygons, self.labels, self.texture = {}, {}, {}, []


def read_model(name):
    return {".ply": content_of_ply, ".obj": content_of_obj, ".off": content_of_off, ".stl": content_of_stl,
            ".glb": content_of_glb}[os.path.splitext(name)[1]](name)


def content_of_ply(name):
    found = read_ply(name)[2]
    vertex, face = found["vertex"][1], found["face"][1]
    content = Content(list(zip(*(vertex[a] for a in "xyz"))), face["vertex_indices"])
    if "red" in vertex:
        content.of_points["colors"] = list(zip(vertex["red"], vertex["green"], vertex["blue"]))
    for real in ("confidence", "elevation"):
        if real in vertex:
            content.of_points[real] = vertex[real]
    if "quality" in face:
        content.of_polygons["quality"] = face["quality"]
    if "region" in face:
        content.labels["region"] = face["region"]
    return content


def content_of_obj(name):
    found = read_obj(name)
    content = Content([tuple(v[:3]) for v in found["v"]], [tuple(v[0] for v in corners) for corners, _ in found["f"]])
    if all(len(v) > 3 for v in found["v"]):
        content.of_points["colors"] = [tuple(255 * x for x in v[3:6]) for v in found["v"]]
    for label, key in (("group", "g"), ("material", "usemtl")):
        values = [state[key] for _, state in found["f"]]
        if any(values):
            content.labels[label] = values
    if found["vt"]:
        content.texture = [[found["vt"][v[1]] for v in corners] for corners, _ in found["f"]]
    return content


def read_off(name):
    """Returns points, polygons, and colors of points, if any."""
    with open(name) as file:
        rows = [line.split() for line in file if line.strip() and not line.startswith("#")]
    sizes = rows[1] if len(rows[0]) == 1 else rows[0][1:]
    rows = rows[2 if len(rows[0]) == 1 else 1:]
    points, polygons = int(sizes[0]), int(sizes[1])
    numbers = [[float(x) for x in row] for row in rows[:points]]
    return ([tuple(row[:3]) for row in numbers], [tuple(int(x) for x in row[1:int(row[0]) + 1]) for row in rows[points:points + polygons]],
            [tuple(row[3:6]) for row in numbers if len(row) > 3])


def content_of_off(name):
    points, polygons, colors = read_off(name)
    content = Content(points, polygons)
    if colors:
        content.of_points["colors"] = colors
    return content


def content_of_stl(name):
    with open(name, "rb") as file:
        data = file.read()
    index, polygons, solids, corners, solid = {}, [], [], [], ""
    if not data.startswith(b"solid"):
        for n in range(struct.unpack_from("<I", data, 80)[0]):
            row = struct.unpack_from("<12f", data, 84 + 50 * n)
            polygons.append(tuple(index.setdefault(row[i:i + 3], len(index)) for i in (3, 6, 9)))
    else:
        for line in data.decode().split("\n"):
            words = line.split()
            if words and words[0] == "solid":
                solid = line.split(None, 1)[1] if len(words) > 1 else ""
            elif words and words[0] == "vertex":
                corners.append(index.setdefault(tuple(float(x) for x in words[1:]), len(index)))
            elif words and words[0] == "endloop":
                polygons.append(tuple(corners))
                solids.append(solid)
                corners = []
    content = Content(list(index), polygons)
    if any(solids):
        content.labels["group"] = solids
    return content


def content_of_glb(name):
    gltf, _, primitives = read_glb(name)
    content = Content([], [])
    colors, materials = [], []
    for number, vertices, rows in primitives:
        first = len(content.points)
        content.points += rows["POSITION"]
        triangles = list(zip(*[iter(vertices)] * 3))
        content.polygons += [tuple(first + v for v in t) for t in triangles]
        colors += [row[:3] for row in rows.get("COLOR_0", ())]
        if "TEXCOORD_0" in rows:
            content.texture += [[(rows["TEXCOORD_0"][v][0], 1 - rows["TEXCOORD_0"][v][1]) for v in t] for t in triangles]
        materials += [gltf["materials"][number].get("name")] * len(triangles)
    if colors:
        content.of_points["colors"] = colors
    content.labels["material"] = materials
    return content
