"""Limits over a grid: what every point uses of each, in the dataset and in the report."""

import json

import numpy as np
import pytest

from riserstudy.dataset.unit_systems import UnitSystem, reading_in
from riserstudy.errors import InputError
from riserstudy.report.limits import limit_tables
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel

#: a string of 1 kN/m and 500 m: of the tension at its top 500 kN are left at its foot
HUNG = {
    "title": "hung",
    "riser": [{"name": "all", "length": "500 m", "axial_stiffness": "5e9 N", "submerged_weight": "1 kN/m"}],
    "bottom": {"hold": "wellhead", "elevation": "0 m"},
    "top": {"z": "free", "tension": "1 MN"},
    "analysis": {},
}
LIMITS = [
    {"output": "effective_tension", "smallest": "350 kN", "mode": "connected"},
    {"output": "lower_end_tension", "largest": {"assumed": "1 MN", "because": "t"}, "mode": "drilling"},
    {"output": "tensioner_stroke", "largest": "7 m", "mode": "connected"},
]  # fmt: skip
TENSIONS = [700.0, 900.0, 1600.0]  # kN
AXES = {"tension": {"path": "top.tension", "unit": "kN", "values": TENSIONS}}


def study(folder, **changes):
    (folder / "hung.yaml").write_text(json.dumps(HUNG))
    model = {"scene": "hung.yaml", "caption": "c", "axes": AXES, "limits": LIMITS} | changes
    return Study("own", "pull", StudyModel.model_validate(model), folder, "standard")


def dataset(folder, **changes):
    made = study(folder, **changes)
    return dataset_of(made, results_of(made, 1, lambda _: None)[0])


pytestmark = pytest.mark.usefixtures("own_store")


def test_every_point_says_what_it_uses_of_each_limit(tmp_path):
    found = dataset(tmp_path)
    left = np.array(TENSIONS) - 500.0
    floor, ceiling, stroke = (found.isel(limit=k) for k in range(3))
    np.testing.assert_allclose(floor["use_of_limit"], 350.0 / left, rtol=1e-9)
    np.testing.assert_allclose(ceiling["use_of_limit"], left / 1000.0, rtol=1e-9)
    np.testing.assert_allclose(ceiling["demand_of_limit"], 1e3 * left, rtol=1e-9)
    assert list(floor["verdict_of_limit"].values) == ["exceeded", "within", "within"]
    assert np.isnan(stroke["use_of_limit"]).all()
    assert set(stroke["verdict_of_limit"].values) == {"not evaluated"}
    assert found["limit"].values[0] == "connected: smallest effective_tension"
    assert json.loads(found.attrs["limits"])[1]["origin"] == "assumed"


def test_points_are_stored_without_their_limits(tmp_path, monkeypatch):
    first = dataset(tmp_path)
    monkeypatch.setattr("riserstudy.study.simulate_points._simulate", lambda *_: pytest.fail("simulated"))
    other = dataset(tmp_path, limits=[LIMITS[0] | {"smallest": "700 kN"}])
    np.testing.assert_allclose(other["use_of_limit"][:, 0], 2.0 * first["use_of_limit"][:, 0], rtol=1e-12)
    assert study(tmp_path).digest != study(tmp_path, limits=LIMITS[:1]).digest
    assert "use_of_limit" not in dataset(tmp_path, limits=None)


def test_the_report_tells_the_point_that_uses_most(tmp_path):
    (table,) = tables_of(dataset(tmp_path))
    floor, ceiling, stroke = table.rows
    assert table.points == 3
    assert (floor.demand, floor.allowable, floor.use) == ("200 kN", "350 kN", "175 %")
    assert (floor.where, floor.verdict) == ("tension 700 kN", "exceeded at 1")
    assert (ceiling.where, ceiling.verdict) == ("tension 1600 kN", "exceeded at 1")
    assert (stroke.use, stroke.verdict) == ("–", "not evaluated")


def tables_of(found, caption="riser at 12:30: pulled"):
    """Tables of the report about a study."""
    (table,) = limit_tables({"pull": found}, {"pull": caption, "other": "another study"})
    assert table.about == caption
    return [table]


