"""Heave and tension over time, with and without tensioners."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from chapters.chang2020.figures.shared import (
    FITTED,
    GAS_LAW,
    LINES,
    MODELS,
    NAMES,
    OF_MODEL,
    OF_STATE,
    STATES,
    TIME,
    of_amplitude,
)
from riserstudy.figures.direct import label_line, legible
from riserstudy.figures.style import GREY, headline, key_below, panel_title, panels, shades

FOUR = (1.0, 3.0, 5.0, 10.0)  # m, amplitudes of Figs 11 and 12
NAMED = (3.0, 10.0)  # m, amplitudes among them that the paper's text states
LAST = 60.0  # s, plotted time of runs from rest: three periods of the platform
CLOSE = 40.0  # s, plotted time where two such runs are compared
#: dashes that keep coinciding lines distinguishable
DASHES = (0, (4, 4)), (0, (7, 2)), (0, (1, 1.5)), (0, (6, 2, 1, 2))
UNITS = {"heave": "m", "tension": "MN"}
HEAVE, TENSION = f"riser heave $x$ ({UNITS['heave']})", f"riser tension ({UNITS['tension']})"
IN_PERIOD = "time in a period (s)"


def fig08(
    from_rest: xr.Dataset, steady: xr.Dataset, rigid: xr.Dataset, tension: float, heave: float
) -> Figure:
    """Riser tension and heave with and without tensioner, H = 5 m interpreted in two ways.

    ``tension``, ``heave``: the published reductions, as fractions of one.
    """
    printed = {"tension": tension, "heave": heave}
    figure, axes = panels(2, 2, 3.1, sharex=True)
    found: list[dict[str, float]] = []  # reductions of each panel
    for column, (amplitude, meant) in enumerate(
        ((5.0, "$H$ = 5 m is the amplitude"), (2.5, "$H$ = 5 m is twice the amplitude"))
    ):
        runs = {
            "without tensioner": (_histories(rigid).sel(heave_amplitude=amplitude), GREY, 1.4),
            f"with tensioner, {STATES['from_rest']}": (
                _gas(from_rest).sel(heave_amplitude=amplitude),
                OF_STATE["from_rest"],
                1.2,
            ),
            f"with tensioner, {STATES['steady']}": (
                _repeated(_gas(steady).sel(heave_amplitude=amplitude), from_rest["time"]),
                OF_STATE["steady"],
                1.2,
            ),
        }
        for ax, quantity, label in zip(axes[column::2], ("tension", "heave"), (TENSION, HEAVE), strict=True):
            for name, (run, colour, width) in runs.items():
                ax.plot(run["time"], run[quantity], color=colour, linewidth=width, label=name)
            ax.set_ylabel(label)
            ax.margins(y=0.06)
            ranges = [float(np.ptp(run[quantity].values)) for run, *_ in runs.values()]
            states = ("from rest", "in steady state")
            found.append({s: 1.0 - part / ranges[0] for s, part in zip(states, ranges[1:], strict=True)})
            reduced = _reductions(found[-1], printed[quantity])
            panel_title(ax, f"{quantity}, {meant}; reduced by\n{reduced}")
            bare, settled = (run[quantity] for run, *_ in (*runs.values(),)[::2])
            _printed_range(ax, bare, settled, printed[quantity])
    for row in (axes[:2], axes[2:]):
        row[0].sharey(row[1])
        row[0].autoscale(axis="y")
    for ax in axes[2:]:
        ax.set_xlabel(TIME)
    axes[-1].set_xlim(0, 104)
    alike = all(
        np.isclose(of_tension[s], of_heave[s], atol=1e-3)
        for of_tension, of_heave in zip(found[::2], found[1::2], strict=True)
        for s in of_tension
    )
    headline(
        figure,
        "No interpretation gives both printed reductions: tension and heave decrease in proportion"
        if alike and tension != heave
        else "Tension and heave of the riser with and without tensioner",
    )
    key_below(figure, axes[0], 2)
    return figure


def _reductions(found: dict[str, float], printed: float) -> str:
    """State the reductions (fractions) of the peak-to-peak range: computed in each state, and published."""
    states = ", ".join(f"{100.0 * part:.0f} % {name}" for name, part in found.items())
    return f"{states}; printed: about {100.0 * printed:.0f} %"


def _printed_range(ax: Axes, bare: xr.DataArray, settled: xr.DataArray, reduction: float) -> None:
    """Draw the peak-to-peak range without tensioner after the published reduction (a fraction).

    It is centred on the steady state with tensioner, with which it is compared.
    """
    ax.errorbar(
        101.5,
        0.5 * float(settled.max() + settled.min()),
        yerr=0.5 * (1.0 - reduction) * float(np.ptp(bare.values)),
        color="black",
        capsize=3,
        clip_on=False,
        label="peak-to-peak range after the printed reduction",
    )


def fig10(from_rest: xr.Dataset, steady: xr.Dataset, lines_settled: xr.Dataset) -> Figure:
    """Heave and tension at 3 and 10 m, gas law and lines; (a) to (d) as in the paper, then steady state."""
    figure, axes = panels(3, 2, 2.6)
    started, settled = _histories(from_rest), _histories(steady)
    straight = _histories(lines_settled)
    start = float(steady["time"][0])
    cases = [(a, q) for a in NAMED for q in ("heave", "tension")]
    for (amplitude, quantity), ax in zip(cases, axes[:4], strict=True):
        for model, line in MODELS.items():
            run = started.sel(tensioner_model=model, heave_amplitude=amplitude)
            ax.plot(run["time"], run[quantity], line, color=OF_MODEL[model], lw=1.1)
        ax.set_ylabel({"heave": HEAVE, "tension": TENSION}[quantity])
        ax.set_xlim(0.0, CLOSE)
        ax.set_xlabel(TIME)
        panel_title(ax, f"{of_amplitude(amplitude)}, {STATES['from_rest']}")
    for amplitude, ax in zip(NAMED, axes[4:], strict=True):
        law = settled.sel(tensioner_model="gas law", heave_amplitude=amplitude)
        ax.plot(law["time"] - start, law["heave"], color=GAS_LAW, lw=2.2, label="gas law")
        for k, name in enumerate(map(str, straight["line"].values)):
            run = straight.sel(line=name, heave_amplitude=amplitude)
            where = "" if OF_MODEL[name] == FITTED else "(e, f) "
            ax.plot(run["time"] - start, run["heave"], color=OF_MODEL[name], lw=1.4, ls=DASHES[k],
                    label=where + LINES[name])  # fmt: skip
        ax.set_xlim(0.0, 20.0)
        ax.set_xlabel(IN_PERIOD)
        ax.set_ylabel(HEAVE)
        _tension_at_right(ax, law)
        panel_title(ax, f"{of_amplitude(amplitude)}, {STATES['steady']}")
    lowest = {"heave_amplitude": NAMED[1]}
    curved = float(settled["heave"].sel(lowest | {"tensioner_model": "gas law"}).min("time"))
    troughs = straight["heave"].sel(lowest).min("time")
    deeper = int((troughs < curved).sum())
    count = (
        "every linearised tensioner gives"
        if deeper == troughs.size
        else f"{deeper} of {troughs.size} linearised tensioners give"
    )
    headline(figure, f"At {NAMED[1]:g} m amplitude, {count} deeper troughs than the gas law")
    key_below(figure, axes[4], 3)
    return figure


def _tension_at_right(ax: Axes, run: xr.Dataset) -> None:
    """Add an axis of tension (MN) to a panel of heave (m), to which the tension is proportional."""
    stiffness = float((run["tension"] * run["heave"]).sum() / (run["heave"] ** 2).sum())

    def to_tension(heave: Any) -> Any:
        return stiffness * heave

    def to_heave(tension: Any) -> Any:
        return tension / stiffness

    right = ax.secondary_yaxis("right", functions=(to_tension, to_heave))
    right.set_ylabel(TENSION)


def fig11(from_rest: xr.Dataset, steady: xr.Dataset) -> Figure:
    """Heave of the riser for four amplitudes."""
    return _four(from_rest, steady, "heave", HEAVE)


def fig12(from_rest: xr.Dataset, steady: xr.Dataset) -> Figure:
    """Tension of the riser for four amplitudes."""
    return _four(from_rest, steady, "tension", TENSION)


def settled_response(steady: xr.Dataset) -> Figure:
    """Heave in steady state over one period, with the tension that is proportional to it at the right."""
    figure, axes = panels(1, 3, 3.6, sharex=True, sharey=True)
    histories, start = _histories(steady), float(steady["time"][0])
    for ax, amplitude in zip(axes, NAMED, strict=False):
        for model, line in MODELS.items():
            run = histories.sel(tensioner_model=model, heave_amplitude=amplitude)
            ax.plot(
                run["time"] - start, run["heave"], line, color=OF_MODEL[model], lw=1.4, label=NAMES[model]
            )
        panel_title(ax, of_amplitude(amplitude))
    _amplitudes(axes[2], steady, "heave")
    panel_title(axes[2], "gas law, by heave amplitude")
    axes[0].set_ylabel(HEAVE)
    for ax in axes:
        ax.set_xlabel(IN_PERIOD)
    axes[0].set_xlim(0, 20)
    axes[0].set_xticks(range(0, 20, 5))  # no label at the end, next to the first of the next panel
    low, high = axes[0].get_ylim()
    axes[0].set_ylim(low, high + 0.05 * (high - low))  # room for a label
    _tension_at_right(axes[2], _gas(steady).sel(heave_amplitude=FOUR[-1]))
    index = float(_steady_index(steady).sel(heave_amplitude=FOUR[-1]))
    shape = "high crests and flat troughs" if index > 1.0 else "crests no higher than troughs"
    headline(figure, f"At {FOUR[-1]:g} m heave amplitude, the gas law gives {shape}")
    key_below(figure, axes[0], 2)
    return figure


def _four(runs: xr.Dataset, steady: xr.Dataset, quantity: str, label: str) -> Figure:
    """One panel per amplitude: motion from rest, and the steady state to which the transient decays.

    The text at the right of each panel gives the distances of steady-state crests and troughs from
    equilibrium.
    """
    figure, axes = panels(4, 1, 1.75, sharex=True, sharey=True)
    rest = _histories(runs, "static")[quantity].sel(tensioner_model="gas law")
    for ax, amplitude in zip(axes, FOUR, strict=False):
        run = _gas(runs).sel(heave_amplitude=amplitude)
        settled = _repeated(_gas(steady).sel(heave_amplitude=amplitude), run["time"])
        level = float(rest.isel(heave_amplitude=0))
        ax.axhline(level, color="black", lw=0.6, label="equilibrium")
        for state, drawn, width in (("from_rest", run, 1.0), ("steady", settled, 2.0)):
            ax.plot(drawn["time"], drawn[quantity], color=OF_STATE[state], lw=width,
                    label=STATES[state])  # fmt: skip
        panel_title(ax, of_amplitude(amplitude) + ("" if amplitude in NAMED else " (assumed)"))
        ax.yaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
        _heights(ax, settled[quantity], level, UNITS[quantity])
    axes[0].annotate(
        "steady state,\nmeasured from\nequilibrium:", (1.01, 1.0), xycoords="axes fraction", fontsize="small",
        va="top", color=legible(OF_STATE["steady"]),
    )  # fmt: skip
    figure.supylabel(label, fontsize="medium")
    axes[-1].set_xlabel(TIME)
    axes[-1].set_xlim(0, LAST)
    index = _steady_index(steady).sel(heave_amplitude=list(FOUR))
    low, high = float(index[0]), float(index[-1])
    headline(
        figure,
        f"Crests of steady-state {quantity} are further from equilibrium than troughs"
        if bool((index > 1.0).all())
        else f"Steady-state {quantity} has asymmetry indices of {low:.2f} to {high:.2f}",
    )
    key_below(figure, axes[0], 3)
    return figure


def _steady_index(steady: xr.Dataset) -> xr.DataArray:
    """Ratio of the steady-state displacements above and below equilibrium; equal for heave and tension."""
    top = steady.isel(s_node=-1).sel(tensioner_model="gas law")
    index: xr.DataArray = (top["z_max"] - top["z_static"]) / (top["z_static"] - top["z_min"])
    return index


def _heights(ax: Axes, settled: xr.DataArray, rest: float, unit: str) -> None:
    """Write the distances of crests and troughs from equilibrium next to a panel, with their unit."""
    for height, side in (
        (float(settled.max()) - rest, "crests +"),
        (float(settled.min()) - rest, "troughs −"),
    ):
        digits = 2 if abs(height) < 10.0 else 1
        ax.annotate(
            f"{side}{abs(height):.{digits}f} {unit}", (1.01, 0.5), xycoords="axes fraction",
            xytext=(0, 2 if height > 0.0 else -2), textcoords="offset points", fontsize="small",
            va="bottom" if height > 0.0 else "top", color=legible(OF_STATE["steady"]),
        )  # fmt: skip


def _amplitudes(ax: Axes, runs: xr.Dataset, quantity: str) -> None:
    for colour, amplitude in zip(shades(GAS_LAW, len(FOUR)), FOUR, strict=True):
        run = _gas(runs).sel(heave_amplitude=amplitude)
        start = float(run["time"][0])
        (line,) = ax.plot(run["time"] - start, run[quantity], color=colour, label=f"{amplitude:g} m")
        label_line(ax, line, 0.25, (0.0, 2.0))
    ax.margins(y=0.1)


def _histories(runs: xr.Dataset, when: str = "") -> xr.Dataset:
    """Heave (m) and riser tension (MN) at the ring over time, or in static equilibrium."""
    if when == "static":
        top = runs.isel(s_node=-1)
        z, tension, zero = (top["z_static"], top["effective_tension_static"], float(runs["s_node"][-1]))
    else:
        top = runs.isel(s=-1)
        z, tension, zero = top["z"], top["effective_tension"], float(runs["s"][-1])
    return xr.Dataset({"heave": z - zero, "tension": tension / 1e6})


def _gas(runs: xr.Dataset) -> xr.Dataset:
    return _histories(runs).sel(tensioner_model="gas law")


def _repeated(period: xr.Dataset, time: xr.DataArray) -> xr.Dataset:
    """Repeat a steady-state period over other times (s); period and times start at equal phases."""
    start, end = float(period["time"][0]), float(period["time"][-1])
    within = start + np.mod(time.values - start, end - start)
    return period.interp(time=within).assign_coords(time=time.values)
