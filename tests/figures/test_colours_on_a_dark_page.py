"""Colours of a quantity of one sign: the most contrasts most with a light and with a dark page."""

import re
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib import colormaps

from riserstudy.figures.style import field, panels

CSS = Path(__file__).parents[2] / "src/riserstudy/report/page.css"
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
#: rotation of hues by half a turn, from the specification of filter effects
HALF_TURN = np.array([[-0.574, 1.43, 0.144], [0.426, 0.43, 0.144], [0.426, 1.43, -0.856]])


def of_the_page(colours):
    """Colours as the filter of the dark page shows them."""
    share, angle = re.search(r"filter: invert\(([.\d]+)\) hue-rotate\((\d+)deg\)", CSS.read_text()).groups()
    assert angle == "180"
    inverted = colours * (1.0 - 2.0 * float(share)) + float(share)
    return np.clip(inverted @ HALF_TURN.T, 0.0, 1.0)


def test_larger_values_contrast_more_with_a_light_and_with_a_dark_page():
    figure, (ax,) = panels()
    values = xr.DataArray(np.eye(3), {"a": [0, 1, 2], "b": [0, 1, 2]})
    field(figure, ax, values, "a", "b", "share of one")
    colours = colormaps[ax.collections[0].get_cmap().name](np.linspace(0.0, 1.0, 40))[:, :3]
    page = np.ones((1, 3))
    for shown, behind in ((colours, page), (of_the_page(colours), of_the_page(page))):
        contrast = abs(shown @ LUMINANCE - behind @ LUMINANCE)
        assert (np.diff(contrast) > 0.0).all()
        assert contrast[0] < 0.1
        assert contrast[-1] > 0.5
