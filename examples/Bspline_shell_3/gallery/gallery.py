#!/usr/bin/python3
"""Generates figures of the gallery, and the page that shows them. examples/gallery.sh runs this script.

Usage: gallery.py pending [--again] [FIGURE...]     lists incomplete figures (default: of all), one per line
       gallery.py programs FIGURE...                lists the programs that these figures need
       gallery.py make FIGURE                       generates a figure, and writes the page
       gallery.py page                              writes results/gallery/index.html
"""
import shutil
import sys

from figures import FIGURES
from making import make
from page import is_complete, write_page
from paths import RESULTS


def chosen(names):
    unknown = set(names) - {f.name for f in FIGURES}
    if unknown:
        sys.exit(f"There is no figure {', '.join(sorted(unknown))}. Choose from: {' '.join(f.name for f in FIGURES)}")
    return [f for f in FIGURES if not names or f.name in names]


def main(what="", *arguments):
    if what == "pending":
        figures = chosen([a for a in arguments if a != "--again"])
        if "--again" in arguments:
            for figure in figures:
                shutil.rmtree(RESULTS / figure.name, ignore_errors=True)
        for figure in figures:
            if not is_complete(figure):
                print(figure.name)
    elif what == "programs":
        for program in sorted({p for f in chosen(arguments) for p in f.programs}):
            print(program)
    elif what == "make" and len(arguments) == 1:
        made = make(*chosen(arguments))
        write_page()
        return 0 if made else 1
    elif what == "page":
        write_page()
    else:
        sys.exit(__doc__)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
