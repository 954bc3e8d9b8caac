#!/usr/bin/env python3
"""Plants each fault of a list into code that proofs depend on, and prints which test detects it.

   plant_faults.py [--work FOLDER] [--jobs N] [--list FILE] [--part I/N] [--all] [--dry] [WORDS ...]

With WORDS, only faults whose name or file contains one of these words are run; with --part, only the I-th of N parts of
them. The list (faults.txt beside this script) explains its format. All faults are planted into a copy of the sources in
FOLDER (build/planted_faults). A switch selects a fault from the environment, so that each test is compiled only once.

First, all tests must pass without a fault. Then each fault is switched on, and tests are run until the first failure.
Crashes and timeouts are failures. Faults of the package are tested by CMake's target `proof_tests`, in this order: the
test that detected the fault last time; the test file of the header; test files that include the header; those that
include it indirectly, up to three levels. With --all, all other tests follow. Faults of check_certificate are tested
with small certificates; with --all, also with large ones.

FOLDER keeps the build, and the results in found.json. An interrupted run can be resumed. A fault is examined again if
its text, the code of its header, or the test file that detected it has changed. An undetected fault is examined again
if any of its test files has changed, or if --all requests more tests.

The exit code is 0 if every fault is detected, except those with an argument that they change no answer. It is 1 if
other faults are not detected, or if one of the exceptions is. It is 2 if the list does not fit the sources. --dry stops
after planting.

Requires the packages that test/run.sh installs. On two cores, compilation takes about ten minutes, and the whole list
less than two hours.
"""
import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import xml.sax.saxutils

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(HERE)))
HEADERS = "include/CGAL/Bspline_shell_3/"
CHECKER = "benchmark/Bspline_shell_3/Robustness/"
SWITCH = """#ifndef PLANTED_FAULT_H
#define PLANTED_FAULT_H
#include <cstdlib>
inline const int planted_fault = std::getenv("PLANTED_FAULT") ? std::atoi(std::getenv("PLANTED_FAULT")) : 0;
inline bool planted(int fault) { return fault == planted_fault; }
#endif
"""


class Sources:
    """Headers, and the test files that include them."""

    LEVELS = 3

    def __init__(self):
        self.includers = collections.defaultdict(set)
        self.path_of_test = {}
        top, tests = os.path.join(ROOT, "include"), os.path.join(ROOT, "test", "Bspline_shell_3")
        for folder in (top, tests):
            for path in (os.path.join(f, n) for f, _, names in os.walk(folder) for n in names if n.endswith((".h", ".cpp"))):
                name = os.path.relpath(path, top)
                if path.endswith(".cpp"):
                    name = os.path.basename(path).removesuffix(".cpp")
                    self.path_of_test[name] = path
                text = open(path, encoding="utf-8").read()
                for header in re.findall(r"#include <(CGAL/.*)>", text):
                    self.includers[header].add(name)
                for header in re.findall(r'#include "(.*)"', text):
                    beside = os.path.join(os.path.dirname(path), header)
                    header = beside if os.path.exists(beside) else os.path.join(tests, header)
                    self.includers[os.path.relpath(header, top)].add(name)

    def tests(self, header):
        """Returns levels of tests: that of the header, others that include it, and those that include it indirectly."""
        headers = {header, header.replace("_impl.h", ".h")}
        levels = [{"test_" + os.path.basename(h).removesuffix(".h") for h in headers} & set(self.path_of_test)]
        for _ in range(self.LEVELS):
            names = set().union(*(self.includers[h] for h in headers))
            levels.append({n for n in names if n in self.path_of_test} - set().union(*levels))
            headers = {n for n in names if n not in self.path_of_test}
        return levels

    def checksum(self, fault, test=None):
        """Returns a checksum of the data that determines whether a fault is detected, except other headers.

        The data are the fault's text, the code of its header, and of a test file, or of all that could detect it.
        """
        result = hashlib.sha256(fault.text.encode())
        paths = [os.path.join(ROOT, fault.file)]
        if fault.is_of_checker:
            paths += [os.path.join(f, n) for f, _, names in os.walk(os.path.join(ROOT, CHECKER)) for n in names if n.endswith((".h", ".cpp"))]
        elif test in self.path_of_test:
            paths.append(self.path_of_test[test])
        else:
            paths += [self.path_of_test[n] for level in self.tests(fault.file.removeprefix("include/")) for n in level]
        for path in sorted(paths):
            result.update(code(open(path, encoding="utf-8").read()))
        return result.hexdigest()


