"""Figures of the Hamilton-principle riser paper: the printed ones by number, others by what they show.

Filled: envelope of the Hermite beam, the paper's own method. Dashed lines of the same colour: lumped
masses. Heights count along the riser from its lower end.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator

from riserstudy.chapters.fem_riser.along import (
    amplitude_at,
    angles,
    drift_rate,
    measures,
    period_of,
    stress_factor,
    without_drift,
)
from riserstudy.chapters.fem_riser.claims import (
    BEAM,
    DURATION,
    LUMPED,
    PAPER_STEP,
    PHASES,
    SETTLED,
    TOGETHER,
    averaged,
    claims,
    differences,
    grid_error,
    middle,
    reciprocates,
    settling_time,
)
from riserstudy.figures.style import (
    COLOURS,
    GREY,
    PRINTED,
    headline,
    key_below,
    legend_below,
    panel_title,
    panels,
)

HEIGHT, TIME = "s from the bottom (m)", "time (s)"
DEFLECTION, STRESS, ANGLE = "deflection x (m)", "bending stress (MPa)", "angle (deg)"
WINDOWS = ((0.0, 16.0), (17.0, 260.0), (261.0, 300.0))  # s
BLUE, RED, BLACK = COLOURS[0], COLOURS[1], COLOURS[6]
PHASE = ListedColormap(colormaps["cividis"](np.linspace(0.0, 0.85, 256)))  # of time, or the tide
LAST = ListedColormap(colormaps["Reds"](np.linspace(0.5, 0.9, 256)))  # of time, red as in the text
viridis = colormaps["viridis"]  # of heights along the riser
GRID_TIME = 80.0  # s, of the runs of the grid test
#: what the buoyant factor may mean
READINGS = {
    "R1": "the share of the weight in air that the blocks carry",
    "R2": "the share of the weight in air that is left",
    "R3": "the share that is left, the tension ratio being to the weight without blocks",
    "R4": "the share that the blocks carry, the tension ratio being to the weight without blocks",
}
APART = "vibration, drift (m)"
SEEN = 1e-3  # m, of vibration and drift: below it lines show what the mesh leaves


# the sea


def fig03(water: xr.Dataset) -> Figure:
    """Velocity and acceleration under the wave, and current."""
    figure, axes = panels(1, 3, 3.8)
    near = water.sel(below_surface=slice(0.0, 60.0))
    for ax, name, label in zip(
        axes,
        ("wave_velocity", "wave_acceleration"),
        ("wave velocity (m/s)", "wave acceleration (m/s²)"),
        strict=False,
    ):
        drawn = ax.pcolormesh(
            near["time"],
            near["below_surface"],
            near[name].T,
            cmap="RdBu_r",
            shading="gouraud",
            rasterized=True,
        )
        figure.colorbar(drawn, ax=ax, label=label, location="top", shrink=0.9)
        ax.invert_yaxis()
        ax.set_xlabel(TIME)
    for ax in axes[:2]:
        ax.set_ylabel("depth (m), upper 60 m")
    axes[2].plot(water["water_speed"], water["below_surface"], color=COLOURS[0])
    axes[2].set_xlabel("current (m/s), assumed")
    axes[2].set_ylabel("depth (m), whole riser")
    axes[2].set_ylim(float(water["below_surface"][-1]), 0.0)
    axes[2].set_xlim(left=0.0)
    headline(
        figure,
        "Waves move the water near the surface only",
    )
    return figure


# the base case


def fig04(motion: xr.Dataset) -> Figure:
    """Deflection profiles and histories in the three windows."""
    figure, axes = panels(2, 3, 3.2)
    x, other = (motion["x"].sel(solver=solver) for solver in (BEAM, LUMPED))
    for k, (start, end) in enumerate(WINDOWS):
        window = x.sel(time=slice(start, end))
        last = other.sel(time=end, method="nearest")
        _profiles(figure, axes[k], window, last, LAST if k == 2 else PHASE)
        panel_title(axes[k], f"profiles in {start:g} to {end:g} s")
        axes[k].set_ylim(0.0, float(x["s"][-1]))
        history = axes[k + 3]
        heights = np.arange(200.0, 2000.0, 200.0)
        for colour, s in zip(viridis(np.linspace(0.0, 0.95, heights.size)), heights, strict=True):
            track = window.sel(s=s, method="nearest")
            drawn = 100.0 * (track - track.mean("time")) if k == 2 else track
            history.plot(track["time"], drawn, color=colour, linewidth=0.9, label=f"{s:g} m")
        history.set_xlabel(TIME)
        history.set_ylabel("deflection less its mean (cm)" if k == 2 else DEFLECTION)
        panel_title(history, "histories, by height")
    axes[0].set_ylabel(HEIGHT)
    dashed = Line2D([], [], label="lumped masses, last profile", **PRINTED)
    handles, labels = axes[3].get_legend_handles_labels()
    legend_below(figure, [*handles, dashed], [*labels, str(dashed.get_label())], 5)
    settled = float(settling_time(motion, SETTLED))
    headline(
        figure,
        f"The riser is steady within {100 * SETTLED:g} % after {settled:.0f} s (tide calibrated)",
    )
    return figure


def _profiles(
    figure: Figure, ax: Axes, window: xr.DataArray, last: xr.DataArray, colours: Colormap
) -> None:
    """Profiles of a window, coloured by time; dashed, the last one by the other method."""
    shapes = window.isel(time=slice(None, None, max(1, window.sizes["time"] // 24)))
    times = Normalize(float(window["time"][0]), float(window["time"][-1]))
    for time in shapes["time"].values:
        ax.plot(shapes.sel(time=time), shapes["s"], linewidth=0.7, color=colours(times(time)))
    ax.plot(last, last["s"], **PRINTED)
    figure.colorbar(ScalarMappable(times, colours), ax=ax, location="top", label=TIME, shrink=0.9)
    ax.set_xlabel(DEFLECTION)


def fig05(settled: xr.Dataset) -> Figure:
    """The base case."""
    figure = _envelopes({"2000 m, ratio 1.3, factor 0.7 (assumed)": settled}, (BLUE,))
    measured = measures(settled.sel(solver=BEAM))
    place = float(measured["deflection_place"])
    ends = [
        float(measured[f"{name}_from_{end}"])
        for name in ("stress", "angle")
        for end in ("bottom", "top")
    ]
    headline(
        figure,
        f"Deflection peaks {100.0 * place:.0f} % up the riser, stress and angle within "
        f"{100.0 * max(ends):.0f} % of its ends",
    )
    return figure


def tides(tides: xr.Dataset) -> Figure:
    """Mid-length over time and the tide; how far it swings back, and when it settles."""
    figure, axes = panels(1, 3, 3.6)
    slow = averaged(middle(tides))
    values = tides["tide"].values
    for k, tide in enumerate(values):
        curve = slow.sel(tide=tide)
        axes[0].plot(curve["time"], curve / curve[-1], label=f"{tide:g} m/s",
                     color=PHASE(k / max(1, len(values) - 1)))  # fmt: skip
    axes[0].axvline(PHASES["second"][1], **PRINTED)
    axes[0].axhspan(1.0 - SETTLED, 1.0 + SETTLED, color="0.85", zorder=0)
    axes[0].set_xlabel(TIME)
    axes[0].set_ylabel("mid-length / its last mean")
    axes[0].legend(
        title="tide at the surface", fontsize="x-small", title_fontsize="x-small", ncols=2
    )
    time, back = settling_time(tides, SETTLED), 100.0 * reciprocates(tides, 0.0).value
    axes[1].plot(values, back, "o-", color=BLUE)
    axes[1].set_ylabel("swing back, of the last mean (%)")
    axes[2].plot(values, time, "o-", color=BLUE)
    axes[2].axhline(PHASES["second"][1], label="printed: 260 s", **PRINTED)
    axes[2].set_ylabel("settling time (s)")
    axes[2].legend(loc="lower right", fontsize="x-small")
    for ax in axes[1:]:
        ax.set_xlabel("surface speed of the tide (m/s)")
        ax.set_ylim(bottom=0.0)
    nearest = float(abs(time - PHASES["second"][1]).idxmin("tide"))
    headline(
        figure,
        f"The tide sets the settling time: {float(time.sel(tide=nearest)):.0f} s at {nearest:g} m/s",
    )
    return figure


# parameters


def fig06(length_500: xr.Dataset, length_1000: xr.Dataset, length_1500: xr.Dataset) -> Figure:
    """Three lengths; colours as the text has them, where it says."""
    cases = {"500 m": length_500, "1000 m": length_1000, "1500 m": length_1500}
    figure = _envelopes(cases, (BLUE, BLACK, RED))
    changed = _ratios(length_500, length_1500)
    headline(
        figure,
        f"Tripling the length gives {changed['deflection']:.1f} times the deflection, "
        f"{changed['vibration']:.1f} times the vibration{_still_drifting(cases)}",
    )
    return figure


def fig07(tension_ratio: xr.Dataset) -> Figure:
    """Three top tension ratios; colours as the text has them, where it says."""
    cases = _each(tension_ratio, "tension_ratio", "ratio")
    figure = _envelopes(cases, (BLUE, BLACK, RED))
    headline(
        figure,
        f"More top tension lowers deflection, stress, angle and vibration{_still_drifting(cases)}",
    )
    return figure


def fig08(buoyant_factor: xr.Dataset) -> Figure:
    """Three buoyant factors; colours as the text has them, where it says."""
    cases = _each(buoyant_factor, "buoyant_factor", "factor")
    figure = _envelopes(cases, (RED, BLUE, BLACK))
    headline(
        figure,
        f"A higher buoyant factor raises deflection, stress and angle{_still_drifting(cases)}",
    )
    return figure


def _ratios(first: xr.Dataset, last: xr.Dataset) -> dict[str, float]:
    """What a case has of deflection and vibration over another, by the paper's beam."""
    old, new = (measures(runs.sel(solver=BEAM)) for runs in (first, last))
    return {name: float(new[name] / old[name]) for name in ("deflection", "vibration")}


