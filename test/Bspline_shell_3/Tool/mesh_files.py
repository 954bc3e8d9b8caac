"""Meshes with known shapes, and files of meshes, which the tests read and write themselves."""
import json
import math
import struct


def write(name, data):
    with open(name, "wb") as file:
        file.write(data if isinstance(data, bytes) else data.encode())
    return name


def read(name):
    with open(name, "rb") as file:
        return file.read()


def sphere(rings=24, sectors=48):
    """Returns points and triangles of the unit sphere."""
    points = [(0.0, 0.0, 1.0)]
    for i in range(1, rings):
        for j in range(sectors):
            t, p = math.pi * i / rings, 2 * math.pi * j / sectors
            points.append((math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t)))
    points.append((0.0, 0.0, -1.0))
    last = len(points) - 1
    at = lambda i, j: 1 + (i - 1) * sectors + j % sectors
    triangles = [(0, at(1, j), at(1, j + 1)) for j in range(sectors)]
    for i in range(1, rings - 1):
        for j in range(sectors):
            triangles += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    triangles += [(last, at(rings - 1, j + 1), at(rings - 1, j)) for j in range(sectors)]
    return points, triangles


def centroid(points, triangle):
    return [sum(points[v][a] for v in triangle) / 3 for a in range(3)]


SIZES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}


def read_ply(name):
    """Returns comments, and for each element the types and values of its properties."""
    data = read(name)
    header, body = data.split(b"end_header\n", 1)
    lines = header.decode().split("\n")
    encoding = lines[1].split()[1]
    comments = [line for line in lines if line.startswith(("comment", "obj_info"))]
    elements = []
    for line in lines:
        words = line.split()
        if words and words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words and words[0] == "property":
            elements[-1][2].append((words[-1], words[1:-1]))
    words, position = iter(body.split()) if encoding == "ascii" else None, 0
    order = ">" if encoding == "binary_big_endian" else "<"

    def number(kind):
        nonlocal position
        if encoding == "ascii":
            word = next(words)
            return struct.unpack("f", struct.pack("f", float(word)))[0] if kind == "float" else float(word) if kind == "double" else int(word)
        position += struct.calcsize(SIZES[kind])
        return struct.unpack_from(order + SIZES[kind], body, position - struct.calcsize(SIZES[kind]))[0]

    found = {}
    for element, size, properties in elements:
        columns = {property: [] for property, _ in properties}
        for _ in range(size):
            for property, kind in properties:
                columns[property].append([number(kind[2]) for _ in range(number(kind[1]))] if kind[0] == "list" else number(kind[0]))
        found[element] = ({property: " ".join(kind) for property, kind in properties}, columns)
    return encoding, comments, found


def as_ply(encoding, points, triangles, of_points, of_triangles):
    """of_points, of_triangles: lists of name, type, function of the position."""
    order = ">" if encoding == "binary_big_endian" else "<"
    header = "ply\nformat %s 1.0\ncomment units millimetre\nobj_info scan 42\nelement vertex %d\n" % (encoding, len(points))
    header += "".join("property double %s\n" % a for a in "xyz") + "".join("property %s %s\n" % (t, n) for n, t, _ in of_points)
    header += "element face %d\nproperty list uchar int vertex_indices\n" % len(triangles)
    header += "".join("property %s %s\n" % (t, n) for n, t, _ in of_triangles) + "end_header\n"
    body = b""
    for p in points:
        row = [("double", x) for x in p] + [(t, f(p)) for _, t, f in of_points]
        body += pack(encoding, order, row)
    for t in triangles:
        c = centroid(points, t)
        body += pack(encoding, order, [("uchar", 3)] + [("int", v) for v in t] + [(kind, f(c)) for _, kind, f in of_triangles])
    return header.encode() + body


def pack(encoding, order, row):
    if encoding == "ascii":
        return (" ".join(repr(x) for _, x in row) + "\n").encode()
    return b"".join(struct.pack(order + SIZES[kind], x) for kind, x in row)


