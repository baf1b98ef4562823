"""The operating envelope of a scene: offsets between which limits are met, by current and by sea."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from riserstudy.dataset.limits import coordinates
from riserstudy.dataset.table import Cell, Table
from riserstudy.design.allowances_by_offset import ByOffset, ends_of, with_ends
from riserstudy.design.envelopes import SIDES, envelopes, words_of
from riserstudy.design.operability import AtRest, Offsets, at_offset, moved, offset_of, offsets_of
from riserstudy.design.sea_allowances import Allowance, allowances
from riserstudy.errors import InputError, SimulationError
from riserstudy.model.sea import surface_current
from riserstudy.scene.forcing import Shape
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.study.in_sea import Sea

COLUMNS = ["mode", "sea", "current", "from", "to", "limit at from", "limit at to", "note"]
UNITS = ["", "", "m/s", "m", "m", "", "", ""]
CALM = "calm"
#: change of a scene, such as to another current
Change = Callable[[Resolved], Resolved]
#: allowances of a sea by limit, for arguments ``notify`` and ``change`` as of `allowances`
InSea = Callable[..., list[Allowance]]
STILL = 1e-9  # share of the fastest current that counts as rounding


class Envelope(NamedTuple):
    """Rows by mode, sea and current, and the limits that could not be evaluated, with the reasons."""

    table: Table
    missing: dict[str, str]


def envelope(
    file: SceneFile,
    reach: float,
    currents: Sequence[float],
    seas: Sequence[Sea],
    seeds: int,
    notify: Callable[[str], None] = lambda _: None,
    storm: float | None = None,
    towards: float = 0.0,
) -> Envelope:
    """Offsets between which the limits of each mode are met, for risers at rest with allowances for seas.

    Raises InputError when the scene has no offset that can be changed, or has no current or sea. Raises
    SimulationError when a run in a sea cannot be completed.

    Parameters
    ----------
    reach : largest offset of the search, to both sides of the well (m).
    currents : speeds of the current at the surface (m/s).
    seas : irregular seas; none: calm.
    seeds : number of runs for each sea and current.
    notify : function that receives a description of the next run.
    storm : duration of the seas (s); None: that of a run after its ramps.
    towards : direction of positive offsets, from x towards y (rad).
    """
    scene = file.resolved()
    limits = scene.limits or []
    moved(scene, 0.0, towards)  # refuses a scene without an offset that can be changed
    with_speeds = [with_current(scene, speed) for speed in currents]
    over_limits = coordinates(limits)
    found = np.full((max(len(seas), 1), len(currents), len(limits), len(SIDES)), math.nan)
    lost = np.zeros(found.shape[:-1], bool)
    also = np.full(found.shape[:-1], math.nan)
    missing: dict[str, str] = {}
    for c, (speed, of) in enumerate(zip(currents, with_speeds, strict=True)):
        change = partial(with_current, speed=speed)
        in_seas = [partial(allowances, file, sea, seeds, storm=storm) for sea in seas]
        notify(f"offsets in a current of {speed:g} m/s")
        for n, between in enumerate(_each(of, reach, towards, change, in_seas, notify)):
            for k, one in enumerate(between):
                found[n, c, k], also[n, c, k] = one[:2], one.also
                if one.missing:
                    lost[n, c, k] = True
                    missing.setdefault(over_limits["limit"][k], one.missing)
    names = [f"{sea.height:g} m, {sea.period:g} s" for sea in seas] or [CALM]
    array = xr.DataArray(
        found,
        dims=("sea", "current", "limit", "offset_side"),
        coords=over_limits | {"offset_side": list(SIDES)},
    )
    of_seas = [array.isel(sea=n) for n in range(len(names))]
    rows = [
        [mode, name, float(speed), *_ends(of_sea.isel(current=c), mode, lost[n, c], also[n, c])]
        for mode in dict.fromkeys(limit.mode for limit in limits)
        for n, (name, of_sea) in enumerate(zip(names, of_seas, strict=True))
        for c, speed in enumerate(currents)
    ]
    return Envelope(Table(COLUMNS, UNITS, rows), missing)


def _each(
    scene: Resolved,
    reach: float,
    towards: float,
    change: Change,
    in_seas: Sequence[InSea],
    notify: Callable[[str], None],
) -> list[list[Offsets]]:
    """Offsets of all limits in calm water, or in each sea; all seas share the static solutions.

    The allowances of a sea are computed at the scene's own offset first, and then at the ends of the
    envelopes that follow from them.

    Parameters
    ----------
    change : change of the scene to its current.
    in_seas : for each sea, a function that gives its allowances with a ``change`` of the scene.
    """
    limits = scene.limits or []
    try:
        at = AtRest(scene, reach, towards)
    except SimulationError as failure:
        lost = Offsets(math.nan, math.nan, f"a static equilibrium ({failure})")
        return [[lost] * len(limits)] * max(len(in_seas), 1)
    own = offset_of(scene, towards)
    found = []
    for in_sea in in_seas:
        here = (own, in_sea(notify=notify, change=change))
        first = _offsets(at, [ByOffset([own], [one]) for one in here[1]], reach)

        def there(end: float, in_sea: InSea = in_sea) -> list[Allowance]:
            return in_sea(
                notify=lambda text: notify(f"{text}, at an offset of {end:.4g} m"),
                change=lambda moving: at_offset(change(moving), end, towards),
            )

        added = with_ends(limits, here, ends_of(limits, first, reach), reach, there)
        found.append(_offsets(at, added, reach))
    calm = [ByOffset([own], [Allowance(0.0)])] * len(limits)
    return found or [_offsets(at, calm, reach)]


def _offsets(at: AtRest, added: Sequence[ByOffset], reach: float) -> list[Offsets]:
    """Offsets of all limits with their allowances."""
    return [
        Offsets(math.nan, math.nan, more.missing) if more.missing else offsets_of(at, limit, reach, more.at)
        for limit, more in zip(at.scene.limits or [], added, strict=True)
    ]


def with_current(scene: Resolved, speed: float) -> Resolved:
    """The scene with another surface speed of the current (m/s); a table of speeds is scaled.

    Raises InputError when its current has no surface speed that can be changed.
    """
    current = scene.current
    allowed = "give `current.profile` as a shape with surface_speed, or as points"
    if current is None:
        if speed == 0.0:
            return scene
        raise InputError("scene", "current", "missing, but a current speed is given", allowed)
    profile = current.profile
    if isinstance(profile, Shape):
        changed: object = profile.replaced(surface_speed=speed)
    elif isinstance(profile, list):
        x, y = surface_current(current, scene.water)  # a table may extend above the surface
        turn = current.towards
        own = math.hypot(x, y) if current.turns else x * math.cos(turn) + y * math.sin(turn)
        if abs(own) <= STILL * max(abs(point.speed) for point in profile):
            found = "the current speed at the surface is 0 m/s, so the profile cannot be scaled"
            raise InputError("scene", "current.profile", found, allowed)
        changed = [point.replaced(speed=point.speed * speed / own) for point in profile]
    else:
        found = "the surface current speed of a sum or a wind drift cannot be changed"
        raise InputError("scene", "current.profile", found, allowed)
    return scene.replaced(current=current.replaced(profile=changed))


def _ends(limits: xr.DataArray, mode: str, lost: NDArray[np.bool_], also: NDArray[np.float64]) -> list[Cell]:
    """Offsets of one mode in one sea and current, the governing limits, and a note.

    Parameters
    ----------
    lost : (limits,) true for limits that could not be evaluated.
    also : (limits,) offset (m) outside of its range at which a limit is met, too; NaN: none.
    """
    words = words_of(limits)
    of = np.flatnonzero(limits["mode_of_limit"].values == mode).tolist()
    without = [words[k] for k in of if lost[k]]
    limits = limits.isel(limit=[k for k in of if not lost[k]])
    notes = [f"not evaluated: {', '.join(without)}"] if without else []
    notes += [
        f"{words[k]} is met at other offsets, too, such as {also[k]:.4g} m"
        for k in of
        if not math.isnan(also[k])
    ]
    if not limits.sizes["limit"]:
        return [None, None, "", "", "; ".join(notes)]
    one = envelopes(limits).isel(operation=0)
    ends = [float(value) for value in one["envelope_offset"]]
    names = [str(name) for name in one["governing_limit_name"].values]
    if math.isnan(ends[0]):
        several = not np.isnan(also[of]).all()
        note = "the offsets of the limits do not overlap" if several else "no offset meets all limits"
        return [None, None, "", "", "; ".join([note, *notes])]
    return [
        *(end if math.isfinite(end) else None for end in ends),
        *(name if math.isfinite(end) else "not reached" for name, end in zip(names, ends, strict=True)),
        "; ".join(notes),
    ]