def _still_drifting(cases: Mapping[str, xr.Dataset]) -> str:
    """The case that drifts most in the window, with its drift; "" where all are at rest."""
    shares = {}
    for name, runs in cases.items():
        x = runs["x"].sel(solver=BEAM).dropna("s", how="all")
        period = period_of(runs)
        way = float(abs(drift_rate(x, period)).max()) * float(x["time"][-1] - x["time"][0])
        shares[name] = way / float(abs(without_drift(x, period)).max())
    worst = max(shares, key=lambda name: shares[name])
    return f"; {worst} drifts by {100 * shares[worst]:.1f} %" if shares[worst] > SETTLED else ""


def _each(runs: xr.Dataset, axis: str, word: str) -> dict[str, xr.Dataset]:
    return {f"{word} {value:g}": runs.sel({axis: value}) for value in runs[axis].values}


def _envelopes(cases: Mapping[str, xr.Dataset], colours: tuple[str, ...]) -> Figure:
    """Panels (a) to (c) of Figs 5 to 8; (d) vibration, and drift, which (a) is freed of."""
    figure, axes = panels(1, 4, 4.2, sharey=True)
    for colour, (name, runs) in zip(colours, cases.items(), strict=True):
        factor = stress_factor(runs) / 1e6
        period = period_of(runs)
        for solver in (BEAM, LUMPED):
            run = runs.sel(solver=solver)
            x = run["x"].dropna("s", how="all")
            angle: xr.DataArray = xr.apply_ufunc(np.rad2deg, angles(run))
            nodes, length = run["s_node"], float(run["s_node"][-1])
            still = without_drift(x, period)
            low, high = (factor * run[f"bending_moment_{side}"] for side in ("min", "max"))
            fields = (
                (still.min("time"), still.max("time"), x["s"]),
                (low, high, nodes),
                (angle.min("time"), angle.max("time"), length * angle["middle"]),
            )
            for ax, (least, most, s) in zip(axes, fields, strict=False):
                _envelope(ax, least, most, s, colour, name if solver == BEAM else None)
            line = "-" if solver == BEAM else "--"
            vibration = amplitude_at(x, period)
            axes[3].plot(vibration, x["s"], line, color=colour, linewidth=0.9)
            if solver == BEAM:
                span = float(x["time"][-1] - x["time"][0])
                drift = span * abs(drift_rate(x, period))
                if (
                    float(drift.max()) > 10.0 * SEEN
                ):  # where it is less, the dots of a changing sign
                    axes[3].plot(drift, x["s"], ":", color=colour, linewidth=1.2)
    for ax, label in zip(axes, (DEFLECTION, STRESS, ANGLE, APART), strict=True):
        ax.set_xlabel(label)
    axes[3].set_xscale("log")
    axes[3].set_xlim(left=SEEN)
    axes[0].set_ylabel(HEIGHT)
    axes[0].set_ylim(bottom=0.0)
    axes[0].plot([], [], color=GREY, linewidth=0.8, linestyle="--", label="lumped masses")
    axes[0].plot(
        [],
        [],
        color=GREY,
        linewidth=1.2,
        linestyle=":",
        label="drift in 261 to 300 s, taken off (a)",
    )
    key_below(figure, axes[0], 5)
    return figure


