"""Lines of operators: order, whole turns of headings and units change nothing; none occurs twice."""

import math
import random

import numpy as np
import pytest

from riserstudy.model.rao import operator
from riserstudy.scene.rao import MOTIONS, Response
from riserstudy.scene.tables import PLACES, read_table

TURN = 360.0  # deg


def lines(rng, headed=True):
    """Headings (deg), periods (s) and, for each of both, motions with size and phase."""
    first = rng.uniform(-180.0, 180.0)
    headings = [first + k * TURN / 8 for k in range(8)] if headed else [None]
    periods = sorted({round(rng.uniform(4.0, 25.0), 2) for _ in range(rng.randint(3, 7))})
    return [
        (heading, period, {name: (rng.random(), rng.uniform(0.0, TURN)) for name in MOTIONS})
        for heading in headings
        for period in periods
    ]


def written(rows, rng, turns=False, units=False):
    """The lines as a scene has them, headings with whole turns added and times in other units."""
    found = []
    for heading, period, motions in rows:
        row = {"period": f"{period!r} s"}
        if units and rng.random() < 0.5:
            row = {"period": f"{period / 60.0!r} min"}
        if heading is not None:
            heading += TURN * rng.choice([-2, -1, 0, 1, 2] if turns else [0])
            row["heading"] = f"{heading!r} deg"
            if units and rng.random() < 0.5:
                row["heading"] = f"{math.radians(heading)!r} rad"
        for name, (size, phase) in motions.items():
            row[name] = f"{size!r} {'m/m' if name in MOTIONS[:3] else 'rad/m'}"
            row[f"{name}_phase"] = f"{phase!r} deg"
        found.append(row)
    return found


def response(rows, **more):
    headings = {"headings": "towards"} if "heading" in rows[0] else {}
    return Response.model_validate({"operators": rows, "phases": "lead"} | headings | more)


def answers(found, rng):
    """Responses at frequencies within the operators and headings all around."""
    frequency = np.array([2.0 * math.pi / rng.uniform(4.0, 25.0) for _ in range(5)])
    headings = [rng.uniform(-7.0, 7.0) for _ in range(4)] + [0.0, math.pi, -math.pi]
    return np.array([operator(found, name, frequency, heading) for name in MOTIONS for heading in headings])


@pytest.mark.parametrize("headings", ["towards", "from"])
@pytest.mark.parametrize("seed", range(12))
def test_lines_may_stand_in_any_order(seed, headings):
    rng = random.Random(seed)
    rows = written(lines(rng), rng)
    shuffled = rng.sample(rows, len(rows))
    one, other = (answers(response(r, headings=headings), random.Random(1)) for r in (rows, shuffled))
    np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("headings", ["towards", "from"])
@pytest.mark.parametrize("seed", range(12))
def test_whole_turns_of_headings_and_units_of_lines_change_nothing(seed, headings):
    rng = random.Random(seed)
    rows = lines(rng)
    plain = response(written(rows, rng), headings=headings)
    turned = response(rng.sample(written(rows, rng, turns=True, units=True), len(rows)), headings=headings)
    assert len(turned.by_heading) == len(plain.by_heading) == 8
    one, other = (answers(found, random.Random(1)) for found in (plain, turned))
    np.testing.assert_allclose(other, one, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("headed", [True, False])
@pytest.mark.parametrize("seed", range(20))
def test_no_line_can_be_contradicted_by_another(seed, headed):
    rng = random.Random(seed)
    rows = lines(rng, headed)
    heading, period, _ = rng.choice(rows)
    again = (heading, period, dict.fromkeys(MOTIONS, (2.0, 0.0)))
    every = written(rows, rng) + written([again], rng, turns=True, units=True)
    for _ in range(3):
        rng.shuffle(every)
        with pytest.raises(ValueError, match=f"occurs twice, {period:g} s") as refused:
            response(every)
        assert ("at heading" in str(refused.value)) == headed


@pytest.mark.parametrize("pair", [(0.0, 360.0), (-180.0, 180.0), (90.0, -270.0), (720.0, 0.0)])
def test_headings_a_turn_apart_are_refused_by_name_of_their_table(tmp_path, pair):
    table = tmp_path / "rao.csv"
    head = "heading (deg),period (s),surge (m/m),surge_phase (deg)\n"
    table.write_text(head + "".join(f"{h},{p},{0.1 * k},0\n" for k, h in enumerate(pair) for p in (8, 12)))
    (place,) = [place for place in PLACES if place.name == "operators"]
    with pytest.raises(ValueError, match="headings that differ by 360 deg are the same"):
        Response(operators=read_table(table, place), phases="lead", headings="towards")


@pytest.mark.parametrize("apart", [1e-4, 1e-3])
def test_periods_that_differ_are_two(apart):
    rows = [(None, period, {"heave": (1.0, 0.0)}) for period in (8.0, 8.0 * (1.0 + apart), 12.0)]
    assert len(response(written(rows, random.Random(0))).by_heading[None]) == 3
