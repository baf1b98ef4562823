"""Effect of each input on the results of a towed riser."""

from __future__ import annotations

import textwrap

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from chapters.mao_hangoff.figures.colours import OF_INPUT
from chapters.mao_hangoff.runs import STATED
from riserstudy.figures.names import in_words
from riserstudy.figures.style import GREY, headline, key_below, panel_title, panels

RESULTS = ("displacement astern", "largest moment", "joint angle")
LETTERS = 36  # most letters per line of a current's name above a panel
#: points, of inputs whose lines nearly coincide: the later line is in front of the earlier
WIDTHS = {"lmrp_mass": 3.0, "current_speed": 1.2}
NAMES = {
    "lmrp_mass": "LMRP {:.0f} to {:.0f} t, opposing current",
    "current_speed": "current {:.1f} to {:.1f} m/s, along the track",
    "platform_speed": "platform {:.1f} to {:.1f} kn, current along the track",
    "riser_length": "riser {:.0f} to {:.0f} m, opposing current",
}


def trends(
    lmrp_mass: xr.Dataset, current_speed: xr.Dataset, platform_speed: xr.Dataset, riser_length: xr.Dataset
) -> Figure:
    """Change of displacement, moment and joint angle at 130 s over the change of each input, both in %.

    One row per current profile.
    """
    figure, axes = panels(2, 3, 2.7, sharex=True)
    runs = {
        "lmrp_mass": lmrp_mass,
        "current_speed": current_speed,
        "platform_speed": platform_speed,
        "riser_length": riser_length,
    }
    profiles = [str(name) for name in current_speed["current_profile"].values]
    most: set[str] = set()
    for k, (row, profile) in enumerate(zip((axes[:3], axes[3:]), profiles, strict=True)):
        last, height = profile == profiles[-1], " of the height" * profile.startswith("power")
        for ax in row[1:]:
            ax.sharey(row[0])
            ax.tick_params(labelleft=False)
        here = {
            axis: run.isel(current_profile=k, drop=True) if "current_profile" in run.dims else run
            for axis, run in runs.items()
            if "current_profile" in run.dims or last
        }
        steepest = _changes_over_inputs(row, here)
        most |= steepest
        for ax, result in zip(row, RESULTS, strict=True):
            panel_title(ax, f"{result}, current:\n{textwrap.fill(profile, LETTERS)}{height}")
            if last:
                ax.set_xlabel("change of input (%)")
        row[0].set_ylabel("change of result (%)")
    headline(figure, _matters_most(most))
    key_below(figure, axes[3], 2)
    return figure


def _changes_over_inputs(axes: list[Axes], runs: dict[str, xr.Dataset]) -> set[str]:
    """Plot changes of results over changes of inputs; return the input of the largest ratio in each panel."""
    quotients: dict[str, list[float]] = {}
    for axis, run in runs.items():
        values = run[axis].values
        along = 100.0 * (values / values[0] - 1.0)
        name, width = NAMES[axis].format(values[0], values[-1]), WIDTHS.get(axis, 1.5)
        for ax, curve in zip(axes, _at_the_stated_time(run), strict=True):
            change = 100.0 * (curve / curve.isel({axis: 0}) - 1.0)
            ax.plot(along, change, ".-", color=OF_INPUT[axis], lw=width, ms=max(6.0, 3.0 * width), label=name)
            quotients.setdefault(axis, []).append(abs(float(change[-1]) / along[-1]))
    for ax in axes:
        ax.axhline(0.0, color=GREY, linewidth=0.8, zorder=1.0)
    return {max(runs, key=lambda axis: quotients[axis][k]) for k in range(len(axes))}


def _matters_most(inputs: set[str]) -> str:
    """Title: inputs to which results are most sensitive, in % of result per % of input."""
    names = sorted(in_words(axis) for axis in inputs)
    if len(names) == 1:
        return f"All results change most steeply with the {names[0]}"
    return f"Per 1 % of change, the {' or the '.join(names)} matters most, by profile and result"


def _at_the_stated_time(runs: xr.Dataset) -> list[xr.DataArray]:
    """Displacement of the LMRP, largest moment and flex joint angle at the stated time."""
    at = runs.sel(time=STATED)
    moment = runs["bending_moment_size"].max("s")
    return [abs(at["lmrp_displacement"]), moment, abs(at["ufj_angle"])]
