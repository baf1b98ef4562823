"""Damage over years: sums over sea states against sums by hand, and what cannot be meant is refused."""

import json
import math

import numpy as np
import pytest
import xarray as xr
from fatigued_rigs import INSIDE, WELD, fatigued
from random_rigs import moving, written

from riserstudy.errors import InputError
from riserstudy.fatigue import tables
from riserstudy.fatigue.occurrence import of_record, of_table
from riserstudy.fatigue.years import axes_of, over_years
from riserstudy.figures.fatigue import fatigue as drawn

HEIGHTS, PERIODS = np.arange(1.0, 10.0), np.arange(5.0, 18.0, 1.5)
WAVE = {
    "significant_height": "3 m",
    "peak_period": "9 s",
    "peak_enhancement": 2,
    "components": 20,
    "seed": 1,
    "above_mean_level": "none",
}


def rate(height, period, power=4.0):
    """Damage a year of a made-up detail, growing as a power of the height, largest at 9 s."""
    return 1e-4 * height**power * np.exp(-(((period - 9.0) / 6.0) ** 2))


def study(power=4.0, heights=HEIGHTS, periods=PERIODS, seeds=(1,), details=(WELD, INSIDE), by=rate):
    """A study as if simulated: the first detail at 3 of 4 places, the second a tenth at all."""
    h, p = np.meshgrid(heights, periods, indexing="ij")
    base = by(h, p, power)
    angles, s = np.arange(8) * 45.0, np.array([0.0, 10.0, 20.0, 30.0])
    shape = np.cos(np.radians(angles - 45.0)) ** 2
    along = np.array([[np.nan, 0.2, 1.0, 0.5], [0.1, 0.1, 0.1, 0.05]])[: len(details)]
    rates = base[:, :, None, None, None] * shape[:, None] * along[:, None, :]
    rates = np.stack([rates * (1.0 + 0.1 * k) for k in range(len(seeds))], axis=2)
    tree = fatigued(moving(4, spatial=False), *details) | {"wave": WAVE}
    tree["analysis"]["output"]["interval"] = 0.1
    tree["platform"] = {name: one for name, one in tree["platform"].items() if "amplitude" not in one}
    axes = ("significant_height", "peak_period", "seed")
    data = xr.Dataset(
        {"damage_rate": ((*axes, "detail", "wall_angle", "s_node"), rates)},
        {
            "significant_height": heights,
            "peak_period": periods,
            "seed": list(map(float, seeds)),
            "detail": [detail["name"] for detail in details],
            "wall_angle": angles,
            "s_node": s,
        },
        {"scene": json.dumps(written(tree)), "tables": "{}"},
    )
    for axis, unit, path in zip(
        axes, ("m", "s", "1"), ("significant_height", "peak_period", "seed"), strict=True
    ):
        values = {
            str(v): {f"wave.{path}": int(v) if path == "seed" else f"{v} {unit}"}
            for v in data[axis].values.tolist()
        }
        data[axis].attrs = {"units": unit, "sets": json.dumps(values)}
    data["point_key"] = (axes, np.full(rates.shape[:3], "key"))
    data["error_damage"] = (axes, np.full(rates.shape[:3], 0.02))
    return data


def table(tmp_path, text):
    path = tmp_path / "scatter.csv"
    path.write_text(text)
    return path


def summed(of, path, **options):
    return over_years(of, of_table(path, of, axes_of(of)), {}, **options)


def test_simulated_sea_states_are_summed_by_their_shares(tmp_path):
    """By hand; the place where the sum is largest, the safety factor, the life."""
    path = table(tmp_path, "hs (m),tp (s),share (%)\n1,8,60\n3,9.5,30\n6,11,10\n")
    found = summed(study(), path)
    expected = 0.6 * rate(1.0, 8.0) + 0.3 * rate(3.0, 9.5) + 0.1 * rate(6.0, 11.0)
    weld, inside = found.worst
    assert weld.rate == pytest.approx(expected, rel=1e-12)
    assert (weld.s, weld.angle, weld.safety_factor) == (20.0, 45.0, 10.0)
    assert weld.life == pytest.approx(1.0 / (10.0 * expected))
    assert inside.rate == pytest.approx(0.1 * expected)
    assert inside.s == 0.0
    assert weld.error_between == 0.0
    assert np.isnan(found.rates[0, :, 0]).all()
    assert not found.notes
    assert found.error_runs == pytest.approx(0.02)


