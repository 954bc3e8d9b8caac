#!/usr/bin/env python3
"""Fails if a header of the package includes one of a higher layer, or from internal/ of another folder.

   source_rules_test.py ROOT_OF_THE_PROJECT

The layers, from the lowest, are the folders of include/CGAL/Bspline_shell_3 in the order below. Tests include internal
headers only to test them; examples and benchmarks do not use internal names.

It also fails
- if a source of the program bspline_shell includes one of a higher layer (Files, Carry, Bake, View, Commands), or names something
  internal to the package;
- if a source of the package converts numbers to doubles other than by rounded() of Support/coordinates.h, which proofs
  rely on;
- if a line of C++ has more columns than .clang-format allows;
- if a test file is not compiled;
- if the title of a test has a semicolon: CMake would truncate it, and no test would be run.
"""
import os
import re
import sys

STOREYS = ["Support", "Spline", "Cells", "Mesh", "Field", "Shell", "Closing", "Truncation", "Fit", "Certificate", "Projection", "Transfer", "Editing", "Surface",
           "IO", "Construction", "Soup"]
TOOL_STOREYS = ["Files", "Carry", "Bake", "View", "Commands"]
PACKAGE = "CGAL/Bspline_shell_3/"


def files(top):
    for folder, _, names in os.walk(top):
        for name in names:
            if name.endswith((".h", ".cpp")):
                yield os.path.relpath(os.path.join(folder, name), top)


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def includes(text):
    return re.findall(r'^#include <' + PACKAGE + r'([^>]+)>', text, re.MULTILINE)


def storey(header):
    """Returns the index of the header's folder; headers outside these folders are in the highest layer."""
    return STOREYS.index(header.split("/")[0]) if "/" in header else len(STOREYS)


def is_internal(header):
    return "/internal/" in header


def converts_numbers(text):
    """Returns whether the text contains one of CGAL's conversions to doubles."""
    return re.search(r"\b(to_double|NT_converter|Cartesian_converter)\b", text)


def circles(graph):
    """Returns cycles of headers that include each other."""
    done, found = set(), []

    def visit(header, path):
        if header in path:
            found.append(" -> ".join(path[path.index(header):] + [header]))
        elif header not in done:
            for other in graph.get(header, []):
                visit(other, path + [header])
            done.add(header)

    for header in graph:
        visit(header, [])
    return found


def main(root):
    top = os.path.join(root, "include", PACKAGE)
    wrong = [f"{f} is no storey" for f in sorted(os.listdir(top)) if f not in STOREYS]
    if not wrong:
        # NAME_impl.h belongs to NAME.h, which includes it unless its code is in the library.
        graph = {header: [other for other in includes(read(top, header)) if other != header.replace(".h", "_impl.h")]
                 for header in files(top)}
        for header, others in sorted(graph.items()):
            for other in others:
                if not os.path.exists(os.path.join(top, other)):
                    wrong.append(f"{header} includes {other}, which does not exist")
                elif storey(other) > storey(header):
                    wrong.append(f"{header} includes {other}, from a storey above")
                elif is_internal(other) and storey(other) != storey(header):
                    wrong.append(f"{header} includes {other}, which is internal to another folder")
        wrong += [f"circle of includes: {circle}" for circle in circles(graph)]
    for place in ("include", "src"):
        for name in files(os.path.join(root, place)):
            if not name.endswith("Support/coordinates.h") and converts_numbers(read(root, place, name)):
                wrong.append(f"{place}/{name} converts numbers to doubles: use rounded() of Support/coordinates.h")
    for name in files(os.path.join(root, "test")):
        tested = re.sub(r"^.*/([A-Za-z]+)/test_(\w+)\.cpp$", r"\1/internal/\2.h", name)
        others = [header for header in includes(read(root, "test", name)) if is_internal(header)]
        if others and tested not in others:
            wrong.append(f"{name} includes {', '.join(others)}, and tests no internal header")
    tool = os.path.join(root, "tool", "Bspline_shell_3")
    for name in files(tool):
        folder = name.split("/")[0]
        for other in re.findall(r'#include "\.\./(\w+)/', read(tool, name)):
            if TOOL_STOREYS.index(other) > TOOL_STOREYS.index(folder):
                wrong.append(f"tool/Bspline_shell_3/{name} includes a file of {other}, from a storey above")
    for place in ("examples", "benchmark", "tool"):
        for name in files(os.path.join(root, place)):
            text = read(root, place, name)
            if re.search(r"(\bBS|Bspline_shells)::internal::", text) or any(map(is_internal, includes(text))):
                wrong.append(f"{place}/{name} names something internal")
    tests = os.path.join(root, "test", "Bspline_shell_3")
    lists = read(tests, "CMakeLists.txt")
    wrong += [f"test/Bspline_shell_3/{name} is in no list of CMakeLists.txt" for name in files(tests)
              if os.path.basename(name).startswith("test_") and name.endswith(".cpp") and f"{name}\n" not in lists.replace(")", "\n")]
    for name in files(tests):
        titles = re.findall(r'TEST_CASE\(\s*((?:"(?:[^"\\]|\\.)*"\s*)+)', read(tests, name))
        wrong += [f"test/Bspline_shell_3/{name} has a title with a semicolon: {title}" for title in titles if ";" in title]
    columns = int(re.search(r"^ColumnLimit: (\d+)$", read(root, ".clang-format"), re.MULTILINE).group(1))
    for place in ("include", "src", "test", "examples", "benchmark", "tool", "doc"):
        for name in files(os.path.join(root, place)):
            long = [str(n) for n, line in enumerate(read(root, place, name).split("\n"), 1) if len(line) > columns]
            if long:
                wrong.append(f"{place}/{name} has more than {columns} columns in {', '.join(long)}")
    print("\n".join(wrong) if wrong else "all rules are kept")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
