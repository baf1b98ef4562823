"""Animation of a run: the riser in a side view or in space, and histories on its right.

A frame contains only the data that change; the style of all traces is stored once, in the figure.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Callable
from typing import Any

import numpy as np
import plotly.graph_objects as go
import plotly.io as pio
from numpy.typing import NDArray
from plotly.subplots import make_subplots

from riserstudy.figures.style import COLOURS, GREY
from riserstudy.report.motion import Motion

# shares of the width: riser, colour bar, start of histories
RISER, BAR, HISTORIES = (0.0, 0.4), 0.43, 0.61
HEIGHT = 560  # of the figure (pixels)
NARROW = 790  # the same with the histories below the riser
#: in that layout, as shares: bottom, top and width of the riser's view; height of all histories
ABOVE, BELOW = (0.59, 1.0, 0.7), 0.48
FARTHER = 1.45  # factor on the distance of the camera in space, where labels need room
RISER_ASPECT = 0.95  # width over height of the side view, for the calculation of its scale
LONG = 18  # letters of the label of a history, above which its unit has a separate row
NICE = np.array([1.0, 2.0, 5.0])
# breadth of the view in space over its height: at most, for the wider; at least
WIDE, SLIM = 0.6, 0.06
FONT = {"family": "Source Sans 3, Segoe UI, Helvetica Neue, Arial, sans-serif", "size": 12}
IN_SPACE = {"family": "Arial", "size": 13}  # one name: views in space accept no list of fonts
EYE = {"x": 0.85, "y": -1.25, "z": 0.25}  # position of the camera of a view in space
# the middle is visible on white, too
DIVERGING = [[0.0, "#2166ac"], [0.5, "#b9c0c7"], [1.0, "#b2182b"]]
PAUSE = 60  # between frames while playing (ms)

Trace = dict[str, Any]
# from the number of a frame to the changes of each moving trace
Moving = Callable[[int], list[Trace]]


def animation(motion: Motion) -> str:
    """Return the figure as JSON, with one frame per time; slider and buttons select the frame."""
    rows = max(1, len(motion.histories))
    kind = "scene" if motion.y is not None else "xy"
    figure = make_subplots(
        rows,
        2,
        column_widths=[HISTORIES, 1.0 - HISTORIES],
        specs=[[{"type": kind, "rowspan": rows}, {}], *([[None, {}]] * (rows - 1))],
        horizontal_spacing=0.0,
        vertical_spacing=0.07,
    )
    still, traces, moving = _riser_traces(motion)
    for trace in [still, *traces]:
        figure.add_trace(trace, 1, 1)
    cursors = _histories(figure, motion)
    last = len(figure.data)
    changed = [*range(1, 1 + len(traces)), *range(last - len(motion.histories), last)]
    for place, trace in zip(changed, [*moving(0), *cursors(0)], strict=True):
        figure.data[place].update(trace)
    _axes(figure, motion)
    _controls(figure, motion)
    figure.update_layout(
        template="simple_white",
        height=HEIGHT,
        font=FONT,
        margin={"l": 60, "r": 20, "t": 20, "b": 20},
        showlegend=False,
        separators=".\u00a0",  # of thousands, from five digits on
    )
    figure.update_xaxes(exponentformat="none")
    figure.update_yaxes(exponentformat="none")
    frames = [
        {"name": f"{k}", "traces": changed, "data": [*moving(k), *cursors(k)]}
        for k in range(len(motion.time))
    ]
    # plain: as objects of plotly's, each checked, a thousand frames take seconds
    whole = figure.to_dict() | {"frames": frames, "narrow": _narrow(motion, rows)}
    return str(pio.to_json(whole, validate=False))


def small(values: NDArray[np.float64]) -> Trace:
    """Return values as stored: single precision is more than a screen shows."""
    return {"dtype": "f4", "bdata": b64encode(np.asarray(values, "<f4").tobytes()).decode()}


# the riser


def _riser_traces(motion: Motion) -> tuple[go.Scatter, list[go.Scatter], Moving]:
    """Return the fixed trace behind the riser, the moving traces, and the function that moves them."""
    low, high = float(motion.colour.min()), float(motion.colour.max())
    both_ways = motion.signed and low < 0.0
    if both_ways:
        low, high = -max(-low, high), max(-low, high)
    shade = {"colorscale": DIVERGING if both_ways else "Viridis", "cmin": low, "cmax": high}
    title = "<br>".join([*motion.quantity.split(), f"({motion.unit})"])  # narrower than the gap on its right
    bar = {"title": {"text": title, "font": {"size": 11}}, "len": 0.6, "thickness": 10, "x": BAR}
    bar |= {"exponentformat": "none"}
    if motion.y is not None:
        return _in_space(motion, shade, bar)
    return _from_the_side(motion, shade, bar)


def _from_the_side(motion: Motion, shade: Trace, bar: Trace) -> tuple[go.Scatter, list[go.Scatter], Moving]:
    rest = go.Scatter(
        x=small(motion.rest[0]),
        y=small(motion.rest[1]),
        mode="lines",
        line={"color": GREY, "width": 1, "dash": "dash"},
        hoverinfo="skip",
    )
    about = f"{motion.quantity} %{{marker.color:.4g}} {motion.unit}<br>"
    riser = go.Scatter(
        mode="lines+markers",
        line={"color": "#9aa4ad", "width": 2},
        marker={"size": 7, "colorbar": bar, **shade},
        hovertemplate=about + "x %{x:.4g} m, z %{y:.5g} m<extra></extra>",
    )
    platform = go.Scatter(  # a symbol above the riser, with the tensioners that connect both
        mode="lines+markers",
        line={"color": "#22282e", "width": 2, "dash": "dot"},
        # two bars, between which the top of the riser stays visible
        marker={
            "symbol": "line-ew",
            "size": [9, 17],
            "color": "#22282e",
            "line": {"color": "#22282e", "width": [2, 5]},
        },
        hovertemplate="platform<br>x %{x:.4g} m, z %{y:.5g} m<extra></extra>",
    )

    def moving(k: int) -> list[Trace]:
        x, z, colour = motion.x[k], motion.z[k], motion.colour[k]
        moved: list[Trace] = [{"x": small(x), "y": small(z), "marker": {"color": small(colour)}}]
        if motion.platform is not None:
            deck_x, deck_z = (float(place[k]) for place in motion.platform)
            moved.append({"x": [float(x[-1]), deck_x], "y": [float(z[-1]), deck_z]})
        return moved

    return rest, [riser, platform][: len(moving(0))], moving


def _in_space(motion: Motion, shade: Trace, bar: Trace) -> tuple[go.Scatter3d, list[go.Scatter3d], Moving]:
    y = motion.y if motion.y is not None else 0.0 * motion.x
    trail = go.Scatter3d(
        x=small(motion.x[:, 0]),
        y=small(y[:, 0]),
        z=small(motion.z[:, 0]),
        mode="lines",
        line={"color": GREY, "width": 2},
        hoverinfo="skip",
    )

    riser = go.Scatter3d(
        mode="lines",
        line={"width": 7, "colorbar": bar, **shade},
        hovertemplate="x %{x:.4g} m, y %{y:.4g} m, z %{z:.5g} m<extra></extra>",
    )
    top = go.Scatter3d(
        mode="markers",
        marker={"symbol": "square-open", "size": 9, "color": "#22282e"},
        hovertemplate="platform<extra></extra>",
    )

    def moving(k: int) -> list[Trace]:
        places = {"x": motion.x[k], "y": y[k], "z": motion.z[k]}
        whole: Trace = {name: small(values) for name, values in places.items()}
        end: Trace = {name: [float(values[-1])] for name, values in places.items()}
        return [whole | {"line": {"color": small(motion.colour[k])}}, end]

    return trail, [riser, top], moving


# histories


def _histories(figure: go.Figure, motion: Motion) -> Moving:
    """Add histories and, last, their cursors; return the function that moves the cursors."""
    limits = []
    for row, history in enumerate(motion.histories, start=1):
        for colour, (name, line) in zip(COLOURS, history.lines.items(), strict=False):
            figure.add_scatter(
                x=small(motion.moments),
                y=small(line),
                name=name,
                line={"color": colour, "width": 1.3},
                hovertemplate=f"{name} %{{y:.4g}}, %{{x:.4g}} s<extra></extra>",
                row=row,
                col=2,
            )
        values = np.concatenate(list(history.lines.values()))
        limits.append((float(np.nanmin(values)), float(np.nanmax(values))))
        label = history.label
        if len(label) > LONG:
            label = label.replace(" (", "<br>(")
        label += "".join(
            f"<br><span style='color:{colour}'>{name}</span>"
            for colour, name in zip(COLOURS, history.lines, strict=False)
        )
        figure.update_yaxes(title_text=label, title_font_size=11, row=row, col=2)
    figure.update_xaxes(title_text="time (s)", row=max(1, len(limits)), col=2)

    style = {"color": "#22282e", "width": 1}
    for row, pair in enumerate(limits, start=1):
        cursor = go.Scatter(y=list(pair), mode="lines", line=style, hoverinfo="skip")
        figure.add_trace(cursor, row, 2)

    def cursors(k: int) -> list[Trace]:
        now = float(motion.time[k])
        return [{"x": [now, now]} for _ in limits]

    return cursors


# axes and controls


def _axes(figure: go.Figure, motion: Motion) -> None:
    """Set fixed ranges of the axes, and write by which factor horizontal distances are stretched."""
    wide, high = _ranges(motion)
    if motion.y is not None:
        span = [float(np.ptp(values)) or 1.0 for values in (motion.x, motion.y, motion.z)]
        factor = _nice(WIDE * span[2] / max(span[:2]))
        shares = [max(SLIM, factor * across / span[2]) for across in span[:2]]
        along = {name: {"title": {"text": f"{name} (m)", "font": IN_SPACE}} for name in "xyz"}
        figure.update_scenes(
            xaxis={**along["x"], "nticks": 4, "tickfont": IN_SPACE},
            yaxis={**along["y"], "nticks": 4, "tickfont": IN_SPACE},
            zaxis={**along["z"], "tickfont": IN_SPACE},
            aspectmode="manual",
            aspectratio={"x": shares[0], "y": shares[1], "z": 1.0},
            camera={"eye": EYE, "center": {"x": 0, "y": 0, "z": -0.08}},
            domain={"x": list(RISER)},
        )
        figure.add_annotation(
            text=f"x and y drawn {factor:g} times as large as z",
            **{"xref": "paper", "yref": "paper", "x": 0.0, "y": -0.06, "showarrow": False},
        )
        return
    factor = _nice((high[1] - high[0]) * RISER_ASPECT / (wide[1] - wide[0]))
    scale = "" if factor == 1.0 else f", drawn {factor:g} times as large as z"
    figure.update_xaxes(
        title_text=f"x (m){scale}", range=list(wide), constrain="domain", row=1, col=1,
        domain=list(RISER),
    )  # fmt: skip
    figure.update_yaxes(
        title_text="z (m)",
        range=list(high),
        scaleanchor="x",
        scaleratio=1.0 / factor,
        constrain="domain",
        row=1,
        col=1,
    )
    water = motion.scene.water
    if water and water.surface is not None and high[0] < water.surface < high[1]:
        figure.add_hline(water.surface, line={"color": COLOURS[0], "width": 1}, row=1, col=1)
    if water and water.seabed is not None and high[0] < water.seabed < high[1]:
        figure.add_hline(water.seabed, line={"color": "#7a6a4f", "width": 1}, row=1, col=1)


def _ranges(motion: Motion) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the ranges of x and z in the side view: all, or near the top if nothing moves sideways."""
    x = np.concatenate([motion.x.ravel(), *([motion.platform[0]] if motion.platform else [])])
    z = np.concatenate([motion.z.ravel(), *([motion.platform[1]] if motion.platform else [])])
    if not motion.scene.lateral:
        tops = motion.z[:, -1]
        z = np.concatenate([tops, tops - 2.0 * np.ptp(tops), z[z >= tops.min()]])
    reach = float(np.ptp(z))
    low, high = float(z.min()) - 0.04 * reach, float(z.max()) + 0.08 * reach
    if not motion.scene.lateral:
        half = 0.5 * RISER_ASPECT * (high - low)
        return (-half, half), (low, high)
    margin = 0.12 * float(np.ptp(x))
    return (float(x.min()) - margin, float(x.max()) + margin), (low, high)


