"""Loads about 1000 times too large or small have a warning; those of rigs and of models at 1:50 have none."""

import math

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.model.unusual_loads import unusual_loads
from riserstudy.model.warnings_of_scene import warnings_of
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile

STEEP = math.radians(75.0)  # of a platform


def loads(seed, scale=1.0):
    """Size of each load at a place on earth, or for its model (SI)."""
    draw = np.random.default_rng(seed)
    period = float(draw.uniform(5.0, 20.0))
    sizes = {"height": float(draw.uniform(0.002, 0.04)) * 1.56 * period**2 / scale}
    root = math.sqrt(scale)
    sizes |= {"period": period / root, "current": float(draw.uniform(0.1, 2.5)) / root}
    return sizes | {"surge": float(draw.uniform(0.1, 5.0)), "heave": float(draw.uniform(0.1, 3.0))}


def said(seed, *, wave=True, platform=None, **sizes):
    """Warnings about the loads of a rig on inclined cylinders, which are also among all of the scene's."""
    tree = written(rig(seed, spatial=bool(seed % 2)))
    tree["current"]["profile"]["surface_speed"] = f"{sizes['current']!r} m/s"
    kind = "significant_height" if seed % 3 else "height"
    sea = {kind: f"{sizes['height']!r} m", "peak_period" if seed % 3 else "period": f"{sizes['period']!r} s"}
    sea |= {"peak_enhancement": 2, "components": 10, "seed": 1} if seed % 3 else {}
    rows = [
        {"period": f"{t * sizes['period']!r} s"}
        | {name: f"{sizes[name] * share!r} m/m" for name in ("surge", "heave")}
        | {"surge_phase": "0 deg", "heave_phase": "90 deg"}
        for t, share in ((0.2, 0.0), (1.0, 0.4), (4.0, 1.0))
    ]
    response = {"operators": rows, "phases": "lead", "beyond": "hold", "ramp": "30 s", "wave": sea}
    tree["platform"] |= {"response": response} if wave else platform
    tree["analysis"] = {"duration": "4000 s", "output": {"interval": "0.02 s"}, "accuracy": "5 %"}
    scene = SceneFile("rig.yaml", tree).resolved()
    found = sentences(unusual_loads(scene))
    assert set(found) <= set(sentences(warnings_of(scene)))
    return found


@pytest.mark.parametrize("scale", [1.0, 50.0])
@pytest.mark.parametrize("seed", range(12))
def test_loads_of_rigs_and_of_models_have_no_warning(seed, scale):
    assert said(seed, **loads(seed, scale)) == []


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("factor", [1e3, 1e-3])
@pytest.mark.parametrize(
    "names, where",
    [
        (("height",), "platform.response.wave: a "),
        (("current",), "current.profile: "),
        (("surge", "heave"), "platform.response.operators: "),
        (("period",), "platform.response.wave: "),
    ],
)
def test_a_slip_of_a_thousand_has_a_warning(seed, factor, names, where):
    """Strong currents and large motions have none where a thousandth of them is a small one of a model."""
    if factor > 1.0 and names == ("height",):
        seed += seed % 3 == 0  # high regular waves have the warning of waves that break
    sizes = loads(seed)
    if factor < 1.0:
        sizes |= {"current": min(sizes["current"], 0.4), "surge": min(sizes["surge"], 0.9)}
        sizes["heave"] = min(sizes["heave"], 0.9)
    found = said(seed, **sizes | {name: factor * sizes[name] for name in names})
    assert len(found) == 1
    assert found[0].startswith(where)
    assert found[0].endswith("Check the unit")


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize(
    "motion, unit, usual, most",
    [("surge", "m", 10.0, 4000.0), ("heave", "m", 12.0, 60.0), ("roll", "rad", 0.5, STEEP),
     ("pitch", "rad", 0.5, STEEP)],
)  # fmt: skip
def test_motions_beyond_those_of_platforms_have_a_warning(seed, motion, unit, usual, most):
    """Harmonics, their sums and time series."""
    slow = {"period": "4000 s", "ramp": "4000 s"}
    for size, count in ((usual, 0), (1.01 * most, 1)):
        one = {"amplitude": f"{size!r} {unit}"} | slow
        other = {"amplitude": f"0.1 {unit}"} | slow
        points = [{"time": f"{1000 * k} s", "value": f"{(k % 2) * 2.0 * size!r} {unit}"} for k in range(5)]
        for value in (one, [other, one], {"points": points}):
            found = said(seed, wave=False, platform={motion: value}, **loads(seed))
            assert len(found) == count
            assert not count or found[0].startswith(f"platform.{motion}: an amplitude of ")


def test_winds_and_cruises_beyond_those_on_earth_have_a_warning():
    sizes = loads(1)
    cruise = {"cruise": {"speed": "50 m/s", "ramp": "100 s"}}
    (found,) = said(1, wave=False, platform=cruise, **sizes)
    assert found.startswith("platform.cruise.speed: 50 m/s")
