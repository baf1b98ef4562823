"""A schematic of any scene, drawn to scale: its parts, their degrees of freedom, and the loads on them.

Every panel has one scale in both directions. A long riser is shown whole, where the pipe is narrower than any
line, and again with both ends magnified. Parts without a size in the scene (platform, bodies, upright
cylinders) are drawn dashed, as symbols. The riser is drawn unstretched, before current and waves act on it.
"""

from __future__ import annotations

import textwrap
from collections.abc import Mapping

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from riserstudy.figures.style import as_written
from riserstudy.scene.resolve import Resolved
from riserstudy.schematic.above import above, has_plan, radius
from riserstudy.schematic.facts import freedom_text
from riserstudy.schematic.geometry import ASSUMED, CALIBRATED, Geometry, is_spring
from riserstudy.schematic.labels import KEY, SIZE, Label, place_in_column
from riserstudy.schematic.not_shown import parts_left_out
from riserstudy.schematic.riser import borders, ends, riser
from riserstudy.schematic.sea import sea
from riserstudy.schematic.topside import topside
from riserstudy.schematic.view import View
from riserstudy.schematic.words import in_words

WIDTH, HEIGHT = 9.6, 7.6  # of the figure (inches)
COLUMNS = (0.7, 5.5)  # left ends of the panels (inches)
FLOOR, CEILING = 0.75, 6.75  # of the panels (inches)
WHOLE, END = 2.0, 1.85  # widths of panels (inches)
BETWEEN = 0.6  # vertical distance between panels (inches)
SHARES = {2: (0.5, 0.5), 3: (0.48, 0.28, 0.24)}  # of the right column, by the number of panels
SHARES_OF_SPRING = (0.7, 0.3)  # a riser that is a spring has no parts at its lower end
MARGIN = 0.16  # share of the whole view that stays free above and below its parts
NEAR = 0.12  # share of the riser's length that is shown at its ends
MOST = 40.0  # but at most this length (m), unless a longer part is there
HANGING = 0.8  # height of a body, the arrow of its weight, and a margin (inches)
#: height of the panel of an end if there are two (inches)
FULL = 0.5 * (CEILING - FLOOR - BETWEEN)
AXES = ("horizontal position (m)", "elevation (m)")  # of a scene without lateral motion
NAMED_AXES = ("horizontal position x (m)", "elevation z (m)")
NOTE = "Each panel has one scale in both directions; lines have a least width"
SYMBOLS = "Dashed: symbols of parts without a size in the scene; in (a) they are enlarged"


def schematic(
    scene: Resolved,
    *,
    standing: bool = False,
    remarks: Mapping[str, str] | None = None,
    assumed: frozenset[str] = frozenset(),
    calibrated: frozenset[str] = frozenset(),
) -> Figure:
    """Draw a scene.

    Parameters
    ----------
    standing : draw cylinders without an arrangement below the ring.
    remarks : remarks for the labels of parts, by the paths of the parts.
    assumed, calibrated : paths of values that the scene assumes, or fits to a published value; all numbers
        from such values are marked in the drawing.
    """
    with as_written():
        return _schematic(Geometry(scene, standing, remarks or {}, assumed, calibrated), scene)


def _schematic(geometry: Geometry, scene: Resolved) -> Figure:
    figure = Figure((WIDTH, HEIGHT), dpi=150, facecolor="white")
    whole = _panel(figure, COLUMNS[0], FLOOR, (WHOLE, CEILING - FLOOR), *_all(geometry), whole=True)
    whole.ax.set_title("(a) whole riser", loc="left", fontsize="small")
    views = [whole]
    plan = has_plan(scene)
    shares = SHARES[3 if plan else 2]
    if all(map(is_spring, scene.riser)):
        shares = SHARES_OF_SPRING
    room, top = CEILING - FLOOR - BETWEEN * (len(shares) - 1), CEILING
    windows = {
        "upper end": _upper(geometry, shares[0] * room),
        "lower end": _lower(geometry, shares[1] * room),
    }
    if plan:
        windows["from above"] = ((0.0, 0.0), 2.0 * radius(geometry))
    for letter, share, (name, window) in zip("bcd", shares, windows.items(), strict=False):
        height = share * room
        view = _panel(figure, COLUMNS[1], top - height, (END, height), *window)
        times = _times(whole.inch / view.inch)
        title = name if name == "from above" and not _to_scale(scene) else f"{name}, scale of (a) × {times}"
        view.ax.set_title(f"({letter}) {title}", loc="left", fontsize="small")
        views.append(view)
        top -= height + BETWEEN
    whole.ends.extend(views[1:3])
    for view in views[:3]:
        sea(view, geometry)
        riser(view, geometry)
        ends(view, geometry)
        topside(view, geometry)
    if plan:
        views[3].ax.set_ylabel("y (m)", fontsize=SIZE, labelpad=1.0)
        if not _to_scale(scene):
            views[3].ax.set(xticks=[], yticks=[], xlabel="x", ylabel="y")
        above(views[3], geometry)
    for column in (views[:1], views[1:]):
        place_in_column([(view.labels, view.ax) for view in column])
    if not (scene.lateral or plan):
        for view in views:
            view.ax.set_xlabel(AXES[0])
            view.ax.set_ylabel(AXES[1])
    styles = [
        *(patch.get_linestyle() for view in views for patch in view.ax.patches),
        *(line.get_linestyle() for view in views for line in view.ax.lines),
    ]
    dashed = any(style not in ("-", "solid", "None") for style in styles)
    _texts(figure, geometry, [row for view in views for row in view.labels.rows], dashed)
    return figure


def _times(ratio: float) -> str:
    return f"{ratio:.2g}" if ratio < 100 else f"{round(ratio, -1):.0f}"