def _nice(factor: float) -> float:
    """Return the largest of 1, 2, 5, 10, ... that does not exceed a factor (1), at least 1."""
    ladder = (NICE[None, :] * 10.0 ** np.arange(0, 6)[:, None]).ravel()
    return float(max(1.0, *ladder[ladder <= max(1.0, factor)]))


def _controls(figure: go.Figure, motion: Motion) -> None:
    """Add a slider over all frames, and buttons that start and stop the animation."""
    at_once = {"frame": {"duration": 0, "redraw": True}, "mode": "immediate"}
    going = {"frame": {"duration": PAUSE, "redraw": True}, "fromcurrent": True}
    still = {"transition": {"duration": 0}}
    steps = [
        {"label": f"{t:.4g}", "method": "animate", "args": [[f"{k}"], at_once | still]}
        for k, t in enumerate(motion.time)
    ]
    buttons = [
        {"label": "▶", "method": "animate", "args": [None, going | still]},
        {"label": "❚❚", "method": "animate", "args": [[None], at_once | still]},
    ]
    figure.update_layout(
        sliders=[
            {
                "steps": steps,
                "currentvalue": {"prefix": "t = ", "suffix": " s", "font": {"size": 12, "color": "#22282e"}},
                "x": 0.13,
                "len": 0.87,
                "y": -0.1,
                "pad": {"t": 20},
                # ticks would mark every nth frame, not round times; the histories have round times
                "ticklen": 0,
                "minorticklen": 0,
                "font": {"color": "rgba(0,0,0,0)", "size": 1},
            }
        ],
        updatemenus=[
            {
                "type": "buttons",
                "direction": "left",
                "buttons": buttons,
                "showactive": False,
                "x": 0.0,
                "xanchor": "left",
                "y": -0.1,
                "yanchor": "top",
                "pad": {"t": 32},
            }
        ],
    )