def _envelope(
    ax: Axes, low: xr.DataArray, high: xr.DataArray, s: xr.DataArray, colour: str, label: str | None
) -> None:
    if label is None:
        for side in (low, high):
            ax.plot(side, s, color=colour, linewidth=0.8, linestyle="--")
        return
    ax.fill_betweenx(s, low, high, color=colour, alpha=0.35, linewidth=0)
    ax.plot(low, s, color=colour, linewidth=0.6)
    ax.plot(high, s, color=colour, linewidth=0.6, label=label)


def readings(reading_trends: xr.Dataset) -> Figure:
    """Deflection, stress and angle over the buoyant factor in its four readings."""
    figure, axes = panels(1, 3, 3.4)
    fields = (("deflection", 1.0, "largest deflection (m)"), ("stress", 1e-6, "largest stress (MPa)"),
              ("angle", np.rad2deg(1.0), "largest angle (deg)"))  # fmt: skip
    for ax, (name, scale, label) in zip(axes, fields, strict=True):
        for colour, reading in zip(COLOURS, READINGS, strict=False):
            curve = scale * reading_trends[f"{name}_by_factor"].sel(reading=reading)
            ax.plot(
                curve["buoyant_factor"],
                curve,
                "o-",
                color=colour,
                label=f"{reading}: {READINGS[reading]}",
            )
        ax.set_xlabel("buoyant factor")
        ax.set_ylabel(label)
        ax.set_ylim(bottom=0.0)
    key_below(figure, axes[0], 1)
    raised = [
        reading
        for reading in READINGS
        if all(
            bool(
                (
                    reading_trends[f"{name}_by_factor"].sel(reading=reading).diff("buoyant_factor")
                    > 0
                ).all()
            )
            for name, *_ in fields
        )
    ]
    headline(
        figure,
        f"Only in interpretation {', '.join(raised) or 'none'} the factor raises all three, as claimed",
    )
    return figure


