"""One run of a chapter for an animation in the report: thinned, with platform and histories."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from riserstudy.dataset.provenance import scene_of_point
from riserstudy.figures.grid import evenly_spaced
from riserstudy.records.arrays import FloatArray
from riserstudy.records.units import after_number
from riserstudy.scene.forcing import TILTS, TRANSLATIONS
from riserstudy.scene.resolve import Resolved
from riserstudy.schematic.geometry import Geometry
from riserstudy.study.models import RunInMotion

if TYPE_CHECKING:
    import xarray as xr

# most times and nodes of the riser, and most times of the histories, that are shown
FRAMES, NODES, MOMENTS = 101, 61, 301
MOST_HISTORIES = 3
DEGREES = 180.0 / np.pi
# positions along a riser that is one spring, most of them near its top
SPRING = np.array([0.0, *np.linspace(0.98, 1.0, 40)])
UPRIGHT = 20.0  # distance from ring to platform if the scene gives upright cylinders no length (m)


class History(NamedTuple):
    """Quantities with one unit over time."""

    label: str
    lines: dict[str, FloatArray]  # by name, (times,) each


class Motion(NamedTuple):
    """A run, thinned; positions in metres."""

    title: str
    scene: Resolved
    time: FloatArray  # (frames,) s
    x: FloatArray  # (frames, nodes)
    y: FloatArray | None  # the same, None in the plane
    z: FloatArray
    rest: tuple[FloatArray, FloatArray]  # x and z of the nodes at rest
    colour: FloatArray  # (frames, nodes), in `unit`
    quantity: str
    unit: str
    signed: bool
    platform: tuple[FloatArray, FloatArray] | None  # x and z (frames,)
    moments: FloatArray  # times of the histories (s)
    histories: list[History]


def motion_of(of_run: RunInMotion, dataset: xr.Dataset, caption: str) -> Motion:
    """Return the run of a dataset that a study file selects for the animation; ``caption``: of its study."""
    run = dataset.sel(of_run.at)
    index = {axis: dataset.get_index(axis).get_loc(value) for axis, value in of_run.at.items()}
    scene = scene_of_point(dataset, index)
    time = run["time"].values
    geometry = Geometry(scene)
    frames = evenly_spaced(len(time), FRAMES)
    thin = run.isel(time=frames, s=evenly_spaced(run.sizes["s"], NODES))
    s = thin["s"].values
    rest = _rest(run, geometry, s)
    x, z = (
        thin[name].values if name in thin else np.tile(values, (len(frames), 1))
        for name, values in zip("xz", rest, strict=True)
    )
    colour = thin[of_run.colour].values / 1e3
    if len(s) == 1:  # one spring, known only at its top: it stretches evenly under one tension
        foot = geometry.bottom[1]
        x, z = 0.0 * SPRING + x, foot + SPRING * (z - foot)
        colour = np.repeat(colour, len(SPRING), axis=1)
        rest = (0.0 * SPRING, foot + SPRING * (rest[1] - foot))
    moments = evenly_spaced(len(time), MOMENTS)
    moved = _displaced(scene, time)
    place = None
    if moved is not None or scene.vessel:
        place = _platform(scene, geometry, x, z, None if moved is None else moved[frames])
    return Motion(
        title=_title(caption, dataset, of_run.at),
        scene=scene,
        time=time[frames],
        x=x,
        y=thin["y"].values if "y" in thin else None,
        z=z,
        rest=rest,
        colour=colour,
        quantity=str(dataset[of_run.colour].attrs["long_name"]),
        unit={"bending_moment": "kN m", "effective_tension": "kN"}[of_run.colour],
        signed=of_run.colour == "bending_moment",
        platform=place,
        moments=time[moments],
        histories=_histories(run.isel(time=moments), scene, None if moved is None else moved[moments]),
    )


def _displaced(scene: Resolved, time: FloatArray) -> FloatArray | None:
    """Return the displacement of the platform over time, (times, 6) in m and rad; None without platform."""
    if scene.platform is None:
        return None
    # Imports the kernels, which a report without a platform does not need.
    from riserstudy.model.platform_motion import displacement

    return displacement(scene, time)


def _title(caption: str, dataset: xr.Dataset, at: dict[str, Any]) -> str:
    chosen = [f"{axis.replace('_', ' ')}: {_with_unit(dataset[axis], at[axis])}" for axis in at]
    return f"{caption} ({'; '.join(chosen)})" if chosen else caption


def _with_unit(axis: xr.DataArray, value: Any) -> str:
    """Return a place on an axis as text, a number with its unit."""
    if axis.dtype.kind != "f":
        return str(value)
    return f"{float(value):g}{after_number(axis.attrs.get('units', ''))}"


def _rest(run: xr.Dataset, geometry: Geometry, s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the position at rest (m): from the run if it contains it, else the position without load."""
    x, z = (np.array(row) for row in zip(*map(geometry.at, s), strict=True))
    kept = {name: run[name].values for name in ("x_static", "z_static") if name in run}
    nodes = run["s_node"].values if kept else s
    x = np.interp(s, nodes, kept["x_static"]) if "x_static" in kept else x
    z = np.interp(s, nodes, kept["z_static"]) if "z_static" in kept else z
    return x, z


def _platform(
    scene: Resolved, geometry: Geometry, x: FloatArray, z: FloatArray, moved: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """Return the position of the platform (m): in directions in which it holds the riser, that of the top."""
    top = scene.top
    zero = np.zeros(len(x))
    surge = zero if moved is None else moved[:, 0]
    heave = zero if moved is None else moved[:, 2]
    upright = top.tensioners and not top.tensioners.arrangement and not top.telescopic_joint
    deck = geometry.top[1] + (UPRIGHT if upright else 0.0)
    return (
        x[:, -1] if top.x in ("platform", "vessel") else surge,
        z[:, -1] if top.z == "platform" else deck + heave,
    )


def _histories(run: xr.Dataset, scene: Resolved, moved: FloatArray | None) -> list[History]:
    """Return the quantities that are shown over time."""
    rows = []
    if "platform_surge" in run:
        rows.append(History("platform (m)", {"surge": run["platform_surge"].values}))
    elif moved is not None:
        for names, start, label, unit in (
            (TRANSLATIONS, 0, "platform (m)", 1.0),
            (TILTS, 3, "platform (°)", DEGREES),
        ):
            lines = {n: unit * moved[:, start + k] for k, n in enumerate(names)}
            if lines := {name: line for name, line in lines.items() if np.any(line)}:
                rows.append(History(label, lines))
    if "stroke" in run:
        joint = "telescopic joint" if scene.top.telescopic_joint else "tensioners"
        rows.append(History("stroke (m)", {joint: run["stroke"].values}))
    joints = {"upper": "ufj_angle", "lower": "lfj_angle"}
    angles = {name: DEGREES * run[of].values for name, of in joints.items() if of in run}
    if angles:
        rows.append(History("flex joints (°)", angles))
    if "bending_moment" in run and len(rows) < MOST_HISTORIES:
        largest = abs(run["bending_moment"]).max("s").values / 1e3
        rows.append(History("largest moment (kN m)", {"along the riser": largest}))
    elif "effective_tension" in run and len(rows) < MOST_HISTORIES:
        tension = run["effective_tension"].isel(s=-1).values / 1e3
        rows.append(History("top tension (kN)", {"riser's top": tension}))
    return rows[:MOST_HISTORIES]
