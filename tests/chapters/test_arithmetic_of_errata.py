"""Numbers that errata work out of printed inputs, and that no simulation gives: worked out again."""

from math import pi, sqrt
from pathlib import Path

import pytest
import yaml
from scipy.optimize import brentq

CONFIG = Path(__file__).parents[2] / "config"
G, STEEL, SEA, INCH = 9.81, 7850.0, 1025.0, 0.0254


def circle(diameter):
    return 0.25 * pi * diameter**2


def text_of(paper, erratum):
    errata = yaml.safe_load((CONFIG / f"published/{paper}.yaml").read_text("utf-8"))["errata"]
    found = next(one for one in errata if one["id"] == erratum)
    return " ".join([found["reading"], found.get("simulation", "")])


def chang2020():
    """Four cylinders with a gas volume of 3.2 m3 at 190.2 bar each, on a bore of 470 mm."""
    area, volume, pressure, mass, stiffness, damping = (circle(0.47), 3.2, 190.2e5, 749e3, 3.43e6, 4 * 967.0)

    def pull(x):
        return 4.0 * pressure * area * (volume / (volume + area * x)) ** 1.4

    rest = brentq(lambda x: pull(x) - mass * G - stiffness * x, 0.0, 5.0)
    gas = 1.4 * pull(rest) * area / (volume + area * rest)
    ratio = damping / (2.0 * sqrt((stiffness + gas) * mass))
    yield "E3", f"the gas volume becomes zero at a piston displacement of {-volume / 0.47:.1f} m"
    shared = -volume / (4.0 * area)
    yield "E3", f"bottle, the gas volume becomes zero at a piston displacement of {shared:.1f} m"
    yield "E4", f"damping reduces to 37 % in {2.0 * mass / damping:.0f} s"
    yield "E5", f"which gives a damping ratio of {100.0 * ratio:.1f} %"
    yield "E5", f"would require a damping coefficient that is {0.05 / ratio:.0f} times as large"
    yield ("E15", f"four pistons is {4.0 * 2510.0 / mass:.1%}".replace("%", " %") + " of the riser's mass")


def liu2020():
    """Joints of 15.24 m with buoyancy, 21 in by 1 in; six cylinders by Eq. 11."""
    joint, dry, buoyed, bore = 15.24, 15334.0, circle(1.22), circle(19 * INCH)
    moved, filled = dry / joint + SEA * buoyed, dry / joint + SEA * (buoyed + bore)
    yield "E9", f"with added mass, is {moved:.0f} kg/m"
    yield (
        "E9",
        f"to {filled:.0f} kg/m and lengthen the lateral periods by {100 * (sqrt(filled / moved) - 1):.0f} %",
    )
    flooded, empty = dry - SEA * joint * (buoyed - bore), dry - SEA * joint * buoyed
    yield "E9", f"a joint has {flooded:.0f} kg in water if it is flooded, and {empty:.0f} kg if it is empty"
    annulus, piston = circle(0.56) - circle(0.23), circle(0.56)

    def pull(shorter):
        high = 2.08e6 * (9.38 / (9.38 + annulus * shorter)) ** 1.4
        low = 0.15e6 * (2.25 / (2.25 - piston * shorter)) ** 1.4
        return 6.0 * (high * annulus - low * piston) / G / 1e3 - 6.05

    yield "E14", f"pull {pull(0.0):.1f} t at mid-stroke"
    yield "E14", f"is zero at a stroke of {brentq(pull, 0.0, 7.5):.2f} m in compression"
    yield "E14", f"At a stroke of 7.5 m in compression the cylinders push with {-pull(7.5):.1f} t"
    yield "E14", f"compressed to {100 * (1.0 - piston * 7.5 / 2.25):.0f} % of its volume"


def liu2017():
    """A pipe of 21 in and 7/8 in, 1327 m long."""
    outer = 21 * INCH
    steel = circle(outer) - circle(outer - 1.75 * INCH)
    yield "E1", f"requires {steel * (STEEL - SEA) * G * 1327.0 / 1e6:.2f} MN of top tension"
    inner = (outer**4 - 64.0 * 0.0012 / pi) ** 0.25
    yield "E2", f"I = 0.0012 m4 has {STEEL * (circle(outer) - circle(inner)):.0f} kg/m"


def mao_hangoff():
    """439 kg over a joint of 23.7 m, beside a flooded pipe of 21 in and 1 in."""
    light = 439.0 / 23.7
    pipe = (STEEL - SEA) * (circle(21 * INCH) - circle(19 * INCH))
    fraction = {15: "fifteenth"}[round(pipe / light)]
    yield "E16", f"is {light:.1f} kg/m. A weight of {light:.1f} kg/m is a {fraction} of"


@pytest.mark.parametrize("paper", [chang2020, liu2020, liu2017, mao_hangoff], ids=lambda p: p.__name__)
def test_numbers_from_printed_inputs_are_worked_out_right(paper):
    for erratum, words in paper():
        assert words in text_of(paper.__name__, erratum), (erratum, words)