def code(text):
    """Returns the code without comments and white space, which do not affect answers."""
    return re.sub(r"//.*|/\*.*?\*/|\s+", "", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)).encode()


class Fault:
    def __init__(self, number, name, file):
        self.number, self.name, self.file = number, name, file
        self.lines, self.replacement, self.argument = [], None, None

    @property
    def is_of_checker(self):
        return self.file.startswith(CHECKER)

    @property
    def text(self):
        return "\n".join([self.file, *self.lines, self.replacement])


def fail(message):
    print(message, file=sys.stderr)
    sys.exit(2)


def read_list(path):
    faults, file, fault = [], None, None
    for number, line in enumerate(open(path, encoding="utf-8"), 1):
        stripped = line.strip()
        if not stripped:
            fault = None
        elif line[0] == "#":
            pass
        elif line[0] == "[":
            name = stripped[1:-1]
            file = (CHECKER if name.startswith("check_certificate/") else HEADERS) + name
        elif line[0] != " ":
            fault = Fault(len(faults) + 1, stripped, file)
            faults.append(fault)
        elif fault is None:
            fail(f"{path}:{number}: a fault begins with its name, at the beginning of a line")
        elif stripped.startswith("->") and fault.replacement is None:
            fault.replacement = stripped[2:].strip()
        elif stripped.startswith("equivalent:"):
            fault.argument = stripped[len("equivalent:"):].strip()
        elif fault.argument is not None:
            fault.argument += " " + stripped
        elif fault.replacement is not None:
            fault.replacement += " " + stripped
        else:
            fault.lines.append(stripped)
    names = set()
    for fault in faults:
        if fault.replacement is None or " ".join(fault.lines).count("⟦") != 1:
            fail(f"{fault.name}: no line with ⟦what is changed⟧ and -> what it is changed into")
        if fault.name in names:
            fail(f"{fault.name}: two faults have this name")
        names.add(fault.name)
    return faults


def pattern(text):
    """Returns a pattern that matches the text with any white space."""
    return r"\s*".join(re.escape(character) for character in "".join(text.split()))


class Place:
    """A part of a source file, with its replacements for some faults."""

    def __init__(self, begin, end):
        self.begin, self.end, self.faults, self.inner = begin, end, [], []


def find(fault, text):
    before, rest = " ".join(fault.lines).split("⟦")
    changed, after = rest.split("⟧")
    before, changed, after = (pattern(part) for part in (before, changed, after))
    expression = rf"{before}\s*({changed})\s*{after}"
    found = list(re.finditer(expression, text))
    if len(found) != 1:
        fail(f"{fault.name}: its place is found {len(found)} times in {fault.file}")
    return found[0].span(1)


def render(text, begin, end, places):
    """Returns the text with all faults of all places planted."""
    result = ""
    for place in places:
        result += text[begin:place.begin]
        inner = render(text, place.begin, place.end, place.inner)
        statement = inner.rstrip().endswith(";") or not inner.strip()
        if statement:
            if re.match(r"(?!return\b)[\w:]+(<.*>)?[\s&*]+\w+\s*[({=;]", inner.strip()):
                fail(f"{place.faults[0].name}: what is declared would end with the braces; mark a part of the declaration")
            result += "{ " + "".join(f"if(planted({fault.number})) {{ {fault.replacement} }} else " for fault in place.faults) + f"{{ {inner} }} }}"
        else:
            if re.match(r"(return|if|for|while)\b", inner.strip()):
                fail(f"{place.faults[0].name}: mark an expression, or a statement with its semicolon")
            result += "(" + "".join(f"planted({fault.number}) ? ({fault.replacement}) : " for fault in place.faults) + f"({inner}))"
        begin = place.end
    return result + text[begin:end]


