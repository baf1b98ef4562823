"""What Python functions return has the attributes that files have: long names, units, CF conventions."""

from pathlib import Path

import pytest

from riserstudy import load_scene, modes, simulate, sweep
from riserstudy.design.vortex_screening import Coefficients, screening

ROOT = Path(__file__).parents[2]
SHORT = {
    "analysis.mesh": {"elements": 30},
    "analysis.step": "0.2 s",
    "analysis.duration": "6 s",
    "analysis.output": {"interval": "0.5 s"},
}


def surge():
    return load_scene(ROOT / "config/scenes/hard/surge.yaml", **SHORT)


MADE = {
    "simulate": lambda: simulate(surge(), progress=False),
    "modes": lambda: modes(surge(), 3),
    "sweep": lambda: sweep(surge(), {"top.tension": [2000, 2500]}, cores=1, progress=False),
    "screening": lambda: screening(load_scene(ROOT / "config/scenes/design/riser.yaml"), Coefficients()),
}


@pytest.mark.parametrize("function", MADE)
def test_every_variable_has_a_name_and_every_number_a_unit(function):
    dataset = MADE[function]()
    assert dataset.attrs["Conventions"].startswith("CF-")
    for name, of in dataset.variables.items():
        assert of.attrs.get("long_name"), name
        assert "units" in of.attrs or of.dtype.kind not in "fiu", name
