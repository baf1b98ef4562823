"""The search for the cheapest setting, against all settings; the next finer one; worth of a setting."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from riserstudy.study.quick_tune import TWICE, finer
from riserstudy.study.setting import METHODS, Setting, meshes, steps
from riserstudy.study.tune import ENOUGH, Tuner, work_of

SECONDS = 100.0


def place(number, factor):
    """A point whose errors are so many times those of others."""
    scene = SimpleNamespace(analysis=SimpleNamespace(duration=SECONDS))
    file = SimpleNamespace(resolved=lambda: scene)
    return SimpleNamespace(index=(number,), factor=factor, file=file, work_of_request=1e6 * (1 + number))


class Known(Tuner):
    """Errors that fall with segments and steps, and work that grows with them, without any run."""

    def __init__(self, mesh, step, iterations):
        self.mesh, self.step, self.iterations, self.tried = mesh, step, iterations, set()

    def _tried(self, setting, of):
        self.tried.add(setting)
        error = of.factor * ((self.mesh / setting.elements) ** 2 + (setting.step / self.step) ** 2)
        solutions = SECONDS / setting.step * METHODS[setting.method][1]
        return error, setting.elements * solutions * self.iterations * (1.0 + setting.step)

    own = Setting(64, (), 0.1, "generalised-alpha")
    words = "1 %"


def grid(method):
    counts = [round(8 * 2 ** (k / 4)) for k in range(20)]
    return [[Setting(n, (), 2.0 * 2 ** (-k / 3), method) for k in range(21)] for n in counts]


@pytest.mark.parametrize("seed", range(8))
def test_the_border_has_the_cheapest_of_all_settings_that_suffice(seed):
    draw = np.random.default_rng(seed)
    tuner = Known(draw.uniform(10.0, 80.0), draw.uniform(0.1, 1.0), draw.uniform(1.0, 3.0))
    places = [place(k, factor) for k, factor in enumerate(draw.uniform(0.5, 2.0, 4))]
    every = grid("ESDIRK4")
    cost = {}
    for setting in (one for row in every for one in row):
        found = [tuner._tried(setting, one) for one in places]
        if max(error for error, _ in found) <= ENOUGH:
            cost[setting] = sum(work for _, work in found)
    cheapest = min(cost, key=cost.get)
    tuner.tried.clear()
    best, work = tuner._along_border(every, list(places), math.inf)
    assert work == pytest.approx(cost[cheapest])
    assert cost[best] == cost[cheapest]
    # a border has at most as many settings as both sides together
    assert len(tuner.tried) <= len(every) + len(every[0])
    # cheaper ones are not wanted: none is found
    assert tuner._along_border(every, list(places), 0.999 * work)[0] is None


@pytest.mark.parametrize("share, suffices", [(0.89, True), (0.91, False)])
def test_a_setting_suffices_up_to_nine_tenths_of_the_tolerance(share, suffices):
    tuner, places = Known(8.0, 1.0, 1.0), [place(0, 0.01), place(1, share / 1.25), place(2, 0.01)]
    work = tuner._suffices(Setting(16, (), 1.0, "ESDIRK4"), places)
    assert (work < math.inf) == suffices
    # where it fails is tried first the next time
    assert [one.index for one in places] == ([(0,), (1,), (2,)] if suffices else [(1,), (0,), (2,)])


def test_error_and_work_are_told_of_both_kinds_of_points():
    """Work relative to requests at the points of tuning alone; the largest errors of both."""
    tuner, setting = Known(8.0, 1.0, 1.0), Setting(16, (), 1.0, "ESDIRK4")
    places, checks = [place(0, 0.4), place(1, 0.6)], [place(2, 0.2), place(3, 0.7)]
    found = tuner.worth(setting, places, checks)
    assert found.error == pytest.approx(0.6 * 1.25)
    assert found.held_out == pytest.approx(0.7 * 1.25)
    one = tuner._tried(setting, places[0])[1]
    assert found.work == pytest.approx(2.0 * one / 3e6)  # requests cost 1 and 2 million
    own, error, work = found.own
    assert own == Known.own
    assert error == pytest.approx(0.7 * (1.0 / 64.0 + 0.01))
    assert work == pytest.approx(2.0 * tuner._tried(own, places[0])[1] / 3e6)


def test_work_is_segments_times_iterations():
    assert work_of({"elements": 20, "newton_iterations": 300, "steps": 7}) == 6000.0


@pytest.mark.parametrize("elements, expected", [(4, 8), (20, 24), (100, 120), (1, 1), (3, 3)])
def test_the_next_finer_setting_has_segments_that_can_be_halved_twice(elements, expected):
    """2^(1/4) times the segments, at least; 2^(1/3) times the steps, to two digits."""
    found = finer(Setting(elements, (("top", 5.0),), 0.4, "ESDIRK4"))
    assert found.elements == expected
    assert elements < TWICE or found.elements % 4 == 0
    assert found.step == pytest.approx(0.4 / 2 ** (1.0 / 3.0), rel=0.016)
    assert (found.layers, found.method) == ((("top", 5.0),), "ESDIRK4")


def test_meshes_and_steps_to_try_are_spaced_evenly_by_ratio(monkeypatch):
    monkeypatch.setattr("riserstudy.study.setting.massless", lambda scene: False)
    monkeypatch.setattr("riserstudy.study.setting.period", lambda scene: scene)
    counts = meshes([None], 200)
    assert counts[0] == 8
    assert counts[-1] >= 200 > counts[-2]
    # each is rounded by half a segment at most
    assert np.abs(np.array(counts[4:]) - 2.0 * np.array(counts[:-4])).max() <= 1.5
    tried = steps([12.0, 8.0])  # of the shortest period
    assert tried[0] == 2.0
    assert tried[-1] <= 8.0 / 400.0 < tried[-2]
    np.testing.assert_allclose(np.array(tried[3:]) / tried[:-3], 0.5, rtol=0.07)
