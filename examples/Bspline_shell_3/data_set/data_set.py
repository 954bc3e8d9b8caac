"""Describes a data set: meshes, their names and batches, and options."""
import hashlib
from collections import Counter
from pathlib import Path

FORMATS = {".ply", ".obj", ".off", ".stl", ".gltf", ".glb"}
DEFAULTS = {
    "program": str(Path(__file__).resolve().parents[3] / "build/data_set/tool/Bspline_shell_3/bspline_shell"),
    "facets": 0,                # target number of facets; 0: as few as the shell allows
    "time_limit": 300,          # seconds per mesh, without its picture; the program gets 80 %, and is killed at the end
    "memory_limit": 4000,       # megabytes per mesh; the shell gets two thirds
    "pictures": True,
    "keep": "mesh simplified places inner outer",       # PLY files; also: shell
    "batch": 20,                # meshes per job
}


def options(config):
    """Returns the options: those of the configuration, converted to the types of the defaults, and defaults for the others."""
    if not config.get("meshes"):
        raise ValueError("Pass a folder or a list of meshes: --config meshes=FOLDER")
    unknown = set(config) - set(DEFAULTS) - {"meshes"}
    if unknown:
        raise ValueError(f"Unknown option: {', '.join(sorted(unknown))}.")
    chosen = {**DEFAULTS, **config}
    for name in ("facets", "time_limit", "memory_limit", "batch"):
        chosen[name] = int(chosen[name])
        least = 0 if name == "facets" else 1
        if chosen[name] < least:
            raise ValueError(f"{name} must be at least {least}.")
    chosen["pictures"] = str(chosen["pictures"]).lower() in ("true", "1", "yes")
    return chosen


def files_of(meshes):
    """Returns all meshes in a folder and its subfolders, or those in a list: one per line, relative to the folder of the list."""
    meshes = Path(meshes).absolute()
    if meshes.is_dir():
        return sorted(path for path in meshes.rglob("*") if path.suffix.lower() in FORMATS and path.is_file())
    lines = (line.strip() for line in meshes.read_text(encoding="utf-8").splitlines())
    return list(dict.fromkeys(meshes.parent / line for line in lines if line and not line.startswith("#")))


def plain(text):
    """Replaces characters that are special in shells, snakemake or links."""
    return "".join(c if c.isalnum() or c in "-_+=" else "_" for c in text)


def name_of(path, stems):
    """Returns the name of the file. If it is not unique, appends the format and a checksum of the path."""
    if stems[plain(path.stem)] == 1:
        return plain(path.stem)
    return f"{plain(path.stem)}_{path.suffix[1:].lower()}_{hashlib.sha256(str(path).encode()).hexdigest()[:6]}"


def batches_of(files, size):
    """Returns lists of (name, file). Meshes are distributed by size, so that all batches take similar times."""
    stems = Counter(plain(path.stem) for path in files)
    by_size = sorted(files, key=lambda path: (-path.stat().st_size if path.exists() else 0, path))
    number = -(-len(files) // size)
    return [[(name_of(path, stems), path) for path in by_size[n::number]] for n in range(number)]


def state(file):
    """Returns data that changes if the file changes."""
    try:
        return [str(file), file.stat().st_size, file.stat().st_mtime_ns]
    except OSError:
        return [str(file)]


def checksum_of(batch):
    return hashlib.sha256(repr([(name, state(file)) for name, file in batch]).encode()).hexdigest()


def checksum(file):
    return hashlib.sha256(Path(file).read_bytes()).hexdigest()