def read_obj(name):
    found = {"v": [], "vt": [], "vn": [], "f": [], "lines": []}
    state = {"usemtl": None, "g": None, "s": None, "o": None}
    for line in read(name).decode().split("\n"):
        words = line.split()
        if not words:
            continue
        if words[0] in ("v", "vt", "vn"):
            found[words[0]].append([float(x) for x in words[1:]])
        elif words[0] == "f":
            found["f"].append(([tuple(int(i) - 1 if i else -1 for i in word.split("/")) for word in words[1:]], dict(state)))
        elif words[0] in state:
            state[words[0]] = line.split(None, 1)[1]
        else:
            found["lines"].append(line)
    return found


def torus(around=48, across=24, radius=1.0, tube=0.4, phase=0.0):
    """Returns points and quadrangles of a torus."""
    points = []
    for i in range(around):
        for j in range(across):
            t, p = 2 * math.pi * (i + phase) / around, 2 * math.pi * (j + phase) / across
            r = radius + tube * math.cos(p)
            points.append((r * math.cos(t), r * math.sin(t), tube * math.sin(p)))
    at = lambda i, j: i % around * across + j % across
    return points, [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(around) for j in range(across)]


def as_obj(points, polygons, uv=None, head=""):
    """uv: texture coordinates of the corners of each polygon."""
    text, corner = head + "".join("v %r %r %r\n" % tuple(p) for p in points), 1
    for n, polygon in enumerate(polygons):
        if uv:
            text += "".join("vt " + " ".join(map(repr, x)) + "\n" for x in uv[n])
            text += "f " + " ".join("%d/%d" % (v + 1, corner + i) for i, v in enumerate(polygon)) + "\n"
            corner += len(polygon)
        else:
            text += "f " + " ".join(str(v + 1) for v in polygon) + "\n"
    return text


GLTF_TYPES = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}
GLTF_SIZES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def as_glb(attributes, primitives, image, extra):
    """attributes: tuples of semantic, component type, type, rows. primitives: lists of vertices; each has its material."""
    data, views, accessors = b"", [], []

    def view(content):
        nonlocal data
        data += b"\0" * (-len(data) % 4)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(content)})
        data += content
        return len(views) - 1

    def accessor(component, kind, rows, **more):
        content = struct.pack("<%d%s" % (len(rows) * GLTF_SIZES[kind], GLTF_TYPES[component]), *(x for row in rows for x in row))
        accessors.append({"bufferView": view(content), "componentType": component, "type": kind, "count": len(rows), **more})
        return len(accessors) - 1

    of_vertices = {semantic: accessor(component, kind, rows, **({"normalized": True} if component == 5121 else {}))
                   for semantic, component, kind, rows in attributes}
    parts = [{"attributes": of_vertices, "indices": accessor(5125, "SCALAR", [(v,) for v in vertices]), "material": n}
             for n, vertices in enumerate(primitives)]
    head = json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "ball"}],
                       "meshes": [{"primitives": parts}], "images": [{"bufferView": view(image), "mimeType": "image/png"}],
                       "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(data)}], **extra}).encode()
    head += b" " * (-len(head) % 4)
    data += b"\0" * (-len(data) % 4)
    return (b"glTF" + struct.pack("<IIII", 2, 28 + len(head) + len(data), len(head), 0x4E4F534A) + head
            + struct.pack("<II", len(data), 0x004E4942) + data)


def read_glb(name):
    """Returns the parts of the file, the bytes of its image, and for each primitive its material, vertices, and attributes."""
    data = read(name)
    assert data[:4] == b"glTF" and struct.unpack_from("<I", data, 8)[0] == len(data), data[:12]
    size = struct.unpack_from("<I", data, 12)[0]
    gltf, body = json.loads(data[20:20 + size]), data[28 + size:]

    def rows(index):
        a = gltf["accessors"][index]
        v = gltf["bufferViews"][a["bufferView"]]
        row = "<%d%s" % (GLTF_SIZES[a["type"]], GLTF_TYPES[a["componentType"]])
        stride = v.get("byteStride", struct.calcsize(row))
        return [struct.unpack_from(row, body, v.get("byteOffset", 0) + n * stride) for n in range(a["count"])]

    v = gltf["bufferViews"][gltf["images"][0]["bufferView"]]
    image = body[v.get("byteOffset", 0):][:v["byteLength"]]
    return gltf, image, [(p["material"], [v for v, in rows(p["indices"])], {s: rows(a) for s, a in p["attributes"].items()})
                         for m in gltf["meshes"] for p in m["primitives"]]