@pytest.mark.parametrize("place", ["stroke", "lower x joint", "time; s: 3", ""])
def test_the_report_names_places_as_the_scene_does(place, tmp_path):
    """Only the output gets its long name, whatever a section is called; equal limits are numbered."""
    found = dataset(tmp_path)
    first, *_, last = json.loads(found.attrs["limits"])
    about = [first | {"at": place}, first | {"at": place}, last]
    found.attrs["limits"] = json.dumps(about)
    (table,) = tables_of(found)
    name = f"connected: smallest effective tension{f' at {place}' if place else ''}"
    assert [row.limit for row in table.rows][:2] == [name, f"{name} (2)"]


@pytest.mark.parametrize("seed", range(12))
def test_no_limit_that_is_not_evaluated_somewhere_passes_for_one_that_is_met(seed, tmp_path):
    draw, found = np.random.default_rng(seed), dataset(tmp_path)
    words = draw.choice(["within", "exceeded", "not evaluated"], (3, 3), p=draw.dirichlet([1.0, 1.0, 1.0]))
    found["verdict_of_limit"].values[:] = words
    found["use_of_limit"].values[:] = np.where(words == "exceeded", 1.2, 0.5)
    (table,) = tables_of(found)
    exceeded, unknown = ({k for k in range(3) if w in words[:, k]} for w in ("exceeded", "not evaluated"))
    assert table.sentences.startswith(f"{len(exceeded) or 'None'} of 3 limits ")
    assert (f"; {len(unknown)} " in table.sentences) == bool(unknown)
    assert ("not evaluated at one or more points" in table.sentences) == bool(unknown)


def test_the_report_tells_it_in_the_units_of_the_configuration(tmp_path):
    with reading_in(UnitSystem.US):
        (table,) = tables_of(dataset(tmp_path))
    floor = table.rows[0]
    assert (floor.demand, floor.allowable) == ("45 kip", "78.7 kip")  # 200 and 350 kN
    assert floor.where == "tension 157.4 kip"
    assert floor.use == "175 %"


def test_where_nothing_is_used_the_point_that_comes_nearest_is_told(tmp_path):
    floor = {"output": "effective_tension", "smallest": "0 kN", "mode": "connected"}
    (table,) = tables_of(dataset(tmp_path, limits=[floor]))
    (row,) = table.rows
    assert (row.use, row.demand, row.where) == ("margin 200 kN", "200 kN", "tension 700 kN")


def test_limits_that_cannot_be_meant_are_refused(tmp_path):
    with pytest.raises(ValueError, match="remove one of the two"):
        study(tmp_path, set={"limits": LIMITS})
    with pytest.raises(InputError, match="'colour' is not an output that can have a limit"):
        dataset(tmp_path, limits=[{"output": "colour", "largest": "1 m", "mode": "drilling"}])
    modes = {mode: {"limits": [LIMITS[0] | {"mode": mode}]} for mode in ("drilling", "connected")}
    with pytest.raises(InputError, match="same outputs"):
        dataset(tmp_path, axes={"mode": modes}, limits=LIMITS[:1])


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("named", [False, True])
@pytest.mark.parametrize("of_scene", [False, True])
def test_an_axis_of_allowables_has_each_at_its_points(seed, named, of_scene, tmp_path):
    chance = np.random.default_rng(seed)
    floors = sorted(chance.uniform(100.0, 900.0, 3).round(1).tolist())
    axis = {"path": "limits[0].smallest", "unit": "kN", "values": floors}
    whole = {
        f"floor {k}": {"limits": [LIMITS[0] | {"smallest": f"{floor} kN"}, *LIMITS[1:]]}
        for k, floor in enumerate(floors)
    }
    named |= not of_scene  # numbers have a limit of the scene to replace
    axes = AXES | {"floor": whole if named else axis}
    found = dataset(tmp_path, axes=axes, limits=LIMITS if of_scene else None)
    left = np.array(TENSIONS)[:, None] - 500.0
    use = np.array(floors) / left
    np.testing.assert_allclose(found["use_of_limit"].isel(limit=0), use, rtol=1e-9)
    np.testing.assert_allclose(found["allowable_of_limit"][0, :, 0], 1e3 * np.array(floors))
    about = json.loads(found.attrs["limits"])
    assert [row["allowable"] for row in about] == [None, 1e6, 7.0]
    floor, ceiling, _ = tables_of(found)[0].rows
    assert (floor.demand, floor.allowable) == ("200 kN", f"{floors[-1]:.3g} kN")
    assert float(floor.use.removesuffix(" %")) == pytest.approx(100.0 * use.max(), rel=5e-3)
    assert ceiling.allowable == "1000 kN"
