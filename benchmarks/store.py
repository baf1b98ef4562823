"""Measure what points take in the store and beside it: bytes, and time to write and read.

``python benchmarks/store.py [POINTS]`` simulates so many points of each study of the preview, puts them into
each container, and reckons every study with the number of points that it has in the standard tier. The table
stands in docs/results_database.md. Times are those of the processor, without waiting for a disk.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import sqlite3
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import netCDF4
import numpy as np

from riserstudy.dataset.result import Result
from riserstudy.files.whole import write_whole
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.study import store
from riserstudy.study.needed import needed
from riserstudy.study.read import read_studies
from riserstudy.study.simulate_points import has_error_estimate
from riserstudy.study.study import Study

CONFIG = Path(__file__).resolve().parents[1] / "config"
BLOCK = 4096  # bytes that a disk gives at a time


class Point(NamedTuple):
    """A point that was simulated, and what its study keeps of it."""

    key: str
    file: SceneFile
    result: Result
    keep: list[str] | None

    @property
    def kept(self) -> Result:
        """The result with the arrays that the study needs."""
        shapes = {name: np.shape(values) for name, values in self.result.arrays.items()}
        names = needed(shapes, self.keep)
        return Result({n: self.result.arrays[n] for n in shapes if n in names}, self.result.facts)


class Spent(NamedTuple):
    """Bytes and blocks on a disk, and seconds to write and to read the points of one study."""

    content: float = 0.0
    disk: float = 0.0
    write: float = 0.0
    read: float = 0.0

    def plus(self, other: Spent, times: float) -> Spent:
        """The sum with so many times the other."""
        return Spent(*(a + times * b for a, b in zip(self, other, strict=True)))


def main(most: int = 6) -> None:
    """Measure and print."""
    total = dict.fromkeys(CONTAINERS, Spent())
    points = simulated = 0
    for study, standard in studies():
        plan = study.plan[:: max(1, len(study.plan) // most)][:most]
        files = [study.grid.file(point.index) for point in plan]
        runs = [
            Point(p.key, f, run(f.resolved(), estimated=has_error_estimate(study, p)), study.model.keep)
            for p, f in zip(plan, files, strict=True)
        ]
        for name, measure in CONTAINERS.items():
            total[name] = total[name].plus(spent(measure, runs), standard / len(runs))
        points, simulated = points + standard, simulated + len(runs)
    print(f"{simulated} points simulated, which stand for the {points} of the standard tier")
    print("| | MB | MB on disk | ms to write | ms to read |\n|---|---|---|---|---|")
    for name, one in total.items():
        sizes = f"{one.content / 1e6:.0f} | {one.disk / 1e6:.0f}"
        print(f"| {name} | {sizes} | {1e3 * one.write / points:.2f} | {1e3 * one.read / points:.2f} |")


def studies() -> Iterator[tuple[Study, int]]:
    """The studies of the preview, with the number of points that each has in the standard tier."""
    config = read_yaml(CONFIG / "config.yaml", keep=True)
    for paper in config["papers"]:
        file = read_studies(CONFIG, paper)
        for name, model in file.studies.items():
            preview, standard = (
                Study(paper, name, model, CONFIG, t, config["tiers"][t].get("accuracy"), file.readings)
                for t in ("preview", "standard")
            )
            yield preview, len(standard.plan)


def spent(measure: Callable[[list[Point]], list[Callable[[], object]]], points: list[Point]) -> Spent:
    """What a container takes for some points, in an empty folder."""
    here = Path.cwd()
    with TemporaryDirectory() as folder:
        os.chdir(folder)
        os.environ["RISERSTUDY_CACHE"] = folder
        seconds = []
        for job in measure(points):
            began = time.process_time()
            job()
            seconds.append(time.process_time() - began)
        sizes = [file.stat().st_size for file in Path(folder).rglob("*") if file.is_file()]
        os.chdir(here)
    blocks = [BLOCK * math.ceil(size / BLOCK) for size in sizes]
    return Spent(sum(sizes), sum(blocks), *seconds)


def whole_as_it_is(points: list[Point]) -> list[Callable[[], object]]:
    """A file a point with all of its run, not compressed: the store as it was."""
    return _plain([(point, point.result) for point in points])


def kept_as_it_is(points: list[Point]) -> list[Callable[[], object]]:
    """A file a point with what is kept, not compressed."""
    return _plain([(point, point.kept) for point in points])


def _plain(points: list[tuple[Point, Result]]) -> list[Callable[[], object]]:
    def write() -> None:
        for point, result in points:
            write_whole(Path(point.key), plain_bytes(point, result))

    def read() -> None:
        for point, _ in points:
            whole = Path(point.key).read_bytes()
            certain(hashlib.sha256(whole[:-32]).digest() == whole[-32:])
            end = whole.index(b"\n")
            begin = end + 1
            for kind, shape in json.loads(whole[:end])["arrays"].values():
                part = np.frombuffer(whole, np.dtype(kind), math.prod(shape), begin)
                begin += part.nbytes
                part.reshape(shape).copy()

    return [write, read]


def plain_bytes(point: Point, result: Result) -> bytes:
    """JSON, arrays and seal."""
    arrays = {name: np.asarray(values, order="C") for name, values in result.arrays.items()}
    shapes = {name: [values.dtype.str, values.shape] for name, values in arrays.items()}
    said = {"facts": result.facts, "scene": point.file.tree, "source": point.file.source}
    said |= {"origins": {p: o.status for p, o in point.file.origins.items()}, "arrays": shapes}
    content = json.dumps(said).encode() + b"\n" + b"".join(a.tobytes() for a in arrays.values())
    return content + hashlib.sha256(content).digest()


def certain(found: Any) -> Any:
    """What was read; the end where it is not what was written."""
    return found or sys.exit("a point is not whole")


def the_store(points: list[Point]) -> list[Callable[[], object]]:
    """The store as it is."""

    def write() -> None:
        for point in points:
            store.put(point.key, point.result, point.file, point.keep)

    def read() -> None:
        for point in points:
            certain(store.get(point.key, point.keep))

    return [write, read]


def one_database(points: list[Point]) -> list[Callable[[], object]]:
    """One SQLite file a study, with the same bytes as the store; each point is committed by itself."""

    def write() -> None:
        with closing(sqlite3.connect("points.sqlite")) as db:
            db.execute("create table points (key text primary key, content blob) without rowid")
            for point in points:
                content = store.packed(point.key, point.result, point.file, point.kept.arrays)
                with db:
                    db.execute("insert into points values (?, ?)", (point.key, content))

    def read() -> None:
        asked = "select content from points where key = ?"
        with closing(sqlite3.connect("points.sqlite")) as db:
            for point in points:
                ((content,),) = db.execute(asked, (point.key,)).fetchall()
                found = certain(store.unpacked(point.key, content))
                found.result(found.about["arrays"])

    return [write, read]


def one_netcdf(points: list[Point]) -> list[Callable[[], object]]:
    """One netCDF file a study, a group a point, compressed, brought to the disk after each point."""

    def write() -> None:
        with netCDF4.Dataset("points.nc", "w") as file:
            for point in points:
                group = file.createGroup(point.key)
                group.setncattr("about", json.dumps([point.kept.facts, point.file.tree]))
                for name, values in point.kept.arrays.items():
                    sides = [f"{name}_{k}" for k in range(np.ndim(values))]
                    for side, size in zip(sides, np.shape(values), strict=True):
                        group.createDimension(side, size)
                    packed = {"zlib": True, "complevel": 1} if sides else {}
                    group.createVariable(name, "f8", sides, **packed)[...] = values
                file.sync()

    def read() -> None:
        with netCDF4.Dataset("points.nc") as file:
            for point in points:
                group = file[point.key]
                json.loads(group.getncattr("about"))
                for name in group.variables:
                    group[name][...]

    return [write, read]


CONTAINERS = {
    "a file a point, all of the run as it is": whole_as_it_is,
    "a file a point, what is kept as it is": kept_as_it_is,
    "a file a point, what is kept compressed: the store": the_store,
    "one SQLite file a study, the same bytes": one_database,
    "one netCDF file a study, a group a point": one_netcdf,
}

if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
