"""Runs the programs of one figure and draws their output; prints a line of progress for each step."""
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

from paths import BUILD, HERE, RESULTS, ROOT

MAX_SECONDS = 300       # per program
ATTEMPTS = 2            # per picture


class Failure(Exception):
    """A failure, with a sentence for the page."""


def last_line(done):
    """Returns the last line of the output of a process."""
    return (done.stderr.strip() or done.stdout.strip() or f"The program ended with exit code {done.returncode}.").splitlines()[-1]


class Making:
    """Generates a figure in `folder`, which is renamed to the name of the figure when it is complete."""

    def __init__(self, name):
        self.name = name
        self.folder = RESULTS / f"{name}.part"
        self.commands = []          # pairs of a command and its seconds
        self.step = ""              # set while a line of progress is unfinished

    def run(self, program, *arguments, folder="."):
        """Runs a program, in a separate folder if one is given, and returns its output."""
        if not (BUILD / program).exists():
            raise Failure(f"{program} was not built: see {BUILD.relative_to(ROOT)}/build.log.")
        return self._run([BUILD / program, *arguments], folder)

    def script(self, path, *arguments):
        return self._run(["python3", path, *arguments], ".")

    def draw(self, function, *arguments):
        """Draws a picture; its name is the last argument.

        VTK requires an X server. If it loses the server, the process ends, and another attempt is made.
        """
        *others, picture = arguments
        self._start(f"drawing {picture}")
        start = time.monotonic()
        command = ["xvfb-run", "-a", sys.executable, f"{HERE}/drawing.py", function, json.dumps([*others, self.folder / picture], default=str)]
        for _ in range(ATTEMPTS):
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode == 0:
                self._end(start)
                return
        raise Failure(f"{picture} could not be drawn: {last_line(done)}")

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
            name = Path(command[0]).name
            raise Failure(f"{name}: {last_line(done).removeprefix(f'{name}: ')}")
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
    """Writes a complete file, or no file."""
    part = Path(f"{path}.part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


def make(figure):
    """Generates a figure, and returns whether this succeeded. Otherwise, its incomplete folder contains the reason."""
    making = Making(figure.name)
    shutil.rmtree(making.folder, ignore_errors=True)
    making.folder.mkdir(parents=True)
    start = time.monotonic()
    try:
        results = figure.make(making)
    except Exception as error:      # an error must not affect other figures
        sentence = str(error) if isinstance(error, Failure) else f"{type(error).__name__}: {error}"
        print(f"{'' if making.step else figure.name + ': '}failed: {sentence}", flush=True)
        write(making.folder / "failure.txt", sentence)
        return False
    write(making.folder / "figure.json", json.dumps({**results._asdict(), "commands": making.commands, "seconds": time.monotonic() - start}))
    shutil.rmtree(RESULTS / figure.name, ignore_errors=True)
    making.folder.rename(RESULTS / figure.name)
    return True
