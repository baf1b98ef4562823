"""A tensioner's law as a table: what is accepted, what it becomes, what it is refused for."""

from itertools import accumulate
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from riserstudy import load_scene, simulate
from riserstudy.errors import InputError
from riserstudy.model.tensioner_law import gas_force, table_law
from riserstudy.scene.tensioners import Gas, TableRow

HEAVE = Path(__file__).parents[2] / "config/scenes/chang2020/heave.yaml"
TENSIONERS = "top.tensioners"
STATICS = {"platform.heave": None, "platform.position.heave": "3 m", "analysis": {}}
#: one dynamic run of known mesh and step
MOVING = {
    "platform.heave.period": "10 s",
    "analysis": {
        "duration": "30 s",
        "output": {"interval": "0.1 s"},
        "mesh": {"elements": 1},
        "step": "0.01 s",
    },
}


def gas_rows(first, last, count):
    """Chang's gas law, tabulated."""
    gas = load_scene(HEAVE).resolved().top.tensioners.gas
    reach = np.linspace(first, last, count)
    return [
        {"reach": f"{x:.6f} m", "force": f"{f:.3f} N"}
        for x, f in zip(reach, gas_force(Gas.model_construct(**dict(gas)), reach), strict=True)
    ]


def tabulated(rows, more):
    return load_scene(HEAVE, **{f"{TENSIONERS}.gas": None, f"{TENSIONERS}.table": rows, **more})


def test_a_tabulated_gas_law_is_the_gas_law_at_rest():
    gas = simulate(load_scene(HEAVE, **STATICS))
    table = simulate(tabulated(gas_rows(-8.0, 8.0, 65), STATICS))
    for name in ("tensioner_force_static", "tensioner_stroke_static"):
        # cubics over 0.25 m, third order: (0.25 m / 18 m)^3
        np.testing.assert_allclose(table[name], gas[name], rtol=1e-5)
    assert "tabulated tensioner" in table.attrs["effects"]


def test_a_tabulated_gas_law_moves_like_the_gas_law_and_keeps_its_energy():
    gas = simulate(load_scene(HEAVE, **MOVING))
    table = simulate(tabulated(gas_rows(-8.0, 8.0, 65), MOVING))
    force = gas["tensioner_force"]
    assert float(abs(table["tensioner_force"] - force).max()) < 1e-4 * float(force.max())
    assert "does not account" not in table.attrs["warnings"]
    assert "table" not in table.attrs["warnings"]


def test_leaving_the_table_is_warned_of():
    run = simulate(tabulated(gas_rows(-1.0, 1.0, 9), MOVING))
    assert (
        "their table covers only -1 m to 1 m: beyond it, force is extrapolated linearly"
        in run.attrs["warnings"]
    )


def test_a_csv_table_is_the_same_as_rows_written_out(tmp_path):
    rows = gas_rows(-8.0, 8.0, 5)
    lines = [",".join(value.split()[0] for value in row.values()) for row in rows]
    (tmp_path / "law.csv").write_text("\n".join(["reach (m), force (N)", *lines]) + "\n")
    (tmp_path / "scene.yaml").write_text(HEAVE.read_text())
    changes = {f"{TENSIONERS}.gas": None, f"{TENSIONERS}.table": {"file": "law.csv"}}
    from_file = load_scene(tmp_path / "scene.yaml", **changes).resolved()
    assert from_file.top.tensioners == tabulated(rows, {}).resolved().top.tensioners


def rows(*pairs):
    return [{"reach": f"{x} m", "force": f"{f} kN"} for x, f in pairs]


@pytest.mark.parametrize(
    "table, stroke, said",
    [
        (rows((-1, 5), (1, 4)), None, "force decreases to 4000 N in row 2"),
        (rows((-1, 5), (1, 6), (1, 7)), None, "not greater than in the row before"),
        (rows((1, 5), (2, 6)), None, "without mid-stroke"),
        (rows((-1, -5), (1, 6)), None, "greater than or equal to 0"),
        (rows((-1, 5)), None, "at least 2"),
        (rows((-5, 5), (5, 6)), (-7, 4), "extend it to the whole stroke, -7 m to 4 m"),
        (rows((-5, 5), (5, 6)), (-4, 7), "extend it to the whole stroke, -4 m to 7 m"),
    ],
)
def test_a_table_that_is_no_law_is_refused(table, stroke, said):
    more = {}
    if stroke:
        shortest, longest = (f"{x} m" for x in stroke)
        stop = {"shortest": shortest, "longest": longest, "stop_stiffness": "1e9 N/m"}
        more[f"{TENSIONERS}.stroke"] = stop
    with pytest.raises(InputError) as refused:
        tabulated(table, more)
    assert "top.tensioners" in str(refused.value)
    assert said in str(refused.value)


def test_a_linear_table_is_straight_between_its_rows_and_beyond():
    table = [
        TableRow.model_construct(reach=x, force=f)
        for x, f in ((-4.0, 1e5), (0.0, 2e5), (1.0, 5e5), (5.0, 6e5))
    ]
    law = table_law(table, "linear")
    np.testing.assert_allclose(
        law([-4.0, -2.0, 0.0, 0.5, 3.0, 5.0, 6.0, -5.0]),
        [1e5, 1.5e5, 2e5, 3.5e5, 5.5e5, 6e5, 6.25e5, 0.75e5],
        rtol=1e-9,
    )
    assert not np.allclose(table_law(table)(0.25), law(0.25), rtol=1e-3)


@pytest.mark.long
def test_a_linear_table_of_one_slope_moves_like_a_linear_tensioner():
    line = {"tension": "300 kN", "stiffness": "20 kN/m"}
    rows = [{"reach": f"{x} m", "force": f"{300 + 20 * x} kN"} for x in (-8, -1, 8)]
    linear = {f"{TENSIONERS}.gas": None, f"{TENSIONERS}.linear": line, **MOVING}
    one = simulate(load_scene(HEAVE, **linear))
    other = simulate(tabulated(rows, MOVING | {f"{TENSIONERS}.interpolation": "linear"}))
    np.testing.assert_allclose(other["tensioner_force"], one["tensioner_force"], rtol=1e-9)


def test_interpolation_without_a_table_is_refused():
    with pytest.raises(InputError, match="no effect without a table"):
        load_scene(HEAVE, **{f"{TENSIONERS}.interpolation": "linear"})


steps = st.lists(
    st.tuples(st.floats(0.1, 5.0), st.one_of(st.just(0.0), st.floats(0.0, 1e6))), min_size=2, max_size=12
)


@given(steps)
def test_between_its_rows_the_law_rises_with_a_continuous_slope(grown):
    reach = list(accumulate((dx for dx, _ in grown), initial=-3.0))
    force = list(accumulate((df for _, df in grown), initial=2e5))
    law = table_law([TableRow.model_construct(reach=x, force=f) for x, f in zip(reach, force, strict=True)])
    np.testing.assert_allclose(law(reach), force, rtol=1e-9)
    fine = np.linspace(reach[0] - 4.0, reach[-1] + 4.0, 2001)
    assert np.diff(law(fine)).min() > -1e-6 * force[-1] * 1e-6  # rounding
    slope, tiny = law.derivative(), 1e-9
    stiff = max(np.diff(force) / np.diff(reach))
    for x in reach:
        assert slope(x - tiny) == pytest.approx(slope(x + tiny), abs=1e-6 * stiff + 1e-6)
