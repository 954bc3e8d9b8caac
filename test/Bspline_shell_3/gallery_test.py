"""Makes figures of the gallery without drawing: runs programs, parses their output, and checks that drawn files exist.

Usage: gallery_test.py GALLERY MESHES PROGRAM...     (GALLERY: the folder of its scripts; MESHES: that of CGAL's meshes)

Makes the figures for which all programs are given.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
gallery, meshes = map(Path, sys.argv[1:3])
programs = {Path(p).name: p for p in sys.argv[3:]}
sys.path.insert(0, str(gallery))
import figures      # noqa: E402  (needs the path)


class Making:
    """Replaces the gallery's class, which also draws."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.pictures = []

    def run(self, program, *arguments, folder="."):
        (self.folder / folder).mkdir(exist_ok=True)
        done = subprocess.run([programs[program], *map(str, arguments)], cwd=self.folder / folder, capture_output=True,
                              text=True, check=False)
        assert done.returncode == 0, (done.args, done.returncode, done.stdout, done.stderr)
        return done.stdout

    def draw(self, _, *arguments):
        *data, picture = arguments
        for prefix in self.prefixes(data):
            for surface in "inner", "outer":
                file = Path(f"{prefix}_{surface}.ply")
                assert file.stat().st_size > 0, file
        self.pictures.append(picture)

    def prefixes(self, data):
        """Yields the paths in arguments of a drawing: prefixes of files that a program wrote."""
        if isinstance(data, (list, tuple)):
            for part in data:
                yield from self.prefixes(part)
        elif str(data).startswith(str(self.folder)):
            yield data


figures.MESHES = meshes
chosen = [f for f in figures.FIGURES if set(f.programs) <= set(programs)]
assert chosen, programs
for figure in chosen:
    with tempfile.TemporaryDirectory() as folder:
        making = Making(folder)
        results = figure.make(making)
        assert [name for name, _ in results.pictures] == making.pictures, (results.pictures, making.pictures)
        assert all((making.folder / file).is_file() for file, _ in results.pages), results.pages
        print(figure.name, results.headline)
