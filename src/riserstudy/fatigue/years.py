"""Damage over years: sums over sea states, places of the largest damage, and the governing sea states."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.place import value_of
from riserstudy.dataset.provenance import first_scene, name_of
from riserstudy.errors import InputError
from riserstudy.fatigue.occurrence import Occurrence, within
from riserstudy.fatigue.response import ORDER, Response, in_parts
from riserstudy.records.arrays import FloatArray
from riserstudy.records.words import listed
from riserstudy.study.departures import prescribed_motions

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.scene.fatigue import Detail

PLACES = ("detail", "wall_angle", "s_node")
VIBRATION = "vortex-induced vibration"  # name of the effect
HALF = 0.5

OF_WAVES = ("height", "amplitude", "period")  # keys of a regular wave in a scene
#: keys of a wave in a scene that an axis of seas may set, by what they are
KEYS = {"height": ("significant_height", "height", "amplitude"), "period": ("peak_period", "period")}


class Worst(NamedTuple):
    """A detail at the place of its largest damage over the years."""

    detail: str
    s: float  # m
    angle: float  # degree
    rate: float  # 1/year, unfactored
    safety_factor: float
    error_between: float  # relative error of interpolation between sea states; NaN if not known
    chance: float  # relative standard error by seeds; NaN for fewer than two seeds

    @property
    def factored(self) -> float:
        """Damage per year times the safety factor."""
        return self.rate * self.safety_factor

    @property
    def life(self) -> float:
        """Years until the factored damage is one."""
        return 1.0 / self.factored if self.factored > 0.0 else math.inf


class Sea(NamedTuple):
    """A simulated sea state, with all sea states that are nearest to it."""

    values: tuple[float, ...]  # of the axes
    share: float  # of the time
    damage: float  # 1/year, unfactored, where the damage of the governing detail is largest
    vibrates: bool  # whether vortex-induced vibration is simulated there
    error: float  # estimated relative error of the damage in its runs; NaN if not known


class Years(NamedTuple):
    """Damage per year of all details, and the contributions of sea states to the governing detail."""

    rates: FloatArray  # (details, angles, places) 1/year, unfactored
    s: FloatArray  # (places,) m
    worst: list[Worst]
    governing: int
    seas: list[Sea]  # in order of decreasing damage
    axes: list[tuple[str, str]]  # axes of the sea states, with their units
    # estimated relative error of runs, each by its damage; NaN where none is known
    error_runs: float
    notes: tuple[str, ...]
    details: tuple[Detail, ...] = ()  # in the order of `worst`

    @property
    def half(self) -> list[Sea]:
        """The sea states that together cause half of the damage, in order of decreasing damage."""
        total, found = sum(sea.damage for sea in self.seas), []
        for sea in self.seas:
            found.append(sea)
            if sum(one.damage for one in found) >= HALF * total:
                break
        return found

    @property
    def by_vibration(self) -> float:
        """Share of the damage in sea states with simulated vortex-induced vibration."""
        total = sum(sea.damage for sea in self.seas)
        some = sum(sea.damage for sea in self.seas if sea.vibrates)
        return some / total if total > 0.0 else 0.0


def axes_of(study: xr.Dataset) -> list[str]:
    """Axes of a study; empty for a single run. Raises InputError when it has no damage."""
    if "damage_rate" not in study:
        allowed = "give a study or run whose scene has 'fatigue:' and which keeps damage_rate"
        raise InputError(name_of(study), "damage_rate", "the dataset has no fatigue damage", allowed)
    return [str(dim) for dim in study["damage_rate"].dims if dim not in PLACES]


def over_years(study: xr.Dataset, occurs: Occurrence, at: Mapping[str, str], calm: bool = False) -> Years:
    """Damage per year of a study's details in the given sea states.

    Seeds have equal weights. Between simulated sea states, damage is interpolated as in `Response`; the error
    is estimated by omission of every second sea state. Raises InputError when an axis has
    no value, or sea states are outside the simulated range.

    Parameters
    ----------
    study : a dataset with ``damage_rate`` over axes, detail, wall_angle and s_node.
    at : value of each axis that is neither an axis of seas nor of seeds, as text.
    calm : replace values of seas below the lowest simulated value by it.
    """
    axes = axes_of(study)
    _check_seas(study, occurs)
    _check_other_waves(study, occurs)
    study = _at(study, axes, occurs, at)
    seeds = [axis for axis in axes if axis in study.dims and _is_seed(study, axis)]
    for axis in axes:
        if axis in study.dims and axis not in seeds and axis not in occurs.values:
            known = ", ".join(map(str, study[axis].values.tolist()))
            why = "no value of this axis is given, neither here nor in the table"
            raise InputError("--at", axis, why, f"add --at {axis}=VALUE with one of {known}")
    grid = {axis: study[axis].values.astype(float) for axis in occurs.values}
    study = study.sortby([*grid])
    grid = {axis: np.sort(places) for axis, places in grid.items()}
    units = {axis: str(study[axis].attrs.get("units", "")) for axis in grid}
    occurs = within(occurs, grid, calm, units)
    every = study["damage_rate"].transpose(*seeds, *grid, *PLACES)
    rates = every.mean(seeds).values if seeds else every.values
    missing = np.isnan(every.values.reshape(-1, *every.shape[-3:]))
    elsewhere = missing.all(axis=0)  # places without the detail
    if elsewhere.all() or (missing != elsewhere).any():
        allowed = "repeat the study until all its points are complete"
        raise InputError(name_of(study), "damage_rate", "some points have no results", allowed)
    response = Response(grid, np.where(elsewhere, 0.0, rates))
    total = in_parts(response, occurs.values, occurs.shares)
    total[elsewhere] = np.nan
    runs = every.values.reshape(-1, *rates.shape)
    worst = _worst(study, response, occurs, total, runs)
    governing = max(range(len(worst)), key=lambda k: worst[k].factored)
    found = _seas(study, response, occurs, _place(total[governing], governing))
    return Years(
        total,
        study["s_node"].values,
        worst,
        governing,
        found,
        [(axis, str(study[axis].attrs.get("units", ""))) for axis in grid],
        _error_of(found),
        (*occurs.notes, *_of_all_seas(study)),
        tuple(_details(study)),
    )


def _at(study: xr.Dataset, axes: list[str], occurs: Occurrence, at: Mapping[str, str]) -> xr.Dataset:
    """The study at the given values, and at the single value of axes with one value."""
    if unknown := [axis for axis in at if axis not in axes]:
        allowed = f"use one of {', '.join(axes)}" if axes else "omit --at, since the study has no axes"
        raise InputError("--at", unknown[0], "the study has no axis of this name", allowed)
    for axis in axes:
        if axis in at:
            if axis in occurs.values:
                raise InputError("--at", axis, "the table also has this axis", "omit it from --at")
            study = study.isel({axis: value_of(study, axis, at[axis])})
        elif study.sizes[axis] == 1 and axis not in occurs.values:
            study = study.isel({axis: 0})
    return study


def _paths(study: xr.Dataset, axis: str) -> set[str]:
    """Paths of the scene that an axis sets."""
    sets = json.loads(study[axis].attrs.get("sets", "{}"))
    return {path for one in sets.values() for path in one}


def _check_seas(study: xr.Dataset, occurs: Occurrence) -> None:
    """Check that heights and periods of irregular seas are not used for regular waves.

    Raises InputError if they would be.
    """
    for axis in occurs.irregular:
        paths = _paths(study, axis) if axis in study.dims else set()
        if paths and all(path.rpartition(".")[2] in OF_WAVES for path in paths):
            found = f"this axis sets {', '.join(sorted(paths))} of a regular wave, not of an irregular sea"
            allowed = f"give a study of irregular seas, or a table of waves with a column {axis}"
            raise InputError("sea states", axis, found, allowed)


def _check_other_waves(study: xr.Dataset, occurs: Occurrence) -> None:
    """Check that the axes of the seas change both waves of a scene that has one for its platform alone.

    The other wave would be equal in all seas. Raises InputError with the axis that changes one wave only.
    """
    there = first_scene(study).waves.keys()
    for kind, keys in KEYS.items():
        by_axis = {
            axis: {path.rpartition(".")[0] for path in _paths(study, axis) if path.rpartition(".")[2] in keys}
            for axis in occurs.values
        }
        axes = [axis for axis, waves_of in by_axis.items() if waves_of & there]
        if axes and (left := set(there).difference(*by_axis.values())):
            found = f"the {kind} of {min(left)} in the scene is equal in all sea states"
            allowed = "give a study in which this axis sets both waves, or remove one wave from the scene"
            raise InputError("sea states", axes[0], found, allowed)


def _of_all_seas(study: xr.Dataset) -> Iterator[str]:
    """A note about motions of the platform that no sea state changes."""
    if names := prescribed_motions(first_scene(study)):
        yield f"prescribed {listed(names)} of the platform: equal in all sea states"


def _is_seed(study: xr.Dataset, axis: str) -> bool:
    """Whether an axis sets only seeds of the sea or of vortices."""
    paths = _paths(study, axis)
    return bool(paths) and all(path.endswith(".seed") for path in paths)


def _place(rates: FloatArray, detail: int) -> tuple[int, int, int]:
    angle, node = np.unravel_index(int(np.nanargmax(rates)), rates.shape)
    return detail, int(angle), int(node)


def _worst(
    study: xr.Dataset, response: Response, occurs: Occurrence, total: FloatArray, runs: FloatArray
) -> list[Worst]:
    """Each detail at the place of its largest damage, with its errors."""
    found = []
    for k, factor in enumerate(detail.safety_factor for detail in _details(study)):
        place = _place(total[k], k)
        rate = float(total[place])
        here = Response(response.grid, response.rates[(..., *place)])
        each = [
            float(in_parts(Response(response.grid, run[(..., *place)]), occurs.values, occurs.shares))
            for run in runs
        ]
        chance = math.nan
        if len(each) > 1 and rate > 0.0:
            chance = float(np.std(each, ddof=1) / math.sqrt(len(each)) / rate)
        found.append(
            Worst(
                str(study["detail"].values[k]),
                float(study["s_node"].values[place[2]]),
                float(study["wall_angle"].values[place[1]]),
                rate,
                factor,
                _between(here, occurs, rate),
                chance,
            )
        )
    return found


def _between(here: Response, occurs: Occurrence, rate: float) -> float:
    """Relative error of interpolation between sea states at a place; NaN if an axis has too few values."""
    error, fine = 0.0, here.sums(occurs.values, occurs.shares)
    for axis in here.grid:
        between = here.between(axis, occurs.values[axis])
        if rate == 0.0 or not between.any():
            continue
        coarse = here.thinned(axis)
        if not coarse:
            return math.nan
        off = [np.abs(one.sums(occurs.values, occurs.shares) - fine) for one in coarse]
        error += float(np.max(off, axis=0)[between].sum()) / (ORDER - 1.0) / rate
    return error


def gamma_of(study: xr.Dataset, at: Mapping[str, str] | None = None) -> float | None:
    """Peak enhancement (1) of the irregular sea that a study simulates; None for regular waves.

    ``at``: values by axis, as in `over_years`; those of other axes are the first ones.
    """
    index = {axis: value_of(study, axis, value) for axis, value in (at or {}).items() if axis in study.dims}
    for sea in first_scene(study.isel(index)).waves.values():
        if found := getattr(sea, "peak_enhancement", None):
            return float(found)
    return None


def _details(study: xr.Dataset) -> list[Detail]:
    """The details in a study's scene."""
    fatigue = first_scene(study).fatigue
    if fatigue is None:
        found = "the scene that is stored in the dataset has no fatigue details"
        raise InputError(name_of(study), "fatigue", found, "repeat the run with a scene with 'fatigue:'")
    return fatigue.details


