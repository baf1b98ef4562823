"""Values exceeded once in many years: against distributions that are known, and how often bands hold them."""

import math

import numpy as np
import pytest

from riserstudy.errors import InputError
from riserstudy.seas.return_values import of_peaks, of_years, return_values, storms
from riserstudy.seas.synthetic import synthetic


def test_many_years_give_the_value_that_their_distribution_has():
    largest = np.random.default_rng(1).gumbel(8.0, 1.2, 20000)
    for years in (10.0, 100.0, 1000.0):
        true = 8.0 - 1.2 * math.log(-math.log(1.0 - 1.0 / years))
        assert of_years(largest[:2000], years).value == pytest.approx(true, rel=0.03)
        assert np.quantile(largest, 1.0 - 1.0 / years) == pytest.approx(true, rel=0.03)


@pytest.mark.long
@pytest.mark.parametrize("shape", [-0.2, 0.0, 0.2])
def test_many_storms_give_the_value_that_their_distribution_has(shape):
    """Six peaks a year for a thousand years; exceeded once in 50 years is one in 300 of them."""
    draw = np.random.default_rng(2)
    chance = draw.uniform(size=6000)
    over = -np.log(chance) if shape == 0.0 else (chance**-shape - 1.0) / shape
    found = of_peaks(5.0 + over, 5.0, 1000.0, 50.0)
    true = math.log(300.0) if shape == 0.0 else (300.0**shape - 1.0) / shape
    assert found.value == pytest.approx(5.0 + true, rel=0.03)
    assert found.low < found.value < found.high


def test_bands_of_ten_years_hold_the_true_value_about_nine_times_in_ten():
    true = 8.0 - 1.2 * math.log(-math.log(1.0 - 1.0 / 50.0))
    held = 0
    for seed in range(200):
        largest = np.random.default_rng(seed).gumbel(8.0, 1.2, 10)
        found = of_years(largest, 50.0, seed)
        held += found.low <= true <= found.high
    assert 0.75 <= held / 200 <= 0.97  # a band of so few is too narrow rather than too wide


def test_both_methods_agree_on_a_record_of_many_years_within_their_bands():
    record = synthetic(30, 7)
    table = return_values(record["time"].values, record["significant_wave_height"].values, 1.0, [10.0, 100.0])
    for _, value, low, high, other, below, above in table.rows:
        assert low < value < high
        assert below < other < above
        assert max(low, below) < min(high, above)
    assert table.rows[1][1] > table.rows[0][1]


def test_peaks_are_of_storms_apart_and_above_their_threshold():
    record = synthetic(4, 3)
    time, values = record["time"].values, record["significant_wave_height"].values
    peaks, threshold = storms(time, values, 4.0)
    assert len(peaks) == 24
    assert peaks.min() >= threshold
    at = np.sort(time[np.isin(values, peaks)])
    assert (np.diff(at) >= np.timedelta64(72, "h")).all()
    assert peaks.max() == values.max()
    # storm after storm, each with all rows around its peak taken out
    left, found = values.copy(), []
    for _ in range(25):
        top = int(left.argmax())
        found.append(left[top])
        left[np.abs(time - time[top]) < np.timedelta64(72, "h")] = 0.0
    assert [*peaks, threshold] == found


def test_missing_values_and_another_unit_change_nothing_that_they_should_not():
    record = synthetic(6, 3)
    time, values = record["time"].values, record["significant_wave_height"].values.copy()
    plain = return_values(time, values, 1.0, [20.0])
    feet = return_values(time, values / 0.3048, 1.0, [20.0])
    np.testing.assert_allclose(np.array(feet.rows)[:, 1:] * 0.3048, np.array(plain.rows)[:, 1:])
    values[::9] = np.where(values[::9] < 2.0, np.nan, values[::9])
    np.testing.assert_allclose(
        np.array(return_values(time, values, 1.0, [20.0]).rows)[0, 1:4], np.array(plain.rows)[0, 1:4]
    )


def test_few_years_are_refused():
    record = synthetic(3, 1)
    with pytest.raises(InputError, match="5 or more such years"):
        return_values(record["time"].values, record["significant_wave_height"].values, 1.0, [100.0])


def test_the_command_prints_both_methods_in_order(commands):
    code, out, _ = commands("seas", "--synthetic", "6", "--return-period", "20")
    row = [float(cell) for cell in out.splitlines()[-1].split()]
    assert (code, row[0]) == (0, 20.0)
    assert row[2] < row[1] < row[3]
    assert row[5] < row[4] < row[6]
