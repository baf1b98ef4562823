"""A run warns where its histories show another motion than that of the platform."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

PERIODS = 24


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_a_warning_says_where_histories_show_another_frequency(seed, spatial):
    """The frequency is that of the largest Fourier component of the outputs."""
    draw = np.random.default_rng((seed, 7))
    tree = moving(seed, spatial=spatial, conductor=False)
    tree["platform"].pop("pitch", None)
    period = tree["platform"]["surge"]["period"]
    for outputs in (draw.uniform(0.6, 1.8), draw.uniform(2.3, 9.0)):  # in a period
        tree["analysis"] |= {"duration": (1 + PERIODS) * period, "step": period / 25, "mesh": {"elements": 6}}
        tree["analysis"]["output"] = {"interval": period / outputs, "start": period}
        file = SceneFile("rig.yaml", written(tree, unit_of={"start": "s"}))
        found = run(file.resolved(), estimated=False)
        end = found.arrays["x"][:, -1]  # of the riser, which the platform moves
        power = abs(np.fft.rfft((end - end.mean()) * np.hanning(len(end)), 4096))
        shown = power.argmax() / 4096 * outputs / period  # Hz
        differs = abs(shown * period - 1.0) > 2.0 / PERIODS
        warned = [text for text in sentences(found.facts["warnings"]) if "histories do not show" in text]
        assert len(warned) == differs
        assert differs == (outputs < 2.0)