# beside the paper


def region(map_trends: xr.Dataset, open_trends: xr.Dataset, change: float) -> Figure:
    """Where B5 to B10 hold together; ``change``: what counts as an increase or decrease."""
    figure, axes = panels(2, 2, 3.6)
    held = claims(map_trends, change)
    for ax, joints in zip(axes, map_trends["joints"].values, strict=False):
        here = held.sel(joints=joints)
        for tide in here["tide"].values:
            for wave in here["wave_height"].values:
                true = here.sel(tide=tide, wave_height=wave)
                every = bool(true.all())
                missed = [str(c) for c in TOGETHER if not bool(true.sel(claim=c))]
                ax.plot(tide, wave, "o" if every else "s", ms=17, mfc=COLOURS[2] if every else "0.9",
                        mec="none")  # fmt: skip
                ax.annotate("all" if every else "\n".join(missed), (tide, wave), ha="center",
                            va="center", fontsize="x-small", color="white" if every else "black")  # fmt: skip
        ax.margins(0.15)
        panel_title(ax, f"joints: {joints}")
        ax.set_xlabel("surface speed of the tide (m/s)")
        ax.set_ylabel("wave height (m)")
    shares = _shares(axes[3], claims(open_trends, change))
    headline(
        figure,
        f"B5 to B10 hold together in {100 * shares['all six']:.0f} % of the samples",
    )
    return figure


