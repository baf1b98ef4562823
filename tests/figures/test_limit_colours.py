"""A limit has the same colour in all figures of a dataset, whichever limits govern there."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_hex

from riserstudy.figures.limit_colours import colours_of
from riserstudy.figures.utilisation import utilisation


@pytest.mark.parametrize("count", range(1, 45))
def test_no_two_limits_have_one_colour(count):
    names = [f"drilling: limit {k}" for k in range(count)]
    found = colours_of(names)
    assert list(found) == names
    assert len({to_hex(colour) for colour in found.values()}) == count


def uses(draw, count, axes):
    """A dataset of utilisations over some axes, with the same limits."""
    shape = (*[3] * len(axes), count)
    return xr.Dataset(
        {
            "use_of_limit": ((*axes, "limit"), draw.uniform(0.0, 1.0, shape)),
            "point_key": (axes, np.full(shape[:-1], "key")),
        },
        {name: (name, np.arange(3.0), {"long_name": name, "units": "1"}) for name in axes}
        | {"limit": [f"drilling: limit {k}" for k in range(count)]},
    )


def colours(figure):
    """Colours of limits in the legend, by name."""
    (legend,) = figure.legends
    entries = zip(legend.get_texts(), legend.get_lines(), strict=True)
    return {text.get_text(): to_hex(line.get_color()) for text, line in entries}


@pytest.mark.parametrize("seed", range(8))
def test_lines_and_maps_agree_about_the_colours(seed):
    draw = np.random.default_rng(seed)
    count = int(draw.integers(3, 30))
    lines = colours(utilisation(uses(draw, count, ["speed"])))
    maps = [colours(utilisation(uses(draw, count, ["speed", "offset"]))) for _ in range(2)]
    assert len(lines) == count
    for one in maps:
        assert len(one) < count or count < 9
        assert one == {name: lines[name] for name in one}
