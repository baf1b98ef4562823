"""The smallest angle of a joint in space: of a vector that may pass near zero between two steps."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.simulation.step_peaks import peaks_of


def passing(seed, count):
    """Times, and a smooth vector that passes near zero at a small distance."""
    draw = np.random.default_rng(seed)
    ends = np.linspace(0.0, 10.0, count + 1)
    times = ends + np.append(0.0, np.append(draw.uniform(-0.2, 0.2, count - 1), 0.0)) * 10.0 / count
    rate, phase = draw.uniform(0.5, 1.0, 3), draw.uniform(0.0, 6.0, 3)
    near, size = draw.normal(0.0, 1e-3, 3), draw.uniform(0.5, 2.0, 3)
    at = draw.uniform(4.0, 6.0)

    def vector(t):
        t = np.asarray(t)[:, None]
        return near + size * (np.sin(rate * t + phase) - np.sin(rate * at + phase))

    return times, vector


@pytest.mark.parametrize("seed", range(20))
def test_the_smallest_magnitude_is_that_of_the_vector_between_steps(seed):
    worst = []
    for count in (40, 80, 160):
        times, vector = passing(seed, count)
        vectors = vector(times)
        sizes = np.linalg.norm(vectors, axis=1)
        found = peaks_of(times, {"angle": sizes}, {"angle": vectors})["angle"]
        dense = np.linspace(times[0], times[-1], 400_001)
        true = np.linalg.norm(vector(dense), axis=1)
        assert found.smallest_time == pytest.approx(dense[true.argmin()], abs=0.02)
        worst.append(abs(found.smallest - true.min()))
    # by the third derivative, at most 1 / 6 * 2 * 0.5 * h^3 with components up to 2 and steps up to 1.4 h
    for error, count in zip(worst, (40, 80, 160), strict=True):
        assert error < 1.0 * (1.4 * 10.0 / count) ** 3 + 1e-3 * 10.0 / count


@pytest.mark.parametrize("seed", [0, 2, 3, 5])
def test_the_smallest_angle_of_a_rig_does_not_depend_on_the_step(seed):
    """Against steps a quarter as long, relative to the largest angle; a parabola of magnitudes is far off."""
    tree = moving(seed, spatial=True, conductor=False)
    period = tree["platform"]["surge"]["period"]
    tree["analysis"] |= {"duration": 3.0 * period, "mesh": {"elements": 60}}
    found = []
    for steps in (80, 320):
        tree["analysis"]["step"] = period / steps
        tree["analysis"]["output"]["interval"] = period / 20.0
        rows = run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False).facts["extremes"]
        found.append({row["output"]: row for row in rows if "fj_angle" in row["output"]})
    coarse, fine = found
    for name, row in fine.items():
        off = {side: abs(coarse[name][side] - row[side]) for side in ("largest", "smallest")}
        # what the longer steps change in the angle itself, at its peak and elsewhere
        assert off["smallest"] < 2.0 * off["largest"] + 4e-4 * row["largest"], name
