"""Titles and colours of Mao's figures state what drawn data show."""

from itertools import product

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_rgb

from chapters.mao_hangoff.figures.colours import OF_INPUT, ordered
from chapters.mao_hangoff.figures.limits import _slowest_and_fastest
from chapters.mao_hangoff.figures.towed_sweeps import _where_astern
from chapters.mao_hangoff.figures.trends import trends
from chapters.mao_hangoff.runs import STATED
from riserstudy.figures.figure_text import headline

RANGES = {
    "lmrp_mass": (120.0, 140.0),
    "current_speed": (1.0, 1.2),
    "platform_speed": (2.4, 2.6),
    "riser_length": (1200.0, 1800.0),
}
PROFILES = ["power 1/4", "layer"]
IN_BOTH = ("current_speed", "platform_speed")


@pytest.mark.parametrize("seed", range(5))
def test_a_shade_is_the_darker_the_larger_its_value(seed):
    random = np.random.default_rng(seed)
    values = random.permutation(np.cumsum(random.uniform(0.1, 1.0, random.integers(2, 7))))
    for colour in OF_INPUT.values():
        shades = dict(zip(values, ordered(colour, values), strict=True))
        light = [np.dot((0.2126, 0.7152, 0.0722), to_rgb(shades[v])) for v in sorted(values)]
        assert (np.diff(light) < 0.0).all()


@pytest.mark.parametrize("signs", list(product((-1.0, 1.0), repeat=3)))
@pytest.mark.parametrize("doubt", [None, 0.0, 45.0, 90.0])
def test_the_title_of_tracks_names_those_on_which_the_lmrp_is_ahead(signs, doubt):
    astern = {angle: (sign, 2.0 * sign) for angle, sign in zip((0.0, 45.0, 90.0), signs, strict=True)}
    if doubt is not None:  # both interpretations differ
        astern[doubt] = (-1.0, 1.0)
    said = _where_astern(astern)
    if doubt is not None or list(signs) != sorted(signs):
        assert "depends" in said
    elif len(set(signs)) == 1:
        assert ("ahead" in said) == (signs[0] < 0.0)
        assert "all three" in said
    else:
        last = {1: "0°", 2: "45°"}[signs.count(-1.0)]
        first = {1: "45°", 2: "90°"}[signs.count(-1.0)]
        assert said == f"Up to {last} the LMRP leads the platform; at {first} it trails"


def runs_of(axis, sensitivities):
    """Runs whose results change by so many per cent for 1 % of an input, by profile and result."""
    low, high = RANGES[axis]
    values = np.linspace(low, high, 3)
    share = 1.0 + np.asarray(sensitivities)[..., None] * (values / low - 1.0)
    over = {axis: values}
    if axis in IN_BOTH:
        over = {"current_profile": PROFILES, **over}
    x, moment, angle = (
        xr.DataArray(share[..., k, :], over, tuple(over)).expand_dims(at, axis=-1)
        for k, at in enumerate(({"time": [STATED]}, {"s": [0.0]}, {"time": [STATED]}))
    )
    return xr.Dataset({"lmrp_displacement": -50.0 * x, "bending_moment_size": 1e4 * moment,
                       "ufj_angle": -0.1 * angle})  # fmt: skip


@pytest.mark.parametrize("seed", range(12))
def test_the_title_of_trends_names_every_input_that_a_result_depends_on_most(seed):
    random = np.random.default_rng(seed)
    slopes = {}
    for axis in RANGES:
        size = (2, 3) if axis in IN_BOTH else (3,)
        slopes[axis] = random.uniform(-0.9, 0.9, size)
        if seed % 3 == 0 and axis == "platform_speed":
            slopes[axis] = random.uniform(2.0, 5.0, size)
    figure = trends(**{axis: runs_of(axis, of) for axis, of in slopes.items()})
    most = set()
    for profile, result in product(range(2), range(3)):
        here = {axis: abs(of[profile, result]) for axis, of in slopes.items() if axis in IN_BOTH}
        if profile == 1:
            here |= {a: abs(of[result]) for a, of in slopes.items() if a not in IN_BOTH}
        most.add(max(here, key=lambda axis: here[axis]))
    title = headline(figure)
    named = {axis for axis in RANGES if axis.replace("_", " ").replace("lmrp", "LMRP") in title}
    assert named == most
    assert ("by profile and result" in title) == (len(most) > 1)
    for ax in figure.axes[:3]:
        assert len([line for line in ax.lines if not line.get_label().startswith("_")]) == 2


@pytest.mark.parametrize("seed", range(12))
def test_the_title_of_speeds_gives_no_upper_limit_where_some_risers_reach_none(seed):
    draw = np.random.default_rng(seed)
    names = ["joint angle", "clearance", "stress"]
    governing = draw.choice([[-1.0, 0.0], [0.0, 2.0], [-1.0, -1.0], [1.0, 1.0]][seed % 4], 8)
    speed = np.where(governing < 0.0, 5.0, draw.uniform(1.0, 4.0, 8))
    runs = xr.Dataset({"speed_limit": ("riser", speed), "governing_limit": ("riser", governing)})
    said = _slowest_and_fastest(runs, names)
    for k, name in enumerate(names):
        assert (name in said) == (k in governing)
    bounded = (governing >= 0.0).all()
    assert ("between" in said) == bounded
    assert (f"{speed.max():.1f} kn" in said) == (bounded or (governing < 0.0).all())
    assert "grid" not in said
