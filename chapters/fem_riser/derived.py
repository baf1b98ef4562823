"""The Hamilton-principle riser paper: water under the wave, and the trends in its claims."""

from __future__ import annotations

import json

import numpy as np
import xarray as xr

from chapters.fem_riser.along import measures
from riserstudy.dataset.variables import attributes
from riserstudy.inputs.validate import check
from riserstudy.model.sea import current_table, wave_number
from riserstudy.scene.models import Scene
from riserstudy.scene.sea import RegularWave
from riserstudy.scene.units import to_si

#: measures of a run, and their units
MEASURES = {
    "deflection": "m",
    "deflection_from_line": "m",
    "deflection_place": "1",
    "deflection_from_line_place": "1",
    "vibration": "m",
    "drift": "1",
    "stress": "Pa",
    "stress_from_bottom": "1",
    "stress_from_top": "1",
    "angle": "rad",
    "angle_from_bottom": "1",
    "angle_from_top": "1",
}
BEAM, LUMPED = "Hermite beam", "lumped masses"


def water(motion: xr.Dataset) -> xr.Dataset:
    """Horizontal velocity and acceleration under the wave over (time, depth), and the current over depth."""
    scene = check(Scene, json.loads(motion.attrs["scene"]), "motion")
    wave, levels = scene.wave, scene.water
    if not isinstance(wave, RegularWave) or levels is None or scene.current is None:
        raise TypeError("fem_riser has a regular wave and a current")
    height = (levels.surface or 0.0) - (levels.seabed or 0.0)
    w = 2.0 * np.pi / wave.period
    k = wave_number(w, height, scene.gravity or 0.0)
    depth = np.append(np.linspace(0.0, 100.0, 201), np.linspace(105.0, height, 400))
    time = np.linspace(0.0, 2.0 * wave.period, 97)
    amplitude = wave.amplitude or 0.5 * (wave.height or 0.0)
    fade = (np.exp(-k * depth) + np.exp(-k * (2.0 * height - depth))) / -np.expm1(-2.0 * k * height)
    phase = (wave.phase or 0.0) - w * time[:, None]
    z, speed = current_table(scene.current, levels)
    dataset = xr.Dataset(
        {
            "wave_velocity": (("time", "below_surface"), amplitude * w * np.cos(phase) * fade),
            "wave_acceleration": (("time", "below_surface"), amplitude * w**2 * np.sin(phase) * fade),
            "water_speed": ("below_surface", np.interp((levels.surface or 0.0) - depth, z, speed)),
        },
        {"time": time, "below_surface": depth},
    )
    return described(dataset, "water under the wave")


def trends(
    length_500: xr.Dataset, length_1000: xr.Dataset, length_1500: xr.Dataset,
    tension_ratio: xr.Dataset, buoyant_factor: xr.Dataset,
) -> xr.Dataset:  # fmt: skip
    """Measures over length, tension ratio and buoyant factor, by solver."""
    lengths = _over_length(length_500, length_1000, length_1500)
    return _joined({"length": lengths, "ratio": measures(tension_ratio), "factor": measures(buoyant_factor)})


def lumped_trends(**studies: xr.Dataset) -> xr.Dataset:
    """Measures over length, tension ratio and buoyant factor, by lumped masses alone."""
    return trends(**studies).sel(solver=LUMPED, drop=True)


def open_trends(
    open_500: xr.Dataset, open_1000: xr.Dataset, open_1500: xr.Dataset,
    open_ratio: xr.Dataset, open_factor: xr.Dataset,
) -> xr.Dataset:  # fmt: skip
    """Measures over samples of the unspecified inputs as well, by the paper's beam."""
    lengths = _over_length(open_500, open_1000, open_1500)
    ratio, factor = (measures(runs).sel(solver=BEAM, drop=True) for runs in (open_ratio, open_factor))
    return _with_assumed(_joined({"length": lengths, "ratio": ratio, "factor": factor}), open_ratio)


def open_lumped_trends(open_ratio: xr.Dataset, open_factor: xr.Dataset) -> xr.Dataset:
    """Measures over samples, tension ratio and buoyant factor, by lumped masses."""
    ratio, factor = (measures(runs).sel(solver=LUMPED, drop=True) for runs in (open_ratio, open_factor))
    return _with_assumed(_joined({"ratio": ratio, "factor": factor}), open_ratio)


