"""What the ramp of a current would change of mao_hangoff's Fig 11 if it accelerated the water (E20)."""

import re
from pathlib import Path

import pytest
import yaml
from reference_chain import SEABED, Chain

from riserstudy.scene.load import read_scene
from riserstudy.simulation.refine import run

CONFIG = Path(__file__).parents[2] / "config"
SETS = {
    "current.profile": {"shape": "power", "power": 0.25},
    "platform.cruise.speed": "1.289 m/s",
    "analysis.mesh": {"elements": 400, "layers": {"top": "7 m", "bottom": "14 m"}},
    "analysis.step": "0.1 s",
    "analysis.method": "ESDIRK4",
    "analysis.output.interval": "0.1 s",
}
UNTIL = 130.0


def trails(speed):
    """How far the LMRP trails the platform (m): the engine's, and the chain's with still and moved water."""
    sets = SETS | {"current.profile": SETS["current.profile"] | {"surface_speed": f"{speed} m/s"}}
    scene = read_scene(CONFIG / "scenes/mao_hangoff/evacuation.yaml").with_values(sets, "test")
    found = run(scene.resolved(), estimated=False).arrays
    x, top = found["x"], (found["time"], found["x"][:, -1], found["z"][:, -1])

    def profile(z):
        return speed * ((z - SEABED) / -SEABED).clip(0.0) ** 0.25

    chain = [x[-1, -1] - Chain().lowest(profile, top, UNTIL, moved)[0] for moved in (False, True)]
    return x[-1, -1] - x[-1, 0], *chain


def percentages():
    """Those that the erratum prints."""
    errata = yaml.safe_load((CONFIG / "published/mao_hangoff.yaml").read_text("utf-8"))["errata"]
    text = next(one["simulation"] for one in errata if one["id"] == "E20")
    return [float(number) for number in re.findall(r"(\d+\.\d+)(?: to| %)", text)]


@pytest.mark.slow
@pytest.mark.parametrize("speed, end", [(1.0, 0), (1.2, 1)])
def test_a_ramp_that_accelerates_the_water_shortens_the_trail_as_printed(speed, end):
    engine, still, moved = trails(speed)
    *least_and_most, agreement = percentages()
    assert 100.0 * (1.0 - moved / still) == pytest.approx(least_and_most[end], abs=0.1)
    assert 100.0 * abs(still / engine - 1.0) < agreement