def test_damage_does_not_depend_on_units_names_or_order_of_a_table(tmp_path):
    texts = [
        "hs (m),tp (s),share (%)\n1,8,25\n3,9.5,75\n",
        "peak_period (s),share (%),significant_height (ft)\n9.5,75,9.842519685\n8,25,3.280839895\n",
        "Hs (m),Tp (min),time (h)\n1,0.13333333333333333,2191.5\n3,0.15833333333333333,6574.5\n",
        "hs (cm),tp (s),count\n300,9.5,3\n100,8,1\n",
    ]
    rates = [summed(study(), table(tmp_path, text)).worst[0].rate for text in texts]
    assert np.allclose(rates, rates[0], rtol=1e-9, atol=0.0)


def test_a_table_in_two_halves_adds_up(tmp_path):
    head = "hs (m),tp (s),share (%)\n"
    one, other = "2.5,8.3,20\n4.1,9.9,30\n", "5.6,12.2,5\n"
    both = summed(study(), table(tmp_path, head + one + other)).rates
    parts = [summed(study(), table(tmp_path, head + text)).rates for text in (one, other)]
    assert np.nansum(abs(both - parts[0] - parts[1])) < 1e-12 * np.nansum(both)


@pytest.mark.parametrize("power", [3.0, 4.0, 5.0])
@pytest.mark.parametrize("seed", range(5))
def test_the_error_between_simulated_seas_covers_the_true_one(seed, power, tmp_path):
    """Random sea states against the function that the study samples, and it falls with the grid."""
    draw = np.random.default_rng(seed)
    heights, periods = draw.uniform(1.0, 9.0, 200), draw.uniform(5.0, 17.0, 200)
    rows = "".join(f"{h!r},{p!r},0.5\n" for h, p in zip(heights.tolist(), periods.tolist(), strict=True))
    path = table(tmp_path, "hs (m),tp (s),share (%)\n" + rows)
    true = 0.005 * rate(heights, periods, power).sum()
    found = summed(study(power), path).worst[0]
    off = abs(found.rate / true - 1.0)
    assert off <= 1.5 * found.error_between + 1e-3
    fine = summed(study(power, np.linspace(1.0, 9.0, 17), np.linspace(5.0, 17.0, 17)), path).worst[0]
    assert fine.error_between < 0.5 * found.error_between


@pytest.mark.parametrize("seed", range(8))
def test_a_damage_whose_fourth_root_is_linear_has_no_error_between_seas(seed, tmp_path):
    """On uneven grids of odd and even numbers of values, up to their ends."""
    draw = np.random.default_rng(seed)
    counts = draw.integers(3, 9, 2)
    grids = [np.sort([low, high, *draw.uniform(low, high, n - 2)])
             for (low, high), n in zip(((1.0, 9.0), (5.0, 17.0)), counts, strict=True)]  # fmt: skip

    def by(height, period, power):
        return (0.1 * height + 0.02 * period) ** power

    heights, periods = (np.append(draw.uniform(grid[0], grid[-1], 20), grid[[0, -1]]) for grid in grids)
    rows = "".join(f"{h!r},{p!r},1\n" for h, p in zip(heights.tolist(), periods.tolist(), strict=True))
    path = table(tmp_path, "hs (m),tp (s),share (%)\n" + rows)
    found = summed(study(4.0, *grids, by=by), path).worst[0]
    assert found.rate == pytest.approx(0.01 * by(heights, periods, 4.0).sum(), rel=1e-9)
    assert found.error_between == pytest.approx(0.0, abs=1e-9)


def test_seeds_count_alike_and_tell_what_is_chance(tmp_path):
    """Damage of 1, 1.1 and 1.2 times one: the mean, and its standard error."""
    path = table(tmp_path, "hs (m),tp (s),share (%)\n3,9.5,100\n")
    one, three = (summed(study(seeds=seeds), path).worst[0] for seeds in ((1,), (1, 2, 3)))
    assert three.rate == pytest.approx(1.1 * one.rate)
    assert three.chance == pytest.approx(0.1 / 1.1 / math.sqrt(3.0))
    assert math.isnan(one.chance)


