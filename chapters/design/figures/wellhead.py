"""Design, wellhead: uncertainty of the fatigue damage of a conductor, and the inputs that explain it."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from riserstudy.figures.style import COLOURS, GREY, headline, panel_title, panels

WORDS = {
    "riser[2].mass": "mass of the stack",
    "riser[2].added_mass.coefficient": "added mass of the stack",
    "riser[3].flex_joint_below.stiffness": "lower flex joint",
    "riser[3].drag.coefficient": "drag of the riser",
    "riser[3].added_mass.coefficient": "added mass of the riser",
    "top.tension": "top tension",
    "soil.resistance.strength_at_mudline": "soil strength at the seabed",
    "soil.resistance.strength_gradient": "soil strength over depth",
    "soil.resistance.strain_at_half_strength": "soil strain",
    "soil.damping.ratio": "soil damping",
    "cement": "cement level",
    "platform": "platform motions",
    "damping": "structural damping",
}


CLEAR = {"facecolor": "white", "edgecolor": "none", "pad": 1.5}  # box of words that lines would cross


def wellhead_fatigue(wellhead_fatigue: xr.Dataset) -> Figure:
    """Damage of every sample in rising order, and the share of its variance that each input explains."""
    figure, (left, right) = panels(1, 2, 4.6)
    damage = np.sort(wellhead_fatigue["damage_largest"].values)
    share = 100.0 * (np.arange(len(damage)) + 0.5) / len(damage)
    left.plot(damage, share, "o", color=COLOURS[0], markersize=3)
    left.set_xscale("log")
    left.xaxis.set_minor_formatter(NullFormatter())  # labels within a decade overlap
    error = 100.0 * float(wellhead_fatigue["damage_error"])
    left.set_xlabel("damage of the conductor (1/year)")
    left.text(
        0.03, 0.97, f"240 instead of 120\nsegments change the\ndamage by {error:.1g} %\nat most",
        transform=left.transAxes, va="top", fontsize="small", bbox=CLEAR,
    )  # fmt: skip
    left.set_ylabel("share of samples with less (%)")
    low, high = np.quantile(damage, [0.05, 0.95])
    for value in (low, high):
        left.axvline(value, color=GREY, linewidth=0.8)
    panel_title(left, f"lines: 90 % of samples, a factor of {high / low:.0f}")
    names = [str(name) for name in wellhead_fatigue["varied_input"].values]
    shares = 100.0 * wellhead_fatigue["share_explained"].values
    sure = shares > 100.0 * wellhead_fatigue["by_chance"].values
    rows = np.arange(len(names))[::-1]
    colours = [COLOURS[0] if known else GREY for known in sure]
    right.barh(rows, shares, color=colours, height=0.7)
    right.set_yticks(rows, [WORDS.get(name, name) for name in names], fontsize="small")
    right.set_xlabel("share of variance (%)")
    right.grid(visible=False, axis="y")
    panel_title(right, "log damage, by input; grey: as by chance")
    known = [k for k, one in enumerate(sure) if one]
    if known:
        first = max(known, key=lambda k: float(shares[k]))
        named, share = WORDS.get(names[first], names[first]), shares[first]
        most = ", the largest share" if share >= shares.max() else ""
        headline(figure, f"The {named} explains {share:.0f} % of log-damage variance{most}")
    else:
        headline(figure, "Fatigue damage of a conductor over the unknown inputs of a well")
    return figure