def _seas(
    study: xr.Dataset, response: Response, occurs: Occurrence, place: tuple[int, int, int]
) -> list[Sea]:
    """Simulated sea states, each with the sea states nearest to it, in order of decreasing damage."""
    here = Response(response.grid, response.rates[(..., *place)])
    each = here.sums(occurs.values, occurs.shares)
    nearest = [
        np.abs(occurs.values[axis][:, None] - places).argmin(axis=1) for axis, places in here.grid.items()
    ]
    index = np.ravel_multi_index(nearest, tuple(map(len, here.grid.values())))
    vibrating, errors = _vibrating(study, here), _errors(study, here)
    found = []
    for k in np.unique(index):
        at = np.unravel_index(int(k), tuple(map(len, here.grid.values())))
        values = tuple(float(p[i]) for p, i in zip(here.grid.values(), at, strict=True))
        mine = index == k
        found.append(
            Sea(
                values,
                float(occurs.shares[mine].sum()),
                float(each[mine].sum()),
                bool(vibrating[at]),
                float(errors[at]),
            )
        )
    return sorted(found, key=lambda sea: -sea.damage)


def _vibrating(study: xr.Dataset, here: Response) -> NDArray[np.bool_]:
    """Over the grid, whether a sea state includes vortex-induced vibration."""
    shape = tuple(map(len, here.grid.values()))
    if "effects" not in study:
        return np.full(shape, VIBRATION in str(study.attrs.get("effects", "")))
    on = study["effects"].astype(str).str.contains(VIBRATION, regex=False)
    others = [dim for dim in on.dims if dim not in here.grid]
    return np.asarray(on.any(others).transpose(*here.grid).values)


def _errors(study: xr.Dataset, here: Response) -> FloatArray:
    """Over the grid, the largest estimated relative error of damage; NaN without an estimate."""
    if "error_damage" not in study:
        return np.full(tuple(map(len, here.grid.values())), math.nan)
    error = study["error_damage"]
    others = [dim for dim in error.dims if dim not in here.grid]
    return np.asarray(error.max(others).transpose(*here.grid).values)


def _error_of(seas: list[Sea]) -> float:
    """Mean error of the sea states with an estimate, weighted by damage."""
    known = [sea for sea in seas if math.isfinite(sea.error)]
    total = sum(sea.damage for sea in known)
    return sum(sea.error * sea.damage for sea in known) / total if total > 0.0 else math.nan
