#!/usr/bin/env python3
"""Checks that check_certificate accepts certificates, and refuses them if one thing in their files is changed.

   check_certificate_test.py CHECKER [PREFIX]
   check_certificate_test.py --apply PREFIX...

PREFIX.shell.txt, PREFIX.mesh.off and PREFIX.certificate.txt belong to a small mesh of one or several components. Some
changes apply only to some kinds of shells and meshes. Claims that are not proved must not be accepted, whatever the
witnesses are changed to. If there is PREFIX.user.off, it is the mesh that is truncated or closed, and is passed to the
checker. So are PREFIX.kept.off, PREFIX.soup.off and PREFIX.joined.off, the meshes with excised triangles. Without PREFIX, generated shells are tested. The exit code is 0 if all tests pass. With --apply, it is 0 if
each change applies to some of the files.
"""
import itertools
import math
import os
import struct
import subprocess
import sys
import tempfile

TABLE = []
for byte in range(256):
    for _ in range(8):
        byte = (byte >> 1) ^ (0xC96C5795D7870F42 if byte & 1 else 0)
    TABLE.append(byte)


def crc64(data):
    crc = 0xFFFFFFFFFFFFFFFF
    for byte in data:
        crc = TABLE[(crc ^ byte) & 255] ^ (crc >> 8)
    return "%016x" % (crc ^ 0xFFFFFFFFFFFFFFFF)


assert crc64(b"123456789") == "995dc9bbdf1939fa"


def text(lines):
    return "".join(line + "\n" for line in lines)


EXCISION = ["kept", "soup", "joined"]


def triangles_of(points, facets):
    return [[tuple(points[v]) for v in t] for t in facets]


class Files:
    """The files as parts that a test can change; `update_...()` recomputes checksums. The user's mesh and those of an
    excision are optional."""

    def __init__(self, prefix):
        self.shell, self.shell_sum = self.read(prefix + ".shell.txt")
        self.certificate, self.certificate_sum = self.read(prefix + ".certificate.txt")
        self.points, self.facets = self.read_mesh(prefix + ".mesh.off")
        self.user = self.read_mesh(prefix + ".user.off") if os.path.exists(prefix + ".user.off") else None
        # the triangles of these soups, as coordinates of the corners
        self.excision = os.path.exists(prefix + ".soup.off") and {
            name: triangles_of(*self.read_mesh("%s.%s.off" % (prefix, name))) for name in EXCISION}

    @classmethod
    def of(cls, shell, certificate, points, facets):
        """Creates files from lines without checksums, and lists."""
        files = cls.__new__(cls)
        files.shell, files.certificate, files.points, files.facets = shell, certificate, points, facets
        files.user = files.excision = None
        files.update_shell()
        files.update_mesh()
        files.update_certificate()
        return files

    @staticmethod
    def read(name):
        lines = open(name).read().split("\n")
        return lines[:-2], lines[-2]

    @staticmethod
    def read_mesh(name):
        numbers = open(name).read().split()[1:]
        vertices, facets = int(numbers[0]), int(numbers[1])
        coordinates = [float(x) for x in numbers[3:3 + 3 * vertices]]
        indices = [int(i) for i in numbers[3 + 3 * vertices:]]
        return [coordinates[3 * v:3 * v + 3] for v in range(vertices)], [indices[4 * f + 1:4 * f + 4] for f in range(facets)]

    @staticmethod
    def write_mesh(name, points, facets):
        with open(name, "w") as out:
            out.write("OFF\n%d %d 0\n" % (len(points), len(facets)))
            out.write("".join("%.17g %.17g %.17g\n" % tuple(p) for p in points))
            out.write("".join("3 %d %d %d\n" % tuple(f) for f in facets))

    def copy(self):
        other = Files.__new__(Files)
        other.shell, other.certificate = list(self.shell), list(self.certificate)
        other.shell_sum, other.certificate_sum = self.shell_sum, self.certificate_sum
        other.points, other.facets = [list(p) for p in self.points], [list(f) for f in self.facets]
        other.user = self.user and ([list(p) for p in self.user[0]], [list(f) for f in self.user[1]])
        other.excision = self.excision and {name: [list(t) for t in triangles] for name, triangles in self.excision.items()}
        return other

    def update_shell(self):
        self.shell_sum = "checksum " + crc64(text(self.shell).encode())
        self.certificate[1] = "shell " + self.shell_sum.split()[1]

    def update_mesh(self):
        data = b"".join(struct.pack("<3d", *p) for p in self.points) + b"".join(struct.pack("<3I", *f) for f in self.facets)
        self.certificate[2] = "mesh %d %d %s" % (len(self.points), len(self.facets), crc64(data))

    def update_certificate(self):
        self.certificate_sum = "checksum " + crc64(text(self.certificate).encode())

    def section(self, lines, name):
        """Returns the number of the line that begins with the name, and its count, or 0 if there is none."""
        line = next(i for i, l in enumerate(lines) if l.startswith(name + " "))
        count = lines[line].split()[1]
        return line, int(count) if count.isdigit() else 0

    def words(self, lines, line, change):
        words = lines[line].split(" ")
        change(words)
        lines[line] = " ".join(words)

    def leaf_at(self, point):
        """Returns the words of the line of a leaf that contains a point."""
        field = self.shell[4].split()
        origin, spacing = [float(x) for x in field[2:5]], float(field[5])
        line, count = self.section(self.shell, "leaves")
        for text_of_leaf in self.shell[line + 1:line + 1 + count]:
            words = text_of_leaf.split()
            place = [(point[a] - origin[a]) / spacing * 2**int(words[0]) - int(words[1 + a]) for a in range(3)]
            if all(0 <= x <= 1 for x in place):
                return words
        raise AssertionError("no leaf at the point")

    def function_at(self, point):
        """Returns the line of a function that acts on the leaf at a point, preferably a central one."""
        words = self.leaf_at(point)
        line, count = self.section(self.shell, "functions")
        lines = {tuple(l.split()[:4]): line + 1 + i for i, l in enumerate(self.shell[line + 1:line + 1 + count])}
        for step in sorted(itertools.product(range(-1, 3), repeat=3), key=lambda d: sum((2 * x - 1)**2 for x in d)):
            function = (words[0],) + tuple(str(int(words[1 + a]) + step[a]) for a in range(3))
            if function in lines:
                return lines[function]
        raise AssertionError("no function acts on the leaf")

    def some_vertex(self):
        """Returns the farthest vertex in a direction in which changes at a vertex have an effect."""
        return max(self.points, key=lambda p: sum(x * d for x, d in zip(p, (0, 0.5, 0.9))))

    def claims(self):
        """Returns the checker's output if it accepts the certificate."""
        verdicts = self.certificate[3].split()[1:]
        claims = ["P%d" % (i + 1) for i in range(5) if verdicts[i] == "proved"]
        return " ".join(["certified:"] + claims + ["T"] * self.is_truncated() + ["A"] * bool(self.user) + ["E"] * bool(self.excision)) + "\n"

    def is_truncated(self):
        return self.shell[self.shell.index("truncation") + 1] != "0 0 0 0 0 0"

    def are_all_proved(self):
        return self.certificate[3].count("proved") == 5

    def components(self):
        return self.section(self.certificate, "seeds")[1]

    def component_of_vertices(self):
        """Returns the component of each vertex, in the order of seeds."""
        parent = list(range(len(self.points)))

        def root(v):
            while parent[v] != v:
                parent[v] = v = parent[parent[v]]
            return v

        for a, b, c in self.facets:
            parent[root(a)] = parent[root(c)] = root(b)
        line, count = self.section(self.certificate, "seeds")
        seeds = [int(self.certificate[line + 1 + c].split()[1]) for c in range(count)]
        number = {root(v): c for c, v in enumerate(seeds)}
        return [number[root(v)] for v in range(len(self.points))]

    def cubes(self):
        """Returns a map from each box's line to its least corner and edge."""
        field = self.shell[4].split()
        origin, spacing = [float(x) for x in field[2:5]], float(field[5])
        first = self.section(self.shell, "leaves")[0] + 1
        result = {}
        for i in self.boxes():
            number, depth, *place = [int(x) for x in self.certificate[i].split()[:5]]
            leaf = [int(x) for x in self.shell[first + number].split()]
            h = spacing / 2**(leaf[0] + depth)
            result[i] = [origin[a] + h * (leaf[1 + a] * 2**depth + place[a]) for a in range(3)], h
        return result

    def kind(self, line):
        return self.certificate[line].split()[5]

    def boxes_at(self, points):
        """Returns, for each point, the lines of cover boxes that contain it."""
        cover = [(i, low, h) for i, (low, h) in self.cubes().items() if self.kind(i) in "gbau"]
        return [[i for i, low, h in cover if low[0] <= p[0] <= low[0] + h and all(low[a] <= p[a] <= low[a] + h for a in (1, 2))]
                for p in points]

    def box_on_mesh(self):
        """Returns the line of a cover box that contains a vertex."""
        return self.boxes_at([self.some_vertex()])[0][0]

    def ends_of_cover(self):
        """Returns where the first path enters and leaves the cover, each as a point and the line of a box there."""
        words = [float(x) for x in self.certificate[self.section(self.certificate, "paths")[0] + 1].split()]
        points = [[words[2 + a] + t / 64 * (words[5 + a] - words[2 + a]) for a in range(3)] for t in range(65)]
        met = [(p, lines[0]) for p, lines in zip(points, self.boxes_at(points)) if lines]
        return met[0], met[-1]

    def excluded_next_to_cover(self):
        """Returns the line of an excluded box that touches a cover box at an end of the first path."""
        cubes = self.cubes()
        ends = [cubes[line] for _, line in reversed(self.ends_of_cover())]
        return next(i for low, h in ends for i, (l, k) in cubes.items() if self.kind(i) == "x"
                    and all(low[a] <= l[a] + k and l[a] <= low[a] + h for a in range(3)))

    def boxes(self):
        line, count = self.section(self.certificate, "boxes")
        return range(line + 1, line + 1 + count)

    def first_box(self, kind):
        return next(i for i in self.boxes() if self.certificate[i].split()[5] == kind)

    def remove_boxes(self, removed):
        line = self.section(self.certificate, "boxes")[0]
        self.certificate = [l for i, l in enumerate(self.certificate) if i not in removed]
        self.certificate[line] = "boxes %d" % (len(self.boxes()) - len(removed))

    def write(self, prefix):
        open(prefix + ".shell.txt", "w").write(text(self.shell + [self.shell_sum]))
        open(prefix + ".certificate.txt", "w").write(text(self.certificate + [self.certificate_sum]))
        self.write_mesh(prefix + ".mesh.off", self.points, self.facets)
        if self.user:
            self.write_mesh(prefix + ".user.off", *self.user)
        for name, triangles in (self.excision or {}).items():
            # each triangle has its own points
            self.write_mesh("%s.%s.off" % (prefix, name), [p for t in triangles for p in t], [[3 * n, 3 * n + 1, 3 * n + 2] for n in range(len(triangles))])


