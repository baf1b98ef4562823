"""Every implicit method is of second order in the step, in displacement, moment and end tension.

Errors are against the same mesh at an eighth of the smallest step. Meshes are so coarse that even their
fastest axial wave is resolved; otherwise waves that the start leaves behind drift out of phase and hide
the order.
"""

from functools import cache

import numpy as np
import pytest
from engine import METHODS, march, rms, slopes

from riserstudy.model.mesh import even
from riserstudy.scene.models import Scene
from riserstudy.scene.resolve import resolve
from riserstudy.simulation.run import single

SECOND = pytest.approx(2.0, abs=0.1)


def errors(name, elements, steps, method, duration, interval, **values):
    """Errors of each quantity over the steps; tension at the ends apart."""
    wanted = {
        "analysis__method": METHODS[method],
        "analysis__duration": f"{duration} s",
        "analysis__output": {"interval": f"{interval} s"},
    }

    def run(step):
        arrays = march(name, elements, step, **wanted, **values).arrays
        ends = {f"tension at {k}": arrays["effective_tension"][:, k] for k in (0, -1)}
        return {k: arrays[k] for k in ("x", "z", "bending_moment") if k in arrays} | ends

    best = run(steps[-1] / 8.0)
    found = [run(step) for step in steps]
    return {name: [rms(one[name], best[name]) for one in found] for name in best}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", ["s2", "s2c"])
def test_surge_is_of_second_order_in_the_step(name, method):
    steps = [0.02, 0.01, 0.005]
    found = errors(name, 10, steps, method, 30, 0.02)
    for quantity in ("x", "bending_moment"):
        assert list(slopes(steps, found[quantity])) == [SECOND] * 2, quantity
    assert found["x"][0] < 3e-5
    assert found["bending_moment"][0] < 1e-4


@pytest.mark.parametrize("method", METHODS)
def test_outputs_between_the_steps_are_of_second_order_too(method):
    steps = [0.04, 0.02, 0.01]
    found = errors("s2", 10, steps, method, 15, 0.015)
    for quantity in ("x", "bending_moment"):
        assert list(slopes(steps, found[quantity])) == [SECOND] * 2, quantity


@pytest.mark.parametrize("method", METHODS)
def test_the_support_force_of_heave_is_of_second_order_in_the_step(method):
    steps = [0.008, 0.004, 0.002]
    found = errors("s3", 4, steps, method, 8, 0.04)
    for quantity in ("z", "tension at 0", "tension at -1"):
        assert list(slopes(steps, found[quantity])) == [SECOND] * 2, quantity
    assert found["tension at -1"][0] < 2e-5


@pytest.mark.parametrize("method", METHODS)
def test_the_support_force_of_surge_is_of_second_order_in_the_step(method):
    steps = [0.008, 0.004, 0.002]
    dry = {"riser[0].added_mass": None, "riser[0].drag": None}
    found = errors("s2c", 4, steps, method, 8, 0.04, **dry)
    assert list(slopes(steps, found["tension at -1"])) == [SECOND] * 2


@pytest.mark.parametrize("method", METHODS)
def test_added_mass_on_a_pipe_that_swings_is_of_second_order_in_the_step(method):
    """A hanging pipe of four segments, its top moved by 30 m to either side."""
    steps = [0.02, 0.01, 0.005]

    def run(step):
        scene = resolve(Scene.model_validate(SWINGING | {"analysis": swing(step, METHODS[method])}))
        return single(scene, even(scene, 4), step).arrays

    best = run(steps[-1] / 8.0)
    found = [run(step) for step in steps]
    assert list(slopes(steps, [rms(one["x"], best["x"]) for one in found])) == [SECOND] * 2
    support = [rms(one["effective_tension"][:, -1], best["effective_tension"][:, -1]) for one in found]
    assert list(slopes(steps, support)) == [SECOND] * 2


SWINGING = {
    "title": "swinging pipe",
    "water": {"density": "1025 kg/m^3"},
    "riser": [
        {
            "name": "pipe",
            "length": "100 m",
            "axial_stiffness": "10 MN",
            "mass": "100 kg/m",
            "submerged_weight": "500 N/m",
            "added_mass": {"coefficient": 3.0, "diameter": "0.5 m"},
        }
    ],
    "bottom": {"hold": "free", "body": {"name": "end", "mass": "1 t", "submerged_weight": "8 kN"}},
    "top": {"x": "platform", "z": "held", "elevation": "0 m"},
    "platform": {"surge": {"amplitude": "30 m", "period": "8 s", "ramp": "8 s"}},
}


def swing(step, method):
    return {
        "duration": "8 s",
        "output": {"interval": "0.2 s"},
        "mesh": {"elements": 4},
        "step": f"{step} s",
        "method": method,
    }


@cache
def practical(method):
    steps = [0.2, 0.1, 0.05]
    return steps, errors("s2c", 40, steps, method, 60, 0.2)


@pytest.mark.parametrize("method", METHODS)
def test_practical_steps_show_the_order_already(method):
    steps, found = practical(method)
    for quantity in ("x", "tension at 0", "tension at -1"):
        assert slopes(steps, found[quantity]).min() > 1.9, quantity
    # the moment's largest errors sit in a layer of 11 m at the top, a segment long
    assert slopes(steps, found["bending_moment"]).min() > 1.75


def test_newmark_and_generalised_alpha_agree_in_the_limit():
    a, b = (
        march("s2", 20, 0.005, analysis__method=METHODS[m], analysis__duration="30 s").arrays["x"]
        for m in ("Newmark", "rho 0.8")
    )
    assert np.abs(a - b).max() < 1e-5 * np.abs(a).max()
