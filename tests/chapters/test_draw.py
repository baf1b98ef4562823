"""A figure whose dataset lacks what it draws is refused by the names of figure, dataset and variable."""

import pytest
import xarray as xr

from riserstudy.chapters import draw as module
from riserstudy.errors import InputError

FULL = xr.Dataset({"angle": ("q", [1.0, 2.0]), "lift": ("q", [3.0, 4.0])}, {"q": [0.0, 1.0]})
LOOKS = {
    "by name": lambda one: one["lift"],
    "several": lambda one: one[["angle", "lift"]],
    "as an attribute": lambda one: one.lift,
    "of a part": lambda one: one.isel(q=0)["lift"],
    "selected": lambda one: one["angle"].sel(lift=0.0),
}


def refused(monkeypatch, look, **datasets):
    monkeypatch.setattr(module, "function_of", lambda *_: lambda **given: look(given["motion"]))
    module.draw("smith2031", "fig3", datasets)


@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
def test_what_a_dataset_lacks_is_named(monkeypatch, look):
    said = (
        "^smith2031, figure fig3: the figure draws 'lift', which is not in motion; use .*: motion has angle$"
    )
    with pytest.raises(InputError, match=said):
        refused(monkeypatch, look, motion=FULL.drop_vars("lift"), whole=FULL)


@pytest.mark.parametrize(
    "look, error",
    [
        (lambda one: one["angle"].sel(q=7.0), KeyError),  # of a value, not of a variable
        (lambda one: {}["lift"], KeyError),
        (lambda one: one.values.lift, AttributeError),
        (lambda one: one["lift"] / 0, ZeroDivisionError),
    ],
)
def test_other_faults_stay_as_they_are(monkeypatch, look, error):
    def shown(one):
        look(one)
        raise ZeroDivisionError

    with pytest.raises(error):
        refused(monkeypatch, shown, motion=FULL)
