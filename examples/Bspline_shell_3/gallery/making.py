"""Runs the programs of one figure and draws what they write, with a line of progress for each step."""
import json
import os
import shutil
import subprocess
import time
from pathlib import Path

from paths import BUILD, RESULTS, ROOT

MAX_SECONDS = 300       # of a program


class Failure(Exception):
    """Has a sentence for the page."""


class Making:
    """All is written into `folder`, which gets the name of the figure when it is complete."""

    def __init__(self, name):
        self.name = name
        self.folder = RESULTS / f"{name}.part"
        self.commands = []          # and the seconds of each
        self.step = ""              # its line of progress has no end yet

    def run(self, program, *arguments, folder="."):
        """What the program prints. It runs in a folder of its own, if one is named."""
        if not (BUILD / program).exists():
            raise Failure(f"{program} was not built; {BUILD.relative_to(ROOT)}/build.log says why.")
        return self._run([BUILD / program, *arguments], folder)

    def script(self, path, *arguments):
        return self._run(["python3", path, *arguments], ".")

    def draw(self, function, *arguments):
        """The last argument is the picture's name."""
        self._start(f"drawing {arguments[-1]}")
        start = time.monotonic()
        function(*(str(a) if isinstance(a, Path) else a for a in arguments[:-1]), str(self.folder / arguments[-1]))
        self._end(start)

    def _run(self, command, folder):
        command = [c if isinstance(c, Path) else str(c) for c in command]
        self._start(" ".join(c.name if isinstance(c, Path) else c for c in command))
        (self.folder / folder).mkdir(exist_ok=True)
        start = time.monotonic()
        try:
            done = subprocess.run(command, cwd=self.folder / folder, capture_output=True, text=True, timeout=MAX_SECONDS, check=False)
        except subprocess.TimeoutExpired:
            raise Failure(f"{Path(command[0]).name} took longer than {MAX_SECONDS} s.") from None
        if done.returncode != 0:
            said = (done.stderr.strip() or done.stdout.strip() or f"It ended with {done.returncode}.").splitlines()[-1]
            raise Failure(f"{Path(command[0]).name}: {said.removeprefix(f'{Path(command[0]).name}: ')}")
        shown = " ".join(os.path.relpath(c, ROOT).replace(".part/", "/") if isinstance(c, Path) else c for c in command)
        self.commands.append((shown, self._end(start)))
        return done.stdout

    def _start(self, step):
        self.step = f"{self.name}: {step} ... "
        print(self.step, end="", flush=True)

    def _end(self, start):
        seconds = time.monotonic() - start
        print(f"{seconds:.1f} s", flush=True)
        self.step = ""
        return seconds


def write(path, text):
    """Completely or not at all."""
    part = Path(f"{path}.part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


def make(figure):
    """Whether the figure was made. If not, its unfinished folder has the sentence why."""
    making = Making(figure.name)
    shutil.rmtree(making.folder, ignore_errors=True)
    making.folder.mkdir(parents=True)
    start = time.monotonic()
    try:
        results = figure.make(making)
    except (Exception, SystemExit) as error:        # functions that draw end with SystemExit if a file is missing
        sentence = str(error) if isinstance(error, (Failure, SystemExit)) else f"{type(error).__name__}: {error}"
        print(f"{'' if making.step else figure.name + ': '}failed. {sentence}", flush=True)
        write(making.folder / "failure.txt", sentence)
        return False
    write(making.folder / "figure.json", json.dumps({**results._asdict(), "commands": making.commands, "seconds": time.monotonic() - start}))
    shutil.rmtree(RESULTS / figure.name, ignore_errors=True)
    making.folder.rename(RESULTS / figure.name)
    return True
