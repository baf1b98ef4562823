"""The number of finished points is read from a log as it was written, whatever else the log contains."""

import numpy as np
import pytest

from riserstudy.jobs.points_done import TAIL, PointsDone, ShowPoints, last_points

OTHERS = ("3 of 4 points cannot be completed", "12 of 40", "7 of 9 points left", "x" * 300, "", "a µ é")


@pytest.mark.parametrize("seed", range(30))
def test_the_last_number_is_found_whatever_lines_are_around_it(seed, tmp_path):
    draw = np.random.default_rng(seed)
    numbers = [PointsDone(*map(int, draw.integers(0, 10**6, 2))) for _ in range(draw.integers(0, 40))]
    lines = [line for one in numbers for line in (*draw.choice(OTHERS, draw.integers(0, 4)), str(one))]
    lines += [*draw.choice(OTHERS, draw.integers(0, 9))]  # shorter than the end that is read
    being_written = "1000000 of 1000000 points"[: draw.integers(0, 26)]
    log = tmp_path / "one.log"
    log.write_text("".join(f"{line}\n" for line in lines) + being_written, "utf-8")
    assert last_points(log) == (numbers[-1] if numbers else None)


@pytest.mark.parametrize("cut", range(30))
def test_a_line_that_the_end_of_a_long_log_cuts_is_no_number(cut, tmp_path):
    """Of ``112 of 400 points``, the end could contain ``2 of 400 points``."""
    log = tmp_path / "one.log"
    log.write_text("112 of 400 points\n" + "x" * (TAIL - cut) + "\n")
    assert last_points(log) in (None, PointsDone(112, 400))


def test_what_a_job_prints_is_what_is_read(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("riserstudy.jobs.points_done.time.monotonic", iter([1.0, 1.1, 1.2]).__next__)
    show = ShowPoints()
    for done in (1, 2, 3):
        show(done, 3)
    printed = capsys.readouterr().out
    assert len(printed.splitlines()) == 2  # the first and the last: more often nobody looks
    log = tmp_path / "one.log"
    log.write_text(printed)
    assert last_points(log) == PointsDone(3, 3)


def test_a_log_that_is_not_there_has_no_points(tmp_path):
    assert last_points(tmp_path / "none.log") is None
