"""A limit has one name in all figures, with abbreviations in capitals."""

import numpy as np
import pytest
import xarray as xr
from test_workable_hours import hours

from riserstudy.dataset.variables import variables
from riserstudy.figures.names import in_words
from riserstudy.figures.utilisation import utilisation
from riserstudy.figures.workable_hours import workable_hours

LIMITS = ["drilling: mean lfj_angle", "connected: largest von_mises_stress"]


def labels_of_utilisation():
    use = np.array([[0.5, 0.2], [0.4, 0.6]])
    coords = {"heave_amplitude": [1.0, 2.0], "limit": LIMITS}
    data = {"use_of_limit": (("heave_amplitude", "limit"), use), "point_key": ("heave_amplitude", ["a", "b"])}
    (legend,) = utilisation(xr.Dataset(data, coords)).legends
    return [text.get_text() for text in legend.get_texts()]


def labels_of_workable_hours():
    figure = workable_hours(hours((0.0, 0.25, 0.5), 7.0))
    return [text.get_text().replace("\n", " ") for text in figure.axes[2].get_yticklabels()]


def test_figures_of_utilisation_and_of_workable_hours_name_limits_alike():
    expected = ["drilling: mean LFJ angle", "connected: largest von Mises stress"]
    assert labels_of_utilisation() == expected
    assert labels_of_workable_hours() == expected


@pytest.mark.parametrize("name", sorted(variables()))
def test_names_keep_their_letters_and_are_the_same_when_put_in_words_twice(name):
    words = in_words(name)
    assert words.lower() == name.replace("_", " ").lower()
    assert in_words(words) == words
    assert not {"ufj", "lfj", "lmrp"} & set(words.split())