class Truncation:
    """The truncation of the user's mesh: the last section of a shell file."""

    def __init__(self, shell):
        rows = ([float(w) if "." in w or "e" in w else int(w) for w in l.split()] for l in shell[shell.index("truncation") + 1:])

        def take(n):
            return [next(rows) for _ in range(n)]

        corners, cuts, inner, facets, cores, discs = next(rows)
        self.points, self.planar, self.cuts, self.facets, self.cores = (take(n) for n in (
            corners + cuts + inner, cuts + inner, cuts, facets, cores))
        self.discs = []
        for _ in range(discs):
            center, rim, triangles = next(rows)
            self.discs.append(Disc(center, take(rim), take(triangles)))

    def corners(self):
        """Returns the number of points that are vertices of the user's mesh."""
        return len(self.points) - len(self.planar)

    def lines(self):
        rows = [[self.corners(), len(self.cuts), len(self.planar) - len(self.cuts), len(self.facets), len(self.cores), len(self.discs)]]
        rows += self.points + self.planar + self.cuts + self.facets + self.cores
        for d in self.discs:
            rows += [[d.center, len(d.rim), len(d.triangles)]] + d.rim + d.triangles
        return ["truncation"] + [" ".join("%d" % x if isinstance(x, int) else "%.17g" % x for x in row) for row in rows]

    def ear(self):
        """Returns a triangle of the first disc with three consecutive points of its rim, and these points."""
        rim = [r[0] for r in self.discs[0].rim]
        ears = [rim[i - 2:] + rim[:i - 2] for i in range(len(rim))]
        return next((t, e[:3]) for t in self.discs[0].triangles for e in ears if sorted(t) == sorted(e[:3]))


class Disc:
    def __init__(self, center, rim, triangles):
        self.center, self.rim, self.triangles = center, rim, triangles


def set_word(n, new):
    """Returns a function that changes a word of a line; `new` is text, or a function of a number."""
    def change(words):
        words[n] = new if isinstance(new, str) else "%.17g" % new(float(words[n]))
    return change


TESTS = []


def test(code, sentence, update="c", applies=lambda f: True):
    """Registers a change with its expected result.

    `code` is the exit code, `sentence` a part of the output, and `update` the checksums to recompute. The change is
    made to files whose claims are all proved and to which it `applies`.
    """
    return any_test(code, sentence, update, lambda f: f.are_all_proved() and applies(f))


def any_test(code, sentence, update, applies):
    """The same for files with unproved claims."""
    def register(function):
        TESTS.append((function, code, sentence, update, applies))
        return function
    return register


def shell_line(section, offset, change):
    return lambda f: f.words(f.shell, f.section(f.shell, section)[0] + offset, change)


def certificate_line(section, offset, change):
    return lambda f: f.words(f.certificate, f.section(f.certificate, section)[0] + offset, change)


def box(kind, change):
    """Changes the first box of a kind outside the cover, or a cover box on the mesh."""
    return lambda f: f.words(f.certificate, f.box_on_mesh() if kind == "g" else f.first_box(kind), change)


def named(name, function):
    function.__name__ = name
    return function


def add(name, function, *rest):
    test(*rest)(named(name, function))


def used_leaf(f):
    """Returns the number of a leaf with a cover box."""
    return int(f.certificate[f.box_on_mesh()].split()[0])


any_test(0, Files.claims, "", lambda f: True)(named("nothing", lambda f: None))
any_test(0, Files.claims, "smc", lambda f: True)(named("all checksums computed here", lambda f: None))
add("fewer claims", lambda f: f.certificate.__setitem__(3, "verdicts proved proved refuted undecided proved"), 0,
    lambda f: f.claims().replace(" P3 P4", ""))
add("P3 to P5 without P1", lambda f: f.certificate.__setitem__(3, "verdicts undecided proved proved proved proved"), 1, "without P1")

# the shell
def change_at_mesh(word, shift):
    """Adds a multiple of the unit to a number of a function near a vertex."""
    return lambda f: f.words(f.shell, f.function_at(f.some_vertex()), set_word(word, lambda x: x + shift * float(f.shell[1].split()[1])))


for shift in (1, -1, 0.5):
    add("coefficient of f moved by %g" % shift, change_at_mesh(4, shift), 1, "P", "sc")
add("coefficient, old checksum", change_at_mesh(4, 1e-9), 2, "checksum", "")
add("coefficient, old checksum in the certificate", lambda f: (change_at_mesh(4, 1e-9)(f), setattr(
    f, "shell_sum", "checksum " + crc64(text(f.shell).encode()))), 2, "another shell")
add("coefficient that is no number", lambda f: f.words(f.shell, 6, set_word(4, "nan")), 2, "finite", "sc")
add("function removed", lambda f: remove_line(f, f.function_at(f.some_vertex()), "functions"), 2, "has no coefficient", "sc")
add("functions out of order", lambda f: f.shell.__setitem__(slice(6, 8), f.shell[7:5:-1]), 2, "order", "sc")
add("leaves out of order", lambda f: (lambda n: f.shell.__setitem__(slice(n, n + 2), [f.shell[n + 1], f.shell[n]]))(
    f.section(f.shell, "leaves")[0] + 1), 2, "order", "sc")
add("leaf removed, and its boxes", lambda f: remove_leaf(f, f.shell.index(" ".join(f.leaf_at(f.some_vertex())))), 1, "P1", "sc")
add("leaf of another level", lambda f: f.words(f.shell, f.section(f.shell, "leaves")[0] + 1, set_word(0, "11")), 2, "out of range", "sc")


def remove_line(f, line, section):
    count, number = f.section(f.shell, section)
    del f.shell[line]
    f.shell[count] = "%s %d" % (section, number - 1)


def remove_leaf(f, line):
    number = line - f.section(f.shell, "leaves")[0] - 1
    f.remove_boxes([i for i in f.boxes() if int(f.certificate[i].split()[0]) == number])
    for i in f.boxes():
        f.words(f.certificate, i, set_word(0, lambda n: n - (n > number)))
    remove_line(f, line, "leaves")


def levels(name, change, *rest):
    add(name, lambda f: shell_line("levels", 0, change)(f), *rest, lambda f: f.shell[2].startswith("levels"))


def tight_levels(name, change, *rest):
    """Changes the levels of a shell that was built for its mesh, and has ranges of facets."""
    add(name, lambda f: shell_line("levels", 0, change)(f), *rest,
        lambda f: f.shell[2].startswith("levels") and f.section(f.shell, "facet_ranges")[1] > 0)


tight_levels("inner level inwards", set_word(1, lambda x: x + 1e-6), 1, "P1", "sc")
tight_levels("outer level inwards", set_word(2, lambda x: x - 1e-6), 1, "P1", "sc")
tight_levels("outer level inwards a little", set_word(2, lambda x: x - 1e-9), 1, "P1", "sc")
levels("inner level at the outer one", lambda w: w.__setitem__(1, "%.17g" % (float(w[2]) - 1e-9)), 1, "P1", "sc")
levels("outer level at the inner one", lambda w: w.__setitem__(2, "%.17g" % (float(w[1]) + 1e-9)), 1, "P1", "sc")
levels("levels much wider", lambda w: w.__setitem__(slice(1, 3), ["-0.5", "0.5"]), 1, "P3", "sc")


def thresholds(name, change, *rest):
    add(name, change, *rest, lambda f: f.shell[2].startswith("thickness"))


def all_thresholds(word, factor):
    def change(f):
        line, count = f.section(f.shell, "functions")
        for n in range(line + 1, line + 1 + count):
            f.words(f.shell, n, set_word(word, lambda x: factor * x))
    return change


# On leaves of different sizes, the vertex may be beyond the function.
for name, word, shift in (("inner threshold raised at a vertex", 5, 0.5), ("outer threshold lowered at a vertex", 6, -0.5)):
    thresholds(name, change_at_mesh(word, shift), 1, lambda f: "P" if f.is_truncated() else "P1", "sc")
thresholds("outer threshold raised at a vertex", change_at_mesh(6, 0.5), 1, "P3", "sc")
thresholds("no room inside", all_thresholds(5, 0.01), 1, "P1", "sc")
thresholds("far too thick", all_thresholds(6, 30), 1, "P3", "sc")
thresholds("no coefficient of a threshold", lambda f: f.shell.__setitem__(6, f.shell[6].rsplit(" ", 1)[0]), 2, "expected a blank", "sc")
thresholds("thresholds taken for levels", lambda f: f.shell.__setitem__(2, "levels -1 1"), 2, "expected the end of the line", "sc")


# leaves of different sizes
def hierarchy(name, change, *rest):
    add(name, change, *rest, lambda f: not f.shell[6].startswith("0 "))


def insert_line(f, line, new, section):
    f.shell.insert(line, new)
    count, number = f.section(f.shell, section)
    f.shell[count] = "%s %d" % (section, number + 1)


def leaf_lines(f):
    line, count = f.section(f.shell, "leaves")
    return [l.split() for l in f.shell[line + 1:line + 1 + count]]


def overlapping_leaf(f):
    """Adds a leaf that is an octant of another leaf."""
    coarse = leaf_lines(f)[0]
    fine = [int(coarse[0]) + 1] + [2 * int(i) for i in coarse[1:4]]
    line, count = f.section(f.shell, "leaves")
    n = next(n for n in range(line + 1, line + count) if order(f.shell[n]) > (fine[0],) + tuple(fine[:0:-1]))
    insert_line(f, n, " ".join(str(i) for i in fine + [1]), "leaves")


def order(leaf):
    words = [int(i) for i in leaf.split()[:4]]
    return (words[0],) + tuple(words[:0:-1])


def function_on_coarser_leaf(f):
    """Adds a coefficient of a function that should depend on the level above."""
    leaves = {tuple(int(i) for i in words[:4]) for words in leaf_lines(f)}
    line, count = f.section(f.shell, "functions")
    listed = {tuple(int(i) for i in l.split()[:4]) for l in f.shell[line + 1:line + 1 + count]}
    new = next((l, i + a, j + b, k + c) for l, i, j, k in sorted(leaves) if l > 0
               for a in range(-1, 3) for b in range(-1, 3) for c in range(-1, 3) if (l, i + a, j + b, k + c) not in listed)
    def place(key):
        return (-key[0],) + key[:0:-1]
    n = next((line + 1 + n for n, l in enumerate(f.shell[line + 1:line + 1 + count])
              if place(tuple(int(i) for i in l.split()[:4])) > place(new)), line + 1 + count)
    insert_line(f, n, " ".join(str(i) for i in new) + " 0" * (len(f.shell[line + 1].split()) - 4), "functions")


hierarchy("leaf and an eighth of it", overlapping_leaf, 2, "overlaps", "sc")
hierarchy("function with a coefficient of its own at a coarser leaf", function_on_coarser_leaf, 2, "acts on a coarser leaf", "sc")

