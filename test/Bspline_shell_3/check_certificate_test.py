#!/usr/bin/env python3
"""Whether check_certificate accepts a certificate and refuses it when one thing in its files is changed.

   check_certificate_test.py CHECKER PREFIX

PREFIX.shell.txt, PREFIX.mesh.off and PREFIX.certificate.txt are of a connected mesh whose five claims are proved; the mesh
should be small. Changes that only make sense for some kinds of shells are tried on these. Exit code 0 if all went as it should.
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
    it applies to some files"""
    def register(function):
        TESTS.append((function, code, sentence, update, applies))
        return function
    return register


def shell_line(section, offset, change):
    return lambda f: f.words(f.shell, f.section(f.shell, section)[0] + offset, change)


def certificate_line(section, offset, change):
    return lambda f: f.words(f.certificate, f.section(f.certificate, section)[0] + offset, change)


def box(kind, change):
    return lambda f: f.words(f.certificate, f.first_box(kind), change)


def named(name, function):
    function.__name__ = name
    return function


def add(name, function, *rest):
    test(*rest)(named(name, function))


def used_leaf(f):
    """number of the first leaf with a cover box"""
    return int(f.certificate[f.first_box("g")].split()[0])


add("nothing", lambda f: None, 0, "certified: P1 P2 P3 P4 P5", "")
add("all checksums computed here", lambda f: None, 0, "certified: P1 P2 P3 P4 P5", "smc")
add("fewer claims", lambda f: f.certificate.__setitem__(3, "verdicts proved proved refuted undecided proved"), 0, "certified: P1 P2 P5\n")
add("P3 to P5 without P1", lambda f: f.certificate.__setitem__(3, "verdicts undecided proved proved proved proved"), 1, "without P1")

# the shell
def change_at_mesh(word, shift):
    """moves a number of a function near a vertex, by a part of the unit"""
    return lambda f: f.words(f.shell, f.function_at(f.points[0]), set_word(word, lambda x: x + shift * float(f.shell[1].split()[1])))


for shift in (1, -1, 0.1):
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


levels("inner level inwards", set_word(1, lambda x: x + 1e-6), 1, "P1", "sc")
levels("outer level inwards", set_word(2, lambda x: x - 1e-6), 1, "P1", "sc")
levels("outer level inwards a little", set_word(2, lambda x: x - 1e-9), 1, "P1", "sc")
levels("levels much wider", lambda w: w.__setitem__(slice(1, 3), ["-0.5", "0.5"]), 1, "P3", "sc")


def thresholds(name, change, *rest):
    add(name, change, *rest, lambda f: f.shell[2].startswith("thickness"))


def all_thresholds(word, factor):
    def change(f):
        line, count = f.section(f.shell, "functions")
        for n in range(line + 1, line + 1 + count):
            f.words(f.shell, n, set_word(word, lambda x: factor * x))
    return change


thresholds("inner threshold raised at a vertex", change_at_mesh(5, 0.1), 1, "P1", "sc")
thresholds("outer threshold lowered at a vertex", change_at_mesh(6, -0.1), 1, "P1", "sc")
thresholds("outer threshold raised at a vertex", change_at_mesh(6, 0.1), 1, "P3", "sc")
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
add("version of another time", shell_line("cubic_bspline_shell", 0, set_word(1, "1")), 2, "expected", "sc")
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
    v, n = len(f.points), len(f.facets)
    f.points += [list(p) for p in f.points]
    f.facets += [[i + v for i in t] for t in f.facets]
    line = f.section(f.certificate, "seeds")[0]
    f.certificate[line] = "seeds 2"
    f.certificate.insert(line + 2, "1 %d" % (v + int(f.certificate[line + 1].split()[1])))
    line = f.section(f.certificate, "paths")[0]
    f.certificate[line] = "paths 2"
    path = f.certificate[line + 1].split()
    f.certificate.append(" ".join(["1", str(n + int(path[1]))] + path[2:]))


def double_mesh_without_p4(f):
    double_mesh(f)
    f.certificate[3] = "verdicts proved proved proved undecided proved"


add("vertex moved out of the shell", move_last_point, 1, "P1", "mc")
add("two vertices swapped", swap_points, 1, "P", "mc")
add("vertex moved, old checksum of the mesh", lambda f: f.points[0].__setitem__(0, f.points[0][0] + 1e-12), 2, "another mesh")
add("one facet flipped", lambda f: f.facets[3].reverse(), 1, "closed", "mc")
add("all facets flipped", lambda f: [t.reverse() for t in f.facets], 1, "P2, facet 0", "mc")
add("facet removed", lambda f: f.facets.pop(), 1, "closed", "mc")
add("mesh twice", double_mesh, 1, "P4", "mc")
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
add("box removed", lambda f: f.remove_boxes([f.first_box("g")]), 1, "P3")
add("boxes of a leaf removed",
    lambda f: f.remove_boxes([i for i in f.boxes() if int(f.certificate[i].split()[0]) == used_leaf(f)]), 1, "P3")


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
add("another number of covers", certificate_line("covers", 0, set_word(1, "2")), 1, "P4")
add("seed that is no vertex", lambda f: certificate_line("seeds", 1, set_word(1, str(len(f.points))))(f), 2, "out of range")
add("no seed", lambda f: certificate_line("seeds", 0, set_word(1, "0"))(f), 2, "seed")


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
add("no path", no_paths, 1, "P5")

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
# left and small ones at the right, around an octahedron. The outer threshold is 2 and a wave, the more steep the higher it is.
def ball(wave):
    inner, outer, roots = 0.3, 2, range(-5, 5)
    leaves = [(0, i, j, k) for k in roots for j in roots for i in roots if i < 0]
    leaves += [(1, i, j, k) for k in range(-10, 10) for j in range(-10, 10) for i in range(10)]
    functions = []
    for level, size in ((1, 10), (0, 5)):
        h = 0.5 / 2**level
        # on small leaves only; on large leaves
        along_x = range(2, size + 2) if level == 1 else range(-size - 1, 2)
        for k, j, i in itertools.product(range(-size - 1, size + 2), range(-size - 1, size + 2), along_x):
            functions.append("%d %d %d %d %.17g %.17g %.17g" % (level, i, j, k, h * h * (i * i + j * j + k * k - 1), inner,
                                                                outer + wave * (-1)**j))
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
        if sum(x * x for x in furthest) < inner or sum(x * x for x in nearest) > outer + wave / 3 + 0.01:
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
    certificate += boxes + ["seeds 1", "0 0", "covers 1", "paths 1", "0 0 0.27 0.28 0.28 0.97 0.95 0.98"]
    return Files.of(shell, certificate, points, facets)


WAVES = [(0, 0, "certified: P1 P2 P3 P4 P5"), (0.3, 0, "certified: P1 P2 P3 P4 P5"), (1.2, 1, "more steeply")]


def main():
    checker, prefix = sys.argv[1:]
    files = Files(prefix)
    cases = [("wave of height %g" % wave, ball(wave), code, sentence) for wave, code, sentence in WAVES]
    for function, code, sentence, update, applies in TESTS:
        if not applies(files):
            continue
        changed = files.copy()
        function(changed)
        if "s" in update:
            changed.update_shell()
        if "m" in update:
            changed.update_mesh()
        if update:
            changed.update_certificate()
        cases.append((function.__name__, changed, code, sentence))
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