def _to_scale(scene: Resolved) -> bool:
    """Return whether the view from above shows more than headings."""
    return bool(scene.top.tensioners and scene.top.tensioners.arrangement)


def _panel(
    figure: Figure,
    left: float,
    floor: float,
    size: tuple[float, float],
    middle: tuple[float, float],
    height: float,
    whole: bool = False,
) -> View:
    """Make a panel around a point, with its height in metres and its position and size in inches."""
    width = height * size[0] / size[1]
    place = (left / WIDTH, floor / HEIGHT, size[0] / WIDTH, size[1] / HEIGHT)
    ax = figure.add_axes(place)
    ax.set_xlim(middle[0] - 0.5 * width, middle[0] + 0.5 * width)
    ax.set_ylim(middle[1] - 0.5 * height, middle[1] + 0.5 * height)
    ax.tick_params(labelsize=SIZE)
    ax.locator_params(nbins=5)
    ax.set_xlabel(NAMED_AXES[0], fontsize=SIZE, labelpad=1.0)
    ax.set_ylabel(NAMED_AXES[1], fontsize=SIZE, labelpad=1.0)
    return View(ax, whole, inch=height / size[1])


def _all(geometry: Geometry) -> tuple[tuple[float, float], float]:
    """Return middle and height of the whole view (m)."""
    x = geometry.line[1]
    height = (geometry.highest - geometry.lowest) / (1.0 - MARGIN)
    wide = 1.3 * float(x.max() - x.min()) * (CEILING - FLOOR) / WHOLE
    middle = geometry.highest + 0.6 * MARGIN * height - 0.5 * height
    return (0.5 * float(x.max() + x.min()), middle), max(height, wide)


def _upper(geometry: Geometry, inches: float) -> tuple[tuple[float, float], float]:
    """Return middle and height of the view of the upper end (m), for a panel height in inches."""
    x, ring = geometry.ring
    span = geometry.deck - ring
    near = min(MOST, NEAR * geometry.riser_length)
    if span > 0.0:
        return (x, ring + 0.55 * span), 1.9 * span
    if geometry.standing:
        return (geometry.top[0], ring - 0.2 * near), near
    surface = geometry.surface
    if surface is not None and 0.2 * near < abs(surface - ring) < 2.0 * near:
        near = 2.2 * abs(surface - ring)
    elif geometry.scene.bottom.body:
        near *= inches / FULL  # the scale of the lower end
    return (geometry.top[0], ring + 0.12 * near), near


def _lower(geometry: Geometry, inches: float) -> tuple[tuple[float, float], float]:
    """Return middle and height of the view of the lower end (m), for a panel height in inches."""
    x, z = geometry.bottom
    short = geometry.short_below()
    near = min(MOST, NEAR * geometry.riser_length)
    body = geometry.scene.bottom.body
    middle, height = z + (0.02 if body else 0.18) * near, near
    if 0.0 < short < geometry.riser_length:
        middle, height = z + 0.5 * short, 1.35 * short
    if body is None:
        return (x, middle), height
    # One scale for all panel heights, as symbols must have one size; body and weight hang below.
    above = middle + 0.5 * height - z
    scale = max(height / FULL, above / (FULL - HANGING))
    height = scale * inches
    below = max(scale * HANGING, height - above)
    return (x, z - below + 0.5 * height), height


def _note(geometry: Geometry, labels: list[Label], dashed: bool) -> str:
    """Return a note about the scale, the marks in the labels, and the parts that are not shown."""
    scene = geometry.scene
    moved = ""
    if (scene.platform or scene.vessel) and geometry.has_upright_cylinders:
        moved = ", as is the ring. "
        if geometry.surface is None:
            moved += f"There the platform is moved {'down' if geometry.standing else 'up'}"
        else:
            moved += "The platform's height is not to scale"
    current, waves = scene.current is not None, scene.wave is not None
    loads = "current and waves act" if current and waves else "the current acts"
    before = f", before {loads if current else 'waves act'} on it" if current or waves else ""
    named = ", ".join(map(in_words, parts_left_out(scene)))
    missing = f" Not shown: {named}." if named else ""
    meanings = {ASSUMED: "assumed; derived values have no mark", CALIBRATED: "calibrated"}
    marks = "".join(
        f" {mark}: {meaning}."
        for mark, meaning in meanings.items()
        if any(mark in label.text for label in labels)
    )
    symbols = f". {SYMBOLS}{moved}" if dashed or moved else ""
    parts = ". Marks in (a) divide the riser into sections" if borders(geometry) else ""
    return f"{NOTE}{symbols}{parts}. The riser is unstretched{before}.{marks}{missing}"


def _texts(figure: Figure, geometry: Geometry, labels: list[Label], dashed: bool) -> None:
    """Write title, directions of motion, meaning of colours and marks, and the note about the scale."""
    scene, used = geometry.scene, {label.colour for label in labels}
    title = "\n".join(textwrap.wrap(scene.title, 100))
    figure.suptitle(title, x=0.03, y=0.985, ha="left", va="top", fontsize=10)
    figure.text(0.03, 0.945, freedom_text(scene), fontsize=8.5, va="top", color=KEY["freedoms and motions"])
    handles = [Line2D([], [], color=colour, label=name) for name, colour in KEY.items() if colour in used]
    figure.legend(
        handles=handles, loc="upper right", bbox_to_anchor=(0.985, 0.962), ncols=4, fontsize=SIZE,
        frameon=False, handlelength=1.2, columnspacing=1.2,
    )  # fmt: skip
    note = "\n".join(textwrap.wrap(_note(geometry, labels, dashed), 150))
    figure.text(0.03, 0.012, note, fontsize=SIZE, va="bottom", color="0.35")
