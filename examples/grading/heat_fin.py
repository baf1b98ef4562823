"""Heat that flows through a straight fin: what the claims of ``heat_fin.yaml`` are checked against."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import xarray as xr
from scipy.linalg import solve_banded

from riserstudy.grading import alike, claim, grade_claims, more, read_claims

CELLS = 400


def heat(inputs: Mapping[str, object], *, tip: bool = True) -> float:
    """Heat a metre of width, per kelvin between root and air (W/(m K)), by finite volumes.

    ``tip``: whether the end of the fin cools, too.
    """
    thickness, length = 1e-3 * inputs["thickness"], 1e-3 * inputs["length"]
    h, k = inputs["transfer"], inputs["conductivity"]
    dx = length / CELLS
    conduct, cool = k * thickness / dx, 2.0 * h * dx
    diagonal = np.full(CELLS, 2.0 * conduct + cool)
    diagonal[0] += conduct  # half a cell to the root
    diagonal[-1] = conduct + cool
    if tip:
        diagonal[-1] += 1.0 / (1.0 / (h * thickness) + 0.5 * dx / (k * thickness))
    bands = np.zeros((3, CELLS))
    bands[0, 1:], bands[1], bands[2, :-1] = -conduct, diagonal, -conduct
    root = np.zeros(CELLS)
    root[0] = 2.0 * conduct
    first = solve_banded((1, 1), bands, root)[0]
    return float(2.0 * conduct * (1.0 - first))


def corrected_length(inputs, same):
    """Heat with a cooling tip is that of a longer fin with an insulated one; value: their ratio."""
    longer = {**inputs, "length": inputs["length"] + 0.5 * inputs["thickness"]}
    ratio = heat(longer, tip=False) / heat(inputs)
    return claim(ratio, alike(xr.DataArray(ratio), 1.0, same))


def _of_twice_the_length(inputs):
    return heat({**inputs, "length": 2.0 * inputs["length"]}) / heat(inputs)


def longer_gives_more(inputs, **words):
    """Twice the length gives more; value: ratio of the heats."""
    ratio = _of_twice_the_length(inputs)
    return claim(ratio, more(xr.DataArray(ratio), 1.0, words["more"]))


def in_proportion(inputs, same):
    """Twice the length gives twice as much; value: ratio of the heats."""
    ratio = _of_twice_the_length(inputs)
    return claim(ratio, alike(xr.DataArray(ratio), 2.0, same))


def efficiency(inputs):
    """Heat over that of a fin as warm as its root, tip included."""
    area = 1e-3 * (2.0 * inputs["length"] + inputs["thickness"])
    return heat(inputs) / (inputs["transfer"] * area)


CHECKS = {f.__name__: f for f in (corrected_length, longer_gives_more, in_proportion, efficiency)}
FILE = Path(__file__).with_suffix(".yaml")

if __name__ == "__main__":
    for graded in grade_claims(read_claims(FILE), CHECKS):
        print(graded.id, graded.verdict, graded.grounds.to_json())
