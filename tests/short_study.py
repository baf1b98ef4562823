"""The shortest real study: forty riser statics and a run in waves of motion, drawn and reported."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import xarray as xr

from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.validate import check
from riserstudy.study.models import StudyFile
from riserstudy.study.study import Study

STUDY = """\
paper: example
studies:
  tension:
    scene: scenes/riser.yaml
    caption: a riser at rest under forty tensions
    set: {analysis: {mesh: {elements: 20}}, platform: null, top.x: held}
    limits:
      - {output: lfj_angle, largest: 2 deg, mode: drilling}
      - {output: joint_stroke, largest: 5 m, mode: connected}
    axes:
      top_tension:
        path: top.tension
        unit: kN
        values: {start: 1500, stop: 3450, step: 50}
  heave:
    scene: scenes/riser.yaml
    caption: two amplitudes of surge
    axes:
      surge_amplitude:
        path: platform.surge.amplitude
        unit: m
        values: [1, 2]
"""
SCENE = """\
title: a short riser
water: {density: 1025 kg/m^3}
riser:
  - name: riser
    length: 300 m
    outer_diameter: 0.5334 m
    inner_diameter: 0.4826 m
    young_modulus: 206 GPa
    mass: 700 kg/m
    submerged_weight: 1.5 kN/m
    drag: {coefficient: 1.0, diameter: 0.6 m}
    added_mass: {coefficient: 1.0, diameter: 0.6 m}
bottom: {hold: wellhead, elevation: 0 m, rotation: free}
top: {x: platform, z: free, tension: 2000 kN, rotation: free}
current: {profile: {file: current.csv}}
platform: {surge: {amplitude: 1 m, period: 10 s, ramp: 10 s}}
analysis: {duration: 20 s, mesh: {elements: 20}, step: 0.1 s, output: {interval: 0.5 s}}
"""
CURRENT = "elevation (m), speed (m/s)\n0, 0.2\n300, 1.1\n"
CONFIG = """\
papers: [example]
tier: preview
tiers: {preview: {}, standard: {}, reference: {}}
"""


def lay_out(folder, ends="\n"):
    """Make a folder by the template, with this study in it."""
    from riserstudy.study.new import new_study

    new_study(folder)
    for name in ("chapters/example", "config/published", "config/scenes"):
        for file in (folder / name).iterdir():
            file.unlink()
    for name, text in {
        "config/config.yaml": CONFIG,
        "config/studies/example.yaml": STUDY,
        "config/scenes/riser.yaml": SCENE,
        "config/scenes/current.csv": CURRENT,
    }.items():
        (folder / name).write_text(text, "utf-8", newline=ends)


def snakemake(folder, environment, *arguments, python=sys.executable):
    """A plain ``snakemake`` in its own words, step by step: exit status and all it said."""
    plain = ("--workflow-profile", "none", "--rerun-incomplete", "--scheduler", "greedy")
    done = subprocess.run(
        [python, "-m", "snakemake", "--cores", "2", *plain, *arguments],
        cwd=folder,
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        errors="replace",
    )
    return done.returncode, done.stdout


def simulated(name="tension"):
    """Dataset of one of its studies, from the current folder."""
    from riserstudy.jobs.workplan import Workplan
    from riserstudy.study.collect import dataset_of, results_of

    study = Workplan.read(Path("config"), {}, only=[]).study("example", name)
    results, _ = results_of(study, 1, print)
    return dataset_of(study, results)


def main(folder):
    """Run it twice as a user would, and say how that ended."""
    lay_out(folder)
    for expected in ("(100%) done", "Nothing to be done"):
        status, said = snakemake(folder, os.environ)
        print(said)
        if status or expected not in said:
            sys.exit(f"expected {expected!r}; status {status}")
    for name, values in numbers(folder).items():
        print(name, values.shape, float(np.nansum(abs(values))))


def numbers(folder):
    """All numbers of the datasets, but those that tell times."""
    found = {}
    for file in sorted((Path(folder) / "results/example").glob("*.nc")):
        with xr.open_dataset(file) as dataset:
            for name, values in dataset.variables.items():
                if values.dtype.kind in "fiu" and "seconds" not in name:
                    found[f"{file.stem}/{name}"] = values.values
    return found


def same(one, other):
    """Whether two sets of numbers are the same to the last bit."""
    return one.keys() == other.keys() and all(np.array_equal(one[n], other[n], True) for n in one)


def shared_kernels(cache):
    """A cache of its own with the kernels that are compiled."""
    from riserstudy.files.cache import cache_folder

    (cache_folder() / "numba").mkdir(parents=True, exist_ok=True)
    cache.mkdir(parents=True)
    (cache / "numba").symlink_to(cache_folder().absolute() / "numba")
    return cache


if __name__ == "__main__":
    main(Path(sys.argv[1]))


def studies_in(folder, paper, text):
    """Take studies by name from a text, with the riser's scene in a folder of their own."""
    (folder / "scenes").mkdir()
    (folder / "studies").mkdir()
    (folder / "scenes/riser.yaml").write_text(SCENE)
    (folder / "scenes/current.csv").write_text(CURRENT)
    path = folder / f"studies/{paper}.yaml"
    path.write_text(text)

    def made(name):
        return Study(paper, name, check(StudyFile, read_yaml(path), path).studies[name], folder, "standard")

    return made