def _shares(ax: Axes, held: xr.DataArray) -> dict[str, float]:
    """Draw and return the share of the samples in which each claim and all six are true."""
    shares = {str(c): float(held.sel(claim=c).mean()) for c in TOGETHER}
    shares["all six"] = float(held.all("claim").mean())
    for k, (name, share) in enumerate(shares.items()):
        bar = ax.barh(k, 100.0 * share, color=COLOURS[2] if name == "all six" else COLOURS[0])
        ax.bar_label(bar, fmt="%.0f", fontsize="x-small", padding=2)
    ax.set_yticks(range(len(shares)), list(shares))
    ax.invert_yaxis()
    ax.set_xlim(0, 112)
    ax.set_xlabel(f"share of {held.sizes['sample']} samples (%)")
    return shares


def solvers(small_deflection: xr.Dataset) -> Figure:
    """Difference of the two solvers over the deflection."""
    figure, (ax,) = panels()
    largest = abs(small_deflection["x"].sel(solver=BEAM)).max(("time", "s"))
    apart = differences(small_deflection)
    for colour, (name, label) in zip(
        COLOURS, (("x", "deflection"), ("bending_moment", "bending moment")), strict=False
    ):
        ax.loglog(largest, 100.0 * apart[name], "o-", color=colour, label=label)
    ax.loglog(largest, 100.0 * float(apart["x"][-1]) * (largest / largest[-1]) ** 2, **PRINTED,
              label="square of the deflection")  # fmt: skip
    ax.set_xticks(largest.values, [f"{value:.2g}" for value in largest.values])
    ax.minorticks_off()
    ax.set_xlabel("largest deflection (m)")
    ax.set_ylabel("largest difference over largest value (%)")
    ax.legend(fontsize="small")
    far = {name: 100.0 * float(apart[name].max()) for name in ("x", "bending_moment")}
    headline(
        figure,
        f"Deflections of both models agree to {far['x']:.2g} %, moments only to "
        f"{far['bending_moment']:.0f} %",
    )
    return figure


