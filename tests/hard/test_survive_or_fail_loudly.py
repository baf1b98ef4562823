"""Runs that are asked too much either work or stop with time, node, effect and remedy; never NaN."""

import json

import numpy as np
import pytest
from scenes import from_file

from riserstudy import simulate
from riserstudy.errors import SimulationError

CHANG = "chang2020/heave"
ONE = {"analysis__accuracy": None, "analysis__mesh": {"elements": 1}}
FORTY = {"analysis__mesh": {"elements": 40}}
STOPS = {"shortest": "-7 m", "longest": "7 m", "stop_stiffness": "1e9 N/m"}

HARD = {
    "gas volume overshot": (CHANG, {"platform__heave__amplitude": "40 m", "analysis__step": "1 s"} | ONE),
    "gas volume overshot, step chosen": (CHANG, {"platform__heave__amplitude": "40 m"}),
    "heave faster than the step": (
        CHANG,
        {
            "platform__heave__amplitude": "40 m",
            "platform__heave__period": "2 s",
            "analysis__step": "1 s",
        }
        | ONE,
    ),
    "stops hit": (
        CHANG,
        {
            "platform__heave__amplitude": "20 m",
            "top__tensioners__stroke": STOPS,
            "analysis__step": "0.5 s",
        }
        | ONE,
    ),
    "surge of 1500 m": (
        "bench/s2",
        {"platform__surge__amplitude": "1500 m", "analysis__step": "3.75 s"} | FORTY,
    ),
    "surge of 400 m, held": (
        "bench/s2c",
        {"platform__surge__amplitude": "400 m", "analysis__step": "2 s"} | FORTY,
    ),
    "surge without ramp": ("bench/s2", {"platform__surge__ramp": None, "analysis__step": "0.1 s"} | FORTY),
    "step of 10 s": ("bench/s2", {"analysis__step": "10 s"} | FORTY),
    "heave of 200 m": (
        "bench/s3",
        {"platform__heave__amplitude": "200 m", "analysis__step": "0.5 s"} | FORTY,
    ),
}  # fmt: skip
#: all others run to their end
MAY_BE_REFUSED = {"heave faster than the step", "stops hit", "surge of 1500 m", "step of 10 s"}


@pytest.mark.parametrize("case", HARD)
def test_a_hard_run_is_finite_or_refused(case):
    name, values = HARD[case]
    try:
        found = simulate(from_file(name, **values))
    except SimulationError:
        assert case in MAY_BE_REFUSED
        return
    for variable in found.variables.values():
        assert variable.dtype.kind != "f" or np.isfinite(variable).all()
    # what such a run is worth stands in its audit
    audit = json.loads(found.attrs["audit"])
    warned = "energy" in found.attrs["warnings"]
    assert warned == (audit["unexplained_share"] > 1e-3)


def test_a_step_that_cannot_converge_names_time_node_effect_and_remedy():
    name, values = HARD["surge of 1500 m"]
    with pytest.raises(SimulationError) as failure:
        simulate(from_file(name, **values))
    said = str(failure.value)
    for part in (
        r"t = [\d.]+ s",
        r"node \d+ \(s = [\d.]+ m\)",
        r"force at this node comes from [a-z ]+ \(",
        "Use a",
    ):
        assert failure.match(part)
    assert "nan" not in said.lower()


def test_the_effect_that_is_named_is_the_one_to_blame():
    name, values = HARD["stops hit"]
    with pytest.raises(SimulationError, match="end stops"):
        simulate(from_file(name, **values | {"analysis__step": "0.1 s"}))


@pytest.mark.parametrize(
    "values",
    [
        {"analysis__step": "0.1 s"},
        {"analysis__step": "1 ms", "analysis__method": "explicit"},
        {"analysis__step": "0.1 s", "analysis__method": {"beta": 0.25, "gamma": 0.5}},
    ],
    ids=["generalised-alpha", "explicit", "Newmark"],
)
def test_what_rests_stays_at_rest(values):
    still = {"platform__surge__amplitude": "0 m", "analysis__duration": "20 s"}
    found = simulate(from_file("bench/s2", **FORTY, **still, **values))
    assert float(np.abs(found["x"]).max()) == 0.0
    assert float(np.abs(found["bending_moment"]).max()) == 0.0
    # rounding of elevations of 533 m
    assert float(np.abs(found["z"] - found["z_static"].values).max()) < 1e-11
    assert json.loads(found.attrs["warnings"]) == []


def test_a_current_that_stays_leaves_the_riser_where_statics_put_it():
    dynamic = {"duration": "20 s", "output": {"interval": "1 s"}, "step": "0.1 s"}
    dynamic["mesh"] = {"elements": 40}
    scene = from_file("bench/s1", analysis=dynamic, **{"riser[0].mass": "1006 kg/m"})
    found = simulate(scene)
    assert float(np.abs(found["x"] - found["x_static"].values).max()) < 1e-9
    audit = json.loads(found.attrs["audit"])
    # the water works on the riser, and all of it is dissipated
    assert audit["dissipated"] == pytest.approx(audit["work_of_water_and_devices"], rel=1e-9)


def test_a_top_that_does_not_move_has_no_error_to_refine_for():
    found = simulate(from_file("bench/s2", platform__surge__amplitude="0 m"))
    assert json.loads(found.attrs["warnings"]) == []
    assert found.attrs["elements"] < 100
