#!/usr/bin/env python3
"""Whether check_certificate accepts a certificate and refuses it when one thing in its files is changed.

   check_certificate_test.py CHECKER PREFIX

PREFIX.shell.txt, PREFIX.mesh.off and PREFIX.certificate.txt are of a connected mesh whose five claims are proved; the mesh
should be small. Exit code 0 if all went as it should.
"""
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


def test(code, sentence, update="c"):
    """registers a change, the exit code and a part of the sentence that it should lead to, and the checksums that follow"""
    def register(function):
        TESTS.append((function, code, sentence, update))
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
for position in (0, 0.3, 0.6, 1):
    def change_function(f, position=position):
        line, count = f.section(f.shell, "functions")
        f.words(f.shell, line + 1 + int(position * (count - 1)), set_word(3, lambda x: x + 1e-9))
    add("function coefficient at %g" % position, change_function, 1, "Leaf", "sc")
add("Bernstein coefficient", lambda f: shell_line("leaves", 1 + used_leaf(f), set_word(40, lambda x: x + 1e-12))(f), 1, "Leaf", "sc")
add("Bernstein coefficient, old checksum", shell_line("leaves", 5, set_word(40, lambda x: x + 1e-12)), 2, "checksum", "")
add("radius zero", shell_line("leaves", 5, set_word(8, "0")), 1, "Leaf 4", "sc")
add("corner moved by one bit", shell_line("leaves", 9, set_word(5, lambda x: x * (1 + 2**-52))), 2, "corner", "sc")
add("inner level inwards", shell_line("levels", 0, set_word(1, lambda x: x + 1e-6)), 1, "P1", "sc")
add("outer level inwards", shell_line("levels", 0, set_word(2, lambda x: x - 1e-6)), 1, "P1", "sc")
add("outer level inwards a little", shell_line("levels", 0, set_word(2, lambda x: x - 1e-9)), 1, "P1", "sc")
add("levels much wider", shell_line("levels", 0, lambda w: w.__setitem__(slice(1, 3), ["-0.5", "0.5"])), 1, "P3", "sc")
add("another spacing", shell_line("field", 0, set_word(5, lambda x: 2 * x)), 2, "corner", "sc")
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


def main():
    checker, prefix = sys.argv[1:]
    files = Files(prefix)
    failures = 0
    with tempfile.TemporaryDirectory() as directory:
        changed_prefix = os.path.join(directory, "changed")
        for function, code, sentence, update in TESTS:
            changed = files.copy()
            function(changed)
            if "s" in update:
                changed.update_shell()
            if "m" in update:
                changed.update_mesh()
            if update:
                changed.update_certificate()
            changed.write(changed_prefix)
            run = subprocess.run([checker] + [changed_prefix + end for end in (".shell.txt", ".mesh.off", ".certificate.txt")],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
            said = run.stdout + run.stderr
            right = run.returncode == code and sentence in said and (code == 0) == bool(run.stdout)
            failures += not right
            print("%-5s %s: exit %d, %s" % ("ok" if right else "WRONG", function.__name__, run.returncode, said.strip()))
    print("%d of %d wrong" % (failures, len(TESTS)))
    return 1 if failures else 0


sys.exit(main())
