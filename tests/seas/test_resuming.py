"""Operations that have stopped resume under stricter limits: hours counted row by row."""

import numpy as np
import pytest
from test_record_traps import written

from riserstudy.errors import InputError
from riserstudy.scene.limits import Limit
from riserstudy.seas.hours import check_resumes, hours, sea_limit
from riserstudy.seas.record import read_record
from riserstudy.seas.riser_hours import Met, riser_hours

START = np.datetime64("2001-03-01T00")
ANGLE = Limit(output="ufj_angle", largest="4 deg", mode="drilling")


def of_seed(tmp_path, seed):
    """A record of hours with gaps and empty cells, and values that change slowly."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(200, 700))
    size = np.exp(np.cumsum(0.2 * draw.standard_normal((2, count)), axis=1) % 1.5)
    kept = draw.random(count) > 0.03
    times = (START + np.arange(count).astype("timedelta64[h]"))[kept]
    columns = {"hs (m)": size[0][kept], "wind (m/s)": 3.0 * size[1][kept]}
    columns["wind (m/s)"][draw.random(kept.sum()) < 0.02] = np.nan
    return read_record(written(tmp_path, {"time": times.astype(str)} | columns))


def by_hand(times, met, resuming):
    """Rows in operation, one after another."""
    working, last, found = False, None, []
    for time, fine, calm in zip(times, met, resuming, strict=True):
        if last is None or time - last > np.timedelta64(1, "h"):
            working = False
        working = fine and (working or calm)
        last = time
        found.append(working)
    return np.array(found)


@pytest.mark.parametrize("seed", range(12))
def test_operations_continue_until_a_limit_and_resume_under_stricter_ones(tmp_path, seed):
    record = of_seed(tmp_path, seed)
    stop, resume = sea_limit("hs <= 3 m"), [sea_limit("hs <= 2 m"), sea_limit("wind <= 9 m/s")]
    found = hours(record, [stop], resume)
    height, wind = record["significant_wave_height"].values, record["wind_speed"].values
    known = np.isfinite(wind)  # a row without the wind can neither resume nor not resume
    expected = by_hand(
        record["time"].values[known], height[known] <= 3.0, (height <= 2.0)[known] & (wind <= 9.0)[known]
    )
    np.testing.assert_array_equal(found.workable, expected)
    assert found.waiting == pytest.approx((height[known] <= 3.0).mean() - expected.mean(), abs=1e-12)
    assert found.waiting > 0.0
    # limits that all rows meet change nothing; the limits of operation themselves neither
    for same in ([], [sea_limit("hs <= 3 m")]):
        plain = hours(record.isel(time=known), [stop], same)
        np.testing.assert_array_equal(plain.workable, height[known] <= 3.0)
        assert plain.waiting == 0.0


@pytest.mark.parametrize("seed", range(8))
def test_a_riser_waits_in_its_nominal_hours_and_in_both_ends_of_their_range(tmp_path, seed):
    record = of_seed(tmp_path, seed)
    draw = np.random.default_rng(seed)
    count = record.sizes["time"]
    demand = 0.05 + 0.03 * np.sin(0.1 * np.arange(count)) + 0.01 * draw.random(count)
    flags = [demand + of <= ANGLE.allowable for of in (0.0, 0.004, -0.004)]
    zero = np.zeros((count, 1))
    rows = Met(*(one[:, None] for one in flags), demand[:, None], zero, zero, zero, zero)
    every, calm = np.ones(count, bool), draw.random(count) < 0.3
    (mode,) = riser_hours(record, every, rows, [ANGLE], np.zeros(1), {}, calm).modes
    shares = [by_hand(record["time"].values, one, calm).mean() for one in flags]
    assert [mode.hours.share, mode.low, mode.high] == pytest.approx(shares, abs=1e-12)
    assert mode.low <= mode.hours.share <= mode.high


def test_the_command_prints_hours_of_waiting(tmp_path, commands):
    record = of_seed(tmp_path, 3)
    path = next(tmp_path.glob("*.csv"))
    found = hours(record, [sea_limit("hs <= 3 m")], [sea_limit("hs <= 2 m")])
    code, out, _ = commands("downtime", str(path), "--limit", "hs <= 3 m", "--resume", "hs <= 2 m")
    assert code == 0
    assert f"waiting to resume: {found.waiting:.2%} of the rows" in out
    assert f"workable: {found.share:.2%} of all rows" in out


@pytest.mark.parametrize("resume", ["hs <= 3 m", "hs <= 4 m"])
def test_a_limit_that_is_not_stricter_is_refused(resume):
    with pytest.raises(InputError, match="not stricter"):
        check_resumes([sea_limit("hs <= 3 m")], [sea_limit(resume, "--resume")])
    check_resumes([sea_limit("hs <= 3 m")], [sea_limit("hs <= 2 m"), sea_limit("tp <= 9 s")])
