"""Paths of files, and search paths of modules."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
BUILD = ROOT / "build/gallery"
RESULTS = ROOT / "results/gallery"
MESHES = BUILD / "data/meshes"

sys.path += [f"{ROOT}/doc/Bspline_shell_3/figures", f"{ROOT}/examples/Bspline_shell_3"]
