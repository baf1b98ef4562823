"""Records of sea states, and the hours, windows and waits that limits leave of them."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.cli import app
from riserstudy.errors import InputError
from riserstudy.seas.hours import hours, sea_limit
from riserstudy.seas.record import gaps, read_record, with_peak_period, write_record
from riserstudy.seas.synthetic import synthetic
from riserstudy.seas.windows import statistics_of, waits, windows
from riserstudy.seas.years import by_year
from riserstudy.study.spacing import stretches

ROWS = ["time,hs (m),tz (s)"] + [
    f"2001-01-{day:02d} {hour:02d}:00,{1 + 0.1 * hour:.3f},5" for day in range(1, 9) for hour in range(24)
]


@pytest.fixture
def csv(tmp_path):
    """Write lines to a file."""

    def write(lines):
        path = tmp_path / "sea.csv"
        path.write_text("\n".join(lines) + "\n")
        return path

    return write


def changed(row, text):
    """The rows with one of them replaced; 2 is the first after the header."""
    return [*ROWS[: row - 1], text, *ROWS[row:]]


def test_a_record_is_the_same_in_other_units_separators_and_forms_of_time(csv):
    plain = read_record(csv(ROWS))
    other = ["time (YYYY-MM-DD-hh); significant wave height (ft); zero-up-crossing period (min)"]
    for row in ROWS[1:]:
        time, height, period = row.split(",")
        said = time[:13].replace(" ", "-")
        other.append(f"{said}; {float(height) / 0.3048!r}; {float(period) / 60.0!r}")
    xr.testing.assert_allclose(read_record(csv(other)), plain)


def test_a_record_comes_back_from_the_file_that_it_is_written_to(tmp_path):
    made = synthetic(1, 3)
    write_record(made, tmp_path / "sea.nc")
    again = read_record(tmp_path / "sea.nc")
    xr.testing.assert_allclose(again, made)
    assert again["significant_wave_height"].attrs == made["significant_wave_height"].attrs


def test_gaps_are_named_and_rows_without_a_value_are_neither_workable_nor_not(csv):
    lines = [line for k, line in enumerate(ROWS) if not 50 <= k < 60]
    lines[5] = "2001-01-01 04:00,,5"
    record = read_record(csv(lines))
    (gap,) = gaps(record)
    assert (gap.after - gap.before) / np.timedelta64(1, "h") == 11
    found = hours(record, [sea_limit("hs <= 2 m")])
    assert (found.rows, found.lacking) == (len(lines) - 2, 1)


@pytest.mark.parametrize(
    "lines, said",
    [
        (["time,hs,tz (s)", *ROWS[1:]], "hs: the heading has no unit"),
        (["time,hs (s),tz (s)", *ROWS[1:]], "hs"),
        (["time,hs (m),period (s)", *ROWS[1:]], "period.*peak_period or zero_crossing_period"),
        (["time,hs (m),direction (deg)", *ROWS[1:]], "wave_from_direction"),
        (["hour,hs (m),tz (s)", *ROWS[1:]], "time: this column is missing"),
        (
            ["time,hs (m),u10 (m/s),v10 (m/s)", *(f"{row},3" for row in ROWS[1:])],
            "u10, v10: these are the components",
        ),
        (["time,tp (s),tz (s)", *ROWS[1:]], "significant_wave_height"),
        (["time,hs (m),hm0 (m)", *ROWS[1:]], "two columns"),
        (changed(7, "2001-01-01 05:00,-0.5,5"), "row 7: significant_wave_height: -0.5 m"),
        (changed(7, "2001-01-01 05:00,big,5"), "row 7: hs: 'big'"),
        (changed(7, "2001-01-01 05:00,50,5"), "row 7"),
        (changed(7, "2001-01-01 03:00,1,5"), "row 7: time: the time is not after"),
        (changed(7, "yesterday,1,5"), "row 7: time"),
        (ROWS[:2], "the record has 1 row;"),
    ],
)
def test_a_bad_record_is_refused_with_its_place(csv, lines, said):
    with pytest.raises(InputError, match=said):
        read_record(csv(lines))


def test_peak_periods_of_a_jonswap_spectrum_follow_from_its_moments():
    """The relation used, against the moments of the spectrum itself."""
    peak = 9.0
    f = np.linspace(0.2 / peak, 20.0 / peak, 200_000)
    for gamma in (1.0, 2.0, 3.3, 5.0):
        width = np.where(f <= 1.0 / peak, 0.07, 0.09)
        bump = gamma ** np.exp(-0.5 * ((f * peak - 1.0) / width) ** 2)
        density = f**-5 * np.exp(-1.25 * (f * peak) ** -4) * bump
        zero = np.sqrt(np.trapezoid(density, f) / np.trapezoid(f**2 * density, f))
        record = xr.Dataset({"zero_crossing_period": ("time", [zero])})
        assert with_peak_period(record, gamma)["peak_period"].item() == pytest.approx(peak, rel=0.01)


def counted(workable, joined, rows):
    """Windows and waits hour by hour, as one would count them by hand."""
    n = len(workable)
    seen = [k + rows <= n and all(joined[k : k + rows - 1]) for k in range(n)]
    starts = [seen[k] and all(workable[k : k + rows]) for k in range(n)]
    found = []
    for k in range(n):
        at = k
        while seen[at] and not starts[at] and at + 1 < n and joined[at]:
            at += 1
        found.append((at - k + (seen[at] and not starts[at]), starts[at]))
    inside = np.zeros(n, bool)
    for k in np.flatnonzero(starts):
        inside[k : k + rows] = True
    return np.array(starts), inside, found


@pytest.mark.parametrize("seed", range(30))
def test_windows_and_waits_are_those_counted_by_hand(seed):
    draw = np.random.default_rng(seed)
    n, rows = int(draw.integers(2, 60)), int(draw.integers(1, 6))
    workable = draw.random(n) < 0.7
    joined = draw.random(n - 1) < 0.9
    starts, inside, waited = counted(workable, joined, rows)
    of = windows(workable, joined, rows)
    ends = np.array([k + rows <= n and all(joined[k : k + rows - 1]) for k in range(n)])
    around = np.array(
        [all(j >= 0 and j < n and ends[j] for j in range(k - rows + 1, k + 1)) for k in range(n)]
    )
    for share, flags in ((of.starts, starts[ends]), (of.inside, inside[around])):
        assert share == pytest.approx(flags.mean()) if flags.size else np.isnan(share)
    long = stretches(workable, joined)
    assert of.number == sum(last - first >= rows for first, last in long)
    found = waits(workable, joined, rows, 1.0)
    assert list(zip(found.hours.tolist(), found.known.tolist(), strict=True)) == waited


def test_waits_without_gaps_have_their_plain_statistics():
    draw = np.random.default_rng(4)
    workable = draw.random(20_000) < 0.8
    workable[-100:] = True
    found = waits(workable, np.ones(19_999, bool), 5, 1.0)
    of = statistics_of(type(found)(found.hours[:-5], found.known[:-5]))
    plain = found.hours[:-5]
    assert of.mean == pytest.approx(plain.mean(), rel=1e-9)
    assert of.p50 == np.quantile(plain, 0.5, method="inverted_cdf")
    assert of.p90 == np.quantile(plain, 0.9, method="inverted_cdf")


def test_waits_that_are_cut_short_do_not_make_the_others_shorter():
    """Waits of an exponential law of which two fifths are cut off at random: the mean stays."""
    draw = np.random.default_rng(5)
    true, cut = draw.exponential(10.0, 40_000), draw.exponential(15.0, 40_000)
    of = statistics_of(waits_of(np.minimum(true, cut), true <= cut))
    assert of.open == np.count_nonzero(true > cut)
    none = statistics_of(waits_of(cut, np.zeros(len(cut), bool)))
    assert none.open == len(cut)
    assert np.isnan([none.mean, none.p50, none.p90]).all()
    assert of.mean == pytest.approx(10.0, rel=0.03)
    assert of.p90 == pytest.approx(10.0 * np.log(10.0), rel=0.03)


@pytest.mark.parametrize("seed", range(6))
def test_a_mean_is_told_only_of_waits_that_the_record_sees_to_their_end(seed):
    draw = np.random.default_rng(seed)
    true, longest = draw.exponential(10.0, 4000), draw.uniform(5.0, 40.0)
    of = statistics_of(waits_of(np.minimum(true, longest), true <= longest))
    assert np.isnan(of.mean)
    if not np.isnan(of.p50):
        assert of.p50 == np.quantile(true, 0.5, method="inverted_cdf")
    whole = statistics_of(waits_of(true, np.ones(4000, bool)))
    assert whole.mean == pytest.approx(true.mean())


def waits_of(values, known):
    """Waits by their values."""
    from riserstudy.seas.windows import Waits

    return Waits(values, known)


def test_rows_count_by_year():
    begin, end = np.datetime64("2001-01-01"), np.datetime64("2011-01-01")
    time = np.arange(begin, end, np.timedelta64(1, "h"))
    years = by_year(time, np.arange(len(time)) % 2 == 0, 1.0)
    assert [year.recorded for year in years] == [1.0] * 10
    assert [year.share for year in years] == [0.5] * 10
    assert [year.year for year in years] == [*range(2001, 2011)]


def test_a_synthetic_record_has_the_statistics_that_it_is_said_to_have():
    record = synthetic(30, 2)
    height = record["significant_wave_height"]
    assert float(height.median()) == pytest.approx(1.8, rel=0.05)
    months = np.log(height).groupby("time.month").mean()
    assert float(months.sel(month=1)) - np.log(1.8) == pytest.approx(np.log(1.45), abs=0.06)
    about = np.log(height).groupby("time.month") - months
    assert float(about.std()) == pytest.approx(0.39, rel=0.06)
    xr.testing.assert_identical(record, synthetic(30, 2))
    assert not record.equals(synthetic(30, 3))

    (steps,) = np.unique(np.diff(record["time"].values) / np.timedelta64(1, "h"))
    assert record.attrs["interval_hours"] == steps


@pytest.mark.parametrize("text", ["hs < 2 m", "hs <= 2", "height <= 2 m", "hs <= 2 s", "", "hs"])
def test_a_limit_in_seas_that_cannot_be_meant_is_refused(text):
    with pytest.raises(InputError, match="--limit"):
        sea_limit(text)


def test_limits_together_leave_no_more_than_each(tmp_path):
    record = synthetic(1, 1)
    one, two = sea_limit("hs <= 2 m"), sea_limit("tp <= 9 s")
    both = hours(record, [one, two]).workable
    each = [hours(record, [limit]).workable for limit in (one, two)]
    np.testing.assert_array_equal(both, each[0] & each[1])
    with pytest.raises(InputError, match="the record has no such column"):
        hours(record, [sea_limit("wind_speed <= 10 m/s")])
    with pytest.raises(InputError, match="not a multiple of the interval"):
        hours(record, [one]).of_windows(1.5)


def test_the_commands_agree_with_each_other(tmp_path, capsys):
    record, table, picture = tmp_path / "sea.nc", tmp_path / "hours.csv", tmp_path / "hours.png"
    app(["seas", "--synthetic", "3", "-o", str(record)], standalone_mode=False)
    assert "26280 rows" in capsys.readouterr().out
    words = ["downtime", str(record), "--limit", "hs <= 2 m", "--window", "24 h", "--hold-back", "1"]
    app([*words, "--csv", str(table), "--plot", str(picture)], standalone_mode=False)
    said = capsys.readouterr().out
    share = hours(read_record(record), [sea_limit("hs <= 2 m")]).share
    assert f"workable: {share:.2%} of all" in said
    assert "held back from 2003 on" in said
    assert len(table.read_text().splitlines()) == 4
    assert picture.stat().st_size > 10_000