def test_the_seas_that_bring_half_are_the_fewest_that_do(tmp_path):
    path = table(tmp_path, "hs (m),tp (s),share (%)\n1,8,40\n3,9.5,30\n4,8,20\n6,11,8\n8,12.5,2\n")
    found = summed(study(), path)
    damages = [sea.damage for sea in found.seas]
    assert damages == sorted(damages, reverse=True)
    assert sum(damages) == pytest.approx(found.worst[0].rate)
    half = sum(sea.damage for sea in found.half)
    assert half >= 0.5 * sum(damages) > half - found.half[-1].damage
    assert sum(sea.share for sea in found.seas) == pytest.approx(1.0)


def test_a_record_of_seas_is_a_table_of_its_hours(tmp_path):
    draw = np.random.default_rng(3)
    hours = 500
    heights, periods = (
        np.round(draw.uniform(1.0, 8.0, hours), 1),
        np.round(draw.uniform(6.0, 15.0, hours), 1),
    )
    heights[7] = np.nan
    record = xr.Dataset(
        {
            "significant_wave_height": ("time", heights, {"units": "m"}),
            "peak_period": ("time", periods, {"units": "s"}),
        },
        {"time": np.arange(hours)},
    )
    of = study()
    occurs = of_record(record, of, axes_of(of))
    whole = ~np.isnan(heights)
    rows = "".join(f"{h},{p},1\n" for h, p in zip(heights[whole], periods[whole], strict=True))
    expected = summed(of, table(tmp_path, "hs (m),tp (s),count\n" + rows))
    found = over_years(of, occurs, {})
    assert found.worst[0].rate == pytest.approx(expected.worst[0].rate, rel=1e-12)
    assert found.notes == ("1 row of the record without a value, not counted",)


@pytest.mark.parametrize(
    "text, said",
    [
        ("hs,tp (s),share (%)\n1,8,10\n", "no unit"),
        ("hs (kg),tp (s),share (%)\n1,8,10\n", "wrong dimension"),
        ("hs (m),tp (s)\n1,8\n", "does not state how often sea states occur"),
        ("hs (m),tp (s),share\n1,8,10\n", "the unit '' is wrong"),
        ("hs (m),tp (s),share (%),count\n1,8,10,1\n", "two columns state"),
        ("hs (m),wind (m/s),share (%)\n1,8,10\n", "not an axis of the study"),
        ("hs (m),share (%)\n1,10\n", "neither here nor in the table"),
        ("hs (m),tp (s),share (%)\n1,8,90\n2,8,20\n", "add up to 110 %"),
        ("hs (m),tp (s),share (%)\n1,8,-1\n2,8,20\n", "give 0 or more"),
        ("hs (m),tp (s),share (%)\n1,eight,10\n", "row 2: tp"),
        ("hs (m),tp (s),share (%)\n1,8\n", "2 cells"),
        ("hs (m),tp (s),share (%)\n12,8,5\n", "outside the simulated range 1 to 9"),
        ("hs (m),tp (s),share (%)\n0.5,8,5\n", "--calm"),
        ("hs (m),tp (s),share (%)\n1,30,5\n", "outside the simulated range 5 to 17"),
        ("hs (m),tp (s),share (%)\n", "has no rows"),
        ("hs (m),wave_period (s),share (%)\n3,9.5,10\n", "ambiguous"),
        ("wave_height (m),tp (s),share (%)\n3,9.5,10\n", "ambiguous"),
        ("hs (m),hm0 (m),tp (s),share (%)\n3,4,9.5,10\n", "two columns give significant_height"),
    ],
)
def test_a_table_that_cannot_be_meant_is_refused(text, said, tmp_path):
    with pytest.raises(InputError, match=said.replace("(", r"\(")):
        summed(study(), table(tmp_path, text))


