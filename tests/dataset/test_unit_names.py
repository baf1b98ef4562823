"""Units of published values and of a chapter's variables are known ones."""

import numpy as np
import pint
import pytest

from riserstudy.dataset.chapter_variables import chapter_table
from riserstudy.dataset.unit_names import known_unit, scene_notation
from riserstudy.errors import InputError
from riserstudy.grading.published import printed_of
from riserstudy.inputs.misfit import Misfit

UNKNOWN = ["KN", "kN-m", "m//s", "-", "5", "parsnip", "ton", "mt", "dB", "m/parsnip", "m s--1", "kN m)"]
PUBLISHED = """
paper: own
items:
  - {{id: N1, figure: "1", kind: number, statement: the tension is 2, published: 2, rounding: 1,
     unit: "{unit}", impossible: there is no drawing}}
"""


@pytest.mark.parametrize("unit", UNKNOWN)
def test_unknown_units_are_refused_with_file_and_field(tmp_path, monkeypatch, unit):
    monkeypatch.chdir(tmp_path)
    published, table = tmp_path / "config/published/own.yaml", tmp_path / "chapters/own/variables.yaml"
    for file, text in (
        (published, PUBLISHED.format(unit=unit)),
        (table, f'swing: {{long_name: swing, units: "{unit}"}}\n'),
    ):
        file.parent.mkdir(parents=True)
        file.write_text(text)
    with pytest.raises(InputError, match=r"own\.yaml: items\[0\]\.unit: "):
        printed_of(published.parents[1], "own")
    with pytest.raises(InputError, match=r"variables\.yaml: swing\.units: "):
        chapter_table("own")


@pytest.mark.parametrize("seed", range(30))
def test_products_of_units_are_known_in_either_notation(seed):
    draw = np.random.default_rng(seed)
    names = draw.choice(["kN", "MN", "m", "s", "deg", "ft", "kip", "lbf", "knot", "year"], 3, replace=False)
    powers = [int(k) for k in draw.choice([-3, -2, -1, 1, 2, 3], 3)]
    cf = " ".join(f"{name}{power if power != 1 else ''}" for name, power in zip(names, powers, strict=True))
    scene = "*".join(f"{name}^{power}" for name, power in zip(names, powers, strict=True))
    assert (known_unit(cf), known_unit(scene)) == (cf, scene)
    with pytest.raises(Misfit):
        known_unit(f"{cf} parsnip")


#: values in SI units, each by its definition
SI = {"kN": 1e3, "MN": 1e6, "m": 1.0, "s": 1.0, "ft": 0.3048, "min": 60.0, "h": 3600.0, "km": 1e3}


@pytest.mark.parametrize("seed", range(30))
def test_notations_of_a_unit_mean_the_same_number(seed):
    """The product of the values of its parts, in the notation of CF, of scenes, and with a stroke."""
    draw = np.random.default_rng(seed)
    above, below = (str(name) for name in draw.choice([*SI], 2, replace=False))
    first, second = (int(k) for k in draw.choice([1, 2, 3], 2))
    ones = {1: "", 2: "2", 3: "3"}
    units = pint.UnitRegistry()
    for name in (
        f"{above}{ones[first]} {below}-{second}",
        f"{above}{ones[first]}/{below}{ones[second]}",
        f"{above}^{first}*{below}^-{second}",
    ):
        found = units.Quantity(1.0, scene_notation(name)).to_base_units().magnitude
        assert found == pytest.approx(SI[above] ** first / SI[below] ** second, rel=1e-12)


def test_numbers_without_a_unit_have_none():
    assert [known_unit(name) for name in ("", "1", "%")] == ["", "1", "%"]
