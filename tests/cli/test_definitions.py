"""Errors about signed quantities name the section of the page that defines them."""

import re
from pathlib import Path

import pytest

from riserstudy.cli.definitions import PAGE, SECTIONS, where_defined
from riserstudy.errors import InputError, SimulationError

ROOT = Path(__file__).parents[2]


def test_every_section_is_on_the_page():
    text = (ROOT / PAGE).read_text("utf-8")
    headings = {
        re.sub(r"[^a-z]+", "-", heading.lower()).strip("-")
        for heading in re.findall(r"^## (.+)$", text, re.M)
    }
    assert set(SECTIONS) <= headings


@pytest.mark.parametrize(
    "field, section",
    [
        ("top.offset", "axes-and-places"),
        ("platform.pitch.amplitude", "angles"),
        ("top.tensioners.stroke.longest", "tensioners-and-telescopic-joint"),
        ("top.tension", "tension"),
        ("riser[0].submerged_weight", "tension"),
        ("riser[0].name", ""),
        ("", ""),
    ],
)
def test_an_error_names_the_section_of_its_field(field, section):
    said = where_defined(InputError("scene.yaml", field, "'x'", "a number"))
    assert said == (f" (signs and definitions: {PAGE}#{section})" if section else "")


def test_other_errors_are_left_alone():
    assert where_defined(SimulationError("no convergence at 3 s")) == ""