@pytest.mark.parametrize("seed", range(6))
def test_rows_that_never_occur_change_nothing(seed, tmp_path):
    """Neither the damage nor its error, wherever they are."""
    draw = np.random.default_rng(seed)
    rows = [f"{h},{p},5" for h, p in zip(draw.choice(HEIGHTS, 9), draw.choice(PERIODS, 9), strict=True)]
    never = [f"{h},{p},0" for h, p in draw.uniform(0.1, 40.0, (9, 2)).tolist()]
    mixed = list(draw.permutation(rows + never))
    head = "hs (m),tp (s),share (%)"
    plain, more = (summed(study(), table(tmp_path, "\n".join([head, *of]) + "\n")) for of in (rows, mixed))
    assert [w[:-1] for w in more.worst] == [
        (*w[:3], pytest.approx(w.rate, rel=1e-12), *w[4:-1]) for w in plain.worst
    ]
    assert {sea.values for sea in more.seas} == {sea.values for sea in plain.seas}
    assert more.notes == plain.notes


@pytest.mark.parametrize("head", ["hs (m),tp (s)", "Hm0 (m),peak_period (s)"])
def test_heights_of_seas_are_none_of_regular_waves(head, tmp_path):
    """A column of waves is taken for them; H_s and T_p, of a table or a record, are not."""
    of = study().isel(seed=0, drop=True)
    names = {"significant_height": ("wave_height", "height", "m"),
             "peak_period": ("wave_period", "period", "s")}  # fmt: skip
    of = of.rename({old: name for old, (name, *_) in names.items()})
    for name, key, unit in names.values():
        values = {str(v): {f"wave.{key}": f"{v} {unit}"} for v in of[name].values.tolist()}
        of[name].attrs["sets"] = json.dumps(values)
    with pytest.raises(InputError, match="regular wave"):
        summed(of, table(tmp_path, f"{head},share (%)\n3,9.5,50\n"))
    metres, seconds = {"units": "m"}, {"units": "s"}
    sea = {
        "significant_wave_height": ("time", [3.0], metres),
        "peak_period": ("time", [9.5], seconds),
        "time": ("time", [0]),
    }
    with pytest.raises(InputError, match="regular wave"):
        over_years(of, of_record(xr.Dataset(sea), of, axes_of(of)), {})
    tree = json.loads(of.attrs["scene"])
    tree["wave"] = {"height": "3 m", "period": "9 s", "above_mean_level": "none"}
    of.attrs["scene"] = json.dumps(tree)
    waves = table(tmp_path, "wave_height (m),wave_period (s),share (%)\n3,9.5,50\n")
    assert summed(of, waves).worst[0].rate == pytest.approx(0.5 * rate(3.0, 9.5))


def test_calmer_seas_count_as_the_calmest_when_it_is_said(tmp_path):
    found = summed(study(), table(tmp_path, "hs (m),tp (s),share (%)\n0.2,8,100\n"), calm=True)
    assert found.worst[0].rate == pytest.approx(rate(1.0, 8.0))
    assert found.notes == ("significant_height below 1, 100 % of the time, is set to 1",)


def test_time_that_a_table_leaves_out_is_told(tmp_path):
    found = summed(study(), table(tmp_path, "hs (m),tp (s),share (%)\n2,8,90\n"))
    assert found.notes == ("10 % of the time is not in scatter.csv and does no damage",)


def test_points_without_numbers_are_refused(tmp_path):
    of = study()
    of["damage_rate"][2, 3] = np.nan
    with pytest.raises(InputError, match="some points have no results"):
        summed(of, table(tmp_path, "hs (m),tp (s),share (%)\n2,8,90\n"))


@pytest.mark.parametrize("seed", range(8))
def test_a_place_without_a_number_in_one_run_counts_neither_as_no_damage_nor_as_that_of_others(
    seed, tmp_path
):
    of = study(seeds=(1, 2, 3))
    values = of["damage_rate"].values
    there = np.argwhere(np.isfinite(values))
    values[tuple(np.random.default_rng(seed).choice(there))] = np.nan
    with pytest.raises(InputError, match="some points have no results"):
        summed(of, table(tmp_path, "hs (m),tp (s),share (%)\n2,8,90\n"))


