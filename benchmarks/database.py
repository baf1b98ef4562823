"""Time the results database over invented points: building it, bringing it to date, asking it.

``python benchmarks/database.py [POINTS [STUDIES]]`` works in a folder of its own; the table stands in
docs/results_database.md. A point has two axes, the facts of a run, and the extremes of three quantities.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import xarray as xr
from ruamel.yaml import YAML

from riserstudy.database.ask import NAME, ask, opened
from riserstudy.database.build import build
from riserstudy.database.sources import Sources
from riserstudy.database.wide_table import facts_of_points
from riserstudy.dataset.write_dataset import write_dataset

ROOT = Path(__file__).resolve().parents[1]
SCENE = "scenes/bench/s2c.yaml"
PERIODS = 100  # values of the second axis
COMMAND = "import sys; from riserstudy.cli import main; main()"
ASKED = {
    "filtered by an axis and a result, counted": "select count(*) from {table} where heave_amplitude > 3"
    " and effective_tension_min < 0",
    "largest moment of all points, with its study": "select study, place, value from results"
    " join points using (point) where quantity = 'bending_moment' and statistic = 'max'"
    " order by value desc limit 1",
    "points by a parameter of their scenes, counted": "select count(*) from parameters"
    " where path = 'platform.heave.amplitude' and value > 3",
}


def main(points: int = 1_000_000, studies: int = 10) -> None:
    """Measure and print."""
    with TemporaryDirectory() as folder:
        os.chdir(folder)
        names = lay_out(points, studies)
        database = Path("results") / NAME
        sources = Sources(Path("config"), ["invented"], sorted(Path("results").glob("*/*.nc")))
        print("| | s |\n|---|---|")
        began = time.process_time()
        seconds = timed(lambda: build(database, sources))
        own = time.process_time() - began
        print(f"| built from nothing, {points / seconds:.0f} points/s | {seconds:.1f} |")
        print(f"| (of the processor: {points / own:.0f} points/s) | {own:.1f} |")
        size = database.stat().st_size / 1e6
        print(f"| (its size: {size:.0f} MB, {1e6 * size / points:.0f} bytes a point) | |")
        print(f"| brought to date, nothing new | {timed(lambda: build(database, sources)):.2f} |")
        invent(names[0], points // studies, seed=99)
        seconds = timed(lambda: build(database, sources))
        print(f"| brought to date, one dataset of {studies} new | {seconds:.2f} |")
        table = f"invented_{names[0]}"
        for what, sql in ASKED.items():
            with opened(database) as db:
                statement = sql.format(table=table)
                print(f"| {what} | {timed(lambda s=statement, db=db: ask(db, s)):.3f} |")
        shell = {
            "in a shell: `riserstudy results`": ["results"],
            f"in a shell: points of one study of {points // studies} filtered and sorted": [
                *("results", f"invented/{names[0]}", "--where", "heave_amplitude > 9.9"),
                *("--sort=-effective_tension_min", "--columns", "point,effective_tension_min"),
            ],
            "in a shell: all points filtered by `riserstudy sql`": ["sql", ASKED_ALL],
        }
        for what, arguments in shell.items():
            print(f"| {what} | {timed(lambda a=arguments: run(a)):.2f} |")


ASKED_ALL = "select count(*) from points where smallest_tension < 0 and warnings = ''"


def timed(job: Callable[[], Any]) -> float:
    """Seconds that something takes."""
    began = time.perf_counter()
    job()
    return time.perf_counter() - began


def run(arguments: list[str]) -> None:
    """A command in a process of its own."""
    subprocess.run([sys.executable, "-c", COMMAND, *arguments], check=True, capture_output=True)


def lay_out(points: int, studies: int) -> list[str]:
    """Write configuration and datasets; names of the studies."""
    names = [f"run{k}" for k in range(studies)]
    axes = {
        "heave_amplitude": {"path": "platform.heave.amplitude", "unit": "m", "values": [1.0]},
        "heave_period": {"path": "platform.heave.period", "unit": "s", "values": [1.0]},
    }
    study = {"scene": SCENE, "caption": "invented", "axes": axes}
    figure = {"caption": "none", "reads": [names[0]], "plot": "lines"}
    tree = {"paper": "invented", "studies": dict.fromkeys(names, study), "figures": {"one": figure}}
    Path("config/studies").mkdir(parents=True)
    Path("config", SCENE).parent.mkdir(parents=True)
    shutil.copy(ROOT / "config" / SCENE, Path("config", SCENE))  # plots are checked against it
    YAML().dump(json.loads(json.dumps(tree)), Path("config/studies/invented.yaml"))
    for seed, name in enumerate(names):
        invent(name, points // studies, seed)
    return names


def invent(name: str, points: int, seed: int) -> None:
    """A dataset as a study writes it, of random numbers."""
    draw = np.random.default_rng(seed)
    shape = (points // PERIODS, PERIODS)
    over = ("heave_amplitude", "heave_period")
    facts = [column.name for column in facts_of_points()]
    data: dict[str, Any] = {fact: (over, draw.random(shape)) for fact in facts}
    for name, none in (("warnings", ""), ("warning_records", "[]")):
        data[name] = (over, np.full(shape, none, dtype=object))
    data["effects"] = (over, np.full(shape, "support\nplatform motion", dtype=object))
    keys = np.array([f"{seed:08x}{k:024x}" for k in range(points)], dtype=object)
    data["point_key"] = (over, keys.reshape(shape))
    told = {}
    for quantity, unit in (("z", "m"), ("effective_tension", "N"), ("bending_moment", "N m")):
        for ending in ("_max", "_min"):
            values = 1e6 * draw.standard_normal((*shape, 2))
            data[quantity + ending] = ((*over, "s_node"), values, {"units": unit})
            told[f"{quantity} {ending[1:]}"] = values.max(-1) if ending == "_max" else values.min(-1)
    places = np.full((*shape, len(told)), 2394.0)
    data["value_of_statistic"] = ((*over, "statistic"), np.stack([*told.values()], axis=-1))
    data["s_of_statistic"] = ((*over, "statistic"), places)
    axes = {
        "heave_amplitude": np.linspace(0.01, 10.0, shape[0]).tolist(),
        "heave_period": np.linspace(5.0, 20.0, shape[1]).tolist(),
    }
    coords: dict[str, Any] = {"s_node": [0.0, 2394.0], "statistic": [*told]}
    for axis, unit in (("heave_amplitude", "m"), ("heave_period", "s")):
        path = f"platform.{axis.replace('_', '.')}"
        sets = json.dumps({str(value): {path: f"{value} {unit}"} for value in axes[axis]})
        coords[axis] = (axis, axes[axis], {"units": unit, "sets": sets})
    scene = {"riser": [{"length": "2394 m"}], "platform": {"heave": {"amplitude": "1 m"}}}
    attributes = {"scene": json.dumps(scene), "origins": "{}", "evidence": "{}"}
    attributes |= {"effects": json.dumps({"support": "bottom.hold", "platform motion": "platform"})}
    attributes |= {"engine": "0123456789abcdef", "tier": "standard"}
    write_dataset(xr.Dataset(data, coords, attributes), Path(f"results/invented/{name}.nc"))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