def _narrow(motion: Motion, rows: int) -> dict[str, Trace]:
    """Return the changes for a narrow screen: histories below the riser, buttons below the slider.

    ``layout``: changes of the figure's layout; ``riser``: of the trace with the colour bar.
    """
    layout: Trace = {"height": NARROW, "margin.l": 55, "margin.r": 10}
    if motion.y is None:
        layout |= {"xaxis.domain": [0.0, ABOVE[2]], "yaxis.domain": [ABOVE[0], ABOVE[1]]}
        layout |= {"xaxis.title.font.size": 11}
    else:
        layout |= {"scene.domain.x": [0.0, ABOVE[2]], "scene.domain.y": [ABOVE[0], ABOVE[1]]}
        layout |= {"annotations[0].y": ABOVE[0] - 0.02}
        layout |= {"scene.camera.eye": {name: FARTHER * place for name, place in EYE.items()}}
        for name in "xyz":
            layout |= {f"scene.{name}axis.{of}.size": 10 for of in ("tickfont", "title.font")}
    each = (BELOW - 0.05 * (rows - 1)) / rows
    for row in range(rows):
        axis = row + 1 if motion.y is not None else row + 2
        name = "" if axis == 1 else f"{axis}"
        top = BELOW - row * (each + 0.05)
        layout |= {f"xaxis{name}.domain": [0.08, 1.0], f"yaxis{name}.domain": [top - each, top]}
    layout |= {"sliders[0].x": 0.0, "sliders[0].len": 1.0, "sliders[0].y": -0.08}
    layout |= {"updatemenus[0].y": -0.16}
    bar = "line.colorbar" if motion.y is not None else "marker.colorbar"
    middle = 0.5 * (ABOVE[0] + ABOVE[1])
    riser: Trace = {f"{bar}.x": ABOVE[2] + 0.02, f"{bar}.y": middle, f"{bar}.len": 0.3}
    return {"layout": layout, "riser": riser}