add("another spacing", shell_line("field", 0, set_word(5, lambda x: 2 * x)), 1, "P", "sc")
add("another origin", shell_line("field", 0, set_word(2, lambda x: x - 0.1)), 1, "P", "sc")
add("no kind of field", shell_line("field", 0, set_word(1, "dense")), 2, "kind", "sc")
for version in ("4", "6"):
    add("version %s" % version, shell_line("cubic_bspline_shell", 0, set_word(1, version)), 2, "out of range", "sc")
add("a path more", lambda f: insert_line(f, f.shell.index("truncation"), "0 0 0 0 1 1 1", "paths"), 0, lambda f: f.claims(), "sc")
add("a path without an end", lambda f: insert_line(f, f.shell.index("truncation"), "0 0 0 0", "paths"), 2, "expected", "sc")
add("a path that is not finite", lambda f: insert_line(f, f.shell.index("truncation"), "0 0 0 0 1 1 nan", "paths"), 2, "finite", "sc")
add("too many leaves", shell_line("leaves", 0, set_word(1, "999999999")), 2, "expected", "sc")
add("shell of another certificate", lambda f: f.certificate.__setitem__(1, "shell 0123456789abcdef"), 2, "another shell")


# the mesh
def size(f):
    return max(max(p[i] for p in f.points) - min(p[i] for p in f.points) for i in range(3))


