#!/usr/bin/env python3
"""Whether check_certificate accepts a certificate and refuses it when one thing in its files is changed.

   check_certificate_test.py CHECKER [PREFIX]

PREFIX.shell.txt, PREFIX.mesh.off and PREFIX.certificate.txt are of a small mesh, of one component or of several. Changes that
only make sense for some kinds of shells and meshes are tried on these. Where not all claims are proved, those that are not must
not be accepted, whatever the witnesses are changed to. Without PREFIX, shells that are made here are tried. Exit code 0 if all
went as it should.
"""
import itertools
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


class Files:
    """The three files, in parts that a test changes; `update` tells which checksums follow the change."""

    def __init__(self, prefix):
        self.shell, self.shell_sum = self.read(prefix + ".shell.txt")
        self.certificate, self.certificate_sum = self.read(prefix + ".certificate.txt")
        numbers = open(prefix + ".mesh.off").read().split()[1:]
        vertices, facets = int(numbers[0]), int(numbers[1])
        coordinates = [float(x) for x in numbers[3:3 + 3 * vertices]]
        self.points = [coordinates[3 * v:3 * v + 3] for v in range(vertices)]
        indices = [int(i) for i in numbers[3 + 3 * vertices:]]
        self.facets = [indices[4 * f + 1:4 * f + 4] for f in range(facets)]

    @classmethod
    def of(cls, shell, certificate, points, facets):
        """from lines, without checksums, and lists"""
        files = cls.__new__(cls)
        files.shell, files.certificate, files.points, files.facets = shell, certificate, points, facets
        files.update_shell()
        files.update_mesh()
        files.update_certificate()
        return files

    @staticmethod
    def read(name):
        lines = open(name).read().split("\n")
        return lines[:-2], lines[-2]

    def copy(self):
        other = Files.__new__(Files)
        other.shell, other.certificate = list(self.shell), list(self.certificate)
        other.shell_sum, other.certificate_sum = self.shell_sum, self.certificate_sum
        other.points, other.facets = [list(p) for p in self.points], [list(f) for f in self.facets]
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
        """number of the line that begins with the name, and of those that it counts, if it does"""
        line = next(i for i, l in enumerate(lines) if l.startswith(name + " "))
        count = lines[line].split()[1]
        return line, int(count) if count.isdigit() else 0

    def words(self, lines, line, change):
        words = lines[line].split(" ")
        change(words)
        lines[line] = " ".join(words)

    def leaf_at(self, point):
        """words of the line of a leaf that contains a point"""
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
        """line of a function that acts on the leaf at a point, one in the middle of those that do"""
        words = self.leaf_at(point)
        line, count = self.section(self.shell, "functions")
        lines = {tuple(l.split()[:4]): line + 1 + i for i, l in enumerate(self.shell[line + 1:line + 1 + count])}
        for step in sorted(itertools.product(range(-1, 3), repeat=3), key=lambda d: sum((2 * x - 1)**2 for x in d)):
            function = (words[0],) + tuple(str(int(words[1 + a]) + step[a]) for a in range(3))
            if function in lines:
                return lines[function]
        raise AssertionError("no function acts on the leaf")

    def claims(self):
        """what the checker says if it accepts the certificate"""
        verdicts = self.certificate[3].split()[1:]
        return " ".join(["certified:"] + ["P%d" % (i + 1) for i in range(5) if verdicts[i] == "proved"])

    def are_all_proved(self):
        return self.certificate[3].count("proved") == 5

    def components(self):
        return self.section(self.certificate, "seeds")[1]

    def component_of_vertices(self):
        """by seeds, that is in the order in which components are numbered"""
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
        """least corner and edge of each box, by its line"""
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
        """for each point, lines of the cover's boxes that contain it"""
        cover = [(i, low, h) for i, (low, h) in self.cubes().items() if self.kind(i) in "gu"]
        return [[i for i, low, h in cover if low[0] <= p[0] <= low[0] + h and all(low[a] <= p[a] <= low[a] + h for a in (1, 2))]
                for p in points]

    def box_on_mesh(self):
        """line of a box of the cover that contains a vertex"""
        return self.boxes_at([self.points[0]])[0][0]

    def ends_of_cover(self):
        """where the first path enters the cover, and where it leaves it: a point and the line of a box there"""
        words = [float(x) for x in self.certificate[self.section(self.certificate, "paths")[0] + 1].split()]
        points = [[words[2 + a] + t / 64 * (words[5 + a] - words[2 + a]) for a in range(3)] for t in range(65)]
        met = [(p, lines[0]) for p, lines in zip(points, self.boxes_at(points)) if lines]
        return met[0], met[-1]

    def excluded_next_to_cover(self):
        """line of an excluded box that touches one of the cover"""
        cubes = self.cubes()
        low, h = cubes[self.ends_of_cover()[1][1]]
        return next(i for i, (l, k) in cubes.items() if self.kind(i) == "x"
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
        with open(prefix + ".mesh.off", "w") as out:
            out.write("OFF\n%d %d 0\n" % (len(self.points), len(self.facets)))
            out.write("".join("%.17g %.17g %.17g\n" % tuple(p) for p in self.points))
            out.write("".join("3 %d %d %d\n" % tuple(f) for f in self.facets))


def set_word(n, new):
    """the change of a line's word; new is a text or a function of a number"""
    def change(words):
        words[n] = new if isinstance(new, str) else "%.17g" % new(float(words[n]))
    return change


TESTS = []


def test(code, sentence, update="c", applies=lambda f: True):
    """registers a change, the exit code and a part of the sentence that it should lead to, the checksums that follow, and whether
    it applies to some files whose claims are all proved"""
    return any_test(code, sentence, update, lambda f: f.are_all_proved() and applies(f))


def any_test(code, sentence, update, applies):
    """the same for files of which this need not be so"""
    def register(function):
        TESTS.append((function, code, sentence, update, applies))
        return function
    return register


def shell_line(section, offset, change):
    return lambda f: f.words(f.shell, f.section(f.shell, section)[0] + offset, change)


def certificate_line(section, offset, change):
    return lambda f: f.words(f.certificate, f.section(f.certificate, section)[0] + offset, change)


def box(kind, change):
    """of the first box that is not of the cover, or of a box of the cover on the mesh"""
    return lambda f: f.words(f.certificate, f.box_on_mesh() if kind == "g" else f.first_box(kind), change)


def named(name, function):
    function.__name__ = name
    return function


def add(name, function, *rest):
    test(*rest)(named(name, function))


def used_leaf(f):
    """number of a leaf with a cover box"""
    return int(f.certificate[f.box_on_mesh()].split()[0])


any_test(0, Files.claims, "", lambda f: True)(named("nothing", lambda f: None))
any_test(0, Files.claims, "smc", lambda f: True)(named("all checksums computed here", lambda f: None))
add("fewer claims", lambda f: f.certificate.__setitem__(3, "verdicts proved proved refuted undecided proved"), 0, "certified: P1 P2 P5\n")
add("P3 to P5 without P1", lambda f: f.certificate.__setitem__(3, "verdicts undecided proved proved proved proved"), 1, "without P1")

# the shell
def change_at_mesh(word, shift):
    """moves a number of a function near a vertex, by a part of the unit"""
    return lambda f: f.words(f.shell, f.function_at(f.points[0]), set_word(word, lambda x: x + shift * float(f.shell[1].split()[1])))


for shift in (1, -1, 0.5):
    add("coefficient of f moved by %g" % shift, change_at_mesh(4, shift), 1, "P", "sc")
add("coefficient, old checksum", change_at_mesh(4, 1e-9), 2, "checksum", "")
add("coefficient, old checksum in the certificate", lambda f: (change_at_mesh(4, 1e-9)(f), setattr(
    f, "shell_sum", "checksum " + crc64(text(f.shell).encode()))), 2, "another shell")
add("coefficient that is no number", lambda f: f.words(f.shell, 6, set_word(4, "nan")), 2, "finite", "sc")
add("function removed", lambda f: remove_line(f, f.function_at(f.points[0]), "functions"), 2, "has no coefficient", "sc")
add("functions out of order", lambda f: f.shell.__setitem__(slice(6, 8), f.shell[7:5:-1]), 2, "order", "sc")
add("leaves out of order", lambda f: (lambda n: f.shell.__setitem__(slice(n, n + 2), [f.shell[n + 1], f.shell[n]]))(
    f.section(f.shell, "leaves")[0] + 1), 2, "order", "sc")
add("leaf removed, and its boxes", lambda f: remove_leaf(f, f.shell.index(" ".join(f.leaf_at(f.points[0])))), 1, "P1", "sc")
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
    """those of a shell that was built for its mesh, and knows ranges of its facets"""
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


thresholds("inner threshold raised at a vertex", change_at_mesh(5, 0.5), 1, "P1", "sc")
thresholds("outer threshold lowered at a vertex", change_at_mesh(6, -0.5), 1, "P1", "sc")
thresholds("outer threshold raised at a vertex", change_at_mesh(6, 0.5), 1, "P3", "sc")
thresholds("no room inside", all_thresholds(5, 0.01), 1, "P1", "sc")
thresholds("far too thick", all_thresholds(6, 30), 1, "P3", "sc")
thresholds("no coefficient of a threshold", lambda f: f.shell.__setitem__(6, f.shell[6].rsplit(" ", 1)[0]), 2, "a blank is expected", "sc")
thresholds("thresholds taken for levels", lambda f: f.shell.__setitem__(2, "levels -1 1"), 2, "end where it should", "sc")


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
    """a leaf, and an eighth of it"""
    coarse = leaf_lines(f)[0]
    fine = [int(coarse[0]) + 1] + [2 * int(i) for i in coarse[1:4]]
    line, count = f.section(f.shell, "leaves")
    n = next(n for n in range(line + 1, line + count) if order(f.shell[n]) > (fine[0],) + tuple(fine[:0:-1]))
    insert_line(f, n, " ".join(str(i) for i in fine + [1]), "leaves")


def order(leaf):
    words = [int(i) for i in leaf.split()[:4]]
    return (words[0],) + tuple(words[:0:-1])


def function_on_coarser_leaf(f):
    """one with a coefficient of its own, where it should depend on the level above"""
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
add("another origin", shell_line("field", 0, set_word(2, lambda x: x + 0.1)), 1, "P", "sc")
add("no kind of field", shell_line("field", 0, set_word(1, "dense")), 2, "kind", "sc")
add("version of another time", shell_line("cubic_bspline_shell", 0, set_word(1, "1")), 2, "out of range", "sc")
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
    """the mesh twice, at the same place; the certificate says so"""
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
    """a direction at right angles to another one"""
    d = [float(x) for x in words[6:9]]
    least = min(range(3), key=lambda a: abs(d[a]))
    other, third = (least + 1) % 3, (least + 2) % 3
    words[6 + least], words[6 + other], words[6 + third] = "0", "%.17g" % d[third], "%.17g" % -d[other]


for step in (1, 3, 5):
    add("another direction negated, %d" % step, negate_every(step), 1, "P3, box")
add("direction turned by a right angle", box("g", tangential), 1, "P3, box")
add("excluded box without a claim",
    lambda f: f.words(f.certificate, f.excluded_next_to_cover(), lambda w: w.__setitem__(5, "o")), 1, "about which nothing is claimed")
def remove_leaf_beside_cover(f):
    """one without a box of the cover: the domain ends there"""
    number = int(f.certificate[f.excluded_next_to_cover()].split()[0])
    remove_leaf(f, f.section(f.shell, "leaves")[0] + 1 + number)


def has_excluded_leaf_beside_cover(f):
    number = f.certificate[f.excluded_next_to_cover()].split()[0]
    return all(f.kind(i) == "x" for i in f.boxes() if f.certificate[i].split()[0] == number)


def no_cover(f):
    for i in f.boxes():
        if f.kind(i) == "g":
            f.certificate[i] = " ".join(f.certificate[i].split()[:5] + ["o"])
    f.certificate[f.section(f.certificate, "covers")[0]] = "covers 0"


add("leaf beside the cover removed, and its boxes", remove_leaf_beside_cover, 1, "a cell that it touches has no boxes", "sc",
    has_excluded_leaf_beside_cover)
add("no cover", no_cover, 1, "its seed is in no cover box")
add("all boxes of the cover excluded", lambda f: [f.certificate.__setitem__(i, " ".join(f.certificate[i].split()[:5] + ["x"]))
                                                  for i in f.boxes() if f.certificate[i].split()[5] == "g"], 1, "P3, box")


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
    """of the first two lines of a section"""
    def change(f):
        line = f.section(f.certificate, section)[0] + 1
        one, two = f.certificate[line].split(), f.certificate[line + 1].split()
        one[first:last], two[first:last] = two[first:last], one[first:last]
        f.certificate[line], f.certificate[line + 1] = " ".join(one), " ".join(two)
    return change


def without_component(removed):
    """the mesh without one of its components, and the certificate without its seed and its path"""
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
    """the first component where the second one is, and with its path, but a little larger or smaller"""
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
    """no box of a leaf that has a box of the cover at the last component"""
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
several("one path missing", lambda f: (f.certificate.pop(), certificate_line("paths", 0, set_word(1, lambda n: n - 1))(f)), 1, "one path for each")
several("one path twice", lambda f: certificate_line("paths", 2, set_word(0, "0"))(f), 2, "out of range")
several("a component of the cover too few", certificate_line("covers", 0, set_word(1, lambda n: n - 1)), 1, "P4")
for c in (0, 1, 2):
    several("component %d left out" % c, without_component(c), 1, "P4", "mc")
several("component where another one is", component_onto_another, 1, "P4", "mc")
several("component turned inside out", turn_component, 1, "P2", "mc")
several("no boxes at a component", no_boxes_at_component, 1, "P3")


# thresholds that vary, with a bump where the cover ends
def bump_at_end(word, height, end):
    """a threshold moved away where a path enters the cover or leaves it: what was excluded there is so no longer"""
    def change(f):
        f.words(f.shell, f.function_at(f.ends_of_cover()[end][0]), set_word(word, lambda x: x + height * float(f.shell[1].split()[1])))
    return change


thresholds("inner threshold with a bump at an end of the cover", bump_at_end(5, -1, 0), 1, "P", "sc")
thresholds("outer threshold with a bump at an end of the cover", bump_at_end(6, 1, 1), 1, "P", "sc")


# claims that are not proved, raised
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
    """to undecided boxes: the direction from the origin, along which the field rises"""
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
not_all("undecided boxes with directions, and verdicts raised", directions_and_verdicts, 1, "more steeply", "c", is_gradient_undecided)
not_all("undecided boxes excluded, and verdicts raised", exclude_undecided, 1, "P3, box", "c", is_gradient_undecided)

# the form
add("blank at the end of a line", lambda f: f.certificate.__setitem__(3, f.certificate[3] + " "), 2, "line 4")
add("two blanks", lambda f: f.certificate.__setitem__(3, f.certificate[3].replace(" ", "  ", 1)), 2, "line 4")
add("lines that end with \\r", lambda f: f.certificate.__setitem__(3, f.certificate[3] + "\r"), 2, "line 4")
add("verdict that does not exist", lambda f: f.certificate.__setitem__(3, "verdicts proved proved proved proved true"), 2, "verdict")
add("line too many", lambda f: f.certificate.append("0"), 2, "more than")
add("line too few", lambda f: f.certificate.pop(), 2, "a number is expected")
add("empty certificate", lambda f: f.certificate.clear(), 2, "missing", "e")
add("checksum in upper case", lambda f: setattr(f, "certificate_sum", "checksum " + f.certificate_sum[9:].upper()), 2, "checksum", "")


# A shell made here: f = |x|^2, which the coefficients |p|^2 - h^2 at lattice points of any spacing h give, on large leaves at the
# left and small ones at the right, around an octahedron. The thresholds are 0.3 and 2, and waves along some axes, the more steep the
# higher they are.
def ball(inner_wave=0, outer_wave=0, axes=(1,), unit=1, path="0.27 0.28 0.28 0.97 0.95 0.98"):
    inner, outer, roots = 0.3, 2, range(-5, 5)
    leaves = [(0, i, j, k) for k in roots for j in roots for i in roots if i < 0]
    leaves += [(1, i, j, k) for k in range(-10, 10) for j in range(-10, 10) for i in range(10)]
    functions = []
    for level, size in ((1, 10), (0, 5)):
        h = 0.5 / 2**level
        # on small leaves only; on large leaves
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
            boxes.append(start + "g %.17g %.17g %.17g" % tuple(center))
        else:
            for o in range(8):
                divide(leaf, depth + 1, [2 * place[a] + (o >> a & 1) for a in range(3)])

    for leaf in range(len(leaves)):
        divide(leaf, 0, [0, 0, 0])
    points = [[1.2 * (a == b) * sign for b in range(3)] for a in range(3) for sign in (1, -1)]
    facets = [[x, y, z] if (x + y + z) % 2 == 0 else [x, z, y] for x in (0, 1) for y in (2, 3) for z in (4, 5)]
    shell = ["cubic_bspline_shell 2 ascii", "unit 2.4", "thickness 3", "triangles 8 components 1", "field hierarchical 0 0 0 0.5",
             "functions %d" % len(functions)] + functions + ["leaves %d" % len(leaves)]
    shell += ["%d %d %d %d 1" % leaf for leaf in leaves] + ["facet_ranges 0"]
    certificate = ["cubic_bspline_shell_certificate 1", "", "", "verdicts proved proved proved proved proved", "boxes %d" % len(boxes)]
    certificate += boxes + ["seeds 1", "0 0", "covers 1", "paths 1", "0 0 " + path]
    return Files.of(shell, certificate, points, facets)


ACCEPTED, STEEP = (0, "certified: P1 P2 P3 P4 P5"), (1, "more steeply")
WAVES = [({}, ACCEPTED), ({"outer_wave": 0.3}, ACCEPTED), ({"outer_wave": 1.2}, STEEP), ({"inner_wave": 0.02}, ACCEPTED),
         ({"inner_wave": 0.6}, STEEP), ({"outer_wave": 0.5}, ACCEPTED), ({"outer_wave": 0.5, "axes": (0, 1, 2)}, STEEP),
         ({"outer_wave": 0.3, "unit": 1e-170}, ACCEPTED), ({"outer_wave": 1.2, "unit": 1e-170}, STEEP)]
THROUGH_EDGE, FROM_BEHIND_THE_CENTER = "0.375 0.375 0 1.125 1.125 0", "-0.125 -0.125 0.0625 1 0.875 0.9375"


def main():
    checker = sys.argv[1]
    files = Files(sys.argv[2]) if len(sys.argv) > 2 else None
    cases = [] if files else [("ball, waves: %s" % wave, ball(**wave), code, sentence) for wave, (code, sentence) in WAVES] + [
        ("ball, path through an edge", ball(path=THROUGH_EDGE), 1, "does not pass through the interior"),
        ("ball, path that begins downwards", ball(path=FROM_BEHIND_THE_CENTER), 1, "does not rise on all of it")]
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
            run = subprocess.run([checker] + [changed_prefix + end for end in (".shell.txt", ".mesh.off", ".certificate.txt")],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
            said = run.stdout + run.stderr
            right = run.returncode == code and sentence in said and (code == 0) == bool(run.stdout)
            failures += not right
            print("%-5s %s: exit %d, %s" % ("ok" if right else "WRONG", name, run.returncode, said.strip()))
    print("%d of %d wrong" % (failures, len(cases)))
    return 1 if failures else 0


sys.exit(main())
