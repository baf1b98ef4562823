"""Colours in all figures of this chapter: one per thing; ordered values are shades, light to dark."""

from __future__ import annotations

from collections.abc import Iterable

from riserstudy.figures.style import shades

#: inputs that are varied, by the names of their axes
OF_INPUT = {
    "lmrp_mass": "#0072b2",
    "current_speed": "#d55e00",
    "platform_speed": "#009e73",
    "riser_length": "#aa4499",
    "track_angle": "#7f6000",
}
#: coordinates of a single run
OF_COORDINATE = {"time": "#456882", "depth": "#882255"}
FINE_MESH, MESH_OF_PAPER = ("computed, fine mesh", "computed, 50 elements and\n0.00163 s as the paper")
OF_MESH = {FINE_MESH: "#332288", MESH_OF_PAPER: "#ee3377"}
#: the riser's weight in water; config/studies/mao_hangoff.yaml, readings
OF_WEIGHT = {
    "439 kg a joint": "#56b4e9",
    "439 kg a metre": "#e69f00",
    "flooded 22.2 mm wall": "#117733",
    "flooded 25.4 mm wall": "#cc6677",
}
PROFILE = "#555555"  # current profiles; panels and names distinguish them


def ordered(colour: str, values: Iterable[float]) -> list[str]:
    """One shade of a colour for each value; larger values are darker."""
    given = [*values]
    known = dict(zip(sorted(given), shades(colour, len(given)), strict=True))
    return [known[value] for value in given]