def swap_points(f):
    a, b = f.facets[len(f.facets) // 2][:2]
    f.points[a], f.points[b] = f.points[b], f.points[a]


def move_last_point(f):
    v = max(range(len(f.points)), key=lambda v: f.points[v][0])
    f.points[v][0] += 0.2 * size(f)


def double_mesh(f):
    """Adds a copy of the mesh at the same place, and adapts the certificate."""
    v, n, components = len(f.points), len(f.facets), f.components()
    f.points += [list(p) for p in f.points]
    f.facets += [[i + v for i in t] for t in f.facets]
    for section, offset in (("seeds", v), ("paths", n)):
        line = f.section(f.certificate, section)[0]
        f.certificate[line] = "%s %d" % (section, 2 * components)
        copies = [l.split() for l in f.certificate[line + 1:line + 1 + components]]
        f.certificate[line + 1 + components:line + 1 + components] = [
            " ".join([str(components + int(w[0])), str(offset + int(w[1]))] + w[2:]) for w in copies]


def double_mesh_without_p4(f):
    double_mesh(f)
    f.certificate[3] = "verdicts proved proved proved undecided proved"


add("vertex moved out of the shell", move_last_point, 1, "P1", "mc")
add("two vertices swapped", swap_points, 1, "P", "mc")
add("vertex moved, old checksum of the mesh", lambda f: f.points[0].__setitem__(0, f.points[0][0] + 1e-12), 2, "another mesh")
add("one facet flipped", lambda f: f.facets[3].reverse(), 1, "closed", "mc")
add("all facets flipped", lambda f: [t.reverse() for t in f.facets], 1, "P2, facet 0", "mc")
add("facet removed", lambda f: f.facets.pop(), 1, "closed", "mc")
add("mesh twice", double_mesh, 1, "count 2", "mc")
add("mesh twice, without P4", double_mesh_without_p4, 1, "count 2", "mc")
add("vertex number too large", lambda f: f.facets[0].__setitem__(0, len(f.points)), 2, "out of range", "mc")

# the boxes
add("direction negated", box("g", lambda w: w.__setitem__(slice(6, 9), ["%.17g" % -float(x) for x in w[6:9]])), 1, "P3, box")
add("direction zero", box("g", lambda w: w.__setitem__(slice(6, 9), ["0", "0", "0"])), 1, "P3, box")
add("direction not a number", box("g", set_word(7, "nan")), 2, "finite")
add("direction infinite", box("g", set_word(7, "inf")), 2, "finite")
add("cover box excluded", box("g", lambda w: w.__delitem__(slice(5, 9)) or w.append("x")), 1, "P3, box")
add("cover box undecided", box("g", lambda w: w.__delitem__(slice(5, 9)) or w.append("u")), 1, "P3, box")
add("cover box without a claim", box("g", lambda w: w.__delitem__(slice(5, 9)) or w.append("o")), 1, "P3, box")
add("box deeper", box("g", set_word(1, lambda x: x + 1)), 1, "partition")
add("box with a wrong place", box("x", lambda w: w.__setitem__(2, str(1 << int(w[1])))), 2, "out of range")
add("box removed", lambda f: f.remove_boxes([f.box_on_mesh()]), 1, "P3")
add("boxes of a leaf removed", lambda f: (lambda leaf: f.remove_boxes(
    [i for i in f.boxes() if int(f.certificate[i].split()[0]) == leaf]))(used_leaf(f)), 1, "P3")


def none_excluded(f):
    for i in f.boxes():
        if f.certificate[i].endswith(" x"):
            f.certificate[i] = f.certificate[i][:-1] + "o"


def repeat_box(f):
    line = f.first_box("x")
    f.certificate.insert(line, f.certificate[line])
    f.certificate[f.section(f.certificate, "boxes")[0]] = "boxes %d" % (len(f.boxes()) + 1)


add("no box excluded", none_excluded, 1, "P3, box")
add("box twice", repeat_box, 1, "partition")
add("another number of covers", certificate_line("covers", 0, set_word(1, lambda n: n + 1)), 1, "P4")
add("seed that is no vertex", lambda f: certificate_line("seeds", 1, set_word(1, str(len(f.points))))(f), 2, "out of range")
add("no seed", lambda f: certificate_line("seeds", 0, set_word(1, "0"))(f), 2, "seed")


def negate_every(step):
    def change(f):
        lines = [i for i in f.boxes() if f.certificate[i].split()[5] == "g"][::step]
        f.words(f.certificate, lines[len(lines) // 2], lambda w: w.__setitem__(slice(6, 9), ["%.17g" % -float(x) for x in w[6:9]]))
    return change


def tangential(words):
    """Replaces a direction by an orthogonal one."""
    d = [float(x) for x in words[6:9]]
    least = min(range(3), key=lambda a: abs(d[a]))
    other, third = (least + 1) % 3, (least + 2) % 3
    words[6 + least], words[6 + other], words[6 + third] = "0", "%.17g" % d[third], "%.17g" % -d[other]


for step in (1, 3, 5):
    add("another direction negated, %d" % step, negate_every(step), 1, "P3, box")
add("direction turned by a right angle", box("g", tangential), 1, "P3, box")
add("excluded box without a claim",
    lambda f: f.words(f.certificate, f.excluded_next_to_cover(), lambda w: w.__setitem__(5, "o")), 1, "for which there is no claim")


def leaf_at_end_of_path(f):
    """Returns the number of the leaf in which the first path leaves the cover."""
    return int(f.certificate[f.ends_of_cover()[1][1]].split()[0])


def has_no_facet_at_end_of_path(f):
    """Returns whether boxes of facets do not meet this leaf, so that P1 does not depend on it."""
    first = f.section(f.shell, "leaves")[0] + 1
    level, *place = (int(x) for x in f.shell[first + leaf_at_end_of_path(f)].split()[:4])
    words = f.shell[4].split()
    h = float(words[5]) / 2**level
    low = [float(words[2 + a]) + h * place[a] for a in range(3)]
    return not any(all(min(f.points[v][a] for v in t) <= low[a] + h and max(f.points[v][a] for v in t) >= low[a] for a in range(3))
                   for t in f.facets)


def no_cover(f):
    for i in f.boxes():
        if f.kind(i) in "gba":
            f.certificate[i] = " ".join(f.certificate[i].split()[:5] + ["o"])
    f.certificate[f.section(f.certificate, "covers")[0]] = "covers 0"


add("leaf of the cover removed, and its boxes", lambda f: remove_leaf(f, f.section(f.shell, "leaves")[0] + 1 + leaf_at_end_of_path(f)), 1,
    "where the leaves end", "sc", has_no_facet_at_end_of_path)
add("no cover", no_cover, 1, "the seed is not in a cover box")
add("all boxes of the cover excluded", lambda f: [f.certificate.__setitem__(i, " ".join(f.certificate[i].split()[:5] + ["x"]))
                                                  for i in f.boxes() if f.kind(i) in "gba"], 1, "P3, box")


def critical_box(change):
    """Changes the first box whose critical points are beyond a threshold."""
    return lambda f: f.words(f.certificate, next(i for i in f.boxes() if f.kind(i) in "ba"), change)


def has_critical_box(f):
    return any(f.kind(i) in "ba" for i in f.boxes())


def add_critical(name, change, *rest):
    any_test(*rest, "c", has_critical_box)(named(name, critical_box(change)))


def with_center(kind):
    return box("g", lambda w: w.__setitem__(slice(5, 9), [kind, "0.5", "0.5", "0.5"]))


def move_center(words):
    """Moves the center away from the middle of the box, so that the slope towards it is too large for a proof."""
    offset = [0.5 - float(x) for x in words[6:9]]
    size = max(abs(x) for x in offset)
    if size < 1e-3:
        offset, size = [1, 1, 1], 1
    words[6:9] = ["%.17g" % (float(c) + 30 * x / size) for c, x in zip(words[6:9], offset)]


add_critical("center moved", move_center, 1, "no critical point in the shell on the box")
add_critical("center not a number", set_word(6, "nan"), 2, "finite")
add_critical("critical points on the other side", lambda w: w.__setitem__(5, "ab"[w[5] == "a"]), 1, "no critical point in the shell on the box")
add_critical("critical points in a box that rises", lambda w: w.__setitem__(slice(5, 9), ["g", "1", "1", "1"]), 1, "increases along the direction")
add_critical("center left out", lambda w: w.__delitem__(slice(6, 9)), 2, "")
add("box on the mesh with a center below", with_center("b"), 1, "no critical point in the shell on the box")
add("box on the mesh with a center above", with_center("a"), 1, "no critical point in the shell on the box")


# the path
def end_in_the_middle(first):
    def change(words):
        for i in range(3):
            words[first + i] = "%.17g" % (0.5 * (float(words[2 + i]) + float(words[5 + i])))
    return change


def no_paths(f):
    line, count = f.section(f.certificate, "paths")
    f.certificate[line] = "paths 0"
    del f.certificate[line + 1:line + 1 + count]


add("path begins in the middle", certificate_line("paths", 1, end_in_the_middle(2)), 1, "P5, path 0")
add("path ends in the middle", certificate_line("paths", 1, end_in_the_middle(5)), 1, "P5, path 0")
add("path backwards", certificate_line("paths", 1, lambda w: w.__setitem__(slice(2, 8), w[5:8] + w[2:5])), 1, "P5, path 0")
add("path far away", certificate_line("paths", 1, set_word(2, lambda x: x + 1e6)), 1, "leaf")
add("path of another facet", lambda f: certificate_line(
    "paths", 1, lambda w: w.__setitem__(1, str((int(w[1]) + len(f.facets) // 2) % len(f.facets))))(f), 1, "P5, path 0")
add("path moved aside", certificate_line("paths", 1, lambda w: [set_word(a, lambda x: x + 0.37)(w) for a in (2, 5)]), 1, "",
    "c", lambda f: f.shell[1] == "unit 2")
add("path along the mesh", lambda f: certificate_line(
    "paths", 1, lambda w: w.__setitem__(slice(2, 8), ["%.17g" % x for v in f.facets[int(w[1])][:2] for x in f.points[v]]))(f), 1, "P5, path 0")
add("no path", no_paths, 1, "P5")


# several components
def several(name, change, code, sentence, update="c"):
    add(name, change, code, sentence, update, lambda f: f.components() > 1)


def swap_words(section, first, last):
    """Swaps words of the first two lines of a section."""
    def change(f):
        line = f.section(f.certificate, section)[0] + 1
        one, two = f.certificate[line].split(), f.certificate[line + 1].split()
        one[first:last], two[first:last] = two[first:last], one[first:last]
        f.certificate[line], f.certificate[line + 1] = " ".join(one), " ".join(two)
    return change


def without_component(removed):
    """Removes a component from the mesh, with its seed and its path in the certificate."""
    def change(f):
        component = f.component_of_vertices()
        kept = [v for v in range(len(f.points)) if component[v] != removed]
        number = {v: n for n, v in enumerate(kept)}
        facets = [n for n, t in enumerate(f.facets) if component[t[0]] != removed]
        facet_number = {old: new for new, old in enumerate(facets)}
        f.points = [f.points[v] for v in kept]
        f.facets = [[number[v] for v in f.facets[n]] for n in facets]
        for section, table in (("seeds", number), ("paths", facet_number)):
            line, count = f.section(f.certificate, section)
            rest = [l.split() for l in f.certificate[line + 1:line + 1 + count] if int(l.split()[0]) != removed]
            f.certificate[line:line + 1 + count] = ["%s %d" % (section, count - 1)] + [
                " ".join([str(n), str(table[int(w[1])])] + w[2:]) for n, w in enumerate(rest)]
    return change


def component_onto_another(f):
    """Moves the first component and its path to the second one, slightly scaled."""
    component = f.component_of_vertices()
    one, two = [[v for v in range(len(f.points)) if component[v] == c] for c in (0, 1)]
    center = [sum(f.points[v][a] for v in two) / len(two) for a in range(3)]
    to_two = dict(zip(one, two))
    for v in one:
        f.points[v] = [center[a] + 1.004 * (f.points[to_two[v]][a] - center[a]) for a in range(3)]
    f.facets = [[v for v in t] if component[t[0]] else None for t in f.facets]
    copies = iter([t for t in f.facets if t and component[t[0]] == 1])
    from_two = dict(zip(two, one))
    f.facets = [t or [from_two[v] for v in next(copies)] for t in f.facets]
    line = f.section(f.certificate, "paths")[0] + 1
    one, two = f.certificate[line].split(), f.certificate[line + 1].split()
    f.certificate[line] = " ".join(one[:2] + two[2:])


def turn_component(f):
    component = f.component_of_vertices()
    for t in f.facets:
        if component[t[0]] == 0:
            t.reverse()


def no_boxes_at_component(f):
    """Removes all boxes of the leaves with cover boxes at the last component."""
    component = f.component_of_vertices()
    at = f.boxes_at([p for p, c in zip(f.points, component) if c == f.components() - 1])
    leaves = {f.certificate[i].split()[0] for lines in at for i in lines}
    f.remove_boxes([i for i in f.boxes() if f.certificate[i].split()[0] in leaves])


several("seeds exchanged", swap_words("seeds", 1, 2), 2, "not a vertex of its component")
several("seeds in another order", swap_words("seeds", 0, 2), 2, "out of range")
several("two seeds of one component", lambda f: certificate_line(
    "seeds", 2, set_word(1, f.certificate[f.section(f.certificate, "seeds")[0] + 1].split()[1]))(f), 2, "not a vertex of its component")
several("facets of paths exchanged", swap_words("paths", 1, 2), 1, "another component")
several("path through the other component", swap_words("paths", 2, 8), 1, "does not cross its facet")
several("path through the other component, and its facet", swap_words("paths", 1, 8), 1, "another component")
several("one path missing", lambda f: (f.certificate.pop(), certificate_line("paths", 0, set_word(1, lambda n: n - 1))(f)), 1, "the number of paths")
several("one path twice", lambda f: certificate_line("paths", 2, set_word(0, "0"))(f), 2, "out of range")
several("a component of the cover too few", certificate_line("covers", 0, set_word(1, lambda n: n - 1)), 1, "P4")
for c in (0, 1, 2):
    several("component %d left out" % c, without_component(c), 1, "P4", "mc")
several("component where another one is", component_onto_another, 1, "P4", "mc")
several("component turned inside out", turn_component, 1, "P2", "mc")
several("no boxes at a component", no_boxes_at_component, 1, "P3")


# varying thresholds, with a bump at an end of the cover
def bump_at_end(word, height, end):
    """Moves a threshold away where a path enters or leaves the cover, so that boxes there are no longer excluded."""
    def change(f):
        f.words(f.shell, f.function_at(f.ends_of_cover()[end][0]), set_word(word, lambda x: x + height * float(f.shell[1].split()[1])))
    return change


thresholds("inner threshold with a bump at an end of the cover", bump_at_end(5, -1, 0), 1, "P", "sc")
thresholds("outer threshold with a bump at an end of the cover", bump_at_end(6, 1, 1), 1, "P", "sc")


# unproved claims, raised
def not_all(name, change, *rest):
    any_test(*rest)(named(name, change))


def raise_verdicts(f):
    f.certificate[3] = "verdicts proved proved proved proved proved"


def raise_verdict(n):
    def change(f):
        f.words(f.certificate, 3, set_word(n, "proved"))
    return change


def is_unproved(n):
    return lambda f: f.certificate[3].split()[n] != "proved"


def give_directions(f):
    """Gives undecided boxes the direction from the origin, along which the field increases."""
    for i, (low, h) in f.cubes().items():
        words = f.certificate[i].split()
        if words[5] == "u":
            f.certificate[i] = " ".join(words[:5] + ["g"] + ["%.17g" % (x + h / 2) for x in low])


def directions_and_verdicts(f):
    give_directions(f)
    raise_verdicts(f)


def exclude_undecided(f):
    for i in f.boxes():
        words = f.certificate[i].split()
        if words[5] == "u":
            f.certificate[i] = " ".join(words[:5] + ["x"])
    raise_verdicts(f)


def is_gradient_undecided(f):
    return is_unproved(3)(f) and any(f.kind(i) == "u" for i in f.boxes())


not_all("all verdicts raised", raise_verdicts, 1, "P", "c", lambda f: not f.are_all_proved())
for n in range(1, 6):
    not_all("verdict %d raised" % n, raise_verdict(n), 1, "P", "c", is_unproved(n))
not_all("undecided boxes with directions, and verdicts raised", directions_and_verdicts, 1, "faster than a threshold", "c", is_gradient_undecided)
not_all("undecided boxes excluded, and verdicts raised", exclude_undecided, 1, "P3, box", "c", is_gradient_undecided)

# the truncation, and the user's mesh
NO_POINT = 4294967295
T_AND_A, T_ONLY = "certified: P1 P2 P3 P4 P5 T A\n", "certified: P1 P2 P3 P4 P5 T\n"


def no_claims(f):
    """Removes all claims, so that only the truncation and the user's mesh can be wrong."""
    f.certificate[3] = "verdicts undecided undecided undecided undecided undecided"


def truncation(name, change, code, sentence, update="sc"):
    """Registers a change of the files and the truncation.

    If the change is expected to be refused for another reason, there is no comparison with the user's mesh.
    """
    def change_files(f):
        t = Truncation(f.shell)
        if code == 1:
            no_claims(f)
            f.user = f.user if sentence.startswith("A: ") else None
        change(f, t)
        f.shell[f.shell.index("truncation"):] = t.lines()
    add(name, change_files, code, sentence, update, Files.is_truncated)


def of_truncation(change):
    return lambda f, t: change(t)


def scaled(t, p, factor):
    """Scales the position of a point in the plane."""
    planar = t.planar[p - t.corners()]
    planar[:] = [factor * x for x in planar]


def set_cut(n, **numbers):
    names = ("center", "first", "second", "s", "t")
    return of_truncation(lambda t: [t.cuts[n].__setitem__(names.index(name), x) for name, x in numbers.items()])


def turn_rim_twice(t):
    """Turns a regular polygon into a star."""
    n = len(t.discs[0].rim)
    for i, (p, _) in enumerate(t.discs[0].rim):
        t.planar[p - t.corners()] = [math.cos(4 * math.pi * i / n), math.sin(4 * math.pi * i / n)]


def cuts_on_common_edge(t):
    """Returns two cuts on one edge, around different vertices."""
    return next((a, b) for a in t.cuts for b in t.cuts if a[:2] == b[1::-1] and a[2] == b[2] == NO_POINT)


def pass_each_other(t):
    for c in cuts_on_common_edge(t):
        c[3] = 0.9


def meet_each_other(t):
    for c in cuts_on_common_edge(t):
        c[3] = 0.5


def flip_edge(f, t):
    """Flips an edge of the mesh within the first disc."""
    points = [tuple(t.points[r[0]]) for r in t.discs[0].rim]
    inside = [g for g in f.facets if all(tuple(f.points[v]) in points for v in g)]
    for g in inside:
        for h in inside:
            for i in range(3):
                a, b, c = g[i], g[(i + 1) % 3], g[(i + 2) % 3]
                if (b in h) and (a in h) and g is not h:
                    d = next(v for v in h if v not in (a, b))
                    g[:], h[:] = [a, d, c], [d, b, c]
                    return


def vertex_at(f, p):
    return f.points.index(p)


def move_in_mesh(f, t):
    f.points[vertex_at(f, t.points[t.discs[0].rim[0][0]])][0] += 1e-9


def add_component(at):
    """Adds a tetrahedron that is far away, except for one of its corners."""
    def change(f, t):
        n = len(f.points)
        f.points += [list(at(t)), [9., 9., 9.], [9., 10., 9.], [9., 9., 10.]]
        f.facets += [[n, n + 1, n + 2], [n, n + 2, n + 3], [n, n + 3, n + 1], [n + 1, n + 3, n + 2]]
        line, count = f.section(f.certificate, "seeds")
        f.certificate[line] = "seeds %d" % (count + 1)
        f.certificate.insert(line + 1 + count, "%d %d" % (count, n))
    return change


def not_in_rim(t):
    """Returns a vertex that is not cut off."""
    return next(p for p in range(t.corners()) if all(p != d.center for d in t.discs))


def exchange_in_rim(word):
    def change(f, t):
        a, b = t.discs[0].rim[:2]
        a[word], b[word] = b[word], a[word]
    return change


truncation("without the user's mesh", lambda f, t: setattr(f, "user", None), 0, T_ONLY, "")
truncation("truncation as read", lambda f, t: None, 0, T_AND_A)

# the numbers of cuts
truncation("cut beyond its edge", set_cut(0, s=1.), 1, "T, cut 0: the cut is not between")
truncation("cut before its edge", set_cut(0, s=-0.1), 1, "T, cut 0: the cut is not between")
truncation("cut at its vertex", set_cut(0, s=0.), 1, "T, cut 0: the cut is not between")
truncation("cut on an edge and off it", set_cut(0, t=1e-9), 1, "T, cut 0: T is zero although")
truncation("cut before its edge, sideways", set_cut(0, t=-1e-9), 1, "T, cut 0: the cut is not between")
truncation("cut within a facet, but on its edge", set_cut(0, second=3), 1, "T, cut 0: T is zero although")
truncation("cut on an edge, but within one of its facets", set_cut(0, second=0, t=1e-9), 1, "T, facet 0: the parts do not end at the sides")
truncation("cut within a facet, of another one", set_cut(0, second=12, t=0.01), 1, "is not in the facet")
truncation("cut on another edge", set_cut(0, first=11), 1, "is not in the facet")
truncation("cut between equal vertices", set_cut(0, first=1), 1, "are in the wrong order")
truncation("cut around another vertex", set_cut(0, center=6), 1, "is not a cut around the center")
truncation("cuts on an edge pass each other", of_truncation(pass_each_other), 1, "T, facet")
truncation("cuts on an edge meet", of_truncation(meet_each_other), 1, "T, facet")
truncation("cut moved along its edge", set_cut(0, s=0.04), 0, T_AND_A)

# in the plane
truncation("point of a rim across the center", of_truncation(lambda t: scaled(t, t.discs[0].rim[0][0], -1)), 1, "does not turn around")
truncation("point of a rim at the center", of_truncation(lambda t: scaled(t, t.discs[0].rim[0][0], 0)), 1, "does not turn around")
truncation("point of a rim across an edge of the disc", of_truncation(lambda t: scaled(t, t.ear()[1][1], 0.5)), 1, "in the plane, a triangle is reversed")
truncation("rim leads around twice", of_truncation(turn_rim_twice), 1, "2 times")
truncation("two points of a rim exchanged in the plane", of_truncation(lambda t: t.planar.__setitem__(slice(0, 2), t.planar[1::-1])), 1, "in the plane")
truncation("point of a rim moved a little", of_truncation(lambda t: scaled(t, t.discs[0].rim[0][0], 1.01)), 0, T_AND_A)
truncation("disc enlarged in the plane", of_truncation(lambda t: [scaled(t, r[0], 3.) for r in t.discs[0].rim]), 0, T_AND_A)

# the parts of facets
truncation("core removed", of_truncation(lambda t: t.cores.pop(0)), 1, "T, facet 0: the parts")
truncation("all cores of a facet removed", of_truncation(lambda t: t.cores.__setitem__(slice(0, 2), [])), 1, "T, facet 0: the parts")
truncation("core turned", of_truncation(lambda t: t.cores[0].__setitem__(slice(0, 2), t.cores[0][1::-1])), 1, "T, facet 0: a part is reversed")
truncation("core twice", of_truncation(lambda t: t.cores.append(list(t.cores[0]))), 1, "T, facet 0: two triangles")
truncation("core of another facet", of_truncation(lambda t: t.cores[-1].__setitem__(3, 5)), 1, "is not in the facet")
truncation("core of a neighboring facet", of_truncation(lambda t: t.cores[1].__setitem__(3, 9)), 1, "T, facet 0: the parts")
truncation("core with a center", of_truncation(lambda t: t.cores[0].__setitem__(0, t.discs[0].center)), 1, "T, core 0: a corner is cut off")
truncation("core without area", of_truncation(lambda t: t.cores[0].__setitem__(0, t.cores[0][1])), 1, "T, facet 0: a part is reversed")
truncation("edge of the rim in another facet", of_truncation(lambda t: t.discs[0].rim[1].__setitem__(1, 0)), 1, "is not in the facet")
truncation("edges of the rim in each other's facets", exchange_in_rim(1), 1, "is not in the facet")
truncation("facet turned", of_truncation(lambda t: t.facets[0].reverse()), 1, "another facet is on the same side")
truncation("facet with another corner", of_truncation(lambda t: t.facets[0].__setitem__(0, 16)), 1, "T, facet 0: ")
truncation("facet without area", of_truncation(lambda t: t.facets[0].__setitem__(0, t.facets[0][1])), 1, "T, facet 0: the facet is degenerate")
truncation("facet twice", of_truncation(lambda t: t.facets.append(list(t.facets[0]))), 1, "another facet is on the same side")
truncation("cores in another order", of_truncation(lambda t: t.cores.reverse()), 0, T_AND_A)
truncation("corners of a core in another order", of_truncation(
    lambda t: t.cores[0].__setitem__(slice(0, 3), t.cores[0][1:3] + t.cores[0][:1])), 0, T_AND_A)

# discs
truncation("points of a rim exchanged", exchange_in_rim(0), 1, "T, facet")
truncation("point of a rim removed", of_truncation(lambda t: t.discs[0].rim.pop()), 1, "T, disc 0: ")
truncation("point of a rim twice", of_truncation(lambda t: t.discs[0].rim.append(list(t.discs[0].rim[0]))), 1, "is in an earlier rim")
truncation("point of a rim that is a vertex", of_truncation(lambda t: t.discs[0].rim[0].__setitem__(0, t.cuts[0][1])), 1, "is not a cut around the center")
truncation("point of a rim of another disc", of_truncation(
    lambda t: t.discs[0].rim[0].__setitem__(0, t.discs[1].rim[0][0])), 1, "is not a cut around the center")
truncation("rim backwards", of_truncation(lambda t: t.discs[0].rim.reverse()), 1, "T, facet")
truncation("rim of two points", of_truncation(lambda t: t.discs[0].rim.__setitem__(slice(2, None), [])), 1, "fewer than three points")
truncation("triangle of a disc turned", of_truncation(lambda t: t.discs[0].triangles[0].reverse()), 1, "in the plane, a triangle is reversed")
truncation("triangle of a disc removed", of_truncation(lambda t: t.discs[0].triangles.pop()), 1, "do not end at the rim")
truncation("no triangles of a disc", of_truncation(lambda t: t.discs[0].triangles.clear()), 1, "do not end at the rim")
truncation("triangle of a disc twice", of_truncation(lambda t: t.discs[0].triangles.append(list(t.discs[0].triangles[0]))), 1,
           "T, disc 0: two triangles")
truncation("triangle of a disc without area", of_truncation(lambda t: t.discs[0].triangles[0].__setitem__(0, t.discs[0].triangles[0][1])), 1,
           "T, disc 0: in the plane")
truncation("triangle with a point of another disc", of_truncation(
    lambda t: t.discs[0].triangles[0].__setitem__(0, t.discs[1].rim[0][0])), 1, "is not a point of the disc")
truncation("triangle of a disc with a vertex", of_truncation(
    lambda t: t.discs[0].triangles[0].__setitem__(0, not_in_rim(t))), 1, "is not a point of the disc")
truncation("triangle of one disc in another one", of_truncation(
    lambda t: t.discs[1].triangles.append(t.discs[0].triangles.pop())), 1, "is not a point of the disc")
truncation("two discs of one vertex", of_truncation(lambda t: setattr(t.discs[1], "center", t.discs[0].center)), 1, "another disc has the same center")
truncation("disc of another vertex", of_truncation(lambda t: setattr(t.discs[0], "center", not_in_rim(t))), 1, "is not a cut around the center")
truncation("disc removed", of_truncation(lambda t: t.discs.pop()), 1, "is not in a disc")
truncation("discs in another order", of_truncation(lambda t: t.discs.reverse()), 0, T_AND_A)
truncation("rim begun elsewhere", of_truncation(lambda t: t.discs[0].rim.append(t.discs[0].rim.pop(0))), 0, T_AND_A)

# points
truncation("two vertices in one place", of_truncation(lambda t: t.points.__setitem__(0, list(t.points[1]))), 1, "T: point 1 has the coordinates of another point")
truncation("cut where a vertex is", of_truncation(lambda t: t.points.__setitem__(t.corners(), list(t.points[0]))), 1, "has the coordinates of another point")
truncation("cut moved, but not in the mesh", of_truncation(lambda t: t.points[t.corners()].__setitem__(0, 1 + 1e-9)), 1, "A: the mesh is not the user's mesh after")
truncation("vertex moved, but not in the mesh", of_truncation(lambda t: t.points[0].__setitem__(0, 1e-9)), 1, "A: the mesh is not the user's mesh after")
truncation("center moved, but not in the user's mesh", of_truncation(
    lambda t: t.points[t.discs[0].center].__setitem__(0, 1e-9)), 1, "A: the user's mesh")
truncation("point that does not exist", of_truncation(lambda t: t.cores[0].__setitem__(0, len(t.points))), 2, "out of range")
truncation("facet that does not exist", of_truncation(lambda t: t.cores[0].__setitem__(3, len(t.facets))), 2, "out of range")
truncation("rim with a point that does not exist", of_truncation(lambda t: t.discs[0].rim[0].__setitem__(0, -1)), 2, "out of range")
truncation("coordinate that is no number", of_truncation(lambda t: t.points[0].__setitem__(0, math.nan)), 2, "finite")
truncation("number of a cut that is none", set_cut(0, s=math.nan), 2, "finite")
for n, what in enumerate(("vertices", "cuts", "points within discs", "facets", "cores", "discs")):
    for more in (-1, 1):
        add("%s: %+d" % (what, more), (lambda n, more: lambda f: f.words(f.shell, f.shell.index("truncation") + 1, set_word(
            n, lambda x: max(0, x + more) + (n == 2))))(n, more), 2, "line ", "sc", Files.is_truncated)

# the mesh
truncation("triangle of a disc turned in the mesh", lambda f, t: next(
    g for g in f.facets if all(f.points[v] in [t.points[p] for p, _ in t.discs[0].rim] for v in g)).reverse(), 1, "closed", "mc")
truncation("edge of a disc flipped in the mesh", flip_edge, 1, "A: the mesh is not the user's mesh after", "mc")
truncation("edge of a disc flipped in a mesh that is the user's", lambda f, t: (flip_edge(f, t), setattr(f, "user", (f.points, f.facets)), no_claims(f)), 0, "certified: T(0/1) A\n", "mc")
truncation("all facets of the mesh turned", lambda f, t: [g.reverse() for g in f.facets], 1, "A: the mesh is not the user's mesh after", "mc")
truncation("point of a rim moved in the mesh", move_in_mesh, 1, "A: the mesh is not the user's mesh after", "mc")
truncation("tip beside its disc", add_component(lambda t: t.points[t.discs[0].center]), 1, "T: a facet outside the truncation", "mc")
truncation("component at a point of a rim", add_component(lambda t: t.points[t.discs[0].rim[0][0]]), 1, "T: two vertices of the mesh", "mc")
truncation("component at a vertex", add_component(lambda t: t.points[not_in_rim(t)]), 1, "T: two vertices of the mesh", "mc")
truncation("component elsewhere", add_component(lambda t: [10., 10., 10.]), 1, "A: the mesh is not the user's mesh after", "mc")
truncation("vertices of the mesh that no facet has", lambda f, t: f.points.append(list(f.some_vertex())), 0, T_AND_A, "mc")


# A second patch at another place. Vertices of both patches come first, then cuts of both.
def renumbered(t, point, facet):
    return ([[point(p) for p in c[:3]] + c[3:] for c in t.cuts], [[point(p) for p in f] for f in t.facets],
            [[point(p) for p in c[:3]] + [facet(c[3])] for c in t.cores],
            [Disc(point(d.center), [[point(p), facet(f)] for p, f in d.rim], [[point(p) for p in c] for c in d.triangles]) for d in t.discs])


def double(t):
    assert len(t.planar) == len(t.cuts)
    corners, facets, elsewhere = t.corners(), len(t.facets), [[x + 20 for x in p] for p in t.points]
    first = renumbered(t, lambda p: p if p < corners or p == NO_POINT else p + corners, lambda f: f)
    second = renumbered(t, lambda p: p if p == NO_POINT else p + (corners if p < corners else len(t.points)), lambda f: f + facets)
    t.points = t.points[:corners] + elsewhere[:corners] + t.points[corners:] + elsewhere[corners:]
    t.planar = t.planar + [list(p) for p in t.planar]
    t.cuts, t.facets, t.cores, t.discs = (a + b for a, b in zip(first, second))


truncation("patch that the mesh does not have", lambda f, t: double(t), 0, "certified: P1 P2 P3 P4 P5 T(1/2) A\n")
truncation("core missing in a patch that the mesh does not have", lambda f, t: (double(t), t.cores.pop()), 1, "the parts")
truncation("patch that the mesh does not have, next to one of its points", lambda f, t: (
    double(t), t.points.__setitem__(t.corners() - 1, list(t.points[t.corners() // 2 - 1]))), 1, "has the coordinates of another point")


# Adds a point within the first disc, and a cut within the first facet, to a truncation without such points. The mesh is
# changed accordingly.
def enriched(name, change, code, sentence):
    def change_all(f, t):
        before = t.cores + [c for d in t.discs for c in d.triangles]
        before = [[t.points[p] for p in c[:3]] for c in before]
        cut, inner = enrich(t)
        after = [[t.points[p] for p in c[:3]] for c in t.cores + [c for d in t.discs for c in d.triangles]]
        replace_facets(f, [c for c in before if c not in after], [c for c in after if c not in before])
        no_claims(f)
        change(t, cut, inner)
    truncation(name, change_all, code, sentence, "smc")


def enrich(t):
    """Adds the points, and returns their numbers."""
    assert len(t.planar) == len(t.cuts)
    d, corners, cut = t.discs[0], t.corners(), len(t.points)
    inner = cut + 1
    p, f = d.rim[0]
    q = d.rim[1][0]
    core = next(c for c in t.cores if c[3] == f and p in c[:3] and q in c[:3])
    y = next(v for v in core[:3] if v not in (p, q))
    facet = t.facets[f]
    i = facet.index(d.center)
    along = {t.cuts[v - corners][1]: t.cuts[v - corners][3] for v in (p, q)}
    first, second = facet[(i + 1) % 3], facet[(i + 2) % 3]
    t.cuts.append([d.center, first, second, 0.51 * along[first], 0.51 * along[second]])
    t.points += [[sum(t.points[v][a] for v in (p, q, y)) / 3 for a in range(3)], [x + 1e-3 for x in t.points[d.center]]]
    t.planar += [[0.51 * (t.planar[p - corners][a] + t.planar[q - corners][a]) for a in range(2)], [0.01, 0.02]]
    t.cores.remove(core)
    t.cores += [[q, cut, y, f], [cut, p, y, f]]
    d.rim.insert(1, [cut, f])
    rim = [r[0] for r in d.rim]
    d.triangles = [[a, b, inner] for a, b in zip(rim, rim[1:] + rim[:1])]
    return cut, inner


def replace_facets(f, removed, added):
    """Replaces facets of the mesh, given by coordinates."""
    removed = [sorted(c) for c in removed]
    f.facets = [g for g in f.facets if sorted(f.points[v] for v in g) not in removed]
    for c in added:
        for p in c:
            if p not in f.points:
                f.points.append(list(p))
        f.facets.append([vertex_at(f, p) for p in c])


def set_planar(p, place):
    return lambda t, cut, inner: t.planar.__setitem__((cut, inner)[p] - t.corners(), place)


def set_last_cut(n, x):
    return lambda t, cut, inner: t.cuts[-1].__setitem__(n, x)


enriched("more points", lambda t, cut, inner: None, 0, "certified: T A\n")
enriched("point within a disc moved", set_planar(1, [-0.1, 0.3]), 0, "certified: T A\n")
enriched("point within a disc across the rim", set_planar(1, [2., 0.3]), 1, "in the plane, a triangle is reversed")
enriched("point within a disc on an edge", set_planar(1, [1., 0.]), 1, "in the plane, a triangle is reversed")
enriched("point within a disc in another one, too", lambda t, cut, inner: t.discs[1].triangles[0].__setitem__(0, inner), 1, "is not a point of the disc")
enriched("point within a disc in a core", lambda t, cut, inner: t.cores[0].__setitem__(0, inner), 1, "T, core 0: a corner is in the interior of a disc")
enriched("point within a disc in no triangle", lambda t, cut, inner: setattr(
    t.discs[0], "triangles", [[t.discs[0].rim[0][0] if p == inner else p for p in c] for c in t.discs[0].triangles[1:-1]]), 1, "is not in a disc")
enriched("cut within a facet moved", set_last_cut(3, 0.02), 0, "certified: T A\n")
enriched("cut within a facet across an edge", set_last_cut(3, 0.99), 1, "the cut is not between")
enriched("cut within a facet on a core's edge", set_last_cut(3, 0.7), 1, "T, facet 0: a part is reversed")
enriched("cut within a facet that is on an edge", lambda t, cut, inner: t.cuts[-1].__setitem__(slice(2, 5), [NO_POINT, 0.02, 0]), 1, "T, facet 0: ")
enriched("cut within a facet whose corners are exchanged", lambda t, cut, inner: t.cuts[-1].__setitem__(slice(1, 3), t.cuts[-1][2:0:-1]), 1,
         "are in the wrong order")
enriched("cut within a facet moved out of its angle, in the plane", set_planar(0, [0.1, -0.4]), 1, "does not turn around")


# the user's mesh
def user(name, change, code, sentence, update=""):
    """Registers a change of the user's mesh. If the files have none, it is a copy of the certificate's mesh."""
    def change_files(f):
        f.user = f.user or ([list(p) for p in f.points], [list(t) for t in f.facets])
        change(f)
    any_test(code, sentence, update, lambda f: not f.excision)(named(name, change_files))


def reorder_user(f):
    points, facets = f.user
    n = len(points)
    f.user = [[9., 9., 9.]] + points[::-1], [[n - v for v in t[1:] + t[:1]] for t in facets[::-1]]


def restore_tips(f, t):
    """Turns the certificate's mesh into the mesh before the truncation."""
    new = t.cores + [c for d in t.discs for c in d.triangles]
    replace_facets(f, [[t.points[p] for p in c[:3]] for c in new], [[t.points[p] for p in c] for c in t.facets])


def accepted(f):
    return f.claims() if f.user else f.claims().replace("\n", " A\n")


user("the user's mesh", lambda f: None, 0, accepted)
user("the user's mesh in another order", reorder_user, 0, accepted)
user("the user's mesh with a vertex moved", lambda f: f.user[0][0].__setitem__(0, f.user[0][0][0] + 1e-9), 1, "A: ")
user("the user's mesh with a facet turned", lambda f: f.user[1][0].reverse(), 1, "A: ")
user("the user's mesh turned", lambda f: [t.reverse() for t in f.user[1]], 1, "A: ")
user("the user's mesh without a facet", lambda f: f.user[1].pop(), 1, "A: ")
user("the user's mesh with a facet twice", lambda f: f.user[1].append(list(f.user[1][0])), 1, "A: ")
user("the user's mesh with another component", lambda f: f.user[1].extend([[0, 1, 2], [0, 2, 1]]), 1, "A: ")
truncation("the mesh as the user's", lambda f, t: setattr(f, "user", (f.points, f.facets)), 1,
           "A: the user's mesh lacks facets that the truncation cuts")
truncation("the user's mesh as the certificate's", lambda f, t: (restore_tips(f, t), no_claims(f)), 0, "certified: T(0/1) A\n", "mc")


# An open mesh: the last facet of the user's mesh is removed, and becomes the closing.
def opened(name, change, code, sentence, facet=-1):
    def change_files(f):
        f.user = f.user or ([list(p) for p in f.points], [list(t) for t in f.facets])
        corners = [f.user[0][v] for v in f.user[1].pop(facet(f) if callable(facet) else facet)]
        closing = ["closing 3 3 1"] + ["%.17g %.17g %.17g" % tuple(p) for p in corners] + ["0 1 2 0"]
        change(f, closing)
        line = f.section(f.shell, "closing")[0]
        f.shell[line:line + 1] = closing
    any_test(code, sentence, "sc", lambda f: (f.is_truncated() or not callable(facet)) and not f.excision)(named(name, change_files))


def first_cut(f):
    """Returns the number of a cut facet in the user's mesh."""
    t = Truncation(f.shell)
    return next(n for n, g in enumerate(f.user[1]) if sorted(f.user[0][v] for v in g) == sorted(t.points[p] for p in t.facets[0]))


opened("open mesh whose closing is cut", lambda f, closing: None, 1, "A: the user's mesh lacks facets that the truncation cuts", first_cut)
opened("open mesh", lambda f, closing: None, 0, accepted)
opened("open mesh, without the user's", lambda f, closing: setattr(f, "user", None), 0, lambda f: f.claims().replace(" A\n", "\n"))
opened("open mesh, closed the wrong way round", lambda f, closing: closing.__setitem__(-1, "1 0 2 0"), 1, "A: ")
opened("open mesh, closed elsewhere", lambda f, closing: closing.__setitem__(1, "9 9 9"), 1, "A: ")
opened("open mesh, not closed", lambda f, closing: closing.__setitem__(slice(0, None), ["closing 0 0 0"]), 1, "A: ")
opened("open mesh, another facet missing", lambda f, closing: f.user[1].pop(0), 1, "A: ")
opened("open mesh, closed by a point that does not exist", lambda f, closing: closing.__setitem__(-1, "0 1 3 0"), 2, "out of range")

# excised triangles
FAR = (7., 8., 9.)


def excision(name, change, code, sentence, update=""):
    """Registers a change of the soups; `sentence` is without "E, ". Claims are only made if it is to be accepted."""
    def change_files(f):
        if code == 1:
            no_claims(f)
        change(f)
    any_test(code, sentence, update or "c", lambda f: bool(f.excision))(named(name, change_files))


def same(t):
    return tuple(sorted(t))


def is_in(triangle, triangles):
    return any(same(triangle) == same(t) for t in triangles)


def excised(f):
    kept = set(same(t) for t in f.excision["kept"])
    return [t for t in f.excision["soup"] if same(t) not in kept]


def user_triangles(f):
    return triangles_of(*f.user)


def corners_of(triangles):
    return set(p for t in triangles for p in t)


def edges_of(triangles):
    return set((t[i], t[(i + 1) % 3]) for t in triangles for i in range(3))


def border_of(triangles):
    edges = edges_of(triangles)
    return set(e for e in edges if e[::-1] not in edges)


def excise(f, triangle):
    """Adds an excised triangle."""
    f.excision["soup"].append(list(triangle))
    f.excision["joined"].append(list(triangle))


def remove(triangle, triangles):
    triangles[:] = [t for t in triangles if same(t) != same(triangle)]


def in_edit(f, removed, added):
    """Replaces facets of the simplified mesh, everywhere. The triangles that close it remain."""
    removed, added = [[list(p) for p in t] for t in removed], [[list(p) for p in t] for t in added]
    replace_facets(f, removed, added)
    user = f.copy()
    user.points, user.facets = f.user
    replace_facets(user, removed, added)
    f.user = user.points, user.facets
    for t in removed:
        remove([tuple(p) for p in t], f.excision["joined"])
    f.excision["joined"] += [[tuple(p) for p in t] for t in added]


def flip_user_edge(f, edge):
    """Flips an edge of the simplified mesh, and returns the new edge."""
    a, b = edge
    c, d = (next(p for p in t if p not in edge) for e in (edge, edge[::-1]) for t in user_triangles(f) if e in edges_of([t]))
    in_edit(f, [[a, b, c], [b, a, d]], [[c, a, d], [d, b, c]])
    return c, d


def fin_edge(f):
    """Returns the edge of an excised triangle that is within the mesh."""
    edges = edges_of(excised(f))
    border = border_of(f.excision["kept"])
    return next(e for e in sorted(edges_of(f.excision["kept"])) if (e in edges or e[::-1] in edges) and e not in border)


def flip_to_chord(f):
    """Flips an edge of the simplified mesh so that the mesh before has the new edge's ends, but not the edge."""
    kept, edges = corners_of(f.excision["kept"]), edges_of(excised(f))
    for a, b in sorted(edges_of(user_triangles(f))):
        apexes = [next(p for p in t if p not in (a, b)) for e in ((a, b), (b, a)) for t in user_triangles(f) if e in edges_of([t])]
        if len(apexes) == 2 and all(p in kept for p in apexes) and not any(
                tuple(apexes[::k]) in edges_of(f.excision["kept"] + user_triangles(f)) or (a, b)[::k] in edges for k in (1, -1)):
            return flip_user_edge(f, (a, b))
    raise AssertionError("no edge to flip")


def new_user_facet(f):
    return next(t for t in user_triangles(f) if not is_in(t, f.excision["kept"]))


def vertex_of_one(f, one, other):
    return sorted(corners_of(one) - corners_of(other))[0]


def removed_vertex(f):
    return vertex_of_one(f, f.excision["kept"], user_triangles(f))


def new_vertex(f):
    return vertex_of_one(f, user_triangles(f), f.excision["soup"])


def move_joined(name, triangle):
    """Moves the last corner of an excised triangle by one bit in the soup after the edit."""
    def change(f):
        t = next(t for t in f.excision["joined"] if same(t) == same(triangle(f)))
        p = next(p for p in t if p not in corners_of(user_triangles(f)))
        bits = struct.unpack("<q", struct.pack("<d", p[0]))[0] + 1
        t[t.index(p)] = (struct.unpack("<d", struct.pack("<q", bits))[0],) + p[1:]
    excision(name, change, 1, "the triangle is excised, but JOINED lacks it")


def with_corner(f, n):
    """Returns an excised triangle that has n vertices of the mesh that is kept."""
    return next(t for t in excised(f) if sum(p in corners_of(f.excision["kept"]) for p in t) == n)


def reorder_excision(f):
    for name in EXCISION:
        f.excision[name] = [t[1:] + t[:1] for t in f.excision[name][::-1]]
    for t in f.excision["soup"][::3]:
        if is_in(t, f.excision["kept"]):
            t.reverse()


def take_from_border(f):
    """Excises a facet at the border that was not there after the edit."""
    border = border_of(f.excision["kept"])
    facet = next(t for t in f.excision["kept"] if edges_of([t]) & border and not is_in(t, user_triangles(f)))
    remove(facet, f.excision["kept"])
    f.excision["joined"].append(next(list(t) for t in f.excision["soup"] if same(t) == same(facet)))


def fill_hole(f):
    """Keeps the excised triangle that fills the hole."""
    facet = with_corner(f, 3)
    remove(facet, f.excision["soup"])
    remove(facet, f.excision["joined"])
    border = border_of(f.excision["kept"])
    facet = facet if (facet[1], facet[0]) in border else facet[::-1]
    f.excision["kept"].append(facet)
    f.excision["soup"].append(facet)


def as_before(f):
    """Edits nothing: the mesh before the edit is the simplified one."""
    e = excised(f)
    f.excision = {"kept": user_triangles(f), "soup": user_triangles(f) + e, "joined": user_triangles(f) + e}


excision("excised triangles", lambda f: None, 0, Files.claims)
excision("excised triangles in another order", reorder_excision, 0, Files.claims)
excision("excised triangles of a mesh that was not edited", as_before, 0, Files.claims)
excision("excised triangles not at all", lambda f: (as_before(f), [f.excision.__setitem__(n, user_triangles(f)) for n in EXCISION]), 0, Files.claims)
excision("an excised triangle turned in both", lambda f: [with_corner(f, 2).reverse(), next(
    t for t in f.excision["joined"] if same(t) == same(with_corner(f, 2))).reverse()], 0, Files.claims)
excision("an excised triangle more", lambda f: excise(f, [FAR, removed_vertex(f)[::-1], (0., 0., 0.)]), 0, Files.claims)
excision("an excised triangle turned after the edit", lambda f: next(
    t for t in f.excision["joined"] if same(t) == same(with_corner(f, 2))).reverse(), 1, "the triangle is excised, but JOINED lacks it")
for n in (1, 2):
    move_joined("an excised triangle with %d common vertices moved by a bit" % n, lambda f, n=n: with_corner(f, n))
excision("an excised triangle missing", lambda f: remove(with_corner(f, 1), f.excision["joined"]), 1, "the triangle is excised, but JOINED lacks it")
excision("an excised triangle twice", lambda f: f.excision["joined"].append(with_corner(f, 1)), 1, "the triangle is neither a facet of USER_MESH nor excised, or JOINED has it twice")
excision("another triangle after the edit", lambda f: f.excision["joined"].append([FAR, (0., 0., 0.), (1., 0., 0.)]), 1, "the triangle is neither a facet of USER_MESH nor excised, or JOINED has it twice")
excision("a facet missing after the edit", lambda f: remove(user_triangles(f)[3], f.excision["joined"]), 1, "triangle 3 of USER_MESH: JOINED lacks this facet")
excision("a facet turned after the edit", lambda f: next(t for t in f.excision["joined"] if same(t) == same(user_triangles(f)[3])).reverse(), 1, "triangle 3 of USER_MESH: JOINED lacks this facet")
excision("a facet twice after the edit", lambda f: f.excision["joined"].append(user_triangles(f)[3]), 1, "or JOINED has it twice")
excision("a facet that is not in the soup", lambda f: remove(f.excision["kept"][5], f.excision["soup"]), 1, "triangle 5 of KEPT: SOUP has no triangle with these corners")
excision("a facet twice before the edit", lambda f: f.excision["kept"].append(f.excision["kept"][5][::-1]), 1, "of KEPT: triangle 5 has the same corners")
excision("a triangle twice in the soup", lambda f: f.excision["soup"].append(f.excision["soup"][5][::-1]), 1, "of SOUP: triangle 5 has the same corners")
excision("an excised triangle twice in both", lambda f: excise(f, with_corner(f, 1)), 1, "has the same corners")
excision("a triangle with a repeated corner", lambda f: excise(f, [FAR, FAR, (0., 0., 0.)]), 1, "of SOUP: two corners have the same coordinates")
excision("a triangle whose last corner is its first", lambda f: excise(f, [FAR, (0., 0., 0.), FAR]), 1, "of SOUP: two corners have the same coordinates")
excision("a facet of the border excised", take_from_border, 1, ": the edge is on the border of KEPT, but not of USER_MESH")
excision("a facet that fills the hole", fill_hole, 1, ": the edge is on the border of USER_MESH, but not of KEPT")
excision("an excised triangle at a vertex that the edit removed", lambda f: excise(f, [removed_vertex(f), FAR, (0., 0., 0.)]), 1, "E, vertex (")
excision("an excised triangle at a vertex that the edit removed, in words", lambda f: excise(f, [removed_vertex(f), FAR, (0., 0., 0.)]), 1,
         "): KEPT and an excised triangle have it in common, but USER_MESH lacks it")
excision("an excised triangle at a vertex that the edit made", lambda f: excise(f, [new_vertex(f), FAR, (0., 0., 0.)]), 1,
         "): USER_MESH and an excised triangle have it in common, but KEPT lacks it")
excision("the edge of a fin flipped", lambda f: flip_user_edge(f, fin_edge(f)), 1, "): KEPT and an excised triangle have it in common, but USER_MESH lacks it", "mc")
excision("the edge of a fin flipped, in words", lambda f: flip_user_edge(f, fin_edge(f)), 1, "E, edge from vertex (", "mc")
excision("an edge flipped elsewhere", lambda f: (flip_to_chord(f), no_claims(f)), 0, "certified: A E\n", "mc")
excision("a chord", lambda f: excise(f, flip_to_chord(f) + (FAR,)), 1, "): USER_MESH and an excised triangle have it in common, but KEPT lacks it", "mc")
excision("a pillow", lambda f: excise(f, new_user_facet(f)[::-1]), 1, "the triangle is excised, but a facet of USER_MESH has the same corners")
excision("a pillow between vertices that are kept", lambda f: pillow(f), 1, "the triangle is excised, but a facet of USER_MESH has the same corners", "mc")
excision("the soup after the edit as that before it", lambda f: f.excision.__setitem__("soup", f.excision["joined"]), 1, "SOUP has no triangle with these corners")
excision("the soup before the edit as that after it", lambda f: f.excision.__setitem__("joined", f.excision["soup"]), 1, "JOINED lacks this facet")
excision("a component that has each facet twice", lambda f: add_flat_component(f), 1, "of USER_MESH: triangle 199 has the same corners", "mc")


def add_flat_component(f):
    """Adds two facets with the same corners to the simplified mesh."""
    in_edit(f, [], [[FAR, (9., 9., 9.), (9., 8., 8.)], [(9., 9., 9.), FAR, (9., 8., 8.)]])
    line, count = f.section(f.certificate, "seeds")
    f.certificate[line] = "seeds %d" % (count + 1)
    f.certificate.insert(line + 1 + count, "%d %d" % (count, f.facets[-1][0]))


def pillow(f):
    """All three edges of the excised triangle are edges of the mesh before and after the edit."""
    c, d = flip_to_chord(f)
    facet = next(t for t in user_triangles(f) if c in t and d in t)
    fourth = next(p for p in facet if p not in (c, d))
    excise(f, [c, d, fourth])


def thorn(name, place, code, sentence):
    """Registers an excised triangle at a vertex of a mesh with truncated tips."""
    def change(f, t):
        f.excision = {n: user_triangles(f) for n in EXCISION}
        excise(f, [tuple(place(f, t)), FAR, (9., 9., 9.)])
    any_test(code, sentence, "", Files.is_truncated)(named(name, lambda f: change(f, Truncation(f.shell))))


thorn("thorn at a truncated tip", lambda f, t: t.points[t.discs[0].center], 1, "): an excised triangle has this vertex, whose tip is truncated")
thorn("thorn at another truncated tip", lambda f, t: t.points[t.discs[-1].center], 1, "): an excised triangle has this vertex, whose tip is truncated")
thorn("thorn beside a truncated tip", lambda f, t: next(p for n, p in enumerate(t.points) if n not in [d.center for d in t.discs]), 0,
      lambda f: f.claims().replace("\n", " E\n"))

# file format
add("blank at the end of a line", lambda f: f.certificate.__setitem__(3, f.certificate[3] + " "), 2, "line 4")
add("two blanks", lambda f: f.certificate.__setitem__(3, f.certificate[3].replace(" ", "  ", 1)), 2, "line 4")
add("lines that end with \\r", lambda f: f.certificate.__setitem__(3, f.certificate[3] + "\r"), 2, "line 4")
add("verdict that does not exist", lambda f: f.certificate.__setitem__(3, "verdicts proved proved proved proved true"), 2, "verdict")
add("line too many", lambda f: f.certificate.append("0"), 2, "unexpected data")
add("line too few", lambda f: f.certificate.pop(), 2, "expected a number")
add("empty certificate", lambda f: f.certificate.clear(), 2, "missing", "e")
add("checksum in upper case", lambda f: setattr(f, "certificate_sum", "checksum " + f.certificate_sum[9:].upper()), 2, "checksum", "")


# A generated shell of f = |x|^2 around an octahedron, with large leaves on the left and small ones on the right. At
# lattice points with spacing h, the coefficients are |p|^2 - h^2. The thresholds are 0.3 and 2, with waves along some
# axes; their steepness increases with their height. Boxes of the cover claim that f rises from the origin, or that its
# critical point is below the inner threshold.
def ball(inner_wave=0, outer_wave=0, axes=(1,), unit=1, path="0.27 0.28 0.28 0.97 0.95 0.98", outer=2, roots=5,
         by_center=False):
    inner, middle = 0.3, range(-roots, roots)
    leaves = [(0, i, j, k) for k in middle for j in middle for i in middle if i < 0]
    leaves += [(1, i, j, k) for k in range(-2 * roots, 2 * roots) for j in range(-2 * roots, 2 * roots) for i in range(2 * roots)]
    functions = []
    for level, size in ((1, 2 * roots), (0, roots)):
        h = 0.5 / 2**level
        # on small leaves, or on large leaves
        along_x = range(2, size + 2) if level == 1 else range(-size - 1, 2)
        for k, j, i in itertools.product(range(-size - 1, size + 2), range(-size - 1, size + 2), along_x):
            wave = sum((-1)**(i, j, k)[a] for a in axes)
            functions.append("%d %d %d %d %.17g %.17g %.17g" % (level, i, j, k, unit * h * h * (i * i + j * j + k * k - 1),
                                                                unit * (inner + inner_wave * wave), unit * (outer + outer_wave * wave)))
    boxes = []

    def divide(leaf, depth, place):
        level = leaves[leaf][0]
        h = 0.5 / 2**(level + depth)
        low = [h * (leaves[leaf][1 + a] * 2**depth + place[a]) for a in range(3)]
        nearest = [max(0, x, -x - h) for x in low]
        furthest = [max(abs(x), abs(x + h)) for x in low]
        center = [x + h / 2 for x in low]
        start = "%d %d %d %d %d " % ((leaf, depth) + tuple(place))
        least_product = sum(min(c * x, c * (x + h)) for c, x in zip(center, low))
        if (sum(x * x for x in furthest) < inner - inner_wave * len(axes) / 3
                or sum(x * x for x in nearest) > outer + outer_wave * len(axes) / 3 + 0.01):
            boxes.append(start + "x")
        elif least_product > 0 and (depth > 0 or level > 0):
            witness = ("b",) + tuple(-x / h for x in low) if by_center else ("g",) + tuple(center)
            boxes.append(start + "%s %.17g %.17g %.17g" % witness)
        else:
            for o in range(8):
                divide(leaf, depth + 1, [2 * place[a] + (o >> a & 1) for a in range(3)])

    for leaf in range(len(leaves)):
        divide(leaf, 0, [0, 0, 0])
    points = [[1.2 * (a == b) * sign for b in range(3)] for a in range(3) for sign in (1, -1)]
    facets = [[x, y, z] if (x + y + z) % 2 == 0 else [x, z, y] for x in (0, 1) for y in (2, 3) for z in (4, 5)]
    shell = ["cubic_bspline_shell 5 ascii", "unit 2.4", "thickness 3", "triangles 8 components 1", "field hierarchical 0 0 0 0.5",
             "functions %d" % len(functions)] + functions + ["leaves %d" % len(leaves)]
    shell += ["%d %d %d %d 1" % leaf for leaf in leaves] + ["facet_ranges 0", "closing 0 0 0", "paths 0", "truncation", "0 0 0 0 0 0"]
    certificate = ["cubic_bspline_shell_certificate 3", "", "", "verdicts proved proved proved proved proved", "boxes %d" % len(boxes)]
    certificate += boxes + ["seeds 1", "0 0", "covers 1", "paths 1", "0 0 " + path]
    return Files.of(shell, certificate, points, facets)


ACCEPTED, STEEP, AT_END = (0, "certified: P1 P2 P3 P4 P5"), (1, "faster than a threshold"), (1, "where the leaves end")
WAVES = [({}, ACCEPTED), ({"outer_wave": 0.3}, ACCEPTED), ({"outer_wave": 1.2}, STEEP), ({"inner_wave": 0.02}, ACCEPTED),
         ({"inner_wave": 0.6}, STEEP), ({"outer_wave": 0.5}, ACCEPTED), ({"outer_wave": 0.5, "axes": (0, 1, 2)}, STEEP),
         ({"outer_wave": 0.3, "unit": 1e-170}, ACCEPTED), ({"outer_wave": 1.2, "unit": 1e-170}, STEEP)]
# On small leaves, the slope of the outer threshold is at most four times the wave. A claim about the critical point at
# the origin implies that the slope of f is at least 0.6 / |x|. This is 0.424 where |x|^2 = 2, and less beyond.
CENTERS = [({"by_center": True, "outer_wave": 0.1}, ACCEPTED),
           ({"by_center": True, "outer_wave": 0.106}, (1, "has no critical point in the shell on the box, and is steeper")),
           ({"by_center": True, "inner_wave": 0.2}, ACCEPTED)]
# The domain ends at 1.5 along each axis, outside the shell or inside it.
ENDS = [({"roots": 3}, ACCEPTED), ({"roots": 3, "outer": 2.2}, ACCEPTED), ({"roots": 3, "outer": 2.3}, AT_END),
        ({"roots": 3, "outer": 2.2, "outer_wave": 0.2}, AT_END)]
THROUGH_EDGE, FROM_BEHIND_THE_CENTER = "0.375 0.375 0 1.125 1.125 0", "-0.125 -0.125 0.0625 1 0.875 0.9375"


def names_that_apply_to_none(prefixes):
    all_files = [Files(prefix) for prefix in prefixes]
    return [function.__name__ for function, _, _, _, applies in TESTS if not any(applies(files) for files in all_files)]


def main():
    if sys.argv[1] == "--apply":
        names = names_that_apply_to_none(sys.argv[2:])
        for name in names:
            print("applies to no files: %s" % name)
        return 1 if names else 0
    checker = sys.argv[1]
    files = Files(sys.argv[2]) if len(sys.argv) > 2 else None
    cases = [] if files else [("ball: %s" % ball_is, ball(**ball_is), code, sentence) for ball_is, (code, sentence) in WAVES + CENTERS + ENDS] + [
        ("ball, path through an edge", ball(path=THROUGH_EDGE), 1, "does not pass through the interior"),
        ("ball, path that begins downwards", ball(path=FROM_BEHIND_THE_CENTER), 1, "increase along it")]
    for function, code, sentence, update, applies in TESTS:
        if not files or not applies(files):
            continue
        changed = files.copy()
        function(changed)
        if "s" in update:
            changed.update_shell()
        if "m" in update:
            changed.update_mesh()
        if update:
            changed.update_certificate()
        cases.append((function.__name__, changed, code, sentence(files) if callable(sentence) else sentence))
    failures = 0
    with tempfile.TemporaryDirectory() as directory:
        changed_prefix = os.path.join(directory, "changed")
        for name, changed, code, sentence in cases:
            changed.write(changed_prefix)
            ends = (".shell.txt", ".mesh.off", ".certificate.txt") + ((".user.off",) if changed.user else ())
            arguments = [changed_prefix + end for end in ends]
            if changed.excision:
                arguments += ["--excised"] + ["%s.%s.off" % (changed_prefix, name) for name in EXCISION]
            run = subprocess.run([checker] + arguments,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
            said = run.stdout + run.stderr
            right = run.returncode == code and sentence in said and (code == 0) == bool(run.stdout)
            failures += not right
            print("%-5s %s: exit %d, %s" % ("ok" if right else "WRONG", name, run.returncode, said.strip()))
    print("%d of %d wrong" % (failures, len(cases)))
    return 1 if failures else 0


sys.exit(main())
