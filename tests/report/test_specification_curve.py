"""The specification curve behind a claim that depends: every case in order, with its options."""

import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from riserstudy.report.curve import ABOVE, HIGH, LEFT, RIGHT, Cases, curve, options_of, ordered


def cases(seed, count=60):
    """Cases of which an option decides, and a range changes the margin a little."""
    rng = np.random.default_rng(seed)
    soil = rng.choice(["clay", "sand & silt"], count)
    speed = rng.uniform(0.2, 1.4, count)
    margin = np.where(soil == "clay", 0.5, -0.5) + 0.1 * speed
    speeds = np.array([f"{v} m/s" for v in speed])
    noise = np.array([f"{v} kg" for v in rng.uniform(0.0, 1.0, count)])
    inputs = {"noise": noise, "the current": speeds, "the soil": soil, "same": np.full(count, "x")}
    return Cases(margin, margin > 0.0, np.zeros(count, bool), inputs, margin[0])


def texts(svg):
    return ["".join(text.itertext()) for text in ElementTree.fromstring(svg).iter("text")]


@pytest.mark.parametrize("seed", range(6))
def test_the_input_that_decides_comes_first_and_one_that_does_not_vary_is_left_out(seed):
    found = ordered(cases(seed), [])
    assert next(iter(found.inputs)) == "the soil"
    assert "same" not in found.inputs
    assert len(found.inputs) + found.hidden == 3


def test_named_inputs_come_first_whatever_they_explain():
    assert next(iter(ordered(cases(0), ["noise"]).inputs)) == "noise"


@pytest.mark.parametrize("seed", range(6))
def test_shares_are_those_of_the_cases_with_an_option(seed):
    of = cases(seed)
    said = texts(curve(ordered(of, [])).svg)
    for option, share in (("clay", "100\N{NO-BREAK SPACE}%"), ("sand & silt", "0\N{NO-BREAK SPACE}%")):
        assert said[said.index(option) + 1] == share
    assert f"{of.met.sum()} of 60 cases agree" in said


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("count", [3, 60, 700])
def test_marks_of_the_options_fill_the_width_once(seed, count):
    """Every case that is drawn has one option of each input."""
    of = ordered(cases(seed, count), [])
    svg = curve(of).svg
    rows = re.findall(r'class="has" d="([^"]*)"', svg)
    lengths = [sum(float(x) for x in re.findall(r"h([\d.]+)", row)) for row in rows]
    assert sum(lengths) == pytest.approx(len(of.inputs) * (RIGHT - LEFT), rel=0.02)
    starts = [float(x) for row in rows for x in re.findall(r"M([\d.]+)", row)]
    assert min(starts) >= LEFT
    assert max(starts) < RIGHT


@pytest.mark.parametrize(
    "count, said",
    [(60, "is drawn"), (300, "Only every second case is drawn."), (700, "one of every 3 cases is drawn.")],
)
def test_cases_that_are_not_drawn_are_told(count, said):
    caption = curve(ordered(cases(1, count), [])).caption
    assert (said in caption) == (count > 240)
    assert f"of {count} cases" in caption


@pytest.mark.parametrize("seed", range(5))
def test_parts_of_a_range_hold_every_case_once(seed):
    values = np.array([f"{v} m" for v in np.random.default_rng(seed).uniform(1e3, 1e6, 50)])
    parts = options_of(values)
    assert np.sum([part.has for part in parts], axis=0).tolist() == [1] * 50
    assert all(part.name.endswith(" m") and "e+" not in part.name for part in parts)


def test_more_options_than_fit_are_joined_and_counted():
    values = np.array([f"option {k % 20}" for k in range(100)])
    *most, rest = options_of(values)
    assert rest.name == f"{20 - len(most)} others"
    assert np.sum([one.has for one in (*most, rest)], axis=0).tolist() == [1] * 100


def test_names_are_escaped():
    assert "sand &amp; silt" in curve(ordered(cases(0), [])).svg


def bars(svg, kind):
    """Centre and height of each bar of a kind; positive heights point up."""
    paths = re.findall(rf'class="{kind}" stroke-width="[\d.]+" d="([^"]*)"', svg)
    found = re.findall(r"M([\d.]+) ([\d.]+)v(-?[\d.]+)", "".join(paths))
    assert {float(y) for _, y, _ in found} <= {ABOVE + 0.5 * HIGH}
    return [(float(x), -float(up)) for x, _, up in found]


@pytest.mark.parametrize("most, top", [(0.04, 0.05), (0.13, 0.2), (0.2, 0.2), (0.7, 1.0)])
def test_bars_stand_in_the_order_of_their_margins_with_their_sign_and_kind(most, top):
    """Six cases; of two with the same value neither is met; the panel ends at the next scale."""
    share = np.array([0.5, -1.0, 1.0, -0.2, 0.1, -0.5])
    met = np.array([True, False, True, False, False, False])
    same = np.array([True, False, False, True, True, False])  # what is met counts first
    of = Cases(most * share, met, same, {}, most * share[4])
    svg = curve(of).svg
    width, place = (RIGHT - LEFT) / 6.0, np.argsort(np.argsort(share))
    for kind, members in (("true", [0, 2]), ("same", [3, 4]), ("false", [1, 5])):
        expected = sorted(
            (LEFT + (place[k] + 0.5) * width, share[k] * most / top * 0.5 * HIGH) for k in members
        )
        np.testing.assert_allclose(bars(svg, kind), expected, atol=0.051)
    said = texts(svg)
    assert f"+{100 * top:.0f} %" in said
    assert f"\u2212{100 * top:.0f} %" in said
    # the triangle marks the base case: three margins are smaller
    (x,) = re.findall(r'class="base" d="M([\d.]+) ', svg)
    assert float(x) == pytest.approx(LEFT + 3.0 * width, abs=0.051)


def test_a_base_case_of_the_largest_margin_sets_the_scale():
    of = Cases(np.array([0.01, 0.02, -0.01]), np.array([True, True, False]), np.zeros(3, bool), {}, 0.4)
    assert "+50 %" in texts(curve(of).svg)


def test_of_many_options_the_most_frequent_are_shown():
    values = np.array([f"option {k}" for k in range(12) for _ in range(k + 1)])
    *most, rest = options_of(values)
    assert {one.name for one in most} == {f"option {k}" for k in range(4, 12)}
    assert int(rest.has.sum()) == 1 + 2 + 3 + 4


@pytest.mark.parametrize("share, shown", [(0.015, 0), (0.025, 1)])
def test_an_input_is_shown_from_two_per_cent_of_the_variance_on(share, shown):
    """Two inputs of two options each, that add."""
    large, small = np.tile([0, 1], 200), np.repeat([0, 1], 200)
    margin = large + np.sqrt(share / (1.0 - share)) * small
    inputs = {"large": np.array(["a", "b"])[large], "small": np.array(["c", "d"])[small]}
    found = ordered(Cases(margin, margin > 0.0, np.zeros(400, bool), inputs, None), [])
    assert list(found.inputs) == ["large", "small"][: 1 + shown]
    assert found.hidden == 1 - shown


def test_thirds_of_a_range_are_told_by_their_ends_the_largest_first():
    parts = options_of(np.array([f"{k} kN*m^2" for k in range(1, 10)]))
    assert [part.name for part in parts] == ["7 to 9 kN m²", "4 to 6 kN m²", "1 to 3 kN m²"]
    assert [np.flatnonzero(part.has).tolist() for part in parts] == [[6, 7, 8], [3, 4, 5], [0, 1, 2]]
