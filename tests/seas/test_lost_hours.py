"""Hours that each limit on the sea takes, against hours without this limit."""

import numpy as np
import pytest
from test_record_traps import written

from riserstudy.seas.hours import hours, sea_limit
from riserstudy.seas.record import read_record

TEXTS = ("hs <= {:.2f} m", "wind <= {:.2f} m/s", "current <= {:.2f} m/s", "tp <= {:.2f} s")


def of_seed(seed):
    """Columns of a record, and two to four limits."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(300, 900))
    size = np.exp(0.3 * draw.standard_normal((4, count)) + 0.3 * draw.standard_normal(count))
    columns = dict(zip(("hs (m)", "wind (m/s)", "current (m/s)", "tp (s)"), size, strict=True))
    columns["tp (s)"] += 3.0
    chosen = draw.permutation(4)[: int(draw.integers(2, 5))]
    texts = [TEXTS[k].format(draw.uniform(0.8, 1.8) + 3.0 * (k == 3)) for k in chosen]
    return columns, [sea_limit(text) for text in texts]


@pytest.mark.parametrize("seed", range(12))
def test_a_limit_takes_alone_what_its_absence_would_give(tmp_path, seed):
    columns, limits = of_seed(seed)
    record = read_record(written(tmp_path, columns))
    found = hours(record, limits)
    assert [one.limit for one in found.lost] == [str(one) for one in limits]
    for limit, lost in zip(limits, found.lost, strict=True):
        others = hours(record, [one for one in limits if one is not limit])
        assert lost.alone == pytest.approx(others.share - found.share)
        assert lost.exceeded == pytest.approx(1.0 - hours(record, [limit]).share)
    assert not hours(record, limits[:1]).lost


@pytest.mark.parametrize("seed", range(3))
def test_the_command_prints_the_hours_of_each_limit(tmp_path, commands, seed):
    columns, limits = of_seed(seed)
    path = written(tmp_path, columns)
    asked = [f"{one.quantity.name} <= {one.value!r} {one.quantity.unit}" for one in limits]
    words = [word for text in asked for word in ("--limit", text)]
    code, out, _ = commands("downtime", str(path), *words)
    assert code == 0
    for lost in hours(read_record(path), limits).lost:
        assert f"{lost}\n" in out
        assert f"not met in {100.0 * lost.exceeded:.2f}% of the rows" in out