def grid_test(grid_test: xr.Dataset, own_setting: xr.Dataset) -> Figure:
    """Error over element length, and the time of a run, that of the paper's own setting among them."""
    figure, (left, right) = panels(1, 2, 3.6)
    error, elements = 100.0 * grid_error(grid_test), [str(e) for e in grid_test["element"].values]
    lengths = [float(element.split()[0]) for element in elements]
    for colour, mark, step in zip(COLOURS, "os^Dv<>", grid_test["time_step"].values, strict=False):
        curve = error.sel(time_step=step)
        left.loglog(
            lengths, curve.where(curve > 0.0), mark + "-", color=colour, ms=6, mfc="none", lw=1.0,
            label=f"steps of {step:g} s",
        )  # fmt: skip
        seconds = grid_test["solve_seconds"].sel(time_step=step)
        right.plot(seconds, range(len(elements)), mark, color=colour, ms=6, mfc="none")
    left.set_xticks(lengths, [f"{length:g}" for length in lengths])
    left.xaxis.set_minor_locator(NullLocator())
    left.yaxis.set_major_formatter("{x:g}")
    left.set_xlabel("length of the elements (m)")
    left.set_ylabel("error against the finest grid (%)")
    step = float(
        own_setting["time_step"].min()
    )  # the paper's own, or the nearest to it at this tier
    whole = float(own_setting["solve_seconds"].sel(time_step=step))
    right.plot([GRID_TIME / DURATION * whole], [len(elements)], "*", color=BLACK, ms=11)
    own = (
        "its step" if np.isclose(step, PAPER_STEP) else f"here {step:g} s, its own {PAPER_STEP:g} s"
    )
    length = float(own_setting["s_node"][1] - own_setting["s_node"][0])
    rows = [*elements, f"paper's {length:g} m\n({own})"]
    right.set_yticks(range(len(rows)), rows)
    right.set_ylim(len(rows) - 0.5, -0.5)
    right.set_xscale("log")
    right.xaxis.set_major_formatter("{x:g}")
    right.set_xlabel(f"run time of {GRID_TIME:g} simulated seconds (s)")
    panel_title(right, "by element; star: scaled from 300 s")
    key_below(figure, left, 5)
    most = float(error.sel(element="5 m").max())
    headline(figure, f"Elements of 5 m have an error of up to {most:.1f} % at any tested step")
    return figure


def api2j(api2j: xr.Dataset, api2j_surge: xr.Dataset) -> Figure:
    """Envelopes of the API riser by both solvers, and over its surge; and how far the solvers are apart."""
    figure, axes = panels(1, 3, 4.0)
    for ax, name, scale, label in (
        (axes[0], "x", 1.0, "displacement x (m)"),
        (axes[1], "bending_moment", 1e-3, "bending moment (kN m)"),
    ):
        over = ("surge_amplitude", "surge_phase")
        low, high = (
            scale * api2j_surge[f"{name}_min"].min(over),
            scale * api2j_surge[f"{name}_max"].max(over),
        )
        ax.fill_betweenx(
            api2j_surge["s_node"], low, high, color="0.88", linewidth=0, label="over the surge"
        )
        for solver, style in ((LUMPED, {"color": COLOURS[0]}), (BEAM, PRINTED)):
            run = api2j.sel(solver=solver)
            for side in ("min", "max"):
                word = solver if side == "min" else None
                ax.plot(scale * run[f"{name}_{side}"], run["s_node"], label=word, **style)
        ax.set_xlabel(label)
        ax.set_ylabel(HEIGHT)
    both = api2j[["x", "bending_moment"]]
    apart = abs(both.sel(solver=LUMPED) - both.sel(solver=BEAM)).max("s")
    largest = abs(both.sel(solver=BEAM)).max(("time", "s"))
    for colour, (name, label) in zip(
        COLOURS, (("x", "displacement"), ("bending_moment", "bending moment")), strict=False
    ):
        axes[2].plot(apart["time"], 100.0 * apart[name] / largest[name], color=colour, label=label)
    axes[2].set_xlabel(TIME)
    axes[2].set_ylabel("difference over largest value (%)")
    axes[2].set_ylim(0.0, 1.3 * axes[2].get_ylim()[1])
    axes[2].legend(fontsize="x-small", loc="upper right")
    key_below(figure, axes[0], 3)
    headline(
        figure,
        "Both solvers agree to "
        f"{float((apart['bending_moment'] / largest['bending_moment']).max()):.2%} of the moment, "
        f"{float((apart['x'] / largest['x']).max()):.2%} of the displacement".replace("%", " %"),
    )
    return figure
