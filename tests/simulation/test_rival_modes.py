"""Where any of two modes may last a run says so, and nowhere else."""

import random
from math import pi, sqrt

import numpy as np
import pytest
from test_vortex_induced_vibration import scene

from riserstudy.errors import SimulationError
from riserstudy.model.vortices import synchronised
from riserstudy.records.warning import sentences
from riserstudy.scene.forcing import Cruise, Platform
from riserstudy.simulation.refine import run
from riserstudy.simulation.rival_modes import EDGE, FIRST, rivals, warn_of_rivals

WARNING = "riser.viv: vortices may lock in to modes"
LOW, HIGH = 0.11, 0.26  # of the scene's vortices, over U / D


def natural(file, count):
    """Frequencies (Hz) of a beam on pins under the mean of its tension."""
    section = file.scene().riser[0]
    water = pi / 4 * 0.028**2 * 1000.0
    tension = 1200.0 - 0.5 * 12.0 * 13.0
    k = np.arange(1, count + 1) * pi / 13.0
    return k / (2 * pi) * np.sqrt((tension + 30.0 * k**2) / (section.mass + water))


@pytest.mark.parametrize("seed", range(30))
def test_in_a_uniform_current_they_are_those_between_two_frequencies(seed):
    speed = 10 ** random.Random(seed).uniform(-1.3, 0.2)
    file = scene(current__profile={"shape": "uniform", "surface_speed": f"{speed} m/s"})
    found, beam = rivals(file.resolved()), natural(file, FIRST // 2)
    low, high = LOW * speed / 0.028 / (1.0 + EDGE), HIGH * speed / 0.028 / (1.0 - EDGE)
    near = [f for f in beam if min(abs(f / low - 1.0), abs(f / high - 1.0)) < 0.02]
    within = [f for f in beam if low < f < high]
    if high < beam[-1] and not near:  # a beam's frequencies are those of a mean tension
        assert len(found) == len(within)
        np.testing.assert_allclose(found, within, rtol=0.02)


def test_a_place_counts_where_its_own_speed_allows_it():
    """In a current that grows from nothing a frequency has the share between two of its speeds."""
    profile = [{"elevation": "0 m", "speed": "0 m/s"}, {"elevation": "13 m", "speed": "1 m/s"}]
    file = scene(current__profile=profile).resolved()
    for frequency in (0.5, 1.0, 3.0):
        share = frequency * 0.028 / LOW - frequency * 0.028 / HIGH
        assert synchronised(file, frequency) == pytest.approx(share, abs=0.01)
    assert synchronised(file, 20.0) == 0.0
    shares = [f * 0.028 * ((1 + EDGE) / LOW - (1 - EDGE) / HIGH) for f in rivals(file)]
    assert shares
    assert min(shares) > 0.5


@pytest.mark.parametrize("speed, said", [(0.21, True), (0.13, False)])
def test_a_run_says_so(speed, said):
    """At 0.21 m/s such a riser stayed in its second mode, and in its first on a finer mesh."""
    file = scene(
        current__profile={"shape": "uniform", "surface_speed": f"{speed} m/s"},
        analysis__duration="4 s",
        riser=[_brief(scene())],
    )
    result = run(file.resolved(), estimated=False)
    assert any(text.startswith(WARNING) for text in sentences(result.facts["warnings"])) == said


def test_a_run_whose_modes_cannot_be_found_is_whole_and_says_so(monkeypatch):
    def fail(scene, count):
        raise SimulationError("modes require mass")

    monkeypatch.setattr("riserstudy.simulation.modes.modes_of", fail)
    facts = {"warnings": []}
    warn_of_rivals(scene().resolved(), facts)
    (warning,) = sentences(facts["warnings"])
    assert warning.endswith("several competing modes failed: modes require mass")


def test_of_a_riser_that_is_towed_nothing_is_claimed(monkeypatch):
    """Vortices then depend on the speed through the water, which the modes about a riser at rest lack."""
    monkeypatch.setattr("riserstudy.simulation.rival_modes.rivals", lambda scene: [0.1, 0.2])
    facts = {"warnings": []}
    resolved = scene().resolved()
    platform = Platform(cruise=Cruise(speed="0.5 m/s"))
    warn_of_rivals(resolved.replaced(platform=platform), facts)
    (warning,) = sentences(facts["warnings"])
    assert "not checked for a platform that cruises" in warning


def _brief(file):
    """Its section, with vortices that come up within 2 s."""
    section = file.tree["riser"][0]
    return section | {"viv": section["viv"] | {"ramp": "2 s"}}


def test_the_closed_form_is_that_of_a_string_without_stiffness():
    assert natural(scene(), 1)[0] == pytest.approx(sqrt(1122.0 / (1.85 + 0.6158)) / 26.0, rel=0.01)
