"""What is found in figures, and how it is said."""
import re
from collections import namedtuple

from making import Failure

# `headline`: what is measured, and of what. `pictures`: (file, caption). `rows` of a table: (what, the paper, lines that say what was found here).
Results = namedtuple("Results", "headline pictures rows")

NOT_GIVEN = "not given"


def parsed(pattern, text):
    found = re.search(pattern, text)
    if not found:
        raise Failure(f"The output of a program has changed: there is no “{pattern}” in it.")
    return found.groups()


def count(number):
    return f"{int(number):,}".replace(",", "\u202f")


def percent(number):
    return f"{float(number):.2g}\u202f%"