def _with_assumed(dataset: xr.Dataset, samples: xr.Dataset) -> xr.Dataset:
    """Dataset with the assumed inputs of each sample."""
    assumed = [name for name in samples.data_vars if str(name).startswith("assumed_")]
    return dataset.assign({name: samples[name] for name in assumed})


def map_trends(map_500: xr.Dataset, map_1000: xr.Dataset, map_1500: xr.Dataset) -> xr.Dataset:
    """Measures over length, joints, tide and wave height."""
    return _joined({"length": _over_length(map_500, map_1000, map_1500)})


def reading_trends(readings: xr.Dataset, readings_literal: xr.Dataset) -> xr.Dataset:
    """Measures over the buoyant factor and its interpretation.

    In R4 the factor is the share that blocks carry, and the tension ratio refers to the weight of riser and
    mud. Therefore R4 is R3 with the share that is left.
    """
    literal = measures(readings_literal).rename(weight_left="buoyant_factor")
    literal = literal.assign_coords(buoyant_factor=1.0 - literal["buoyant_factor"])
    literal = literal.assign_coords(buoyant_factor=literal["buoyant_factor"].round(9))
    both = [measures(readings), literal.assign_coords(reading="R4").expand_dims("reading")]
    return _joined({"factor": xr.concat(both, "reading", coords="minimal", compat="override")})


def rest(at_rest: xr.Dataset) -> xr.Dataset:
    """Measures of the softest cases in their final state."""
    return _joined({"case": measures(at_rest)})


def drift_trends(top_drift: xr.Dataset) -> xr.Dataset:
    """Measures over the offset of the top from the wellhead."""
    return _joined({"offset": measures(top_drift)})


def wind_trends(wind_500: xr.Dataset, wind_2000: xr.Dataset) -> xr.Dataset:
    """Measures over length, the wind-driven component of the current, and tide."""
    return _joined({"length": _over_length(wind_500, wind_2000)})


def sample_error(open_fine: xr.Dataset, open_ratio: xr.Dataset) -> xr.Dataset:
    """Relative error of each measure on the mesh of the samples, for the samples with a finer run.

    Deflection is from the line between the ends: the drift of the top has no error, and may exceed it.
    """
    fine = measures(open_fine)
    coarse = measures(open_ratio).sel(sample=fine["sample"], solver=BEAM)
    sizes = {"deflection": "deflection_from_line"} | {name: name for name in ("vibration", "stress", "angle")}
    dataset = xr.Dataset({name: abs(coarse[of] / fine[of] - 1.0) for name, of in sizes.items()})
    for name in sizes:
        dataset[name].attrs = {"units": "1", "long_name": f"relative error of {name}"}
    return described(dataset, "error of the samples")


def _over_length(*runs: xr.Dataset) -> xr.Dataset:
    lengths = [to_si(json.loads(r.attrs["scene"])["riser"][0]["length"], "m") for r in runs]
    return xr.concat([measures(r) for r in runs], xr.DataArray(lengths, dims="length", name="length"))


def _joined(parts: dict[str, xr.Dataset]) -> xr.Dataset:
    """Measures of several studies in one dataset, named <measure>_by_<study's axis>."""
    named = {
        f"{name}_by_{axis}": part[name].drop_vars([c for c in part[name].coords if c not in part[name].dims])
        for axis, part in parts.items()
        for name in MEASURES
    }
    dataset = xr.Dataset(named)
    for label in named:
        name = label.rsplit("_by_", 1)[0]
        dataset[label].attrs = {"units": MEASURES[name], "long_name": name.replace("_", " ")}
    return described(dataset, "trends")


def described(dataset: xr.Dataset, title: str) -> xr.Dataset:
    """Dataset with attributes of its variables and global attributes."""
    for name in dataset.variables:
        dataset[name].attrs = attributes(str(name)) or dataset[name].attrs
    dataset.attrs = {"Conventions": "CF-1.11", "paper": "fem_riser", "title": f"fem_riser: {title}"}
    return dataset
