"""Common settings of the figures: colors, fonts, and saving of pictures."""
import io
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from PIL import Image

INNER, OUTER, MESH, OTHER_MESH = "#336bd9", "#d94033", "#1a1a1a", "#008c40"     # as in render_shell.py
SHELL, FACET, CURVE, FAILURE, CELL = "#f6e8d2", "#edebe6", "#e08a00", "#b000a0", "#b8bec8"

WIDTH = 900         # width of a picture, pixels
DPI = 100
SCALE = 1.5         # pixels of the file per pixel of the width, for displays with high resolution
plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 11, "axes.titlesize": 12, "mathtext.fontset": "dejavusans",
                     "axes.linewidth": 0.8, "lines.solid_capstyle": "round", "lines.solid_joinstyle": "round"})


def rgb(color):
    return tuple(int(color[i:i + 2], 16) / 255 for i in (1, 3, 5))


def figure(rows, columns, height, **options):
    return plt.subplots(rows, columns, figsize=(WIDTH / DPI, height / DPI), squeeze=False, **options)


def save(fig, name):
    """Saves a picture with few colors, so that the file is small."""
    data = io.BytesIO()
    fig.savefig(data, dpi=SCALE * DPI, facecolor="white")
    plt.close(fig)
    image = Image.open(data).convert("RGB").quantize(colors=256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    image.save(name + ".part", "PNG", optimize=True)
    os.replace(name + ".part", name)
