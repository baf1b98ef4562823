"""The specification curve behind a claim that depends: every case in order, with its options."""

import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from riserstudy.report.curve import LEFT, RIGHT, Cases, curve, options_of, ordered


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


@pytest.mark.parametrize("count, said", [(60, "one of"), (700, "one of 3 is drawn")])
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
