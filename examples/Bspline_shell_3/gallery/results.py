"""Results of figures, and their formatting."""
import re
from collections import namedtuple

from making import Failure

# `headline`: (number, description). `pictures`: (file, caption). `rows` of the table: (quantity, value in the paper,
# lines with our results). `pages` to turn the meshes in a browser: (file, text).
Results = namedtuple("Results", "headline pictures rows pages", defaults=((),))

NOT_GIVEN = "not given"


def parsed(pattern, text):
    found = re.search(pattern, text)
    if not found:
        raise Failure(f"The output of a program has changed: it does not match “{pattern}”.")
    return found.groups()


def count(number):
    return f"{int(number):,}".replace(",", "\u202f")


def percent(number):
    return f"{float(number):.2g}\u202f%"