def test_tables_and_figure_hold_the_same_numbers(tmp_path):
    found = summed(study(), table(tmp_path, "hs (m),tp (s),share (%)\n1,8,60\n3,9.5,30\n6,11,10\n"))
    along = tables.along(found)
    assert max(row[1] for row in along.rows if row[1] is not None) == found.worst[0].rate
    by_sea = tables.by_sea(found)
    assert by_sea.rows[-1][-1] == pytest.approx(100.0)
    assert len(tables.by_sea(found, all_of_them=False).rows) == len(found.half)
    figure = drawn(found)
    assert "Factored life of weld" in figure.get_suptitle()


def test_a_dataset_without_damage_is_refused():
    with pytest.raises(InputError, match="damage_rate"):
        axes_of(xr.Dataset())


def test_the_command_prints_tables_and_writes_files(tmp_path, commands, monkeypatch):
    monkeypatch.chdir(tmp_path)
    study().to_netcdf("study.nc")
    table(tmp_path, "hs (m),tp (s),share (%)\n1,8,60\n3,9.5,30\n6,11,10\n")
    words = ["--csv", "a.csv", "--along", "b.csv", "--by-sea", "c.csv", "--plot", "d.png"]
    code, said, _ = commands("fatigue", "study.nc", "--scatter", "scatter.csv", *words)
    assert code == 0
    assert "half of the damage of weld" in said
    assert all((tmp_path / name).stat().st_size for name in words[1::2])
    code, _, fault = commands("fatigue", "study.nc")
    assert code == 2
    assert "--scatter" in fault


@pytest.mark.parametrize(
    "first, second", [("--csv", "--along"), ("--csv", "--by-sea"), ("--along", "--by-sea")]
)
def test_two_tables_of_one_name_are_refused(tmp_path, commands, monkeypatch, first, second):
    """The second would replace the first."""
    monkeypatch.chdir(tmp_path)
    study().to_netcdf("study.nc")
    table(tmp_path, "hs (m),tp (s),share (%)\n1,8,60\n3,9.5,30\n6,11,10\n")
    words = [first, "a.csv", second, tmp_path / "a.csv"]
    code, said, fault = commands("fatigue", "study.nc", "--scatter", "scatter.csv", *words)
    assert (code, said) == (2, "")
    assert first in fault
    assert second in fault
    assert not (tmp_path / "a.csv").exists()


@pytest.mark.parametrize("seed", range(6))
def test_an_unknown_error_of_runs_is_stated(tmp_path, commands, monkeypatch, seed):
    """Some runs or all lack an estimate: a line gives the number of sea states that have one, or none."""
    monkeypatch.chdir(tmp_path)
    draw = np.random.default_rng(seed)
    known = np.array([True, bool(seed % 3), False])[draw.permutation(3)] & (seed % 2 == 0)
    made = study(heights=np.array([1.0, 3.0, 6.0]), periods=np.array([8.0, 9.5]))
    made["error_damage"] = made["error_damage"].where(xr.DataArray(known, dims="significant_height"))
    made.to_netcdf("study.nc")
    table(tmp_path, "hs (m),tp (s),share (%)\n1,8,60\n3,9.5,30\n6,8,10\n")
    code, said, _ = commands("fatigue", "study.nc", "--scatter", "scatter.csv")
    (line,) = [line for line in said.splitlines() if "error of damage in runs" in line]
    assert code == 0
    assert ("unknown" in line) == (not known.any())
    assert not known.any() or line.endswith(f"known for {known.sum()} of 3 sea states")


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_lines_of_a_table_may_end_as_on_any_system(tmp_path, end):
    """Lines that end with a carriage return alone ended in a traceback."""
    rows = ["hs (m),tp (s),share (%)", "1,8,60", "3,9.5,30", "6,11,10"]
    path = tmp_path / "scatter.csv"
    path.write_bytes((end.join(rows) + end).encode())
    expected = 0.6 * rate(1.0, 8.0) + 0.3 * rate(3.0, 9.5) + 0.1 * rate(6.0, 11.0)
    assert summed(study(), path).worst[0].rate == pytest.approx(expected, rel=1e-12)
