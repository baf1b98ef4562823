"""Design, wellhead: uncertainty of the fatigue damage of a conductor, and the inputs that explain it."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from riserstudy.figures.style import COLOURS, GREY, headline, panel_title, panels
from riserstudy.records.numerals import rounded_up

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


def wellhead_fatigue(wellhead_fatigue: xr.Dataset) -> Figure:
    """Damage of every sample in rising order, and the share of its variance that each input explains."""
    figure, (left, right) = panels(1, 2, 4.6)
    damage = np.sort(wellhead_fatigue["damage_largest"].values)
    share = 100.0 * (np.arange(len(damage)) + 0.5) / len(damage)
    low, high = np.quantile(damage, [0.05, 0.95])
    left.axvspan(low, high, color="0.92", lw=0.0, zorder=0.5)
    left.plot(damage, share, "o", color=COLOURS[0], markersize=3)
    left.set_xscale("log")
    left.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    left.xaxis.set_minor_formatter(NullFormatter())  # labels within a decade overlap
    left.xaxis.set_major_formatter("{x:g}")
    error = 100.0 * float(wellhead_fatigue["damage_error"])
    left.set_xlabel("damage of the conductor (1/year)")
    left.text(
        low, 99.0, f" grey: 90 % of samples,\n a factor of {high / low:.0f}", va="top", fontsize="small"
    )
    left.set_ylabel("share of samples with less damage (%)")
    panel_title(left, f"all samples; error of the mesh at most {rounded_up(error)} %")
    names = [str(name) for name in wellhead_fatigue["varied_input"].values]
    shares = 100.0 * wellhead_fatigue["share_explained"].values
    chance = 100.0 * wellhead_fatigue["by_chance"].values
    # with fewer samples than inputs, the regression fits any outcome
    sure = (shares > chance) & (damage.size > len(names) + 1)
    rows = np.arange(len(names))[::-1]
    colours = [COLOURS[0] if known else GREY for known in sure]
    right.barh(rows, shares, color=colours, height=0.7)
    right.plot(chance, rows, "|", color="black", markersize=11, markeredgewidth=1.5)
    right.set_yticks(rows, [WORDS.get(name, name) for name in names], fontsize="small")
    right.set_xlabel("share of the variance of log damage (%)")
    right.grid(visible=False, axis="y")
    panel_title(right, "by input; black marks: 5 % significance")
    known = [k for k, one in enumerate(sure) if one]
    if known:
        first = max(known, key=lambda k: float(shares[k]))
        named = WORDS.get(names[first], names[first])
        headline(figure, f"The {named} explains {shares[first]:.0f} % of the scatter of damage")
    else:
        headline(figure, "Fatigue damage of a conductor over the unknown inputs of a well")
    return figure
