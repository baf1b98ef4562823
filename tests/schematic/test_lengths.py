"""Lengths, places and labels in drawings of rigs."""

from itertools import combinations
from math import dist

import numpy as np
import pytest
from drawn_words import labels
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Annotation
from random_rigs import rig, written

from riserstudy.scene.load import SceneFile
from riserstudy.schematic import schematic
from riserstudy.schematic.geometry import Geometry


@pytest.mark.parametrize("seed", range(12))
def test_a_riser_below_a_telescopic_joint_is_drawn_unstretched_above_an_upright_stack(seed):
    """At an offset, with a riser longer or shorter than what the length of its joint leaves room for."""
    draw = np.random.default_rng(1000 + seed)
    tree = rig(seed)
    stacked = any("flex_joint_below" in section for section in tree["riser"])
    tree["top"]["offset"] = float(draw.uniform(-0.05, 0.05)) * -tree["water"]["seabed"]
    tree["riser"][-1]["length"] += float(draw.uniform(-0.002, 0.004)) * -tree["water"]["seabed"]
    place = Geometry(SceneFile("rig.yaml", written(tree)).resolved())
    for _, low, high in place.sections:
        assert dist(place.at(low), place.at(high)) == pytest.approx(high - low, rel=1e-9)
    lowest = place.scene.lowest_riser_section
    assert (lowest > 0) == stacked
    _, wellhead, _ = place.sections[lowest]
    foot = tree["bottom"]["elevation"]
    assert place.at(wellhead) == pytest.approx((0.0, foot + wellhead), abs=1e-9)
    assert place.top == pytest.approx((tree["top"]["offset"], tree["top"]["elevation"]))
    assert not stacked or place.at(0.5 * wellhead)[0] == 0.0


@pytest.mark.parametrize("seed", range(4))
def test_labels_of_a_rig_are_within_the_figure_and_do_not_touch(seed):
    """Of a rig with many parts at its upper end, whose labels do not all fit beside their panel."""
    tree = rig(seed, spatial=True)
    tree["top"]["offset"] = 5.0
    tree["top"]["body"] = {"name": "tension ring with outer barrel", "mass": 2e4}
    for motion, size in (("heave", "m"), ("surge", "m"), ("roll", "deg"), ("pitch", "deg")):
        tree["platform"][motion] = {"amplitude": f"1.25 {size}", "period": 11.0, "phase": "70 deg"}
    tree["riser"][-1]["name"] = "slick joints without buoyancy modules"
    figure = schematic(SceneFile("rig.yaml", written(tree)).resolved())
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    boxes = [super(Annotation, t).get_window_extent(canvas.get_renderer()) for t in labels(figure)]
    key = figure.legends[0].get_window_extent(canvas.get_renderer())
    for first, second in combinations([key, *boxes], 2):
        assert not first.overlaps(second)
    assert all(box.y0 >= 0.0 and box.y1 <= figure.bbox.height for box in boxes)
