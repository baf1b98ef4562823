"""The engine's runs of the benchmark scenes, as the verification tests need them."""

from pathlib import Path

import numpy as np

from riserstudy import load_scene, simulate
from riserstudy.model.mesh import even
from riserstudy.simulation.run import Result, single

SCENES = Path(__file__).parents[2] / "config" / "scenes" / "bench"
METHODS = {
    "rho 0.5": {"rho_inf": 0.5},
    "rho 0.8": {"rho_inf": 0.8},
    "rho 1": {"rho_inf": 1.0},
    "Newmark": {"beta": 0.25, "gamma": 0.5},
}


def scene(name: str, **values):
    """A benchmark scene with values set by dotted path; dots are written as two underscores."""
    return load_scene(SCENES / f"{name}.yaml", **{k.replace("__", "."): v for k, v in values.items()})


def dataset(name: str, elements: int | None = None, **values):
    """Its dataset, on so many equal elements."""
    mesh = {} if elements is None else {"analysis__mesh": {"elements": elements}}
    return simulate(scene(name, **mesh, **values))


def march(name: str, elements: int, step: float, **values) -> Result:
    """One run on given mesh and step, without the second run that estimates its error."""
    wanted = {"analysis__mesh": {"elements": elements}, "analysis__step": f"{step!r} s"}
    file = scene(name, **(wanted | values)).resolved()
    return single(file, even(file, elements), step)


def off(found, expected) -> float:
    """Largest difference over the largest expected value."""
    return float(np.abs(np.asarray(found) - expected).max() / np.abs(expected).max())


def rms(found, expected) -> float:
    """Root mean square difference over the largest expected value."""
    difference = np.asarray(found) - expected
    return float(np.sqrt(np.mean(difference**2)) / np.abs(expected).max())


def slopes(sizes, errors) -> np.ndarray:
    """Order between each two neighbouring sizes (element lengths or steps)."""
    return np.diff(np.log(errors)) / np.diff(np.log(sizes))