def plant(file, faults):
    text = open(os.path.join(ROOT, file), encoding="utf-8").read()
    places = {}
    for fault in faults:
        span = find(fault, text)
        places.setdefault(span, Place(*span)).faults.append(fault)
    outer, open_places = [], []
    for place in sorted(places.values(), key=lambda p: (p.begin, -p.end)):
        while open_places and open_places[-1].end <= place.begin:
            open_places.pop()
        if open_places and place.end > open_places[-1].end:
            fail(f"{place.faults[0].name}: overlaps {open_places[-1].faults[0].name}")
        (open_places[-1].inner if open_places else outer).append(place)
        if place.begin < place.end:
            open_places.append(place)
    return render(text, 0, len(text), outer)


def write(path, text):
    """Writes a file unless it is up to date, so that it is not compiled again."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    if not os.path.exists(path) or open(path, encoding="utf-8").read() != text:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


def plant_all(faults, source):
    """Plants all faults, and returns a checksum of the sources without faults."""
    checksum = hashlib.sha256()
    by_file = {}
    for fault in faults:
        by_file.setdefault(fault.file, []).append(fault)
    wanted = {"planted_fault.h"}
    write(os.path.join(source, "planted_fault.h"), SWITCH)
    for top in ("CMakeLists.txt", "cmake", "include", "src", "test", "benchmark"):
        top = os.path.join(ROOT, top)
        for path in [top] if os.path.isfile(top) else sorted(os.path.join(f, n) for f, _, names in os.walk(top) for n in names):
            name = os.path.relpath(path, ROOT)
            if name.endswith((".h", ".cpp", ".txt", ".cmake", "_test.py")) and not path.startswith(HERE):
                checksum.update(open(path, "rb").read())
            wanted.add(name)
            if name in by_file:
                write(os.path.join(source, name), plant(name, by_file.pop(name)))
            elif not name.endswith(".pyc"):
                write(os.path.join(source, name), open(path, encoding="utf-8").read())
    for file in by_file:
        fail(f"{file} does not exist")
    for folder, _, names in os.walk(source):
        for name in names:
            if os.path.relpath(os.path.join(folder, name), source) not in wanted:
                os.remove(os.path.join(folder, name))
    return checksum.hexdigest()


def run(command, **options):
    done = subprocess.run(command, **options)
    if done.returncode != 0:
        fail(f"{' '.join(command)} failed")


def build(source, build_folder, jobs):
    # Assertions are off; proofs do not depend on them.
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DBUILD_TESTING=ON", "-DBSPLINE_SHELL_3_EXAMPLES=OFF", "-DBSPLINE_SHELL_3_TOOL=OFF",
               "-DBSPLINE_SHELL_3_BENCHMARKS=ON", "-DCMAKE_DISABLE_FIND_PACKAGE_Doxygen=ON", "-DCMAKE_CXX_FLAGS=-include " + os.path.join(source, "planted_fault.h")]
    if shutil.which("ccache"):
        options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
    run(["cmake", "-S", source, "-B", build_folder, "-G", "Ninja", "-Wno-dev", *options], stdout=subprocess.DEVNULL)
    run(["cmake", "--build", build_folder, "--parallel", str(jobs), "--target", "proof_tests", "check_certificate", "check_certificate_arithmetic",
         "certify_meshes", "write_certificates", "--", "-k", "0"])


class Tests:
    """Runs one of the two sets of tests.

    Time limits are in processor time, which does not depend on other load. A wall-clock time of ten times the limit is
    treated as a deadlock.
    """

    def __init__(self, command, name_of_test):
        self.command, self.name_of_test = command, name_of_test

    def run(self, number, only=(), seconds=None):
        """Returns the name of a test that fails, or None, and the output."""
        environment = dict(os.environ, PLANTED_FAULT=str(number))
        command = [*(["prlimit", f"--cpu={seconds:.0f}"] if seconds else []), *self.command, *only]
        process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                                   start_new_session=True)
        try:
            output, _ = process.communicate(timeout=seconds and 10 * seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            output, _ = process.communicate()
            return f"{self.last_test(output)} (not in time)", output
        late = " (not in time)" if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL) else ""
        return self.last_test(output) + late if process.returncode != 0 else None, output

    def last_test(self, output):
        names = re.findall(self.name_of_test, output)
        return xml.sax.saxutils.unescape(names[-1], {"&quot;": '"'}) if names else "no test in particular"


class Package_tests(Tests):
    def __init__(self, build_folder, sources):
        super().__init__([os.path.join(build_folder, "test", "Bspline_shell_3", "proof_tests"), "--abort", "-r", "xml", "-d", "yes",
                          "--filenames-as-tags"], r'<TestCase name="([^"]*)"')
        self.sources = sources

    def learn(self, output):
        """Determines the time of each test and each test file from the output."""
        self.seconds, self.file = collections.defaultdict(float), {}
        for name, file, seconds in re.findall(r'<TestCase name="([^"]*)"[^>]*filename="[^"]*?(\w+)\.cpp".*?<OverallResult success=[^>]*durationInSeconds="([^"]*)"',
                                              output, re.DOTALL):
            name = xml.sax.saxutils.unescape(name, {"&quot;": '"'})
            self.file[name] = file
            for key in (name, file, ""):
                self.seconds[key] += float(seconds)

    def attempts(self, fault, seen_by, is_all):
        """Yields arguments that select tests, with their usual time in seconds."""
        if seen_by in self.seconds:
            yield [re.sub(r"([,\[\\])", r"\\\1", seen_by)], self.seconds[seen_by]
        for level in self.sources.tests(fault.file.removeprefix("include/")):
            files = sorted(level & set(self.seconds), key=self.seconds.get)
            if files:
                yield [",".join(f"[#{f}]" for f in files)], sum(self.seconds[f] for f in files)
        if is_all:
            yield [], self.seconds[""]


class Checker_tests(Tests):
    LARGE = "eight|blob-closed"

    def __init__(self, build_folder):
        super().__init__(["ctest", "--test-dir", build_folder, "-FS", ".", "--stop-on-failure"], r"Start +\d+: (\S+)")
        self.all = ["-R", "^check_certificate_"]

    def learn(self, output):
        self.seconds = {name: float(seconds) for name, seconds in re.findall(r": (check_certificate_\S+) \.+ +Passed +([0-9.]+) sec", output)}

    def attempts(self, fault, seen_by, is_all):
        if seen_by in self.seconds:
            yield ["-R", f"^{seen_by}$"], self.seconds[seen_by]
        yield [*self.all, "-E", self.LARGE], sum(self.seconds.values())
        if is_all:
            yield ["-R", self.LARGE, "-E", "^write|^changes"], sum(self.seconds.values())


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("words", nargs="*")
    parser.add_argument("--work", default=os.path.join(ROOT, "build", "planted_faults"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list", default=os.path.join(HERE, "faults.txt"))
    parser.add_argument("--part", default="1/1")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--dry", action="store_true")
    arguments = parser.parse_args()
    work = os.path.abspath(arguments.work)
    source, build_folder = os.path.join(work, "source"), os.path.join(work, "build")

    faults = read_list(arguments.list)
    checksum = plant_all(faults, source)
    print(f"{len(faults)} faults are planted", flush=True)
    if arguments.dry:
        return 0
    chosen = [f for f in faults if not arguments.words or any(w.lower() in (f.name + " " + f.file).lower() for w in arguments.words)]
    part, parts = map(int, arguments.part.split("/"))
    chosen = chosen[part - 1::parts]

    memory = os.path.join(work, "found.json")
    found = json.load(open(memory)) if os.path.exists(memory) else {}

    def remember(name, entry):
        found[name] = entry
        with open(memory + ".new", "w") as out:
            json.dump(found, out, indent=1)
        os.replace(memory + ".new", memory)

    sources = Sources()

    def is_known(fault):
        known = found.get(fault.name, {})
        return known.get("sources") == sources.checksum(fault, known.get("file")) and (known["seen"] or known["all"] or not arguments.all)

    unknown = [f for f in chosen if not is_known(f)]
    sets = {}
    if unknown:
        build(source, build_folder, arguments.jobs)
        sets = {False: Package_tests(build_folder, sources), True: Checker_tests(build_folder)}
        if any(f.is_of_checker for f in unknown):
            run(["ctest", "--test-dir", build_folder, "-R", "^write_certificate"], stdout=subprocess.DEVNULL)
    for is_of_checker in sorted({f.is_of_checker for f in unknown}):
        key, tests = ("check_certificate" if is_of_checker else "package"), sets[is_of_checker]
        passed = found.get(key, {})
        if passed.get("sources") != checksum:
            start = time.time()
            failed, output = tests.run(0, tests.all if is_of_checker else [])
            if failed:
                fail(f"{failed} fails without a fault")
            passed = {"sources": checksum, "output": "\n".join(re.findall(r".*(?:<TestCase|<OverallResult|Passed).*", output))}
            remember(key, passed)
            print(f"without a fault all tests pass, in {time.time() - start:.0f} s", flush=True)
        tests.learn(passed["output"])

    def examine(fault):
        start, last = time.time(), found.get(fault.name, {})
        if is_known(fault):
            return fault, last
        seen = None
        for only, seconds in sets[fault.is_of_checker].attempts(fault, last.get("by"), arguments.all):
            seen, _ = sets[fault.is_of_checker].run(fault.number, only, 10 + 5 * seconds)
            if seen:
                break
        by = seen.removesuffix(" (not in time)") if seen else None
        file = None if fault.is_of_checker else sets[False].file.get(by)
        return fault, {"sources": sources.checksum(fault, file), "seen": seen, "by": by, "file": file,
                       "all": arguments.all, "time": round(time.time() - start, 1)}

    start, file, survivors, argued, mistaken = time.time(), None, [], [], []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for task in concurrent.futures.as_completed([pool.submit(examine, fault) for fault in unknown]):
            fault, result = task.result()
            remember(fault.name, result)
            print(f"{result['time']:6.1f} s  {fault.name}", flush=True)
    for fault in chosen:
        if fault.file != file:
            file = fault.file
            print(f"\n{file}")
        seen = found[fault.name]["seen"]
        if seen:
            print(f"  {fault.name}\n      seen by {seen}" + (", although it is argued to change no answer" if fault.argument else ""))
            mistaken += [fault] * bool(fault.argument)
        else:
            print(f"  {fault.name}\n      {'changes no answer: ' + fault.argument if fault.argument else 'NOT SEEN'}")
            (argued if fault.argument else survivors).append(fault)
    print(f"\n{len(chosen)} faults planted, {len(chosen) - len(argued) - len(survivors)} seen, {len(argued)} argued to change no answer, "
          f"{len(survivors)} not seen; {time.time() - start:.0f} s")
    for fault in survivors:
        print(f"  not seen: {fault.name} ({os.path.basename(fault.file)})")
    for fault in mistaken:
        print(f"  seen, although argued: {fault.name}")
    return 1 if survivors or mistaken else 0


if __name__ == "__main__":
    sys.exit(main())
